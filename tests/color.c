/// CIEDE2000, as seen with all cones or without one kind.
#include "color.h"
#include <math.h>
#include <stdbool.h>

/// Linear RGB as seen. Brettel's dichromats see two half planes: `other` where the product with `normal` is below 0.
struct vision {
    const char *name;
    double seen[3][3], other[3][3], normal[3];
};

/// Machado et al.: table 1 of "A Physiologically-based Model for Simulation of Color Vision Deficiency", IEEE TVCG 15(6).
/// Brettel et al.: "Computerized simulation of color appearance for dichromats", JOSA A 14(10), brought to linear sRGB by
/// libDaltonLens (public domain).
static const struct vision visions[EYES_COUNT] = {
    [EYES_WITH_ALL_CONES] = {"all cones", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0}}, {0}},
    [EYES_PROTANOPIA] = {"protanopia (Machado)",
                         {{0.152286, 1.052583, -0.204868},
                          {0.114503, 0.786281, 0.099216},
                          {-0.003882, -0.048116, 1.051998}},
                         {{0}},
                         {0}},
    [EYES_DEUTERANOPIA] = {"deuteranopia (Machado)",
                           {{0.367322, 0.860646, -0.227968},
                            {0.280085, 0.672501, 0.047413},
                            {-0.011820, 0.042940, 0.968881}},
                           {{0}},
                           {0}},
    [EYES_TRITANOPIA] = {"tritanopia (Machado)",
                         {{1.255528, -0.076749, -0.178779},
                          {-0.078411, 0.930809, 0.147602},
                          {0.004733, 0.691367, 0.303900}},
                         {{0}},
                         {0}},
    [EYES_PROTANOPIA_BRETTEL] =
        {"protanopia (Brettel)",
         {{0.14980, 1.19548, -0.34528}, {0.10764, 0.84864, 0.04372}, {0.00384, -0.00540, 1.00156}},
         {{0.14570, 1.16172, -0.30742}, {0.10816, 0.85291, 0.03892}, {0.00386, -0.00524, 1.00139}},
         {0.00048, 0.00393, -0.00441}},
    [EYES_DEUTERANOPIA_BRETTEL] =
        {"deuteranopia (Brettel)",
         {{0.36477, 0.86381, -0.22858}, {0.26294, 0.64245, 0.09462}, {-0.02006, 0.02728, 0.99278}},
         {{0.37298, 0.88166, -0.25464}, {0.25954, 0.63506, 0.10540}, {-0.01980, 0.02784, 0.99196}},
         {-0.00281, -0.00611, 0.00892}},
    [EYES_TRITANOPIA_BRETTEL] =
        {"tritanopia (Brettel)",
         {{1.01277, 0.13548, -0.14826}, {-0.01243, 0.86812, 0.14431}, {0.07589, 0.80500, 0.11911}},
         {{0.93678, 0.18979, -0.12657}, {0.06154, 0.81526, 0.12320}, {-0.37562, 1.12767, 0.24796}},
         {0.03901, -0.02788, -0.01113}},
};

