/// Tails and chains on the stage: posing, projecting their joints, and pulling them.
///
/// A pull is per frame one step of Newton's method on the poses at the playhead.
/// The grabbed point (pixels) depends on x of at most two splines, one for each axis, each with its real and imaginary part. Its derivative J comes
/// from posing again with a changed x. The rule is that of pins (docs/mathematics.md): with the eigenvalues e of JJᵀ and Φ = φ(e/max e)·max e on its
/// eigenvectors,
///
///     x = x₀ + Jᵀ (JJᵀ + Φ)⁻¹ (target − p + J(x − x₀)),   x₀ at the press, in radians of bend, so that both axes count alike.
///
/// So the least change of x that reaches the target is taken, and a direction in which the point hardly moves gives way. On a
/// curved way there the change still stays within twice what the best direction needs.
#include "base/names.h"
#include "editor/core/core.h"
#include "editor/stage/state.h"
#include "maths/maths.h"
#include "maths/symmetric.h"
#include "model/vector.h"
#include "ui/theme.h"
#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BLOBS_OF_ONE_TAIL = 20 }; ///< STAGE_MAX_BLOBS has them for all tails, which are posed first

static const float DUSK = 0.35f; ///< for a fox of bind size

bool strand_pose(const struct stage *stage, int rig, double position, const struct by_hand *change,
                 struct rig_pose *pose)
{
    struct posing posing = stage_posing_by_hand(stage);
    posing.by_hand = change;
    posing.held = rig;
    return tail_drag_holds(stage->core->document, rig, 0) && rig_pose(&posing, rig, position, pose);
}

void stage_pose_tail(struct stage *stage, const struct core *core, int rig)
{
    struct stage_view *view = &stage->view;
    struct posing posing = stage_posing_by_hand(stage);
    struct rig_pose posed, body;
    if (stage->tail_count == STAGE_MAX_TAILS) return;
    posing.memory = POSE_SHOWN;
    const bool has_fox = tail_pose(&posing, rig, core->view.playback.position, &posed, &body);
    struct shadow_blob *blobs = view->blobs + view->blob_count;
    view->blob_count += pose_blobs(&posed.strand, view->key_from, blobs, BLOBS_OF_ONE_TAIL);
    struct stage_model *fox = has_fox ? models_show(view, &body) : NULL;
    if (fox) fox->dusk = DUSK * posed.strand.scale;
    stage->strands[stage->strand_count++] =
        (struct shown_strand){rig, fox ? view->model_count - 1 : -1, posed.strand};
    stage->tail_count++;
}

void stage_pose_chain(struct stage *stage, const struct core *core, int rig)
{
    const struct chain *chain = &core->document->rigs[rig]->chain;
    const int model = rig_body(core->document, rig);
    const struct imported *shown = model >= 0 ? bones_character(core, model) : NULL;
    struct chain_bones bones;
    struct rig_pose posed;
    if (!shown || !chain_find(&shown->gltf, chain->from, chain->to, &bones, NULL)) return;

    // Its bones have the colour of the active spline if that bends them.
    int spline = chain->channel_count > 0 ? chain->channels[0].spline : -1;
    for (int c = 0; c < chain->channel_count; c++) {
        if (chain->channels[c].spline == core->focus.active) spline = core->focus.active;
    }
    for (int b = 0; b < stage->bone_count; b++) {
        struct shown_bone *bone = &stage->bones[b];
        if (bone->model != model || (bone->chain >= 0 && spline != core->focus.active)) continue;
        for (int n = 0; n < bones.count; n++) {
            const struct bone *part = &bone->part;
            const bool is_last = n + 1 == bones.count;
            if (part->from != bones.node[n]) continue;
            if (is_last ? part->node != part->from : part->child != bones.node[n + 1]) continue;
            bone->part.hidden = false;
            bone->chain = rig;
            bone->joint = n;
            bone->color = spline >= 0 ? spline_list_color(core->document, spline) : 0;
        }
    }
    if (stage->strand_count < STAGE_MAX_STRANDS &&
        strand_pose(stage, rig, core->view.playback.position, NULL, &posed))
        stage->strands[stage->strand_count++] = (struct shown_strand){rig, -1, posed.strand};
}

const struct shown_strand *strand_of(const struct stage *stage, int rig)
{
    for (int s = 0; s < stage->strand_count; s++) {
        if (stage->strands[s].rig == rig) return &stage->strands[s];
    }
    return NULL;
}

