/// Knots of several splines at once: selected, moved, nudged, scaled, sloped, deleted, copied and pasted as one step.
#include "panel_session.h"
#include "shown.h"

static const char TWO[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,\"damping\": 0.1, "
    "\"knots\": [{\"frame\": 10, \"value\": 0}, {\"frame\": 20, \"value\": 1},{\"frame\": 30, \"value\": -1}, "
    "{\"frame\": 60, \"value\": 0}]},{\"name\": \"up\", \"mode\": \"cubic\", \"limits\": [-50, 60], \"knots\": "
    "[{\"frame\": 20, \"value\": 0.5},{\"frame\": 40, \"value\": -0.5}]},{\"name\": \"far\", \"mode\": \"cubic\", "
    "\"knots\": [{\"frame\": 22, \"value\": 0.2}]}]}";

static const struct knot *knot(const struct session *s, int spline, int k)
{
    return &s->document->splines[spline]->knots[k];
}

/// A box from one place of the plot to another, by frames and values.
static void box(struct session *s, const char *from, const char *to)
{
    session_point(s, from);
    session_press(s, BUTTON_LEFT, 1);
    session_hover(s, to);
    session_release(s, BUTTON_LEFT);
}

SESSION_TEST(test_all_of_one_and_of_all_that_are_shown, session_open(s, TWO))
{
    session_key(s, 'A', MOD_CTRL);
    assert_int_equal(selected(s->editor), 4);
    session_key(s, 'A', MOD_CTRL | MOD_SHIFT);
    assert_int_equal(selected(s->editor), 7);
    session_key(s, 'A', MOD_CTRL); // fewer again
    assert_int_equal(selected(s->editor), 4);
    selection_set(hidden_of(s->editor), s->document->splines[2]->id, true);
    session_key(s, 'A', MOD_CTRL | MOD_SHIFT);
    assert_int_equal(selected(s->editor), 6);
}

SESSION_TEST(test_a_box_takes_knots_of_all_curves, session_open(s, TWO))
{
    box(s, "curve(sway,17,1.1)", "curve(sway,26,0.1)");
    assert_int_equal(selected(s->editor), 3);
    assert_int_equal(active(s->editor), 0);
    box(s, "curve(sway,37,-0.3)", "curve(sway,45,-0.7)"); // the other curve alone: that one is worked on then
    assert_int_equal(selected(s->editor), 1);
    assert_int_equal(active(s->editor), 1);
}

SESSION_TEST(test_shift_clicks_add_knots_of_another_curve, session_open(s, TWO))
{
    session_click(s, "knot(sway,1)");
    s->mods = MOD_SHIFT;
    session_click(s, "knot(up,1)");
    assert_int_equal(selected(s->editor), 2);
    session_click(s, "knot(up,1)");
    s->mods = 0;
    assert_int_equal(selected(s->editor), 1);
    assert_int_equal(active(s->editor), 0); // the one that has what is still selected
}

SESSION_TEST(test_a_drag_moves_all_in_one_step, session_open(s, TWO))
{
    const char *original = session_saved(s);
    box(s, "curve(sway,17,1.1)", "curve(sway,26,0.1)");
    const float frame = x_of(s->editor, 1) - x_of(s->editor, 0);
    session_carry(s, "knot(up,0)", 5 * frame, -12, 4);
    assert_near(knot(s, 0, 1)->frame, 25, 0);
    assert_near(knot(s, 1, 0)->frame, 25, 0);
    assert_near(knot(s, 2, 0)->frame, 27, 0);
    const double up = knot(s, 1, 0)->value - 0.5;
    assert_true(up > 0.01);
    assert_near(knot(s, 0, 1)->value - 1, up, 0.01);
    assert_near(knot(s, 2, 0)->value - 0.2, up, 0.01);
    assert_near(knot(s, 0, 2)->frame, 30, 0);
    assert_one_step(s, original);
}

/// The last knot of one spline stops them all; none is lost where another knot is in the way.
SESSION_TEST(test_what_one_meets_stops_all, session_open(s, TWO))
{
    session_key(s, 'A', MOD_CTRL | MOD_SHIFT);
    session_carry(s, "knot(up,0)", 900, 0, 6);
    assert_near(knot(s, 0, 3)->frame, 96, 0);
    assert_near(knot(s, 0, 0)->frame, 46, 0);
    assert_near(knot(s, 1, 1)->frame, 76, 0);
    session_key(s, 'Z', MOD_CTRL);
    session_click(s, "knot(sway,1)"); // on 20, with one on 30
    session_click_with(s, MOD_SHIFT, "knot(far,0)");
    session_key(s, KEY_RIGHT, MOD_ALT | MOD_SHIFT); // 30 is taken in one spline: both go on to 40
    assert_near(knot(s, 0, 2)->frame, 40, 0);
    assert_near(knot(s, 2, 0)->frame, 42, 0);
}

SESSION_TEST(test_normalised_curves_move_by_the_same_height, session_open(s, TWO))
{
    session_key(s, 'N', 0);
    session_frame(s);
    session_key(s, 'A', MOD_CTRL | MOD_SHIFT);
    const char *original = session_saved(s);
    const double before[2] = {knot(s, 0, 1)->value, knot(s, 1, 0)->value};
    session_key(s, KEY_UP, MOD_ALT | MOD_SHIFT);
    const double by[2] = {knot(s, 0, 1)->value - before[0], knot(s, 1, 0)->value - before[1]};
    assert_true(by[0] > 0 && by[1] > 0);
    assert_true(by[1] < 0.7 * by[0]); // of a curve that is drawn larger than it is
    assert_one_step(s, original);
}

SESSION_TEST(test_delete_and_slopes_are_one_step, session_open(s, TWO))
{
    session_key(s, 'A', MOD_CTRL | MOD_SHIFT);
    const char *original = session_saved(s);
    session_key(s, 'T', MOD_SHIFT);
    for (int i = 0; i < 3; i++) assert_true(knot(s, i, 0)->has_slope);
    assert_one_step(s, original);
    original = session_saved(s);
    session_key(s, KEY_DELETE, 0);
    for (int i = 0; i < 3; i++) assert_int_equal(s->document->splines[i]->knot_count, 0);
    assert_one_step(s, original);
}

static void paste(struct session *s, const char *text)
{
    session_send(s, (struct event){.kind = EVENT_PASTE, .text = text});
    session_frame(s);
}

SESSION_TEST(test_pasted_knots_go_to_their_splines, session_open(s, TWO))
{
    session_key(s, 'A', MOD_CTRL | MOD_SHIFT);
    session_key(s, 'C', MOD_CTRL);
    const char *original = session_saved(s);
    char *text = strdup(copied(s->editor));
    assert_non_null(strstr(text, "\"spline\": \"up\""));
    session_click(s, "ruler(21)");
    paste(s, text);
    assert_int_equal(s->document->splines[0]->knot_count, 8);
    assert_int_equal(s->document->splines[1]->knot_count, 4);
    assert_int_equal(s->document->splines[2]->knot_count, 2);
    assert_near(knot(s, 1, 1)->frame, 31, 0); // 20 is 10 behind the first one, of another spline
    assert_int_equal(selected(s->editor), 7);
    assert_one_step(s, original);
    free(text);
}

/// What is of a spline that this scene lacks goes to the active one; of one spline alone, always.
SESSION_TEST(test_pasted_knots_of_unknown_splines_go_to_the_active_one, session_open(s, TWO))
{
    session_click(s, "ruler(70)");
    paste(s,
          "[{\"spline\": \"up\", \"frame\": 0, \"value\": 1}, {\"spline\": \"gone\", \"frame\": 2, \"value\": 2}]");
    assert_near(knot(s, 0, 4)->frame, 72, 0);
    assert_near(knot(s, 1, 2)->frame, 70, 0);
    session_click(s, "knot(sway,1)");
    session_key(s, 'C', MOD_CTRL);
    assert_null(strstr(copied(s->editor), "spline"));
    paste(s, "[{\"spline\": 3, \"frame\": 0, \"value\": 1}]");
    assert_said(s->editor, "[0].spline: expected");
}

SESSION_TEST(test_copies_go_behind_the_end, session_open(s, TWO))
{
    session_key(s, 'A', MOD_CTRL | MOD_SHIFT);
    const char *original = session_saved(s);
    session_key(s, 'D', MOD_CTRL); // 10 … 60 and 40 behind each other: 20 later
    assert_int_equal(s->document->splines[0]->knot_count, 8);
    assert_int_equal(s->document->last_frame, 130);
    assert_near(knot(s, 0, 7)->frame, 130, 0);
    assert_near(knot(s, 1, 2)->frame, 90, 0);
    assert_int_equal(selected(s->editor), 7);
    assert_one_step(s, original);
}

SESSION_TEST(test_scaling_about_the_equilibrium, session_open(s, TWO))
{
    session_key(s, 'A', MOD_CTRL | MOD_SHIFT);
    const char *original = session_saved(s);
    session_strike(s, 'S', MOD_SHIFT, 'S');
    session_type(s, "2");
    session_frame(s);
    assert_non_null(strstr(s->editor->curves->scaling.sentence, "value × 2"));
    session_key(s, KEY_ENTER, 0);
    assert_near(knot(s, 0, 1)->value, 2, 1e-9);
    assert_near(knot(s, 0, 2)->value, -2, 1e-9);
    assert_near(knot(s, 1, 1)->value, -1, 1e-9); // a cubic's equilibrium is 0 too
    assert_near(knot(s, 0, 1)->frame, 20, 0);
    assert_one_step(s, original);
}

SESSION_TEST(test_two_factors_and_what_stops_them, session_open(s, TWO))
{
    const struct scaling *scaling = &s->editor->curves->scaling;
    box(s, "curve(sway,17,1.1)", "curve(sway,26,0.1)"); // 20 of sway and up, 22 of far
    session_type(s, "s");
    session_type(s, "3 1.5");
    session_frame(s);
    assert_near(knot(s, 2, 0)->frame, 24, 0); // about 21
    assert_near(knot(s, 0, 1)->frame, 18, 0);
    assert_near(knot(s, 0, 1)->value, 0.6 + 1.5 * 0.4, 1e-6);
    assert_non_null(strstr(scaling->sentence, "time × 3, value × 1.5"));
    session_key(s, KEY_ESCAPE, 0);
    session_type(s, "s");
    session_type(s, "11 1");
    session_frame(s);
    assert_near(knot(s, 0, 1)->frame, 20, 0);
    assert_non_null(strstr(scaling->sentence, "a knot would land on another on frame 10"));
    session_key(s, KEY_BACKSPACE, 0);
    session_key(s, KEY_BACKSPACE, 0);
    session_type(s, "0 1");
    session_frame(s);
    assert_non_null(strstr(scaling->sentence, "a knot would leave the range"));
    session_key(s, KEY_ESCAPE, 0);
    session_type(s, "sy300");
    session_frame(s);
    assert_near(knot(s, 0, 1)->value, 0.6 + 300 * 0.4, 1e-3); // sway has no limit
    assert_near(knot(s, 1, 0)->value, -29.4, 1e-3);
    assert_null(strstr(scaling->sentence, "limit"));
    session_type(s, "0");
    session_frame(s);
    assert_near(knot(s, 1, 0)->value, -50, 0);
    assert_non_null(strstr(scaling->sentence, "held by the limit -50 of up at frame 20"));
    session_key(s, KEY_ESCAPE, 0);
}

/// The upper edge goes along with the pointer, the lower one stays; the factor is beside the pointer.
SESSION_TEST(test_an_edge_of_the_box_scales_about_the_other_side, session_open(s, TWO))
{
    const float unit =
        (float)(layout_of(s->editor)->plot.h / (plot_of(s->editor)->value1 - plot_of(s->editor)->value0));
    box(s, "curve(sway,17,1.1)", "curve(sway,34,-1.2)"); // 20 and 30 of sway, 20 of up, 22 of far
    const char *original = session_saved(s);
    session_pull(s, "box(0,-1)", 0, -unit / 2, 4);
    assert_non_null(shown_text(s->editor, "value × 1.25"));
    assert_non_null(strstr(s->editor->curves->scaling.sentence, "value × 1.25 about the other side.  P: the equili"));
    session_release(s, BUTTON_LEFT);
    assert_near(knot(s, 0, 1)->value, 1.5, 0.01);
    assert_near(knot(s, 0, 2)->value, -1, 1e-9);
    assert_near(knot(s, 1, 0)->value, -1 + 1.5 * 1.25, 0.01);
    assert_near(knot(s, 0, 1)->frame, 20, 0);
    assert_one_step(s, original);
}

/// With Alt about the equilibrium, or with P: the upper edge goes along, the lower one the other way.
TEST(test_an_edge_of_the_box_scales_about_the_equilibrium)
{
    for (int by_key = 0; by_key < 2; by_key++) {
        struct session s;
        session_open(&s, TWO);
        const float unit =
            (float)(layout_of(s.editor)->plot.h / (plot_of(s.editor)->value1 - plot_of(s.editor)->value0));
        session_key(&s, 'A', MOD_CTRL);
        s.mods = by_key ? 0 : MOD_ALT;
        session_pull(&s, "box(0,-1)", 0, -unit / 2, 4);
        if (by_key) session_key(&s, 'P', 0);
        session_release(&s, BUTTON_LEFT);
        assert_near(knot(&s, 0, 1)->value, 1.5, 0.01);
        assert_near(knot(&s, 0, 2)->value, -1.5, 0.01);
        session_close(&s);
    }
}

SESSION_TEST(test_a_corner_of_the_box_scales_both_and_says_what_stops_it, session_open(s, TWO))
{
    const struct curves *curves = s->editor->curves;
    const float frame = (float)(layout_of(s->editor)->plot.w / (curves->view.frame1 - curves->view.frame0));
    box(s, "curve(sway,17,1.1)", "curve(sway,34,-1.2)");
    const char *original = session_saved(s);
    session_pull(s, "box(1,-1)", 10 * frame, 0, 4);
    assert_near(knot(s, 0, 2)->frame, 40, 0);
    assert_near(knot(s, 0, 1)->frame, 20, 0);
    assert_non_null(shown_text(s->editor, "time × 2"));
    session_drag(s, 80 * frame, 0, 10); // 110 is outside
    assert_non_null(shown_text(s->editor, "a knot would leave the range"));
    assert_true(knot(s, 0, 2)->frame <= 96);
    session_key(s, KEY_ESCAPE, 0);
    assert_saved(s, original);
}

/// A knot is where a handle would be, and a press there takes the knot; a single one, and knots on one frame, have fewer handles.
SESSION_TEST(test_the_box_has_the_handles_that_can_scale, session_open(s, TWO))
{
    float x, y;
    struct error error;
    session_click(s, "knot(sway,1)");
    assert_false(editor_target(s->editor, "box(0,-1)", &x, &y, &error));
    session_click_with(s, MOD_SHIFT, "knot(up,0)"); // on the same frame
    assert_true(editor_target(s->editor, "box(0,-1)", &x, &y, &error));
    assert_false(editor_target(s->editor, "box(1,0)", &x, &y, &error));
    assert_false(editor_target(s->editor, "box(1,-1)", &x, &y, &error));
    session_hover(s, "knot(sway,1)");
    assert_ptr_equal(hovered(s->editor), &thing_knot);
}

/// With Alt, from the playhead; a system that sends the comma all the same goes no further.
SESSION_TEST(test_the_playhead_goes_to_the_next_knot, session_open(s, TWO))
{
    const struct playback *playback = playback_of(s->editor);
    session_strike(s, '.', MOD_ALT, '.');
    assert_near(playback->position, 10, 0);
    session_key(s, '.', MOD_ALT);
    session_key(s, KEY_END, MOD_ALT);
    assert_near(playback->position, 30, 0);
    session_strike(s, ',', MOD_ALT, ',');
    assert_near(playback->position, 20, 0);
    assert_true(selection_has(selection_of(s->editor), knot(s, 0, 1)->id));
    session_key(s, KEY_HOME, MOD_ALT);
    session_key(s, KEY_HOME, MOD_ALT);
    assert_near(playback->position, 10, 0);
    assert_said(s->editor, "No knot lies before");
    session_point(s, "knot(sway,3)");
    session_click_here(s, 1);
    session_click_here(s, 2);
    assert_near(playback->position, 60, 0);
    assert_null(history_undo_label(s->history));
}
