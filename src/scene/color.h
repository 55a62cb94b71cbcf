/// Colours as files and people write them: "#RRGGBB".
#ifndef SCENE_COLOR_H
#define SCENE_COLOR_H

#include <stdbool.h>

enum { COLOR_TEXT_SIZE = 8 };

/// Reads "#RRGGBB" (six hexadecimal digits of either case) into 0xRRGGBB; false for anything else.
bool color_parse(const char *text, int *color);

/// Writes 0xRRGGBB as "#RRGGBB" with capital digits.
void color_print(int color, char text[COLOR_TEXT_SIZE]);

#endif
