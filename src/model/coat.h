/// The colours of the animal's coat. Linear RGB.
#ifndef MODEL_COAT_H
#define MODEL_COAT_H

#include <stdint.h>

#define COAT_FUR 0xD98A4Bu
#define COAT_BELLY 0xF2D3ACu
#define COAT_BAND 0x7A4528u
#define COAT_TIP 0xF4F1E8u
#define COAT_DARK 0x2B1D18u /* eyes, nose, inside of ears */

/// sRGB 0xRRGGBB → linear RGB.
void coat_linear(uint32_t srgb, float rgb[3]);

/// rgb = rgb + (to − rgb)·amount.
void coat_mix(float rgb[3], uint32_t to, float amount);

/// Colour of the tail `z` metres from its base where its skin faces `up` (the y of the direction from its axis, −1 …
/// 1).
void coat_tail(float z, float up, float rgb[3]);

#endif
