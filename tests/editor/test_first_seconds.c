/// What a newcomer meets at once: things that swing can be caught, figures play, and no text lies over a character.
#include "panel_session.h"

#include "base/file.h"
#include "editor/stage/state.h"

static const char swings[] =
    "{\"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.02, \"start\": "
    "\"loop\", \"knots\": [{\"frame\": 0, \"value\": 1}, {\"frame\": 48, \"value\": 1}]},{\"name\": \"run\", "
    "\"mode\": \"cubic\", \"start\": \"loop\", \"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 48, \"value\": "
    "9}]}],\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"position\": [%s, 0.26, 0], \"channels\": "
    "[{\"spline\": \"sway\", \"lag\": 6, \"gain\": 6}]}]}";

static void open_swinging(struct session *s, const char *x)
{
    char scene[1024];
    snprintf(scene, sizeof scene, swings, x);
    session_open(s, scene);
    session_key(s, KEY_SPACE, 0);
    for (int i = 0; i < 30; i++) session_frame(s);
}

/// Where the pointer was put, nothing is after a quarter of a second; the press still takes what it was put on.
static void late_press(const char *target, const char *x, const char *taken)
{
    struct session s;
    open_swinging(&s, x);
    session_point(&s, target);
    for (int i = 0; i < 15; i++) session_frame(&s);
    assert_null(hovered(s.editor));
    session_press(&s, BUTTON_LEFT, 1);
    assert_string_equal(dragged(s.editor), taken);
    session_release(&s, BUTTON_LEFT);
    session_close(&s);
}

TEST(test_a_tail_that_swings_is_caught) { late_press("tail(tail,0.95)", "0", "Pull tail"); }

TEST(test_a_body_that_runs_is_caught) { late_press("body(tail)", "{\"spline\": \"run\"}", "Move body"); }

/// While the scene stands, what is pressed is what is seen.
SESSION_TEST(test_nothing_is_caught_at_rest, open_swinging(s, "0"))
{
    session_point(s, "tail(tail,0.95)");
    for (int i = 0; i < 15; i++) session_frame(s);
    session_key(s, KEY_SPACE, 0);
    session_press(s, BUTTON_LEFT, 1);
    assert_null(dragged(s->editor)); // the camera turns
    session_release(s, BUTTON_LEFT);
}

/// The highest point of any tail or body over the whole scene, pixels from the stage's upper edge.
static float highest(struct session *s)
{
    const struct stage *stage = s->editor->stage;
    float y = INFINITY;
    for (int t = 0; t < stage->tail_count; t++) {
        const float *base = stage->strands[t].pose.matrix[0] + 12;
        const float ears[3] = {base[0], base[1] + 0.8f, base[2] - 0.4f};
        float xy[2];
        assert_true(stage_project_point(s->editor->stage, layout_of(s->editor)->stage, ears, xy));
        y = fminf(y, xy[1]);
        for (int n = 0; n < stage->strands[t].pose.count; n++) {
            stage_project_point(s->editor->stage, layout_of(s->editor)->stage, stage->strands[t].pose.matrix[n] + 12,
                                xy);
            y = fminf(y, xy[1]);
        }
    }
    return y - layout_of(s->editor)->stage.y;
}

TEST(test_figures_play_below_their_captions)
{
    for (int figure = 1; figure <= 6; figure++) {
        char path[64];
        size_t size;
        char *text;
        snprintf(path, sizeof path, "assets/scenes/figure%d.json", figure);
        assert_done(file_read(path, 1 << 20, &text, &size, &error));
        struct session s;
        session_open(&s, text);
        editor_open(s.editor, &s.world);
        session_frame(&s);
        assert_true(playback_of(s.editor)->playing);
        const float caption = caption_height(layout_of(s.editor)->stage, s.document);
        assert_true(caption > 30);
        for (int i = 0; i < 120; i++) {
            session_frame(&s);
            assert_true(highest(&s) > caption);
        }
        free(text);
        session_close(&s);
    }
}

/// Two tails have their names at their feet, each behind a dot in the colour of its curve.
SESSION_TEST(
    test_two_tails_are_told_apart,
    session_open(
        s,
        "{\"frames\": [0, 24], \"splines\": [{\"name\": \"a\", \"color\": \"#ff8000\"}, {\"name\": \"b\", \"color\": "
        "\"#0080ff\"}], "
        "\"rigs\": [{\"type\": \"tail\", \"name\": \"old\", \"channels\": [{\"spline\": \"a\"}]}, "
        "{\"type\": \"tail\", \"name\": \"new\", \"position\": [2, 0, 0], \"channels\": [{\"spline\": \"b\"}]}]}"))
{
    session_frame(s);
    const struct rect stage = layout_of(s->editor)->stage;
    const struct drawlist *list = drawn_by(s->editor);
    float x[2] = {0};
    for (int i = 1; i < list->count; i++) {
        const struct draw_command *command = &list->commands[i];
        if (command->kind != DRAW_TEXT || !rect_contains(stage, command->x, command->y)) continue;
        for (int t = 0; t < 2; t++) {
            if (strcmp(list->text + command->first, t ? "new" : "old") != 0) continue;
            x[t] = command->x;
            assert_int_equal(list->commands[i - 1].color, spline_list_color(s->document, t));
        }
    }
    assert_true(x[0] > 0 && x[1] > 0 && fabsf(x[0] - x[1]) > 100);
}
