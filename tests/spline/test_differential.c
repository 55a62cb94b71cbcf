/// The solver against a textbook one (quadruple precision) and against LAPACKE on the same systems: every knot pattern of
/// small domains, and seeded random ones up to 40 samples, in every mode, start and kind of parameter.
#include "near.h"

#include "curve.h"
#include "spline/solver.h"
#include "textbook.h"
#include "uniform.h"
#include <lapacke.h>

enum { MAX = 40 };

/// The usual one, and that of long domains, which does without squaring.
enum { FACTORISATIONS = 2 };
static wiggly_solver *solvers[FACTORISATIONS];

static int pick(uint64_t *seed, int count) { return (int)(uniform(seed) * count); }

/// A description with its storage.
struct example {
    wiggly_desc desc;
    wiggly_knot knots[MAX];
    double tracks[4][MAX];
};

static wiggly_param some_param(struct example *e, uint64_t *seed, int slot, double low, double high)
{
    wiggly_param param = {.value = low + (high - low) * uniform(seed)};
    if (pick(seed, 4) > 0) return param;
    double from = param.value, to = low + (high - low) * uniform(seed);
    for (int i = 0; i < e->desc.samples; i++) {
        double s = e->desc.samples > 1 ? (double)i / (e->desc.samples - 1) : 0;
        e->tracks[slot][i] = from + (to - from) * s * s * (3 - 2 * s);
    }
    if (e->desc.start == WIGGLY_LOOP) e->tracks[slot][e->desc.samples - 1] = e->tracks[slot][0];
    param.track = e->tracks[slot];
    return param;
}

/// Knots on the samples of `pattern`, everything else at random.
static void make_example(struct example *e, uint64_t *seed, int samples, uint64_t pattern, wiggly_mode mode,
                         wiggly_start start)
{
    memset(e, 0, sizeof *e);
    e->desc = wiggly_default_desc();
    e->desc.samples = samples;
    e->desc.mode = mode;
    e->desc.start = start;
    e->desc.passive = pick(seed, 2) ? WIGGLY_FILTER : WIGGLY_OSCILLATOR;
    e->desc.knots = e->knots;
    e->desc.step = pick(seed, 2) ? 1.0 / 24 : 1.0 / 240;
    e->desc.calm = (double[]){1, 0.3, 0.05}[pick(seed, 3)];
    e->desc.frequency = some_param(e, seed, 0, 0.3, 4);
    e->desc.damping = some_param(e, seed, 1, 0.02, mode == WIGGLY_REAL ? 1.6 : 1.2);
    e->desc.bandwidth = some_param(e, seed, 2, 0, 0.4);
    if (pick(seed, 3) == 0) e->desc.equilibrium = some_param(e, seed, 3, -1, 1);
    if (mode == WIGGLY_REAL && pick(seed, 4) == 0) {
        const double k = 400 * uniform(seed), gamma = 8 * uniform(seed);
        e->desc.frequency.track = e->desc.damping.track = NULL;
        wiggly_from_spring(k, gamma, &e->desc.frequency.value, &e->desc.damping.value);
    }
    for (int i = 0; i < samples - (start == WIGGLY_LOOP ? 1 : 0); i++) {
        if (!(pattern >> i & 1)) continue;
        e->knots[e->desc.knot_count++] = (wiggly_knot){
            .sample = i,
            .value = 2 * uniform(seed) - 1,
            .has_slope = pick(seed, 3) == 0,
            .slope = 4 * uniform(seed) - 2,
            .stiffness = (double[]){1000, 1, 1e6}[pick(seed, 3)],
        };
    }
}

/// Whether the textbook has an answer of its own: enough samples, and something to solve.
static bool is_solvable(const wiggly_desc *d)
{
    if (d->knot_count == 0) return false;
    int earliest = d->samples;
    for (int k = 0; k < d->knot_count; k++) earliest = d->knots[k].sample < earliest ? d->knots[k].sample : earliest;
    int m = d->start == WIGGLY_LOOP ? d->samples - 1 : d->start == WIGGLY_FREE ? d->samples - earliest : d->samples;
    return m >= 3 && (d->start != WIGGLY_REST || earliest > 1);
}

static double largest_difference(const wiggly_curve *exact, const wiggly_curve *curve, double *size)
{
    double worst = 0;
    *size = 0;
    for (int i = 0; i < curve->samples; i++) {
        worst = fmax(worst, fabs(exact->total[i] - curve->total[i]));
        worst = fmax(worst, fabs(exact->re[i] - curve->re[i]));
        worst = fmax(worst, fabs(exact->im[i] - curve->im[i]));
        *size = fmax(*size, fmax(fabs(curve->total[i]), hypot(curve->re[i], curve->im[i])));
    }
    return worst;
}

