/// How large everything in the window is drawn, on top of the display's own scale. Internal to src/app.
#ifndef APP_UI_SCALE_H
#define APP_UI_SCALE_H

#include "base/error.h"
#include "ui/event.h"

struct app;

#define UI_SCALE_LEAST 0.75
#define UI_SCALE_MOST 3.0

/// Logical pixels of the layout; less shows a part of it.
enum { UI_LEAST_WIDTH = 320, UI_LEAST_HEIGHT = 240 };

/// Lays the editor out anew for the display's size, as large as is chosen and as leaves room.
void ui_scale_fit(struct app *app);
/// The same, where presenting or leaving has changed what is wanted.
void ui_scale_update(struct app *app);
/// Turns the window's coordinates into the editor's.
void ui_scale_to_ui(const struct app *app, struct event *event);
/// The next step up (1) or down (-1), or the display's own scale (0). Refuses one that leaves the panels no room.
bool ui_scale_step(struct app *app, int direction, struct error *error);

#endif
