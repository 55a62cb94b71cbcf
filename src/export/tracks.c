/// Collects what moves the nodes of an imported character.
#include "export/tracks.h"
#include "rig/bones.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int components_of(const struct gltf *gltf, int node, enum gltf_path path)
{
    if (path == GLTF_WEIGHTS)
        return gltf->nodes[node].mesh < 0 ? 0 : gltf->meshes[gltf->nodes[node].mesh].target_count;
    return path == GLTF_ROTATION ? 4 : 3;
}

static bool add(const struct take *take, struct tracks *tracks, const struct gltf *gltf, int node,
                enum gltf_path path)
{
    const int components = components_of(gltf, node, path);
    for (int t = 0; t < tracks->count; t++) {
        if (tracks->list[t].node == node && tracks->list[t].path == path) return true;
    }
    struct track *larger = realloc(tracks->list, ((size_t)tracks->count + 1) * sizeof *larger);
    if (!larger) return false;
    tracks->list = larger;
    struct track *track = &larger[tracks->count];
    *track = (struct track){node, path, components, NULL};
    track->values = malloc(((size_t)take->key_count * (size_t)components + 1) * sizeof(float));
    tracks->count += track->values != NULL;
    return track->values != NULL;
}

/// Whether the keys begin where the clip does and end where it ends.
static bool spans_clip(const struct take *take, const struct gltf *gltf, int clip)
{
    const double fps = take->posing->document->fps, last = take_seconds(take, take->key_count - 1);
    if (clip < 0) return true;
    const double begin = fmod(take->first / fps, fmax(gltf->clips[clip].duration, 1e-9));
    return fabs(begin) < 1e-4 && fabs(last - gltf->clips[clip].duration) < 1e-4;
}

static bool add_all(const struct take *take, int rig, const struct gltf *gltf, struct tracks *tracks)
{
    const struct document *document = take->posing->document;
    const char *playing = document->rigs[rig].model.clip;
    const int clip = playing ? gltf_find_clip(gltf, playing) : -1;
    tracks->keeps_clip = spans_clip(take, gltf, clip);
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *chain = &document->rigs[r];
        struct chain_bones bones;
        if (chain->kind != RIG_CHAIN) continue;
        if (document_find_model(document, chain->chain.model, chain->chain.by_file) != rig) continue;
        if (!chain_find(gltf, chain->chain.from, chain->chain.to, &bones, NULL)) continue;
        tracks->has_chains = true;
        for (int n = 0; n < bones.count; n++) {
            if (!add(take, tracks, gltf, bones.node[n], GLTF_ROTATION)) return false;
        }
    }
    for (int c = 0; clip >= 0 && !tracks->keeps_clip && c < gltf->clips[clip].channel_count; c++) {
        const struct gltf_channel *channel = &gltf->clips[clip].channels[c];
        if (!gltf->nodes[channel->node].has_matrix && !add(take, tracks, gltf, channel->node, channel->path))
            return false;
    }
    return true;
}

static const float *value_of(const struct gltf *gltf, const struct gltf_pose *pose, const struct track *track)
{
    const struct gltf_place *place = &pose->place[track->node];
    switch (track->path) {
    case GLTF_TRANSLATION:
        return place->translation;
    case GLTF_ROTATION:
        return place->rotation;
    case GLTF_SCALE:
        return place->scale;
    default:
        return pose->weights + gltf->nodes[track->node].first_weight;
    }
}

static void copy_key(const struct gltf *gltf, const struct gltf_pose *pose, const struct track *track, int key)
{
    float *row = track->values + key * track->components;
    memcpy(row, value_of(gltf, pose, track), (size_t)track->components * sizeof *row);
    if (track->path != GLTF_ROTATION || key == 0) return;
    const float *before = row - 4;
    if (before[0] * row[0] + before[1] * row[1] + before[2] * row[2] + before[3] * row[3] >= 0) return;
    for (int k = 0; k < 4; k++) row[k] = -row[k];
}

static bool collect(struct take *take, int rig, struct tracks *tracks, struct error *error)
{
    struct rig_pose pose;
    if (!take_pose(take, rig, 0, &pose, error)) return false;
    const struct gltf *gltf = &pose.model.imported->gltf;
    if (!add_all(take, rig, gltf, tracks)) return fail_no_memory(error, gltf->path);
    take->total = take->key_count;
    for (int k = 0; k < take->key_count; k++) {
        if (!take_pose(take, rig, k, &pose, error)) return false;
        for (int t = 0; t < tracks->count; t++) copy_key(gltf, pose.model.pose, &tracks->list[t], k);
        if (!take_proceed(take, error)) return false;
    }
    return true;
}

bool tracks_collect(struct take *take, int rig, struct tracks *tracks, struct error *error)
{
    *tracks = (struct tracks){0};
    if (collect(take, rig, tracks, error)) return true;
    tracks_free(tracks);
    return false;
}

void tracks_free(struct tracks *tracks)
{
    for (int t = 0; t < tracks->count; t++) free(tracks->list[t].values);
    free(tracks->list);
    *tracks = (struct tracks){0};
}
