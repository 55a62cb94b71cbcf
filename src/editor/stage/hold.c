/// Dragging the body over the ground: where the pointer takes it, and what the document makes of that.
#include "editor/stage/hold.h"
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/stage/rigs.h"
#include "model/creature.h"
#include "model/limbs.h"
#include "model/vector.h"
#include "ui/theme.h"
#include <math.h>

enum { AXIS_X, AXIS_Y, AXIS_Z };

static const double LEAST_AXIS = 0.3; ///< pixels of an axis in a pixel across, below which it is as slow as that

/// Along one axis of the ground, so that the body stays under the pointer: the axis' own direction on the screen counts.
static double along_axis(const struct hold *hold, const double axis[2], double dx, double dy)
{
    double across = axis[0] * hold->right[0] + axis[1] * hold->right[1];
    double away = (axis[0] * hold->right[1] - axis[1] * hold->right[0]) * hold->pitch;
    double square = fmax(across * across + away * away, LEAST_AXIS * LEAST_AXIS);
    return (dx * across - dy * away) / square / hold->pixels_per_metre;
}

void hold_way(const struct stage *stage, const struct core *core, double offset[3])
{
    const struct drag *drag = &core->drag;
    const struct hold *hold = &stage->hold;
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

void hold_advance(struct stage *stage, const struct core *core, const struct editor_world *world)
{
    hold_way(stage, core, stage->hold.offset);
    place_within(stage, core, world, stage->hold.offset);
}

void hold_offset(const struct stage *stage, const struct core *core, int tail, double offset[3])
{
    const bool held = body_is_held(core) && stage->hold.tail == tail;
    for (int k = 0; k < 3; k++) offset[k] = held ? stage->hold.offset[k] : 0;
}

static bool lock(struct stage *stage, int key)
{
    if (key != 'X' && key != 'Y' && key != 'Z') return false;
    const int axis = key - 'X';
    stage->hold.axis = stage->hold.axis == axis ? -1 : axis;
    return true;
}

enum { TRACE_STEPS = 64, RING_POINTS = 64 };

static const float TRACE_NEAR = 0.004f; ///< metres from the skin that count as touching it, bind size
static const double LEAST_PITCH = 0.35; ///< sine of the camera's elevation below which depth follows the pointer less
static const double LEAST_RISE = 0.3;   ///< cosine of it below which height does
static const float ring_middle[2] = {0, -0.25f}; ///< x and z in bind size, metres
static const float RING_RADIUS = 0.6f;

static const float *base_of(const struct stage *stage, int tail)
{
    return stage->view.tails[tail].pose.matrix[0] + 12;
}

static float scale_of(const struct pose *pose) { return pose_length(pose) / CREATURE_TAIL_LENGTH; }

/// Where the ray from the eye meets the body as it is moved (metres along it, bind size), or a negative number: steps of the distance to
/// the skin cannot pass through it.
static float trace(const struct limbs *limbs, const float from[3], const float direction[3])
{
    const struct limbs_back back = limbs_back(limbs);
    float near = 0, far = INFINITY, lo[3], hi[3];
    limbs_bounds(limbs, lo, hi);
    for (int k = 0; k < 3; k++) {
        float a = (lo[k] - from[k]) / direction[k], b = (hi[k] - from[k]) / direction[k];
        near = fmaxf(near, fminf(a, b));
        far = fminf(far, fmaxf(a, b));
    }
    for (int step = 0; step < TRACE_STEPS && near < far; step++) {
        const vec3s p = glms_vec3_muladds(vec3_from(direction), near, vec3_from(from));
        float distance = limbs_distance(&back, p.raw);
        if (distance < TRACE_NEAR) return near;
        near += 0.9f * distance;
    }
    return -1;
}

float hold_distance(const struct stage *stage, const struct pose *pose, float x, float y)
{
    const struct stage_view *view = &stage->view;
    const float viewport[4] = {view->viewport.x, view->viewport.y, view->viewport.w, view->viewport.h};
    const float scale = scale_of(pose);
    float direction[3];
    camera_ray(view->view, view->projection, viewport, (const float[2]){x, y}, direction);
    const vec3s from = glms_vec3_divs(glms_vec3_sub(vec3_from(view->eye), vec3_from(pose->matrix[0] + 12)), scale);
    return scale * trace(&pose->limbs, from.raw, direction);
}

struct hover hold_hover(const struct stage *stage, float x, float y)
{
    struct hover hover = {.kind = HOVER_NONE};
    float nearest = INFINITY;
    for (int t = 0; t < stage->view.tail_count; t++) {
        const float distance = hold_distance(stage, &stage->view.tails[t].pose, x, y);
        if (!(distance >= 0 && distance < nearest)) continue;
        nearest = distance;
        hover = (struct hover){.kind = HOVER_BODY, .tail = t, .x = x, .y = y};
    }
    return hover;
}

bool hold_point(const struct stage *stage, const struct core *core, int tail, int point, float xy[2])
{
    static const float places[HOLD_POINTS][3] = {
        {0, 0.18f, -0.45f}, {0, 0.54f, -0.385f}, {0, 0.05f, -0.25f}, {0, 0, -0.5f}}; // chest, head, rump, paws
    const struct pose *pose = &stage->view.tails[tail].pose;
    const vec3s base = vec3_from(base_of(stage, tail));
    float matrix[LIMBS][16];
    limbs_matrices(&pose->limbs, 1.0f, matrix);
    const mat4s moved = mat4_from(matrix[point == HOLD_HEAD ? LIMB_HEAD : LIMB_BODY]);
    const vec3s at = glms_mat4_mulv3(moved, vec3_from(places[point]), 1.0f);
    const vec3s place = glms_vec3_muladds(at, scale_of(pose), base);
    return stage_project_point(stage, core->layout.stage, place.raw, xy);
}

/// A stretch of the ring that is as far from the eye all along, near or far half.
static void show_arc(struct core *core, const float point[RING_POINTS + 1][2], int from, int to, uint32_t color)
{
    drawlist_line(&core->list, point[from], to - from + 1, 1.5f, color);
}

void hold_show(struct stage *stage, struct core *core)
{
    bool held = body_is_held(core);
    if (!held && core->hover.kind != HOVER_BODY) return;
    int tail = held ? stage->hold.tail : core->hover.tail;
    if (tail >= stage->view.tail_count) return;
    const float scale = scale_of(&stage->view.tails[tail].pose), *base = base_of(stage, tail);
    const uint32_t color = held ? theme()->accent : theme()->playhead;
    float point[RING_POINTS + 1][2];
    for (int i = 0; i <= RING_POINTS; i++) { // from the right side of the picture over the near half
        float angle = 6.2831853f * (float)i / RING_POINTS - stage->camera.azimuth;
        const float world[3] = {base[0] + scale * (ring_middle[0] - RING_RADIUS * sinf(-angle)),
                                stage->view.tails[tail].pose.ground,
                                base[2] + scale * (ring_middle[1] - RING_RADIUS * cosf(-angle))};
        if (!stage_project_point(stage, core->layout.stage, world, point[i])) return;
    }
    show_arc(core, (const float(*)[2])point, 0, RING_POINTS / 2, color);
    show_arc(core, (const float(*)[2])point, RING_POINTS / 2, RING_POINTS, theme_fade(color, 0.3f));
}

/// Inside the open step the document gets the recorded motion or the new place.
static void release(struct stage *stage, struct core *core, const struct editor_world *world, bool keep)
{
    int tail = stage->hold.tail;
    double offset[3];
    keep = keep && document_tail(world->document, tail); // an edit may have taken the tail out of the hand
    hold_way(stage, core, offset);
    if (keep && record_has_motion(stage)) {
        record_keep(stage, core, world);
        sway_stop(stage, tail);
    } else if (keep) {
        place_body(stage, core, world, offset);
    } else {
        sway_stop(stage, tail);
    }
    record_forget(stage);
}

/// A body that is to be recorded is so from the first movement on.
static void move(void *room, struct core *core, const struct editor_world *world)
{
    struct stage *stage = room;
    (void)world;
    if (stage->hold.begun) return;
    stage->hold.begun = true;
    if (core->record_armed) record_begin(stage, core);
}

static enum drag_answer take_event(void *room, struct core *core, const struct editor_world *world,
                                   const struct event *event)
{
    // Ctrl may still be down, which lifts bodies.
    const bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & MOD_ALT);
    if (!key) return DRAG_PASSES;
    if (event->key != 'R') return lock(room, event->key) ? DRAG_USED : DRAG_PASSES;
    drag_start_moving(core, world);
    move(room, core, world);
    record_begin(room, core);
    return DRAG_USED;
}

