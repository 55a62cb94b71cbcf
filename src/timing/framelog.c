/// Collects frames, writes the timing log, reads logs back, and sums them up.
#include "timing/framelog.h"
#include "base/embedded.h"
#include "base/file.h"
#include "base/need.h"
#include <errno.h>
#include <limits.h>
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

// --- the summary

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

/// Percentiles of the chosen columns, a bit for each, as far as they were measured; frames over budget, and the rate that all but 1 % of
/// the frames reach, of enough frames.
static void summary_print(const struct timing_log *log, const char *name, unsigned columns, FILE *out)
{
    enum { ENOUGH_FOR_LOW = 1000 };
    double *values = need_zeroed((size_t)log->rows, sizeof *values), elapsed = 0;
    for (int row = 0; row < log->rows; row++) {
        const double *v = &log->values[(size_t)row * COLUMN_COUNT];
        if (row == 0 || log->run[row - 1] != log->run[row]) elapsed -= v[COLUMN_TIME];
        if (row + 1 == log->rows || log->run[row + 1] != log->run[row])
            elapsed += v[COLUMN_TIME] + v[COLUMN_FRAME_MS] / 1000;
    }
    print_line(out, "%s: %d frames of %d %s in %.2f s, %.1f fps on average, without the warm-up ones", name,
               log->rows, log->runs, log->runs == 1 ? "run" : "runs", elapsed, log->rows / elapsed);
    if (log->solvers[0]) print_line(out, "solver: %s", log->solvers);

    fprintf(out, "\n%-18s %10s %10s %10s %10s\n", "", "p50", "p95", "p99", "largest");
    for (int c = 0; c < COLUMN_COUNT; c++) {
        static const double at[] = {0.5, 0.95, 0.99, 1};
        const struct column *column = &timing_columns[c];
        const int count = columns >> c & 1 ? column_values(log, c, values) : 0;
        if ((column->use != COLUMN_COST && column->use != COLUMN_WAIT) || count == 0) continue;
        statistics_sort(values, count);
        fprintf(out, "%-18s", column->name);
        for (int i = 0; i < 4; i++) {
            const int decimals = column->is_count ? 0 : column->decimals > 1 ? 3 : 1;
            fprintf(out, " %10.*f", decimals, statistics_quantile(values, count, at[i]));
        }
        fputc('\n', out);
    }
    fputc('\n', out);

    for (int row = 0; row < log->rows; row++) values[row] = log->values[(size_t)row * COLUMN_COUNT + COLUMN_FRAME_MS];
    for (int b = 0; b < BUDGET_COUNT; b++) {
        struct over_budget all = {0, 0}; // a run of frames ends with its program run
        for (int row = 0, start = 0; row < log->rows; row++) {
            if (row + 1 < log->rows && log->run[row + 1] == log->run[row]) continue;
            const struct over_budget over = statistics_over(values + start, row + 1 - start, frame_budgets_ms[b]);
            all.frames += over.frames;
            all.longest = over.longest > all.longest ? over.longest : all.longest;
            start = row + 1;
        }
        fprintf(out, "over %.1f ms       %d of %d frames (%.1f %%), up to %d in a row\n", frame_budgets_ms[b],
                all.frames, log->rows, 100.0 * all.frames / log->rows, all.longest);
    }
    const int intervals = column_values(log, COLUMN_FRAME_INTERVAL_MS, values);
    statistics_sort(values, intervals);
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
    struct timing_log kept;            ///< for the summary; ring: row n after the warm-up at n % capacity
    int capacity;
    long pushed, written; ///< rows of the run so far
};

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
    write_milliseconds(file, "reference_frame_ms", header->reference_ms);
    write_milliseconds(file, "first_frame_ms", header->first_frame_ms);
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
    timing_log_free(&log->kept);
    free(log);
}

struct framelog *framelog_open(const char *path, const struct frame_header *header, int capacity, struct error *error)
{
    struct framelog *log = need_zeroed(1, sizeof *log);
    log->capacity = capacity;
    log->warm_up = header->warm_up;
    log->solver = header->solver;
    log->kept.values = need_zeroed((size_t)capacity, COLUMN_COUNT * sizeof *log->kept.values);
    log->kept.run = need_zeroed((size_t)capacity, sizeof *log->kept.run);
    log->kept.runs = 1;
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
        log->kept.values[kept % log->capacity * COLUMN_COUNT + c] = column_value(&timing_columns[c], row);
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

