/// Measures the feel of curves as a table: how far a curve moves when a knot moves by one frame, its overshoot, its motion before and after
/// the last knot, and Figure 4. For the paper's filter, the oscillator, poses, limits, wind-up and the cubic.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <wiggly/wiggly.h>

enum { SAMPLES = 121, MOST_KNOTS = 6, SETTINGS = 10, LAYOUTS = 200, RUNS = SETTINGS * LAYOUTS };
enum way { FILTER, OSCILLATOR, POSES, LIMITED, WOUND_UP, CUBIC, WAYS };

static const char *const names[] = {"filter", "oscillator", "poses", "limits", "wind-up", "cubic"};
static const double limit = 1.15;
// p99, relative to the largest knot:
static const double most_change = 1;  ///< of poses and of wind-up, when a knot moves by one frame
static const double most_size = 1.35; ///< of wind-up, up to the last knot
static const double most_loop = 1.25; ///< of wind-up in a loop

struct layout {
    wiggly_desc desc;
    wiggly_knot knots[MOST_KNOTS];
    double largest;
};

static unsigned seed;

static double uniform(void)
{
    seed = seed * 1664525U + 1013904223U;
    return (seed >> 8) / 16777216.0;
}

/// Settings of the mathematics page in turn, with knots at least `apart` frames apart.
static void make_layout(struct layout *l, int number, int apart)
{
    static const double f[] = {0.5, 0.75, 1, 1.25, 1.5, 1.75, 2, 2.25, 2.5, 3};
    static const double damping[] = {0, 0.05, 0.1, 0.15, 0.2, 0.3}, bandwidth[] = {0, 0.05, 0.1, 0.2};
    seed = (unsigned)number * 2654435761U + 97;
    for (int i = 0; i < 4; i++) uniform();
    *l = (struct layout){.desc = wiggly_default_desc()};
    l->desc.samples = SAMPLES;
    l->desc.frequency.value = f[number % SETTINGS];
    l->desc.damping.value = damping[number % 6];
    l->desc.bandwidth.value = bandwidth[number % 4];
    l->desc.knot_count = 3 + (int)(4 * uniform());
    bool taken[SAMPLES] = {false};
    for (int k = 0; k < l->desc.knot_count;) {
        int at = 2 + (int)(uniform() * (SAMPLES - 42)); // the last second and a half has no knots
        bool free = true;
        for (int i = at - apart + 1; i < at + apart; i++) free = free && (i < 0 || !taken[i]);
        if (!free) continue;
        taken[at] = true;
        l->knots[k++] = (wiggly_knot){.sample = at, .value = 2 * uniform() - 1};
        l->largest = fmax(l->largest, fabs(l->knots[k - 1].value));
    }
}

static int last_knot(const struct layout *l)
{
    int last = 0;
    for (int k = 0; k < l->desc.knot_count; k++) last = l->knots[k].sample > last ? l->knots[k].sample : last;
    return last;
}

struct arrays {
    double total[256], im[256];
};

static void solve_way(wiggly_solver *solver, const struct layout *l, enum way way, struct arrays *out)
{
    struct layout own = *l;
    own.desc.knots = own.knots;
    if (way == FILTER) own.desc.passive = WIGGLY_FILTER;
    if (way == CUBIC) own.desc.mode = WIGGLY_CUBIC;
    if (way == WOUND_UP) own.desc.wind_up = 0.5;
    if (way == LIMITED) {
        own.desc.high = limit * l->largest, own.desc.low = -own.desc.high;
        own.desc.has_low = own.desc.has_high = true;
    }
    wiggly_curve curve = {.size = sizeof curve, .total = out->total, .im = out->im};
    wiggly_status status = wiggly_solve(solver, &own.desc, &curve);
    if (status >= WIGGLY_ERROR_ARGUMENT) fprintf(stderr, "%s\n", wiggly_status_text(status));
}

/// Sets knots one after another, each with the phase visible at that time.
static void make_poses(wiggly_solver *solver, struct layout *l)
{
    static struct arrays seen;
    struct layout so_far = *l;
    for (int k = 0; k < l->desc.knot_count; k++) {
        so_far.desc.knot_count = k + 1;
        solve_way(solver, &so_far, POSES, &seen);
        l->knots[k].phase = seen.im[l->knots[k].sample];
        l->knots[k].has_phase = true;
        so_far.knots[k] = l->knots[k];
    }
}

static int compare(const void *a, const void *b)
{
    const double *left = a, *right = b;
    return (*left > *right) - (*left < *right);
}

static double p99(double *values)
{
    qsort(values, RUNS, sizeof *values, compare);
    return values[RUNS * 99 / 100];
}

/// Prints median and 99th percentile; returns the latter.
static double print_two(double *values)
{
    const double most = p99(values);
    printf("  %5.2f %6.2f", values[RUNS / 2], most);
    return most;
}

static bool is_alone(const struct layout *l, const wiggly_knot *knot)
{
    for (int k = 0; k < l->desc.knot_count; k++) {
        if (&l->knots[k] != knot && l->knots[k].sample == knot->sample) return false;
    }
    return true;
}

