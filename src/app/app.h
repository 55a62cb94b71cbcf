/// The app: its state and a function that runs one frame, for windows, headless runs and replays.
#ifndef APP_APP_H
#define APP_APP_H

#include "base/error.h"
#include "scene/evaluate.h"
#include <stdbool.h>
#include <wiggly/wiggly.h>

/// Zero means default.
struct app_options {
    const char *scene; ///< path, or NULL: the built-in tail
    bool headless;     ///< offscreen instead of a window
    bool no_draw;      ///< no surface: solves and poses without drawing
    int frames;        ///< number of frames; 0: the replay's length, else (headless) 1200, else unlimited
    int width, height; ///< logical pixels; 0: the replay's, else 1280 × 720
    double
        ui_scale; ///< size of the interface relative to the display's; 0: the replay's, else the user's own in a window, else 1
    double scale;              ///< device pixels per logical pixel; 0: the replay's, else the display's (headless 1)
    const char *stage_scale;   ///< of the stage while it moves: "auto" or a number; NULL: auto in a window, else 1
    int theme;                 ///< 1 + an enum theme_kind; 0: the user's own in a window, else dark
    enum solver_choice solver; ///< how the splines are solved
    bool gl_debug;             ///< prints the OpenGL driver's messages; serious ones fail the run
    bool still;                ///< nothing plays before the user starts it
    bool welcome;              ///< shows the card for new users
    bool stats;                ///< frame rate and solve time in the status line
    const char *log;           ///< timing log, CSV
    const char *screenshot;    ///< PNG of the last frame
    const char *frames_dir;    ///< a PNG for each frame
    const char *replay;        ///< replays events from this file, with its clock
    const char *saves;         ///< folder for what a replay saves and exports; NULL: it writes nothing
    const char *record;        ///< records events to this file
    const char *result;        ///< saves the final document
    int turns; ///< 1: first, 2: second: takes turns with another program, frame by frame (platform/process.h)
};

/// Runs until the user quits or the frames are done; prints the timing summary if frames were counted. Without a display it prints why and
/// runs headless. Returns the exit status; on failure `error` says why.
int app_run(const struct app_options *options, struct error *error);

#endif