const char *color_eyes_name(enum color_eyes eyes) { return visions[eyes].name; }

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static double linear(uint32_t color, int shift)
{
    const double value = (color >> shift & 0xFFu) / 255.0;
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

static double lab_curve(double t) { return t > 216.0 / 24389 ? cbrt(t) : t * 841 / 108 + 4.0 / 29; }

void color_lab(uint32_t color, enum color_eyes eyes, double lab[3])
{
    static const double xyz_of[3][3] = {
        {0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}};
    static const double white[3] = {0.95047, 1, 1.08883};
    const struct vision *vision = &visions[eyes];
    const double rgb[3] = {linear(color, 24), linear(color, 16), linear(color, 8)};
    const double(*matrix)[3] = dot(vision->normal, rgb) < 0 ? vision->other : vision->seen;
    double seen[3], f[3];
    for (int k = 0; k < 3; k++) seen[k] = fmin(fmax(dot(matrix[k], rgb), 0), 1);
    for (int k = 0; k < 3; k++) f[k] = lab_curve(dot(xyz_of[k], seen) / white[k]);
    lab[0] = 116 * f[1] - 16;
    lab[1] = 500 * (f[0] - f[1]);
    lab[2] = 200 * (f[1] - f[2]);
}

static double square(double x) { return x * x; }

/// Cosine of an angle given in degrees.
static double cosine(double degrees) { return cos(degrees * M_PI / 180); }

/// Share by which CIEDE2000 treats a chroma as large: near 0 for greys, near 1 for vivid colours.
static double vividness(double chroma) { return sqrt(pow(chroma, 7) / (pow(chroma, 7) + pow(25, 7))); }

/// Hue in degrees, 0 … 360; 0 for a grey.
static double hue_of(double a, double b)
{
    const double degrees = a == 0 && b == 0 ? 0 : atan2(b, a) * 180 / M_PI;
    return degrees < 0 ? degrees + 360 : degrees;
}

/// The hue between two, the short way round; greys have none, so that the other's counts alone.
static double mean_hue(double one, double other, bool has_grey)
{
    if (has_grey) return one + other;
    if (fabs(one - other) <= 180) return (one + other) / 2;
    return (one + other + (one + other < 360 ? 360 : -360)) / 2;
}

/// In the notation of Sharma, Wu and Dalal, "The CIEDE2000 Color-Difference Formula: Implementation Notes, Supplementary Test
/// Data, and Mathematical Observations", Color Research and Application 30(1), 2005.
double color_lab_difference(const double one[3], const double other[3])
{
    const double g = 0.5 * (1 - vividness((hypot(one[1], one[2]) + hypot(other[1], other[2])) / 2));
    const double a1 = (1 + g) * one[1], a2 = (1 + g) * other[1];
    const double c1 = hypot(a1, one[2]), c2 = hypot(a2, other[2]);
    const double h1 = hue_of(a1, one[2]), h2 = hue_of(a2, other[2]);
    const bool has_grey = c1 * c2 == 0;
    const double dh = has_grey ? 0 : remainder(h2 - h1, 360);
    const double dl = other[0] - one[0], dc = c2 - c1, dhue = 2 * sqrt(c1 * c2) * sin(dh / 2 * M_PI / 180);
    const double l = (one[0] + other[0]) / 2, c = (c1 + c2) / 2, h = mean_hue(h1, h2, has_grey);
    const double t =
        1 - 0.17 * cosine(h - 30) + 0.24 * cosine(2 * h) + 0.32 * cosine(3 * h + 6) - 0.20 * cosine(4 * h - 63);
    const double sl = 1 + 0.015 * square(l - 50) / sqrt(20 + square(l - 50)), sc = 1 + 0.045 * c,
                 sh = 1 + 0.015 * c * t;
    const double turn = 60 * exp(-square((h - 275) / 25)), rt = -2 * vividness(c) * sin(turn * M_PI / 180);
    return sqrt(square(dl / sl) + square(dc / sc) + square(dhue / sh) + rt * (dc / sc) * (dhue / sh));
}

double color_difference(uint32_t a, uint32_t b, enum color_eyes eyes)
{
    double one[3], other[3];
    color_lab(a, eyes, one);
    color_lab(b, eyes, other);
    return color_lab_difference(one, other);
}

uint32_t color_blend(uint32_t over, uint32_t under)
{
    const float alpha = (float)(over & 0xFFu) / 255;
    uint32_t color = 0xFFu;
    for (int shift = 8; shift < 32; shift += 8) {
        const float a = (float)(over >> shift & 0xFFu), b = (float)(under >> shift & 0xFFu);
        color |= (uint32_t)lroundf(b + (a - b) * alpha) << shift;
    }
    return color;
}
