/// Details of the editor, one each: notches of the wheel, lists longer than the screen and what typing finds in them, held letters, targets of
/// recordings.
#include "hands.h"
#include "ui/theme.h"
#include "ui/widgets.h"

static const char tail[] =
    "{'wiggly': 1, 'frames': [0, 120], 'splines': [{'name': 'sway', 'frequency': 1, 'knots': [<0 0.8>, <40 "
    "-1>]}, {'name': 'lift', 'frequency': 0.5, 'knots': [<20 0.4>]}], 'rigs': [{'type': 'tail', 'name': 'tail', "
    "'channels': [{'spline': 'sway', 'axis': 'side'}, {'spline': 'lift', 'axis': 'up', 'gain': 3}]}]}";

/// How many frames a pixel is wide.
static double frames_wide(const struct session *s) { return 1 / (double)(x_of(s->editor, 1) - x_of(s->editor, 0)); }

/// A turn of two notches is as much as two of one.
SESSION_TEST(notches_of_the_wheel_add_up, session_open(s, tail))
{
    static const char *const turns[] = {"point curve(sway,40,-0.5)", "wheel 1; wheel 1", "wheel 2", "wheel -4"};
    double width[4];
    for (int i = 0; i < 4; i++) {
        hands(s, "%s", turns[i]);
        width[i] = frames_wide(s);
    }
    assert_true(width[1] < 0.95 * width[0] && width[1] > 0.3 * width[0]);
    assert_near(width[2] / width[1], width[1] / width[0], 1e-3);
    assert_near(width[3], width[0], 1e-3 * width[0]);
}

/// More splines than the window is high: the wheel turns the open list, wherever on it the pointer is.
TEST(a_long_list_turns_by_wheel)
{
    static char scene[8000] = "{'wiggly': 1, 'frames': [0, 48], 'splines': [";
    for (int i = 0; i < 60; i++) sprintf(scene + strlen(scene), "%s{'name': 's%d', 'knots': []}", i ? "," : "", i);
    struct session session, *const s = &session;
    panel_open(s, strcat(scene, "], 'rigs': []}"), 1280, 600);
    hands(s, "click follow.frequency; finds item.s1; lacks item.s59; point item.s3");
    for (int i = 0; i < 20; i++) session_wheel(s, -5);
    hands(s, "finds item.s59; lacks item.s1");
    session_close(s);
}

static double lag_of(const struct session *s, int channel)
{
    return angles_number(&s->document->rigs[0]->tail.channels[channel].lag, 0);
}

