/// Splines solved together so that points are where they must be, or not below: by the conditions of Karush, Kuhn and Tucker on the
/// textbook's system, which shares no line with the solver, and what is refused. (Exact answers: test_vectors.)
#include "near.h"

#include "curve.h"
#include "textbook.h"

enum { MOST_SPLINES = 8, MOST_PINS = 8, SAMPLES = 240, KNOTS = 8, BOUNDS = 36 };

/// A group with everything it needs.
struct random_group {
    int splines, pins, bounds, samples;
    wiggly_desc descs[MOST_SPLINES];
    wiggly_knot knots[MOST_SPLINES][KNOTS];
    double weights[MOST_SPLINES];
    wiggly_pull pulls[MOST_PINS][MOST_SPLINES];
    wiggly_pin pin[MOST_PINS];
    double c[BOUNDS][MOST_SPLINES][2];
    wiggly_bound bound[BOUNDS];
    double track[SAMPLES], numbers[MOST_SPLINES][5 * SAMPLES];
    wiggly_curve curve[MOST_SPLINES];
    double largest; ///< x, once solved
};

static unsigned seed;

static double uniform(double low, double high)
{
    seed = seed * 1664525 + 1013904223;
    return low + (high - low) * (seed >> 8) / (1 << 24);
}

static int below(int end) { return (int)uniform(0, end) % end; }

static void make_spline(struct random_group *g, int s)
{
    static const wiggly_start starts[] = {WIGGLY_REST, WIGGLY_LOOP, WIGGLY_FREE, WIGGLY_FREE};
    wiggly_desc *desc = &g->descs[s];
    bool taken[SAMPLES] = {false};
    *desc = wiggly_default_desc();
    desc->samples = g->samples;
    desc->mode = below(3) == 0 ? WIGGLY_REAL : WIGGLY_COMPLEX;
    desc->start = starts[below(4)];
    desc->passive = below(4) == 0 ? WIGGLY_FILTER : WIGGLY_OSCILLATOR;
    desc->frequency.value = uniform(0.6, 3);
    desc->damping.value = uniform(0.02, 0.3);
    desc->bandwidth.value = uniform(0, 0.2);
    if (below(3) == 0) desc->equilibrium.track = g->track;
    desc->knots = g->knots[s], desc->knot_count = below(KNOTS);
    for (int k = 0; k < desc->knot_count; k++) {
        int sample = below(g->samples - 1);
        while (taken[sample]) sample = below(g->samples - 1);
        taken[sample] = true;
        wiggly_knot *knot = &g->knots[s][k];
        knot->sample = sample, knot->value = uniform(-1, 1);
        knot->has_slope = below(4) == 0, knot->stiffness = uniform(1, 1000);
    }
    g->weights[s] = uniform(0.5, 2);
}

/// Pins sit on neighbouring frames, on knots and at both sides of a loop's seam more often than chance would have it.
static void make_pin(struct random_group *g, int p)
{
    wiggly_pin *pin = &g->pin[p];
    const wiggly_desc *desc = &g->descs[below(g->splines)];
    int near = p > 0 ? g->pin[p - 1].sample : 0;
    if (desc->knot_count > 0 && below(2)) near = desc->knots[below(desc->knot_count)].sample;
    int sample = below(3) == 0 ? near + below(3) - 1 : below(g->samples);
    if (below(5) == 0) sample = below(2) * g->samples;
    pin->sample = sample < 0 ? 0 : sample >= g->samples - 1 ? g->samples - 2 : sample;
    pin->pulls = g->pulls[p], pin->pull_count = g->splines;
    for (int s = 0; s < g->splines; s++) {
        g->pulls[p][s].spline = s;
        for (int i = 0; i < 6; i++) g->pulls[p][s].c[i / 2][i % 2] = uniform(-1, 1);
    }
    for (int i = 0; i < 3; i++) pin->to[i] = uniform(-1, 1);
}

