/// Solves the splines that have changed and their followers in dependency order.
#include "scene/evaluate.h"
#include "base/need.h"
#include "scene/storage.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_KNOTS = 256 };

static void free_splines(struct evaluation *evaluation, struct storage *storage)
{
    for (int s = 0; s < storage->spline_capacity; s++) {
        spline_drop(storage->state[s].held);
        free(storage->state[s].baked.raw);
    }
    free(storage->state);
    free(storage->order);
    free(storage->space.stack);
    free(storage->space.next);
    free(evaluation->curves);
    free(evaluation->status);
    free(evaluation->revisions);
}

static void resize_splines(struct evaluation *evaluation, struct storage *storage, int splines)
{
    if (splines <= storage->spline_capacity) return;
    size_t count = (size_t)splines;
    free_splines(evaluation, storage);
    evaluation->curves = need_zeroed(count, sizeof *evaluation->curves);
    evaluation->status = need_zeroed(count, sizeof *evaluation->status);
    evaluation->revisions = need_zeroed(count, sizeof *evaluation->revisions);
    storage->state = need_zeroed(count, sizeof *storage->state);
    storage->order = need(count, sizeof *storage->order);
    storage->space.stack = need(count, sizeof *storage->space.stack);
    storage->space.next = need(count, sizeof *storage->space.next);
    storage->spline_capacity = splines;
    storage->is_new = true;
}

static void resize_numbers(struct storage *storage, int splines, int samples)
{
    const size_t needed = (size_t)splines * ROWS * (size_t)samples;
    if (needed <= storage->number_capacity) return;
    free(storage->numbers);
    storage->numbers = need_zeroed(needed, sizeof *storage->numbers);
    storage->number_capacity = needed;
    storage->is_new = true;
}

/// Room for the motions that splines follow.
static void resize_baked(struct storage *storage, const struct document *document, int samples)
{
    for (int s = 0; s < document->spline_count; s++) {
        struct baked *baked = &storage->state[s].baked;
        if (!document->splines[s]->parameter[PARAMETER_EQUILIBRIUM].motion || samples <= baked->capacity) continue;
        free(baked->raw);
        *baked = (struct baked){.raw = need(2 * (size_t)samples, sizeof *baked->raw), .capacity = samples};
        baked->samples = baked->raw + samples;
    }
}

bool evaluation_sentence(const struct evaluation *evaluation, int spline, char *text)
{
    const wiggly_status status = evaluation->status[spline];
    const double error = evaluation->curves[spline].error;
    if (status == WIGGLY_OK) return false;
    if (status != WIGGLY_INEXACT) {
        snprintf(text, EVALUATION_SENTENCE, "%s", wiggly_status_text(status));
    } else if (error > 1) {
        snprintf(text, EVALUATION_SENTENCE, "%s: no digit of it is certain", wiggly_status_text(status));
    } else {
        snprintf(text, EVALUATION_SENTENCE, "%s: %.1e of the curve's size", wiggly_status_text(status), error);
    }
    return true;
}

static void resize_solver(struct storage *storage, int samples, int knots)
{
    if (storage->solver && samples <= storage->solver_samples && knots <= storage->solver_knots) return;
    int room = storage->solver_knots > FIRST_KNOTS ? storage->solver_knots : FIRST_KNOTS;
    while (room < knots) room *= 2;
    if (samples < storage->solver_samples) samples = storage->solver_samples;
    wiggly_destroy(storage->solver);
    free(storage->knots);
    storage->knots = need((size_t)room, sizeof *storage->knots);
    if (wiggly_create(samples, room, &storage->solver) != WIGGLY_OK) need_failed();
    storage->solver_samples = samples;
    storage->solver_knots = room;
}

/// Gives each curve its place. Until it is solved, its numbers are zeros or left over from another layout: finite in any case.
static void lay_out(struct evaluation *evaluation, struct storage *storage, int splines, int samples)
{
    evaluation->count = splines;
    evaluation->samples = samples;
    storage->is_new = true;
    for (int i = 0; i < splines; i++) {
        storage_place(&evaluation->curves[i], storage->numbers + (size_t)i * ROWS * (size_t)samples, samples);
        evaluation->status[i] = WIGGLY_OK;
    }
}