static void end(void *room, struct core *core, const struct editor_world *world, bool keep)
{
    if (core->drag.moved) release(room, core, world, keep);
    stage_click(room, core, world, keep);
}

static const struct drag_owner body_owner = {.cursor = CURSOR_MOVE, .move = move, .event = take_event, .end = end};

bool body_is_held(const struct core *core) { return core->drag.owner == &body_owner; }

void hold_begin(struct stage *stage, struct core *core, int tail, const struct event *event)
{
    struct hold *hold = &stage->hold;
    const struct camera *camera = &stage->camera;
    const struct pose *pose = &stage->view.tails[tail].pose;
    drag_begin(core, &body_owner, stage, "Move body", event);
    *hold = (struct hold){.tail = tail, .lifts = event->mods & MOD_CTRL, .axis = -1};
    const float depth = camera_depth(stage->view.view, stage->view.eye, base_of(stage, tail));
    hold->pixels_per_metre = 0.5 * (double)(core->layout.stage.h * stage->view.projection[5] / fmaxf(depth, 0.1f));
    double pitch = sin((double)camera->elevation);
    hold->pitch = copysign(fmax(fabs(pitch), LEAST_PITCH), pitch);
    hold->rise = fmax(cos((double)camera->elevation), LEAST_RISE);
    const float sitting = pose->ground + CREATURE_BASE_HEIGHT * scale_of(pose);
    hold->lowest = fmin(0, (double)(sitting - base_of(stage, tail)[1]));
    hold->right[0] = -sin((double)camera->azimuth);
    hold->right[1] = -cos((double)camera->azimuth);
}
