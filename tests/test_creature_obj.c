/// The generated creature, as the file that is simulated: one closed manifold that stands on the ground, with the budget,
/// normals and arms that the simulation and the stage count on.
#include "near.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 20000, MOST_EDGES = 6 * MOST };

static float position[MOST][3], normal[MOST][3];
static int face[MOST][3];
static int vertex_count, normal_count, face_count;

static void read_line(const char *line)
{
    float *v = position[vertex_count], *n = normal[normal_count], rgb[3];
    int *f = face[face_count], used = 0;
    assert_in_range(vertex_count + 1, 0, MOST - 1);
    assert_in_range(face_count + 1, 0, MOST + 500);
    if (strncmp(line, "vn ", 3) == 0) {
        normal_count += sscanf(line, "vn %f %f %f", &n[0], &n[1], &n[2]) == 3;
    } else if (strncmp(line, "v ", 2) == 0) {
        vertex_count += sscanf(line, "v %f %f %f %f %f %f", &v[0], &v[1], &v[2], &rgb[0], &rgb[1], &rgb[2]) == 6;
    } else if (strncmp(line, "f ", 2) == 0) {
        sscanf(line, "f %d//%*d %d//%*d %d//%*d%n", &f[0], &f[1], &f[2], &used);
        assert_true(used > 0);
        for (int k = 0; k < 3; k++) f[k]--;
        face_count++;
    }
}

static int read_creature(void **state)
{
    (void)state;
    char path[512], command[1100], line[256];
    const char *build = getenv("B"), *out = getenv("TEST_OUT");
    snprintf(path, sizeof path, "%s/creature.obj", out ? out : "/tmp");
    snprintf(command, sizeof command, "%s/creature_obj '%s' >/dev/null", build ? build : "build", path);
    if (system(command) != 0) return -1;
    FILE *f = fopen(path, "r");
    if (!f) return -1;
    while (fgets(line, sizeof line, f)) read_line(line);
    fclose(f);
    return 0;
}

static int compare_edges(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

/// Every directed edge is there once, and so is its reverse; V − E + F = 2 then says that it is one ball.
static void it_is_one_closed_manifold(void **state)
{
    (void)state;
    static uint64_t edges[MOST_EDGES];
    const size_t count = 3 * (size_t)face_count;
    for (size_t i = 0; i < count; i++) {
        const uint64_t from = (uint64_t)face[i / 3][i % 3], to = (uint64_t)face[i / 3][(i + 1) % 3];
        edges[i] = from << 32 | to;
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    for (size_t i = 0; i < count; i++) {
        const uint64_t reverse = edges[i] << 32 | edges[i] >> 32;
        assert_true(i == 0 || edges[i] != edges[i - 1]);
        assert_non_null(bsearch(&reverse, edges, count, sizeof *edges, compare_edges));
    }
    assert_int_equal(vertex_count - face_count * 3 / 2 + face_count, 2);
}

static void it_keeps_to_its_budget(void **state)
{
    (void)state;
    assert_in_range(face_count, 18000, 20000);
    assert_int_equal(vertex_count, normal_count);
}

static void it_stands_on_the_ground(void **state)
{
    (void)state;
    int soles[2] = {0, 0};
    for (int i = 0; i < vertex_count; i++) {
        assert_true(position[i][1] > -0.002f);
        if (position[i][1] < 0.004f) soles[position[i][0] > 0]++;
    }
    assert_true(soles[0] > 40 && soles[1] > 40);
}

/// Triangles have a size, and no vertex' normal points away from a side that it belongs to.
static void its_normals_are_the_surfaces(void **state)
{
    (void)state;
    int off = 0;
    for (int t = 0; t < face_count; t++) {
        const float *a = position[face[t][0]], *b = position[face[t][1]], *c = position[face[t][2]];
        const float u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        const float n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        const float twice = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; k++) {
            const float *m = normal[face[t][k]];
            assert_near((double)(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]), 1.0, 2e-3);
            off += m[0] * n[0] + m[1] * n[1] + m[2] * n[2] < 0.3f * twice;
        }
    }
    assert_true(off < 3 * face_count / 100);
}

/// Beyond the flanks there are hands, and nothing between: a lattice of 6 cm cells leaves at least two of them empty.
static void the_arms_hang_clear_of_the_body(void **state)
{
    (void)state;
    int hand = 0;
    for (int i = 0; i < vertex_count; i++) {
        const float x = fabsf(position[i][0]), y = position[i][1];
        if (y > 0.72f) continue;
        assert_false(x > 0.40f && x < 0.52f);
        hand += x > 0.52f;
    }
    assert_true(hand > 300);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_one_closed_manifold),       cmocka_unit_test(it_keeps_to_its_budget),
        cmocka_unit_test(it_stands_on_the_ground),         cmocka_unit_test(its_normals_are_the_surfaces),
        cmocka_unit_test(the_arms_hang_clear_of_the_body),
    };
    return cmocka_run_group_tests(tests, read_creature, NULL);
}
