/// Edits: of the scene's frames, of splines and knots, of rigs and their pins, channels, drives and paint.
#include "scene/edit.h"
#include "base/file.h"
#include "base/names.h"
#include "base/need.h"
#include "scene/fields.h"
#include "scene/pins.h"
#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EDIT_KIND(kind) (1u << (kind))
#define EDIT_BENT (EDIT_KIND(RIG_TAIL) | EDIT_KIND(RIG_CHAIN)) ///< kinds that have channels
#define EDIT_ANY_KIND (EDIT_KIND(RIG_KINDS) - 1)

/// Ends an edit of a document, of which `before` is a copy; `good` says whether it went well so far. If not, or if a file could not have its
/// pins and floors any more, the document is restored. Returns whether it went well.
static bool end_edit(struct document *document, struct document *before, bool good, struct error *error)
{
    struct pin_trouble trouble;
    good = good && document_check_joints(document, error);
    if (good && !pins_check(document, &trouble)) {
        const struct rig *rig = document->rigs[trouble.rig];
        good = fail(error, ERROR_INPUT, "%s: %s: %s", rig_title(rig), trouble.pin >= 0 ? "pins" : trouble.member,
                    trouble.error.text);
    }

    if (good) {
        document_destroy(before);
    } else {
        document_become(document, before);
    }
    return good;
}

/// The rig at that index if it is of one of those kinds; NULL and an error if not.
static const struct rig *find_rig(const struct document *document, int rig, unsigned kinds, struct error *error)
{
    const bool is_rig = rig >= 0 && rig < document->rig_count;
    if (is_rig && kinds & EDIT_KIND(document->rigs[rig]->kind)) return document->rigs[rig];
    const char *word = "rig";
    for (int k = 0; k < RIG_KINDS; k++) {
        if (kinds == EDIT_KIND(k)) word = rig_word((enum rig_kind)k);
    }
    fail(error, ERROR_INPUT, "there is no such %s", word);
    return NULL;
}

/// Replaces a rig by a changed clone, and takes the clone over, if the document allows it and it differs in more than name and pins.
static bool replace_rig(struct document *document, int rig, struct rig *changed, struct error *error)
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
    return end_edit(document, before, true, error);
}

// --- frames per second, substeps and range

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

/// Whether a document's timing is allowed, knots not considered.
static bool check_timing(const struct document *document, struct error *error)
{
    const long long frames = (long long)document->last_frame - document->first_frame;
    if (!(document->fps > 0 && document->fps <= SCENE_MAX_FPS)) {
        return fail(error, ERROR_INPUT, "frames per second must be above 0 and at most %d", SCENE_MAX_FPS);
    }
    if (document->substeps < 1 || document->substeps > SCENE_MAX_SUBSTEPS) {
        return fail(error, ERROR_INPUT, "substeps must be from 1 to %d", SCENE_MAX_SUBSTEPS);
    }
    if (frames < 0) return fail(error, ERROR_INPUT, "the last frame must not be before the first");
    if (document->first_frame < -SCENE_MAX_FRAME || document->last_frame > SCENE_MAX_FRAME) {
        return fail(error, ERROR_INPUT, "frames must be from -%d to %d", SCENE_MAX_FRAME, SCENE_MAX_FRAME);
    }
    return document_check_samples(document->spline_count, document_count_limited(document),
                                  frames * document->substeps + 1, error);
}

/// Makes a document what a shallow copy of it with another timing is. Returns a copy from before.
static struct document *set_timing(struct document *document, const struct document *wanted)
{
    struct document *before = document_copy(document);
    *document = *wanted;
    document_touch(document);
    return before;
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
    struct document wanted = *document;
    const double factor = fps / document->fps;
    wanted.fps = fps;
    if (!check_timing(&wanted, error)) return false;
    if (fps == document->fps) return true;
    if (keeps_seconds) {
        wanted.first_frame = scaled_end(document->first_frame, factor, true);
        wanted.last_frame = scaled_end(document->last_frame, factor, false);
        if (!check_timing(&wanted, error)) return false;
    }
    struct document *before = set_timing(document, &wanted);
    for (int s = 0; keeps_seconds && s < document->spline_count; s++) {
        struct spline *spline = document_own_spline(document, s);
        for (int k = 0; k < spline->knot_count; k++) spline->knots[k].frame = spline->knots[k].frame * factor + 0.0;
    }
    for (int r = 0; keeps_seconds && r < document->rig_count; r++) {
        struct rig *rig = document_own_rig(document, r);
        rig->offset *= factor;
        for (int i = 0; i < rig->pin_count; i++) rig->pins[i].frame = rig->pins[i].frame * factor + 0.0;
    }
    return end_edit(document, before, check_loops(document, error) && check_knots_fit(document, error), error);
}

bool edit_substeps(struct document *document, int substeps, struct error *error)
{
    struct document wanted = *document;
    wanted.substeps = substeps;
    if (!check_timing(&wanted, error)) return false;
    if (substeps == document->substeps) return true;
    struct document *before = set_timing(document, &wanted);
    return end_edit(document, before, check_knots_fit(document, error), error);
}

bool edit_background(struct document *document, const struct background_file *wanted, struct error *error)
{
    struct background_file set = *wanted;
    if (set.file && !fields_check(document, JOINTS_UNKNOWN, background_fields, &set, error)) return false;
    if (fields_equal(background_fields, &set, &document->background)) return true;
    fields_copy(background_fields, &set); // first, because it may be this document's own
    fields_free(background_fields, &document->background);
    document->background = set;
    document_touch(document);
    return true;
}

