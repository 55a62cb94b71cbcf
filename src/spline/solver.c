/// A solver's memory: one block, carved once, largest alignment first so that nothing needs padding.
#include "spline/solver.h"
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/// What carve() hands out for each sample and for each knot; keep in step with it.
enum {
    MATRIX_DOUBLES = 3 + 4 + 4 + 2 * BORDER_MAX,
    CHAIN_DOUBLES = 8,
    RUN_DOUBLES = 6,
    LIMIT_DOUBLES = 11,
    LINE = 64, ///< of the cache: columns begin with one
    BYTES_PER_SAMPLE =
        (int)((MATRIX_DOUBLES + 2 + 2 + 2 + 4 + 4) * sizeof(double) + sizeof(coefficients) +
              LIMIT_DOUBLES * sizeof(double) + sizeof(cplx) + 3 * sizeof(int) + 2 * sizeof(unsigned char)),
    BYTES_PER_KNOT = (int)(sizeof(slope_row) + sizeof(chain_stretch) + sizeof(chain_node) + sizeof(chain_row) +
                           2 * sizeof(wiggly_knot) + 9 * sizeof(double) + sizeof(int)),
    FIXED_BYTES = (int)(RUN_DOUBLES * CHAIN_RUN * sizeof(double)) + CHAIN_DOUBLES * LINE + 3 * LINE,
};

_Static_assert((int)CHAIN_DOUBLES <= (int)MATRIX_DOUBLES, "the chain's tables lie over the matrix");

size_t wiggly_memsize(int samples, int knots)
{
    if (samples < 1 || knots < 0) return 0;
    size_t per_sample, per_knot, sum;
    if (__builtin_mul_overflow((size_t)samples, (size_t)BYTES_PER_SAMPLE, &per_sample) ||
        __builtin_mul_overflow((size_t)knots + 1, (size_t)BYTES_PER_KNOT, &per_knot) ||
        __builtin_add_overflow(per_sample, per_knot, &sum) ||
        __builtin_add_overflow(sum, sizeof(wiggly_solver) + FIXED_BYTES, &sum)) {
        return 0;
    }
    return sum;
}

static void *take(unsigned char **at, size_t bytes)
{
    void *p = *at;
    *at += bytes;
    return p;
}

static void *take_lines(unsigned char **at, size_t bytes)
{
    *at += (LINE - (uintptr_t)*at % LINE) % LINE;
    return take(at, bytes);
}

/// Tables of the chain, the powers' over the matrix.
static void carve_tables(chain *c, unsigned char *runs, unsigned char *powers, size_t samples)
{
    double **const run_columns[] = {&c->pulled[0].re, &c->pulled[0].im, &c->pulled[1].re,
                                    &c->pulled[1].im, &c->back.re,      &c->back.im};
    double **const columns[] = {&c->powers.p.re,   &c->powers.p.im,   &c->powers.q.re, &c->powers.q.im,
                                &c->powers.w01.re, &c->powers.w01.im, &c->powers.w00,  &c->powers.w11};
    _Static_assert(sizeof run_columns / sizeof *run_columns == RUN_DOUBLES, "RUN_DOUBLES counts the columns");
    _Static_assert(sizeof columns / sizeof *columns == CHAIN_DOUBLES, "CHAIN_DOUBLES counts the columns");
    for (int i = 0; i < RUN_DOUBLES; i++) *run_columns[i] = take_lines(&runs, CHAIN_RUN * sizeof(double));
    for (int i = 0; i < CHAIN_DOUBLES; i++) *columns[i] = take_lines(&powers, samples * sizeof(double));
}

static void carve(wiggly_solver *solver)
{
    unsigned char *at = (unsigned char *)(solver + 1);
    size_t n = (size_t)solver->samples;
    system_rows *rows = &solver->rows;
    pentadiagonal *m = &solver->matrix;
    rows->at = take(&at, n * sizeof(coefficients));
    rows->drive = take(&at, n * sizeof(cplx));
    m->diagonal = take(&at, 3 * n * sizeof(double));
    m->below = take(&at, 4 * n * sizeof(double));
    m->below2 = take(&at, 4 * n * sizeof(double));
    m->border = take(&at, 2 * BORDER_MAX * n * sizeof(double));
    take(&at, CHAIN_DOUBLES * LINE + LINE); // what the tables' columns are longer than the matrix of few samples
    rows->jet_weight = take(&at, n * sizeof(double));
    rows->im_weight = take(&at, n * sizeof(double));
    rows->x = take(&at, 2 * n * sizeof(double));
    rows->gradient = take(&at, 2 * n * sizeof(double));
    rows->jet = take(&at, 4 * n * sizeof(double));
    solver->y = take(&at, n * sizeof(double));
    solver->response.total = take(&at, n * sizeof(double));
    solver->response.im = take(&at, n * sizeof(double));
    solver->response.speed = take(&at, n * sizeof(double));
    limit_memory *limits = &solver->limits;
    double **const of_limits[] = {&limits->pull,    &limits->spare,   &limits->re,        &limits->im,
                                  &limits->free[0], &limits->free[1], &limits->pushed[0], &limits->pushed[1]};
    _Static_assert(sizeof of_limits / sizeof *of_limits + 3 == LIMIT_DOUBLES, "LIMIT_DOUBLES counts the arrays");
    for (size_t i = 0; i < sizeof of_limits / sizeof *of_limits; i++) *of_limits[i] = take(&at, n * sizeof(double));
    limits->stiffness = take(&at, n * sizeof(double));
    limits->by_push = take(&at, 2 * n * sizeof(double));
    size_t k = (size_t)solver->knots + 1;
    chain *c = &solver->chain;
    limits->own = take(&at, k * sizeof(wiggly_knot));
    limits->all = take(&at, k * sizeof(wiggly_knot));
    rows->slopes = take(&at, k * sizeof(slope_row));
    c->stretches = take(&at, k * sizeof(chain_stretch));
    c->nodes = take(&at, k * sizeof(chain_node));
    c->rows = take(&at, k * sizeof(chain_row));
    c->to_first = take(&at, k * 9 * sizeof(double));
    solver->order = take(&at, k * sizeof(int));
    solver->knot_at = take(&at, n * sizeof(int));
    c->stretch_of[0] = take(&at, n * sizeof(int));
    c->stretch_of[1] = take(&at, n * sizeof(int));
    rows->fixed = take(&at, n);
    limits->held = take(&at, n);
    carve_tables(c, at, (unsigned char *)m->diagonal, n);
}

