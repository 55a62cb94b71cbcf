/// Larger type, and presenting: how large everything is, panels that slide away, keys as they are pressed.
#include "blind.h"
#include "documents.h"
#include "questions.h"
#include "shown.h"

static struct core *core_of(struct blind *b) { return &b->app.work.editor->core; }

/// The pointer in device pixels, as a window at scale 1 sends it.
static void point(struct blind *b, float x, float y)
{
    blind_send(b, (struct event){.kind = EVENT_POINTER, .x = x, .y = y});
    blind_frame(b);
}

static void frames(struct blind *b, int count)
{
    for (int i = 0; i < count; i++) blind_frame(b);
}

enum { CTRL_SHIFT = MOD_CTRL | MOD_SHIFT };

BLIND_TEST(test_keys_make_everything_larger_and_smaller, blind_open(b, NULL))
{
    blind_key(b, '=', CTRL_SHIFT);
    assert_near(core_of(b)->view.layout.window.w, 1024, 1e-3);
    assert_near(core_of(b)->view.scale, 1.25, 1e-6);
    assert_non_null(shown_text(b->app.work.editor, "125 %"));
    blind_key(b, KEY_F8, 0);
    assert_near(core_of(b)->view.scale, 1.5, 1e-6);
    blind_key(b, '-', CTRL_SHIFT);
    blind_key(b, '-', CTRL_SHIFT);
    blind_key(b, KEY_F8, MOD_SHIFT);
    assert_near(core_of(b)->view.scale, 0.75, 1e-6);
    blind_key(b, '-', CTRL_SHIFT);
    assert_near(core_of(b)->view.scale, 0.75, 1e-6);
    blind_key(b, '0', CTRL_SHIFT);
    assert_near(core_of(b)->view.layout.window.w, 1280, 1e-3);
}

/// What is on the screen under the pointer stays there.
BLIND_TEST(test_the_pointer_means_the_same_place, blind_open(b, NULL))
{
    point(b, 640, 300);
    blind_key(b, '=', CTRL_SHIFT);
    assert_near(core_of(b)->input.pointer_x, 512, 1e-3);
    point(b, 700, 500);
    assert_near(core_of(b)->input.pointer_x, 560, 1e-3);
    assert_near(core_of(b)->input.pointer_y, 400, 1e-3);
}

BLIND_TEST(test_a_scale_without_room_is_refused, blind_open(b, NULL))
{
    for (int i = 0; i < 4; i++) blind_key(b, '=', CTRL_SHIFT);
    assert_near(core_of(b)->view.scale, 1.5, 1e-6);
    assert_string_equal(core_of(b)->message.text, "175 % needs a window of 1330 × 700, not 1280 × 720");
    blind_frame(b);
    assert_non_null(shown_text(b->app.work.editor, core_of(b)->message.text)); // in full
    blind_send(b, (struct event){.kind = EVENT_SIZE, .x = 1000, .y = 600, .scale = 1});
    blind_frame(b);
    assert_near(core_of(b)->view.scale, 1.25, 1e-6);
    blind_send(b, (struct event){.kind = EVENT_SIZE, .x = 2560, .y = 1440, .scale = 2});
    blind_frame(b);
    assert_near(core_of(b)->view.scale, 3, 1e-6);
    assert_near(core_of(b)->view.layout.window.w, 2560 / 1.5, 1e-2);
    blind_send(b, (struct event){.kind = EVENT_SIZE, .x = 600, .y = 1000, .scale = 1});
    blind_frame(b);
    assert_near(core_of(b)->view.scale, 1.5, 1e-6); // upright it needs less
}

BLIND_TEST(test_the_status_line_changes_it_by_mouse, blind_open(b, NULL))
{
    const float x = 6 + 24 + 42 + 44 + 64 + 48 + 20;
    struct event press = {.kind = EVENT_BUTTON, .action = ACTION_PRESS, .clicks = 1, .x = x, .y = 708};
    blind_send(b, press);
    blind_frame(b);
    assert_near(core_of(b)->view.scale, 1.25, 1e-6);
    press.button = BUTTON_RIGHT; // the bar is higher now
    press.x *= 1.25f;
    blind_send(b, press);
    blind_frame(b);
    assert_near(core_of(b)->view.scale, 1, 1e-6);
}

BLIND_TEST(test_presenting_gives_the_stage_the_window_and_changes_nothing, blind_open(b, NULL))
{
    char *before = text_of_document(b->app.work.document);
    const struct layout normal = core_of(b)->view.layout;
    blind_key(b, KEY_F5, 0);
    frames(b, 30);
    const struct layout *l = &core_of(b)->view.layout;
    assert_near(core_of(b)->view.scale, 1.5, 1e-6);
    assert_near(l->stage.w * 1.5f, 1280, 1);
    assert_near(l->stage.h * 1.5f, 720, 1);
    assert_true(l->inspector.x >= l->window.w && l->curves.y >= l->window.h);
    assert_null(shown_text(b->app.work.editor, "Splines"));
    blind_key(b, KEY_ESCAPE, 0);
    assert_memory_equal(&core_of(b)->view.layout, &normal, sizeof normal);
    assert_non_null(shown_text(b->app.work.editor, "Splines"));
    assert_true(history_is_saved(b->app.work.history));
    assert_prints(b->app.work.document, before);
    free(before);
}

