/// A table: one row per key, a column for every spline and every channel of the rigs.
#include "base/error.h"
#include "base/need.h"
#include "export/form.h"
#include "scene/text.h"
#include <stdarg.h>
#include <stdlib.h>

/// A row being written: names at first, then numbers.
struct row {
    FILE *out;
    bool names;
    int columns;
};

static void write_column(void *user, double value, const char *format, ...)
{
    struct row *row = user;
    char text[NUMBER_TEXT_SIZE], *name = NULL;
    if (row->columns++ > 0) fputc(',', row->out);
    if (!row->names) {
        number_print(value, text);
        fputs(text, row->out);
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    if (vasprintf(&name, format, arguments) < 0) need_failed();
    va_end(arguments);
    print_field(row->out, name, "");
    free(name);
}

static bool write_row(struct export_range *range, double key, struct row *row, struct error *error)
{
    struct rig_pose pose;
    const struct document *document = range->posing->document;
    row->columns = 0;
    write_column(row, range_frame(range, key), "frame");
    for (int i = 0; i < document->spline_count; i++) {
        const wiggly_value value = range_value(range, i, key);
        write_column(row, value.y + value.re, "%s", document->splines[i]->name);
    }
    for (int r = 0; r < range->rig_count; r++) {
        const int rig = range->rigs[r];
        if (!range_pose(range, rig, key, &pose, error)) return false;
        const struct form_kind *kind = form_kind(document->rigs[rig]->kind);
        if (kind->columns) kind->columns(range, rig, &pose, key, write_column, row);
    }
    fputc('\n', row->out);
    return true;
}

bool csv_write(struct export_range *range, FILE *out, struct error *error)
{
    struct row row = {.out = out, .names = true};
    range->total = range->key_count;
    if (!write_row(range, 0, &row, error)) return false;
    row.names = false;
    for (int k = 0; k < range->key_count; k++) {
        if (!write_row(range, k, &row, error) || !range_proceed(range, error)) return false;
    }
    snprintf(range->summary, FORMAT_SUMMARY, "%d columns, %d rows", row.columns, range->key_count);
    return true;
}
