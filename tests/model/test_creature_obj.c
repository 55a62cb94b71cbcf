/// The generated creature, as the file that is simulated: one closed manifold that stands on the ground, with the budget,
/// normals and arms that the simulation and the stage count on.
#include "model/character.h"
#include "model/surface.h"
#include "near.h"

enum { MOST_TRIANGLES = 15000 };

static struct character creature;

static int read_creature(void **state)
{
    (void)state;
    char path[512], command[1100];
    const char *build = getenv("B"), *out = getenv("TEST_OUT");
    struct surface surface;
    struct error error = {0};
    snprintf(path, sizeof path, "%s/creature.obj", out ? out : "/tmp");
    snprintf(command, sizeof command, "%s/creature_obj '%s' >/dev/null", build ? build : "build", path);
    if (system(command) != 0 || !surface_read(path, &surface, &error)) return -1;
    bool made = surface.color && character_create(&creature, &surface, 0);
    surface_free(&surface);
    return made ? 0 : -1;
}

static int free_creature(void **state)
{
    (void)state;
    character_free(&creature);
    return 0;
}

static int compare_edges(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

/// Every directed edge is there once, and so is its reverse; V − E + F = 2 then says that it is one ball.
TEST(it_is_one_closed_manifold)
{
    static uint64_t edges[3 * MOST_TRIANGLES];
    const size_t count = (size_t)creature.index_count;
    const uint32_t *index = creature.indices;
    assert_in_range(count, 1, 3 * MOST_TRIANGLES);
    for (size_t i = 0; i < count; i++) {
        edges[i] = (uint64_t)index[i] << 32 | index[i % 3 == 2 ? i - 2 : i + 1];
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    for (size_t i = 0; i < count; i++) {
        const uint64_t reverse = edges[i] << 32 | edges[i] >> 32;
        assert_true(i == 0 || edges[i] != edges[i - 1]);
        assert_non_null(bsearch(&reverse, edges, count, sizeof *edges, compare_edges));
    }
    assert_int_equal(creature.vertex_count - (int)count / 2 + (int)count / 3, 2);
}

/// A coordinate is six numbers a vertex in the file. Six coordinates of 14,000 triangles take 1.4 MB; of the 19,000 that there were
/// while it had two, they would take 2 MB.
TEST(it_keeps_to_its_budget) { assert_in_range(creature.index_count / 3, 12000, MOST_TRIANGLES); }

TEST(it_stands_on_the_ground)
{
    int soles[2] = {0, 0};
    for (int i = 0; i < creature.vertex_count; i++) {
        assert_true(creature.position[i][1] > -0.002f);
        if (creature.position[i][1] < 0.004f) soles[creature.position[i][0] > 0]++;
    }
    assert_true(soles[0] > 40 && soles[1] > 40);
}

/// Triangles have a size, and no vertex' normal points away from a side that it belongs to.
TEST(its_normals_are_the_surfaces)
{
    int off = 0;
    for (int t = 0; t < creature.index_count / 3; t++) {
        const uint32_t *index = creature.indices + 3 * t;
        const float *a = creature.position[index[0]], *b = creature.position[index[1]],
                    *c = creature.position[index[2]];
        const float u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        const float n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        const float twice = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; k++) {
            const float *m = creature.normal[index[k]];
            assert_near((double)(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]), 1.0, 2e-3);
            off += m[0] * n[0] + m[1] * n[1] + m[2] * n[2] < 0.3f * twice;
        }
    }
    assert_true(off < creature.index_count / 100);
}

/// Under the armpits there is nothing beside the flanks: a lattice of 6 cm cells leaves at least two of them empty.
TEST(the_arms_stand_clear_of_the_body)
{
    int hand = 0;
    for (int i = 0; i < creature.vertex_count; i++) {
        const float x = fabsf(creature.position[i][0]), y = creature.position[i][1];
        assert_false(y < 0.75f && x > 0.40f && x < 0.52f);
        hand += x > 0.60f;
    }
    assert_true(hand > 600);
}

TESTS_BETWEEN(read_creature, free_creature)
