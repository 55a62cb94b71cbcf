/// Compares the logs of two builds by bootstrap intervals.
#include "timing/compare.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    STRETCH_FRAMES = 60,
    RUNS_ENOUGH = 8
}; ///< five runs all differ in the same direction once in 16 times by chance

/// Worse means grown by more than `value`, with the whole interval above `low`. Twelve pairs of runs of one build, in turn on
/// two busy cores (load 6 to 10), differed by at most 0.6 % frame by frame in stages above 0.1 ms, by 4 % at p95 and p99
/// of the frame, and by 1.1 % in the share of slow frames.
struct limit {
    double value, low;
};
static const struct limit frame_limit = {0.015, 0.005}, quantile_limit = {0.10, 0.05}, share_limit = {0.01, 0.003},
                          longest_limit = {3, 1};
static const double LONGER = 1.5; ///< and the longest run of frames has to grow by half

/// Per segment of a log: a sum, and of how many.
struct tally {
    double sum, of;
};

const double compared_quantiles[QUANTILE_COUNT] = {0.5, 0.95, 0.99};

static double value_at(const struct timing_log *log, int row, int column)
{
    return log->values[(size_t)row * COLUMN_COUNT + (size_t)column];
}

/// Which frames the bootstrap keeps together: whole runs if there are enough, because runs differ by more than chance;
/// else stretches of about a second.
static int segment_of(const struct comparison *c, const struct timing_log *log, int row)
{
    return c->by_run ? log->run[row] : row / STRETCH_FRAMES;
}

static bool has_same_shape(const struct timing_log *old, const struct timing_log *new)
{
    if (old->rows != new->rows) return false;
    for (int row = 0; row < old->rows; row++) {
        if (old->run[row] != new->run[row]) return false;
        if (value_at(old, row, COLUMN_FRAME) != value_at(new, row, COLUMN_FRAME)) return false;
    }
    return true;
}

bool comparison_open(struct comparison *c, const struct timing_log *old, const struct timing_log *new,
                     struct error *error)
{
    *c = (struct comparison){.old = old, .new = new};
    c->same_shape = has_same_shape(old, new);
    c->by_run = old->runs >= RUNS_ENOUGH && new->runs >= RUNS_ENOUGH;
    c->segments.old_count = segment_of(c, old, old->rows - 1) + 1;
    c->segments.new_count = segment_of(c, new, new->rows - 1) + 1;
    c->segments.paired = c->same_shape;
    c->old_items = calloc((size_t)old->rows, sizeof *c->old_items);
    c->new_items = calloc((size_t) new->rows, sizeof *c->new_items);
    c->ratios = calloc((size_t)old->rows, sizeof *c->ratios);
    c->old_tallies = calloc((size_t)old->rows, sizeof *c->old_tallies); // at most a run or a stretch a frame
    c->new_tallies = calloc((size_t) new->rows, sizeof *c->new_tallies);
    if (c->old_items && c->new_items && c->ratios && c->old_tallies && c->new_tallies) return true;
    comparison_close(c);
    return fail_no_memory(error, "comparing timing logs");
}

void comparison_close(struct comparison *c)
{
    free(c->old_items);
    free(c->new_items);
    free(c->ratios);
    free(c->old_tallies);
    free(c->new_tallies);
    *c = (struct comparison){0};
}

static int observe(const struct comparison *c, const struct timing_log *log, int column, struct observation *items)
{
    int count = 0;
    for (int row = 0; row < log->rows; row++) {
        double value = value_at(log, row, column);
        if (!isnan(value)) items[count++] = (struct observation){value, segment_of(c, log, row)};
    }
    statistics_sort_observations(items, count);
    return count;
}

static double ratio_of(double new, double old) { return new == old ? 1 : new / old; }

/// New over old, for every frame that both measured.
static int observe_ratios(struct comparison *c, int column)
{
    int count = 0;
    for (int row = 0; row < c->old->rows; row++) {
        double ratio = ratio_of(value_at(c->new, row, column), value_at(c->old, row, column));
        if (!isnan(ratio)) c->ratios[count++] = (struct observation){ratio, segment_of(c, c->old, row)};
    }
    statistics_sort_observations(c->ratios, count);
    return count;
}

/// Sorted observations, and which quantile of them is asked for.
struct question {
    const struct observation *old, *new;
    int old_count, new_count;
    double p;
};

static double quantile_growth(const int *old_weight, const int *new_weight, const void *user)
{
    const struct question *q = user;
    return ratio_of(statistics_weighted_quantile(q->new, q->new_count, new_weight, q->p),
                    statistics_weighted_quantile(q->old, q->old_count, old_weight, q->p)) -
           1;
}

/// The median of ratios, which are in `new`.
static double frame_growth(const int *old_weight, const int *new_weight, const void *user)
{
    (void)old_weight;
    const struct question *q = user;
    return statistics_weighted_quantile(q->new, q->new_count, new_weight, 0.5) - 1;
}

