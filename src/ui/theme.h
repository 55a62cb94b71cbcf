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

/// All colours but those of the stage and of splines: in the dark and in the light theme.
#define THEME_COLORS(COLOR)                                                                                          \
    COLOR(panel, 0x14171CFFu, 0xF8F9FBFFu)                                                                           \
    COLOR(border, 0x262B33FFu, 0xD3D9E1FFu)                                                                          \
    COLOR(raised, 0x1B1F26FFu, 0xEAEEF3FFu)  /* fields and buttons */                                                \
    COLOR(fill, 0x2B313BFFu, 0xD5DCE5FFu)    /* filled part of a bar, chosen segment */                              \
    COLOR(hover, 0x363D49FFu, 0xC8D1DCFFu)   /* the same under the pointer */                                        \
    COLOR(control, 0x666E7AFFu, 0x7C8693FFu) /* outlines and thumbs of controls */                                   \
    COLOR(text, 0xD7DCE3FFu, 0x1C222BFFu)                                                                            \
    COLOR(text_dim, 0xA6AEBAFFu, 0x4D5764FFu)                                                                        \
    COLOR(accent, 0xFFB000FFu, 0x935600FFu)                                                                          \
    COLOR(warning, 0xE3B34FFFu, 0x8A5300FFu)                                                                         \
    COLOR(error, 0xE0705AFFu, 0xB3301BFFu)                                                                           \
    COLOR(veil, 0x0000008Cu, 0x1C222B66u)    /* over everything behind a dialog; a popup's shadow */                 \
    COLOR(outside, 0x0F1216FFu, 0xEBEEF2FFu) /* plot outside the scene's range */                                    \
    COLOR(grid_minor, 0x1B1F26FFu, 0xEFF1F5FFu)                                                                      \
    COLOR(grid_major, 0x262B33FFu, 0xE0E5EBFFu)                                                                      \
    COLOR(zero, 0x3A414CFFu, 0xB9C2CDFFu)                                                                            \
    COLOR(equilibrium, 0x9AA3AFFFu, 0x6B7684FFu)                                                                     \
    COLOR(playhead, 0xF4F1E8FFu, 0x2A313BFFu)

/// Text colours (text, text_dim, accent, warning, error) have a contrast of at least 4.5:1 on panel and raised, `text` and `text_dim` also
/// on fill, hover and stage. `control`, spline colours and other non-text colours have 3:1. tests/draw/test_theme.c lists the pairs.
struct theme {
    const char *name; ///< in settings and on the command line
#define THEME_MEMBER(name, dark, light) uint32_t name;
    THEME_COLORS(THEME_MEMBER)
#undef THEME_MEMBER
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
