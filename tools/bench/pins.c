/// The benchmark's pins: groups of splines that share points, with one point dragged.
#include "base/need.h"
#include "base/progress.h"
#include "bench/bench.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { GAP = 24, MOST_SPLINES = 8, MOST_PINS = 40, MOST_BOUNDS = 40, RUNS = 2000 };

static const struct {
    const char *name;
    int splines, pins, samples;
    bool moves; ///< the dragged pin also changes its sample, so the last run's results are useless
    int bounds;
} plan[] = {
    {"pins/drag/6x9x240", 6, 9, 240, false, 0},       {"pins/retime/6x9x240", 6, 9, 240, true, 0},
    {"pins/drag/8x40x1000", 8, 40, 1000, false, 0},   {"pins/retime/8x40x1000", 8, 40, 1000, true, 0},
    {"pins/bounds/2x1x240/40", 2, 1, 240, false, 40},
};

struct pinned {
    int splines, pins, bounds, samples;
    wiggly_desc desc[MOST_SPLINES];
    double weight[MOST_SPLINES];
    wiggly_curve curve[MOST_SPLINES];
    wiggly_pull pull[MOST_PINS][MOST_SPLINES];
    wiggly_pin pin[MOST_PINS];
    double seen[MOST_BOUNDS][MOST_SPLINES][2];
    wiggly_bound bound[MOST_BOUNDS];
    wiggly_knot *knots;
    double *numbers;
};

static void describe(struct pinned *p, int s)
{
    wiggly_desc *desc = &p->desc[s];
    const int knots = p->samples / GAP;
    *desc = wiggly_default_desc();
    desc->samples = p->samples;
    desc->frequency.value = 1 + 0.15 * s;
    desc->damping.value = 0.05 + 0.01 * s;
    desc->knots = p->knots + s * knots;
    desc->knot_count = knots;
    for (int k = 0; k < knots; k++)
        p->knots[s * knots + k] = (wiggly_knot){.sample = GAP * k + (5 * s + 7 * k) % 11, .value = sin(s + 2.0 * k)};
    p->weight[s] = 1 + 0.1 * s;
    double *at = p->numbers + (size_t)s * 3 * (size_t)p->samples;
    p->curve[s] =
        (wiggly_curve){.size = sizeof(wiggly_curve), .total = at, .re = at + p->samples, .im = at + 2 * p->samples};
}

static void place(struct pinned *p, int i)
{
    p->pin[i] = (wiggly_pin){.sample = 10 + i * (p->samples - 20) / p->pins,
                             .pulls = p->pull[i],
                             .pull_count = p->splines,
                             .to = {0.3 * sin(i), 0.3 * cos(2.0 * i), 0.2 * sin(3.0 * i)}};
    for (int s = 0; s < p->splines; s++) {
        p->pull[i][s].spline = s;
        for (int k = 0; k < 6; k++) p->pull[i][s].c[k / 2][k % 2] = sin(i + 1.7 * (k + 1) * (s + 2));
    }
}

/// A bound on a point, active in about half of the cases.
static void lay(struct pinned *p, int b)
{
    for (int s = 0; s < p->splines; s++) {
        for (int part = 0; part < 2; part++) p->seen[b][s][part] = sin(3.1 * b + 1.9 * s + part);
    }
    p->bound[b] = (wiggly_bound){
        .sample = 7 + b * (p->samples - 10) / p->bounds, .c = (const double(*)[2])p->seen[b], .least = -0.3};
}

static void open_group(struct pinned *p, int splines, int pins, int samples, int bounds)
{
    *p = (struct pinned){.splines = splines, .pins = pins, .bounds = bounds, .samples = samples};
    p->knots = need_zeroed((size_t)(splines * (samples / GAP)), sizeof *p->knots);
    p->numbers = need_zeroed((size_t)(splines * 3 * samples), sizeof *p->numbers);
    for (int s = 0; s < splines; s++) describe(p, s);
    for (int i = 0; i < pins; i++) place(p, i);
    for (int b = 0; b < bounds; b++) lay(p, b);
}

static double largest_left(const struct pinned *p)
{
    double left = 0;
    for (int i = 0; i < p->pins; i++) {
        for (int axis = 0; axis < 3; axis++) left = fmax(left, fabs(p->pin[i].left[axis]));
    }
    for (int b = 0; b < p->bounds; b++) left = fmax(left, p->bound[b].left);
    return left;
}

static void run_group(struct bench *bench, struct pinned *p, bool moves, struct bench_result *result)
{
    wiggly_group *group = NULL;
    wiggly_status status =
        wiggly_group_create_bounded(p->samples, p->samples / GAP, p->splines, p->pins, p->bounds, &group);
    wiggly_pin *dragged = &p->pin[p->pins / 2];
    const int at = dragged->sample;
    int run = 0;
    for (; run < RUNS && status == WIGGLY_OK; run++) {
        dragged->to[0] = 0.3 * sin(0.1 * run);
        if (moves) dragged->sample = at + run % 3;
        double start = clock_now();
        status = wiggly_group_solve_bounded(group, p->desc, p->weight, p->curve, p->splines, p->pin, p->pins,
                                            p->bound, p->bounds);
        bench->times[run] = clock_now() - start;
    }
    wiggly_group_destroy(group);
    result->splines = p->splines;
    result->error = largest_left(p);
    bench_sum_up(bench, run, (double)p->samples * p->splines, result);
    if (status != WIGGLY_OK || !(result->error < (p->bounds > 0 ? 1e-8 : 1e-9)))
        bench_stop("%s: points are off by %g", result->name, result->error);
}

void bench_pins(struct bench *bench)
{
    for (size_t n = 0; n < sizeof plan / sizeof *plan; n++) {
        struct pinned p;
        struct bench_result result = bench_blank(WIGGLY_COMPLEX, plan[n].samples);
        snprintf(result.name, sizeof result.name, "%s", plan[n].name);
        open_group(&p, plan[n].splines, plan[n].pins, plan[n].samples, plan[n].bounds);
        run_group(bench, &p, plan[n].moves, &result);
        bench_report(bench, &result);
        free(p.knots);
        free(p.numbers);
    }
}
