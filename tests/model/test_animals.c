/// The animals that tools make: the fox, its tail and the creature are closed and smooth within their budgets; the dog is whole, with joints to
/// hang chains on, and clips that loop and leave the chains to wiggly; and committed files are what the tools make.
#include "model/character.h"
#include "model/fox.h"
#include "model/gltf.h"
#include "model/vector.h"
#include "models/fox_maker.h"
#include "near.h"
#include "temporary.h"

#define DOG "assets/models/dog.glb"
enum { KEYS = 24, LEGS = 4, MOST_TRIANGLES = 15000, SEGMENTS = 40 };

static struct mesh body, tail, levels[FOX_LEVELS];
static struct character creature;
static struct gltf dog;

/// The path of what a tool makes.
static const char *make_file(const char *tool, const char *name)
{
    static char path[512];
    char command[1100];
    const char *build = getenv("B");
    snprintf(path, sizeof path, "%s", temporary_path(name));
    snprintf(command, sizeof command, "%s/%s '%s' >/dev/null", build ? build : "build", tool, path);
    return system(command) == 0 ? path : NULL;
}

static int make_animals(void **state)
{
    (void)state;
    struct surface surface;
    struct error error = {0};
    mesh_fox_body(0.030f, 0.0028f, 3, &body);
    mesh_fox_tail(100, SEGMENTS, &tail);
    for (int level = 0; level < FOX_LEVELS; level++) mesh_fox(level, &levels[level]);
    const char *path = make_file("creature_obj", "creature.obj");
    const bool made = path && surface_read(path, &surface, &error) && surface.color &&
                      character_create(&creature, &surface, 0) && gltf_read(DOG, &dog, &error);
    if (made) surface_free(&surface);
    return made ? 0 : -1;
}

static int free_animals(void **state)
{
    (void)state;
    mesh_free(&body);
    mesh_free(&tail);
    for (int level = 0; level < FOX_LEVELS; level++) mesh_free(&levels[level]);
    character_free(&creature);
    gltf_free(&dog);
    return 0;
}

TESTS_BETWEEN(make_animals, free_animals)

// --- skins

/// A mesh, wherever its numbers are.
struct skin {
    const char *what;
    const float *position, *normal;
    size_t stride; ///< floats from one to the next
    const uint32_t *indices;
    int vertex_count, index_count;
};

static struct skin skin_of(const char *what, const struct mesh *mesh)
{
    return (struct skin){
        what,          mesh->vertices->position, mesh->vertices->normal, sizeof *mesh->vertices / sizeof(float),
        mesh->indices, mesh->vertex_count,       mesh->index_count};
}

static struct skin skin_of_creature(void)
{
    return (struct skin){"the creature",   *creature.position,    *creature.normal,    3,
                         creature.indices, creature.vertex_count, creature.index_count};
}

