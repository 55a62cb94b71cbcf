/// What moves by itself, of both kinds. The figures in docs/corrections.md are those of the solver; the oscillator is what a damped spring does;
/// and more samples a second change its motion less and less: with every doubling of the rate a quarter as much, whatever is keyed, followed or
/// tracked.
#include "near.h"

#include "base/file.h"
#include "curve.h"

enum { MOST = 4096, FRAMES = 96, FPS = 24 };

static const double turn = 6.283185307179586;
static double tracks[2][MOST];

SHARED_SOLVER_AND_CURVE(MOST, 5)

typedef double function_of_time(double seconds);

/// So many seconds, of so many samples a frame.
static wiggly_desc describe(wiggly_passive passive, double seconds, int substeps)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.passive = passive;
    desc.samples = (int)lround(seconds * FPS) * substeps + 1, desc.step = 1.0 / (FPS * substeps);
    desc.frequency.value = 1, desc.damping.value = 0.1;
    return desc;
}

static void follow(wiggly_desc *desc, wiggly_param *param, function_of_time *function)
{
    double *track = tracks[param == &desc->equilibrium];
    for (int i = 0; i < desc->samples; i++) track[i] = function(i * desc->step);
    param->track = track;
}

/// The largest total.
static double solve(const wiggly_desc *desc, const char *what)
{
    double largest = 0;
    const wiggly_status status = wiggly_solve(solver, desc, &curve);
    if (status != WIGGLY_OK) fail_msg("%s, mode %d: %s", what, desc->mode, wiggly_status_text(status));
    for (int i = 0; i < desc->samples; i++) largest = fmax(largest, fabs(curve.total[i]));
    return largest;
}

// --- figures of docs/corrections.md ----------------------------------------------------------------------------------

/// Fails unless docs/corrections.md has the row: what it says first, and what the filter and the oscillator make of it.
static void assert_row(const char *first, const char *filter, const char *oscillator)
{
    char *text, row[256], dash[256];
    size_t size, at = 0;
    assert_done(file_read("docs/corrections.md", 1 << 20, &text, &size, &error));
    snprintf(row, sizeof row, " | %s | %s |", filter, oscillator);
    for (const char *c = row; *c; c++)
        at += (size_t)snprintf(dash + at, sizeof dash - at, *c == '-' ? "−" : "%c", *c);
    const char *line = strstr(text, first), *found = line ? strstr(line, dash) : NULL;
    if (!found || found > strchr(line, '\n')) fail_msg("docs/corrections.md has no row “%s … %s”", first, dash);
    free(text);
}

/// Five plausible knots, and the turning points behind the last one. With the filter the swing grows; an oscillator's dies away by e^{−ζωt}
/// from turning point to turning point.
TEST(the_swing_dies_away)
{
    static const wiggly_knot knots[] = {{.sample = 0, .value = 0},
                                        {.sample = 8, .value = 0},
                                        {.sample = 14, .value = 0.8},
                                        {.sample = 22, .value = -0.735},
                                        {.sample = 30, .value = 0.802}};
    char text[2][64];
    double extrema[2][5];
    for (int passive = 0; passive < 2; passive++) {
        wiggly_desc desc = describe((wiggly_passive)passive, 5, 1);
        size_t at = 0;
        int count = 0;
        desc.knots = knots, desc.knot_count = 5;
        solve(&desc, "five knots");
        for (const double *x = curve.total + 31; x < curve.total + 120 && count < 5; x++) {
            if ((x[0] - x[-1]) * (x[1] - x[0]) > 0) continue;
            at += (size_t)snprintf(text[passive] + at, sizeof text[0] - at, count ? " %.2f" : "%.2f", x[0]);
            extrema[passive][count++] = x[0];
        }
        assert_int_equal(count, 5);
    }
    assert_row("turning points after the knots", text[WIGGLY_FILTER], text[WIGGLY_OSCILLATOR]);
    const double *x = extrema[WIGGLY_OSCILLATOR];
    for (int i = 1; i < 5; i++) assert_near(-x[i] / x[i - 1], exp(-0.1 * turn / 2), 0.02);
    assert_true(fabs(extrema[WIGGLY_FILTER][2]) > fabs(extrema[WIGGLY_FILTER][0]));
}

/// From 0 to 1 in 20 frames from frame 40 on, as smoothly as a cubic does it.
static double step_at(double t)
{
    const double u = fmin(fmax((FPS * t - 40) / 20, 0), 1);
    return u * u * (3 - 2 * u);
}

