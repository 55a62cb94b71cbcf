/// Seeded problems meant to be hard on the solver, judged by the textbook (adversary.h), and those that it once got wrong. tools/adversary.c
/// tries as many as you like.
#include "near.h"

#include "adversary.h"

static struct adversary_problem problem;

static void tell(const char *name, const struct adversary_verdict *v)
{
    adversary_explain(stderr, name, v);
    adversary_print(stderr, &problem);
}

static bool stands(wiggly_solver *solver, const char *name)
{
    struct adversary_verdict v;
    adversary_judge(solver, &problem, &v);
    if (v.fault) tell(name, &v);
    return !v.fault;
}

/// A complaint about what is easy is no more than a nuisance: of the worst kind one in fifty may have it, of all together one in a
/// hundred (make adversary).
static void try_many(wiggly_solver *solver, adversary_kind kind, int problems)
{
    int faults = 0, needless = 0;
    problems = quick_or_all(problems / 8, 2 * problems);
    for (int seed = 0; seed < problems; seed++) {
        char name[40];
        adversary_make(&problem, kind, (uint64_t)seed);
        if (seed % 4 == 3) adversary_hold(&problem, (uint64_t)seed);
        snprintf(name, sizeof name, "seed %d", seed);
        struct adversary_verdict v;
        adversary_judge(solver, &problem, &v);
        needless += v.fault && v.needless;
        faults += v.fault && !v.needless;
        if (v.fault && !v.needless) tell(name, &v);
    }
    if (faults) fail_msg("%d of %d problems", faults, problems);
    if (needless > 1 + problems / 50) fail_msg("%d of %d problems are called INEXACT needlessly", needless, problems);
}

TEST(filters) { try_many(*state, ADVERSARY_FILTER, 800); }

TEST(oscillators) { try_many(*state, ADVERSARY_OSCILLATOR, 800); }

TEST(three_adjacent_knots) { try_many(*state, ADVERSARY_ADJACENT, 400); }

TEST(knots_at_half_periods) { try_many(*state, ADVERSARY_NODAL, 500); }

TEST(fast_poles) { try_many(*state, ADVERSARY_NYQUIST, 300); }

TEST(tracks_from_zero) { try_many(*state, ADVERSARY_FROM_ZERO, 300); }

TEST(slow_loops) { try_many(*state, ADVERSARY_SLOW, 150); }

TEST(undamped_chains) { try_many(*state, ADVERSARY_CHAIN, 20); }

TEST(long_splines) { try_many(*state, ADVERSARY_LONG, 20); }

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
    for (size_t i = 0; i < sizeof found / sizeof *found; i++) {
        adversary_make_nth(&problem, found[i].seed, found[i].number);
        assert_true(stands(*state, "found before"));
    }
}

/// An empty problem of so many samples.
static wiggly_desc *begin(double fps, int samples)
{
    problem.fps = fps;
    problem.tracks_used = 0;
    problem.desc = wiggly_default_desc();
    problem.desc.samples = samples;
    problem.desc.step = 1 / fps;
    problem.desc.knots = problem.knots;
    return &problem.desc;
}

static void add_knot(int sample, double value)
{
    problem.knots[problem.desc.knot_count++] = (wiggly_knot){.sample = sample, .value = value, .stiffness = 1000};
}

static void set_slope(double slope)
{
    problem.knots[problem.desc.knot_count - 1].has_slope = true;
    problem.knots[problem.desc.knot_count - 1].slope = slope;
}

static wiggly_param track_of(const double *values, int count)
{
    double *track = problem.tracks[problem.tracks_used++];
    for (int i = 0; i < count; i++) track[i] = values[i];
    return (wiggly_param){.track = track};
}

/// All totals are 0, so there is nothing that an error could be a part of: two knots at 0 on no equilibrium, and every sample a knot at 0
/// on one that is elsewhere.
TEST(nothing_at_all_is_exact)
{
    bool all = true;
    for (int kind = 0; kind < 36; kind++) {
        wiggly_desc *desc = begin(24, 20);
        desc->mode = (wiggly_mode)(kind % 3);
        desc->start = (wiggly_start)(kind / 3 % 3);
        desc->passive = (wiggly_passive)(kind / 9 % 2);
        desc->frequency.value = 1;
        desc->damping.value = 0.1;
        bool everywhere = kind >= 18;
        if (everywhere) desc->equilibrium.value = 0.3;
        for (int i = everywhere ? 0 : 5; i < 19; i += everywhere ? 1 : 7) {
            add_knot(i, 0);
            if (i == 5) set_slope(0);
        }
        all = stands(*state, "all totals 0") && all;
    }
    assert_true(all);
}

