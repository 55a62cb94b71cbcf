/// The animal's mesh: closed, smooth, within its budget, and one animal where tail and body meet.
#include "model/fox.h"
#include "models/fox_maker.h"
#include "near.h"
#include "temporary.h"

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Twice the triangle's area times its normal.
static void face_normal(const struct mesh *mesh, int triangle, float out[3])
{
    const uint32_t *index = mesh->indices + 3 * triangle;
    const float *a = mesh->vertices[index[0]].position, *b = mesh->vertices[index[1]].position;
    const float *c = mesh->vertices[index[2]].position;
    const float u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    out[0] = u[1] * v[2] - u[2] * v[1];
    out[1] = u[2] * v[0] - u[0] * v[2];
    out[2] = u[0] * v[1] - u[1] * v[0];
}

/// A directed edge as one number; its reverse with the ends exchanged.
static uint64_t edge_key(uint32_t from, uint32_t to) { return (uint64_t)from << 32 | to; }

static int compare_edges(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

/// Number of directed edges whose reverse is missing; fails where an edge is there twice in one direction.
static int open_edges(const struct mesh *mesh)
{
    const size_t count = (size_t)mesh->index_count;
    uint64_t *edges = malloc(count * sizeof *edges);
    assert_non_null(edges);
    for (size_t i = 0; i < count; i++) {
        edges[i] = edge_key(mesh->indices[i], mesh->indices[i % 3 == 2 ? i - 2 : i + 1]);
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    int open = 0;
    for (size_t i = 0; i < count; i++) {
        if (i > 0) assert_true(edges[i] != edges[i - 1]);
        const uint64_t reverse = edges[i] << 32 | edges[i] >> 32;
        open += bsearch(&reverse, edges, count, sizeof *edges, compare_edges) == NULL;
    }
    free(edges);
    return open;
}

static struct mesh body, tail, levels[FOX_LEVELS]; ///< made once

static int make_meshes(void **state)
{
    (void)state;
    mesh_fox_body(0.030f, 0.0028f, 3, &body);
    mesh_fox_tail(100, 40, &tail);
    for (int level = 0; level < FOX_LEVELS; level++) mesh_fox(level, &levels[level]);
    return 0;
}

static int free_meshes(void **state)
{
    (void)state;
    mesh_free(&body);
    mesh_free(&tail);
    for (int level = 0; level < FOX_LEVELS; level++) mesh_free(&levels[level]);
    return 0;
}

TEST(the_body_is_closed) { assert_int_equal(open_edges(&body), 0); }

TEST(the_tail_is_open_only_inside_the_body)
{
    const struct mesh *mesh = &tail;
    assert_int_equal(open_edges(mesh), 40);
    float start = INFINITY, end = -INFINITY;
    for (int v = 0; v < mesh->vertex_count; v++) {
        start = fminf(start, mesh->vertices[v].position[2]);
        end = fmaxf(end, mesh->vertices[v].position[2]);
    }
    assert_near(end, FOX_TAIL_LENGTH, 1e-5);
    assert_true(start < -0.05f && start > fox_body_lo[2]);
}

/// Lighting and culling rely on it.
TEST(normals_are_unit_and_agree_with_the_triangles)
{
    for (int level = 0; level < FOX_LEVELS; level++) {
        const struct mesh *mesh = &levels[level];
        int wrong = 0;
        for (int v = 0; v < mesh->vertex_count; v++) {
            assert_near(dot(mesh->vertices[v].normal, mesh->vertices[v].normal), 1.0, 1e-3);
            assert_true(mesh->vertices[v].bend >= 0.0f && mesh->vertices[v].bend <= 1.0f);
        }
        for (int t = 0; t < mesh->index_count / 3; t++) {
            float face[3], smooth[3] = {0};
            face_normal(mesh, t, face);
            for (int c = 0; c < 3; c++) {
                const float *normal = mesh->vertices[mesh->indices[3 * t + c]].normal;
                for (int k = 0; k < 3; k++) smooth[k] += normal[k];
            }
            wrong += dot(face, smooth) < 0.0f;
        }
        assert_true(wrong <= mesh->index_count / 3 / 200);
    }
}

/// What an eye sees as round is nowhere cut off by an edge: at 250 pixels a metre not by a pixel.
TEST(silhouettes_have_no_corners)
{
    const struct mesh *mesh = &levels[0];
    for (int i = 0; i < mesh->index_count; i++) {
        const struct vertex *a = &mesh->vertices[mesh->indices[i]];
        const struct vertex *b = &mesh->vertices[mesh->indices[i % 3 == 2 ? i - 2 : i + 1]];
        float edge[3], turn[3];
        for (int k = 0; k < 3; k++) {
            edge[k] = a->position[k] - b->position[k];
            turn[k] = a->normal[k] - b->normal[k];
        }
        assert_true(sqrtf(dot(edge, edge) * dot(turn, turn)) / 8.0f < 0.004f); // height of the arc over the edge
    }
}

TEST(the_stage_stays_within_its_triangles)
{
    for (int animals = 1; animals <= 8; animals++)
        assert_true(animals * levels[fox_level(animals)].index_count / 3 <= 20000);
}

TEST(the_body_stands_on_the_ground)
{
    float low = INFINITY;
    for (int v = 0; v < body.vertex_count; v++) low = fminf(low, body.vertices[v].position[1]);
    assert_near(low, -FOX_BASE_HEIGHT, 0.02);
}

/// Where the tail leaves the body both skins coincide, in place, colour and bending, so that no line shows.
TEST(tail_and_body_meet_smoothly)
{
    int seen = 0;
    for (int v = 0; v < body.vertex_count; v++) {
        const struct vertex *vertex = &body.vertices[v];
        const float z = vertex->position[2];
        if (z < 0.13f || z > 0.2f) continue;
        const float radius = hypotf(vertex->position[0], vertex->position[1]);
        assert_near(radius, fox_tail_radius(z), 0.008);
        assert_true(vertex->normal[2] < 0.15f);
        assert_near(vertex->bend, 1.0, 1e-6);
        seen++;
    }
    assert_true(seen > 40);
}

/// From the root it swells to about twice as much, and its pointed tip is white.
TEST(the_brush_swells_and_ends_white)
{
    const struct mesh *mesh = &tail;
    float thickest = 0.0f, at = 0.0f;
    int edges = 0;
    for (int ring = 0; ring < 100; ring++) {
        const struct vertex *top = &mesh->vertices[ring * 40 + 10];
        if (top->position[1] > thickest) at = top->position[2];
        thickest = fmaxf(thickest, top->position[1]);
        edges += ring > 0 && (top->mark[MARK_WHITE] > 0) != (top[-40].mark[MARK_WHITE] > 0);
    }
    assert_near(thickest / FOX_TAIL_RADIUS, 2.0, 0.1);
    assert_true(at > 0.5f * FOX_TAIL_LENGTH && at < 0.75f * FOX_TAIL_LENGTH);
    assert_int_equal(edges, 1);
    const struct vertex *tip = &mesh->vertices[mesh->vertex_count - 1];
    assert_true(tip->color[0] > 0.8f && tip->color[2] > 0.75f);
}

/// The stage draws eyes and nose in the head's own space, from the front.
TEST(the_face_looks_where_the_stage_draws_it)
{
    const struct mesh *mesh = &levels[0];
    float m[16];
    int nose = 0, eyes[2] = {0, 0};
    fox_head_from_bind(m);
    for (int v = 0; v < mesh->vertex_count; v++) {
        const float *p = mesh->vertices[v].position;
        float q[3];
        for (int k = 0; k < 3; k++) q[k] = m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
        if (mesh->vertices[v].color[0] > 0.1f || q[2] > -0.04f) continue;
        nose += fabsf(q[0]) < 0.02f && fabsf(q[1] + 0.05f) < 0.03f && q[2] < -0.25f;
        eyes[q[0] > 0] += fabsf(fabsf(q[0]) - 0.076f) < 0.03f && fabsf(q[1] - 0.016f) < 0.035f;
    }
    assert_true(nose > 3 && eyes[0] > 3 && eyes[1] > 3);
}

/// Of a part: both have as many vertices and triangles, and each vertex the same place, coat and weights, but for another machine's rounding.
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

/// The tool still makes the file that is committed, and that the app has in it.
TEST(the_file_is_what_its_tool_makes)
{
    char path[512], command[1100];
    const char *build = getenv("B");
    struct gltf made, committed;
    snprintf(path, sizeof path, "%s", temporary_path("fox.glb"));
    snprintf(command, sizeof command, "%s/fox_glb '%s' >/dev/null", build ? build : "build", path);
    assert_int_equal(system(command), 0);
    assert_done(gltf_read(path, &made, &error));
    assert_done(gltf_read("assets/models/fox.glb", &committed, &error));
    assert_int_equal(made.mesh_count, FOX_LEVELS);
    assert_int_equal(made.node_count, committed.node_count);
    for (int m = 0; m < FOX_LEVELS; m++) {
        for (int p = 0; p < 2; p++) assert_alike(&made.meshes[m].parts[p], &committed.meshes[m].parts[p]);
    }
    gltf_free(&made);
    gltf_free(&committed);
}

TESTS_BETWEEN(make_meshes, free_meshes)
