/// The demo: all of it can be played, it begins anew by itself, and the first touch ends it.
#include "blind.h"
#include "questions.h"
#include "scene/load.h"
#include "shown.h"

static void demo_open(struct blind *b)
{
    blind_open(b, NULL);
    b->options.demo = true;
    b->app.demo = (struct demo){.on = true, .theme = theme_in_use()};
    assert_done(b->app.replay = demo_replay(&error));
}

static const char *caption(struct blind *b) { return b->app.work.editor->dialogs->caption; }

static uint64_t scene_now(const struct blind *b) { return scene_hash(b->app.work.document); }

#define DEMO_TEST(name) TEST_OF(struct blind, b, demo_open(b), blind_close(b), name)

/// Every target is there (else a frame fails), every caption fits, every kind of thing is shown, and the second round is the first.
DEMO_TEST(test_all_of_it_plays_and_begins_anew)
{
    bool seen[RIG_KINDS] = {false}, light = false, presents = false, records = false;
    const uint64_t first = scene_now(b);
    const long length = replay_get_header(b->app.replay)->frames;
    uint64_t changed = first;
    int edits = 0; ///< captions under which the scene became another
    char last[160] = "";
    assert_true(length > 100 * 60 && length < 140 * 60);
    for (long frame = 0; frame < length; frame++) {
        blind_frame(b);
        const struct document *document = b->app.work.document;
        for (int r = 0; r < document->rig_count; r++) seen[document->rigs[r]->kind] = true;
        light |= theme_in_use() == THEME_LIGHT;
        presents |= b->app.work.editor->core.view.presenter.on;
        records |= strstr(said(b->app.work.editor), "knots recorded") != NULL;
        if (strcmp(last, caption(b)) == 0) continue;
        snprintf(last, sizeof last, "%s", caption(b));
        if (!shown_text(b->app.work.editor, last)) fail_msg("the caption “%s” does not fit", last);
        edits += scene_now(b) != changed;
        changed = scene_now(b);
    }
    for (int kind = 0; kind < RIG_KINDS; kind++) assert_true(seen[kind]);
    assert_true(light && presents && records);
    assert_true(edits >= 9);
    assert_true(scene_now(b) != first);
    blind_frame(b);
    assert_int_equal(b->app.demo.frame, 0);
    assert_int_equal(scene_now(b), first);
    assert_int_equal(theme_in_use(), THEME_DARK);
    assert_true(b->app.demo.on);
}

static void plays_until(const struct event *event, bool stops)
{
    struct blind b;
    demo_open(&b);
    const uint64_t first = scene_now(&b);
    for (int i = 0; i < 9 * 60; i++) blind_frame(&b); // in the middle of a drag
    assert_string_equal(dragged(b.app.work.editor), "Move body");
    blind_send(&b, *event);
    blind_frame(&b);
    assert_int_equal(b.app.demo.on, !stops);
    if (stops) {
        assert_int_equal(scene_now(&b), first);
        assert_true(history_is_saved(b.app.work.history));
        assert_string_equal(caption(&b), "");
        assert_false(is_dragging(b.app.work.editor));
        blind_frame(&b);
        assert_null(b.app.replay);
    }
    blind_close(&b);
}

TEST(test_the_first_touch_ends_it_with_the_start_scene)
{
    plays_until(&(struct event){.kind = EVENT_KEY, .key = 'V', .action = ACTION_PRESS}, true);
    plays_until(&(struct event){.kind = EVENT_BUTTON, .action = ACTION_PRESS, .x = 300, .y = 200}, true);
    plays_until(&(struct event){.kind = EVENT_WHEEL, .dy = 1, .x = 300, .y = 200}, true);
}

TEST(test_a_pointer_that_passes_does_not)
{
    plays_until(&(struct event){.kind = EVENT_POINTER, .x = 300, .y = 200}, false);
    plays_until(&(struct event){.kind = EVENT_SIZE, .x = 1600, .y = 900, .scale = 1}, false);
}

/// A slow display shows fewer pictures of the same demo.
DEMO_TEST(test_it_takes_its_time_whatever_the_display)
{
    struct error error = {0};
    for (int i = 0; i < 144 * 3; i++) assert_true(demo_next(&b->app, 1.0 / 144, &error));
    assert_int_equal(b->app.demo.frame, 180);
    for (int i = 0; i < 20 * 3; i++) assert_true(demo_next(&b->app, 1.0 / 20, &error));
    assert_int_equal(b->app.demo.frame, 360);
}

/// The window's close button loses nothing, and asks nothing.
DEMO_TEST(test_the_window_closes_at_once)
{
    for (int i = 0; i < 9 * 60; i++) blind_frame(b);
    event_queue_push(&b->app.platform->queue, &(struct event){.kind = EVENT_CLOSE});
    app_frame(&b->app);
    assert_true(b->app.quit);
}
