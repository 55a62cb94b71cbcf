/// Edits of knots: inserting, deleting, copying, what they hold, their slopes; and selecting them.
#include "base/need.h"
#include "editor/core/core.h"
#include "scene/load.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void core_select_only(struct core *core, unsigned id)
{
    core->focus.pin = 0;
    selection_clear(&core->focus.selection);
    selection_set(&core->focus.selection, id, true);
}

/// Whether the active spline is locked, which it says before a step is open.
static bool is_locked(struct core *core)
{
    struct error why;
    if (core_check_lock(core, core->focus.active, &why)) return false;
    core_message(core, false, "%s", why.text);
    return true;
}

static const char no_phase[] = "Only a wiggly spline has a phase. Press M to change the kind.";

void core_insert_knot(struct core *core, double frame, double value, bool snap, enum holds holds)
{
    const struct document *document = core->document;
    const struct spline *spline = core_active_spline(core);
    const bool pose = holds == HOLDS_POSE;
    if (!spline || !isfinite(frame)) return;
    if (pose && spline_mode(spline) != WIGGLY_COMPLEX) {
        core_message(core, false, no_phase);
        return;
    }
    const double last = document_frame(document, document_last_knot_sample(document, spline));
    struct knot knot = {.frame = fmin(fmax(snap ? round(frame) : frame, document->first_frame), last),
                        .value = value,
                        .stiffness = KNOT_DEFAULT_STIFFNESS,
                        .has_phase = pose};
    const int sample = document_sample(document, knot.frame);
    const wiggly_value here = evaluation_at(core->evaluation, core->focus.active, sample);
    if (isnan(value)) knot.value = here.y + here.re;
    if (pose) knot.phase = here.im;
    if (is_locked(core)) return;
    int at = spline_find_knot(document, spline, sample);
    if (at < 0) {
        if (!core_step(core, pose ? "Insert pose" : "Insert knot", 0)) return;
        if (!core_put_knot(core, core->focus.active, &knot)) return;
        at = spline_find_knot(document, core_active_spline(core), sample);
    }
    if (at < 0) return;
    core_select_only(core, core_active_spline(core)->knots[at].id);
    core_edited(core, -1);
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
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) {
        const struct spline *spline = core->document->splines[at.spline];
        const struct knot *was = knot_at(core->document, at);
        const int sample = document_sample(core->document, was->frame);
        struct knot knot = *was;
        if (holds == HOLDS_POSE && (spline_mode(spline) != WIGGLY_COMPLEX || was->has_phase)) continue;

        // A pose is as seen now. A still knot becomes a value again by the one it had, if it had one.
        knot.still = holds == HOLDS_STILL;
        if (!knot.still && (holds == HOLDS_POSE || isnan(was->value)))
            knot.value = core_knot_value(core, at.spline, was);
        knot.has_phase = holds == HOLDS_POSE;
        knot.phase = knot.has_phase ? evaluation_at(core->evaluation, at.spline, sample).im : 0;
        if (knot.still) knot.has_slope = false;
        core_hold(spline, &knot, why);
        core_put_knot(core, at.spline, &knot);
    }
    core_edited(core, -1);
    if (holds == HOLDS_STILL)
        core_message(core, false, "The motion comes to rest at the equilibrium. Shift+P brings the value back.");
    if (*why) core_stopped(core, why);
}

void core_toggle_settles(struct core *core)
{
    bool all = true, any = false;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) {
        const struct knot *knot = knot_at(core->document, at);
        any = any || !knot->still;
        all = all && (knot->settles || knot->still);
    }
    if (!any && selected_count(core) > 0) core_message(core, false, "A still knot has no value to settle at.");
    if (!any || !core_step(core, all ? "Settle off" : "Settle here", 0)) return;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) {
        struct knot knot = *knot_at(core->document, at);
        knot.settles = !all;
        if (!knot.still) core_put_knot(core, at.spline, &knot);
    }
    core_edited(core, -1);
}

/// Deletes the selected knots in a step `label`.
static void remove_knots(struct core *core, const char *label)
{
    const struct originals *originals = &core->step.originals;
    if (!core_step(core, label, 0)) return;
    core_collect(core, false);
    for (int i = originals->count - 1; i >= 0; i--) {
        const struct original *original = &originals->list[i];
        edit_knot_remove(core->document, original->spline, original->knot.id, &core->step.error);
    }
    selection_clear(&core->focus.selection);
}

