/// The editor's picture, in painter's order: rectangles, lines, convex shapes and text, each clipped. No GL.
///
/// Coordinates are logical pixels from the top left; y down. Colours are 0xRRGGBBAA in sRGB.
#ifndef UI_DRAWLIST_H
#define UI_DRAWLIST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rect {
    float x, y, w, h;
};

static inline bool rect_contains(struct rect r, float x, float y)
{
    return x >= r.x && y >= r.y && x < r.x + r.w && y < r.y + r.h;
}

struct rect rect_intersect(struct rect a, struct rect b);
struct rect rect_inset(struct rect r, float by);

enum font { FONT_LABEL, FONT_LABEL_BOLD, FONT_NUMBER, FONT_COUNT }; ///< Inter, Inter semi-bold, JetBrains Mono

enum draw_kind { DRAW_RECT, DRAW_LINE, DRAW_BAND, DRAW_CONVEX, DRAW_TEXT };

struct draw_command {
    enum draw_kind kind;
    uint32_t color;
    float width;   ///< line, band: full width; convex and rect: 0. text: pixel size
    float on, off; ///< line: dashes and gaps along it; both 0 where it is whole
    enum font font;
    float x, y;         ///< text: the pen, at the left end of the baseline
    int first, count;   ///< points (pairs of floats) or bytes of text (a NUL follows) in the list's pools
    struct rect bounds; ///< its bounds, clipped
    struct rect clip;
    uint64_t hash; ///< of everything above and the points or text: equal hash, equal pixels
};

struct drawlist {
    struct draw_command *commands;
    int count, capacity;
    float *points; ///< x, y pairs
    int point_count, point_capacity;
    char *text;
    int text_count, text_capacity;
    struct rect clip; ///< current
    bool overflow;    ///< something did not fit and was left out
};

/// Allocates all memory it will ever use.
void drawlist_create(struct drawlist *list, int commands, int points, int text_bytes);
void drawlist_destroy(struct drawlist *list);
void drawlist_clear(struct drawlist *list, struct rect whole);

/// Intersects the clip with `r`; returns the clip to restore with drawlist_set_clip().
struct rect drawlist_push_clip(struct drawlist *list, struct rect r);
void drawlist_set_clip(struct drawlist *list, struct rect clip);

/// Filled rectangle; fractional edges are anti-aliased.
void drawlist_rect(struct drawlist *list, struct rect r, uint32_t color);
/// Polyline of `count` points with mitred joints (round ones at hairpins), anti-aliased; closed if the last point is the
/// first again. Skipped, like every shape, if a coordinate is not finite.
void drawlist_line(struct drawlist *list, const float *xy, int count, float width, uint32_t color);
/// The same as dashes of `on` and gaps of `off` pixels along the line.
void drawlist_dashed(struct drawlist *list, const float *xy, int count, float width, float on, float off,
                     uint32_t color);
/// What a line covers that goes up and down from point to point, the points a pixel or so apart: all between each point and the next, in
/// one piece, its upper and lower edge anti-aliased. A fraction of the line's cost.
void drawlist_band(struct drawlist *list, const float *xy, int count, float width, uint32_t color);
/// Filled convex polygon (any winding), anti-aliased.
void drawlist_convex(struct drawlist *list, const float *xy, int count, uint32_t color);
/// Filled rounded rectangle, and its outline, which lies inside `r`.
void drawlist_rounded(struct drawlist *list, struct rect r, float radius, uint32_t color);
void drawlist_rounded_line(struct drawlist *list, struct rect r, float radius, float width, uint32_t color);
/// A disc about a point; and a circle, whose outer edge is `radius` away from it.
void drawlist_disc(struct drawlist *list, const float middle[2], float radius, uint32_t color);
void drawlist_circle(struct drawlist *list, const float middle[2], float radius, float width, uint32_t color);
/// UTF-8 text with its baseline at (x, y); x is rounded to device pixels when drawn. `size` in logical pixels.
void drawlist_text(struct drawlist *list, float x, float y, enum font font, float size, uint32_t color,
                   const char *utf8);
/// Text, cut with "…" if it is wider than `width`.
void drawlist_text_fit(struct drawlist *list, float x, float y, float width, enum font font, float size,
                       uint32_t color, const char *utf8);

#endif
