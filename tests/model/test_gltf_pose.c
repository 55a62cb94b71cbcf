/// Poses of glTF characters: every interpolation against numbers made by hand, skins and morph targets against the textbook.
#include "gltf_builder.h"

/// One node's clip at a time.
static void place_at(const struct gltf *gltf, int clip, double time, struct gltf_place *place)
{
    struct gltf_pose pose;
    assert_true(gltf_pose_create(gltf, &pose));
    gltf_pose_clip(gltf, clip, time, &pose);
    *place = pose.place[0];
    gltf_pose_free(&pose);
}

static void assert_numbers(const float *actual, const double *expected, int count)
{
    for (int i = 0; i < count; i++) assert_near(actual[i], expected[i], 2e-6);
}

#define CHANNEL(path, sampler) "{\"sampler\":" sampler ",\"target\":{\"node\":0,\"path\":\"" path "\"}}"

/// Keys at 1, 2 and 4 seconds.
GLTF_TEST(step_and_linear)
{
    const float times[] = {1, 2, 4}, values[3][3] = {{0, 10, 4}, {2, 20, 4}, {6, 0, 8}};
    struct gltf_place place;
    add_data(b, FLOAT, "SCALAR", 3, times, sizeof times);
    add_data(b, FLOAT, "VEC3", 3, values, sizeof values);
    read_built(b, "\"nodes\":[{\"translation\":[7,8,9]}],\"animations\":[{\"name\":\"Walk\",\"channels\":[" CHANNEL(
                      "translation", "0") "," CHANNEL("scale", "1") "],\"samplers\":[{\"input\":0,\"output\":1},{"
                                                                    "\"input\":0,\"output\":1,\"interpolation\":"
                                                                    "\"STEP\"}]},{\"channels\":[],\"samplers\":[]}]");
    assert_int_equal(gltf_find_clip(&b->gltf, "Walk"), 0);
    assert_int_equal(gltf_find_clip(&b->gltf, "clip 1"), 1);
    assert_near(b->gltf.clips[0].last, 4, 0);
    const struct {
        double time, linear[3], step[3];
    } cases[] = {
        {-5, {0, 10, 4}, {0, 10, 4}}, {1, {0, 10, 4}, {0, 10, 4}}, {1.25, {0.5, 12.5, 4}, {0, 10, 4}},
        {2, {2, 20, 4}, {2, 20, 4}},  {3, {4, 10, 6}, {2, 20, 4}}, {3.999, {5.998, 0.01, 7.998}, {2, 20, 4}},
        {4, {6, 0, 8}, {6, 0, 8}},    {1e9, {6, 0, 8}, {6, 0, 8}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        place_at(&b->gltf, 0, cases[i].time, &place);
        for (int k = 0; k < 3; k++) assert_near(place.translation[k], cases[i].linear[k], 1e-5);
        assert_numbers(place.scale, cases[i].step, 3);
    }
    place_at(&b->gltf, -1, 3, &place);
    assert_numbers(place.translation, (const double[]){7, 8, 9}, 3);
}

/// From no turn to 120° about z, whose key is written as −q; the short way is a third of it at a third of the time. And a pair of keys that
/// are the same rotation with other signs: nothing moves.
GLTF_TEST(rotations_take_the_short_way)
{
    const double turn = acos(-1) / 3; // half of 120°
    const float times[] = {0, 3, 4};
    const float q[3][4] = {
        {0, 0, 0, 1}, {0, 0, (float)-sin(turn), (float)-cos(turn)}, {0, 0, (float)sin(turn), (float)cos(turn)}};
    struct gltf_place place;
    add_data(b, FLOAT, "SCALAR", 3, times, sizeof times);
    add_data(b, FLOAT, "VEC4", 3, q, sizeof q);
    read_built(b, "\"nodes\":[{}],\"animations\":[{\"channels\":[" CHANNEL(
                      "rotation", "0") "],\"samplers\":[{\"input\":0,"
                                       "\"output\":1,\"interpolation\":\"LINEAR\"}]}]");
    place_at(&b->gltf, 0, 1, &place);
    assert_numbers(place.rotation, (const double[]){0, 0, sin(turn / 3), cos(turn / 3)}, 4);
    place_at(&b->gltf, 0, 3.5, &place);
    assert_near(fabsf(place.rotation[2]), sin(turn), 1e-6);
    assert_near(fabsf(place.rotation[3]), cos(turn), 1e-6);
}

/// The spline of glTF's appendix at a quarter of two seconds: s = 1/4 has the weights 27/32, 9/64, 5/32 and −3/64.
GLTF_TEST(cubic_splines)
{
    const float times[] = {1, 3};
    const float moves[6][3] = {{9, 9, 9}, {1, 2, 3}, {4, 0, -8}, {8, 16, 0}, {5, 6, 7}, {9, 9, 9}};
    const float turns[6][4] = {{0}, {0, 0, 0, 1}, {0, 0, 0.5f, 0}, {0}, {0, 0, 1, 0}, {0}};
    struct gltf_place place;
    add_data(b, FLOAT, "SCALAR", 2, times, sizeof times);
    add_data(b, FLOAT, "VEC3", 6, moves, sizeof moves);
    add_data(b, FLOAT, "VEC4", 6, turns, sizeof turns);
    read_built(b,
               "\"nodes\":[{}],\"animations\":[{\"channels\":[" CHANNEL("translation", "0") "," CHANNEL(
                   "rotation", "1") "],\"samplers\":[{\"input\":0,\"output\":1,\"interpolation\":\"CUBICSPLINE\"},{"
                                    "\"input\":0,\"output\":2,\"interpolation\":\"CUBICSPLINE\"}]}]");
    place_at(&b->gltf, 0, 1.5, &place);
    double expected[4], length;
    for (int k = 0; k < 3; k++)
        expected[k] = 27 / 32.0 * moves[1][k] + 2 * 9 / 64.0 * moves[2][k] + 5 / 32.0 * moves[4][k] -
                      2 * 3 / 64.0 * moves[3][k];
    assert_numbers(place.translation, expected, 3);
    for (int k = 0; k < 4; k++)
        expected[k] = 27 / 32.0 * turns[1][k] + 2 * 9 / 64.0 * turns[2][k] + 5 / 32.0 * turns[4][k] -
                      2 * 3 / 64.0 * turns[3][k];
    length = sqrt(expected[2] * expected[2] + expected[3] * expected[3]);
    for (int k = 0; k < 4; k++) expected[k] /= length;
    assert_numbers(place.rotation, expected, 4);
    place_at(&b->gltf, 0, 9, &place);
    assert_numbers(place.translation, (const double[]){5, 6, 7}, 3);
    place_at(&b->gltf, 0, 0, &place);
    assert_numbers(place.translation, (const double[]){1, 2, 3}, 3);
}

/// Two nodes show one mesh with two targets; weights at rest are the mesh's and the second node's own, a clip moves the second's. Times
/// as normalised bytes, weights as normalised shorts.
GLTF_TEST(morph_weights)
{
    const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, up[3][3] = {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}};
    const float tilt[3][3] = {{1, 0, -1}, {1, 0, -1}, {1, 0, -1}}, normal[3][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    const uint8_t times[] = {0, 255};
    const int16_t weights[] = {0, 32767, 32767, -32767};
    struct gltf_pose pose;
    char more[64];
    add_data(b, FLOAT, "VEC3", 3, corners, sizeof corners);
    add_data(b, FLOAT, "VEC3", 3, up, sizeof up);
    add_data(b, FLOAT, "VEC3", 3, tilt, sizeof tilt);
    add_data(b, FLOAT, "VEC3", 3, normal, sizeof normal);
    snprintf(more, sizeof more, ",\"normalized\":true,\"bufferView\":%d", add_view(b, times, sizeof times, 0));
    add_accessor(b, UBYTE, "SCALAR", 2, more);
    snprintf(more, sizeof more, ",\"normalized\":true,\"bufferView\":%d", add_view(b, weights, sizeof weights, 0));
    add_accessor(b, SHORT, "SCALAR", 4, more);
    read_built(
        b,
        "\"meshes\":[{\"weights\":[0.5,0],\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":3},\"targets\":["
        "{"
        "\"POSITION\":1},{\"POSITION\":1,\"NORMAL\":2}]}]}],\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"weights\":[0,1],"
        "\"translation\":[10,0,0]}],\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,\"path\":"
        "\"weights\"}}],\"samplers\":[{\"input\":4,\"output\":5}]}]");
    float positions[3][3], normals[3][3];
    assert_true(gltf_pose_create(&b->gltf, &pose));
    assert_int_equal(b->gltf.weight_count, 4);
    gltf_pose_vertices(&b->gltf, &pose, 0, positions, normals);
    assert_numbers(positions[2], (const double[]){0, 1, 1.5}, 3);
    gltf_pose_vertices(&b->gltf, &pose, 1, positions, normals);
    assert_numbers(positions[2], (const double[]){10, 1, 3}, 3);
    assert_numbers(normals[0], (const double[]){1, 0, 0}, 3);
    gltf_pose_clip(&b->gltf, 0, 0.25, &pose);
    assert_numbers(pose.weights, (const double[]){0.5, 0, 0.25, 0.5}, 4);
    gltf_pose_vertices(&b->gltf, &pose, 1, positions, NULL);
    assert_numbers(positions[1], (const double[]){11, 0, 1.5}, 3);
    gltf_pose_free(&pose);
}

