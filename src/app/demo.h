/// A demo that plays itself: a recording that comes with the program, over and over, until the first touch. Internal to src/app.
#ifndef APP_DEMO_H
#define APP_DEMO_H

#include "app/replay.h"
#include "ui/theme.h"

struct app;

struct demo {
    bool on;
    double seconds;        ///< since this round began
    long frame;            ///< of the recording
    enum theme_kind theme; ///< before
};

/// The recording, from its start. NULL with a sentence where it is broken or not in this build.
struct replay *demo_replay(struct error *error);
/// `dt` seconds on; behind the recording's end the next round begins.
bool demo_next(struct app *app, double dt, struct error *error);
/// Whether somebody wants to try for themselves.
bool demo_is_touched_by(const struct event *event);
/// Ends it with the start scene and the user's settings, as without a demo.
bool demo_stop(struct app *app, struct error *error);

#endif
