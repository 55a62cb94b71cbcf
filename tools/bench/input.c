/// The benchmark's splines: frequency 1, damping 0.05, 24 samples per second, about one knot per second.
#include "base/need.h"
#include "bench/bench.h"
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

enum { KNOT_EVERY = 24, LEAST_GAP = 12, GAPS = 25 };
static const double pi = 3.14159265358979323846;

static bool has_slope(enum bench_kind kind, int knot, bool last)
{
    if (kind == BENCH_SLOPES) return knot % 2 == 1;
    return kind == BENCH_END_SLOPES && (knot == 0 || last);
}

static void add_knot(struct bench_input *input, int sample, bool with_slope)
{
    int k = input->desc.knot_count++;
    input->knots[k] = (wiggly_knot){.sample = sample,
                                    .value = sin(1.7 * k),
                                    .has_slope = with_slope,
                                    .slope = with_slope ? 2 * cos(0.9 * k) : 0,
                                    .stiffness = 1000};
}

/// Gaps between LEAST_GAP and 2 KNOT_EVERY − LEAST_GAP in pseudo-random order.
static void add_knots(struct bench_input *input, enum bench_kind kind)
{
    bool even = kind == BENCH_SINGLE, ends = kind == BENCH_ENDS || kind == BENCH_END_SLOPES;
    int last = input->desc.samples - 1;
    uint32_t seed = 11;
    int sample = even || ends ? 0 : LEAST_GAP / 2;
    while (sample < last - (ends ? LEAST_GAP : 0)) {
        add_knot(input, sample, has_slope(kind, input->desc.knot_count, false));
        seed = seed * 1664525 + 1013904223;
        sample += even ? KNOT_EVERY : LEAST_GAP + (int)(seed >> 24) % GAPS;
    }
    if (ends) add_knot(input, last, has_slope(kind, input->desc.knot_count, true));
}

static void set_limits(struct bench_input *input, double by)
{
    double largest = 0;
    for (int k = 0; k < input->desc.knot_count; k++) largest = fmax(largest, fabs(input->knots[k].value));
    input->desc.high = by * largest;
    input->desc.low = -input->desc.high;
    input->desc.has_low = input->desc.has_high = true;
}

/// Oscillates about every 15 seconds; in a loop it would close.
static void add_track(struct bench_input *input, wiggly_param *param, double middle, double by)
{
    for (int i = 0; i < input->desc.samples; i++) input->track[i] = middle + by * sin(2 * pi * i / (15 * KNOT_EVERY));
    param->track = input->track;
}

void bench_input_create(struct bench_input *input, enum bench_kind kind, wiggly_mode mode, int samples)
{
    *input = (struct bench_input){
        .desc = wiggly_default_desc(),
        .knots = need_zeroed((size_t)samples / LEAST_GAP + 3, sizeof *input->knots),
        .track = need_zeroed((size_t)samples, sizeof *input->track),
    };
    wiggly_desc *desc = &input->desc;
    desc->knots = input->knots;
    desc->samples = samples;
    desc->mode = mode;
    desc->frequency.value = kind == BENCH_SHORT ? 1 / ((samples - 1) * desc->step) : 1;
    desc->damping.value = 0.05;
    if (kind == BENCH_LOOP) desc->start = WIGGLY_LOOP;
    if (kind == BENCH_REST) desc->start = WIGGLY_REST;
    if (kind == BENCH_EQUILIBRIUM) add_track(input, &desc->equilibrium, 0, 1);
    if (kind == BENCH_WIND_UP || kind == BENCH_WIND_UP_TRACK) desc->wind_up = 0.5;
    if (kind == BENCH_TRACK || kind == BENCH_WIND_UP_TRACK) add_track(input, &desc->frequency, 1, 0.4);
    add_knots(input, kind);
    if (kind == BENCH_LIMITS) set_limits(input, 1.02);
    if (kind == BENCH_VARIATION) desc->variation = 0.5, desc->variation_seed = 7;
}

void bench_input_destroy(struct bench_input *input)
{
    free(input->knots);
    free(input->track);
}
