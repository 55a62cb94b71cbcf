/// When the next frame may begin: a swap that waits for the display sets the pace by itself; where none does, the app keeps to
/// the display's rate.
#ifndef APP_PACE_H
#define APP_PACE_H

#include <stdbool.h>

/// Zero: nothing is known yet of a display of 60 Hz.
struct pace {
    double period; ///< of the display, s
    bool limits;   ///< swaps do not wait
    int run;       ///< frames in a row that followed each other at once
    double start;  ///< of those that are being looked at, s
};

/// The display's rate in Hz, 0 where unknown. Another one is judged anew.
void pace_set_rate(struct pace *pace, double rate);

/// A swap has returned. `at_once`: the frame did not wait for anything but that.
void pace_swapped(struct pace *pace, double now, bool at_once);

/// When the frame after one that began at `frame_start` may begin, where that one was due at `due`.
double pace_next(const struct pace *pace, double due, double frame_start);

#endif
