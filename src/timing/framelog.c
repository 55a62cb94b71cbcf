/// Collects frames, writes the timing log and sums it up.
#include "timing/framelog.h"
#include "base/embedded.h"
#include "base/file.h"
#include "base/need.h"
#include "maths/maths.h"
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <wiggly/wiggly.h>

// --- columns, and what sums one up

#define ROW(field) #field, .offset = offsetof(struct frame_row, field)

const struct column timing_columns[COLUMN_COUNT] = {
    {ROW(frame), .use = COLUMN_LABEL, .is_count = true},
    {ROW(t_s), .use = COLUMN_LABEL, .decimals = 6},
    {ROW(frame_ms), .use = COLUMN_COST, .decimals = 4, .grain = 0.001, .tail_grain = 0.25},
    {ROW(frame_interval_ms), .use = COLUMN_COST, .decimals = 4, .grain = 0.001, .tail_grain = 0.25},
    {ROW(wait_us), .use = COLUMN_WAIT, .decimals = 1},
    {ROW(input_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(edit_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(solve_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(pose_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(upload_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(draw_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(gpu_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(swap_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(splines_solved), .use = COLUMN_COUNTER, .is_count = true},
    {ROW(samples), .use = COLUMN_COUNTER, .is_count = true},
    {ROW(knots), .use = COLUMN_COUNTER, .is_count = true},
    {ROW(edited), .use = COLUMN_COUNTER, .is_count = true},
    {ROW(event_to_swap_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(allocations), .use = COLUMN_COST, .is_count = true},
    {ROW(uploaded_bytes), .use = COLUMN_COST, .is_count = true},
};

/// The number in a column of a row; NAN where it was not measured.
static double column_value(const struct column *column, const struct frame_row *row)
{
    const char *field = (const char *)row + column->offset;
    if (column->is_count) {
        long count;
        memcpy(&count, field, sizeof count);
        return count < 0 ? NAN : (double)count;
    }
    double value;
    memcpy(&value, field, sizeof value);
    return value;
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

// --- the summary

/// A column of the first `rows` kept frames, as far as it was measured, in their order; `values` has room for all. Returns how many.
static int column_values(const double *kept, int rows, int column, double *values)
{
    int count = 0;
    for (int row = 0; row < rows; row++) {
        const double value = kept[(size_t)row * COLUMN_COUNT + (size_t)column];
        if (!isnan(value)) values[count++] = value;
    }
    return count;
}

/// Percentiles of some columns, as far as they were measured; frames over budget, and the rate that all but 1 % of the frames reach, of
/// enough frames.
static void summary_print(const double *kept, int rows, FILE *out)
{
    enum { ENOUGH_FOR_LOW = 1000 };
    static const int columns[] = {COLUMN_FRAME_MS, COLUMN_FRAME_INTERVAL_MS, COLUMN_SOLVE_US,
                                  COLUMN_EVENT_TO_SWAP_US};
    static const double at[] = {0.5, 0.95, 0.99, 1};
    double *values = need_zeroed((size_t)rows, sizeof *values);
    const double *last = &kept[(size_t)(rows - 1) * COLUMN_COUNT];
    const double elapsed = last[COLUMN_TIME] + last[COLUMN_FRAME_MS] / 1000 - kept[COLUMN_TIME];
    fprintf(out, "live: %d frames in %.2f s, %.1f fps on average, without the warm-up ones\n", rows, elapsed,
            rows / elapsed);
    fprintf(out, "\n%-18s %10s %10s %10s %10s\n", "", "p50", "p95", "p99", "largest");
    for (int c = 0; c < 4; c++) {
        const struct column *column = &timing_columns[columns[c]];
        const int count = column_values(kept, rows, columns[c], values);
        if (count == 0) continue;
        qsort(values, (size_t)count, sizeof *values, maths_compare);
        fprintf(out, "%-18s", column->name);
        for (int i = 0; i < 4; i++)
            fprintf(out, " %10.*f", column->decimals > 1 ? 3 : 1, statistics_quantile(values, count, at[i]));
        fputc('\n', out);
    }
    fputc('\n', out);
    const int frames = column_values(kept, rows, COLUMN_FRAME_MS, values);
    for (int b = 0; b < BUDGET_COUNT; b++) {
        const struct over_budget over = statistics_over(values, frames, frame_budgets_ms[b]);
        fprintf(out, "over %.1f ms       %d of %d frames (%.1f %%), up to %d in a row\n", frame_budgets_ms[b],
                over.frames, rows, 100.0 * over.frames / rows, over.longest);
    }
    const int intervals = column_values(kept, rows, COLUMN_FRAME_INTERVAL_MS, values);
    qsort(values, (size_t)intervals, sizeof *values, maths_compare);
    if (intervals >= ENOUGH_FOR_LOW)
        fprintf(out, "%-18s %.1f fps\n", "1 % low", 1000 / statistics_quantile(values, intervals, 0.99));
    free(values);
}

// --- writing a log

enum { BLOCK_ROWS = 256, LATE_ROWS = 16 }; ///< the last rows wait for their GPU times

struct framelog {
    FILE *file; ///< NULL: for the summary only, or a write failed
    char *path;
    int write_errno; ///< of the first failed write
    int warm_up;
    const char *solver;                ///< as the file says so far
    struct frame_row rows[BLOCK_ROWS]; ///< ring: row n of the run at n % BLOCK_ROWS
    double *kept; ///< for the summary, COLUMN_COUNT a row; ring: row n after the warm-up at n % capacity
    int capacity;
    long pushed, written; ///< rows of the run so far
};

static void write_solver(FILE *file, const char *solver) { fprintf(file, "# solver: %s\n", solver ? solver : "NA"); }

static void write_header(FILE *file, const struct frame_header *header)
{
    struct utsname os;
    bool known = uname(&os) == 0;
    fprintf(file, "# schema: " TIMING_SCHEMA "\n");
    fprintf(file, "# wiggly: %s (%s)\n", WIGGLY_VERSION, build_commit);
    fprintf(file, "# compiler: %s %s\n", build_compiler, build_flags);
    fprintf(file, "# os: %s %s %s\n", known ? os.sysname : "NA", known ? os.release : "", known ? os.machine : "");
    char line[256], *cpu = NULL;
    FILE *info = fopen("/proc/cpuinfo", "r");
    while (info && !cpu && fgets(line, sizeof line, info))
        cpu = strncmp(line, "model name", 10) == 0 ? strchr(line, ':') : NULL;
    if (info) fclose(info);
    fprintf(file, "# cpu: %s", cpu ? cpu + 2 : "NA\n");
    fprintf(file, "# gl_renderer: %s\n", header->gl_renderer ? header->gl_renderer : "NA");
    fprintf(file, "# size: %dx%d scale %g\n", header->width, header->height, (double)header->scale);
    fprintf(file, "# vsync: %d\n", header->vsync);
    write_solver(file, header->solver);
    fprintf(file, "# warm_up_frames: %d\n", header->warm_up);
    if (isnan(header->first_frame_ms))
        fputs("# first_frame_ms: NA\n", file);
    else
        fprintf(file, "# first_frame_ms: %.3f\n", header->first_frame_ms);
    for (int c = 0; c < COLUMN_COUNT; c++) fprintf(file, "%s%s", c ? "," : "", timing_columns[c].name);
    fputc('\n', file);
}

/// Writes up to a row. Closes the file at the first failure, so that a full disk is reported once, not at every block.
static void write_rows(struct framelog *log, long end)
{
    for (; log->file && log->written < end; log->written++) {
        const struct frame_row *row = &log->rows[log->written % BLOCK_ROWS];
        if (row->solver != log->solver) write_solver(log->file, row->solver);
        log->solver = row->solver;
        for (int c = 0; c < COLUMN_COUNT; c++) {
            const double value = column_value(&timing_columns[c], row);
            if (c) fputc(',', log->file);
            if (isnan(value)) {
                fputs("NA", log->file);
            } else {
                fprintf(log->file, "%.*f", timing_columns[c].decimals, value);
            }
        }
        fputc('\n', log->file);
    }
    if (!log->file || (fflush(log->file) == 0 && !ferror(log->file))) return;
    log->write_errno = errno ? errno : EIO;
    fclose(log->file);
    log->file = NULL;
}

static void framelog_free(struct framelog *log)
{
    if (log->file) fclose(log->file);
    free(log->path);
    free(log->kept);
    free(log);
}

struct framelog *framelog_open(const char *path, const struct frame_header *header, int capacity, struct error *error)
{
    struct framelog *log = need_zeroed(1, sizeof *log);
    log->capacity = capacity;
    log->warm_up = header->warm_up;
    log->solver = header->solver;
    log->kept = need_zeroed((size_t)capacity, COLUMN_COUNT * sizeof *log->kept);
    if (!path) return log;
    log->path = need_text(path);
    log->file = file_open_growing(path, error);
    if (!log->file) {
        framelog_free(log);
        return NULL;
    }
    write_header(log->file, header);
    return log;
}

void framelog_push(struct framelog *log, const struct frame_row *row)
{
    log->rows[log->pushed % BLOCK_ROWS] = *row;
    const long kept = log->pushed++ - log->warm_up;
    for (int c = 0; kept >= 0 && c < COLUMN_COUNT; c++)
        log->kept[kept % log->capacity * COLUMN_COUNT + c] = column_value(&timing_columns[c], row);
    if (log->pushed - log->written >= BLOCK_ROWS) write_rows(log, log->pushed - LATE_ROWS);
}

void framelog_gpu(struct framelog *log, long frame, double gpu_us)
{
    long oldest = log->pushed > LATE_ROWS ? log->pushed - LATE_ROWS : 0;
    for (long n = log->pushed - 1; n >= oldest; n--) {
        struct frame_row *row = &log->rows[n % BLOCK_ROWS];
        if (row->frame == frame) row->gpu_us = gpu_us;
    }
}

bool framelog_close(struct framelog *log, FILE *summary, struct error *error)
{
    if (log->file) write_rows(log, log->pushed);
    if (log->file && fclose(log->file) != 0) log->write_errno = errno;
    log->file = NULL;

    const long frames = log->pushed - log->warm_up, begin = frames % log->capacity;
    if (summary && frames <= 0) {
        fprintf(summary, "live: %ld frames, all of them warm-up: nothing to sum up\n", log->pushed);
    } else if (summary) {
        if (frames > log->capacity) { // the oldest first
            const size_t row = COLUMN_COUNT * sizeof *log->kept, later = (size_t)(log->capacity - begin);
            double *kept = need((size_t)log->capacity, row);
            memcpy(kept, log->kept + begin * COLUMN_COUNT, later * row);
            memcpy(kept + later * COLUMN_COUNT, log->kept, (size_t)begin * row);
            free(log->kept);
            log->kept = kept;
        }
        summary_print(log->kept, frames < log->capacity ? (int)frames : log->capacity, summary);
    }

    bool written = log->write_errno == 0;
    if (!written) {
        fail(error, ERROR_ENVIRONMENT, "%s: the timing log could not be written: %s", log->path,
             strerror(log->write_errno));
    }
    framelog_free(log);
    return written;
}
