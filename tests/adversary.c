/// The adversary: its problems, what the textbook says of the solver's answers, and both as text.
#include "adversary.h"
#include "uniform.h"

#include <math.h>
#include <string.h>

static int pick(uint64_t *seed, int count) { return (int)(uniform(seed) * count); }

static double between(uint64_t *seed, double low, double high) { return low + (high - low) * uniform(seed); }

/// From one power of ten to another.
static double power(uint64_t *seed, double low, double high) { return pow(10, between(seed, low, high)); }

/// From one number to another: smoothly, in one step, there and back, or in steps between the two. In a loop the ends may differ.
static wiggly_param make_track(struct adversary_problem *p, uint64_t *seed, double from, double to)
{
    double *track = p->tracks[p->tracks_used++];
    int n = p->desc.samples, shape = pick(seed, 4), at = pick(seed, n);
    for (int i = 0; i < n; i++) {
        double s = n > 1 ? (double)i / (n - 1) : 0, way = 0;
        if (shape == 0) way = s * s * (3 - 2 * s);
        if (shape == 1) way = i >= at;
        if (shape == 2) way = sin(6.3 * s);
        if (shape == 3) way = pick(seed, 2);
        track[i] = from + (to - from) * way;
    }
    bool ragged = pick(seed, 3) == 0;
    if (p->desc.start == WIGGLY_LOOP && !ragged) track[n - 1] = track[0];
    return (wiggly_param){.track = track};
}

/// A number, or one time in five a track from it to another of the same kind.
static wiggly_param make_param(struct adversary_problem *p, uint64_t *seed, double value, double other)
{
    if (pick(seed, 5) > 0) return (wiggly_param){.value = value};
    return make_track(p, seed, value, other);
}

static double at_sample(wiggly_param param, int sample) { return param.track ? param.track[sample] : param.value; }

/// A spring and a friction, as a frequency and a damping.
static void set_spring(struct adversary_problem *p, wiggly_param k, wiggly_param gamma)
{
    wiggly_desc *d = &p->desc;
    if (!k.track && !gamma.track) {
        wiggly_from_spring(k.value, gamma.value, &d->frequency.value, &d->damping.value);
        return;
    }
    double *frequency = p->tracks[p->tracks_used++], *damping = p->tracks[p->tracks_used++];
    for (int i = 0; i < d->samples; i++)
        wiggly_from_spring(at_sample(k, i), at_sample(gamma, i), &frequency[i], &damping[i]);
    d->frequency.track = frequency, d->damping.track = damping;
}

/// Periods over the domain: none, a whole or a half number, few, many.
static double some_periods(uint64_t *seed)
{
    const int what = pick(seed, 5);
    if (what == 0) return 0;
    if (what == 1) return 0.5 * pick(seed, 13);
    if (what == 2) return power(seed, -4, 0);
    return between(seed, 0, what == 3 ? 4 : 30);
}

static double some_damping(uint64_t *seed)
{
    const int what = pick(seed, 6);
    if (what < 4) return (double[]){0, 0, 0.03, 1}[what];
    if (what == 4) return between(seed, 0, 2);
    return pick(seed, 3) ? between(seed, 0, 0.3) : between(seed, 1, 25);
}

static double some_bandwidth(uint64_t *seed) { return (double[]){0, 0.1, 1, uniform(seed)}[pick(seed, 4)]; }

static double some_calm(uint64_t *seed) { return (double[]){0, 0.001, 1, 1, power(seed, -14, 0)}[pick(seed, 5)]; }

static void make_poles(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    double t = (d->samples - 1) * d->step;
    // Where both poles alias to the same λ, the oscillator's speeds are infinite.
    double most = (d->passive == WIGGLY_FILTER ? 0.9 : 0.45) / d->step;
    double f = fmin(some_periods(seed) / t, most), other = fmin(some_periods(seed) / t, most);
    if (d->mode == WIGGLY_REAL && pick(seed, 4) == 0) {
        double friction = between(seed, 0, 8);
        wiggly_param k = make_param(p, seed, 39.5 * f * f, 39.5 * other * other);
        set_spring(p, k, make_param(p, seed, friction, 0));
        return;
    }
    d->frequency = make_param(p, seed, f, other);
    d->damping = make_param(p, seed, some_damping(seed), some_damping(seed));
    d->bandwidth = make_param(p, seed, some_bandwidth(seed), some_bandwidth(seed));
}

