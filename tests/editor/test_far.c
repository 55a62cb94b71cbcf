/// A curve that one pose sends far beyond its knots: said at once, also while it is dragged on the stage, and held by one click.
#include "panel_session.h"

/// A jump within a frame, in a scene of that last frame; with more in the spline, and before it in the list.
static void print_jump(int last, const char *more, const char *before, char text[1024])
{
    snprintf(
        text, 1024,
        "{\"wiggly\": 2, \"frames\": [0, %d], \"splines\": [%s{\"name\": \"sway\", \"frequency\": 1, \"damping\": "
        "0.05, \"bandwidth\": 0.05%s, \"knots\": [{\"frame\": 10, \"value\": 0},"
        "{\"frame\": 11, \"value\": 1}, {\"frame\": 24, \"value\": 1}]}]}",
        last, before, more);
}

static struct document *jump(int last, const char *more, const char *before)
{
    char text[1024];
    print_jump(last, more, before, text);
    return document_of_text(text);
}

/// How far a spline's curve and its knots are from 0 at most.
static double farthest(const struct session *s, int spline, double *knot)
{
    double most = 0;
    const struct spline *of = s->document->splines[spline];
    for (int i = 0; i < s->work.evaluation.samples; i++)
        most = fmax(most, fabs(s->work.evaluation.curves[spline].total[i]));
    *knot = 0;
    for (int k = 0; k < of->knot_count; k++) *knot = fmax(*knot, fabs(of->knots[k].value));
    return most;
}

/// The tail dragged far up just behind a knot that stays: a whole curve of the sway is sent to three times its other knots.
static void drag_far(struct session *s)
{
    s->mods = MOD_ALT;
    playback_of(s->editor)->position = 84;
    session_frame(s);
    session_pull(s, "tail(tail,0.3)", 0, -300, 12);
    for (int i = 0; i < 60; i++) session_frame(s);
    s->mods = 0;
}

/// The start scene as it was before wind-up.
static const char whole[] = "tests/replays/session.json";

SESSION_TEST(test_a_drag_on_the_stage_says_that_the_curve_swings_far, session_open_file(s, whole))
{
    double knot;
    assert_int_equal(warnings_of(s->editor)->count, 0);
    drag_far(s);
    assert_true(is_dragging(s->editor));
    assert_true(farthest(s, 0, &knot) > 2.5 * knot && farthest(s, 1, &knot) > 4);
    assert_int_equal(warnings_of(s->editor)->count,
                     2); // the active curve, and the other one that the tail follows
    for (int i = 0; i < 2; i++) {
        assert_int_equal(warnings_of(s->editor)->list[i].kind, WARNING_FAR);
        assert_int_equal(warnings_of(s->editor)->list[i].spline, i);
    }
}

/// With wind-up the same drag stays within twice what it sets.
SESSION_TEST(test_the_start_scene_bears_the_same_drag, session_open_file(s, "assets/scenes/tail.json"))
{
    double knot;
    drag_far(s);
    assert_true(is_dragging(s->editor));
    for (int i = 0; i < 2; i++) assert_true(farthest(s, i, &knot) < 2 * knot);
    assert_int_equal(warnings_of(s->editor)->count, 0);
}

/// One click leaves what swings least, as one step.
SESSION_TEST(test_one_click_holds_what_swings_far, session_open_file(s, whole))
{
    double knot;
    drag_far(s);
    session_release(s, BUTTON_LEFT);
    const char *dragged = session_saved(s);
    session_hover(s, "warning(0)");
    session_frame(s);
    assert_ptr_equal(hovered(s->editor), &thing_warning);
    assert_string_equal(s->editor->curves->fixes[0].text, "set limits from -1.3 to 1.3");
    session_click(s, "warning(0)");
    session_frame(s);
    assert_true(farthest(s, 0, &knot) < 1.3 * knot);
    session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, dragged);
}

/// A scene too long for limits: W adds a pose at the peak, outside complex mode a knot.
TEST(test_a_pose_at_the_peak_holds_where_limits_cannot)
{
    static const char *const modes[] = {", \"mode\": \"real\"", ""};
    for (int is_complex = 0; is_complex < 2; is_complex++) {
        char scene[1024];
        double knot;
        struct session s;
        print_jump(25000, modes[is_complex], "", scene);
        session_open(&s, scene);
        const char *original = session_saved(&s);
        const double before = farthest(&s, 0, &knot);
        session_key(&s, 'W', 0);
        const struct spline *sway = s.document->splines[0];
        assert_int_equal(sway->knot_count, 4);
        const struct knot *added = &sway->knots[2];
        assert_true(added->has_phase == is_complex && (added->phase != 0) == is_complex);
        assert_near(fabs(added->value), 1, 1e-12);
        assert_true(farthest(&s, 0, &knot) < before);
        session_key(&s, 'Z', MOD_CTRL);
        assert_saved(&s, original);
        session_close(&s);
    }
}

/// What is said of the last spline of a scene, which then ends.
static struct warnings found_far(struct document *document)
{
    struct evaluation evaluation = {0};
    struct warnings found = {0};
    evaluation_update(&evaluation, document, false);
    warnings_add_far(document, &evaluation, document->spline_count - 1, &found);
    evaluation_free(&evaluation);
    document_destroy(document);
    return found;
}

/// Poses at which the curve passes through 0 as fast as it swings.
static struct document *passed_through_0(void)
{
    return document_of_text(
        "{\"wiggly\": 2, \"frames\": [0, 72], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"knots\": "
        "[{\"frame\": 12, \"value\": 0.1, \"im\": 1}, {\"frame\": 36, \"value\": 0.1, \"im\": 1}]}]}");
}

TEST(test_limits_moving_equilibria_and_poses_are_not_far)
{
    static const char *const moving = "{\"name\": \"base\", \"mode\": \"cubic\", \"knots\": [{\"frame\": 0, "
                                      "\"value\": 0}, {\"frame\": 60, \"value\": 3}]},";
    assert_int_equal(found_far(jump(72, "", "")).count, 1);
    assert_int_equal(found_far(jump(72, ", \"limits\": [null, 9]", "")).count, 0);
    assert_int_equal(found_far(jump(72, ", \"equilibrium\": {\"spline\": \"base\"}", moving)).count, 0);
    assert_int_equal(found_far(jump(72, ", \"mode\": \"cubic\"", "")).count, 0);
    assert_int_equal(found_far(passed_through_0()).count, 0);
}

TEST(test_the_largest_knot_is_measured_from_the_equilibrium)
{
    const struct warnings found = found_far(jump(72, ", \"equilibrium\": -0.2", ""));
    assert_int_equal(found.count, 1);
    assert_near(fabs(found.list[0].remedy + 0.2), 1.2, 1e-12);
    assert_true(found.list[0].low < -1.4 && found.list[0].low > -2);
}