/// The largest total as the equilibrium steps aside.
static double peak_of_step(wiggly_passive passive, int substeps)
{
    wiggly_desc desc = describe(passive, 152.0 / FPS, substeps);
    desc.frequency.value = 1.2, desc.damping.value = 0.08;
    desc.start = WIGGLY_REST;
    follow(&desc, &desc.equilibrium, step_at);
    return solve(&desc, "a step");
}

/// The same of x'' + 2ζω x' + ω² x = −y'', by a fourth-order Runge-Kutta method for v = total' on a fine grid.
static double peak_of_differential_equation(void)
{
    const double omega = 1.2 * turn, zeta = 0.08, h = 1e-4;
    double total = 0, v = 0, largest = 0;
    for (int i = 0; i < 60000; i++) {
        double k[4][2];
        for (int stage = 0; stage < 4; stage++) {
            const double ahead = stage == 3 ? h : h / 2, t = i * h + (stage ? ahead : 0);
            const double at = total + (stage ? ahead * k[stage - 1][0] : 0),
                         speed = v + (stage ? ahead * k[stage - 1][1] : 0);
            const double slope = (step_at(t + 1e-4 / FPS) - step_at(t - 1e-4 / FPS)) / 2e-4 * FPS;
            k[stage][0] = speed;
            k[stage][1] = -2 * zeta * omega * (speed - slope) - omega * omega * (at - step_at(t));
        }
        total += h / 6 * (k[0][0] + 2 * k[1][0] + 2 * k[2][0] + k[3][0]);
        v += h / 6 * (k[0][1] + 2 * k[1][1] + 2 * k[2][1] + k[3][1]);
        largest = fmax(largest, total);
    }
    return largest;
}

TEST(an_equilibrium_that_moves)
{
    char text[2][64];
    const double exact = peak_of_differential_equation(), coarse = peak_of_step(WIGGLY_OSCILLATOR, 1);
    snprintf(text[0], sizeof text[0], "%.2f", peak_of_step(WIGGLY_FILTER, 1));
    snprintf(text[1], sizeof text[1], "%.2f", coarse);
    assert_row("largest total as y goes from 0 to 1", text[0], text[1]);
    assert_near(coarse, exact, 4e-3);
    assert_near(peak_of_step(WIGGLY_OSCILLATOR, 8), exact, 1e-4);
}

/// To 5 Hz in 240 frames.
static double rising(double t) { return t / 2; }

TEST(a_frequency_that_rises_from_zero)
{
    static const wiggly_knot knots[] = {{.sample = 0, .value = 0.5, .has_slope = true, .slope = 0, .stiffness = 1000},
                                        {.sample = 20, .value = 1},
                                        {.sample = 60, .value = 0}};
    char text[2][64];
    for (int passive = 0; passive < 2; passive++) {
        wiggly_desc desc = describe((wiggly_passive)passive, 10, 1);
        desc.knots = knots, desc.knot_count = 3;
        follow(&desc, &desc.frequency, rising);
        snprintf(text[passive], sizeof text[0], "%.1f", solve(&desc, "a frequency from 0"));
    }
    assert_row("largest total where the frequency rises", text[WIGGLY_FILTER], text[WIGGLY_OSCILLATOR]);
}

// --- from rate to rate -----------------------------------------------------------------------------------------------

enum { KNOTS = 3, LEVELS = 4 };

/// The same knots, in seconds, at so many samples a frame: the total at every frame, and Im x behind it.
static void solve_at(wiggly_desc desc, const wiggly_knot *knots, function_of_time *equilibrium,
                     function_of_time *frequency, const char *what, double at_frames[2][FRAMES + 1])
{
    const int substeps = (desc.samples - 1) / FRAMES;
    wiggly_knot placed[KNOTS];
    for (int k = 0; k < KNOTS; k++) placed[k] = knots[k], placed[k].sample *= substeps;
    desc.knots = placed, desc.knot_count = KNOTS;
    if (equilibrium) follow(&desc, &desc.equilibrium, equilibrium);
    if (frequency) follow(&desc, &desc.frequency, frequency);
    solve(&desc, what);
    for (int i = 0; i <= FRAMES; i++)
        at_frames[0][i] = curve.total[i * substeps], at_frames[1][i] = curve.im[i * substeps];
}

