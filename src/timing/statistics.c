/// The bootstrap: draw as many segments as there are, with replacement, and take the median of the frames in them; repeat.
/// A drawn segment only changes how often its frames count, so the frames are sorted once and each repetition walks them
/// adding up weights until half of the total is reached.
#include "timing/statistics.h"
#include <assert.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { RESAMPLES = 1000 };

static int by_number(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void statistics_sort(double *values, int count)
{
    if (count > 1) qsort(values, (size_t)count, sizeof *values, by_number);
}

double statistics_quantile(const double *sorted, int count, double p)
{
    if (count < 1) return NAN;
    double position = p * (count - 1);
    int below = (int)position;
    int above = below + 1 < count ? below + 1 : below;
    return sorted[below] + (position - below) * (sorted[above] - sorted[below]);
}

const double frame_budgets_ms[BUDGET_COUNT] = {1000.0 / 60, 1000.0 / 30};

struct over_budget statistics_over(const double *values, int count, double budget)
{
    struct over_budget over = {0, 0};
    for (int i = 0, run = 0; i < count; i++) {
        run = values[i] > budget ? run + 1 : 0;
        over.frames += run > 0;
        if (run > over.longest) over.longest = run;
    }
    return over;
}

static int by_value(const void *a, const void *b)
{
    const struct observation *x = a, *y = b;
    return (x->value > y->value) - (x->value < y->value);
}

/// splitmix64: small, seedable, good enough for drawing segments.
static uint64_t next_random(uint64_t *state)
{
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/// Lower and upper median of the sorted items, each counted weight[segment] times, and the mean of the two. NAN for none.
static double weighted_median(const struct observations *set, const int *weight)
{
    long total = 0;
    for (int i = 0; i < set->count; i++) total += weight[set->items[i].segment];
    if (total == 0) return NAN;
    long seen = 0;
    double lower = NAN;
    for (int i = 0; i < set->count; i++) {
        seen += weight[set->items[i].segment];
        if (isnan(lower) && 2 * seen >= total) lower = set->items[i].value;
        if (2 * seen > total) return 0.5 * (lower + set->items[i].value);
    }
    return lower;
}

static void draw_segments(int *weight, int segments, uint64_t *random)
{
    memset(weight, 0, (size_t)segments * sizeof *weight);
    for (int i = 0; i < segments; i++) weight[next_random(random) % (uint64_t)segments]++;
}

static double plain_median(const struct observations *set, int *weight)
{
    for (int i = 0; i < set->segments; i++) weight[i] = 1;
    return weighted_median(set, weight);
}

static double ratio_of(double new, double old) { return new == old ? 1 : new / old; }

/// Medians' ratios of RESAMPLES draws, sorted; returns how many draws had measurements of both.
static int resample(const struct observations *old, const struct observations *new, bool paired, int *weight,
                    double *ratios)
{
    uint64_t random = 1;
    int count = 0;
    for (int i = 0; i < RESAMPLES; i++) {
        draw_segments(weight, old->segments, &random);
        double old_median = weighted_median(old, weight);
        if (!paired) draw_segments(weight, new->segments, &random);
        double ratio = ratio_of(weighted_median(new, weight), old_median);
        if (!isnan(ratio)) ratios[count++] = ratio;
    }
    statistics_sort(ratios, count);
    return count;
}

bool statistics_median_ratio(struct observations *old, struct observations *new, bool paired,
                             struct median_ratio *result)
{
    assert(!paired || old->segments == new->segments);
    int segments = old->segments > new->segments ? old->segments : new->segments;
    int *weight = malloc((size_t)segments * sizeof *weight);
    double *ratios = malloc(RESAMPLES * sizeof *ratios);
    bool done = weight && ratios;
    if (done) {
        qsort(old->items, (size_t)old->count, sizeof *old->items, by_value);
        qsort(new->items, (size_t) new->count, sizeof *new->items, by_value);
        result->old_median = plain_median(old, weight);
        result->new_median = plain_median(new, weight);
        result->ratio = ratio_of(result->new_median, result->old_median);
        int count = resample(old, new, paired, weight, ratios);
        result->low = statistics_quantile(ratios, count, 0.025);
        result->high = statistics_quantile(ratios, count, 0.975);
    }
    free(weight);
    free(ratios);
    return done;
}
