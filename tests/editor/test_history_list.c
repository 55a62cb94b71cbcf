/// The inspector's list of the history: every step can be seen and gone to, by mouse, keys and wheel.
#include "panel_session.h"
#include "shown.h"

static const char scene[] =
    "{\"frames\": [0, 480], \"splines\": [{\"name\": \"sway\", \"mode\": \"cubic\", \"knots\": "
    "[{\"frame\": 0, \"value\": 0}]}]}";

static int knots(const struct session *session) { return session->document->splines[0]->knot_count; }

/// Opens the section, with `steps` knots inserted one after the other.
static void open_list(struct session *session, int steps)
{
    panel_open(session, scene, 1280, 1184);
    panel_click(session, "section.history");
    session_key(session, KEY_LEFT, MOD_SHIFT);
    for (int i = 0; i < steps; i++) {
        session_key(session, KEY_RIGHT, 0);
        session_key(session, 'I', 0);
    }
    assert_int_equal(knots(session), 1 + steps);
}

SESSION_TEST(test_click, open_list(s, 4))
{
    assert_true(panel_shows(s, "history.4"));
    assert_false(panel_shows(s, "history.5"));
    panel_click(s, "history.1");
    assert_int_equal(knots(s), 2);
    assert_true(panel_shows(s, "history.4")); // what was undone stays in the list
    panel_click(s, "history.3");
    assert_int_equal(knots(s), 4);
    panel_click(s, "history.0");
    assert_int_equal(knots(s), 1);
    assert_true(history_is_saved(s->history));
}

SESSION_TEST(test_keys, open_list(s, 4))
{
    panel_click(s, "section.history"); // a press gives no keyboard focus; Tab does
    panel_click(s, "section.history");
    panel_tab_to(s, "history.4");
    session_key(s, KEY_UP, 0);
    session_key(s, KEY_UP, 0);
    assert_int_equal(knots(s), 3);
    session_key(s, KEY_DOWN, 0);
    assert_int_equal(knots(s), 4);
    for (int i = 0; i < 9; i++) session_key(s, KEY_UP, 0);
    assert_int_equal(knots(s), 1);
    session_key(s, KEY_TAB, 0);
    session_key(s, KEY_ENTER, 0); // the row after it
    assert_int_equal(knots(s), 2);
}

/// More steps than rows: the list follows the present one, and the wheel shows the others.
SESSION_TEST(test_long_list, open_list(s, 40))
{
    assert_true(panel_shows(s, "history.40"));
    assert_false(panel_shows(s, "history.0"));
    panel_press(s, "history.36", 1);
    session_release(s, BUTTON_LEFT);
    assert_int_equal(knots(s), 37);
    for (int i = 0; i < 20; i++) session_wheel(s, 1);
    assert_true(panel_shows(s, "history.0"));
    assert_int_equal(knots(s), 37); // looking is not going
    panel_click(s, "history.2");
    assert_int_equal(knots(s), 3);
    session_key(s, 'Y', MOD_CTRL);
    for (int i = 0; i < 25; i++) session_key(s, 'Y', MOD_CTRL);
    assert_true(panel_shows(s, "history.28"));
}

/// Over the list the wheel moves only that, until it is at its end; then the panel.
SESSION_TEST(test_wheel, open_list(s, 40))
{
    editor_resize(s->editor, 1280, 600, 1);
    unfold(s->editor, "section.history");
    session_frame(s);
    const struct inspector *inspector = s->editor->inspector;
    float x, y;
    assert_true(widget_at(s->editor, "section.history", &x, &y));
    session_move(s, x, y + 60);
    const float offset = inspector->sections.offset;
    assert_true(offset > 100);
    for (float top = inspector->history.list.offset; top > 0; top = inspector->history.list.offset) {
        session_wheel(s, 1);
        assert_true(inspector->history.list.offset < top);
        assert_near(inspector->sections.offset, offset, 0);
    }
    session_wheel(s, 1);
    assert_true(inspector->sections.offset < offset);
}

/// The list says what it does not have any more.
SESSION_TEST(test_dropped, panel_open(s, scene, 1280, 984))
{
    panel_click(s, "section.history");
    history_set_limit(s->history, 2000);
    for (int i = 0; i < 40; i++) {
        session_key(s, KEY_RIGHT, 0);
        session_key(s, 'I', 0);
    }
    assert_true(history_dropped(s->history) > 10);
    for (int i = 0; i < 20; i++) {
        float x, y;
        assert_true(widget_at(s->editor, "section.history", &x, &y));
        session_move(s, x, y + 40);
        session_wheel(s, 1);
    }
    panel_click(s, "history.0");
    assert_int_equal(knots(s), 1 + (int)history_dropped(s->history));
    char text[64];
    snprintf(text, sizeof text, "%zu older steps were dropped", history_dropped(s->history));
    assert_non_null(shown_text(s->editor, text));
}

/// A drag holds a step open: the list does nothing meanwhile.
SESSION_TEST(test_not_in_a_drag, open_list(s, 2))
{
    history_begin(s->history, "Drag", 0);
    panel_click(s, "history.0");
    assert_int_equal(knots(s), 3);
    history_end(s->history);
}
