/// Dragging the body over the ground: where the pointer takes it, and what the document makes of that.
#include "editor/stage/hold.h"
#include "editor/core/core.h"
#include "editor/stage/rigs.h"
#include "model/creature.h"
#include "model/vector.h"
#include "ui/theme.h"
#include <math.h>

static const double LEAST_AXIS = 0.3; ///< pixels of an axis in a pixel across, below which it is as slow as that

/// Along one axis of the ground, so that the body stays under the pointer: the axis' own direction on the screen counts.
static double along_axis(const struct hold *hold, const double axis[2], double dx, double dy)
{
    double across = axis[0] * hold->right[0] + axis[1] * hold->right[1];
    double away = (axis[0] * hold->right[1] - axis[1] * hold->right[0]) * hold->pitch;
    double square = fmax(across * across + away * away, LEAST_AXIS * LEAST_AXIS);
    return (dx * across - dy * away) / square / hold->pixels_per_metre;
}

void hold_offset(const struct stage *stage, const struct core *core, int tail, double offset[3])
{
    const struct drag *drag = &core->drag;
    const struct hold *hold = &stage->hold;
    offset[0] = offset[1] = offset[2] = 0;
    if (drag->kind != DRAG_BODY || !drag->moved || hold->tail != tail) return;
    const double x_axis[2] = {1, 0}, z_axis[2] = {0, 1};
    if (drag->lock_x) {
        offset[0] = along_axis(hold, x_axis, drag->moved_x, drag->moved_y);
    } else if (drag->lock_y) {
        offset[2] = along_axis(hold, z_axis, drag->moved_x, drag->moved_y);
    } else {
        double across = drag->moved_x / hold->pixels_per_metre;
        double away = -drag->moved_y / hold->pixels_per_metre / hold->pitch;
        offset[0] = across * hold->right[0] + away * hold->right[1];
        offset[2] = across * hold->right[1] - away * hold->right[0];
    }
}

enum { TRACE_STEPS = 64, RING_POINTS = 64 };

static const float TRACE_NEAR = 0.004f; ///< metres from the skin that count as touching it, bind size
static const double LEAST_PITCH = 0.35; ///< sine of the camera's elevation below which depth follows the pointer less
static const double RESOLUTION = 1e-3;  ///< metres that the document gets
static const float ring_middle[2] = {0, -0.25f}; ///< x and z in bind size, metres
static const float RING_RADIUS = 0.6f;

static const float *base_of(const struct stage *stage, int tail)
{
    return stage->view.tails[tail].pose.matrix[0] + 12;
}

static float scale_of(const struct pose *pose) { return pose_length(pose) / CREATURE_TAIL_LENGTH; }

/// Where the ray from the eye meets the body (metres along it, bind size), or a negative number: steps of the distance to the
/// skin cannot pass through it.
static float trace(const float from[3], const float direction[3])
{
    float near = 0, far = INFINITY;
    for (int k = 0; k < 3; k++) {
        float a = (creature_torso_lo[k] - from[k]) / direction[k],
              b = (creature_torso_hi[k] - from[k]) / direction[k];
        near = fmaxf(near, fminf(a, b));
        far = fminf(far, fmaxf(a, b));
    }
    for (int step = 0; step < TRACE_STEPS && near < far; step++) {
        const vec3s p = glms_vec3_muladds(vec3_from(direction), near, vec3_from(from));
        float distance = creature_torso_distance(p.raw);
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
    return scale * trace(from.raw, direction);
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
    const vec3s base = vec3_from(base_of(stage, tail));
    const vec3s place = glms_vec3_muladds(vec3_from(places[point]), scale_of(&stage->view.tails[tail].pose), base);
    return stage_project_point(stage, core->layout.stage, place.raw, xy);
}

void hold_begin(struct stage *stage, const struct core *core, int tail)
{
    struct hold *hold = &stage->hold;
    const struct camera *camera = &stage->camera;
    *hold = (struct hold){.tail = tail};
    const float depth = camera_depth(stage->view.view, stage->view.eye, base_of(stage, tail));
    hold->pixels_per_metre = 0.5 * (double)(core->layout.stage.h * stage->view.projection[5] / fmaxf(depth, 0.1f));
    double pitch = sin((double)camera->elevation);
    hold->pitch = copysign(fmax(fabs(pitch), LEAST_PITCH), pitch);
    hold->right[0] = -sin((double)camera->azimuth);
    hold->right[1] = -cos((double)camera->azimuth);
}

/// A knot at the playhead of the spline that a coordinate follows.
static void key_position(struct core *core, const struct editor_world *world, int track, double by)
{
    const struct document *document = world->document;
    int sample = document_sample(document, round(core_frame(core, document)));
    int last = document_last_knot_sample(document, &document->splines[track]);
    sample = sample > last ? last : sample < 0 ? 0 : sample;
    struct edit edit = core_knot_edit(document, track, sample);
    wiggly_value value = evaluation_at(world->evaluation, track, sample);
    edit.knot.value = core_round(value.y + value.re + by, RESOLUTION);
    core_edit(core, world, &edit);
}

static void key_offset(struct core *core, const struct editor_world *world, int tail, const double offset[3])
{
    for (int k = 0; k < 3; k++) {
        const struct param *param = &document_tail(world->document, tail)->position[k];
        if (offset[k] == 0) continue;
        if (param->track >= 0) {
            key_position(core, world, param->track, offset[k]);
            continue;
        }
        struct edit edit = core_edit_of(EDIT_POSITION, 0);
        edit.rig = document_find_rig(world->document, RIG_TAIL, tail);
        edit.coordinate = k;
        edit.param.value = core_round(param->value + offset[k], RESOLUTION);
        core_edit(core, world, &edit);
    }
}

void hold_release(struct stage *stage, struct core *core, const struct editor_world *world, bool keep)
{
    int tail = stage->hold.tail;
    double offset[3];
    keep = keep && document_tail(world->document, tail); // an edit may have taken the tail out of the hand
    hold_offset(stage, core, tail, offset);
    if (keep && record_has_motion(stage)) {
        record_keep(stage, core, world);
        sway_stop(stage, tail);
    } else if (keep) {
        key_offset(core, world, tail, offset);
        sway_land(stage, tail);
    } else {
        sway_stop(stage, tail);
    }
    record_forget(stage);
}

/// A stretch of the ring that is as far from the eye all along, near or far half.
static void show_arc(struct core *core, const float point[RING_POINTS + 1][2], int from, int to, uint32_t color)
{
    drawlist_line(&core->list, point[from], to - from + 1, 1.5f, color);
}

void hold_show(struct stage *stage, struct core *core)
{
    bool held = core->drag.kind == DRAG_BODY;
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
