/// The inspector's poles: dragged in the inset they set frequency, damping and bandwidth.
#include "panel_session.h"

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": ["
    "{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.1, \"bandwidth\": 0.1234, \"knots\": ["
    "  {\"frame\": 0, \"value\": 0}, {\"frame\": 36, \"value\": 1}]},"
    "{\"name\": \"pace\", \"mode\": \"cubic\", \"knots\": [{\"frame\": 0, \"value\": 1}]},"
    "{\"name\": \"pluck\", \"mode\": \"real\", \"frequency\": 1, \"damping\": 0.08},"
    "{\"name\": \"lift\", \"frequency\": {\"spline\": \"pace\"}, \"damping\": 0.2, \"knots\": ["
    "  {\"frame\": 10, \"value\": 1}]}], \"rigs\": []}";

static double value(const struct session *f, enum parameter which)
{
    return f->document->splines[active(f->editor)]->parameter[which].value;
}

static void open_poles(struct session *f, int spline)
{
    panel_open(f, scene, 1280, 1400);
    activate(f->editor, spline);
    panel_click(f, "section.poles");
    session_frame(f);
}

/// Takes a handle and moves the pointer by so many pixels; the button stays down.
static void drag(struct session *f, const char *name, float dx, float dy)
{
    float x, y;
    assert_true(widget_at(f->editor, name, &x, &y));
    panel_press(f, name, 1);
    session_move(f, x + dx, y + dy);
    session_frame(f);
}

SESSION_TEST(test_centre_sets_frequency_and_damping, open_poles(s, 0))
{
    drag(s, "pole.centre", 40, -15);
    assert_true(value(s, PARAMETER_FREQUENCY) > 1.1 && value(s, PARAMETER_FREQUENCY) < 2);
    assert_true(value(s, PARAMETER_DAMPING) > 0.15 && value(s, PARAMETER_DAMPING) < 0.5);
    assert_near(value(s, PARAMETER_BANDWIDTH), 0.1234, 0);
    panel_release(s);
    assert_string_equal(history_undo_label(s->history), "Move poles");
    session_key(s, 'Z', MOD_CTRL);
    assert_near(value(s, PARAMETER_FREQUENCY), 1, 0);
    assert_near(value(s, PARAMETER_DAMPING), 0.1, 0);
    assert_null(history_undo_label(s->history));
}

/// Whichever of the two is taken, away from the other one is wider.
TEST(test_pole_opens_the_band)
{
    const char *const poles[] = {"pole.lower", "pole.upper"};
    for (int i = 0; i < 2; i++) {
        struct session f;
        open_poles(&f, 0);
        drag(&f, poles[i], i == 0 ? -30 : 30, 0);
        double wide = value(&f, PARAMETER_BANDWIDTH);
        assert_true(wide > 0.2 && wide < 0.5);
        assert_near(value(&f, PARAMETER_FREQUENCY), 1, 0);
        assert_near(value(&f, PARAMETER_DAMPING), 0.1, 0.001);
        session_move(&f, 1140, 10); // far out: clamped, so that it loads again
        session_move(&f, 5, 10);
        session_frame(&f);
        assert_in_range(value(&f, PARAMETER_BANDWIDTH) * 1000, 0, 1000);
        session_key(&f, KEY_ESCAPE, 0);
        assert_near(value(&f, PARAMETER_BANDWIDTH), 0.1234, 0);
        assert_null(history_undo_label(f.history));
        session_close(&f);
    }
}

/// The poles of real mode mirror each other: there is one handle.
SESSION_TEST(test_real_poles, open_poles(s, 2))
{
    assert_false(panel_shows(s, "pole.upper"));
    drag(s, "pole.centre", 30, -10);
    panel_release(s);
    assert_true(value(s, PARAMETER_FREQUENCY) > 1.05);
    assert_true(value(s, PARAMETER_DAMPING) > 0.08);
    session_key(s, 'Z', MOD_CTRL);
    assert_near(value(s, PARAMETER_FREQUENCY), 1, 0);
    assert_near(value(s, PARAMETER_DAMPING), 0.08, 0);
}

/// A parameter that follows another spline is not torn off it.
SESSION_TEST(test_tracks_stay, open_poles(s, 3))
{
    drag(s, "pole.centre", 30, -12);
    panel_release(s);
    assert_int_equal(s->document->splines[3]->parameter[PARAMETER_FREQUENCY].track, 1);
    assert_true(value(s, PARAMETER_DAMPING) > 0.25);
}

SESSION_TEST(test_arrow_keys_move_a_focused_pole, open_poles(s, 0))
{
    inspector_of(s->editor)->focus = panel_id(s, "pole.centre");
    session_key(s, KEY_RIGHT, 0);
    session_key(s, KEY_RIGHT, 0);
    assert_near(value(s, PARAMETER_FREQUENCY), 1.1, 1e-12);
    session_key(s, 'Z', MOD_CTRL);
    assert_near(value(s, PARAMETER_FREQUENCY), 1, 0);
    inspector_of(s->editor)->focus = panel_id(s, "pole.lower");
    session_key(s, KEY_LEFT, 0);
    assert_near(value(s, PARAMETER_BANDWIDTH), 0.133, 1e-12);
}
