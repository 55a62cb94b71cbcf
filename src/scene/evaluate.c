#include "scene/evaluate.h"
#include "base/checked.h"
#include "scene/order.h"
#include <stdlib.h>
#include <string.h>

enum { ROWS = 5, FIRST_KNOTS = 256 }; ///< rows of numbers a curve: total, y, re, im, omega

struct storage {
    double *numbers; ///< ROWS · N for each spline
    size_t number_capacity;
    wiggly_solver *solver;
    int solver_samples, solver_knots;
    wiggly_knot *knots; ///< of the spline being solved; solver_knots
    int *order;         ///< one a spline each, as the next three
    bool *solved;
    struct order_space space;
    int spline_capacity;
    bool is_new; ///< curves were laid out anew, and none is solved
};

static bool fail_memory(const struct document *document, struct error *error)
{
    return fail(error, ERROR_ENVIRONMENT, "not enough memory to solve %d splines of %d samples",
                document->spline_count, document_samples(document));
}

static void free_splines(struct evaluation *evaluation, struct storage *storage)
{
    free(evaluation->curves);
    free(evaluation->status);
    free(storage->order);
    free(storage->solved);
    free(storage->space.stack);
    free(storage->space.next);
    evaluation->curves = NULL;
    evaluation->status = NULL;
    storage->order = NULL;
    storage->solved = NULL;
    storage->space = (struct order_space){0};
    storage->spline_capacity = 0;
}

static bool resize_splines(struct evaluation *evaluation, struct storage *storage, int splines)
{
    if (splines <= storage->spline_capacity) return true;
    size_t count = (size_t)splines;
    free_splines(evaluation, storage);
    evaluation->curves = calloc(count, sizeof *evaluation->curves);
    evaluation->status = calloc(count, sizeof *evaluation->status);
    storage->order = calloc(count, sizeof *storage->order);
    storage->solved = calloc(count, sizeof *storage->solved);
    storage->space.stack = calloc(count, sizeof *storage->space.stack);
    storage->space.next = calloc(count, sizeof *storage->space.next);
    storage->is_new = true;
    if (!evaluation->curves || !evaluation->status || !storage->order || !storage->solved || !storage->space.stack ||
        !storage->space.next) {
        return false;
    }
    storage->spline_capacity = splines;
    return true;
}

static bool resize_numbers(struct storage *storage, int splines, int samples)
{
    size_t needed;
    if (!checked_mul((size_t)splines * ROWS, (size_t)samples, &needed)) return false;
    if (needed <= storage->number_capacity) return true;
    free(storage->numbers);
    storage->numbers = calloc(needed, sizeof *storage->numbers);
    storage->number_capacity = storage->numbers ? needed : 0;
    storage->is_new = true;
    return storage->numbers != NULL;
}

static bool resize_solver(struct storage *storage, int samples, int knots)
{
    if (storage->solver && samples <= storage->solver_samples && knots <= storage->solver_knots) return true;
    int room = storage->solver_knots > FIRST_KNOTS ? storage->solver_knots : FIRST_KNOTS;
    while (room < knots) room *= 2;
    if (samples < storage->solver_samples) samples = storage->solver_samples;
    wiggly_destroy(storage->solver);
    free(storage->knots);
    storage->solver = NULL;
    storage->solver_samples = storage->solver_knots = 0;
    storage->knots = malloc((size_t)room * sizeof *storage->knots);
    if (!storage->knots || wiggly_create(samples, room, &storage->solver) != WIGGLY_OK) return false;
    storage->solver_samples = samples;
    storage->solver_knots = room;
    return true;
}

/// Where each curve's numbers are. Until they are solved they are zeros or what another layout left: finite in any
/// case.
static void lay_out(struct evaluation *evaluation, struct storage *storage, int splines, int samples)
{
    evaluation->count = splines;
    evaluation->samples = samples;
    storage->is_new = true;
    for (int i = 0; i < splines; i++) {
        double *row = storage->numbers + (size_t)i * ROWS * (size_t)samples;
        size_t n = (size_t)samples;
        evaluation->curves[i] = (wiggly_curve){.total = row,
                                               .y = row + n,
                                               .re = row + 2 * n,
                                               .im = row + 3 * n,
                                               .omega = row + 4 * n,
                                               .samples = samples,
                                               .mode = WIGGLY_CUBIC};
        evaluation->status[i] = WIGGLY_OK;
    }
}

bool evaluation_resize(struct evaluation *evaluation, const struct document *document, struct error *error)
{
    int splines = document->spline_count, samples = document_samples(document), knots = 0;
    for (int i = 0; i < splines; i++) {
        if (document->splines[i].knot_count > knots) knots = document->splines[i].knot_count;
    }
    if (!evaluation->storage) evaluation->storage = calloc(1, sizeof(struct storage));
    struct storage *storage = evaluation->storage;
    if (!storage) return fail_memory(document, error);
    if (!resize_splines(evaluation, storage, splines) || !resize_numbers(storage, splines, samples) ||
        !resize_solver(storage, samples, knots)) {
        evaluation->count = 0;
        return fail_memory(document, error);
    }
    bool same = evaluation->count == splines && evaluation->samples == samples && !storage->is_new;
    if (!same) lay_out(evaluation, storage, splines, samples);
    return true;
}