static struct random_group *make_group(unsigned which, int splines, int pins)
{
    static struct random_group g;
    memset(&g, 0, sizeof g);
    seed = which * 2654435761u + 1;
    g.splines = splines;
    g.pins = pins;
    g.samples = SAMPLES;
    for (int i = 0; i < SAMPLES; i++) g.track[i] = 0.3 * sin(0.05 * i);
    for (int s = 0; s < splines; s++) make_spline(&g, s);
    for (int p = 0; p < pins; p++) make_pin(&g, p);
    return &g;
}

/// One spline with pins on its Re x, so many samples apart.
static struct random_group *make_single(unsigned which, int pins, int from, int apart)
{
    struct random_group *g = make_group(which, 1, pins);
    for (int p = 0; p < pins; p++) {
        g->pin[p].sample = from + apart * p;
        g->pulls[p][0] = (wiggly_pull){.c = {{1, 0}, {0, 0}, {0, 0}}};
    }
    return g;
}

/// By `group`, or (NULL) one of its own.
static wiggly_status solve_in(wiggly_group *group, struct random_group *g, wiggly_method method)
{
    wiggly_group *own = NULL;
    if (!group) {
        assert_int_equal(wiggly_group_create_bounded(g->samples, KNOTS, g->splines, g->pins, g->bounds, &own),
                         WIGGLY_OK);
        wiggly_group_set_method(own, method);
    }
    for (int s = 0; s < g->splines; s++) g->curve[s] = curve_in(g->numbers[s], g->samples);
    const wiggly_status status =
        wiggly_group_solve_bounded(group ? group : own, g->descs, g->weights, g->curve, g->splines, g->pin, g->pins,
                                   g->bounds ? g->bound : NULL, g->bounds);
    wiggly_group_destroy(own);
    g->largest = 0;
    for (int s = 0; s < g->splines; s++) {
        for (int i = 0; i < g->curve[s].samples; i++)
            g->largest = fmax(g->largest, fmax(fabs(g->curve[s].re[i]), fabs(g->curve[s].im[i])));
    }
    return status;
}

static wiggly_status solve_group(struct random_group *g) { return solve_in(NULL, g, WIGGLY_CHAIN); }

/// What the solver of one spline makes of spline s: five times SAMPLES numbers.
static const double *solve_alone(const struct random_group *g, int s, wiggly_status *status)
{
    static double numbers[5 * SAMPLES];
    wiggly_solver *solver;
    wiggly_curve curve = curve_in(numbers, SAMPLES);
    assert_int_equal(wiggly_create(SAMPLES, KNOTS, &solver), WIGGLY_OK);
    *status = wiggly_solve(solver, &g->descs[s], &curve);
    wiggly_destroy(solver);
    return numbers;
}

/// All values as large, or as small, as numbers can hardly be: the same motion in another unit, to the bit.
static void check_scaled(const struct random_group *g, wiggly_group *group, unsigned which)
{
    static struct random_group other;
    const double scale = which % 2 ? 0x1p600 : 0x1p-600;
    bool same = true;
    other = *g;
    for (int s = 0; s < g->splines; s++) {
        other.descs[s].knots = other.knots[s];
        if (g->descs[s].equilibrium.track) other.descs[s].equilibrium.track = other.track;
        for (int k = 0; k < KNOTS; k++) other.knots[s][k].value *= scale, other.knots[s][k].slope *= scale;
    }
    for (int i = 0; i < SAMPLES; i++) other.track[i] *= scale;
    for (int i = 0; i < 3 * g->pins; i++) other.pin[i / 3].to[i % 3] *= scale;
    for (int b = 0; b < g->bounds; b++) other.bound[b].least *= scale;
    assert_int_equal(solve_in(group, &other, WIGGLY_CHAIN), WIGGLY_OK);
    for (int s = 0; s < g->splines; s++) {
        for (int i = 0; i < 4 * g->samples; i++) same = same && other.numbers[s][i] / scale == g->numbers[s][i];
    }
    for (int i = 0; i < 3 * g->pins; i++)
        same = same && other.pin[i / 3].left[i % 3] / scale == g->pin[i / 3].left[i % 3];
    for (int b = 0; b < g->bounds; b++) {
        same = same && other.bound[b].left / scale == g->bound[b].left;
        same = same && other.bound[b].push / scale == g->bound[b].push;
    }
    if (!same) fail_msg("group %u is another one in another unit", which);
}

