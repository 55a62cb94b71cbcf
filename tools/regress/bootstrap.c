/// The bootstrap: draw as many segments as there are, with replacement, and compute the quantity from the frames in them; repeat.
/// A drawn segment only changes how often its frames count, so frames are sorted once, and each repetition walks them adding up
/// weights until the quantile's share of the total is reached.
#include "regress/bootstrap.h"
#include "base/need.h"
#include "maths/maths.h"
#include "timing/framelog.h"
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { RESAMPLES = 1000 };

static int by_value(const void *a, const void *b)
{
    const struct observation *x = a, *y = b;
    return (x->value > y->value) - (x->value < y->value);
}

void sort_observations(struct observation *items, int count)
{
    if (count > 1) qsort(items, (size_t)count, sizeof *items, by_value);
}

double weighted_quantile(const struct observation *sorted, int count, const int *weight, double p)
{
    long total = 0, seen = 0;
    for (int i = 0; i < count; i++) total += weight[sorted[i].segment];
    double share = p * (double)total, lower = NAN;
    for (int i = 0; i < count; i++) {
        if (weight[sorted[i].segment] == 0) continue;
        seen += weight[sorted[i].segment];
        if (isnan(lower) && (double)seen >= share) lower = sorted[i].value;
        if ((double)seen > share) return 0.5 * (lower + sorted[i].value);
    }
    return lower;
}

/// splitmix64: small, seedable, good enough for drawing segments.
static uint64_t next_random(uint64_t *state)
{
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

static void draw_segments(int *weight, int segments, uint64_t *random)
{
    memset(weight, 0, (size_t)segments * sizeof *weight);
    for (int i = 0; i < segments; i++) weight[next_random(random) % (uint64_t)segments]++;
}

struct estimate bootstrap(int segments, bootstrap_quantity *quantity, const void *user)
{
    int *weight = need((size_t)segments, sizeof *weight), count = 0;
    double *values = need(RESAMPLES, sizeof *values);
    uint64_t random = 1;
    for (int i = 0; i < segments; i++) weight[i] = 1;
    struct estimate result = {.value = quantity(weight, user)};
    for (int i = 0; i < RESAMPLES; i++) {
        draw_segments(weight, segments, &random);
        const double value = quantity(weight, user);
        if (!isnan(value)) values[count++] = value;
    }
    qsort(values, (size_t)count, sizeof *values, maths_compare);
    result.low = statistics_quantile(values, count, 0.005);
    result.high = statistics_quantile(values, count, 0.995);
    free(weight);
    free(values);
    return result;
}
