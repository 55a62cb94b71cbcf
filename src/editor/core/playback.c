/// Playback: playing, stepping, scrubbing, and the played range, which is never saved. The position is in samples, fractional.
#include "editor/core/core.h"
#include <math.h>

void playback_range(const struct core *core, double range[2])
{
    const struct document *document = core->document;
    const double *part = core->playback.range;
    range[0] = fmax(part[0], document->first_frame);
    range[1] = fmin(part[1], document->last_frame);
    if (range[0] < range[1]) return;
    range[0] = document->first_frame; // the range lies outside the scene
    range[1] = document->last_frame;
}

bool playback_is_part(const struct core *core)
{
    double range[2];
    playback_range(core, range);
    return range[0] > core->document->first_frame || range[1] < core->document->last_frame;
}

void playback_choose(struct core *core, double first, double last)
{
    double *range = core->playback.range;
    range[0] = first;
    range[1] = last;
    if (first < last && playback_is_part(core)) return;
    range[0] = -INFINITY;
    range[1] = INFINITY;
}

void playback_say_range(struct core *core)
{
    double range[2];
    playback_range(core, range);
    bool part = playback_is_part(core);
    core_message(core, false, part ? "Playing frames %.0f to %.0f." : "Playing the whole scene.", range[0], range[1]);
}

void playback_mark(struct core *core, int end)
{
    const struct document *document = core->document;
    double range[2], frame = round(core_frame(core));
    playback_range(core, range);
    range[end] = frame;
    if (range[0] >= range[1]) range[1 - end] = end ? document->first_frame : document->last_frame;
    playback_choose(core, range[0], range[1]);
    playback_say_range(core);
}

static const double REFRESH = 60; ///< frames per second a display shows at least

static const double speeds[] = {0.1, 0.25, 0.5, 1, 2, 4};

enum { SPEEDS = sizeof speeds / sizeof speeds[0] };

static double last_position(const struct document *document) { return fmax(document_samples(document) - 1, 0); }

static void go_to(struct core *core, double position)
{
    core->playback.position = fmin(fmax(position, 0), last_position(core->document));
}

/// The played range in samples.
static void range_positions(const struct core *core, double range[2])
{
    playback_range(core, range);
    for (int end = 0; end < 2; end++) range[end] = core_position(core->document, range[end]);
}

void playback_toggle(struct core *core)
{
    struct playback *playback = &core->playback;
    double range[2];
    playback->playing = !playback->playing;
    if (!playback->playing) return;
    range_positions(core, range);
    playback->dropped = 0;
    bool at_end = !playback->looping && playback->position >= range[1];
    if (at_end || playback->position < range[0] || playback->position > range[1]) playback->position = range[0];
}

/// Whole frames between two positions that were not shown, beyond those a display cannot show at this speed.
static long frames_dropped(const struct document *document, double from, double to, double speed)
{
    const double rounding = 1e-6; // a sum of steps may end just before its frame
    double passed = floor(to / document->substeps + rounding) - floor(from / document->substeps + rounding);
    double expected = fmax(1, ceil(document->fps * speed / REFRESH));
    return passed > expected ? (long)(passed - expected) : 0;
}

void playback_advance(struct core *core, double dt)
{
    struct playback *playback = &core->playback;
    const struct document *document = core->document;
    double range[2], from = playback->position;
    if (!playback->playing) {
        go_to(core, from); /* an edit may have shortened the scene */
        return;
    }
    range_positions(core, range);
    double to = from + dt * document->fps * document->substeps * playback->speed;
    playback->dropped += frames_dropped(document, from, to, playback->speed);
    playback->position = fmax(to, range[0]);
    if (to < range[1]) return;
    if (playback->looping && range[1] > range[0]) {
        playback->position = range[0] + fmod(to - range[0], range[1] - range[0]);
    } else {
        playback->position = range[1];
        playback->playing = playback->looping;
    }
}

void playback_seek(struct core *core, double frame)
{
    core->playback.playing = false;
    go_to(core, core_position(core->document, frame));
}

void playback_step(struct core *core, int direction)
{
    double frame = core_frame(core);
    playback_seek(core, direction > 0 ? floor(frame + 1e-6) + 1 : ceil(frame - 1e-6) - 1);
}

void playback_end(struct core *core, int direction)
{
    playback_seek(core, direction > 0 ? core->document->last_frame : core->document->first_frame);
}

void playback_change_speed(struct core *core, int direction)
{
    double *speed = &core->playback.speed;
    int at = 0;
    while (at < SPEEDS - 1 && speeds[at] < *speed) at++;
    at += direction;
    *speed = direction == 0 ? 1 : speeds[at < 0 ? 0 : at >= SPEEDS ? SPEEDS - 1 : at];
    core_message(core, false, *speed == 1 ? "Playback in real time." : "Playback at %g× speed.", *speed);
}
