/// A body that is moved by hand: the drag over the ground, the follow-through of its tail meanwhile, the recorded path, and the
/// edits that a drag leaves.
///
/// A channel whose spline has its own knots keeps that spline. The swing that the base causes goes into a new channel on a spline with the
/// same poles. By linearity the motion is the same, and every existing key keeps its meaning. A tail without a channel for an axis gets a
/// new one, too.
#include "base/names.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/stage/stage.h"
#include "editor/stage/state.h"
#include "maths/maths.h"
#include "model/figure.h"
#include "model/fox.h"
#include "model/vector.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct drag_owner body_owner; ///< of a body; its functions come last

static bool body_is_held(const struct core *core) { return core->input.drag.owner == &body_owner; }

/// A rig's tail; NULL if it is none or gone.
static struct tail *tail_of(const struct document *document, int rig)
{
    const bool is_tail = rig >= 0 && rig < document->rig_count && document->rigs[rig]->kind == RIG_TAIL;
    return is_tail ? &document->rigs[rig]->tail : NULL;
}

/// How far the current drag has moved a rig, in metres; 0 unless it is on the held body.
static void body_drag_offset(const struct stage *stage, int rig, double offset[3])
{
    const bool held = body_is_held(stage->core) && rig_body(stage->core->document, rig) == stage->body_drag.rig;
    for (int k = 0; k < 3; k++) offset[k] = held ? stage->body_drag.offset[k] : 0;
}

// Follow-through, which is not part of the document's solution but added to it.

/// Index of a rig's swing; id 0 finds a free one; −1: none.
static int find_inertia(const struct stage *stage, unsigned id)
{
    int i = STAGE_MAX_STRANDS;
    while (--i >= 0 && stage->inertia[i].rig != id) continue;
    return i;
}

/// Bases follow body_drag_offset(), their tails and chains swing.
static void drag_inertia_advance(struct stage *stage, const struct core *core, double dt)
{
    const struct document *document = core->document;
    const struct posing posing = stage_posing(core);
    if (!(dt > 0)) return;
    if (core->view.look == LOOK_CUBIC)
        memset(stage->inertia, 0, sizeof stage->inertia); // a cubic has no restoring force
    for (int r = 0; r < document->rig_count && core->view.look != LOOK_CUBIC; r++) {
        const unsigned id = document->rigs[r]->id;
        double offset[3], kick[3];
        bool moves = false;
        if (document->rigs[r]->kind != RIG_TAIL && document->rigs[r]->kind != RIG_CHAIN) continue;
        body_drag_offset(stage, r, offset);
        int at = find_inertia(stage, id);
        if (at < 0 && (offset[0] != 0 || offset[1] != 0 || offset[2] != 0)) at = find_inertia(stage, 0);
        if (at < 0) continue;
        struct drag_inertia *inertia = &stage->inertia[at];
        inertia->rig = id;
        for (int k = 0; k < 3; k++) {
            double velocity = (offset[k] - inertia->offset[k]) / dt;
            kick[k] = velocity - inertia->velocity[k];
            moves |= velocity != 0 || kick[k] != 0 || offset[k] != 0;
            inertia->velocity[k] = velocity;
            inertia->offset[k] = offset[k];
        }
        const bool drives = moves || inertia->swings;
        struct swing_arm arm = {.joints = 0};
        int count = 0;
        const struct channel *channels = rig_channels(document->rigs[r], &count);
        if (!drives || !swing_arm(&posing, r, &arm)) count = 0;
        inertia->swings = moves;

        // The change of the base's velocity drives the channels.
        for (int c = 0; c < count; c++) {
            const struct channel *channel = &channels[c];
            const struct spline *spline = document->splines[channel->spline];
            struct swing_filter filter;
            double direction[3], parameter[PARAMETER_COUNT]; // at the playhead, those that follow splines too
            for (int p = 0; p < PARAMETER_COUNT; p++) {
                const int track = spline->parameter[p].track;
                const wiggly_value now = evaluation_at(core->evaluation, track, core->view.playback.position);
                parameter[p] = track >= 0 ? now.y + now.re : spline->parameter[p].value;
            }
            inertia->scale[c] = 0;
            if (!swing_hangs(channels, count, channel) || !swing_filter(spline, parameter, &filter)) {
                inertia->channel[c] = (struct swing){0};
                continue;
            }
            swing_direction(&arm, channel->axis, direction);
            double along = kick[0] * direction[0] + kick[1] * direction[1] + kick[2] * direction[2];
            swing_step(&inertia->channel[c], &filter, along, dt);
            inertia->scale[c] = swing_scale(&arm, channel, &filter);
            inertia->swings |= !swing_settled(&inertia->channel[c], &filter);
        }
        if (!inertia->swings) *inertia = (struct drag_inertia){0}; // at rest
    }
}

void drag_inertia_stop(struct stage *stage, const struct document *document, int body)
{
    for (int r = 0; r < document->rig_count; r++) {
        const int at = rig_body(document, r) == body ? find_inertia(stage, document->rigs[r]->id) : -1;
        if (at >= 0) stage->inertia[at] = (struct drag_inertia){0};
    }
}

