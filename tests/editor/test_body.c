/// The body dragged by hand: it goes along at once, its tail follows through, and the document gets one step at the end.
#include "panel_session.h"

#include "editor/stage/state.h"

static const char scene[] = "{\"frames\": [0, 48], \"splines\": ["
                            "{\"name\": \"sway\", \"frequency\": 1.5, \"damping\": 0.2, \"bandwidth\": "
                            "0.1},{\"name\": \"walk\", \"mode\": \"cubic\", \"knots\": [{\"frame\": 0, \"value\": "
                            "0.1}, {\"frame\": 48, \"value\": 0.1}]}],\"rigs\": [{\"type\": \"tail\", \"name\": "
                            "\"tail\", \"position\": [0, 0.26, 0], \"channels\": [{\"spline\": \"sway\"}]}]}";

enum { JOINTS = 24, X = 12, Y = 13, Z = 14 };

static const float *joint(const struct session *s, int n) { return posed(s->editor)->matrix[n]; }

/// Takes hold of the body and moves the pointer along the screen; the button stays down.
static void hold_and_drag(struct session *s, float dx, float dy, int steps)
{
    session_hover(s, "body(tail)");
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, dx, dy, steps);
}

SESSION_TEST(test_tail_follows_through_and_settles, session_open(s, scene))
{
    const char *before = session_saved(s);
    hold_and_drag(s, -150, 0, 12);
    float base = joint(s, 0)[X], trailing = joint(s, JOINTS)[X] - base;
    assert_true(base > 0.1f);       // the pointer went to the left, where +x is
    assert_true(trailing < -0.05f); // the tip stayed behind
    assert_saved(s, before);        // the document waits
    session_release(s, BUTTON_LEFT);
    assert_near(joint(s, 0)[X], base, 1e-3);
    assert_near(document_tail(s->document, 0)->position[0].value, base, 1e-3);
    float overshoot = -1;
    for (int i = 0; i < 60; i++) {
        session_frame(s);
        overshoot = fmaxf(overshoot, joint(s, JOINTS)[X] - joint(s, 0)[X]);
    }
    assert_true(overshoot > 0.05f); // and swung past
    assert_true(editor_wants_frames(s->editor));
    for (int i = 0; i < 60 * 20; i++) session_frame(s);
    assert_false(editor_wants_frames(s->editor));
    assert_near(joint(s, JOINTS)[X], joint(s, 0)[X], 0); // hangs still: exactly nothing is left
    assert_string_equal(history_undo_label(s->history), "Move body");
    session_key(s, 'Z', MOD_CTRL);
    assert_null(history_undo_label(s->history));
    assert_saved(s, before);
}

/// A body whose way begins at a still knot: a drag with auto-key gives it a value, one of the whole shot takes it along.
static const char still[] =
    "{\"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"frequency\": 1.5, \"damping\": 0.2},"
    "{\"name\": \"walk\", \"mode\": \"cubic\", \"equilibrium\": 0.05, \"knots\": [{\"frame\": 0, \"still\": true}, "
    "{\"frame\": 48, \"value\": 0.1}]}], \"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", "
    "\"position\": [{\"spline\": \"walk\"}, 0.26, 0], \"channels\": [{\"spline\": \"sway\"}]}]}";

SESSION_TEST(test_a_still_knot_under_a_dragged_body_gets_a_value, session_open(s, still))
{
    hold_and_drag(s, -150, 0, 12);
    session_release(s, BUTTON_LEFT);
    assert_false(s->document->splines[1]->knots[0].still);
    assert_true(s->document->splines[1]->knots[0].value > 0.1);
}

SESSION_TEST(test_a_still_knot_goes_along_with_the_whole_shot, session_open(s, still))
{
    session_click(s, "knot(walk,1)");
    session_key(s, 'D', MOD_CTRL);
    session_key(s, 'P', MOD_SHIFT); // with a value that it keeps
    session_key(s, 'A', MOD_SHIFT);
    hold_and_drag(s, -150, 0, 12);
    session_release(s, BUTTON_LEFT);
    const struct spline *walk = s->document->splines[1];
    const double by = walk->knots[1].value - 0.1;
    assert_true(walk->knots[0].still && by > 0.1);
    assert_near(s->work.evaluation.curves[1].total[0], 0.05 + by, 1e-6);
    assert_true(walk->knots[2].still);
    assert_near(walk->knots[2].value, 0.1 + by, 1e-9);
}