static int compare_edges(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

/// Number of directed edges whose reverse is missing; fails where an edge is there twice in one direction.
static int open_edges(const struct skin *skin)
{
    const size_t count = (size_t)skin->index_count;
    const uint32_t *index = skin->indices;
    uint64_t *edges = malloc(count * sizeof *edges);
    assert_true(edges && count > 0);
    for (size_t i = 0; i < count; i++) edges[i] = (uint64_t)index[i] << 32 | index[i % 3 == 2 ? i - 2 : i + 1];
    qsort(edges, count, sizeof *edges, compare_edges);
    int open = 0;
    for (size_t i = 0; i < count; i++) {
        if (i > 0 && edges[i] == edges[i - 1]) fail_msg("%s: an edge is there twice", skin->what);
        const uint64_t reverse = edges[i] << 32 | edges[i] >> 32;
        open += bsearch(&reverse, edges, count, sizeof *edges, compare_edges) == NULL;
    }
    free(edges);
    return open;
}

/// V − E + F = 2 then says that the creature is one ball. The fox's tail is open where it is inside the body.
TEST(skins_are_closed)
{
    const struct skin ball = skin_of_creature(), of_body = skin_of("the body", &body),
                      of_tail = skin_of("the tail", &tail);
    assert_int_equal(open_edges(&ball), 0);
    assert_int_equal(ball.vertex_count - ball.index_count / 2 + ball.index_count / 3, 2);
    assert_int_equal(open_edges(&of_body), 0);
    assert_int_equal(open_edges(&of_tail), SEGMENTS);
    float start = INFINITY, end = -INFINITY;
    for (int v = 0; v < tail.vertex_count; v++) {
        start = fminf(start, tail.vertices[v].position[2]);
        end = fmaxf(end, tail.vertices[v].position[2]);
    }
    assert_near(end, FOX_TAIL_LENGTH, 1e-5);
    assert_true(start < -0.05f && start > fox_body_lo[2]);
}

/// Normals are unit vectors; returns the share of corners that turn away from their triangle, `least` being the cosine that is allowed.
static double turned_away(const struct skin *skin, float least)
{
    int off = 0;
    for (int v = 0; v < skin->vertex_count; v++) {
        const vec3s normal = vec3_from(skin->normal + skin->stride * (size_t)v);
        if (!(fabsf(glms_vec3_norm2(normal) - 1) < 2e-3f)) fail_msg("%s: normal %d is no unit vector", skin->what, v);
    }
    for (int i = 0; i < skin->index_count; i++) {
        const uint32_t *corner = skin->indices + i / 3 * 3;
        const float *at[3];
        for (int k = 0; k < 3; k++) at[k] = skin->position + skin->stride * corner[k];
        const vec3s face = triangle_normal(at[0], at[1], at[2]);
        off += glms_vec3_dot(vec3_from(skin->normal + skin->stride * corner[i % 3]), face) <
               least * glms_vec3_norm(face);
    }
    return off / (double)skin->index_count;
}

/// Lighting and culling rely on it.
TEST(normals_are_unit_and_agree_with_the_triangles)
{
    const struct skin ball = skin_of_creature();
    assert_true(turned_away(&ball, 0.3f) < 0.01);
    for (int level = 0; level < FOX_LEVELS; level++) {
        const struct skin skin = skin_of("the fox", &levels[level]);
        assert_true(turned_away(&skin, 0) < 0.01);
        for (int v = 0; v < levels[level].vertex_count; v++)
            assert_true(levels[level].vertices[v].bend >= 0.0f && levels[level].vertices[v].bend <= 1.0f);
    }
}

/// What an eye sees as round is nowhere cut off by an edge: at 250 pixels a metre not by a pixel.
TEST(silhouettes_have_no_corners)
{
    const struct mesh *mesh = &levels[0];
    for (int i = 0; i < mesh->index_count; i++) {
        const struct vertex *a = &mesh->vertices[mesh->indices[i]];
        const struct vertex *b = &mesh->vertices[mesh->indices[i % 3 == 2 ? i - 2 : i + 1]];
        const float edge = glms_vec3_distance(vec3_from(a->position), vec3_from(b->position));
        const float turn = glms_vec3_distance(vec3_from(a->normal), vec3_from(b->normal));
        assert_true(edge * turn / 8.0f < 0.004f); // height of the arc over the edge
    }
}

/// A coordinate is six numbers a vertex in the file. Six coordinates of 14,000 triangles take 1.4 MB; of the 19,000 that the creature had
/// while it had two, they would take 2 MB.
TEST(animals_keep_to_their_budgets)
{
    struct stat file;
    int triangles = 0;
    for (int animals = 1; animals <= 8; animals++)
        assert_true(animals * levels[fox_level(animals)].index_count / 3 <= 20000);
    assert_in_range(creature.index_count / 3, 12000, MOST_TRIANGLES);
    assert_int_equal(stat(DOG, &file), 0);
    assert_true(file.st_size <= 1000000);
    for (int p = 0; p < dog.meshes[0].part_count; p++) triangles += dog.meshes[0].parts[p].index_count / 3;
    assert_in_range(triangles, 8000, 20000);
    assert_null(dog.not_shown);
}

TEST(animals_stand_on_the_ground)
{
    float low = INFINITY;
    int soles[2] = {0, 0};
    for (int v = 0; v < body.vertex_count; v++) low = fminf(low, body.vertices[v].position[1]);
    assert_near(low, -FOX_BASE_HEIGHT, 0.02);
    assert_near(dog.lo[1], 0.0, 2e-3);
    for (int i = 0; i < creature.vertex_count; i++) {
        assert_true(creature.position[i][1] > -0.002f);
        if (creature.position[i][1] < 0.004f) soles[creature.position[i][0] > 0]++;
    }
    assert_true(soles[0] > 40 && soles[1] > 40);
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

/// Where the tail leaves the body both skins coincide, in place, colour and bending, so that no line shows.
TEST(tail_and_body_meet_smoothly)
{
    int seen = 0;
    for (int v = 0; v < body.vertex_count; v++) {
        const struct vertex *vertex = &body.vertices[v];
        const float z = vertex->position[2];
        if (z < 0.13f || z > 0.2f) continue;
        assert_near(hypotf(vertex->position[0], vertex->position[1]), fox_tail_radius(z), 0.008);
        assert_true(vertex->normal[2] < 0.15f);
        assert_near(vertex->bend, 1.0, 1e-6);
        seen++;
    }
    assert_true(seen > 40);
}

/// From the root it swells to about twice as much, and its pointed tip is white.
TEST(the_brush_swells_and_ends_white)
{
    float thickest = 0.0f, at = 0.0f;
    int edges = 0;
    for (int ring = 0; ring < 100; ring++) {
        const struct vertex *top = &tail.vertices[ring * SEGMENTS + SEGMENTS / 4];
        if (top->position[1] > thickest) at = top->position[2];
        thickest = fmaxf(thickest, top->position[1]);
        edges += ring > 0 && (top->mark[MARK_WHITE] > 0) != (top[-SEGMENTS].mark[MARK_WHITE] > 0);
    }
    assert_near(thickest / FOX_TAIL_RADIUS, 2.0, 0.1);
    assert_true(at > 0.5f * FOX_TAIL_LENGTH && at < 0.75f * FOX_TAIL_LENGTH);
    assert_int_equal(edges, 1);
    const struct vertex *tip = &tail.vertices[tail.vertex_count - 1];
    assert_true(tip->color[0] > 0.8f && tip->color[2] > 0.75f);
}

/// The stage draws eyes and nose in the head's own space, from the front.
TEST(the_face_looks_where_the_stage_draws_it)
{
    float m[16];
    int nose = 0, eyes[2] = {0, 0};
    fox_head_from_bind(m);
    for (int v = 0; v < levels[0].vertex_count; v++) {
        const vec3s q = glms_mat4_mulv3(mat4_from(m), vec3_from(levels[0].vertices[v].position), 1);
        if (levels[0].vertices[v].color[0] > 0.1f || q.z > -0.04f) continue;
        nose += fabsf(q.x) < 0.02f && fabsf(q.y + 0.05f) < 0.03f && q.z < -0.25f;
        eyes[q.x > 0] += fabsf(fabsf(q.x) - 0.076f) < 0.03f && fabsf(q.y - 0.016f) < 0.035f;
    }
    assert_true(nose > 3 && eyes[0] > 3 && eyes[1] > 3);
}

// --- the dog's joints and clips

static int node(const char *name)
{
    const int found = gltf_find_node(&dog, name);
    if (found < 0) fail_msg("%s has no joint %s", DOG, name);
    return found;
}

/// A chain is a row of joints, each the child of the one before.
TEST(the_dog_has_chains)
{
    static const struct {
        const char *name, *above, *suffix;
        int joints;
    } chains[] = {{"tail", "hips", "", 8}, {"ear", "head", "_L", 4}, {"ear", "head", "_R", 4}};
    static const char *const others[] = {"spine_1",       "chest",        "neck",       "jaw",
                                         "thigh_front_L", "shin_front_R", "foot_back_L"};
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        int before = node(chains[c].above);
        for (int n = 1; n <= chains[c].joints; n++) {
            char name[32];
            snprintf(name, sizeof name, "%s_%d%s", chains[c].name, n, chains[c].suffix);
            assert_int_equal(dog.nodes[node(name)].parent, before);
            before = node(name);
        }
    }
    for (size_t n = 0; n < sizeof others / sizeof *others; n++) node(others[n]);
}

TEST(the_dogs_clips_loop)
{
    static const char *const names[] = {"Walk", "Trot", "Idle"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        const int number = gltf_find_clip(&dog, names[n]);
        assert_true(number >= 0);
        const struct gltf_clip *clip = &dog.clips[number];
        assert_true(clip->channel_count > 0);
        for (int i = 0; i < clip->channel_count; i++) {
            const struct gltf_channel *c = &clip->channels[i];
            const float *last = c->values + (size_t)c->components * (size_t)(c->key_count - 1);
            assert_int_equal(c->interpolation, GLTF_LINEAR);
            assert_memory_equal(c->values, last, sizeof *last * (size_t)c->components);
            for (int k = 1; c->path == GLTF_ROTATION && k < c->key_count; k++) {
                const float *a = c->values + 4 * (k - 1), *b = a + 4;
                assert_true(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] > 0.0f); // the short way
            }
            const char *joint = dog.nodes[c->node].name;
            if (strncmp(joint, "tail", 4) == 0 || strncmp(joint, "ear", 3) == 0)
                fail_msg("%s moves %s, which is for splines", names[n], joint);
        }
    }
    assert_near(dog.clips[gltf_find_clip(&dog, "Walk")].last, 1.0, 1e-6);
}