bool edit_range(struct document *document, int first, int last, enum range_fit fit, struct error *error)
{
    struct document wanted = *document;
    wanted.first_frame = first;
    wanted.last_frame = last;
    if (!check_timing(&wanted, error)) return false;
    if (first == document->first_frame && last == document->last_frame) return true;
    struct document *before = set_timing(document, &wanted);

    bool good = check_loops(document, error);
    if (good && fit == RANGE_REFUSE) good = check_knots_fit(document, error);
    for (int s = 0; good && fit == RANGE_TRIM && s < document->spline_count; s++) { // knots outside go
        const struct spline *spline = document->splines[s];
        const int end = document_last_knot_sample(document, spline), count = spline->knot_count;
        int from = 0, to = count;
        while (from < count && document_sample(document, spline->knots[from].frame) < 0) from++;
        while (to > from && document_sample(document, spline->knots[to - 1].frame) > end) to--;
        if (to - from == count) continue;
        struct spline *own = document_own_spline(document, s);
        memmove(own->knots, own->knots + from, (size_t)(to - from) * sizeof *own->knots);
        own->knot_count = to - from;
    }
    for (int s = 0; good && fit == RANGE_MOVE && s < document->spline_count; s++) {
        // They move to the nearest samples inside, and push other knots along.
        const struct spline *spline = document->splines[s];
        const int end = document_last_knot_sample(document, spline), count = spline->knot_count;
        if (count > end + 1) {
            good = fail(error, ERROR_INPUT, "%s: %d knots do not fit into %d frames", spline->name, count,
                        document->last_frame - document->first_frame + 1);
            break;
        }
        int low = 0, high = count; // knots up to `low` are pushed right, those from `high` on left
        while (low < count && document_sample(document, spline->knots[low].frame) < low) low++;
        while (high > low && document_sample(document, spline->knots[high - 1].frame) > end - (count - high)) high--;
        if (low == 0 && high == count) continue;
        struct knot *knots = document_own_spline(document, s)->knots;
        for (int k = 0; k < low; k++) knots[k].frame = document_frame(document, k);
        for (int k = high; k < count; k++) knots[k].frame = document_frame(document, end - (count - 1 - k));
    }

    // Pins outside move to the nearest sample inside, or go.
    for (int r = 0; good && fit != RANGE_REFUSE && r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        const int end = pins_last_sample(document, rig);
        for (int i = 0; i < rig->pin_count;) {
            const int sample = document_sample(document, rig->pins[i].frame);
            if (sample >= 0 && sample <= end) {
                i++;
                continue;
            }
            struct rig *own = document_own_rig(document, r);
            struct pin pin = pins_remove(own, own->pins[i].id);
            pin.frame = document_frame(document, sample < 0 ? 0 : end);
            if (fit == RANGE_MOVE) pins_insert(own, &pin);
            rig = own;
            i = 0; // the pins' order has changed
        }
    }
    return end_edit(document, before, good, error);
}

// --- splines and knots

/// `base`, or the first free name among "base 2", "base 3" …; a number at the end of `base` is replaced.
static char *free_name(const struct document *document, const char *base)
{
    size_t length = strlen(base), stem = length;
    while (stem > 0 && isdigit((unsigned char)base[stem - 1])) stem--;
    bool numbered = stem > 1 && stem < length && base[stem - 1] == ' ';
    if (numbered) length = stem - 1;
    struct names names = {0};
    for (int i = 0; i < document->spline_count; i++) names_add(&names, document->splines[i]->name);
    char *wanted = name_from(base, length), *name = need_text(names_add(&names, wanted));
    names_free(&names);
    free(wanted);
    return name;
}

static bool check_spline_name(const struct document *document, const char *name, int own, struct error *error)
{
    int other = document_find_spline(document, name);
    if (!name[0]) return fail(error, ERROR_INPUT, "a spline needs a name");
    if (other < 0 || other == own) return true;
    return fail(error, ERROR_INPUT, "a spline called %s already exists", name);
}

/// Updates all references to splines when the one at `from` moves to `to`. INT_MAX as `from` or `to` means outside the list.
static void move_references(struct document *document, int from, int to)
{
    for (struct reference reference = {0}; reference_next(document, &reference);) {
        const int index = reference.spline;
        if (index == from)
            reference_set(document, &reference, to);
        else if (from < index && index <= to)
            reference_set(document, &reference, index - 1);
        else if (to <= index && index < from)
            reference_set(document, &reference, index + 1);
    }
}

/// Inserts a spline with new ids.
static bool add_spline(struct document *document, int at, struct spline *spline, struct error *error)
{
    const int limited = spline_is_limited(spline) + document_count_limited(document);
    long long total = spline->knot_count;
    for (int i = 0; i < document->spline_count; i++) total += document->splines[i]->knot_count;
    bool good = document_check_samples(document->spline_count + 1, limited, document_samples(document), error);
    if (good && total > SCENE_MAX_KNOTS)
        good = fail(error, ERROR_INPUT, "the limit is %d knots over all splines", SCENE_MAX_KNOTS);
    if (!good) {
        spline_drop(spline);
        return false;
    }
    spline->id = document->next_id++;
    for (int k = 0; k < spline->knot_count; k++) spline->knots[k].id = document->next_id++;
    document_insert_spline(document, at, spline);
    move_references(document, INT_MAX, at);
    return true;
}