static void add_knot(struct adversary_problem *p, uint64_t *seed, int sample, double size, bool slope)
{
    wiggly_desc *d = &p->desc;
    p->knots[d->knot_count++] = (wiggly_knot){
        .sample = sample,
        .value = size * between(seed, -1, 1),
        .has_slope = slope,
        .slope = size * between(seed, -2, 2) / d->step / (double[]){1, 10}[pick(seed, 2)],
        .stiffness = power(seed, -3, 12),
    };
}

/// Few or many, adjacent or apart, on the first and the last sample too.
static void make_knots(struct adversary_problem *p, uint64_t *seed, double size)
{
    wiggly_desc *d = &p->desc;
    int end = d->samples - (d->start == WIGGLY_LOOP ? 1 : 0), run = pick(seed, 3) == 0 ? pick(seed, end) : -9;
    double density = uniform(seed) * uniform(seed);
    bool ends = pick(seed, 3) == 0, flat = pick(seed, 12) == 0;
    if (pick(seed, 4) == 0) density = 2.0 / d->samples;
    for (int i = 0; i < end; i++) {
        bool here = uniform(seed) < density || (i >= run && i < run + 3) || (ends && (i == 0 || i == end - 1));
        if (here) add_knot(p, seed, i, flat ? 0 : size, pick(seed, 3) == 0);
    }
}

static void make_equilibrium(struct adversary_problem *p, uint64_t *seed, double size)
{
    double y = size * between(seed, -1, 1);
    if (pick(seed, 3) == 0) p->desc.equilibrium = make_param(p, seed, y, size * between(seed, -1, 1));
    if (pick(seed, 6) == 0) p->desc.equilibrium = make_track(p, seed, y, size * between(seed, -9, 9));
}

static double some_size(uint64_t *seed) { return (double[]){1, 1, 1, 1e-6, 1e6}[pick(seed, 5)]; }

/// Everything at random, of so many samples.
static void make_mixed(struct adversary_problem *p, uint64_t *seed, int samples)
{
    wiggly_desc *d = &p->desc;
    d->samples = samples;
    d->mode = (wiggly_mode)pick(seed, 3);
    d->start = samples > 1 ? (wiggly_start)pick(seed, 3) : WIGGLY_FREE;
    d->calm = some_calm(seed);
    make_poles(p, seed);
    double size = some_size(seed);
    make_equilibrium(p, seed, size);
    make_knots(p, seed, size);
}

/// The filter, calm, and of so many the mode and the start.
static void choose(struct adversary_problem *p, uint64_t *seed, int modes, int starts)
{
    p->desc.passive = (wiggly_passive)pick(seed, 2);
    if (modes > 1) p->desc.mode = (wiggly_mode)pick(seed, modes);
    if (starts > 1) p->desc.start = (wiggly_start)pick(seed, starts);
    p->desc.calm = some_calm(seed);
}

static void make_adjacent(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    d->samples = 6 + pick(seed, 35);
    d->passive = (wiggly_passive)pick(seed, 2);
    d->calm = 0;
    d->start = pick(seed, 2) ? WIGGLY_REST : WIGGLY_FREE;
    d->bandwidth.value = 0;
    d->frequency.value = fmin(power(seed, -1, 1.2) / (d->samples * d->step), 0.45 / d->step);
    d->damping.value = some_damping(seed);
    int first = 2 + pick(seed, d->samples - 5);
    for (int k = 0; k < 3; k++) add_knot(p, seed, first + k, 1, false);
}

