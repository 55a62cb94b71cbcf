/// What belongs to the user, not a document: settings, recent files, autosave. Headless runs, replays and recordings neither read nor write
/// any of it. Private to src/app.
#ifndef APP_PERSONAL_H
#define APP_PERSONAL_H

#include "base/error.h"
#include "editor/editor.h"
#include <stdbool.h>

struct app;
struct personal;

/// Call at a window with an open document: applies settings, starts autosave, offers recovered work. Failures go to the status line.
void personal_start(struct app *app);

/// Call once per frame, and while idle.
void personal_update(struct app *app);

/// Whether unsaved work waits for personal_update().
bool personal_is_behind(const struct app *app);

/// The recent files; `user` is the app.
dialog_list_recent personal_recent;

/// Call when a document's file was opened or saved.
void personal_note_file(struct app *app, const char *path);

/// Stores the last export for the Export dialog.
void personal_note_export(struct app *app, const struct request *request);

/// Opens the offered recovery file, or deletes it and offers the next.
bool personal_recover(struct app *app, struct error *error);
void personal_forget(struct app *app);

/// Writes unsaved work to the recovery file and waits for it. Returns the path, or NULL if it failed.
const char *personal_rescue(struct app *app);

/// `keep`: the user could not decide about unsaved work, so its recovery file stays.
void personal_end(struct app *app, bool keep);

#endif
