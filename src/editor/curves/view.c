/// What part of time and value the curves panel shows.
#include "editor/curves/curves.h"
#include <math.h>

/// Pixels further from the plot than this are the same to the eye, and bounded ones are safe as floats.
static const double FAR_PIXELS = 4000;

static double bounded(double pixels, double lo, double hi)
{
    return fmin(fmax(pixels, lo - FAR_PIXELS), hi + FAR_PIXELS);
}

double curves_pixels_per_frame(const struct editor *editor)
{
    return editor->layout.plot.w / (editor->view.frame1 - editor->view.frame0);
}

double curves_pixels_per_value(const struct editor *editor)
{
    return editor->layout.plot.h / (editor->view.value1 - editor->view.value0);
}

float curves_x(const struct editor *editor, double frame)
{
    const struct rect *plot = &editor->layout.plot;
    double x = plot->x + (frame - editor->view.frame0) * curves_pixels_per_frame(editor);
    return (float)bounded(x, plot->x, plot->x + plot->w);
}

float curves_y(const struct editor *editor, double value)
{
    const struct rect *plot = &editor->layout.plot;
    double y = plot->y + (editor->view.value1 - value) * curves_pixels_per_value(editor);
    return (float)bounded(y, plot->y, plot->y + plot->h);
}

double curves_frame(const struct editor *editor, double x)
{
    return editor->view.frame0 + (x - editor->layout.plot.x) / curves_pixels_per_frame(editor);
}

double curves_value(const struct editor *editor, double y)
{
    return editor->view.value1 - (y - editor->layout.plot.y) / curves_pixels_per_value(editor);
}

double round_value(double value, double resolution)
{
    double exponent = floor(log10(resolution));
    double power = pow(10, fabs(exponent));
    double rounded = exponent < 0 ? round(value * power) / power : round(value / power) * power;
    return isfinite(rounded) && fabs(value) < 1e15 * resolution ? rounded : value;
}

double curves_position(const struct document *document, double frame)
{
    return (frame - document->first_frame) * document->substeps;
}

wiggly_value curves_solved(const struct editor_world *world, int spline, double position)
{
    return evaluation_at(world->evaluation, spline, position);
}

struct focus editor_focus(const struct editor *editor, const struct document *document)
{
    double last = document_samples(document) - 1;
    double first = fmin(fmax(floor(curves_position(document, editor->view.frame0)), 0), last);
    double end = fmin(fmax(ceil(curves_position(document, editor->view.frame1)), 0), last);
    return (struct focus){.spline = editor->active < document->spline_count ? editor->active : -1,
                          .first = (int)first,
                          .count = (int)(end - first) + 1,
                          .at = (int)fmin(fmax(editor->playback.position, 0), last)};
}

/// Keeps the visible part wider than rounding and narrower than anyone needs.
static void keep_sane(struct view *view)
{
    double frames = fmin(fmax(view->frame1 - view->frame0, 0.5), 1e8);
    double values = fmin(fmax(view->value1 - view->value0, 1e-9), 1e15);
    double frame = fmin(fmax((view->frame0 + view->frame1) / 2, -1e9), 1e9);
    double value = fmin(fmax((view->value0 + view->value1) / 2, -1e15), 1e15);
    values = fmax(values, fabs(value) * 1e-9);
    *view = (struct view){frame - frames / 2, frame + frames / 2, value - values / 2, value + values / 2};
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

void view_frame_all(struct editor *editor, const struct editor_world *world)
{
    const struct document *document = world->document;
    const struct evaluation *evaluation = world->evaluation;
    double range[2] = {INFINITY, -INFINITY};
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = &document->splines[s];
        if (editor->options.normalise && s != editor->active) continue;
        for (int k = 0; k < spline->knot_count; k++) include_value(range, spline->knots[k].value);
        if (!evaluation || s >= evaluation->count) continue;
        for (int highest = 0; highest < 2 && evaluation->samples > 0; highest++) {
            int sample = evaluation_extreme(evaluation, s, 0, evaluation->samples - 1, highest);
            include_value(range, evaluation->curves[s].total[sample]);
        }
    }
    show_values(&editor->view, range);
    double frames = document->last_frame - document->first_frame;
    editor->view.frame0 = document->first_frame - fmax(0.02 * frames, 0.5);
    editor->view.frame1 = document->last_frame + fmax(0.02 * frames, 0.5);
    keep_sane(&editor->view);
}

void view_frame_selection(struct editor *editor, const struct editor_world *world)
{
    const struct spline *spline = editor_active_spline(editor, world);
    double values[2] = {INFINITY, -INFINITY};
    double frames[2] = {INFINITY, -INFINITY};
    for (int k = 0; spline && k < spline->knot_count; k++) {
        if (!selection_has(&editor->selection, spline->knots[k].id)) continue;
        include_value(values, spline->knots[k].value);
        include_value(frames, spline->knots[k].frame);
    }
    if (frames[0] > frames[1]) {
        view_frame_all(editor, world);
        return;
    }
    double margin = fmax(0.25 * (frames[1] - frames[0]), 6);
    editor->view.frame0 = frames[0] - margin;
    editor->view.frame1 = frames[1] + margin;
    for (int column = 0; column <= 200; column++) {
        double frame = editor->view.frame0 + (editor->view.frame1 - editor->view.frame0) * column / 200;
        wiggly_value v = curves_solved(world, editor->active, curves_position(world->document, frame));
        include_value(values, v.y + v.re);
    }
    show_values(&editor->view, values);
    keep_sane(&editor->view);
}

void view_reveal(struct editor *editor, double frame, double value)
{
    struct view *view = &editor->view;
    double frames = 0.05 * (view->frame1 - view->frame0);
    double values = 0.05 * (view->value1 - view->value0);
    double dx = fmin(frame - frames - view->frame0, 0) + fmax(frame + frames - view->frame1, 0);
    double dy = fmin(value - values - view->value0, 0) + fmax(value + values - view->value1, 0);
    view->frame0 += dx;
    view->frame1 += dx;
    view->value0 += dy;
    view->value1 += dy;
    keep_sane(view);
}

void view_rescale(struct editor *editor, double scale, double offset)
{
    editor->view.value0 = (editor->view.value0 - offset) / scale;
    editor->view.value1 = (editor->view.value1 - offset) / scale;
    keep_sane(&editor->view);
}

void view_pan(struct editor *editor, double dx, double dy)
{
    struct view *view = &editor->view;
    double frames = dx / curves_pixels_per_frame(editor);
    double values = dy / curves_pixels_per_value(editor);
    view->frame0 -= frames;
    view->frame1 -= frames;
    view->value0 += values;
    view->value1 += values;
    keep_sane(view);
}

void view_zoom(struct editor *editor, float x, float y, double time_factor, double value_factor)
{
    struct view *view = &editor->view;
    double frame = curves_frame(editor, x);
    double value = curves_value(editor, y);
    view->frame0 = frame + (view->frame0 - frame) * time_factor;
    view->frame1 = frame + (view->frame1 - frame) * time_factor;
    view->value0 = value + (view->value0 - value) * value_factor;
    view->value1 = value + (view->value1 - value) * value_factor;
    keep_sane(view);
}