/// Projects a point of a strand: `fraction` 0 … 1 of the way from joint to joint + 1. False if it is behind the eye.
static bool strand_project(const struct stage *stage, const struct pose *strand, int joint, double fraction,
                           float xy[2])
{
    assert(joint >= 0 && joint < strand->count);
    const int next = joint + 1 < strand->count ? joint + 1 : joint;
    const vec3s from = vec3_from(strand->matrix[joint] + 12), to = vec3_from(strand->matrix[next] + 12);
    const vec3s world = glms_vec3_lerp(from, to, (float)fraction);
    return stage_project_point(stage, world.raw, xy);
}

bool stage_project(const struct stage *stage, int rig, int joint, double fraction, float xy[2])
{
    const struct shown_strand *strand = strand_of(stage, rig);
    return strand && joint < strand->pose.count && strand_project(stage, &strand->pose, joint, fraction, xy);
}

void strand_nearer(const struct stage *stage, int rig, const struct pose *strand, const float p[2], float *nearest,
                   struct hover *hover)
{
    for (int n = 0; n + 1 < strand->count; n++) {
        float a[2], b[2];
        if (!strand_project(stage, strand, n, 0, a) || !strand_project(stage, strand, n, 1, b)) continue;
        float fraction = segment_nearest(a, b, p);
        float at[2] = {a[0] + (b[0] - a[0]) * fraction, a[1] + (b[1] - a[1]) * fraction};
        float distance = maths_hypotf(p[0] - at[0], p[1] - at[1]);
        if (distance >= *nearest) continue;
        *nearest = distance;
        *hover = (struct hover){
            .thing = &thing_tail, .rig = rig, .joint = n, .fraction = fraction, .x = at[0], .y = at[1]};
    }
}

struct hover strand_end(const struct stage *stage, const struct hover *between)
{
    struct hover hover = {.thing = &thing_point, .rig = between->rig};
    const struct shown_strand *strand = strand_of(stage, hover.rig);
    float xy[2];
    hover.joint = (int)round(between->joint + between->fraction) - 1;
    if (hover.joint < 0) hover.joint = 0;
    if (!strand || hover.joint + 1 >= strand->pose.count ||
        !strand_project(stage, &strand->pose, hover.joint + 1, 0, xy))
        return (struct hover){.thing = NULL};
    hover.x = xy[0];
    hover.y = xy[1];
    return hover;
}

// Pulling.

static const double LARGEST_STEP = 0.35; ///< radians at the grabbed joint, per frame
static const double CLOSE = 0.2;         ///< pixels; closer is close enough
static const double PROBE = 0.01;        ///< radians of bend for the derivative
static const double RESOLUTION = 1e-4;   ///< radians of bend
static const double REACH = 0.04;        ///< of the largest eigenvalue: a fifth as far as the best direction
static const double DEAREST = 2;         ///< times the change that the best direction needs, at most
static const double LEAST_LINE = 1.5;    ///< pixels; shorter lines to the pointer are not drawn
static const double DEGREE = 0.017453292519943295;

/// How a pull controls an axis: by the rig's channel for it, preferably the active spline's.
static struct tail_drag_axis axis_for(const struct core *core, int rig, int joint, enum axis axis)
{
    const struct channel *channel = NULL;
    const int joints = bones_joints(core, rig);
    double gain = 0;
    int count;
    const struct channel *channels = rig_channels(core->document->rigs[rig], &count);
    for (int c = 0; c < count; c++) {
        const bool is_better = !channel || channels[c].spline == core->focus.active;
        if (channels[c].axis == axis && is_better) channel = &channels[c];
    }
    for (int n = 0; channel && n <= joint && n < joints; n++)
        gain += fabs(angles_at(&channel->gain, n, joints)) * DEGREE;
    if (!(gain > 1e-9)) return (struct tail_drag_axis){0};
    return (struct tail_drag_axis){.active = true, .spline = channel->spline, .values_per_radian = 1 / gain};
}

bool tail_drag_holds(const struct document *document, int rig, int joint)
{
    if (rig >= document->rig_count) return false;
    const struct rig *held = document->rigs[rig];
    return held->kind == RIG_CHAIN || (held->kind == RIG_TAIL && joint <= held->tail.joints);
}