wiggly_solver *solver_lay_out(void *memory, int samples, int knots)
{
    wiggly_solver *solver = memory;
    solver->samples = samples;
    solver->knots = knots;
    solver->longest_squared = INT_MAX;
    solver->chain.stretch_capacity = knots + 1;
    carve(solver);
    return solver;
}

wiggly_status wiggly_create_at(void *memory, size_t size, int samples, int knots, wiggly_solver **solver)
{
    size_t needed = wiggly_memsize(samples, knots);
    if (!memory || !solver || !needed || (uintptr_t)memory % sizeof(double) != 0) return WIGGLY_ERROR_ARGUMENT;
    if (size < needed) return WIGGLY_ERROR_MEMORY;
    memset(memory, 0, needed);
    *solver = solver_lay_out(memory, samples, knots);
    return WIGGLY_OK;
}

wiggly_status wiggly_create(int samples, int knots, wiggly_solver **solver)
{
    size_t size = wiggly_memsize(samples, knots);
    if (!solver || !size) return WIGGLY_ERROR_ARGUMENT;
    void *memory = calloc(1, size); // pages that a way of solving does not use are never touched
    if (!memory) return WIGGLY_ERROR_MEMORY;
    *solver = solver_lay_out(memory, samples, knots);
    (*solver)->owned = true;
    return WIGGLY_OK;
}

void wiggly_destroy(wiggly_solver *solver)
{
    if (solver && solver->owned) free(solver);
}

/// Over a run the poles may decay unlike each other by so much, and both together by so much: exponents of e.
static const double most_unlike = 5, most_decay = 50;

/// Samples after which the chain takes a state anew.
static int run_of(const poles *at, double step)
{
    double decay = step * fabs(fmin(at->s[0].re, at->s[1].re)), unlike = step * fabs(at->s[0].re - at->s[1].re);
    double run = fmin(most_unlike / unlike, most_decay / decay); // of nothing: infinite
    return run < CHAIN_RUN ? (int)fmax(run, 1) : CHAIN_RUN;
}

const constant_filter *solver_filter(wiggly_solver *solver, const wiggly_desc *desc, double floor)
{
    constant_filter *f = &solver->filter;
    if (f->known && f->floor == floor && desc_same_filter(&f->desc, desc)) return f;
    const poles own = poles_at(desc, 0, floor);
    *f = (constant_filter){.known = true, .desc = desc_settings(desc), .floor = floor, .at = own};
    poles_mean(&f->at, desc->step, &f->lambda, &f->delta2);
    f->run = run_of(&f->at, desc->step);
    poles damped = poles_at(desc, 0, fmax(floor, LEAST_DAMPING));
    f->start = poles_start_cost(&damped, desc->step);
    if (desc->passive != WIGGLY_OSCILLATOR) return f;
    f->unit = exp(-poles_weight_exponent(&f->at, desc->step));
    f->ahead = poles_speed(&f->at, desc->step, false);
    f->passive = cplx_scale(desc->step, poles_passive(&own));
    f->tail = poles_tail(poles_passive(&own), &f->ahead, desc->step);
    if (damped.decay == f->at.decay) return f;
    f->start = poles_start_seen_from(f->start, &damped, &f->at, desc->step);
    double weight = exp(poles_weight_exponent(&damped, desc->step) - poles_weight_exponent(&f->at, desc->step));
    for (int i = 0; i < 2; i++) f->start.row[i].weight *= weight;
    return f;
}

void wiggly_set_method(wiggly_solver *solver, wiggly_method method) { solver->method = method; }

void solver_forget(wiggly_solver *solver)
{
    solver->filter.known = false;
    chain_forget(&solver->chain);
}