/// Lagged joints come later: each extremum of the bend is at the base first and at the tip last.
SESSION_TEST(test_swing_runs_along_the_tail, session_open(s, scene))
{
    hold_and_drag(s, -150, 0, 3); // so fast that the base has not swung out yet
    session_release(s, BUTTON_LEFT);
    float least_near = 0, least_far = 0;
    int near_at = 0, far_at = 0;
    for (int i = 0; i < 40; i++) {
        float near = atan2f(joint(s, 4)[8], joint(s, 4)[10]) - atan2f(joint(s, 3)[8], joint(s, 3)[10]);
        float far = atan2f(joint(s, 20)[8], joint(s, 20)[10]) - atan2f(joint(s, 19)[8], joint(s, 19)[10]);
        if (near < least_near) near_at = i;
        if (far < least_far) far_at = i;
        least_near = fminf(least_near, near);
        least_far = fminf(least_far, far);
        session_frame(s);
    }
    // 16 joints × 6.5° of a swing of 1.5 Hz: 0.19 s, 11.6 frames
    assert_in_range(far_at - near_at, 8, 15);
}

SESSION_TEST(test_escape_takes_it_back, session_open(s, scene))
{
    const char *before = session_saved(s);
    hold_and_drag(s, 80, 30, 6);
    session_key(s, KEY_ESCAPE, 0);
    session_button(s, BUTTON_LEFT, ACTION_RELEASE, 1);
    session_frame(s);
    assert_near(joint(s, 0)[X], 0, 0);
    assert_near(joint(s, JOINTS)[X], 0, 0);
    assert_false(editor_wants_frames(s->editor));
    assert_saved(s, before);
    assert_null(history_undo_label(s->history));
}

/// A held body may lose its tail, to an edit made meanwhile; letting go of it then changes nothing.
SESSION_TEST(test_a_tail_that_goes_while_held, session_open(s, scene))
{
    hold_and_drag(s, 80, 30, 6);
    assert_done(edit_rig_remove(s->document, 0, &error));
    const char *without = session_saved(s);
    session_button(s, BUTTON_LEFT, ACTION_RELEASE, 1);
    session_frame(s);
    assert_saved(s, without);
}

/// A press in the frame in which an edit takes the tail away finds nothing to take hold of.
static void press_as_it_goes(const char *target)
{
    struct session s;
    session_open(&s, scene);
    session_frame(&s);
    session_point(&s, target);
    history_begin(s.history, "Remove tail", 0);
    assert_done(edit_rig_remove(s.document, 0, &error));
    history_end(s.history);
    const char *without = session_saved(&s);
    session_press(&s, BUTTON_LEFT, 1);
    session_drag(&s, 40, 10, 3);
    session_release(&s, BUTTON_LEFT);
    assert_saved(&s, without);
    session_close(&s);
}

TEST(test_a_press_as_the_tail_goes)
{
    press_as_it_goes("tail(tail,0.5)");
    press_as_it_goes("body(tail)");
}

SESSION_TEST(test_axes_lock_and_shift_is_fine, session_open(s, scene))
{
    hold_and_drag(s, -60, 40, 4);
    assert_true(fabsf(joint(s, 0)[Z]) > 0.05f);
    session_key(s, 'X', 0);
    assert_near(joint(s, 0)[Z], 0, 0);
    assert_true(fabsf(joint(s, 0)[X]) > 0.05f);
    session_key(s, 'Y', 0);
    assert_near(joint(s, 0)[X], 0, 0);
    session_key(s, 'Y', 0);
    float x = joint(s, 0)[X];
    s->mods = MOD_SHIFT;
    session_drag(s, -60, 0, 4);
    float fine = joint(s, 0)[X] - x;
    s->mods = 0;
    session_drag(s, -60, 0, 4);
    assert_near(joint(s, 0)[X] - x - fine, 10 * fine, 1e-3);
    session_release(s, BUTTON_LEFT);
}

