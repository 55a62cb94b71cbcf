/// timing_diff old.csv new.csv: what became slower or faster, column by column, and how sure that is.
///
/// Exit status 1 where a column's median grew by more than 10 % and the whole 95 % interval of the ratio lies past +5 %, or
/// where a counter differs in any frame; 2 where the logs cannot be compared; else 0.
#include "timing/readlog.h"
#include "timing/statistics.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STRETCH_FRAMES = 60, RUNS_ENOUGH = 5 };
static const double MEDIAN_LIMIT = 1.10, INTERVAL_LIMIT = 1.05;

/// Which frames the bootstrap keeps together: runs where there are enough of them, because the machine drifts between runs;
/// else stretches of about a second.
static int segment_of(const struct timing_log *log, int row)
{
    return log->runs >= RUNS_ENOUGH ? log->run[row] : row / STRETCH_FRAMES;
}

/// The measured values of a column; `items` has room for all rows.
static struct observations observe(const struct timing_log *log, int column, struct observation *items)
{
    struct observations set = {.items = items, .segments = segment_of(log, log->rows - 1) + 1};
    for (int row = 0; row < log->rows; row++) {
        double value = log->values[(size_t)row * COLUMN_COUNT + (size_t)column];
        if (!isnan(value)) items[set.count++] = (struct observation){value, segment_of(log, row)};
    }
    return set;
}

/// Compares a counter frame by frame; true where it is the same.
static bool compare_counter(const struct timing_log *old, const struct timing_log *new, int column)
{
    const char *name = timing_columns[column].name;
    for (int row = 0; row < old->rows && row < new->rows; row++) {
        double before = old->values[(size_t)row * COLUMN_COUNT + (size_t)column];
        double after = new->values[(size_t)row * COLUMN_COUNT + (size_t)column];
        if (before == after || (isnan(before) && isnan(after))) continue;
        printf("%-18s DIFFERS first in run %d, frame %g: %g, now %g\n", name, old->run[row] + 1,
               old->values[(size_t)row * COLUMN_COUNT + COLUMN_FRAME], before, after);
        return false;
    }
    printf("%-18s the same in every frame\n", name);
    return true;
}

/// Compares a time; true where it did not become slower. `old_items` and `new_items` have room for all rows.
static bool compare_times(const struct timing_log *old, const struct timing_log *new, int column,
                          struct observation *old_items, struct observation *new_items)
{
    const struct column *about = &timing_columns[column];
    struct observations before = observe(old, column, old_items), after = observe(new, column, new_items);
    if (before.count == 0 || after.count == 0) {
        printf("%-18s %12s %12s\n", about->name, before.count ? "measured" : "NA", after.count ? "measured" : "NA");
        return true;
    }
    struct median_ratio m;
    bool paired = old->runs == new->runs && old->runs >= RUNS_ENOUGH; // runs taken in turn, as make regress does
    if (!statistics_median_ratio(&before, &after, paired, &m)) {
        fprintf(stderr, "timing_diff: out of memory\n");
        exit(3);
    }
    bool grew = m.ratio > MEDIAN_LIMIT && m.low > INTERVAL_LIMIT && m.new_median - m.old_median > about->grain;
    bool slower = grew && about->use == COLUMN_COST;
    printf("%-18s %12.4g %12.4g %8.3f   [%.3f, %.3f]%s\n", about->name, m.old_median, m.new_median, m.ratio, m.low,
           m.high, slower ? "  SLOWER" : "");
    return !slower;
}

static bool compare(const struct timing_log *old, const struct timing_log *new, struct observation *old_items,
                    struct observation *new_items)
{
    bool good = true;
    printf("%-18s %12s %12s %8s   95 %% interval\n", "median of", "old", "new", "ratio");
    for (int c = 0; c < COLUMN_COUNT; c++) {
        enum column_use use = timing_columns[c].use;
        if (use == COLUMN_COST || use == COLUMN_WAIT) good &= compare_times(old, new, c, old_items, new_items);
    }
    if (old->rows != new->rows) {
        printf("counters           NOT COMPARED over all frames: %d frames, now %d\n", old->rows, new->rows);
        good = false;
    }
    for (int c = 0; c < COLUMN_COUNT; c++) {
        if (timing_columns[c].use == COLUMN_COUNTER) good &= compare_counter(old, new, c);
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
    if (!timing_log_read(argv[1], &old, &error) || !timing_log_read(argv[2], &new, &error)) {
        fprintf(stderr, "timing_diff: %s\n", error.text);
        timing_log_free(&old);
        return 2;
    }
    struct observation *old_items = calloc((size_t)old.rows, sizeof *old_items);
    struct observation *new_items = calloc((size_t) new.rows, sizeof *new_items);
    int status = 3;
    if (old_items && new_items) {
        status = compare(&old, &new, old_items, new_items) ? 0 : 1;
    } else {
        fprintf(stderr, "timing_diff: out of memory\n");
    }
    free(old_items);
    free(new_items);
    timing_log_free(&old);
    timing_log_free(&new);
    return status;
}