static void set_text(char **text, const char *value)
{
    char *copy = value[0] ? need_text(value) : NULL; // first: need_text() may save the document when memory runs out
    free(*text);
    *text = copy;
}

bool edit_spline_add(struct document *document, int at, const char *name, const struct knot *first,
                     struct error *error)
{
    const int count = document->spline_count;
    if (name && !check_spline_name(document, name, -1, error)) return false;
    const int sample = first ? document_sample(document, first->frame) : 0;
    if (first && !(isfinite(first->frame) && isfinite(first->value)))
        return fail(error, ERROR_INPUT, "a knot's numbers must be finite");
    if (sample < 0 || sample >= document_samples(document)) {
        return fail(error, ERROR_INPUT, "frame %.10g is outside %d to %d", first->frame, document->first_frame,
                    document->last_frame);
    }
    struct spline *spline = spline_create();
    spline->name = free_name(document, name ? name : "spline");
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        spline->parameter[p].value = parameter_rows[p].fresh;
    }
    if (document_loops(document)) spline->parameter[PARAMETER_START].value = WIGGLY_LOOP;
    spline->knots = need(1, sizeof *spline->knots);
    if (first) {
        spline->knot_count = 1;
        spline->knots[0] = (struct knot){
            .frame = first->frame + 0.0, .value = first->value + 0.0, .stiffness = KNOT_DEFAULT_STIFFNESS};
        if (sample > document_last_knot_sample(document, spline))
            spline->knots[0].frame = document->first_frame; // the last frame of a loop repeats the first
    }
    return add_spline(document, at < 0 || at > count ? count : at, spline, error);
}

bool edit_spline_copy(struct document *document, int spline, struct error *error)
{
    if (!document_has_spline(document, spline, error)) return false;
    struct spline *copy = spline_clone(document->splines[spline]);
    free(copy->name);
    copy->name = free_name(document, document->splines[spline]->name);
    return add_spline(document, spline + 1, copy, error);
}

bool edit_spline_remove(struct document *document, int spline, struct error *error)
{
    if (!document_has_spline(document, spline, error)) return false;
    int followers = reference_count(document, spline);
    if (followers > 0) {
        return fail(error, ERROR_INPUT, "%s: still used in %d place%s; remove those first",
                    document->splines[spline]->name, followers, followers == 1 ? "" : "s");
    }
    move_references(document, spline, INT_MAX);
    document_remove_spline(document, spline);
    return true;
}

bool edit_spline_move(struct document *document, int spline, int to, struct error *error)
{
    if (!document_has_spline(document, spline, error)) return false;
    if (to < 0 || to >= document->spline_count) return fail(error, ERROR_INPUT, "there is no such place in the list");
    if (to == spline) return true;
    struct spline *moved = spline_hold(document->splines[spline]);
    document_remove_spline(document, spline);
    document_insert_spline(document, to, moved);
    move_references(document, spline, to);
    return true;
}

bool edit_spline_name(struct document *document, int spline, const char *name, struct error *error)
{
    if (!document_has_spline(document, spline, error) || !check_spline_name(document, name, spline, error))
        return false;
    if (strcmp(document->splines[spline]->name, name) != 0)
        set_text(&document_own_spline(document, spline)->name, name);
    return true;
}

bool edit_spline_color(struct document *document, int spline, int color, struct error *error)
{
    if (!document_has_spline(document, spline, error)) return false;
    if (color < -1 || color > 0xFFFFFF) return fail(error, ERROR_INPUT, "there is no such colour");
    if (document->splines[spline]->color != color) document_own_spline(document, spline)->color = color;
    return true;
}

bool edit_spline_folder(struct document *document, int spline, const char *folder, struct error *error)
{
    if (!document_has_spline(document, spline, error)) return false;
    const char *before = document->splines[spline]->folder;
    if (strcmp(before ? before : "", folder) != 0) set_text(&document_own_spline(document, spline)->folder, folder);
    return true;
}

bool edit_spline_lock(struct document *document, int spline, bool locked, struct error *error)
{
    if (!document_has_spline(document, spline, error)) return false;
    if (document->splines[spline]->locked != locked) document_own_spline(document, spline)->locked = locked;
    return true;
}

static bool check_constant(const struct spline *spline, enum parameter parameter, double value, struct error *error)
{
    double low = parameter_rows[parameter].minimum, high = parameter_maximum(parameter, spline_mode(spline));
    const char *name = parameter_rows[parameter].name;
    if (!isfinite(value)) return fail(error, ERROR_INPUT, "%s: %s must be finite", spline->name, name);
    if (parameter_rows[parameter].kind == PARAMETER_WHOLE && value != floor(value))
        return fail(error, ERROR_INPUT, "%s: %s must be a whole number", spline->name, name);
    if (value >= low && value <= high) return true;
    if (value < low) return fail(error, ERROR_INPUT, "%s: %s must be at least %g", spline->name, name, low);
    return fail(error, ERROR_INPUT, "%s: %s must be at most %g", spline->name, name, high);
}