bool stage_is_moving(const struct stage *stage)
{
    for (int i = 0; i < STAGE_MAX_STRANDS; i++) {
        if (stage->inertia[i].swings) return true;
    }
    return false;
}

static void move_by_hand(const void *context, int rig, struct by_hand *hand)
{
    const struct stage *stage = context;
    double offset[3];
    body_drag_offset(stage, rig, offset);
    for (int k = 0; k < 3; k++) hand->base[k] += offset[k];
    const int at = find_inertia(stage, stage->core->document->rigs[rig]->id);
    const struct drag_inertia *inertia = &stage->inertia[at < 0 ? 0 : at];
    for (int c = 0; at >= 0 && inertia->swings && c < SCENE_MAX_CHANNELS; c++) {
        hand->input[c].re += inertia->scale[c] * inertia->channel[c].x[0];
        hand->input[c].im += inertia->scale[c] * inertia->channel[c].x[1];
    }
}

struct posing stage_posing_by_hand(const struct stage *stage)
{
    const struct take *take = &stage->core->take;
    struct posing posing = stage_posing(stage->core);
    if (take_is_posed(stage->core)) {
        posing.document = take->document;
        posing.evaluation = &take->evaluation;
        posing.look = take->look;
    }
    posing.move = move_by_hand;
    posing.context = stage;
    return posing;
}

// Splines that move a body, and channels that let its tail follow through.

enum { NAME_SIZE = 300 };

static const double RECORD_STIFFNESS = 1e5; ///< 1/s; the body stands still at both ends of its path
static const double RESOLUTION = 1e-3;      ///< metres; values are rounded to this
static const double LEAST_SHARE = 0.05;
static const double MAIN_SHARE = 0.5; ///< least component of a coordinate along an axis' bending direction

/// Sets or inserts a knot within its spline's limits (see core_hold()); `level`: with slope 0.
static void base_put_knot(struct core *core, int spline, int sample, double value, bool level, char why[STOPPED_SIZE])
{
    struct knot knot = core_knot_at(core->document, spline, sample);
    knot.value = core_round(value, RESOLUTION);
    core_hold(core->document->splines[spline], &knot, why);
    if (level) {
        knot.has_slope = true;
        knot.slope = 0;
        knot.stiffness = RECORD_STIFFNESS;
    }
    core_put_knot(core, spline, &knot);
}

/// The spline of a coordinate; creates a cubic if it is fixed. -1 on failure.
static int base_spline(const struct stage *stage, struct core *core, int coordinate)
{
    const int rig = stage->body_drag.rig;
    const struct tail *moved = tail_of(core->document, rig);
    char name[NAME_SIZE];
    if (moved->position[coordinate].track >= 0) return moved->position[coordinate].track;
    snprintf(name, sizeof name, "%.*s %s", name_fit(core->document->rigs[rig]->name, 250),
             core->document->rigs[rig]->name, coordinate_name(coordinate));
    if (!edit_spline_add(core->document, -1, name, NULL, &core->step.error)) return -1;
    const int spline = core->document->spline_count - 1;
    core_set_parameter(core, spline, PARAMETER_MODE, WIGGLY_CUBIC);
    if (stage->body_drag.loops) core_set_parameter(core, spline, PARAMETER_START, WIGGLY_LOOP);
    return spline;
}

/// A coordinate at a sample, in metres, as a spline would have it.
static double base_value(const struct core *core, int rig, int coordinate, int sample)
{
    const struct tail *moved = tail_of(core->document, rig);
    const struct param *param = &moved->position[coordinate];
    const wiggly_value value = evaluation_at(core->evaluation, param->track, sample);
    if (param->track >= 0) return value.y + value.re;
    // A fixed height stands for the ground; a height that follows a spline is above 0.
    return coordinate == 1 ? moved->length * (double)(FOX_BASE_HEIGHT / FOX_TAIL_LENGTH) : param->value;
}

static void equilibrium_follow(struct core *core, int spline, int base)
{
    const struct param param = param_track(base);
    edit_parameter(core->document, spline, PARAMETER_EQUILIBRIUM, &param, &core->step.error);
}

/// Adds a displacement channel about the axis and with the angles of a model channel; returns its spline, or -1. The spline has the poles
/// of the model's and no knots, and is driven by the base, from rest or as a loop.
static int add_channel(const struct stage *stage, struct core *core, const struct channel *model, const char *name,
                       double scale, int base)
{
    struct document *document = core->document;
    if (!edit_spline_add(document, -1, name, NULL, &core->step.error)) return -1;
    const int spline = document->spline_count - 1;
    const struct spline *copied = document->splines[model->spline];
    const bool loops = spline_start(copied) == WIGGLY_LOOP;
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        if (p != PARAMETER_EQUILIBRIUM && p != PARAMETER_START)
            edit_parameter(document, spline, p, &copied->parameter[p], &core->step.error);
    }
    core_set_parameter(core, spline, PARAMETER_START, loops ? WIGGLY_LOOP : WIGGLY_REST);
    equilibrium_follow(core, spline, base);

    struct channel channel = {spline, model->axis, PART_DISPLACEMENT, model->lag, model->gain, NULL};
    for (int i = 0; i < angles_count(&channel.gain); i++)
        angles_set_number(&channel.gain, i, round(angles_number(&channel.gain, i) * scale * 1e4) / 1e4);
    const int rig = stage->body_drag.rig;
    if (!edit_channel_add(document, rig, spline, channel.axis, channel.of, &core->step.error)) return -1;
    const struct channel_place added = {rig, document->rigs[rig]->tail.channel_count - 1};
    edit_channel(document, added, &channel, &core->step.error);
    return spline;
}