    struct timing_log *kept = &log->kept;
    const long frames = log->pushed - log->warm_up, begin = frames % log->capacity;
    kept->rows = (int)(frames < log->capacity ? frames : log->capacity);
    if (summary && frames <= 0) {
        fprintf(summary, "live: %ld frames, all of them warm-up: nothing to sum up\n", log->pushed);
    } else if (summary) {
        if (frames > log->capacity) { // the oldest first
            const size_t row = COLUMN_COUNT * sizeof *kept->values, later = (size_t)(log->capacity - begin);
            double *values = need((size_t)log->capacity, row);
            memcpy(values, kept->values + begin * COLUMN_COUNT, later * row);
            memcpy(values + later * COLUMN_COUNT, kept->values, (size_t)begin * row);
            free(kept->values);
            kept->values = values;
        }
        const unsigned columns = 1U << COLUMN_FRAME_MS | 1U << COLUMN_FRAME_INTERVAL_MS | 1U << COLUMN_SOLVE_US |
                                 1U << COLUMN_EVENT_TO_SWAP_US;
        summary_print(kept, "live", columns, summary);
    }

    bool written = log->write_errno == 0;
    if (!written) {
        fail(error, ERROR_ENVIRONMENT, "%s: the timing log could not be written: %s", log->path,
             strerror(log->write_errno));
    }
    framelog_free(log);
    return written;
}

// --- reading logs of one or several runs

static bool bad_log(struct error *error, const char *path, int line, const char *expected, const char *got)
{
    return fail(error, ERROR_INPUT, "%s:%d: expected %s, got '%.80s'", path, line, expected, got);
}

bool timing_log_read(const char *path, struct timing_log *log, struct error *error)
{
    static const char schema[] = "# schema: ", warm_up[] = "# warm_up_frames: ", solver[] = "# solver: ";
    *log = (struct timing_log){0};
    int line = 0, columns[COLUMN_COUNT], fields = 0, capacity = 0; // `columns`: of each field
    int skipped = 0, seen = 0; // warm-up frames of this run, and its frames so far
    bool named = false, good = true;
    FILE *file = fopen(path, "r");
    if (!file) return fail(error, ERROR_INPUT, "%s: %s", path, strerror(errno));
    char *text = NULL;
    size_t size = 0;
    while (good && getline(&text, &size, file) >= 0) {
        line++;
        text[strcspn(text, "\r\n")] = 0;
        if (strncmp(text, schema, sizeof schema - 1) == 0) {
            const char *name = text + sizeof schema - 1;
            if (strcmp(name, TIMING_SCHEMA) != 0 && strcmp(name, TIMING_SCHEMA_BEFORE) != 0)
                good = bad_log(error, path, line, "the schema " TIMING_SCHEMA " or " TIMING_SCHEMA_BEFORE, name);
            log->runs++;
            skipped = seen = 0;
            named = false;
        } else if (strncmp(text, warm_up, sizeof warm_up - 1) == 0) {
            skipped = atoi(text + sizeof warm_up - 1);
        } else if (strncmp(text, solver, sizeof solver - 1) == 0) {
            const char *name = text + sizeof solver - 1;
            if (strcmp(name, "NA") != 0 && !strstr(log->solvers, name))
                print_more(log->solvers, sizeof log->solvers, "%s%s", *log->solvers ? ", " : "", name);
        } else if (*text == '#' || (named && seen++ < skipped)) {
            continue;
        } else if (!named) { // columns are found by name, so that logs older than a column can be read
            if (log->runs == 0) good = bad_log(error, path, line, "a timing log's '# schema:' line first", text);
            bool has_frame = false, has_time = false, known = true;
            fields = 0;
            for (const char *name = text; name && known; name = strchr(name, ',') ? strchr(name, ',') + 1 : NULL) {
                const size_t length = strcspn(name, ",");
                int column = COLUMN_COUNT - 1;
                while (column >= 0 && (strlen(timing_columns[column].name) != length ||
                                       strncmp(timing_columns[column].name, name, length) != 0))
                    column--;
                known = column >= 0 && fields < COLUMN_COUNT;
                has_frame |= column == COLUMN_FRAME;
                has_time |= column == COLUMN_FRAME_MS;
                if (known) columns[fields++] = column;
            }
            named = known && has_frame && has_time;
            if (good && !named) good = bad_log(error, path, line, "the column names of " TIMING_SCHEMA, text);
        } else {
            if (log->rows == capacity && capacity > INT_MAX / 2 / COLUMN_COUNT) {
                good = fail(error, ERROR_INPUT, "%s: too many frames", path);
                break;
            }
            if (log->rows == capacity) {
                capacity = capacity ? 2 * capacity : 1024;
                double *values = realloc(log->values, (size_t)capacity * COLUMN_COUNT * sizeof *values);
                if (values) log->values = values;
                int *run = realloc(log->run, (size_t)capacity * sizeof *run);
                if (run) log->run = run;
                good = (values && run) || fail(error, ERROR_ENVIRONMENT, "%s: out of memory", path);
                if (!good) break;
            }
            double *row = &log->values[(size_t)log->rows * COLUMN_COUNT];
            char *rest = text;
            for (int c = 0; c < COLUMN_COUNT; c++) row[c] = NAN;
            for (int i = 0; good && i < fields; i++) {
                char *end = rest + 2;
                const bool missing = strncmp(rest, "NA", 2) == 0;
                const double value = row[columns[i]] = missing ? NAN : strtod(rest, &end);
                if (end == rest || *end != (i + 1 < fields ? ',' : 0) || (!missing && !isfinite(value)))
                    good = bad_log(error, path, line, "a number or NA for each column, separated by commas", text);
                rest = end + 1;
            }
            log->run[log->rows++] = log->runs - 1;
        }
    }
    if (good && ferror(file)) good = fail(error, ERROR_INPUT, "%s: %s", path, strerror(errno));
    if (good && log->rows == 0)
        good = fail(error, ERROR_INPUT, "%s: there are no frames after the warm-up ones", path);
    free(text);
    fclose(file);
    if (!good) timing_log_free(log);
    return good;
}