/// Where a spline is followed, the drag leaves a knot at the playhead; the other coordinates stay numbers.
static void drag_a_tracked_body(const char *text, int track)
{
    struct session s;
    session_open(&s, text);
    document_tail(s.document, 0)->position[0] = param_track(track);
    const int splines = s.document->spline_count;
    session_key(&s, 'A', MOD_SHIFT);
    session_key(&s, KEY_RIGHT, 0);
    session_key(&s, KEY_RIGHT, 0);
    assert_near(joint(&s, 0)[X], 0.1, 1e-6);
    const char *before = session_saved(&s);
    hold_and_drag(&s, -60, 0, 4);
    session_key(&s, 'X', 0);
    float x = joint(&s, 0)[X];
    session_release(&s, BUTTON_LEFT);
    const struct spline *walk = s.document->splines[track];
    assert_int_equal(s.document->spline_count, splines);
    assert_int_equal(walk->knot_count, 3);
    assert_near(walk->knots[1].frame, 2, 0);
    assert_near(walk->knots[1].value, x, 1e-3);
    assert_near(joint(&s, 0)[X], x, 1e-3);
    assert_near(document_tail(s.document, 0)->position[2].value, 0, 0);
    session_key(&s, 'Z', MOD_CTRL);
    assert_saved(&s, before);
    session_close(&s);
}

TEST(test_a_tracked_body_gets_a_knot)
{
    static const char walk_first[] =
        "{\"frames\": [0, 48], \"splines\": [{\"name\": \"walk\", \"mode\": \"cubic\", \"knots\": [{\"frame\": 0, "
        "\"value\": 0.1}, {\"frame\": 48, \"value\": 0.1}]}, {\"name\": \"sway\", \"frequency\": 1.5}],"
        "\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"position\": [0, 0.26, 0], "
        "\"channels\": [{\"spline\": \"sway\"}]}]}";
    drag_a_tracked_body(scene, 1);
    drag_a_tracked_body(walk_first, 0);
}

/// Without auto-key all of the shot moves: every knot of what the place follows.
SESSION_TEST(test_without_auto_key_the_shot_moves, session_open(s, scene))
{
    document_tail(s->document, 0)->position[0] = param_track(1);
    session_key(s, KEY_RIGHT, 0);
    hold_and_drag(s, -60, 0, 4);
    session_key(s, 'X', 0);
    float x = joint(s, 0)[X];
    session_release(s, BUTTON_LEFT);
    const struct spline *walk = s->document->splines[1];
    assert_int_equal(walk->knot_count, 2);
    for (int i = 0; i < 2; i++) assert_near(walk->knots[i].value, x, 1e-3);
    assert_said(s->editor, "whole shot: x +");
}

/// A limit of what the place follows: all knots stop where the first does, so that the motion stays what it was.
TEST(test_a_limit_holds_the_body)
{
    static const char limited[] =
        "{\"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"frequency\": 1.5}, {\"name\": \"walk\", "
        "\"mode\": \"cubic\", \"limits\": [-1, 0.25], \"knots\": [{\"frame\": 0, \"value\": 0.1}, {\"frame\": 24, "
        "\"value\": 0.2}, {\"frame\": 48, \"value\": 0.1}]}], \"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", "
        "\"position\": [{\"spline\": \"walk\"}, 0.26, 0], \"channels\": [{\"spline\": \"sway\"}]}]}";
    struct session s;
    session_open(&s, limited);
    session_key(&s, 'A', MOD_SHIFT); // what follows a spline is keyed, else
    for (int again = 0; again < 2; again++) {
        hold_and_drag(&s, -150, 0, 4);
        session_key(&s, 'X', 0);
        session_frame(&s);
        assert_near(joint(&s, 0)[X], 0.15, 1e-6); // under the hand, too
        session_release(&s, BUTTON_LEFT);
        for (int i = 0; i < 3; i++) assert_near(s.document->splines[1]->knots[i].value, i == 1 ? 0.25 : 0.15, 1e-12);
        assert_string_equal(said(s.editor),
                            again
                                ? "Held by the limit 0.25 of walk at frame 24."
                                : "Moved for the whole shot: x +0.05 m. Held by the limit 0.25 of walk at frame 24.");
        assert_false(said_error(s.editor));
    }
    session_key(&s, 'A', MOD_SHIFT);
    hold_and_drag(&s, -150, 0, 4);
    session_key(&s, 'X', 0);
    session_frame(&s);
    assert_near(joint(&s, 0)[X], 0.25, 1e-6);
    session_release(&s, BUTTON_LEFT);
    assert_near(s.document->splines[1]->knots[0].value, 0.25, 0);
    assert_string_equal(said(s.editor), "Keyed walk at frame 0. Held by the limit 0.25 of walk at frame 0.");
    session_close(&s);
}

