/// Helpers of all edits; and edits of the document's frames per second, substeps and range of frames.
#include "scene/editing.h"
#include "scene/pins.h"
#include <math.h>
#include <string.h>

static bool check_loops(const struct document *document, struct error *error)
{
    for (int i = 0; i < document->spline_count && document_samples(document) == 1; i++) {
        const struct spline *spline = document->splines[i];
        if (spline_start(spline) != WIGGLY_LOOP) continue;
        return fail(error, ERROR_INPUT, "%s: a loop needs more than one frame", spline->name);
    }
    return true;
}

/// Whether all knots are inside the document's frames, on different samples.
static bool check_knots_fit(const struct document *document, struct error *error)
{
    for (int i = 0; i < document->spline_count; i++) {
        const struct spline *spline = document->splines[i];
        int before = -1, last = document_last_knot_sample(document, spline);
        for (int k = 0; k < spline->knot_count; k++) {
            const double frame = spline->knots[k].frame;
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

struct timing {
    double fps;
    int substeps, first, last;
};

static struct timing timing_of(const struct document *document)
{
    return (struct timing){document->fps, document->substeps, document->first_frame, document->last_frame};
}

/// Whether a timing is allowed, knots not considered.
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
    return document_check_samples(document->spline_count, document_count_limited(document), samples, error);
}

static void set_timing(struct document *document, const struct timing *timing)
{
    document->fps = timing->fps;
    document->substeps = timing->substeps;
    document->first_frame = timing->first;
    document->last_frame = timing->last;
    document_touch(document);
}

/// Multiplies the frames of all knots and pins.
static void scale_frames(struct document *document, double factor)
{
    for (int s = 0; s < document->spline_count; s++) {
        struct spline *spline = document_own_spline(document, s);
        for (int k = 0; k < spline->knot_count; k++) spline->knots[k].frame = spline->knots[k].frame * factor + 0.0;
    }
    for (int r = 0; r < document->rig_count; r++) {
        struct rig *rig = document_own_rig(document, r);
        for (int i = 0; i < rig->pin_count; i++) rig->pins[i].frame = rig->pins[i].frame * factor + 0.0;
    }
}

/// The scaled end of the range, rounded outwards so that knots inside stay inside.
static int scaled_end(int frame, double factor, bool first)
{
    const double slack = 1e-6; // so that 96 · 30/24 stays 120
    double scaled = first ? floor(frame * factor + slack) : ceil(frame * factor - slack);
    return (int)fmax(-SCENE_MAX_FRAME - 1, fmin(SCENE_MAX_FRAME + 1, scaled));
}

bool edit_fps(struct document *document, double fps, bool keeps_seconds, struct error *error)
{
    struct timing timing = timing_of(document);
    const double factor = fps / document->fps;
    timing.fps = fps;
    if (!check_timing(document, &timing, error)) return false;
    if (fps == document->fps) return true;
    if (keeps_seconds) {
        timing.first = scaled_end(document->first_frame, factor, true);
        timing.last = scaled_end(document->last_frame, factor, false);
        if (!check_timing(document, &timing, error)) return false;
    }
    struct document *before = document_copy(document);
    if (keeps_seconds) scale_frames(document, factor);
    set_timing(document, &timing);
    return edit_end(document, before, check_loops(document, error) && check_knots_fit(document, error), error);
}

bool edit_substeps(struct document *document, int substeps, struct error *error)
{
    struct timing timing = timing_of(document);
    timing.substeps = substeps;
    if (!check_timing(document, &timing, error)) return false;
    if (substeps == document->substeps) return true;
    struct document *before = document_copy(document);
    set_timing(document, &timing);
    return edit_end(document, before, check_knots_fit(document, error), error);
}

static bool is_outside(const struct document *document, double frame, int last)
{
    const int sample = document_sample(document, frame);
    return sample < 0 || sample > last;
}

/// Removes a spline's knots that fall outside the range.
static void trim_knots(struct document *document, int index)
{
    const struct spline *spline = document->splines[index];
    const int last = document_last_knot_sample(document, spline), count = spline->knot_count;
    int from = 0, to = count;
    while (from < count && document_sample(document, spline->knots[from].frame) < 0) from++;
    while (to > from && document_sample(document, spline->knots[to - 1].frame) > last) to--;
    if (to - from == count) return;
    struct spline *own = document_own_spline(document, index);
    memmove(own->knots, own->knots + from, (size_t)(to - from) * sizeof *own->knots);
    own->knot_count = to - from;
}

/// Moves knots outside the range to the nearest samples inside, and pushes other knots along.
static bool move_knots(struct document *document, int index, struct error *error)
{
    const struct spline *spline = document->splines[index];
    int count = spline->knot_count, last = document_last_knot_sample(document, spline);
    if (count > last + 1) {
        return fail(error, ERROR_INPUT, "%s: %d knots do not fit into %d frames", spline->name, count,
                    document->last_frame - document->first_frame + 1);
    }
    int low = 0, high = count; // knots up to `low` are pushed right, those from `high` on left
    while (low < count && document_sample(document, spline->knots[low].frame) < low) low++;
    while (high > low && document_sample(document, spline->knots[high - 1].frame) > last - (count - high)) high--;
    if (low == 0 && high == count) return true;
    struct knot *knots = document_own_spline(document, index)->knots;
    for (int k = 0; k < low; k++) knots[k].frame = document_frame(document, k);
    for (int k = high; k < count; k++) knots[k].frame = document_frame(document, last - (count - 1 - k));
    return true;
}

/// Moves a rig's pins outside the range to the nearest sample inside, or removes them.
static void fit_pins(struct document *document, int index, enum range_fit fit)
{
    const struct rig *rig = document->rigs[index];
    const int last = pins_last_sample(document, rig);
    for (int i = 0; i < rig->pin_count;) {
        if (!is_outside(document, rig->pins[i].frame, last)) {
            i++;
            continue;
        }
        struct rig *own = document_own_rig(document, index);
        struct pin pin = pins_remove(own, own->pins[i].id);
        pin.frame = document_frame(document, document_sample(document, pin.frame) < 0 ? 0 : last);
        if (fit == RANGE_MOVE) pins_insert(own, &pin);
        rig = own;
        i = 0; // the pins' order has changed
    }
}

/// Handles what is outside the document's new range.
static bool fit_all(struct document *document, enum range_fit fit, struct error *error)
{
    bool good = check_loops(document, error);
    for (int s = 0; good && fit != RANGE_REFUSE && s < document->spline_count; s++) {
        if (fit == RANGE_TRIM)
            trim_knots(document, s);
        else
            good = move_knots(document, s, error);
    }
    for (int r = 0; good && fit != RANGE_REFUSE && r < document->rig_count; r++) fit_pins(document, r, fit);
    return good && (fit != RANGE_REFUSE || check_knots_fit(document, error));
}

bool edit_range(struct document *document, int first, int last, enum range_fit fit, struct error *error)
{
    struct timing timing = timing_of(document);
    timing.first = first;
    timing.last = last;
    if (!check_timing(document, &timing, error)) return false;
    if (first == document->first_frame && last == document->last_frame) return true;
    struct document *before = document_copy(document);
    set_timing(document, &timing);
    return edit_end(document, before, fit_all(document, fit, error), error);
}

/// Whether the document's pins and floors would be allowed in a file.
static bool suits_pins(const struct document *document, struct error *error)
{
    struct pin_trouble trouble;
    if (!pins_hold_any(document) || (pins_check(document, &trouble) && pins_check_order(document, &trouble)))
        return true;
    const struct rig *rig = document->rigs[trouble.rig];
    return fail(error, ERROR_INPUT, "%s: %s: %s", rig_title(rig), trouble.pin >= 0 ? "pins" : trouble.member,
                trouble.error.text);
}

bool edit_end(struct document *document, struct document *before, bool good, struct error *error)
{
    good = good && document_check_joints(document, error) && suits_pins(document, error);
    if (good) {
        document_destroy(before);
    } else {
        document_become(document, before);
    }
    return good;
}

bool edit_has_spline(const struct document *document, int spline, struct error *error)
{
    return (spline >= 0 && spline < document->spline_count) || fail(error, ERROR_INPUT, "there is no such spline");
}

/// The word for a rig of one of these kinds.
static const char *word_for(unsigned kinds)
{
    for (int k = 0; k < RIG_KINDS; k++) {
        if (kinds == EDIT_KIND(k)) return rig_word((enum rig_kind)k);
    }
    return "rig";
}

const struct rig *edit_find_rig(const struct document *document, int rig, unsigned kinds, struct error *error)
{
    const bool is_rig = rig >= 0 && rig < document->rig_count;
    if (is_rig && kinds & EDIT_KIND(document->rigs[rig]->kind)) return document->rigs[rig];
    fail(error, ERROR_INPUT, "there is no such %s", word_for(kinds));
    return NULL;
}

bool edit_replace_rig(struct document *document, int rig, struct rig *changed, struct error *error)
{
    const bool good = rig_check(document, changed, error);
    if (!good || rig_equals(document->rigs[rig], changed)) {
        rig_drop(changed);
        return good;
    }
    struct document *before = document_copy(document);
    rig_drop(document->rigs[rig]);
    document->rigs[rig] = changed;
    document_touch(document);
    return edit_end(document, before, true, error);
}