static const wiggly_knot *knot_at(const struct random_group *g, int s, int sample)
{
    for (int k = 0; k < g->descs[s].knot_count; k++) {
        if (g->knots[s][k].sample == sample) return &g->knots[s][k];
    }
    return NULL;
}

/// Re(c x) of a spline at a sample.
static double reached(const struct random_group *g, int sample, int s, const double c[2])
{
    return c[0] * g->curve[s].re[sample] - c[1] * g->curve[s].im[sample];
}

static void check_knots(const struct random_group *g, double tolerance)
{
    for (int s = 0; s < g->splines; s++) {
        for (int k = 0; k < g->descs[s].knot_count; k++)
            assert_near(g->curve[s].total[g->knots[s][k].sample], g->knots[s][k].value, tolerance);
    }
}

/// The error that a group tells, as a logarithm. The bits are the same everywhere: another mean is another bound, or another search; write it
/// where it is asked for if it is meant.
static double told_by(const struct random_group *g)
{
    double told = 0;
    for (int s = 0; s < g->splines; s++) told = fmax(told, g->curve[s].error);
    return log10(told + 1e-18);
}

static void check_told(double told, double expected)
{
    if (!(fabs(told - expected) < 1e-5)) fail_msg("the mean logarithm of the error told is %.6f", told);
}

static struct textbook book;

/// What pulls on unknown j of the book that was solved last, of a solution x, and the size of what it is the sum of.
static real pull_of(int j, int unknowns, const real *x, real *size)
{
    real pull = book.right[j];
    for (int k = 0; k < unknowns; k++) {
        const real part = textbook_entry(&book, j, k) * x[k];
        pull -= part;
        *size = fmaxq(*size, fabsq(part));
    }
    return pull;
}

// --- pins ------------------------------------------------------------------------------------------------------------

/// Pulls are in any order.
static void turn_pulls(struct random_group *g, int p)
{
    for (int s = 0; s < g->splines / 2; s++) {
        const wiggly_pull first = g->pulls[p][s];
        g->pulls[p][s] = g->pulls[p][g->splines - 1 - s], g->pulls[p][g->splines - 1 - s] = first;
    }
}

static const double (*pull_on(const struct random_group *g, int p, int s))[2]
{
    for (int i = 0; i < g->splines; i++) {
        if (g->pulls[p][i].spline == s) return g->pulls[p][i].c;
    }
    return NULL;
}

static bool moves(const struct random_group *g, int p, int s)
{
    const double(*c)[2] = pull_on(g, p, s);
    bool any = false;
    for (int i = 0; i < 6; i++) any = any || c[i / 2][i % 2] != 0;
    return any;
}

/// Forces along x, y and z of the pins at one sample, by least squares: what pulls on the splines there.
struct forces {
    int count, rows;
    double row[2 * MOST_SPLINES][3 * MOST_PINS], pull[2 * MOST_SPLINES], most;
};

/// The largest part of the pulls that no forces make.
static double rest_of(struct forces *f)
{
    const int n = f->count;
    double rest = 0;
    for (int pass = 0; pass < 2; pass++) { // twice, against rounding
        for (int j = 0; j < n; j++) {      // modified Gram and Schmidt, column by column
            double size = 0;
            for (int r = 0; r < f->rows; r++) size += f->row[r][j] * f->row[r][j];
            for (int k = j + 1; size > 1e-18 && k <= n; k++) {
                double along = 0;
                for (int r = 0; r < f->rows; r++) along += f->row[r][j] * (k < n ? f->row[r][k] : f->pull[r]) / size;
                for (int r = 0; r < f->rows; r++) *(k < n ? &f->row[r][k] : &f->pull[r]) -= along * f->row[r][j];
            }
        }
    }
    for (int r = 0; r < f->rows; r++) rest = fmax(rest, fabs(f->pull[r]));
    return rest;
}

