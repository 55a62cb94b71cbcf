/// The curves panel: what part is visible, mouse and wheel, and warnings with their fixes.
#include "base/hash.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/curves/state.h"
#include "maths/maths.h"
#include "scene/pins.h"
#include "scene/warnings.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// Panning, zooming, normalised curves, and following edits. A normalised curve with values c … d is drawn over the active curve's a … b:
// v at a + (v − c)·(b − a)/(d − c).

/// Pixels from the plot. Points further away look the same, and clamped ones are safe as floats.
static const double FAR_PIXELS = 4000;

static double bounded(double pixels, double lo, double hi)
{
    return fmin(fmax(pixels, lo - FAR_PIXELS), hi + FAR_PIXELS);
}

double curves_pixels_per_frame(const struct core *core)
{
    return core->view.layout.plot.w / (core->view.plot.frame1 - core->view.plot.frame0);
}

double curves_pixels_per_value(const struct core *core) { return core->view.layout.plot.h / plot_height(core); }

float curves_x(const struct core *core, double frame)
{
    const struct rect *plot = &core->view.layout.plot;
    double x = plot->x + (frame - core->view.plot.frame0) * curves_pixels_per_frame(core);
    return (float)bounded(x, plot->x, plot->x + plot->w);
}

float curves_knot_x(const struct core *core, const struct knot *knot)
{
    return curves_x(core, document_frame(core->document, document_sample(core->document, knot->frame)));
}

int curves_knot_from(const struct core *core, const struct spline *spline, double x)
{
    const double sample = floor(core_position(core->document, curves_frame(core, x)));
    return spline_lower_bound(core->document, spline, (int)fmin(fmax(sample, INT_MIN), INT_MAX));
}

float curves_y(const struct core *core, double value)
{
    const struct rect *plot = &core->view.layout.plot;
    double y = plot->y + (core->view.plot.value1 - value) * curves_pixels_per_value(core);
    return (float)bounded(y, plot->y, plot->y + plot->h);
}

double curves_frame(const struct core *core, double x)
{
    return core->view.plot.frame0 + (x - core->view.layout.plot.x) / curves_pixels_per_frame(core);
}

double curves_value(const struct core *core, double y)
{
    return core->view.plot.value1 - (y - core->view.layout.plot.y) / curves_pixels_per_value(core);
}

/// Keeps the view wider than rounding errors and within a sensible maximum.
static void keep_sane(struct core *core)
{
    struct plotted *view = &core->view.plot;
    double frames = fmin(fmax(view->frame1 - view->frame0, 0.5), 1e8);
    double values = fmin(fmax(view->value1 - view->value0, 1e-9), 1e15);
    double frame = fmin(fmax((view->frame0 + view->frame1) / 2, -1e9), 1e9);
    double value = fmin(fmax((view->value0 + view->value1) / 2, -1e15), 1e15);
    values = fmax(values, fabs(value) * 1e-9);
    *view = (struct plotted){frame - frames / 2, frame + frames / 2, value - values / 2, value + values / 2};
}

/// An empty view, before anything is included.
static const struct plotted NOTHING = {INFINITY, -INFINITY, INFINITY, -INFINITY};

static void include_value(struct plotted *part, double value)
{
    if (!isfinite(value)) return;
    part->value0 = fmin(part->value0, value);
    part->value1 = fmax(part->value1, value);
}

/// Widens a view to a knot.
static void include_knot(const struct curves *curves, const struct core *core, struct knot_place at,
                         struct plotted *part)
{
    const struct value_map map = normal_map(curves, core, at.spline);
    const struct knot *knot = knot_at(core->document, at);
    part->frame0 = fmin(part->frame0, knot->frame);
    part->frame1 = fmax(part->frame1, knot->frame);
    include_value(part, map.scale * core_knot_value(core, at.spline, knot) + map.offset);
}

/// Widens a view to the drawn values of a curve between two samples.
static void include_curve(const struct curves *curves, const struct core *core, int spline, double first, double last,
                          struct plotted *part)
{
    const struct evaluation *evaluation = core->evaluation;
    const struct value_map map = normal_map(curves, core, spline);
    if (!evaluation || spline >= evaluation->count || evaluation->samples == 0) return;
    last = fmin(last, evaluation->samples - 1);
    for (int highest = 0; highest < 2 && first <= last; highest++) {
        const int sample = evaluation_extreme(evaluation, spline, (int)first, (int)last, highest);
        include_value(part, map.scale * evaluation->curves[spline].total[sample] + map.offset);
    }
}

/// The same for the visible part of those samples.
static void include_seen(const struct curves *curves, const struct core *core, int spline, double first, double last,
                         struct plotted *part)
{
    const double left = floor(core_position(core->document, core->view.plot.frame0));
    const double right = ceil(core_position(core->document, core->view.plot.frame1));
    include_curve(curves, core, spline, fmax(first, fmax(left, 0)), fmin(last, right), part);
}

/// Fits the visible values to those of `part` with a margin; a flat part gets one unit.
static void show_values(struct plotted *view, const struct plotted *part)
{
    const double span = part->value1 - part->value0, largest = fmax(fabs(part->value0), fabs(part->value1));
    const double margin = span > 1e-9 * largest && span > 1e-9 ? 0.12 * span : 1;
    const bool finite = isfinite(span);
    view->value0 = finite ? part->value0 - margin : -1;
    view->value1 = finite ? part->value1 + margin : 1;
}

/// Sets the view within limits, and stops following edits.
static void view_set(struct curves *curves, struct core *core, struct plotted view)
{
    curves->moves = false;
    core->step.edited = (struct edited){0};
    core->view.plot = view;
    keep_sane(core);
}

