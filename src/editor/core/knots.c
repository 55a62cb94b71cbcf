/// Inserting, deleting and choosing knots.
#include "base/hash.h"
#include "editor/core/actions.h"
#include "editor/curves/curves.h"
#include <math.h>

uint64_t merge_key(const struct editor *editor, const struct editor_world *world, uint64_t kind)
{
    const struct spline *spline = editor_active_spline(editor, world);
    uint64_t key = hash_bytes(HASH_START, &kind, sizeof kind);
    key = hash_bytes(key, &editor->active, sizeof editor->active);
    for (int k = 0; spline && k < spline->knot_count; k++) {
        unsigned id = spline->knots[k].id;
        if (selection_has(&editor->selection, id)) key = hash_bytes(key, &id, sizeof id);
    }
    return key ? key : 1;
}

static void select_only(struct editor *editor, unsigned id)
{
    selection_clear(&editor->selection);
    selection_set(&editor->selection, id, true);
}

/// Inserts and selects a knot; where there is one on that sample already, that one is selected.
static void insert_at(struct editor *editor, const struct editor_world *world, const struct knot *knot)
{
    const struct document *document = world->document;
    const struct spline *spline = editor_active_spline(editor, world);
    int sample = document_sample(document, knot->frame);
    int at = spline_find_knot(document, spline, sample);
    if (at < 0) {
        struct edit edit = editor_edit_of(EDIT_KNOT_INSERT, editor->active);
        edit.knot = *knot;
        if (!editor_step(editor, world, "Insert knot", 0, &edit)) return;
        editor_reserve(editor, document);
        at = spline_find_knot(document, spline, sample);
    }
    if (at >= 0) select_only(editor, spline->knots[at].id);
}

/// The frame for a knot of the active spline: a whole one when `snap`, inside the range.
static double knot_frame(const struct editor *editor, const struct editor_world *world, double frame, bool snap)
{
    const struct document *document = world->document;
    const struct spline *spline = editor_active_spline(editor, world);
    double last = document_frame(document, document_last_knot_sample(document, spline));
    return fmin(fmax(snap ? round(frame) : frame, document->first_frame), last);
}

void insert_knot(struct editor *editor, const struct editor_world *world, double frame, double value, bool snap)
{
    if (!editor_active_spline(editor, world) || !isfinite(frame)) return;
    const struct knot knot = {
        .frame = knot_frame(editor, world, frame, snap), .value = value, .stiffness = KNOT_DEFAULT_STIFFNESS};
    insert_at(editor, world, &knot);
}

void insert_on_curve(struct editor *editor, const struct editor_world *world, double frame, bool snap, bool slope)
{
    const struct document *document = world->document;
    if (!editor_active_spline(editor, world) || !isfinite(frame)) return;
    struct knot knot = {
        .frame = knot_frame(editor, world, frame, snap), .stiffness = KNOT_DEFAULT_STIFFNESS, .has_slope = slope};
    int sample = document_sample(document, knot.frame);
    int next = sample + 1 < document_samples(document) ? sample + 1 : sample - 1;
    wiggly_value here = curves_solved(world, editor->active, sample);
    wiggly_value there = curves_solved(world, editor->active, next);
    knot.value = here.y + here.re;
    if (slope && next >= 0) {
        knot.slope = (there.y + there.re - knot.value) / ((next - sample) * document_step(document));
    }
    insert_at(editor, world, &knot);
}

void remove_knots(struct editor *editor, const struct editor_world *world, const char *label)
{
    const struct spline *spline = editor_active_spline(editor, world);
    if (!spline || history_is_open(world->history)) return;
    history_begin(world->history, label, 0);
    for (int k = spline->knot_count - 1; k >= 0; k--) {
        if (!selection_has(&editor->selection, spline->knots[k].id)) continue;
        struct edit edit = editor_edit_of(EDIT_KNOT_REMOVE, editor->active);
        edit.knot.id = spline->knots[k].id;
        editor_edit(editor, world, &edit);
    }
    history_end(world->history);
    selection_clear(&editor->selection);
}

void delete_knots(struct editor *editor, const struct editor_world *world)
{
    int count = selection_count(&editor->selection, editor_active_spline(editor, world));
    remove_knots(editor, world, count == 1 ? "Delete knot" : "Delete knots");
}

void select_all(struct editor *editor, const struct editor_world *world)
{
    const struct spline *spline = editor_active_spline(editor, world);
    for (int k = 0; spline && k < spline->knot_count; k++)
        selection_set(&editor->selection, spline->knots[k].id, true);
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

void select_neighbour(struct editor *editor, const struct editor_world *world, int direction)
{
    const struct spline *spline = editor_active_spline(editor, world);
    if (!spline || spline->knot_count == 0) return;
    int single = selection_single(&editor->selection, spline);
    int next = single + direction;
    if (single < 0) next = beside(world->document, spline, editor->playback.position, direction);
    if (next < 0 || next >= spline->knot_count) return;
    select_only(editor, spline->knots[next].id);
    view_reveal(editor, spline->knots[next].frame, spline->knots[next].value);
}

void activate_neighbour(struct editor *editor, const struct editor_world *world, int direction)
{
    int count = world->document->spline_count;
    if (count > 0) editor_activate(editor, world, ((editor->active + direction) % count + count) % count);
}