/// A spline of the group, with poses where it is pinned as it was solved: that is the textbook's spline, so nothing else pulls on it. What
/// pulls on it at the pins goes to their forces.
static void check_pinned(const struct random_group *g, int s, struct forces *at)
{
    static double exact[3][SAMPLES];
    wiggly_knot posed[KNOTS + MOST_PINS];
    wiggly_desc desc = g->descs[s];
    const wiggly_curve *curve = &g->curve[s];
    memcpy(posed, g->knots[s], sizeof g->knots[s]);
    desc.knots = posed;
    for (int p = 0; p < g->pins; p++) {
        const int sample = g->pin[p].sample;
        int k = 0;
        if (!moves(g, p, s)) continue;
        while (k < desc.knot_count && posed[k].sample != sample) k++;
        if (k == desc.knot_count)
            posed[desc.knot_count++] = (wiggly_knot){.sample = sample, .value = curve->total[sample]};
        posed[k].has_phase = true, posed[k].phase = curve->im[sample];
    }
    assert_true(textbook_as(&desc, WIGGLY_OK, &book, exact[0], exact[1], exact[2]));
    for (int i = 0; i < g->samples; i++) {
        assert_near(curve->re[i], exact[1][i], 1e-8 * g->largest);
        assert_near(curve->im[i], exact[2][i], 1e-8 * g->largest);
    }
    const int unknowns = 2 * (book.tied ? book.last - book.first + 1 : book.count);
    for (int p = 0; p < g->pins && book.count >= 3; p++) { // shorter domains pass over their pins
        const int sample = g->pin[p].sample;
        for (int part = 0; part < 2 && moves(g, p, s); part++) {
            if (part == 0 ? knot_at(g, s, sample) != NULL : desc.mode != WIGGLY_COMPLEX) continue;
            real size = 0;
            struct forces *f = &at[p];
            f->pull[f->rows] =
                g->weights[s] * (double)pull_of(2 * (sample - book.first) + part, unknowns, book.x, &size);
            f->most = fmax(f->most, g->weights[s] * (double)size);
            f->count = 0;
            for (int q = 0; q < g->pins; q++) {
                for (int i = 0; i < 3 && g->pin[q].sample == sample; i++)
                    f->row[f->rows][f->count++] = (part ? -1 : 1) * pull_on(g, q, s)[i][part];
            }
            f->rows++;
        }
    }
}

/// Random groups, by the chain and by the band: knots are hit, `left` is what is left, and nothing pulls but the pins, along what they hold.
TEST(nothing_pulls_but_the_pins)
{
    int exact = 0, tested = 0;
    double told = 0;
    for (unsigned n = 0; n < 200; n++) {
        static struct forces at[MOST_PINS];
        const int pins = 1 + below(6), splines = 2 + below(4);
        struct random_group *g = make_group(n, splines, pins);
        memset(at, 0, sizeof at);
        for (int p = 0; p < g->pins; p += 2) turn_pulls(g, p);
        if (n % 3 == 2) memset(g->pulls[0][n % 2].c, 0, sizeof g->pulls[0][0].c); // it moves one spline less
        if (solve_in(NULL, g, n % 2 ? WIGGLY_BAND : WIGGLY_CHAIN) != WIGGLY_OK) fail_msg("group %u", n);
        told += told_by(g) / 200;
        check_knots(g, 0);
        for (int s = 0; s < g->splines; s++) check_pinned(g, s, at);
        for (int p = 0; p < g->pins; p++) {
            const wiggly_pin *pin = &g->pin[p];
            double left = 0;
            for (int i = 0; i < 3; i++) {
                double is = 0;
                for (int s = 0; s < g->splines; s++) is += reached(g, pin->sample, s, pull_on(g, p, s)[i]);
                assert_near(pin->left[i], pin->to[i] - is, 1e-7 * g->largest);
                left = fmax(left, fabs(pin->left[i]));
            }
            exact += left < 1e-7 * g->largest;
            tested += at[p].rows > at[p].count;
            const double most = at[p].most, rest = rest_of(&at[p]);
            if (!(rest <= 1e-7 * most)) fail_msg("group %u: %g of %g pulls beside pin %d", n, rest, most, p);
        }
    }
    assert_true(exact > 150 && tested > 150);
    check_told(told, -11.584186);
}

