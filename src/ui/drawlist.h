/// The editor's picture as draw commands in painter's order, each clipped. No GL. Coordinates are logical pixels from the top left, y down.
/// Colours are 0xRRGGBBAA in sRGB.
#ifndef UI_DRAWLIST_H
#define UI_DRAWLIST_H

#include <stdbool.h>
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
    float on, off; ///< line: dashes and gaps; both 0: solid
    enum font font;
    float x, y;         ///< text: left end of the baseline
    int first, count;   ///< points (x, y) or bytes of text (with a NUL after) in the list's pools
    struct rect bounds; ///< clipped
    struct rect clip;
    uint64_t hash; ///< of everything above and the points or text: equal hashes mean equal pixels
};

struct drawlist {
    struct draw_command *commands;
    int count, capacity;
    float *points; ///< x, y pairs
    int point_count, point_capacity;
    char *text;
    int text_count, text_capacity;
    struct rect clip;
    bool overflow; ///< something did not fit
};

/// Allocates all the memory the list will use.
void drawlist_create(struct drawlist *list, int commands, int points, int text_bytes);
void drawlist_destroy(struct drawlist *list);
void drawlist_clear(struct drawlist *list, struct rect whole);

/// Intersects the clip with `r`; returns the old clip for drawlist_set_clip().
struct rect drawlist_push_clip(struct drawlist *list, struct rect r);
void drawlist_set_clip(struct drawlist *list, struct rect clip);

/// Filled; fractional edges are anti-aliased.
void drawlist_rect(struct drawlist *list, struct rect r, uint32_t color);
/// Anti-aliased polyline with mitred joints (round at hairpins); closed if the last point equals the first. Like every shape, it is left
/// out if a coordinate is not finite.
void drawlist_line(struct drawlist *list, const float *xy, int count, float width, uint32_t color);
/// With dashes of `on` and gaps of `off` pixels.
void drawlist_dashed(struct drawlist *list, const float *xy, int count, float width, float on, float off,
                     uint32_t color);
/// A line through points about a pixel apart that goes up and down between them, as one area with anti-aliased edges. Much cheaper than the
/// line.
void drawlist_band(struct drawlist *list, const float *xy, int count, float width, uint32_t color);
/// Filled convex polygon (any winding), anti-aliased.
void drawlist_convex(struct drawlist *list, const float *xy, int count, uint32_t color);
/// Filled rounded rectangle; the second draws its outline, inside `r`.
void drawlist_rounded(struct drawlist *list, struct rect r, float radius, uint32_t color);
void drawlist_rounded_line(struct drawlist *list, struct rect r, float radius, float width, uint32_t color);
/// A disc; a circle whose outer edge is `radius` away.
void drawlist_disc(struct drawlist *list, const float middle[2], float radius, uint32_t color);
void drawlist_circle(struct drawlist *list, const float middle[2], float radius, float width, uint32_t color);
/// UTF-8 text with its baseline at (x, y); drawing rounds x to device pixels. `size` in logical pixels.
void drawlist_text(struct drawlist *list, float x, float y, enum font font, float size, uint32_t color,
                   const char *utf8);
/// Cut with "…" if wider than `width`.
void drawlist_text_fit(struct drawlist *list, float x, float y, float width, enum font font, float size,
                       uint32_t color, const char *utf8);

#endif
