/// Inserts, deletes and selects knots.
#include "editor/core/knots.h"
#include "base/hash.h"
#include "editor/core/core.h"
#include "editor/core/pins.h"
#include "editor/core/selection.h"
#include <math.h>

uint64_t core_merge_key(const struct core *core, uint64_t kind)
{
    uint64_t key = hash_bytes(HASH_START, &kind, sizeof kind);
    key = hash_bytes(key, &core->active, sizeof core->active);
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) {
        unsigned id = knot_at(core->document, at)->id;
        key = hash_bytes(key, &id, sizeof id);
    }
    return key ? key : 1;
}

static void select_only(struct core *core, unsigned id)
{
    pins_clear(core);
    selection_clear(&core->selection);
    selection_set(&core->selection, id, true);
}

/// Inserts and selects a knot, or selects the one at that sample.
static void insert_at(struct core *core, const struct knot *knot)
{
    const struct document *document = core->document;
    int sample = document_sample(document, knot->frame);
    int at = spline_find_knot(document, core_active_spline(core), sample);
    if (at < 0) {
        if (!core_step(core, knot->has_phase ? "Insert pose" : "Insert knot", 0)) return;
        if (!core_put_knot(core, core->active, knot)) return;
        at = spline_find_knot(document, core_active_spline(core), sample);
    }
    if (at < 0) return;
    select_only(core, core_active_spline(core)->knots[at].id);
    core_edited(core, -1);
}

/// A frame for a knot of the active spline: in range, and whole if `snap`.
static double knot_frame(const struct core *core, double frame, bool snap)
{
    const struct document *document = core->document;
    const struct spline *spline = core_active_spline(core);
    double last = document_frame(document, document_last_knot_sample(document, spline));
    return fmin(fmax(snap ? round(frame) : frame, document->first_frame), last);
}

void core_insert_knot(struct core *core, double frame, double value, bool snap)
{
    if (!core_active_spline(core) || !isfinite(frame)) return;
    const struct knot knot = {
        .frame = knot_frame(core, frame, snap), .value = value, .stiffness = KNOT_DEFAULT_STIFFNESS};
    insert_at(core, &knot);
}

static const char no_phase[] = "Only a wiggly spline has a phase. Press M to change the kind.";

void core_insert_on_curve(struct core *core, double frame, bool snap, bool pose)
{
    const struct spline *spline = core_active_spline(core);
    if (!spline || !isfinite(frame)) return;
    if (pose && spline_mode(spline) != WIGGLY_COMPLEX) {
        core_message(core, false, no_phase);
        return;
    }
    struct knot knot = {
        .frame = knot_frame(core, frame, snap), .stiffness = KNOT_DEFAULT_STIFFNESS, .has_phase = pose};
    const wiggly_value here =
        evaluation_at(core->evaluation, core->active, document_sample(core->document, knot.frame));
    knot.value = here.y + here.re;
    if (pose) knot.phase = here.im;
    insert_at(core, &knot);
}

/// A knot after changing what it holds. A pose is as seen now; a still knot becomes a value again by the one it had, if it had one.
static struct knot held(const struct core *core, int spline, const struct knot *knot, enum holds holds)
{
    const wiggly_value here = evaluation_at(core->evaluation, spline, document_sample(core->document, knot->frame));
    struct knot to = *knot;
    to.still = holds == HOLDS_STILL;
    if (!to.still && (holds == HOLDS_POSE || isnan(to.value))) to.value = core_knot_value(core, spline, knot);
    to.has_phase = holds == HOLDS_POSE;
    to.phase = to.has_phase ? here.im : 0;
    return to;
}

void core_set_hold(struct core *core, int holds)
{
    static const char *const labels[] = {
        [HOLDS_VALUE] = "Make values", [HOLDS_POSE] = "Make poses", [HOLDS_STILL] = "Make still"};
    char why[STOPPED_SIZE] = "";
    bool all = true, swings = false;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) {
        all = all && knot_holds(knot_at(core->document, at)) == (enum holds)holds;
        swings = swings || spline_mode(core->document->splines[at.spline]) == WIGGLY_COMPLEX;
    }
    if (selected_count(core) == 0) return;
    if (holds == HOLDS_POSE && !all && !swings) {
        core_message(core, false, no_phase);
        return;
    }
    if (all) holds = HOLDS_VALUE;
    if (!core_step(core, labels[holds], 0)) return;
    core_collect(core, false);
    for (int i = 0; i < core->originals.count; i++) {
        const struct original *original = &core->originals.list[i];
        struct knot knot = held(core, original->spline, &original->knot, (enum holds)holds);
        if (holds == HOLDS_POSE && spline_mode(core->document->splines[original->spline]) != WIGGLY_COMPLEX) continue;
        if (holds == HOLDS_POSE && original->knot.has_phase) continue; // already a pose
        if (holds == HOLDS_STILL) knot.has_slope = false;
        core_hold(core->document->splines[original->spline], &knot, why);
        core_put_knot(core, original->spline, &knot);
    }
    core_edited(core, -1);
    if (holds == HOLDS_STILL)
        core_message(core, false, "The motion comes to rest at the equilibrium. Shift+P brings the value back.");
    if (*why) core_stopped(core, why);
}

