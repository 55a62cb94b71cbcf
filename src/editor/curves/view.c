/// What the panel shows of the curves: pans and zooms, curves of different sizes made as high as the active one, and the way to what is
/// edited.
///
/// Let a … b be the values that the active curve takes and c … d those of another: normalised, the other's value v is drawn where the
/// active one's a + (v − c)·(b − a)/(d − c) is.
#include "editor/core/core.h"
#include "editor/core/selected_knots.h"
#include "editor/curves/state.h"
#include <limits.h>
#include <math.h>

/// Pixels further from the plot than this are the same to the eye, and bounded ones are safe as floats.
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

/// Keeps the visible part wider than rounding and narrower than anyone needs.
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

/// Shows a part, within reason.
static void view_set(struct curves *curves, struct core *core, struct view view)
{
    curves->view = view;
    keep_sane(curves, core);
}

static void include_value(double range[2], double value)
{
    if (!isfinite(value)) return;
    range[0] = fmin(range[0], value);
    range[1] = fmax(range[1], value);
}

/// Sets the visible values to a range with a margin; a flat one gets a unit around it.
static void show_values(struct view *view, const double range[2])
{
    double span = range[1] - range[0];
    if (!isfinite(span)) {
        view->value0 = -1;
        view->value1 = 1;
        return;
    }
    double margin = span > 1e-9 * fmax(fabs(range[0]), fabs(range[1])) && span > 1e-9 ? 0.12 * span : 1;
    view->value0 = range[0] - margin;
    view->value1 = range[1] + margin;
}

/// Makes room for what else is drawn of the active spline: its imaginary part, and what it swings about.
static void include_rest(struct curves *curves, const struct core *core)
{
    enum { COLUMNS = 200 };
    const double margin = 0.06, last = document_samples(core->document) - 1;
    struct view *view = &curves->view;
    double range[2] = {view->value0, view->value1};
    for (int column = 0; column <= COLUMNS && core->active >= 0; column++) {
        const wiggly_value v = evaluation_at(core->evaluation, core->active, last * column / COLUMNS);
        include_value(range, v.y);
        include_value(range, v.y + v.im);
    }
    const double span = range[1] - range[0];
    if (range[0] < view->value0) view->value0 = range[0] - margin * span;
    if (range[1] > view->value1) view->value1 = range[1] + margin * span;
}

/// The view stays where it is, whatever was edited.
static void follow_stop(struct curves *curves, struct core *core)
{
    curves->following = (struct following){0};
    core->edited = (struct edited){0};
}

void curves_frame_all(struct curves *curves, struct core *core)
{
    follow_stop(curves, core);
    const struct document *document = core->document;
    const struct evaluation *evaluation = core->evaluation;
    double range[2] = {INFINITY, -INFINITY};
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = document->splines[s];
        if (core->curves.normalise && s != core->active) continue;
        for (int k = 0; k < spline->knot_count; k++) include_value(range, spline->knots[k].value);
        if (!evaluation || s >= evaluation->count) continue;
        for (int highest = 0; highest < 2 && evaluation->samples > 0; highest++) {
            int sample = evaluation_extreme(evaluation, s, 0, evaluation->samples - 1, highest);
            include_value(range, evaluation->curves[s].total[sample]);
        }
    }
    show_values(&curves->view, range);
    include_rest(curves, core);
    double frames = document->last_frame - document->first_frame;
    curves->view.frame0 = document->first_frame - fmax(0.02 * frames, 0.5);
    curves->view.frame1 = document->last_frame + fmax(0.02 * frames, 0.5);
    keep_sane(curves, core);
}

/// Widens a range to what a curve does in the frames that are in sight.
static void include_part(const struct curves *curves, const struct core *core, int spline, double range[2])
{
    enum { COLUMNS = 200 };
    const struct value_map map = normal_map(curves, core, spline);
    for (int column = 0; column <= COLUMNS; column++) {
        double frame = curves->view.frame0 + (curves->view.frame1 - curves->view.frame0) * column / COLUMNS;
        wiggly_value v = evaluation_at(core->evaluation, spline, core_position(core->document, frame));
        include_value(range, map.scale * (v.y + v.re) + map.offset);
    }
}