/// Makes a coordinate, and the channels that swing with it, follow its spline. A tail that bends mainly along the coordinate gets a channel
/// about that axis, if it has none: then `made` receives that channel's new spline.
static void base_follow(const struct stage *stage, struct core *core, int coordinate, int base, int *made)
{
    struct document *document = core->document;
    const int rig = stage->body_drag.rig, count = tail_of(document, rig)->channel_count;
    const struct posing posing = stage_posing(core);
    struct rig moved = *document->rigs[rig];
    struct swing_arm arm = {.joints = 0};
    char name[NAME_SIZE];
    moved.tail.position[coordinate] = param_track(base);
    edit_rig_set(document, rig, &moved, &core->step.error);
    const int swings = find_inertia(stage, document->rigs[rig]->id);
    if (swings < 0) return;
    const double *scale = stage->inertia[swings].scale;
    swing_arm(&posing, rig, &arm);
    for (int c = 0; c < count; c++) {
        const struct channel channel = tail_of(document, rig)->channels[c];
        const struct spline *spline = document->splines[channel.spline];
        double direction[3];
        swing_direction(&arm, channel.axis, direction);
        if (!stage->body_drag.hangs[c] || fabs(direction[coordinate]) <= LEAST_SHARE || scale[c] == 0) continue;
        if (channel.of == PART_TOTAL) {
            snprintf(name, sizeof name, "%.*s follow", name_fit(spline->name, 280), spline->name);
            add_channel(stage, core, &channel, name, scale[c] * direction[coordinate], base);
        } else if (!param_follows(&spline->parameter[PARAMETER_EQUILIBRIUM])) {
            equilibrium_follow(core, channel.spline, base);
        }
    }

    const struct tail *tail = tail_of(document, rig);
    const bool up = fabs(arm.direction[AXIS_UP][coordinate]) > fabs(arm.direction[AXIS_SIDE][coordinate]);
    const enum axis axis = up ? AXIS_UP : AXIS_SIDE;
    const double share = arm.direction[axis][coordinate];
    bool missing = fabs(share) >= MAIN_SHARE;
    for (int c = 0; c < tail->channel_count; c++) missing &= tail->channels[c].axis != axis;
    snprintf(name, sizeof name, "%.*s %s", name_fit(rig_title(document->rigs[rig]), 250),
             rig_title(document->rigs[rig]), axis_word(axis));
    for (int c = 0; missing && c < tail->channel_count; c++) {
        struct channel model = tail->channels[c];
        if (!axis_bends(model.axis) || !stage->body_drag.hangs[c] || scale[c] == 0) continue;
        model.axis = axis;
        *made = add_channel(stage, core, &model, name, scale[c] * share, base);
        return;
    }
}

enum { REPORT_SIZE = 768 }; ///< of the message after a drag

/// Adds to it.
static __attribute__((format(printf, 2, 3))) void say(char report[REPORT_SIZE], const char *format, ...)
{
    const size_t length = strlen(report);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(report + length, REPORT_SIZE - length, format, arguments);
    va_end(arguments);
}

/// Ends the message with what stopped an edit, and a sentence about the new spline (-1: none).
static void say_rest(const struct core *core, const char *why, int spline, char report[REPORT_SIZE])
{
    core_add_stopped(why, report, REPORT_SIZE);
    if (spline < 0) return;
    const struct spline *made = core->document->splines[spline];
    const int base = made->parameter[PARAMETER_EQUILIBRIUM].track;
    say(report, " New spline %s: the tail swings after %s.", made->name,
        base >= 0 ? core->document->splines[base]->name : "it");
}

// A recording: a place per sample, and knots fitted to them.

enum { AXIS_X, AXIS_Y, AXIS_Z };

/// The pointer's movement of the held body in metres, before limits; 0 if none is held.
static void body_drag_way(const struct stage *stage, const struct core *core, double offset[3])
{
    const struct drag *drag = &core->input.drag;
    const struct body_drag *hold = &stage->body_drag;
    offset[0] = offset[1] = offset[2] = 0;
    if (!body_is_held(core) || !drag->moved) return;
    const double *right = hold->right, across = drag->moved_x / hold->pixels_per_metre;
    const double up = -drag->moved_y / hold->pixels_per_metre;
    const double away = hold->lifts ? 0 : up / hold->pitch;
    if (hold->axis == AXIS_X) { // the body stays under the pointer along the axis, as that runs on the screen
        offset[0] = stage_along(right[0], right[1] * hold->pitch, drag) / hold->pixels_per_metre;
    } else if (hold->axis == AXIS_Z) {
        offset[2] = stage_along(right[1], -right[0] * hold->pitch, drag) / hold->pixels_per_metre;
    } else if (hold->axis != AXIS_Y) {
        offset[0] = across * right[0] + away * right[1];
        offset[2] = across * right[1] - away * right[0];
    }
    if (hold->axis == AXIS_Y || (hold->axis < 0 && hold->lifts)) offset[1] = fmax(up / hold->rise, hold->lowest);
}