void curves_frame_all(struct curves *curves, struct core *core)
{
    enum { COLUMNS = 200 };
    const struct document *document = core->document;
    struct plotted part = NOTHING, *view = &core->view.plot;
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = document->splines[s];
        if (core->view.on[SWITCH_NORMALISE] && s != core->focus.active) continue;
        for (int k = 0; k < spline->knot_count; k++)
            include_value(&part, core_knot_value(core, s, &spline->knots[k]));
        include_curve(curves, core, s, 0, INFINITY, &part);
    }
    show_values(view, &part);

    // The active spline's equilibrium, phase curve and copies.
    double turn[CURVES_FAN][2], delay;
    const int copies = core->focus.active >= 0 ? curves_fan(core, turn, &delay) : 0;
    const double last = document_samples(document) - 1;
    part = *view;
    for (int column = 0; column <= COLUMNS && core->focus.active >= 0; column++) {
        const wiggly_value v = evaluation_at(core->evaluation, core->focus.active, last * column / COLUMNS);
        include_value(&part, v.y);
        include_value(&part, v.y + v.im);
        for (int i = 0; i < copies; i++) include_value(&part, v.y + turn[i][0] * v.re + turn[i][1] * v.im);
    }
    const double more = 0.06 * (part.value1 - part.value0);
    const double margin = fmax(0.02 * (document->last_frame - document->first_frame), 0.5);
    view_set(curves, core,
             (struct plotted){document->first_frame - margin, document->last_frame + margin,
                              part.value0 < view->value0 ? part.value0 - more : view->value0,
                              part.value1 > view->value1 ? part.value1 + more : view->value1});
}

void curves_frame_selection(struct curves *curves, struct core *core)
{
    struct plotted part = NOTHING;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) include_knot(curves, core, at, &part);
    if (part.frame0 > part.frame1) {
        curves_frame_all(curves, core);
        return;
    }
    const double margin = fmax(0.25 * (part.frame1 - part.frame0), 6);
    core->view.plot.frame0 = part.frame0 - margin;
    core->view.plot.frame1 = part.frame1 + margin;
    int seen = -1;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at); seen = at.spline) {
        if (at.spline != seen) include_seen(curves, core, at.spline, 0, INFINITY, &part);
    }
    show_values(&core->view.plot, &part);
    view_set(curves, core, core->view.plot);
}

static void shift_view(struct curves *curves, struct core *core, double frames, double values)
{
    const struct plotted *v = &core->view.plot;
    view_set(curves, core,
             (struct plotted){v->frame0 + frames, v->frame1 + frames, v->value0 + values, v->value1 + values});
}

void curves_reveal(struct curves *curves, struct core *core, double frame, double value)
{
    const struct plotted *view = &core->view.plot;
    const double frames = 0.05 * (view->frame1 - view->frame0), values = 0.05 * (view->value1 - view->value0);
    shift_view(curves, core, fmin(frame - frames - view->frame0, 0) + fmax(frame + frames - view->frame1, 0),
               fmin(value - values - view->value0, 0) + fmax(value + values - view->value1, 0));
}

void curves_pan(struct curves *curves, struct core *core, double dx, double dy)
{
    shift_view(curves, core, -dx / curves_pixels_per_frame(core), dy / curves_pixels_per_value(core));
}

void curves_zoom(struct curves *curves, struct core *core, float x, float y, double time_factor, double value_factor)
{
    const struct plotted *view = &core->view.plot;
    const double frame = curves_frame(core, x), value = curves_value(core, y);
    view_set(curves, core,
             (struct plotted){
                 frame + (view->frame0 - frame) * time_factor, frame + (view->frame1 - frame) * time_factor,
                 value + (view->value0 - value) * value_factor, value + (view->value1 - value) * value_factor});
}

static bool has_height(const double range[2]) { return range[1] - range[0] > 1e-12 * fmax(1, fabs(range[0])); }

/// Maps the values of one spline to those of another.
static struct value_map map_between(const struct curves *curves, const struct core *core, int active, int spline)
{
    const struct value_map as_it_is = {1, 0};
    const struct curve_cache *cache = &curves->cache;
    bool measured = spline < cache->range_count && active >= 0 && active < cache->range_count;
    if (!core->view.on[SWITCH_NORMALISE] || spline == active || !measured) return as_it_is;
    const double *to = cache->range[active], *from = cache->range[spline];
    if (!has_height(to)) return as_it_is;
    if (!has_height(from)) return (struct value_map){1, (to[0] + to[1]) / 2 - from[0]};
    double scale = (to[1] - to[0]) / (from[1] - from[0]);
    return (struct value_map){scale, to[0] - scale * from[0]};
}

struct value_map normal_map(const struct curves *curves, const struct core *core, int spline)
{
    return map_between(curves, core, core->focus.active, spline);
}

/// Height of a spline's value in logical pixels, normalised if that is on.
static float curves_y_of(const struct curves *curves, const struct core *core, int spline, double value)
{
    struct value_map map = normal_map(curves, core, spline);
    return curves_y(core, map.scale * value + map.offset);
}

float curves_knot_y(const struct curves *curves, const struct core *core, int spline, const struct knot *knot)
{
    return curves_y_of(curves, core, spline, core_knot_value(core, spline, knot));
}

static const float LIFT = 16, EDGE = 12; ///< pixels: a warning's marker above its point; from the plot's edge

/// Position of a warning's marker; false if it is not visible.
static bool warning_place(const struct curves *curves, const struct core *core, const struct warning *warning,
                          float xy[2])
{
    const struct rect plot = core->view.layout.plot;
    xy[0] = plot.x + EDGE;
    xy[1] = plot.y + EDGE;
    if (warning->kind == WARNING_RATE) return true;
    xy[0] = curves_x(core, warning->frame);
    xy[1] = fminf(fmaxf(curves_y_of(curves, core, warning->spline, warning->value) - LIFT, plot.y + EDGE),
                  plot.y + plot.h - EDGE);
    return xy[0] >= plot.x && xy[0] <= plot.x + plot.w;
}

void curves_activate(struct curves *curves, struct core *core, int before)
{
    const struct value_map map = map_between(curves, core, before, core->focus.active);
    const struct plotted *view = &core->view.plot;
    view_set(curves, core,
             (struct plotted){view->frame0, view->frame1, (view->value0 - map.offset) / map.scale,
                              (view->value1 - map.offset) / map.scale});
}

