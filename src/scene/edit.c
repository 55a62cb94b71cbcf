#include "scene/edit.h"
#include "scene/change.h"
#include "scene/number.h"
#include "scene/order.h"
#include <math.h>
#include <stdlib.h>

enum { FIRST_KNOTS = 16 };

static const double TWO_PI = 6.283185307179586;

static bool add(struct change_list *list, const struct change *change, struct error *error)
{
    if (!change_list_reserve(list, 1)) return fail(error, ERROR_ENVIRONMENT, "not enough memory for this edit");
    list->items[list->count++] = *change;
    return true;
}

/// Room for one knot more, with doubling so that knots may come one by one.
static bool reserve_knot(const struct document *document, struct spline *spline, struct error *error)
{
    long long total = 1;
    for (int i = 0; i < document->spline_count; i++) total += document->splines[i].knot_count;
    if (total > SCENE_MAX_KNOTS)
        return fail(error, ERROR_INPUT, "there are %d knots, and no more fit", SCENE_MAX_KNOTS);
    if (spline->knot_count < spline->knot_capacity) return true;
    int capacity = spline->knot_capacity > 0 ? 2 * spline->knot_capacity : FIRST_KNOTS;
    struct knot *knots = realloc(spline->knots, (size_t)capacity * sizeof *knots);
    if (!knots) return fail(error, ERROR_ENVIRONMENT, "not enough memory for another knot");
    spline->knots = knots;
    spline->knot_capacity = capacity;
    return true;
}

/// Whether a knot may stand where it wants to, `id` being its own.
static bool check_knot(const struct document *document, const struct spline *spline, const struct knot *knot,
                       unsigned id, struct error *error)
{
    char frame[NUMBER_TEXT_SIZE];
    if (!isfinite(knot->frame) || !isfinite(knot->value) || !isfinite(knot->slope) || !isfinite(knot->stiffness)) {
        return fail(error, ERROR_INPUT, "%s: a knot's numbers must be finite", spline->name);
    }
    number_print(knot->frame, frame);
    if (knot->stiffness <= 0) return fail(error, ERROR_INPUT, "%s: stiffness must be above 0", spline->name);
    int sample = document_sample(document, knot->frame), last = document_last_knot_sample(document, spline);
    if (sample < 0 || sample > last) {
        return fail(error, ERROR_INPUT, "%s: frame %s is outside %d to %d%s", spline->name, frame,
                    document->first_frame, document->last_frame,
                    spline->start == WIGGLY_LOOP ? ", whose last is the loop's first again" : "");
    }
    int there = spline_find_knot(document, spline, sample);
    if (there < 0 || spline->knots[there].id == id) return true;
    return fail(error, ERROR_INPUT, "%s: there is a knot at frame %s already", spline->name, frame);
}

/// −0 is saved as 0, and must be 0 before, or saving and loading would be a change.
static struct knot without_negative_zeros(struct knot knot)
{
    knot.frame += 0.0;
    knot.value += 0.0;
    knot.slope += 0.0;
    return knot;
}

static bool has_id(const struct document *document, unsigned id)
{
    for (int i = 0; i < document->spline_count; i++) {
        if (spline_find_id(&document->splines[i], id) >= 0) return true;
    }
    return false;
}

static bool plan_insert(struct document *document, const struct edit *edit, struct change_list *list,
                        struct error *error)
{
    struct spline *spline = &document->splines[edit->spline];
    struct change change = {.kind = CHANGE_KNOT_OUT, .spline = edit->spline};
    change.knot = without_negative_zeros(edit->knot);
    if (!check_knot(document, spline, &change.knot, 0, error)) return false;
    if (change.knot.id != 0 && has_id(document, change.knot.id)) {
        return fail(error, ERROR_INPUT, "%s: the knot is there already", spline->name);
    }
    if (!reserve_knot(document, spline, error)) return false;
    if (change.knot.id == 0) change.knot.id = document->next_id;
    if (!add(list, &change, error)) return false;
    if (document->next_id <= change.knot.id) document->next_id = change.knot.id + 1;
    return true;
}

