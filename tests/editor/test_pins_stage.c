/// Pins by mouse and keyboard: on the stage, on the ruler, in the inspector.
#include "panel_session.h"
#include "shown.h"

#include "editor/core/rigs.h"
#include "editor/core/view.h"
#include "scene/pins.h"

static const char tail[] =
    "{\"wiggly\": 1, \"frames\": [0, 60], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"damping\": 0.1, "
    "\"knots\": [{\"frame\": 0, \"value\": 0}]}, {\"name\": \"u\", \"frequency\": 0.7, \"damping\": 0.1, \"knots\": "
    "[{\"frame\": 0, \"value\": 0}]}], \"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"position\": [0, 0.4, "
    "0], \"channels\": [{\"spline\": \"s\", \"axis\": \"side\"}, {\"spline\": \"u\", \"axis\": \"up\"}]}]}";

static const char creature[] =
    "{\"wiggly\": 1, \"frames\": [0, 60], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"damping\": 0.1, "
    "\"knots\": []}, {\"name\": \"u\", \"frequency\": 0.7, \"damping\": 0.1, \"knots\": []}], \"rigs\": [{\"type\": "
    "\"character\", \"name\": \"c\", \"model\": \"assets/models/creature.glb\", \"coordinates\": [{\"name\": \"up\", "
    "\"spline\": \"s\"}, {\"name\": \"side\", \"spline\": \"u\"}]}]}";

static void open_tail(struct session *s)
{
    panel_open_models(s, tail);
    session_frame(s);
}

static int pins_of(const struct session *s) { return s->document->rigs[0]->pin_count; }
static const struct pin *pin_of(const struct session *s, int at) { return &s->document->rigs[0]->pins[at]; }

/// Presses on a target with Ctrl, which pins joints, and drags.
static void pull_with_ctrl(struct session *s, const char *target, float dx, float dy)
{
    s->mods = MOD_CTRL;
    session_point(s, target);
    session_press(s, BUTTON_LEFT, 1);
    s->mods = 0;
    session_drag(s, dx, dy, 4);
}

SESSION_TEST(test_ctrl_and_a_drag_pin_a_joint_which_follows_the_pointer, open_tail(s))
{
    for (int step = 0; step < 10; step++) session_key(s, KEY_RIGHT, 0);
    const char *before = session_saved(s);
    pull_with_ctrl(s, "tail(tail,1)", 0, -30);
    float tip[2], marker[2];
    session_where(s, "tail(tail,1)", tip);
    session_where(s, "pin(tail,0)", marker);
    const float x = s->x, y = s->y;
    session_release(s, BUTTON_LEFT);
    assert_int_equal(pins_of(s), 1);
    assert_int_equal(pin_of(s, 0)->point, 23);
    assert_near(pin_of(s, 0)->frame, 10, 0);
    assert_true(hypotf(marker[0] - x, marker[1] - y) < 1);
    const float apart = hypotf(tip[0] - marker[0], tip[1] - marker[1]);
    if (!(apart < 8)) fail_msg("the tip is %g pixels from the pointer", (double)apart);
    assert_int_equal(s->document->splines[0]->knot_count, 1);
    assert_one_step(s, before);
}

SESSION_TEST(test_the_plain_drag_still_sets_knots, open_tail(s))
{
    for (int step = 0; step < 10; step++) session_key(s, KEY_RIGHT, 0);
    session_pull(s, "tail(tail,0.9)", 20, 20, 4);
    session_release(s, BUTTON_LEFT);
    assert_int_equal(pins_of(s), 0);
    assert_int_equal(s->document->splines[0]->knot_count, 2);
}

SESSION_TEST(test_an_axis_can_be_locked_and_esc_cancels, open_tail(s))
{
    const char *before = session_saved(s);
    pull_with_ctrl(s, "tail(tail,1)", 30, 25);
    const struct pin free_pin = *pin_of(s, 0);
    session_key(s, 'Y', 0);
    const struct pin locked = *pin_of(s, 0);
    assert_true(locked.to[1] != free_pin.to[1] || locked.to[0] != free_pin.to[0]);
    session_key(s, 'X', 0);
    const struct pin other = *pin_of(s, 0);
    assert_true(locked.to[0] != other.to[0]);
    assert_near(locked.to[2], other.to[2], 1e-9); // neither moves along z
    session_key(s, KEY_ESCAPE, 0);
    assert_saved(s, before);
    session_release(s, BUTTON_LEFT);
    session_key(s, KEY_DELETE, 0); // nothing is selected now
    assert_saved(s, before);
}

