/// Collects frames, writes the log and prints the summary.
#include "base/embedded.h"
#include "base/file.h"
#include "base/need.h"
#include "timing/columns.h"
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <wiggly/wiggly.h>

enum { BLOCK_ROWS = 256, LATE_ROWS = 16 }; ///< the last rows wait for their GPU times
static const int LOW_NEEDS_FRAMES = 1000;

/// What the summary needs of a frame: all that is kept of it once its row is written.
enum { SUMMED_TIME, SUMMED_FRAME, SUMMED_INTERVAL, SUMMED_SOLVE, SUMMED_EVENT, SUMMED_COUNT };
static const int summed_columns[SUMMED_COUNT] = {COLUMN_TIME, COLUMN_FRAME_MS, COLUMN_FRAME_INTERVAL_MS,
                                                 COLUMN_SOLVE_US, COLUMN_EVENT_TO_SWAP_US};

struct framelog {
    FILE *file; ///< NULL: for the summary only, or a write failed
    char *path;
    int write_errno; ///< of the first failed write
    int warm_up;
    const char *solver;                ///< as the file says so far
    struct frame_row rows[BLOCK_ROWS]; ///< ring: row n of the run at n % BLOCK_ROWS
    float (*summed)[SUMMED_COUNT];     ///< ring: of row n at n % capacity
    double *scratch;                   ///< capacity numbers, for sorting
    int capacity;
    long pushed, written; ///< rows of the run so far
};

static void write_cpu(FILE *file)
{
    char line[256];
    FILE *info = fopen("/proc/cpuinfo", "r");
    while (info && fgets(line, sizeof line, info)) {
        const char *name = strncmp(line, "model name", 10) == 0 ? strchr(line, ':') : NULL;
        if (!name) continue;
        fprintf(file, "# cpu: %s", name + 2);
        fclose(info);
        return;
    }
    if (info) fclose(info);
    fprintf(file, "# cpu: NA\n");
}

static void write_milliseconds(FILE *file, const char *key, double value)
{
    if (isnan(value)) {
        fprintf(file, "# %s: NA\n", key);
    } else {
        fprintf(file, "# %s: %.3f\n", key, value);
    }
}

static void write_solver(FILE *file, const char *solver) { fprintf(file, "# solver: %s\n", solver ? solver : "NA"); }

static void write_header(FILE *file, const struct frame_header *header)
{
    struct utsname os;
    bool known = uname(&os) == 0;
    fprintf(file, "# schema: " TIMING_SCHEMA "\n");
    fprintf(file, "# wiggly: %s (%s)\n", WIGGLY_VERSION, build_commit);
    fprintf(file, "# compiler: %s %s\n", build_compiler, build_flags);
    fprintf(file, "# os: %s %s %s\n", known ? os.sysname : "NA", known ? os.release : "", known ? os.machine : "");
    write_cpu(file);
    fprintf(file, "# gl_renderer: %s\n", header->gl_renderer ? header->gl_renderer : "NA");
    fprintf(file, "# size: %dx%d scale %g\n", header->width, header->height, (double)header->scale);
    fprintf(file, "# vsync: %d\n", header->vsync);
    write_solver(file, header->solver);
    fprintf(file, "# warm_up_frames: %d\n", header->warm_up);
    write_milliseconds(file, "reference_frame_ms", header->reference_ms);
    write_milliseconds(file, "first_frame_ms", header->first_frame_ms);
    for (int c = 0; c < COLUMN_COUNT; c++) fprintf(file, "%s%s", c ? "," : "", timing_columns[c].name);
    fputc('\n', file);
}

static void write_row(FILE *file, const struct frame_row *row)
{
    for (int c = 0; c < COLUMN_COUNT; c++) {
        double value = column_value(&timing_columns[c], row);
        if (c) fputc(',', file);
        if (isnan(value)) {
            fputs("NA", file);
        } else {
            fprintf(file, "%.*f", timing_columns[c].decimals, value);
        }
    }
    fputc('\n', file);
}

/// Closes the file at the first failure, so that a full disk is reported once, not at every block.
static void check_written(struct framelog *log)
{
    if (fflush(log->file) == 0 && !ferror(log->file)) return;
    log->write_errno = errno ? errno : EIO;
    fclose(log->file);
    log->file = NULL;
}

static void write_rows(struct framelog *log, long end)
{
    for (; log->file && log->written < end; log->written++) {
        const struct frame_row *row = &log->rows[log->written % BLOCK_ROWS];
        if (row->solver != log->solver) write_solver(log->file, row->solver);
        log->solver = row->solver;
        write_row(log->file, row);
    }
    if (log->file) check_written(log);
}

