/// Where all vertices of a rig are at each key: .pc2, .mdd and .npy.
#include "base/need.h"
#include "export/form.h"
#include <stdlib.h>

static bool write_keys(struct export_range *range, const struct form *form, FILE *out, float (*positions)[3],
                       struct error *error)
{
    struct rig_pose pose;
    const enum motion_form as = range->format->motion;
    const bool in_seconds = as == MOTION_MDD;
    const struct document *document = range->posing->document;
    const struct motion_span span = {
        .frames = range->key_count,
        .vertices = form->vertex_count,
        .first = in_seconds ? range->first / document->fps : range->first,
        .spacing = in_seconds ? range_seconds(range, 1) : range->spacing,
    };
    motion_print_start(out, as, &span);
    for (int k = 0; k < range->key_count; k++) {
        if (!range_pose(range, range->rigs[0], k, &pose, error)) return false;
        form->kind->vertices(form, &pose, positions);
        motion_print_frame(out, as, (const float(*)[3])positions, form->vertex_count);
        if (ferror(out)) return true; // the caller says what is wrong; a full disk need not be filled to the end
        if (!range_proceed(range, error)) return false;
    }
    return true;
}

bool points_write(struct export_range *range, FILE *out, struct error *error)
{
    struct form form;
    if (!form_open(range, range->rigs[0], &form, error)) return false;
    float(*positions)[3] = need((size_t)form.vertex_count + 1, sizeof *positions);
    const bool done = write_keys(range, &form, out, positions, error);
    snprintf(range->summary, FORMAT_SUMMARY, "%d vertices, %d frames", form.vertex_count, range->key_count);
    free(positions);
    form_close(&form);
    return done;
}
