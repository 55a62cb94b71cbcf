/// What is drawn while knots are scaled: what they are scaled about, and beside the pointer by how much.
#include "editor/curves/curves.h"
#include "editor/curves/gestures.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

enum { PAD = 8, LINE = 16, MARGIN = 4, MOST_LINES = 4 };

static const float BESIDE = 16, BELOW = 20; ///< of the pointer

/// The words beside the pointer.
struct tag {
    int count;
    struct {
        char text[STOPPED_SIZE];
        bool is_stop;
    } line[MOST_LINES];
};

/// A factor, and on a line of its own what stopped it.
static void add_factor(struct tag *tag, const char *what, double factor, const char *stopped)
{
    snprintf(tag->line[tag->count++].text, sizeof tag->line[0].text, "%s × %.3g", what, factor);
    if (!*stopped) return;
    tag->line[tag->count].is_stop = true;
    snprintf(tag->line[tag->count++].text, sizeof tag->line[0].text, "%s", stopped);
}

/// Beside the pointer, inside the panel.
static void show_tag(struct core *core, const struct tag *tag)
{
    const struct rect panel = core->layout.curves;
    float width = 0;
    for (int i = 0; i < tag->count; i++)
        width = fmaxf(width, ceilf(font_width(FONT_LABEL, THEME_TEXT_SMALL, tag->line[i].text)));
    const float w = width + 2 * PAD, h = (float)(tag->count * LINE + PAD);
    const float right = panel.x + panel.w - MARGIN - w, bottom = panel.y + panel.h - MARGIN - h;
    const struct rect box = {roundf(fmaxf(panel.x + MARGIN, fminf(core->drag.x + BESIDE, right))),
                             roundf(core->drag.y + BELOW <= bottom ? core->drag.y + BELOW : core->drag.y - BELOW - h),
                             w, h};
    drawlist_rounded(&core->list, box, 4, theme()->raised);
    drawlist_rounded_line(&core->list, box, 4, 1, theme()->control);
    for (int i = 0; i < tag->count; i++)
        drawlist_text(&core->list, box.x + PAD, box.y + (float)((i + 1) * LINE), FONT_LABEL, THEME_TEXT_SMALL,
                      tag->line[i].is_stop ? theme()->warning : theme()->text, tag->line[i].text);
}

static void show_pivot(const struct curves *curves, struct core *core)
{
    const struct scaling *scaling = &curves->scaling;
    const float x = curves_x(curves, core, scaling->frame), y = curves_y(curves, core, scaling->value), arm = 7;
    const float across[] = {x - arm, y, x + arm, y}, down[] = {x, y - arm, x, y + arm};
    const float line[] = {x, y, core->drag.x, core->drag.y};
    const bool pointed = scaling->handle < 0 && !scaling->typed[0];
    if (pointed) drawlist_dashed(&core->list, line, 2, 1, 3, 4, theme_fade(theme()->playhead, 0.5f));
    if (!core->drag.lock_y) drawlist_line(&core->list, across, 2, 1.5f, theme()->playhead);
    if (!core->drag.lock_x) drawlist_line(&core->list, down, 2, 1.5f, theme()->playhead);
}

void scale_show(void *room, struct core *core, const struct editor_world *world)
{
    const struct curves *curves = room;
    const struct scaling *scaling = &curves->scaling;
    struct tag tag = {0};
    const struct rect clip = drawlist_push_clip(&core->list, core->layout.plot);
    scale_box_show(curves, core, world->document, true);
    show_pivot(curves, core);
    drawlist_set_clip(&core->list, clip);
    if (!core->drag.lock_y) add_factor(&tag, "time", scaling->by.time, scaling->stopped[0]);
    if (!core->drag.lock_x) add_factor(&tag, "value", scaling->by.value, scaling->stopped[1]);
    show_tag(core, &tag);
}
