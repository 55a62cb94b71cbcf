/// The size of the interface relative to the display's scale.
#include "app/state.h"
#include <math.h>

static const double steps[] = {UI_SCALE_LEAST, 1, 1.25, 1.5, 1.75, 2, 2.5, UI_SCALE_MOST};
/// Logical pixels of the layout; a smaller window shows a part of it.
enum { UI_LEAST_WIDTH = 320, UI_LEAST_HEIGHT = 240 };

enum { STEPS = sizeof steps / sizeof *steps };

static const double PRESENTING = 1.5; ///< times the chosen scale
static const double SHARPEST = 5;     ///< device pixels per logical pixel that the glyph atlas can hold

/// Logical pixels that the panels need; in an upright window they lie below each other.
static double least_width(const struct app *app) { return app->display.height > app->display.width ? 360 : 760; }
static double least_height(const struct app *app) { return app->display.height > app->display.width ? 560 : 400; }

static bool has_room(const struct app *app, double scale)
{
    return (double)app->display.width / scale >= least_width(app) &&
           (double)app->display.height / scale >= least_height(app) && (double)app->display.scale * scale <= SHARPEST;
}

static double wanted(const struct app *app, double chosen)
{
    return chosen * (app->table.editor->core.presenter.on ? PRESENTING : 1);
}

/// The chosen scale, or the largest step below it that fits. A window too small for any keeps its scale.
static double fitting(const struct app *app)
{
    const double most = wanted(app, app->ui_scale);
    if (most <= 1 || has_room(app, most)) return most;
    int step = STEPS - 1;
    while (steps[step] > 1 && (steps[step] > most || !has_room(app, steps[step]))) step--;
    return steps[step];
}

void ui_scale_fit(struct app *app)
{
    app->ui_scale_shown = fitting(app);
    const float shown = (float)app->ui_scale_shown;
    editor_resize(app->table.editor, fmaxf(app->display.width / shown, UI_LEAST_WIDTH),
                  fmaxf(app->display.height / shown, UI_LEAST_HEIGHT), app->display.scale * shown);
    app->table.editor->core.ui_scale = app->ui_scale;
}

void ui_scale_update(struct app *app)
{
    if (app->ui_scale_shown == fitting(app)) return;
    editor_let_go(app->table.editor); // a held control would jump
    ui_scale_fit(app);
}

void ui_scale_to_ui(const struct app *app, struct event *event)
{
    const float shown = (float)app->ui_scale_shown;
    event->x /= shown;
    event->y /= shown;
    event->scale *= shown;
}

bool ui_scale_step(struct app *app, int direction, struct error *error)
{
    double next = 1;
    int step = 0;
    while (step < STEPS - 1 && steps[step] <= app->ui_scale) step++;
    if (direction > 0) next = fmax(steps[step], app->ui_scale);
    while (step > 0 && steps[step] >= app->ui_scale) step--;
    if (direction < 0) next = fmin(steps[step], app->ui_scale);
    const double shown = wanted(app, next);
    if (next > app->ui_scale && shown > 1 && !has_room(app, shown)) {
        return fail(error, ERROR_INPUT, "%.0f %% needs a window of %.0f × %.0f, not %.0f × %.0f", 100 * shown,
                    least_width(app) * shown, least_height(app) * shown, (double)app->display.width,
                    (double)app->display.height);
    }
    app->ui_scale = next;
    ui_scale_update(app);
    return true;
}
