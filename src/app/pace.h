/// When the next frame may begin: swaps that wait for the display set the pace; if they do not, the app keeps to
/// the display's rate.
#ifndef APP_PACE_H
#define APP_PACE_H

#include <stdbool.h>

/// Zero: a display of 60 Hz of which nothing else is known yet.
struct pace {
    double period; ///< of the display, s
    bool limits;   ///< swaps do not wait
    int run;       ///< frames in a row that followed each other at once
    double start;  ///< when judging began, s
};

/// The display's rate in Hz, 0 if unknown. A new rate restarts the judgement.
void pace_set_rate(struct pace *pace, double rate);

/// A swap has returned. `at_once`: the frame waited for nothing else.
void pace_swapped(struct pace *pace, double now, bool at_once);

/// When the next frame may begin, after one that was due at `due` and began at `frame_start`.
double pace_next(const struct pace *pace, double due, double frame_start);

#endif
