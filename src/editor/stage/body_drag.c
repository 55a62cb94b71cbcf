/// Drags a body over the ground and turns the drag into edits.
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include "maths/maths.h"
#include "model/figure.h"
#include "model/fox.h"
#include "model/vector.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

enum { AXIS_X, AXIS_Y, AXIS_Z };

/// Movement along one ground axis that keeps the body under the pointer, from the axis' direction on the screen.
static double along_axis(const struct body_drag *hold, const double axis[2], double dx, double dy)
{
    double across = axis[0] * hold->right[0] + axis[1] * hold->right[1];
    double away = (axis[0] * hold->right[1] - axis[1] * hold->right[0]) * hold->pitch;
    return stage_along(across, away, dx, dy) / hold->pixels_per_metre;
}

void body_drag_way(const struct stage *stage, const struct core *core, double offset[3])
{
    const struct drag *drag = &core->drag;
    const struct body_drag *hold = &stage->body_drag;
    offset[0] = offset[1] = offset[2] = 0;
    if (!body_is_held(core) || !drag->moved) return;
    const double x_axis[2] = {1, 0}, z_axis[2] = {0, 1};
    const double across = drag->moved_x / hold->pixels_per_metre;
    const double up = -drag->moved_y / hold->pixels_per_metre;
    const double away = hold->lifts ? 0 : up / hold->pitch;
    if (hold->axis == AXIS_X) {
        offset[0] = along_axis(hold, x_axis, drag->moved_x, drag->moved_y);
    } else if (hold->axis == AXIS_Z) {
        offset[2] = along_axis(hold, z_axis, drag->moved_x, drag->moved_y);
    } else if (hold->axis != AXIS_Y) {
        offset[0] = across * hold->right[0] + away * hold->right[1];
        offset[2] = across * hold->right[1] - away * hold->right[0];
    }
    if (hold->axis == AXIS_Y || (hold->axis < 0 && hold->lifts)) offset[1] = fmax(up / hold->rise, hold->lowest);
}

static const double RESOLUTION = 1e-3; ///< metres; values are rounded to this

/// The message after a drag, and why a knot stopped.
struct report {
    char text[512], why[STOPPED_SIZE];
    size_t length;
};

static void say(struct report *report, const char *text)
{
    report->length +=
        (size_t)snprintf(report->text + report->length, sizeof report->text - report->length, "%s", text);
    if (report->length >= sizeof report->text) report->length = sizeof report->text - 1;
}

/// Adds a name, with a comma before all but the first.
static void say_name(struct report *report, bool is_first, const char *name)
{
    if (!is_first) say(report, ", ");
    say(report, name);
}

/// The playhead's sample, clamped to where the spline may have knots.
static int sample_of(const struct core *core, int spline)
{
    const struct document *document = core->document;
    const int sample = document_sample(document, round(core_frame(core)));
    const int last = document_last_knot_sample(document, document->splines[spline]);
    return sample > last ? last : sample < 0 ? 0 : sample;
}

/// Sets a knot at the playhead. A fixed coordinate gets a spline that starts at the body's place. Returns the new spline that swings the
/// tail with it, or -1.
static int key_coordinate(const struct stage *stage, struct core *core, int coordinate, double by,
                          char why[STOPPED_SIZE])
{
    const struct document *document = core->document;
    const int rig = stage->body_drag.rig;
    const bool is_new = tail_of(document, rig)->position[coordinate].track < 0;
    const int spline = base_spline(stage, core, coordinate);
    if (spline < 0) return -1;
    const int sample = sample_of(core, spline);
    const double before = base_value(core, rig, coordinate, sample);
    if (!is_new) {
        struct knot knot = core_knot_at(document, spline, sample);
        knot.value = core_round(before + by, RESOLUTION);
        core_hold(document->splines[spline], &knot, why);
        core_put_knot(core, spline, &knot);
        core_edited(core, spline);
        return -1;
    }
    if (sample > 1) base_put_knot(core, spline, 0, before, true, why);
    base_put_knot(core, spline, sample, before + by, true, why);
    base_follow(stage, core, coordinate, spline);
    const int swings = base_hang_channels(stage, core, coordinate, spline);
    core_edited(core, spline);
    return swings;
}

