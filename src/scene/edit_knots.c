/// Edits of knots.
#include "base/need.h"
#include "scene/editing.h"
#include "scene/text.h"
#include <math.h>
#include <string.h>

/// Whether a knot may go where it says; `id` is its own.
static bool check_knot(const struct document *document, const struct spline *spline, const struct knot *knot,
                       unsigned id, struct error *error)
{
    char frame[NUMBER_TEXT_SIZE];
    if (!isfinite(knot->frame) || !isfinite(knot->value) || !isfinite(knot->slope) || !isfinite(knot->stiffness)) {
        return fail(error, ERROR_INPUT, "%s: a knot's numbers must be finite", spline->name);
    }
    const double low = spline->parameter[PARAMETER_LOW].value, high = spline->parameter[PARAMETER_HIGH].value;
    if (knot->value < low || knot->value > high) {
        return fail(error, ERROR_INPUT, "%s: a knot at %.6g would be %s limit, %.6g", spline->name, knot->value,
                    knot->value < low ? "below the low" : "above the high", knot->value < low ? low : high);
    }
    if (knot->stiffness <= 0) return fail(error, ERROR_INPUT, "%s: stiffness must be above 0", spline->name);
    int sample = document_sample(document, knot->frame), last = document_last_knot_sample(document, spline);
    if (sample < 0 || sample > last) {
        number_print(knot->frame, frame);
        return fail(error, ERROR_INPUT, "%s: frame %s is outside %d to %d%s", spline->name, frame,
                    document->first_frame, document->last_frame,
                    spline_start(spline) == WIGGLY_LOOP ? "; the last frame of a loop repeats the first" : "");
    }
    int there = spline_find_knot(document, spline, sample);
    if (there < 0 || spline->knots[there].id == id) return true;
    number_print(knot->frame, frame);
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
        if (spline_find_id(document->splines[i], id) >= 0) return true;
    }
    return false;
}

bool edit_knot_insert(struct document *document, int spline, const struct knot *knot, struct error *error)
{
    struct knot added = without_negative_zeros(*knot);
    long long total = 1;
    if (!edit_has_spline(document, spline, error)) return false;
    const struct spline *old = document->splines[spline];
    if (!check_knot(document, old, &added, 0, error)) return false;
    if (added.id != 0 && has_id(document, added.id)) {
        return fail(error, ERROR_INPUT, "%s: this knot already exists", old->name);
    }
    for (int i = 0; i < document->spline_count; i++) total += document->splines[i]->knot_count;
    if (total > SCENE_MAX_KNOTS) return fail(error, ERROR_INPUT, "the limit of %d knots is reached", SCENE_MAX_KNOTS);
    if (added.id == 0) added.id = document->next_id;
    if (document->next_id <= added.id) document->next_id = added.id + 1;
    struct spline *own = document_own_spline(document, spline);
    if (own->knot_count == own->knot_capacity) {
        own->knot_capacity += own->knot_capacity / 2 + 1;
        own->knots = need_more(own->knots, (size_t)own->knot_capacity, sizeof *own->knots);
    }
    const int at = spline_lower_bound(document, own, document_sample(document, added.frame));
    memmove(&own->knots[at + 1], &own->knots[at], (size_t)(own->knot_count++ - at) * sizeof added);
    own->knots[at] = added;
    return true;
}

/// Index of the knot with that id; -1 with a sentence.
static int find(const struct document *document, int spline, unsigned id, struct error *error)
{
    if (!edit_has_spline(document, spline, error)) return -1;
    const int at = spline_find_id(document->splines[spline], id);
    if (at < 0) fail(error, ERROR_INPUT, "%s: this knot no longer exists", document->splines[spline]->name);
    return at;
}

bool edit_knot_remove(struct document *document, int spline, unsigned id, struct error *error)
{
    const int at = find(document, spline, id, error);
    if (at < 0) return false;
    struct spline *own = document_own_spline(document, spline);
    memmove(&own->knots[at], &own->knots[at + 1], (size_t)(--own->knot_count - at) * sizeof *own->knots);
    return true;
}

static bool same_knot(const struct knot *a, const struct knot *b)
{
    return a->frame == b->frame && a->value == b->value && a->slope == b->slope && a->stiffness == b->stiffness &&
           a->has_slope == b->has_slope;
}

bool edit_knot_set(struct document *document, int spline, const struct knot *knot, struct error *error)
{
    struct knot changed = without_negative_zeros(*knot);
    const int from = find(document, spline, knot->id, error);
    if (from < 0) return false;
    const struct spline *old = document->splines[spline];
    changed.extra = old->knots[from].extra;
    if (!check_knot(document, old, &changed, changed.id, error)) return false;
    if (same_knot(&changed, &old->knots[from])) return true;
    struct knot *knots = document_own_spline(document, spline)->knots;
    int to = spline_lower_bound(document, document->splines[spline], document_sample(document, changed.frame));
    if (to > from) to--; // where it is once the old one is gone
    if (to > from) memmove(&knots[from], &knots[from + 1], (size_t)(to - from) * sizeof *knots);
    if (to < from) memmove(&knots[to + 1], &knots[to], (size_t)(from - to) * sizeof *knots);
    knots[to] = changed;
    return true;
}
