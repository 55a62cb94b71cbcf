/// Decides when the next frame may begin.
#include "app/pace.h"
#include <math.h>

enum { QUEUED = 4, JUDGED = 24 }; // frames a driver queues before it waits; frames to judge by
static const double usual_rate = 60, slowest = 20, fastest = 1000;
static const double shortest = 0.93; ///< of a period on average, where swaps wait for the display

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