/// The poles fade by e⁻⁸⁰ a sample, and jets there weigh e⁸⁰ times as much: b and the weights need all their digits.
TEST(overdamped_loops_from_frequency_0)
{
    static const double fast_in_the_middle[] = {0, 0, 39, 39, 39, 39, 0}, fast_at_first[] = {39, 39, 0, 0, 0, 39, 39};
    bool all = true;
    for (double damping = 1; damping < 25; damping += 0.7) {
        for (int at_first = 0; at_first < 2; at_first++) {
            wiggly_desc *desc = begin(120, 7);
            desc->mode = WIGGLY_REAL;
            desc->start = WIGGLY_LOOP;
            desc->frequency = track_of(at_first ? fast_at_first : fast_in_the_middle, 7);
            desc->damping.value = damping;
            add_knot(4, -1.24);
            set_slope(6.5);
            add_knot(5, 0);
            add_knot(0, 0.4585);
            all = stands(*state, "an overdamped loop") && all;
        }
    }
    assert_true(all);
}

/// Swing that costs next to nothing is held by the imaginary rows alone, and its bound may be too wide.
TEST(starts_that_cost_next_to_nothing)
{
    bool all = true;
    for (int exponent = 10; exponent <= 20; exponent += 2) {
        for (int kind = 0; kind < 4; kind++) {
            wiggly_desc *desc = begin(kind % 2 ? 12 : 25, kind % 2 ? 192 : 34);
            desc->calm = 7.3 * pow(10, -exponent);
            desc->passive = kind / 2 ? WIGGLY_FILTER : WIGGLY_OSCILLATOR;
            desc->frequency.value = kind % 2 ? 0.888 : kind / 2 ? 23.7 : 11;
            desc->damping.value = kind % 2 ? 0.3 : 0.01;
            desc->bandwidth.value = 0;
            add_knot(kind % 2 ? 77 : 16, 1);
            if (kind % 2) add_knot(191, 2);
            struct adversary_verdict v;
            adversary_judge(*state, &problem, &v);
            if (v.fault && !v.needless) tell("a start that costs next to nothing", &v), all = false;
        }
    }
    assert_true(all);
}

/// A friction without a spring: what it loses in speed comes back from the equilibrium, and its circle closes.
TEST(loops_without_a_spring)
{
    static const double y[] = {0, 1, 2, 1, 0, -1, -1, 0};
    for (int k = 0; k < 3; k++) {
        wiggly_desc *desc = begin(24, 8);
        desc->mode = WIGGLY_REAL;
        desc->start = WIGGLY_LOOP;
        wiggly_from_spring(0, (const double[]){0.02, 2, 50}[k], &desc->frequency.value, &desc->damping.value);
        desc->equilibrium = track_of(y, 8);
        add_knot(2, 1);
        struct adversary_verdict v;
        adversary_judge(*state, &problem, &v);
        assert_int_equal(v.said, WIGGLY_OK);
        assert_true(!v.fault);
    }
}

/// A frequency that varies twice a swing pumps it up: run forward, what rounds at the seam is a million times as large at the end.
TEST(loops_whose_swing_grows)
{
    enum { SAMPLES = 241 };
    double frequency[SAMPLES], y[SAMPLES];
    bool all = true;
    for (int n = 0; n < 8; n++) {
        const double depth = 0.1 + 0.1 * n;
        for (int i = 0; i < SAMPLES; i++) {
            const double turn = 2 * 3.14159265358979323846 * i / 24;
            frequency[i] = fmax(0, 1 + depth * sin(2 * turn)), y[i] = 1000 * sin(0.7 * turn) + 300 * cos(turn);
        }
        wiggly_desc *desc = begin(24, SAMPLES);
        desc->mode = n % 2 ? WIGGLY_REAL : WIGGLY_COMPLEX;
        desc->start = WIGGLY_LOOP;
        desc->calm = n < 4 ? 1e-4 : 1;
        desc->frequency = track_of(frequency, SAMPLES);
        desc->equilibrium = track_of(y, SAMPLES);
        add_knot(20, 1000);
        add_knot(131, -400);
        struct adversary_verdict v;
        adversary_judge(*state, &problem, &v);
        all = all && v.said == WIGGLY_OK && !v.fault;
        if (v.said != WIGGLY_OK || v.fault) tell("a growing loop", &v);
    }
    assert_true(all);
}

