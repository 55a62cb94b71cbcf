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

/// Handles moved by so many pixels, and what parameters must then be between. Of the two poles of complex mode, whichever is taken, away from
/// the other one is wider; those of real mode mirror each other: there is one handle. A parameter that follows another spline is not torn
/// off it.
static const struct move {
    int spline;
    const char *handle;
    float dx, dy;
    double frequency[2], damping[2], bandwidth[2];
} moves[] = {
    {0, "pole.centre", 40, -15, {1.1, 2}, {0.15, 0.5}, {0.1234, 0.1234}},
    {0, "pole.lower", -30, 0, {1, 1}, {0.099, 0.101}, {0.2, 0.5}},
    {0, "pole.upper", 30, 0, {1, 1}, {0.099, 0.101}, {0.2, 0.5}},
    {2, "pole.centre", 30, -10, {1.05, 24}, {0.08001, 3}, {0, 1}},
    {3, "pole.centre", 30, -12, {0, 24}, {0.25, 3}, {0, 1}},
};

static bool is_between(const struct session *s, enum parameter p, const double range[2])
{
    return value(s, p) >= range[0] && value(s, p) <= range[1];
}

TEST(test_handles_set_parameters)
{
    for (size_t i = 0; i < 2 * sizeof moves / sizeof *moves; i++) {
        const struct move *move = &moves[i / 2];
        const bool is_kept = i % 2; // else Esc takes it back
        struct session s;
        open_poles(&s, move->spline);
        const char *before = session_saved(&s);
        assert_int_equal(panel_shows(&s, "pole.upper"), move->spline != 2);
        drag(&s, move->handle, move->dx, move->dy);
        if (!is_between(&s, PARAMETER_FREQUENCY, move->frequency) ||
            !is_between(&s, PARAMETER_DAMPING, move->damping) ||
            !is_between(&s, PARAMETER_BANDWIDTH, move->bandwidth))
            fail_msg("move %zu: frequency %g, damping %g, bandwidth %g", i / 2, value(&s, PARAMETER_FREQUENCY),
                     value(&s, PARAMETER_DAMPING), value(&s, PARAMETER_BANDWIDTH));
        assert_int_equal(s.document->splines[3]->parameter[PARAMETER_FREQUENCY].track, 1);
        if (is_kept) {
            panel_release(&s);
            assert_string_equal(history_undo_label(s.history), "Move poles");
            session_key(&s, 'Z', MOD_CTRL);
        } else {
            session_move(&s, 1140, 10); // far out: clamped, so that it loads again
            session_move(&s, 5, 10);
            session_frame(&s);
            assert_true(is_between(&s, PARAMETER_BANDWIDTH, (const double[]){0, 1}));
            session_key(&s, KEY_ESCAPE, 0);
        }
        assert_saved(&s, before);
        assert_null(history_undo_label(s.history));
        session_close(&s);
    }
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
