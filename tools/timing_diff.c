/// timing_diff old.csv new.csv: shows which numbers became slower or faster, with confidence intervals.
///
/// The logs must be of the same frames, so that frame n is compared with frame n. Exit status 1 if something worsened beyond its limit or a
/// counter differs in any frame, 2 if the logs cannot be compared, else 0.
#include "base/need.h"
#include "regress/bootstrap.h"
#include "regress/log.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    STRETCH_FRAMES = 60,
    RUNS_ENOUGH = 8
}; ///< five runs all differ in the same direction once in 16 times by chance

/// Worse means an increase above `value`, with the whole interval above `low`. Twelve pairs of runs of one build, alternating on two busy
/// cores (load 6 to 10), differed by at most 0.6 % per frame in stages above 0.1 ms, by 4 % at the frame's p95 and p99, and by 1.1 % in the
/// share of slow frames.
struct limit {
    double value, low;
};
static const struct limit frame_limit = {0.015, 0.005}, quantile_limit = {0.10, 0.05}, share_limit = {0.01, 0.003},
                          longest_limit = {3, 1};
static const double LONGER = 1.5; ///< the longest run of frames must also grow by half

/// Per segment of a log: a sum and a count.
struct tally {
    double sum, of;
};

/// Two logs, and memory to compare them.
struct comparison {
    const struct timing_log *old, *new;
    int segments;
    bool by_run; ///< segments are runs (at least eight), else stretches of 60 frames
    struct observation *old_items, *new_items, *ratios; ///< private
    struct tally *old_tallies, *new_tallies;            ///< private
};

/// A number of both builds. `change` is new over old minus 1 for times, new minus old for shares (1 is all frames) and runs of frames.
struct change {
    double old, new;
    struct estimate change;
    bool worse; ///< beyond its limit, with the whole interval above the lower limit
};

enum { QUANTILE_P50, QUANTILE_P95, QUANTILE_P99, QUANTILE_COUNT };
static const double compared_quantiles[QUANTILE_COUNT] = {0.5, 0.95, 0.99};

static double value_at(const struct timing_log *log, int row, int column)
{
    return log->values[(size_t)row * COLUMN_COUNT + (size_t)column];
}

/// The frames that the bootstrap keeps together: whole runs if there are enough, because runs differ by more than chance, else stretches of
/// about a second.
static int segment_of(const struct comparison *c, const struct timing_log *log, int row)
{
    return c->by_run ? log->run[row] : row / STRETCH_FRAMES;
}

/// Same number of runs and of frames: frame n did the same work in both.
static bool has_same_shape(const struct timing_log *old, const struct timing_log *new)
{
    if (old->rows != new->rows) return false;
    for (int row = 0; row < old->rows; row++) {
        if (old->run[row] != new->run[row]) return false;
        if (value_at(old, row, COLUMN_FRAME) != value_at(new, row, COLUMN_FRAME)) return false;
    }
    return true;
}

static struct comparison comparison_open(const struct timing_log *old, const struct timing_log *new)
{
    const size_t rows = (size_t)old->rows;
    struct comparison c = {.old = old, .new = new, .by_run = old->runs >= RUNS_ENOUGH};
    c.segments = segment_of(&c, old, old->rows - 1) + 1;
    c.old_items = need_zeroed(rows, sizeof *c.old_items);
    c.new_items = need_zeroed(rows, sizeof *c.new_items);
    c.ratios = need_zeroed(rows, sizeof *c.ratios);
    c.old_tallies = need_zeroed(rows, sizeof *c.old_tallies); // at most one segment per frame
    c.new_tallies = need_zeroed(rows, sizeof *c.new_tallies);
    return c;
}

static void comparison_close(struct comparison *c)
{
    free(c->old_items);
    free(c->new_items);
    free(c->ratios);
    free(c->old_tallies);
    free(c->new_tallies);
}