/// The textbook's matrix by LAPACKE's banded Cholesky, in double; x into the book.
static void solve_with_lapack(struct textbook *book)
{
    enum { KD = 5 };
    static double band[2 * MAX][KD + 1], right[2 * MAX];
    int map[2 * MAX], n = 0;
    for (int i = 0; i < 2 * book->count; i++) {
        if (book->used[i] && !book->fixed[i]) map[n++] = i;
    }
    memset(band, 0, sizeof band);
    for (int j = 0; j < n; j++) {
        right[j] = (double)book->right[map[j]];
        for (int i = 0; i < 2 * book->count; i++) {
            if (book->fixed[i]) right[j] -= (double)(textbook_entry(book, map[j], i) * book->x[i]);
        }
        for (int i = j; i < n && i <= j + KD; i++) band[j][i - j] = (double)textbook_entry(book, map[i], map[j]);
    }
    assert_int_equal(LAPACKE_dpbsv(LAPACK_COL_MAJOR, 'L', n, KD, 1, &band[0][0], KD + 1, right, 2 * MAX), 0);
    for (int i = 0; i < n; i++) book->x[map[i]] = right[i];
}

struct tally {
    int solved, lapack;
};

static void compare_one(wiggly_solver *solver, const struct example *e, uint64_t seed, const wiggly_curve *exact)
{
    wiggly_curve curve = curve_create(MAX);
    const wiggly_status status = wiggly_solve(solver, &e->desc, &curve);
    double size, worst = largest_difference(exact, &curve, &size);
    if (status != WIGGLY_OK || !(worst <= 1e-9 * size)) {
        fail_msg("seed %llu, %d samples, mode %d, start %d, %d knots, squared up to %d: status %d, off by %g of %g",
                 (unsigned long long)seed, e->desc.samples, e->desc.mode, e->desc.start, e->desc.knot_count,
                 solver->longest_squared, status, worst, size);
    }
    curve_destroy(&curve);
}

/// Each textbook answer, which takes most of the time, is compared with every solver.
static void compare(const struct example *e, uint64_t seed, struct tally *tally)
{
    static struct textbook book;
    wiggly_curve exact = curve_create(MAX), lapack = curve_create(MAX);
    if (textbook_as(&e->desc, WIGGLY_OK, &book, exact.total, exact.re, exact.im) && book.pivot > 1e-13) {
        for (int f = 0; f < FACTORISATIONS; f++) compare_one(solvers[f], e, seed, &exact);
        tally->solved++;
        if (e->desc.start != WIGGLY_LOOP) {
            solve_with_lapack(&book);
            textbook_fill(&book, lapack.total, lapack.re, lapack.im);
            double size, worst = largest_difference(&lapack, &exact, &size);
            if (!(worst <= 1e-5 * size))
                fail_msg("seed %llu: LAPACKE off by %g of %g", (unsigned long long)seed, worst, size);
            tally->lapack++;
        }
    }
    curve_destroy(&lapack);
    curve_destroy(&exact);
}

TEST(every_pattern_to_10_samples)
{
    struct tally tally = {0};
    uint64_t seed = 1;
    for (int samples = 1; samples <= quick_or_all(8, 10); samples++) {
        for (uint64_t pattern = 0; pattern < 1u << samples; pattern++) {
            for (int kind = 0; kind < 9; kind++) {
                struct example e;
                uint64_t before = seed;
                make_example(&e, &seed, samples, pattern, (wiggly_mode)(kind % 3), (wiggly_start)(kind / 3));
                if (is_solvable(&e.desc)) compare(&e, before, &tally);
            }
        }
    }
    assert_true(tally.solved > quick_or_all(3000, 13000) && tally.lapack > quick_or_all(1500, 7000));
}

TEST(random_patterns_to_40_samples)
{
    struct tally tally = {0};
    uint64_t seed = 2;
    for (int samples = 11; samples <= MAX; samples++) {
        for (int n = 0; n < quick_or_all(100, 500); n++) {
            struct example e;
            uint64_t before = seed, pattern = 0;
            double density = uniform(&seed);
            for (int i = 0; i < samples; i++) pattern |= (uint64_t)(uniform(&seed) < density * density) << i;
            wiggly_mode mode = (wiggly_mode)pick(&seed, 3);
            make_example(&e, &seed, samples, pattern, mode, (wiggly_start)pick(&seed, 3));
            if (is_solvable(&e.desc)) compare(&e, before, &tally);
        }
    }
    assert_true(tally.solved > quick_or_all(1900, 9500) && tally.lapack > quick_or_all(1100, 5500));
}

static int create(void **state)
{
    (void)state;
    for (int f = 0; f < FACTORISATIONS; f++) {
        if (wiggly_create(MAX, MAX, &solvers[f]) != WIGGLY_OK) return -1;
    }
    solvers[1]->longest_squared = 2;
    return 0;
}

static int destroy(void **state)
{
    (void)state;
    for (int f = 0; f < FACTORISATIONS; f++) wiggly_destroy(solvers[f]);
    return 0;
}

TESTS_BETWEEN(create, destroy)