void timing_log_free(struct timing_log *log)
{
    free(log->values);
    free(log->run);
    *log = (struct timing_log){0};
}

// --- how a log's frame times are distributed

enum { BAR = 50, BINS = 24, SLOWEST = 5 };

void distribution_print(const struct timing_log *log, const char *name, FILE *out)
{
    double *values = need_zeroed((size_t)log->rows, sizeof *values);
    summary_print(log, name, ~0U, out);

    // Bars over steps that read well, at most BINS up to p99 and one for the rest.
    const int count = column_values(log, COLUMN_FRAME_MS, values);
    statistics_sort(values, count);
    const double high = statistics_quantile(values, count, 0.99);
    const double least = fmax((high - values[0]) / BINS, 1e-3), power = pow(10, floor(log10(least)));
    const double times = least / power; // steps are 1, 2 or 5 times a power of ten
    const double step = power * (times <= 1 ? 1 : times <= 2 ? 2 : times <= 5 ? 5 : 10);
    const double start = step * floor(values[0] / step);
    const int bins = (int)fmin(floor((high - start) / step) + 2, BINS + 2);
    const int decimals = (int)fmax(0, ceil(-log10(step) - 1e-9));
    int counts[BINS + 2] = {0}, most = 0;
    for (int i = 0; i < count; i++) counts[(int)fmin(floor((values[i] - start) / step), bins - 1)]++;
    for (int i = 0; i < bins; i++) most = counts[i] > most ? counts[i] : most;
    fprintf(out, "\nframe_ms\n");
    for (int i = 0; i < bins; i++) {
        const double from = start + i * step, to = i < bins - 1 ? from + step : fmax(values[count - 1], from);
        fprintf(out, "%8.*f to %-8.*f %7d ", decimals, from, decimals, to, counts[i]);
        for (int k = 0; k < (int)ceil((double)BAR * counts[i] / most); k++) fputs("█", out);
        fputc('\n', out);
    }
    free(values);

    // For the slowest frames, the stages that took at least a tenth.
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
