/// Limits in the app: their lines are dragged, knots stop at them, the inspector switches them.

#include "panel_session.h"

static const char swinging[] =
    "{\"wiggly\": 1, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 1.2, \"damping\": 0.05, "
    "\"limits\": [null, 1.2], \"knots\": [{\"frame\": 8, \"value\": 0}, {\"frame\": 14, \"value\": 0.8}, "
    "{\"frame\": 22, \"value\": -0.4}, {\"frame\": 60, \"value\": 1}]}]}";

static double limit(const struct session *s, enum parameter p) { return s->document->splines[0]->parameter[p].value; }

static double highest(const struct session *s)
{
    const wiggly_curve *curve = s->world.evaluation->curves;
    double highest = curve->total[0];
    for (int i = 0; i < curve->samples; i++) highest = fmax(highest, curve->total[i]);
    return highest;
}

static void pull(struct session *s, const char *from, const char *to)
{
    session_point(s, from);
    session_press(s, BUTTON_LEFT, 1);
    session_hover(s, to);
    session_release(s, BUTTON_LEFT);
    session_frame(s);
}

SESSION_TEST(a_line_is_dragged_as_far_as_the_knots, session_open(s, swinging))
{
    const char *original = session_saved(s);
    assert_non_null(strstr(original, "\"limits\": [null, 1.2]"));
    session_hover(s, "curve(sway,100,1.2)");
    assert_ptr_equal(hovered(s->editor), &thing_limit);
    pull(s, "curve(sway,100,1.2)", "curve(sway,100,1.05)");
    assert_near(limit(s, PARAMETER_HIGH), 1.05, 0.01);
    assert_true(highest(s) == limit(s, PARAMETER_HIGH) || highest(s) == 1);
    pull(s, "curve(sway,100,1.05)", "curve(sway,100,0.5)");
    assert_near(limit(s, PARAMETER_HIGH), 1, 0);
    pull(s, "knot(sway,3)", "curve(sway,60,1.1)");
    assert_near(s->document->splines[0]->knots[3].value, 1, 0);
    for (int i = 0; i < 2; i++) session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, original);
}

/// While a limit holds a knot the status line says so, and no longer; it stays after the release, to be read.
SESSION_TEST(what_holds_a_dragged_knot_is_said, session_open(s, swinging))
{
    session_pull(s, "knot(sway,1)", 0, -20, 4);
    assert_string_equal(said(s->editor), "");
    session_drag(s, 0, -400, 4);
    assert_near(s->document->splines[0]->knots[1].value, 1.2, 0);
    assert_string_equal(said(s->editor), "Held by the limit 1.2 of sway at frame 14.");
    session_drag(s, 0, 400, 4);
    assert_string_equal(said(s->editor), "");
    session_drag(s, 0, -400, 4);
    session_release(s, BUTTON_LEFT);
    assert_string_equal(said(s->editor), "Held by the limit 1.2 of sway at frame 14.");
}

/// A knot cannot leave the range nor sit on another one: what stops it is said as it is where knots are scaled.
SESSION_TEST(what_stops_a_knot_in_time_is_said, session_open(s, swinging))
{
    const float frame = x_of(s->editor, 1) - x_of(s->editor, 0);
    session_pull(s, "knot(sway,1)", 7 * frame, 0, 7);
    assert_string_equal(said(s->editor), "");
    session_drag(s, frame, 0, 1);
    assert_near(s->document->splines[0]->knots[1].frame, 21, 0);
    assert_string_equal(said(s->editor), "A knot would land on another on frame 22.");
    session_drag(s, frame, 0, 1); // past it
    assert_string_equal(said(s->editor), "");
    session_drag(s, 120 * frame, 0, 5);
    assert_string_equal(said(s->editor), "A knot would leave the range.");
    session_key(s, KEY_ESCAPE, 0);
    session_click(s, "knot(sway,0)");
    for (int i = 0; i < 8; i++) session_key(s, KEY_LEFT, MOD_ALT);
    assert_near(s->document->splines[0]->knots[0].frame, 0, 0);
    hush(s->editor);
    session_key(s, KEY_LEFT, MOD_ALT);
    assert_string_equal(said(s->editor), "A knot would leave the range.");
}

SESSION_TEST(a_nudge_goes_as_far_as_the_limit, session_open(s, swinging))
{
    session_click(s, "knot(sway,3)"); // 0.2 below it
    for (int i = 0; i < 9; i++) session_key(s, KEY_UP, MOD_ALT | MOD_SHIFT);
    assert_near(s->document->splines[0]->knots[3].value, 1.2, 0);
    assert_string_equal(said(s->editor), "Held by the limit 1.2 of sway at frame 60.");
    assert_false(said_error(s->editor));
}

/// It bends as far as the limit; before, the pull was taken back as a whole.
SESSION_TEST(
    a_pulled_tail_stops_at_the_limit,
    session_open(s,
                 "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"limits\": [-0.5, 0.5], "
                 "\"knots\": [{\"frame\": 0, \"value\": 0}]}], \"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", "
                 "\"position\": [0, 0.26, 0], \"channels\": [{\"spline\": \"sway\", \"gain\": 6}]}]}"))
{
    session_frame(s);
    session_pull(s, "tail(tail,0.95)", -500, 0, 25);
    for (int i = 0; i < 20; i++) session_frame(s);
    session_release(s, BUTTON_LEFT);
    assert_near(fabs(s->document->splines[0]->knots[0].value), 0.5, 0);
    assert_said(s->editor, "eld by the limit");
    assert_false(said_error(s->editor));
}

SESSION_TEST(the_inspector_switches_each, panel_open(s, swinging, 1280, 1000))
{
    panel_click(s, "section.limits");
    panel_click(s, "limit.low");
    assert_near(limit(s, PARAMETER_LOW), -0.55, 1e-12); // 0.15 of the largest knot beyond the lowest
    panel_enter(s, "low limit", "-0.45");
    assert_near(limit(s, PARAMETER_LOW), -0.45, 0);
    panel_enter(s, "low limit", "0"); // there is a knot below
    assert_near(limit(s, PARAMETER_LOW), -0.45, 0);
    panel_click(s, "limit.high");
    assert_true(limit(s, PARAMETER_HIGH) == INFINITY);
    const char *text = session_saved(s);
    assert_non_null(strstr(text, "\"limits\": [-0.45, null]"));
    panel_click(s, "limit.low");
    text = session_saved(s);
    assert_null(strstr(text, "limits"));
}