void evaluation_resize(struct evaluation *evaluation, const struct document *document)
{
    int splines = document->spline_count, samples = document_samples(document), knots = 0;
    for (int i = 0; i < splines; i++) {
        int room = storage_knot_room(document->splines[i], samples);
        if (room > knots) knots = room;
    }
    if (!evaluation->storage) evaluation->storage = need_zeroed(1, sizeof *evaluation->storage);
    struct storage *storage = evaluation->storage;
    resize_splines(evaluation, storage, splines);
    resize_numbers(storage, splines, samples);
    resize_solver(storage, samples, knots);
    resize_baked(storage, document, samples);
    pinned_resize(storage, document);
    bool same = evaluation->count == splines && evaluation->samples == samples && !storage->is_new;
    if (!same) lay_out(evaluation, storage, splines, samples);
}

void evaluation_free(struct evaluation *evaluation)
{
    struct storage *storage = evaluation->storage;
    if (storage) {
        free_splines(evaluation, storage);
        free(storage->numbers);
        free(storage->knots);
        wiggly_destroy(storage->solver);
        pinned_free(&storage->pinned);
        free(storage);
    }
    *evaluation = (struct evaluation){0};
}

/// Whether the spline depends on one that was just solved.
static bool follows_solved(const struct storage *storage, const struct spline *spline, bool cubic)
{
    for (int i = 0; i < PARAMETER_COUNT; i++) {
        int track = spline->parameter[i].track;
        if (track >= 0 && storage->state[track].solved && spline_uses(spline, (enum parameter)i, cubic)) return true;
    }
    return false;
}

static void count_solved(struct evaluation *evaluation, const struct document *document, int spline,
                         wiggly_status status)
{
    evaluation->status[spline] = status;
    evaluation->revisions[spline] = ++evaluation->revision;
    evaluation->solved_splines++;
    evaluation->solved_samples += evaluation->samples;
    evaluation->solved_knots += document->splines[spline]->knot_count;
}

static void solve(struct evaluation *evaluation, const struct document *document, int spline, bool cubic)
{
    struct storage *storage = evaluation->storage;
    wiggly_curve *curve = &evaluation->curves[spline];
    wiggly_desc desc = storage_describe(storage, evaluation->curves, document, spline, cubic);
    assert(document->splines[spline]->knot_count <= storage->solver_knots);
    storage_add_knots(&desc, document, spline, storage->knots);
    wiggly_set_method(storage->solver, evaluation_method(evaluation));
    const wiggly_status status = wiggly_solve(storage->solver, &desc, curve);
    if (status >= WIGGLY_ERROR_ARGUMENT) storage_flatten(curve, &desc);
    count_solved(evaluation, document, spline, status);
}

/// Whether a spline is out of date: it or what it follows is not what was solved.
static bool is_due(struct evaluation *evaluation, const struct document *document, int spline)
{
    const struct storage *storage = evaluation->storage;
    const struct spline_state *state = &storage->state[spline];
    return storage->is_new || state->held != document->splines[spline] || state->baked.is_new || state->forced ||
           follows_solved(storage, document->splines[spline], evaluation->cubic);
}

/// Holds what is solved, so that its address stays its own.
static void mark_solved(struct storage *storage, const struct document *document, int spline)
{
    struct spline_state *state = &storage->state[spline];
    struct spline *old = state->held;
    state->held = spline_hold(document->splines[spline]);
    spline_drop(old);
    state->solved = true;
    state->baked.is_new = state->forced = false;
}

/// Whether all splines are to be solved: another way, or at other times.
static bool has_changed(const struct evaluation *evaluation, const struct document *document, bool cubic)
{
    const struct storage *storage = evaluation->storage;
    return cubic != evaluation->cubic || document->fps != storage->fps || document->substeps != storage->substeps ||
           document->first_frame != storage->first_frame;
}

