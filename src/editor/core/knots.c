/// Inserting, deleting and choosing knots.
#include "editor/core/knots.h"
#include "base/hash.h"
#include "editor/core/core.h"
#include "editor/core/pins.h"
#include "editor/core/playback.h"
#include "editor/core/selected_knots.h"
#include "editor/core/selection.h"
#include "editor/core/spline_list.h"
#include <math.h>

uint64_t core_merge_key(const struct core *core, const struct editor_world *world, uint64_t kind)
{
    uint64_t key = hash_bytes(HASH_START, &kind, sizeof kind);
    key = hash_bytes(key, &core->active, sizeof core->active);
    for (struct knot_place at = SELECTED_START; selected_next(core, world->document, &at);) {
        unsigned id = knot_at(world->document, at)->id;
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

/// Inserts and selects a knot; where there is one on that sample already, that one is selected.
static void insert_at(struct core *core, const struct editor_world *world, const struct knot *knot)
{
    const struct document *document = world->document;
    int sample = document_sample(document, knot->frame);
    int at = spline_find_knot(document, core_active_spline(core, world), sample);
    if (at < 0) {
        if (!core_begin(core, world, "Insert knot", 0)) return;
        if (!core_end(core, world, core_put_knot(core, world, core->active, knot))) return;
        at = spline_find_knot(document, core_active_spline(core, world), sample);
    }
    if (at < 0) return;
    select_only(core, core_active_spline(core, world)->knots[at].id);
    core_edited(core, -1);
}

/// The frame for a knot of the active spline: a whole one when `snap`, inside the range.
static double knot_frame(const struct core *core, const struct editor_world *world, double frame, bool snap)
{
    const struct document *document = world->document;
    const struct spline *spline = core_active_spline(core, world);
    double last = document_frame(document, document_last_knot_sample(document, spline));
    return fmin(fmax(snap ? round(frame) : frame, document->first_frame), last);
}

void core_insert_knot(struct core *core, const struct editor_world *world, double frame, double value, bool snap)
{
    if (!core_active_spline(core, world) || !isfinite(frame)) return;
    const struct knot knot = {
        .frame = knot_frame(core, world, frame, snap), .value = value, .stiffness = KNOT_DEFAULT_STIFFNESS};
    insert_at(core, world, &knot);
}

void core_insert_on_curve(struct core *core, const struct editor_world *world, double frame, bool snap, bool slope)
{
    const struct document *document = world->document;
    if (!core_active_spline(core, world) || !isfinite(frame)) return;
    struct knot knot = {
        .frame = knot_frame(core, world, frame, snap), .stiffness = KNOT_DEFAULT_STIFFNESS, .has_slope = slope};
    int sample = document_sample(document, knot.frame);
    wiggly_value here = evaluation_at(world->evaluation, core->active, sample);
    knot.value = here.y + here.re;
    if (slope) knot.slope = evaluation_slope(world->evaluation, document, core->active, sample);
    insert_at(core, world, &knot);
}

void core_remove_knots(struct core *core, const struct editor_world *world, const char *label)
{
    const struct originals *originals = &core->originals;
    if (!core_begin(core, world, label, 0)) return;
    core_collect(core, world->document, false);
    for (int i = originals->count - 1; i >= 0; i--) {
        const struct original *original = &originals->list[i];
        edit_knot_remove(world->document, original->spline, original->knot.id, &core->error);
    }
    core_end(core, world, true);
    selection_clear(&core->selection);
}

void core_delete_knots(struct core *core, const struct editor_world *world, int unused)
{
    (void)unused;
    core_remove_knots(core, world, selected_count(core, world->document) == 1 ? "Delete knot" : "Delete knots");
}

void core_select_all(struct core *core, const struct editor_world *world, int all_splines)
{
    const struct document *document = world->document;
    pins_clear(core);
    selection_clear(&core->selection);
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = document->splines[s];
        if (all_splines ? !spline_list_shows(core, document, s) : s != core->active) continue;
        for (int k = 0; k < spline->knot_count; k++) selection_set(&core->selection, spline->knots[k].id, true);
    }
    selected_settle(core, world);
}

/// Index of the first knot after, or last one before, a position; -1 where there is none.
static int beside(const struct document *document, const struct spline *spline, double position, int direction)
{
    int found = -1;
    for (int k = 0; k < spline->knot_count; k++) {
        double sample = document_sample(document, spline->knots[k].frame);
        if (direction < 0 && sample < position) found = k;
        if (direction > 0 && sample > position) return k;
    }
    return found;
}

const struct knot *core_select_neighbour(struct core *core, const struct editor_world *world, int direction)
{
    const struct spline *spline = core_active_spline(core, world);
    if (!spline || spline->knot_count == 0) return NULL;
    int single = selection_single(&core->selection, spline);
    int next = single + direction;
    if (single < 0) next = beside(world->document, spline, core->playback.position, direction);
    if (next < 0 || next >= spline->knot_count) return NULL;
    select_only(core, spline->knots[next].id);
    return &spline->knots[next];
}

const struct knot *core_visit_neighbour(struct core *core, const struct editor_world *world, int direction)
{
    const struct document *document = world->document;
    const struct spline *spline = core_active_spline(core, world);
    const int next = spline ? beside(document, spline, core->playback.position, direction) : -1;
    if (next < 0) {
        core_message(core, false,
                     direction < 0 ? "No knot lies before the playhead." : "No knot lies behind the playhead.");
        return NULL;
    }
    const struct knot *knot = &spline->knots[next];
    select_only(core, knot->id);
    playback_seek(core, document, document_frame(document, document_sample(document, knot->frame)));
    return knot;
}

const struct knot *core_extend_selection(struct core *core, const struct editor_world *world, int direction)
{
    const struct spline *spline = core_active_spline(core, world);
    int end = -1;
    for (int k = 0; spline && k < spline->knot_count; k++) {
        if (selection_has(&core->selection, spline->knots[k].id) && (end < 0 || direction > 0)) end = k;
    }
    if (end < 0) return core_select_neighbour(core, world, direction);
    int next = end + direction;
    if (next < 0 || next >= spline->knot_count) return NULL;
    selection_set(&core->selection, spline->knots[next].id, true);
    return &spline->knots[next];
}

void core_activate_neighbour(struct core *core, const struct editor_world *world, int direction)
{
    int count = world->document->spline_count;
    if (count > 0) core_activate(core, world, ((core->active + direction) % count + count) % count);
}
