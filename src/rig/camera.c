/// Orbits, pans, zooms and projects.
#include "rig/camera.h"
#include "maths/maths.h"
#include "model/vector.h"
#include <math.h>
#include <string.h>

/// Half of the 30° vertical field of view, as a slope.
#define HALF_FIELD 0.267949192f
#define MIN_DISTANCE 1e-4f
#define MAX_DISTANCE 1e5f
#define FIT_MARGIN 1.15f
#define LEAST_HEIGHT 0.02f /* least height of the eye above the floor, as a share of its distance */

enum { EDGES = 12 }; ///< of a box

/// The camera's axes in the world: to the right, up, and from the target to the eye.
struct axes {
    vec3s right, up, back;
};

static struct axes camera_axes(const struct camera *camera)
{
    const float ca = maths_cosf(camera->azimuth), sa = maths_sinf(camera->azimuth);
    const float ce = maths_cosf(camera->elevation), se = maths_sinf(camera->elevation);
    return (struct axes){{{-sa, 0.0f, -ca}}, {{-ca * se, ce, sa * se}}, {{ca * ce, se, -sa * ce}}};
}

/// The vector that has these components along the axes.
static vec3s along(const struct axes *axes, float right, float up, float back)
{
    return glms_vec3_muladds(axes->back, back, glms_vec3_muladds(axes->up, up, glms_vec3_scale(axes->right, right)));
}

struct camera camera_default(void)
{
    const float degree = 0.0174532925f;
    return (struct camera){
        .azimuth = 35.0f * degree, .elevation = 12.0f * degree, .distance = 4.0f, .floor = -INFINITY, .back = 1.0f};
}

void camera_lamp(const struct camera *camera, float from[3])
{
    const struct axes axes = camera_axes(camera);
    vec3s lamp = along(&axes, -0.39955f, 0.79910f, 0.44949f);
    glm_vec3_copy(lamp.raw, from);
}

/// near and far scale with the distance, so that depth is equally precise for scenes of any size.
void camera_matrices(const struct camera *camera, float aspect, float view[16], float projection[16], float eye[3])
{
    const struct axes axes = camera_axes(camera);
    vec3s from = glms_vec3_muladds(axes.back, camera->distance, vec3_from(camera->target));
    glm_vec3_copy(from.raw, eye);
    for (int k = 0; k < 3; k++) {
        view[4 * k] = axes.right.raw[k];
        view[4 * k + 1] = axes.up.raw[k];
        view[4 * k + 2] = axes.back.raw[k];
        view[4 * k + 3] = 0.0f;
    }
    view[12] = -glms_vec3_dot(axes.right, from);
    view[13] = -glms_vec3_dot(axes.up, from);
    view[14] = -glms_vec3_dot(axes.back, from);
    view[15] = 1.0f;
    const float near = 0.05f * camera->distance;
    const float far = 20.0f * camera->distance + fminf(10.0f, 1000.0f * camera->distance);
    memset(projection, 0, 16 * sizeof *projection);
    projection[0] = 1.0f / (HALF_FIELD * aspect);
    projection[5] = 1.0f / HALF_FIELD;
    projection[10] = (far + near) / (near - far);
    projection[11] = -1.0f;
    projection[14] = 2.0f * far * near / (near - far);
}

/// For one axis of the picture, with points at (across, depth towards the eye) from the target: how far the eye must be to see all of them
/// within `slope`, and how to shift the target to centre them.
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