static void make_nodal(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    int half = 2 + pick(seed, 4), halves = 2 + pick(seed, 3), first = pick(seed, half);
    d->passive = (wiggly_passive)pick(seed, 2);
    d->mode = pick(seed, 3) ? WIGGLY_REAL : WIGGLY_COMPLEX;
    d->start = (wiggly_start)pick(seed, 3);
    d->samples = d->start == WIGGLY_LOOP ? 2 * half * (halves / 2) + 1 : half * halves + 2 + pick(seed, 4);
    d->calm = (double[]){0, 0.001, 1}[pick(seed, 3)];
    d->bandwidth.value = 0;
    d->damping.value = (double[]){0, 0, 1e-9, 1e-5}[pick(seed, 4)];
    d->frequency.value = 1 / (2 * half * d->step);
    if (pick(seed, 4) == 0) { // nothing swings where the curve starts
        double *track = p->tracks[p->tracks_used++];
        for (int i = 0; i < d->samples; i++) track[i] = i <= first ? 0 : d->frequency.value;
        if (d->start == WIGGLY_LOOP) track[d->samples - 1] = 0;
        d->frequency.track = track;
    }
    if (pick(seed, 3) == 0) d->equilibrium = make_track(p, seed, 0, between(seed, -1, 1));
    bool flat = pick(seed, 4) == 0;
    for (int i = first; i < d->samples - 1; i += half) {
        add_knot(p, seed, i, 1, false);
        if (flat) p->knots[d->knot_count - 1].value = 0.5;
    }
}

static void make_nyquist(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    d->samples = 3 + pick(seed, 60);
    choose(p, seed, 2, 3);
    double most = d->passive == WIGGLY_FILTER ? 1.5 : 0.499, f = between(seed, 0.3, most) / d->step;
    d->frequency = make_param(p, seed, f, 0);
    d->damping = make_param(p, seed, some_damping(seed), some_damping(seed));
    d->bandwidth.value = d->passive == WIGGLY_FILTER ? some_bandwidth(seed) : 0;
    make_equilibrium(p, seed, 1);
    make_knots(p, seed, 1);
}

static void make_from_zero(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    d->samples = 4 + pick(seed, 60);
    choose(p, seed, 2, 3);
    double f = power(seed, -2, -0.35) / d->step, end = pick(seed, 2) ? 0 : 0.5 * f;
    double *track = p->tracks[p->tracks_used++];
    int off = pick(seed, d->samples), on = off + 1 + pick(seed, d->samples - off);
    for (int i = 0; i < d->samples; i++) track[i] = i >= off && i < on ? f : i < off ? 0 : end;
    if (pick(seed, 3) == 0) {
        for (int i = 0; i < d->samples; i++) track[i] = f * i / d->samples;
    }
    d->frequency.track = track;
    double damping = pick(seed, 2) ? between(seed, 1, 25) : some_damping(seed);
    d->damping = make_param(p, seed, damping, some_damping(seed));
    d->bandwidth.value = some_bandwidth(seed);
    make_equilibrium(p, seed, 1);
    make_knots(p, seed, 1);
}

static void make_slow(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    d->samples = 3 + pick(seed, pick(seed, 4) ? 60 : 600);
    d->passive = (wiggly_passive)pick(seed, 2);
    d->mode = (wiggly_mode)pick(seed, 2);
    d->start = pick(seed, 3) ? WIGGLY_LOOP : (wiggly_start)pick(seed, 2);
    d->calm = some_calm(seed);
    double t = (d->samples - 1) * d->step, f = power(seed, -4, 0.3) / t;
    if (d->mode == WIGGLY_REAL && pick(seed, 3) == 0) {
        wiggly_param k = make_param(p, seed, pick(seed, 3) ? 39.5 * f * f : 0, 0);
        set_spring(p, k, make_param(p, seed, between(seed, 0, 8) * (pick(seed, 2) ? f : 1), 0));
    } else {
        d->frequency = make_param(p, seed, f, 0.1 * f);
        d->damping = make_param(p, seed, some_damping(seed), some_damping(seed));
        d->bandwidth.value = some_bandwidth(seed);
    }
    d->equilibrium = make_track(p, seed, between(seed, -1, 1), between(seed, -1, 1));
    if (pick(seed, 2)) make_knots(p, seed, 1);
}

