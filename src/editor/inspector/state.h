/// The state of the inspector. Private to the room.
#ifndef EDITOR_INSPECTOR_STATE_H
#define EDITOR_INSPECTOR_STATE_H

#include "editor/core/state.h"
#include "editor/inspector/response.h"
#include "ui/widgets.h"

enum { INSPECTOR_MAX_SECTIONS = 16 };

enum { POLES_COLUMNS = 224 }; ///< points of a response's plot

/// The filter at the playhead.
struct pole_setting {
    enum filter_kind kind; ///< two-pole real or complex
    double hz, damping, bandwidth, step;
};

/// Responses of the filter and of those it is compared with; made anew only when the setting changes. Zero is a valid start.
struct poles_view {
    struct pole_setting setting; ///< for which the rest was computed; step 0: none yet
    struct passband band[FILTER_KINDS];
    float decibels[FILTER_KINDS][POLES_COLUMNS]; ///< relative to each one's peak, from −span to span
    double span;                                 ///< Hz
    double reach, top; ///< Hz and damping ratio at the inset's right and upper edge; kept while a pole is dragged
};

/// State of the list of history steps.
struct history_view {
    size_t top;         ///< its first row
    size_t count, done; ///< of the history, when it was last laid out
};

/// A field of the selected knots: the first one's number, and whether others differ.
struct knot_numbers {
    int count;
    double first;
    bool mixed;
};

/// The inspector's own view state; zero but for `core` is a valid start.
struct inspector {
    struct core *core;
    struct ui ui;
    enum ui_change change; ///< that a number is being set by
    struct ui_scroll scroll;
    bool flipped[INSPECTOR_MAX_SECTIONS]; ///< sections that are not as they are at first, open or closed
    bool called
        [INSPECTOR_MAX_SECTIONS]; ///< sections that were asked for, and are shown without More until they are closed
    int rig, channel;             ///< the tail or chain that is shown, and its channel
    int selected;                 ///< in the list of all rigs
    int model;                    ///< the imported character that is shown, of their number
    double angle_reach[3];        ///< by enum angle_kind: times the usual ends of its slider
    double ramp_scale[3][2];      ///< by enum angle_kind: lowest and highest angle that its curve shows
    int joint[3];                 ///< by enum angle_kind: the selected one, where each has its own
    struct angles drawn;          ///< angles of each joint as the running drag has drawn them
    float drawn_x, drawn_y;       ///< where it was last
    struct bone_selection seen_bone; ///< that was last shown
    const char *revealed;            ///< section that is to be in sight, NULL: none
    double dragged;                  ///< what it would be; of several knots, what was last possible
    struct knot_numbers knots;       ///< of the field that was built last
    char knot_title[32];             ///< of the section on knots
    struct poles_view poles;
    struct history_view history;
    const struct dropdown *list; ///< that is open, in the running pass; NULL: none
};

#endif
