/// The active spline's poles and what they pass: the paper's Figure 2, live. Private to src/editor.
#ifndef EDITOR_INSPECTOR_POLES_H
#define EDITOR_INSPECTOR_POLES_H

#include "editor/inspector/response.h"
#include "ui/drawlist.h"
#include <stdbool.h>

enum { POLES_COLUMNS = 224 }; ///< points of a response's plot

/// The filter in force: what the parameters say at the playhead.
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

#endif
