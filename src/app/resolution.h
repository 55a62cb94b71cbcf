/// Keeps up with the display: lowers the stage's resolution while it moves and frames are slow (a still stage is always exact), and paces
/// frames.
#ifndef APP_RESOLUTION_H
#define APP_RESOLUTION_H

#include <stdbool.h>
#include <stdint.h>

/// Zero: always full resolution.
struct resolution {
    float moving;    ///< resolution while the stage moves; 0 means 1
    float shown;     ///< resolution on the screen; 0 means 1
    bool adapts;     ///< adapt `moving` to the cost of frames
    uint64_t hash;   ///< of the displayed stage
    double changed;  ///< time of the last change, s
    int slow, quick; ///< leaky counts of slow and quick frames
    int since;       ///< frames since the last step
    bool tried;      ///< the last step raised the resolution
    int patience;    ///< quick frames before trying a step up; grows after each one that failed
};

/// Parses "auto" or a number from 0.25 to 1; false if it is neither.
bool resolution_parse(struct resolution *resolution, const char *text);

/// The resolution for a stage with this `hash`; `now` in seconds.
float resolution_choose(struct resolution *resolution, uint64_t hash, double now);

/// Whether the displayed stage has full resolution.
bool resolution_is_exact(const struct resolution *resolution);

/// Seconds until the stage must be redrawn exactly; INFINITY if it already is.
double resolution_wait(const struct resolution *resolution, double now);

/// Time for a frame with a moving stage, ms.
struct resolution_cost {
    double before;     ///< before drawing
    double draw, swap; ///< on the CPU
    double gpu;        ///< of a recent frame; 0 without GPU timers
};

/// Waiting for the display is not work, so GPU time counts instead of the swap where there is one.
void resolution_measure(struct resolution *resolution, const struct resolution_cost *cost);

// When the next frame may begin. Swaps that wait for the display set the pace; otherwise the app keeps to its refresh rate.

/// Zero: a 60 Hz display, nothing measured yet.
struct pace {
    double period; ///< of the display, s
    bool limits;   ///< swaps do not wait, so the app must
    int run;       ///< consecutive frames that waited for nothing else
    double start;  ///< start of the measurement, s
};

/// Refresh rate in Hz, 0 if unknown. A new rate restarts the measurement.
void pace_set_rate(struct pace *pace, double rate);

/// Call after a swap. `at_once`: the frame did not wait for anything else.
void pace_swapped(struct pace *pace, double now, bool at_once);

/// When the next frame may begin, after one due at `due` that began at `frame_start`.
double pace_next(const struct pace *pace, double due, double frame_start);

#endif