// --- bounds ----------------------------------------------------------------------------------------------------------

/// Two splines with knots 40 samples apart; `missing` of them are left out at the end of the first spline, one less of the second.
static struct random_group *make_bounded(unsigned which, int missing)
{
    struct random_group *g = make_group(which, 2, 0);
    g->samples = 121;
    g->bounds = BOUNDS;
    seed = which * 2654435761u + 5;
    for (int s = 0; s < g->splines; s++) {
        wiggly_desc *desc = &g->descs[s];
        *desc = wiggly_default_desc();
        desc->samples = g->samples;
        desc->frequency.value = uniform(1, 2);
        desc->damping.value = uniform(0.05, 0.25);
        desc->knots = g->knots[s];
        desc->knot_count = missing > s ? 4 - missing + s : 4;
        for (int k = 0; k < 4; k++) g->knots[s][k] = (wiggly_knot){.sample = 40 * k, .value = uniform(-1, 1)};
        g->weights[s] = uniform(0.5, 1.5);
    }
    for (int b = 0; b < BOUNDS; b++) {
        for (int i = 0; i < 2 * g->splines; i++) g->c[b][i / 2][i % 2] = uniform(-1, 1);
        g->bound[b] =
            (wiggly_bound){.sample = 5 + 3 * b, .c = (const double(*)[2])g->c[b], .least = uniform(-0.4, 0.2)};
        if (g->bound[b].sample % 40 == 0) g->bound[b].sample++;
    }
    return g;
}

/// Pushes on a spline, by Re and Im w up to the last knot, and by e behind it.
struct pushes {
    real body[2 * SAMPLES], tail[SAMPLES], most;
};

/// Behind the last knot Im x takes part in what e does at the samples beside, and Im w of the knot in all that is there.
static void add_tail_push(const double c[2], real force, int behind, int count, struct pushes *to)
{
    static real unit[SAMPLES];
    const number turned = 1.0Qi * cexpq(book.at[book.last].p * (behind * book.h));
    to->body[2 * book.last + 1] += force * (c[0] * crealq(turned) - c[1] * cimagq(turned));
    to->tail[behind] += force * c[0];
    for (int i = behind - 1; i <= behind + 1 && i < count; i++) {
        unit[i] = 1;
        to->tail[i] -= force * c[1] * textbook_tail_im(&book, unit, count, behind);
        unit[i] = 0;
    }
}

/// Up to the last knot what pulls on a spline's x is nothing but the bounds' pushes, times c; behind it they are what pulls on e, and Im e
/// is that of a swing.
static void check_pushed(const struct random_group *g, int s)
{
    static struct pushes pushes;
    static real x[2 * SAMPLES];
    double exact[3][SAMPLES];
    const wiggly_curve *curve = &g->curve[s];
    assert_true(textbook_as(&g->descs[s], WIGGLY_OK, &book, exact[0], exact[1], exact[2]));
    const int last = book.last, count = g->samples - last;
    memset(&pushes, 0, sizeof pushes);
    pushes.most = 1;
    for (int b = 0; b < BOUNDS; b++) {
        const double *c = g->c[b][s], force = g->bound[b].push / g->weights[s];
        const int sample = g->bound[b].sample;
        pushes.most = fmaxq(pushes.most, force);
        if (sample > last) {
            add_tail_push(c, force, sample - last, count, &pushes);
        } else {
            pushes.body[2 * sample] += force * c[0];
            pushes.body[2 * sample + 1] -= force * c[1];
        }
    }
    for (int i = 0; i <= last; i++) x[2 * i] = curve->re[i], x[2 * i + 1] = curve->im[i];
    for (int j = 0; j < 2 * (last + 1); j++) {
        real size = pushes.most;
        const real pull = pull_of(j, 2 * (last + 1), x, &size);
        if (j % 2 == 0 && knot_at(g, s, j / 2)) continue;
        assert_near(pull + pushes.body[j], 0, 1e-7 * (double)size);
    }
    const number w = curve->re[last] + 1.0Qi * curve->im[last];
    real e[SAMPLES] = {0}, im[SAMPLES] = {0};
    for (int i = 1; i < count; i++) {
        const number by_itself = w * cexpq(book.at[last].p * (i * book.h));
        e[i] = curve->re[last + i] - crealq(by_itself);
        im[i] = curve->im[last + i] - cimagq(by_itself);
    }
    for (int i = 1; i < count; i++) {
        assert_near(im[i], textbook_tail_im(&book, e, count, i), 1e-7);
        assert_near(textbook_tail_pull(&book, e, count, i) + pushes.tail[i], 0, 1e-7 * (double)pushes.most);
    }
}

