#include "ui/theme.h"

const uint32_t theme_spline_color[THEME_SPLINE_COLORS] = {
    0xFFB000FFu, 0x4FA3E3FFu, 0xE39AC8FFu, 0x1F9E7AFFu, 0xF4F1E8FFu, 0xC8502AFFu,
};

uint32_t theme_fade(uint32_t color, float alpha)
{
    float clamped = alpha < 0.0f ? 0.0f : alpha > 1.0f ? 1.0f : alpha;
    return (color & 0xFFFFFF00u) | (uint32_t)((float)(color & 0xFFu) * clamped + 0.5f);
}