static void key_body(struct stage *stage, struct core *core, const double offset[3])
{
    struct report report = {.length = 0};
    char frame[64];
    bool is_first = true;
    int swings = -1;
    base_begin(stage, core);
    say(&report, "Keyed ");
    for (int k = 0; k < 3; k++) {
        if (offset[k] == 0) continue;
        const int made = key_coordinate(stage, core, k, offset[k], report.why);
        if (made >= 0) swings = made;
        const int track = tail_of(core->document, stage->body_drag.rig)->position[k].track;
        if (track < 0) continue;
        say_name(&report, is_first, core->document->splines[track]->name);
        is_first = false;
    }
    snprintf(frame, sizeof frame, " at frame %.0f.", round(core_frame(core)));
    say(&report, frame);
    core_add_stopped(report.why, report.text, sizeof report.text);
    base_say_channel(core, swings, report.text, sizeof report.text);
    if (!is_first) core_message(core, false, "%s", report.text);
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

/// Limits the held body's offset, in metres, as its splines' limits will in place_body() or a recording.
static void place_within(const struct stage *stage, const struct core *core, double offset[3])
{
    const struct document *document = core->document;
    const struct tail *tail = tail_of(document, stage->body_drag.rig);
    const bool keys = core->auto_key || stage->record.running || record_has_motion(stage);
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
}

/// Moves the equilibrium of still knots with the other knots, unless the equilibrium moves by itself.
static void shift_still(struct core *core, int spline, double by)
{
    const struct spline *shifted = core->document->splines[spline];
    const struct param *equilibrium = &shifted->parameter[PARAMETER_EQUILIBRIUM];
    bool any = false;
    for (int k = 0; k < shifted->knot_count; k++) any |= shifted->knots[k].still;
    if (any && equilibrium->track < 0 && !equilibrium->motion)
        core_set_parameter(core, spline, PARAMETER_EQUILIBRIUM, core_round(equilibrium->value + by, RESOLUTION));
}

/// Shifts all knots of a spline equally, as far as all can move, so that followers keep their motion. Returns the shift.
static double shift_spline(struct core *core, int spline, double way, char why[STOPPED_SIZE])
{
    const int count = core->document->splines[spline]->knot_count;
    const struct knot *stops;
    const double by = room_for(core->document->splines[spline], way, &stops);
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
        core_put_knot(core, spline, &knot);
    }
    shift_still(core, spline, by);
    core_edited(core, spline);
    return by;
}

static double shift_model(struct core *core, int rig, int coordinate, double by)
{
    struct rig moved = *core->document->rigs[rig];
    moved.model.position[coordinate] = core_round(moved.model.position[coordinate] + by, RESOLUTION);
    return edit_rig_set(core->document, rig, &moved, &core->error) ? by : 0;
}

/// Shifts a coordinate; returns the shift. A fixed height stands for the ground, which stays.
static double shift_coordinate(struct core *core, int rig, int coordinate, double by, char why[STOPPED_SIZE])
{
    const struct tail *tail = tail_of(core->document, rig);
    if (coordinate == 1 && (!tail || tail->position[1].track < 0)) return 0;
    if (!tail) return shift_model(core, rig, coordinate, by);
    const struct param *param = &tail->position[coordinate];
    if (param->track >= 0) return shift_spline(core, param->track, by, why);
    struct rig moved = *core->document->rigs[rig];
    moved.tail.position[coordinate] = param_number(core_round(param->value + by, RESOLUTION));
    edit_rig_set(core->document, rig, &moved, &core->error);
    return by;
}

static void shift_body(struct stage *stage, struct core *core, const double offset[3])
{
    struct report report = {.length = 0};
    bool is_first = true;
    say(&report, "Moved for the whole shot: ");
    for (int k = 0; k < 3; k++) {
        char part[32];
        if (offset[k] == 0) continue;
        const double by = shift_coordinate(core, stage->body_drag.rig, k, offset[k], report.why);
        if (by == 0) continue;
        snprintf(part, sizeof part, "%s %+.2f m", coordinate_name(k), by);
        say_name(&report, is_first, part);
        is_first = false;
    }
    if (is_first && report.why[0]) {
        core_stopped(core, report.why);
    } else if (is_first) {
        core_message(core, false, "Back on the ground. Turn on auto-key (Shift+A) or record (R) to keep the height.");
    } else {
        const bool keys = tail_of(core->document, stage->body_drag.rig) && !report.why[0];
        say(&report, keys ? ". Auto-key (Shift+A) sets knots instead." : ".");
        core_add_stopped(report.why, report.text, sizeof report.text);
        core_message(core, false, "%s", report.text);
    }
}

/// Moves the body by metres: knots at the playhead with auto-key, else the whole motion. Reports which.
static void place_body(struct stage *stage, struct core *core, const double offset[3])
{
    if (core->auto_key && tail_of(core->document, stage->body_drag.rig)) {
        key_body(stage, core, offset);
    } else {
        shift_body(stage, core, offset);
    }
    drag_inertia_land(stage);
}

