/// How frames keep up: the stage's resolution, lower while it moves and frames take too long (a still stage is always drawn
/// exactly), and when the next one may begin.
#ifndef APP_RESOLUTION_H
#define APP_RESOLUTION_H

#include <stdbool.h>
#include <stdint.h>

/// Zero: always full resolution.
struct resolution {
    float moving;    ///< resolution while the stage moves; 0 means 1
    float shown;     ///< resolution on the screen; 0 means 1
    bool adapts;     ///< adapt `moving` to the cost of frames
    uint64_t hash;   ///< of the stage on the screen
    double changed;  ///< when it last became another one, s
    int slow, quick; ///< how much more frequent slow (quick) frames have been of late
    int since;       ///< frames since the last step
    bool tried;      ///< the last step was up
    int patience;    ///< quick frames before a step up is tried; more after each one that had to be taken back
};

/// From the command line's word: "auto", or a number from 0.25 to 1. false if it is neither.
bool resolution_parse(struct resolution *resolution, const char *text);

/// The resolution for a stage with that `hash`; `now` in seconds on the app's clock.
float resolution_choose(struct resolution *resolution, uint64_t hash, double now);

/// Whether the stage on the screen is as sharp as it can be.
bool resolution_is_exact(const struct resolution *resolution);

/// Seconds until the stage must be redrawn exactly; INFINITY if it is exact.
double resolution_wait(const struct resolution *resolution, double now);

/// Cost of a frame with a moving stage, ms.
struct resolution_cost {
    double before;     ///< until drawing began
    double draw, swap; ///< on the CPU's clock
    double gpu;        ///< of a frame just before; 0 where the graphics card has no clock
};

/// Reports it. A swap that waits for the display is no work: where the graphics card has a clock, that counts instead.
void resolution_measure(struct resolution *resolution, const struct resolution_cost *cost);

// When the next frame may begin: swaps that wait for the display set the pace; if they do not, the app keeps to the display's rate.

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