/// (JJᵀ + Φ)⁻¹ miss; J by columns. Returns JJᵀ's largest eigenvalue, and with it 0 if nothing moves the point.
static double pull_back(const double (*column)[2], int columns, const double miss[2], double pull[2])
{
    double square[4] = {0}, values[2], vectors[4];
    for (int c = 0; c < columns; c++) {
        for (int k = 0; k < 4; k++) square[k] += column[c][k / 2] * column[c][k % 2];
    }
    symmetric_eigen(2, square, values, vectors);
    const double most = fmax(values[0], values[1]);
    pull[0] = pull[1] = 0;
    for (int e = 0; e < 2 && most > 0; e++) { // a direction gives way, unless it moves a fifth as far as the best one
        const double share = fmax(values[e], 0) / most, way[2] = {vectors[2 * e], vectors[2 * e + 1]};
        const double beyond = share > 0 ? fmax(0, REACH / share * (REACH / share) - 1) : INFINITY;
        const double along = (way[0] * miss[0] + way[1] * miss[1]) / (most * (share + beyond * beyond));
        for (int k = 0; k < 2; k++) pull[k] += along * way[k];
    }
    return fmax(most, 0);
}

/// The knot that a pull takes along to its pose: the nearest one within a quarter of a period, and at least a frame; −1: none, or there is one.
static int taken_knot(const struct core *core, int of, int sample)
{
    const struct document *document = core->document;
    const struct spline *spline = document->splines[of];
    const double frequency = core_parameter_at(core, spline, PARAMETER_FREQUENCY, sample);
    const bool swings = spline_mode(spline) != WIGGLY_CUBIC && frequency > 0;
    const double quarter = swings ? 0.25 / (frequency * document_step(document)) : 0;
    const int period = spline_start(spline) == WIGGLY_LOOP ? document_samples(document) - 1 : INT_MAX;
    double nearest = fmax(quarter, document->substeps);
    int taken = -1;
    for (int k = 0; k < spline->knot_count; k++) {
        const int away = abs(document_sample(document, spline->knots[k].frame) - sample);
        const int distance = away < period - away ? away : period - away;
        if (distance == 0) return -1;
        if (distance > nearest) continue;
        nearest = distance;
        taken = k;
    }
    return taken;
}

/// Puts an axis' pose at the grabbed sample, within its spline's limits.
static void set_pose(struct stage *stage, struct core *core, const struct tail_drag_axis *axis, const double to[2],
                     char why[STOPPED_SIZE])
{
    struct tail_drag *grab = &stage->tail_drag;
    const struct spline *spline = core->document->splines[axis->spline];
    const int taken = core->input.mods & MOD_ALT ? -1 : taken_knot(core, axis->spline, grab->sample);
    struct knot knot = core_knot_at(core->document, axis->spline, grab->sample);
    if (taken >= 0) {
        const double frame = knot.frame;
        knot = spline->knots[taken];
        snprintf(grab->hint, sizeof grab->hint, "The knot of %.*s at frame %.6g comes along; with Alt it stays",
                 name_fit(spline->name, 40), spline->name, knot.frame);
        knot.frame = frame;
        knot.still = knot.has_slope = false;
    }
    knot.value = to[0];
    knot.has_phase = axis->swings;
    knot.phase = axis->swings ? to[1] : 0;
    core_hold(spline, &knot, why);

    // A spline without knots starts from rest, a quarter period before its first knot.
    const struct document *document = core->document;
    const double first = document->first_frame;
    const double frequency = core_parameter_at(core, spline, PARAMETER_FREQUENCY, grab->sample);
    if (spline->knot_count == 0 && frequency > 0) {
        struct knot still = {.value = NAN, .stiffness = KNOT_DEFAULT_STIFFNESS, .still = true};
        still.frame = knot.frame - fmax(1, round(document->fps / (4 * frequency)));
        if (still.frame < first)
            still.frame = spline_start(spline) == WIGGLY_LOOP ? still.frame + document->last_frame - first : first;
        if (still.frame >= first && still.frame != knot.frame) core_put_knot(core, axis->spline, &still);
    }
    core_put_knot(core, axis->spline, &knot);
}

/// Activates a spline that bends the strand, unless one is active.
static void activate_bending(const struct tail_drag *grab, struct core *core)
{
    bool steered = false;
    for (int a = 0; a < 2; a++) steered |= grab->axis[a].active && grab->axis[a].spline == core->focus.active;
    if (!steered) core_activate(core, grab->axis[grab->axis[AXIS_SIDE].active ? AXIS_SIDE : AXIS_UP].spline);
}

