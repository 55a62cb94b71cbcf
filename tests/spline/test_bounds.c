/// Bounds of a group, by the conditions of Karush, Kuhn and Tucker on the textbook's system, which shares no line with the solver.
#include "near.h"

#include "textbook.h"

enum { SAMPLES = 121, SPLINES = 2, KNOTS = 4, BOUNDS = 36 };

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

/// Knots are 40 samples apart; `missing` of them are left out at the end of the first spline, one less of the second.
static void make_group(struct random_group *g, unsigned which, int missing)
{
    seed = which * 2654435761U + 5;
    for (int s = 0; s < SPLINES; s++) {
        wiggly_desc *desc = &g->desc[s];
        *desc = wiggly_default_desc();
        desc->samples = SAMPLES;
        desc->frequency.value = 1 + uniform();
        desc->damping.value = 0.05 + 0.2 * uniform();
        desc->knots = g->knots[s];
        desc->knot_count = missing > s ? KNOTS - missing + s : KNOTS;
        for (int k = 0; k < KNOTS; k++) g->knots[s][k] = (wiggly_knot){.sample = 40 * k, .value = 2 * uniform() - 1};
        g->weight[s] = 0.5 + uniform();
        g->curve[s] =
            (wiggly_curve){.size = sizeof(wiggly_curve), .total = g->total[s], .re = g->re[s], .im = g->im[s]};
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

/// Pushes on a spline, by Re and Im w up to the last knot, and by e behind it.
struct pushes {
    real body[2 * SAMPLES], tail[SAMPLES], most;
};

/// Behind the last knot Im x takes part in what e does at the samples beside, and Im w of the knot in all that is there.
static void add_tail_push(const double c[2], real force, int behind, struct pushes *to)
{
    static real unit[SAMPLES];
    const int count = SAMPLES - book.last;
    const number turned = 1.0Qi * cexpq(book.at[book.last].p * (behind * book.h));
    to->body[2 * book.last + 1] += force * (c[0] * crealq(turned) - c[1] * cimagq(turned));
    to->tail[behind] += force * c[0];
    for (int i = behind - 1; i <= behind + 1 && i < count; i++) {
        unit[i] = 1;
        to->tail[i] -= force * c[1] * textbook_tail_im(&book, unit, count, behind);
        unit[i] = 0;
    }
}

static struct pushes find_pushes(const struct random_group *g, int s)
{
    struct pushes all = {.most = 1};
    for (int b = 0; b < BOUNDS; b++) {
        const double *c = g->c[b][s], force = g->bound[b].push / g->weight[s];
        const int sample = g->bound[b].sample;
        all.most = fmaxq(all.most, force);
        if (sample > book.last) {
            add_tail_push(c, force, sample - book.last, &all);
        } else {
            all.body[2 * sample] += force * c[0];
            all.body[2 * sample + 1] -= force * c[1];
        }
    }
    return all;
}

/// Up to the last knot what pulls on a spline's x is nothing but the bounds' pushes, times c.
static void check_body(const struct random_group *g, int s, const struct pushes *pushes)
{
    static real x[2 * SAMPLES];
    const int last = book.last;
    for (int i = 0; i <= last; i++) x[2 * i] = g->re[s][i], x[2 * i + 1] = g->im[s][i];
    for (int j = 0; j < 2 * (last + 1); j++) {
        real pull = book.right[j], size = pushes->most;
        for (int k = 0; k < 2 * (last + 1); k++) {
            pull -= textbook_entry(&book, j, k) * x[k];
            size = fmaxq(size, fabsq(textbook_entry(&book, j, k) * x[k]));
        }
        if (j % 2 == 0 && (j / 2) % 40 == 0) continue; // a knot
        assert_near(pull + pushes->body[j], 0, 1e-7 * (double)size);
    }
}

/// Behind it they are what pulls on e, and Im e is that of a swing.
static void check_tail(const struct random_group *g, int s, const struct pushes *pushes)
{
    const int last = book.last, count = SAMPLES - last;
    const number w = g->re[s][last] + 1.0Qi * g->im[s][last];
    real e[SAMPLES] = {0}, im[SAMPLES] = {0};
    for (int i = 1; i < count; i++) {
        const number by_itself = w * cexpq(book.at[last].p * (i * book.h));
        e[i] = g->re[s][last + i] - crealq(by_itself);
        im[i] = g->im[s][last + i] - cimagq(by_itself);
    }
    for (int i = 1; i < count; i++) {
        assert_near(im[i], textbook_tail_im(&book, e, count, i), 1e-7);
        assert_near(textbook_tail_pull(&book, e, count, i) + pushes->tail[i], 0, 1e-7 * (double)pushes->most);
    }
}

static void check_pulls(const struct random_group *g, int s)
{
    double total[SAMPLES], re[SAMPLES], im[SAMPLES];
    assert_true(textbook_as(&g->desc[s], WIGGLY_OK, &book, total, re, im));
    const struct pushes pushes = find_pushes(g, s);
    check_body(g, s, &pushes);
    check_tail(g, s, &pushes);
}

/// How many bounds are touched.
static int check_bounds(const struct random_group *g)
{
    int touched = 0;
    for (int b = 0; b < BOUNDS; b++) {
        const double above = height(g, b) - g->bound[b].least;
        assert_true(above > -1e-8 && g->bound[b].push >= 0);
        assert_true(g->bound[b].push == 0 || above < 1e-8);
        assert_near(g->bound[b].left, -above, 1e-12);
        touched += g->bound[b].push > 0;
    }
    return touched;
}

static void check_groups(unsigned groups, int missing)
{
    static struct random_group g;
    int touched = 0;
    wiggly_group *group;
    assert_int_equal(wiggly_group_create_bounded(SAMPLES, KNOTS, SPLINES, 0, BOUNDS, &group), WIGGLY_OK);
    for (unsigned n = 0; n < groups; n++) {
        make_group(&g, n, missing);
        assert_int_equal(
            wiggly_group_solve_bounded(group, g.desc, g.weight, g.curve, SPLINES, NULL, 0, g.bound, BOUNDS),
            WIGGLY_OK);
        touched += check_bounds(&g);
        for (int s = 0; s < SPLINES; s++) {
            for (int k = 0; k < g.desc[s].knot_count; k++)
                assert_near(g.total[s][g.knots[s][k].sample], g.knots[s][k].value, 1e-12);
            check_pulls(&g, s);
        }
    }
    assert_true(touched > (int)groups);
    wiggly_group_destroy(group);
}

TEST(pushes_alone_pull_and_only_where_they_touch) { check_groups(40, 0); }

TEST(so_they_do_behind_the_last_knot)
{
    check_groups(12, 1);
    check_groups(12, 2);
}