/// Starts to record at the playhead, and plays. The body must be held.
static void record_begin(struct stage *stage, struct core *core)
{
    struct record *record = &stage->record;
    if (record->running) return;
    *record = (struct record){.running = true, .first = (int)ceil(core->view.playback.position)};
    core->view.playback.playing = true;
    core_message(core, false, "Recording the body: release to keep it.");
}

bool record_has_motion(const struct stage *stage) { return stage->record.count >= 3; }

int record_simplify(const double *values, int count, double tolerance, int *knots, int capacity)
{
    wiggly_solver *solver = NULL;
    double *total = need((size_t)count, sizeof *total);
    wiggly_knot *buffer = need((size_t)capacity, sizeof *buffer);
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = count;
    desc.mode = WIGGLY_CUBIC;
    desc.knots = buffer;
    int made = 2;
    knots[0] = 0;
    knots[1] = count - 1;
    if (wiggly_create(count, capacity, &solver) != WIGGLY_OK) need_failed();
    for (;;) {
        wiggly_curve curve = {.size = sizeof curve, .total = total};
        desc.knot_count = made;
        for (int i = 0; i < made; i++) {
            const bool end = i == 0 || i == made - 1;
            buffer[i] = (wiggly_knot){
                .sample = knots[i], .value = values[knots[i]], .has_slope = end, .stiffness = RECORD_STIFFNESS};
        }
        if (wiggly_solve(solver, &desc, &curve) >= WIGGLY_ERROR_ARGUMENT) break;

        // The sample that is missed most. Not beside the ends: a knot there would change the end's slope.
        double miss = 0;
        int at = 0, to = made;
        for (int i = 2; i < count - 2; i++) {
            const double distance = fabs(values[i] - total[i]);
            if (distance > miss) miss = distance, at = i;
        }
        if (miss <= tolerance || made == capacity) break;
        for (; to > 0 && knots[to - 1] > at; to--) knots[to] = knots[to - 1];
        knots[to] = at;
        made++;
    }
    wiggly_destroy(solver);
    free(buffer);
    free(total);
    return made;
}

enum { MAX_KNOTS = 64 };

static const double STILL = 2e-3;     ///< metres; less is no movement
static const double TOLERANCE = 4e-3; ///< metres between the recorded path and the cubic

/// Keys a coordinate's motion; returns the number of knots. `swings` receives a new spline that swings the tail with it; `why` what limited
/// a knot. Before and after it a newly keyed body stands still, except in a loop, where it moves back by itself.
static int key_way(const struct stage *stage, struct core *core, int coordinate, int *swings, char why[STOPPED_SIZE])
{
    const struct record *record = &stage->record;
    const struct document *document = core->document;
    const int rig = stage->body_drag.rig, last = document_samples(document) - 1;
    const bool is_new = tail_of(document, rig)->position[coordinate].track < 0;
    double way[RECORD_SAMPLES];
    int knots[MAX_KNOTS];
    int spline = base_spline(stage, core, coordinate);
    if (spline < 0) return 0;
    int count = record->count, end = document_last_knot_sample(document, document->splines[spline]);
    if (record->first + count - 1 > end) count = end - record->first + 1;
    for (int i = 0; i < count; i++)
        way[i] = base_value(core, rig, coordinate, record->first + i) + record->way[coordinate][i];
    int made = count >= 2 ? record_simplify(way, count, TOLERANCE, knots, MAX_KNOTS) : 0;
    if (made == 0) return 0;
    for (bool clears = !is_new; clears;) { // the knots that were there
        const struct spline *cleared = document->splines[spline];
        const int at = spline_lower_bound(document, cleared, record->first);
        clears = at < cleared->knot_count &&
                 document_sample(document, cleared->knots[at].frame) <= record->first + count - 1 &&
                 edit_knot_remove(core->document, spline, cleared->knots[at].id, &core->step.error);
    }
    for (int i = 0; i < made; i++)
        base_put_knot(core, spline, record->first + knots[i], way[knots[i]], i == 0 || i == made - 1, why);
    if (is_new && !stage->body_drag.loops) {
        if (record->first > 1) base_put_knot(core, spline, 0, way[0], true, why);
        if (record->first + count < last) base_put_knot(core, spline, last, way[count - 1], true, why);
    }
    base_follow(stage, core, coordinate, spline, swings);
    core_edited(core, spline);
    return made;
}

enum { MARGIN = 12, HEIGHT = 22, PAD = 8, DOT = 10, MAX_POINTS = 256 };

/// In the top right corner, below the caption.
static void show_sign(struct core *core, bool runs, const char *text)
{
    const struct rect stage = core->view.layout.stage;
    const float width = ceilf(font_width(FONT_LABEL_BOLD, THEME_TEXT_NORMAL, text)) + DOT + 3 * PAD;
    const struct rect sign = {stage.x + stage.w - MARGIN - width,
                              stage.y + fmaxf(MARGIN, caption_height(stage, core->document)), width, HEIGHT};
    const struct rect dot = {sign.x + PAD, sign.y + (HEIGHT - DOT) / 2.0f, DOT, DOT};
    drawlist_rounded(&core->list, sign, HEIGHT / 2.0f, theme()->panel);
    if (runs) drawlist_rounded(&core->list, dot, DOT / 2.0f, theme()->error);
    if (!runs) drawlist_rounded_line(&core->list, dot, DOT / 2.0f, 1.5f, theme()->error);
    drawlist_text(&core->list, dot.x + DOT + PAD, sign.y + HEIGHT - 7, FONT_LABEL_BOLD, THEME_TEXT_NORMAL,
                  theme()->error, text);
}

