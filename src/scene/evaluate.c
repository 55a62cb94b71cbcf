/// Solves the splines that have changed and their followers in dependency order.
#include "base/hash.h"
#include "base/need.h"
#include "scene/storage.h"
#include "scene/text.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FIRST_KNOTS = 256, ROWS = 5 }; ///< rows of each curve: total, y, re, im, omega

bool evaluation_sentence(const struct evaluation *evaluation, int spline, char *text)
{
    const wiggly_status status = evaluation->status[spline];
    const double error = evaluation->curves[spline].error;
    const int knot = evaluation->curves[spline].knot;
    if (status == WIGGLY_OK) return false;
    if (status >= WIGGLY_ERROR_ARGUMENT && knot >= 0) {
        const struct spline *of = evaluation->storage->state[spline].held;
        snprintf(text, EVALUATION_SENTENCE, "the knot at frame %.6g: %s", of->knots[knot].frame,
                 wiggly_status_text(status));
    } else if (status != WIGGLY_INEXACT) {
        snprintf(text, EVALUATION_SENTENCE, "%s", wiggly_status_text(status));
    } else if (error > 1) {
        snprintf(text, EVALUATION_SENTENCE, "%s: no digit is certain", wiggly_status_text(status));
    } else {
        snprintf(text, EVALUATION_SENTENCE, "%s: %.1e of the curve's size", wiggly_status_text(status), error);
    }
    return true;
}

static void free_storage(struct evaluation *evaluation)
{
    struct storage *storage = evaluation->storage;
    if (!storage) return;
    for (int s = 0; s < evaluation->count; s++) spline_drop(storage->state[s].held);
    wiggly_destroy(storage->solver);
    pinned_free(&storage->pinned);
    pool_free(&storage->pool);
    free(storage);
    evaluation->storage = NULL;
}

static void create_storage(struct evaluation *evaluation, int splines, int samples, int knots)
{
    struct storage *storage = evaluation->storage = need_zeroed(1, sizeof *storage);
    struct pool *pool = &storage->pool;
    const size_t count = (size_t)splines, n = (size_t)samples;
    double *numbers = pool_take(pool, count * ROWS * n, sizeof *numbers);
    evaluation->curves = pool_take(pool, count, sizeof *evaluation->curves);
    evaluation->status = pool_take(pool, count, sizeof *evaluation->status);
    evaluation->count = splines;
    evaluation->samples = samples;
    storage->state = pool_take(pool, count, sizeof *storage->state);
    storage->order = pool_take(pool, count, sizeof *storage->order);
    storage->space.stack = pool_take(pool, count, sizeof *storage->space.stack);
    storage->space.next = pool_take(pool, count, sizeof *storage->space.next);
    storage->knots = pool_take(pool, (size_t)knots, sizeof *storage->knots);
    if (wiggly_create(samples, knots, &storage->solver) != WIGGLY_OK) need_failed();
    storage->solver_knots = knots;
    storage->is_new = true;
    for (int i = 0; i < splines; i++, numbers += ROWS * n) {
        evaluation->curves[i] = (wiggly_curve){.size = sizeof(wiggly_curve),
                                               .total = numbers,
                                               .y = numbers + n,
                                               .re = numbers + 2 * n,
                                               .im = numbers + 3 * n,
                                               .omega = numbers + 4 * n,
                                               .samples = samples,
                                               .mode = WIGGLY_CUBIC};
    }
}

/// Makes room for the document's splines.
static void resize(struct evaluation *evaluation, const struct document *document)
{
    const int splines = document->spline_count, samples = document_samples(document);
    int needed = 0, knots = FIRST_KNOTS;
    for (int i = 0; i < splines; i++) {
        const int room = storage_knot_room(document->splines[i], samples);
        if (room > needed) needed = room;
    }
    while (knots < needed) knots *= 2;
    if (evaluation->storage && evaluation->count == splines && evaluation->samples == samples &&
        evaluation->storage->solver_knots >= needed)
        return;
    free_storage(evaluation);
    create_storage(evaluation, splines, samples, knots);
}

void evaluation_free(struct evaluation *evaluation)
{
    free_storage(evaluation);
    *evaluation = (struct evaluation){0};
}

/// Whether the spline follows one that was just solved.
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
    evaluation->revision++;
    evaluation->solved_splines++;
    evaluation->solved_samples += evaluation->samples;
    evaluation->solved_knots += document->splines[spline]->knot_count;
}