// --- a tail of eight bones ----------------------------------------------------------------------------------------------

enum { BONES = 8 };

static void product(const double a[4], const double b[4], double out[4])
{
    out[0] = a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1];
    out[1] = a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0];
    out[2] = a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3];
    out[3] = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
}

/// q v q*
static void turn(const double q[4], const double v[3], double out[3])
{
    const double p[4] = {v[0], v[1], v[2], 0}, back[4] = {-q[0], -q[1], -q[2], q[3]};
    double qp[4], whole[4];
    product(q, p, qp);
    product(qp, back, whole);
    for (int k = 0; k < 3; k++) out[k] = whole[k];
}

/// Bone n of a straight tail along z, a unit long each, is rolled by n radians about its own direction.
static void rolled(int bone, double q[4])
{
    q[0] = q[1] = 0;
    q[2] = sin(bone / 2.0);
    q[3] = cos(bone / 2.0);
}

/// The inverse bind matrix of a bone: turns back about z and moves by −n.
static void bind(int bone, float m[16])
{
    double q[4];
    rolled(-bone, q);
    memset(m, 0, 16 * sizeof *m);
    for (int column = 0; column < 3; column++) {
        const double unit[3] = {column == 0, column == 1, column == 2};
        double x[3];
        turn(q, unit, x);
        for (int k = 0; k < 3; k++) m[4 * column + k] = (float)x[k];
    }
    m[14] = (float)-bone;
    m[15] = 1;
}