static double change_of(double a[2][FRAMES + 1], double b[2][FRAMES + 1], int parts)
{
    double change = 0;
    for (int part = 0; part < parts; part++) {
        for (int i = 0; i <= FRAMES; i++) change = fmax(change, fabs(a[part][i] - b[part][i]));
    }
    return change;
}

/// How far a real spline with three keyed slopes is from itself at twice the rate, of its range.
TEST(slopes_at_twice_the_rate)
{
    static const wiggly_knot knots[KNOTS] = {
        {.sample = 0},
        {.sample = 30, .value = 1, .has_slope = true, .slope = -3, .stiffness = 1000},
        {.sample = 70, .value = 0.2, .has_slope = true, .slope = 1, .stiffness = 1000}};
    char text[2][64];
    double change[2][2];
    for (int n = 0; n < 4; n++) {
        const int passive = n / 2, is_fine = n % 2;
        double at[2][2][FRAMES + 1], low = 0, high = 0;
        for (int twice = 0; twice < 2; twice++) {
            wiggly_desc desc = describe((wiggly_passive)passive, FRAMES / FPS, (is_fine ? 4 : 1) << twice);
            desc.mode = WIGGLY_REAL;
            solve_at(desc, knots, NULL, NULL, "slopes", at[twice]);
        }
        for (int i = 0; i <= FRAMES; i++) low = fmin(low, at[1][0][i]), high = fmax(high, at[1][0][i]);
        change[passive][is_fine] = change_of(at[0], at[1], 1) / (high - low);
    }
    for (int passive = 0; passive < 2; passive++)
        snprintf(text[passive], sizeof text[0], "%.1f %%", 100 * change[passive][0]);
    assert_row("change of a real spline with slopes", text[WIGGLY_FILTER], text[WIGGLY_OSCILLATOR]);
    assert_true(change[WIGGLY_OSCILLATOR][1] < 0.08 * change[WIGGLY_OSCILLATOR][0]); // as h²
    assert_true(change[WIGGLY_FILTER][1] > 0.2 * change[WIGGLY_FILTER][0]);          // as h
}

/// From 0 to 1 in three seconds, then still.
static double ease(double t)
{
    const double u = fmin(t / 3, 1);
    return u * u * u * (10 + u * (-15 + 6 * u));
}

static double round_trip(double t) { return 0.5 * sin(turn * t / 4) + 0.3 * cos(turn * t / 2); }
static double from_zero(double t) { return 1.25 * t; }
static double up_and_down(double t) { return 1.5 + 0.8 * sin(turn * t / 4); }

/// Samples, values and slopes of the knots; frames.
struct keys {
    int at[KNOTS];
    double value[KNOTS], slope[KNOTS];
};
static const struct keys plain = {{8, 38, 70}, {0.5, 1, 0}, {NAN, NAN, NAN}},
                         sloped = {{8, 38, 70}, {0.5, 1, 0}, {NAN, -1, NAN}},
                         early = {{0, 38, 70}, {0.5, 1, 0}, {NAN, NAN, NAN}},
                         late = {{8, 38, 96}, {0.5, 1, 0}, {NAN, NAN, NAN}},
                         first = {{8, 38, 70}, {0.5, 1, 0}, {2, NAN, NAN}},
                         last = {{8, 38, 70}, {0.5, 1, 0}, {NAN, NAN, -1}},
                         end = {{8, 38, 96}, {0.5, 1, 0}, {NAN, NAN, 1}};

/// What the paper's filter makes of the case, which is why the oscillator is there.
enum by_filter {
    AS_WELL, ///< a quarter, too, or nothing that changes
    SLOWER,  ///< the error shrinks with the step, not with its square
};

enum { COMPLEX = 1 << WIGGLY_COMPLEX, REAL = 1 << WIGGLY_REAL };

