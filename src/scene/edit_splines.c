/// Edits of splines: the list of them, their parameters and their knots.
#include "base/names.h"
#include "base/need.h"
#include "scene/editing.h"
#include "scene/fields.h"
#include "scene/order.h"
#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Whether another spline fits.
static bool fits(const struct document *document, const struct spline *added, struct error *error)
{
    const int limited = spline_is_limited(added) + document_count_limited(document);
    long long total = added->knot_count;
    for (int i = 0; i < document->spline_count; i++) total += document->splines[i]->knot_count;
    if (!document_check_samples(document->spline_count + 1, limited, document_samples(document), error)) return false;
    return total <= SCENE_MAX_KNOTS ||
           fail(error, ERROR_INPUT, "the limit is %d knots over all splines", SCENE_MAX_KNOTS);
}

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

static bool check_name(const struct document *document, const char *name, int own, struct error *error)
{
    int other = document_find_spline(document, name);
    if (!name[0]) return fail(error, ERROR_INPUT, "a spline needs a name");
    if (other < 0 || other == own) return true;
    return fail(error, ERROR_INPUT, "a spline called %s already exists", name);
}

/// The new index of the spline at `index` when the one at `from` moves to `to`.
static int moved_index(int index, int from, int to)
{
    if (index == from) return to;
    if (from < index && index <= to) return index - 1;
    return to <= index && index < from ? index + 1 : index;
}

/// Updates all references to splines. INT_MAX as `from` or `to` means outside the list.
static void move_references(struct document *document, int from, int to)
{
    for (struct reference reference = {0}; reference_next(document, &reference);) {
        const int now = moved_index(reference.spline, from, to);
        if (now != reference.spline) reference_set(document, &reference, now);
    }
}

/// Inserts a spline with new ids.
static bool add(struct document *document, int at, struct spline *spline, struct error *error)
{
    if (!fits(document, spline, error)) {
        spline_drop(spline);
        return false;
    }
    spline->id = document->next_id++;
    for (int k = 0; k < spline->knot_count; k++) spline->knots[k].id = document->next_id++;
    document_insert_spline(document, at, spline);
    move_references(document, INT_MAX, at);
    return true;
}

static bool check_first_knot(const struct document *document, const struct knot *knot, struct error *error)
{
    int sample = document_sample(document, knot->frame);
    if (!isfinite(knot->frame) || !isfinite(knot->value)) {
        return fail(error, ERROR_INPUT, "a knot's numbers must be finite");
    }
    if (sample >= 0 && sample < document_samples(document)) return true;
    return fail(error, ERROR_INPUT, "frame %.10g is outside %d to %d", knot->frame, document->first_frame,
                document->last_frame);
}

bool edit_spline_add(struct document *document, int at, const char *name, const struct knot *first,
                     struct error *error)
{
    const int count = document->spline_count;
    if (name && !check_name(document, name, -1, error)) return false;
    if (first && !check_first_knot(document, first, error)) return false;
    struct spline *spline = spline_create();
    spline->name = free_name(document, name ? name : "spline");
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        spline->parameter[p].value = parameter_rows[p].fresh;
    }
    if (document_loops(document)) spline->parameter[PARAMETER_START].value = WIGGLY_LOOP;
    spline->knots = need(1, sizeof *spline->knots);
    spline->knot_capacity = 1;
    if (first) {
        spline->knot_count = 1;
        spline->knots[0] = (struct knot){
            .frame = first->frame + 0.0, .value = first->value + 0.0, .stiffness = KNOT_DEFAULT_STIFFNESS};
        if (document_sample(document, first->frame) > document_last_knot_sample(document, spline))
            spline->knots[0].frame = document->first_frame; // the last frame of a loop repeats the first
    }
    return add(document, at < 0 || at > count ? count : at, spline, error);
}

bool edit_spline_copy(struct document *document, int spline, struct error *error)
{
    if (!edit_has_spline(document, spline, error)) return false;
    struct spline *copy = spline_clone(document->splines[spline]);
    free(copy->name);
    copy->name = free_name(document, document->splines[spline]->name);
    return add(document, spline + 1, copy, error);
}