void core_delete(struct core *core)
{
    int rig;
    const struct pin *pin = pins_selected(core, &rig);
    if (!pin) {
        remove_knots(core, selected_count(core) == 1 ? "Delete knot" : "Delete knots");
    } else if (core_step(core, "Delete pin", 0) && edit_pin_remove(core->document, rig, pin->id, &core->step.error)) {
        core->focus.pin = 0;
    }
}

void core_select_all(struct core *core, int all_splines)
{
    const struct document *document = core->document;
    core->focus.pin = 0;
    selection_clear(&core->focus.selection);
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = document->splines[s];
        if (spline->locked || (all_splines ? !spline_list_shows(core, s) : s != core->focus.active)) continue;
        for (int k = 0; k < spline->knot_count; k++) selection_set(&core->focus.selection, spline->knots[k].id, true);
    }
    selected_activate(core);
}

/// Index of the first knot after, or last one before, a position; -1 if none.
static int beside(const struct document *document, const struct spline *spline, double position, int direction)
{
    const int before = spline_lower_bound(document, spline, (int)ceil(position)) - 1;
    const int after = spline_lower_bound(document, spline, (int)floor(position) + 1);
    return direction < 0 ? before : after < spline->knot_count ? after : -1;
}

/// Selects a knot of the active spline alone, or as well; NULL: there is none at that index.
static const struct knot *select_at(struct core *core, int k, bool as_well)
{
    const struct spline *spline = core_active_spline(core);
    if (!spline || k < 0 || k >= spline->knot_count) return NULL;
    if (!as_well) core_select_only(core, spline->knots[k].id);
    selection_set(&core->focus.selection, spline->knots[k].id, true);
    return &spline->knots[k];
}

const struct knot *core_select_neighbour(struct core *core, int direction)
{
    const struct spline *spline = core_active_spline(core);
    if (!spline || spline->locked) return NULL;
    const int single = selection_single(&core->focus.selection, spline);
    const int near = beside(core->document, spline, core->view.playback.position, direction);
    return select_at(core, single < 0 ? near : single + direction, false);
}

const struct knot *core_visit_neighbour(struct core *core, int direction)
{
    const struct document *document = core->document;
    const struct spline *spline = core_active_spline(core);
    const int next = spline ? beside(document, spline, core->view.playback.position, direction) : -1;
    const struct knot *knot = select_at(core, next, false);
    if (knot) playback_seek(core, document_frame(document, document_sample(document, knot->frame)));
    if (!knot) core_message(core, false, "No knot lies %s the playhead.", direction < 0 ? "before" : "after");
    return knot;
}

const struct knot *core_extend_selection(struct core *core, int direction)
{
    const struct spline *spline = core_active_spline(core);
    int end = -1;
    for (int k = 0; spline && k < spline->knot_count; k++) {
        if (selection_has(&core->focus.selection, spline->knots[k].id) && (end < 0 || direction > 0)) end = k;
    }
    return end < 0 ? core_select_neighbour(core, direction) : select_at(core, end + direction, true);
}

// --- slopes: on, off, flat, Catmull-Rom, turned and stiffened by keys

static const double FIRM = 1000;             ///< default stiffness, 1/s
static const double TURN = 0.05;             ///< per key press: of the visible values, a second
static const double FIRMER = 1.25;           ///< per key press: factor on the stiffness
static const double SLOPE_RESOLUTION = 1e-3; ///< of the visible values, a second

/// Catmull-Rom: the slope of the chord between both neighbours; at an end, to the only neighbour. A loop wraps around.
static double catmull_rom(const struct core *core, struct knot_place at)
{
    const struct document *document = core->document;
    const struct spline *spline = document->splines[at.spline];
    const struct knot *knots = spline->knots;
    int count = spline->knot_count, k = at.knot;
    bool loop = spline_start(spline) == WIGGLY_LOOP && count > 1;
    double period = document->last_frame - document->first_frame;
    int before = k > 0 ? k - 1 : loop ? count - 1 : 0, after = k + 1 < count ? k + 1 : loop ? 0 : count - 1;
    double frames = knots[after].frame - knots[before].frame;
    if (loop && (k == 0 || k == count - 1)) frames += period;
    if (loop && count == 2) return 0; /* the same knot on both sides */
    const double rise =
        core_knot_value(core, at.spline, &knots[after]) - core_knot_value(core, at.spline, &knots[before]);
    return frames > 0 ? rise / frames * document->fps : 0;
}