/// An infinite limit is no limit. Knots must be within.
static bool check_limit(const struct document *document, const struct spline *spline, enum parameter parameter,
                        double value, struct error *error)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    const bool is_high = parameter == PARAMETER_HIGH;
    const double other = spline->parameter[is_high ? PARAMETER_LOW : PARAMETER_HIGH].value;
    if (value == row->standard) return true;
    if (!isfinite(value)) return fail(error, ERROR_INPUT, "%s: a limit must be finite", spline->name);
    const int limited = document_count_limited(document) + !spline_is_limited(spline);
    if (!document_check_samples(document->spline_count, limited, document_samples(document), error)) return false;
    if (is_high ? value <= other : value >= other)
        return fail(error, ERROR_INPUT, "%s: the low limit must be below the high one", spline->name);
    for (int k = 0; k < spline->knot_count; k++) {
        char frame[NUMBER_TEXT_SIZE];
        if (spline->knots[k].still) continue;
        if (is_high ? spline->knots[k].value <= value : spline->knots[k].value >= value) continue;
        number_print(spline->knots[k].frame, frame);
        return fail(error, ERROR_INPUT, "%s: the knot at frame %s is %s that", spline->name, frame,
                    is_high ? "above" : "below");
    }
    return true;
}

/// Sets a parameter, but does not check whether splines then follow each other in a circle.
static bool set_parameter(struct document *document, int index, enum parameter parameter, const struct param *param,
                          struct error *error)
{
    const struct spline *old = document->splines[index];
    const struct parameter_row *row = &parameter_rows[parameter];
    const double value = param->value;
    struct spline wanted = *old;
    struct param *own = &wanted.parameter[parameter];
    struct joint_motion *motion = NULL;

    if (row->kind == PARAMETER_CHOICE) {
        if (!(value >= 0 && value <= row->maximum && value == floor(value)))
            return fail(error, ERROR_INPUT, "there is no such %s", row->name);
        *own = param_number(value);
        for (enum parameter p = 0; parameter == PARAMETER_MODE && p < PARAMETER_COUNT; p++)
            wanted.parameter[p].value =
                fmin(wanted.parameter[p].value, parameter_maximum(p, (enum wiggly_mode)value));
        if (parameter == PARAMETER_START && value == WIGGLY_LOOP) {
            const int last = document_samples(document) - 1;
            if (last == 0) return fail(error, ERROR_INPUT, "%s: a loop needs more than one frame", old->name);
            if (spline_find_knot(document, old, last) >= 0)
                return fail(error, ERROR_INPUT,
                            "%s: delete the knot at the last frame first; in a loop that frame repeats the first",
                            old->name);
        }
    } else if (param->motion) {
        struct joint_motion checked = *param->motion;
        struct error why;
        if (parameter != PARAMETER_EQUILIBRIUM)
            return fail(error, ERROR_INPUT, "%s: only the equilibrium follows a joint", old->name);
        if (!motion_check(document, &checked, &why)) return fail(error, ERROR_INPUT, "%s: %s", old->name, why.text);
        motion = motion_create(&checked);
        *own = (struct param){.track = -1, .motion = motion};
    } else if (param->track >= 0) {
        if (row->kind != PARAMETER_TRACK)
            return fail(error, ERROR_INPUT, "%s: %s must be a number", old->name, row->name);
        if (param->track >= document->spline_count)
            return fail(error, ERROR_INPUT, "%s: there is no spline to follow", old->name);
        *own = param_track(param->track);
    } else {
        if (!(row->kind == PARAMETER_LIMIT ? check_limit(document, old, parameter, value, error)
                                           : check_constant(old, parameter, value, error)))
            return false;
        *own = param_number(value + 0.0);
    }

    bool same = true;
    for (int p = 0; p < PARAMETER_COUNT; p++) {
        const struct param *a = &old->parameter[p], *b = &wanted.parameter[p];
        same &= a->value == b->value && a->track == b->track && motion_equals(a->motion, b->motion);
    }
    if (!same) {
        struct spline *changed = document_own_spline(document, index);
        motion_hold(wanted.parameter[PARAMETER_EQUILIBRIUM].motion);
        motion_drop(changed->parameter[PARAMETER_EQUILIBRIUM].motion);
        memcpy(changed->parameter, wanted.parameter, sizeof changed->parameter);
    }
    motion_drop(motion);
    return true;
}

bool edit_parameter(struct document *document, int spline, enum parameter parameter, const struct param *param,
                    struct error *error)
{
    if (!document_has_spline(document, spline, error)) return false;
    if ((unsigned)parameter >= PARAMETER_COUNT) return fail(error, ERROR_INPUT, "there is no such parameter");
    struct document *before = document_copy(document);
    bool good = set_parameter(document, spline, parameter, param, error);
    struct order_cycle cycle;
    if (good && param->track >= 0 && !scene_has_order(document, &cycle)) {
        good = fail(error, ERROR_INPUT, "%s cannot follow %s, which already follows it",
                    before->splines[spline]->name, before->splines[param->track]->name);
    }
    return end_edit(document, before, good, error);
}

/// Whether a knot is allowed; `id` is its own. Turns −0 into 0, as saving does, and clears slope and phase of a still
/// knot.
static bool check_knot(const struct document *document, const struct spline *spline, struct knot *knot, unsigned id,
                       struct error *error)
{
    char frame[NUMBER_TEXT_SIZE];
    struct error why;
    const double kept = knot->value;
    if (knot->still)
        *knot = (struct knot){.frame = knot->frame,
                              .stiffness = KNOT_DEFAULT_STIFFNESS,
                              .still = true,
                              .id = knot->id,
                              .extra = knot->extra};
    if (!fields_check(document, JOINTS_UNKNOWN, knot_fields, knot, &why))
        return fail(error, ERROR_INPUT, "%s: a knot: %s", spline->name, why.text);
    if (knot->still) knot->value = kept;
    const double low = spline->parameter[PARAMETER_LOW].value, high = spline->parameter[PARAMETER_HIGH].value;
    if (!knot->still && (knot->value < low || knot->value > high)) {
        return fail(error, ERROR_INPUT, "%s: a knot at %.6g would be %s limit, %.6g", spline->name, knot->value,
                    knot->value < low ? "below the low" : "above the high", knot->value < low ? low : high);
    }
    int sample = document_sample(document, knot->frame), last = document_last_knot_sample(document, spline);
    if (sample < 0 || sample > last) {
        number_print(knot->frame, frame);
        return fail(error, ERROR_INPUT, "%s: frame %s is outside %d to %d%s", spline->name, frame,
                    document->first_frame, document->last_frame,
                    spline_start(spline) == WIGGLY_LOOP ? "; the last frame of a loop repeats the first" : "");
    }
    int there = spline_find_knot(document, spline, sample);
    if (there < 0 || spline->knots[there].id == id) return true;
    number_print(knot->frame, frame);
    return fail(error, ERROR_INPUT, "%s: there is already a knot at frame %s", spline->name, frame);
}