/// The JSON of the tail's nodes and clip, whose key of bone n is accessor n + 1: parent⁻¹ · turn about y · own.
static const char *tail_json(struct builder *b, const double about[4])
{
    static char members[8192];
    char *nodes = members, channels[2048] = "", samplers[1024] = "", view[64];
    nodes += sprintf(nodes, "\"nodes\":[{\"mesh\":0,\"skin\":0,\"translation\":[3,3,3]}");
    for (int n = 0; n < BONES; n++) {
        double world[4], back[4], local[4], turned[4], both[4];
        float key[4];
        rolled(n, world);
        rolled(n > 0 ? 1 - n : 0, back);
        product(back, world, local);
        product(about, world, turned);
        product(back, turned, both);
        for (int k = 0; k < 4; k++) key[k] = (float)both[k];
        nodes += sprintf(nodes, ",{\"rotation\":[%.17g,%.17g,%.17g,%.17g],\"translation\":[0,0,%d]", local[0],
                         local[1], local[2], local[3], n > 0);
        nodes += n < BONES - 1 ? sprintf(nodes, ",\"children\":[%d]}", n + 2) : sprintf(nodes, "}],");
        snprintf(view, sizeof view, ",\"bufferView\":%d", add_view(b, key, sizeof key, 0));
        add_accessor(b, FLOAT, "VEC4", 1, view);
        sprintf(channels + strlen(channels), "%s{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"rotation\"}}",
                n ? "," : "", n, n + 1);
        sprintf(samplers + strlen(samplers), "%s{\"input\":0,\"output\":%d}", n ? "," : "", n + 1);
    }
    sprintf(
        nodes,
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":9,\"NORMAL\":9,\"JOINTS_0\":10,\"WEIGHTS_0\":11}}"
        "]}],"
        "\"skins\":[{\"joints\":[1,2,3,4,5,6,7,8],\"inverseBindMatrices\":12}],\"animations\":[{\"channels\":[%s],"
        "\"samplers\":[%s]}]",
        channels, samplers);
    return members;
}

