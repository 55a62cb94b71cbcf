/// Numbers as text: the shortest that reads back equal.
#ifndef SCENE_NUMBER_H
#define SCENE_NUMBER_H

#include <stddef.h>

enum { NUMBER_TEXT_SIZE = 32 }; ///< room for any double

/// Writes the fewest digits that read back equal, as plain decimals from 1e-5 up to 1e15 and with an exponent beyond:
/// 0.1, 120, 1.5e-7. Both zeros are "0". The same in every locale. `value` must be finite. Returns the length.
size_t number_print(double value, char text[NUMBER_TEXT_SIZE]);

#endif