/// Pins the tip where it is, at frame 10.
static void pin_the_tip(struct session *s)
{
    for (int step = 0; step < 10; step++) session_key(s, KEY_RIGHT, 0);
    session_point(s, "tail(tail,1)");
    session_frame(s);
    session_key(s, 'H', 0);
}

SESSION_TEST(test_a_pin_is_moved_nudged_retimed_and_deleted_by_keys, open_tail(s))
{
    pin_the_tip(s);
    assert_int_equal(pins_of(s), 1);
    const char *placed = session_saved(s);
    const struct pin first = *pin_of(s, 0);
    session_key(s, KEY_UP, MOD_ALT);
    session_key(s, KEY_UP, MOD_ALT);
    assert_true(pin_of(s, 0)->to[1] > first.to[1] + 0.01);
    assert_one_step(s, placed); // both nudges
    session_key(s, KEY_PAGE_DOWN, MOD_ALT);
    assert_near(pin_of(s, 0)->frame, 11, 0);
    assert_near(shown_frame(s->editor), 11, 0);
    session_move(s, 2, 2);
    session_frame(s);
    for (int step = 0; step < 9; step++) session_key(s, KEY_RIGHT, 0);
    session_key(s, 'H', 0); // the same point, once more
    assert_non_null(
        shown_text(s->editor, "Pinned at frame 20. Drag the marker, or type its place in the section Pins."));
    assert_int_equal(pins_of(s), 2);
    assert_near(pin_of(s, 1)->frame, 20, 0);
    assert_near(pin_of(s, 1)->to[1], pin_of(s, 0)->to[1], 0);
    session_type(s, ",");
    assert_near(shown_frame(s->editor), 11, 0);
    session_key(s, KEY_DELETE, 0);
    assert_int_equal(pins_of(s), 1);
    assert_near(pin_of(s, 0)->frame, 20, 0);
}

SESSION_TEST(test_a_marker_is_dragged_on_the_stage_and_on_the_ruler, open_tail(s))
{
    pin_the_tip(s);
    session_key(s, KEY_ESCAPE, 0);
    const char *placed = session_saved(s);
    session_pull(s, "pin(tail,0)", 0, -25, 4);
    session_release(s, BUTTON_LEFT);
    assert_int_equal(pins_of(s), 1);
    assert_one_step(s, placed);
    const char *moved = session_saved(s);
    float from[2], to[2];
    session_where(s, "ruler(10)", from);
    session_where(s, "ruler(25)", to);
    session_pull(s, "pintime(tail,0)", to[0] - from[0], 0, 4);
    session_release(s, BUTTON_LEFT);
    assert_near(pin_of(s, 0)->frame, 25, 0);
    assert_near(shown_frame(s->editor), 25, 0);
    assert_one_step(s, moved);
    float mark[2];
    session_where(s, "pintime(tail,0)", mark); // it hangs over the ruler's edge, and is taken there, too
    session_move(s, mark[0], mark[1] + 4);
    while (said(s->editor)[0]) session_frame(s);
    session_frame(s);
    assert_non_null(shown_text(s->editor,
                               "Drag to move the pin in time (Ctrl: off frames); Del removes it; Alt+PgUp, "
                               "Alt+PgDn: by a frame"));
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, to[0] - from[0], 0, 4);
    session_release(s, BUTTON_LEFT);
    assert_near(pin_of(s, 0)->frame, 40, 0);
}

/// Of two marks close together on the ruler the nearer one is under the pointer, unless the other is selected and in reach.
SESSION_TEST(test_the_selected_mark_is_taken_first, open_tail(s))
{
    float marks[2][2];
    pin_the_tip(s);
    session_key(s, KEY_ESCAPE, 0);
    session_key(s, KEY_RIGHT, 0);
    session_key(s, 'H', 0);
    session_key(s, KEY_ESCAPE, 0);
    assert_int_equal(pins_of(s), 2);
    plot_of(s->editor)->frame0 -= 400; // frames are so narrow that both marks are in reach
    plot_of(s->editor)->frame1 += 400;
    session_frame(s);
    for (int m = 0; m < 2; m++) session_where(s, m ? "pintime(tail,1)" : "pintime(tail,0)", marks[m]);
    assert_true(marks[1][0] - marks[0][0] > 1 && marks[1][0] - marks[0][0] < 5);
    for (int chosen = -1; chosen < 2; chosen++) {
        for (int m = 0; m < 2; m++) {
            s->editor->core.focus.pin = (struct pin_selection){.any = chosen >= 0, .id = pin_of(s, chosen > 0)->id};
            session_move(s, marks[m][0], marks[m][1]);
            session_frame(s);
            assert_ptr_equal(hovered(s->editor), &thing_pin_time);
            assert_int_equal(s->editor->core.input.hover.pin, pin_of(s, chosen >= 0 ? chosen : m)->id);
        }
    }
    session_move(s, marks[1][0] + 20, marks[1][1]);
    session_frame(s);
    assert_ptr_not_equal(hovered(s->editor), &thing_pin_time);
}

