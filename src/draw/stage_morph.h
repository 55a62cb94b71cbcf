/// Soft characters on the stage: figures on the GPU, moved by complex morphs.
#ifndef DRAW_STAGE_MORPH_H
#define DRAW_STAGE_MORPH_H

#include "base/error.h"
#include "model/figure.h"
#include <stdbool.h>

/// Whether what moves a figure fits into a texture of at most `largest` texels a side; false with a sentence that has the
/// figures.
bool stage_morph_fits(const struct figure *figure, int largest, struct error *error);

#endif