/// A knot every so many samples, or about that.
static void make_regular_knots(struct adversary_problem *p, uint64_t *seed, int gap)
{
    wiggly_desc *d = &p->desc;
    int end = d->samples - (d->start == WIGGLY_LOOP ? 1 : 0);
    bool irregular = pick(seed, 2), slopes = pick(seed, 3) == 0;
    for (int i = pick(seed, gap); i < end; i += irregular ? 1 + pick(seed, 2 * gap - 1) : gap)
        add_knot(p, seed, i, 1, slopes && pick(seed, 2));
}

static void make_chain(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    d->samples = pick(seed, 6) ? 100 + pick(seed, 500) : 600 + pick(seed, 1800);
    d->passive = (wiggly_passive)pick(seed, 2);
    d->mode = pick(seed, 4) ? WIGGLY_COMPLEX : WIGGLY_REAL;
    d->start = pick(seed, 4) ? WIGGLY_FREE : (wiggly_start)(1 + pick(seed, 2));
    d->calm = pick(seed, 5) ? power(seed, -13, 0) : 1;
    d->bandwidth.value = (double[]){0, 0, 1e-3, 0.1, 1}[pick(seed, 5)];
    d->damping.value = (double[]){0, 0, 1e-9, 1e-4, 1e-2}[pick(seed, 5)];
    int gap = 2 + (int)(d->samples * power(seed, -2.5, -0.5));
    double halves = pick(seed, 2) ? 1 + pick(seed, 4) : between(seed, 0, 5); // periods between knots, twice
    d->frequency.value = fmin(halves / (2 * gap * d->step), 0.45 / d->step);
    make_regular_knots(p, seed, gap);
}

static void make_long(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    int samples = pick(seed, 8) ? 60 + pick(seed, 500) : 600 + pick(seed, 2400);
    d->passive = (wiggly_passive)pick(seed, 2);
    if (pick(seed, 2)) {
        make_mixed(p, seed, samples);
        return;
    }
    d->samples = samples;
    d->mode = (wiggly_mode)pick(seed, 3);
    d->start = (wiggly_start)pick(seed, 3);
    d->calm = some_calm(seed);
    make_poles(p, seed);
    make_equilibrium(p, seed, 1);
    make_regular_knots(p, seed, 2 + (int)(samples * power(seed, -2.5, -0.05)));
}

static void make_short(struct adversary_problem *p, uint64_t *seed)
{
    make_mixed(p, seed, pick(seed, 40) ? 4 + pick(seed, 37) : 1 + pick(seed, 3));
}

/// Knots, poses or still knots with hundreds to thousands of samples between, slow and fast, hardly damped or not.
static void make_gaps(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    const int gap = 400 + (int)(600 * power(seed, 0, 0.7) - 600), count = 2 + pick(seed, 3), what = pick(seed, 4);
    d->passive = (wiggly_passive)pick(seed, 2);
    d->mode = pick(seed, 4) ? WIGGLY_COMPLEX : (wiggly_mode)pick(seed, 3);
    d->start = pick(seed, 3) ? WIGGLY_FREE : WIGGLY_REST;
    d->samples = 2 + pick(seed, 100);
    d->frequency.value = 24 * power(seed, -3, 0);
    d->damping.value = (double[]){0, 1e-6, 1e-3, 0.05}[pick(seed, 4)];
    d->bandwidth.value = 0.1 * uniform(seed) * pick(seed, 2);
    for (int k = 0; k < count && d->samples < ADVERSARY_MAX - 101; k++, d->samples += gap) {
        add_knot(p, seed, d->samples - 1, 1, false);
        wiggly_knot *knot = &p->knots[d->knot_count - 1];
        if (what == 1 || (what == 2 && pick(seed, 2))) knot->has_phase = true, knot->phase = between(seed, -1, 1);
        if (what == 3 && pick(seed, 2)) *knot = (wiggly_knot){.sample = knot->sample, .still = true};
    }
    d->samples += 1 + pick(seed, 100) - gap;
}

