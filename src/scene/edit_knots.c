/// Edits of knots.
#include "scene/edit_plan.h"
#include "scene/number.h"
#include <math.h>
#include <stdlib.h>

enum { FIRST_KNOTS = 16 };

/// Makes room for one more knot, by doubling.
static bool reserve_knot(const struct document *document, struct spline *spline, struct error *error)
{
    long long total = 1;
    for (int i = 0; i < document->spline_count; i++) total += document->splines[i].knot_count;
    if (total > SCENE_MAX_KNOTS) return fail(error, ERROR_INPUT, "the limit of %d knots is reached", SCENE_MAX_KNOTS);
    if (spline->knot_count < spline->knot_capacity) return true;
    int capacity = spline->knot_capacity > 0 ? 2 * spline->knot_capacity : FIRST_KNOTS;
    struct knot *knots = realloc(spline->knots, (size_t)capacity * sizeof *knots);
    if (!knots) return plan_no_memory(error);
    spline->knots = knots;
    spline->knot_capacity = capacity;
    return true;
}

/// Whether a knot may go where it says; `id` is its own.
static bool check_knot(const struct document *document, const struct spline *spline, const struct knot *knot,
                       unsigned id, struct error *error)
{
    char frame[NUMBER_TEXT_SIZE];
    if (!isfinite(knot->frame) || !isfinite(knot->value) || !isfinite(knot->slope) || !isfinite(knot->stiffness)) {
        return fail(error, ERROR_INPUT, "%s: a knot's numbers must be finite", spline->name);
    }
    number_print(knot->frame, frame);
    const double low = spline->parameter[PARAMETER_LOW].value, high = spline->parameter[PARAMETER_HIGH].value;
    if (knot->value < low || knot->value > high) {
        return fail(error, ERROR_INPUT, "%s: a knot at %.6g would be %s limit, %.6g", spline->name, knot->value,
                    knot->value < low ? "below the low" : "above the high", knot->value < low ? low : high);
    }
    if (knot->stiffness <= 0) return fail(error, ERROR_INPUT, "%s: stiffness must be above 0", spline->name);
    int sample = document_sample(document, knot->frame), last = document_last_knot_sample(document, spline);
    if (sample < 0 || sample > last) {
        return fail(error, ERROR_INPUT, "%s: frame %s is outside %d to %d%s", spline->name, frame,
                    document->first_frame, document->last_frame,
                    spline_start(spline) == WIGGLY_LOOP ? "; the last frame of a loop repeats the first" : "");
    }
    int there = spline_find_knot(document, spline, sample);
    if (there < 0 || spline->knots[there].id == id) return true;
    return fail(error, ERROR_INPUT, "%s: there is already a knot at frame %s", spline->name, frame);
}

/// −0 is saved as 0, so it must be 0 in the document, too.
static struct knot without_negative_zeros(struct knot knot)
{
    knot.frame += 0.0;
    knot.value += 0.0;
    knot.slope += 0.0;
    return knot;
}

static bool has_id(const struct document *document, unsigned id)
{
    for (int i = 0; i < document->spline_count; i++) {
        if (spline_find_id(&document->splines[i], id) >= 0) return true;
    }
    return false;
}

bool plan_knot_insert(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    struct spline *spline = &document->splines[edit->spline];
    struct change change = {.kind = CHANGE_KNOT_OUT, .spline = edit->spline};
    change.knot = without_negative_zeros(edit->knot);
    if (!check_knot(document, spline, &change.knot, 0, error)) return false;
    if (change.knot.id != 0 && has_id(document, change.knot.id)) {
        return fail(error, ERROR_INPUT, "%s: this knot already exists", spline->name);
    }
    if (!reserve_knot(document, spline, error)) return false;
    if (change.knot.id == 0) change.knot.id = document->next_id;
    if (!plan_add(list, &change, error)) return false;
    if (document->next_id <= change.knot.id) document->next_id = change.knot.id + 1;
    return true;
}

bool plan_knot_remove(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    const struct spline *spline = &document->splines[edit->spline];
    struct change change = {.kind = CHANGE_KNOT_IN, .spline = edit->spline, .knot = edit->knot};
    if (spline_find_id(spline, edit->knot.id) < 0) {
        return fail(error, ERROR_INPUT, "%s: this knot no longer exists", spline->name);
    }
    return plan_add(list, &change, error);
}

static bool same_knot(const struct knot *a, const struct knot *b)
{
    return a->frame == b->frame && a->value == b->value && a->slope == b->slope && a->stiffness == b->stiffness &&
           a->has_slope == b->has_slope;
}

bool plan_knot_set(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct spline *spline = &document->splines[edit->spline];
    struct change change = {.kind = CHANGE_KNOT, .spline = edit->spline};
    int at = spline_find_id(spline, edit->knot.id);
    if (at < 0) return fail(error, ERROR_INPUT, "%s: this knot no longer exists", spline->name);
    change.knot = without_negative_zeros(edit->knot);
    change.knot.extra = spline->knots[at].extra;
    if (!check_knot(document, spline, &change.knot, change.knot.id, error)) return false;
    return same_knot(&change.knot, &spline->knots[at]) || plan_add(list, &change, error);
}