/// With all knots, and behind the last ones.
TEST(bounds_alone_push_and_only_where_they_are_touched)
{
    int touched[3] = {0};
    double told = 0;
    wiggly_group *group;
    assert_int_equal(wiggly_group_create_bounded(SAMPLES, KNOTS, 2, 0, BOUNDS, &group), WIGGLY_OK);
    for (unsigned n = 0; n < 64; n++) {
        const int missing = n < 40 ? 0 : n < 52 ? 1 : 2;
        struct random_group *g = make_bounded(n < 40 ? n : (n - 40) % 12, missing);
        assert_int_equal(solve_in(group, g, WIGGLY_CHAIN), WIGGLY_OK);
        for (int b = 0; b < BOUNDS; b++) {
            double above = -g->bound[b].least;
            const int sample = g->bound[b].sample;
            for (int s = 0; s < g->splines; s++) above += reached(g, sample, s, g->c[b][s]);
            assert_true(above > -1e-8 && g->bound[b].push >= 0);
            assert_true(g->bound[b].push == 0 || above < 1e-8);
            assert_near(g->bound[b].left, -above, 1e-12);
            touched[missing] += g->bound[b].push > 0;
        }
        told += told_by(g) / 64;
        check_knots(g, 1e-12);
        for (int s = 0; s < g->splines; s++) check_pushed(g, s);
        check_scaled(g, group, n);
    }
    wiggly_group_destroy(group);
    assert_true(touched[0] > 40 && touched[1] > 12 && touched[2] > 12);
    check_told(told, -11.700839);
}

// --- what a user would miss ------------------------------------------------------------------------------------------

/// A group without pins is its splines, and one that has solved others before gives the same bits as a new one.
TEST(nothing_that_is_kept_changes_a_bit)
{
    static double fresh[MOST_SPLINES][5 * SAMPLES];
    wiggly_group *group;
    wiggly_status status;
    assert_int_equal(wiggly_group_create(SAMPLES, KNOTS, 4, 6, &group), WIGGLY_OK);
    for (unsigned n = 0; n < 20; n++) {
        struct random_group *g = make_group(n, 4, 6);
        assert_int_equal(solve_group(g), WIGGLY_OK);
        memcpy(fresh, g->numbers, sizeof fresh);
        assert_int_equal(solve_in(group, g, WIGGLY_CHAIN), WIGGLY_OK);
        assert_memory_equal(fresh, g->numbers, sizeof fresh);
        check_scaled(g, group, n);
        g->pins = 0;
        assert_int_equal(solve_in(group, g, WIGGLY_CHAIN), WIGGLY_OK);
        for (int s = 0; s < 4; s++) {
            assert_memory_equal(solve_alone(g, s, &status), g->numbers[s], sizeof g->numbers[s]);
            assert_int_equal(status, WIGGLY_OK);
        }
    }
    wiggly_group_destroy(group);
}

