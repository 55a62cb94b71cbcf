/// Colours the fox by where on its body a point is.
#include "model/coat.h"
#include "base/srgb.h"
#include "model/creature.h"
#include <math.h>

void coat_linear(uint32_t srgb, float rgb[3])
{
    for (int k = 0; k < 3; k++) rgb[k] = srgb_to_linear((float)(srgb >> (16 - 8 * k) & 0xFF) / 255.0f);
}

void coat_mix(float rgb[3], uint32_t to, float amount)
{
    float other[3];
    coat_linear(to, other);
    for (int k = 0; k < 3; k++) rgb[k] += (other[k] - rgb[k]) * amount;
}

float coat_step(float from, float to, float x)
{
    const float t = fminf(fmaxf((x - from) / (to - from), 0.0f), 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

void coat_tail(float z, float up, float rgb[3])
{
    static const float band_middle[] = {0.23f, 0.40f, 0.56f, 0.71f};
    const float u = z / CREATURE_TAIL_LENGTH;
    coat_linear(COAT_FUR, rgb);
    coat_mix(rgb, COAT_BELLY, coat_step(-0.15f, -0.75f, up));
    for (int b = 0; b < 4; b++) {
        const float across = coat_step(0.042f, 0.018f, fabsf(u - band_middle[b]));
        coat_mix(rgb, COAT_BAND, across * (0.35f + 0.65f * coat_step(-0.9f, -0.1f, up)));
    }
    coat_mix(rgb, COAT_TIP, coat_step(0.80f, 0.86f, u));
}
