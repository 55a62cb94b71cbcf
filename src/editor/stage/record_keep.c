/// What a recorded motion becomes in the document: knots of the splines that the body's position follows, and a tail that follows
/// through as it did while it was dragged.
#include "editor/core/core.h"
#include "editor/stage/base.h"
#include "editor/stage/hold.h"
#include <math.h>
#include <stdio.h>

enum { MAX_KNOTS = 64 };

static const double STILL = 2e-3;     ///< metres: a coordinate that moved less did not move
static const double TOLERANCE = 4e-3; ///< metres between the hand's way and the cubic through its knots

static double largest(const double *values, int count)
{
    double most = 0;
    for (int i = 0; i < count; i++) most = fmax(most, fabs(values[i]));
    return most;
}

static void clear_knots(struct core *core, const struct editor_world *world, int spline, int from, int to)
{
    const struct document *document = world->document;
    for (;;) {
        int at = spline_lower_bound(document, &document->splines[spline], from);
        const struct spline *cleared = &document->splines[spline];
        if (at == cleared->knot_count || document_sample(document, cleared->knots[at].frame) > to) return;
        struct edit edit = core_edit_of(EDIT_KNOT_REMOVE, spline);
        edit.knot = cleared->knots[at];
        if (!core_edit(core, world, &edit)) return;
    }
}

/// Keys a coordinate's motion; returns how many knots that took. `swings` is the spline by which the tail swings with that from now
/// on, where it did not; `why` is what held a knot. Before and after it the body stands still, unless the scene is a loop, in which
/// it comes back by itself.
static int key_coordinate(const struct stage *stage, struct core *core, const struct editor_world *world,
                          int coordinate, int *swings, char why[STOPPED_SIZE])
{
    const struct record *record = &stage->record;
    const struct document *document = world->document;
    const int tail = stage->hold.tail, last = document_samples(document) - 1;
    const bool is_new = document_tail(document, tail)->position[coordinate].track < 0;
    double way[RECORD_SAMPLES];
    int knots[MAX_KNOTS];
    int spline = base_spline(stage, core, world, coordinate);
    if (spline < 0) return 0;
    int count = record->count, end = document_last_knot_sample(document, &document->splines[spline]);
    if (record->first + count - 1 > end) count = end - record->first + 1;
    for (int i = 0; i < count; i++)
        way[i] = base_value(world, tail, coordinate, record->first + i) + record->way[coordinate][i];
    int made = count >= 2 ? record_simplify(way, count, TOLERANCE, core->method, knots, MAX_KNOTS) : 0;
    if (made == 0) return 0;
    if (!is_new) clear_knots(core, world, spline, record->first, record->first + count - 1);
    for (int i = 0; i < made; i++) {
        base_put_knot(core, world, spline, record->first + knots[i], way[knots[i]], i == 0 || i == made - 1, why);
    }
    if (is_new && !stage->hold.loops) {
        if (record->first > 1) base_put_knot(core, world, spline, 0, way[0], true, why);
        if (record->first + count < last) base_put_knot(core, world, spline, last, way[count - 1], true, why);
    }
    if (is_new) base_follow(stage, core, world, coordinate, spline);
    const int hung = base_hang_channels(stage, core, world, coordinate, spline);
    if (hung >= 0) *swings = hung;
    core_edited(core, spline);
    return made;
}

void record_keep(struct stage *stage, struct core *core, const struct editor_world *world)
{
    struct record *record = &stage->record;
    char text[768], why[STOPPED_SIZE] = "";
    int made = 0, swings = -1;
    base_begin(stage, world);
    for (int k = 0; k < 3; k++) {
        if (largest(record->way[k], record->count) >= STILL)
            made += key_coordinate(stage, core, world, k, &swings, why);
    }
    snprintf(text, sizeof text, made == 0 ? "Nothing moved: nothing is recorded." : "%d knots recorded.", made);
    core_add_stopped(why, text, sizeof text);
    base_say_channel(world, swings, text, sizeof text);
    core_message(core, false, text);
    record_forget(stage);
}
