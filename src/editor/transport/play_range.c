/// The part of the scene that is played: chosen on the ruler or with the playhead, never saved.
#include "editor/core/actions.h"
#include "editor/curves/curves.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

void playback_range(const struct editor *editor, const struct document *document, double range[2])
{
    const struct playback *playback = &editor->playback;
    range[0] = document->first_frame;
    range[1] = document->last_frame;
    if (!playback->has_range) return;
    double first = fmax(playback->range[0], range[0]), last = fmin(playback->range[1], range[1]);
    if (first >= last) return; // nothing of it is left in the scene
    range[0] = first;
    range[1] = last;
}

static bool is_part(const struct editor *editor, const struct document *document)
{
    double range[2];
    playback_range(editor, document, range);
    return range[0] > document->first_frame || range[1] < document->last_frame;
}

/// Sets the part; one that is empty or holds everything is none.
static void choose(struct editor *editor, const struct document *document, double first, double last)
{
    struct playback *playback = &editor->playback;
    first = fmax(first, document->first_frame);
    last = fmin(last, document->last_frame);
    playback->has_range = first < last && (first > document->first_frame || last < document->last_frame);
    playback->range[0] = first;
    playback->range[1] = last;
}

static void say(struct editor *editor, const struct document *document)
{
    char text[96];
    double range[2];
    playback_range(editor, document, range);
    bool part = is_part(editor, document);
    snprintf(text, sizeof text, part ? "Playing frames %.0f to %.0f." : "Playing the whole scene.", range[0],
             range[1]);
    editor_message(editor, false, text);
}

void range_mark(struct editor *editor, const struct editor_world *world, int end)
{
    const struct document *document = world->document;
    double range[2], frame = round(editor_frame(editor, document));
    playback_range(editor, document, range);
    range[end] = frame;
    if (range[0] >= range[1]) range[1 - end] = end ? document->first_frame : document->last_frame;
    choose(editor, document, range[0], range[1]);
    say(editor, document);
}

void range_begin(struct editor *editor, const struct event *event)
{
    struct playback *playback = &editor->playback;
    drag_begin(editor, DRAG_RANGE, event);
    playback->had_range = playback->has_range;
    playback->old_range[0] = playback->range[0];
    playback->old_range[1] = playback->range[1];
}

void range_drag(struct editor *editor, const struct document *document, float x)
{
    double from = round(curves_frame(editor, editor->drag.start_x)), to = round(curves_frame(editor, x));
    choose(editor, document, fmin(from, to), fmax(from, to));
    say(editor, document);
}

void range_end(struct editor *editor, bool keep)
{
    struct playback *playback = &editor->playback;
    if (!keep) {
        playback->has_range = playback->had_range;
        playback->range[0] = playback->old_range[0];
        playback->range[1] = playback->old_range[1];
    } else if (!editor->drag.moved) {
        playback->has_range = false;
        editor_message(editor, false, "Playing the whole scene.");
    }
}

/// Where the part lies on the screen.
static void edges(const struct editor *editor, const struct document *document, float x[2])
{
    const struct rect *plot = &editor->layout.plot;
    double range[2];
    playback_range(editor, document, range);
    for (int end = 0; end < 2; end++) {
        x[end] = fminf(fmaxf(curves_x(editor, range[end]), plot->x), plot->x + plot->w);
    }
}

void range_show_ruler(struct editor *editor, const struct document *document)
{
    const struct rect *ruler = &editor->layout.ruler;
    float x[2];
    if (!is_part(editor, document)) return;
    edges(editor, document, x);
    struct rect band = {x[0], ruler->y, x[1] - x[0], ruler->h};
    drawlist_rect(&editor->list, band, theme_fade(theme()->accent, 0.14f));
    drawlist_rect(&editor->list, (struct rect){band.x, ruler->y, 2, ruler->h}, theme()->accent);
    drawlist_rect(&editor->list, (struct rect){band.x + band.w - 2, ruler->y, 2, ruler->h}, theme()->accent);
}

void range_show_plot(struct editor *editor, const struct document *document)
{
    const struct rect *plot = &editor->layout.plot;
    float x[2];
    if (!is_part(editor, document)) return;
    edges(editor, document, x);
    drawlist_rect(&editor->list, (struct rect){x[0], plot->y, x[1] - x[0], plot->h},
                  theme_fade(theme()->accent, 0.05f));
}