bool edit_knot_insert(struct document *document, int spline, const struct knot *knot, struct error *error)
{
    struct knot added = *knot;
    long long total = 1;
    bool exists = false;
    if (!document_has_spline(document, spline, error)) return false;
    const struct spline *old = document->splines[spline];
    if (!check_knot(document, old, &added, 0, error)) return false;
    for (int i = 0; i < document->spline_count; i++) {
        total += document->splines[i]->knot_count;
        exists |= added.id != 0 && spline_find_id(document->splines[i], added.id) >= 0;
    }
    if (exists) return fail(error, ERROR_INPUT, "%s: this knot already exists", old->name);
    if (total > SCENE_MAX_KNOTS) return fail(error, ERROR_INPUT, "the limit of %d knots is reached", SCENE_MAX_KNOTS);
    if (added.id == 0) added.id = document->next_id;
    if (document->next_id <= added.id) document->next_id = added.id + 1;
    struct spline *own = document_own_spline(document, spline);
    own->knots = need_more(own->knots, (size_t)own->knot_count + 1, sizeof *own->knots);
    const int at = spline_lower_bound(document, own, document_sample(document, added.frame));
    memmove(&own->knots[at + 1], &own->knots[at], (size_t)(own->knot_count++ - at) * sizeof added);
    own->knots[at] = added;
    return true;
}

/// Index of the knot with that id; -1 and an error if there is none.
static int find_knot(const struct document *document, int spline, unsigned id, struct error *error)
{
    if (!document_has_spline(document, spline, error)) return -1;
    const int at = spline_find_id(document->splines[spline], id);
    if (at < 0) fail(error, ERROR_INPUT, "%s: this knot no longer exists", document->splines[spline]->name);
    return at;
}

bool edit_knot_remove(struct document *document, int spline, unsigned id, struct error *error)
{
    const int at = find_knot(document, spline, id, error);
    if (at < 0) return false;
    struct spline *own = document_own_spline(document, spline);
    memmove(&own->knots[at], &own->knots[at + 1], (size_t)(--own->knot_count - at) * sizeof *own->knots);
    return true;
}

bool edit_knot_set(struct document *document, int spline, const struct knot *knot, struct error *error)
{
    struct knot changed = *knot;
    const int from = find_knot(document, spline, knot->id, error);
    if (from < 0) return false;
    const struct spline *old = document->splines[spline];
    changed.extra = old->knots[from].extra;
    if (!check_knot(document, old, &changed, changed.id, error)) return false;
    if (fields_equal(knot_fields, &changed, &old->knots[from])) return true;
    struct knot *knots = document_own_spline(document, spline)->knots;
    int to = spline_lower_bound(document, document->splines[spline], document_sample(document, changed.frame));
    if (to > from) to--; // its index once the old one is removed
    if (to > from) memmove(&knots[from], &knots[from + 1], (size_t)(to - from) * sizeof *knots);
    if (to < from) memmove(&knots[to + 1], &knots[to], (size_t)(from - to) * sizeof *knots);
    knots[to] = changed;
    return true;
}

bool edit_spline_settles(struct document *document, int spline, bool settles, struct error *error)
{
    bool done = document_has_spline(document, spline, error);
    for (int k = 0; done && k < document->splines[spline]->knot_count; k++) {
        struct knot knot = document->splines[spline]->knots[k];
        knot.settles = settles && !knot.still;
        knot.has_phase &= !settles;
        done = edit_knot_set(document, spline, &knot, error);
    }
    return done;
}

// --- rigs and their pins

enum { NAME_SIZE = 512 };

static const struct joint_motion *motion_of_spline(const struct document *document, int spline)
{
    return document->splines[spline]->parameter[PARAMETER_EQUILIBRIUM].motion;
}

static void append_name(char list[NAME_SIZE], const char *name)
{
    const size_t used = strlen(list);
    if (used + 2 < NAME_SIZE)
        snprintf(list + used, NAME_SIZE - used, "%s%.*s", used > 0 ? ", " : "", name_fit(name, NAME_SIZE - used - 3),
                 name);
}

bool edit_rig_remove(struct document *document, int rig, struct error *error)
{
    char users[NAME_SIZE] = "";
    if (!find_rig(document, rig, EDIT_ANY_KIND, error)) return false;
    for (int r = -1; (r = document_next_chain(document, rig, r)) >= 0;)
        append_name(users, rig_title(document->rigs[r]));
    for (int s = 0; s < document->spline_count; s++) {
        if (document_follows(document, s, rig)) append_name(users, document->splines[s]->name);
    }
    if (users[0]) {
        return fail(error, ERROR_INPUT, "%s: still needed by %s; remove those first", rig_title(document->rigs[rig]),
                    users);
    }
    document_remove_rig(document, rig);
    return true;
}

