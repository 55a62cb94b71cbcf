/// Seeded problems meant to be hard on the solver, judged by the textbook (adversary.h), and those that it once got wrong. tools/adversary.c
/// tries as many as you like.
#include "near.h"

#include "adversary.h"

static struct adversary_problem problem;

/// How many problems went how.
struct tally {
    int faults, needless, inexact, other; ///< other: said to be something else than solved
};

static void judge(wiggly_solver *solver, const char *what, int which, struct tally *tally)
{
    struct adversary_verdict v;
    adversary_judge(solver, &problem, &v);
    tally->inexact += v.said == WIGGLY_INEXACT;
    tally->other += v.said != WIGGLY_OK;
    tally->needless += v.fault && v.needless;
    if (!v.fault || v.needless) return;
    char name[80];
    snprintf(name, sizeof name, "%s %d", what, which);
    tally->faults++;
    adversary_explain(stderr, name, &v);
    adversary_print(stderr, &problem);
}

/// A complaint about what is easy is no more than a nuisance: of a kind one in fifty may have it, of poles that alias to one, which are all
/// but singular, three; of all together one in a hundred (make adversary).
TEST(problems_of_every_kind)
{
    static const struct {
        const char *what;
        adversary_kind kind;
        int problems;
    } rows[] = {
        {"filters", ADVERSARY_FILTER, 800},
        {"oscillators", ADVERSARY_OSCILLATOR, 800},
        {"three adjacent knots", ADVERSARY_ADJACENT, 400},
        {"knots at half periods", ADVERSARY_NODAL, 500},
        {"fast poles", ADVERSARY_NYQUIST, 300},
        {"tracks from 0", ADVERSARY_FROM_ZERO, 300},
        {"slow loops", ADVERSARY_SLOW, 150},
        {"undamped chains", ADVERSARY_CHAIN, 20},
        {"long splines", ADVERSARY_LONG, 20},
        {"damping near 1", ADVERSARY_CRITICAL, 80},
        {"frequencies that alias", ADVERSARY_ALIAS, 80},
        {"frequencies that jump", ADVERSARY_JUMPS, 80},
        {"slopes on the last sample", ADVERSARY_LAST, 80},
        {"any stiffness", ADVERSARY_STIFF, 80},
        {"loops in resonance", ADVERSARY_RESONANT, 80},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const int problems = quick_or_all(rows[r].problems / 8, 2 * rows[r].problems);
        struct tally tally = {0};
        for (int seed = 0; seed < problems; seed++) {
            adversary_make(&problem, rows[r].kind, (uint64_t)seed);
            if (seed % 4 == 3) adversary_hold(&problem, (uint64_t)seed);
            judge(*state, rows[r].what, seed, &tally);
        }
        const int most = (rows[r].kind == ADVERSARY_ALIAS ? 3 : 1) * problems / 50;
        if (tally.faults || tally.needless > 1 + most)
            fail_msg("%s: %d of %d problems are wrong, %d called INEXACT needlessly", rows[r].what, tally.faults,
                     problems, tally.needless);
    }
}

/// What make adversary once found wrong in silence, or inexact without need: its seed and number.
TEST(found_before)
{
    static const struct {
        uint64_t seed, number;
    } found[] = {
        {302, 958},     // a loop whose damping falls from 7.7 to 0: of the light jets the squared matrix kept nothing
        {77001, 55105}, // no damping or calm, knots at half periods: the band had no digit left, the chain hardly one
        {21, 7748},     // a wind-up over frequencies that jump: a variance lost its digits, and with it the pushes
        {23, 6116},     // the same, and the variance was nothing but rounding
        {24, 19482},    // a loop in resonance that winds up: a phase of 1 was rounded like a response of a million
        {29, 18769},    // a response of 1e17 left nothing of the curve, and a curve of nothing had no error
        {28, 14307},    // a loop overdamped a hundred million times: the pull of a step was lost beside its brake
        {11, 5950},     // a slope whose poles alias to one: its row misses all that a speed adds to the aliased part
        {21, 10954},    // a loop of 70 microhertz: at its seam the gradient's differences were lost beside the jets
        {21, 186},      // a loop in resonance: the errors of u and w were added although w takes u's back
        {21, 492},      // the same without a phase
        {21, 1674},     // the same, not in a loop
    };
    struct tally tally = {0};
    for (size_t i = 0; i < sizeof found / sizeof *found; i++) {
        adversary_make_nth(&problem, found[i].seed, found[i].number);
        judge(*state, "found before", (int)i, &tally);
    }
    assert_int_equal(tally.faults + tally.needless, 0);
}

// --- scenes ----------------------------------------------------------------------------------------------------------

