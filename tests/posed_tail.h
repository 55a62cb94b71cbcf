/// A tail without a scene, posed by its channels' values; with its fox if there are models.
#ifndef TESTS_POSED_TAIL_H
#define TESTS_POSED_TAIL_H

#include "near.h"

#include "rig/posing.h"

static inline void pose_tail_in(struct models *models, const struct tail *tail, const wiggly_value *values,
                                enum look look, struct pose *pose, struct rig_pose *fox)
{
    static struct rig rig;
    static struct rig_pose posed;
    struct rig *rigs[] = {&rig};
    struct document document = {.rigs = rigs, .rig_count = 1};
    struct by_hand hand = {0};
    const struct posing posing = {.document = &document, .models = models, .look = look, .by_hand = &hand};
    rig.kind = RIG_TAIL;
    rig.tail = *tail;
    if (values) memcpy(hand.input, values, (size_t)tail->channel_count * sizeof *values);
    if (models) models_follow(models, &document);
    assert_true(rig_pose(&posing, 0, 0, &posed));
    *pose = posed.strand;
    if (fox) assert_true(rig_pose_body(&posing, 0, 0, fox));
}

static inline void pose_tail(const struct tail *tail, const wiggly_value *values, enum look look, struct pose *pose)
{
    pose_tail_in(NULL, tail, values, look, pose, NULL);
}

/// All vertex positions of a posed fox, `count` of them. The caller frees them.
static inline float (*fox_places(const struct rig_pose *fox, int *count))[3]
{
    const struct gltf *gltf = &fox->imported->gltf;
    const float *root = fox->model.root;
    *count = gltf_vertex_count(gltf, gltf->node_count - 1);
    float(*place)[3] = calloc((size_t)*count, sizeof *place);
    assert_non_null(place);
    gltf_pose_vertices(gltf, fox->model.pose, gltf->node_count - 1, place, NULL);
    for (int v = 0; v < *count; v++)
        for (int k = 0; k < 3; k++) place[v][k] = root[0] * place[v][k] + root[12 + k];
    return place;
}

#endif
