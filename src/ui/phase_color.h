/// Colours of phases: hue and lightness say how far ahead something moves, both the more clearly the more it moves.
///
/// They go once around a tilted circle in Oklab: hue evenly, lightness by 0.22 up and down, brightest at 65° ahead, between the
/// yellow of what is in step and the cyan of a quarter ahead. So tilted, the circle stays open from whichever side colour-blind
/// eyes see it: phases an eighth of a turn apart differ to all of them (tests/test_theme.c). The movement
/// z = re + j·im is the point of that circle's plane at the same angle, 0.6th power of its amplitude from the grey in the
/// middle: nothing that stands still has a hue. The surface shows lines between the eighths besides (stage_mesh.frag).
#ifndef UI_PHASE_COLOR_H
#define UI_PHASE_COLOR_H

#include <stdint.h>

/// Linear RGB, within 0 … 1, of a movement of amplitude |z| ≤ 1 that leads by arg z.
void phase_color_linear(float re, float im, float rgb[3]);

/// The same as 0xRRGGBBFF in sRGB.
uint32_t phase_color(float re, float im);

#endif