void slopes_set(struct core *core, int how)
{
    const struct document *document = core->document;
    bool off = how == SLOPES_TOGGLE; // if all that can have one do; still knots cannot
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) {
        const struct knot *knot = knot_at(document, at);
        off &= knot->has_slope || knot->still;
    }

    enum { MERGES_SLOPE = 50, MERGES_STIFFNESS }; // kinds for core_merge_key(), different from those of splines.c
    const struct {
        const char *label;
        uint64_t merges;
        double slope;     ///< added, of the visible values
        double stiffness; ///< multiplied
    } changes[] = {
        [SLOPES_TOGGLE] = {off ? "Slope off" : "Slope on", 0, 0, 1},
        [SLOPES_FLAT] = {"Slope flat", 0, 0, 1},
        [SLOPES_SMOOTH] = {"Slope smooth", 0, 0, 1},
        [SLOPES_UP] = {"Change slope", MERGES_SLOPE, TURN, 1},
        [SLOPES_DOWN] = {"Change slope", MERGES_SLOPE, -TURN, 1},
        [SLOPES_FIRMER] = {"Change stiffness", MERGES_STIFFNESS, 0, FIRMER},
        [SLOPES_SOFTER] = {"Change stiffness", MERGES_STIFFNESS, 0, 1 / FIRMER},
    };
    const uint64_t merge = changes[how].merges ? core_merge_key(core, changes[how].merges) : 0;
    const bool aims = how == SLOPES_FLAT || how == SLOPES_SMOOTH;
    const double more = changes[how].slope * plot_height(core);
    if (selected_count(core) == 0 || !core_step(core, changes[how].label, merge)) return;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) {
        const struct knot *before = knot_at(document, at);
        if (before->still) continue;
        const bool fresh = !off && !before->has_slope;
        const int sample = document_sample(document, before->frame);
        struct knot knot = *before;
        knot.has_slope = !off;
        if (fresh) knot.slope = evaluation_slope(core->evaluation, document, at.spline, sample);
        if (!isfinite(knot.slope)) knot.slope = 0;
        if (!(before->stiffness > 0)) knot.stiffness = FIRM;
        if (aims) knot.slope = how == SLOPES_FLAT ? 0 : catmull_rom(core, at);
        if (aims || more != 0 || fresh)
            knot.slope = core_round(knot.slope + more, SLOPE_RESOLUTION * plot_height(core));
        knot.stiffness = fmin(fmax(knot.stiffness * changes[how].stiffness, 1e-3), 1e9);
        core_put_knot(core, at.spline, &knot);
    }
    core_edited(core, -1);
}

// --- copying, cutting, pasting and duplicating

static void say_count(struct core *core, const char *what, int count)
{
    core_message(core, false, "%s %d knot%s.", what, count, count == 1 ? "" : "s");
}

/// Collects the selected knots in core's originals, which no drag is using; returns how many.
static int collect(struct core *core)
{
    core_collect(core, false);
    if (core->step.originals.count == 0) core_message(core, false, "No knots are selected.");
    return core->step.originals.count;
}

bool core_copy_knots(struct core *core, bool cut)
{
    const int count = collect(core);
    if (count == 0) return false;

    // Knots of a single spline leave out its name, so that they can be pasted into any.
    const struct original *originals = core->step.originals.list;
    const bool mixed = originals[0].spline != originals[count - 1].spline;
    struct knot_list list = {need((size_t)count, sizeof *list.knots), need((size_t)count, sizeof *list.splines),
                             count};
    for (int i = 0; i < count; i++) {
        list.knots[i] = originals[i].knot;
        list.splines[i] = mixed ? core->document->splines[originals[i].spline]->name : NULL;
    }
    free(core->clipboard);
    core->clipboard = knots_print(&list);
    free(list.knots);
    free(list.splines); // the document owns the names
    if (cut) remove_knots(core, count == 1 ? "Cut knot" : "Cut knots");
    say_count(core, cut ? "Cut" : "Copied", count);
    return true;
}

/// The knot upside down: its value, slope and phase, about zero.
static struct knot mirrored(const struct core *core, const void *how, const struct original *original)
{
    struct knot turned = original->knot;
    (void)core, (void)how;
    turned.value *= -1;
    turned.slope *= -1;
    turned.phase *= -1;
    return turned;
}

void core_mirror_knots(struct core *core)
{
    char why[STOPPED_SIZE] = "";
    if (collect(core) == 0 || !core_step(core, "Mirror knots", 0)) return;
    originals_put(core, mirrored, NULL, why);
    core_edited(core, -1);
    if (*why) core_stopped(core, why);
}

/// Inserts a shifted copy of a knot in the open step.
static bool insert_copy(struct core *core, int spline, const struct knot *knot, double shift)
{
    struct knot copy = *knot;
    copy.id = 0;
    copy.frame += shift;
    return core_put_knot(core, spline, &copy);
}

