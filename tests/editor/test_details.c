/// Details of the editor, one each: notches of the wheel, lists longer than the screen, held letters, targets of recordings.
#include "panel_session.h"
#include "shown.h"
#include "ui/theme.h"

static const char tail[] =
    "{\"wiggly\": 1, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"knots\": "
    "[{\"frame\": 0, \"value\": 0.8}, {\"frame\": 40, \"value\": -1}]},{\"name\": \"lift\", \"frequency\": 0.5, "
    "\"knots\": [{\"frame\": 20, \"value\": 0.4}]}], \"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", "
    "\"channels\": [{\"spline\": \"sway\", \"axis\": \"side\"}, {\"spline\": \"lift\", \"axis\": \"up\", \"gain\": "
    "3}]}]}";

static double frames_wide(struct session *s)
{
    float x[2], y;
    struct error error = {0};
    if (!editor_target(s->editor, "curve(sway,38,-0.5)", &x[0], &y, &error) ||
        !editor_target(s->editor, "curve(sway,42,-0.5)", &x[1], &y, &error)) {
        fail_msg("%s", error.text);
    }
    return 4 / (double)(x[1] - x[0]);
}

/// A turn of two notches is as much as two of one.
SESSION_TEST(notches_of_the_wheel_add_up, session_open(s, tail))
{
    double width[3];
    session_point(s, "curve(sway,40,-0.5)");
    width[0] = frames_wide(s);
    session_wheel(s, 1);
    session_wheel(s, 1);
    width[1] = frames_wide(s);
    session_wheel(s, 2);
    width[2] = frames_wide(s);
    assert_true(width[1] < 0.95 * width[0] && width[1] > 0.3 * width[0]);
    assert_near(width[2] / width[1], width[1] / width[0], 1e-3);
    session_wheel(s, -4);
    assert_near(frames_wide(s), width[0], 1e-3 * width[0]);
}

/// More splines than the window is high: the wheel turns the open list, wherever on it the pointer is.
TEST(a_long_list_turns_by_wheel)
{
    static char scene[8000];
    size_t end = (size_t)snprintf(scene, sizeof scene, "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [");
    for (int i = 0; i < 60; i++)
        end += (size_t)snprintf(scene + end, sizeof scene - end, "%s{\"name\": \"s%d\", \"knots\": []}", i ? "," : "",
                                i);
    snprintf(scene + end, sizeof scene - end, "], \"rigs\": []}");
    struct session s;
    panel_open(&s, scene, 1280, 600);
    panel_click(&s, "follow.frequency");
    assert_true(panel_shows(&s, "item.s1"));
    assert_false(panel_shows(&s, "item.s59"));
    float x, y;
    assert_true(widget_at(s.editor, "item.s3", &x, &y));
    session_move(&s, x, y);
    for (int i = 0; i < 20; i++) session_wheel(&s, -5);
    assert_true(panel_shows(&s, "item.s59"));
    assert_false(panel_shows(&s, "item.s1"));
    session_close(&s);
}

static double lag_of(const struct session *s, int channel)
{
    return angles_number(&s->document->rigs[0]->tail.channels[channel].lag, 0);
}

/// L and an arrow: the lag of the channel that the active spline drives, whichever it is.
TEST(lag_is_the_active_splines)
{
    for (int active = 0; active < 2; active++) {
        struct session s;
        session_open(&s, tail);
        core_choose(&s.editor->core, active);
        const double before[2] = {lag_of(&s, 0), lag_of(&s, 1)};
        session_hold(&s, 'L', ACTION_PRESS);
        session_key(&s, KEY_UP, 0);
        session_hold(&s, 'L', ACTION_RELEASE);
        assert_near(lag_of(&s, active), before[active] + 0.5, 1e-9);
        assert_near(lag_of(&s, 1 - active), before[1 - active], 0);
        session_close(&s);
    }
}

/// In the list of rigs each has the colour of the spline that moves it first.
SESSION_TEST(a_rig_has_the_colour_of_its_first_spline, panel_open(s, tail, 1280, 1400))
{
    float x, y;
    int found = 0;
    unfold(s->editor, "section.rigs");
    session_frame(s);
    assert_true(widget_at(s->editor, "tail.0", &x, &y));
    const struct drawlist *list = drawn_by(s->editor);
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *c = &list->commands[i];
        found +=
            c->kind == DRAW_CONVEX && c->color == theme()->spline[0] && fabsf(c->bounds.y + c->bounds.h / 2 - y) < 2;
    }
    assert_int_equal(found, 1);
}