/// Solves the splines of a group, which are in a row from `order` on, if one of them is out of date. Returns how many they are.
static int update_group(struct evaluation *evaluation, const struct document *document, const int *order)
{
    struct storage *storage = evaluation->storage;
    const struct pinned *pinned = &storage->pinned;
    const int which = pinned->which[order[0]];
    int count = 0;
    wiggly_status status;
    bool due = pinned_base_moved(evaluation, document, which);
    for (int s = 0; s < evaluation->count; s++) {
        if (pinned->which[s] != which) continue;
        count++;
        due |= is_due(evaluation, document, s);
    }
    const bool together = due && pinned_solve(evaluation, document, which, &status);
    for (int i = 0; i < count; i++) {
        pinned->placed[order[i]] = true;
        if (due) mark_solved(storage, document, order[i]);
        if (together) count_solved(evaluation, document, order[i], status);
        if (due && !together) solve(evaluation, document, order[i], false);
    }
    return count;
}

static void update_alone(struct evaluation *evaluation, const struct document *document, int spline)
{
    if (!is_due(evaluation, document, spline)) return;
    mark_solved(evaluation->storage, document, spline);
    solve(evaluation, document, spline, evaluation->cubic);
}

wiggly_desc evaluation_describe(const struct evaluation *evaluation, const struct document *document, int spline,
                                wiggly_knot *knots)
{
    wiggly_desc desc = storage_describe(evaluation->storage, evaluation->curves, document, spline, evaluation->cubic);
    storage_add_knots(&desc, document, spline, knots);
    return desc;
}

void evaluation_update(struct evaluation *evaluation, const struct document *document, bool cubic)
{
    struct storage *storage = evaluation->storage;
    struct order_cycle cycle;
    evaluation->solved_splines = evaluation->solved_samples = evaluation->solved_knots = 0;
    assert(evaluation->count == document->spline_count && evaluation->samples == document_samples(document));
    storage->is_new |= has_changed(evaluation, document, cubic);
    evaluation->cubic = cubic;
    storage->fps = document->fps;
    storage->substeps = document->substeps;
    storage->first_frame = document->first_frame;
    if (!scene_order(document, storage->space, storage->order, &cycle)) return; // a document has no cycles
    const bool grouped = pinned_begin(evaluation, document);
    const int *order = grouped ? storage->pinned.order : storage->order;
    for (int i = 0; i < evaluation->count; i++) storage->state[i].solved = false;
    for (int i = 0; i < evaluation->count;) {
        if (grouped && storage->pinned.which[order[i]] >= 0) {
            i += update_group(evaluation, document, &order[i]);
            continue;
        }
        update_alone(evaluation, document, order[i]);
        if (grouped) storage->pinned.placed[order[i]] = true;
        i++;
    }
    if (storage->pinned.pins > 0) pinned_measure(evaluation, document);
    storage->is_new = false;
}

wiggly_method evaluation_method(const struct evaluation *evaluation)
{
    if (evaluation->solver != SOLVER_BY_LENGTH) return evaluation->solver == SOLVER_BAND ? WIGGLY_BAND : WIGGLY_CHAIN;
    return evaluation->samples <= SOLVER_LONGEST_BAND ? WIGGLY_BAND : WIGGLY_CHAIN;
}

const char *evaluation_solver(const struct evaluation *evaluation)
{
    return evaluation_method(evaluation) == WIGGLY_BAND ? "band" : "chain";
}

wiggly_value evaluation_at(const struct evaluation *evaluation, int spline, double position)
{
    bool solved = evaluation && spline >= 0 && spline < evaluation->count && evaluation->samples > 0;
    return solved ? wiggly_evaluate(&evaluation->curves[spline], position) : (wiggly_value){0};
}

int evaluation_extreme(const struct evaluation *evaluation, int spline, int first, int last, bool highest)
{
    const double *total = evaluation->curves[spline].total;
    int best = first;
    for (int i = first + 1; i <= last; i++) {
        if (highest ? total[i] > total[best] : total[i] < total[best]) best = i;
    }
    return best;
}
