/// Moving the body: where the pointer takes it, and what the document makes of it.
#include "editor/stage/body.h"
#include "editor/core/actions.h"
#include "editor/curves/curves.h"
#include "editor/stage/follow.h"
#include "editor/stage/record.h"
#include "model/creature.h"
#include "ui/theme.h"
#include <math.h>

enum { TRACE_STEPS = 64, RING_POINTS = 64 };

static const float TRACE_NEAR = 0.004f; ///< metres from the skin that count as touching it, bind size
static const double LEAST_PITCH = 0.35; ///< sine of the camera's elevation below which depth follows the pointer less
static const double LEAST_AXIS = 0.3;   ///< pixels of an axis in a pixel across, below which it is as slow as that
static const double RESOLUTION = 1e-3;  ///< metres that the document gets
static const float ring_middle[2] = {0, -0.25f}; ///< x and z in bind size, metres
static const float RING_RADIUS = 0.6f;

static const float *base_of(const struct editor *editor, int tail)
{
    return editor->stage.tails[tail].pose.matrix[0] + 12;
}

static float scale_of(const struct editor *editor, int tail)
{
    return pose_length(&editor->stage.tails[tail].pose) / CREATURE_TAIL_LENGTH;
}

/// Where the ray from the eye meets the body (metres along it, bind size), or a negative number: steps of the distance to the
/// skin cannot pass through it.
static float trace(const float from[3], const float direction[3])
{
    float near = 0, far = INFINITY;
    for (int k = 0; k < 3; k++) {
        float a = (creature_body_lo[k] - from[k]) / direction[k], b = (creature_body_hi[k] - from[k]) / direction[k];
        near = fmaxf(near, fminf(a, b));
        far = fminf(far, fmaxf(a, b));
    }
    for (int step = 0; step < TRACE_STEPS && near < far; step++) {
        const float p[3] = {from[0] + near * direction[0], from[1] + near * direction[1],
                            from[2] + near * direction[2]};
        float distance = creature_body_distance(p);
        if (distance < TRACE_NEAR) return near;
        near += 0.9f * distance;
    }
    return -1;
}

struct hover body_hover(const struct editor *editor, float x, float y)
{
    const struct stage_view *view = &editor->stage;
    const float viewport[4] = {view->viewport.x, view->viewport.y, view->viewport.w, view->viewport.h};
    struct hover hover = {.kind = HOVER_NONE};
    float direction[3], nearest = INFINITY;
    camera_ray(view->view, view->projection, viewport, (const float[2]){x, y}, direction);
    for (int t = 0; t < view->tail_count; t++) {
        const float scale = scale_of(editor, t);
        float from[3];
        for (int k = 0; k < 3; k++) from[k] = (view->eye[k] - base_of(editor, t)[k]) / scale;
        const float distance = scale * trace(from, direction);
        if (!(distance >= 0 && distance < nearest)) continue;
        nearest = distance;
        hover = (struct hover){.kind = HOVER_BODY, .tail = t, .x = x, .y = y};
    }
    return hover;
}

static bool project(const struct editor *editor, const float point[3], float xy[2])
{
    const struct rect *r = &editor->layout.stage;
    const float viewport[4] = {r->x, r->y, r->w, r->h};
    return camera_project(editor->stage.view, editor->stage.projection, viewport, point, xy);
}

bool body_point(const struct editor *editor, int tail, float xy[2])
{
    static const float candidates[][3] = {
        {0, 0.18f, -0.45f}, {0, 0.54f, -0.385f}, {0, 0.05f, -0.25f}, {0, 0, -0.5f}}; // chest, head, rump, paws
    for (size_t i = 0; i < sizeof candidates / sizeof candidates[0]; i++) {
        float point[3];
        for (int k = 0; k < 3; k++) point[k] = base_of(editor, tail)[k] + scale_of(editor, tail) * candidates[i][k];
        if (!project(editor, point, xy)) continue;
        struct hover hover = stage_hover(editor, xy[0], xy[1]);
        if (hover.kind == HOVER_BODY && hover.tail == tail) return true;
    }
    return false;
}

void body_begin(struct editor *editor, int tail)
{
    struct body *body = &editor->body;
    const float *eye = editor->stage.eye, *base = base_of(editor, tail);
    const struct camera *camera = &editor->camera;
    *body = (struct body){.tail = tail};
    float depth = 0;
    for (int k = 0; k < 3; k++) depth += (eye[k] - base[k]) * editor->stage.view[4 * k + 2];
    body->pixels_per_metre =
        0.5 * (double)(editor->layout.stage.h * editor->stage.projection[5] / fmaxf(depth, 0.1f));
    double pitch = sin((double)camera->elevation);
    body->pitch = copysign(fmax(fabs(pitch), LEAST_PITCH), pitch);
    body->right[0] = -sin((double)camera->azimuth);
    body->right[1] = -cos((double)camera->azimuth);
}