static bool plan_remove(struct document *document, const struct edit *edit, struct change_list *list,
                        struct error *error)
{
    const struct spline *spline = &document->splines[edit->spline];
    struct change change = {.kind = CHANGE_KNOT_IN, .spline = edit->spline, .knot = edit->knot};
    if (spline_find_id(spline, edit->knot.id) < 0) {
        return fail(error, ERROR_INPUT, "%s: there is no such knot any more", spline->name);
    }
    return add(list, &change, error);
}

static bool same_knot(const struct knot *a, const struct knot *b)
{
    return a->frame == b->frame && a->value == b->value && a->slope == b->slope && a->stiffness == b->stiffness &&
           a->has_slope == b->has_slope;
}

static bool plan_set(struct document *document, const struct edit *edit, struct change_list *list,
                     struct error *error)
{
    const struct spline *spline = &document->splines[edit->spline];
    struct change change = {.kind = CHANGE_KNOT, .spline = edit->spline};
    int at = spline_find_id(spline, edit->knot.id);
    if (at < 0) return fail(error, ERROR_INPUT, "%s: there is no such knot any more", spline->name);
    change.knot = without_negative_zeros(edit->knot);
    change.knot.extra = spline->knots[at].extra;
    if (!check_knot(document, spline, &change.knot, change.knot.id, error)) return false;
    return same_knot(&change.knot, &spline->knots[at]) || add(list, &change, error);
}

static bool same_settings(const struct settings *a, const struct settings *b)
{
    bool same = a->mode == b->mode && a->start == b->start && a->spring_friction == b->spring_friction;
    for (int i = 0; i < PARAMETER_COUNT; i++) {
        same &= a->parameter[i].value == b->parameter[i].value && a->parameter[i].track == b->parameter[i].track;
    }
    return same;
}

static bool add_settings(struct document *document, const struct edit *edit, const struct settings *settings,
                         struct change_list *list, struct error *error)
{
    struct settings old = settings_of(&document->splines[edit->spline]);
    struct change change = {.kind = CHANGE_SETTINGS, .spline = edit->spline, .settings = *settings};
    return same_settings(&old, settings) || add(list, &change, error);
}

/// Whether a spline may follow another in a parameter: tried on the document, and taken back.
static bool check_track(struct document *document, const struct edit *edit, struct error *error)
{
    struct spline *spline = &document->splines[edit->spline];
    struct order_cycle cycle;
    int track = edit->param.track;
    if (edit->parameter == PARAMETER_CALM) return fail(error, ERROR_INPUT, "%s: calm is a number only", spline->name);
    if (track >= document->spline_count) {
        return fail(error, ERROR_INPUT, "%s: there is no spline to follow", spline->name);
    }
    struct param old = spline->parameter[edit->parameter];
    spline->parameter[edit->parameter].track = track;
    bool good = scene_has_order(document, &cycle);
    spline->parameter[edit->parameter] = old;
    if (good) return true;
    if (cycle.spline < 0) return fail(error, ERROR_ENVIRONMENT, "not enough memory for this edit");
    return fail(error, ERROR_INPUT, "%s cannot follow %s, which follows it already", spline->name,
                document->splines[track].name);
}

static bool check_constant(const struct spline *spline, enum parameter parameter, double value, struct error *error)
{
    double low = parameter_minimum(parameter, spline->mode), high = parameter_maximum(parameter, spline->mode);
    const char *name = parameter_name(parameter);
    if (!isfinite(value)) return fail(error, ERROR_INPUT, "%s: %s must be finite", spline->name, name);
    if (value >= low && value <= high) return true;
    if (value < low) return fail(error, ERROR_INPUT, "%s: %s must be at least %g", spline->name, name, low);
    return fail(error, ERROR_INPUT, "%s: %s must be at most %g", spline->name, name, high);
}

static bool is_ratio(enum parameter parameter)
{
    return parameter == PARAMETER_FREQUENCY || parameter == PARAMETER_DAMPING;
}

static bool is_spring(enum parameter parameter)
{
    return parameter == PARAMETER_SPRING || parameter == PARAMETER_FRICTION;
}

