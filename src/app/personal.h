/// What belongs to the user and not to a document: settings, recent files, and unsaved work that is kept safe. Only a window
/// that somebody sits at has it; headless runs, replays and recordings never read or write any of it. Internal to src/app.
#ifndef APP_PERSONAL_H
#define APP_PERSONAL_H

#include "base/error.h"
#include "editor/dialogs/dialog_files.h"
#include <stdbool.h>

struct app;
struct personal;

/// After the first document is open: applies the settings, starts autosave, offers what an earlier run left behind. What
/// cannot be had is a sentence in the status line.
void personal_start(struct app *app);

/// Once a frame, and while nothing happens.
void personal_update(struct app *app);

/// Recent files for the editor's dialogs; `user` is the app.
dialog_list_recent personal_recent;

/// A document's own file was opened or saved.
void personal_note_file(struct app *app, const char *path);

/// The unsaved work that was offered: puts it on the table, or deletes it and offers the next one.
bool personal_recover(struct app *app, struct error *error);
bool personal_forget(struct app *app, struct error *error);

/// Writes unsaved work to the recovery file and returns when it is there: the path, or NULL where that is not possible.
const char *personal_rescue(struct app *app);

/// Ends it all. The recovery file stays where `keep` (the run ended without the user's word) and there is unsaved work.
void personal_end(struct app *app, bool keep);

#endif