static wiggly_desc *const desc = &problem.desc;

/// An empty problem of so many samples.
static void begin(double fps, int samples, wiggly_mode mode, wiggly_start start)
{
    problem.fps = fps;
    problem.tracks_used = 0;
    *desc = wiggly_default_desc();
    desc->samples = samples, desc->step = 1 / fps;
    desc->mode = mode, desc->start = start;
    desc->knots = problem.knots;
}

static wiggly_knot *add_knot(int sample, double value)
{
    problem.knots[desc->knot_count] = (wiggly_knot){.sample = sample, .value = value, .stiffness = 1000};
    return &problem.knots[desc->knot_count++];
}

static void add_slope(int sample, double value, double slope)
{
    wiggly_knot *knot = add_knot(sample, value);
    knot->has_slope = true, knot->slope = slope;
}

static double *track_of(wiggly_param *param, const double *values)
{
    double *track = problem.tracks[problem.tracks_used++];
    for (int i = 0; values && i < desc->samples; i++) track[i] = values[i];
    param->track = track;
    return track;
}

/// All totals are 0, so there is nothing that an error could be a part of: two knots at 0 on no equilibrium, and every sample a knot at 0
/// on one that is elsewhere.
static void make_nothing(int n)
{
    const bool everywhere = n >= 18;
    begin(24, 20, (wiggly_mode)(n % 3), (wiggly_start)(n / 3 % 3));
    desc->passive = (wiggly_passive)(n / 9 % 2);
    desc->frequency.value = 1, desc->damping.value = 0.1;
    if (everywhere) desc->equilibrium.value = 0.3;
    for (int i = everywhere ? 0 : 5; i < 19; i += everywhere ? 1 : 7)
        i == 5 ? add_slope(i, 0, 0) : (void)add_knot(i, 0);
}

/// The poles fade by e⁻⁸⁰ a sample, and jets there weigh e⁸⁰ times as much: b and the weights need all their digits.
static void make_overdamped_loop(int n)
{
    static const double fast[][7] = {{0, 0, 39, 39, 39, 39, 0}, {39, 39, 0, 0, 0, 39, 39}};
    begin(120, 7, WIGGLY_REAL, WIGGLY_LOOP);
    track_of(&desc->frequency, fast[n % 2]);
    desc->damping.value = 1 + 0.7 * (n / 2);
    add_slope(4, -1.24, 6.5);
    add_knot(5, 0);
    add_knot(0, 0.4585);
}

/// Swing that costs next to nothing is held by the imaginary rows alone, and its bound may be too wide.
static void make_cheap_start(int n)
{
    const bool is_long = n % 2, filters = n / 2 % 2;
    begin(is_long ? 12 : 25, is_long ? 192 : 34, WIGGLY_COMPLEX, WIGGLY_FREE);
    desc->calm = 7.3 * pow(10, -10 - 2 * (n / 4));
    desc->passive = filters ? WIGGLY_FILTER : WIGGLY_OSCILLATOR;
    desc->frequency.value = is_long ? 0.888 : filters ? 23.7 : 11;
    desc->damping.value = is_long ? 0.3 : 0.01;
    desc->bandwidth.value = 0;
    add_knot(is_long ? 77 : 16, 1);
    if (is_long) add_knot(191, 2);
}

/// A friction without a spring: what it loses in speed comes back from the equilibrium, and its circle closes.
static void make_loop_without_spring(int n)
{
    static const double y[] = {0, 1, 2, 1, 0, -1, -1, 0}, frictions[] = {0.02, 2, 50};
    begin(24, 8, WIGGLY_REAL, WIGGLY_LOOP);
    wiggly_from_spring(0, frictions[n], &desc->frequency.value, &desc->damping.value);
    track_of(&desc->equilibrium, y);
    add_knot(2, 1);
}

/// A frequency that varies twice a swing pumps it up: run forward, what rounds at the seam is a million times as large at the end.
static void make_growing_loop(int n)
{
    begin(24, 241, n % 2 ? WIGGLY_REAL : WIGGLY_COMPLEX, WIGGLY_LOOP);
    desc->calm = n < 4 ? 1e-4 : 1;
    double *frequency = track_of(&desc->frequency, NULL), *y = track_of(&desc->equilibrium, NULL);
    for (int i = 0; i < 241; i++) {
        const double turn = 2 * 3.14159265358979323846 * i / 24;
        frequency[i] = fmax(0, 1 + (0.1 + 0.1 * n) * sin(2 * turn));
        y[i] = 1000 * sin(0.7 * turn) + 300 * cos(turn);
    }
    add_knot(20, 1000);
    add_knot(131, -400);
}

