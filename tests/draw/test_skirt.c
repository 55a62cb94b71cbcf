/// Skirts of models of several nodes: each mesh stands in its own place, and faces the eye or not by itself.
#include "draw/posed.h"
#include "gltf_builder.h"

/// A square of one metre, seen from +z, for two nodes: one of them 5 m behind, its back to the eye.
static const char nodes[] = "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1},'indices':2}]}],'nodes'"
                            ":[{'mesh':0},{},{'mesh':0,'translation':[0,0,-5],'rotation':[0,1,0,0]}]";

static const float square[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

/// Edges of a part's outline.
static int outline(const struct posed *mesh, const struct posed_part *part)
{
    int count = 0;
    for (int at = part->first - 1; (at = skirt_next(mesh, part, at + 1)) < part->end;) count++;
    return count;
}

TEST(nodes_stand_for_themselves)
{
    const float normals[4][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, eye[3] = {0, 0, 10};
    const uint8_t indices[] = {0, 1, 2, 0, 2, 3};
    struct builder b = {0};
    struct gltf gltf;
    struct gltf_pose pose;
    struct posed mesh;
    add_data(&b, FLOAT, "VEC3", 4, square, sizeof square);
    add_data(&b, FLOAT, "VEC3", 4, normals, sizeof normals);
    add_data(&b, UBYTE, "SCALAR", 6, indices, sizeof indices);
    read_text(builder_json(&b, nodes), &gltf);
    assert_true(gltf_pose_create(&gltf, &pose));
    gltf_pose_clip(&gltf, -1, 0, &pose);
    gltf_pose_world(&gltf, &pose);
    const struct stage_model shown = {
        .gltf = &gltf, .pose = &pose, .root = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 0, 0, 1}};
    posed_from_gltf(&mesh, &gltf);
    assert_int_equal(mesh.part_count, 2);
    posed_pose_gltf(&mesh, &shown, eye);
    const float(*front)[3] = (const float(*)[3])mesh.place + mesh.parts[0].vertex;
    const float(*behind)[3] = (const float(*)[3])mesh.place + mesh.parts[1].vertex;
    for (int v = 0; v < 4; v++) {
        assert_near(front[v][0], square[v][0] + 2, 1e-6);
        assert_near(front[v][1], square[v][1], 1e-6);
        assert_near(front[v][2], 0, 1e-6);
        assert_near(behind[v][0], 2 - square[v][0], 1e-6); // turned half round
        assert_near(behind[v][1], square[v][1], 1e-6);
        assert_near(behind[v][2], -5, 1e-6);
    }
    assert_int_equal(outline(&mesh, &mesh.parts[0]), 4); // not where its triangles meet
    assert_int_equal(outline(&mesh, &mesh.parts[1]), 0);
    posed_free(&mesh);
    gltf_pose_free(&pose);
    gltf_free(&gltf);
}
