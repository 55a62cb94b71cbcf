/// Records draw commands, and computes with rectangles.
#include "ui/drawlist.h"
#include "base/hash.h"
#include "base/need.h"
#include "maths/maths.h"
#include "ui/font.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void drawlist_create(struct drawlist *list, int commands, int points, int text_bytes)
{
    *list = (struct drawlist){
        .commands = need_zeroed((size_t)commands, sizeof *list->commands),
        .capacity = commands,
        .points = need_zeroed((size_t)points * 2, sizeof *list->points),
        .point_capacity = points,
        .text = need_zeroed((size_t)text_bytes, 1),
        .text_capacity = text_bytes,
    };
}

void drawlist_destroy(struct drawlist *list)
{
    free(list->commands);
    free(list->points);
    free(list->text);
    *list = (struct drawlist){0};
}

void drawlist_clear(struct drawlist *list, struct rect whole)
{
    list->count = list->point_count = list->text_count = 0;
    list->overflow = false;
    list->clip = whole;
}

struct rect drawlist_push_clip(struct drawlist *list, struct rect r)
{
    struct rect before = list->clip;
    list->clip = rect_intersect(before, r);
    return before;
}

void drawlist_set_clip(struct drawlist *list, struct rect clip) { list->clip = clip; }

/// Appends a command with pixels in `bounds` and its points or text (with a NUL), unless nothing would be visible or the list is full.
static void add(struct drawlist *list, struct draw_command command, struct rect bounds, const void *data)
{
    const bool finite = isfinite(bounds.x) && isfinite(bounds.y) && isfinite(bounds.w) && isfinite(bounds.h);
    const bool is_text = command.kind == DRAW_TEXT;
    const struct rect clip = list->clip, visible = rect_intersect(bounds, clip);
    if (!finite || visible.w <= 0.0f || visible.h <= 0.0f || (command.color & 0xFFu) == 0) return;
    const int room = is_text ? list->text_capacity - list->text_count - 1 : list->point_capacity - list->point_count;
    if (list->count == list->capacity || command.count > room) {
        list->overflow = true;
        return;
    }
    const size_t bytes = (size_t)command.count * (is_text ? 1 : 2 * sizeof *list->points);
    if (is_text) {
        command.first = list->text_count;
        memcpy(list->text + command.first, data, bytes + 1);
        list->text_count += command.count + 1;
    } else {
        command.first = list->point_count;
        memcpy(list->points + 2 * (size_t)command.first, data, bytes);
        list->point_count += command.count;
    }
    const float numbers[] = {command.width, command.x, command.y, command.on, command.off,
                             clip.x,        clip.y,    clip.w,    clip.h};
    const uint64_t words = (uint64_t)command.kind << 40 | (uint64_t)command.font << 32 | command.color;
    command.hash = hash_bytes(hash_bytes(hash_word(HASH_START, words), numbers, sizeof numbers), data, bytes);
    command.bounds = visible;
    command.clip = clip;
    list->commands[list->count++] = command;
}

static struct rect bounds_of(const float *xy, int count, float margin)
{
    float x0 = xy[0], y0 = xy[1], x1 = x0, y1 = y0, sum = 0.0f;
    for (int i = 0; i < count; i++) {
        const float x = xy[2 * i], y = xy[2 * i + 1];
        x0 = x < x0 ? x : x0;
        x1 = x > x1 ? x : x1;
        y0 = y < y0 ? y : y0;
        y1 = y > y1 ? y : y1;
        sum += (x + y) * 0.0f;
    }
    // 0 · x is NaN if x is not finite; comparisons would miss a NaN.
    return (struct rect){x0 - margin + sum, y0 - margin, x1 - x0 + 2.0f * margin, y1 - y0 + 2.0f * margin};
}

void drawlist_rect(struct drawlist *list, struct rect r, uint32_t color)
{
    const struct draw_command command = {.kind = DRAW_RECT, .color = color, .count = 2};
    if (r.w > 0.0f && r.h > 0.0f) add(list, command, r, (const float[]){r.x, r.y, r.x + r.w, r.y + r.h});
}

void drawlist_dashed(struct drawlist *list, const float *xy, int count, float width, float on, float off,
                     uint32_t color)
{
    if (count < 2 || !(width > 0.0f)) return;
    const struct draw_command command = {
        .kind = DRAW_LINE, .color = color, .width = width, .on = on, .off = off, .count = count};
    // A mitre reaches twice the half-width, anti-aliasing one pixel more.
    add(list, command, bounds_of(xy, count, width + 1.0f), xy);
}

void drawlist_line(struct drawlist *list, const float *xy, int count, float width, uint32_t color)
{
    drawlist_dashed(list, xy, count, width, 0.0f, 0.0f, color);
}

void drawlist_band(struct drawlist *list, const float *xy, int count, float width, uint32_t color)
{
    const struct draw_command command = {.kind = DRAW_BAND, .color = color, .width = width, .count = count};
    if (count >= 3 && width > 0.0f) add(list, command, bounds_of(xy, count, 0.5f * width + 1.0f), xy);
}