/// In the walk each paw stands for well over half of the time, and all the while moves back at one pace: it would not slip on a moving
/// ground. Nothing sinks into the ground, between keys either.
TEST(the_dogs_paws_stay_on_the_ground)
{
    static const char *const toes[LEGS] = {"toe_front_L", "toe_front_R", "toe_back_L", "toe_back_R"};
    struct gltf_pose pose;
    const int skin = node("dog"), count = gltf_vertex_count(&dog, skin);
    float(*positions)[3] = malloc((size_t)count * sizeof *positions);
    assert_true(positions && gltf_pose_create(&dog, &pose));
    for (int leg = 0; leg < LEGS; leg++) {
        const int toe = node(toes[leg]);
        float rest, at[KEYS + 1][2];
        gltf_pose_clip(&dog, -1, 0.0, &pose);
        gltf_pose_world(&dog, &pose);
        rest = pose.world[toe][13];
        for (int k = 0; k <= KEYS; k++) {
            gltf_pose_clip(&dog, gltf_find_clip(&dog, "Walk"), (double)k / KEYS, &pose);
            gltf_pose_world(&dog, &pose);
            memcpy(at[k], pose.world[toe] + 13, sizeof at[k]);
        }
        int steps = 0;
        for (int k = 0; k < KEYS; k++) {
            if (fabsf(at[k][0] - rest) > 5e-4f || fabsf(at[k + 1][0] - rest) > 5e-4f) continue;
            assert_near(at[k + 1][1] - at[k][1], -0.25 / 0.62 / KEYS, 5e-4);
            steps++;
        }
        assert_in_range(steps, KEYS / 2, 17);
    }
    for (int sample = 0; sample < 16 * dog.clip_count; sample++) {
        const struct gltf_clip *clip = &dog.clips[sample / 16];
        gltf_pose_clip(&dog, sample / 16, clip->last * (sample % 16) / 16, &pose);
        gltf_pose_world(&dog, &pose);
        gltf_pose_vertices(&dog, &pose, skin, positions, NULL);
        for (int v = 0; v < count; v++)
            if (positions[v][1] < -0.003f)
                fail_msg("%s, sample %d: %g m", clip->name, sample % 16, (double)positions[v][1]);
    }
    gltf_pose_free(&pose);
    free(positions);
}

