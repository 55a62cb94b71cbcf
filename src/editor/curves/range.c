/// The part that is played, on the ruler and in the plot.
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/core/playback.h"
#include "editor/curves/curves.h"
#include "editor/curves/gestures.h"
#include "editor/curves/view.h"
#include "ui/theme.h"
#include <math.h>

/// The part goes from where the drag began to the pointer.
static void move(void *room, struct core *core, const struct editor_world *world)
{
    const double from = round(curves_frame(room, core, core->drag.start_x));
    const double to = round(curves_frame(room, core, core->drag.x));
    playback_choose(core, world->document, fmin(from, to), fmax(from, to));
    playback_say_range(core, world->document);
}

/// A press that did not move plays all again; `keep` false brings the former part back.
static void end(void *room, struct core *core, const struct editor_world *world, bool keep)
{
    struct playback *playback = &core->playback;
    (void)room;
    (void)world;
    if (!keep) {
        playback->has_range = playback->had_range;
        playback->range[0] = playback->old_range[0];
        playback->range[1] = playback->old_range[1];
    } else if (!core->drag.moved) {
        playback->has_range = false;
        core_message(core, false, "Playing the whole scene.");
    }
}

void range_begin(struct curves *curves, struct core *core, const struct event *event)
{
    static const struct drag_owner owner = {.cursor = CURSOR_HORIZONTAL, .move = move, .end = end};
    struct playback *playback = &core->playback;
    drag_begin(core, &owner, curves, NULL, event);
    playback->had_range = playback->has_range;
    playback->old_range[0] = playback->range[0];
    playback->old_range[1] = playback->range[1];
}

/// Where the part lies on the screen.
static void edges(const struct curves *curves, const struct core *core, const struct document *document, float x[2])
{
    const struct rect *plot = &core->layout.plot;
    double range[2];
    playback_range(core, document, range);
    for (int end = 0; end < 2; end++) {
        x[end] = fminf(fmaxf(curves_x(curves, core, range[end]), plot->x), plot->x + plot->w);
    }
}

void range_show_ruler(const struct curves *curves, struct core *core, const struct document *document)
{
    const struct rect *ruler = &core->layout.ruler;
    float x[2];
    if (!playback_is_part(core, document)) return;
    edges(curves, core, document, x);
    struct rect band = {x[0], ruler->y, x[1] - x[0], ruler->h};
    drawlist_rect(&core->list, band, theme_fade(theme()->accent, 0.14f));
    drawlist_rect(&core->list, (struct rect){band.x, ruler->y, 2, ruler->h}, theme()->accent);
    drawlist_rect(&core->list, (struct rect){band.x + band.w - 2, ruler->y, 2, ruler->h}, theme()->accent);
}

void range_show_plot(const struct curves *curves, struct core *core, const struct document *document)
{
    const struct rect *plot = &core->layout.plot;
    float x[2];
    if (!playback_is_part(core, document)) return;
    edges(curves, core, document, x);
    drawlist_rect(&core->list, (struct rect){x[0], plot->y, x[1] - x[0], plot->h},
                  theme_fade(theme()->accent, 0.05f));
}