static void solve(struct evaluation *evaluation, const struct document *document, int spline, bool cubic)
{
    struct storage *storage = evaluation->storage;
    wiggly_curve *curve = &evaluation->curves[spline];
    wiggly_desc desc = storage_describe(evaluation, document, spline, cubic);
    assert(document->splines[spline]->knot_count <= storage->solver_knots);
    storage_add_knots(&desc, document, spline, storage->knots);
    wiggly_set_method(storage->solver, evaluation_method(evaluation, &desc));
    const wiggly_status status = wiggly_solve(storage->solver, &desc, curve);
    if (status >= WIGGLY_ERROR_ARGUMENT) storage_flatten(curve, &desc);
    count_solved(evaluation, document, spline, status);
}

/// Whether a spline is out of date: it has changed since it was solved, or a spline that it follows was solved.
static bool is_due(struct evaluation *evaluation, const struct document *document, int spline)
{
    const struct storage *storage = evaluation->storage;
    const struct spline_state *state = &storage->state[spline];
    return storage->is_new || state->held != document->splines[spline] || state->baked.is_new || state->forced ||
           follows_solved(storage, document->splines[spline], evaluation->cubic);
}

/// Keeps a reference to the solved spline, so that its address is not reused.
static void mark_solved(struct storage *storage, const struct document *document, int spline)
{
    struct spline_state *state = &storage->state[spline];
    struct spline *old = state->held;
    state->held = spline_hold(document->splines[spline]);
    spline_drop(old);
    state->solved = true;
    state->baked.is_new = state->forced = false;
}

/// Solves a group of splines, listed from `order` on, if one is out of date. Returns how many there are.
static int update_group(struct evaluation *evaluation, const struct document *document, const int *order)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    int count = 0;
    wiggly_status status;
    bool due = pinned_take(pinned, pinned->which[order[0]]);
    for (int s = 0; s < evaluation->count; s++) {
        if (pinned->which[s] != pinned->group) continue;
        count++;
        due |= is_due(evaluation, document, s);
    }
    const bool together = due && pinned_solve(pinned, &status);
    for (int i = 0; i < count; i++) {
        pinned->placed[order[i]] = true;
        if (due) mark_solved(evaluation->storage, document, order[i]);
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
    wiggly_desc desc = storage_describe(evaluation, document, spline, evaluation->cubic);
    storage_add_knots(&desc, document, spline, knots);
    return desc;
}

static uint64_t hash_text(uint64_t hash, const char *text)
{
    return hash_bytes(hash, text ? text : "", text_size(text));
}

static uint64_t hash_number(uint64_t hash, double number) { return hash_bytes(hash, &number, sizeof number); }

static uint64_t hash_model(uint64_t hash, const struct model_rig *model)
{
    hash = hash_text(hash_text(hash, model->model), model->clip);
    return hash_number(hash_number(hash, model->scale), model->turn);
}

static uint64_t hash_chain(uint64_t hash, const struct chain *chain)
{
    hash = hash_text(hash_text(hash_text(hash, chain->model), chain->from), chain->to);
    return hash_word(hash_number(hash, chain->turn), chain->mirror);
}

/// A hash of everything that the samples depend on; never 0.
static uint64_t key_of(const struct document *document, const struct joint_motion *motion,
                       const struct model_source *source)
{
    const int model = document_find_model(document, motion->model, motion->by_file);
    const int chain = motion->chain ? document_find_chain(document, motion->chain) : -1;
    uint64_t hash = hash_text(HASH_START, motion->joint);
    hash = hash_word(hash_number(hash, document->fps), (uint64_t)document->substeps);
    hash = hash_word(hash_word(hash, (uint64_t)document->first_frame), (uint64_t)document->last_frame);
    hash = hash_word(hash, (uint64_t)motion->of);
    hash = hash_word(hash_word(hash, source->follow ? 1 : 0), source->version);
    if (model >= 0) hash = hash_model(hash, &document->rigs[model]->model);
    if (chain >= 0) hash = hash_chain(hash, &document->rigs[chain]->chain);
    return hash | 1;
}

static void read(struct baked *baked, const struct document *document, const struct joint_motion *motion,
                 const struct model_source *source)
{
    const int count = document_samples(document);
    bool good = source->follow && source->follow(source->context, document, motion, baked->raw);
    for (int i = 0; good && i < count; i++) good = isfinite(baked->raw[i]);
    for (int i = 0; !good && i < count; i++) baked->raw[i] = 0;
}

