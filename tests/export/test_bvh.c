/// What .bvh files hold: every bone of a character, where the .glb of the same scene has it.
#include "export_scene.h"
#include "model/vector.h"

enum { MOST_JOINTS = 64, MOST_DEPTH = 40 };

struct bvh_joint {
    char name[64];
    int parent, channels;
    double offset[3];
};

struct bvh {
    struct bvh_joint joints[MOST_JOINTS];
    int count, frames;
    char *motion; ///< the text of its numbers, in `data`
    char *data;
};

static struct bvh read_bvh(const char *path)
{
    struct bvh bvh = {0};
    size_t size;
    int above[MOST_DEPTH] = {-1}, depth = 0, current = -1, used;
    char word[64], *at = bvh.data = bytes_of(path, &size);
    for (; sscanf(at, "%63s%n", word, &used) == 1 && strcmp(word, "MOTION") != 0;) {
        at += used;
        if (strcmp(word, "ROOT") == 0 || strcmp(word, "JOINT") == 0) {
            assert_true(bvh.count < MOST_JOINTS);
            current = bvh.count++;
            bvh.joints[current].parent = depth == 0 ? -1 : above[depth];
            assert_int_equal(sscanf(at, "%63s%n", bvh.joints[current].name, &used), 1);
            at += used;
        } else if (strcmp(word, "End") == 0) {
            current = -1;
        } else if (strcmp(word, "{") == 0) {
            assert_true(depth + 1 < MOST_DEPTH);
            above[++depth] = current;
        } else if (strcmp(word, "}") == 0) {
            depth--;
        } else if (strcmp(word, "OFFSET") == 0 && current >= 0) {
            double *o = bvh.joints[current].offset;
            assert_int_equal(sscanf(at, "%lf %lf %lf%n", &o[0], &o[1], &o[2], &used), 3);
            at += used;
        } else if (strcmp(word, "CHANNELS") == 0) {
            bvh.joints[current].channels = atoi(at);
        }
    }
    assert_int_equal(sscanf(at, " MOTION Frames: %d Frame Time: %*f%n", &bvh.frames, &used), 1);
    bvh.motion = at + used;
    return bvh;
}

/// Where all joints are at the next frame: y, x, z turn in this order, a place is one in the parent.
static void next_frame(struct bvh *bvh, mat4 world[MOST_JOINTS])
{
    for (int j = 0; j < bvh->count; j++) {
        const struct bvh_joint *joint = &bvh->joints[j];
        double number[6];
        vec3 place;
        for (int c = 0; c < joint->channels; c++) number[c] = strtod(bvh->motion, &bvh->motion);
        for (int k = 0; k < 3; k++) place[k] = (float)(joint->channels == 6 ? number[k] : joint->offset[k]);
        if (joint->parent < 0) {
            glm_mat4_identity(world[j]);
        } else {
            glm_mat4_copy(world[joint->parent], world[j]);
        }
        const double *turn = number + joint->channels - 3;
        glm_translate(world[j], place);
        glm_rotate_y(world[j], glm_rad((float)turn[0]), world[j]);
        glm_rotate_x(world[j], glm_rad((float)turn[1]), world[j]);
        glm_rotate_z(world[j], glm_rad((float)turn[2]), world[j]);
    }
}

/// The largest distance of a joint from the bone of the same name.
static double farthest(const struct bvh *bvh, mat4 world[MOST_JOINTS], const struct gltf *gltf,
                       const struct gltf_pose *pose)
{
    double off = 0;
    for (int j = 0; j < bvh->count; j++) {
        const int node = gltf_find_node(gltf, bvh->joints[j].name);
        assert_true(node >= 0);
        for (int k = 0; k < 3; k++) off = fmax(off, fabs((double)(world[j][3][k] - pose->world[node][12 + k])));
    }
    return off;
}

TEST_WITH(folder_make, folder_remove, every_bone_is_where_the_glb_has_it)
{
    for (int shown = 0; shown < 2; shown++) {
        struct opened scene = open_scene("assets/scenes/dog.json");
        struct gltf gltf;
        struct gltf_pose pose;
        mat4 world[MOST_JOINTS];
        scene.document->rigs[0]->model.scale = 0.3; // the test's own
        scene.document->rigs[0]->model.turn = 30;
        const struct export_options options = {.substeps = 1, .as_shown = shown};
        struct bvh bvh = read_bvh(export_opened(&scene, "dog.bvh", options));
        assert_done(gltf_read(export_opened(&scene, "dog.glb", options), &gltf, &error));
        assert_true(gltf_pose_create(&gltf, &pose));
        assert_int_equal(bvh.count, gltf.skins[0].joint_count);
        assert_int_equal(bvh.frames, 97);
        for (int f = 0; f < bvh.frames; f++) {
            gltf_pose_clip(&gltf, 0, f / 24.0, &pose);
            gltf_pose_world(&gltf, &pose);
            next_frame(&bvh, world);
            assert_near(farthest(&bvh, world, &gltf, &pose), 0, 2e-6);
        }
        gltf_pose_free(&pose);
        gltf_free(&gltf);
        free(bvh.data);
        close_scene(&scene);
    }
}

/// Without --as-shown the stage's size and place are in no file, with it in all; and both agree.
TEST_WITH(folder_make, folder_remove, a_character_keeps_the_size_and_place_of_its_file)
{
    for (int shown = 0; shown < 2; shown++) {
        struct opened scene = open_scene("assets/scenes/dog.json");
        const struct export_options options = {.substeps = 1, .has_frames = true, .last = 4, .as_shown = shown};
        size_t size;
        scene.document->rigs[0]->model.scale = 0.3;
        struct points points = read_points(export_opened(&scene, "dog.pc2", options));
        assert_near(glb_clip_is_off(export_opened(&scene, "dog.glb", options), "Walk", &points), 0, 2e-6);
        double top = 0;
        for (int v = 0; v < points.vertices; v++) top = fmax(top, frame_of(&points, 0)[3 * v + 1]);
        assert_true(shown ? top < 0.5 : top > 0.5);
        char *text = bytes_of(export_opened(&scene, "dog.usda", options), &size);
        assert_int_equal(strstr(text, "matrix4d xformOp:transform = ((0.3") != NULL, shown);
        free(text);
        free(points.number);
        close_scene(&scene);
    }
}