void drawlist_convex(struct drawlist *list, const float *xy, int count, uint32_t color)
{
    const struct draw_command command = {.kind = DRAW_CONVEX, .color = color, .count = count};
    if (count >= 3) add(list, command, bounds_of(xy, count, 1.0f), xy);
}

enum { CORNER_MAX = 9 };

/// The outline, clockwise from the top left; returns the number of points (at most 4 · CORNER_MAX).
static int rounded_outline(struct rect r, float radius, float *xy)
{
    float limit = 0.5f * fminf(r.w, r.h);
    float used = fminf(fmaxf(radius, 0.0f), limit);
    int steps = used <= 0.0f ? 1 : (int)fminf(3.0f + used / 2.0f, (float)CORNER_MAX);
    const float center_x[4] = {r.x + used, r.x + r.w - used, r.x + r.w - used, r.x + used};
    const float center_y[4] = {r.y + used, r.y + used, r.y + r.h - used, r.y + r.h - used};
    int count = 0;
    for (int corner = 0; corner < 4; corner++) {
        for (int i = 0; i < steps; i++) {
            float turn = (float)corner + (steps > 1 ? (float)i / (float)(steps - 1) : 0.5f);
            float angle = (turn - 2.0f) * (float)M_PI_2;
            xy[2 * count] = center_x[corner] + used * maths_cosf(angle);
            xy[2 * count + 1] = center_y[corner] + used * maths_sinf(angle);
            count++;
        }
    }
    return count;
}

void drawlist_rounded(struct drawlist *list, struct rect r, float radius, uint32_t color)
{
    float xy[8 * CORNER_MAX];
    if (r.w <= 0.0f || r.h <= 0.0f) return;
    drawlist_convex(list, xy, rounded_outline(r, radius, xy), color);
}

void drawlist_rounded_line(struct drawlist *list, struct rect r, float radius, float width, uint32_t color)
{
    float xy[8 * CORNER_MAX + 2];
    struct rect middle = rect_inset(r, 0.5f * width);
    if (middle.w <= 0.0f || middle.h <= 0.0f) return;
    int count = rounded_outline(middle, radius - 0.5f * width, xy);
    xy[2 * count] = xy[0];
    xy[2 * count + 1] = xy[1];
    drawlist_line(list, xy, count + 1, width, color);
}

static struct rect around(const float middle[2], float radius)
{
    return (struct rect){middle[0] - radius, middle[1] - radius, 2 * radius, 2 * radius};
}

void drawlist_disc(struct drawlist *list, const float middle[2], float radius, uint32_t color)
{
    drawlist_rounded(list, around(middle, radius), radius, color);
}

void drawlist_circle(struct drawlist *list, const float middle[2], float radius, float width, uint32_t color)
{
    drawlist_rounded_line(list, around(middle, radius), radius, width, color);
}

void drawlist_text(struct drawlist *list, float x, float y, enum font font, float size, uint32_t color,
                   const char *utf8)
{
    // Glyphs and rounding to device pixels reach beyond the advance widths.
    const float width = font_width(font, size, utf8);
    const struct rect bounds = {x - 0.3f * size - 1.0f, y - 1.3f * size, width + 0.6f * size + 2.0f, 1.8f * size};
    const int count = (int)strlen(utf8);
    const struct draw_command command = {
        .kind = DRAW_TEXT, .color = color, .width = size, .font = font, .x = x, .y = y, .count = count};
    if (count > 0) add(list, command, bounds, utf8);
}

void drawlist_text_fit(struct drawlist *list, float x, float y, float width, enum font font, float size,
                       uint32_t color, const char *utf8)
{
    static const char ellipsis[] = "…";
    if (font_width(font, size, utf8) <= width) {
        drawlist_text(list, x, y, font, size, color, utf8);
        return;
    }
    char cut[256];
    float used = 0.0f;
    const float room = width - font_width(font, size, ellipsis);
    size_t length = 0;
    for (const char *next = utf8; utf8_next(&next) != 0; length = (size_t)(next - utf8)) { // the longest prefix
        char letter[5] = "";
        memcpy(letter, utf8 + length, (size_t)(next - utf8) - length);
        used += font_width(font, size, letter);
        if (used > room || (size_t)(next - utf8) > sizeof cut - sizeof ellipsis) break;
    }
    while (length > 0 && utf8[length - 1] == ' ') length--;
    memcpy(cut, utf8, length);
    memcpy(cut + length, ellipsis, sizeof ellipsis);
    drawlist_text(list, x, y, font, size, color, cut);
}

struct rect rect_intersect(struct rect a, struct rect b)
{
    float x = fmaxf(a.x, b.x), y = fmaxf(a.y, b.y);
    float w = fminf(a.x + a.w, b.x + b.w) - x, h = fminf(a.y + a.h, b.y + b.h) - y;
    return (struct rect){x, y, fmaxf(w, 0.0f), fmaxf(h, 0.0f)};
}

struct rect rect_inset(struct rect r, float by)
{
    return (struct rect){r.x + by, r.y + by, fmaxf(r.w - 2.0f * by, 0.0f), fmaxf(r.h - 2.0f * by, 0.0f)};
}
