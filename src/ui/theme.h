/// All colours (0xRRGGBBAA) and sizes (logical pixels). The process uses one of two themes; drawing code looks it up each time:
/// drawlist_rect(list, area, theme()->panel).
#ifndef UI_THEME_H
#define UI_THEME_H

#include <stdbool.h>
#include <stdint.h>

/// Assigned in turn. Any two differ by a ΔE2000 of at least 10 under each of the three kinds of colour blindness.
enum { THEME_SPLINE_COLORS = 6 };

/// Opacity of inactive splines, which keeps a contrast of 3:1 and their differences.
#define THEME_OTHERS 0.8f

/// Opaque colours of the stage without its rigs.
struct stage_colors {
    uint32_t top, bottom;
    uint32_t ground, shadow;
    uint32_t bounce; ///< light from the ground
};

/// Text colours (text, text_dim, accent, warning, error) have a contrast of at least 4.5:1 on panel and raised, `text` and `text_dim` also
/// on fill, hover and stage. `control`, spline colours and other non-text colours have 3:1. tests/draw/test_theme.c lists the pairs.
struct theme {
    const char *name; ///< in settings and on the command line
    uint32_t panel, border;
    uint32_t raised;      ///< fields and buttons
    uint32_t fill, hover; ///< filled part of a bar, chosen segment; the same under the pointer
    uint32_t control;     ///< outlines and thumbs of controls
    uint32_t text, text_dim, accent, warning, error;
    uint32_t veil;    ///< over everything behind a dialog; a popup's shadow
    uint32_t outside; ///< plot outside the scene's range
    uint32_t grid_minor, grid_major, zero;
    uint32_t equilibrium, playhead;
    struct stage_colors stage;
    uint32_t spline[THEME_SPLINE_COLORS];
};

enum theme_kind { THEME_DARK, THEME_LIGHT, THEME_COUNT };

/// Initially the dark one.
const struct theme *theme(void);
enum theme_kind theme_in_use(void);
void theme_use(enum theme_kind kind);
/// Index of a theme, or -1.
int theme_find(const char *name);

/// The colour at `alpha` times its opacity.
uint32_t theme_fade(uint32_t color, float alpha);

/// Contrast of two opaque colours, 1 … 21 (WCAG 2: (L₁ + 0.05)/(L₂ + 0.05) with relative luminances L₁ ≥ L₂).
float theme_contrast(uint32_t a, uint32_t b);
/// Blends an opaque colour towards the text's until it has `contrast` on a background.
uint32_t theme_readable(uint32_t color, uint32_t background, float contrast);

/// The theme's colour for a document's 0xRRGGBB: those of theme_spline_rgb() become the theme's own, others are made readable on the panel.
uint32_t theme_spline(uint32_t rgb);
/// The stored colour number `index`.
uint32_t theme_spline_rgb(int index);

/// Text sizes in the atlas.
#define THEME_TEXT_SMALL 11.0f
#define THEME_TEXT_NORMAL 13.0f
#define THEME_TEXT_TITLE 18.0f

enum { THEME_INSPECTOR_WIDTH = 280 };

/// Height in pixels of the panels' rows and icons and of the status line: 24, or 32 on a phone, where fingers press them.
float theme_row(void);
void theme_fit_fingers(bool fingers);

/// The colour of a movement z = re + j·im, amplitude |z| ≤ 1, phase lead arg z, in linear RGB. Phases lie on a tilted circle in Oklab: hue
/// is uniform, lightness varies by 0.22 with its maximum at 65°, between yellow (in step) and cyan (a quarter ahead). The tilt lets phases
/// an eighth of a turn apart differ under every kind of colour blindness (tests/draw/test_theme.c). Distance from the grey centre is the
/// amplitude to the power 0.6. The surface also has lines between the eighths (stage_mesh.frag).
void phase_color_linear(float re, float im, float rgb[3]);

/// As 0xRRGGBBFF in sRGB.
uint32_t phase_color(float re, float im);

#endif