static const double RATE = 14;     ///< share of the remaining distance per second
static const double CLOSE = 0.25;  ///< pixels: close enough to stop
static const double MARGIN = 0.06; ///< of the view, around the edit
static const double WIDEST = 1.7;  ///< of the visible frames; further edits pan instead
static const double MOST = 4;      ///< the same about the pointer, which may lie at an edge

/// Widens the view to the edit about what is under the pointer (NAN: it is elsewhere), or pans if that would be too wide.
static void widen(double *low, double *high, const double part[2], double widest, double pointed)
{
    const double least = fmin(*low, part[0]), most = fmax(*high, part[1]), span = *high - *low;
    if (least >= *low && most <= *high) return;
    const double margin = MARGIN * (most - least);
    const double below = least < *low ? pointed - least + margin : 0,
                 above = most > *high ? most + margin - pointed : 0;
    const double by = fmax(below / (pointed - *low), above / (*high - pointed));
    if (pointed > *low && pointed < *high && by <= fmin(widest, MOST)) {
        *low = pointed - by * (pointed - *low);
        *high = pointed + by * (*high - pointed);
        return;
    }
    if (most - least <= widest * span) {
        if (least < *low) *low = least - margin;
        if (most > *high) *high = most + margin;
        return;
    }
    const double pan = part[0] < *low ? part[0] - margin - *low : part[1] + margin - *high;
    *low += pan;
    *high += pan;
}

/// Whether playback passes from the scene's end to its start.
static bool seam_is_played(const struct core *core)
{
    return core->view.playback.playing && core->view.on[SWITCH_LOOP] && !playback_is_part(core);
}

/// How many curves do not end as they start, so that looping playback jumps.
static int open_curves(const struct core *core)
{
    static const double SEEN = 0.01; // of the curve's height
    const struct evaluation *evaluation = core->evaluation;
    int count = 0;
    for (int s = 0; evaluation && s < evaluation->count && s < core->document->spline_count; s++) {
        const int last = evaluation->samples - 1;
        const double *total = evaluation->curves[s].total;
        if (last < 1 || spline_start(core->document->splines[s]) == WIGGLY_LOOP) continue;
        const wiggly_value first = evaluation_at(evaluation, s, 0), end = evaluation_at(evaluation, s, last);
        const double height = total[evaluation_extreme(evaluation, s, 0, last, true)] -
                              total[evaluation_extreme(evaluation, s, 0, last, false)];
        count += maths_hypot(total[last] - total[0], end.im - first.im) > SEEN * height;
    }
    return count;
}

void follow_edits(struct curves *curves, struct core *core)
{
    const struct edited *edited = &core->step.edited;
    const struct document *document = core->document;
    const bool has_changed = curves->followed != document->edits;
    curves->followed = document->edits;
    if (seam_is_played(core) && curves->open_of != document->edits) {
        curves->open = open_curves(core);
        curves->open_of = document->edits;
    }
    if (!edited->selection && edited->count == 0 && !has_changed) return;

    // Frames and values of everything edited since the last frame: selected knots with the curve between their neighbours; of splines only
    // the visible values.
    struct plotted part = NOTHING;
    for (struct knot_place at = SELECTED_START; edited->selection && selected_next(core, &at);) {
        const struct knot *knot = knot_at(document, at);
        const bool has_next = at.knot + 1 < document->splines[at.spline]->knot_count;
        include_knot(curves, core, at, &part);
        const double first = at.knot > 0 ? document_sample(document, knot[-1].frame) : 0;
        const double last = has_next ? (double)document_sample(document, knot[1].frame) : INFINITY;
        include_seen(curves, core, at.spline, first, last, &part);
    }
    for (int i = 0; i < edited->count; i++) include_seen(curves, core, edited->spline[i], 0, INFINITY, &part);
    const bool is_measured = core->input.drag.room == curves; // by a drag, and stays
    struct plotted goal = curves->moves && !is_measured ? curves->goal : core->view.plot;
    const float x = core->input.pointer_x, y = core->input.pointer_y;
    const bool points = rect_contains(core->view.layout.plot, x, y);
    const double frame = points ? curves_frame(core, x) : NAN, value = points ? curves_value(core, y) : NAN;
    if (part.frame0 <= part.frame1)
        widen(&goal.frame0, &goal.frame1, (double[2]){part.frame0, part.frame1}, WIDEST, frame);
    if (part.value0 <= part.value1)
        widen(&goal.value0, &goal.value1, (double[2]){part.value0, part.value1}, INFINITY, value);

    // Whatever was edited, some of the active curve stays in sight.
    part = NOTHING;
    if (core->focus.active >= 0) include_seen(curves, core, core->focus.active, 0, INFINITY, &part);
    if (has_changed && (part.value1 < goal.value0 || part.value0 > goal.value1) && part.value0 <= part.value1)
        widen(&goal.value0, &goal.value1, (double[2]){part.value0, part.value1}, INFINITY, value);
    curves->moves = goal.frame0 != core->view.plot.frame0 || goal.frame1 != core->view.plot.frame1 ||
                    goal.value0 != core->view.plot.value0 || goal.value1 != core->view.plot.value1;
    curves->goal = goal;
    core->step.edited = (struct edited){0};
}

void curves_advance(struct curves *curves, struct core *core, double dt)
{
    keep_ghost(curves, core);
    if (!curves->moves || core->input.drag.room == curves) return;
    const double share = 1 - maths_exp(-RATE * fmax(dt, 0));
    const struct plotted *view = &core->view.plot, *goal = &curves->goal;
    const double left[4] = {goal->frame0 - view->frame0, goal->frame1 - view->frame1, goal->value0 - view->value0,
                            goal->value1 - view->value1};
    const double frames = fmax(fabs(left[0]), fabs(left[1])) * curves_pixels_per_frame(core);
    const double values = fmax(fabs(left[2]), fabs(left[3])) * curves_pixels_per_value(core);
    const bool there = fmax(frames, values) < CLOSE;
    core->view.plot = there ? *goal
                            : (struct plotted){view->frame0 + share * left[0], view->frame1 + share * left[1],
                                               view->value0 + share * left[2], view->value1 + share * left[3]};
    keep_sane(core);
    curves->moves = !there;
}

