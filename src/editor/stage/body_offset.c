/// Where the pointer takes the body that it holds.
#include "editor/stage/body_offset.h"
#include <math.h>

static const double LEAST_AXIS = 0.3; ///< pixels of an axis in a pixel across, below which it is as slow as that

/// Along one axis of the ground, so that the body stays under the pointer: the axis' own direction on the screen counts.
static double along_axis(const struct body_drag *body, const double axis[2], double dx, double dy)
{
    double across = axis[0] * body->right[0] + axis[1] * body->right[1];
    double away = (axis[0] * body->right[1] - axis[1] * body->right[0]) * body->pitch;
    double square = fmax(across * across + away * away, LEAST_AXIS * LEAST_AXIS);
    return (dx * across - dy * away) / square / body->pixels_per_metre;
}

void body_offset(const struct stage *stage, const struct core *core, int tail, double offset[3])
{
    const struct drag *drag = &core->drag;
    const struct body_drag *body = &stage->body_drag;
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