static void framelog_free(struct framelog *log)
{
    if (log->file) fclose(log->file);
    free(log->path);
    free(log->summed);
    free(log->scratch);
    free(log);
}

struct framelog *framelog_open(const char *path, const struct frame_header *header, int capacity, struct error *error)
{
    struct framelog *log = need_zeroed(1, sizeof *log);
    log->capacity = capacity;
    log->warm_up = header->warm_up;
    log->solver = header->solver;
    log->summed = need_zeroed((size_t)capacity, sizeof *log->summed);
    log->scratch = need_zeroed((size_t)capacity, sizeof *log->scratch);
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
    float *summed = log->summed[log->pushed++ % log->capacity];
    for (int i = 0; i < SUMMED_COUNT; i++) summed[i] = (float)column_value(&timing_columns[summed_columns[i]], row);
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

/// Collects the measured values of one kind over the frames from `first` on in the log's scratch.
static int collect(const struct framelog *log, long first, int summed)
{
    int count = 0;
    for (long n = first; n < log->pushed; n++) {
        const double value = (double)log->summed[n % log->capacity][summed];
        if (!isnan(value)) log->scratch[count++] = value;
    }
    return count;
}

static void print_percentiles(const struct framelog *log, long first, int summed, double to_ms, const char *what,
                              FILE *out)
{
    int count = collect(log, first, summed);
    if (count == 0) return;
    statistics_sort(log->scratch, count);
    fprintf(out, "%-14s p50 %8.3f ms   p95 %8.3f ms   p99 %8.3f ms\n", what,
            to_ms * statistics_quantile(log->scratch, count, 0.5),
            to_ms * statistics_quantile(log->scratch, count, 0.95),
            to_ms * statistics_quantile(log->scratch, count, 0.99));
}

static void print_slow_frames(const struct framelog *log, long first, FILE *out)
{
    int count = collect(log, first, SUMMED_FRAME);
    for (int b = 0; b < BUDGET_COUNT; b++) {
        struct over_budget over = statistics_over(log->scratch, count, frame_budgets_ms[b]);
        fprintf(out, "over %.1f ms   %d of %d frames", frame_budgets_ms[b], over.frames, count);
        if (over.longest > 1) fprintf(out, ", up to %d in a row", over.longest);
        fputc('\n', out);
    }
    count = collect(log, first, SUMMED_INTERVAL);
    if (count < LOW_NEEDS_FRAMES) return;
    statistics_sort(log->scratch, count);
    fprintf(out, "1 %% low        %.1f fps\n", 1000 / statistics_quantile(log->scratch, count, 0.99));
}

static void print_summary(const struct framelog *log, FILE *out)
{
    long oldest = log->pushed > log->capacity ? log->pushed - log->capacity : 0;
    long first = oldest > log->warm_up ? oldest : log->warm_up;
    if (first >= log->pushed) {
        fprintf(out, "frames         %ld, all of them warm-up: nothing to sum up\n", log->pushed);
        return;
    }
    const float *start = log->summed[first % log->capacity], *end = log->summed[(log->pushed - 1) % log->capacity];
    const float elapsed = end[SUMMED_TIME] + end[SUMMED_FRAME] / 1000 - start[SUMMED_TIME];
    long frames = log->pushed - first;
    fprintf(out, "frames         %ld in %.2f s, %.1f fps on average", frames, (double)elapsed,
            (double)frames / (double)elapsed);
    fprintf(out, ", the first %ld left out\n", first);
    print_percentiles(log, first, SUMMED_FRAME, 1, "frame", out);
    print_percentiles(log, first, SUMMED_INTERVAL, 1, "interval", out);
    print_percentiles(log, first, SUMMED_SOLVE, 1e-3, "solve", out);
    print_percentiles(log, first, SUMMED_EVENT, 1e-3, "event to swap", out);
    print_slow_frames(log, first, out);
}

bool framelog_close(struct framelog *log, FILE *summary, struct error *error)
{
    if (log->file) write_rows(log, log->pushed);
    if (log->file && fclose(log->file) != 0) log->write_errno = errno;
    log->file = NULL;
    if (summary) print_summary(log, summary);
    bool written = log->write_errno == 0;
    if (!written) {
        fail(error, ERROR_ENVIRONMENT, "%s: the timing log could not be written: %s", log->path,
             strerror(log->write_errno));
    }
    framelog_free(log);
    return written;
}