static void take_name(struct names *names, const char *name)
{
    if (name && !names_has(names, name)) names_add(names, name);
}

char *edit_rig_free_name(const struct document *document, const char *wanted)
{
    struct names names = {0};
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        take_name(&names, rig->name);
        if (rig->kind == RIG_CHAIN) take_name(&names, rig->chain.model);
    }
    for (int s = 0; s < document->spline_count; s++) {
        const struct joint_motion *motion = motion_of_spline(document, s);
        if (motion) take_name(&names, motion->model);
    }
    char *name = need_text(names_add(&names, wanted));
    names_free(&names);
    return name;
}

/// What refers to a rig by its old name, or by its old file, refers to the new one.
static void refer(struct document *document, int rig, const char *old, const char *now)
{
    const bool is_model = document->rigs[rig]->kind == RIG_MODEL;
    for (int s = 0; s < document->spline_count; s++) {
        if (!document_follows(document, s, rig)) continue;
        struct param *param = &document_own_spline(document, s)->parameter[PARAMETER_EQUILIBRIUM];
        struct joint_motion *motion = motion_create(param->motion);
        char **own = is_model ? &motion->model : &motion->chain;
        if (strcmp(*own, old) == 0) set_text(own, now);
        motion_drop(param->motion);
        param->motion = motion;
    }
    for (int r = -1; (r = document_next_chain(document, rig, r)) >= 0;) {
        if (strcmp(document->rigs[r]->chain.model, old) != 0) continue;
        set_text(&document_own_rig(document, r)->chain.model, now);
    }
}

bool edit_rig_name(struct document *document, int rig, const char *name, struct error *error)
{
    if (!find_rig(document, rig, EDIT_ANY_KIND, error)) return false;
    const enum rig_kind kind = document->rigs[rig]->kind;
    if (!name || !name[0]) return fail(error, ERROR_INPUT, "a %s needs a name", rig_word(kind));
    for (int r = 0; r < document->rig_count; r++) {
        const char *other = document->rigs[r]->name;
        if (r != rig && other && strcmp(other, name) == 0)
            return fail(error, ERROR_INPUT, "there is a rig called %s already", name);
    }
    const char *const before = document->rigs[rig]->name;
    if (before && strcmp(before, name) == 0) return true;

    // A rig with that name would take the place of a file by which a chain or a spline refers to a model.
    bool is_file = false;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *chain = document->rigs[r];
        is_file |= chain->kind == RIG_CHAIN && strcmp(chain->chain.model, name) == 0;
    }
    for (int s = 0; s < document->spline_count; s++) {
        const struct joint_motion *motion = motion_of_spline(document, s);
        is_file |= motion && strcmp(motion->model, name) == 0;
    }
    if (kind == RIG_MODEL && is_file)
        return fail(error, ERROR_INPUT, "expected a name that is no model's file, got %s", name);
    char *const old = before ? need_text(before) : NULL;

    if (old) refer(document, rig, old, name);
    set_text(&document_own_rig(document, rig)->name, name);
    free(old);
    return true;
}

bool edit_model_file(struct document *document, int rig, const char *file, struct error *error)
{
    if (!find_rig(document, rig, EDIT_KIND(RIG_MODEL), error)) return false;
    char *const old = need_text(document->rigs[rig]->model.model);
    refer(document, rig, old, file);
    set_text(&document_own_rig(document, rig)->model.model, file);
    free(old);
    return true;
}

bool edit_rig_add(struct document *document, const struct rig *contents, struct error *error)
{
    if (document->rig_count >= SCENE_MAX_RIGS)
        return fail(error, ERROR_INPUT, "there are %d rigs, and no more fit", SCENE_MAX_RIGS);
    struct rig *rig = rig_clone(contents);
    if (!rig_check(document, rig, error)) {
        rig_drop(rig);
        return false;
    }
    struct document *before = document_copy(document);

    // Without a name it gets one from its file, joint or kind.
    const char *const title = rig_title(contents);
    const bool is_file = !(rig->name && rig->name[0]) && rig->kind == RIG_MODEL;
    const char *const base = is_file ? path_name(title) : title, *const dot = is_file ? strrchr(base, '.') : NULL;
    char *stem = name_from(base, dot && dot > base ? (size_t)(dot - base) : strlen(base));
    free(rig->name);
    rig->name = edit_rig_free_name(document, stem[0] ? stem : "model");
    free(stem);

    rig->extra = NULL;
    rig->id = document->next_id++;
    document_add_rig(document, rig);
    return end_edit(document, before, true, error);
}

bool edit_rig_set(struct document *document, int rig, const struct rig *wanted, struct error *error)
{
    return find_rig(document, rig, EDIT_KIND(wanted->kind), error) &&
           replace_rig(document, rig, rig_clone(wanted), error);
}

/// The rig that has the pin; NULL and an error if there is none.
static const struct rig *find_pinned(const struct document *document, int rig, unsigned id, struct error *error)
{
    const struct rig *found = find_rig(document, rig, EDIT_ANY_KIND, error);
    if (!found || pins_find_id(found, id) >= 0) return found;
    fail(error, ERROR_INPUT, "%s: this pin no longer exists", rig_title(found));
    return NULL;
}

