/// Colours of phases: hue and lightness show how far ahead something moves, more clearly the more it moves.
///
/// They go once around a tilted circle in Oklab: hue evenly, lightness by 0.22 up and down, brightest at 65° ahead, between the
/// yellow of what is in step and the cyan of a quarter ahead. The tilt keeps the circle open for every kind of colour
/// blindness: phases an eighth of a turn apart always differ (tests/test_theme.c). The movement
/// z = re + j·im is the point of that circle's plane at the same angle, amplitude to the power 0.6 away from the grey in the
/// middle: what stands still is grey. The surface also has lines between the eighths (stage_mesh.frag).
#ifndef UI_PHASE_COLOR_H
#define UI_PHASE_COLOR_H

#include <stdint.h>

/// Linear RGB, within 0 … 1, of a movement of amplitude |z| ≤ 1 that leads by arg z.
void phase_color_linear(float re, float im, float rgb[3]);

/// The same as 0xRRGGBBFF in sRGB.
uint32_t phase_color(float re, float im);

#endif
