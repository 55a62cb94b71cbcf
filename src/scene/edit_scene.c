/// Edits of what all splines share: the scene's frames.
#include "scene/edit_plan.h"

/// Whether all knots lie inside a document's frames, each on a sample of its own.
static bool check_knots_fit(const struct document *document, struct error *error)
{
    int samples = document_samples(document);
    for (int i = 0; i < document->spline_count; i++) {
        const struct spline *spline = &document->splines[i];
        int before = -1, last = document_last_knot_sample(document, spline);
        if (spline->start == WIGGLY_LOOP && samples == 1) {
            return fail(error, ERROR_INPUT, "%s: a loop needs more than one frame", spline->name);
        }
        for (int k = 0; k < spline->knot_count; k++) {
            int sample = document_sample(document, spline->knots[k].frame);
            if (sample <= before || sample > last) {
                return fail(error, ERROR_INPUT, "%s: the knot at frame %.10g would lie outside", spline->name,
                            spline->knots[k].frame);
            }
            before = sample;
        }
    }
    return true;
}

bool plan_range(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    struct change change = {.kind = CHANGE_RANGE, .spline = -1, .range = {edit->first, edit->last}};
    struct document moved = *document;
    long long frames = (long long)edit->last - edit->first, splines = document->spline_count;
    long long samples = frames * document->substeps + 1;
    if (frames < 0) return fail(error, ERROR_INPUT, "the last frame must not be before the first");
    if (edit->first < -SCENE_MAX_FRAME || edit->last > SCENE_MAX_FRAME) {
        return fail(error, ERROR_INPUT, "frames must lie from -%d to %d", SCENE_MAX_FRAME, SCENE_MAX_FRAME);
    }
    if (samples * (splines > 0 ? splines : 1) > SCENE_MAX_SAMPLES) {
        return fail(error, ERROR_INPUT, "that would be more than %d samples over all splines", SCENE_MAX_SAMPLES);
    }
    moved.first_frame = edit->first;
    moved.last_frame = edit->last;
    if (!check_knots_fit(&moved, error)) return false;
    bool same = edit->first == document->first_frame && edit->last == document->last_frame;
    return same || plan_add(list, &change, error);
}