// --- the tools still make the files that are committed, but for another machine's rounding

/// Of a part of the fox: both have as many vertices and triangles, and each vertex the same place, coat and weights.
static void assert_alike(const struct gltf_part *is, const struct gltf_part *was)
{
    assert_int_equal(is->vertex_count, was->vertex_count);
    assert_int_equal(is->index_count, was->index_count);
    assert_true(is->mark && was->mark);
    assert_memory_equal(is->indices, was->indices, (size_t)was->index_count * sizeof *was->indices);
    for (int v = 0; v < was->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            assert_near(is->position[v][k], was->position[v][k], 1e-4);
            assert_near(is->normal[v][k], was->normal[v][k], 1e-2);
            assert_near(is->mark[v][k], was->mark[v][k], 1e-3);
        }
        for (int k = 0; k < 2; k++) assert_near(is->fur[v][k], was->fur[v][k], 1e-2);
        for (int k = 0; k < 4; k++) assert_near(is->weights[v][k], was->weights[v][k], 1e-2);
    }
}

TEST(the_fox_is_what_its_tool_makes)
{
    struct gltf made, committed;
    assert_done(gltf_read(make_file("fox_glb", "fox.glb"), &made, &error));
    assert_done(gltf_read("assets/models/fox.glb", &committed, &error));
    assert_int_equal(made.mesh_count, FOX_LEVELS);
    assert_int_equal(made.node_count, committed.node_count);
    for (int m = 0; m < FOX_LEVELS; m++)
        for (int p = 0; p < 2; p++) assert_alike(&made.meshes[m].parts[p], &committed.meshes[m].parts[p]);
    gltf_free(&made);
    gltf_free(&committed);
}

