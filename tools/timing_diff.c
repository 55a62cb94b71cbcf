/// timing_diff old.csv new.csv: what became slower or faster, number by number, and how sure that is.
///
/// Exit status 1 where something became worse by more than its limit (see timing/compare.c) or a counter differs in any
/// frame; 2 where the logs cannot be compared; else 0.
#include "timing/compare.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { OUT_OF_MEMORY = 3 };

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
        if (!compare_budget(comparison, frame_budgets_ms[b], &share, &longest)) {
            fprintf(stderr, "timing_diff: out of memory\n");
            exit(OUT_OF_MEMORY);
        }
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
    const struct timing_log *old = comparison->old, *new = comparison->new;
    bool good = true;
    printf("%-18s %4s %12s %12s %10s  99 %% interval\n", "", "", "old", "new", "change");
    for (int c = 0; c < COLUMN_COUNT; c++) {
        enum column_use use = timing_columns[c].use;
        if (use == COLUMN_COST || use == COLUMN_WAIT) good &= compare_column(comparison, c);
    }
    good &= compare_budgets(comparison);
    if (!comparison->same_shape) {
        printf("counters           NOT COMPARED over all frames: %d frames of %d runs, now %d of %d\n", old->rows,
               old->runs, new->rows, new->runs);
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
    struct comparison comparison = {0};
    struct error error = {0};
    int status = 2;
    if (timing_log_read(argv[1], &old, &error) && timing_log_read(argv[2], &new, &error) &&
        comparison_open(&comparison, &old, &new, &error)) {
        status = compare(&comparison) ? 0 : 1;
    } else {
        fprintf(stderr, "timing_diff: %s\n", error.text);
        if (error.kind == ERROR_ENVIRONMENT) status = OUT_OF_MEMORY;
    }
    comparison_close(&comparison);
    timing_log_free(&old);
    timing_log_free(&new);
    return status;
}
