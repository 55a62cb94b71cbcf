/// Plain numbers: a table with a row per key and a column for every spline and channel (.csv), or the positions of a rig's vertices at each
/// key (.pc2, .mdd and .npy).
#include "base/error.h"
#include "base/need.h"
#include "export/form.h"
#include "scene/text.h"
#include <stdarg.h>
#include <stdlib.h>

/// A row being written: first names, then numbers.
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

static bool write_row(struct export_range *range, int key, struct row *row, struct error *error)
{
    struct rig_pose pose;
    const struct document *document = range->posing->document;
    row->columns = 0;
    write_column(row, range_frame(range, key), "frame");
    for (int i = 0; i < document->spline_count; i++) {
        const wiggly_value value = evaluation_at(range->posing->evaluation, i, range_position(range, key));
        write_column(row, value.y + value.re, "%s", document->splines[i]->name);
    }
    for (int r = 0; r < range->rig_count; r++) {
        const int rig = range->rigs[r];
        if (!range_pose(range, rig, key, &pose, error)) return false;
        const struct form_kind *kind = form_kind(range->posing, rig);
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

bool points_write(struct export_range *range, FILE *out, struct error *error)
{
    struct form form;
    if (!form_open(range, range->rigs[0], &form, error)) return false;
    const enum motion_form as = range->format->motion;
    const bool in_seconds = as == MOTION_MDD;
    const struct motion_span span = {
        .frames = range->key_count,
        .vertices = form.vertex_count,
        .first = in_seconds ? range->first / range->posing->document->fps : range->first,
        .spacing = in_seconds ? range_seconds(range, 1) : range->spacing,
    };
    motion_print_start(out, as, &span);
    float(*positions)[3] = need((size_t)form.vertex_count + 1, sizeof *positions);
    bool done = true;
    for (int k = 0; done && k < range->key_count; k++) {
        struct rig_pose pose;
        done = range_pose(range, range->rigs[0], k, &pose, error);
        if (!done) break;
        form_vertices(&form, &pose, range->options->as_shown, positions);
        motion_print_frame(out, as, (const float(*)[3])positions, form.vertex_count);
        if (ferror(out)) break; // the caller reports the error; writing on to a full disk is useless
        done = range_proceed(range, error);
    }
    snprintf(range->summary, FORMAT_SUMMARY, "%d vertices, %d frames", form.vertex_count, range->key_count);
    free(positions);
    form_close(&form);
    return done;
}
