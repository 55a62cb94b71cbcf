/// Slopes of knots in the curves panel: by keys, by buttons, and by pulling their handles.
#include "five_knots.h"
#include "panel_session.h"

SESSION_TEST(test_slopes_flat_and_smooth, session_open(s, FIVE))
{
    session_key(s, 'A', MOD_CTRL);
    const char *original = session_saved(s);
    session_key(s, 'T', MOD_CTRL);
    assert_near(spline(s, 0)->knots[0].slope, (1.0 - 0) / 10 * 24, 1e-2); // only one neighbour
    assert_near(spline(s, 0)->knots[2].slope, (0.5 - 1) / 20 * 24, 1e-2);
    assert_near(spline(s, 0)->knots[3].slope, (0.0 + 1) / 30 * 24, 1e-2);
    assert_one_step(s, original);
    original = session_saved(s);
    session_key(s, 'T', MOD_SHIFT);
    for (int k = 0; k < 5; k++) {
        assert_true(spline(s, 0)->knots[k].has_slope);
        assert_near(spline(s, 0)->knots[k].slope, 0, 0);
    }
    assert_one_step(s, original);
    panel_click(s, "slope.smooth"); // the same by the inspector's buttons
    assert_near(spline(s, 0)->knots[0].slope, (1.0 - 0) / 10 * 24, 1e-2);
    panel_click(s, "slope.switch");
    for (int k = 0; k < 5; k++) assert_false(spline(s, 0)->knots[k].has_slope);
}

SESSION_TEST(test_a_longer_handle_is_stiffer, session_open(s, FIVE))
{
    session_click(s, "knot(sway,1)");
    float x = s->x, y = s->y;
    session_point(s, "handle(sway,1,1)");
    float along[2] = {(s->x - x) / hypotf(s->x - x, s->y - y), (s->y - y) / hypotf(s->x - x, s->y - y)};
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 6 * along[0], 6 * along[1], 3);
    assert_near(spline(s, 0)->knots[1].stiffness, 1000, 0); // a hand is not that steady
    session_drag(s, 26 * along[0], 26 * along[1], 5);
    assert_near(spline(s, 0)->knots[1].stiffness, 100000, 10000); // 24 pixels are two powers of ten
    assert_near(spline(s, 0)->knots[1].slope, 2, 0.05);
    session_drag(s, -64 * along[0], -64 * along[1], 5);
    assert_true(spline(s, 0)->knots[1].stiffness < 50);
    session_release(s, BUTTON_LEFT);
}

/// A handle that is pulled past its knot stays steep on its own side.
SESSION_TEST(test_a_handle_does_not_flip, session_open(s, FIVE))
{
    session_click(s, "knot(sway,1)");
    session_pull(s, "handle(sway,1,1)", -150, -40, 8);
    assert_true(spline(s, 0)->knots[1].slope > 20);
    session_release(s, BUTTON_LEFT);
    session_pull(s, "handle(sway,1,0)", 150, 100, 8);
    assert_true(spline(s, 0)->knots[1].slope > 20);
    session_release(s, BUTTON_LEFT);
}

/// Of handles that nearly touch the one under the pointer is pulled.
TEST(test_the_nearest_handle_is_pulled)
{
    static const char close[] =
        "{\"wiggly\": 1, \"frames\": [0, 240], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
        "\"damping\": 0.1, \"knots\": [{\"frame\": 100, \"value\": 0, \"slope\": 0}, {\"frame\": 101, \"value\": 0,"
        "\"slope\": 0}]}]}";
    for (int k = 0; k < 2; k++) {
        struct session s;
        session_open(&s, close);
        session_key(&s, 'A', MOD_CTRL);
        session_pull(&s, k ? "handle(sway,1,1)" : "handle(sway,0,1)", 0, -60, 5);
        session_release(&s, BUTTON_LEFT);
        assert_true(spline(&s, 0)->knots[k].slope > 0.1);
        assert_near(spline(&s, 0)->knots[1 - k].slope, 0, 0);
        session_close(&s);
    }
}

static const char LOOP[] =
    "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"start\": \"loop\","
    "\"frequency\": {\"spline\": \"pace\"}, \"equilibrium\": {\"spline\": \"base\"},"
    "\"knots\": [{\"frame\": 8, \"value\": 1}, {\"frame\": 30, \"value\": -1}]},"
    "{\"name\": \"pace\", \"mode\": \"cubic\", \"start\": \"loop\", \"knots\": [{\"frame\": 0, \"value\": 1},"
    "{\"frame\": 24, \"value\": 2}]}, {\"name\": \"base\", \"mode\": \"cubic\", \"start\": \"loop\","
    "\"knots\": [{\"frame\": 5, \"value\": 0}, {\"frame\": 20, \"value\": 1}]}]}";

/// The slope that a curve has does not change it, in a loop that swings about a moving equilibrium with a varying frequency, too.
SESSION_TEST(test_a_slope_of_a_varying_loop_is_the_curves, session_open(s, LOOP))
{
    double before[49];
    memcpy(before, s->work.evaluation.curves[0].total, sizeof before);
    session_key(s, 'A', MOD_CTRL);
    session_key(s, 'T', 0);
    assert_true(spline(s, 0)->knots[0].has_slope && spline(s, 0)->knots[0].slope != 0);
    for (int i = 0; i < 49; i++)
        assert_near(s->work.evaluation.curves[0].total[i], before[i], 1e-4); // slopes are rounded
}