/// Two poles that the sample rate makes one: a speed between samples would have an infinite coefficient, and what its limit costs is told.
static void make_alias(int n)
{
    begin(30, 27, n / 3 % 2 ? WIGGLY_REAL : WIGGLY_COMPLEX, n / 6 % 2 ? WIGGLY_REST : WIGGLY_FREE);
    desc->frequency.value = (n / 12 % 2 ? 30 : 15) * (1 - (const double[]){0, 1e-12, 1e-9}[n % 3]);
    desc->bandwidth.value = 1;
    desc->calm = n / 24 % 2 ? 1e-3 : 1;
    add_knot(7, -0.2952921474333854);
    add_slope(14, 1.2555603111723084, 1.88);
    if (n / 48) problem.knots[1].stiffness = 5.6e-8;
    n % 2 ? add_slope(24, -2.21, -1) : (void)add_knot(24, -2.21);
    add_knot(17, -1.05);
}

/// A frequency that jumps from 0, overdamped: some jets weigh a hundred times as much as others, and the light ones lose digits in the square.
static void make_jump(int n)
{
    begin(12, 85, WIGGLY_REAL, WIGGLY_FREE);
    double *frequency = track_of(&desc->frequency, NULL), *damping = track_of(&desc->damping, NULL);
    for (int i = 0; i < 85; i++) {
        frequency[i] = i < 56 ? 0 : 0.559;
        damping[i] = i < 70 ? 8 + 0.3 * n + 6 * sin(7.3 * i) : fmax(0, 8 * sin(n + 0.7 * i));
    }
    add_knot(0, 0)->still = true;
    add_knot(18, -0.04);
}

/// A slope is that of the total: at an end of the domain, and where y begins to move, what y adds to it is one-sided.
static void make_slope_on_moving(int n)
{
    static const double y[] = {0.5, 2, -1, 0.3, 0.9, -0.7, 0.2, 1.5, 0.1, -2, 0.4, 0.5};
    begin(24, 12, (wiggly_mode)(n % 3), (wiggly_start)(n / 3 % 3));
    desc->passive = (wiggly_passive)(n / 9 % 2);
    desc->frequency.value = 3, desc->damping.value = 0.1;
    track_of(&desc->equilibrium, y);
    add_slope(n / 18 % 2 ? 3 : 0, 1, 20);
    add_knot(5, -1);
    add_slope((n / 36 ? 10 : 8) + (desc->start != WIGGLY_LOOP), 0.5, -30);
}

/// Of two samples, the earliest knot's: of the oscillator its total, of the filter its x.
static void make_short_cubic(int n)
{
    static const double y[] = {0.5, 0.5, -3};
    begin(24, 3, WIGGLY_CUBIC, n / 2 ? WIGGLY_LOOP : WIGGLY_FREE);
    desc->passive = (wiggly_passive)(n % 2);
    track_of(&desc->equilibrium, y);
    add_knot(1, 7);
}

TEST(scenes_meant_to_be_hard)
{
    enum { NEEDLESS = 1, SOLVED = 2, TOLD = 4 }; // it may complain; all are solved; some are told to be inexact
    static const struct {
        const char *what;
        void (*make)(int n);
        int count, more;
    } rows[] = {
        {"nothing at all", make_nothing, 36, 0},
        {"an overdamped loop from frequency 0", make_overdamped_loop, 70, 0},
        {"a start that costs next to nothing", make_cheap_start, 24, NEEDLESS},
        {"a loop without a spring", make_loop_without_spring, 3, SOLVED},
        {"a loop whose swing grows", make_growing_loop, 8, SOLVED},
        {"poles that alias to one", make_alias, 96, NEEDLESS | TOLD},
        {"a jump from frequency 0", make_jump, 40, 0},
        {"a slope on a moving equilibrium", make_slope_on_moving, 72, 0},
        {"two samples of a cubic", make_short_cubic, 4, 0},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct tally tally = {0};
        for (int n = 0; n < rows[r].count; n++) {
            rows[r].make(n);
            judge(*state, rows[r].what, n, &tally);
        }
        if (tally.faults || (tally.needless && !(rows[r].more & NEEDLESS)) ||
            (tally.other && rows[r].more & SOLVED) || (!tally.inexact && rows[r].more & TOLD))
            fail_msg("%s: %d are wrong, %d complain needlessly, %d are inexact, %d not solved", rows[r].what,
                     tally.faults, tally.needless, tally.inexact, tally.other);
    }
}

static int create(void **state) { return (int)wiggly_create(ADVERSARY_MAX, ADVERSARY_MAX, (wiggly_solver **)state); }

static int destroy(void **state)
{
    wiggly_destroy(*state);
    return 0;
}

TESTS_BETWEEN(create, destroy)