void core_toggle_settles(struct core *core, int unused)
{
    (void)unused;
    bool all = true, any = false;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) {
        const struct knot *knot = knot_at(core->document, at);
        any = any || !knot->still;
        all = all && (knot->settles || knot->still);
    }
    if (!any) {
        if (selected_count(core) > 0) core_message(core, false, "A still knot has no value to settle at.");
        return;
    }
    if (!core_step(core, all ? "Settle off" : "Settle here", 0)) return;
    core_collect(core, false);
    for (int i = 0; i < core->originals.count; i++) {
        const struct original *original = &core->originals.list[i];
        struct knot knot = original->knot;
        if (knot.still) continue;
        knot.settles = !all;
        core_put_knot(core, original->spline, &knot);
    }
    core_edited(core, -1);
}

void core_remove_knots(struct core *core, const char *label)
{
    const struct originals *originals = &core->originals;
    if (!core_step(core, label, 0)) return;
    core_collect(core, false);
    for (int i = originals->count - 1; i >= 0; i--) {
        const struct original *original = &originals->list[i];
        edit_knot_remove(core->document, original->spline, original->knot.id, &core->error);
    }
    selection_clear(&core->selection);
}

void core_delete(struct core *core, int unused)
{
    (void)unused;
    if (pins_any_selected(core)) {
        pins_delete(core);
    } else {
        core_remove_knots(core, selected_count(core) == 1 ? "Delete knot" : "Delete knots");
    }
}

void core_select_all(struct core *core, int all_splines)
{
    const struct document *document = core->document;
    pins_clear(core);
    selection_clear(&core->selection);
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = document->splines[s];
        if (all_splines ? !spline_list_shows(core, s) : s != core->active) continue;
        for (int k = 0; k < spline->knot_count; k++) selection_set(&core->selection, spline->knots[k].id, true);
    }
    selected_settle(core);
}

/// Index of the first knot after, or last one before, a position; -1 if none.
static int beside(const struct document *document, const struct spline *spline, double position, int direction)
{
    const int before = spline_lower_bound(document, spline, (int)ceil(position)) - 1;
    const int after = spline_lower_bound(document, spline, (int)floor(position) + 1);
    return direction < 0 ? before : after < spline->knot_count ? after : -1;
}

const struct knot *core_select_neighbour(struct core *core, int direction)
{
    const struct spline *spline = core_active_spline(core);
    if (!spline || spline->knot_count == 0) return NULL;
    int single = selection_single(&core->selection, spline);
    int next = single + direction;
    if (single < 0) next = beside(core->document, spline, core->playback.position, direction);
    if (next < 0 || next >= spline->knot_count) return NULL;
    select_only(core, spline->knots[next].id);
    return &spline->knots[next];
}

const struct knot *core_visit_neighbour(struct core *core, int direction)
{
    const struct document *document = core->document;
    const struct spline *spline = core_active_spline(core);
    const int next = spline ? beside(document, spline, core->playback.position, direction) : -1;
    if (next < 0) {
        core_message(core, false,
                     direction < 0 ? "No knot lies before the playhead." : "No knot lies after the playhead.");
        return NULL;
    }
    const struct knot *knot = &spline->knots[next];
    select_only(core, knot->id);
    playback_seek(core, document_frame(document, document_sample(document, knot->frame)));
    return knot;
}

const struct knot *core_extend_selection(struct core *core, int direction)
{
    const struct spline *spline = core_active_spline(core);
    int end = -1;
    for (int k = 0; spline && k < spline->knot_count; k++) {
        if (selection_has(&core->selection, spline->knots[k].id) && (end < 0 || direction > 0)) end = k;
    }
    if (end < 0) return core_select_neighbour(core, direction);
    int next = end + direction;
    if (next < 0 || next >= spline->knot_count) return NULL;
    selection_set(&core->selection, spline->knots[next].id, true);
    return &spline->knots[next];
}

void core_activate_neighbour(struct core *core, int direction)
{
    int count = core->document->spline_count;
    if (count > 0) core_choose(core, ((core->active + direction) % count + count) % count);
}
