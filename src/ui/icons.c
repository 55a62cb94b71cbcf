/// Small buttons with icons, drawn in a square of 14 pixels around (0, 0), y down.
#include "ui/widgets_internal.h"
#include <math.h>

enum { ARC_POINTS = 9, RING_POINTS = 17 };

static const float THIN = 1.4f;

struct pen {
    struct drawlist *list;
    float x, y;
    uint32_t color;
};

static void stroke(const struct pen *pen, const float *xy, int count)
{
    float moved[2 * RING_POINTS];
    for (int i = 0; i < count; i++) {
        moved[2 * i] = pen->x + xy[2 * i];
        moved[2 * i + 1] = pen->y + xy[2 * i + 1];
    }
    drawlist_line(pen->list, moved, count, THIN, pen->color);
}

static void line(const struct pen *pen, float x0, float y0, float x1, float y1)
{
    stroke(pen, (const float[]){x0, y0, x1, y1}, 2);
}

/// Part of an ellipse, angles in turns, clockwise from the right.
static void arc(const struct pen *pen, struct rect around, float from, float to, int points)
{
    float xy[2 * RING_POINTS];
    for (int i = 0; i < points; i++) {
        float angle = 6.2831853f * (from + (to - from) * (float)i / (float)(points - 1));
        xy[2 * i] = around.x + around.w * cosf(angle);
        xy[2 * i + 1] = around.y + around.h * sinf(angle);
    }
    stroke(pen, xy, points);
}

static void dot(const struct pen *pen, float x, float y, float radius)
{
    struct rect r = {pen->x + x - radius, pen->y + y - radius, 2 * radius, 2 * radius};
    drawlist_rounded(pen->list, r, radius, pen->color);
}

static void ring(const struct pen *pen, float radius)
{
    const float outer = radius + THIN / 2;
    struct rect r = {pen->x - outer, pen->y - outer, 2 * outer, 2 * outer};
    drawlist_rounded_line(pen->list, r, outer, THIN, pen->color);
}

static void draw_add(const struct pen *pen)
{
    line(pen, -5, 0, 5, 0);
    line(pen, 0, -5, 0, 5);
}

static void draw_copy(const struct pen *pen)
{
    stroke(pen, (const float[]){-2, -2, 5, -2, 5, 5, -2, 5, -2, -2}, 5);
    stroke(pen, (const float[]){-2, 2, -5, 2, -5, -5, 2, -5, 2, -2}, 5);
}

/// A bin.
static void draw_delete(const struct pen *pen)
{
    line(pen, -5, -3.5f, 5, -3.5f);
    line(pen, -1.5f, -5.5f, 1.5f, -5.5f);
    stroke(pen, (const float[]){-3.8f, -3.5f, -3.2f, 5, 3.2f, 5, 3.8f, -3.5f}, 4);
    line(pen, 0, -1, 0, 2.5f);
}

static void draw_up(const struct pen *pen) { stroke(pen, (const float[]){-4.5f, 2.5f, 0, -2, 4.5f, 2.5f}, 3); }

static void draw_down(const struct pen *pen) { stroke(pen, (const float[]){-4.5f, -2.5f, 0, 2, 4.5f, -2.5f}, 3); }

static void draw_eye(const struct pen *pen)
{
    arc(pen, (struct rect){0, 3.5f, 7, 7.5f}, 0.57f, 0.93f, ARC_POINTS);
    arc(pen, (struct rect){0, -3.5f, 7, 7.5f}, 0.07f, 0.43f, ARC_POINTS);
    dot(pen, 0, 0, 2);
}

static void draw_eye_closed(const struct pen *pen)
{
    arc(pen, (struct rect){0, -3.5f, 7, 7.5f}, 0.07f, 0.43f, ARC_POINTS);
    line(pen, 0, 4, 0, 6);
    line(pen, -4, 3, -5, 4.8f);
    line(pen, 4, 3, 5, 4.8f);
}

static void draw_solo(const struct pen *pen)
{
    ring(pen, 5.5f);
    dot(pen, 0, 0, 2.2f);
}

/// Two links of a chain.
static void draw_follow(const struct pen *pen)
{
    arc(pen, (struct rect){-3, 0, 3.2f, 3.2f}, 0.08f, 0.92f, RING_POINTS);
    arc(pen, (struct rect){3, 0, 3.2f, 3.2f}, -0.42f, 0.42f, RING_POINTS);
    line(pen, -2.2f, 0, 2.2f, 0);
}

static void draw_unfollow(const struct pen *pen)
{
    draw_follow(pen);
    line(pen, 4.5f, -5.5f, -4.5f, 5.5f);
}

static void draw_pick(const struct pen *pen)
{
    ring(pen, 4);
    dot(pen, 0, 0, 1.2f);
    line(pen, -6.5f, 0, -3, 0);
    line(pen, 3, 0, 6.5f, 0);
    line(pen, 0, -6.5f, 0, -3);
    line(pen, 0, 3, 0, 6.5f);
}

static void draw_ramp(const struct pen *pen)
{
    stroke(pen, (const float[]){-5.5f, 4, -1.5f, 1.5f, 1.5f, -2.5f, 5.5f, -4}, 4);
    dot(pen, -5, 3.7f, 1.8f);
    dot(pen, 5, -3.8f, 1.8f);
}

static void draw_each(const struct pen *pen)
{
    static const float heights[] = {3, 5, 7, 9, 11};
    for (int i = 0; i < 5; i++) line(pen, -5.0f + 2.5f * (float)i, 5.5f, -5.0f + 2.5f * (float)i, 5.5f - heights[i]);
}

bool ui_icon_button(struct ui *ui, struct rect r, const char *name, enum ui_icon icon, bool lit, const char *hint)
{
    static void (*const shapes[])(const struct pen *) = {
        [UI_ICON_ADD] = draw_add,
        [UI_ICON_COPY] = draw_copy,
        [UI_ICON_DELETE] = draw_delete,
        [UI_ICON_UP] = draw_up,
        [UI_ICON_DOWN] = draw_down,
        [UI_ICON_EYE] = draw_eye,
        [UI_ICON_EYE_CLOSED] = draw_eye_closed,
        [UI_ICON_SOLO] = draw_solo,
        [UI_ICON_FOLLOW] = draw_follow,
        [UI_ICON_UNFOLLOW] = draw_unfollow,
        [UI_ICON_PICK] = draw_pick,
        [UI_ICON_RAMP] = draw_ramp,
        [UI_ICON_EACH] = draw_each,
    };
    uint32_t id = ui_id(name);
    ui_register(ui, id, r);
    bool pressed = ui_pressed(ui, r, BUTTON_LEFT) || ui_activated(ui, id);
    bool hot = ui_hovered(ui, r);
    ui_hint(ui, r, hint);
    if (ui->pass == UI_PASS_DRAW) {
        if (hot) drawlist_rounded(ui->list, r, UI_RADIUS, theme()->fill);
        uint32_t color = lit ? theme()->accent : hot || ui->focus == id ? theme()->text : theme()->text_dim;
        struct pen pen = {ui->list, roundf(r.x + r.w / 2), roundf(r.y + r.h / 2), color};
        shapes[icon](&pen);
        ui_focus_ring(ui, id, rect_inset(r, 1));
    }
    return pressed;
}
