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

/// A coat is fur with markings, which have clear edges however near one looks: mark[0] is how deep a point lies in what is
/// white, mark[1] in what is dark (metres, negative outside), mark[2] how brown its fur is (0 … 1).
enum { MARK_WHITE, MARK_DARK, MARK_BROWN, MARKS };

/// The colour that markings come to where nothing evaluates them by the pixel.
void coat_marked(const float mark[MARKS], float rgb[3]);

/// Markings of the tail `z` metres from its base, where its skin faces `up` (the y of the direction from its axis, −1 … 1).
void coat_tail(float z, float up, float mark[MARKS]);

#endif
