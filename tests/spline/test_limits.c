/// Limits, by the conditions of Karush, Kuhn and Tucker on the textbook's system, which shares no line with the solver: within the
/// limits everywhere, on every knot, and nothing pulls but a limit that is touched, away from itself.
#include "near.h"

#include "spline/solver.h"
#include "textbook.h"

enum { SAMPLES = 241, MOST_KNOTS = 6, LAYOUTS = 200 };

static struct textbook book;
static double total[SAMPLES], y[SAMPLES], re[SAMPLES], im[SAMPLES], omega[SAMPLES], track[SAMPLES];
static wiggly_curve curve = {
    .size = sizeof(wiggly_curve), .total = total, .y = y, .re = re, .im = im, .omega = omega};
static wiggly_solver *solver;
static unsigned seed;

static double uniform(void)
{
    seed = seed * 1664525U + 1013904223U;
    return (seed >> 8) / 16777216.0;
}

struct layout {
    wiggly_desc desc;
    wiggly_knot knots[MOST_KNOTS];
    double largest;
    char what[80];
};

/// The layouts of the mathematics page: f 0.5 … 3 Hz, damping up to 0.3, bandwidth up to 0.2, knots −1 … 1.
static void make_layout(struct layout *l, unsigned layout, wiggly_mode mode, int samples, double step)
{
    seed = layout * 2654435761U + 17;
    for (int i = 0; i < 4; i++) uniform();
    *l = (struct layout){.desc = wiggly_default_desc(), .what = "layout"};
    wiggly_desc *desc = &l->desc;
    desc->samples = samples;
    desc->step = step;
    desc->mode = mode;
    desc->frequency.value = 0.5 + 2.5 * uniform();
    desc->damping.value = 0.3 * uniform();
    desc->bandwidth.value = 0.2 * uniform();
    desc->knots = l->knots;
    desc->knot_count = 3 + (int)(4 * uniform());
    for (int k = 0; k < desc->knot_count; k++) {
        int sample, part = samples / desc->knot_count;
        sample = k * part + (int)(uniform() * (part - 1));
        l->knots[k] = (wiggly_knot){.sample = sample, .value = 2 * uniform() - 1};
        l->largest = fmax(l->largest, fabs(l->knots[k].value));
    }
}

static void limit(struct layout *l, double by)
{
    l->desc.high = by * l->largest;
    l->desc.low = -l->desc.high;
    l->desc.has_low = l->desc.has_high = true;
}

static bool is_keyed(const wiggly_desc *desc, int sample)
{
    for (int k = 0; k < desc->knot_count; k++) {
        if (desc->knots[k].sample == sample) return true;
    }
    return false;
}

/// A pull at a free sample is none; at a limit it is outwards: the limit pushes back.
static void check_pull(const wiggly_desc *desc, int sample, real pull, double tolerance, const char *what)
{
    bool high = total[sample] >= desc->high, low = total[sample] <= desc->low;
    if (is_keyed(desc, sample)) return;
    if ((!high && pull > tolerance) || (!low && pull < -tolerance))
        fail_msg("%s: %g pulls at sample %d (%g), which is free to go", what, (double)pull, sample, total[sample]);
}

static real largest_of(const real *x, int count, int step)
{
    real largest = 0;
    for (int i = 0; i < count; i += step) largest = fmaxq(largest, fabsq(x[i]));
    return largest;
}

/// What pulls behind the last knot, from sample 1 there on; returns how much of that is on Im w of the knot.
static real find_tail_pulls(const wiggly_desc *desc, real *pull)
{
    static real e[SAMPLES];
    const int last = book.last, count = desc->samples - last;
    number w = ((real)re[last] + 1.0Qi * im[last]) - book.u[last], turn = 1.0Qi;
    real turned[SAMPLES], on_turn = 0;
    for (int i = 1; i < count; i++) {
        number by = cexpq((book.at[last + i - 1].p + book.at[last + i].p) / 2 * book.h);
        w *= by, turn *= by;
        turned[i] = crealq(turn);
        e[i] = (real)total[last + i] - book.y[last + i] - crealq(book.u[last + i]) - crealq(w);
    }
    for (int i = 1; i < count; i++) {
        pull[i] = textbook_tail_pull(&book, e, count, i);
        on_turn -= pull[i] * turned[i];
    }
    return on_turn;
}