void evaluation_free(struct evaluation *evaluation)
{
    struct storage *storage = evaluation->storage;
    if (storage) {
        free_splines(evaluation, storage);
        free(storage->numbers);
        free(storage->knots);
        wiggly_destroy(storage->solver);
        free(storage);
    }
    *evaluation = (struct evaluation){0};
}

static wiggly_param solver_param(const struct evaluation *evaluation, const struct spline *spline,
                                 enum parameter parameter)
{
    const struct param *param = &spline->parameter[parameter];
    return (wiggly_param){param->value, param->track >= 0 ? evaluation->curves[param->track].total : NULL};
}

/// What is to be solved for one spline; tracks point into the evaluation, `knots` has room for the spline's.
static wiggly_desc describe(const struct evaluation *evaluation, const struct document *document, int spline_index,
                            bool cubic, wiggly_knot *knots)
{
    const struct spline *spline = &document->splines[spline_index];
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = document_samples(document);
    desc.step = document_step(document);
    desc.mode = cubic ? WIGGLY_CUBIC : spline->mode;
    desc.start = spline->start;
    desc.frequency = solver_param(evaluation, spline, PARAMETER_FREQUENCY);
    desc.damping = solver_param(evaluation, spline, PARAMETER_DAMPING);
    desc.bandwidth = solver_param(evaluation, spline, PARAMETER_BANDWIDTH);
    desc.spring_friction = spline->spring_friction && desc.mode == WIGGLY_REAL;
    desc.spring = solver_param(evaluation, spline, PARAMETER_SPRING);
    desc.friction = solver_param(evaluation, spline, PARAMETER_FRICTION);
    desc.equilibrium = solver_param(evaluation, spline, PARAMETER_EQUILIBRIUM);
    desc.calm = spline->parameter[PARAMETER_CALM].value;
    desc.knots = knots;
    desc.knot_count = spline->knot_count;
    for (int i = 0; i < spline->knot_count; i++) {
        const struct knot *knot = &spline->knots[i];
        knots[i] = (wiggly_knot){.sample = document_sample(document, knot->frame),
                                 .has_slope = knot->has_slope,
                                 .value = knot->value,
                                 .slope = knot->slope,
                                 .stiffness = knot->stiffness};
    }
    return desc;
}

/// Whether a spline that was solved now is one that this one depends on.
static bool follows_solved(const struct storage *storage, const struct spline *spline, bool cubic)
{
    for (int i = 0; i < PARAMETER_COUNT; i++) {
        int track = spline->parameter[i].track;
        if (track >= 0 && storage->solved[track] && spline_uses(spline, (enum parameter)i, cubic)) return true;
    }
    return false;
}

/// What is shown where there is no solution: nothing moves.
static void flatten(wiggly_curve *curve, const wiggly_desc *desc)
{
    double *const rows[] = {curve->total, curve->y, curve->re, curve->im, curve->omega};
    for (int r = 0; r < ROWS; r++) memset(rows[r], 0, sizeof(double) * (size_t)desc->samples);
    curve->samples = desc->samples;
    curve->step = desc->step;
    curve->first = 0;
    curve->mode = desc->mode;
    curve->start = WIGGLY_FREE;
}

static void solve(struct evaluation *evaluation, const struct document *document, int spline, bool cubic)
{
    struct storage *storage = evaluation->storage;
    int knots = document->splines[spline].knot_count;
    wiggly_curve *curve = &evaluation->curves[spline];
    wiggly_desc desc = {.samples = evaluation->samples, .step = document_step(document)};
    wiggly_status status = WIGGLY_ERROR_CAPACITY;
    if (knots <= storage->solver_knots) {
        desc = describe(evaluation, document, spline, cubic, storage->knots);
        status = wiggly_solve(storage->solver, &desc, curve);
    }
    if (status >= WIGGLY_ERROR_ARGUMENT) flatten(curve, &desc);
    evaluation->status[spline] = status;
    evaluation->solved_splines++;
    evaluation->solved_samples += desc.samples;
    evaluation->solved_knots += knots;
}

void evaluation_update(struct evaluation *evaluation, const struct document *document, const bool *dirty, bool cubic)
{
    struct storage *storage = evaluation->storage;
    struct order_cycle cycle;
    evaluation->solved_splines = evaluation->solved_samples = evaluation->solved_knots = 0;
    bool fits = evaluation->count == document->spline_count && evaluation->samples == document_samples(document);
    if (!fits) return; // evaluation_resize() failed, and said so
    bool all = !dirty || storage->is_new || cubic != evaluation->cubic;
    evaluation->cubic = cubic;
    if (!scene_order(document, storage->space, storage->order, &cycle)) return; // no document has one
    for (int i = 0; i < evaluation->count; i++) storage->solved[i] = false;
    for (int i = 0; i < evaluation->count; i++) {
        int spline = storage->order[i];
        if (!all && !dirty[spline] && !follows_solved(storage, &document->splines[spline], cubic)) continue;
        storage->solved[spline] = true;
        solve(evaluation, document, spline, cubic);
    }
    storage->is_new = false;
}