/// One step towards the pointer; needs the last solved frame's pose.
static void pull_strand(void *room, struct core *core)
{
    struct stage *stage = room;
    struct tail_drag *grab = &stage->tail_drag;
    const struct drag *drag = &core->input.drag;
    if (!grab->axis[AXIS_SIDE].active && !grab->axis[AXIS_UP].active) return;
    if (!tail_drag_holds(core->document, grab->rig, grab->joint)) return;
    struct rig_pose posed;
    float at[2];
    if (!strand_pose(stage, grab->rig, core->view.playback.position, NULL, &posed)) return;
    if (!strand_project(stage, &posed.strand, grab->joint, grab->fraction, at)) return;
    double miss[2] = {grab->start[0] + drag->moved_x - at[0], grab->start[1] + drag->moved_y - at[1]};
    if (grab->applied && maths_hypot(miss[0], miss[1]) < CLOSE) return;
    double column[4][2] = {{0}}; // of each axis by its real and its imaginary part, per radian of bend
    double way[4] = {0}, pull[2];
    int count;
    const struct channel *channels = rig_channels(core->document->rigs[grab->rig], &count);
    for (int a = 0; a < 2; a++) {
        const struct tail_drag_axis *axis = &grab->axis[a];
        if (!axis->active) continue;
        const wiggly_value now = evaluation_at(core->evaluation, axis->spline, grab->sample);
        for (int part = 0; part < (axis->swings ? 2 : 1); part++) { // the derivative
            float moved[2] = {at[0], at[1]};
            const double change = PROBE * axis->values_per_radian;
            struct by_hand hand = {0};
            for (int c = 0; c < count; c++) {
                if (channels[c].spline != axis->spline) continue;
                hand.input[c] = (wiggly_value){.re = part ? 0 : change, .im = part ? change : 0};
            }
            if (strand_pose(stage, grab->rig, core->view.playback.position, &hand, &posed))
                strand_project(stage, &posed.strand, grab->joint, grab->fraction, moved);
            for (int k = 0; k < 2; k++) column[2 * a + part][k] = (double)(moved[k] - at[k]) / PROBE;
        }
        way[2 * a] = (now.y + now.re - axis->start[0]) / axis->values_per_radian;
        way[2 * a + 1] = axis->swings ? (now.im - axis->start[1]) / axis->values_per_radian : 0;
        for (int k = 0; k < 2; k++) miss[k] += column[2 * a][k] * way[2 * a] + column[2 * a + 1][k] * way[2 * a + 1];
    }
    const double best = sqrt(pull_back(column, 4, miss, pull));
    double step[4], whole = 0, size = 0;
    for (int c = 0; c < 4; c++) {
        step[c] = column[c][0] * pull[0] + column[c][1] * pull[1];
        whole = maths_hypot(whole, step[c]);
    }
    const double most = best > 0 ? DEAREST * maths_hypot(drag->moved_x, drag->moved_y) / best : 0;
    for (int c = 0; c < 4; c++) {
        step[c] = step[c] * fmin(1, most / fmax(whole, most)) - way[c];
        size = maths_hypot(size, step[c]);
    }
    char why[STOPPED_SIZE] = "";
    grab->hint[0] = '\0';
    drag_restart(core);
    for (int a = 0; a < 2; a++) {
        const struct tail_drag_axis *axis = &grab->axis[a];
        double to[2];
        for (int part = 0; part < 2; part++) {
            const int c = 2 * a + part;
            const double by = way[c] + step[c] * fmin(1, LARGEST_STEP / fmax(size, LARGEST_STEP));
            to[part] =
                core_round(axis->start[part] + by * axis->values_per_radian, RESOLUTION * axis->values_per_radian);
        }
        if (axis->active) set_pose(stage, core, axis, to, why);
    }
    core->input.drag.hint = grab->hint[0] ? grab->hint : NULL;
    drag_say_stopped(core, why);
    grab->applied = true;

    // Selects the pulled knot.
    activate_bending(grab, core);
    const struct spline *spline = core_active_spline(core);
    const int pulled = spline ? spline_find_knot(core->document, spline, grab->sample) : -1;
    if (pulled < 0) return;
    core->focus.pin = 0;
    selection_clear(&core->focus.selection);
    selection_set(&core->focus.selection, spline->knots[pulled].id, true);
    core_edited(core, -1);
    for (int a = 0; a < 2; a++) {
        const struct tail_drag_axis *axis = &grab->axis[a];
        if (axis->active && axis->spline != core->focus.active) core_edited(core, axis->spline);
    }
}

static void end_pull(void *room, struct core *core, bool keep)
{
    const struct tail_drag *grab = &((const struct stage *)room)->tail_drag;
    const bool steers = grab->axis[AXIS_SIDE].active || grab->axis[AXIS_UP].active;
    if (keep && steers && !core->input.drag.moved) activate_bending(grab, core);
    stage_click(room, core, keep);
}

