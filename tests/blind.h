/// The app without drawing: events, frames, requests and files.
#ifndef TESTS_BLIND_H
#define TESTS_BLIND_H

#include "near.h"

#include "app/state.h"
#include "platform/events.h"
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

/// Queues the keys that open an example, by words of its name.
static inline void blind_send_example(struct blind *blind, const char *words)
{
    const char *const typed[] = {"examples", words};
    blind_send_key(blind, KEY_F3, 0);
    for (int i = 0; i < 2; i++) {
        for (const char *c = typed[i]; *c; c++)
            blind_send(blind, (struct event){.kind = EVENT_TEXT, .codepoint = (uint32_t)*c});
        blind_send_key(blind, KEY_ENTER, 0);
    }
}

/// Presses keys one after the other, apart by spaces: "^S" is Ctrl+S, "+I" Shift+I, "!A" Alt+A.
static inline void blind_keys(struct blind *blind, const char *keys)
{
    static const struct {
        const char *name;
        int key;
    } names[] = {{"Enter", KEY_ENTER}, {"Esc", KEY_ESCAPE}, {"Right", KEY_RIGHT}, {"Space", KEY_SPACE}};
    while (*keys) {
        unsigned mods = 0;
        for (; strchr("^+!", *keys); keys++) mods |= *keys == '^' ? MOD_CTRL : *keys == '+' ? MOD_SHIFT : MOD_ALT;
        const size_t length = strcspn(keys, " ");
        int key = *keys;
        for (size_t i = 0; i < sizeof names / sizeof *names; i++)
            if (length == strlen(names[i].name) && strncmp(keys, names[i].name, length) == 0) key = names[i].key;
        blind_key(blind, key, mods);
        keys += length + strspn(keys + length, " ");
    }
}

static inline void blind_frames(struct blind *blind, int count)
{
    for (int i = 0; i < count; i++) blind_frame(blind);
}

/// Queues a movement of the pointer, in device pixels.
static inline void blind_pointer(struct blind *blind, float x, float y)
{
    blind_send(blind, (struct event){.kind = EVENT_POINTER, .x = x, .y = y});
}

/// The same, with a frame.
static inline void blind_point(struct blind *blind, float x, float y)
{
    blind_pointer(blind, x, y);
    blind_frame(blind);
}

static inline void blind_button(struct blind *blind, enum event_button button, enum event_action action, float x,
                                float y)
{
    blind_send(blind,
               (struct event){.kind = EVENT_BUTTON, .button = button, .action = action, .clicks = 1, .x = x, .y = y});
}

/// A click, with a frame.
static inline void blind_click(struct blind *blind, float x, float y)
{
    blind_pointer(blind, x, y);
    blind_button(blind, BUTTON_LEFT, ACTION_PRESS, x, y);
    blind_button(blind, BUTTON_LEFT, ACTION_RELEASE, x, y);
    blind_frame(blind);
}

static inline void blind_resize(struct blind *blind, float width, float height, float scale)
{
    blind_send(blind, (struct event){.kind = EVENT_SIZE, .x = width, .y = height, .scale = scale});
    blind_frame(blind);
}

/// Lets the user's settings and recovery files be in this folder.
static inline void blind_home(const char *folder)
{
    assert_int_equal(setenv("XDG_STATE_HOME", folder, 1) | setenv("XDG_CONFIG_HOME", folder, 1), 0);
}

/// Starts the app as a user does, with settings and recovery.
static inline void blind_arrive(struct blind *blind, const char *scene)
{
    blind_open(blind, scene);
    personal_start(&blind->app);
    blind_frame(blind);
}

/// Ends it; `lost`: as when it could not ask, so that unsaved work stays in its recovery file.
static inline void blind_leave(struct blind *blind, bool lost)
{
    personal_end(&blind->app, lost);
    blind_close(blind);
}

/// A test of the app as `opens` starts it: BLIND_TEST(name, blind_open(b, NULL)) { … }.
#define BLIND_TEST(name, opens) TEST_OF(struct blind, b, opens, blind_close(b), name)

#endif