/// Along one axis of the ground, so that the body stays under the pointer: the axis' own direction on the screen counts.
static double along_axis(const struct body *body, const double axis[2], double dx, double dy)
{
    double across = axis[0] * body->right[0] + axis[1] * body->right[1];
    double away = (axis[0] * body->right[1] - axis[1] * body->right[0]) * body->pitch;
    double square = fmax(across * across + away * away, LEAST_AXIS * LEAST_AXIS);
    return (dx * across - dy * away) / square / body->pixels_per_metre;
}

void body_offset(const struct editor *editor, int tail, double offset[3])
{
    const struct drag *drag = &editor->drag;
    const struct body *body = &editor->body;
    offset[0] = offset[1] = offset[2] = 0;
    if (drag->kind != DRAG_BODY || !drag->moved || body->tail != tail) return;
    const double x_axis[2] = {1, 0}, z_axis[2] = {0, 1};
    if (drag->lock_x) {
        offset[0] = along_axis(body, x_axis, drag->moved_x, drag->moved_y);
    } else if (drag->lock_y) {
        offset[2] = along_axis(body, z_axis, drag->moved_x, drag->moved_y);
    } else {
        double across = drag->moved_x / body->pixels_per_metre;
        double away = -drag->moved_y / body->pixels_per_metre / body->pitch;
        offset[0] = across * body->right[0] + away * body->right[1];
        offset[2] = across * body->right[1] - away * body->right[0];
    }
}

/// A knot at the playhead of the spline that a coordinate follows.
static void key_position(struct editor *editor, const struct editor_world *world, int track, double by)
{
    const struct document *document = world->document;
    const struct spline *spline = &document->splines[track];
    int sample = document_sample(document, round(editor_frame(editor, document)));
    int last = document_last_knot_sample(document, spline);
    sample = sample > last ? last : sample < 0 ? 0 : sample;
    int at = spline_find_knot(document, spline, sample);
    struct edit edit = editor_edit_of(at < 0 ? EDIT_KNOT_INSERT : EDIT_KNOT_SET, track);
    wiggly_value value = curves_solved(world, track, sample);
    edit.knot = at < 0 ? (struct knot){.frame = document_frame(document, sample), .stiffness = KNOT_DEFAULT_STIFFNESS}
                       : spline->knots[at];
    edit.knot.value = round_value(value.y + value.re + by, RESOLUTION);
    editor_edit(editor, world, &edit);
}

static void key_offset(struct editor *editor, const struct editor_world *world, int tail, const double offset[3])
{
    for (int k = 0; k < 3; k++) {
        const struct param *param = &document_tail(world->document, tail)->position[k];
        if (offset[k] == 0) continue;
        if (param->track >= 0) {
            key_position(editor, world, param->track, offset[k]);
            continue;
        }
        struct edit edit = editor_edit_of(EDIT_POSITION, 0);
        edit.rig = document_find_rig(world->document, RIG_TAIL, tail);
        edit.coordinate = k;
        edit.param.value = round_value(param->value + offset[k], RESOLUTION);
        editor_edit(editor, world, &edit);
    }
}

void body_release(struct editor *editor, const struct editor_world *world, bool keep)
{
    int tail = editor->body.tail;
    double offset[3];
    body_offset(editor, tail, offset);
    if (keep && record_has_motion(editor)) {
        record_keep(editor, world);
        follow_stop(editor, tail);
    } else if (keep) {
        key_offset(editor, world, tail, offset);
        follow_land(editor, tail);
    } else {
        follow_stop(editor, tail);
    }
    record_forget(editor);
}

/// A stretch of the ring that is as far from the eye all along, near or far half.
static void show_arc(struct editor *editor, const float point[RING_POINTS + 1][2], int from, int to, uint32_t color)
{
    drawlist_line(&editor->list, point[from], to - from + 1, 1.5f, color);
}

void body_show(struct editor *editor)
{
    bool held = editor->drag.kind == DRAG_BODY;
    if (!held && editor->hover.kind != HOVER_BODY) return;
    int tail = held ? editor->body.tail : editor->hover.tail;
    if (tail >= editor->stage.tail_count) return;
    const float scale = scale_of(editor, tail), *base = base_of(editor, tail);
    const uint32_t color = held ? theme()->accent : theme()->playhead;
    float point[RING_POINTS + 1][2];
    for (int i = 0; i <= RING_POINTS; i++) { // from the right side of the picture over the near half
        float angle = 6.2831853f * (float)i / RING_POINTS - editor->camera.azimuth;
        const float world[3] = {base[0] + scale * (ring_middle[0] - RING_RADIUS * sinf(-angle)),
                                editor->stage.tails[tail].pose.ground,
                                base[2] + scale * (ring_middle[1] - RING_RADIUS * cosf(-angle))};
        if (!project(editor, world, point[i])) return;
    }
    show_arc(editor, (const float(*)[2])point, 0, RING_POINTS / 2, color);
    show_arc(editor, (const float(*)[2])point, RING_POINTS / 2, RING_POINTS, theme_fade(color, 0.3f));
}