/// Two poles that the sample rate makes one: a speed between samples would have an infinite coefficient, and what its limit costs is told.
TEST(poles_that_alias_to_one)
{
    int inexact = 0;
    for (int n = 0; n < 96; n++) {
        wiggly_desc *desc = begin(30, 27);
        const double off = (const double[]){0, 1e-12, 1e-9}[n % 3];
        desc->mode = n / 3 % 2 ? WIGGLY_REAL : WIGGLY_COMPLEX;
        desc->start = (wiggly_start)(n / 6 % 2); // free, or from rest
        desc->frequency.value = (n / 12 % 2 ? 30 : 15) * (1 - off);
        desc->bandwidth.value = 1;
        desc->calm = n / 24 % 2 ? 1e-3 : 1;
        add_knot(7, -0.2952921474333854);
        add_knot(14, 1.2555603111723084);
        set_slope(1.88);
        if (n / 48) problem.knots[1].stiffness = 5.6e-8;
        add_knot(24, -2.21);
        if (n % 2) set_slope(-1);
        add_knot(17, -1.05);
        struct adversary_verdict v;
        adversary_judge(*state, &problem, &v);
        inexact += v.said == WIGGLY_INEXACT;
        if (v.fault && !v.needless) tell("poles that alias", &v);
        assert_true(!v.fault || v.needless);
    }
    assert_true(inexact > 0);
}

/// A frequency that jumps from 0, overdamped: some jets weigh a hundred times as much as others, and the light ones lose digits in the square.
TEST(jumps_from_frequency_0)
{
    enum { SAMPLES = 85 };
    double frequency[SAMPLES], damping[SAMPLES];
    bool all = true;
    for (int n = 0; n < 40; n++) {
        wiggly_desc *desc = begin(12, SAMPLES);
        for (int i = 0; i < SAMPLES; i++)
            frequency[i] = i < 56 ? 0 : 0.559,
            damping[i] = i < 70 ? 8 + 0.3 * n + 6 * sin(7.3 * i) : fmax(0, 8 * sin(n + 0.7 * i));
        desc->mode = WIGGLY_REAL;
        desc->frequency = track_of(frequency, SAMPLES);
        desc->damping = track_of(damping, SAMPLES);
        add_knot(0, 0);
        problem.knots[0].still = true;
        add_knot(18, -0.04);
        all = stands(*state, "a jump from frequency 0") && all;
    }
    assert_true(all);
}

/// A slope is that of the total: at an end of the domain, and where y begins to move, what y adds to it is one-sided.
TEST(slopes_beside_a_moving_equilibrium)
{
    static const double y[] = {0.5, 2, -1, 0.3, 0.9, -0.7, 0.2, 1.5, 0.1, -2, 0.4, 0.5};
    bool all = true;
    for (int kind = 0; kind < 3 * 3 * 2 * 4; kind++) {
        wiggly_desc *desc = begin(24, 12);
        desc->mode = (wiggly_mode)(kind % 3);
        desc->start = (wiggly_start)(kind / 3 % 3);
        desc->passive = (wiggly_passive)(kind / 9 % 2);
        desc->frequency.value = 3;
        desc->damping.value = 0.1;
        desc->equilibrium = track_of(y, 12);
        const int first = kind / 18 % 2 ? 3 : 0, last = kind / 36 ? 10 : 8;
        add_knot(first, 1);
        set_slope(20);
        add_knot(5, -1);
        add_knot(last + (desc->start != WIGGLY_LOOP), 0.5);
        set_slope(-30);
        all = stands(*state, "a slope beside a moving equilibrium") && all;
    }
    assert_true(all);
}

/// Of two samples, the earliest knot's: of the oscillator its total, of the filter its x.
TEST(two_samples_of_a_cubic)
{
    static const double y[] = {0.5, 0.5, -3};
    for (int kind = 0; kind < 4; kind++) {
        wiggly_desc *desc = begin(24, 3);
        desc->mode = WIGGLY_CUBIC;
        desc->passive = (wiggly_passive)(kind % 2);
        desc->start = kind / 2 ? WIGGLY_LOOP : WIGGLY_FREE;
        desc->equilibrium = track_of(y, 3);
        add_knot(1, 7);
        assert_true(stands(*state, "two samples of a cubic"));
    }
}

static int create(void **state) { return (int)wiggly_create(ADVERSARY_MAX, ADVERSARY_MAX, (wiggly_solver **)state); }

static int destroy(void **state)
{
    wiggly_destroy(*state);
    return 0;
}

TESTS_BETWEEN(create, destroy)