static int observe(const struct comparison *c, const struct timing_log *log, int column, struct observation *items)
{
    int count = 0;
    for (int row = 0; row < log->rows; row++) {
        double value = value_at(log, row, column);
        if (!isnan(value)) items[count++] = (struct observation){value, segment_of(c, log, row)};
    }
    sort_observations(items, count);
    return count;
}

static double ratio_of(double new, double old) { return new == old ? 1 : new / old; }

/// New over old for every frame measured in both logs.
static int observe_ratios(struct comparison *c, int column)
{
    int count = 0;
    for (int row = 0; row < c->old->rows; row++) {
        double ratio = ratio_of(value_at(c->new, row, column), value_at(c->old, row, column));
        if (!isnan(ratio)) c->ratios[count++] = (struct observation){ratio, segment_of(c, c->old, row)};
    }
    sort_observations(c->ratios, count);
    return count;
}

/// Sorted observations, and the quantile to compute.
struct question {
    const struct observation *old, *new;
    int old_count, new_count;
    double p;
};

static double quantile_growth(const int *weight, const void *user)
{
    const struct question *q = user;
    return ratio_of(weighted_quantile(q->new, q->new_count, weight, q->p),
                    weighted_quantile(q->old, q->old_count, weight, q->p)) -
           1;
}

