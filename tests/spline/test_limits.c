/// Limits, by the conditions of Karush, Kuhn and Tucker on the textbook's system, which shares no line with the solver: within the
/// limits everywhere, on every knot, and nothing pulls but a limit that is touched, away from itself.
#include "near.h"

#include "spline/solver.h"
#include "textbook_parts.h"

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
    if (status != WIGGLY_OK) fail_msg("%s", wiggly_status_text(status));
}

static double largest_total(const struct layout *l)
{
    double largest = 0;
    for (int i = 0; i < l->desc.samples; i++) largest = fmax(largest, fabs(total[i]));
    return largest / l->largest;
}

static const char *const modes[] = {"complex", "real", "cubic"}, *const starts[] = {"free", "rest", "loop"};

enum { STILL, MOVING, TRACK, VARIANTS };

/// A layout of one of the kinds: mode, start, filter, and what moves.
static void vary(struct layout *l, int start, int filter, int variant)
{
    static const char *const passive[] = {"oscillator", "filter"};
    wiggly_desc *desc = &l->desc;
    desc->start = (wiggly_start)start;
    desc->passive = (wiggly_passive)filter;
    for (int i = 0; i < desc->samples; i++)
        track[i] = variant == TRACK ? 1.5 + sin(0.05 * i) : 0.3 * l->largest * sin(0.11 * i);
    if (variant == TRACK) desc->frequency.track = track;
    if (variant == MOVING) desc->equilibrium.track = track;
    if (desc->mode == WIGGLY_CUBIC && start != WIGGLY_LOOP) {
        l->knots[0].has_slope = true, l->knots[0].slope = 2, l->knots[0].stiffness = 1000;
    }
    snprintf(l->what, sizeof l->what, "%s, %s, %s, variant %d", modes[desc->mode], starts[start], passive[filter],
             variant);
}

/// Half the rate is enough.
TEST(the_conditions_hold_in_every_mode)
{
    for (int kind = 0; kind < 3 * 3 * 2 * VARIANTS; kind++) {
        for (unsigned n = 0; n < 5; n++) {
            struct layout l;
            make_layout(&l, n + 100 * (unsigned)kind, (wiggly_mode)(kind % 3), 121, 1.0 / 12);
            vary(&l, kind / 3 % 3, kind / 9 % 2, kind / 18);
            limit(&l, 1.15);
            solve(&l);
            check_conditions(&l);
        }
    }
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
    snprintf(l->what, sizeof l->what, "any spline %u", n);
}

TEST(the_conditions_hold_of_any_spline)
{
    int held = 0, solved = 0;
    for (unsigned n = 0; n < 240; n++) {
        struct layout l;
        make_any(&l, n);
        const wiggly_status status = wiggly_solve(solver, &l.desc, &curve);
        if (status == WIGGLY_CALMED || status == WIGGLY_LEVELLED) continue;
        if (status != WIGGLY_OK) fail_msg("%s: %s", l.what, wiggly_status_text(status));
        check_conditions(&l);
        solved++;
        held += solver->limits.solves > 0;
    }
    print_message("%d solved as asked, %d of them held\n", solved, held);
    assert_true(solved > 200 && held > 110);
}

/// 200 layouts of 240 samples: within 1e-9, in few solves.
TEST(few_solves_are_enough)
{
    int rounds[LAYOUTS];
    double before = 0, after = 0;
    for (unsigned n = 0; n < LAYOUTS; n++) {
        struct layout l;
        make_layout(&l, n, WIGGLY_COMPLEX, 240, 1.0 / 24);
        solve(&l);
        before = fmax(before, largest_total(&l));
        limit(&l, 1.15);
        solve(&l);
        after = fmax(after, largest_total(&l));
        rounds[n] = 1 + solver->limits.solves;
        if (n % 10 == 0) check_conditions(&l);
    }
    qsort(rounds, LAYOUTS, sizeof *rounds, compare);
    print_message("overshoot %.2f to %.2f of the largest knot; solves: median %d, p99 %d, most %d\n", before, after,
                  rounds[LAYOUTS / 2], rounds[LAYOUTS * 99 / 100], rounds[LAYOUTS - 1]);
    assert_true(before > 2 && after <= 1.15 * (1 + 1e-12));
    assert_true(rounds[LAYOUTS / 2] <= 4);
}

/// An equilibrium that swings far beyond the limits, of every start, mode and filter: most of 240 samples are held.
TEST(few_solves_are_enough_where_most_are_held)
{
    enum { EACH = 20, COUNT = 18 * EACH };
    int rounds[COUNT], most_held = 0;
    for (int n = 0; n < COUNT; n++) {
        struct layout l;
        make_layout(&l, (unsigned)n, (wiggly_mode)(n % 3), 240, 1.0 / 24);
        vary(&l, n / 3 % 3, n / 9 % 2, MOVING);
        limit(&l, 0.3);
        for (int i = 0; i < 240; i++) track[i] = l.largest * sin((0.015 + 0.0001 * n) * i);
        for (int k = 0; k < l.desc.knot_count; k++) l.knots[k].value *= 0.25;
        solve(&l);
        int held = 0;
        for (int i = 0; i < 240; i++) held += abs(solver->limits.held[i]) == 1;
        most_held += held > 110;
        rounds[n] = 1 + solver->limits.solves;
    }
    qsort(rounds, COUNT, sizeof *rounds, compare);
    print_message("%d of %d with most samples held; solves: median %d, p99 %d, most %d\n", most_held, COUNT,
                  rounds[COUNT / 2], rounds[COUNT * 99 / 100], rounds[COUNT - 1]);
    assert_true(most_held > COUNT / 3);
    assert_true(rounds[COUNT / 2] <= 4 && rounds[COUNT * 99 / 100] <= 30);
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
    desc.high = 0.01, desc.low = -0.01, desc.has_low = desc.has_high = true;
    assert_int_equal(wiggly_create(LONG, LONG, &large), WIGGLY_OK);
    assert_int_equal(wiggly_solve(large, &desc, &within), WIGGLY_INEXACT);
    for (int i = 0; i < LONG; i++) assert_true(now[i] >= desc.low && now[i] <= desc.high);
    wiggly_destroy(large);
}

/// An equilibrium far beyond the limits holds nearly all, the sample right behind the last knot too; in the last of these layouts
/// with others before and behind it.
TEST(what_is_right_behind_the_last_knot_is_held)
{
    static const double parts[] = {0.8, 1, 1 - 1e-12, 1 - 1e-6};
    int held = 0;
    for (unsigned n = 219; n < 259; n++) {
        struct layout l;
        make_layout(&l, n + 5000, WIGGLY_COMPLEX, 121, 1.0 / 12);
        vary(&l, (int)n % 2, 0, MOVING);
        limit(&l, 0.3);
        for (int i = 0; i < l.desc.samples; i++) track[i] = l.largest * sin((0.03 + 0.0001 * n) * i);
        if (l.desc.start == WIGGLY_FREE) l.knots[0].sample = 0;
        for (int k = 0; k < l.desc.knot_count; k++) l.knots[k].value *= 0.3 * parts[n / 2 % 4];
        solve(&l);
        snprintf(l.what, sizeof l.what, "layout %u", n);
        held += solver->limits.held[l.knots[l.desc.knot_count - 1].sample + 1] != 0;
        check_conditions(&l);
    }
    print_message("held behind the last knot: %d\n", held);
    assert_true(held > 0);
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
