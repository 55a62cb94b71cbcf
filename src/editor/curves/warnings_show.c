/// The markers of warnings in the curves panel, and their words.
#include "editor/curves/curves.h"
#include "editor/curves/warnings.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

static const float SIZE = 7, LIFT = 16, EDGE = 12; ///< half a marker; above its place; from the plot's border

bool warning_place(const struct curves *curves, const struct core *core, const struct warning *warning, float xy[2])
{
    const struct rect plot = core->layout.plot;
    xy[0] = plot.x + EDGE;
    xy[1] = plot.y + EDGE;
    if (warning->kind == WARNING_RATE) return true;
    xy[0] = curves_x(curves, core, warning->frame);
    xy[1] = fminf(fmaxf(curves_y(curves, core, warning->value) - LIFT, plot.y + EDGE), plot.y + plot.h - EDGE);
    return xy[0] >= plot.x && xy[0] <= plot.x + plot.w;
}

bool curves_warning(const struct curves *curves, const struct core *core, double number, float xy[2])
{
    bool there = number >= 0 && number < curves->warnings.count;
    return there && warning_place(curves, core, &curves->warnings.list[(int)number], xy);
}

/// What is wrong, and what a click does about it.
static void put_words(const struct warning *warning, char what[160], char remedy[96])
{
    switch (warning->kind) {
    case WARNING_SWING:
        snprintf(what, 160, "Frames %.6g to %.6g: the curve swings %.1f times as far as its knots.", warning->from,
                 warning->to, warning->amount);
        snprintf(remedy, 96, "Click to tame it with more calm, a knot at the peak or a lower frequency.");
        break;
    case WARNING_RATE:
        snprintf(what, 160, "%.3g Hz is too close to half the sample rate to keep its shape (the limit is %.3g Hz).",
                 warning->amount, warning->limit);
        snprintf(remedy, 96, "Click to use %.0f substeps per frame.", warning->remedy);
        break;
    case WARNING_DRIFT:
        snprintf(what, 160,
                 "Bandwidth %.3g is too wide for the %.1f periods between frames %.6g and %.6g: the swing drifts out "
                 "of phase.",
                 warning->limit, warning->amount, warning->from, warning->to);
        snprintf(remedy, 96, "Click to narrow it to %.3g.", warning->remedy);
        break;
    case WARNING_SLOPE:
        snprintf(what, 160, "Frame %.6g: the slope has no effect, as both samples beside it have knots.",
                 warning->frame);
        snprintf(remedy, 96, "Click to switch it off.");
        break;
    }
}

/// The warning under the pointer, or NULL.
static const struct warning *hovered_warning(const struct curves *curves, const struct core *core)
{
    int index = core->hover.handle;
    if (core->hover.kind != HOVER_WARNING || index >= curves->warnings.count) return NULL;
    return &curves->warnings.list[index];
}

static void show_marker(struct drawlist *list, const float xy[2], bool hovered)
{
    const float x = xy[0], y = xy[1], r = hovered ? SIZE + 1.5f : SIZE;
    const float corners[] = {x, y - r, x + r, y + 0.8f * r, x - r, y + 0.8f * r};
    drawlist_convex(list, corners, 3, theme()->warning);
    drawlist_rect(list, (struct rect){x - 0.75f, y - 0.4f * r, 1.5f, 0.6f * r}, theme()->panel);
    drawlist_rect(list, (struct rect){x - 0.75f, y + 0.38f * r, 1.5f, 1.5f}, theme()->panel);
}

void warnings_show(const struct curves *curves, struct core *core)
{
    const struct warning *hovered = hovered_warning(curves, core);
    for (int i = 0; i < curves->warnings.count; i++) {
        float xy[2];
        const struct warning *warning = &curves->warnings.list[i];
        if (warning_place(curves, core, warning, xy)) show_marker(&core->list, xy, warning == hovered);
    }
}

void warnings_show_words(const struct curves *curves, struct core *core)
{
    enum { PAD = 10, LINE = 18 };
    const struct warning *warning = hovered_warning(curves, core);
    float xy[2];
    if (!warning || !warning_place(curves, core, warning, xy)) return;
    char what[160], remedy[96];
    put_words(warning, what, remedy);
    const struct rect panel = core->layout.curves;
    float width =
        fmaxf(font_width(FONT_LABEL, THEME_TEXT_NORMAL, what), font_width(FONT_LABEL, THEME_TEXT_NORMAL, remedy));
    float w = fminf(width + 2 * PAD, panel.w - 16), h = 2 * LINE + PAD;
    float x = fminf(fmaxf(xy[0] - w / 2, panel.x + 8), panel.x + panel.w - 8 - w);
    float y = xy[1] + 14 + h < panel.y + panel.h ? xy[1] + 14 : xy[1] - 14 - h;
    struct rect box = {roundf(x), roundf(y), w, h};
    drawlist_rounded(&core->list, box, 5, theme()->raised);
    drawlist_rounded_line(&core->list, box, 5, 1, theme_fade(theme()->warning, 0.6f));
    drawlist_text_fit(&core->list, box.x + PAD, box.y + LINE, w - 2 * PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->text, what);
    drawlist_text_fit(&core->list, box.x + PAD, box.y + 2 * LINE, w - 2 * PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->warning, remedy);
}
