/// The state of the inspector. Private to the room.
#ifndef EDITOR_INSPECTOR_STATE_H
#define EDITOR_INSPECTOR_STATE_H

#include "editor/core/state.h"
#include "editor/inspector/poles.h"
#include "ui/widgets.h"

enum { INSPECTOR_MAX_SECTIONS = 16 };

/// What the list of the history's steps shows.
struct history_view {
    size_t top;         ///< its first row
    size_t count, done; ///< of the history, when it was last laid out
};

/// The inspector's own view state; zero is a valid start.
struct inspector {
    struct ui ui;
    struct ui_scroll scroll;
    bool flipped[INSPECTOR_MAX_SECTIONS]; ///< sections that are not as they are at first, open or closed
    int rig, channel;                     ///< the tail or chain that is shown, and its channel
    int selected;                         ///< in the list of all rigs
    int model;                            ///< the imported character that is shown, of their number
    double angle_reach[3];                ///< by enum angle_kind: times the usual ends of its slider
    double ramp_scale[3][2];              ///< by enum angle_kind: lowest and highest angle that its curve shows
    int joint[3];                         ///< by enum angle_kind: the selected one, where each has its own
    struct angles drawn;                  ///< angles of each joint as the running drag has drawn them
    float drawn_x, drawn_y;               ///< where it was last
    struct bone_selection seen_bone;      ///< that was last shown
    const char *revealed;                 ///< section that is to be in sight, NULL: none
    double dragged;                       ///< what it would be; of several knots, what was last possible
    char knot_title[32];                  ///< of the section on knots
    struct poles_view poles;
    struct history_view history;
};

#endif