bool edit_pin_remove(struct document *document, int rig, unsigned id, struct error *error)
{
    if (!find_pinned(document, rig, id, error)) return false;
    struct document *before = document_copy(document);
    pins_remove(document_own_rig(document, rig), id);
    return end_edit(document, before, true, error);
}

bool edit_pin_set(struct document *document, int rig, const struct pin *pin, struct error *error)
{
    const bool is_new = pin->id == 0;
    const struct rig *old =
        is_new ? find_rig(document, rig, EDIT_ANY_KIND, error) : find_pinned(document, rig, pin->id, error);
    struct pin changed = *pin;
    struct error why;
    if (!old) return false;
    if (!fields_check(document, JOINTS_UNKNOWN, rig_pin_fields(old), &changed, &why)) // turns −0 into 0
        return fail(error, ERROR_INPUT, "%s: a pin: %s", rig_title(old), why.text);
    if (is_new && pins_count(document) >= SCENE_MAX_PINS)
        return fail(error, ERROR_INPUT, "the limit of %d pins is reached", SCENE_MAX_PINS);
    if (!is_new) {
        const struct pin *was = &old->pins[pins_find_id(old, pin->id)];
        if (fields_equal(rig_pin_fields(old), was, &changed)) return true;
        changed.extra = was->extra;
    }
    struct document *before = document_copy(document);
    struct rig *own = document_own_rig(document, rig);
    if (is_new) {
        changed.id = document->next_id++;
    } else {
        pins_remove(own, changed.id);
    }
    pins_insert(own, &changed);
    return end_edit(document, before, true, error);
}

// --- channels, drives and paint

/// A clone of the rig that has that channel; NULL and an error if there is none.
static struct rig *clone_bent(const struct document *document, struct channel_place at, struct error *error)
{
    const struct rig *rig = find_rig(document, at.rig, EDIT_BENT, error);
    if (!rig) return NULL;
    if (at.channel >= 0 && at.channel < rig->bent.channel_count) return rig_clone(rig);
    fail(error, ERROR_INPUT, "there is no such channel");
    return NULL;
}

bool edit_angles(struct document *document, struct channel_place at, enum angle_kind kind,
                 const struct angles *angles, struct error *error)
{
    if (kind == ANGLE_REST) {
        const struct rig *rig = find_rig(document, at.rig, EDIT_BENT, error);
        if (!rig) return false;
        if (rig->kind != RIG_TAIL) return fail(error, ERROR_INPUT, "only a tail has angles at rest");
        struct rig wanted = *rig;
        wanted.tail.rest = *angles;
        return edit_rig_set(document, at.rig, &wanted, error);
    }
    struct rig *changed = clone_bent(document, at, error);
    if (!changed) return false;
    struct channel *channel = &changed->bent.channels[at.channel];
    *(kind == ANGLE_LAG ? &channel->lag : &channel->gain) = *angles;
    return replace_rig(document, at.rig, changed, error);
}

bool edit_channel(struct document *document, struct channel_place at, const struct channel *channel,
                  struct error *error)
{
    struct rig *changed = clone_bent(document, at, error);
    if (!changed) return false;
    struct channel *own = &changed->bent.channels[at.channel];
    if (channel) {
        *own = *channel;
    } else {
        memmove(own, own + 1, (size_t)(--changed->bent.channel_count - at.channel) * sizeof *own);
    }
    return replace_rig(document, at.rig, changed, error);
}

/// Appends a visible channel.
static void append_channel(struct rig *rig, int spline, enum axis axis, enum channel_part of)
{
    const size_t count = (size_t)rig->bent.channel_count;
    rig->bent.channels = need_more(rig->bent.channels, count + 1, sizeof *rig->bent.channels);
    struct channel *channel = &rig->bent.channels[count];
    *channel = (struct channel){.spline = spline, .axis = axis, .of = of};
    channel->lag.value[0] = CHANNEL_DEFAULT_LAG;
    if ((unsigned)axis < AXES) channel->gain.value[0] = axis_gain(axis);
    rig->bent.channel_count++;
}

bool edit_channel_add(struct document *document, int rig, int spline, enum axis axis, enum channel_part of,
                      struct error *error)
{
    const struct rig *old = find_rig(document, rig, EDIT_BENT, error);
    if (!old) return false;
    struct rig *changed = rig_clone(old);
    append_channel(changed, spline, axis, of);
    return replace_rig(document, rig, changed, error);
}

static const struct model_rig *find_character(const struct document *document, int rig, struct error *error)
{
    const struct rig *found = find_rig(document, rig, EDIT_KIND(RIG_MODEL), error);
    return found ? &found->model : NULL;
}

bool edit_drive(struct document *document, int rig, int index, const struct drive *drive, struct error *error)
{
    struct drive drives[MODEL_MAX_DRIVES + 1];
    const struct model_rig *character = find_character(document, rig, error);
    if (!character) return false;
    int count = character->drive_count;
    if (index < (drive ? -1 : 0) || index >= count)
        return fail(error, ERROR_INPUT, "this character has no such coordinate");
    struct rig wanted = *document->rigs[rig];
    for (int i = 0; i < count; i++) drives[i] = character->drives[i];
    if (drive) {
        struct drive *own = &drives[index < 0 ? count++ : index];
        char *const name = index < 0 ? drive->name : own->name; // the coordinate keeps its name
        *own = *drive;
        own->name = name;
    } else {
        memmove(&drives[index], &drives[index + 1], (size_t)(--count - index) * sizeof *drives);
    }
    wanted.model.drives = drives;
    wanted.model.drive_count = count;
    return edit_rig_set(document, rig, &wanted, error);
}