static void find_body_pulls(int count, real *pull)
{
    static real x[2 * SAMPLES];
    for (int k = 0; k < count; k++) {
        number w = ((real)re[book.first + k] + 1.0Qi * im[book.first + k]) - book.u[book.first + k];
        x[2 * k] = crealq(w), x[2 * k + 1] = cimagq(w);
    }
    for (int j = 0; j < 2 * count; j++) {
        pull[j] = book.right[j];
        for (int k = 0; k < 2 * count; k++) pull[j] -= textbook_entry(&book, j, k) * x[k];
    }
}

static void check_feasible(const wiggly_desc *desc)
{
    for (int i = book.first; i < desc->samples; i++) {
        assert_true(total[i] >= desc->low && total[i] <= desc->high);
        assert_near(total[i], y[i] + re[i], 1e-9 * (desc->high - desc->low));
    }
    for (int k = 0; k < desc->knot_count; k++) assert_true(total[desc->knots[k].sample] == desc->knots[k].value);
}

/// The textbook's gradient at the solver's curve. The pull on Im w at the last knot of a spline that settles is what its own rows and
/// all that is held behind make together.
static void check_conditions(const struct layout *l)
{
    static double unused[3][SAMPLES];
    static real pull[2 * SAMPLES], behind[SAMPLES];
    wiggly_desc unlimited = l->desc;
    unlimited.has_low = unlimited.has_high = false;
    assert_true(textbook_as(&unlimited, WIGGLY_OK, &book, unused[0], unused[1], unused[2]));
    check_feasible(&l->desc);
    const bool tail = book.tied && book.is_complex;
    const int count = book.tied ? book.last - book.first + 1 : book.count;
    find_body_pulls(count, pull);
    double tolerance = 1e-6 * (double)largest_of(pull, 2 * count, 2) + 1e-9;
    if (tail) pull[2 * count - 1] += find_tail_pulls(&l->desc, behind);
    for (int i = 1; tail && i < l->desc.samples - book.last; i++)
        check_pull(&l->desc, book.last + i, behind[i], tolerance, l->what);
    for (int k = 0; k < count; k++) {
        if (!book.fixed[2 * k]) check_pull(&l->desc, book.first + k, pull[2 * k], tolerance, l->what);
        if (!book.used[2 * k + 1] || book.fixed[2 * k + 1]) continue;
        if (fabsq(pull[2 * k + 1]) > tolerance)
            fail_msg("%s: %g pulls at Im w of sample %d", l->what, (double)pull[2 * k + 1], book.first + k);
    }
}

static int compare(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }

static void solve(const struct layout *l)
{
    wiggly_status status = wiggly_solve(solver, &l->desc, &curve);
    if (status != WIGGLY_OK) fail_msg("%s: %s", l->what, wiggly_status_text(status));
}

static double largest_total(const struct layout *l)
{
    double largest = 0;
    for (int i = 0; i < l->desc.samples; i++) largest = fmax(largest, fabs(total[i]));
    return largest / l->largest;
}

// --- layouts ---------------------------------------------------------------------------------------------------------

enum { STILL, MOVING, TRACK, VARIANTS };

/// A layout of one of the kinds: mode, start, filter, and what moves.
static void vary(struct layout *l, int start, int filter, int variant)
{
    wiggly_desc *desc = &l->desc;
    desc->start = (wiggly_start)start;
    desc->passive = (wiggly_passive)filter;
    for (int i = 0; i < desc->samples; i++)
        track[i] = variant == TRACK ? 1.5 + sin(0.05 * i) : 0.3 * l->largest * sin(0.11 * i);
    if (variant == TRACK) desc->frequency.track = track;
    if (variant == MOVING) desc->equilibrium.track = track;
    if (desc->mode == WIGGLY_CUBIC && start != WIGGLY_LOOP)
        l->knots[0].has_slope = true, l->knots[0].slope = 2, l->knots[0].stiffness = 1000;
}