/// A pin that throws a rig far makes its curves high: they come into sight.
SESSION_TEST(test_the_curves_follow_a_pin, panel_open_models(s, creature))
{
    session_frame(s);
    for (int step = 0; step < 10; step++) session_key(s, KEY_RIGHT, 0);
    session_pull(s, "character(c,0.5,0.8)", 120, -80, 4);
    session_release(s, BUTTON_LEFT);
    assert_int_equal(pins_of(s), 1);
    for (int frame = 0; frame < 90; frame++) session_frame(s);
    const struct plotted *view = plot_of(s->editor);
    for (int i = 0; i < 2; i++) {
        for (int sample = 0; sample <= 60; sample++) {
            const double total = s->world.evaluation->curves[i].total[sample];
            assert_true(total < view->value1 && total > view->value0);
        }
    }
}

SESSION_TEST(test_the_surface_of_a_character_is_pinned_and_follows_the_pointer, panel_open_models(s, creature))
{
    session_frame(s);
    for (int step = 0; step < 10; step++) session_key(s, KEY_RIGHT, 0);
    const char *before = session_saved(s);
    session_point(s, "character(c,0.5,0.9)");
    session_frame(s);
    assert_ptr_equal(hovered(s->editor), &thing_point);
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 25, 8, 4);
    session_release(s, BUTTON_LEFT);
    assert_int_equal(pins_of(s), 1);
    const struct pin_left *left = evaluation_pin(&s->work.evaluation, s->document, 0, 0);
    assert_non_null(left);
    assert_true(left->is_found);
    assert_true(fabs(left->way[0]) < 0.05 && fabs(left->way[1]) < 0.05);
    assert_one_step(s, before);
}

/// The soles hardly move: pulling them would throw all else far.
SESSION_TEST(test_what_hardly_moves_does_not_light_up, panel_open_models(s, creature))
{
    session_frame(s);
    session_point(s, "character(c,0.4,0.01)");
    session_frame(s);
    assert_null(hovered(s->editor));
}

/// Without a mouse: H pins what moves most, Tab leads to its numbers.
TEST(test_the_keyboard_alone_is_enough)
{
    struct session s;
    panel_open_models(&s, creature);
    session_move(&s, 2, 2);
    session_frame(&s);
    session_key(&s, 'H', 0);
    assert_int_equal(pins_of(&s), 1);
    session_close(&s);
    open_tail(&s);
    session_move(&s, 2, 2);
    session_frame(&s);
    session_key(&s, 'H', 0);
    assert_int_equal(pins_of(&s), 1);
    assert_int_equal(pin_of(&s, 0)->point, 23);
    session_close(&s);
}

/// So they do where its place is typed.
SESSION_TEST(test_the_curves_follow_a_typed_place, panel_open_models(s, creature))
{
    session_frame(s);
    for (int step = 0; step < 10; step++) session_key(s, KEY_RIGHT, 0);
    session_pull(s, "character(c,0.5,0.8)", 20, -10, 4);
    session_release(s, BUTTON_LEFT);
    for (int frame = 0; frame < 90; frame++) session_frame(s);
    panel_enter(s, "pin.y", "3");
    for (int frame = 0; frame < 90; frame++) session_frame(s);
    const wiggly_curve *curve = s->world.evaluation->curves;
    for (int sample = 0; sample <= 60; sample++) assert_true(curve->total[sample] < plot_of(s->editor)->value1);
}

SESSION_TEST(test_the_inspector_lists_pins_and_takes_numbers, open_tail(s))
{
    session_point(s, "tail(tail,1)");
    session_frame(s);
    session_key(s, 'H', 0);
    session_key(s, KEY_ESCAPE, 0);
    assert_false(panel_shows(s, "pin.x"));
    panel_click(s, "pin.0");
    assert_true(panel_shows(s, "pin.x"));
    panel_enter(s, "pin.x", "0.25");
    assert_near(pin_of(s, 0)->to[0], 0.25, 0);
    panel_enter(s, "pin.frame", "12");
    assert_near(pin_of(s, 0)->frame, 12, 0);
    panel_enter(s, "pin.point", "11");
    assert_int_equal(pin_of(s, 0)->point, 11);
    panel_click(s, "pin.0.remove");
    assert_int_equal(pins_of(s), 0);
}
