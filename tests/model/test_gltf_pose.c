/// Poses of glTF characters: every interpolation against numbers made by hand, skins and morph targets against the textbook.
#include "gltf_facts.h"
#include "model/vector.h"

#define CHANNEL(node, path, sampler) "{'sampler':" sampler ",'target':{'node':" node ",'path':'" path "'}}"
#define CUBIC(output) "{'input':4,'output':" output ",'interpolation':'CUBICSPLINE'}"

/// Accessors: 0 three times, 1 places; 2 three times, 3 turns by 0°, 120° as −q, and as q; 4 two times, 5 cubic places, 6 cubic turns; 7 a
/// triangle, 8 and 9 moves of it, 10 normals, 11 times as normalised bytes, 12 weights as normalised shorts; 13 a slope, 14 its normals.
static void add_all(struct builder *b)
{
    ADD(b, FLOAT, float, 1, 1, 2, 4);
    ADD(b, FLOAT, float, 3, 0, 10, 4, 2, 20, 4, 6, 0, 8);
    ADD(b, FLOAT, float, 1, 0, 3, 4);
    ADD(b, FLOAT, float, 4, 0, 0, 0, 1, 0, 0, -0.8660254037844386f, -0.5f, 0, 0, 0.8660254037844386f, 0.5f);
    ADD(b, FLOAT, float, 1, 1, 3);
    ADD(b, FLOAT, float, 3, 9, 9, 9, 1, 2, 3, 4, 0, -8, 8, 16, 0, 5, 6, 7, 9, 9, 9);
    ADD(b, FLOAT, float, 4, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0);
    ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0);
    ADD(b, FLOAT, float, 3, 0, 0, 1, 0, 0, 2, 0, 0, 3);
    ADD(b, FLOAT, float, 3, 1, 0, -1, 1, 0, -1, 1, 0, -1);
    ADD(b, FLOAT, float, 3, 0, 0, 1, 0, 0, 1, 0, 0, 1);
    ADD_NORMALISED(b, UBYTE, uint8_t, 1, 0, 255);
    ADD_NORMALISED(b, SHORT, int16_t, 1, 0, 32767, 32767, -32767);
    ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 1, 0, 1, 0);
    assert_int_equal(ADD(b, FLOAT, float, 3, -1, 0, 1, -1, 0, 1, -1, 0, 1), 14);
}

static const struct gltf_row rows[] = {
    {"'nodes':[{'translation':[7,8,9]}],'animations':[{'samplers':[{'input':0,'output':1},{'input':0,'output':1,"
     "'interpolation':'STEP'}],'channels':[" CHANNEL("0", "translation", "0") "," CHANNEL("0", "scale", "1") "]}]",
     "last 4 at 3 translation 7 8 9 clip 0 at -5 translation 0 10 4 scale 0 10 4 at 1 translation 0 10 4 scale 0 10 "
     "4 "
     "at 1.25 translation 0.5 12.5 4 scale 0 10 4 at 2 translation 2 20 4 scale 2 20 4 at 3 translation 4 10 6 "
     "scale 2 20 4 at 3.875 translation 5.75 1.25 7.75 scale 2 20 4 at 4 translation 6 0 8 scale 6 0 8 "
     "at 1000000000 translation 6 0 8 scale 6 0 8",
     NULL},
    // the short way is a third of 120° at a third of the time; between keys of the same rotation with other signs nothing moves
    {"'nodes':[{}],'animations':[{'samplers':[{'input':2,'output':3,'interpolation':'LINEAR'}],"
     "'channels':[" CHANNEL("0", "rotation", "0") "]}]",
     "clip 0 at 1 rotation ~0 ~0 ~0.342020143326 ~0.939692620786 "
     "at 3.5 axes ~-0.5 ~0.866025403784 ~0 ~-0.866025403784 ~-0.5 ~0 ~0 ~0 ~1",
     NULL},
    // the spline of glTF's appendix at a quarter of two seconds: s = 1/4 has the weights 27/32, 9/64, 5/32 and −3/64
    {"'nodes':[{}],'animations':[{'samplers':[" CUBIC("5") "," CUBIC("6") "],'channels':[" CHANNEL(
         "0", "translation", "0") "," CHANNEL("0", "rotation", "1") "]}]",
     "clip 0 at 1.5 translation ~2 ~1.125 ~1.375 rotation ~0 ~0 ~0.331906211591 ~0.943312390837 "
     "at 9 translation 5 6 7 at 0 translation 1 2 3",
     NULL},
    // two nodes show one mesh: weights at rest are the mesh's and the second node's own, and a clip moves the second's
    {"'meshes':[{'weights':[0.5,0],'primitives':[{'attributes':{'POSITION':7,'NORMAL':10},'targets':[{'POSITION':8},{"
     "'POSITION':8,'NORMAL':9}]}]}],'nodes':[{'mesh':0},{'mesh':0,'weights':[0,1],'translation':[10,0,0]}],"
     "'animations':[{'samplers':[{'input':11,'output':12}],'channels':[" CHANNEL("1", "weights", "0") "]}]",
     "morphs 0.5 0 0 1 posed ~0 ~0 ~0.5 ~1 ~0 ~1 ~0 ~1 ~1.5 node 1 posed ~10 ~0 ~1 ~11 ~0 ~2 ~10 ~1 ~3 "
     "turned ~1 ~0 ~0 ~1 ~0 ~0 ~1 ~0 ~0 clip 0 at 0.25 morphs 0.5 0 ~0.25 ~0.5 "
     "posed ~10 ~0 ~0.75 ~11 ~0 ~1.5 ~10 ~1 ~2.25 at 0.75 morphs 0.5 0 ~0.75 ~-0.5 "
     "posed ~10 ~0 ~0.25 ~11 ~0 ~0.5 ~10 ~1 ~0.75",
     NULL},
    // mirrored and stretched: normals stay across the surface, and look to where they did
    {"'meshes':[{'primitives':[{'attributes':{'POSITION':13,'NORMAL':14}}]}],'nodes':[{'mesh':0,'scale':[-3,1,1]}]",
     "posed ~0 ~0 ~0 ~-3 ~0 ~1 ~0 ~1 ~0 turned ~0.316227766017 ~0 ~0.948683298051 ~0.316227766017 ~0 ~0.948683298051 "
     "~0.316227766017 ~0 ~0.948683298051",
     NULL},
};