// The drag.

/// The playhead's sample, clamped to where the spline may have knots.
static int sample_of(const struct core *core, int spline)
{
    const struct document *document = core->document;
    const int sample = document_sample(document, round(core_frame(core)));
    const int last = document_last_knot_sample(document, document->splines[spline]);
    return sample > last ? last : sample < 0 ? 0 : sample;
}

/// How far all knots of a spline can move within its limits, and the knot that stops them, or NULL.
static double room_for(const struct spline *spline, double by, const struct knot **stops)
{
    double room = by;
    *stops = NULL;
    for (int i = 0; i < spline->knot_count; i++) {
        const double value = spline->knots[i].value, within = spline_within(spline, value + by);
        if (spline->knots[i].still || within == value + by || fabs(within - value) >= fabs(room)) continue;
        room = within - value;
        *stops = &spline->knots[i];
    }
    return room;
}

/// Shifts a coordinate; returns the shift. A fixed height stands for the ground, which stays. All knots of a spline shift equally, as far as
/// all can move, so that followers keep their motion.
static double shift_coordinate(struct core *core, int rig, int coordinate, double way, char why[STOPPED_SIZE])
{
    const struct tail *tail = tail_of(core->document, rig);
    const int spline = tail ? tail->position[coordinate].track : -1;
    if (spline < 0 && coordinate == 1) return 0;
    if (spline < 0) {
        struct rig moved = *core->document->rigs[rig];
        const double from = tail ? tail->position[coordinate].value : moved.model.position[coordinate];
        const double to = core_round(from + way, RESOLUTION);
        if (tail) moved.tail.position[coordinate] = param_number(to);
        if (!tail) moved.model.position[coordinate] = to;
        return edit_rig_set(core->document, rig, &moved, &core->step.error) || tail ? way : 0;
    }
    const int count = core->document->splines[spline]->knot_count;
    const struct knot *stops;
    const double by = room_for(core->document->splines[spline], way, &stops);
    bool any_still = false;
    if (stops) {
        struct knot moved = *stops;
        moved.value += way;
        core_hold(core->document->splines[spline], &moved, why);
    }
    if (by == 0) return 0;
    for (int i = 0; i < count; i++) {
        struct knot knot = core->document->splines[spline]->knots[i];
        knot.value = core_round(knot.value + by, RESOLUTION);
        if (!knot.still) knot.value = spline_within(core->document->splines[spline], knot.value);
        any_still |= knot.still;
        core_put_knot(core, spline, &knot);
    }
    // The equilibrium of still knots moves with the other knots, unless it moves by itself.
    const struct param *equilibrium = &core->document->splines[spline]->parameter[PARAMETER_EQUILIBRIUM];
    if (any_still && equilibrium->track < 0 && !equilibrium->motion)
        core_set_parameter(core, spline, PARAMETER_EQUILIBRIUM, core_round(equilibrium->value + by, RESOLUTION));
    core_edited(core, spline);
    return by;
}

/// Leaves the body where the pointer has moved it: knots at the playhead with auto-key, else the whole motion. Reports which.
static void place_body(struct stage *stage, struct core *core)
{
    const int rig = stage->body_drag.rig;
    double offset[3];
    body_drag_way(stage, core, offset);
    const bool is_tail = tail_of(core->document, rig), keys = core->view.on[SWITCH_AUTO_KEY] && is_tail;
    char report[REPORT_SIZE] = "", why[STOPPED_SIZE] = "";
    bool any = false;
    int swings = -1;
    say(report, keys ? "Keyed " : "Moved for the whole shot: ");
    for (int k = 0; k < 3; k++) {
        if (offset[k] == 0) continue;
        if (keys) {
            // A fixed coordinate gets a spline that starts at the body's place.
            const bool is_new = tail_of(core->document, rig)->position[k].track < 0;
            const int spline = base_spline(stage, core, k);
            if (spline < 0) continue;
            const int sample = sample_of(core, spline);
            const double before = base_value(core, rig, k, sample);
            if (is_new && sample > 1) base_put_knot(core, spline, 0, before, true, why);
            base_put_knot(core, spline, sample, before + offset[k], is_new, why);
            if (is_new) base_follow(stage, core, k, spline, &swings);
            core_edited(core, spline);
            if (tail_of(core->document, rig)->position[k].track < 0) continue;
            say(report, "%s%s", any ? ", " : "", core->document->splines[spline]->name);
        } else {
            const double by = shift_coordinate(core, rig, k, offset[k], why);
            if (by == 0) continue;
            say(report, "%s%s %+.2f m", any ? ", " : "", coordinate_name(k), by);
        }
        any = true;
    }
    if (keys) {
        say(report, " at frame %.0f.", round(core_frame(core)));
    } else if (any) {
        say(report, is_tail && !why[0] ? ". Auto-key (Shift+A) sets knots instead." : ".");
    } else if (why[0]) {
        core_stopped(core, why);
    } else {
        core_message(core, false, "Back on the ground. Turn on auto-key (Shift+A) or record (R) to keep the height.");
    }
    say_rest(core, why, swings, report);
    if (any) core_message(core, false, "%s", report);
    for (int i = 0; i < STAGE_MAX_STRANDS; i++) // the document now contains the offset: no new movement of the base
        memset(stage->inertia[i].offset, 0, sizeof stage->inertia[i].offset);
}