void curves_frame_selection(struct curves *curves, struct core *core)
{
    const struct document *document = core->document;
    double values[2] = {INFINITY, -INFINITY};
    double frames[2] = {INFINITY, -INFINITY};
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) {
        const struct value_map map = normal_map(curves, core, at.spline);
        include_value(values, map.scale * knot_at(document, at)->value + map.offset);
        include_value(frames, knot_at(document, at)->frame);
    }
    if (frames[0] > frames[1]) {
        curves_frame_all(curves, core);
        return;
    }
    double margin = fmax(0.25 * (frames[1] - frames[0]), 6);
    follow_stop(curves, core);
    curves->view.frame0 = frames[0] - margin;
    curves->view.frame1 = frames[1] + margin;
    int seen = -1;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at); seen = at.spline) {
        if (at.spline != seen) include_part(curves, core, at.spline, values);
    }
    show_values(&curves->view, values);
    keep_sane(curves, core);
}

void curves_reveal(struct curves *curves, struct core *core, double frame, double value)
{
    follow_stop(curves, core);
    struct view *view = &curves->view;
    double frames = 0.05 * (view->frame1 - view->frame0);
    double values = 0.05 * (view->value1 - view->value0);
    double dx = fmin(frame - frames - view->frame0, 0) + fmax(frame + frames - view->frame1, 0);
    double dy = fmin(value - values - view->value0, 0) + fmax(value + values - view->value1, 0);
    view->frame0 += dx;
    view->frame1 += dx;
    view->value0 += dy;
    view->value1 += dy;
    keep_sane(curves, core);
}

/// Shows the values v that were shown as scale·v + offset.
static void view_rescale(struct curves *curves, struct core *core, double scale, double offset)
{
    follow_stop(curves, core);
    curves->view.value0 = (curves->view.value0 - offset) / scale;
    curves->view.value1 = (curves->view.value1 - offset) / scale;
    keep_sane(curves, core);
}

void curves_pan(struct curves *curves, struct core *core, double dx, double dy)
{
    follow_stop(curves, core);
    struct view *view = &curves->view;
    double frames = dx / curves_pixels_per_frame(curves, core);
    double values = dy / curves_pixels_per_value(curves, core);
    view->frame0 -= frames;
    view->frame1 -= frames;
    view->value0 += values;
    view->value1 += values;
    keep_sane(curves, core);
}

void curves_zoom(struct curves *curves, struct core *core, float x, float y, double time_factor, double value_factor)
{
    follow_stop(curves, core);
    struct view *view = &curves->view;
    double frame = curves_frame(curves, core, x);
    double value = curves_value(curves, core, y);
    view->frame0 = frame + (view->frame0 - frame) * time_factor;
    view->frame1 = frame + (view->frame1 - frame) * time_factor;
    view->value0 = value + (view->value0 - value) * value_factor;
    view->value1 = value + (view->value1 - value) * value_factor;
    keep_sane(curves, core);
}

/// Samples that are in sight.
static void curves_span(const struct curves *curves, const struct document *document, int *first, int *count)
{
    double last = document_samples(document) - 1;
    double left = fmin(fmax(floor(core_position(document, curves->view.frame0)), 0), last);
    double right = fmin(fmax(ceil(core_position(document, curves->view.frame1)), 0), last);
    *first = (int)left;
    *count = (int)(right - left) + 1;
}

static bool has_height(const double range[2]) { return range[1] - range[0] > 1e-12 * fmax(1, fabs(range[0])); }

/// Where the values of one spline are drawn as those of another.
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
    view_rescale(curves, core, map.scale, map.offset);
}