/// Lines that are drawn within 10 pixels of a widget's middle.
static int lines_at(struct session *s, const char *widget)
{
    const struct drawlist *list = drawn_by(s->editor);
    float x, y;
    int count = 0;
    assert_true(widget_at(s->editor, widget, &x, &y));
    for (int i = 0; i < list->count; i++) {
        const struct rect *b = &list->commands[i].bounds;
        const bool is_inside = b->x > x - 10 && b->x + b->w < x + 10 && b->y > y - 10 && b->y + b->h < y + 10;
        count += list->commands[i].kind == DRAW_LINE && is_inside;
    }
    return count;
}

SESSION_TEST(small_buttons_have_their_icons, panel_open(s, tail, 1280, 1400))
{
    assert_true(lines_at(s, "eye.sway") > 0);
    assert_true(lines_at(s, "solo.sway") > 0);
}

/// The lines of equal damping say which they are; the lowest, at the edge, needs no number.
SESSION_TEST(the_map_of_poles_has_its_numbers, panel_open(s, tail, 1280, 1400))
{
    unfold(s->editor, "section.poles");
    session_frame(s);
    assert_non_null(shown_text(s->editor, "ζ 0.2"));
    assert_null(shown_text(s->editor, "ζ 0"));
}

/// A letter that is let go while a dialog is open is no longer held once that is closed.
SESSION_TEST(a_letter_let_go_in_a_dialog_is_not_held, session_open(s, tail))
{
    const char *before = session_saved(s);
    session_hold(s, 'F', ACTION_PRESS);
    offer_recovery(s->editor, &(struct recovery_offer){.name = "walk.json"}); // by no key
    assert_int_equal(asked(s->editor), DIALOG_RECOVER);
    session_hold(s, 'F', ACTION_RELEASE);
    session_key(s, KEY_ESCAPE, 0);
    assert_int_equal(asked(s->editor), DIALOG_NONE);
    session_key(s, KEY_UP, 0);
    assert_saved(s, before);
}

SESSION_TEST(
    nothing_to_follow_is_an_error,
    panel_open(
        s, "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"alone\", \"knots\": []}], \"rigs\": []}",
        1280, 720))
{
    panel_click(s, "follow.frequency");
    assert_said_error(s->editor, "no other spline for alone to follow");
}

/// What a recording names and the scene does not have is said.
SESSION_TEST(targets_that_are_missing_are_said, session_open(s, tail))
{
    static const char *const missing[] = {"pin(tail,0)",  "pintime(tail,0)", "knot(sway,7)",
                                          "knot(none,0)", "tail(none,0.5)",  "divider(none)"};
    for (size_t i = 0; i < sizeof missing / sizeof *missing; i++) {
        struct error error = {0};
        float x, y;
        if (editor_target(s->editor, missing[i], &x, &y, &error)) fail_msg("%s is there", missing[i]);
        assert_true(error.text[0]);
    }
}

SESSION_TEST(a_target_from_the_pointer, session_open(s, tail))
{
    float x, y;
    session_move(s, 300, 200);
    const float height = layout_of(s->editor)->stage.h;
    assert_done(editor_target(s->editor, "pointer(0.1,-0.2)", &x, &y, &error));
    assert_near(x, 300 + 0.1f * height, 1e-3);
    assert_near(y, 200 - 0.2f * height, 1e-3);
}

/// Knots before a first frame are asked about, as those behind a last one are.
SESSION_TEST(a_first_frame_asks_for_its_knots, panel_open(s, tail, 1280, 1600))
{
    panel_click(s, "section.scene");
    panel_enter(s, "scene.first", "30");
    assert_int_equal(asked(s->editor), DIALOG_ASK);
    session_key(s, 'T', 0);
    assert_int_equal(s->document->first_frame, 30);
    assert_int_equal(s->document->splines[0]->knot_count, 1);
    assert_int_equal(s->document->splines[1]->knot_count, 0);
}

/// A preset is no state that something is in: none of their buttons looks like the one that Enter presses.
SESSION_TEST(presets_look_alike_and_plain, panel_open(s, tail, 1280, 1400))
{
    static const char *const presets[] = {"preset.cat", "preset.whip", "preset.heavy", "preset.jelly",
                                          "preset.antenna"};
    const struct drawlist *list = drawn_by(s->editor);
    for (size_t p = 0; p < sizeof presets / sizeof *presets; p++) {
        float x, y;
        assert_true(widget_at(s->editor, presets[p], &x, &y));
        for (int i = 0; i < list->count; i++) {
            const struct draw_command *c = &list->commands[i];
            const bool covers = c->kind != DRAW_TEXT && c->bounds.w < 200 && rect_contains(c->bounds, x, y);
            if (covers && c->color == theme()->accent) fail_msg("%s stands out", presets[p]);
        }
    }
}