static bool is_past(const struct estimate *change, struct limit limit)
{
    return change->value > limit.value && change->low > limit.low;
}

static double plain_quantile(const struct observation *sorted, int count, double p)
{
    double position = p * (count - 1);
    int below = (int)position, above = below + 1 < count ? below + 1 : below;
    return sorted[below].value + (position - below) * (sorted[above].value - sorted[below].value);
}

bool compare_times(struct comparison *c, int column, struct change changes[QUANTILE_COUNT])
{
    const struct column *about = &timing_columns[column];
    int old_count = observe(c, c->old, column, c->old_items), new_count = observe(c, c->new, column, c->new_items);
    int ratios = c->same_shape ? observe_ratios(c, column) : 0;
    if (old_count == 0 || new_count == 0) return false;
    for (int i = 0; i < QUANTILE_COUNT; i++) {
        struct change *change = &changes[i];
        bool by_frame = i == QUANTILE_P50 && ratios > 0;
        struct question question = {c->old_items, c->new_items, old_count, new_count, compared_quantiles[i]};
        if (by_frame) question.new = c->ratios, question.new_count = ratios;
        if (!statistics_bootstrap(&c->segments, by_frame ? frame_growth : quantile_growth, &question,
                                  &change->change))
            return false;
        change->old = plain_quantile(c->old_items, old_count, compared_quantiles[i]);
        change->new = plain_quantile(c->new_items, new_count, compared_quantiles[i]);
        double grew = by_frame && change->old > 0 ? change->change.value * change->old : change->new - change->old;
        change->worse = about->use == COLUMN_COST && grew > (i == QUANTILE_P50 ? about->grain : about->tail_grain) &&
                        is_past(&change->change, by_frame ? frame_limit : quantile_limit);
    }
    return true;
}

static double mean(const struct tally *tallies, const int *weight, int count)
{
    double sum = 0, of = 0;
    for (int i = 0; i < count; i++) {
        sum += weight[i] * tallies[i].sum;
        of += weight[i] * tallies[i].of;
    }
    return sum / of;
}

static double mean_growth(const int *old_weight, const int *new_weight, const void *user)
{
    const struct comparison *c = user;
    return mean(c->new_tallies, new_weight, c->segments.new_count) -
           mean(c->old_tallies, old_weight, c->segments.old_count);
}

/// Frames over the budget in every segment.
static void tally_share(const struct comparison *c, const struct timing_log *log, double budget,
                        struct tally *tallies)
{
    for (int row = 0; row < log->rows; row++) {
        struct tally *tally = &tallies[segment_of(c, log, row)];
        if (row == 0 || tally != &tallies[segment_of(c, log, row - 1)]) *tally = (struct tally){0, 0};
        tally->sum += value_at(log, row, COLUMN_FRAME_MS) > budget;
        tally->of += 1;
    }
}

/// The longest run of frames over the budget in every run of the program; returns the mean over these.
static double tally_longest(const struct timing_log *log, double budget, struct tally *tallies)
{
    double sum = 0;
    for (int row = 0, start = 0, length = 0, longest = 0; row < log->rows; row++) {
        length = value_at(log, row, COLUMN_FRAME_MS) > budget ? length + 1 : 0;
        longest = length > longest ? length : longest;
        if (row + 1 < log->rows && log->run[row + 1] == log->run[start]) continue;
        tallies[log->run[row]] = (struct tally){longest, 1};
        sum += longest;
        start = row + 1;
        length = longest = 0;
    }
    return sum / log->runs;
}

static double all_of(const struct tally *tallies, int count)
{
    double sum = 0, of = 0;
    for (int i = 0; i < count; i++) sum += tallies[i].sum, of += tallies[i].of;
    return sum / of;
}

bool compare_budget(struct comparison *c, double budget_ms, struct change *share, struct change *longest)
{
    tally_share(c, c->old, budget_ms, c->old_tallies);
    tally_share(c, c->new, budget_ms, c->new_tallies);
    share->old = all_of(c->old_tallies, c->segments.old_count);
    share->new = all_of(c->new_tallies, c->segments.new_count);
    if (!statistics_bootstrap(&c->segments, mean_growth, c, &share->change)) return false;
    share->worse = is_past(&share->change, share_limit);

    longest->old = tally_longest(c->old, budget_ms, c->old_tallies);
    longest->new = tally_longest(c->new, budget_ms, c->new_tallies);
    longest->change = (struct estimate){longest->new - longest->old, NAN, NAN};
    if (c->by_run && !statistics_bootstrap(&c->segments, mean_growth, c, &longest->change)) return false;
    longest->worse = is_past(&longest->change, longest_limit) && longest->new > LONGER * longest->old;
    return true;
}
