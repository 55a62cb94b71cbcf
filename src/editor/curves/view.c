/// The visible part of the curves panel: panning, zooming, normalised curves, and following edits. A normalised curve with values c … d is
/// drawn over the active curve's a … b: v at a + (v − c)·(b − a)/(d − c).
#include "editor/core/core.h"
#include "editor/core/selection.h"
#include "editor/curves/state.h"
#include "maths/maths.h"
#include <limits.h>
#include <math.h>

/// Pixels from the plot. Points further away look the same, and clamped ones are safe as floats.
static const double FAR_PIXELS = 4000;

static double bounded(double pixels, double lo, double hi)
{
    return fmin(fmax(pixels, lo - FAR_PIXELS), hi + FAR_PIXELS);
}

double curves_pixels_per_frame(const struct curves *curves, const struct core *core)
{
    return core->layout.plot.w / (curves->view.frame1 - curves->view.frame0);
}

double curves_pixels_per_value(const struct curves *curves, const struct core *core)
{
    return core->layout.plot.h / (curves->view.value1 - curves->view.value0);
}

float curves_x(const struct curves *curves, const struct core *core, double frame)
{
    const struct rect *plot = &core->layout.plot;
    double x = plot->x + (frame - curves->view.frame0) * curves_pixels_per_frame(curves, core);
    return (float)bounded(x, plot->x, plot->x + plot->w);
}

float curves_knot_x(const struct curves *curves, const struct core *core, const struct knot *knot)
{
    return curves_x(curves, core, document_frame(core->document, document_sample(core->document, knot->frame)));
}

int curves_knot_from(const struct curves *curves, const struct core *core, const struct spline *spline, double x)
{
    const double sample = floor(core_position(core->document, curves_frame(curves, core, x)));
    return spline_lower_bound(core->document, spline, (int)fmin(fmax(sample, INT_MIN), INT_MAX));
}

float curves_y(const struct curves *curves, const struct core *core, double value)
{
    const struct rect *plot = &core->layout.plot;
    double y = plot->y + (curves->view.value1 - value) * curves_pixels_per_value(curves, core);
    return (float)bounded(y, plot->y, plot->y + plot->h);
}

double curves_frame(const struct curves *curves, const struct core *core, double x)
{
    return curves->view.frame0 + (x - core->layout.plot.x) / curves_pixels_per_frame(curves, core);
}

double curves_value(const struct curves *curves, const struct core *core, double y)
{
    return curves->view.value1 - (y - core->layout.plot.y) / curves_pixels_per_value(curves, core);
}

/// Keeps the view wider than rounding errors and within a sensible maximum.
static void keep_sane(struct curves *curves, struct core *core)
{
    struct view *view = &curves->view;
    double frames = fmin(fmax(view->frame1 - view->frame0, 0.5), 1e8);
    double values = fmin(fmax(view->value1 - view->value0, 1e-9), 1e15);
    double frame = fmin(fmax((view->frame0 + view->frame1) / 2, -1e9), 1e9);
    double value = fmin(fmax((view->value0 + view->value1) / 2, -1e15), 1e15);
    values = fmax(values, fabs(value) * 1e-9);
    *view = (struct view){frame - frames / 2, frame + frames / 2, value - values / 2, value + values / 2};
    core->visible = view->value1 - view->value0;
}

/// An empty view, before anything is included.
static const struct view NOTHING = {INFINITY, -INFINITY, INFINITY, -INFINITY};

static void include_value(struct view *part, double value)
{
    if (!isfinite(value)) return;
    part->value0 = fmin(part->value0, value);
    part->value1 = fmax(part->value1, value);
}

/// Widens a view to a knot.
static void include_knot(const struct curves *curves, const struct core *core, struct knot_place at,
                         struct view *part)
{
    const struct value_map map = normal_map(curves, core, at.spline);
    const struct knot *knot = knot_at(core->document, at);
    part->frame0 = fmin(part->frame0, knot->frame);
    part->frame1 = fmax(part->frame1, knot->frame);
    include_value(part, map.scale * core_knot_value(core, at.spline, knot) + map.offset);
}

/// Widens a view to the drawn values of a curve between two samples.
static void include_curve(const struct curves *curves, const struct core *core, int spline, double first, double last,
                          struct view *part)
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
                         struct view *part)
{
    const double left = floor(core_position(core->document, curves->view.frame0));
    const double right = ceil(core_position(core->document, curves->view.frame1));
    include_curve(curves, core, spline, fmax(first, fmax(left, 0)), fmin(last, right), part);
}

/// Fits the visible values to those of `part` with a margin; a flat part gets one unit.
static void show_values(struct view *view, const struct view *part)
{
    const double span = part->value1 - part->value0, largest = fmax(fabs(part->value0), fabs(part->value1));
    const double margin = span > 1e-9 * largest && span > 1e-9 ? 0.12 * span : 1;
    const bool known = isfinite(span);
    view->value0 = known ? part->value0 - margin : -1;
    view->value1 = known ? part->value1 + margin : 1;
}

