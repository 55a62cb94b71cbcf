/// The dialog on the screen: opened, closed, waiting for the app.
#ifndef EDITOR_DIALOGS_DIALOG_H
#define EDITOR_DIALOGS_DIALOG_H

#include "editor/dialogs/state.h"

/// Shows a dialog that has no text.
void dialog_open(struct dialogs *dialogs, enum dialog_kind kind);
/// Closes whichever is shown.
void dialog_close(struct dialogs *dialogs);
/// Asks which file to open.
void dialog_ask_open(struct dialogs *dialogs);
/// Asks something of the app; the dialog takes nothing until dialogs_answer().
void dialog_await(struct dialogs *dialogs, struct core *core, enum request_kind kind, const char *path);
/// true for every event while a dialog is open, but for EVENT_SIZE and EVENT_EXPOSE.
bool dialog_event(struct dialogs *dialogs, struct core *core, const struct editor_world *world,
                  const struct event *event);

#endif
