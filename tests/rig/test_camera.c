/// The stage's camera: what it is fitted to is in view, and what it shows lies where it says.
#include "model/vector.h"
#include "near.h"
#include "rig/camera.h"

static const float viewport[4] = {100.0f, 50.0f, 1000.0f, 400.0f};
static const float lo[3] = {-1.0f, 0.0f, -0.7f}, hi[3] = {1.1f, 1.3f, 1.5f};

struct plotted {
    float view[16], projection[16], eye[3];
};

static struct plotted look(const struct camera *camera)
{
    struct plotted view;
    camera_matrices(camera, viewport[2] / viewport[3], view.view, view.projection, view.eye);
    return view;
}

static bool project(const struct plotted *view, const float world[3], float screen[2])
{
    return camera_project(view->view, view->projection, viewport, world, screen);
}

/// A ray through where a point is seen leads from the eye to it; its depth is along the view axis.
TEST(rays_lead_back_to_what_is_projected)
{
    for (int i = 0; i < 27; i++) {
        struct camera camera = camera_default();
        camera_orbit(&camera, 0.7f * (float)i, 0.05f * (float)i - 0.6f);
        camera_pan(&camera, 31.0f, 17.0f, 400.0f);
        const struct plotted view = look(&camera);
        const float point[3] = {0.3f * (float)(i % 3 - 1), 0.2f * (float)(i / 3 % 3), 0.4f * (float)(i / 9 - 1)};
        const vec3s way = glms_vec3_sub(vec3_from(point), vec3_from(view.eye));
        const vec3s axis = glms_vec3_normalize(glms_vec3_sub(vec3_from(camera.target), vec3_from(view.eye)));
        float screen[2], ray[3], lamp[3];
        assert_true(project(&view, point, screen));
        camera_ray(view.view, view.projection, viewport, screen, ray);
        assert_near(glms_vec3_norm(vec3_from(ray)), 1, 1e-6);
        assert_near(glms_vec3_dot(vec3_from(ray), glms_vec3_normalize(way)), 1, 1e-5);
        assert_near(camera_depth(view.view, view.eye, point), glms_vec3_dot(way, axis), 1e-5);
        camera_lamp(&camera, lamp); // to the left, above, and behind the eye
        assert_near(glms_vec3_norm(vec3_from(lamp)), 1, 2e-4);
        assert_near(-glms_vec3_dot(vec3_from(lamp), axis), 0.44949, 1e-4);
        const vec3s right = glms_vec3_normalize(glms_vec3_cross(axis, (vec3s){.raw = {0, 1, 0}}));
        assert_near(glms_vec3_dot(vec3_from(lamp), right), -0.39955, 1e-4);
        assert_true(lamp[1] > 0);
    }
}

TEST(the_target_is_in_the_middle_with_y_up_and_z_to_the_left)
{
    struct camera camera = camera_default();
    camera.target[1] = 0.7f;
    const struct plotted view = look(&camera);
    const float up[3] = {0.0f, 1.0f, 0.0f}, z[3] = {0.0f, 0.7f, 0.5f};
    float middle[2], above[2], along[2], behind[3], screen[2];
    assert_true(project(&view, camera.target, middle) && project(&view, up, above) && project(&view, z, along));
    assert_near(middle[0], 600.0, 1e-2);
    assert_near(middle[1], 250.0, 1e-2);
    assert_near(above[0], middle[0], 1e-2);
    assert_true(above[1] < middle[1] - 10.0f);
    assert_true(along[0] < middle[0] - 10.0f); // the tail points to the left
    for (int k = 0; k < 3; k++) behind[k] = 2.0f * view.eye[k];
    assert_false(project(&view, behind, screen));
    assert_near(glms_vec3_norm(vec3_from(camera_default().target)), 0, 0);
    assert_near(glms_vec3_distance(vec3_from(view.eye), vec3_from(camera.target)), 4, 1e-5);
    assert_near(view.eye[1] - 0.7f, 4 * sin(12 * M_PI / 180), 1e-5);
    assert_near(atan2((double)-view.eye[2], (double)view.eye[0]), 35 * M_PI / 180, 1e-5);
}

/// From a sixteenth of the distance to the target, where a hand reaches towards the eye, to far behind it, in a scene of any size.
TEST(what_is_near_or_far_is_not_cut_off)
{
    static const float sizes[] = {0.01f, 4.0f, 1000.0f}, seen[] = {0.0625f, 1.0f, 19.0f};
    for (int i = 0; i < 9; i++) {
        struct camera camera = camera_default();
        camera_zoom(&camera, sizes[i / 3] / camera.distance);
        const struct plotted view = look(&camera);
        const float away = seen[i % 3] * camera.distance;
        const float depth = (view.projection[14] - view.projection[10] * away) / away;
        assert_true(depth > -1.0f && depth < 1.0f);
    }
}

