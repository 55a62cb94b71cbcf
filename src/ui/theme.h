/// Colours and sizes of the whole screen (look.md's palette), in one place. Sizes in logical pixels.
#ifndef UI_THEME_H
#define UI_THEME_H

#include <stdint.h>

#define THEME_PANEL 0x14171CFFu
#define THEME_RAISED 0x1B1F26FFu /* fields, buttons */
#define THEME_GRID_MINOR 0x1B1F26FFu
#define THEME_GRID_MAJOR 0x262B33FFu
#define THEME_ZERO 0x3A414CFFu
#define THEME_BORDER 0x262B33FFu
#define THEME_ACCENT 0xFFB000FFu
#define THEME_EQUILIBRIUM 0x9AA3AFFFu
#define THEME_TEXT 0xD7DCE3FFu
#define THEME_TEXT_DIM 0x8A93A0FFu
#define THEME_PLAYHEAD 0xF4F1E8FFu
#define THEME_WARNING 0xE3B34FFFu
#define THEME_ERROR 0xE0705AFFu

/// Spline colours, apart under red-green blindness; taken in turn.
enum { THEME_SPLINE_COLORS = 6 };
extern const uint32_t theme_spline_color[THEME_SPLINE_COLORS];

/// The same colour at `alpha` 0 … 1 of its own opacity.
uint32_t theme_fade(uint32_t color, float alpha);

/// The pixel sizes of text that exist (atlases are built for these).
#define THEME_TEXT_SMALL 11.0f
#define THEME_TEXT_NORMAL 13.0f
#define THEME_TEXT_TITLE 18.0f

enum { THEME_INSPECTOR_WIDTH = 280, THEME_STATUS_HEIGHT = 24 };

#endif
