/// Edits of the whole document, its frames per second, substeps and range of frames.
#include "scene/edit_plan.h"
#include "scene/pins.h"
#include <math.h>
#include <stdlib.h>

static bool check_loops(const struct document *document, struct error *error)
{
    for (int i = 0; i < document->spline_count && document_samples(document) == 1; i++) {
        const struct spline *spline = &document->splines[i];
        if (spline_start(spline) != WIGGLY_LOOP) continue;
        return fail(error, ERROR_INPUT, "%s: a loop needs more than one frame", spline->name);
    }
    return true;
}

/// Whether all knots lie inside a document's frames, each on a sample of its own. `frames` replaces the knots' frames unless NULL.
static bool check_knots_fit(const struct document *document, const double *frames, struct error *error)
{
    for (int i = 0; i < document->spline_count; i++) {
        const struct spline *spline = &document->splines[i];
        int before = -1, last = document_last_knot_sample(document, spline);
        for (int k = 0; k < spline->knot_count; k++) {
            double frame = frames ? *frames++ : spline->knots[k].frame;
            int sample = document_sample(document, frame);
            if (sample < 0 || sample > last) {
                return fail(error, ERROR_INPUT, "%s: the knot at frame %.10g would fall outside the range",
                            spline->name, frame);
            }
            if (sample == before) {
                return fail(error, ERROR_INPUT, "%s: two knots would land on frame %.10g", spline->name, frame);
            }
            before = sample;
        }
    }
    return true;
}

/// Whether a timing is allowed, leaving the knots aside.
static bool check_timing(const struct document *document, const struct timing *timing, struct error *error)
{
    long long frames = (long long)timing->last - timing->first;
    long long samples = frames * timing->substeps + 1;
    if (!(timing->fps > 0 && timing->fps <= SCENE_MAX_FPS)) {
        return fail(error, ERROR_INPUT, "frames per second must be above 0 and at most %d", SCENE_MAX_FPS);
    }
    if (timing->substeps < 1 || timing->substeps > SCENE_MAX_SUBSTEPS) {
        return fail(error, ERROR_INPUT, "substeps must be from 1 to %d", SCENE_MAX_SUBSTEPS);
    }
    if (frames < 0) return fail(error, ERROR_INPUT, "the last frame must not be before the first");
    if (timing->first < -SCENE_MAX_FRAME || timing->last > SCENE_MAX_FRAME) {
        return fail(error, ERROR_INPUT, "frames must be from -%d to %d", SCENE_MAX_FRAME, SCENE_MAX_FRAME);
    }
    return document_check_samples(document->spline_count, samples, document_is_limited(document), error);
}

static struct document with_timing(const struct document *document, const struct timing *timing)
{
    struct document moved = *document;
    moved.fps = timing->fps;
    moved.substeps = timing->substeps;
    moved.first_frame = timing->first;
    moved.last_frame = timing->last;
    return moved;
}

static bool same_timing(const struct document *document, const struct timing *timing)
{
    return timing->fps == document->fps && timing->substeps == document->substeps &&
           timing->first == document->first_frame && timing->last == document->last_frame;
}

/// Adds the change of timing and takes over its `frames`.
static bool add_timing(const struct document *document, const struct timing *timing, struct change_list *list,
                       struct error *error)
{
    struct change change = {.kind = CHANGE_TIMING, .spline = -1, .timing = *timing};
    if (!same_timing(document, timing)) return plan_add(list, &change, error);
    change_release(&change);
    return true;
}

/// The frames of all knots and pins times `factor`; NULL if memory runs out.
static double *scaled_frames(const struct document *document, double factor)
{
    size_t count = (size_t)pins_count(document);
    for (int s = 0; s < document->spline_count; s++) count += (size_t)document->splines[s].knot_count;
    double *frames = malloc((count + 1) * sizeof *frames);
    double *next = frames;
    for (int s = 0; frames && s < document->spline_count; s++) {
        const struct spline *spline = &document->splines[s];
        for (int k = 0; k < spline->knot_count; k++) *next++ = spline->knots[k].frame * factor + 0.0;
    }
    for (int r = 0; frames && r < document->rig_count; r++) {
        const struct rig *rig = &document->rigs[r];
        for (int i = 0; i < rig->pin_count; i++) *next++ = rig->pins[i].frame * factor + 0.0;
    }
    return frames;
}

/// The scaled end of the range, rounded outwards so that knots inside stay inside.
static int scaled_end(int frame, double factor, bool first)
{
    const double slack = 1e-6; // 96 · 30/24 is 120, not a hair more
    double scaled = first ? floor(frame * factor + slack) : ceil(frame * factor - slack);
    return (int)fmax(-SCENE_MAX_FRAME - 1, fmin(SCENE_MAX_FRAME + 1, scaled));
}

