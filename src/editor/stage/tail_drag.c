/// Pulls a tail or chain: per frame one damped Newton step on the knots' values at the playhead.
///
/// The grabbed point p (pixels) depends on the values v of at most two knots, one per axis. Its derivative J comes from posing again with x
/// changed by δ(1 + j·turn), the effect of changing the knot. Re x follows the knot exactly; Im x follows linearly, so one observed step
/// determines `turn`. Then
///
///     (JᵀJ + λ) dv = Jᵀ (target − p),   in radians of bend, so that both axes count alike.
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/core/pins.h"
#include "editor/core/selection.h"
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include "maths/maths.h"
#include <math.h>

static const double DAMPING = 12; ///< √λ, pixels per radian; channels that move the point less are hardly used
static const double LARGEST_STEP = 0.35, LARGEST_BEND = 7; ///< radians at the grabbed joint, per frame and in total
static const double CLOSE = 0.2;                           ///< pixels; closer is close enough
static const double PROBE = 0.01;                          ///< radians of bend for the derivative
static const double RESOLUTION = 1e-4;                     ///< radians of bend
static const double DEGREE = 0.017453292519943295;

/// The rig's channel for an axis, preferably the active spline's; or NULL.
static const struct channel *channel_for(const struct core *core, const struct rig *rig, enum axis axis)
{
    const struct channel *found = NULL;
    int count;
    const struct channel *channels = rig_channels(rig, &count);
    for (int c = 0; c < count; c++) {
        const struct channel *channel = &channels[c];
        if (channel->axis == axis && (!found || channel->spline == core->active)) found = channel;
    }
    return found;
}

static struct tail_drag_axis axis_for(const struct core *core, const struct rig *rig, const struct pose *strand,
                                      int joint, enum axis axis)
{
    const struct channel *channel = channel_for(core, rig, axis);
    const int joints = strand->count - 1;
    double gain = 0;
    for (int n = 0; channel && n <= joint && n < joints; n++)
        gain += fabs(angles_at(&channel->gain, n, joints)) * DEGREE;
    if (!(gain > 1e-9)) return (struct tail_drag_axis){0};
    return (struct tail_drag_axis){.active = true, .spline = channel->spline, .values_per_radian = 1 / gain};
}

/// The sample on a whole frame nearest to the playhead where all controlled splines may have knots.
static int sample_for(const struct stage *stage, const struct core *core)
{
    const struct document *document = core->document;
    int sample = document_sample(document, round(core_frame(core)));
    for (int a = 0; a < 2; a++) {
        const struct tail_drag_axis *axis = &stage->tail_drag.axis[a];
        if (!axis->active) continue;
        int last = document_last_knot_sample(document, document->splines[axis->spline]);
        sample = sample > last ? last : sample;
    }
    return sample < 0 ? 0 : sample;
}

bool tail_drag_holds(const struct document *document, int rig, int joint)
{
    if (rig >= document->rig_count) return false;
    const struct rig *held = document->rigs[rig];
    return held->kind == RIG_CHAIN || (held->kind == RIG_TAIL && joint <= held->tail.joints);
}

/// Reads the present value and derives `turn` from the last step.
static void observe(struct tail_drag_axis *axis, const struct core *core, int sample)
{
    wiggly_value v = evaluation_at(core->evaluation, axis->spline, sample);
    double value = v.y + v.re;
    double change = value - axis->seen_value;
    if (axis->seen_value != axis->value && fabs(change) > 1e-3 * axis->values_per_radian) {
        axis->turn = fmax(-5, fmin(5, (v.im - axis->seen_im) / change));
    }
    axis->value = axis->seen_value = value;
    axis->seen_im = v.im;
}

/// Derivative of the grabbed point per radian of bend about one axis.
static void derivative(const struct stage *stage, const struct core *core, const struct tail_drag_axis *axis,
                       const float at[2], double response[2])
{
    const struct tail_drag *grab = &stage->tail_drag;
    struct rig_pose posed;
    float moved[2] = {at[0], at[1]};
    double change = PROBE * axis->values_per_radian;
    const struct what_if what_if = {axis->spline, change, change * axis->turn};
    if (strand_pose(stage, core, grab->rig, core->playback.position, &what_if, &posed))
        strand_project(stage, core, &posed.strand, grab->joint, grab->fraction, moved);
    response[0] = (moved[0] - at[0]) / PROBE;
    response[1] = (moved[1] - at[1]) / PROBE;
}