BLIND_TEST(test_a_panel_comes_when_the_pointer_does, blind_open(b, NULL))
{
    blind_key(b, KEY_F5, 0);
    frames(b, 30);
    point(b, 600, 300);
    frames(b, 30);
    assert_near(core_of(b)->view.presenter.side, 0, 0);
    point(b, 1275, 300);
    frames(b, 3);
    assert_true(core_of(b)->view.presenter.side > 0 && core_of(b)->view.presenter.side < 1);
    frames(b, 30);
    assert_near(core_of(b)->view.presenter.side, 1, 0);
    assert_near(core_of(b)->view.presenter.below, 0, 0);
    assert_near(core_of(b)->view.layout.stage.w * 1.5f, 1280, 1); // it lies over the stage
    point(b, 1000, 300);
    frames(b, 30);
    assert_near(core_of(b)->view.presenter.side, 1, 0);
    point(b, 300, 715);
    frames(b, 30);
    assert_near(core_of(b)->view.presenter.side, 0, 0);
    assert_near(core_of(b)->view.presenter.below, 1, 0);
    blind_key(b, KEY_TAB, 0);
    frames(b, 30);
    assert_near(core_of(b)->view.presenter.side, 1, 0);
    assert_true(core_of(b)->view.layout.stage.w <
                core_of(b)->view.layout.inspector.x + 1); // now they share the window
    blind_key(b, KEY_TAB, 0);
    frames(b, 30);
    assert_near(core_of(b)->view.presenter.below, 0, 0);
    blind_key(b, KEY_F5, 0);
    assert_false(core_of(b)->view.presenter.on);
}

/// There they come and go together.
BLIND_TEST(test_in_an_upright_window_all_panels_come_from_below, blind_open(b, NULL))
{
    blind_send(b, (struct event){.kind = EVENT_SIZE, .x = 390, .y = 792, .scale = 1});
    blind_key(b, KEY_F5, 0);
    frames(b, 30);
    const struct layout *l = &core_of(b)->view.layout;
    assert_near(l->stage.h, 792, 0);
    assert_true(l->curves.y >= 792 && l->inspector.y >= 792);
    struct event press = {.kind = EVENT_BUTTON, .action = ACTION_PRESS, .clicks = 1, .x = 200, .y = 785};
    point(b, 200, 785);
    frames(b, 2);
    for (int k = 0; k < 2; k++) { // what comes by: the ruler, and the first group's heading
        press.action = ACTION_PRESS;
        press.y = k ? l->inspector.y + 14 : l->ruler.y + 8;
        blind_send(b, press);
        if (!k) blind_frame(b);
        assert_null(core_of(b)->input.drag.owner);
        press.action = ACTION_RELEASE;
        blind_send(b, press);
    }
    frames(b, 30);
    assert_non_null(shown_text(b->app.work.editor, "damping")); // the group is still open
    assert_near(l->status.y + l->status.h, 792, 0);
    assert_near(l->inspector.y + l->inspector.h, l->status.y, 0);
    assert_near(l->stage.h, l->curves.y, 0); // they take their room from the stage
    point(b, 200, l->inspector.y + 20);
    frames(b, 30);
    assert_near(l->status.y + l->status.h, 792, 0);
    point(b, 200, 100);
    frames(b, 30);
    assert_true(l->curves.y >= 792 && l->inspector.y >= 792);
}

BLIND_TEST(test_what_is_pressed_is_shown_and_fades, blind_open(b, NULL))
{
    blind_key(b, 'Z', MOD_CTRL);
    assert_null(shown_text(b->app.work.editor, "Ctrl + Z"));
    blind_key(b, KEY_F5, 0);
    assert_non_null(shown_text(b->app.work.editor, "F5"));
    blind_key(b, 'Z', MOD_CTRL);
    assert_non_null(shown_text(b->app.work.editor, "Ctrl + Z"));
    assert_non_null(shown_text(b->app.work.editor, "Nothing to undo")); // the status line is away or on its way
    blind_key(b, 'Z', MOD_CTRL);
    assert_non_null(shown_text(b->app.work.editor, "Ctrl + Z ×2"));
    frames(b, 120);
    assert_null(shown_text(b->app.work.editor, "Ctrl + Z ×2"));
    struct event event = {
        .kind = EVENT_BUTTON, .button = BUTTON_RIGHT, .action = ACTION_PRESS, .clicks = 1, .x = 600, .y = 300};
    blind_send(b, event);
    blind_frame(b);
    assert_non_null(shown_text(b->app.work.editor, "right-click"));
    point(b, 640, 300);
    assert_non_null(shown_text(b->app.work.editor, "right drag"));
    frames(b, 120);
    assert_non_null(shown_text(b->app.work.editor, "right drag"));
    event.action = ACTION_RELEASE;
    blind_send(b, event);
    frames(b, 120);
    assert_null(shown_text(b->app.work.editor, "right drag"));
}