static bool plan_parameter(struct document *document, const struct edit *edit, struct change_list *list,
                           struct error *error)
{
    const struct spline *spline = &document->splines[edit->spline];
    struct settings settings = settings_of(spline);
    if ((unsigned)edit->parameter >= PARAMETER_COUNT) return fail(error, ERROR_INPUT, "there is no such parameter");
    if (spline->spring_friction ? is_ratio(edit->parameter) : is_spring(edit->parameter)) {
        return fail(error, ERROR_INPUT, "%s: %s is not in use", spline->name, parameter_name(edit->parameter));
    }
    struct param *param = &settings.parameter[edit->parameter];
    if (edit->param.track >= 0) {
        if (!check_track(document, edit, error)) return false;
        *param = (struct param){0, edit->param.track};
    } else {
        if (!check_constant(spline, edit->parameter, edit->param.value, error)) return false;
        *param = (struct param){edit->param.value + 0.0, -1};
    }
    return add_settings(document, edit, &settings, list, error);
}

/// ω = √k, ζ = γ/2√k, or back: k = ω², γ = 2ζω. What is not in use any more returns to its default.
static bool convert_spring(const struct spline *spline, struct settings *settings, bool to_spring,
                           struct error *error)
{
    enum parameter from[] = {PARAMETER_FREQUENCY, PARAMETER_DAMPING}, to[] = {PARAMETER_SPRING, PARAMETER_FRICTION};
    double number[2], result[2];
    for (int i = 0; i < 2; i++) {
        enum parameter source = to_spring ? from[i] : to[i];
        number[i] = settings->parameter[source].value;
        if (settings->parameter[source].track >= 0) {
            return fail(error, ERROR_INPUT, "%s: %s follows a spline and cannot be converted; make it a number first",
                        spline->name, parameter_name(source));
        }
        settings->parameter[source].value = parameter_default(source);
    }
    double omega = to_spring ? TWO_PI * number[0] : sqrt(number[0]);
    result[0] = to_spring ? omega * omega : omega / TWO_PI;
    result[1] = to_spring ? 2 * number[1] * omega : omega > 0 ? number[1] / (2 * omega) : 0;
    if (!isfinite(result[0]) || !isfinite(result[1])) {
        return fail(error, ERROR_INPUT, "%s: the numbers are too large to be converted", spline->name);
    }
    for (int i = 0; i < 2; i++) settings->parameter[to_spring ? to[i] : from[i]].value = result[i];
    settings->spring_friction = to_spring;
    return true;
}

static bool plan_mode(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    const struct spline *spline = &document->splines[edit->spline];
    struct settings settings = settings_of(spline);
    if ((unsigned)edit->mode > WIGGLY_CUBIC) return fail(error, ERROR_INPUT, "there is no such mode");
    settings.mode = edit->mode;
    bool converts = edit->mode == WIGGLY_COMPLEX && settings.spring_friction;
    if (converts && !convert_spring(spline, &settings, false, error)) return false;
    for (int i = 0; i < PARAMETER_COUNT; i++) {
        double maximum = parameter_maximum((enum parameter)i, edit->mode);
        if (settings.parameter[i].value > maximum) settings.parameter[i].value = maximum;
    }
    return add_settings(document, edit, &settings, list, error);
}

static bool plan_start(struct document *document, const struct edit *edit, struct change_list *list,
                       struct error *error)
{
    const struct spline *spline = &document->splines[edit->spline];
    struct settings settings = settings_of(spline);
    int last = document_samples(document) - 1;
    if ((unsigned)edit->start > WIGGLY_LOOP) return fail(error, ERROR_INPUT, "there is no such start");
    if (edit->start == WIGGLY_LOOP && last == 0) {
        return fail(error, ERROR_INPUT, "%s: a loop needs more than one frame", spline->name);
    }
    if (edit->start == WIGGLY_LOOP && spline_find_knot(document, spline, last) >= 0) {
        return fail(error, ERROR_INPUT,
                    "%s: the knot at the last frame must go first, where a loop is at its first again", spline->name);
    }
    settings.start = edit->start;
    return add_settings(document, edit, &settings, list, error);
}

