/// The dark and the light theme.
#include "ui/theme.h"
#include "base/png.h"
#include "maths/maths.h"
#include <math.h>
#include <string.h>

#define DARK(name, dark, light) .name = dark,
#define LIGHT(name, dark, light) .name = light,

static const struct theme themes[THEME_COUNT] = {
    [THEME_DARK] = {.name = "dark",
                    .stage = {.top = 0x1B2028FFu,
                              .bottom = 0x111419FFu,
                              .ground = 0x39414CFFu,
                              .shadow = 0x07080AFFu,
                              .bounce = 0x4A382AFFu},
                    .spline = {0xFFB000FFu, 0x45A8F1FFu, 0xD2A4C7FFu, 0x379570FFu, 0xF4F1E8FFu, 0xCD5C33FFu},
                    THEME_COLORS(DARK)},
    [THEME_LIGHT] = {.name = "light",
                     .stage = {.top = 0xE6EBF1FFu,
                               .bottom = 0xCFD6DFFFu,
                               .ground = 0xF4F3EFFFu,
                               .shadow = 0x4A4640FFu,
                               .bounce = 0x9A8A74FFu},
                     .spline = {0xC25F00FFu, 0x1775C8FFu, 0x9E6690FFu, 0x4D7552FFu, 0x333B46FFu, 0xA43023FFu},
                     THEME_COLORS(LIGHT)},
};

/// Documents store these colours, so they never change. They are the first dark theme's.
static const uint32_t stored[THEME_SPLINE_COLORS] = {0xFFB000, 0x4FA3E3, 0xE39AC8, 0x1F9E7A, 0xF4F1E8, 0xC8502A};

static enum theme_kind in_use = THEME_DARK;

const struct theme *theme(void) { return &themes[in_use]; }

enum theme_kind theme_in_use(void) { return in_use; }

void theme_use(enum theme_kind kind) { in_use = kind; }

static float row = 24;

float theme_row(void) { return row; }

void theme_fit_fingers(bool fingers) { row = fingers ? 32 : 24; }

int theme_find(const char *name)
{
    for (int i = 0; i < THEME_COUNT; i++) {
        if (strcmp(themes[i].name, name) == 0) return i;
    }
    return -1;
}

uint32_t theme_fade(uint32_t color, float alpha)
{
    float clamped = alpha < 0.0f ? 0.0f : alpha > 1.0f ? 1.0f : alpha;
    return (color & 0xFFFFFF00u) | (uint32_t)((float)(color & 0xFFu) * clamped + 0.5f);
}

static float light(uint32_t color, int shift) { return srgb_to_linear((float)(color >> shift & 0xFFu) / 255); }

static float luminance(uint32_t color)
{
    return 0.2126f * light(color, 24) + 0.7152f * light(color, 16) + 0.0722f * light(color, 8);
}

float theme_contrast(uint32_t a, uint32_t b)
{
    float la = luminance(a), lb = luminance(b);
    return (fmaxf(la, lb) + 0.05f) / (fminf(la, lb) + 0.05f);
}

uint32_t theme_readable(uint32_t color, uint32_t background, float contrast)
{
    enum { STEPS = 16 };
    uint32_t blended = color;
    for (int i = 1; i <= STEPS && theme_contrast(blended, background) < contrast; i++) {
        blended = 0xFFu;
        for (int shift = 8; shift < 32; shift += 8) {
            const float from = (float)(color >> shift & 0xFFu), to = (float)(theme()->text >> shift & 0xFFu);
            blended |= (uint32_t)lroundf(from + (to - from) * ((float)i / STEPS)) << shift;
        }
    }
    return blended;
}

uint32_t theme_spline_rgb(int index) { return stored[index]; }

uint32_t theme_spline(uint32_t rgb)
{
    for (int i = 0; i < THEME_SPLINE_COLORS; i++) {
        if (stored[i] == rgb) return theme()->spline[i];
    }
    return theme_readable(rgb << 8 | 0xFFu, theme()->panel, 3);
}

/// Oklab: lightness of grey; chroma; added lightness at re = 1 and im = 1; exponent of the amplitude, which makes small movements visible.
static const float LIGHTNESS = 0.70f, CHROMA = 0.10f, SWING_RE = 0.09298f, SWING_IM = 0.19939f, SPREAD = 0.6f;

/// Oklab → cube roots of cone responses → linear RGB.
void phase_color_linear(float re, float im, float rgb[3])
{
    const float shown = powf(fmaxf(maths_hypotf(re, im), 1e-6f), SPREAD - 1.0f), x = shown * re, y = shown * im;
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
