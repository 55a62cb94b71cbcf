/// A solver's memory: one block with a fixed layout.
#include "spline/solver.h"
#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

void *arena_take(arena *a, size_t count, size_t size)
{
    enum { ALIGNMENT = 16 };
    size_t bytes, end;
    if (__builtin_mul_overflow(count, size, &bytes) || __builtin_add_overflow(bytes, ALIGNMENT - 1, &bytes) ||
        __builtin_add_overflow(a->used, bytes & ~(size_t)(ALIGNMENT - 1), &end)) {
        a->too_large = true;
        return NULL;
    }
    void *at = a->block ? a->block + a->used : NULL;
    a->used = end;
    return at;
}

enum { LINE = 64, POWER_COLUMNS = 8 }; ///< LINE: size of a cache line, to which columns are aligned

static wiggly_solver *lay_out(arena *a, int samples, int knots)
{
    wiggly_solver measured = {0}, *solver = arena_take(a, 1, sizeof *solver), *at = solver ? solver : &measured;
    const size_t n = (size_t)samples, k = (size_t)knots + 1;
    system_rows *rows = &at->rows;
    band_matrix *m = &at->band;
    limit_memory *l = &at->limits;
    forced_response *u = &at->response;
    chain *c = &at->chain;
    at->samples = samples;
    at->knots = knots;
    at->longest_squared = INT_MAX;

    // The factor comes first: the chain's tables share its memory, and are larger for few samples.
    m->record = arena_take(a, n, BAND_RECORD * sizeof(double));
    m->seam = arena_take(a, n, BAND_SEAM * sizeof(double));
    arena_take(a, POWER_COLUMNS + 1, LINE); // the chain's columns begin on lines
    unsigned char *column = (unsigned char *)m->record;
    chain_powers *t = &c->powers;
    double **const powers[POWER_COLUMNS] = {&t->p_re,   &t->p_im,   &t->q_re, &t->q_im,
                                            &t->w01_re, &t->w01_im, &t->w00,  &t->w11};
    for (int i = 0; i < POWER_COLUMNS && column; i++) {
        column += (LINE - (uintptr_t)column % LINE) % LINE;
        *powers[i] = (double *)(void *)column;
        column += n * sizeof(double);
    }

    // A loop's response to a moving equilibrium is found before all that is in these last arrays: they have its room.
    double **const single[] = {&m->d,         &m->e_re,          &m->e_im,    &m->f_re,    &m->f_im,
                               &rows->m_re,   &rows->m_im,       &rows->p_re, &rows->p_im, &rows->loss_m,
                               &rows->loss_p, &rows->jet_weight, &at->y,      &at->re,     &at->im,
                               &at->offset,   &u->total,         &u->im,      &u->speed};
    double **const last[] = {&rows->im_weight, &l->pull,      &l->spare,     &l->free[0],
                             &l->free[1],      &l->pushed[0], &l->pushed[1], &l->stiffness};
    double **const pairs[] = {&rows->x, &rows->gradient, &rows->jet, &l->by_push};
    m->spread = arena_take(a, n, 2 * sizeof(double));
    for (size_t i = 0; i < sizeof single / sizeof *single; i++) *single[i] = arena_take(a, n, sizeof(double));
    for (size_t i = 0; i < sizeof last / sizeof *last; i++) *last[i] = arena_take(a, n, sizeof(double));
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) *pairs[i] = arena_take(a, n, 2 * sizeof(double));
    l->search = arena_take(a, n, 4 * sizeof(double));
    u->room = rows->im_weight;

    rows->rest = arena_take(a, n, sizeof *rows->rest);
    m->own = arena_take(a, n, sizeof *m->own);
    m->kept_own = arena_take(a, n, sizeof *m->kept_own);
    m->kept_marks = arena_take(a, n, sizeof *m->kept_marks);
    rows->drive = arena_take(a, n, sizeof *rows->drive);
    rows->slopes = arena_take(a, k, sizeof *rows->slopes);
    rows->fixed = arena_take(a, n, sizeof *rows->fixed);
    c->stretches = arena_take(a, k, sizeof *c->stretches);
    c->nodes = arena_take(a, k, sizeof *c->nodes);
    c->rows = arena_take(a, k, sizeof *c->rows);
    l->own = arena_take(a, k, sizeof *l->own);
    l->all = arena_take(a, k, sizeof *l->all);
    l->held = arena_take(a, n, sizeof *l->held);
    at->wind.gap = arena_take(a, k, sizeof *at->wind.gap);
    at->wind.push = arena_take(a, n, sizeof *at->wind.push);
    at->filled = arena_take(a, k, sizeof *at->filled);
    at->scaled = arena_take(a, k, sizeof *at->scaled);
    at->order = arena_take(a, k, sizeof *at->order);
    at->knot_at = arena_take(a, n, sizeof *at->knot_at);
    return solver;
}

size_t wiggly_memsize(int samples, int knots)
{
    arena size = {0};
    if (samples < 1 || knots < 0) return 0;
    lay_out(&size, samples, knots);
    return size.too_large ? 0 : size.used;
}

wiggly_solver *solver_lay_out(void *memory, int samples, int knots)
{
    arena a = {.block = memory};
    return lay_out(&a, samples, knots);
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
    void *memory = calloc(1, size); // pages that the method does not use are never touched
    if (!memory) return WIGGLY_ERROR_MEMORY;
    *solver = solver_lay_out(memory, samples, knots);
    (*solver)->owned = true;
    return WIGGLY_OK;
}

void wiggly_destroy(wiggly_solver *solver)
{
    if (solver && solver->owned) free(solver);
}

void wiggly_set_method(wiggly_solver *solver, wiggly_method method) { solver->method = method; }
