/// Chooses the stage's resolution and the frame rate from measured frame times.
#include "app/state.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float levels[] = {1.0f, 0.5f, 0.375f, 0.25f};
enum { LEVELS = sizeof levels / sizeof *levels };
enum { SLOW_FRAMES = 4, PATIENCE = 60, LONGEST_PATIENCE = 32 * PATIENCE };
enum { LATE = 4 };                 ///< frames until GPU times reflect a new resolution
static const double too_long = 31; ///< ms: 30 frames a second with some slack
static const double short_again = 25;
static const double still = 0.15; ///< seconds without change; pauses within a mouse drag are shorter

bool resolution_parse(struct resolution *resolution, const char *text)
{
    char *end;
    *resolution = (struct resolution){.adapts = strcmp(text, "auto") == 0};
    if (resolution->adapts) return true;
    resolution->moving = strtof(text, &end);
    return end != text && *end == '\0' && resolution->moving >= levels[LEVELS - 1] && resolution->moving <= 1;
}

static float scale_of(float stored) { return stored > 0 ? stored : 1; }

float resolution_choose(struct resolution *resolution, uint64_t hash, double now)
{
    const bool again = resolution->hash && now - resolution->changed < still;
    if (hash != resolution->hash) {
        // A single change is drawn exactly at once.
        resolution->shown = again ? scale_of(resolution->moving) : 1;
        resolution->hash = hash;
        resolution->changed = now;
    } else if (!again) {
        resolution->shown = 1;
    }
    return scale_of(resolution->shown);
}

bool resolution_is_exact(const struct resolution *resolution) { return scale_of(resolution->shown) == 1; }

double resolution_wait(const struct resolution *resolution, double now)
{
    if (resolution_is_exact(resolution)) return INFINITY;
    return fmax(0, resolution->changed + still - now);
}

/// Counts up while something holds, down otherwise.
static int leaky_count(int before, bool holds) { return holds ? before + 1 : before > 0 ? before - 1 : 0; }

static void change_level(struct resolution *resolution, int level, bool down)
{
    const bool failed = down && resolution->tried && resolution->since < PATIENCE;
    if (failed && resolution->patience < LONGEST_PATIENCE) resolution->patience *= 2;
    resolution->tried = !down;
    resolution->moving = levels[level];
    resolution->slow = resolution->quick = resolution->since = 0;
}

void resolution_measure(struct resolution *resolution, const struct resolution_cost *cost)
{
    if (!resolution->adapts) return;
    const double draw_ms = cost->gpu > 0 ? fmax(cost->draw, cost->gpu) : cost->draw + cost->swap;
    const double frame_ms = cost->before + draw_ms;
    int level = 0;
    while (level + 1 < LEVELS && levels[level] > scale_of(resolution->moving)) level++;
    // Fewer pixels help only if drawing is the bottleneck.
    const bool slow = resolution->since >= LATE && frame_ms > too_long && draw_ms > frame_ms / 2;
    resolution->slow = leaky_count(resolution->slow, slow);
    resolution->quick = leaky_count(resolution->quick, frame_ms < short_again);
    resolution->since++;
    if (resolution->patience == 0 || (resolution->tried && resolution->since > PATIENCE))
        resolution->patience = PATIENCE;
    if (resolution->slow >= SLOW_FRAMES && level + 1 < LEVELS) {
        change_level(resolution, level + 1, true);
    } else if (level > 0 && resolution->quick >= resolution->patience) {
        change_level(resolution, level - 1, false);
    }
}

// --- the frame rate

enum { QUEUED = 4, JUDGED = 24 }; // frames a driver queues before blocking; frames to judge by
static const double usual_rate = 60, slowest = 20, fastest = 1000;
static const double shortest = 0.93; ///< of a refresh period on average, if swaps wait for the display

static double period_of(const struct pace *pace) { return pace->period > 0 ? pace->period : 1 / usual_rate; }

void pace_set_rate(struct pace *pace, double rate)
{
    const double period = 1 / (rate >= slowest && rate <= fastest ? rate : usual_rate);
    if (period != pace->period) *pace = (struct pace){.period = period};
}

void pace_swapped(struct pace *pace, double now, bool at_once)
{
    pace->run = at_once ? pace->run + 1 : 0;
    if (pace->run == QUEUED) pace->start = now;
    if (pace->run < QUEUED + JUDGED) return;
    if (now - pace->start < shortest * JUDGED * period_of(pace)) pace->limits = true;
    pace->run = QUEUED;
    pace->start = now;
}

double pace_next(const struct pace *pace, double due, double frame_start)
{
    return pace->limits ? fmax(due + period_of(pace), frame_start) : frame_start;
}