static bool plan_spring(struct document *document, const struct edit *edit, struct change_list *list,
                        struct error *error)
{
    const struct spline *spline = &document->splines[edit->spline];
    struct settings settings = settings_of(spline);
    if (spline->mode != WIGGLY_REAL) {
        return fail(error, ERROR_INPUT, "%s: spring and friction are for real mode only", spline->name);
    }
    if (edit->flag == settings.spring_friction) return true;
    if (!convert_spring(spline, &settings, edit->flag, error)) return false;
    return add_settings(document, edit, &settings, list, error);
}

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

static bool plan_range(struct document *document, const struct edit *edit, struct change_list *list,
                       struct error *error)
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
    return same || add(list, &change, error);
}

static struct channel *find_channel(struct document *document, const struct edit *edit)
{
    struct tail *tail = &document->tails[edit->tail];
    return edit->channel >= 0 && edit->channel < tail->channel_count ? &tail->channels[edit->channel] : NULL;
}

static struct angles *find_angles(struct document *document, const struct edit *edit)
{
    struct channel *channel = find_channel(document, edit);
    if (edit->angle == ANGLE_REST) return &document->tails[edit->tail].rest;
    if (!channel) return NULL;
    return edit->angle == ANGLE_LAG ? &channel->lag : &channel->gain;
}

static bool plan_angles(struct document *document, const struct edit *edit, struct change_list *list,
                        struct error *error)
{
    struct angles *target = find_angles(document, edit);
    if (!target) return fail(error, ERROR_INPUT, "there is no such channel");
    int count = edit->angles->each ? document->tails[edit->tail].joints : 1;
    for (int i = 0; i < count; i++) {
        if (!isfinite(edit->angles->value[i])) return fail(error, ERROR_INPUT, "angles must be finite");
    }
    if (!change_list_reserve(list, 1 + TAIL_MAX_JOINTS)) {
        return fail(error, ERROR_ENVIRONMENT, "not enough memory for this edit");
    }
    if (target->each != edit->angles->each) {
        list->items[list->count++] = (struct change){
            .kind = CHANGE_EACH, .spline = -1, .each = {.target = &target->each, .each = edit->angles->each}};
    }
    for (int i = 0; i < count; i++) {
        double value = edit->angles->value[i] + 0.0;
        if (target->value[i] == value) continue;
        list->items[list->count++] = (struct change){
            .kind = CHANGE_ANGLE, .spline = -1, .angle = {.target = &target->value[i], .value = value}};
    }
    return true;
}

static bool plan_axis(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    struct channel *channel = find_channel(document, edit);
    if (!channel) return fail(error, ERROR_INPUT, "there is no such channel");
    if ((unsigned)edit->axis > AXIS_UP) return fail(error, ERROR_INPUT, "there is no such axis");
    struct change change = {
        .kind = CHANGE_AXIS, .spline = -1, .axis = {.target = &channel->axis, .axis = edit->axis}};
    return channel->axis == edit->axis || add(list, &change, error);
}

typedef bool planner(struct document *document, const struct edit *edit, struct change_list *list,
                     struct error *error);

bool edit_plan(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    static planner *const planners[] = {
        [EDIT_KNOT_INSERT] = plan_insert,  [EDIT_KNOT_REMOVE] = plan_remove, [EDIT_KNOT_SET] = plan_set,
        [EDIT_PARAMETER] = plan_parameter, [EDIT_MODE] = plan_mode,          [EDIT_START] = plan_start,
        [EDIT_SPRING] = plan_spring,       [EDIT_RANGE] = plan_range,        [EDIT_ANGLES] = plan_angles,
        [EDIT_AXIS] = plan_axis,
    };
    bool on_tail = edit->kind == EDIT_ANGLES || edit->kind == EDIT_AXIS;
    bool on_spline = !on_tail && edit->kind != EDIT_RANGE;
    if (on_spline && (edit->spline < 0 || edit->spline >= document->spline_count)) {
        return fail(error, ERROR_INPUT, "there is no such spline");
    }
    if (on_tail && (edit->tail < 0 || edit->tail >= document->tail_count)) {
        return fail(error, ERROR_INPUT, "there is no such tail");
    }
    return planners[edit->kind](document, edit, list, error);
}