TEST(poses_are_those_of_the_textbook)
{
    struct builder b = {0};
    add_all(&b);
    assert_rows(&b, rows, sizeof rows / sizeof *rows);
}

enum { BONES = 8 };

/// Bone n of a straight tail along z, a unit long each, is rolled by n radians about its own direction, and in the clip turned about the
/// world's y, which each sees another way. Accessor n + 1 is its key: parent⁻¹ · turn · own. It carries the vertex at its own end.
static void read_tail(float angle, struct gltf *gltf)
{
    char members[4096], *at = members, channels[1024] = "", samplers[512] = "";
    float ends[BONES][3] = {{0}}, inverse[BONES][16], weights[BONES][4] = {{0}};
    uint8_t joints[BONES][4] = {{0}};
    struct builder b = {0};
    versor about, own, back, turned;
    vec3 y = {0, 1, 0}, z = {0, 0, 1};
    glm_quatv(about, angle, y);
    ADD(&b, FLOAT, float, 1, 0);
    at += sprintf(at, "'nodes':[{'mesh':0,'skin':0,'translation':[3,3,3]}");
    for (int n = 0; n < BONES; n++) {
        mat4 bind = GLM_MAT4_IDENTITY_INIT;
        glm_quatv(own, (float)n, z);
        glm_quatv(back, n > 0 ? (float)(1 - n) : 0, z);
        glm_quat_mul(about, own, turned);
        glm_quat_mul(back, turned, turned);
        glm_quat_mul(back, own, own);
        add_data(&b, FLOAT, "VEC4", 1, turned, sizeof turned);
        at += sprintf(at, ",{'rotation':[%.9g,%.9g,%.9g,%.9g],'translation':[0,0,%d]", (double)own[0], (double)own[1],
                      (double)own[2], (double)own[3], n > 0);
        at += n < BONES - 1 ? sprintf(at, ",'children':[%d]}", n + 2) : sprintf(at, "}],");
        sprintf(channels + strlen(channels), "%s{'sampler':%d,'target':{'node':%d,'path':'rotation'}}", n ? "," : "",
                n, n + 1);
        sprintf(samplers + strlen(samplers), "%s{'input':0,'output':%d}", n ? "," : "", n + 1);
        glm_translate(bind, (vec3){0, 0, (float)n});
        glm_rotate(bind, (float)n, z);
        glm_mat4_inv(bind, bind);
        memcpy(inverse[n], bind, sizeof bind);
        ends[n][2] = (float)(n + 1);
        joints[n][2] = (uint8_t)n;
        weights[n][2] = 0.5f;
    }
    assert_int_equal(add_data(&b, FLOAT, "VEC3", BONES, ends, sizeof ends), 9);
    add_data(&b, UBYTE, "VEC4", BONES, joints, sizeof joints);
    add_data(&b, FLOAT, "VEC4", BONES, weights, sizeof weights);
    add_data(&b, FLOAT, "MAT4", BONES, inverse, sizeof inverse);
    sprintf(at,
            "'meshes':[{'primitives':[{'attributes':{'POSITION':9,'NORMAL':9,'JOINTS_0':10,'WEIGHTS_0':11}}]}],"
            "'skins':[{'joints':[1,2,3,4,5,6,7,8],'inverseBindMatrices':12}],'animations':[{'channels':[%s],"
            "'samplers':[%s]}]",
            channels, samplers);
    read_built(&b, members);
    *gltf = b.gltf;
}

/// The vertices lie on a circle's chords, in the plane y = 0.
TEST(a_tail_with_rolls)
{
    const double angle = 0.2;
    struct gltf gltf;
    struct gltf_pose pose;
    float moved[BONES][3], normals[BONES][3], matrix[16];
    read_tail((float)angle, &gltf);
    assert_true(gltf_pose_create(&gltf, &pose));
    gltf_pose_vertices(&gltf, &pose, 0, moved, normals);
    for (int i = 0; i < 3 * BONES; i++)
        assert_near(moved[i / 3][i % 3], i % 3 == 2 ? i / 3 + 1 : 0, 2e-6); // not where node 0 is
    gltf_pose_clip(&gltf, 0, 0, &pose);
    gltf_pose_world(&gltf, &pose);
    gltf_pose_vertices(&gltf, &pose, 0, moved, normals);
    double end[2] = {0, 0};
    for (int n = 0; n < BONES; n++) {
        const double turned = (n + 1) * angle;
        end[0] += sin(turned);
        end[1] += cos(turned);
        const double place[] = {end[0], 0, end[1]}, normal[] = {sin(turned), 0, cos(turned)};
        for (int k = 0; k < 3; k++) {
            assert_near(moved[n][k], place[k], 2e-6);
            assert_near(normals[n][k], normal[k], 2e-6);
        }
        gltf_joint_matrix(&gltf, &pose, 0, n, matrix);
        assert_memory_equal(matrix, pose.joints[n], sizeof matrix);
    }
    gltf_pose_free(&pose);
    gltf_free(&gltf);
}
