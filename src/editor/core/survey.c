/// Where selected knots are, and values of the active spline in runs of knots.
#include "editor/core/survey.h"
#include "editor/core/selection.h"
#include <math.h>

/// As they are now.
static struct survey_key key_of(const struct core *core, const struct document *document)
{
    return (struct survey_key){document->serial, core->active, core->selection.changes, document->edits};
}

/// Whether the active spline's knots are.
static bool is_same_spline(const struct survey_key *a, const struct survey_key *b)
{
    return a->serial == b->serial && a->active == b->active && a->edits == b->edits;
}

static bool is_same(const struct survey_key *a, const struct survey_key *b)
{
    return is_same_spline(a, b) && a->selected == b->selected;
}

static bool is_current(const struct core *core, const struct document *document)
{
    const struct survey_key now = key_of(core, document);
    return core->survey.is_made && is_same(&core->survey.key, &now);
}

static void find_selected(struct survey *survey, const struct core *core, const struct document *document)
{
    survey->from = survey->to = (struct knot_place){-1, -1};
    survey->only = 0;
    if (selection_is_empty(&core->selection)) return;
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = &document->splines[s];
        for (int k = 0; k < spline->knot_count; k++) {
            if (!selection_has(&core->selection, spline->knots[k].id)) continue;
            const bool first = survey->from.spline < 0;
            if (first) survey->from = (struct knot_place){s, k};
            survey->to = (struct knot_place){s, k};
            survey->only = first ? spline->knots[k].id : 0;
        }
    }
}

/// Finds the one selected knot again after an edit of a drag, which adds and removes none. false if more are selected.
static bool find_only(struct survey *survey, const struct document *document)
{
    const int s = survey->from.spline;
    const int k =
        survey->only && s < document->spline_count ? spline_find_id(&document->splines[s], survey->only) : -1;
    if (k >= 0) survey->from.knot = survey->to.knot = k;
    return k >= 0;
}

static void widen(double range[2], double value)
{
    range[0] = fmin(range[0], value);
    range[1] = fmax(range[1], value);
}

static void find_values(struct survey *survey, const struct spline *spline)
{
    survey->run = spline->knot_count / SURVEY_RUNS + 1;
    for (int first = 0, run = 0; first < spline->knot_count; first += survey->run, run++) {
        const int end = first + survey->run < spline->knot_count ? first + survey->run : spline->knot_count;
        double low = spline->knots[first].value, high = low;
        for (int k = first + 1; k < end; k++) {
            const double value = spline->knots[k].value;
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
        survey->values[run][0] = low;
        survey->values[run][1] = high;
    }
}

void survey_update(struct core *core, const struct document *document)
{
    struct survey *survey = &core->survey;
    const struct survey_key now = key_of(core, document), was = survey->key;
    const bool made = survey->is_made && was.serial == now.serial,
               same_selection = made && was.selected == now.selected;
    survey->key = now;
    survey->is_made = true;
    const bool dragged = core->drag.kind != DRAG_NONE;
    if (!same_selection || (was.edits != now.edits && !(dragged && find_only(survey, document))))
        find_selected(survey, core, document);
    const bool has_active = now.active >= 0 && now.active < document->spline_count;
    const bool same_values = made && is_same_spline(&survey->values_key, &now);
    if (!has_active || same_values || dragged) return; // each frame of a drag would look at all
    survey->values_key = now;
    find_values(survey, &document->splines[now.active]);
}

void survey_selected(const struct core *core, const struct document *document, int spline, int *first, int *end)
{
    const struct survey *survey = &core->survey;
    *first = 0;
    *end = document->splines[spline].knot_count;
    if (!is_current(core, document)) return;
    if (spline == survey->from.spline) *first = survey->from.knot;
    if (spline == survey->to.spline) *end = survey->to.knot + 1;
    if (spline < survey->from.spline || spline > survey->to.spline) *end = 0;
}

void survey_values(const struct core *core, const struct document *document, int first, int end, double range[2])
{
    const struct survey *survey = &core->survey;
    const struct knot *knots = document->splines[core->active].knots;
    const struct survey_key now = key_of(core, document);
    const bool current = survey->is_made && is_same_spline(&survey->values_key, &now);
    range[0] = range[1] = knots[first].value;
    for (int k = first; k < end;) {
        if (current && k % survey->run == 0 && k + survey->run <= end) {
            widen(range, survey->values[k / survey->run][0]);
            widen(range, survey->values[k / survey->run][1]);
            k += survey->run;
        } else {
            widen(range, knots[k++].value);
        }
    }
}