// The mouse.

struct curves *curves_create(void) { return need_zeroed(1, sizeof(struct curves)); }

void curves_destroy(struct curves *curves)
{
    free(curves->before_box.bits);
    free(curves);
}

void curves_open(struct curves *curves)
{
    curves->cache.key = 0;
    curves->cache.range_count = 0;
    curves->moves = false;
    curves->warnings = (struct warnings){0};
}

bool curves_wants_frames(const struct curves *curves) { return curves->moves; }

static const float CURVE_REACH = 7, OTHER_REACH = 7, WARNING_REACH = 9, LIMIT_REACH = 5; ///< pixels
static const double ZOOM_STEP = 0.15; ///< exponent of e per notch of the wheel

float nearest_knot(const struct curves *curves, const struct core *core, int of, const float xy[2], float reach,
                   struct hover *hover)
{
    static const char still[] =
        "Comes to rest at the equilibrium; Shift+P gives it a value. Drag it in time (Ctrl: off frames)";
    const struct spline *spline = core->document->splines[of];
    float best = reach;
    for (int k = curves_knot_from(core, spline, xy[0] - reach); k < spline->knot_count && !spline->locked; k++) {
        const struct knot *knot = &spline->knots[k];
        float at = curves_knot_x(core, knot);
        if (at > xy[0] + reach) break;
        const float down = isnan(xy[1]) ? 0 : xy[1] - curves_knot_y(curves, core, of, knot);
        if (is_nearest(maths_hypotf(xy[0] - at, down), &best))
            *hover = (struct hover){
                .thing = &thing_knot, .hint = knot->still ? still : NULL, .spline = of, .knot = knot->id};
    }
    return best;
}

/// A press that did not move deselects; `keep` false restores the former selection.
static void end_box(void *room, struct core *core, bool keep)
{
    const struct curves *curves = room;
    if (!keep) selection_copy(&core->focus.selection, &curves->before_box);
    if (keep && !core->input.drag.moved && curves->knot_drag.box == BOX_REPLACE)
        selection_clear(&core->focus.selection);
    if (keep) selected_activate(core);
}

/// Below the ruler's end while playback loops over curves that do not close.
static bool seam_place(const struct curves *curves, const struct core *core, float xy[2])
{
    const struct rect *plot = &core->view.layout.plot;
    xy[0] = curves_x(core, core->document->last_frame);
    xy[1] = plot->y + EDGE;
    return seam_is_played(core) && curves->open > 0 && rect_contains(*plot, xy[0], xy[1]);
}

static bool find_seam(void *room, const struct core *core, const struct target *target, float xy[2])
{
    (void)target;
    return seam_place(room, core, xy);
}

static enum parameter limit_of(int handle) { return handle ? PARAMETER_HIGH : PARAMETER_LOW; }

/// The inspector lays out the splines' list; this is for its menu and F1.
static const struct thing list_row = {.place = ON_ROW};

struct hover curves_hover(const struct curves *curves, const struct core *core, float x, float y)
{
    struct hover hover = ruler_pins_hover(core, x, y);
    float xy[2];
    const struct spline *spline = core_active_spline(core);
    if (hover.thing) return hover;
    if (rect_contains(core->view.layout.ruler, x, y)) hover.thing = &thing_ruler;
    if (rect_contains(ruler_corner(core), x, y)) hover.thing = &thing_units;
    if (rect_contains(sheet_switch(core), x, y)) hover.thing = &thing_sheet;
    if (rect_contains(core->view.layout.list, x, y)) hover.thing = &list_row;
    if (rect_contains(sheet_area(core), x, y)) return sheet_hover(curves, core, x, y);
    if (!rect_contains(core->view.layout.plot, x, y) || !spline) return hover;
    if (seam_place(curves, core, xy) && maths_hypotf(x - xy[0], y - xy[1]) <= WARNING_REACH)
        hover.thing = &thing_seam;
    const bool seen = spline_list_seen(core) && !spline->locked;
    const float pointer[2] = {x, y};
    float best = core_reach(core, CURVES_HIT_RADIUS);
    if (seen) nearest_knot(curves, core, core->focus.active, pointer, best, &hover);
    if (hover.thing) return hover;
    for (int k = 0; k < spline->knot_count && seen; k++) {
        const struct knot *knot = &spline->knots[k];
        if (!knot->has_slope || !selection_has(&core->focus.selection, knot->id)) continue;
        for (int end = 0; end < 2; end++) {
            curves_handle(core, knot, end, xy);
            if (is_nearest(maths_hypotf(x - xy[0], y - xy[1]), &best))
                hover = (struct hover){
                    .thing = &thing_slope, .spline = core->focus.active, .knot = knot->id, .handle = end};
        }
    }
    if (hover.thing) return hover;
    for (int i = 0; i < curves->warnings.count; i++) {
        if (warning_place(curves, core, &curves->warnings.list[i], xy) &&
            maths_hypotf(x - xy[0], y - xy[1]) <= WARNING_REACH)
            hover = (struct hover){.thing = &thing_warning, .handle = i};
    }
    if (hover.thing) return hover;
    best = OTHER_REACH;
    for (int i = 0; i < curves->cache.other_count; i++) {
        const int other = curves_other(curves, core->document, i);
        if (other >= 0) best = nearest_knot(curves, core, other, pointer, best, &hover);
    }
    if (!hover.thing) scale_box_hover(curves, core, x, y, &hover);
    if (hover.thing) return hover;
    best = LIMIT_REACH;
    for (int i = 0; i < 2 && seen; i++) {
        const double value = spline->parameter[limit_of(i)].value;
        if (is_nearest(isfinite(value) ? fabsf(y - curves_y(core, value)) : INFINITY, &best))
            hover = (struct hover){.thing = &thing_limit, .spline = core->focus.active, .handle = i};
    }
    if (hover.thing) return hover;
    // The nearest curve directly above or below, the active one first.
    const double position = core_position(core->document, curves_frame(core, x));
    best = CURVE_REACH;
    for (int i = 0; i < core->document->spline_count; i++) {
        const int s = i == 0 ? core->focus.active : i <= core->focus.active ? i - 1 : i;
        if (!spline_list_shows(core, s) || core->document->splines[s]->locked) continue;
        const wiggly_value v = evaluation_at(core->evaluation, s, position);
        const float distance = fabsf(y - curves_y_of(curves, core, s, v.y + v.re));
        if (distance >= best) continue;
        best = distance;
        hover = (struct hover){.thing = s == core->focus.active ? &thing_active_curve : &thing_curve, .spline = s};
    }
    return hover;
}