/// L and an arrow: the lag of the channel that the active spline drives, whichever it is.
SESSION_TEST(lag_is_the_active_splines, session_open(s, tail))
{
    for (int active = 0; active < 2; active++) {
        const double before[2] = {lag_of(s, 0), lag_of(s, 1)};
        core_choose(&s->editor->core, active);
        hands(s, "keep; hold L; key Up; let L");
        assert_near(lag_of(s, active), before[active] + 0.5, 1e-9);
        assert_near(lag_of(s, 1 - active), before[1 - active], 0);
        hands(s, "key Ctrl+Z; kept");
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
    EACH_DRAWN(c, s->editor)
    {
        found +=
            c->kind == DRAW_CONVEX && c->color == theme()->spline[0] && fabsf(c->bounds.y + c->bounds.h / 2 - y) < 2;
    }
    assert_int_equal(found, 1);
}

/// Lines that are drawn within 10 pixels of a widget's middle.
static int lines_at(struct session *s, const char *widget)
{
    float x, y;
    int count = 0;
    assert_true(widget_at(s->editor, widget, &x, &y));
    EACH_DRAWN(c, s->editor)
    {
        const struct rect *b = &c->bounds;
        const bool is_inside = b->x > x - 10 && b->x + b->w < x + 10 && b->y > y - 10 && b->y + b->h < y + 10;
        count += c->kind == DRAW_LINE && is_inside;
    }
    return count;
}

SESSION_TEST(small_buttons_have_their_icons, panel_open(s, tail, 1280, 1400))
{
    hands(s, "hover spline.sway");
    assert_true(lines_at(s, "eye.sway") > 0);
    assert_true(lines_at(s, "lock.sway") > 0);
}

/// A letter that is let go while a dialog, which no key has opened, is open is no longer held once that is closed.
SESSION_TEST(a_letter_let_go_in_a_dialog_is_not_held, session_open(s, tail))
{
    hands(s, "keep; hold F");
    offer_recovery(s->editor, &(struct recovery_offer){.name = "walk.json"});
    hands(s, "is asked recover; let F; key Escape; is asked none; key Up; kept");
}

WALK(nothing_to_follow_is_an_error,
     panel_open(s, "{'wiggly': 1, 'frames': [0, 48], 'splines': [{'name': 'alone', 'knots': []}], 'rigs': []}", 1280,
                720),
     "click follow.frequency; error no other spline for alone to follow")

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
WALK(a_first_frame_asks_for_its_knots, panel_open(s, tail, 1280, 1600),
     "enter scene.first 30; is asked ask; key T; is frames.0 30; sway.knots 1; lift.knots 0")

/// A preset is no state that something is in: none of their buttons looks like the one that Enter presses.
SESSION_TEST(presets_look_alike_and_plain, panel_open(s, tail, 1280, 1400))
{
    static const char *const presets[] = {"preset.cat", "preset.whip", "preset.heavy", "preset.jelly",
                                          "preset.antenna"};
    for (size_t p = 0; p < sizeof presets / sizeof *presets; p++) {
        float x, y;
        assert_true(widget_at(s->editor, presets[p], &x, &y));
        EACH_DRAWN(c, s->editor)
        {
            const bool covers = c->kind != DRAW_TEXT && c->bounds.w < 200 && rect_contains(c->bounds, x, y);
            if (covers && c->color == theme()->accent) fail_msg("%s stands out", presets[p]);
        }
    }
}

// --- what typing finds in a list ---

TEST(typing_fits_names)
{
    static const struct {
        const char *typed, *text;
        enum fit fit;
    } cases[] = {
        {"", "tail_1", FIT_START},
        {"tail", "tail_1", FIT_START},
        {"TAIL", "tail_1", FIT_START},
        {"spl", "Add a spline", FIT_WORD},
        {"pli", "Add a spline", FIT_INSIDE},
        {"asp", "Add a spline", FIT_NOT}, // three letters lie scattered in too many
        {"apln", "Add a spline", FIT_LETTERS},
        {"spline add", "Add a spline", FIT_WORD},
        {"add x", "Add a spline", FIT_NOT},
        {"enilps", "Add a spline", FIT_NOT},
        {"1", "tail_1", FIT_WORD},
        {"ü", "Schwänze über", FIT_WORD},
        {"nze", "Schwänze", FIT_INSIDE},
        {"  ", "tail_1", FIT_START},
        {"tail_12", "tail_1", FIT_NOT},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct ui_filter filter = {.typed = ""};
        strcpy(filter.typed, cases[i].typed);
        const enum fit fit = ui_filter_fit(&filter, cases[i].text);
        if (fit != cases[i].fit)
            fail_msg("“%s” in “%s”: expected %d, got %d", cases[i].typed, cases[i].text, (int)cases[i].fit, (int)fit);
    }
}

static bool type(struct ui_filter *filter, uint32_t codepoint)
{
    return ui_filter_event(filter, &(struct event){.kind = EVENT_TEXT, .codepoint = codepoint});
}

/// Characters of several bytes come and go whole; what is full stays as it is.
TEST(a_filter_is_typed)
{
    const struct event back = {.kind = EVENT_KEY, .key = KEY_BACKSPACE, .action = ACTION_PRESS};
    struct ui_filter filter = {.typed = ""};
    assert_false(type(&filter, ' '));
    assert_false(ui_filter_event(&filter, &back));
    assert_true(type(&filter, 'a') && type(&filter, 0x2026) && type(&filter, ' '));
    assert_string_equal(filter.typed, "a… ");
    assert_true(ui_filter_event(&filter, &back) && ui_filter_event(&filter, &back));
    assert_string_equal(filter.typed, "a");
    while (type(&filter, 0x1F98A)) continue;
    assert_true(strlen(filter.typed) < sizeof filter.typed && strlen(filter.typed) % 4 == 1);
}