static void make_calm(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    make_chain(p, seed);
    d->start = WIGGLY_FREE;
    d->calm = power(seed, -20, -3);
    if (pick(seed, 2)) d->damping.value = power(seed, -3, -0.5);
}

static void make_critical(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    make_mixed(p, seed, 20 + pick(seed, 200));
    d->mode = (wiggly_mode)pick(seed, 2);
    d->frequency.track = d->damping.track = NULL;
    d->frequency.value = power(seed, -2, -0.4) / d->step;
    d->damping.value = 1 + between(seed, -1e-9, 1e-9);
    if (d->passive == WIGGLY_OSCILLATOR) d->bandwidth = (wiggly_param){.value = pick(seed, 2) ? 0 : 0.1};
}

static void make_alias(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    d->samples = 10 + pick(seed, 100);
    choose(p, seed, 1, 3);
    d->frequency.value = (0.5 * (1 + pick(seed, 4)) + between(seed, -1e-3, 1e-3)) / d->step;
    d->damping.value = some_damping(seed);
    d->bandwidth.value = 1;
    make_knots(p, seed, 1);
}

static void make_jumps(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    d->samples = 60 + pick(seed, 400);
    d->mode = WIGGLY_REAL;
    choose(p, seed, 1, 3);
    double *track = p->tracks[p->tracks_used++], now = 0;
    for (int i = 0; i < d->samples; i++) {
        if (pick(seed, 20) == 0) now = pick(seed, 3) ? power(seed, -3, -0.6) / d->step : 0;
        track[i] = now;
    }
    if (d->start == WIGGLY_LOOP) track[d->samples - 1] = track[0];
    d->frequency.track = track;
    d->damping.value = some_damping(seed);
    make_equilibrium(p, seed, 1);
    make_regular_knots(p, seed, 4 + pick(seed, d->samples / 2));
}

static void make_last(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    make_mixed(p, seed, 20 + pick(seed, 300));
    d->passive = WIGGLY_FILTER;
    d->start = pick(seed, 2) ? WIGGLY_FREE : WIGGLY_REST;
    while (d->knot_count > 0 && p->knots[d->knot_count - 1].sample >= d->samples - 1) d->knot_count--;
    add_knot(p, seed, d->samples - 1, 1, true);
}

static void make_stiff(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    make_mixed(p, seed, 20 + pick(seed, 300));
    for (int k = 0; k < d->knot_count; k++) {
        wiggly_knot *knot = &p->knots[k];
        knot->has_slope = pick(seed, 2);
        knot->slope = between(seed, -2, 2) / d->step / 10;
        knot->stiffness = power(seed, -12, 15);
    }
}

/// An equilibrium that swings as fast as the loop.
static void make_resonant(struct adversary_problem *p, uint64_t *seed)
{
    wiggly_desc *d = &p->desc;
    d->samples = 20 + pick(seed, 300);
    d->start = WIGGLY_LOOP;
    choose(p, seed, 2, 1);
    const int periods = 1 + pick(seed, 4), seam = d->samples - 1;
    d->frequency.value = (periods + (pick(seed, 2) ? 0 : between(seed, -1e-3, 1e-3))) / (seam * d->step);
    d->damping.value = (double[]){0, 1e-6, 0.03, 0.3}[pick(seed, 4)];
    d->bandwidth.value = 0.1 * pick(seed, 2);
    double *track = p->tracks[p->tracks_used++];
    for (int i = 0; i <= seam; i++) track[i] = sin(2 * 3.14159265358979323846 * periods * (i % seam) / seam);
    if (pick(seed, 2)) d->equilibrium.track = track;
    add_knot(p, seed, 0, 1, pick(seed, 2));
    for (int i = 1 + pick(seed, seam); i < seam - 1; i += 2 + pick(seed, seam)) add_knot(p, seed, i, 1, false);
    if (pick(seed, 2)) add_knot(p, seed, seam - 1, 1, pick(seed, 2));
}