void body_drag_advance(struct stage *stage, const struct core *core)
{
    body_drag_way(stage, core, stage->body_drag.offset);
    place_within(stage, core, stage->body_drag.offset);
}

void body_drag_offset(const struct stage *stage, const struct core *core, int rig, double offset[3])
{
    const bool held = body_is_held(core) && rig_body(core->document, rig) == stage->body_drag.rig;
    for (int k = 0; k < 3; k++) offset[k] = held ? stage->body_drag.offset[k] : 0;
}

enum { RING_POINTS = 64 };

static const double LEAST_PITCH = 0.35; ///< sine of the camera's elevation; below it depth follows the pointer less
static const double LEAST_RISE = 0.3;   ///< cosine of the elevation; below it height follows the pointer less
static const float ring_middle[2] = {0, -0.25f}; ///< x and z in bind space, metres
static const float RING_RADIUS = 0.6f;

struct tail *tail_of(const struct document *document, int rig)
{
    const bool is_tail = rig >= 0 && rig < document->rig_count && document->rigs[rig]->kind == RIG_TAIL;
    return is_tail ? &document->rigs[rig]->tail : NULL;
}

/// Where a body stands.
struct stand {
    float base[3], middle[2]; ///< the grabbed point; x and z
    float ground, radius;     ///< of a ring around it
};

/// False if there is no such body or it is not shown.
static bool find_stand(const struct stage *stage, const struct core *core, int rig, struct stand *stand)
{
    const struct posing posing = stage_posing_by_hand(stage);
    struct rig_pose pose;
    float lo[3], hi[3];
    if (!rig_pose(&posing, rig, core->playback.position, NULL, &pose)) return false;
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

/// Whether a ray hits a body's bounding box.
static bool passes_box(const struct pose *pose, const float eye[3], const float direction[3])
{
    const float *base = pose->matrix[0] + 12, scale = pose->scale;
    float near = 0, far = INFINITY, lo[3], hi[3];
    limbs_bounds(&pose->limbs, lo, hi);
    for (int k = 0; k < 3; k++) {
        const float from = eye[k] - base[k];
        const float a = (scale * lo[k] - from) / direction[k], b = (scale * hi[k] - from) / direction[k];
        near = fmaxf(near, fminf(a, b));
        far = fminf(far, fmaxf(a, b));
    }
    return near < far;
}

/// The ray's nearest hit on a part's body triangles, or `nearest`.
static float meet(const struct gltf_part *part, const float (*place)[3], const float eye[3], const float direction[3],
                  float nearest)
{
    for (int i = 0; i < part->index_count; i += 3) {
        const uint32_t *own = part->indices + i;
        const float *const corner[3] = {place[own[0]], place[own[1]], place[own[2]]};
        float uv[2];
        if (part->fur[own[0]][0] >= 1.0f) continue; // belongs to the tail
        const float distance = pick_triangle(corner, eye, direction, uv);
        if (distance > 0.0f) nearest = fminf(nearest, distance);
    }
    return nearest;
}

/// Distance along a ray to a fox's body, or INFINITY.
static float body_distance(struct stage *stage, const struct rig_pose *fox, const float direction[3])
{
    const struct gltf *gltf = &fox->model.imported->gltf;
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
        nearest = meet(part, (const float(*)[3])place, stage->view.eye, direction, nearest);
        place += part->vertex_count;
    }
    return nearest;
}