/// One spline that moves a point along a line: what is across it cannot be had, and is said.
TEST(what_is_out_of_reach_is_left)
{
    struct random_group *g = make_group(1, 1, 1);
    g->descs[0].mode = WIGGLY_REAL;
    g->pin[0] = (wiggly_pin){.sample = 100, .pulls = g->pulls[0], .pull_count = 1, .to = {0.5, 0.25, 0}};
    g->pulls[0][0] = (wiggly_pull){.c = {{2, 0}, {0, 0}, {0, 0}}};
    assert_int_equal(solve_group(g), WIGGLY_OK);
    assert_near(g->curve[0].re[100], 0.25, 1e-12);
    assert_near(g->pin[0].left[0], 0, 1e-12);
    assert_near(g->pin[0].left[1], 0.25, 0);
}

/// A spline that the pins do not move is to the bit what it is alone, also where they name it and where it is one that could not be
/// pulled.
TEST(who_is_not_pulled_is_as_alone)
{
    for (unsigned n = 0; n < 20; n++) {
        struct random_group *g = make_group(n, 3, 2);
        wiggly_status expected;
        for (int p = 0; p < 2; p++) g->pulls[p][2] = (wiggly_pull){.spline = 2};
        if (n % 2) g->descs[2].calm = 0;
        const double *alone = solve_alone(g, 2, &expected);
        assert_int_equal(solve_group(g), expected);
        assert_memory_equal(g->numbers[2], alone, sizeof g->numbers[2]);
    }
}

/// A pin that is where its point passes in any case changes nothing, whatever the spline's frequency does.
TEST(a_pin_on_the_way_changes_nothing)
{
    static double frequency[SAMPLES];
    for (int i = 0; i < SAMPLES; i++) frequency[i] = 2 + sin(0.03 * i);
    for (unsigned n = 0; n < 12; n++) {
        struct random_group *g = make_group(n, 1, 1);
        wiggly_desc *desc = &g->descs[0];
        wiggly_status status;
        desc->start = (wiggly_start)(n % 3);
        desc->frequency.track = frequency;
        desc->knot_count = 3;
        for (int k = 0; k < 3; k++) g->knots[0][k] = (wiggly_knot){.sample = 40 + 80 * k, .value = k % 2};
        g->pin[0].sample = 70;
        const double *total = solve_alone(g, 0, &status), *re = total + 2 * SAMPLES, *im = total + 3 * SAMPLES;
        assert_int_equal(status, WIGGLY_OK);
        for (int i = 0; i < 3; i++)
            g->pin[0].to[i] = g->pulls[0][0].c[i][0] * re[70] - g->pulls[0][0].c[i][1] * im[70];
        assert_int_equal(solve_group(g), WIGGLY_OK);
        for (int i = 0; i < SAMPLES; i++) assert_near(g->curve[0].total[i], total[i], 1e-8);
    }
}

/// On a filter whose equilibrium moves, two pins that one spline can meet are met.
TEST(pins_on_a_moving_equilibrium_are_met)
{
    for (unsigned n = 0; n < 60; n++) {
        struct random_group *g = make_single(n, 2, 100, 1 + (int)(n % 20));
        wiggly_desc *desc = &g->descs[0];
        desc->passive = WIGGLY_FILTER;
        desc->equilibrium.track = g->track;
        for (int i = 0; i < SAMPLES; i++) g->track[i] = 3 * sin((0.05 + 0.01 * n) * i);
        desc->knot_count = 2;
        g->knots[0][0].sample = 60, g->knots[0][1].sample = 200;
        assert_int_equal(solve_group(g), WIGGLY_OK);
        for (int p = 0; p < 2; p++) assert_near(g->pin[p].left[0], 0, 1e-9 * g->largest);
    }
}