static void (*const makers[ADVERSARY_KINDS])(struct adversary_problem *p, uint64_t *seed) = {
    [ADVERSARY_FILTER] = make_short, [ADVERSARY_OSCILLATOR] = make_short, [ADVERSARY_ADJACENT] = make_adjacent,
    [ADVERSARY_NODAL] = make_nodal,  [ADVERSARY_NYQUIST] = make_nyquist,  [ADVERSARY_FROM_ZERO] = make_from_zero,
    [ADVERSARY_SLOW] = make_slow,    [ADVERSARY_CHAIN] = make_chain,      [ADVERSARY_LONG] = make_long,
    [ADVERSARY_GAPS] = make_gaps,    [ADVERSARY_CALM] = make_calm,        [ADVERSARY_CRITICAL] = make_critical,
    [ADVERSARY_ALIAS] = make_alias,  [ADVERSARY_JUMPS] = make_jumps,      [ADVERSARY_LAST] = make_last,
    [ADVERSARY_STIFF] = make_stiff,  [ADVERSARY_RESONANT] = make_resonant};

static const double rates[] = {24, 60, 1000, 1, 15, 120, 24 * 16, 23.976 * 4, 30 * 256};

void adversary_make(struct adversary_problem *p, adversary_kind kind, uint64_t seed)
{
    for (int i = 0; i < 8; i++) uniform(&seed);
    p->tracks_used = 0;
    p->desc = wiggly_default_desc();
    p->desc.knots = p->knots;
    p->fps = rates[pick(&seed, pick(&seed, 2) ? 4 : (int)(sizeof rates / sizeof *rates))];
    p->desc.step = 1 / p->fps;
    p->desc.passive = kind == ADVERSARY_FILTER ? WIGGLY_FILTER : WIGGLY_OSCILLATOR; // some kinds choose anew
    makers[kind](p, &seed);
}

void adversary_hold(struct adversary_problem *p, uint64_t seed)
{
    wiggly_desc *d = &p->desc;
    double size = 0;
    for (int k = 0; k < d->knot_count; k++) size = fmax(size, fabs(p->knots[k].value));
    for (int i = 0; i < 8; i++) uniform(&seed);
    const int rarely = 2 + pick(&seed, 4);
    for (int k = 0; k < d->knot_count; k++) {
        wiggly_knot *knot = &p->knots[k];
        const double phase = size * between(&seed, -1, 1);
        const int what = pick(&seed, 3 * rarely);
        if (what < 2 && !knot->still) knot->has_phase = true, knot->phase = phase;
        if (what == 2) *knot = (wiggly_knot){.sample = knot->sample, .still = true};
    }
}

void adversary_direct(struct adversary_problem *p, uint64_t seed)
{
    wiggly_desc *d = &p->desc;
    for (int i = 0; i < 16; i++) uniform(&seed);
    if (pick(&seed, 4)) d->mode = WIGGLY_COMPLEX, d->passive = WIGGLY_OSCILLATOR;
    if (pick(&seed, 4)) d->wind_up = pick(&seed, 3) ? 0.5 : power(&seed, -2, 2);
    const int rarely = 1 + pick(&seed, 5);
    for (int k = 0; k < d->knot_count; k++) p->knots[k].settles = !p->knots[k].still && pick(&seed, rarely) == 0;
}

// --- what the textbook says ------------------------------------------------------------------------------------------

/// An answer of the textbook's, or the solver's, in arrays of its own.
struct answer {
    double total[ADVERSARY_MAX], re[ADVERSARY_MAX], im[ADVERSARY_MAX];
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
        parts = fmax(parts, fabs(exact->im[i]));
    }
    return worst <= 0x1p-40 * parts ? 0 : worst / fmax(size_of(exact, n), 1e-6 * parts);
}

/// Whether the total is next to nothing beside what it is the sum of.
static bool is_nothing(const struct answer *a, int n)
{
    double parts = 0;
    for (int i = 0; i < n; i++) parts = fmax(parts, fmax(fabs(a->re[i]), fabs(a->total[i] - a->re[i])));
    return size_of(a, n) < 1e-2 * parts;
}

/// Damped so little that rows of the energy weigh much alike.
static bool is_tame(const wiggly_desc *d)
{
    for (int i = 0; i < d->samples; i++) {
        if (at_sample(d->damping, i) > 2) return false;
    }
    return true;
}

