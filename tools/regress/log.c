/// Reads timing logs.
#include "regress/log.h"
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool bad_log(struct error *error, const char *path, int line, const char *expected, const char *got)
{
    return fail(error, ERROR_INPUT, "%s:%d: expected %s, got '%.80s'", path, line, expected, got);
}

bool timing_log_read(const char *path, struct timing_log *log, struct error *error)
{
    static const char schema[] = "# schema: ", warm_up[] = "# warm_up_frames: ";
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
            if (strcmp(name, TIMING_SCHEMA) != 0)
                good = bad_log(error, path, line, "the schema " TIMING_SCHEMA, name);
            log->runs++;
            skipped = seen = 0;
            named = false;
        } else if (strncmp(text, warm_up, sizeof warm_up - 1) == 0) {
            skipped = atoi(text + sizeof warm_up - 1);
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
