/// Nothing needs a mouse: what it does to selection, views, panels and warnings, the keyboard does too.
#include "panel_session.h"
#include "ui/theme.h"

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 0.5, \"damping\": 0.01, "
    "\"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 36, \"value\": 1}, {\"frame\": 40, \"value\": -1}, "
    "{\"frame\": 90, \"value\": 0}]}],\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"spline\": \"sway\"}]}";

/// A jump within two frames.
static const char jump[] = "{\"wiggly\": 1, \"frames\": [0, 72], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
                           "\"damping\": 0.05, \"bandwidth\": 0.05, \"knots\": [{\"frame\": 10, \"value\": 0},"
                           "{\"frame\": 12, \"value\": 1}, {\"frame\": 24, \"value\": 1}]}]}";

static bool is_selected(const struct session *s, int knot)
{
    return selection_has(selection_of(s->editor), s->document->splines[0]->knots[knot].id);
}

SESSION_TEST(test_the_selection_grows_by_neighbours, session_open(s, scene))
{
    session_key(s, KEY_LEFT, MOD_SHIFT); // to the first frame
    session_type(s, ">");
    assert_true(is_selected(s, 1));
    session_type(s, ">");
    session_type(s, "<");
    for (int k = 0; k < 3; k++) assert_true(is_selected(s, k));
    assert_false(is_selected(s, 3));
    for (int i = 0; i < 3; i++) session_type(s, "<"); // there is nothing before the first
    assert_int_equal(selection_count(selection_of(s->editor), s->document->splines[0]), 3);
}

SESSION_TEST(test_the_curves_pan_and_zoom, session_open(s, scene))
{
    const struct plotted before = *plot_of(s->editor);
    session_key(s, KEY_RIGHT, MOD_CTRL);
    session_key(s, KEY_UP, MOD_CTRL);
    assert_true(plot_of(s->editor)->frame0 > before.frame0 && plot_of(s->editor)->value0 > before.value0);
    session_key(s, KEY_LEFT, MOD_CTRL);
    session_key(s, KEY_DOWN, MOD_CTRL);
    assert_near(plot_of(s->editor)->frame0, before.frame0, 1e-3);
    assert_near(plot_of(s->editor)->value1, before.value1, 1e-3);
    session_key(s, '=', MOD_CTRL);
    assert_near(plot_of(s->editor)->frame1 - plot_of(s->editor)->frame0, 0.8 * (before.frame1 - before.frame0), 1e-3);
    session_key(s, '-', MOD_CTRL);
    assert_near(plot_of(s->editor)->frame1, before.frame1, 1e-3);
}

SESSION_TEST(test_the_camera_turns_and_comes_back, session_open(s, scene))
{
    const struct camera before = *camera_of(s->editor);
    session_key(s, KEY_RIGHT, MOD_CTRL | MOD_SHIFT);
    session_key(s, KEY_UP, MOD_CTRL | MOD_SHIFT);
    session_key(s, KEY_PAGE_UP, MOD_CTRL | MOD_SHIFT);
    assert_true(camera_of(s->editor)->azimuth > before.azimuth && camera_of(s->editor)->elevation > before.elevation);
    assert_true(camera_of(s->editor)->distance < before.distance);
    session_key(s, KEY_HOME, MOD_SHIFT);
    assert_memory_equal(&before, camera_of(s->editor), sizeof before);
}

SESSION_TEST(test_panels_have_sizes_to_choose_from, session_open(s, scene))
{
    const struct layout *layout = layout_of(s->editor), first = *layout;
    session_key(s, KEY_F6, 0);
    session_key(s, KEY_F6, MOD_SHIFT);
    assert_true(layout->stage_share > first.stage_share && layout->inspector_width > first.inspector_width);
    session_key(s, KEY_F6, 0);
    session_key(s, KEY_F6, MOD_SHIFT);
    assert_true(layout->stage_share < first.stage_share);
    assert_true(layout->inspector_width < 480 && layout->inspector_width > first.inspector_width);
}

