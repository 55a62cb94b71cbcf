/// Reads timing logs of one or several runs.
#include "timing/columns.h"
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Where the reader is.
struct log_reader {
    const char *path;
    int line;
    int warm_up;                      ///< of this run
    int seen;                         ///< frames of this run, warm-up included
    bool named;                       ///< this run's column names were read
    int column[COLUMN_COUNT], fields; ///< the column of each field of a line
    int capacity;                     ///< rows that there is room for
    struct timing_log *log;
    struct error *error;
};

static bool bad(const struct log_reader *at, const char *expected, const char *got)
{
    return fail(at->error, ERROR_INPUT, "%s:%d: expected %s, got '%.80s'", at->path, at->line, expected, got);
}

/// Adds a solver to those that the log names.
static void add_solver(struct timing_log *log, const char *name)
{
    size_t used = strlen(log->solvers);
    if (strcmp(name, "NA") == 0 || strstr(log->solvers, name)) return;
    snprintf(log->solvers + used, sizeof log->solvers - used, "%s%s", used ? ", " : "", name);
}

static bool read_comment(struct log_reader *at, const char *text)
{
    static const char schema[] = "# schema: ", warm_up[] = "# warm_up_frames: ", solver[] = "# solver: ";
    if (strncmp(text, schema, sizeof schema - 1) == 0) {
        const char *name = text + sizeof schema - 1;
        if (strcmp(name, TIMING_SCHEMA) != 0 && strcmp(name, TIMING_SCHEMA_BEFORE) != 0) {
            return bad(at, "the schema " TIMING_SCHEMA " or " TIMING_SCHEMA_BEFORE, name);
        }
        at->log->runs++;
        at->warm_up = at->seen = 0;
        at->named = false;
    } else if (strncmp(text, warm_up, sizeof warm_up - 1) == 0) {
        at->warm_up = atoi(text + sizeof warm_up - 1);
    } else if (strncmp(text, solver, sizeof solver - 1) == 0) {
        add_solver(at->log, text + sizeof solver - 1);
    }
    return true;
}

static int find_column(const char *name, size_t length)
{
    for (int c = 0; c < COLUMN_COUNT; c++) {
        if (strlen(timing_columns[c].name) == length && strncmp(timing_columns[c].name, name, length) == 0) return c;
    }
    return -1;
}

/// Columns are found by name, so that logs older than a column can be read.
static bool read_names(struct log_reader *at, const char *text)
{
    if (at->log->runs == 0) return bad(at, "a timing log's '# schema:' line first", text);
    bool has_frame = false, has_time = false;
    at->fields = 0;
    for (const char *name = text; name; name = strchr(name, ',') ? strchr(name, ',') + 1 : NULL) {
        int column = find_column(name, strcspn(name, ","));
        if (column < 0 || at->fields == COLUMN_COUNT) return bad(at, "the column names of " TIMING_SCHEMA, text);
        has_frame |= column == COLUMN_FRAME;
        has_time |= column == COLUMN_FRAME_MS;
        at->column[at->fields++] = column;
    }
    if (!has_frame || !has_time) return bad(at, "the column names of " TIMING_SCHEMA, text);
    at->named = true;
    return true;
}

static bool grow(struct log_reader *at)
{
    struct timing_log *log = at->log;
    if (log->rows < at->capacity) return true;
    if (at->capacity > INT_MAX / 2 / COLUMN_COUNT)
        return fail(at->error, ERROR_INPUT, "%s: too many frames", at->path);
    int capacity = at->capacity ? 2 * at->capacity : 1024;
    double *values = realloc(log->values, (size_t)capacity * COLUMN_COUNT * sizeof *values);
    if (values) log->values = values;
    int *run = realloc(log->run, (size_t)capacity * sizeof *run);
    if (run) log->run = run;
    if (!values || !run) return fail(at->error, ERROR_ENVIRONMENT, "%s: out of memory", at->path);
    at->capacity = capacity;
    return true;
}

static bool read_row(struct log_reader *at, char *text)
{
    if (at->seen++ < at->warm_up) return true;
    if (!grow(at)) return false;
    struct timing_log *log = at->log;
    double *row = &log->values[(size_t)log->rows * COLUMN_COUNT];
    char *rest = text;
    for (int c = 0; c < COLUMN_COUNT; c++) row[c] = NAN;
    for (int i = 0; i < at->fields; i++) {
        char *end = rest + 2;
        bool missing = strncmp(rest, "NA", 2) == 0;
        double value = missing ? NAN : strtod(rest, &end);
        row[at->column[i]] = value;
        if (end == rest || *end != (i + 1 < at->fields ? ',' : 0) || (!missing && !isfinite(value))) {
            return bad(at, "a number or NA for each column, separated by commas", text);
        }
        rest = end + 1;
    }
    log->run[log->rows++] = log->runs - 1;
    return true;
}

static bool read_line(struct log_reader *at, char *text)
{
    text[strcspn(text, "\r\n")] = 0;
    if (*text == '#') return read_comment(at, text);
    return at->named ? read_row(at, text) : read_names(at, text);
}

bool timing_log_read(const char *path, struct timing_log *log, struct error *error)
{
    *log = (struct timing_log){0};
    struct log_reader at = {.path = path, .log = log, .error = error};
    FILE *file = fopen(path, "r");
    if (!file) return fail(error, ERROR_INPUT, "%s: %s", path, strerror(errno));
    char *text = NULL;
    size_t size = 0;
    bool good = true;
    while (good && getline(&text, &size, file) >= 0) {
        at.line++;
        good = read_line(&at, text);
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