static const struct convergence {
    const char *name;
    wiggly_start start;
    const struct keys *keys;
    function_of_time *equilibrium, *frequency;
    enum by_filter by_filter;
    int halves; ///< modes of which a doubling only halves the change
} cases[] = {
    {"knots", WIGGLY_FREE, &plain, NULL, NULL, AS_WELL, 0},
    {"a knot on the last sample", WIGGLY_FREE, &late, NULL, NULL, AS_WELL, 0},
    {"a slope", WIGGLY_FREE, &sloped, NULL, NULL, SLOWER, 0},
    {"a slope on the last knot", WIGGLY_FREE, &last, NULL, NULL, SLOWER, 0},
    {"a slope on the last sample", WIGGLY_FREE, &end, NULL, NULL, SLOWER, 0},
    {"a slope on the first knot of a free start", WIGGLY_FREE, &first, NULL, NULL, SLOWER, COMPLEX | REAL},
    {"a frequency up and down", WIGGLY_FREE, &plain, NULL, up_and_down, AS_WELL, 0},
    {"a frequency from 0", WIGGLY_FREE, &plain, NULL, from_zero, AS_WELL, 0},
    {"a frequency from 0 on the first knot", WIGGLY_FREE, &early, NULL, from_zero, AS_WELL, COMPLEX},
    {"a moving equilibrium", WIGGLY_FREE, &plain, ease, NULL, AS_WELL, 0},
    {"a moving equilibrium and a slope", WIGGLY_FREE, &sloped, ease, NULL, SLOWER, 0},
    {"rest", WIGGLY_REST, &plain, NULL, NULL, SLOWER, 0},
    {"rest and a moving equilibrium", WIGGLY_REST, &plain, ease, NULL, SLOWER, 0},
    {"rest, a slope and a frequency from 0", WIGGLY_REST, &sloped, NULL, from_zero, SLOWER, 0},
    {"a loop", WIGGLY_LOOP, &plain, NULL, NULL, AS_WELL, 0},
    {"a loop with a slope", WIGGLY_LOOP, &sloped, NULL, NULL, SLOWER, 0},
    {"a loop of a moving equilibrium", WIGGLY_LOOP, &plain, round_trip, NULL, AS_WELL, 0},
    {"a loop of everything", WIGGLY_LOOP, &sloped, round_trip, up_and_down, SLOWER, 0},
};

/// Largest changes from each rate to the next, from 24 to 192 samples a second.
static void measure(const struct convergence *c, wiggly_mode mode, wiggly_passive passive, double change[LEVELS - 1])
{
    double at[LEVELS][2][FRAMES + 1];
    wiggly_knot knots[KNOTS];
    for (int k = 0; k < KNOTS; k++) {
        const double slope = c->keys->slope[k];
        knots[k] = (wiggly_knot){.sample = c->keys->at[k], .value = c->keys->value[k]};
        if (!isnan(slope)) knots[k].has_slope = true, knots[k].slope = slope, knots[k].stiffness = 1000;
    }
    for (int level = 0; level < LEVELS; level++) {
        wiggly_desc desc = describe(passive, FRAMES / FPS, 1 << level);
        desc.mode = mode, desc.start = c->start;
        solve_at(desc, knots, c->equilibrium, c->frequency, c->name, at[level]);
        if (level > 0) change[level - 1] = change_of(at[level - 1], at[level], 2);
    }
}

/// Whether the paper's filter is slower: where slopes and rest are asked for; and a complex spline's two poles let a moving equilibrium, and a
/// frequency on its way, in at the first order.
static bool is_slower_by_filter(const struct convergence *c, wiggly_mode mode)
{
    return c->by_filter == SLOWER ||
           (mode == WIGGLY_COMPLEX && (c->equilibrium || c->frequency) && c->start != WIGGLY_LOOP);
}

/// Measured: 3.93 … 4.70 for a quarter, 1.92 … 2.04 for a half.
TEST(every_doubling_of_the_rate_quarters_the_change_and_the_papers_filter_is_slower)
{
    for (size_t n = 0; n < 3 * sizeof cases / sizeof *cases; n++) {
        const struct convergence *c = &cases[n / 3];
        const wiggly_mode mode = (wiggly_mode)(n % 3);
        const double wanted = c->halves >> mode & 1 ? 1.8 : 3.7;
        double change[LEVELS - 1];
        measure(c, mode, WIGGLY_OSCILLATOR, change);
        for (int level = 0; level < LEVELS - 2; level++) {
            const double ratio = change[level] / change[level + 1];
            if (!(ratio >= wanted))
                fail_msg("%s, mode %d, from %d to %d substeps: the change shrinks by %.2f, not %.2f", c->name, mode,
                         2 << level, 4 << level, ratio, wanted);
        }
        if (!is_slower_by_filter(c, mode)) continue;
        measure(c, mode, WIGGLY_FILTER, change);
        const double ratio = change[LEVELS - 3] / change[LEVELS - 2];
        if (!(ratio < 2.8)) fail_msg("%s, mode %d, the filter: the change shrinks by %.2f", c->name, mode, ratio);
    }
}

TESTS_BETWEEN(set_up, tear_down)
