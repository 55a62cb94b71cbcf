/// The dope sheet: rows of marks that share the ruler's time, dragged, boxed, scrolled, by mouse and by key.
#include "panel_session.h"

static const char TWO[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
    "\"damping\": 0.1, \"knots\": [{\"frame\": 10, \"value\": 0}, {\"frame\": 20, \"value\": 1},"
    "{\"frame\": 60, \"value\": 0}]},"
    "{\"name\": \"up\", \"mode\": \"cubic\", \"knots\": [{\"frame\": 20, \"value\": 0.5},"
    "{\"frame\": 40, \"value\": -0.5}]}]}";

static const struct knot *knot(const struct session *s, int spline, int k)
{
    return &s->document->splines[spline]->knots[k];
}

static float frames(const struct session *s, double count)
{
    return (float)(count * (double)(x_of(s->editor, 1) - x_of(s->editor, 0)));
}

static void open_sheet(struct session *s, const char *scene)
{
    session_open(s, scene);
    session_key(s, KEY_F7, 0);
}

SESSION_TEST(test_it_takes_its_room_from_the_curves, session_open(s, TWO))
{
    const struct layout *layout = layout_of(s->editor);
    const struct rect plot = layout->plot;
    assert_near(layout->sheet.h, 0, 0);
    session_key(s, KEY_F7, 0);
    assert_true(layout->sheet.h > 20);
    assert_near(layout->plot.h, plot.h - layout->sheet.h, 0.01);
    assert_near(layout->sheet.y, layout->ruler.y + layout->ruler.h, 0.01);
    assert_near(layout->sheet.x, plot.x, 0); // marks are under their frames on the ruler
    assert_near(layout->sheet.w, plot.w, 0);
    session_move(s, 6, layout->ruler.y + 10); // the triangle
    session_press(s, BUTTON_LEFT, 1);
    session_release(s, BUTTON_LEFT);
    assert_near(layout->plot.h, plot.h, 0);
}

SESSION_TEST(test_marks_are_dragged_in_time_alone, open_sheet(s, TWO))
{
    const char *original = session_saved(s);
    session_pull(s, "mark(up,1)", frames(s, 7), 40, 4);
    session_release(s, BUTTON_LEFT);
    assert_int_equal(active(s->editor), 1);
    assert_near(knot(s, 1, 1)->frame, 47, 0);
    assert_near(knot(s, 1, 1)->value, -0.5, 0);
    assert_one_step(s, original);
}

SESSION_TEST(test_a_box_takes_the_marks_of_its_rows, open_sheet(s, TWO))
{
    session_point(s, "mark(sway,1)");
    session_move(s, s->x - frames(s, 3), s->y);
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, frames(s, 6), 2, 2);
    assert_int_equal(selected(s->editor), 1);
    session_drag(s, 0, 14, 2); // into the next row
    assert_int_equal(selected(s->editor), 2);
    session_release(s, BUTTON_LEFT);
    const char *original = session_saved(s);
    session_pull(s, "mark(sway,1)", frames(s, 5), 0, 3);
    session_release(s, BUTTON_LEFT);
    assert_near(knot(s, 0, 1)->frame, 25, 0);
    assert_near(knot(s, 1, 0)->frame, 25, 0);
    assert_near(knot(s, 0, 1)->value, 1, 0);
    assert_one_step(s, original);
}

SESSION_TEST(test_rows_choose_and_insert, open_sheet(s, TWO))
{
    session_point(s, "mark(up,1)");
    session_move(s, s->x + frames(s, 10), s->y);
    session_press(s, BUTTON_LEFT, 1);
    session_release(s, BUTTON_LEFT);
    assert_int_equal(active(s->editor), 1);
    const wiggly_value there = evaluation_at(s->world.evaluation, 1, 50);
    session_press(s, BUTTON_LEFT, 2);
    session_release(s, BUTTON_LEFT);
    assert_int_equal(s->document->splines[1]->knot_count, 3);
    assert_near(knot(s, 1, 2)->frame, 50, 0);
    assert_near(knot(s, 1, 2)->value, there.y + there.re, 1e-6);
    session_point(s, "mark(sway,2)");
    session_move(s, s->x + frames(s, 10), s->y);
    s->mods = MOD_SHIFT;
    session_click_here(s, 1);
    session_click_here(s, 2);
    assert_int_equal(active(s->editor), 0); // a pose, in the row below the pointer
    assert_int_equal(s->document->splines[0]->knot_count, 4);
    assert_true(knot(s, 0, 3)->has_phase);
}

/// Ten rows are more than it shows: the wheel scrolls, and the active spline's row comes into sight by itself.
TEST(test_rows_scroll)
{
    char scene[2048] = "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [";
    for (int i = 0; i < 10; i++) {
        size_t length = strlen(scene);
        snprintf(scene + length, sizeof scene - length,
                 "%s{\"name\": \"s%d\", \"frequency\": 1, \"knots\": [{\"frame\": %d, \"value\": 0}]}", i ? ", " : "",
                 i, 10 + i);
    }
    strcat(scene, "]}");
    struct session s;
    float x, y;
    open_sheet(&s, scene);
    session_point(&s, "mark(s0,0)");
    assert_false(editor_target(s.editor, "mark(s9,0)", &x, &y, NULL));
    session_wheel(&s, -1);
    session_wheel(&s, -1);
    session_frame(&s);
    assert_false(editor_target(s.editor, "mark(s0,0)", &x, &y, NULL));
    session_key(&s, KEY_PAGE_UP, 0); // round to the last one
    session_frame(&s);
    session_point(&s, "mark(s9,0)");
    selection_set(hidden_of(s.editor), s.document->splines[9]->id, true);
    session_frame(&s);
    assert_false(editor_target(s.editor, "mark(s9,0)", &x, &y, NULL));
    session_close(&s);
}