static struct textbook book;

/// How much more the curve changes, relatively, than the numbers that it is made of: the rounding of the poles alone costs any solver in
/// doubles some 1e-16 of it.
static double condition_of(const struct adversary_problem *p, wiggly_status status, const struct answer *exact)
{
    static struct answer changed;
    static double track[ADVERSARY_MAX];
    const double change = 1e-12;
    wiggly_desc other = p->desc;
    wiggly_param *params[] = {&other.frequency, &other.damping};
    double worst = 0;
    for (int i = 0; i < 2; i++) {
        wiggly_param kept = *params[i];
        for (int k = 0; kept.track && k < other.samples; k++) track[k] = kept.track[k] * (1 + change);
        *params[i] = (wiggly_param){kept.value * (1 + change), kept.track ? track : NULL};
        if (!textbook_as(&other, status, &book, changed.total, changed.re, changed.im)) return INFINITY;
        worst = fmax(worst, error_of(&changed, exact, other.samples) / change);
        *params[i] = kept;
    }
    return worst;
}

static double tolerance(const wiggly_desc *d) { return d->mode == WIGGLY_CUBIC ? 1e-9 : 1e-8; }

/// The textbook's answer to what the solver says it solved, and whether that was the right thing to solve.
static void find_exact(const struct adversary_problem *p, struct adversary_verdict *v, struct answer *a)
{
    bool asked = textbook_as(&p->desc, WIGGLY_OK, &book, a->total, a->re, a->im);
    const double inverse = textbook_inverse(&book);
    v->pivot = book.pivot;
    v->growth = book.growth;
    const bool is_blurred = !asked || inverse > 1e26 || book.pivot < 1e-20; // for 34 digits
    v->undecided = book.open && v->said != WIGGLY_OK
                       ? !asked && v->said != WIGGLY_CALMED && v->said != WIGGLY_LEVELLED
                       : is_blurred;
    v->borderline =
        book.open && ((asked && (book.pivot < 1e-11 || inverse > 1e14)) || (book.growth > 300 && book.growth < 3e5));
    v->exists = textbook_curve(&p->desc, &book, &v->status, a->total, a->re, a->im);
    v->undecided = v->undecided || !v->exists;
    if (!v->borderline || v->said == v->status || v->said == WIGGLY_SINGULAR) return;
    bool as_asked = v->said == WIGGLY_INEXACT || v->said == WIGGLY_OK;
    v->status = as_asked ? WIGGLY_OK : v->said;
    v->exists = textbook_as(&p->desc, v->status, &book, a->total, a->re, a->im);
}

static const char *find_fault(const struct adversary_problem *p, struct adversary_verdict *v,
                              const struct answer *exact)
{
    const bool inexact = v->said == WIGGLY_INEXACT;
    if (v->said != v->status && !(inexact && v->status == WIGGLY_OK)) return "the wrong status";
    if (!(v->estimate >= 0)) return "an estimate that is no number";
    if (v->said == WIGGLY_OK && !(v->error <= tolerance(&p->desc))) return "OK, and off";
    if (v->error > tolerance(&p->desc) && v->error > v->estimate) return "an estimate below the error";
    if (!inexact) return NULL;
    v->needless = true;
    if (!(v->estimate > tolerance(&p->desc))) return "INEXACT by no estimate";
    if (v->error > 0.05 * tolerance(&p->desc) || v->pivot <= 1e-9 || textbook_inverse(&book) > 1e14)
        return NULL; // what is that far off may say so
    if (is_nothing(exact, p->desc.samples) || !is_tame(&p->desc)) return NULL;
    v->condition = condition_of(p, v->status, exact);
    return v->condition < 1e4 ? "INEXACT, and easy" : NULL;
}

