/// Replays: recorded events as text, one per line, by frame (tools/README.md).
///
///     wiggly-replay 1
///     version 0.1.0
///     size 1280 720
///     scale 1
///     ui-scale 1.5                             (left out where it is 1)
///     scene 0123456789abcdef
///     dt 1/60
///     frames 1200
///     10 pointer @knot(sway,2)
///     10 press left @knot(sway,2) shift        (also: release, double, key, keyup, repeat, wheel, text, drop, paste, size, close)
///
/// Positions are two numbers, logical pixels from the top left, or a target with an optional offset, `@knot(sway,2)+4,-3`,
/// which is looked up on the screen when the event is played.
#ifndef APP_REPLAY_H
#define APP_REPLAY_H

#include "base/error.h"
#include "ui/event.h"
#include <stdint.h>

struct replay_header {
    int width, height;
    double scale, ui_scale;
    uint64_t scene_hash;
    long frames; ///< length; 0 in a file cut short
};

struct replay;

/// Reads a replay. On failure NULL with an error "file:line: expected …".
struct replay *replay_load(const char *path, struct error *error);
/// From memory; `name` replaces the path in errors.
struct replay *replay_parse(const char *name, const char *text, size_t size, struct error *error);
void replay_destroy(struct replay *replay);
const struct replay_header *replay_get_header(const struct replay *replay);

/// Finds a target on the screen, by editor_target().
typedef bool replay_locate(void *user, const char *target, float *x, float *y, struct error *error);

/// The next event of `frame`. false if there is none or, with error->kind set, its target cannot be found.
bool replay_next(struct replay *replay, long frame, replay_locate *locate, void *user, struct event *event,
                 struct error *error);

/// A running recording. It writes events as they come, with plain coordinates.
struct recording;

struct recording *recording_open(const char *path, const struct replay_header *header, struct error *error);
void recording_event(struct recording *recording, long frame, const struct event *event);
/// Fills in the length and closes; false with a sentence if a write failed.
bool recording_close(struct recording *recording, long frames, struct error *error);

#endif