void stage_advance(struct stage *stage, struct core *core, double dt)
{
    double *offset = stage->body_drag.offset, way[3];
    const struct document *document = core->document;
    body_drag_way(stage, core, way);
    memcpy(offset, way, sizeof way);

    // As the splines' limits will limit it in place_body() or a recording.
    const struct tail *tail = tail_of(document, stage->body_drag.rig);
    const bool keys = core->view.on[SWITCH_AUTO_KEY] || stage->record.running || record_has_motion(stage);
    if (!tail) offset[1] = 0; // a character stays on its ground
    for (int k = 0; tail && k < 3; k++) {
        const int track = tail->position[k].track;
        if (offset[k] == 0 || track < 0) continue;
        const struct spline *spline = document->splines[track];
        if (keys) {
            const double before = base_value(core, stage->body_drag.rig, k, sample_of(core, track));
            offset[k] = spline_within(spline, before + offset[k]) - before;
        } else {
            const struct knot *stops;
            offset[k] = room_for(spline, offset[k], &stops);
        }
    }
    drag_inertia_advance(stage, core, dt);

    // Records the body's place up to the playhead, until the end of the played range.
    struct record *record = &stage->record;
    if (!record->running || !body_is_held(core)) return;
    const double position = core->view.playback.position;
    int next = record->first + record->count;
    record->running = position >= next - 1 && core->view.playback.playing && record->count < RECORD_SAMPLES &&
                      next < document_samples(document);
    if (!record->running) return;
    const double from = record->seen_position, span = position - from;
    for (; next <= position && record->count < RECORD_SAMPLES; next++) {
        double share = span > 0 && record->count > 0 ? fmax(0, (next - from) / span) : 1;
        for (int k = 0; k < 3; k++)
            record->way[k][record->count] = record->seen[k] + share * (way[k] - record->seen[k]);
        record->count++;
    }
    record->seen_position = position;
    memcpy(record->seen, way, sizeof way);
}

enum { RING_POINTS = 64 };

static const double LEAST_PITCH = 0.35; ///< sine of the camera's elevation; below it depth follows the pointer less
static const double LEAST_RISE = 0.3;   ///< cosine of the elevation; below it height follows the pointer less
static const float ring_middle[2] = {0, -0.25f}; ///< x and z in bind space, metres
static const float RING_RADIUS = 0.6f;

/// Where a body stands.
struct stand {
    float base[3], middle[2]; ///< the grabbed point; x and z
    float ground, radius;     ///< of a ring around it
};

/// False if there is no such body or it is not shown.
static bool find_stand(const struct stage *stage, int rig, struct stand *stand)
{
    const struct posing posing = stage_posing_by_hand(stage);
    struct rig_pose pose;
    float lo[3], hi[3];
    if (!rig_pose(&posing, rig, stage->core->view.playback.position, &pose)) return false;
    if (pose.kind == RIG_TAIL) {
        const float *base = pose.strand.matrix[0] + 12, scale = pose.strand.scale;
        *stand = (struct stand){{base[0], base[1], base[2]},
                                {base[0] + scale * ring_middle[0], base[2] + scale * ring_middle[1]},
                                pose.strand.ground,
                                scale * RING_RADIUS};
        return true;
    }
    if (pose.kind != RIG_MODEL) return false;
    rig_bounds(&pose, lo, hi);
    const float *at = pose.model.root + 12, middle[2] = {0.5f * (lo[0] + hi[0]), 0.5f * (lo[2] + hi[2])};
    *stand = (struct stand){{at[0], 0.5f * (lo[1] + hi[1]), at[2]},
                            {middle[0], middle[1]},
                            pose.model.ground,
                            0.5f * maths_hypotf(hi[0] - lo[0], hi[2] - lo[2])};
    return true;
}

/// Distance along a ray to a fox's body, or INFINITY.
static float body_distance(struct stage *stage, const struct rig_pose *fox, const float direction[3])
{
    const struct gltf *gltf = fox->model.gltf;
    const float *root = fox->model.root;
    const int node = gltf->node_count - 1, count = gltf_vertex_count(gltf, node);
    float(*place)[3] = stage->skin.posed, nearest = INFINITY;
    if (count > stage->skin.capacity) return INFINITY;
    stage->skin.hash = 0;
    gltf_pose_vertices(gltf, fox->model.pose, node, place, NULL);
    for (int v = 0; v < count; v++)
        for (int k = 0; k < 3; k++) place[v][k] = root[0] * place[v][k] + root[12 + k];
    for (int p = 0; p < gltf->meshes->part_count; p++) {
        const struct gltf_part *part = &gltf->meshes->parts[p];
        for (int i = 0; i < part->index_count; i += 3) {
            const uint32_t *own = part->indices + i;
            const float *const corner[3] = {place[own[0]], place[own[1]], place[own[2]]};
            float uv[2];
            if (part->fur[own[0]][0] >= 1.0f) continue; // belongs to the tail
            const float distance = pick_triangle(corner, stage->view.eye, direction, uv);
            if (distance > 0.0f) nearest = fminf(nearest, distance);
        }
        place += part->vertex_count;
    }
    return nearest;
}

