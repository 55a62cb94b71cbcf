/// The memory of a group of splines that share pins: one block, with a solver for each spline.
#include "spline/pin_group.h"
#include <limits.h>
#include <stdlib.h>

static void lay_out_spline(pulled *of, arena *a, int places, int pressed)
{
    const size_t count = (size_t)places;
    pulled p = {.pulls = {.sample = arena_take(a, count, sizeof(int)), .pull = arena_take(a, count, sizeof(cplx))},
                .e = arena_take(a, (size_t)pressed, sizeof(double))};
    if (of) *of = p;
}

static void lay_out_bounds(struct wiggly_group *at, arena *a, size_t rows, size_t samples)
{
    at->want = arena_take(a, rows, sizeof(double));
    const size_t bounds = (size_t)at->bounds;
    at->reduced = arena_take(a, rows, rows * sizeof(double));
    at->square = arena_take(a, bounds, bounds * sizeof(double));
    at->root = arena_take(a, bounds, sizeof(double));
    at->scale = arena_take(a, bounds, sizeof(double));
    at->product = arena_take(a, bounds, sizeof(double));
    at->pressing = arena_take(a, bounds, sizeof(int));
    at->presses = arena_take(a, bounds, sizeof(bool));
    one_sided_limit *limit = &at->search.limit[0];
    double **const of_search[] = {&at->search.value, &at->search.is_open, &at->search.move, &at->search.lack,
                                  &limit->gap,       &limit->push,        &limit->by_gap,   &limit->by_push};
    for (size_t i = 0; i < sizeof of_search / sizeof *of_search; i++)
        *of_search[i] = arena_take(a, bounds, sizeof(double));
    at->tail_rows = arena_take(a, rows, sizeof(tail_row));
    at->e = arena_take(a, samples, sizeof(double));
    at->pressed = arena_take(a, samples, sizeof(double));
}

static struct wiggly_group *lay_out(arena *a, const struct wiggly_group *capacity, int samples)
{
    const int splines = capacity->splines, pins = capacity->pins;
    const size_t s = (size_t)splines, p = (size_t)capacity->places;
    const size_t rows = 3 * (size_t)pins + (size_t)capacity->bounds;
    struct wiggly_group measured = *capacity;
    struct wiggly_group *g = arena_take(a, 1, sizeof *g), *at = g ? g : &measured;
    *at = measured;
    at->pulled = arena_take(a, s, sizeof(pulled));
    for (int i = 0; i < splines; i++)
        lay_out_spline(at->pulled ? &at->pulled[i] : NULL, a, capacity->places, capacity->bounds > 0 ? samples : 0);
    at->rows.row = arena_take(a, rows, sizeof(pin_row));
    at->rows.on = arena_take(a, rows, 2 * s * sizeof(double));
    at->rows.scratch = arena_take(a, pin_rows_scratch(splines, pins > 0 ? pins : 1), sizeof(double));
    at->order = arena_take(a, (size_t)pins, sizeof(int));
    at->pull_of = arena_take(a, rows, sizeof(int));
    at->compliance = arena_take(a, 2 * p, 2 * p * sizeof(double));
    at->alone = arena_take(a, 2 * p, sizeof(double));
    at->answer = arena_take(a, 2 * p, rows * sizeof(double));
    at->system = arena_take(a, rows, rows * sizeof(double));
    at->soft = arena_take(a, rows, sizeof(double));
    at->lambda = arena_take(a, rows, sizeof(double));
    at->miss = arena_take(a, rows, sizeof(double));
    if (capacity->bounds > 0) lay_out_bounds(at, a, rows, (size_t)samples);
    return g;
}

wiggly_status wiggly_group_create(int samples, int knots, int splines, int pins, wiggly_group **group)
{
    return wiggly_group_create_bounded(samples, knots, splines, pins, 0, group);
}

wiggly_status wiggly_group_create_bounded(int samples, int knots, int splines, int pins, int bounds,
                                          wiggly_group **group)
{
    if (!group || samples < 1 || knots < 0 || splines < 1 || pins < 0 || bounds < 0 || pins > WIGGLY_MOST_PINS ||
        bounds > WIGGLY_MOST_PINS || knots > INT_MAX - pins - bounds)
        return WIGGLY_ERROR_ARGUMENT;
    const struct wiggly_group capacity = {.splines = splines,
                                          .pins = pins,
                                          .knots = knots,
                                          .bounds = bounds,
                                          .places = pins + (bounds < samples ? bounds : samples)};
    arena size = {0};
    lay_out(&size, &capacity, samples);
    if (size.too_large) return WIGGLY_ERROR_MEMORY;
    arena a = {.block = calloc(1, size.used)};
    if (!a.block) return WIGGLY_ERROR_MEMORY;
    *group = lay_out(&a, &capacity, samples);
    for (int s = 0; s < splines; s++) {
        wiggly_status status = wiggly_create(samples, knots + capacity.places, &(*group)->pulled[s].solver);
        if (status == WIGGLY_OK) continue;
        wiggly_group_destroy(*group);
        *group = NULL;
        return status;
    }
    return WIGGLY_OK;
}

void wiggly_group_destroy(wiggly_group *g)
{
    for (int s = 0; g && s < g->splines; s++) wiggly_destroy(g->pulled[s].solver);
    free(g);
}

void wiggly_group_set_method(wiggly_group *g, wiggly_method method)
{
    for (int s = 0; s < g->splines; s++) wiggly_set_method(g->pulled[s].solver, method);
}