/// Includes the phase curve and the equilibrium of the active spline.
static void include_rest(struct curves *curves, const struct core *core)
{
    enum { COLUMNS = 200 };
    const double margin = 0.06, last = document_samples(core->document) - 1;
    struct view *view = &curves->view;
    struct view part = *view;
    for (int column = 0; column <= COLUMNS && core->active >= 0; column++) {
        const wiggly_value v = evaluation_at(core->evaluation, core->active, last * column / COLUMNS);
        include_value(&part, v.y);
        include_value(&part, v.y + v.im);
    }
    const double span = part.value1 - part.value0;
    if (part.value0 < view->value0) view->value0 = part.value0 - margin * span;
    if (part.value1 > view->value1) view->value1 = part.value1 + margin * span;
}

static void follow_stop(struct curves *curves, struct core *core)
{
    curves->following = (struct following){0};
    core->edited = (struct edited){0};
}

/// Sets the view within limits, and stops following edits.
static void view_set(struct curves *curves, struct core *core, struct view view)
{
    follow_stop(curves, core);
    curves->view = view;
    keep_sane(curves, core);
}

void curves_frame_all(struct curves *curves, struct core *core)
{
    const struct document *document = core->document;
    struct view part = NOTHING;
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = document->splines[s];
        if (core->curves.normalise && s != core->active) continue;
        for (int k = 0; k < spline->knot_count; k++)
            include_value(&part, core_knot_value(core, s, &spline->knots[k]));
        include_curve(curves, core, s, 0, INFINITY, &part);
    }
    show_values(&curves->view, &part);
    include_rest(curves, core);
    const double margin = fmax(0.02 * (document->last_frame - document->first_frame), 0.5);
    view_set(curves, core,
             (struct view){document->first_frame - margin, document->last_frame + margin, curves->view.value0,
                           curves->view.value1});
}

void curves_frame_selection(struct curves *curves, struct core *core)
{
    struct view part = NOTHING;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) include_knot(curves, core, at, &part);
    if (part.frame0 > part.frame1) {
        curves_frame_all(curves, core);
        return;
    }
    const double margin = fmax(0.25 * (part.frame1 - part.frame0), 6);
    curves->view.frame0 = part.frame0 - margin;
    curves->view.frame1 = part.frame1 + margin;
    int seen = -1;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at); seen = at.spline) {
        if (at.spline != seen) include_seen(curves, core, at.spline, 0, INFINITY, &part);
    }
    show_values(&curves->view, &part);
    view_set(curves, core, curves->view);
}

static void shift(struct curves *curves, struct core *core, double frames, double values)
{
    const struct view *v = &curves->view;
    view_set(curves, core,
             (struct view){v->frame0 + frames, v->frame1 + frames, v->value0 + values, v->value1 + values});
}

void curves_reveal(struct curves *curves, struct core *core, double frame, double value)
{
    const struct view *view = &curves->view;
    const double frames = 0.05 * (view->frame1 - view->frame0), values = 0.05 * (view->value1 - view->value0);
    shift(curves, core, fmin(frame - frames - view->frame0, 0) + fmax(frame + frames - view->frame1, 0),
          fmin(value - values - view->value0, 0) + fmax(value + values - view->value1, 0));
}

void curves_pan(struct curves *curves, struct core *core, double dx, double dy)
{
    shift(curves, core, -dx / curves_pixels_per_frame(curves, core), dy / curves_pixels_per_value(curves, core));
}

void curves_zoom(struct curves *curves, struct core *core, float x, float y, double time_factor, double value_factor)
{
    const struct view *view = &curves->view;
    const double frame = curves_frame(curves, core, x), value = curves_value(curves, core, y);
    view_set(curves, core,
             (struct view){frame + (view->frame0 - frame) * time_factor, frame + (view->frame1 - frame) * time_factor,
                           value + (view->value0 - value) * value_factor,
                           value + (view->value1 - value) * value_factor});
}

static bool has_height(const double range[2]) { return range[1] - range[0] > 1e-12 * fmax(1, fabs(range[0])); }

/// Maps the values of one spline to those of another.
static struct value_map map_between(const struct curves *curves, const struct core *core, int active, int spline)
{
    const struct value_map as_it_is = {1, 0};
    const struct curve_cache *cache = &curves->cache;
    bool known = spline < cache->range_count && active >= 0 && active < cache->range_count;
    if (!core->curves.normalise || spline == active || !known) return as_it_is;
    const double *to = cache->range[active], *from = cache->range[spline];
    if (!has_height(to)) return as_it_is;
    if (!has_height(from)) return (struct value_map){1, (to[0] + to[1]) / 2 - from[0]};
    double scale = (to[1] - to[0]) / (from[1] - from[0]);
    return (struct value_map){scale, to[0] - scale * from[0]};
}

struct value_map normal_map(const struct curves *curves, const struct core *core, int spline)
{
    return map_between(curves, core, core->active, spline);
}

float curves_y_of(const struct curves *curves, const struct core *core, int spline, double value)
{
    struct value_map map = normal_map(curves, core, spline);
    return curves_y(curves, core, map.scale * value + map.offset);
}