/// Reads motions again if the document's frames, model, clip or chain, or the source's version, have changed; their splines are then
/// solved. An unreadable motion is 0 throughout.
static void motions_bake(struct evaluation *evaluation, const struct document *document)
{
    const int count = evaluation->samples;
    for (int s = 0; s < document->spline_count; s++) {
        const struct param *param = &document->splines[s]->parameter[PARAMETER_EQUILIBRIUM];
        struct baked *baked = &evaluation->storage->state[s].baked;
        if (!param->motion) continue;
        const uint64_t key = key_of(document, param->motion, &evaluation->models);
        if (key == baked->key && param->motion->gain == baked->gain) continue;
        if (!baked->raw) {
            baked->raw = pool_take(&evaluation->storage->pool, (size_t)count, sizeof *baked->raw);
            baked->samples = pool_take(&evaluation->storage->pool, (size_t)count, sizeof *baked->samples);
        }
        if (key != baked->key) read(baked, document, param->motion, &evaluation->models);
        for (int i = 0; i < count; i++) baked->samples[i] = param->motion->gain * baked->raw[i];
        baked->key = key;
        baked->gain = param->motion->gain;
        baked->is_new = true;
    }
}

bool evaluation_is_of(const struct evaluation *evaluation, const struct document *document)
{
    return evaluation->storage && evaluation->storage->edits == document->edits;
}

/// Records what the update is for. All splines become out of date if the mode or the samples have changed.
static void note(struct evaluation *evaluation, const struct document *document, bool cubic)
{
    struct storage *storage = evaluation->storage;
    storage->is_new |= cubic != evaluation->cubic || document->fps != storage->fps ||
                       document->substeps != storage->substeps || document->first_frame != storage->first_frame;
    evaluation->cubic = cubic;
    storage->fps = document->fps;
    storage->substeps = document->substeps;
    storage->first_frame = document->first_frame;
    storage->edits = document->edits;
    storage->version = evaluation->models.version;
}

void evaluation_update(struct evaluation *evaluation, const struct document *document, bool cubic)
{
    struct order_cycle cycle;
    evaluation->solved_splines = evaluation->solved_samples = evaluation->solved_knots = 0;
    if (evaluation_is_of(evaluation, document) && evaluation->cubic == cubic &&
        evaluation->storage->version == evaluation->models.version)
        return;
    resize(evaluation, document);
    note(evaluation, document, cubic);
    motions_bake(evaluation, document);
    struct storage *storage = evaluation->storage;
    struct pinned *pinned = &storage->pinned;
    if (!scene_order(document, storage->space, storage->order, &cycle)) return; // never: no document has cycles
    pinned_resize(evaluation, document);
    const bool grouped = pinned_begin(evaluation, document);
    const int *order = grouped ? pinned->order : storage->order;
    for (int i = 0; i < evaluation->count; i++) storage->state[i].solved = false;
    for (int i = 0; i < evaluation->count;) {
        if (grouped && pinned->which[order[i]] >= 0) {
            i += update_group(evaluation, document, &order[i]);
            continue;
        }
        update_alone(evaluation, document, order[i]);
        if (grouped) pinned->placed[order[i]] = true;
        i++;
    }
    pinned_measure(pinned);
    storage->is_new = false;
}

/// Samples of a spline's longest stretch without a knot: between two, round a loop, from rest, and after the last where jets reach there.
static int longest_gap(const wiggly_desc *desc)
{
    const int knots = desc->knot_count, last = desc->samples - 1;
    int longest = 0;
    for (int k = 1; k < knots; k++) {
        const int gap = desc->knots[k].sample - desc->knots[k - 1].sample;
        longest = gap > longest ? gap : longest;
    }
    const int before = knots > 0 ? desc->knots[0].sample : last,
              after = knots > 0 ? last - desc->knots[knots - 1].sample : 0;
    const bool reaches = desc->mode == WIGGLY_REAL || desc->passive == WIGGLY_FILTER;
    const int seam = desc->start == WIGGLY_LOOP ? before + after : 0, rest = desc->start == WIGGLY_REST ? before : 0,
              end = reaches ? after : 0, outer = seam > rest ? seam : rest;
    longest = outer > longest ? outer : longest;
    return end > longest ? end : longest;
}

static bool is_band(const struct evaluation *evaluation)
{
    if (evaluation->solver != SOLVER_BY_LENGTH) return evaluation->solver == SOLVER_BAND;
    return evaluation->samples <= SOLVER_LONGEST_BAND;
}

wiggly_method evaluation_method(const struct evaluation *evaluation, const wiggly_desc *desc)
{
    if (!is_band(evaluation)) return WIGGLY_CHAIN;
    const bool by_length = evaluation->solver == SOLVER_BY_LENGTH;
    return by_length && longest_gap(desc) > SOLVER_LONGEST_GAP ? WIGGLY_CHAIN : WIGGLY_BAND;
}

const char *evaluation_solver(const struct evaluation *evaluation) { return is_band(evaluation) ? "band" : "chain"; }

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