/// What a model looks like however it is cut into triangles: sums of places, normals, colours and joints' weights over its area.
enum { PER_CORNER = 10, SUMS = PER_CORNER + 64 };

static void add_part(const struct gltf_part *part, double *sums)
{
    for (int i = 0; i < part->index_count; i++) {
        const uint32_t *corner = part->indices + i / 3 * 3, v = part->indices[i];
        const vec3s face =
            triangle_normal(part->position[corner[0]], part->position[corner[1]], part->position[corner[2]]);
        const double area = (double)glms_vec3_norm(face) / 6;
        const float *p = part->position[v], *n = part->normal[v];
        sums[0] += area;
        for (int k = 0; k < 3; k++) {
            sums[1 + k] += area * (double)p[k];
            sums[4 + k] += area * (double)(n[k] * p[k]); // the normals' own sum is nothing
            sums[7 + k] += area * (part->color ? (double)(part->color[v][k] * (1.0f + fabsf(p[k]))) : 1.0);
        }
        for (int j = 0; part->joints && j < GLTF_INFLUENCES; j++) {
            assert_in_range(part->joints[v][j], 0, SUMS - PER_CORNER - 1);
            sums[PER_CORNER + part->joints[v][j]] += area * (double)part->weights[v][j];
        }
    }
}

TEST(the_dog_is_what_its_tool_makes)
{
    struct gltf made;
    if (!is_thorough()) skip();
    assert_done(gltf_read(make_file("dog_glb", "dog.glb"), &made, &error));
    assert_int_equal(made.node_count, dog.node_count);
    for (int n = 0; n < dog.node_count; n++) {
        assert_string_equal(made.nodes[n].name, dog.nodes[n].name);
        assert_int_equal(made.nodes[n].parent, dog.nodes[n].parent);
        for (int k = 0; k < 3; k++)
            assert_near(made.nodes[n].place.translation[k], dog.nodes[n].place.translation[k], 1e-5);
    }
    assert_int_equal(made.meshes[0].part_count, dog.meshes[0].part_count);
    for (int p = 0; p < dog.meshes[0].part_count; p++) {
        double sums[2][SUMS] = {{0}};
        add_part(&dog.meshes[0].parts[p], sums[0]);
        add_part(&made.meshes[0].parts[p], sums[1]);
        for (int s = 0; s < SUMS; s++) assert_near(sums[1][s] / sums[0][0], sums[0][s] / sums[0][0], 5e-4);
        for (int c = 0; c < 4; c++) assert_near(made.materials[p].color[c], dog.materials[p].color[c], 1e-5);
    }
    assert_int_equal(made.clip_count, dog.clip_count);
    for (int c = 0; c < dog.clip_count; c++) {
        assert_int_equal(made.clips[c].channel_count, dog.clips[c].channel_count);
        for (int i = 0; i < dog.clips[c].channel_count; i++) {
            const struct gltf_channel *is = &made.clips[c].channels[i], *was = &dog.clips[c].channels[i];
            assert_int_equal(is->key_count * is->components, was->key_count * was->components);
            for (int k = 0; k < was->key_count * was->components; k++)
                assert_near(is->values[k], was->values[k], 1e-5);
        }
    }
    gltf_free(&made);
}
