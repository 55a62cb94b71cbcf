/// State of the inspector. Private to this folder.
#ifndef EDITOR_INSPECTOR_STATE_H
#define EDITOR_INSPECTOR_STATE_H

#include "editor/core/state.h"
#include "editor/inspector/response.h"
#include "ui/widgets.h"

enum { INSPECTOR_MAX_SECTIONS = 16 };

enum { POLES_COLUMNS = 224 }; ///< points per response plot

/// The filter at the playhead.
struct pole_setting {
    enum filter_kind kind; ///< two-pole real or complex
    double hz, damping, bandwidth, step;
};

/// Responses of the filter and those it is compared with, recomputed when the setting changes. Zero is a valid start.
struct poles_view {
    struct pole_setting setting; ///< of the cached responses; step 0: none yet
    struct passband band[FILTER_KINDS];
    float decibels[FILTER_KINDS][POLES_COLUMNS]; ///< relative to each peak, from −span to span
    double span;                                 ///< Hz
    double reach, top; ///< Hz and damping ratio at the inset's right and top edge; constant during a drag
};

struct history_view {
    size_t top;         ///< first visible row
    size_t count, done; ///< of the history at the last layout
};

/// A field of the selected knots: the first knot's number, and whether others differ.
struct knot_numbers {
    int count;
    double first;
    bool mixed;
};

/// The inspector's view state. Zero except `core` is a valid start.
struct inspector {
    struct core *core;
    struct ui ui;
    enum ui_change change; ///< the change a number is being set by
    struct ui_scroll scroll;
    bool flipped[INSPECTOR_MAX_SECTIONS]; ///< sections open that start closed, or the reverse
    bool called[INSPECTOR_MAX_SECTIONS];  ///< requested sections, shown without More until closed
    int rig, channel;                     ///< the shown tail or chain, and its channel
    int selected;                         ///< row in the list of rigs
    int model;                            ///< index of the shown imported character among its kind
    double angle_reach[3];                ///< by enum angle_kind: factor on the slider's usual ends
    double ramp_scale[3][2];              ///< by enum angle_kind: lowest and highest angle of the curve
    int joint[3];                         ///< by enum angle_kind: the selected joint
    struct angles drawn;                  ///< angles as the running drag has drawn them
    float drawn_x, drawn_y;               ///< last pointer position while drawing
    struct bone_selection seen_bone;      ///< last shown bone
    const char *revealed;                 ///< section to scroll to, or NULL
    double dragged;                       ///< the dragged value; of several knots, the last possible one
    struct knot_numbers knots;            ///< of the last field built
    char knot_title[32];                  ///< title of the knot section
    char feel_title[96];                  ///< of that on the feel
    bool alone;                           ///< Alt was held at the last press: Feel is of the active spline alone
    struct poles_view poles;
    struct history_view history;
    const struct dropdown *list; ///< open in this pass, or NULL
};

#endif
