/// The app's frames and files, without a picture.
#include "blind.h"

#include "temporary.h"
#include <stdio.h>

/// A scene in a file of its own, with knots at frames 0 and 36.
static const char *scene_file(void)
{
    static const char text[] = "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": "
                               "[{\"frame\": 0, \"value\": 0}, {\"frame\": 36, \"value\": 1}]}]}";
    return temporary_file("app.json", text, sizeof text - 1);
}

static void send_key(struct blind *blind, int key, unsigned mods)
{
    blind_send(blind, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_PRESS, .mods = mods});
    blind_send(blind, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_RELEASE, .mods = mods});
}

static void send_pointer(struct blind *blind, enum event_kind kind, float x, float y)
{
    blind_send(blind, (struct event){.kind = kind, .action = ACTION_PRESS, .clicks = 1, .x = x, .y = y});
}

/// A figure is opened at the end of the frame, when the pointer has already begun to drag a knot: the drag ends there.
static void a_figure_ends_a_drag_that_begins_in_its_frame(void **state)
{
    (void)state;
    struct blind blind;
    blind_open(&blind, scene_file());
    blind_frame(&blind);
    struct app *app = &blind.app;
    struct editor_world world = app_world(app);
    float x, y;
    assert_true(editor_target(app->editor, &world, "knot(s,1)", &x, &y, NULL));
    send_pointer(&blind, EVENT_POINTER, x, y);
    send_pointer(&blind, EVENT_BUTTON, x, y);
    send_key(&blind, '3', MOD_CTRL);
    send_pointer(&blind, EVENT_POINTER, x, y - 40);
    blind_frame(&blind);
    assert_false(history_is_open(app->history));
    assert_string_equal(history_undo_label(app->history), "Open a figure");
    assert_int_equal(history_count(app->history), 2);
    blind_frame(&blind);
    send_key(&blind, 'Z', MOD_CTRL);
    blind_frame(&blind);
    assert_true(app->document->splines[0].knots[1].value > 1);
    blind_close(&blind);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_figure_ends_a_drag_that_begins_in_its_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
