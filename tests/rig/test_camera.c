/// The stage's camera: what it is fitted to is in view, and what it shows lies where it says.
#include "near.h"
#include "rig/camera.h"

static const float viewport[4] = {100.0f, 50.0f, 1000.0f, 400.0f};

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

TEST(the_target_is_in_the_middle_with_y_up_and_z_to_the_left)
{
    struct camera camera = camera_default();
    camera.target[1] = 0.7f;
    const struct plotted view = look(&camera);
    float middle[2], above[2], along[2];
    const float up[3] = {0.0f, 1.0f, 0.0f}, z[3] = {0.0f, 0.7f, 0.5f};
    assert_true(project(&view, camera.target, middle));
    assert_near(middle[0], 600.0, 1e-2);
    assert_near(middle[1], 250.0, 1e-2);
    assert_true(project(&view, up, above) && above[1] < middle[1] - 10.0f);
    assert_near(above[0], middle[0], 1e-2);
    assert_true(project(&view, z, along) && along[0] < middle[0] - 10.0f); // the tail points to the left
}

TEST(points_behind_the_eye_are_not_projected)
{
    const struct camera camera = camera_default();
    const struct plotted view = look(&camera);
    const float behind[3] = {2.0f * view.eye[0], 2.0f * view.eye[1], 2.0f * view.eye[2]};
    float screen[2];
    assert_false(project(&view, behind, screen));
}

/// From a sixteenth of the distance to the target, where a hand reaches towards the eye, to far behind it, in a scene of any size.
TEST(what_is_near_or_far_is_not_cut_off)
{
    static const float sizes[] = {0.01f, 4.0f, 1000.0f}, seen[] = {0.0625f, 1.0f, 19.0f};
    for (int s = 0; s < 3; s++) {
        struct camera camera = camera_default();
        camera_zoom(&camera, sizes[s] / camera.distance);
        const struct plotted view = look(&camera);
        for (int i = 0; i < 3; i++) {
            const float away = seen[i] * camera.distance;
            const float depth = (view.projection[14] - view.projection[10] * away) / away;
            assert_true(depth > -1.0f && depth < 1.0f);
        }
    }
}

TEST(a_fitted_box_fills_the_picture_from_any_side)
{
    const float lo[3] = {-1.0f, 0.0f, -0.7f}, hi[3] = {1.1f, 1.3f, 1.5f};
    for (int step = 0; step < 24; step++) {
        struct camera camera = camera_default();
        camera_orbit(&camera, 0.26f * (float)step, 0.1f * (float)(step % 12) - 0.4f);
        camera_fit(&camera, lo, hi, viewport[2] / viewport[3], 0);
        const struct plotted view = look(&camera);
        float outermost = 0.0f;
        for (int k = 0; k < 3; k++) {
            for (int side = 0; side < 2; side++) {
                float face[3] = {0.5f * (lo[0] + hi[0]), 0.5f * (lo[1] + hi[1]), 0.5f * (lo[2] + hi[2])}, screen[2];
                face[k] = side ? hi[k] : lo[k];
                assert_true(project(&view, face, screen));
                const float x = fabsf(screen[0] - 600.0f) / 500.0f, y = fabsf(screen[1] - 250.0f) / 200.0f;
                outermost = fmaxf(outermost, fmaxf(x, y));
            }
        }
        assert_true(outermost < 0.9f && outermost > 0.4f);
    }
}

/// A narrower picture shows what was fitted, and the first one looks as before.
TEST(a_picture_of_another_shape_shows_what_was_fitted)
{
    const float lo[3] = {-1.0f, 0.0f, -0.7f}, hi[3] = {1.1f, 1.3f, 1.5f}, narrow[4] = {0, 0, 100, 300};
    struct camera camera = camera_default();
    camera_fit(&camera, lo, hi, 2.5f, 0);
    const float distance = camera.distance;
    camera_reshape(&camera, narrow[2] / narrow[3]);
    struct plotted view;
    camera_matrices(&camera, narrow[2] / narrow[3], view.view, view.projection, view.eye);
    for (int face = 0; face < 6; face++) {
        float place[3], screen[2];
        for (int k = 0; k < 3; k++) place[k] = face / 2 == k ? (face % 2 ? hi : lo)[k] : 0.5f * (lo[k] + hi[k]);
        assert_true(camera_project(view.view, view.projection, narrow, place, screen));
        assert_true(screen[0] > 5 && screen[0] < 95 && screen[1] > 5 && screen[1] < 295);
    }
    camera_reshape(&camera, 2.5f);
    assert_near(camera.distance, distance, 1e-5);
}

TEST(a_broken_box_changes_nothing)
{
    const float lo[3] = {0.0f, 0.0f, 0.0f}, flat[3] = {1.0f, 0.0f, 1.0f}, endless[3] = {1.0f, INFINITY, 1.0f};
    struct camera camera = camera_default();
    camera_fit(&camera, lo, flat, 2.5f, 0);
    camera_fit(&camera, lo, endless, 2.5f, 0);
    assert_near(camera.distance, camera_default().distance, 0.0);
    assert_near(camera.target[0], 0.0, 0.0);
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
    camera_zoom(&camera, 1e9f);
    assert_near(camera.distance, 1e5, 1);
    camera_zoom(&camera, 1e-9f);
    assert_near(camera.distance, 1e-4, 1e-9);
}

/// However one orbits, pans and zooms.
TEST(the_eye_stays_above_the_floor)
{
    struct camera camera = camera_default();
    const float lo[3] = {-1.0f, -0.5f, -1.0f}, hi[3] = {1.0f, 1.0f, 1.0f};
    camera_fit(&camera, lo, hi, 1.6f, 0);
    for (int step = 0; step < 60; step++) {
        float view[16], projection[16], eye[3];
        if (step % 3 == 0) camera_orbit(&camera, 0.3f, -0.4f);
        if (step % 3 == 1) camera_pan(&camera, 3.0f, step < 30 ? -20.0f : 10.0f, 400.0f);
        if (step % 3 == 2) camera_zoom(&camera, step % 2 ? 1.4f : 0.8f);
        camera_matrices(&camera, 1.6f, view, projection, eye);
        if (camera.elevation < CAMERA_MAX_ELEVATION) assert_true(eye[1] > lo[1]);
    }
}