static struct rect box_rect(const struct drag *drag)
{
    return (struct rect){fminf(drag->start_x, drag->x), fminf(drag->start_y, drag->y), fabsf(drag->x - drag->start_x),
                         fabsf(drag->y - drag->start_y)};
}

/// Selects or deselects one spline's knots in the box; on the dope sheet only their time counts.
static void take_inside(const struct curves *curves, struct core *core, int s)
{
    const struct rect box = box_rect(&core->input.drag);
    const struct spline *spline = core->document->splines[s];
    for (int k = curves_knot_from(core, spline, box.x); k < spline->knot_count && !spline->locked; k++) {
        const struct knot *knot = &spline->knots[k];
        const float x = curves_knot_x(core, knot), y = curves_knot_y(curves, core, s, knot);
        if (x >= box.x + box.w) break;
        if (x >= box.x && (curves->knot_drag.in_sheet || rect_contains(box, x, y)))
            selection_set(&core->focus.selection, knot->id, curves->knot_drag.box != BOX_REMOVE);
    }
}

static void draw_box(void *room, struct core *core)
{
    const struct curves *curves = room;
    const struct document *document = core->document;
    selection_copy(&core->focus.selection, &curves->before_box);
    if (curves->knot_drag.box == BOX_REPLACE) selection_clear(&core->focus.selection);
    for (int s = 0; curves->knot_drag.in_sheet && s < document->spline_count; s++) {
        if (sheet_row_in(curves, core, s, box_rect(&core->input.drag))) take_inside(curves, core, s);
    }
    if (curves->knot_drag.in_sheet) return;
    if (spline_list_seen(core)) take_inside(curves, core, core->focus.active);
    for (int i = 0; i < curves->cache.other_count; i++) {
        const int other = curves_other(curves, document, i);
        if (other >= 0) take_inside(curves, core, other);
    }
}

static void show_box(void *room, struct core *core)
{
    const struct curves *curves = room;
    const struct rect r = box_rect(&core->input.drag);
    if (!core->input.drag.moved) return;
    const float outline[] = {r.x, r.y, r.x + r.w, r.y, r.x + r.w, r.y + r.h, r.x, r.y + r.h, r.x, r.y};
    uint32_t color = curves->knot_drag.box == BOX_REMOVE ? theme()->error : theme()->playhead;
    struct rect clip = drawlist_push_clip(&core->list, core->view.layout.curves);
    drawlist_set_clip(&core->list, curves->knot_drag.in_sheet ? core->view.layout.sheet : core->view.layout.plot);
    drawlist_rect(&core->list, r, theme_fade(color, 0.08f));
    drawlist_dashed(&core->list, outline, 5, 1, 4, 3, theme_fade(color, 0.7f));
    drawlist_set_clip(&core->list, clip);
}

void curves_press_empty(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    static const struct drag_owner owner = {
        .cursor = CURSOR_ARROW, .move = draw_box, .end = end_box, .show = show_box};
    struct curves *curves = room;
    const bool keeps = event->mods & (MOD_SHIFT | MOD_CTRL | MOD_ALT), twice = event->clicks == 2;
    const bool on_sheet = hover->thing == &thing_row;
    if (hover->thing && (twice ? on_sheet : !keeps)) core_choose(core, hover->spline);
    if (hover->thing && twice) core_activate(core, hover->spline);
    if (on_sheet && !rect_contains(core->view.layout.sheet, event->x, event->y)) return;
    if (twice) {
        const double value = core_round(curves_value(core, event->y), 0.01 / curves_pixels_per_value(core));
        core_insert_knot(core, curves_frame(core, event->x), hover->thing ? NAN : value,
                         drag_snaps(core, event->mods),
                         hover->thing && event->mods & MOD_SHIFT ? HOLDS_POSE : HOLDS_VALUE);
    } else {
        const bool removes = event->mods & (MOD_CTRL | MOD_ALT);
        const enum box_mode box = removes ? BOX_REMOVE : event->mods & MOD_SHIFT ? BOX_ADD : BOX_REPLACE;
        drag_begin(core, &owner, curves, NULL, event);
        curves->knot_drag = (struct knot_drag){.box = box, .in_sheet = on_sheet};
        selection_copy(&curves->before_box, &core->focus.selection);
    }
}

static bool find_curve(void *room, const struct core *core, const struct target *target, float xy[2])
{
    (void)room;
    return curves_in_plot(core, target->number[0], target->number[1], xy);
}

/// curve(sway,36,1): a frame and a value.
const struct thing thing_curve = {.cursor = CURSOR_HAND,
                                  .hint = "Click to edit this spline",
                                  .press = curves_press_empty,
                                  .name = "curve",
                                  .of = OF_SPLINE,
                                  .numbers = 2,
                                  .find = find_curve,
                                  .missing = "that is not in the visible part of the curves"};

const struct thing thing_active_curve = {
    .hint = "Double-click to insert a knot on the curve, with Shift a pose; drag to select with a box",
    .press = curves_press_empty};

static void press_control(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    (void)room, (void)event;
    if (hover->thing == &thing_seam) core_close_curves(core);
    if (hover->thing == &thing_units) core_flip(core, SWITCH_SECONDS);
    if (hover->thing == &thing_sheet) core_flip(core, SWITCH_SHEET);
}