struct hover body_hover(struct stage *stage, const struct core *core, double position, float x, float y)
{
    const struct stage_view *view = &stage->view;
    const struct posing posing = stage_posing_by_hand(stage);
    const float viewport[4] = {view->viewport.x, view->viewport.y, view->viewport.w, view->viewport.h};
    struct hover hover = {.thing = NULL};
    float direction[3], nearest = INFINITY;
    camera_ray(view->view, view->projection, viewport, (const float[2]){x, y}, direction);
    for (int t = 0; t < stage->tail_count; t++) {
        const int rig = stage->strands[t].rig;
        struct rig_pose pose;
        if (!tail_of(core->document, rig) || !rig_pose(&posing, rig, position, NULL, &pose)) continue;
        if (!passes_box(&pose.strand, view->eye, direction)) continue;
        if (!rig_pose_body(&posing, rig, position, NULL, &pose)) continue;
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
    if (target->nth >= stage->tail_count || stage->strands[target->nth].model < 0) return false;
    const struct stage_model *fox = &stage->view.models[stage->strands[target->nth].model];
    for (int point = 0; point < 4; point++) {
        const mat4s moved = mat4_from(fox->pose->joints[point == 1 ? LIMB_HEAD : LIMB_BODY]);
        const vec3s at = glms_mat4_mulv3(moved, vec3_from(places[point]), 1.0f);
        const vec3s place = glms_mat4_mulv3(mat4_from(fox->root), at, 1.0f);
        if (!stage_project_point(stage, core->layout.stage, place.raw, xy)) continue;
        const struct hover hover = stage_hover(room, core, xy[0], xy[1]);
        if (hover.thing == &thing_body && hover.rig == target->rig) return true;
    }
    return false;
}

/// One half of the ring, near or far.
static void show_arc(struct core *core, const float point[RING_POINTS + 1][2], int from, int to, uint32_t color)
{
    drawlist_line(&core->list, point[from], to - from + 1, 1.5f, color);
}

void body_drag_show(struct stage *stage, struct core *core)
{
    const bool held = body_is_held(core);
    const int rig = held ? stage->body_drag.rig : core->hover.rig;
    struct stand stand;
    if (!held && core->hover.thing != &thing_body) return;
    if (!find_stand(stage, core, rig, &stand)) return;
    const uint32_t color = held ? theme()->accent : theme()->playhead;
    float point[RING_POINTS + 1][2];
    for (int i = 0; i <= RING_POINTS; i++) { // from the right of the screen over the near half
        float angle = 6.2831853f * (float)i / RING_POINTS - stage->camera.azimuth;
        const float place[3] = {stand.middle[0] - stand.radius * maths_sinf(-angle), stand.ground,
                                stand.middle[1] - stand.radius * maths_cosf(-angle)};
        if (!stage_project_point(stage, core->layout.stage, place, point[i])) return;
    }
    show_arc(core, (const float(*)[2])point, 0, RING_POINTS / 2, color);
    show_arc(core, (const float(*)[2])point, RING_POINTS / 2, RING_POINTS, theme_fade(color, 0.3f));
}

/// Edits the document in the open step: the recorded motion or the new place.
static void release(struct stage *stage, struct core *core, bool keep)
{
    const int body = stage->body_drag.rig;
    double offset[3];
    keep = keep && body < core->document->rig_count; // an edit may have removed the body
    body_drag_way(stage, core, offset);
    if (keep && record_has_motion(stage) && tail_of(core->document, body)) {
        record_keep(stage, core);
        drag_inertia_stop(stage, core->document, body);
    } else if (keep) {
        place_body(stage, core, offset);
    } else {
        drag_inertia_stop(stage, core->document, body);
    }
    record_forget(stage);
}

/// The first movement starts an armed recording.
static void move(void *room, struct core *core)
{
    struct stage *stage = room;
    if (stage->body_drag.begun) return;
    stage->body_drag.begun = true;
    if (core->record_armed && tail_of(core->document, stage->body_drag.rig)) record_begin(stage, core);
}

static enum drag_answer take_event(void *room, struct core *core, const struct event *event)
{
    // Ctrl may still be held from lifting the body.
    const bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & MOD_ALT);
    if (!key) return DRAG_PASSES;
    struct stage *stage = room;
    if (event->key != 'R')
        return drag_lock_axis(&core->drag, &stage->body_drag.axis, event->key) ? DRAG_USED : DRAG_PASSES;
    if (!tail_of(core->document, stage->body_drag.rig)) {
        core_message(core, false, "An imported character stays in one place for the whole shot. Its clip moves it.");
        return DRAG_USED;
    }
    drag_start_moving(core);
    move(room, core);
    record_begin(room, core);
    return DRAG_USED;
}

static void end(void *room, struct core *core, bool keep)
{
    if (core->drag.moved) release(room, core, keep);
    stage_click(room, core, keep);
}

static const struct drag_owner body_owner = {.cursor = CURSOR_MOVE, .move = move, .event = take_event, .end = end};

bool body_is_held(const struct core *core) { return core->drag.owner == &body_owner; }

void press_body(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct stage *stage = room;
    const int rig = hover->thing == &thing_bone ? hover->model : hover->rig;
    struct body_drag *hold = &stage->body_drag;
    const struct camera *camera = &stage->camera;
    struct stand stand = {.radius = 0};
    drag_begin(core, &body_owner, stage, "Move body", event);
    *hold = (struct body_drag){.rig = rig, .axis = -1};
    find_stand(stage, core, rig, &stand);
    hold->pixels_per_metre = stage_pixels_per_metre(stage, core, stand.base);
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