/// Half the rate is enough.
static void make_every_mode(struct layout *l, unsigned n)
{
    const int kind = (int)n / 5;
    make_layout(l, n % 5 + 100 * (unsigned)kind, (wiggly_mode)(kind % 3), 121, 1.0 / 12);
    vary(l, kind / 3 % 3, kind / 9 % 2, kind / 18);
    limit(l, 1.15);
}

static double of_range(double low, double high) { return low + (high - low) * uniform(); }

/// Some limits right on the outermost knots, some on one side alone, some on knots that are all the same.
static void limit_any(struct layout *l)
{
    wiggly_desc *desc = &l->desc;
    double low = l->knots[0].value, high = low, room = uniform() < 0.3 ? 0 : of_range(0, 0.3);
    for (int k = 1; k < desc->knot_count; k++) {
        low = fmin(low, l->knots[k].value);
        high = fmax(high, l->knots[k].value);
    }
    desc->low = low - room * (high - low) - (high == low);
    desc->high = high + room * (high - low);
    desc->has_low = desc->has_high = true;
    if (uniform() < 0.2)
        desc->low = -INFINITY, desc->has_low = false;
    else if (uniform() < 0.2)
        desc->high = INFINITY, desc->has_high = false;
}

/// Whatever the sliders allow, on short ranges; loops without knots too.
static void make_any(struct layout *l, unsigned n)
{
    make_layout(l, n, (wiggly_mode)(n % 3), 40 + (int)(n % 24), 1.0 / 12);
    wiggly_desc *desc = &l->desc;
    desc->start = uniform() < 0.5 ? WIGGLY_FREE : WIGGLY_LOOP;
    desc->passive = uniform() < 0.7 ? WIGGLY_OSCILLATOR : WIGGLY_FILTER;
    desc->frequency.value = uniform() < 0.1 ? 0 : of_range(0, 5);
    desc->damping.value = uniform() < 0.1 ? 0 : uniform();
    desc->bandwidth.value = of_range(0, 0.5);
    desc->calm = uniform() < 0.2 ? 0 : uniform();
    if (desc->start == WIGGLY_LOOP && uniform() < 0.3) desc->knot_count = 0, l->knots[0].value = 0.3;
    for (int k = 0; k < desc->knot_count; k++) {
        if (uniform() < 0.2) l->knots[k].has_slope = true, l->knots[k].slope = uniform(), l->knots[k].stiffness = 500;
    }
    const double size = of_range(0, 3), speed = of_range(0, 0.3);
    for (int i = 0; i < desc->samples; i++) track[i] = size * sin(speed * i);
    if (uniform() < 0.5) desc->equilibrium.track = track;
    limit_any(l);
}

/// 240 samples as in the app.
static void make_whole(struct layout *l, unsigned n)
{
    make_layout(l, n, WIGGLY_COMPLEX, 240, 1.0 / 24);
    limit(l, 1.15);
}

/// An equilibrium that swings far beyond the limits, of every start, mode and filter: most samples are held.
static void make_mostly_held(struct layout *l, unsigned n)
{
    make_layout(l, n, (wiggly_mode)(n % 3), 240, 1.0 / 24);
    vary(l, (int)n / 3 % 3, (int)n / 9 % 2, MOVING);
    limit(l, 0.3);
    for (int i = 0; i < 240; i++) track[i] = l->largest * sin((0.015 + 0.0001 * n) * i);
    for (int k = 0; k < l->desc.knot_count; k++) l->knots[k].value *= 0.25;
}

/// The same with the sample right behind the last knot held, too; in the last of these layouts with others before and behind it.
static void make_held_behind(struct layout *l, unsigned n)
{
    static const double parts[] = {0.8, 1, 1 - 1e-12, 1 - 1e-6};
    n += 219;
    make_layout(l, n + 5000, WIGGLY_COMPLEX, 121, 1.0 / 12);
    vary(l, (int)n % 2, 0, MOVING);
    limit(l, 0.3);
    for (int i = 0; i < l->desc.samples; i++) track[i] = l->largest * sin((0.03 + 0.0001 * n) * i);
    if (l->desc.start == WIGGLY_FREE) l->knots[0].sample = 0;
    for (int k = 0; k < l->desc.knot_count; k++) l->knots[k].value *= 0.3 * parts[n / 2 % 4];
}