const struct thing thing_seam = {
    .cursor = CURSOR_HAND,
    .hint = "Playback jumps here, because curves do not end as they start. Click to close all curves",
    .is_control = true,
    .place = ON_TIME,
    .press = press_control,
    .name = "seam",
    .find = find_seam,
    .missing = "playback does not jump there"};

const struct thing thing_units = {.cursor = CURSOR_HAND,
                                  .hint = "Click to switch between frames and seconds (U)",
                                  .is_control = true,
                                  .place = ON_TIME,
                                  .press = press_control};

const struct thing thing_sheet = {.cursor = CURSOR_HAND,
                                  .hint = "Click to open or close the dope sheet (F7)",
                                  .is_control = true,
                                  .place = ON_TIME,
                                  .press = press_control};

static void pan_view(void *room, struct core *core)
{
    curves_pan(room, core, core->input.drag.moved_x, core->input.drag.moved_y);
}

static void move_limit(void *room, struct core *core)
{
    const int handle = ((const struct curves *)room)->knot_drag.handle;
    const struct spline *spline = core_active_spline(core);
    const double by = -core->input.drag.moved_y / curves_pixels_per_value(core);
    const double before = spline->parameter[limit_of(handle)].value,
                 other = spline->parameter[limit_of(!handle)].value;
    double value = core_round(before + by, 0.01 / curves_pixels_per_value(core));
    for (int k = 0; k < spline->knot_count; k++) {
        const double knot = spline->knots[k].value;
        if (spline->knots[k].still) continue;
        value = handle ? fmax(value, knot) : fmin(value, knot);
    }
    if (handle ? value <= other : value >= other) return; // the two limits must not cross, knots or not
    core_set_parameter(core, core->focus.active, limit_of(handle), value);
}

static void press_limit(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    static const struct drag_owner owner = {.cursor = CURSOR_VERTICAL, .apply = move_limit};
    struct curves *curves = room;
    drag_begin(core, &owner, curves, parameter_rows[limit_of(hover->handle)].undo, event);
    core->input.hover = *hover;
    curves->knot_drag = (struct knot_drag){.handle = hover->handle};
}

const struct thing thing_limit = {
    .cursor = CURSOR_VERTICAL, .hint = "Drag the limit; the curve stays on this side of it", .press = press_limit};

const struct thing *const curves_things[] = {&thing_knot,    &thing_mark, &thing_slope, &thing_curve,    &thing_box,
                                             &thing_warning, &thing_seam, &thing_ruler, &thing_pin_time, NULL};

void curves_press(struct curves *curves, struct core *core, const struct event *event)
{
    static const struct drag_owner panning = {.cursor = CURSOR_MOVE, .move = pan_view};
    const bool pans = event->button == BUTTON_MIDDLE || (event->button == BUTTON_LEFT && core->input.space_down);
    if (pans) {
        core->input.space_used = core->input.space_down;
        drag_begin(core, &panning, curves, NULL, event);
        return;
    }
    const struct hover hover = curves_hover(curves, core, event->x, event->y);
    if (event->button == BUTTON_RIGHT) { // what the menu acts on
        core->input.hover = hover;
        if (hover.thing == &thing_knot) {
            core_turn_to(core, hover.spline);
            core->focus.pin = 0;
            if (!selection_has(&core->focus.selection, hover.knot)) core_select_only(core, hover.knot);
        }
        if (hover.thing == &thing_pin_time) {
            const struct rig *rig = core->document->rigs[hover.rig];
            pins_visit(core, &rig->pins[pins_find_id(rig, hover.pin)]);
        }
        if (hover.thing == &thing_curve) core_choose(core, hover.spline);
    }
    if (event->button == BUTTON_RIGHT || hover.thing == &list_row) return;
    if (hover.thing != &thing_pin_time && hover.thing != &thing_ruler) core->focus.pin = 0;
    if (hover.thing) {
        hover.thing->press(curves, core, &hover, event);
    } else if (rect_contains(core->view.layout.plot, event->x, event->y)) {
        curves_press_empty(curves, core, &hover, event);
    }
}

void curves_wheel(struct curves *curves, struct core *core, const struct event *event)
{
    struct ui_list *rows = &curves->sheet.list;
    const bool on_sheet = rect_contains(sheet_area(core), event->x, event->y);
    if (on_sheet && !event->mods && rows->content > rows->view) {
        ui_list_scroll(rows, event->dy > 0 ? -1 : 1);
        return;
    }
    double notches = event->dy != 0 ? event->dy : event->dx; /* some systems turn Shift+wheel sideways */
    double factor = maths_exp(-ZOOM_STEP * fmin(fmax(notches, -20), 20));
    double time = event->mods & MOD_SHIFT && !(event->mods & MOD_CTRL) ? 1 : factor;
    double value = event->mods & MOD_CTRL && !(event->mods & MOD_SHIFT) ? 1 : factor;
    if (on_sheet) value = 1; // the dope sheet zooms time only
    curves_zoom(curves, core, event->x, event->y, time, value);
}

// Warnings on the curves: their marks and fixes.

/// Other curves, and during a drag the active one too, warn only when they swing far beyond their knots. The other warnings would change at
/// every step of a drag.
void warnings_update(struct curves *curves, const struct core *core)
{
    struct warnings *warnings = &curves->warnings;
    const struct spline *spline = spline_list_seen(core);
    const struct evaluation *evaluation = core->evaluation;
    const struct document *document = core->document;
    const bool solved = evaluation && evaluation->samples == document_samples(document),
               drags = core->input.drag.owner;
    const uint64_t state[] = {history_revision(core->history),
                              (uint64_t)(core->focus.active + 1),
                              (uint64_t)core->view.look,
                              solved,
                              solved ? evaluation->revision : 0,
                              drags,
                              curves->cache.key};
    const uint64_t key = hash_bytes(HASH_START, state, sizeof state);
    if (key == curves->warnings_key) return;
    warnings->count = 0;
    curves->warnings_key = key;
    if (!solved) return;
    memset(curves->fixes, 0, sizeof curves->fixes);
    if (spline && drags) warnings_add_far(document, evaluation, core->focus.active, warnings);
    if (spline && !drags) warnings_add(document, evaluation, core->focus.active, warnings);
    for (int i = 0; i < curves->cache.other_count; i++)
        warnings_add_far(document, evaluation, curves_other(curves, document, i), warnings);
}