float curves_knot_y(const struct curves *curves, const struct core *core, int spline, const struct knot *knot)
{
    return curves_y_of(curves, core, spline, core_knot_value(core, spline, knot));
}

void normal_update(struct curves *curves, const struct core *core)
{
    struct curve_cache *cache = &curves->cache;
    const struct evaluation *evaluation = core->evaluation;
    if (!core->curves.normalise || core->drag.owner || !evaluation) return;
    cache->range_count = evaluation->count < CURVES_MAX_RANGES ? evaluation->count : CURVES_MAX_RANGES;
    for (int s = 0; s < cache->range_count; s++) {
        for (int highest = 0; highest < 2; highest++) {
            int sample = evaluation_extreme(evaluation, s, 0, evaluation->samples - 1, highest);
            cache->range[s][highest] = evaluation->curves[s].total[sample];
        }
    }
}

void curves_activate(struct curves *curves, struct core *core, int before)
{
    const struct value_map map = map_between(curves, core, before, core->active);
    const struct view *view = &curves->view;
    view_set(curves, core,
             (struct view){view->frame0, view->frame1, (view->value0 - map.offset) / map.scale,
                           (view->value1 - map.offset) / map.scale});
}

static const double RATE = 14;     ///< share of the remaining distance per second
static const double CLOSE = 0.25;  ///< pixels: close enough to stop
static const double MARGIN = 0.06; ///< of the view, around the edit
static const double WIDEST = 1.7;  ///< of the visible frames; further edits pan instead

/// Widens a view to a knot and to the curve between its neighbours.
static void include_around(const struct curves *curves, const struct core *core, struct knot_place at,
                           struct view *part)
{
    const struct document *document = core->document;
    const struct knot *knot = knot_at(document, at);
    const bool has_next = at.knot + 1 < document->splines[at.spline]->knot_count;
    include_knot(curves, core, at, part);
    const double first = at.knot > 0 ? document_sample(document, knot[-1].frame) : 0;
    const double last = has_next ? (double)document_sample(document, knot[1].frame) : INFINITY;
    include_seen(curves, core, at.spline, first, last, part);
}

/// Frames and values of everything edited since the last frame; for splines only the visible values.
static struct view edited_part(const struct curves *curves, const struct core *core)
{
    const struct edited *edited = &core->edited;
    struct view part = NOTHING;
    for (struct knot_place at = SELECTED_START; edited->selection && selected_next(core, &at);)
        include_around(curves, core, at, &part);
    for (int i = 0; i < edited->count; i++) include_seen(curves, core, edited->spline[i], 0, INFINITY, &part);
    return part;
}

/// Widens the view to the edit, or pans if that would be too wide.
static void widen(double *low, double *high, const double part[2], double widest)
{
    const double least = fmin(*low, part[0]), most = fmax(*high, part[1]), span = *high - *low;
    if (least >= *low && most <= *high) return;
    const double margin = MARGIN * (most - least);
    if (most - least <= widest * span) {
        if (least < *low) *low = least - margin;
        if (most > *high) *high = most + margin;
        return;
    }
    const double by = part[0] < *low ? part[0] - margin - *low : part[1] + margin - *high;
    *low += by;
    *high += by;
}

void follow_edits(struct curves *curves, struct core *core)
{
    struct following *following = &curves->following;
    if (!core->edited.selection && core->edited.count == 0) return;
    const struct view edited = edited_part(curves, core);
    struct view goal = following->moves ? following->goal : curves->view;
    if (edited.frame0 <= edited.frame1)
        widen(&goal.frame0, &goal.frame1, (double[2]){edited.frame0, edited.frame1}, WIDEST);
    if (edited.value0 <= edited.value1)
        widen(&goal.value0, &goal.value1, (double[2]){edited.value0, edited.value1}, INFINITY);
    const bool moves = goal.frame0 != curves->view.frame0 || goal.frame1 != curves->view.frame1 ||
                       goal.value0 != curves->view.value0 || goal.value1 != curves->view.value1;
    *following = (struct following){.moves = moves, .goal = goal};
    core->edited = (struct edited){0};
}

void curves_advance(struct curves *curves, struct core *core, double dt)
{
    keep_ghost(curves, core);
    struct following *following = &curves->following;
    const bool is_measured = core->drag.owner && core->drag.room == curves; // curves must not rescale during a drag
    if (!following->moves || is_measured) return;
    const double share = 1 - maths_exp(-RATE * fmax(dt, 0));
    const struct view *view = &curves->view, *goal = &following->goal;
    const double left[4] = {goal->frame0 - view->frame0, goal->frame1 - view->frame1, goal->value0 - view->value0,
                            goal->value1 - view->value1};
    const double frames = fmax(fabs(left[0]), fabs(left[1])) * curves_pixels_per_frame(curves, core);
    const double values = fmax(fabs(left[2]), fabs(left[3])) * curves_pixels_per_value(curves, core);
    const bool there = fmax(frames, values) < CLOSE;
    curves->view = there ? *goal
                         : (struct view){view->frame0 + share * left[0], view->frame1 + share * left[1],
                                         view->value0 + share * left[2], view->value1 + share * left[3]};
    keep_sane(curves, core);
    following->moves = !there;
}
