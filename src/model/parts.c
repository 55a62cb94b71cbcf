/// Distance and colour of shapes made of round cones.
#include "model/parts.h"
#include "model/coat.h"
#include "model/vector.h"
#include <math.h>

/// Distance to a round cone. Seen in the half plane through its axis (x along it, r from it), the ball that is
/// nearest to a point sits where the cone's surface normal, tilted by asin((radius_a − radius_b)/length), meets the
/// axis.
static float part_distance(const struct part *part, const float p[3])
{
    const vec3s from = vec3_from(part->a), axis = glms_vec3_sub(vec3_from(part->b), from);
    const vec3s q = glms_vec3_sub((vec3s){{part->mirror ? fabsf(p[0]) : p[0], p[1], p[2]}}, from);
    const float length = glms_vec3_norm(axis), x = glms_vec3_dot(q, axis) / length;
    const float r = sqrtf(fmaxf(glms_vec3_norm2(q) - x * x, 0.0f));
    const float tilt = (part->radius_a - part->radius_b) / length;
    const float ball = fminf(fmaxf(x - r * tilt / sqrtf(1.0f - tilt * tilt), 0.0f), length);
    return sqrtf((x - ball) * (x - ball) + r * r) - part->radius_a -
           (part->radius_b - part->radius_a) * ball / length;
}

float parts_union(float old, float added, float blend, float rgb[3], const float added_rgb[3])
{
    const float h = fmaxf(blend - fabsf(added - old), 0.0f) / blend;
    const float share = added < old ? 1.0f - 0.5f * h * h : 0.5f * h * h;
    for (int k = 0; rgb && k < 3; k++) rgb[k] += (added_rgb[k] - rgb[k]) * share;
    return fminf(added, old) - 0.25f * h * h * blend;
}

float parts_add(const struct part *table, size_t count, const float p[3], float distance, float rgb[3])
{
    for (size_t i = 0; i < count; i++) {
        float part_rgb[3] = {0};
        if (rgb) coat_linear(table[i].color, part_rgb);
        distance = parts_union(distance, part_distance(&table[i], p), table[i].blend, rgb, part_rgb);
    }
    return distance;
}
