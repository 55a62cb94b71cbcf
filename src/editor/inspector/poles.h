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

/// Brings the responses up to date with a setting whose frequency is above 0.
void poles_update(struct poles_view *view, const struct pole_setting *setting);
/// Chooses the inset's scale for a setting.
void poles_fit(struct poles_view *view, const struct pole_setting *setting);

/// Where a frequency and a damping ratio are in the inset, and back. Damping is spread near 0, where it matters.
float poles_x(const struct poles_view *view, struct rect inset, double hz);
float poles_y(const struct poles_view *view, struct rect inset, double damping);
double poles_hz(const struct poles_view *view, struct rect inset, float x);
double poles_damping(const struct poles_view *view, struct rect inset, float y);

/// The unit circle, true to scale, with the filter's poles.
void poles_draw_circle(const struct pole_setting *setting, struct rect r, struct drawlist *list);
/// Name, response at zero frequency and width of the three filters.
void poles_draw_legend(const struct poles_view *view, struct rect r, struct drawlist *list);
/// The inset's scales and poles, without the handles.
void poles_draw_inset(const struct poles_view *view, const struct pole_setting *setting, struct rect r,
                      struct drawlist *list);
void poles_draw_response(const struct poles_view *view, struct rect r, struct drawlist *list);

#endif