/// A point (u, w) is in view if |u − shift| ≤ slope·(distance − w). So distance ≥ (max(u + slope·w) − min(u − slope·w)) / 2·slope, and shift
/// is halfway. Swinging things fill the centre of their box, not its corners.
void camera_fit(struct camera *camera, const float lo[3], const float hi[3], float aspect, float top)
{
    const vec3s size = glms_vec3_sub(vec3_from(hi), vec3_from(lo));
    for (int k = 0; k < 3; k++) {
        if (!(size.raw[k] > 0.0f && size.raw[k] < INFINITY)) return;
    }
    const struct axes axes = camera_axes(camera);
    float right[EDGES], up[EDGES], depth[EDGES], shift_right, shift_up;
    for (int e = 0; e < EDGES; e++) {
        vec3s middle; // of an edge, relative to the box's centre
        const int axis = e / 4;
        middle.raw[axis] = 0.0f;
        middle.raw[(axis + 1) % 3] = (e & 1 ? 0.5f : -0.5f) * size.raw[(axis + 1) % 3];
        middle.raw[(axis + 2) % 3] = (e & 2 ? 0.5f : -0.5f) * size.raw[(axis + 2) % 3];
        right[e] = glms_vec3_dot(axes.right, middle);
        up[e] = glms_vec3_dot(axes.up, middle);
        depth[e] = glms_vec3_dot(axes.back, middle);
    }
    const float wide = fit_axis(right, depth, HALF_FIELD * aspect / FIT_MARGIN, &shift_right);
    top = glm_clamp(top, 0.0f, 0.5f);
    const float high = fit_axis(up, depth, HALF_FIELD * (1.0f - top) / FIT_MARGIN, &shift_up);
    camera->distance = glm_clamp(fmaxf(wide, high), MIN_DISTANCE, MAX_DISTANCE);
    camera->aspect = aspect * fminf(wide / camera->distance, 1.0f);
    camera->back = 1.0f;
    shift_up += top * HALF_FIELD * camera->distance; // centre of the free part
    camera->floor = lo[1];
    vec3s target = glms_vec3_center(vec3_from(lo), vec3_from(hi));
    target = glms_vec3_muladds(axes.up, shift_up, glms_vec3_muladds(axes.right, shift_right, target));
    glm_vec3_copy(target.raw, camera->target);
}

void camera_reshape(struct camera *camera, float aspect)
{
    const float back = fmaxf(camera->aspect / aspect, 1.0f);
    if (back != camera->back) camera_zoom(camera, back / camera->back);
    camera->back = back;
}

/// Vectors, not matrices: drags on the screen change documents, and cglm's matrix products round differently on different machines.
bool camera_project(const float view[16], const float projection[16], const float viewport[4], const float world[3],
                    float screen[2])
{
    vec3s eye = glms_vec3_scale(vec3_from(view), world[0]);
    eye = glms_vec3_muladds(vec3_from(view + 4), world[1], eye);
    eye = glms_vec3_muladds(vec3_from(view + 8), world[2], eye);
    eye = glms_vec3_add(eye, vec3_from(view + 12));
    const float depth = -eye.z;
    if (!(depth > 1e-6f)) return false;
    screen[0] = viewport[0] + viewport[2] * (0.5f + 0.5f * projection[0] * eye.x / depth);
    screen[1] = viewport[1] + viewport[3] * (0.5f - 0.5f * projection[5] * eye.y / depth);
    return true;
}

float camera_depth(const float view[16], const float eye[3], const float world[3])
{
    const vec3s back = {{view[2], view[6], view[10]}};
    return glms_vec3_dot(glms_vec3_sub(vec3_from(eye), vec3_from(world)), back);
}

void camera_ray(const float view[16], const float projection[16], const float viewport[4], const float screen[2],
                float direction[3])
{
    const vec3s eye = {{(2.0f * (screen[0] - viewport[0]) / viewport[2] - 1.0f) / projection[0],
                        (1.0f - 2.0f * (screen[1] - viewport[1]) / viewport[3]) / projection[5], -1.0f}};
    const float length = glms_vec3_norm(eye);
    for (int k = 0; k < 3; k++) direction[k] = glms_vec3_dot(vec3_from(view + 4 * k), eye) / length;
}

/// From below, the ground would hide nothing and cover everything.
static void stay_above_floor(struct camera *camera)
{
    const float least = (camera->floor - camera->target[1]) / camera->distance + LEAST_HEIGHT;
    if (least > maths_sinf(camera->elevation))
        camera->elevation = fminf(maths_asinf(fminf(least, 1.0f)), CAMERA_MAX_ELEVATION);
}

void camera_orbit(struct camera *camera, float azimuth, float elevation)
{
    camera->azimuth = remainderf(camera->azimuth + azimuth, 6.28318531f);
    camera->elevation = glm_clamp(camera->elevation + elevation, -CAMERA_MAX_ELEVATION, CAMERA_MAX_ELEVATION);
    stay_above_floor(camera);
}

void camera_pan(struct camera *camera, float dx, float dy, float height)
{
    const struct axes axes = camera_axes(camera);
    const float metres = 2.0f * HALF_FIELD * camera->distance / fmaxf(height, 1.0f);
    vec3s target = glms_vec3_muladds(along(&axes, -dx, dy, 0.0f), metres, vec3_from(camera->target));
    glm_vec3_copy(target.raw, camera->target);
    stay_above_floor(camera);
}

void camera_zoom(struct camera *camera, float factor)
{
    camera->distance = glm_clamp(camera->distance * factor, MIN_DISTANCE, MAX_DISTANCE);
    stay_above_floor(camera);
}