/// Selects the knots inserted from `first_id` on.
static void select_from(struct core *core, unsigned first_id)
{
    selection_clear(&core->focus.selection);
    core->focus.pin = 0;
    for (unsigned id = first_id; id < core->document->next_id; id++) selection_set(&core->focus.selection, id, true);
    selected_activate(core);
    core_edited(core, -1);
}

void core_paste_knots(struct core *core, const char *text)
{
    const struct document *document = core->document;
    struct knot_list list;
    struct error error;
    const enum paste paste = core->input.paste;
    core->input.paste = PASTE_HERE;
    if (!core_active_spline(core) || history_is_open(core->history)) return; // pasted text may come during a drag
    if (!text || !text[strspn(text, " \t\r\n")]) {
        core_message(core, false, "The clipboard has no text.");
        return;
    }
    if (!knots_parse("clipboard", text, &list, &error)) {
        core_message(core, true, "%s", error.text);
        return;
    }
    const unsigned first_id = document->next_id;
    double first = list.knots[0].frame;
    bool good = true;
    for (int k = 1; k < list.count; k++) first = fmin(first, list.knots[k].frame);
    const double shift = paste == PASTE_IN_PLACE ? 0 : round(core_frame(core)) - first;
    core_step(core, list.count == 1 ? "Paste knot" : "Paste knots", 0);
    for (int k = 0; k < list.count && good; k++) {
        const char *name = list.splines ? list.splines[k] : NULL;
        const int named = name ? document_find_spline(document, name) : -1;
        const struct original pasted = {.knot = list.knots[k]};
        const struct knot knot = paste == PASTE_MIRRORED ? mirrored(core, NULL, &pasted) : pasted.knot;
        good = insert_copy(core, named >= 0 ? named : core->focus.active, &knot, shift);
    }
    if (good) select_from(core, first_id);
    if (good) say_count(core, "Pasted", list.count);
    knot_list_free(&list);
}

void core_duplicate_knots(struct core *core)
{
    struct document *document = core->document;
    const struct originals *originals = &core->step.originals;
    const int count = collect(core);
    if (count == 0) return;
    const unsigned first_id = document->next_id;

    // The copies lie as far behind the last original as that is behind the one before, or further until all have room.
    double first = INFINITY, last = -INFINITY, before = -INFINITY;
    for (int i = 0; i < count; i++) {
        const double frame = originals->list[i].knot.frame;
        first = fmin(first, frame);
        if (frame > last) before = last;
        if (frame < last) before = fmax(before, frame);
        last = fmax(last, frame);
    }
    double shift = round(last - first + fmax(isfinite(before) ? last - before : 1, 1));
    for (int i = 0; i < count; i++) {
        const struct original *original = &originals->list[i];
        const int sample = document_sample(document, original->knot.frame + shift);
        if (spline_find_knot(document, document->splines[original->spline], sample) < 0) continue;
        shift++;
        i = -1; // all anew
    }

    // The last frame that the scene needs. A loop's last sample is its first one.
    double most = document->last_frame;
    for (int i = 0; i < count; i++) {
        const struct original *original = &originals->list[i];
        const bool loops = spline_start(document->splines[original->spline]) == WIGGLY_LOOP;
        most = fmax(most, original->knot.frame + shift + (loops ? 1.0 / document->substeps : 0));
    }
    const int end = (int)fmin(ceil(most), SCENE_MAX_FRAME);
    const bool longer = end > document->last_frame;
    if (!core_step(core, count == 1 ? "Duplicate knot" : "Duplicate knots", 0)) return;
    bool good = !longer || edit_range(document, document->first_frame, end, RANGE_REFUSE, &core->step.error);
    for (int i = 0; i < count && good; i++)
        good = insert_copy(core, originals->list[i].spline, &originals->list[i].knot, shift);
    if (!good) return;
    select_from(core, first_id);
    say_count(core, "Duplicated", count);
    if (longer)
        core_message(core, false, "Duplicated %d knot%s; the scene now ends on frame %d.", count,
                     count == 1 ? "" : "s", end);
}

// --- cleaning up: fewer knots, and smoother ones

/// Opens a spline's knots; those that are not selected are fixed if `part`.
static struct simplify *open_knots(const struct core *core, int spline, bool cubic, bool part, bool searches)
{
    const struct spline *of = core->document->splines[spline];
    bool *fixed = need((size_t)of->knot_count, sizeof *fixed);
    wiggly_knot *knots;
    const wiggly_desc desc = core_describe(core, spline, cubic, &knots);
    for (int k = 0; k < of->knot_count; k++)
        fixed[k] = part && !selection_has(&core->focus.selection, of->knots[k].id);
    struct simplify *opened = simplify_open(&desc, fixed, searches);
    free(knots);
    free(fixed);
    return opened;
}