void adversary_judge(wiggly_solver *solver, const struct adversary_problem *p, struct adversary_verdict *v)
{
    static struct answer got, exact;
    wiggly_curve curve = {.size = sizeof curve, .total = got.total, .re = got.re, .im = got.im};
    *v = (struct adversary_verdict){.said = wiggly_solve(solver, &p->desc, &curve), .estimate = curve.error};
    find_exact(p, v, &exact);
    if (v->undecided) return;
    if (v->said == WIGGLY_SINGULAR) {
        v->fault = v->exists && !v->borderline ? "singular is not" : NULL;
    } else if (!v->exists) {
        v->fault = "an answer where there is none";
    } else {
        v->error = error_of(&got, &exact, p->desc.samples);
        // Whether w is calmed depends on last digits where u is in any case.
        if (v->said == WIGGLY_CALMED && v->borderline && v->error > tolerance(&p->desc) &&
            textbook_as(&p->desc, WIGGLY_CALMED, &book, exact.total, exact.re, exact.im))
            v->error = fmin(v->error, error_of(&got, &exact, p->desc.samples));
        v->fault = find_fault(p, v, &exact);
    }
}

// --- as text ---------------------------------------------------------------------------------------------------------

/// A cubic with a knot on every sample: its total is the track, to the bit.
static void print_track(FILE *out, const struct adversary_problem *p, int track)
{
    fprintf(out, "{\"name\": \"track%d\", \"mode\": \"cubic\", \"knots\": [", track);
    for (int i = 0; i < p->desc.samples; i++)
        fprintf(out, "%s{\"frame\": %d, \"value\": %.17g}", i ? ", " : "", i, p->tracks[track][i]);
    fprintf(out, "]}, ");
}

static void print_param(FILE *out, const struct adversary_problem *p, const char *key, wiggly_param param)
{
    int track = 0;
    while (param.track && p->tracks[track] != param.track) track++;
    if (param.track) fprintf(out, ", \"%s\": {\"spline\": \"track%d\"}", key, track);
    if (!param.track) fprintf(out, ", \"%s\": %.17g", key, param.value);
}

void adversary_print(FILE *out, const struct adversary_problem *p)
{
    static const char *const modes[] = {"complex", "real", "cubic"}, *const starts[] = {"free", "rest", "loop"};
    const wiggly_desc *d = &p->desc;
    fprintf(out, "{\"wiggly\": 1, \"fps\": %.17g, \"frames\": [0, %d], \"splines\": [", p->fps, d->samples - 1);
    for (int t = 0; t < p->tracks_used; t++) print_track(out, p, t);
    fprintf(out,
            "{\"name\": \"problem\", \"mode\": \"%s\", \"start\": \"%s\", \"passive\": \"%s\", \"calm\": %.17g, "
            "\"wind_up\": %.17g",
            modes[d->mode], starts[d->start], d->passive == WIGGLY_FILTER ? "filter" : "oscillator", d->calm,
            d->wind_up);
    print_param(out, p, "frequency", d->frequency);
    print_param(out, p, "damping", d->damping);
    print_param(out, p, "bandwidth", d->bandwidth);
    print_param(out, p, "equilibrium", d->equilibrium);
    fprintf(out, ", \"knots\": [");
    for (int k = 0; k < d->knot_count; k++) {
        const wiggly_knot *knot = &d->knots[k];
        fprintf(out, "%s{\"frame\": %d", k ? ", " : "", knot->sample);
        if (knot->still) fprintf(out, ", \"still\": true");
        if (!knot->still) fprintf(out, ", \"value\": %.17g", knot->value);
        if (knot->settles) fprintf(out, ", \"settles\": true");
        if (knot->has_phase) fprintf(out, ", \"im\": %.17g", knot->phase);
        if (knot->has_slope) fprintf(out, ", \"slope\": %.17g, \"stiffness\": %.17g", knot->slope, knot->stiffness);
        fprintf(out, "}");
    }
    fprintf(out, "]}]}\n");
}

void adversary_explain(FILE *out, const char *name, const struct adversary_verdict *v)
{
    fprintf(out, "%s: %s: said %d, is %d, off by %.3g, estimate %.3g, pivot %.3g, growth %.3g, condition %.2g\n",
            name, v->fault, (int)v->said, (int)v->status, v->error, v->estimate, v->pivot, v->growth, v->condition);
}
