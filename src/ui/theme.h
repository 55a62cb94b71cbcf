/// Colours and sizes of the whole screen, in one place. Sizes in logical pixels, colours 0xRRGGBBAA.
///
/// There are two themes; one of them is in use, for the whole process. Code that draws asks for it each time:
///
///     drawlist_rect(list, area, theme()->panel);
#ifndef UI_THEME_H
#define UI_THEME_H

#include <stdint.h>

/// Spline colours are assigned in turn. Any two are a ΔE2000 of 10 or more apart under each of the three kinds of colour blindness.
enum { THEME_SPLINE_COLORS = 6 };

/// Opacity of curves and knots of inactive splines, which keep a contrast of 3:1 and their difference.
#define THEME_OTHERS 0.8f

/// Colours of the stage without its rigs. Opaque.
struct stage_colors {
    uint32_t top, bottom; ///< of the background
    uint32_t ground, shadow;
    uint32_t bounce; ///< light from the ground
};

/// Every text colour (text, text_dim, accent, warning, error) has a contrast of 4.5:1 or more on panel and raised, `text` and
/// `text_dim` on fill, hover and the stage too; `control`, spline colours, and whatever must be seen but not read have
/// 3:1. tests/test_theme.c has the pairs.
struct theme {
    const char *name; ///< in the settings and on the command line
    uint32_t panel, border;
    uint32_t raised;      ///< fields, buttons at rest
    uint32_t fill, hover; ///< the filled part of a bar, chosen segments; the same under the pointer
    uint32_t control;     ///< outlines of controls at rest, thumbs: what shows that there is something to use
    uint32_t text, text_dim, accent, warning, error;
    uint32_t veil;    ///< over what a dialog keeps out of reach, and the shade of a popup
    uint32_t outside; ///< the plot before and after the scene's range
    uint32_t grid_minor, grid_major, zero;
    uint32_t equilibrium, playhead;
    struct stage_colors stage;
    uint32_t spline[THEME_SPLINE_COLORS];
};

enum theme_kind { THEME_DARK, THEME_LIGHT, THEME_COUNT };

/// The theme in use: the dark one at first.
const struct theme *theme(void);
enum theme_kind theme_in_use(void);
void theme_use(enum theme_kind kind);
/// The theme of that name, or -1.
int theme_find(const char *name);

/// The same colour at `alpha` 0 … 1 of its own opacity.
uint32_t theme_fade(uint32_t color, float alpha);

/// Contrast of two opaque colours, 1 … 21 (WCAG 2: (L₁ + 0.05)/(L₂ + 0.05) with relative luminances L₁ ≥ L₂).
float theme_contrast(uint32_t a, uint32_t b);
/// An opaque colour, blended towards the text's just enough for `contrast` on a background.
uint32_t theme_readable(uint32_t color, uint32_t background, float contrast);

/// The theme's colour for one that a document asks for (0xRRGGBB): those of theme_spline_rgb() map to the theme's own,
/// others are made readable on the panel.
uint32_t theme_spline(uint32_t rgb);
/// The stored number of the `index`th spline colour, whatever its shade in a theme.
uint32_t theme_spline_rgb(int index);

/// The pixel sizes of text that exist (atlases are built for these).
#define THEME_TEXT_SMALL 11.0f
#define THEME_TEXT_NORMAL 13.0f
#define THEME_TEXT_TITLE 18.0f

enum { THEME_INSPECTOR_WIDTH = 280, THEME_STATUS_HEIGHT = 24 };

/// The colour of a phase: hue and lightness show how far ahead something moves, more clearly the more it moves. Linear RGB, within 0 … 1, of a
/// movement of amplitude |z| ≤ 1 that leads by arg z.
///
/// Colours go once around a tilted circle in Oklab: hue evenly, lightness by 0.22 up and down, brightest at 65° ahead, between the
/// yellow of what is in step and the cyan of a quarter ahead. The tilt keeps the circle open for every kind of colour
/// blindness: phases an eighth of a turn apart always differ (tests/test_theme.c). The movement
/// z = re + j·im is the point of that circle's plane at the same angle, amplitude to the power 0.6 away from the grey in the
/// middle: what stands still is grey. The surface also has lines between the eighths (stage_mesh.frag).
void phase_color_linear(float re, float im, float rgb[3]);

/// The same as 0xRRGGBBFF in sRGB.
uint32_t phase_color(float re, float im);

#endif