/// Solves (JᵀJ + λ) step = Jᵀ miss for two unknowns; J by column. A zero column leaves its unknown at 0.
static void damped_step(const double column[2][2], const double miss[2], double step[2])
{
    double lambda = DAMPING * DAMPING;
    double a = column[0][0] * column[0][0] + column[0][1] * column[0][1] + lambda;
    double b = column[0][0] * column[1][0] + column[0][1] * column[1][1];
    double d = column[1][0] * column[1][0] + column[1][1] * column[1][1] + lambda;
    double p = column[0][0] * miss[0] + column[0][1] * miss[1];
    double q = column[1][0] * miss[0] + column[1][1] * miss[1];
    double determinant = a * d - b * b; /* at least λ² */
    step[0] = (d * p - b * q) / determinant;
    step[1] = (a * q - b * p) / determinant;
    double size = maths_hypot(step[0], step[1]);
    double factor = size > LARGEST_STEP ? LARGEST_STEP / size : 1;
    step[0] *= factor;
    step[1] *= factor;
}

/// A spline without knots starts from rest, a quarter period before its first knot.
static void begin_from_rest(struct core *core, int spline, int sample)
{
    const struct document *document = core->document;
    const struct spline *of = document->splines[spline];
    const double frame = document_frame(document, sample), first = document->first_frame;
    const double frequency = core_parameter_at(core, of, PARAMETER_FREQUENCY, sample);
    struct knot still = {.stiffness = KNOT_DEFAULT_STIFFNESS, .still = true};
    if (of->knot_count > 0 || !(frequency > 0)) return;
    still.frame = frame - fmax(1, round(document->fps / (4 * frequency)));
    if (still.frame < first)
        still.frame = spline_start(of) == WIGGLY_LOOP ? still.frame + document->last_frame - first : first;
    if (still.frame >= first && still.frame != frame) core_put_knot(core, spline, &still);
}

/// Sets or inserts an axis' knot at the grabbed sample, within its spline's limits. Its phase is free during the pull.
static void set_knot(const struct stage *stage, struct core *core, struct tail_drag_axis *axis,
                     char why[STOPPED_SIZE])
{
    struct knot knot = core_knot_at(core->document, axis->spline, stage->tail_drag.sample);
    knot.value = axis->value;
    knot.has_phase = false;
    core_hold(core->document->splines[axis->spline], &knot, why);
    axis->value = knot.value;
    begin_from_rest(core, axis->spline, stage->tail_drag.sample);
    core_put_knot(core, axis->spline, &knot);
}

/// Activates a spline that bends the strand, unless one is active.
static void activate(const struct tail_drag *grab, struct core *core)
{
    bool steered = false;
    for (int a = 0; a < 2; a++) steered |= grab->axis[a].active && grab->axis[a].spline == core->active;
    if (!steered) core_activate(core, grab->axis[grab->axis[AXIS_SIDE].active ? AXIS_SIDE : AXIS_UP].spline);
}

/// Selects the pulled knot.
static void select_knot(const struct stage *stage, struct core *core)
{
    const struct tail_drag *grab = &stage->tail_drag;
    activate(grab, core);
    const struct spline *spline = core_active_spline(core);
    int at = spline ? spline_find_knot(core->document, spline, grab->sample) : -1;
    if (at < 0) return;
    pins_clear(core);
    selection_clear(&core->selection);
    selection_set(&core->selection, spline->knots[at].id, true);
    core_edited(core, -1);
    for (int a = 0; a < 2; a++) {
        const struct tail_drag_axis *axis = &grab->axis[a];
        if (axis->active && axis->spline != core->active) core_edited(core, axis->spline);
    }
}