void core_simplify(struct core *core, int on)
{
    struct cleaning *cleaning = &core->cleaning;
    const int active = core->focus.active;
    simplify_close(cleaning->of);
    spline_drop(cleaning->was);
    *cleaning = (struct cleaning){.done = -1};
    const struct spline *spline = on ? core_active_spline(core) : NULL;
    if (!spline || spline->knot_count == 0 || !evaluation_is_of(core->evaluation, core->document) || is_locked(core))
        return;
    const int count = selection_count(&core->focus.selection, spline);
    const bool part = count > 1 && count < spline->knot_count;
    const bool follows = param_follows(&spline->parameter[PARAMETER_FREQUENCY]) ||
                         param_follows(&spline->parameter[PARAMETER_DAMPING]);
    cleaning->of = open_knots(core, active, false, part, !part && !follows && spline_mode(spline) != WIGGLY_CUBIC);
    cleaning->was = spline_hold(core->document->splines[active]);
    cleaning->edits = cleaning->merge = core->document->edits;
    cleaning->tolerance = core_round(0.03 * cleaning->of->range, 1e-3 * cleaning->of->range);
}

void core_simplify_advance(struct core *core)
{
    struct cleaning *cleaning = &core->cleaning;
    struct simplify *of = cleaning->of;
    const int active = core->focus.active;
    if (!of) return;
    if (core->focus.active_id != cleaning->was->id || core->document->edits != cleaning->edits) {
        core_simplify(core, false);
        return;
    }
    if (cleaning->tolerance == cleaning->done || !core_step(core, "Simplify", cleaning->merge)) return;
    core->step.pressed.count = 0; // Keep would make a pose of the last knot
    cleaning->done = cleaning->tolerance;
    simplify_within(of, 0.99 * cleaning->tolerance);
    while (core_active_spline(core)->knot_count > 0)
        edit_knot_remove(core->document, active, core_active_spline(core)->knots[0].id, &core->step.error);
    for (int k = 0; k < of->count; k++) {
        const double unit = 1e-3 * fmax(cleaning->tolerance, 1e-6 * of->range);
        const wiggly_knot *now = &of->knots[k];
        struct knot knot = cleaning->was->knots[k];
        if (!knot.still && now->value != knot.value) knot.value = core_round(now->value, unit);
        if (now->has_phase && !knot.has_phase) knot.phase = core_round(now->phase, unit);
        knot.has_phase = now->has_phase;
        knot.value = spline_within(cleaning->was, knot.value);
        if (of->stays[k]) edit_knot_insert(core->document, active, &knot, &core->step.error);
    }
    if (of->searched) {
        core_set_parameter(core, active, PARAMETER_FREQUENCY, of->desc.frequency.value);
        core_set_parameter(core, active, PARAMETER_DAMPING, of->desc.damping.value);
    }
    core_edited(core, active);
    core_close(core);
    cleaning->edits = core->document->edits;
    if (of->searched && !core->message.is_error)
        core_message(core, false, "%d knots → %d: %.2f Hz, damping %.3g.", of->count, of->left,
                     of->desc.frequency.value, of->desc.damping.value);
}

void core_smooth_knots(struct core *core)
{
    const struct selection *selection = &core->focus.selection;
    int moved = 0;
    if (collect(core) == 0 || !evaluation_is_of(core->evaluation, core->document) ||
        !core_step(core, "Smooth knots", 0))
        return;
    for (int s = 0; s < core->document->spline_count; s++) {
        const struct spline *spline = core->document->splines[s];
        if (spline->locked || selection_count(selection, spline) < 3) continue;
        struct simplify *of = open_knots(core, s, true, false, false);
        for (int k = 1; k < of->count - 1; k++) {
            struct knot knot = core->document->splines[s]->knots[k];
            if (knot.still || !selection_has(selection, spline->knots[k - 1].id) ||
                !selection_has(selection, knot.id) || !selection_has(selection, spline->knots[k + 1].id))
                continue;
            const double value = core_round((knot.value + simplify_without(of, k)) / 2, 1e-4 * of->range);
            knot.value = spline_within(core->document->splines[s], value);
            moved += core_put_knot(core, s, &knot);
        }
        simplify_close(of);
    }
    core_edited(core, -1);
    if (moved == 0) core_message(core, false, "Select three knots or more in a row: the ends of a row stay.");
}
