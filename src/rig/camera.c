/// Orbits, pans, zooms and projects.
#include "rig/camera.h"
#include <math.h>
#include <string.h>

/// Half of the 30° vertical field of view, as a slope.
#define HALF_FIELD 0.267949192f
#define MIN_DISTANCE 0.2f
#define MAX_DISTANCE 100.0f
#define FIT_MARGIN 1.15f

enum { EDGES = 12 }; ///< of a box

/// The camera's axes in the world: to the right, up, and from the target to the eye.
struct axes {
    float right[3], up[3], back[3];
};

static struct axes camera_axes(const struct camera *camera)
{
    const float ca = cosf(camera->azimuth), sa = sinf(camera->azimuth);
    const float ce = cosf(camera->elevation), se = sinf(camera->elevation);
    return (struct axes){{-sa, 0.0f, -ca}, {-ca * se, ce, sa * se}, {ca * ce, se, -sa * ce}};
}

static float dot(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static float clamp(float x, float lo, float hi) { return fminf(fmaxf(x, lo), hi); }

struct camera camera_default(void)
{
    const float degree = 0.0174532925f;
    return (struct camera){.azimuth = 35.0f * degree, .elevation = 12.0f * degree, .distance = 4.0f};
}

void camera_lamp(const struct camera *camera, float from[3])
{
    static const float lamp[3] = {-0.39955f, 0.79910f, 0.44949f}; // to the right, up, towards the eye
    const struct axes axes = camera_axes(camera);
    for (int k = 0; k < 3; k++) from[k] = lamp[0] * axes.right[k] + lamp[1] * axes.up[k] + lamp[2] * axes.back[k];
}

/// near and far go with the distance, so that any size of scene keeps the same depth precision.
void camera_matrices(const struct camera *camera, float aspect, float view[16], float projection[16], float eye[3])
{
    const struct axes axes = camera_axes(camera);
    for (int k = 0; k < 3; k++) {
        eye[k] = camera->target[k] + camera->distance * axes.back[k];
        view[4 * k] = axes.right[k];
        view[4 * k + 1] = axes.up[k];
        view[4 * k + 2] = axes.back[k];
        view[4 * k + 3] = 0.0f;
    }
    view[12] = -dot(axes.right, eye);
    view[13] = -dot(axes.up, eye);
    view[14] = -dot(axes.back, eye);
    view[15] = 1.0f;
    const float near = 0.05f * camera->distance, far = 20.0f * camera->distance + 10.0f;
    memset(projection, 0, 16 * sizeof *projection);
    projection[0] = 1.0f / (HALF_FIELD * aspect);
    projection[5] = 1.0f / HALF_FIELD;
    projection[10] = (far + near) / (near - far);
    projection[11] = -1.0f;
    projection[14] = 2.0f * far * near / (near - far);
}

/// Middle of one of the box's edges, relative to the middle of the box.
static void edge_middle(int edge, const float lo[3], const float hi[3], float middle[3])
{
    const int axis = edge / 4;
    const float sign[2] = {edge & 1 ? 0.5f : -0.5f, edge & 2 ? 0.5f : -0.5f};
    middle[axis] = 0.0f;
    for (int k = 0; k < 2; k++) {
        const int other = (axis + 1 + k) % 3;
        middle[other] = sign[k] * (hi[other] - lo[other]);
    }
}

/// Along one axis of the picture, with points at (across, depth towards the eye) from the target: how far away the
/// eye must be to see all of them within `slope`, and where the target must move to see them in the middle.
static float fit_axis(const float across[EDGES], const float depth[EDGES], float slope, float *shift)
{
    float high = -INFINITY, low = INFINITY;
    for (int e = 0; e < EDGES; e++) {
        high = fmaxf(high, across[e] + slope * depth[e]);
        low = fminf(low, across[e] - slope * depth[e]);
    }
    *shift = 0.5f * (high + low);
    return 0.5f * (high - low) / slope;
}

/// A point (u, w) is in view where |u − shift| ≤ slope·(distance − w), so distance ≥ (the largest u + slope·w less
/// the smallest u − slope·w) / 2·slope, and shift is halfway. What swings fills the middle of its box, not the
/// corners.
void camera_fit(struct camera *camera, const float lo[3], const float hi[3], float aspect)
{
    for (int k = 0; k < 3; k++) {
        if (!(hi[k] - lo[k] > 0.0f && hi[k] - lo[k] < INFINITY)) return;
    }
    const struct axes axes = camera_axes(camera);
    float right[EDGES], up[EDGES], depth[EDGES], shift_right, shift_up;
    for (int e = 0; e < EDGES; e++) {
        float middle[3];
        edge_middle(e, lo, hi, middle);
        right[e] = dot(axes.right, middle);
        up[e] = dot(axes.up, middle);
        depth[e] = dot(axes.back, middle);
    }
    const float wide = fit_axis(right, depth, HALF_FIELD * aspect / FIT_MARGIN, &shift_right);
    const float high = fit_axis(up, depth, HALF_FIELD / FIT_MARGIN, &shift_up);
    camera->distance = clamp(fmaxf(wide, high), MIN_DISTANCE, MAX_DISTANCE);
    for (int k = 0; k < 3; k++) {
        camera->target[k] = 0.5f * (lo[k] + hi[k]) + shift_right * axes.right[k] + shift_up * axes.up[k];
    }
}

static void transform(const float m[16], const float v[4], float out[4])
{
    for (int r = 0; r < 4; r++) out[r] = m[r] * v[0] + m[4 + r] * v[1] + m[8 + r] * v[2] + m[12 + r] * v[3];
}

bool camera_project(const float view[16], const float projection[16], const float viewport[4], const float world[3],
                    float screen[2])
{
    const float point[4] = {world[0], world[1], world[2], 1.0f};
    float eye[4], clip[4];
    transform(view, point, eye);
    transform(projection, eye, clip);
    if (!(clip[3] > 1e-6f)) return false;
    screen[0] = viewport[0] + viewport[2] * (0.5f + 0.5f * clip[0] / clip[3]);
    screen[1] = viewport[1] + viewport[3] * (0.5f - 0.5f * clip[1] / clip[3]);
    return true;
}

void camera_ray(const float view[16], const float projection[16], const float viewport[4], const float screen[2],
                float direction[3])
{
    const float eye[3] = {(2.0f * (screen[0] - viewport[0]) / viewport[2] - 1.0f) / projection[0],
                          (1.0f - 2.0f * (screen[1] - viewport[1]) / viewport[3]) / projection[5], -1.0f};
    const float length = sqrtf(dot(eye, eye));
    for (int k = 0; k < 3; k++) direction[k] = dot(view + 4 * k, eye) / length;
}

void camera_orbit(struct camera *camera, float azimuth, float elevation)
{
    camera->azimuth = remainderf(camera->azimuth + azimuth, 6.28318531f);
    camera->elevation = clamp(camera->elevation + elevation, -CAMERA_MAX_ELEVATION, CAMERA_MAX_ELEVATION);
}

void camera_pan(struct camera *camera, float dx, float dy, float height)
{
    const struct axes axes = camera_axes(camera);
    const float metres = 2.0f * HALF_FIELD * camera->distance / fmaxf(height, 1.0f);
    for (int k = 0; k < 3; k++) camera->target[k] += metres * (dy * axes.up[k] - dx * axes.right[k]);
}

void camera_zoom(struct camera *camera, float factor)
{
    camera->distance = clamp(camera->distance * factor, MIN_DISTANCE, MAX_DISTANCE);
}
