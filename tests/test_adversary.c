/// Seeded problems meant to be hard on the solver, judged by the textbook: no OK above the tolerance, no estimate far below the error,
/// no complaint about what is easy.
#include "near.h"

#include "curve.h"
#include "textbook.h"
#include <stdio.h>
#include <string.h>

enum { MAX = 40 };

static double uniform(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static int pick(uint64_t *seed, int count) { return (int)(uniform(seed) * count); }

static double between(uint64_t *seed, double low, double high) { return low + (high - low) * uniform(seed); }

/// A description with its storage.
struct problem {
    wiggly_desc desc;
    wiggly_knot knots[MAX];
    double tracks[6][MAX];
    int tracks_used;
};

/// From one number to another: smoothly, in one step, or there and back.
static wiggly_param make_track(struct problem *p, uint64_t *seed, double from, double to)
{
    double *track = p->tracks[p->tracks_used++];
    int n = p->desc.samples, shape = pick(seed, 3), at = pick(seed, n);
    for (int i = 0; i < n; i++) {
        double s = n > 1 ? (double)i / (n - 1) : 0;
        double way = shape == 0 ? s * s * (3 - 2 * s) : shape == 1 ? i >= at : sin(6.3 * s);
        track[i] = from + (to - from) * way;
    }
    if (p->desc.start == WIGGLY_LOOP) track[n - 1] = track[0];
    return (wiggly_param){.track = track};
}

/// A number, or one time in five a track from it to another of the same kind.
static wiggly_param make_param(struct problem *p, uint64_t *seed, double value, double other)
{
    if (pick(seed, 5) > 0) return (wiggly_param){.value = value};
    return make_track(p, seed, value, other);
}

/// Periods over the domain: none, a whole or a half number, few, many.
static double some_periods(uint64_t *seed)
{
    switch (pick(seed, 5)) {
    case 0:
        return 0;
    case 1:
        return 0.5 * pick(seed, 13);
    case 2:
        return pow(10, between(seed, -4, 0));
    case 3:
        return between(seed, 0, 4);
    default:
        return between(seed, 0, 30);
    }
}

static double some_damping(uint64_t *seed) { return (double[]){0, 0.03, 1, between(seed, 0, 2)}[pick(seed, 4)]; }

static double some_bandwidth(uint64_t *seed) { return (double[]){0, 0.1, 1, uniform(seed)}[pick(seed, 4)]; }

static void make_poles(struct problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    double t = (d->samples - 1) * d->step;
    // Where both poles alias to the same λ, the oscillator's speeds are infinite.
    double most = (d->passive == WIGGLY_FILTER ? 0.9 : 0.45) / d->step;
    double f = fmin(some_periods(seed) / t, most), other = fmin(some_periods(seed) / t, most);
    if (d->mode == WIGGLY_REAL && pick(seed, 4) == 0) {
        double k = 39.5 * f * f, friction = between(seed, 0, 8);
        d->spring_friction = true;
        d->spring = make_param(p, seed, k, 39.5 * other * other);
        d->friction =
            k > 0 || d->start != WIGGLY_LOOP ? make_param(p, seed, friction, 0) : (wiggly_param){.value = friction};
        return;
    }
    d->frequency = make_param(p, seed, f, other);
    d->damping = make_param(p, seed, some_damping(seed), some_damping(seed));
    d->bandwidth = make_param(p, seed, some_bandwidth(seed), some_bandwidth(seed));
}

/// Few or many, adjacent or apart, on the first and the last sample too.
static void make_knots(struct problem *p, uint64_t *seed, double size)
{
    wiggly_desc *d = &p->desc;
    int end = d->samples - (d->start == WIGGLY_LOOP ? 1 : 0), run = pick(seed, 3) == 0 ? pick(seed, end) : -9;
    double density = uniform(seed) * uniform(seed);
    bool ends = pick(seed, 3) == 0, flat = pick(seed, 12) == 0;
    d->knots = p->knots;
    for (int i = 0; i < end; i++) {
        bool here = uniform(seed) < density || (i >= run && i < run + 3) || (ends && (i == 0 || i == end - 1));
        if (!here) continue;
        p->knots[d->knot_count++] = (wiggly_knot){
            .sample = i,
            .value = flat ? 0 : size * between(seed, -1, 1),
            .has_slope = pick(seed, 3) == 0,
            .slope = flat ? 0 : size * between(seed, -2, 2) / d->step / (double[]){1, 10}[pick(seed, 2)],
            .stiffness = pow(10, between(seed, -3, 12)),
        };
    }
}

static void make_problem(struct problem *p, uint64_t seed, wiggly_passive passive)
{
    memset(p, 0, sizeof *p);
    for (int i = 0; i < 8; i++) uniform(&seed);
    wiggly_desc *d = &p->desc;
    *d = wiggly_default_desc();
    d->passive = passive;
    d->samples = 4 + pick(&seed, MAX - 3);
    d->step = (double[]){1.0 / 24, 1.0 / 60, 1.0 / 1000, 1}[pick(&seed, 4)];
    d->mode = (wiggly_mode)pick(&seed, 3);
    d->start = (wiggly_start)pick(&seed, 3);
    d->calm = (double[]){0, 0.001, 1}[pick(&seed, 3)];
    make_poles(p, &seed);
    double size = (double[]){1, 1, 1, 1e-6, 1e6}[pick(&seed, 5)], y = size * between(&seed, -1, 1);
    if (pick(&seed, 3) == 0) d->equilibrium = make_param(p, &seed, y, size * between(&seed, -1, 1));
    if (pick(&seed, 6) == 0) d->equilibrium = make_track(p, &seed, y, size * between(&seed, -9, 9));
    make_knots(p, &seed, size);
}

/// An answer of the textbook's, or the solver's, in arrays of its own.
struct answer {
    double total[MAX], re[MAX], im[MAX];
};

static double size_of(const struct answer *a, int n)
{
    double low = a->total[0], high = low;
    for (int i = 1; i < n; i++) low = fmin(low, a->total[i]), high = fmax(high, a->total[i]);
    return fmax(high - low, fmax(fabs(low), fabs(high)));
}

/// The largest difference in any column, relative to the larger of the total's range and magnitude. What it is the sum of (equilibrium
/// and displacement) has last digits too: they do not count, and a total that is nearly nothing is measured against a millionth of them.
static double error_of(const struct answer *a, const struct answer *exact, int n)
{
    double worst = 0, parts = 0;
    for (int i = 0; i < n; i++) {
        double off = fmax(fabs(a->total[i] - exact->total[i]), fabs(a->re[i] - exact->re[i]));
        off = fmax(off, fabs(a->im[i] - exact->im[i]));
        if (!(off <= worst)) worst = off;
        parts = fmax(parts, fmax(fabs(exact->re[i]), fabs(exact->total[i] - exact->re[i])));
    }
    return worst <= 0x1p-46 * parts ? 0 : worst / fmax(size_of(exact, n), 1e-6 * parts);
}

static struct textbook book;

/// How much more the curve changes, relatively, than the numbers that it is made of: the rounding of the poles alone costs any solver in
/// doubles some 1e-16 of it.
static double condition_of(const struct problem *p, wiggly_status status, const struct answer *exact)
{
    const double change = 1e-12;
    struct problem other = *p;
    wiggly_param *params[] = {&other.desc.frequency, &other.desc.damping, &other.desc.spring, &other.desc.friction};
    struct answer changed;
    double worst = 0;
    for (int i = 0; i < 4; i++) {
        wiggly_param kept = *params[i];
        double track[MAX];
        for (int k = 0; kept.track && k < p->desc.samples; k++) track[k] = kept.track[k] * (1 + change);
        *params[i] = (wiggly_param){kept.value * (1 + change), kept.track ? track : NULL};
        if (!textbook_as(&other.desc, status, &book, changed.total, changed.re, changed.im)) return INFINITY;
        worst = fmax(worst, error_of(&changed, exact, p->desc.samples) / change);
        *params[i] = kept;
    }
    return worst;
}

static double tolerance(const wiggly_desc *d) { return d->mode == WIGGLY_CUBIC ? 1e-9 : 1e-8; }

/// What the textbook says of a problem.
struct verdict {
    wiggly_status status;
    bool exists;     ///< there is an answer for the status that the solver gave
    bool borderline; ///< whether it is singular depends on the last digits
    double pivot, growth, condition;
    struct answer exact;
};

/// The textbook's answer to what the solver says it solved, and whether that was the right thing to solve.
static void judge(const struct problem *p, wiggly_status said, struct verdict *v)
{
    struct answer *a = &v->exact;
    bool asked = textbook_as(&p->desc, WIGGLY_OK, &book, a->total, a->re, a->im);
    v->pivot = book.pivot;
    v->growth = book.growth;
    v->borderline = book.open && ((asked && book.pivot < 1e-11) || (book.growth > 300 && book.growth < 3e5));
    v->exists = textbook_curve(&p->desc, &book, &v->status, a->total, a->re, a->im);
    if (!v->borderline || said == v->status || said == WIGGLY_SINGULAR) return;
    bool as_asked = said == WIGGLY_INEXACT || said == WIGGLY_OK;
    v->status = as_asked ? WIGGLY_OK : said;
    v->exists = textbook_as(&p->desc, v->status, &book, a->total, a->re, a->im);
}

/// What is wrong with the solver's answer, or NULL; `error` receives its own.
static const char *find_fault(const struct problem *p, wiggly_solver *solver, struct verdict *v, double *error,
                              wiggly_status *said, double *estimate)
{
    struct answer got;
    wiggly_curve curve = {.total = got.total, .re = got.re, .im = got.im};
    *error = v->condition = 0;
    *said = wiggly_solve(solver, &p->desc, &curve);
    *estimate = curve.error;
    judge(p, *said, v);
    if (*said == WIGGLY_SINGULAR) return v->exists && !v->borderline ? "singular is not" : NULL;
    if (!v->exists) return "an answer where there is none";
    *error = error_of(&got, &v->exact, p->desc.samples);
    if (*said != v->status && !(*said == WIGGLY_INEXACT && v->status == WIGGLY_OK)) return "the wrong status";
    if (!(curve.error >= 0)) return "an estimate that is no number";
    v->condition = *said == WIGGLY_INEXACT || *error > 1e-12 ? condition_of(p, v->status, &v->exact) : 1;
    if (*said == WIGGLY_OK && !(*error <= tolerance(&p->desc))) return "OK, and off";
    if (!(*error <= 10 * fmax(curve.error, fmax(1e-12, 1e-15 * v->condition))))
        return "an estimate far below the error";
    if (*said == WIGGLY_INEXACT && !(curve.error > tolerance(&p->desc))) return "INEXACT by no estimate";
    bool near = *error > 0.05 * tolerance(&p->desc); // what is that far off may say so
    if (*said == WIGGLY_INEXACT && !near && v->condition < 1e5 && v->pivot > 1e-9) return "INEXACT, and easy";
    return NULL;
}

static void print_param(const char *name, wiggly_param param, int samples)
{
    if (!param.track && param.value == 0) return;
    char text[40 * MAX];
    int used = 0;
    for (int i = 0; i < (param.track ? samples : 1); i++) {
        used +=
            snprintf(text + used, sizeof text - (size_t)used, " %.17g", param.track ? param.track[i] : param.value);
    }
    print_error("  %s%s\n", name, text);
}

/// All that it takes to try it by itself.
static void print_problem(const wiggly_desc *d)
{
    print_error("  samples %d, step %.17g, mode %d, start %d, passive %d, calm %g\n", d->samples, d->step, d->mode,
                d->start, d->passive, d->calm);
    print_param("frequency", d->frequency, d->samples);
    print_param("damping", d->damping, d->samples);
    print_param("bandwidth", d->bandwidth, d->samples);
    print_param("spring", d->spring, d->samples);
    print_param("friction", d->friction, d->samples);
    print_param("equilibrium", d->equilibrium, d->samples);
    for (int k = 0; k < d->knot_count; k++) {
        const wiggly_knot *knot = &d->knots[k];
        print_error("  knot %d: %.17g", knot->sample, knot->value);
        if (knot->has_slope) print_error(", slope %.17g, stiffness %.17g", knot->slope, knot->stiffness);
        print_error("\n");
    }
}

static bool stands(const struct problem *p, wiggly_solver *solver, const char *name)
{
    struct verdict v;
    double error, estimate;
    wiggly_status said;
    const char *fault = find_fault(p, solver, &v, &error, &said, &estimate);
    if (!fault) return true;
    print_error("%s: %s: said %d, is %d, off by %.3g, estimate %.3g, pivot %.3g, growth %.3g, condition %.2g\n", name,
                fault, said, v.status, error, estimate, v.pivot, v.growth, v.condition);
    print_problem(&p->desc);
    return false;
}

typedef void maker(struct problem *p, uint64_t seed, wiggly_passive passive);

static void try_many(wiggly_solver *solver, maker *make, wiggly_passive passive, int problems)
{
    int faults = 0;
    for (int seed = 0; seed < problems; seed++) {
        struct problem p;
        char name[40];
        make(&p, (uint64_t)seed, passive);
        snprintf(name, sizeof name, "seed %d", seed);
        faults += !stands(&p, solver, name);
    }
    if (faults) fail_msg("%d of %d problems", faults, problems);
}

static void filters(void **state) { try_many(*state, make_problem, WIGGLY_FILTER, 2000); }

static void oscillators(void **state) { try_many(*state, make_problem, WIGGLY_OSCILLATOR, 2000); }

/// Nothing but the knots holds Im x, and they are next to each other.
static void make_adjacent(struct problem *p, uint64_t seed, wiggly_passive passive)
{
    memset(p, 0, sizeof *p);
    for (int i = 0; i < 8; i++) uniform(&seed);
    wiggly_desc *d = &p->desc;
    *d = wiggly_default_desc();
    d->samples = 6 + pick(&seed, MAX - 5);
    d->passive = passive;
    d->calm = 0;
    d->start = pick(&seed, 2) ? WIGGLY_REST : WIGGLY_FREE;
    d->bandwidth.value = 0;
    d->frequency.value = fmin(pow(10, between(&seed, -1, 1.2)) / (d->samples * d->step), 0.45 / d->step);
    d->damping.value = some_damping(&seed);
    d->knots = p->knots;
    int first = 2 + pick(&seed, d->samples - 5);
    for (int k = 0; k < 3; k++) {
        p->knots[d->knot_count++] = (wiggly_knot){.sample = first + k, .value = between(&seed, -1, 1)};
    }
}

static void three_adjacent_filters(void **state) { try_many(*state, make_adjacent, WIGGLY_FILTER, 1500); }

static void three_adjacent_oscillators(void **state) { try_many(*state, make_adjacent, WIGGLY_OSCILLATOR, 500); }

/// Knots where an undamped swing passes through 0, whatever its size; loops of whole periods.
static void make_nodal(struct problem *p, uint64_t seed, wiggly_passive passive)
{
    memset(p, 0, sizeof *p);
    for (int i = 0; i < 8; i++) uniform(&seed);
    wiggly_desc *d = &p->desc;
    *d = wiggly_default_desc();
    int half = 2 + pick(&seed, 4), halves = 2 + pick(&seed, 3), first = pick(&seed, half);
    d->passive = passive;
    d->mode = pick(&seed, 3) ? WIGGLY_REAL : WIGGLY_COMPLEX;
    d->start = (wiggly_start)pick(&seed, 3);
    d->samples = d->start == WIGGLY_LOOP ? 2 * half * (halves / 2) + 1 : half * halves + 2 + pick(&seed, 4);
    d->calm = (double[]){0, 0.001, 1}[pick(&seed, 3)];
    d->bandwidth.value = 0;
    d->damping.value = (double[]){0, 0, 1e-9, 1e-5}[pick(&seed, 4)];
    d->frequency.value = 1 / (2 * half * d->step);
    if (pick(&seed, 4) == 0) { // nothing swings where the curve starts
        double *track = p->tracks[p->tracks_used++];
        for (int i = 0; i < d->samples; i++) track[i] = i <= first ? 0 : d->frequency.value;
        if (d->start == WIGGLY_LOOP) track[d->samples - 1] = 0;
        d->frequency.track = track;
    }
    if (pick(&seed, 3) == 0) d->equilibrium = make_track(p, &seed, 0, between(&seed, -1, 1));
    d->knots = p->knots;
    bool flat = pick(&seed, 4) == 0;
    for (int i = first; i < d->samples - 1; i += half) {
        p->knots[d->knot_count++] = (wiggly_knot){.sample = i, .value = flat ? 0.5 : between(&seed, -1, 1)};
    }
}

static void half_period_filters(void **state) { try_many(*state, make_nodal, WIGGLY_FILTER, 500); }

static void half_period_oscillators(void **state) { try_many(*state, make_nodal, WIGGLY_OSCILLATOR, 500); }

/// All totals are 0, so there is nothing that an error could be a part of: two knots at 0 on no equilibrium, and every sample a knot at 0
/// on one that is elsewhere.
static void nothing_at_all_is_exact(void **state)
{
    bool all = true;
    for (int kind = 0; kind < 36; kind++) {
        struct problem p = {.desc = wiggly_default_desc()};
        p.desc.samples = 20;
        p.desc.mode = (wiggly_mode)(kind % 3);
        p.desc.start = (wiggly_start)(kind / 3 % 3);
        p.desc.passive = (wiggly_passive)(kind / 9 % 2);
        p.desc.frequency.value = 1;
        p.desc.damping.value = 0.1;
        p.desc.knots = p.knots;
        bool everywhere = kind >= 18;
        if (everywhere) p.desc.equilibrium.value = 0.3;
        for (int i = everywhere ? 0 : 5; i < 19; i += everywhere ? 1 : 7) {
            p.knots[p.desc.knot_count++] = (wiggly_knot){.sample = i, .has_slope = i == 5, .stiffness = 1000};
        }
        all = stands(&p, *state, "all totals 0") && all;
    }
    assert_true(all);
}

static int create(void **state) { return (int)wiggly_create(MAX, MAX, (wiggly_solver **)state); }

static int destroy(void **state)
{
    wiggly_destroy(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(filters),
        cmocka_unit_test(oscillators),
        cmocka_unit_test(three_adjacent_filters),
        cmocka_unit_test(three_adjacent_oscillators),
        cmocka_unit_test(half_period_filters),
        cmocka_unit_test(half_period_oscillators),
        cmocka_unit_test(nothing_at_all_is_exact),
    };
    return cmocka_run_group_tests(tests, create, destroy);
}
