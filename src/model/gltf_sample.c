/// Clips at a time.
///
/// Between the keys k and k + 1 with s = (t − t_k) / T, T = t_{k+1} − t_k, a channel is v_k (step), (1 − s) v_k + s v_{k+1} (linear; a
/// rotation goes along the great circle, the short way) or, with the tangents b_k out of and a_k into a key,
///     (2s³ − 3s² + 1) v_k + T (s³ − 2s² + s) b_k + (3s² − 2s³) v_{k+1} + T (s³ − s²) a_{k+1}.
#include "model/gltf.h"
#include <math.h>
#include <string.h>

/// The last key at or before a time; the first where there is none.
static int key_at(const struct gltf_channel *channel, double time)
{
    int low = 0, high = channel->key_count;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if ((double)channel->times[middle] <= time) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static void normalise(float q[4])
{
    float length = sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; k++) q[k] = length > 0 ? q[k] / length : (float)(k == 3);
}

/// From a to b, or to −b where that is nearer: both are the same rotation. cglm's own goes through zero where b is nearly −a.
static void slerp(const float a[4], const float b[4], float s, float out[4])
{
    float cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    float sign = cosine < 0 ? -1.0f : 1.0f, from = 1 - s, to = s;
    if (cosine * sign < 0.9999f) {
        float angle = acosf(cosine * sign);
        from = sinf(from * angle) / sinf(angle);
        to = sinf(to * angle) / sinf(angle);
    }
    for (int k = 0; k < 4; k++) out[k] = from * a[k] + to * sign * b[k];
}

static void cubic(const float *key, int components, float s, float T, float *out)
{
    const float *value = key + components, *leaving = key + 2 * components, *arriving = key + 3 * components;
    const float *next = key + 4 * components;
    float s2 = s * s, s3 = s2 * s;
    for (int k = 0; k < components; k++)
        out[k] = (2 * s3 - 3 * s2 + 1) * value[k] + T * (s3 - 2 * s2 + s) * leaving[k] + (3 * s2 - 2 * s3) * next[k] +
                 T * (s3 - s2) * arriving[k];
}

void gltf_channel_at(const struct gltf_channel *channel, double time, float *out)
{
    int key = key_at(channel, time), n = channel->components;
    bool is_cubic = channel->interpolation == GLTF_CUBIC;
    size_t stride = (size_t)(is_cubic ? 3 * n : n);
    const float *at = channel->values + (size_t)key * stride;
    double from = (double)channel->times[key];
    bool held = key + 1 == channel->key_count || time <= from || channel->interpolation == GLTF_STEP;
    double T = held ? 1 : (double)channel->times[key + 1] - from;
    float s = (float)((time - from) / T);
    if (held) {
        memcpy(out, is_cubic ? at + n : at, (size_t)n * sizeof *out);
    } else if (is_cubic) {
        cubic(at, n, s, (float)T, out);
    } else if (channel->path == GLTF_ROTATION) {
        slerp(at, at + n, s, out);
    } else {
        for (int k = 0; k < n; k++) out[k] = (1 - s) * at[k] + s * at[n + k];
    }
    if (channel->path == GLTF_ROTATION) normalise(out);
}

void gltf_pose_clip(const struct gltf *gltf, int clip, double time, struct gltf_pose *pose)
{
    for (int n = 0; n < gltf->node_count; n++) pose->place[n] = gltf->nodes[n].place;
    for (int w = 0; w < gltf->weight_count; w++) pose->weights[w] = gltf->weights[w];
    for (int i = 0; clip >= 0 && i < gltf->clips[clip].channel_count; i++) {
        const struct gltf_channel *channel = &gltf->clips[clip].channels[i];
        struct gltf_place *place = &pose->place[channel->node];
        float *const out[] = {place->translation, place->rotation, place->scale,
                              pose->weights + gltf->nodes[channel->node].first_weight};
        gltf_channel_at(channel, time, out[channel->path]);
    }
}