struct hover body_hover(struct stage *stage, double position, float x, float y)
{
    const struct stage_view *view = &stage->view;
    const struct posing posing = stage_posing_by_hand(stage);
    struct hover hover = {.thing = NULL};
    float direction[3], nearest = INFINITY;
    stage_ray(stage, x, y, direction);
    for (int t = 0; t < stage->tail_count; t++) {
        const int rig = stage->strands[t].rig;
        struct rig_pose pose;
        if (!tail_of(stage->core->document, rig) || !rig_pose(&posing, rig, position, &pose)) continue;

        // Where the ray enters and leaves the bounding box.
        const float *base = pose.strand.matrix[0] + 12, scale = pose.strand.scale;
        float enter = 0, leave = INFINITY, lo[3], hi[3];
        limbs_bounds(&pose.strand.limbs, lo, hi);
        for (int k = 0; k < 3; k++) {
            const float from = view->eye[k] - base[k];
            const float a = (scale * lo[k] - from) / direction[k], b = (scale * hi[k] - from) / direction[k];
            enter = fmaxf(enter, fminf(a, b));
            leave = fminf(leave, fmaxf(a, b));
        }
        if (!(enter < leave) || !rig_pose_body(&posing, rig, position, &pose)) continue;
        const float distance = body_distance(stage, &pose, direction);
        if (distance >= nearest) continue;
        nearest = distance;
        hover = (struct hover){.thing = &thing_body, .rig = rig, .x = x, .y = y};
    }
    return hover;
}

/// A point where body_hover() finds the body; the likeliest are tried first.
static bool find_body(void *room, const struct core *core, const struct target *target, float xy[2])
{
    static const float places[][3] = {
        {0, 0.18f, -0.45f}, {0, 0.54f, -0.385f}, {0, 0.05f, -0.25f}, {0, 0, -0.5f}}; // chest, head, rump, paws
    const struct stage *stage = room;
    const struct shown_strand *tail = strand_of(stage, target->rig);
    if (!tail || tail->model < 0) return false;
    const struct stage_model *fox = &stage->view.models[tail->model];
    for (int point = 0; point < 4; point++) {
        const mat4s moved = mat4_from(fox->posed.pose->joints[point == 1 ? LIMB_HEAD : LIMB_BODY]);
        const vec3s at = glms_mat4_mulv3(moved, vec3_from(places[point]), 1.0f);
        const vec3s place = glms_mat4_mulv3(mat4_from(fox->posed.root), at, 1.0f);
        if (!stage_project_point(stage, place.raw, xy)) continue;
        const struct hover hover = stage_hover(room, core, xy[0], xy[1]);
        if (hover.thing == &thing_body && hover.rig == target->rig) return true;
    }
    return false;
}

/// A ring on the ground around a body.
static void show_ring(const struct stage *stage, struct core *core, int rig)
{
    const uint32_t color = body_is_held(core) ? theme()->accent : theme()->playhead;
    struct stand stand;
    if (!find_stand(stage, rig, &stand)) return;
    float point[RING_POINTS + 1][2];
    for (int i = 0; i <= RING_POINTS; i++) { // from the right of the screen over the near half
        float angle = 6.2831853f * (float)i / RING_POINTS - core->view.camera.azimuth;
        const float place[3] = {stand.middle[0] - stand.radius * maths_sinf(-angle), stand.ground,
                                stand.middle[1] - stand.radius * maths_cosf(-angle)};
        if (!stage_project_point(stage, place, point[i])) return;
    }
    const int half = RING_POINTS / 2;
    drawlist_line(&core->list, point[0], half + 1, 1.5f, color);
    drawlist_line(&core->list, point[half], half + 1, 1.5f, theme_fade(color, 0.3f));
}

void body_show(struct stage *stage, struct core *core)
{
    const struct document *document = core->document;
    const struct record *record = &stage->record;
    const bool is_held = body_is_held(core);
    const int rig = is_held ? stage->body_drag.rig : core->input.hover.rig;
    const bool is_meant = is_held || core->input.hover.thing == &thing_body;
    const struct tail *shown = is_meant ? tail_of(document, rig) : NULL;
    bool moves = false;
    if (is_meant) show_ring(stage, core, rig);
    for (int k = 0; shown && k < 3; k++) moves |= shown->position[k].track >= 0;
    if (moves && !core->view.on[SWITCH_TRAIL])
        path_show(stage, core, TRAIL_OF_BODY, (struct rig_point){rig, POINT_BASE});
    if (!is_held || !record->running) {
        if (core->view.on[SWITCH_RECORD] && document_tail(document, 0))
            show_sign(core, false, "Drag the body to record it");
        return;
    }

    // The recorded path, with the base's place at each sample.
    const int step = record->count / MAX_POINTS + 1;
    float points[MAX_POINTS][2];
    int count = 0;
    bool seen = true;
    for (int i = 0; i < record->count && seen; i += step) {
        float place[3];
        for (int k = 0; k < 3; k++) {
            const struct param *param = &tail_of(document, rig)->position[k];
            const double value = param->track >= 0 ? base_value(core, rig, k, record->first + i) : param->value;
            place[k] = (float)(value + record->way[k][i]);
        }
        seen = stage_project_point(stage, place, points[count++]);
    }
    if (seen && count > 1) drawlist_line(&core->list, (const float *)points, count, 2, theme()->error);
    char text[32];
    snprintf(text, sizeof text, "REC %.1f s", record->count / (document->fps * document->substeps));
    show_sign(core, true, text);
}