static const struct family {
    const char *what;
    void (*make)(struct layout *l, unsigned n);
    int count, judged; ///< layouts; the conditions are checked of one in so many
    bool may_be_calm;  ///< some ask for what has no answer of its own
    int held, mostly_held,
        held_behind;    ///< at least so many hold a sample, most samples, the one behind the last knot
    int most_solves[2]; ///< the median and the 99th percentile; 0: any
} families[] = {
    {"every mode", make_every_mode, 5 * 3 * 3 * 2 * VARIANTS, 1, .held = 1},
    {"any spline", make_any, 240, 1, .may_be_calm = true, .held = 111},
    {"the app's", make_whole, 200, 10, .held = 1, .most_solves = {4}},
    {"mostly held", make_mostly_held, 360, 20, .mostly_held = 121, .most_solves = {4, 30}},
    {"held behind", make_held_behind, 40, 1, .held_behind = 1},
};

TEST(the_conditions_hold_and_few_solves_are_enough)
{
    for (size_t f = 0; f < sizeof families / sizeof *families; f++) {
        const struct family *family = &families[f];
        int rounds[360], solved = 0, held = 0, mostly_held = 0, held_behind = 0;
        for (int n = 0; n < family->count; n++) {
            struct layout l;
            family->make(&l, (unsigned)n);
            snprintf(l.what, sizeof l.what, "layout %d of %s", n, family->what);
            const wiggly_status status = wiggly_solve(solver, &l.desc, &curve);
            if (family->may_be_calm && (status == WIGGLY_CALMED || status == WIGGLY_LEVELLED)) continue;
            if (status != WIGGLY_OK) fail_msg("%s: %s", l.what, wiggly_status_text(status));
            int samples = 0;
            for (int i = 0; i < l.desc.samples; i++) samples += abs(solver->limits.held[i]) == 1;
            held += solver->limits.solves > 0;
            mostly_held += samples > 110;
            if (l.desc.knot_count > 0)
                held_behind += solver->limits.held[l.knots[l.desc.knot_count - 1].sample + 1] != 0;
            rounds[solved++] = 1 + solver->limits.solves;
            if (n % family->judged == 0) check_conditions(&l);
        }
        qsort(rounds, (size_t)solved, sizeof *rounds, compare);
        const int median = rounds[solved / 2], p99 = rounds[solved * 99 / 100];
        print_message("%s: %d solved, %d of them held, %d mostly, %d behind; solves: median %d, p99 %d, most %d\n",
                      family->what, solved, held, mostly_held, held_behind, median, p99, rounds[solved - 1]);
        assert_true(solved > family->count * 5 / 6 && held >= family->held);
        assert_true(mostly_held >= family->mostly_held && held_behind >= family->held_behind);
        assert_true(!family->most_solves[0] || median <= family->most_solves[0]);
        assert_true(!family->most_solves[1] || p99 <= family->most_solves[1]);
    }
}

/// Without limits they overshoot by half and more.
TEST(limits_take_the_overshoot)
{
    double before = 0, after = 0;
    for (unsigned n = 0; n < 200; n++) {
        struct layout l;
        make_whole(&l, n);
        solve(&l);
        after = fmax(after, largest_total(&l));
        l.desc.has_low = l.desc.has_high = false;
        solve(&l);
        before = fmax(before, largest_total(&l));
    }
    assert_true(before > 2 && after <= 1.15 * (1 + 1e-12));
}

/// The first of the layouts that takes a second solve more than its first.
static void make_swinging(struct layout *l)
{
    for (unsigned n = 0; n == 0 || solver->limits.solves < 2; n++) {
        make_layout(l, n, WIGGLY_COMPLEX, 240, 1.0 / 24);
        limit(l, 1.05);
        solve(l);
    }
}

/// Without a knot nothing but the equilibrium's motion moves it, and a limit stops that.
TEST(what_moves_by_itself_is_limited_too)
{
    struct layout l;
    for (int mode = WIGGLY_COMPLEX; mode <= WIGGLY_REAL; mode++) {
        make_layout(&l, 3, (wiggly_mode)mode, 240, 1.0 / 24);
        for (int i = 0; i < 240; i++) track[i] = i < 40 ? 0 : 1;
        l.desc.knot_count = 0;
        l.desc.equilibrium.track = track;
        l.desc.damping.value = 0.05;
        solve(&l);
        assert_true(largest_total(&l) * l.largest > 1.5);
        l.desc.high = 1.2, l.desc.low = -0.1, l.desc.has_low = l.desc.has_high = true;
        solve(&l);
        int touched = 0;
        for (int i = 0; i < 240; i++) touched += total[i] == 1.2;
        for (int i = 0; i < 240; i++) assert_true(total[i] <= 1.2 && total[i] >= -0.1);
        assert_in_range(touched, 1, 10);
    }
}

