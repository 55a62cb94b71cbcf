/// Colours the fox by where on its skin a point is.
#include "model/coat.h"
#include "base/srgb.h"
#include "model/creature.h"
#include "model/vector.h"
#include <math.h>

void coat_linear(uint32_t srgb, float rgb[3])
{
    for (int k = 0; k < 3; k++) rgb[k] = srgb_to_linear((float)(srgb >> (16 - 8 * k) & 0xFF) / 255.0f);
}

void coat_mix(float rgb[3], uint32_t to, float amount)
{
    float other[3];
    coat_linear(to, other);
    glm_vec3_lerp(rgb, other, amount, rgb);
}

void coat_tail(float z, float up, float rgb[3])
{
    static const float band_middle[] = {0.23f, 0.40f, 0.56f, 0.71f};
    const float u = z / CREATURE_TAIL_LENGTH;
    coat_linear(COAT_FUR, rgb);
    coat_mix(rgb, COAT_BELLY, glm_smoothstep(-0.15f, -0.75f, up));
    for (int b = 0; b < 4; b++) {
        const float across = glm_smoothstep(0.042f, 0.018f, fabsf(u - band_middle[b]));
        coat_mix(rgb, COAT_BAND, across * (0.35f + 0.65f * glm_smoothstep(-0.9f, -0.1f, up)));
    }
    coat_mix(rgb, COAT_TIP, glm_smoothstep(0.80f, 0.86f, u));
}