static bool set_warned(struct document *document, const struct warning *warning, enum parameter parameter,
                       double value, struct error *error)
{
    const struct param param = param_number(value);
    return edit_parameter(document, warning->spline, parameter, &param, error);
}

/// Frees the slope or the phase of the knot at a frame.
static bool free_knot(struct document *document, const struct warning *warning, double frame, bool slope,
                      struct error *error)
{
    const struct spline *spline = document->splines[warning->spline];
    const int k = spline_find_knot(document, spline, document_sample(document, frame));
    if (k < 0) return false;
    struct knot knot = spline->knots[k];
    if (slope) knot.has_slope = false;
    if (!slope) knot.has_phase = false, knot.phase = 0;
    return edit_knot_set(document, warning->spline, &knot, error);
}

/// Remedies for each kind of warning. A later one must beat those before it, and doing nothing, by a factor.
static const struct cure {
    const char *label; ///< of the undo step
    int count;
    double worth;
} cures[] = {
    [WARNING_FAR] = {"Tame swing", 3, 1},         [WARNING_RATE] = {"Add substeps", 2, 1},
    [WARNING_DRIFT] = {"Narrow bandwidth", 1, 1}, [WARNING_FORCED] = {"Free the phase", 3, 1.25},
    [WARNING_SLOPE] = {"Slope off", 1, 1},        [WARNING_PHASE] = {"Free the phase", 1, 1},
    [WARNING_WIND_UP] = {"Wind-up off", 1, 1},    [WARNING_SUDDEN] = {"Lengthen wind-up", 1, 1},
    [WARNING_SETTLES] = {"Settle off", 1, 1},
};

/// Applies a warning's remedy of that rank, the gentlest first, to any document, and describes it in a text that fits after "Click to" and
/// "Done:".
static bool remedy_apply(int rank, struct document *document, const struct warning *warning, char text[FIX_TEXT],
                         struct error *error)
{
    const struct spline *spline = document->splines[warning->spline];
    const bool is_pose = spline_mode(spline) == WIGGLY_COMPLEX; // outside complex mode a plain knot
    const struct knot knot = {.frame = warning->frame,
                              .value = warning->remedy,
                              .has_phase = is_pose,
                              .phase = is_pose ? warning->phase : 0,
                              .stiffness = KNOT_DEFAULT_STIFFNESS};
    const double now = spline->parameter[PARAMETER_FREQUENCY].value;
    const double lower = core_round(0.99 * now * warning->limit / warning->amount, 0.01);
    bool good = true;
    switch (warning->kind) {
    case WARNING_FAR:
        if (rank == 0) {
            snprintf(text, FIX_TEXT, "raise calm to 1");
            return set_warned(document, warning, PARAMETER_CALM, 1, error);
        }
        if (rank == 1) {
            snprintf(text, FIX_TEXT, "set limits from %.6g to %.6g", warning->low, warning->high);
            return set_warned(document, warning, PARAMETER_LOW, warning->low, error) &&
                   set_warned(document, warning, PARAMETER_HIGH, warning->high, error);
        }
        snprintf(text, FIX_TEXT, "add a %s at frame %.6g", is_pose ? "pose" : "knot", warning->frame);
        return edit_knot_insert(document, warning->spline, &knot, error);
    case WARNING_RATE:
        if (rank == 0) { // keeps the motion
            snprintf(text, FIX_TEXT, "use %.0f substeps per frame", warning->remedy);
            return warning->remedy <= SCENE_MAX_SUBSTEPS && edit_substeps(document, (int)warning->remedy, error);
        }
        snprintf(text, FIX_TEXT, "lower the frequency to %.3g Hz", lower);
        return set_warned(document, warning, PARAMETER_FREQUENCY, lower, error);
    case WARNING_DRIFT:
        snprintf(text, FIX_TEXT, "narrow the bandwidth to %.3g", warning->remedy);
        return set_warned(document, warning, PARAMETER_BANDWIDTH, warning->remedy, error);
    case WARNING_FORCED: // the later phase, the earlier one, or both
        snprintf(text, FIX_TEXT,
                 rank == 2 ? "free the phases at frames %.6g and %.6g" : "free the phase at frame %.6g",
                 rank == 0 ? warning->to : warning->from, warning->to);
        return (rank == 1 || free_knot(document, warning, warning->to, false, error)) &&
               (rank == 0 || free_knot(document, warning, warning->from, false, error));
    case WARNING_SLOPE:
        snprintf(text, FIX_TEXT, "switch off the slope at frame %.6g", warning->frame);
        return free_knot(document, warning, warning->frame, true, error);
    case WARNING_PHASE:
        for (int k = 0; k < document->splines[warning->spline]->knot_count && good; k++)
            good = free_knot(document, warning, document->splines[warning->spline]->knots[k].frame, false, error);
        snprintf(text, FIX_TEXT, "turn the spline's poses into plain knots");
        return good;
    case WARNING_WIND_UP:
        snprintf(text, FIX_TEXT, "set the wind-up to 0");
        return set_warned(document, warning, PARAMETER_WIND_UP, 0, error);
    case WARNING_SUDDEN:
        snprintf(text, FIX_TEXT, "lengthen the wind-up to %.3g periods", warning->remedy);
        return set_warned(document, warning, PARAMETER_WIND_UP, warning->remedy, error);
    case WARNING_SETTLES:
        snprintf(text, FIX_TEXT, "let its knots be plain ones");
        return edit_spline_settles(document, warning->spline, false, error);
    }
    return false;
}