/// Once the tail has left its limit, its imaginary part goes on with the real one: x turns by its pole.
TEST(what_leaves_a_limit_swings_whole)
{
    const wiggly_knot knots[] = {{.sample = 20}, {.sample = 40, .value = 1}};
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = 160;
    desc.frequency.value = 1, desc.damping.value = 0.05;
    desc.knots = knots, desc.knot_count = 2;
    desc.low = -0.6, desc.high = 1.05, desc.has_low = desc.has_high = true;
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
    int left = 0;
    for (int i = 0; i < desc.samples; i++) left = total[i] <= desc.low || total[i] >= desc.high ? i : left;
    assert_in_range(left, 42, 100);
    const double d = 0.05 * 2 * M_PI, w = 2 * M_PI * sqrt(1 - 0.05 * 0.05);
    const double fade = exp(-d * desc.step), turn_re = fade * cos(w * desc.step), turn_im = fade * sin(w * desc.step);
    for (int i = left + 1; i + 1 < desc.samples; i++) {
        assert_near(re[i + 1], turn_re * re[i] - turn_im * im[i], 1e-8);
        assert_near(im[i + 1], turn_re * im[i] + turn_im * re[i], 1e-8);
    }
}

TEST(what_cannot_be_is_an_error)
{
    struct layout l;
    wiggly_solver *narrow;
    make_layout(&l, 5, WIGGLY_CUBIC, 240, 1.0 / 24);
    limit(&l, 0.9);
    assert_int_equal(wiggly_solve(solver, &l.desc, &curve), WIGGLY_ERROR_KNOT_LIMIT);
    assert_true(fabs(l.knots[curve.knot].value) > l.desc.high);
    for (int kind = 0; kind < 6; kind++) { // at a still knot the total is what moves by itself
        make_layout(&l, 5, (wiggly_mode)(kind % 3), 240, 1.0 / 24);
        vary(&l, 0, kind / 3, MOVING);
        for (int i = 0; i < 240; i++) track[i] = 2 * l.largest * sin(0.11 * i);
        l.knots[2] = (wiggly_knot){.sample = 128, .still = true};
        limit(&l, 1.15);
        memcpy(y, track, sizeof y);
        y[0] = 17;
        assert_int_equal(wiggly_solve(solver, &l.desc, &curve), WIGGLY_ERROR_KNOT_LIMIT);
        assert_int_equal(curve.knot, 2);
        assert_true(y[0] == 17); // nothing is touched
    }
    make_layout(&l, 5, WIGGLY_CUBIC, 240, 1.0 / 24);
    l.desc.has_low = l.desc.has_high = true;
    l.desc.high = l.desc.low = l.knots[0].value;
    assert_int_equal(wiggly_solve(solver, &l.desc, &curve), WIGGLY_ERROR_LIMITS);
    l.desc.high = NAN, l.desc.has_low = false;
    assert_int_equal(wiggly_solve(solver, &l.desc, &curve), WIGGLY_ERROR_LIMITS);
    make_swinging(&l);
    assert_int_equal(wiggly_create(240, l.desc.knot_count, &narrow), WIGGLY_OK);
    assert_int_equal(wiggly_solve(narrow, &l.desc, &curve), WIGGLY_ERROR_CAPACITY);
    wiggly_destroy(narrow);
}