/// The first movement starts an armed recording.
static void body_moves(void *room, struct core *core)
{
    struct stage *stage = room;
    if (stage->body_drag.begun) return;
    stage->body_drag.begun = true;
    if (core->view.on[SWITCH_RECORD] && tail_of(core->document, stage->body_drag.rig)) record_begin(stage, core);
}

static enum drag_answer body_event(void *room, struct core *core, const struct event *event)
{
    // Ctrl may still be held from lifting the body.
    const bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & MOD_ALT);
    if (!key) return DRAG_PASSES;
    struct stage *stage = room;
    if (event->key != 'R')
        return drag_lock_axis(&core->input.drag, &stage->body_drag.axis, event->key) ? DRAG_USED : DRAG_PASSES;
    if (!tail_of(core->document, stage->body_drag.rig)) {
        core_message(core, false, "A character stays in one place for the whole shot. Its clip moves it.");
        return DRAG_USED;
    }
    drag_start_moving(core);
    body_moves(room, core);
    record_begin(room, core);
    return DRAG_USED;
}

/// Edits the document in the open step: the recorded motion or the new place.
static void end_body(void *room, struct core *core, bool keep)
{
    struct stage *stage = room;
    struct record *record = &stage->record;
    const int body = stage->body_drag.rig;
    const bool moved = core->input.drag.moved;
    const bool edits = moved && keep && body < core->document->rig_count; // an edit may have removed the body
    const bool records = edits && record_has_motion(stage) && tail_of(core->document, body);
    if (records) { // splines for coordinates that moved, and channels that follow them
        char report[REPORT_SIZE] = "", why[STOPPED_SIZE] = "";
        int made = 0, swings = -1;
        for (int k = 0; k < 3; k++) {
            double most = 0;
            for (int i = 0; i < record->count; i++) most = fmax(most, fabs(record->way[k][i]));
            if (most >= STILL) made += key_way(stage, core, k, &swings, why);
        }
        say(report, made == 0 ? "Nothing moved, so nothing was recorded." : "%d knots recorded.", made);
        say_rest(core, why, swings, report);
        core_message(core, false, "%s", report);
    } else if (edits) {
        place_body(stage, core);
    }
    if (moved && (!edits || records)) drag_inertia_stop(stage, core->document, body);
    if (moved) *record = (struct record){0};
    stage_click(room, core, keep);
}

static const struct drag_owner body_owner = {
    .cursor = CURSOR_MOVE, .move = body_moves, .event = body_event, .end = end_body};

void press_body(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct stage *stage = room;
    const int rig = hover->thing == &thing_bone ? hover->model : hover->rig;
    struct body_drag *hold = &stage->body_drag;
    const struct camera *camera = &core->view.camera;
    struct stand stand = {.radius = 0};
    drag_begin(core, &body_owner, stage, "Move body", event);
    *hold = (struct body_drag){.rig = rig, .axis = -1};
    find_stand(stage, rig, &stand);
    hold->pixels_per_metre = stage_pixels_per_metre(stage, stand.base);
    double pitch = maths_sin((double)camera->elevation);
    hold->pitch = copysign(fmax(fabs(pitch), LEAST_PITCH), pitch);
    hold->rise = fmax(maths_cos((double)camera->elevation), LEAST_RISE);
    hold->right[0] = -maths_sin((double)camera->azimuth);
    hold->right[1] = -maths_cos((double)camera->azimuth);
    const struct tail *tail = tail_of(core->document, rig);
    if (!tail) return; // a character stays on its ground
    hold->lifts = event->mods & MOD_CTRL;
    const float sitting = stand.ground + FOX_BASE_HEIGHT * (float)tail->length / FOX_TAIL_LENGTH;
    hold->lowest = fmin(0, (double)(sitting - stand.base[1]));
    hold->loops = tail->channel_count > 0;
    for (int c = 0; c < tail->channel_count; c++) {
        hold->hangs[c] = swing_hangs(tail->channels, tail->channel_count, &tail->channels[c]);
        hold->loops &= spline_start(core->document->splines[tail->channels[c].spline]) == WIGGLY_LOOP;
    }
}

const struct thing thing_body = {
    .cursor = CURSOR_MOVE,
    .hint = "Drag the body: the tail follows through (Ctrl lifts it, X, Y or Z locks an axis, R records)",
    .press = press_body,
    .name = "body",
    .of = OF_RIG,
    .rig = RIG_TAIL,
    .find = find_body,
    .missing = "no body of that tail is to be seen"};
