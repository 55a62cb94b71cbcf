/// The app: state and one callable frame, shared by the window, headless runs and replays.
#ifndef APP_APP_H
#define APP_APP_H

#include "base/error.h"
#include "scene/evaluate.h"
#include <stdbool.h>
#include <wiggly/wiggly.h>

/// Zero means default throughout.
struct app_options {
    const char *scene; ///< path, or NULL: the built-in tail
    bool headless;     ///< offscreen instead of a window
    bool no_draw;      ///< no surface at all: frames are solved and posed, not drawn
    int frames;        ///< stop after so many; 0: the replay's length, else (headless) 1200, else never
    int width, height; ///< logical pixels; 0: the replay's, else 1280 × 720
    double
        ui_scale; ///< how large everything is, on top of that; 0: the replay's, else the user's own in a window, else 1
    double scale;              ///< device pixels a logical pixel; 0: the replay's, else the display's (headless 1)
    const char *stage_scale;   ///< of the stage while it moves: "auto" or a number; NULL: auto in a window, else 1
    int theme;                 ///< 1 + an enum theme_kind; 0: the user's own in a window, else dark
    enum solver_choice solver; ///< how the splines are solved
    bool gl_debug;             ///< prints the OpenGL driver's messages; a complaint among them is a failure
    bool welcome;              ///< shows what to try first
    const char *log;           ///< timing log, CSV
    const char *screenshot;    ///< PNG of the last frame
    const char *frames_dir;    ///< a PNG for each frame
    bool demo;                 ///< plays by itself until somebody presses something
    const char *replay;        ///< events from this file; its clock is its own
    const char *record;        ///< events to this file
    const char *result;        ///< the document at the end
    int turns; ///< 1: first, 2: second: draws frames in turn with another program (platform/process.h)
};

/// Runs until the user quits or the frames are done; prints the timing summary if frames were counted. Without a display
/// says so and runs headless. Returns the exit status; on failure `error` says why.
int app_run(const struct app_options *options, struct error *error);

#endif
