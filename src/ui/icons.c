/// Icon buttons. Icons are drawn in 14 × 14 pixels around (0, 0), y down.
#include "maths/maths.h"
#include "ui/widgets_internal.h"
#include <math.h>

enum { MAX_POINTS = 17 };

static const float THIN = 1.4f;

/// A line through points; an arc: middle, radii, start and end in turns clockwise from the right; a disc or ring: middle and radius.
enum shape { LINE, ARC, DOT, RING };

static const struct part {
    enum ui_icon icon;
    enum shape shape;
    int count;    ///< points of a line or arc
    float at[10]; ///< coordinates
} parts[] = {
    {UI_ICON_ADD, LINE, 2, {-5, 0, 5, 0}},
    {UI_ICON_ADD, LINE, 2, {0, -5, 0, 5}},
    {UI_ICON_COPY, LINE, 5, {-2, -2, 5, -2, 5, 5, -2, 5, -2, -2}},
    {UI_ICON_COPY, LINE, 5, {-2, 2, -5, 2, -5, -5, 2, -5, 2, -2}},
    {UI_ICON_DELETE, LINE, 2, {-5, -3.5f, 5, -3.5f}}, // a bin
    {UI_ICON_DELETE, LINE, 2, {-1.5f, -5.5f, 1.5f, -5.5f}},
    {UI_ICON_DELETE, LINE, 4, {-3.8f, -3.5f, -3.2f, 5, 3.2f, 5, 3.8f, -3.5f}},
    {UI_ICON_DELETE, LINE, 2, {0, -1, 0, 2.5f}},
    {UI_ICON_UP, LINE, 3, {-4.5f, 2.5f, 0, -2, 4.5f, 2.5f}},
    {UI_ICON_DOWN, LINE, 3, {-4.5f, -2.5f, 0, 2, 4.5f, -2.5f}},
    {UI_ICON_EYE, ARC, 9, {0, 3.5f, 7, 7.5f, 0.57f, 0.93f}},
    {UI_ICON_EYE, ARC, 9, {0, -3.5f, 7, 7.5f, 0.07f, 0.43f}},
    {UI_ICON_EYE, DOT, 0, {0, 0, 2}},
    {UI_ICON_EYE_CLOSED, ARC, 9, {0, -3.5f, 7, 7.5f, 0.07f, 0.43f}},
    {UI_ICON_EYE_CLOSED, LINE, 2, {0, 4, 0, 6}},
    {UI_ICON_EYE_CLOSED, LINE, 2, {-4, 3, -5, 4.8f}},
    {UI_ICON_EYE_CLOSED, LINE, 2, {4, 3, 5, 4.8f}},
    {UI_ICON_SOLO, RING, 0, {0, 0, 5.5f}},
    {UI_ICON_SOLO, DOT, 0, {0, 0, 2.2f}},
    {UI_ICON_FOLLOW, ARC, 17, {-3, 0, 3.2f, 3.2f, 0.08f, 0.92f}}, // two links of a chain
    {UI_ICON_FOLLOW, ARC, 17, {3, 0, 3.2f, 3.2f, -0.42f, 0.42f}},
    {UI_ICON_FOLLOW, LINE, 2, {-2.2f, 0, 2.2f, 0}},
    {UI_ICON_UNFOLLOW, ARC, 17, {-3, 0, 3.2f, 3.2f, 0.08f, 0.92f}},
    {UI_ICON_UNFOLLOW, ARC, 17, {3, 0, 3.2f, 3.2f, -0.42f, 0.42f}},
    {UI_ICON_UNFOLLOW, LINE, 2, {-2.2f, 0, 2.2f, 0}},
    {UI_ICON_UNFOLLOW, LINE, 2, {4.5f, -5.5f, -4.5f, 5.5f}},
    {UI_ICON_PICK, RING, 0, {0, 0, 4}},
    {UI_ICON_PICK, DOT, 0, {0, 0, 1.2f}},
    {UI_ICON_PICK, LINE, 2, {-6.5f, 0, -3, 0}},
    {UI_ICON_PICK, LINE, 2, {3, 0, 6.5f, 0}},
    {UI_ICON_PICK, LINE, 2, {0, -6.5f, 0, -3}},
    {UI_ICON_PICK, LINE, 2, {0, 3, 0, 6.5f}},
    {UI_ICON_RAMP, LINE, 4, {-5.5f, 4, -1.5f, 1.5f, 1.5f, -2.5f, 5.5f, -4}},
    {UI_ICON_RAMP, DOT, 0, {-5, 3.7f, 1.8f}},
    {UI_ICON_RAMP, DOT, 0, {5, -3.8f, 1.8f}},
    {UI_ICON_EACH, LINE, 2, {-5, 5.5f, -5, 2.5f}},
    {UI_ICON_EACH, LINE, 2, {-2.5f, 5.5f, -2.5f, 0.5f}},
    {UI_ICON_EACH, LINE, 2, {0, 5.5f, 0, -1.5f}},
    {UI_ICON_EACH, LINE, 2, {2.5f, 5.5f, 2.5f, -3.5f}},
    {UI_ICON_EACH, LINE, 2, {5, 5.5f, 5, -5.5f}},
};

static void draw_part(struct drawlist *list, const struct part *part, float x, float y, uint32_t color)
{
    const float *at = part->at;
    float xy[2 * MAX_POINTS];
    if (part->shape == DOT || part->shape == RING) {
        const float radius = at[2] + (part->shape == RING ? THIN / 2 : 0);
        const struct rect r = {x + at[0] - radius, y + at[1] - radius, 2 * radius, 2 * radius};
        if (part->shape == DOT) drawlist_rounded(list, r, radius, color);
        if (part->shape == RING) drawlist_rounded_line(list, r, radius, THIN, color);
        return;
    }
    for (int i = 0; i < part->count; i++) {
        const float angle = 6.2831853f * (at[4] + (at[5] - at[4]) * (float)i / (float)(part->count - 1));
        const bool is_arc = part->shape == ARC;
        xy[2 * i] = x + (is_arc ? at[0] + at[2] * maths_cosf(angle) : at[2 * i]);
        xy[2 * i + 1] = y + (is_arc ? at[1] + at[3] * maths_sinf(angle) : at[2 * i + 1]);
    }
    drawlist_line(list, xy, part->count, THIN, color);
}

bool ui_icon_button(struct ui *ui, struct rect r, const char *name, enum ui_icon icon, bool lit, const char *hint)
{
    uint32_t id = ui_id(ui, name);
    bool pressed = ui_clicked(ui, id, r);
    bool hot = ui_hovered(ui, r);
    ui_hint(ui, r, hint);
    if (ui->pass == UI_PASS_DRAW) {
        if (hot) drawlist_rounded(ui->list, r, UI_RADIUS, theme()->fill);
        uint32_t color = lit ? theme()->accent : hot || ui->focus == id ? theme()->text : theme()->text_dim;
        for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
            if (parts[i].icon == icon)
                draw_part(ui->list, &parts[i], roundf(r.x + r.w / 2), roundf(r.y + r.h / 2), color);
        ui_focus_ring(ui, id, rect_inset(r, 1));
    }
    return pressed;
}