static void read_tail(double angle, struct gltf *gltf)
{
    const double about[4] = {0, sin(angle / 2), 0, cos(angle / 2)};
    const float time = 0;
    float ends[BONES][3] = {{0}}, inverse[BONES][16], weights[BONES][4] = {{0}};
    uint8_t joints[BONES][4] = {{0}};
    struct builder b = {0};
    add_data(&b, FLOAT, "SCALAR", 1, &time, sizeof time);
    const char *members = tail_json(&b, about);
    for (int n = 0; n < BONES; n++) {
        ends[n][2] = (float)(n + 1);
        joints[n][2] = (uint8_t)n;
        weights[n][2] = 0.5f;
        bind(n, inverse[n]);
    }
    assert_int_equal(add_data(&b, FLOAT, "VEC3", BONES, ends, sizeof ends), 9);
    add_data(&b, UBYTE, "VEC4", BONES, joints, sizeof joints);
    add_data(&b, FLOAT, "VEC4", BONES, weights, sizeof weights);
    add_data(&b, FLOAT, "MAT4", BONES, inverse, sizeof inverse);
    read_text(builder_json(&b, members), gltf);
}

/// Every bone turns by the same angle about the world's y, which each sees another way because of its roll. Bone n carries the vertex at
/// its own end: all lie on a circle's chords, in the plane y = 0.
TEST(a_tail_with_rolls)
{
    const double angle = 0.2;
    struct gltf gltf;
    struct gltf_pose pose;
    float moved[BONES][3], normals[BONES][3], matrix[16];
    read_tail(angle, &gltf);
    assert_true(gltf_pose_create(&gltf, &pose));
    gltf_pose_vertices(&gltf, &pose, 0, moved, normals);
    for (int n = 0; n < BONES; n++) assert_numbers(moved[n], (const double[]){0, 0, n + 1}, 3); // not where node 0 is
    gltf_pose_clip(&gltf, 0, 0, &pose);
    gltf_pose_world(&gltf, &pose);
    gltf_pose_vertices(&gltf, &pose, 0, moved, normals);
    double end[2] = {0, 0};
    for (int n = 0; n < BONES; n++) {
        const double turned = (n + 1) * angle;
        end[0] += sin(turned);
        end[1] += cos(turned);
        assert_numbers(moved[n], (const double[]){end[0], 0, end[1]}, 3);
        assert_numbers(normals[n], (const double[]){sin(turned), 0, cos(turned)}, 3);
        gltf_joint_matrix(&gltf, &pose, 0, n, matrix);
        assert_memory_equal(matrix, pose.joints[n], sizeof matrix);
    }
    gltf_pose_free(&pose);
    gltf_free(&gltf);
}

/// A mirrored and stretched node: normals stay across the surface.
GLTF_TEST(normals_of_a_stretched_node)
{
    const float corners[3][3] = {{0, 0, 0}, {1, 0, 1}, {0, 1, 0}},
                normal[3][3] = {{-1, 0, 1}, {-1, 0, 1}, {-1, 0, 1}};
    struct gltf_pose pose;
    add_data(b, FLOAT, "VEC3", 3, corners, sizeof corners);
    add_data(b, FLOAT, "VEC3", 3, normal, sizeof normal);
    read_built(b, "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1}}]}],\"nodes\":[{"
                  "\"mesh\":0,\"scale\":[-"
                  "3,1,1]}]");
    assert_true(gltf_pose_create(&b->gltf, &pose));
    float p[3][3], n[3][3];
    gltf_pose_vertices(&b->gltf, &pose, 0, p, n);
    for (int i = 1; i < 3; i++) assert_near(n[0][0] * p[i][0] + n[0][1] * p[i][1] + n[0][2] * p[i][2], 0, 1e-6);
    assert_near(n[0][2], 3 / sqrt(10), 1e-6); // at rest it looks to +z, and so it does stretched
    gltf_pose_free(&pose);
}