static const double RATE = 14;     ///< of the way that is left, a second
static const double CLOSE = 0.25;  ///< pixels: it is there
static const double MARGIN = 0.06; ///< of what is seen, beyond what was edited
static const double WIDEST = 1.7;  ///< of the visible frames: what needs more is panned to

bool follow_moves(const struct curves *curves) { return curves->following.moves; }

/// Widens a range to the values, as they are drawn, that a curve takes from a sample to another, as far as these are in sight.
static void include_curve(const struct curves *curves, const struct core *core, int spline, int first, int last,
                          struct view *edited)
{
    const struct evaluation *evaluation = core->evaluation;
    const struct value_map map = normal_map(curves, core, spline);
    int seen, count;
    if (!evaluation || spline >= evaluation->count || evaluation->samples == 0) return;
    curves_span(curves, core->document, &seen, &count);
    const int end = seen + count < evaluation->samples ? seen + count - 1 : evaluation->samples - 1;
    first = first > seen ? first : seen;
    last = last < end ? last : end;
    for (int highest = 0; highest < 2 && first <= last; highest++) {
        const int sample = evaluation_extreme(evaluation, spline, first, last, highest);
        const double value = map.scale * evaluation->curves[spline].total[sample] + map.offset;
        if (!isfinite(value)) continue;
        edited->value0 = fmin(edited->value0, value);
        edited->value1 = fmax(edited->value1, value);
    }
}

/// Widens a range to a knot, and the curve from the knot before to the one after it.
static void include_knot(const struct curves *curves, const struct core *core, struct knot_place at,
                         struct view *edited)
{
    const struct document *document = core->document;
    const struct spline *spline = document->splines[at.spline];
    const struct knot *knot = &spline->knots[at.knot];
    const struct value_map map = normal_map(curves, core, at.spline);
    const double value = map.scale * knot->value + map.offset;
    const bool has_next = at.knot + 1 < spline->knot_count;
    const int first = at.knot > 0 ? document_sample(document, knot[-1].frame) : 0;
    const int last = has_next ? document_sample(document, knot[1].frame) : document_samples(document) - 1;
    *edited = (struct view){fmin(edited->frame0, knot->frame), fmax(edited->frame1, knot->frame),
                            fmin(edited->value0, value), fmax(edited->value1, value)};
    include_curve(curves, core, at.spline, first, last, edited);
}

/// The frames and values of all that was edited since the last picture; of splines only values, where they are in sight.
static struct view edited_part(const struct curves *curves, const struct core *core)
{
    const struct edited *edited = &core->edited;
    const struct document *document = core->document;
    struct view part = {INFINITY, -INFINITY, INFINITY, -INFINITY};
    for (struct knot_place at = SELECTED_START; edited->selection && selected_next(core, &at);)
        include_knot(curves, core, at, &part);
    for (int i = 0; i < edited->count; i++)
        include_curve(curves, core, edited->spline[i], 0, document_samples(document) - 1, &part);
    return part;
}

/// Moves the edges of what is seen out to what has to be; where that would be too wide, all of it by what is missing.
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
    const bool is_measured = core->drag.owner && core->drag.room == curves; // which must hold still then
    if (!following->moves || is_measured) return;
    const double share = 1 - exp(-RATE * fmax(dt, 0));
    struct view *view = &curves->view;
    const struct view *goal = &following->goal;
    const double left[4] = {goal->frame0 - view->frame0, goal->frame1 - view->frame1, goal->value0 - view->value0,
                            goal->value1 - view->value1};
    const double frames = fmax(fabs(left[0]), fabs(left[1])) * curves_pixels_per_frame(curves, core);
    const double values = fmax(fabs(left[2]), fabs(left[3])) * curves_pixels_per_value(curves, core);
    const bool there = fmax(frames, values) < CLOSE;
    view_set(curves, core,
             there ? *goal
                   : (struct view){view->frame0 + share * left[0], view->frame1 + share * left[1],
                                   view->value0 + share * left[2], view->value1 + share * left[3]});
    following->moves = !there;
}
