/// The app without drawing: events, frames, requests and files.
#ifndef TESTS_BLIND_H
#define TESTS_BLIND_H

#include "near.h"

#include "app/state.h"
#include "platform/surface.h"
#include "ui/font.h"

struct blind {
    struct app app;
    struct app_options options;
};

/// Starts the app on a scene file (NULL: the built-in one) as app_run() does headless, 1280 × 720.
static inline void blind_open(struct blind *blind, const char *scene)
{
    struct app *app = &blind->app;
    *blind = (struct blind){.options = {.scene = scene, .headless = true}};
    app->options = &blind->options;
    app->fixed_clock = true;
    app->figures.ui_scale = 1;
    app->platform = platform_blind(1280, 720, 1);
    app->work.history = history_create(NULL);
    app->work.models = models_create();
    font_init();
    app_open_editor(app);
    app_resize(app, 1280, 720, 1);
    assert_done(app_open(app, scene, &error));
}

static inline void blind_close(struct blind *blind) { app_free(&blind->app); }

/// Queues an event as the window's callbacks do.
static inline void blind_send(struct blind *blind, struct event event)
{
    event_queue_push(&blind->app.platform->queue, &event);
}

static inline void blind_drop(struct blind *blind, const char *path)
{
    event_queue_push_drop(&blind->app.platform->queue, path, 0);
}

/// One frame with the queued events. Ignores quitting.
static inline void blind_frame(struct blind *blind)
{
    app_frame(&blind->app);
    if (blind->app.failed) fail_msg("%s", blind->app.error.text);
    blind->app.quit = false;
}

/// Presses and releases a key.
static inline void blind_send_key(struct blind *blind, int key, unsigned mods)
{
    blind_send(blind, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_PRESS, .mods = mods});
    blind_send(blind, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_RELEASE, .mods = mods});
}

/// The same, with a frame.
static inline void blind_key(struct blind *blind, int key, unsigned mods)
{
    blind_send_key(blind, key, mods);
    blind_frame(blind);
}

/// A test of the app as `opens` starts it: BLIND_TEST(name, blind_open(b, NULL)) { … }.
#define BLIND_TEST(name, opens) TEST_OF(struct blind, b, opens, blind_close(b), name)

#endif
