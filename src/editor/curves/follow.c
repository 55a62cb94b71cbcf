/// The view follows what is edited: where that leaves the panel, the view widens just far enough, smoothly and never under a drag
/// in the panel itself.
#include "editor/core/core.h"
#include "editor/core/picked.h"
#include "editor/curves/curves.h"
#include "editor/curves/view.h"
#include <math.h>

static const double RATE = 14;     ///< of the way that is left, a second
static const double CLOSE = 0.25;  ///< pixels: it is there
static const double MARGIN = 0.06; ///< of what is seen, beyond what was edited
static const double WIDEST = 1.7;  ///< of the visible frames: what needs more is panned to

void follow_stop(struct curves *curves, struct core *core)
{
    curves->following = (struct following){0};
    core->edited = (struct edited){0};
}

bool follow_moves(const struct curves *curves) { return curves->following.moves; }

/// Widens a range to the values, as they are drawn, that a curve takes from a sample to another, as far as these are in sight.
static void include_curve(const struct curves *curves, const struct core *core, const struct editor_world *world,
                          int spline, int first, int last, struct view *edited)
{
    const struct evaluation *evaluation = world->evaluation;
    const struct value_map map = normal_map(curves, core, spline);
    int seen, count;
    if (!evaluation || spline >= evaluation->count || evaluation->samples == 0) return;
    curves_span(curves, world->document, &seen, &count);
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
static void include_knot(const struct curves *curves, const struct core *core, const struct editor_world *world,
                         struct knot_place at, struct view *edited)
{
    const struct document *document = world->document;
    const struct spline *spline = &document->splines[at.spline];
    const struct knot *knot = &spline->knots[at.knot];
    const struct value_map map = normal_map(curves, core, at.spline);
    const double value = map.scale * knot->value + map.offset;
    const bool has_next = at.knot + 1 < spline->knot_count;
    const int first = at.knot > 0 ? document_sample(document, knot[-1].frame) : 0;
    const int last = has_next ? document_sample(document, knot[1].frame) : document_samples(document) - 1;
    *edited = (struct view){fmin(edited->frame0, knot->frame), fmax(edited->frame1, knot->frame),
                            fmin(edited->value0, value), fmax(edited->value1, value)};
    include_curve(curves, core, world, at.spline, first, last, edited);
}

/// The frames and values of all that was edited since the last picture; of splines only values, where they are in sight.
static struct view edited_part(const struct curves *curves, const struct core *core, const struct editor_world *world)
{
    const struct edited *edited = &core->edited;
    const struct document *document = world->document;
    struct view part = {INFINITY, -INFINITY, INFINITY, -INFINITY};
    for (struct knot_place at = PICKED_START; edited->selection && picked_next(core, document, &at);)
        include_knot(curves, core, world, at, &part);
    for (int i = 0; i < edited->count; i++)
        include_curve(curves, core, world, edited->spline[i], 0, document_samples(document) - 1, &part);
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

void follow_edits(struct curves *curves, struct core *core, const struct editor_world *world)
{
    struct following *following = &curves->following;
    if (!core->edited.selection && core->edited.count == 0) return;
    const struct view edited = edited_part(curves, core, world);
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

void curves_advance(struct curves *curves, struct core *core, const struct editor_world *world, double dt)
{
    keep_ghost(curves, core, world);
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
