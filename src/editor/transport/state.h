/// The state of the status line, and its controls. Private to the room.
#ifndef EDITOR_TRANSPORT_STATE_H
#define EDITOR_TRANSPORT_STATE_H

#include "editor/core/state.h"

/// The right end of the status line; zero is a valid start.
struct status {
    double age;           ///< seconds since the figures were taken over
    double fps, solve_us; ///< as shown
    long dropped;
};

/// The controls at the left of the status line.
enum control {
    TRANSPORT_PLAY,
    TRANSPORT_LOOP,
    TRANSPORT_SPEED,
    TRANSPORT_AUTO_KEY,
    TRANSPORT_UI_SCALE,
    TRANSPORT_PRESENT,
    TRANSPORT_COUNT
};

struct transport {
    struct status status;
    double fps, solve_us; ///< as told last
    float stage_scale;    ///< from editor_set_stage_scale(); 0 means 1
};

/// Where a control is.
struct rect controls_rect(const struct core *core, enum control control);

#endif
