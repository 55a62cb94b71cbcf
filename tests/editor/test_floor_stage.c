/// A character's floor on the stage: its edge is pointed at and dragged up and down.
#include "panel_session.h"

static const char creature[] =
    "{\"wiggly\": 1, \"frames\": [0, 60], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"damping\": 0.1, "
    "\"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 20, \"value\": 5}]}], \"rigs\": [{\"type\": "
    "\"character\", \"name\": \"c\", \"model\": \"assets/models/creature.glb\", \"position\": [0, 0.2, 0], "
    "\"coordinates\": [{\"name\": \"up\", \"spline\": \"s\"}], \"floor\": 0}]}";

static void open_creature(struct session *s)
{
    panel_open_models(s, creature);
    session_frame(s);
}

static double floor_of(const struct session *s) { return s->document->rigs[0]->character.floor; }

static void edge(struct session *s, float xy[2])
{
    assert_done(editor_target(s->editor, "floor(c)", &xy[0], &xy[1], &error));
}

/// The edge stays under the pointer, and all is one step.
SESSION_TEST(test_the_edge_is_dragged_down, open_creature(s))
{
    const char *before = session_saved(s);
    session_hover(s, "floor(c)");
    assert_ptr_equal(hovered(s->editor), &thing_floor);
    assert_int_equal(editor_cursor(s->editor), CURSOR_VERTICAL);
    float from[2], to[2];
    edge(s, from);
    session_pull(s, "floor(c)", 0, 30, 4);
    edge(s, to);
    session_release(s, BUTTON_LEFT);
    assert_true(floor_of(s) < -0.02);
    if (!(fabsf(to[1] - from[1] - 30) < 6)) fail_msg("the edge moved by %g pixels of 30", (double)(to[1] - from[1]));
    assert_one_step(s, before);
}

/// Whatever the pointer says, the floor is not above the feet; Esc puts it back.
SESSION_TEST(test_it_stops_at_the_feet_and_esc_cancels, open_creature(s))
{
    const char *before = session_saved(s);
    session_pull(s, "floor(c)", 0, -300, 4);
    assert_near(floor_of(s), 0.2, 1e-12);
    session_key(s, KEY_ESCAPE, 0);
    session_release(s, BUTTON_LEFT);
    assert_saved(s, before);
}

/// The curve gives way while the floor is dragged, in the same frame.
SESSION_TEST(test_the_motion_follows, open_creature(s))
{
    const double was = s->world.evaluation->curves[0].total[35];
    session_pull(s, "floor(c)", 0, -30, 4);
    const double now = s->world.evaluation->curves[0].total[35];
    session_release(s, BUTTON_LEFT);
    assert_true(floor_of(s) > 0.02);
    assert_true(fabs(now - was) > 1e-3);
}

SESSION_TEST(test_without_a_floor_there_is_no_edge, open_creature(s))
{
    float at[2];
    struct error error;
    edge(s, at);
    s->document->rigs[0]->character.has_floor = false;
    session_move(s, at[0], at[1]);
    session_frame(s);
    assert_ptr_not_equal(hovered(s->editor), &thing_floor);
    assert_false(editor_target(s->editor, "floor(c)", &at[0], &at[1], &error));
}
