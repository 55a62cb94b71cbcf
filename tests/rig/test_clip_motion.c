/// What joints do in clips, as equilibria follow it: against the clip itself, without its corners, again and again.
#include "near.h"
#include "rig/import.h"
#include "rig/posing.h"

enum { SUBSTEPS = 4, CYCLES = 3 };

struct scene {
    struct document *document;
    struct models *models;
    double *samples;
    int count;
};

static struct scene open_scene(void)
{
    struct error error;
    struct scene scene = {import_scene("assets/models/dog.glb", &error), models_create(), NULL, 0};
    assert_non_null(scene.document);
    scene.document->substeps = SUBSTEPS;
    scene.document->last_frame *= CYCLES;
    assert_true(models_update(scene.models, scene.document, &error));
    scene.count = document_samples(scene.document);
    scene.samples = calloc((size_t)scene.count, sizeof *scene.samples);
    return scene;
}

static void close_scene(struct scene *scene)
{
    free(scene->samples);
    models_destroy(scene->models);
    document_destroy(scene->document);
}

static char dog_name[] = "dog", hips[] = "hips", head[] = "head";

static void read_motion(struct scene *scene, char *joint, enum motion_of of)
{
    const struct model_source source = models_source(scene->models);
    const struct joint_motion motion = {.model = dog_name, .joint = joint, .of = of};
    assert_true(source.follow(source.context, scene->document, &motion, scene->samples));
}

/// Height of the hips in the clip at a sample, metres.
static double height_at(const struct scene *scene, int sample)
{
    const struct imported *imported = models_imported(scene->models, scene->document, 0);
    struct gltf_pose *pose = models_pose(scene->models, scene->document, 0, POSE_UNSEEN);
    const double time = fmod(sample * document_step(scene->document), imported->gltf.clips[0].last);
    gltf_pose_clip(&imported->gltf, 0, time, pose);
    gltf_pose_world(&imported->gltf, pose);
    return (double)pose->world[gltf_find_node(&imported->gltf, hips)][13];
}

#define SCENE_TEST(name) TEST_OF(struct scene, scene, *scene = open_scene(), close_scene(scene), name)

SCENE_TEST(test_up_is_the_joints_height_less_its_mean)
{
    double mean = 0, most = 0;
    read_motion(scene, hips, MOTION_UP);
    const int cycle = (scene->count - 1) / CYCLES;
    for (int s = 0; s < cycle; s++) mean += height_at(scene, s) / cycle;
    for (int s = 0; s < scene->count; s++) {
        assert_near(scene->samples[s], height_at(scene, s) - mean, 2e-3);
        most = fmax(most, fabs(scene->samples[s]));
    }
    assert_true(most > 0.005);
}

/// A clip that no number of samples fits goes on in its own time, round after round.
SCENE_TEST(test_a_clip_between_samples_does_not_drift)
{
    double mean = 0;
    scene->document->fps = 23.375; // a round of one second is 93.5 samples
    scene->document->last_frame = 30 * 24;
    free(scene->samples);
    scene->count = document_samples(scene->document);
    scene->samples = calloc((size_t)scene->count, sizeof *scene->samples);
    read_motion(scene, hips, MOTION_UP);
    for (int s = 0; s < 187; s++) mean += height_at(scene, s) / 187;
    for (int s = 0; s < scene->count; s++) assert_near(scene->samples[s], height_at(scene, s) - mean, 2e-3);
}

SCENE_TEST(test_every_cycle_is_the_same)
{
    read_motion(scene, head, MOTION_ACROSS);
    const int cycle = (scene->count - 1) / CYCLES;
    for (int s = cycle; s < scene->count; s++) assert_near(scene->samples[s], scene->samples[s - cycle], 0);
}

/// Straight lines from key to key would bend at every fourth sample only; a spline's second differences do not jump.
SCENE_TEST(test_corners_are_rounded)
{
    double largest = 0, jump = 0, before = 0;
    read_motion(scene, hips, MOTION_ACROSS);
    for (int s = 1; s + 1 < scene->count; s++) {
        const double bend = scene->samples[s - 1] - 2 * scene->samples[s] + scene->samples[s + 1];
        if (s > 1) jump = fmax(jump, fabs(bend - before));
        largest = fmax(largest, fabs(bend));
        before = bend;
    }
    assert_true(largest > 0);
    assert_true(jump < 0.5 * largest);
}

SCENE_TEST(test_turn_is_in_degrees)
{
    double most = 0;
    read_motion(scene, hips, MOTION_TURN);
    for (int s = 0; s < scene->count; s++) most = fmax(most, fabs(scene->samples[s]));
    assert_true(most > 0.5 && most < 45);
}

SCENE_TEST(test_what_is_not_there)
{
    static char nobody[] = "nobody";
    const struct model_source source = models_source(scene->models);
    const struct joint_motion no_joint = {.model = dog_name, .joint = nobody},
                              no_model = {.model = nobody, .joint = hips};
    assert_false(source.follow(source.context, scene->document, &no_joint, scene->samples));
    assert_false(source.follow(source.context, scene->document, &no_model, scene->samples));
}