/// One step towards the pointer; needs the last solved frame's pose.
static void apply(void *room, struct core *core)
{
    struct stage *stage = room;
    struct tail_drag *grab = &stage->tail_drag;
    const struct drag *drag = &core->drag;
    if (!grab->axis[AXIS_SIDE].active && !grab->axis[AXIS_UP].active) return;
    if (!tail_drag_holds(core->document, grab->rig, grab->joint)) return;
    struct rig_pose posed;
    float at[2];
    if (!strand_pose(stage, core, grab->rig, core->playback.position, NULL, &posed)) return;
    if (!strand_project(stage, core, &posed.strand, grab->joint, grab->fraction, at)) return;
    double miss[2] = {grab->start[0] + drag->moved_x - at[0], grab->start[1] + drag->moved_y - at[1]};
    if (grab->applied && maths_hypot(miss[0], miss[1]) < CLOSE) return;
    double column[2][2] = {{0}}, step[2];
    for (int a = 0; a < 2; a++) {
        if (!grab->axis[a].active) continue;
        observe(&grab->axis[a], core, grab->sample);
        derivative(stage, core, &grab->axis[a], at, column[a]);
    }
    char why[STOPPED_SIZE] = "";
    damped_step(column, miss, step);
    drag_restart(core);
    for (int a = 0; a < 2; a++) {
        struct tail_drag_axis *axis = &grab->axis[a];
        if (!axis->active) continue;
        double most = fmax(LARGEST_BEND * axis->values_per_radian, fabs(axis->value));
        double value = fmax(-most, fmin(most, axis->value + step[a] * axis->values_per_radian));
        axis->value = core_round(value, RESOLUTION * axis->values_per_radian);
        set_knot(stage, core, axis, why);
    }
    drag_say_stopped(core, why);
    grab->applied = true;
    select_knot(stage, core);
}

/// Turns pulled knots into poses with the shown phase, so that nothing moves at the release.
static void end(void *room, struct core *core, bool keep)
{
    const struct tail_drag *grab = &((const struct stage *)room)->tail_drag;
    for (int a = 0; keep && grab->applied && a < 2; a++) {
        const struct tail_drag_axis *axis = &grab->axis[a];
        if (!axis->active || spline_mode(core->document->splines[axis->spline]) != WIGGLY_COMPLEX) continue;
        struct knot knot = core_knot_at(core->document, axis->spline, grab->sample);
        knot.has_phase = true;
        knot.phase = evaluation_at(core->evaluation, axis->spline, grab->sample).im;
        core_put_knot(core, axis->spline, &knot);
    }
    const bool steers = grab->axis[AXIS_SIDE].active || grab->axis[AXIS_UP].active;
    if (keep && steers && !core->drag.moved) activate(grab, core);
    stage_click(room, core, keep);
}

static void show(void *room, struct core *core)
{
    const struct tail_drag *grab = &((const struct stage *)room)->tail_drag;
    float xy[2];
    if (stage_project(room, core, grab->rig, grab->joint, grab->fraction, xy)) stage_ring(core, xy);
}

static const struct drag_owner owner = {
    .cursor = CURSOR_HAND, .goes_on = true, .apply = apply, .end = end, .show = show};

void tail_drag_begin(struct stage *stage, struct core *core, const struct hover *hover, const struct event *event)
{
    const struct rig *rig = core->document->rigs[hover->rig];
    struct tail_drag *grab = &stage->tail_drag;
    struct rig_pose posed;
    drag_begin(core, &owner, stage, rig->kind == RIG_CHAIN ? "Pull chain" : "Pull tail", event);
    *grab = (struct tail_drag){.rig = hover->rig, .joint = hover->joint, .fraction = hover->fraction};
    if (!strand_pose(stage, core, grab->rig, core->playback.position, NULL, &posed)) return;
    grab->axis[AXIS_SIDE] = axis_for(core, rig, &posed.strand, grab->joint, AXIS_SIDE);
    grab->axis[AXIS_UP] = axis_for(core, rig, &posed.strand, grab->joint, AXIS_UP);
    if (grab->axis[AXIS_SIDE].active && grab->axis[AXIS_SIDE].spline == grab->axis[AXIS_UP].spline) {
        grab->axis[AXIS_UP].active = false;
    }
    drag_inertia_stop(stage, core->document, grab->rig);
    grab->sample = sample_for(stage, core);
    core->playback.playing = false;
    core->playback.position = grab->sample;
    grab->start[0] = hover->x;
    grab->start[1] = hover->y;
    if (!strand_pose(stage, core, grab->rig, core->playback.position, NULL, &posed)) return;
    strand_project(stage, core, &posed.strand, grab->joint, grab->fraction, grab->start);
}