/// The median of the ratios in `new`.
static double frame_growth(const int *weight, const void *user)
{
    const struct question *q = user;
    return weighted_quantile(q->new, q->new_count, weight, 0.5) - 1;
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

/// Quantiles of a column. The change of p50 is the median of the per-frame ratios, which detects a few percent. Returns false, without a
/// change, if no frame was measured in both logs.
static bool compare_times(struct comparison *c, int column, struct change changes[QUANTILE_COUNT])
{
    const struct column *about = &timing_columns[column];
    int old_count = observe(c, c->old, column, c->old_items), new_count = observe(c, c->new, column, c->new_items);
    int ratios = observe_ratios(c, column);
    if (ratios == 0) return false;
    for (int i = 0; i < QUANTILE_COUNT; i++) {
        struct change *change = &changes[i];
        bool by_frame = i == QUANTILE_P50;
        struct question question = {c->old_items, c->new_items, old_count, new_count, compared_quantiles[i]};
        if (by_frame) question.new = c->ratios, question.new_count = ratios;
        change->change = bootstrap(c->segments, by_frame ? frame_growth : quantile_growth, &question);
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

static double mean_growth(const int *weight, const void *user)
{
    const struct comparison *c = user;
    return mean(c->new_tallies, weight, c->segments) - mean(c->old_tallies, weight, c->segments);
}

/// Counts frames over the budget in every segment; returns their share.
static double tally_share(const struct comparison *c, const struct timing_log *log, double budget,
                          struct tally *tallies)
{
    double sum = 0;
    for (int row = 0; row < log->rows; row++) {
        struct tally *tally = &tallies[segment_of(c, log, row)];
        if (row == 0 || tally != &tallies[segment_of(c, log, row - 1)]) *tally = (struct tally){0, 0};
        const bool over = value_at(log, row, COLUMN_FRAME_MS) > budget;
        tally->sum += over;
        tally->of += 1;
        sum += over;
    }
    return sum / log->rows;
}

/// Finds the longest run of frames over the budget in every run of the program; returns their mean.
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

/// Share of frames over a budget, and the mean length of the longest run of them. The latter has an interval only if segments are runs.
static void compare_budget(struct comparison *c, double budget_ms, struct change *share, struct change *longest)
{
    share->old = tally_share(c, c->old, budget_ms, c->old_tallies);
    share->new = tally_share(c, c->new, budget_ms, c->new_tallies);
    share->change = bootstrap(c->segments, mean_growth, c);
    share->worse = is_past(&share->change, share_limit);

    longest->old = tally_longest(c->old, budget_ms, c->old_tallies);
    longest->new = tally_longest(c->new, budget_ms, c->new_tallies);
    longest->change = (struct estimate){longest->new - longest->old, NAN, NAN};
    if (c->by_run) longest->change = bootstrap(c->segments, mean_growth, c);
    longest->worse = is_past(&longest->change, longest_limit) && longest->new > LONGER * longest->old;
}

// --- output

/// Compares a counter frame by frame; returns true if it is the same.
static bool compare_counter(const struct timing_log *old, const struct timing_log *new, int column)
{
    const char *name = timing_columns[column].name;
    for (int row = 0; row < old->rows; row++) {
        double before = value_at(old, row, column), after = value_at(new, row, column);
        if (before == after || (isnan(before) && isnan(after))) continue;
        printf("%-18s DIFFERS first in run %d, frame %g: %g, now %g\n", name, old->run[row] + 1,
               value_at(old, row, COLUMN_FRAME), before, after);
        return false;
    }
    printf("%-18s the same in every frame\n", name);
    return true;
}

static bool compare_column(struct comparison *comparison, int column)
{
    struct change changes[QUANTILE_COUNT];
    bool good = true;
    if (!compare_times(comparison, column, changes)) return true;
    for (int i = 0; i < QUANTILE_COUNT; i++) {
        const struct change *c = &changes[i];
        printf("%-18s p%-3.0f %12.4g %12.4g %+8.1f %%  [%+.1f, %+.1f]%s\n", timing_columns[column].name,
               100 * compared_quantiles[i], c->old, c->new, 100 * c->change.value, 100 * c->change.low,
               100 * c->change.high, c->worse ? "  SLOWER" : "");
        good &= !c->worse;
    }
    return good;
}

static bool compare_budgets(struct comparison *comparison)
{
    bool good = true;
    for (int b = 0; b < BUDGET_COUNT; b++) {
        struct change share, longest;
        compare_budget(comparison, frame_budgets_ms[b], &share, &longest);
        char name[32];
        snprintf(name, sizeof name, "over %.1f ms", frame_budgets_ms[b]);
        printf("%-18s share   %7.1f %% %10.1f %% %+8.1f    [%+.1f, %+.1f]%s\n", name, 100 * share.old,
               100 * share.new, 100 * share.change.value, 100 * share.change.low, 100 * share.change.high,
               share.worse ? "  SLOWER" : "");
        printf("%-18s longest %9.1f %12.1f %+8.1f", name, longest.old, longest.new, longest.change.value);
        if (!isnan(longest.change.low)) printf("    [%+.1f, %+.1f]", longest.change.low, longest.change.high);
        printf("%s\n", longest.worse ? "  SLOWER" : "");
        good &= !share.worse && !longest.worse;
    }
    return good;
}

static bool compare(struct comparison *comparison)
{
    bool good = true;
    printf("%-18s %4s %12s %12s %10s  99 %% interval\n", "", "", "old", "new", "change");
    for (int c = 0; c < COLUMN_COUNT; c++) {
        enum column_use use = timing_columns[c].use;
        if (use == COLUMN_COST || use == COLUMN_WAIT) good &= compare_column(comparison, c);
    }
    good &= compare_budgets(comparison);
    for (int c = 0; c < COLUMN_COUNT; c++) {
        if (timing_columns[c].use == COLUMN_COUNTER) good &= compare_counter(comparison->old, comparison->new, c);
    }
    return good;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "Usage: timing_diff old.csv new.csv\n");
        return 2;
    }
    struct timing_log old = {0}, new = {0};
    struct error error = {0};
    int status = 2;
    const bool read = timing_log_read(argv[1], &old, &error) && timing_log_read(argv[2], &new, &error);
    if (read && !has_same_shape(&old, &new)) {
        fprintf(stderr, "timing_diff: expected two logs of the same frames, got %d frames of %d runs and %d of %d\n",
                old.rows, old.runs, new.rows, new.runs);
    } else if (read) {
        struct comparison comparison = comparison_open(&old, &new);
        status = compare(&comparison) ? 0 : 1;
        comparison_close(&comparison);
    } else {
        fprintf(stderr, "timing_diff: %s\n", error.text);
        if (error.kind == ERROR_ENVIRONMENT) status = ERROR_ENVIRONMENT;
    }
    timing_log_free(&old);
    timing_log_free(&new);
    return status;
}
