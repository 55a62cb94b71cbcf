/// What belongs to the user rather than a document: settings, recent files, and autosave. Only for interactive windows:
/// headless runs, replays and recordings neither read nor write any of it. Internal to src/app.
#ifndef APP_PERSONAL_H
#define APP_PERSONAL_H

#include "base/error.h"
#include "editor/editor.h"
#include <stdbool.h>

struct app;
struct personal;

/// At a window, after the first document is open: applies the settings, starts autosave, offers what an earlier run left behind. Failures
/// go to the status line.
void personal_start(struct app *app);

/// Call it once a frame, and while idle.
void personal_update(struct app *app);

/// Whether unsaved work waits for the next update.
bool personal_is_behind(const struct app *app);

/// Recent files for the editor's dialogs; `user` is the app.
dialog_list_recent personal_recent;

/// A document's own file was opened or saved.
void personal_note_file(struct app *app, const char *path);

/// Something was exported: the Export dialog remembers it from run to run.
void personal_note_export(struct app *app, const struct request *request);

/// Opens the unsaved work that was offered, or deletes it and offers the next one.
bool personal_recover(struct app *app, struct error *error);
bool personal_forget(struct app *app, struct error *error);

/// Writes unsaved work to the recovery file, waits for it, and returns the path; NULL if that is not possible.
const char *personal_rescue(struct app *app);

/// Ends it all. If `keep` (the user could not decide) and work is unsaved, the recovery file stays.
void personal_end(struct app *app, bool keep);

#endif
