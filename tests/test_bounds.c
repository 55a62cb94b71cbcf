/// Bounds of a group, by the conditions of Karush, Kuhn and Tucker on the textbook's dense system, which shares no line with the solver.
#include "near.h"

#include "textbook.h"
#include <string.h>

enum { SAMPLES = 121, SPLINES = 2, KNOTS = 4, BOUNDS = 36, GROUPS = 40 };

static struct textbook book;
static unsigned seed;

static double uniform(void)
{
    seed = seed * 1664525U + 1013904223U;
    return (seed >> 8) / 16777216.0;
}

struct random_group {
    wiggly_knot knots[SPLINES][KNOTS];
    wiggly_desc desc[SPLINES];
    double weight[SPLINES];
    double total[SPLINES][SAMPLES], re[SPLINES][SAMPLES], im[SPLINES][SAMPLES];
    wiggly_curve curve[SPLINES];
    double c[BOUNDS][SPLINES][2];
    wiggly_bound bound[BOUNDS];
};

static void make_group(struct random_group *g, unsigned which)
{
    seed = which * 2654435761U + 5;
    for (int s = 0; s < SPLINES; s++) {
        wiggly_desc *desc = &g->desc[s];
        *desc = wiggly_default_desc();
        desc->samples = SAMPLES;
        desc->frequency.value = 1 + uniform();
        desc->damping.value = 0.05 + 0.2 * uniform();
        desc->knots = g->knots[s];
        desc->knot_count = KNOTS;
        for (int k = 0; k < KNOTS; k++) g->knots[s][k] = (wiggly_knot){.sample = 40 * k, .value = 2 * uniform() - 1};
        g->weight[s] = 0.5 + uniform();
        g->curve[s] = (wiggly_curve){.total = g->total[s], .re = g->re[s], .im = g->im[s]};
    }
    for (int b = 0; b < BOUNDS; b++) {
        for (int i = 0; i < 2 * SPLINES; i++) g->c[b][i / 2][i % 2] = 2 * uniform() - 1;
        g->bound[b] =
            (wiggly_bound){.sample = 5 + 3 * b, .c = (const double(*)[2])g->c[b], .least = 0.6 * uniform() - 0.4};
        if (g->bound[b].sample % 40 == 0) g->bound[b].sample++;
    }
}

static double height(const struct random_group *g, int b)
{
    double sum = 0;
    const int sample = g->bound[b].sample;
    for (int s = 0; s < SPLINES; s++) sum += g->c[b][s][0] * g->re[s][sample] - g->c[b][s][1] * g->im[s][sample];
    return sum;
}

/// What pulls on a spline's x is nothing but the bounds' pushes, times c.
static void check_pulls(const struct random_group *g, int s)
{
    static real x[2 * SAMPLES];
    double total[SAMPLES], re[SAMPLES], im[SAMPLES], pushed[2 * SAMPLES] = {0}, most = 0;
    assert_true(textbook_as(&g->desc[s], WIGGLY_OK, &book, total, re, im));
    const int last = book.last;
    for (int i = 0; i <= last; i++) x[2 * i] = g->re[s][i], x[2 * i + 1] = g->im[s][i];
    for (int b = 0; b < BOUNDS; b++) {
        for (int part = 0; part < 2; part++)
            pushed[2 * g->bound[b].sample + part] +=
                g->bound[b].push * g->c[b][s][part] * (part ? -1 : 1) / g->weight[s];
        most = fmax(most, g->bound[b].push);
    }
    for (int j = 0; j < 2 * last; j++) {
        real pull = book.right[j], size = 1 + most;
        for (int k = 0; k < 2 * (last + 1); k++) {
            pull -= book.matrix[j][k] * x[k];
            size = fmaxq(size, fabsq(book.matrix[j][k] * x[k]));
        }
        if (j % 2 == 0 && (j / 2) % 40 == 0) continue; // a knot
        assert_near(pull + pushed[j], 0, 1e-7 * (double)size);
    }
}

static void pushes_alone_pull_and_only_where_they_touch(void **state)
{
    static struct random_group g;
    int touched = 0;
    wiggly_group *group;
    (void)state;
    assert_int_equal(wiggly_group_create_bounded(SAMPLES, KNOTS, SPLINES, 0, BOUNDS, &group), WIGGLY_OK);
    for (unsigned n = 0; n < GROUPS; n++) {
        make_group(&g, n);
        assert_int_equal(
            wiggly_group_solve_bounded(group, g.desc, g.weight, g.curve, SPLINES, NULL, 0, g.bound, BOUNDS),
            WIGGLY_OK);
        for (int b = 0; b < BOUNDS; b++) {
            const double above = height(&g, b) - g.bound[b].least;
            assert_true(above > -1e-8 && g.bound[b].push >= 0);
            assert_true(g.bound[b].push == 0 || above < 1e-8);
            assert_near(g.bound[b].left, -above, 1e-12);
            touched += g.bound[b].push > 0;
        }
        for (int s = 0; s < SPLINES; s++) {
            for (int k = 0; k < KNOTS; k++) assert_near(g.total[s][g.knots[s][k].sample], g.knots[s][k].value, 1e-12);
            check_pulls(&g, s);
        }
    }
    assert_true(touched > GROUPS);
    wiggly_group_destroy(group);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pushes_alone_pull_and_only_where_they_touch)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
