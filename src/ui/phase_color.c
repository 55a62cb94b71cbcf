/// Maps a phase and an amplitude to a colour.
#include "ui/phase_color.h"
#include "base/srgb.h"
#include <math.h>

/// Lightness of grey; radius of the circle of hues; added lightness at re = 1 and at im = 1; exponent of the amplitude, which
/// makes small movements visible. stage_character.vert has the same.
static const float LIGHTNESS = 0.70f, CHROMA = 0.10f, SWING_RE = 0.09298f, SWING_IM = 0.19939f, SPREAD = 0.6f;

/// Oklab → cube roots of cone responses → linear RGB.
void phase_color_linear(float re, float im, float rgb[3])
{
    const float shown = powf(fmaxf(hypotf(re, im), 1e-6f), SPREAD - 1.0f), x = shown * re, y = shown * im;
    const float lightness = LIGHTNESS + SWING_RE * x + SWING_IM * y, a = -CHROMA * y, b = CHROMA * x;
    float l = lightness + 0.3963377774f * a + 0.2158037573f * b;
    float m = lightness - 0.1055613458f * a - 0.0638541728f * b;
    float s = lightness - 0.0894841775f * a - 1.2914855480f * b;
    l = l * l * l, m = m * m * m, s = s * s * s;
    rgb[0] = 4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s;
    rgb[1] = -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s;
    rgb[2] = -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s;
}

uint32_t phase_color(float re, float im)
{
    float rgb[3];
    uint32_t color = 0;
    phase_color_linear(re, im, rgb);
    for (int k = 0; k < 3; k++) {
        const float c = fminf(fmaxf(rgb[k], 0.0f), 1.0f);
        color = color << 8 | (uint32_t)lroundf(255.0f * srgb_from_linear(c));
    }
    return color << 8 | 0xFFu;
}
