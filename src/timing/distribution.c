/// Prints how a log's frame times are distributed.
#include "base/error.h"
#include "base/need.h"
#include "timing/columns.h"
#include <math.h>
#include <stdlib.h>

enum { BAR = 50, SLOWEST = 5, LOW_NEEDS_FRAMES = 1000 };

/// Histogram of sorted values in steps that read well (1, 2 or 5 times a power of ten), at most 24 up to p99 and one for the rest.
struct histogram {
    double start, step;
    int bins;       ///< the last one takes all that is above
    int counts[26]; ///< values in [start + i·step, start + (i + 1)·step)
    int most;       ///< largest count
};

/// The measured values of a column in the order of the log; `values` has room for all rows. Returns how many.
static int column_values(const struct timing_log *log, int column, double *values)
{
    int count = 0;
    for (int row = 0; row < log->rows; row++) {
        double value = log->values[(size_t)row * COLUMN_COUNT + (size_t)column];
        if (!isnan(value)) values[count++] = value;
    }
    return count;
}

/// The smallest of 1, 2 and 5 times a power of ten that is not below `least`.
static double round_step(double least)
{
    double power = pow(10, floor(log10(least)));
    double times = least / power;
    return power * (times <= 1 ? 1 : times <= 2 ? 2 : times <= 5 ? 5 : 10);
}

static struct histogram histogram_of(const double *sorted, int count)
{
    struct histogram h = {.bins = 1};
    double high = statistics_quantile(sorted, count, 0.99);
    h.step = round_step(fmax((high - sorted[0]) / 24, 1e-3));
    h.start = h.step * floor(sorted[0] / h.step);
    h.bins = (int)fmin(floor((high - h.start) / h.step) + 2, 26);
    for (int i = 0; i < count; i++) h.counts[(int)fmin(floor((sorted[i] - h.start) / h.step), h.bins - 1)]++;
    for (int i = 0; i < h.bins; i++) h.most = h.counts[i] > h.most ? h.counts[i] : h.most;
    return h;
}

static void print_percentiles(const struct timing_log *log, double *values, FILE *out)
{
    fprintf(out, "\n%-18s %10s %10s %10s %10s\n", "", "p50", "p95", "p99", "largest");
    for (int c = 0; c < COLUMN_COUNT; c++) {
        enum column_use use = timing_columns[c].use;
        int count = column_values(log, c, values);
        if ((use != COLUMN_COST && use != COLUMN_WAIT) || count == 0) continue;
        statistics_sort(values, count);
        int decimals = timing_columns[c].is_count ? 0 : timing_columns[c].decimals > 1 ? 3 : 1;
        fprintf(out, "%-18s", timing_columns[c].name);
        for (int i = 0; i < 4; i++) {
            static const double at[] = {0.5, 0.95, 0.99, 1};
            fprintf(out, " %10.*f", decimals, statistics_quantile(values, count, at[i]));
        }
        fputc('\n', out);
    }
}

/// Share and longest run of frames over each budget; a run of frames ends with its program run.
static void print_budgets(const struct timing_log *log, double *values, FILE *out)
{
    fputc('\n', out);
    for (int b = 0; b < BUDGET_COUNT; b++) {
        struct over_budget all = {0, 0};
        for (int row = 0, start = 0; row < log->rows; row++) {
            values[row] = log->values[(size_t)row * COLUMN_COUNT + COLUMN_FRAME_MS];
            if (row + 1 < log->rows && log->run[row + 1] == log->run[row]) continue;
            struct over_budget over = statistics_over(values + start, row + 1 - start, frame_budgets_ms[b]);
            all.frames += over.frames;
            all.longest = over.longest > all.longest ? over.longest : all.longest;
            start = row + 1;
        }
        fprintf(out, "over %.1f ms       %d of %d frames (%.1f %%), up to %d in a row\n", frame_budgets_ms[b],
                all.frames, log->rows, 100.0 * all.frames / log->rows, all.longest);
    }
    int count = column_values(log, COLUMN_FRAME_INTERVAL_MS, values);
    if (count < LOW_NEEDS_FRAMES) return;
    statistics_sort(values, count);
    fprintf(out, "1 %% low            %.1f fps\n", 1000 / statistics_quantile(values, count, 0.99));
}

static void print_histogram(const struct timing_log *log, double *values, FILE *out)
{
    int count = column_values(log, COLUMN_FRAME_MS, values);
    if (count == 0) return;
    statistics_sort(values, count);
    struct histogram h = histogram_of(values, count);
    int decimals = (int)fmax(0, ceil(-log10(h.step) - 1e-9));
    fprintf(out, "\nframe_ms\n");
    for (int i = 0; i < h.bins; i++) {
        double from = h.start + i * h.step;
        double to = i < h.bins - 1 ? from + h.step : fmax(values[count - 1], from);
        fprintf(out, "%8.*f to %-8.*f %7d ", decimals, from, decimals, to, h.counts[i]);
        int length = (int)ceil((double)BAR * h.counts[i] / h.most);
        for (int k = 0; k < length; k++) fputs("█", out);
        fputc('\n', out);
    }
}

/// For the slowest frames, the stages that took at least a tenth.
static void print_slowest(const struct timing_log *log, FILE *out)
{
    int shown[SLOWEST];
    fprintf(out, "\nslowest frames\n");
    for (int n = 0; n < SLOWEST && n < log->rows; n++) {
        int worst = -1;
        for (int row = 0; row < log->rows; row++) {
            bool taken = false;
            for (int k = 0; k < n; k++) taken |= shown[k] == row;
            double ms = log->values[(size_t)row * COLUMN_COUNT + COLUMN_FRAME_MS];
            if (!taken && (worst < 0 || ms > log->values[(size_t)worst * COLUMN_COUNT + COLUMN_FRAME_MS]))
                worst = row;
        }
        shown[n] = worst;
        const double *row = &log->values[(size_t)worst * COLUMN_COUNT];
        fprintf(out, "run %d frame %-6.0f at %8.3f s %9.3f ms:", log->run[worst] + 1, row[COLUMN_FRAME],
                row[COLUMN_TIME], row[COLUMN_FRAME_MS]);
        for (int c = COLUMN_INPUT_US; c <= COLUMN_SWAP_US; c++) {
            if (row[c] > 100 * row[COLUMN_FRAME_MS]) fprintf(out, " %s %.0f", timing_columns[c].name, row[c]);
        }
        fputc('\n', out);
    }
}

void distribution_print(const struct timing_log *log, const char *name, FILE *out)
{
    double *values = need_zeroed((size_t)log->rows, sizeof *values);
    print_line(out, "%s: %d frames of %d %s, without the warm-up ones", name, log->rows, log->runs,
               log->runs == 1 ? "run" : "runs");
    if (log->solvers[0]) print_line(out, "solver: %s", log->solvers);
    print_percentiles(log, values, out);
    print_budgets(log, values, out);
    print_histogram(log, values, out);
    print_slowest(log, out);
    free(values);
}