/// With it a place that was a number gets a spline, which begins where the body was, and the tail follows that through.
SESSION_TEST(test_auto_key_makes_a_place_follow, session_open(s, scene))
{
    const char *before = session_saved(s);
    session_key(s, 'A', MOD_SHIFT);
    for (int i = 0; i < 12; i++) session_key(s, KEY_RIGHT, 0);
    hold_and_drag(s, -60, 0, 4);
    session_key(s, 'X', 0);
    float x = joint(s, 0)[X];
    session_release(s, BUTTON_LEFT);
    int track = document_tail(s->document, 0)->position[0].track;
    assert_true(track >= 0);
    const struct spline *made = s->document->splines[track];
    assert_string_equal(made->name, "tail x");
    assert_int_equal(made->knot_count, 2);
    assert_near(made->knots[0].value, 0, 0);
    assert_near(made->knots[1].frame, 12, 0);
    assert_near(made->knots[1].value, x, 1e-3);
    const struct tail *tail = document_tail(s->document, 0);
    assert_int_equal(tail->channel_count, 2);
    assert_int_equal(s->document->splines[tail->channels[1].spline]->parameter[PARAMETER_EQUILIBRIUM].track, track);
    assert_int_equal(document_tail(s->document, 0)->position[2].track, -1);
    assert_string_equal(said(s->editor), "Keyed tail x at frame 12.");
    session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, before);
}

/// Ctrl lifts it; it never sinks into the ground, and its height is keyed above that.
SESSION_TEST(test_a_body_is_lifted, session_open(s, scene))
{
    session_key(s, 'A', MOD_SHIFT);
    session_hover(s, "body(tail)");
    s->mods = MOD_CTRL;
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 0, 80, 4);
    assert_near(joint(s, 0)[Y], 0.26, 1e-6);
    session_drag(s, 0, -200, 8);
    float y = joint(s, 0)[Y];
    assert_true(y > 0.35f);
    s->mods = 0;
    session_release(s, BUTTON_LEFT);
    assert_near(joint(s, 0)[Y], y, 1e-3);
    assert_near(posed(s->editor)->ground, 0, 0);
}

/// A click, or a press beside the body, moves nothing.
SESSION_TEST(test_clicks_leave_the_body_alone, session_open(s, scene))
{
    session_click(s, "body(tail)");
    assert_null(history_undo_label(s->history));
    session_carry(s, "stage(0.03,0.1)", 40, 0, 3);
    assert_near(joint(s, 0)[X], 0, 0);
    assert_null(history_undo_label(s->history));
}

static void strike(struct session *s, int key, unsigned mods)
{
    session_send(s, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_PRESS, .mods = mods});
    session_send(s, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_RELEASE, .mods = mods});
}

/// What is shown is of the last frame: a tail that an event before the press took away is not taken hold of.
SESSION_TEST(
    test_a_press_right_after_a_rig_went,
    session_open(
        s, "{\"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"knots\": [{\"frame\": 0, "
           "\"value\": 1}]}], \"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"spline\": \"sway\"}, {\"type\": "
           "\"model\", \"name\": \"gone\", \"model\": \"gone.glb\"}]}"))
{
    session_click(s, "body(tail)");
    session_key(s, KEY_SPACE, 0);
    for (int i = 0; i < 30; i++) session_frame(s);
    session_point(s, "tail(tail,1)");
    strike(s, KEY_DELETE, MOD_SHIFT);
    if (asked(s->editor) == DIALOG_ASK) strike(s, 'K', 0);
    assert_int_equal(s->document->rig_count, 1);
    assert_true(playback_of(s->editor)->playing);
    session_click_here(s, 1);
    assert_int_equal(s->document->rigs[0]->kind, RIG_MODEL);
}