/// Prints a row; returns the p99 of the curve's movement, and in `size` of its size up to the last knot.
static double measure(wiggly_solver *solver, enum way way, int apart, double *size)
{
    static double change[2][RUNS], overshoot[2][RUNS];
    static struct arrays before, after;
    for (int n = 0; n < RUNS; n++) {
        struct layout l;
        make_layout(&l, n, apart);
        if (way == POSES) make_poses(solver, &l);
        const int L = last_knot(&l);
        solve_way(solver, &l, way, &before);
        wiggly_knot *moved = &l.knots[(int)(uniform() * l.desc.knot_count)];
        moved->sample++;
        if (!is_alone(&l, moved)) moved->sample -= 2;
        if (!is_alone(&l, moved)) moved->sample++; // between two knots it stays
        solve_way(solver, &l, way, &after);
        for (int side = 0; side < 2; side++) {
            change[side][n] = overshoot[side][n] = 0;
            for (int i = side ? L + 1 : 0; i < (side ? SAMPLES : L + 1); i++) {
                change[side][n] = fmax(change[side][n], fabs(after.total[i] - before.total[i]) / l.largest);
                overshoot[side][n] = fmax(overshoot[side][n], fabs(before.total[i]) / l.largest);
            }
        }
    }
    printf("%-14s", names[way]);
    const double before_last = print_two(change[0]), after_last = print_two(change[1]);
    *size = print_two(overshoot[0]);
    print_two(overshoot[1]);
    printf("\n");
    return fmax(before_last, after_last);
}

/// The size of loops with wind-up through one knot to five, p99.
static double measure_loops(wiggly_solver *solver)
{
    static double size[RUNS];
    static struct arrays out;
    for (int n = 0; n < RUNS; n++) {
        struct layout l;
        make_layout(&l, n, 6);
        l.desc.start = WIGGLY_LOOP;
        l.desc.knot_count = 1 + n / SETTINGS % (l.desc.knot_count < 5 ? l.desc.knot_count : 5);
        l.largest = 0;
        for (int k = 0; k < l.desc.knot_count; k++) l.largest = fmax(l.largest, fabs(l.knots[k].value));
        solve_way(solver, &l, WOUND_UP, &out);
        size[n] = 0;
        for (int i = 0; i < SAMPLES; i++) size[n] = fmax(size[n], fabs(out.total[i]) / l.largest);
    }
    return p99(size);
}

/// The largest change up to the knot before one whose value moves by 1, with wind-up.
static double measure_before(wiggly_solver *solver)
{
    static struct arrays before, after;
    double most = 0;
    for (int n = 0; n < RUNS; n++) {
        struct layout l;
        make_layout(&l, n, 6);
        solve_way(solver, &l, WOUND_UP, &before);
        wiggly_knot *moved = &l.knots[(int)(uniform() * l.desc.knot_count)];
        moved->value += 1;
        solve_way(solver, &l, WOUND_UP, &after);
        int last = -1;
        for (int k = 0; k < l.desc.knot_count; k++) {
            const int sample = l.knots[k].sample;
            if (sample < moved->sample && sample > last) last = sample;
        }
        for (int i = 0; i <= last; i++) most = fmax(most, fabs(after.total[i] - before.total[i]));
    }
    return most;
}

static bool say(const char *what, double most, double is)
{
    printf("%s at most %.2f: %s, %.2f\n", what, most, is <= most ? "yes" : "no", is);
    return is <= most;
}

/// The smallest extremum between the second and third knot of Figure 4, with the third moved by a tenth.
static void measure_figure(wiggly_solver *solver)
{
    printf("Figure 4, smallest extremum:");
    for (enum way way = 0; way < CUBIC; way++) {
        if (way == POSES || way == WOUND_UP) continue; // these hold the phase that the figure leaves free
        struct layout l = {.desc = wiggly_default_desc(), .largest = 1};
        static struct arrays out;
        const int samples[] = {0, 36, 115};
        l.desc.samples = 176, l.desc.knot_count = 3;
        l.desc.frequency.value = 1, l.desc.damping.value = 0.05;
        for (int k = 0; k < 3; k++)
            l.knots[k] = (wiggly_knot){.sample = samples[k], .value = k > 0, .has_slope = true, .stiffness = 1000};
        solve_way(solver, &l, way, &out);
        double least = INFINITY;
        for (int i = 36 + 4; i <= 115 - 4; i++) {
            double here = out.total[i], a = here - out.total[i - 1], b = out.total[i + 1] - here;
            if (a * b <= 0) least = fmin(least, fabs(here));
        }
        printf("  %s %.3f", names[way], least);
    }
    printf("\n");
}

int main(void)
{
    wiggly_solver *solver;
    double change[2][WAYS], size[2][WAYS];
    if (wiggly_create(256, 256 + MOST_KNOTS, &solver) != WIGGLY_OK) return EXIT_FAILURE;
    for (int harsh = 0; harsh < 2; harsh++) {
        printf("%s; median and p99, of the largest knot\n%-14s  %-13s %-14s %-14s %s\n",
               harsh ? "Knots on neighbouring frames too" : "Knots at least 6 frames apart", "", "change before",
               "after the last", "largest before", "after the last");
        for (enum way way = 0; way < WAYS; way++) {
            change[harsh][way] = measure(solver, way, harsh ? 1 : 6, &size[harsh][way]);
        }
    }
    measure_figure(solver);
    printf("Knots at least 6 frames apart, p99:\n");
    bool met = say("one frame of drag changes poses by", most_change, change[0][POSES]);
    met &= say("one frame of drag changes wind-up by", most_change, change[0][WOUND_UP]);
    met &= say("wind-up swings, up to the last knot, to", most_size, size[0][WOUND_UP]);
    met &= say("wind-up swings, in a loop, to", most_loop, measure_loops(solver));
    met &= say("a value that moves changes wind-up, before the knot before it, by", 0, measure_before(solver));
    wiggly_destroy(solver);
    return met ? EXIT_SUCCESS : EXIT_FAILURE;
}
