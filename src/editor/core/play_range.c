/// The part of the scene that is played: chosen on the ruler or with the playhead, never saved.
#include "editor/core/play_range.h"
#include "editor/core/core.h"
#include "editor/core/state.h"
#include <math.h>
#include <stdio.h>

void playback_range(const struct core *core, const struct document *document, double range[2])
{
    const struct playback *playback = &core->playback;
    range[0] = document->first_frame;
    range[1] = document->last_frame;
    if (!playback->has_range) return;
    double first = fmax(playback->range[0], range[0]), last = fmin(playback->range[1], range[1]);
    if (first >= last) return; // nothing of it is left in the scene
    range[0] = first;
    range[1] = last;
}

bool playback_is_part(const struct core *core, const struct document *document)
{
    double range[2];
    playback_range(core, document, range);
    return range[0] > document->first_frame || range[1] < document->last_frame;
}

/// Sets the part; one that is empty or holds everything is none.
void playback_choose(struct core *core, const struct document *document, double first, double last)
{
    struct playback *playback = &core->playback;
    first = fmax(first, document->first_frame);
    last = fmin(last, document->last_frame);
    playback->has_range = first < last && (first > document->first_frame || last < document->last_frame);
    playback->range[0] = first;
    playback->range[1] = last;
}

void playback_say_range(struct core *core, const struct document *document)
{
    char text[96];
    double range[2];
    playback_range(core, document, range);
    bool part = playback_is_part(core, document);
    snprintf(text, sizeof text, part ? "Playing frames %.0f to %.0f." : "Playing the whole scene.", range[0],
             range[1]);
    core_message(core, false, text);
}

void playback_mark(struct core *core, const struct editor_world *world, int end)
{
    const struct document *document = world->document;
    double range[2], frame = round(core_frame(core, document));
    playback_range(core, document, range);
    range[end] = frame;
    if (range[0] >= range[1]) range[1 - end] = end ? document->first_frame : document->last_frame;
    playback_choose(core, document, range[0], range[1]);
    playback_say_range(core, document);
}