bool edit_spline_remove(struct document *document, int spline, struct error *error)
{
    if (!edit_has_spline(document, spline, error)) return false;
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
    if (!edit_has_spline(document, spline, error)) return false;
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
    if (!edit_has_spline(document, spline, error) || !check_name(document, name, spline, error)) return false;
    if (strcmp(document->splines[spline]->name, name) == 0) return true;
    struct spline *own = document_own_spline(document, spline);
    char *copy = need_text(name);
    free(own->name);
    own->name = copy;
    return true;
}

bool edit_spline_color(struct document *document, int spline, int color, struct error *error)
{
    if (!edit_has_spline(document, spline, error)) return false;
    if (color < -1 || color > 0xFFFFFF) return fail(error, ERROR_INPUT, "there is no such colour");
    if (document->splines[spline]->color != color) document_own_spline(document, spline)->color = color;
    return true;
}

static bool same_param(const struct param *a, const struct param *b)
{
    return a->value == b->value && a->track == b->track && motion_equals(a->motion, b->motion);
}

/// Copies the parameters of `wanted` to the spline.
static void set(struct document *document, int index, const struct spline *wanted)
{
    const struct spline *old = document->splines[index];
    bool same = true;
    for (int p = 0; p < PARAMETER_COUNT; p++) same &= same_param(&old->parameter[p], &wanted->parameter[p]);
    if (same) return;
    struct spline *own = document_own_spline(document, index);
    motion_hold(wanted->parameter[PARAMETER_EQUILIBRIUM].motion);
    motion_drop(own->parameter[PARAMETER_EQUILIBRIUM].motion);
    memcpy(own->parameter, wanted->parameter, sizeof own->parameter);
}

static bool check_track(const struct document *document, const struct spline *spline, enum parameter parameter,
                        int track, struct error *error)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    if (row->kind != PARAMETER_TRACK)
        return fail(error, ERROR_INPUT, "%s: %s must be a number", spline->name, row->name);
    return track < document->spline_count ||
           fail(error, ERROR_INPUT, "%s: there is no spline to follow", spline->name);
}

/// A copy of the motion as the document has it; NULL and an error if the spline may not follow it.
static struct joint_motion *new_motion(const struct document *document, const struct spline *spline,
                                       enum parameter parameter, const struct param *param, struct error *error)
{
    struct joint_motion motion = *param->motion;
    struct error why;
    const bool good = parameter == PARAMETER_EQUILIBRIUM
                          ? motion_check(document, &motion, &why)
                          : fail(&why, ERROR_INPUT, "only the equilibrium follows a joint");
    if (good) return motion_create(&motion);
    fail(error, ERROR_INPUT, "%s: %s", spline->name, why.text);
    return NULL;
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

/// Clamps values to the mode's range.
static void clamp_to_mode(struct spline *settings, enum wiggly_mode mode)
{
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++)
        settings->parameter[p].value = fmin(settings->parameter[p].value, parameter_maximum(p, mode));
}

static bool check_loop(const struct document *document, const struct spline *spline, struct error *error)
{
    int last = document_samples(document) - 1;
    if (last == 0) return fail(error, ERROR_INPUT, "%s: a loop needs more than one frame", spline->name);
    if (spline_find_knot(document, spline, last) < 0) return true;
    return fail(error, ERROR_INPUT,
                "%s: delete the knot at the last frame first; in a loop that frame repeats the first", spline->name);
}

static bool set_choice(const struct document *document, struct spline *settings, enum parameter parameter,
                       double value, struct error *error)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    if (!(value >= 0 && value <= row->maximum && value == floor(value)))
        return fail(error, ERROR_INPUT, "there is no such %s", row->name);
    settings->parameter[parameter] = param_number(value);
    if (parameter == PARAMETER_MODE) clamp_to_mode(settings, (enum wiggly_mode)value);
    return parameter != PARAMETER_START || value != WIGGLY_LOOP || check_loop(document, settings, error);
}

static bool set_number(const struct document *document, struct spline *settings, enum parameter parameter,
                       double value, struct error *error)
{
    const bool limits = parameter_rows[parameter].kind == PARAMETER_LIMIT;
    if (!(limits ? check_limit(document, settings, parameter, value, error)
                 : check_constant(settings, parameter, value, error)))
        return false;
    settings->parameter[parameter] = param_number(value + 0.0);
    return true;
}

/// Whether no spline follows itself, also indirectly.
static bool has_order(const struct document *document, int spline, int track, struct error *error)
{
    struct order_cycle cycle;
    return scene_has_order(document, &cycle) ||
           fail(error, ERROR_INPUT, "%s cannot follow %s, which already follows it", document->splines[spline]->name,
                document->splines[track]->name);
}

