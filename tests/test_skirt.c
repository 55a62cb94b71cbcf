/// Skirts of models of several nodes: each mesh stands in its own place, and faces the eye or not by itself.
#include "draw/skirt.h"
#include "gltf_builder.h"

/// A square of one metre, seen from +z, for two nodes: one of them 5 m behind, its back to the eye.
static const char nodes[] =
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2}]}],"
    "\"nodes\":[{\"mesh\":0},{},{\"mesh\":0,\"translation\":[0,0,-5],\"rotation\":[0,1,0,0]}]";

static const float square[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

static int outline(const struct skirt_mesh *mesh)
{
    int count = 0;
    for (int at = skirt_next(mesh, 0, 6, false); at < 6; at = skirt_next(mesh, at + 1, 6, false)) count++;
    return count;
}

static void nodes_stand_for_themselves(void **state)
{
    (void)state;
    const float normals[4][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, eye[3] = {0, 0, 10};
    const float root[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 0, 0, 1};
    const uint8_t indices[] = {0, 1, 2, 0, 2, 3};
    struct builder b = {0};
    struct gltf gltf;
    struct gltf_pose pose;
    struct model_skirt skirt;
    add_data(&b, FLOAT, "VEC3", 4, square, sizeof square);
    add_data(&b, FLOAT, "VEC3", 4, normals, sizeof normals);
    add_data(&b, UBYTE, "SCALAR", 6, indices, sizeof indices);
    read_built(&b, nodes, &gltf);
    assert_true(gltf_pose_create(&gltf, &pose));
    gltf_pose_clip(&gltf, -1, 0, &pose);
    gltf_pose_world(&gltf, &pose);
    model_skirt_create(&skirt, &gltf);
    assert_non_null(skirt.indices);
    struct skirt_mesh mesh[3];
    for (int n = 2; n >= 0; n -= 2) mesh[n] = model_skirt_pose(&skirt, &gltf, &pose, n, root, eye);
    for (int v = 0; v < 4; v++) {
        assert_near(mesh[0].place[v][0], square[v][0] + 2, 1e-6);
        assert_near(mesh[0].place[v][1], square[v][1], 1e-6);
        assert_near(mesh[0].place[v][2], 0, 1e-6);
        assert_near(mesh[2].place[v][0], 2 - square[v][0], 1e-6); // turned half round
        assert_near(mesh[2].place[v][1], square[v][1], 1e-6);
        assert_near(mesh[2].place[v][2], -5, 1e-6);
    }
    assert_int_equal(outline(&mesh[0]), 4); // not where its triangles meet
    assert_int_equal(outline(&mesh[2]), 0);
    model_skirt_free(&skirt);
    gltf_pose_free(&pose);
    gltf_free(&gltf);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nodes_stand_for_themselves)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
