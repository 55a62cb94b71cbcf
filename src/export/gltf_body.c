/// Samples what an imported character's own clip moves.
#include "export/gltf_body.h"
#include "export/keys.h"
#include <stdlib.h>
#include <string.h>

static const float *values_of(const struct gltf *gltf, const struct gltf_pose *pose,
                              const struct gltf_channel *channel)
{
    const struct gltf_place *place = &pose->place[channel->node];
    switch (channel->path) {
    case GLTF_TRANSLATION:
        return place->translation;
    case GLTF_ROTATION:
        return place->rotation;
    case GLTF_SCALE:
        return place->scale;
    case GLTF_WEIGHTS:
        break;
    }
    return pose->weights + gltf->nodes[channel->node].first_weight;
}

/// One track after the other in each row.
static bool collect(const struct gltf_body *body, struct shot *shot, float *rows, int width, struct error *error)
{
    for (int k = 0; k < shot->key_count; k++) {
        struct rig_pose pose;
        float *at = rows + (size_t)k * (size_t)width;
        if (!shot_pose(shot, shot->rigs[0], k, &pose, error) || !shot_proceed(shot, error)) return false;
        for (int c = 0; c < body->clip->channel_count; c++) {
            const struct gltf_channel *channel = &body->clip->channels[c];
            memcpy(at, values_of(body->gltf, pose.model.pose, channel), (size_t)channel->components * sizeof *at);
            if (channel->path == GLTF_ROTATION && k > 0) keys_turn_short_way(at - width, at);
            at += channel->components;
        }
    }
    keys_close_loop(rows, width, shot->key_count);
    return true;
}

/// The tracks, each in an array of its own.
static bool add_tracks(const struct gltf_body *body, const float *rows, int width, struct gltf_motion *motion)
{
    const size_t keys = (size_t)motion->key_count;
    for (int c = 0; c < body->clip->channel_count; c++) {
        const struct gltf_channel *channel = &body->clip->channels[c];
        const size_t size = (size_t)channel->components;
        const float *from = rows;
        rows += size;
        if (gltf_body_leaves_out(body, channel)) continue;
        float *track = malloc(keys * size * sizeof *track);
        if (!track) return false;
        for (size_t k = 0; k < keys; k++) memcpy(track + k * size, from + k * (size_t)width, size * sizeof *track);
        gltf_motion_add(motion, channel->node, channel->path, track, NULL, channel->components);
        free(track);
    }
    return true;
}

bool gltf_body_leaves_out(const struct gltf_body *body, const struct gltf_channel *channel)
{
    return channel->path == GLTF_ROTATION && body->is_bone[channel->node];
}

bool gltf_body_sample(const struct gltf_body *body, struct shot *shot, struct gltf_motion *motion,
                      struct error *error)
{
    int width = 0;
    for (int c = 0; c < body->clip->channel_count; c++) width += body->clip->channels[c].components;
    float *rows = malloc(((size_t)shot->key_count * (size_t)width + 1) * sizeof *rows);
    if (!rows) return fail_no_memory(error, body->gltf->path);
    const bool done = collect(body, shot, rows, width, error) &&
                      (add_tracks(body, rows, width, motion) || fail_no_memory(error, body->gltf->path));
    free(rows);
    return done;
}