/// How far the middles of the edges of the fitted box reach, as parts of the picture from its middle: to the left, right, top and bottom.
static void reach(const struct camera *camera, float width, float height, float out[4])
{
    const float picture[4] = {0, 0, width, height};
    struct plotted view;
    camera_matrices(camera, width / height, view.view, view.projection, view.eye);
    for (int k = 0; k < 4; k++) out[k] = -INFINITY;
    for (int edge = 0; edge < 12; edge++) {
        float place[3], screen[2];
        const int axis = edge / 4;
        for (int k = 0; k < 3; k++) place[k] = edge >> (k == (axis + 1) % 3) & 1 ? hi[k] : lo[k];
        place[axis] = 0.5f * (lo[axis] + hi[axis]);
        assert_true(camera_project(view.view, view.projection, picture, place, screen));
        const float x = 2 * screen[0] / width - 1, y = 2 * screen[1] / height - 1, parts[] = {-x, x, -y, y};
        for (int k = 0; k < 4; k++) out[k] = fmaxf(out[k], parts[k]);
    }
}

/// From any side, with 15 % to spare, below what is kept free at the top; a narrower picture shows it too, and the first one looks as before.
TEST(a_fitted_box_fills_the_picture)
{
    for (int step = 0; step < 24; step++) {
        struct camera camera = camera_default();
        const float top = 0.2f * (float)(step % 3);
        float parts[4];
        camera_orbit(&camera, 0.26f * (float)step, 0.1f * (float)(step % 12) - 0.4f);
        camera_fit(&camera, lo, hi, viewport[2] / viewport[3], top);
        reach(&camera, viewport[2], viewport[3], parts);
        const float above = (parts[2] + top) / (1 - top), below = (parts[3] - top) / (1 - top);
        const float least = fmaxf(fminf(parts[0], parts[1]), fminf(above, below)); // of what fills it, on both sides
        const float most = fmaxf(fmaxf(parts[0], parts[1]), fmaxf(above, below));
        assert_near(least, 1 / 1.15, top > 0 ? 0.16 : 1e-3); // what is moved down moves farther where it is near
        assert_near(most, 1 / 1.15, top > 0 ? 0.16 : 1e-3);
        const float distance = camera.distance;
        camera_reshape(&camera, 1 / 3.0f);
        reach(&camera, 100, 300, parts);
        for (int k = 0; k < 4; k++) assert_true(parts[k] < 1);
        camera_reshape(&camera, 2.5f);
        assert_near(camera.distance, distance, 1e-5);
    }
}

TEST(a_broken_box_changes_nothing)
{
    static const float broken[][3] = {{1, 0, 1}, {1, INFINITY, 1}, {1, 1, NAN}, {-2, 1, 1}};
    for (int b = 0; b < 4; b++) {
        struct camera camera = camera_default(), before = camera;
        camera_fit(&camera, lo, broken[b], 2.5f, 0);
        assert_memory_equal(&camera, &before, sizeof camera);
    }
}

/// The point of the world under the pointer stays under it while the view is dragged.
TEST(panning_follows_the_pointer)
{
    struct camera camera = camera_default();
    const float target[3] = {camera.target[0], camera.target[1], camera.target[2]};
    camera_pan(&camera, 60.0f, -25.0f, viewport[3]);
    const struct plotted view = look(&camera);
    float screen[2];
    assert_true(project(&view, target, screen));
    assert_near(screen[0], 660.0, 0.1);
    assert_near(screen[1], 225.0, 0.1);
}

TEST(orbit_and_zoom_stay_in_range)
{
    struct camera camera = camera_default();
    camera_orbit(&camera, 100.0f, 100.0f);
    assert_near(camera.elevation, CAMERA_MAX_ELEVATION, 1e-6);
    assert_true(fabsf(camera.azimuth) < 3.2f);
    camera_orbit(&camera, 0, -100.0f);
    assert_near(camera.elevation, -CAMERA_MAX_ELEVATION, 1e-6);
    camera_zoom(&camera, 1e9f);
    assert_near(camera.distance, 1e5, 1);
    camera_zoom(&camera, 1e-9f);
    assert_near(camera.distance, 1e-4, 1e-9);
}

/// However one orbits, pans and zooms.
TEST(the_eye_stays_above_the_floor)
{
    struct camera camera = camera_default();
    const float low[3] = {-1.0f, -0.5f, -1.0f}, high[3] = {1.0f, 1.0f, 1.0f};
    camera_fit(&camera, low, high, 1.6f, 0);
    for (int step = 0; step < 60; step++) {
        if (step % 3 == 0) camera_orbit(&camera, 0.3f, -0.4f);
        if (step % 3 == 1) camera_pan(&camera, 3.0f, step < 30 ? -20.0f : 10.0f, 400.0f);
        if (step % 3 == 2) camera_zoom(&camera, step % 2 ? 1.4f : 0.8f);
        const struct plotted view = look(&camera);
        const float height = (view.eye[1] - low[1]) / camera.distance; // at least 2 % of the distance
        if (camera.elevation < CAMERA_MAX_ELEVATION) assert_true(height > 0.0199f);
    }
}
