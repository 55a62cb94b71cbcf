/// Reads and writes "#RRGGBB".
#include "scene/color.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool color_parse(const char *text, int *color)
{
    if (text[0] != '#' || strlen(text) != 7 || strspn(text + 1, "0123456789abcdefABCDEF") != 6) return false;
    *color = (int)strtol(text + 1, NULL, 16);
    return true;
}

void color_print(int color, char text[COLOR_TEXT_SIZE])
{
    snprintf(text, COLOR_TEXT_SIZE, "#%06X", (unsigned)color & 0xFFFFFFu);
}
