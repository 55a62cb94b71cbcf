/// Finds where a posed tail and its animal keep the lamp from the ground.
#include "model/fox.h"
#include "model/vector.h"
#include <math.h>

/// Below this a blob changes no pixel.
#define STRENGTH_SEEN 0.02f

/// Samples along the tail, and the height at which its shadow has faded to 1/e (bind size, metres).
enum { TAIL_BLOBS = 11 };
#define FADE_HEIGHT 0.45f
#define BODY_FADE_HEIGHT 0.35f /* the same of a body that hops */

/// What the animal keeps the light from, bind space, and at which height: rump, chest, and where each hind foot and fore paw touches the
/// ground; then chest, neck and head.
static const struct {
    struct shadow_blob blob;
    float height;
} body_blobs[] = {
    {{0.0f, -0.27f, 0.44f, 0.60f}, 0.0f},     {{0.0f, -0.48f, 0.27f, 0.36f}, 0.0f},
    {{0.195f, -0.43f, 0.13f, 0.50f}, 0.0f},   {{-0.195f, -0.43f, 0.13f, 0.50f}, 0.0f},
    {{0.065f, -0.555f, 0.085f, 0.75f}, 0.0f}, {{-0.065f, -0.555f, 0.085f, 0.75f}, 0.0f},
    {{0.0f, -0.38f, 0.29f, 0.34f}, 0.42f},    {{0.0f, -0.40f, 0.25f, 0.24f}, 0.62f},
    {{0.01f, -0.40f, 0.29f, 0.30f}, 0.80f},
};

/// How far the lamp's light goes sideways for each metre down.
static vec2s slope_of(const float from[3])
{
    const float down = fmaxf(from[1], 0.3f); // a low lamp throws no endless shadow
    return (vec2s){{-from[0] / down, -from[2] / down}};
}

/// A blob under the tail at `along` (0 base … 1 tip): the higher, the wider and the weaker.
static struct shadow_blob tail_blob(const struct pose *pose, vec2s slope, float along, float scale, float ground)
{
    const float at = along * (float)(pose->count - 1);
    const int n = (int)fminf(at, (float)(pose->count - 2));
    const float part = at - (float)n;
    const vec3s p = glms_vec3_lerp(vec3_from(pose->matrix[n] + 12), vec3_from(pose->matrix[n + 1] + 12), part);
    const float radius = scale * fox_tail_radius(along * FOX_TAIL_LENGTH);
    const float above = fmaxf(p.y - radius - ground, 0.0f), height = above / (scale * FADE_HEIGHT);
    return (struct shadow_blob){p.x + slope.x * above, p.z + slope.y * above,
                                1.6f * radius + 0.12f * scale * (1.0f + height), 0.45f * expf(-height)};
}

int pose_blobs(const struct pose *pose, const float from[3], struct shadow_blob *blobs, int capacity)
{
    const float scale = pose->scale, ground = pose->ground;
    const float above = fmaxf(pose->matrix[0][13] - ground - scale * FOX_BASE_HEIGHT, 0.0f);
    const int body_count = (int)(sizeof body_blobs / sizeof *body_blobs);
    const vec2s slope = slope_of(from);
    int count = 0;
    for (int b = 0; b < body_count && count < capacity; b++) {
        const struct shadow_blob *blob = &body_blobs[b].blob;
        const float fade = expf(-above / (scale * BODY_FADE_HEIGHT)), height = scale * body_blobs[b].height + above;
        blobs[count++] = (struct shadow_blob){pose->matrix[0][12] + scale * blob->x + slope.x * height,
                                              pose->matrix[0][14] + scale * blob->z + slope.y * height,
                                              scale * blob->radius * (1.5f - 0.5f * fade), blob->strength * fade};
    }
    for (int b = 0; b < TAIL_BLOBS && count < capacity; b++) {
        const struct shadow_blob blob = tail_blob(pose, slope, ((float)b + 0.5f) / TAIL_BLOBS, scale, ground);
        if (blob.strength > STRENGTH_SEEN) blobs[count++] = blob;
    }
    return count;
}