bool edit_paint_new(struct document *document, int rig, int coordinates, int vertices, struct error *error)
{
    if (!find_character(document, rig, error)) return false;
    if (coordinates < 1 || vertices < 1)
        return fail(error, ERROR_INPUT, "there is nothing to paint on this character");
    struct paint *paint = paint_create(coordinates, vertices);
    struct model_rig *own = &document_own_rig(document, rig)->model;
    paint_drop(own->painted);
    own->painted = paint;
    return true;
}

bool edit_paint(struct document *document, int rig, const struct dab *dab, struct error *error)
{
    const struct model_rig *old = find_character(document, rig, error);
    if (!old) return false;
    const struct paint *paint = old->painted;
    if (!paint) return fail(error, ERROR_INPUT, "this character has no paint yet");
    if (dab->coordinate < 0 || dab->coordinate >= paint->coordinates)
        return fail(error, ERROR_INPUT, "there is no such coordinate in the paint");
    for (int i = 0; i < dab->count; i++) {
        const float *value = dab->values[i];
        const bool good = fabsf(value[0]) <= PAINT_MOST_SWELL && fabsf(value[1]) <= PAINT_MOST_LEAD;
        if (!good || dab->vertices[i] < 0 || dab->vertices[i] >= paint->vertices)
            return fail(error, ERROR_INPUT, "paint must be finite, and on the model");
    }
    if (dab->count > 0) paint_dab(&document_own_rig(document, rig)->model.painted, dab);
    return true;
}

// --- tails

static const double NEW_REST = 1.5;         ///< degrees per joint, so that a new tail is not a straight cone
static const double NEW_HEIGHT = 0.26;      ///< metres; puts the body of a tail of 1.6 m on the ground
static const double ASIDE = 0.75;           ///< distance from a tail to its copy, in tail lengths
static const double ANGLE_RESOLUTION = 1e6; ///< resampled angles are rounded to 1/this degrees

bool edit_tail_add(struct document *document, int rig, int spline, struct error *error)
{
    const bool is_tail = rig >= 0 && rig < document->rig_count && document->rigs[rig]->kind == RIG_TAIL;
    struct rig *added = is_tail ? rig_clone(document->rigs[rig]) : rig_create(RIG_TAIL);
    free(added->name);
    added->name = NULL;
    added->pin_count = 0; // both tails follow the same splines, so one set of pins is enough
    if (is_tail) {
        if (added->tail.position[0].track < 0) added->tail.position[0].value += ASIDE * added->tail.length;
    } else {
        added->tail.rest.value[0] = NEW_REST;
        added->tail.position[1].value = NEW_HEIGHT;
        if (document_has_spline(document, spline, NULL)) append_channel(added, spline, AXIS_SIDE, PART_TOTAL);
    }
    const bool good = edit_rig_add(document, added, error);
    rig_drop(added);
    return good;
}

/// Resamples a tail's angles for `to` joints, times `factor`. A ramp already covers the whole tail.
static void resample(struct angles *angles, int to, double factor)
{
    const struct angles old = *angles;
    if (old.form == ANGLES_EACH) angles->count = to;
    for (int n = 0; n < angles_count(angles); n++) {
        double value = angles_number(&old, old.form == ANGLES_EACH ? 0 : n);
        if (old.form == ANGLES_EACH && to > 1) {
            double at = (double)n * (old.count - 1) / (to - 1);
            int low = (int)at;
            double high = old.value[low + 1 < old.count ? low + 1 : low];
            value = old.value[low] + (high - old.value[low]) * (at - low);
        }
        angles_set_number(angles, n, round(value * factor * ANGLE_RESOLUTION) / ANGLE_RESOLUTION + 0.0);
    }
}

/// The tail keeps its shape and swing: with twice the joints, each bends and lags half as much.
bool edit_joints(struct document *document, int rig, int count, struct error *error)
{
    const struct rig *old = find_rig(document, rig, EDIT_KIND(RIG_TAIL), error);
    if (!old) return false;
    const int from = old->tail.joints;
    if (count < 1 || count > TAIL_MAX_JOINTS) {
        return fail(error, ERROR_INPUT, "%s: joints must be from 1 to %d", old->name, TAIL_MAX_JOINTS);
    }
    if (from == count) return true;
    struct document *before = document_copy(document);
    struct rig *own = document_own_rig(document, rig);
    struct tail *tail = &own->tail;
    const double factor = (double)from / count;
    tail->joints = count;

    // Pins keep their places along the tail; if two meet, the first stays.
    const int pins = own->pin_count;
    own->pin_count = 0;
    for (int i = 0; i < pins; i++) {
        struct pin pin = own->pins[i];
        bool meets = false;
        pin.point = (2 * (pin.point + 1) * count + from) / (2 * from) - 1;
        if (pin.point < 0) pin.point = 0;
        for (int k = 0; k < own->pin_count; k++)
            meets |= own->pins[k].frame == pin.frame && own->pins[k].point == pin.point;
        if (!meets) own->pins[own->pin_count++] = pin;
    }

    resample(&tail->rest, count, factor);
    for (int c = 0; c < tail->channel_count; c++) {
        struct channel *channel = &tail->channels[c];
        const bool bends = axis_bends(channel->axis);
        resample(&channel->gain, count, bends ? factor : 1);
        resample(&channel->lag, count, bends && channel->lag.form == ANGLES_ONE ? factor : 1);
    }
    return end_edit(document, before, true, error);
}