static bool change(struct document *document, int spline, enum parameter parameter, const struct param *param,
                   struct error *error)
{
    struct spline settings = *document->splines[spline];
    struct joint_motion *motion = NULL;
    if (parameter_rows[parameter].kind == PARAMETER_CHOICE) {
        if (!set_choice(document, &settings, parameter, param->value, error)) return false;
    } else if (param->motion) {
        motion = new_motion(document, &settings, parameter, param, error);
        if (!motion) return false;
        settings.parameter[parameter] = (struct param){.track = -1, .motion = motion};
    } else if (param->track >= 0) {
        if (!check_track(document, &settings, parameter, param->track, error)) return false;
        settings.parameter[parameter] = param_track(param->track);
    } else if (!set_number(document, &settings, parameter, param->value, error)) {
        return false;
    }
    set(document, spline, &settings);
    motion_drop(motion);
    return param->track < 0 || has_order(document, spline, param->track, error);
}

bool edit_parameter(struct document *document, int spline, enum parameter parameter, const struct param *param,
                    struct error *error)
{
    if (!edit_has_spline(document, spline, error)) return false;
    if ((unsigned)parameter >= PARAMETER_COUNT) return fail(error, ERROR_INPUT, "there is no such parameter");
    struct document *before = document_copy(document);
    return edit_end(document, before, change(document, spline, parameter, param, error), error);
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

static bool has_id(const struct document *document, unsigned id)
{
    for (int i = 0; i < document->spline_count; i++) {
        if (spline_find_id(document->splines[i], id) >= 0) return true;
    }
    return false;
}

bool edit_knot_insert(struct document *document, int spline, const struct knot *knot, struct error *error)
{
    struct knot added = *knot;
    long long total = 1;
    if (!edit_has_spline(document, spline, error)) return false;
    const struct spline *old = document->splines[spline];
    if (!check_knot(document, old, &added, 0, error)) return false;
    if (added.id != 0 && has_id(document, added.id)) {
        return fail(error, ERROR_INPUT, "%s: this knot already exists", old->name);
    }
    for (int i = 0; i < document->spline_count; i++) total += document->splines[i]->knot_count;
    if (total > SCENE_MAX_KNOTS) return fail(error, ERROR_INPUT, "the limit of %d knots is reached", SCENE_MAX_KNOTS);
    if (added.id == 0) added.id = document->next_id;
    if (document->next_id <= added.id) document->next_id = added.id + 1;
    struct spline *own = document_own_spline(document, spline);
    if (own->knot_count == own->knot_capacity) {
        own->knot_capacity += own->knot_capacity / 2 + 1;
        own->knots = need_more(own->knots, (size_t)own->knot_capacity, sizeof *own->knots);
    }
    const int at = spline_lower_bound(document, own, document_sample(document, added.frame));
    memmove(&own->knots[at + 1], &own->knots[at], (size_t)(own->knot_count++ - at) * sizeof added);
    own->knots[at] = added;
    return true;
}

/// Index of the knot with that id; -1 and an error if there is none.
static int find(const struct document *document, int spline, unsigned id, struct error *error)
{
    if (!edit_has_spline(document, spline, error)) return -1;
    const int at = spline_find_id(document->splines[spline], id);
    if (at < 0) fail(error, ERROR_INPUT, "%s: this knot no longer exists", document->splines[spline]->name);
    return at;
}

bool edit_knot_remove(struct document *document, int spline, unsigned id, struct error *error)
{
    const int at = find(document, spline, id, error);
    if (at < 0) return false;
    struct spline *own = document_own_spline(document, spline);
    memmove(&own->knots[at], &own->knots[at + 1], (size_t)(--own->knot_count - at) * sizeof *own->knots);
    return true;
}

bool edit_knot_set(struct document *document, int spline, const struct knot *knot, struct error *error)
{
    struct knot changed = *knot;
    const int from = find(document, spline, knot->id, error);
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
    bool done = true;
    for (int k = 0; k < document->splines[spline]->knot_count && done; k++) {
        struct knot knot = document->splines[spline]->knots[k];
        knot.settles = settles && !knot.still;
        done = edit_knot_set(document, spline, &knot, error);
    }
    return done;
}