/// Pins on neighbouring frames that hardly anything holds: what the rounds leave of them belongs to the error.
TEST(a_pin_that_is_missed_is_not_called_met)
{
    int missed = 0;
    double told = 0;
    for (unsigned n = 0; n < 200; n++) {
        struct random_group *g = make_single(n, 5, 100, 1);
        wiggly_desc *desc = &g->descs[0];
        desc->calm = 1e-12;
        desc->frequency.value *= 0.01;
        desc->equilibrium.track = NULL;
        desc->knot_count = 1;
        g->knots[0][0].sample = 60;
        const wiggly_status status = solve_group(g);
        double left = 0;
        told += told_by(g) / 200;
        for (int p = 0; p < 5; p++) left = fmax(left, fabs(g->pin[p].left[0]) / g->largest);
        if (left <= 1e-8) continue;
        missed++;
        assert_int_equal(status, WIGGLY_INEXACT);
        if (!(g->curve[0].error >= left))
            fail_msg("group %u: %g is missed, and an error of %g told", n, left, g->curve[0].error);
    }
    assert_true(missed > 0);
    check_told(told, 33.365031);
}

TEST(what_cannot_be_held_is_refused)
{
    static const wiggly_status expected[] = {WIGGLY_ERROR_PIN,      WIGGLY_ERROR_PIN,       WIGGLY_ERROR_PIN,
                                             WIGGLY_ERROR_PIN,      WIGGLY_ERROR_PIN,       WIGGLY_ERROR_NUMBER,
                                             WIGGLY_ERROR_NUMBER,   WIGGLY_ERROR_ARGUMENT,  WIGGLY_ERROR_SIZE,
                                             WIGGLY_ERROR_ARGUMENT, WIGGLY_ERROR_KNOT_TWICE};
    static const wiggly_knot twice[] = {{.sample = 3}, {.sample = 3}};
    for (int i = 0; i < 11; i++) {
        struct random_group *g = make_group(2, 2, 1);
        if (i == 0) g->pin[0].sample = SAMPLES;
        if (i == 1) {
            g->descs[1].start = WIGGLY_LOOP;
            g->descs[1].knot_count = 0;
            g->pin[0].sample = SAMPLES - 1;
        }
        if (i == 2) g->descs[0].mode = WIGGLY_CUBIC;
        if (i == 3) g->descs[0].calm = 0;
        if (i == 4) g->descs[0].frequency.value = 0;
        if (i == 5) g->pin[0].to[1] = NAN;
        if (i == 6) g->weights[0] = 0;
        if (i == 7) g->pulls[0][1].spline = 2;
        if (i == 8) g->descs[1].size = 0;
        if (i == 9) g->descs[1].samples = 0;
        if (i == 10) g->descs[1].knots = twice, g->descs[1].knot_count = 2;
        g->numbers[0][0] = 17;
        assert_int_equal(solve_group(g), expected[i]);
        assert_near(g->numbers[0][0], 17, 0); // nothing is touched
        if (i == 10) assert_int_equal(g->curve[1].knot, 1);
    }
}

/// In a scene of two samples there is nothing to pull; and a spline that is too short to be pulled, if large, keeps no pin from those that
/// can reach it.
TEST(splines_too_short_are_passed_over)
{
    struct random_group *g = make_group(3, 2, 1);
    g->samples = 2;
    g->pin[0].sample = 1;
    for (int s = 0; s < 2; s++)
        g->descs[s].samples = 2, g->descs[s].knot_count = 0, g->descs[s].equilibrium.track = NULL;
    assert_int_equal(solve_group(g), WIGGLY_OK);
    for (int i = 0; i < 3; i++) assert_near(g->pin[0].left[i], g->pin[0].to[i], 0);
    g = make_group(3, 2, 1);
    for (int s = 0; s < 2; s++) {
        g->descs[s].start = WIGGLY_FREE;
        g->descs[s].mode = WIGGLY_REAL;
        g->descs[s].equilibrium.track = NULL;
    }
    g->descs[0].samples = 2;
    g->descs[0].knot_count = 0;
    g->pin[0] = (wiggly_pin){.sample = 1, .pulls = g->pulls[0], .pull_count = 2, .to = {0, 0.5, 0}};
    g->pulls[0][0] = (wiggly_pull){.spline = 0, .c = {{1, 0}}};
    g->pulls[0][1] = (wiggly_pull){.spline = 1, .c = {{0, 0}, {1e-3, 0}}};
    assert_int_equal(solve_group(g), WIGGLY_OK);
    assert_near(g->pin[0].left[1], 0, 1e-9);
}