bool plan_fps(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    struct timing timing = timing_of(document);
    timing.fps = edit->number;
    if (!check_timing(document, &timing, error)) return false;
    if (edit->flag) {
        double factor = edit->number / document->fps;
        timing.first = scaled_end(document->first_frame, factor, true);
        timing.last = scaled_end(document->last_frame, factor, false);
        if (!check_timing(document, &timing, error)) return false;
        timing.frames = scaled_frames(document, factor);
        if (!timing.frames) return plan_no_memory(error);
    }
    struct document moved = with_timing(document, &timing);
    if (check_loops(&moved, error) && check_knots_fit(&moved, timing.frames, error))
        return add_timing(document, &timing, list, error);
    free(timing.frames);
    return false;
}

bool plan_substeps(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    struct timing timing = timing_of(document);
    timing.substeps = edit->substeps;
    if (!check_timing(document, &timing, error)) return false;
    struct document moved = with_timing(document, &timing);
    return check_knots_fit(&moved, NULL, error) && add_timing(document, &timing, list, error);
}

/// Removes a spline's knots that fall outside the document's new range.
static bool trim_knots(const struct document *moved, int spline_index, struct change_list *list, struct error *error)
{
    const struct spline *spline = &moved->splines[spline_index];
    int last = document_last_knot_sample(moved, spline);
    for (int k = 0; k < spline->knot_count; k++) {
        int sample = document_sample(moved, spline->knots[k].frame);
        struct change change = {.kind = CHANGE_KNOT_IN, .spline = spline_index, .knot = spline->knots[k]};
        if ((sample < 0 || sample > last) && !plan_add(list, &change, error)) return false;
    }
    return true;
}

static bool move_knot(const struct document *moved, int spline_index, int k, int sample, struct change_list *list,
                      struct error *error)
{
    struct change change = {
        .kind = CHANGE_KNOT, .spline = spline_index, .knot = moved->splines[spline_index].knots[k]};
    change.knot.frame = document_frame(moved, sample);
    return plan_add(list, &change, error);
}

/// Moves knots that fall outside to the nearest samples inside, pushing others along. They move in an order in which no two meet.
static bool move_knots(const struct document *moved, int spline_index, struct change_list *list, struct error *error)
{
    const struct spline *spline = &moved->splines[spline_index];
    int count = spline->knot_count, last = document_last_knot_sample(moved, spline);
    if (count > last + 1) {
        return fail(error, ERROR_INPUT, "%s: %d knots do not fit into %d frames", spline->name, count,
                    moved->last_frame - moved->first_frame + 1);
    }
    int low = 0, high = count; // knots that are pushed to the right, up to `low`, and to the left, from `high` on
    while (low < count && document_sample(moved, spline->knots[low].frame) < low) low++;
    while (high > low && document_sample(moved, spline->knots[high - 1].frame) > last - (count - high)) high--;
    for (int k = low - 1; k >= 0; k--) {
        if (!move_knot(moved, spline_index, k, k, list, error)) return false;
    }
    for (int k = high; k < count; k++) {
        if (!move_knot(moved, spline_index, k, last - (count - 1 - k), list, error)) return false;
    }
    return true;
}

/// Moves a rig's pins that fall outside to the nearest sample inside, or removes them.
static bool fit_pins(const struct document *moved, int rig, enum range_fit fit, struct change_list *list,
                     struct error *error)
{
    const int last = pins_last_sample(moved, &moved->rigs[rig]);
    for (int i = 0; i < moved->rigs[rig].pin_count; i++) {
        struct change change = {.kind = fit == RANGE_TRIM ? CHANGE_PIN_IN : CHANGE_PIN, .spline = -1};
        const struct pin *pin = &moved->rigs[rig].pins[i];
        const int sample = document_sample(moved, pin->frame);
        if (sample >= 0 && sample <= last) continue;
        change.pin.rig = rig;
        change.pin.pin = *pin;
        if (fit == RANGE_MOVE) change.pin.pin.frame = document_frame(moved, sample < 0 ? 0 : last);
        if (!plan_add(list, &change, error)) return false;
    }
    return true;
}

bool plan_range(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    struct timing timing = timing_of(document);
    timing.first = edit->first;
    timing.last = edit->last;
    if (!check_timing(document, &timing, error)) return false;
    struct document moved = with_timing(document, &timing);
    if (!check_loops(&moved, error)) return false;
    for (int s = 0; edit->fit != RANGE_REFUSE && s < document->spline_count; s++) {
        bool fits = edit->fit == RANGE_TRIM ? trim_knots(&moved, s, list, error) : move_knots(&moved, s, list, error);
        if (!fits) return false;
    }
    for (int r = 0; edit->fit != RANGE_REFUSE && r < document->rig_count; r++) {
        if (!fit_pins(&moved, r, edit->fit, list, error)) return false;
    }
    if (edit->fit == RANGE_REFUSE && !check_knots_fit(&moved, NULL, error)) return false;
    return add_timing(document, &timing, list, error);
}

bool plan_document(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    (void)document;
    struct change change = {.kind = CHANGE_DOCUMENT, .spline = -1, .document = edit->document};
    return plan_add(list, &change, error);
}
