/// Perceived colour differences: CIEDE2000 between sRGB colours, with normal vision or one kind of cone missing.
#ifndef TESTS_COLOR_H
#define TESTS_COLOR_H

#include <stdint.h>

/// Two models of dichromacy, because they differ by up to a third (most without blue cones): Machado, Oliveira and Fernandes 2009 at
/// severity 1, and Brettel, Viénot and Mollon 1997.
enum color_eyes {
    EYES_WITH_ALL_CONES,
    EYES_PROTANOPIA,
    EYES_DEUTERANOPIA,
    EYES_TRITANOPIA,
    EYES_PROTANOPIA_BRETTEL,
    EYES_DEUTERANOPIA_BRETTEL,
    EYES_TRITANOPIA_BRETTEL,
    EYES_COUNT
};

const char *color_eyes_name(enum color_eyes eyes);

/// CIE L*a*b* (D65) of an opaque colour 0xRRGGBBAA, as these eyes see it.
void color_lab(uint32_t color, enum color_eyes eyes, double lab[3]);

/// ΔE of two L*a*b* colours (CIEDE2000, all weights 1); about 1 is just noticeable.
double color_lab_difference(const double a[3], const double b[3]);

/// The same for two colours as these eyes see them.
double color_difference(uint32_t a, uint32_t b, enum color_eyes eyes);

/// The result of `over`, with its opacity, on the opaque `under`.
uint32_t color_blend(uint32_t over, uint32_t under);

#endif
