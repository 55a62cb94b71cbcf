/// What the stage is made of besides what stands on it; a part of the theme.
#ifndef UI_STAGE_COLORS_H
#define UI_STAGE_COLORS_H

#include <stdint.h>

/// 0xRRGGBBAA, sRGB, opaque.
struct stage_colors {
    uint32_t top, bottom; ///< of the background
    uint32_t ground, shadow;
    uint32_t bounce; ///< light from the ground
};

#endif
