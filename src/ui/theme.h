/// Colours and sizes of the whole screen, in one place. Sizes in logical pixels, colours 0xRRGGBBAA.
///
/// There are two themes; one of them is in use, for the whole process. What is drawn asks for it each time:
///
///     drawlist_rect(list, area, theme()->panel);
#ifndef UI_THEME_H
#define UI_THEME_H

#include <stdint.h>

/// Spline colours are taken in turn. Under each of the three kinds of colour blindness every two are a ΔE2000 of 10 or more apart.
enum { THEME_SPLINE_COLORS = 6 };

/// Opacity of the curves and knots that are not of the active spline; they keep 3:1 and their distance.
#define THEME_OTHERS 0.8f

/// What the stage is made of besides what stands on it. Opaque.
struct stage_colors {
    uint32_t top, bottom; ///< of the background
    uint32_t ground, shadow;
    uint32_t bounce; ///< light from the ground
};

/// Every text colour (text, text_dim, accent, warning, error) has a contrast of 4.5:1 or more on panel and raised, `text` and
/// `text_dim` on fill, hover and the stage too; `control`, spline colours, and what else has to be seen without being read have
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
/// An opaque colour, blended with the text's just so far that its contrast on a background is `contrast` or more.
uint32_t theme_readable(uint32_t color, uint32_t background, float contrast);

/// How the theme in use shows a colour that a document asks for (0xRRGGBB): what theme_spline_rgb() gives stands for the
/// theme's own, others are made out against the panel.
uint32_t theme_spline(uint32_t rgb);
/// What a document stores for the `index`th spline colour, whichever shade a theme has for it.
uint32_t theme_spline_rgb(int index);

/// The pixel sizes of text that exist (atlases are built for these).
#define THEME_TEXT_SMALL 11.0f
#define THEME_TEXT_NORMAL 13.0f
#define THEME_TEXT_TITLE 18.0f

enum { THEME_INSPECTOR_WIDTH = 280, THEME_STATUS_HEIGHT = 24 };

#endif