SESSION_TEST(test_a_warning_is_done_away_with, session_open(s, jump))
{
    assert_int_equal(warnings_of(s->editor)->count, 1);
    session_key(s, 'W', 0);
    session_frame(s);
    assert_int_equal(warnings_of(s->editor)->count, 0);
    session_key(s, 'Z', MOD_CTRL);
    assert_int_equal(warnings_of(s->editor)->count, 1);
}

SESSION_TEST(test_a_number_goes_to_its_default, session_open(s, scene))
{
    panel_tab_to(s, "frequency");
    session_key(s, KEY_DELETE, 0);
    assert_near(s->document->splines[0]->parameter[PARAMETER_FREQUENCY].value, 1, 1e-12);
    assert_int_equal(s->document->splines[0]->knot_count, 4);
    session_key(s, 'Z', MOD_CTRL);
    assert_near(s->document->splines[0]->parameter[PARAMETER_FREQUENCY].value, 0.5, 1e-12);
}

/// Whether a line of the accent's colour, as the focus is drawn, lies around a widget or the part of it that is set.
static bool is_ringed(const struct session *s, struct rect r)
{
    const struct drawlist *list = drawn_by(s->editor);
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *c = &list->commands[i];
        struct rect both = rect_intersect(c->bounds, r);
        bool around = both.w * both.h > 0.6f * fminf(r.w * r.h, c->bounds.w * c->bounds.h);
        bool near = c->bounds.h < r.h + 20; // a handle has a ring of 18 pixels
        if (c->kind == DRAW_LINE && c->color == theme()->accent && around && near) return true;
    }
    return false;
}

static struct rect rect_of_focus(const struct ui *ui)
{
    for (int i = 0; i < ui->stop_count; i++) {
        if (ui->stop[i].id == ui->focus) return ui->stop[i].rect;
    }
    fail_msg("what has the focus is not shown");
    return (struct rect){0};
}

/// Goes round with Tab, and sees the focus wherever it is. Returns how many places there are.
static int tab_round(struct session *s)
{
    struct ui *ui = inspector_of(s->editor);
    session_key(s, KEY_TAB, 0);
    const uint32_t first = ui->focus;
    int count = 0;
    do {
        struct rect r = rect_of_focus(ui);
        if (!is_ringed(s, r)) {
            fail_msg("stop %d, at %g, %g and %g × %g, has no ring", count, (double)r.x, (double)r.y, (double)r.w,
                     (double)r.h);
        }
        session_key(s, KEY_TAB, 0);
        count++;
    } while (ui->focus != first && count < UI_MAX_FOCUS);
    return count;
}

SESSION_TEST(test_the_focus_is_seen_wherever_it_goes, session_open(s, scene))
{
    unfold(s->editor, "section.scene");
    unfold(s->editor, "section.poles");
    unfold(s->editor, "section.history");
    session_click(s, "knot(sway,1)");
    assert_true(tab_round(s) > 45);
}

/// Each stop is counted once, and after the last comes the first.
static void assert_goes_round(struct session *s)
{
    const struct ui *ui = inspector_of(s->editor);
    panel_unfold(s);
    const int stops = ui->stop_count;
    assert_true(stops > 60 && stops < UI_MAX_FOCUS);
    assert_int_equal(tab_round(s), stops);
}

/// The start scene has a spline with the name of a button: up.
SESSION_TEST(test_tab_goes_round_the_start_scene, session_open_file(s, "assets/scenes/tail.json"))
{
    assert_goes_round(s);
}

/// Each has its own switches for onion skin, motion arc and ghost.
SESSION_TEST(test_tab_goes_round_a_tail_and_a_character,
             session_open(s, "{\"frames\": [0, 48], \"splines\": [{\"name\": \"down\", \"knots\": [{\"frame\": 9, "
                             "\"value\": 1}]}], \"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"spline\": "
                             "\"down\"}, {\"type\": \"character\", \"model\": \"none.glb\", \"coordinates\": "
                             "[{\"name\": \"a\", \"spline\": \"down\"}]}]}"))
{
    assert_goes_round(s);
}