static void show_pull(void *room, struct core *core)
{
    const struct tail_drag *grab = &((const struct stage *)room)->tail_drag;
    float line[2][2] = {{0}, {core->input.drag.x, core->input.drag.y}};
    if (!stage_project(room, grab->rig, grab->joint, grab->fraction, line[0])) return;
    const double across = grab->start[0] + core->input.drag.moved_x - (double)line[0][0];
    const double down = grab->start[1] + core->input.drag.moved_y - (double)line[0][1];
    if (grab->applied && maths_hypot(across, down) > LEAST_LINE)
        drawlist_line(&core->list, line[0], 2, 1.25f, theme()->playhead);
    stage_ring(core, line[0]);
}

static const struct drag_owner strand_owner = {
    .cursor = CURSOR_HAND, .goes_on = true, .apply = pull_strand, .end = end_pull, .show = show_pull};

static void press_strand(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct stage *stage = room;
    const struct rig *rig = core->document->rigs[hover->rig];
    struct tail_drag *grab = &stage->tail_drag;
    struct rig_pose posed;
    drag_begin(core, &strand_owner, stage, rig->kind == RIG_CHAIN ? "Pull chain" : "Pull tail", event);
    *grab = (struct tail_drag){.rig = hover->rig, .joint = hover->joint, .fraction = hover->fraction};
    grab->axis[AXIS_SIDE] = axis_for(core, grab->rig, grab->joint, AXIS_SIDE);
    grab->axis[AXIS_UP] = axis_for(core, grab->rig, grab->joint, AXIS_UP);
    if (grab->axis[AXIS_SIDE].active && grab->axis[AXIS_SIDE].spline == grab->axis[AXIS_UP].spline)
        grab->axis[AXIS_UP].active = false;
    drag_inertia_stop(stage, core->document, grab->rig);

    // The sample on a whole frame nearest to what is seen at the playhead where all controlled splines may have knots.
    const struct document *document = core->document;
    const double seen = document_sample(document, round(core_frame(core) - rig->offset));
    double last = document_samples(document) - 1;
    bool loops = true;
    for (int a = 0; a < 2; a++) {
        const struct tail_drag_axis *axis = &grab->axis[a];
        if (!axis->active) continue;
        const struct spline *spline = document->splines[axis->spline];
        loops &= spline_start(spline) == WIGGLY_LOOP;
        last = fmin(last, document_last_knot_sample(document, spline));
    }
    const double rounds = loops ? (last + 1) * floor(seen / (last + 1)) : 0;
    grab->sample = (int)fmin(fmax(seen - rounds, 0), last);
    for (int a = 0; a < 2; a++) {
        struct tail_drag_axis *axis = &grab->axis[a];
        const wiggly_value now = evaluation_at(core->evaluation, axis->spline, grab->sample);
        if (axis->active) axis->start[0] = now.y + now.re, axis->start[1] = now.im;
        axis->swings = axis->active && core->view.look != LOOK_CUBIC &&
                       spline_mode(core->document->splines[axis->spline]) == WIGGLY_COMPLEX;
    }
    playback_seek(core, document_frame(document, grab->sample + (int)rounds) + rig->offset);
    grab->start[0] = hover->x;
    grab->start[1] = hover->y;
    if (!strand_pose(stage, grab->rig, core->view.playback.position, NULL, &posed)) return;
    strand_project(stage, &posed.strand, grab->joint, grab->fraction, grab->start);
}

/// A place along it: 0 is the first joint, 1 the tip.
static bool find_along(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const int joints = bones_joints(core, target->rig);
    const double along = fmin(fmax(target->number[0], 0), 1) * joints;
    const int joint = (int)fmin(floor(along), joints - 1);
    return stage_project(room, target->rig, joint, along - joint, xy);
}

/// tail(tail,0.9)
const struct thing thing_tail = {.cursor = CURSOR_HAND,
                                 .hint = "Drag the tail: it is held where you let go. Ctrl+drag or H pins a joint",
                                 .press = press_strand,
                                 .name = "tail",
                                 .of = OF_RIG,
                                 .rig = RIG_TAIL,
                                 .numbers = 1,
                                 .find = find_along,
                                 .missing = "that tail is not to be seen"};

const struct thing thing_chain = {
    .cursor = CURSOR_HAND,
    .hint = "Drag the chain: it is held where you let go. Ctrl+drag or H pins a joint, a click selects the bone",
    .press = press_strand,
    .name = "chain",
    .of = OF_RIG,
    .rig = RIG_CHAIN,
    .numbers = 1,
    .find = find_along,
    .missing = "that chain is not to be seen"};
