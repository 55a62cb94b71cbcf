/// Colours of phases: hue says how far ahead something moves, chroma how much it moves.
///
/// Hue runs evenly around a circle in Oklab, at one lightness, so equal steps of phase look equally large and no phase
/// stands out. The movement z = re + j·im is the point of that circle's plane at the same angle, 0.6th power of its amplitude
/// from the middle: nothing that stands still has a hue.
#ifndef UI_PHASE_COLOR_H
#define UI_PHASE_COLOR_H

#include <stdint.h>

/// Linear RGB, within 0 … 1, of a movement of amplitude |z| ≤ 1 that leads by arg z.
void phase_color_linear(float re, float im, float rgb[3]);

/// The same as 0xRRGGBBFF in sRGB.
uint32_t phase_color(float re, float im);

#endif