/// The chosen fix, cached: the first remedy if it suffices, else the best. They are tried in copies of the document; `trial` keeps earlier
/// results, so only what differs is solved. A kind's only remedy counts as enough.
static const struct fix *fix_of(struct curves *curves, const struct core *core, int index)
{
    struct fix *best = &curves->fixes[index];
    const struct warning *warning = &curves->warnings.list[index];
    const struct cure *cure = &cures[warning->kind];
    const bool has_choice = cure->count > 1;
    if (best->is_chosen) return best;
    struct evaluation trial = {.solver = core->evaluation->solver, .models = core->evaluation->models};
    double least = has_choice ? warning_left(warning, core->document, core->evaluation) : INFINITY;
    *best = (struct fix){.is_chosen = true, .rank = -1};
    for (int rank = 0; rank < cure->count && (rank != 1 || least > 1); rank++) {
        struct fix fix = {true, rank, ""};
        struct error error;
        struct document *document = document_copy(core->document);
        double left = INFINITY;
        if (remedy_apply(rank, document, warning, fix.text, &error)) {
            left = 0;
            if (has_choice) {
                evaluation_update(&trial, document, false);
                left = warning_left(warning, document, &trial);
            }
        }
        document_destroy(document);
        if (left * cure->worth >= least) continue;
        *best = fix;
        least = left;
    }
    evaluation_free(&trial);
    return best;
}

static const char NO_REMEDY[] = "No fix helps here. Move the knots, or change the frequency.";

/// Fixes a warning in one undo step.
static void press_warning(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct curves *curves = room;
    const struct warning warning = curves->warnings.list[hover->handle];
    struct fix fix = *fix_of(curves, core, hover->handle);
    (void)event;
    core_activate(core, warning.spline);
    if (!core_active_spline(core) || !core_step(core, cures[warning.kind].label, 0)) return;
    const bool helps = fix.rank >= 0;
    const bool good = helps && remedy_apply(fix.rank, core->document, &warning, fix.text, &core->step.error);
    if (good || !helps) core_message(core, false, helps ? "Done: %s." : NO_REMEDY, fix.text);
}

void curves_remedy_first(struct curves *curves, struct core *core, int unused)
{
    (void)unused;
    warnings_update(curves, core);
    const bool any = curves->warnings.count > 0;
    if (any) press_warning(curves, core, &(struct hover){.handle = 0}, NULL);
    if (!any) core_message(core, false, "This spline has no warnings.");
}

static const float SIZE = 7; ///< pixels: half a marker

static bool find_warning(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct curves *curves = room;
    const double number = target->number[0];
    bool there = number >= 0 && number < curves->warnings.count;
    return there && warning_place(curves, core, &curves->warnings.list[(int)number], xy);
}

const struct thing thing_warning = {.cursor = CURSOR_HAND,
                                    .hint = "Click to fix; Ctrl+Z undoes it",
                                    .press = press_warning,
                                    .name = "warning",
                                    .numbers = 1,
                                    .find = find_warning,
                                    .missing = "that warning is not to be seen"};

/// The warning under the pointer, or -1.
static int hovered_warning(const struct curves *curves, const struct core *core)
{
    const int index = core->input.hover.handle;
    return core->input.hover.thing == &thing_warning && index < curves->warnings.count ? index : -1;
}

static void mark_show(struct core *core, const float at[2], bool is_hovered)
{
    const float x = at[0], y = at[1], r = is_hovered ? SIZE + 1.5f : SIZE;
    const float corners[] = {x, y - r, x + r, y + 0.8f * r, x - r, y + 0.8f * r};
    drawlist_convex(&core->list, corners, 3, theme()->warning);
    drawlist_rect(&core->list, (struct rect){x - 0.75f, y - 0.4f * r, 1.5f, 0.6f * r}, theme()->panel);
    drawlist_rect(&core->list, (struct rect){x - 0.75f, y + 0.38f * r, 1.5f, 1.5f}, theme()->panel);
}

void warnings_show(const struct curves *curves, struct core *core)
{
    const int hovered = hovered_warning(curves, core);
    float xy[2];
    for (int i = 0; i < curves->warnings.count; i++) {
        if (warning_place(curves, core, &curves->warnings.list[i], xy)) mark_show(core, xy, i == hovered);
    }
    if (seam_place(curves, core, xy)) mark_show(core, xy, core->input.hover.thing == &thing_seam);
}

void warnings_show_words(struct curves *curves, struct core *core)
{
    enum { PAD = 10, LINE = 18 };
    const int index = hovered_warning(curves, core);
    float xy[2];
    if (index < 0 || !warning_place(curves, core, &curves->warnings.list[index], xy)) return;
    char what[WARNING_SENTENCE], click[FIX_TEXT + 16] = "";
    warning_say(&curves->warnings.list[index], what);
    if (!core->input.drag.owner) {
        const struct fix *fix = fix_of(curves, core, index);
        snprintf(click, sizeof click, fix->rank >= 0 ? "Click to %s." : NO_REMEDY, fix->text);
    }
    const struct rect panel = core->view.layout.curves;
    float width =
        fmaxf(font_width(FONT_LABEL, THEME_TEXT_NORMAL, what), font_width(FONT_LABEL, THEME_TEXT_NORMAL, click));
    float w = fminf(width + 2 * PAD, panel.w - 16), h = 2 * LINE + PAD;
    float x = fminf(fmaxf(xy[0] - w / 2, panel.x + 8), panel.x + panel.w - 8 - w);
    float y = xy[1] + 14 + h < panel.y + panel.h ? xy[1] + 14 : xy[1] - 14 - h;
    struct rect box = {roundf(x), roundf(y), w, h};
    drawlist_rounded(&core->list, box, 5, theme()->raised);
    drawlist_rounded_line(&core->list, box, 5, 1, theme_fade(theme()->warning, 0.6f));
    drawlist_text_fit(&core->list, box.x + PAD, box.y + LINE, w - 2 * PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->text, what);
    drawlist_text_fit(&core->list, box.x + PAD, box.y + 2 * LINE, w - 2 * PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->warning, click);
}
