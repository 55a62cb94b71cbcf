/// What part of time and value the curves panel shows.
#include "editor/curves/view.h"
#include "editor/core/core.h"
#include "editor/core/picked.h"
#include "editor/curves/curves.h"
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

float curves_knot_x(const struct curves *curves, const struct core *core, const struct document *document,
                    const struct knot *knot)
{
    return curves_x(curves, core, document_frame(document, document_sample(document, knot->frame)));
}

int curves_knot_from(const struct curves *curves, const struct core *core, const struct document *document,
                     const struct spline *spline, double x)
{
    const double sample = floor(core_position(document, curves_frame(curves, core, x)));
    return spline_lower_bound(document, spline, (int)fmin(fmax(sample, INT_MIN), INT_MAX));
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

void view_set(struct curves *curves, struct core *core, struct view view)
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
static void include_rest(struct curves *curves, const struct core *core, const struct editor_world *world)
{
    enum { COLUMNS = 200 };
    const double margin = 0.06, last = document_samples(world->document) - 1;
    struct view *view = &curves->view;
    double range[2] = {view->value0, view->value1};
    for (int column = 0; column <= COLUMNS && core->active >= 0; column++) {
        const wiggly_value v = evaluation_at(world->evaluation, core->active, last * column / COLUMNS);
        include_value(range, v.y);
        include_value(range, v.y + v.im);
    }
    const double span = range[1] - range[0];
    if (range[0] < view->value0) view->value0 = range[0] - margin * span;
    if (range[1] > view->value1) view->value1 = range[1] + margin * span;
}

void curves_frame_all(struct curves *curves, struct core *core, const struct editor_world *world)
{
    follow_stop(curves, core);
    const struct document *document = world->document;
    const struct evaluation *evaluation = world->evaluation;
    double range[2] = {INFINITY, -INFINITY};
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = &document->splines[s];
        if (curves->options.normalise && s != core->active) continue;
        for (int k = 0; k < spline->knot_count; k++) include_value(range, spline->knots[k].value);
        if (!evaluation || s >= evaluation->count) continue;
        for (int highest = 0; highest < 2 && evaluation->samples > 0; highest++) {
            int sample = evaluation_extreme(evaluation, s, 0, evaluation->samples - 1, highest);
            include_value(range, evaluation->curves[s].total[sample]);
        }
    }
    show_values(&curves->view, range);
    include_rest(curves, core, world);
    double frames = document->last_frame - document->first_frame;
    curves->view.frame0 = document->first_frame - fmax(0.02 * frames, 0.5);
    curves->view.frame1 = document->last_frame + fmax(0.02 * frames, 0.5);
    keep_sane(curves, core);
}

/// Widens a range to what a curve does in the frames that are in sight.
static void include_part(const struct curves *curves, const struct core *core, const struct editor_world *world,
                         int spline, double range[2])
{
    enum { COLUMNS = 200 };
    const struct value_map map = normal_map(curves, core, spline);
    for (int column = 0; column <= COLUMNS; column++) {
        double frame = curves->view.frame0 + (curves->view.frame1 - curves->view.frame0) * column / COLUMNS;
        wiggly_value v = evaluation_at(world->evaluation, spline, core_position(world->document, frame));
        include_value(range, map.scale * (v.y + v.re) + map.offset);
    }
}

void curves_frame_selection(struct curves *curves, struct core *core, const struct editor_world *world)
{
    const struct document *document = world->document;
    double values[2] = {INFINITY, -INFINITY};
    double frames[2] = {INFINITY, -INFINITY};
    for (struct knot_place at = PICKED_START; picked_next(core, document, &at);) {
        const struct value_map map = normal_map(curves, core, at.spline);
        include_value(values, map.scale * knot_at(document, at)->value + map.offset);
        include_value(frames, knot_at(document, at)->frame);
    }
    if (frames[0] > frames[1]) {
        curves_frame_all(curves, core, world);
        return;
    }
    double margin = fmax(0.25 * (frames[1] - frames[0]), 6);
    follow_stop(curves, core);
    curves->view.frame0 = frames[0] - margin;
    curves->view.frame1 = frames[1] + margin;
    int seen = -1;
    for (struct knot_place at = PICKED_START; picked_next(core, document, &at); seen = at.spline) {
        if (at.spline != seen) include_part(curves, core, world, at.spline, values);
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

void view_rescale(struct curves *curves, struct core *core, double scale, double offset)
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

void curves_span(const struct curves *curves, const struct document *document, int *first, int *count)
{
    double last = document_samples(document) - 1;
    double left = fmin(fmax(floor(core_position(document, curves->view.frame0)), 0), last);
    double right = fmin(fmax(ceil(core_position(document, curves->view.frame1)), 0), last);
    *first = (int)left;
    *count = (int)(right - left) + 1;
}
