/// Plays the demo: which frame of it is due, its rounds, and its end.
#include "app/state.h"
#include "base/embedded.h"
#include "ui/theme.h"

struct replay *demo_replay(struct error *error)
{
    const struct embedded *file = embedded_find("demo/demo.replay");
    if (file) return replay_parse("demo.replay", (const char *)file->data, file->size, error);
    fail(error, ERROR_ENVIRONMENT, "the demo is not in this build");
    return NULL;
}

/// Everything as it was when the program started: whoever watches has changed nothing, and a round depends on no other.
static bool start_anew(struct app *app, struct error *error)
{
    theme_use(app->demo.theme);
    app_open_editor(app);
    return app_open(app, NULL, error);
}

bool demo_next(struct app *app, double dt, struct error *error)
{
    struct demo *demo = &app->demo;
    demo->seconds += dt;
    demo->frame = (long)(60 * demo->seconds + 0.5);
    if (demo->frame < replay_get_header(app->replay)->frames) return true;
    replay_destroy(app->replay);
    app->replay = demo_replay(error);
    demo->seconds = 0;
    demo->frame = 0;
    return app->replay && start_anew(app, error);
}

bool demo_is_touched_by(const struct event *event)
{
    const bool pressed = event->kind == EVENT_KEY || event->kind == EVENT_BUTTON;
    return (pressed && event->action == ACTION_PRESS) || event->kind == EVENT_WHEEL || event->kind == EVENT_DROP;
}

bool demo_stop(struct app *app, struct error *error)
{
    replay_destroy(app->replay);
    app->replay = NULL;
    app->demo.on = false;
    if (!start_anew(app, error)) return false;
    if (platform_is_window(app->platform)) personal_start(app);
    return true;
}