/// A wild equilibrium far beyond the limits: the search ends before it has found what to hold, and says so; the curve keeps within.
TEST(a_search_that_tires_says_so)
{
    enum { LONG = 3000 };
    static double wild[LONG], room[3][1 + LONG]; // what is before them is no sample
    double *const now = room[0] + 1;
    wiggly_solver *large;
    const wiggly_knot knot = {.sample = 10};
    wiggly_curve within = {.size = sizeof within, .total = now, .y = room[1] + 1, .re = room[2] + 1};
    wiggly_desc desc = wiggly_default_desc();
    seed = 1;
    for (int i = 0; i < LONG; i++) wild[i] = 200 * uniform() - 100;
    desc.samples = LONG;
    desc.mode = WIGGLY_REAL;
    desc.start = WIGGLY_LOOP;
    desc.frequency.value = 0.01;
    desc.damping.value = 0.1;
    desc.equilibrium.track = wild;
    desc.knots = &knot;
    desc.knot_count = 1;
    desc.high = 0.001, desc.low = -0.001, desc.has_low = desc.has_high = true;
    assert_int_equal(wiggly_create(LONG, LONG, &large), WIGGLY_OK);
    assert_int_equal(wiggly_solve(large, &desc, &within), WIGGLY_INEXACT);
    for (int i = 0; i < LONG; i++) assert_true(now[i] >= desc.low && now[i] <= desc.high);
    wiggly_destroy(large);
}

/// Long splines that lie along a limit: with every sample there keyed they are the same curve, or the error says how far they are from it.
TEST(no_sample_just_beyond_a_limit_is_forgotten)
{
    enum { LONG = 5000, MOST = 7 };
    static double room[2][2][LONG];
    static wiggly_knot knots[MOST], all[LONG];
    wiggly_curve limited = {.size = sizeof limited, .total = room[0][0], .re = room[0][1]},
                 keyed = {.size = sizeof keyed, .total = room[1][0], .re = room[1][1]};
    wiggly_solver *large;
    assert_int_equal(wiggly_create(LONG, LONG, &large), WIGGLY_OK);
    const int layouts = quick_or_all(20, 600);
    for (int n = 110; n < 110 + layouts; n++) {
        seed = (unsigned)n * 2654435761U + 17;
        for (int i = 0; i < 4; i++) uniform();
        wiggly_desc desc = wiggly_default_desc();
        desc.samples = (int)of_range(2000, LONG);
        desc.mode = WIGGLY_CUBIC;
        desc.start = n % 3 ? WIGGLY_FREE : WIGGLY_LOOP;
        desc.knots = knots;
        desc.knot_count = (int)of_range(3, MOST);
        for (int k = 0; k < desc.knot_count; k++) {
            const int part = desc.samples / desc.knot_count;
            const double value = uniform() < 0.4 ? of_range(-1, 1) : uniform() < 0.5 ? -1 : 1;
            knots[k] = (wiggly_knot){.sample = k * part + (int)of_range(0, part - 1), .value = value};
        }
        desc.low = -1, desc.high = 1, desc.has_low = desc.has_high = true;
        const wiggly_status status = wiggly_solve(large, &desc, &limited);
        const int given = desc.knot_count;
        desc.has_low = desc.has_high = false, desc.knots = all, desc.knot_count = 0;
        for (int i = 0, k = 0; i < desc.samples; i++) {
            const bool is_given = k < given && knots[k].sample == i;
            const bool is_inside = n % 3 == 0 || (i > knots[0].sample && i < knots[given - 1].sample);
            if (is_given || (is_inside && fabs(limited.total[i]) >= 1))
                all[desc.knot_count++] = (wiggly_knot){.sample = i, .value = limited.total[i]};
            k += is_given;
        }
        if (desc.start == WIGGLY_LOOP && all[desc.knot_count - 1].sample == desc.samples - 1) desc.knot_count--;
        assert_true(wiggly_solve(large, &desc, &keyed) <= WIGGLY_INEXACT);
        double off = 0;
        for (int i = 0; i < desc.samples; i++) off = fmax(off, fabs(limited.re[i] - keyed.re[i]));
        if (off > (status == WIGGLY_OK ? 1e-9 : limited.error))
            fail_msg("layout %d: %d, off by %g", n, (int)status, off);
    }
    wiggly_destroy(large);
}

static int create(void **state)
{
    (void)state;
    return (int)wiggly_create(SAMPLES, SAMPLES + MOST_KNOTS, &solver);
}

static int destroy(void **state)
{
    (void)state;
    wiggly_destroy(solver);
    return 0;
}

TESTS_BETWEEN(create, destroy)
