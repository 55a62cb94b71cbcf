/// The door of what lies over the panels: dialogs, help, the card for new users.
#ifndef EDITOR_DIALOGS_DIALOGS_H
#define EDITOR_DIALOGS_DIALOGS_H

#include "editor/core/state.h"
#include "editor/dialogs/dialog_files.h"
#include "ui/widgets.h"

struct dialogs;

struct dialogs *dialogs_create(void);
void dialogs_destroy(struct dialogs *dialogs);
/// See editor_set_files().
void dialogs_set_files(struct dialogs *dialogs, const struct dialog_files *files);
/// Asks where to save.
void dialogs_save_as(struct dialogs *dialogs, const struct core *core);
/// Asks what to export, and where to.
void dialogs_export(struct dialogs *dialogs, const struct core *core);
/// See editor_set_export() and editor_tell_export().
void dialogs_set_export(struct dialogs *dialogs, const struct export_memory *memory);
void dialogs_tell_export(struct dialogs *dialogs, long done, long total);
/// Does `after` (REQUEST_NEW, REQUEST_OPEN with a path, or without: asks for one, REQUEST_QUIT), but asks first where work
/// would be lost: Save, Discard, Cancel. `after` then follows only when the save has succeeded.
void dialogs_leave(struct dialogs *dialogs, struct core *core, const struct request *after);
/// The app's answer to what the dialog has asked for: it closes and goes on with `after`, or stays and says why not. false
/// where it waits for no such answer.
bool dialogs_answer(struct dialogs *dialogs, struct core *core, const struct request *request, bool ok,
                    const char *text);
/// Draws the help and the dialog.
void dialogs_show(struct dialogs *dialogs, struct core *core);
/// Asks before an edit.
void dialogs_ask(struct dialogs *dialogs, const struct core *core, const struct ask *ask);
/// See editor_ask_changed().
bool dialogs_ask_changed(struct dialogs *dialogs, const char *name, bool saving);
/// See editor_offer_recovery().
void dialogs_offer_recovery(struct dialogs *dialogs, const struct recovery_offer *offer);
/// true where an open dialog, the help or the card for new users takes the event; `busy`: no help now.
bool dialogs_event(struct dialogs *dialogs, struct core *core, const struct event *event, bool busy);
/// Whether something lies over the panels.
bool dialogs_cover(const struct dialogs *dialogs);
/// The same, and what the pointer is over there.
bool dialogs_over(const struct dialogs *dialogs, enum ui_over *over);
/// How far down the left side of the stage is free.
float dialogs_bottom(const struct dialogs *dialogs, const struct core *core);
/// Shows the card for new users.
void dialogs_welcome(struct dialogs *dialogs);
/// Whether it is still to be seen.
bool dialogs_is_welcoming(const struct dialogs *dialogs);
/// Hears of every event, for who shows keys as they are pressed.
void dialogs_note(struct dialogs *dialogs, const struct event *event);
/// Time passes: what is shown of that fades, and the demo's pointer glides.
void dialogs_advance(struct dialogs *dialogs, const struct core *core, double dt);
/// Whether it is still to be seen.
bool dialogs_want_frames(const struct dialogs *dialogs, const struct core *core);
/// While presenting, and in a demo: what is pressed, its caption and pointer.
void dialogs_show_input(const struct dialogs *dialogs, struct core *core);
/// A card on the stage with what to try first, beside `figure`, which is what the scene shows.
void dialogs_show_welcome(struct dialogs *dialogs, struct core *core, struct rect figure);

#endif
