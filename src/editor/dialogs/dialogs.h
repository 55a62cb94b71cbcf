/// Interface of the overlays: dialogs, help, the card for new users.
#ifndef EDITOR_DIALOGS_DIALOGS_H
#define EDITOR_DIALOGS_DIALOGS_H

#include "editor/core/app.h"
#include "export/export.h"
#include "ui/widgets.h"

struct command;
struct core;
struct dialogs;

/// `commands`: the table for F1 and F3.
struct dialogs *dialogs_create(struct core *core, const struct command *commands, int count);
void dialogs_destroy(struct dialogs *dialogs);
void dialogs_save_as(struct dialogs *dialogs);
void dialogs_export(struct dialogs *dialogs);
/// Sets the Export dialog's initial choices.
void dialogs_set_export(struct dialogs *dialogs, const struct export_memory *memory);
/// Carries out `after` (new, figure, open, quit), but first offers Save, Discard and Cancel for unsaved work. After Save it goes on only if
/// saving succeeded. REQUEST_OPEN without a path asks for one.
void dialogs_leave(struct dialogs *dialogs, const struct request *after);
/// The app's answer to the dialog's request: the dialog closes and `after` follows, or it stays and shows why not. false if no dialog waits
/// for this answer.
bool dialogs_answer(struct dialogs *dialogs, const struct request *request, bool ok, const char *text);
void dialogs_show(struct dialogs *dialogs);
/// Opens core's question, or asks which file REQUEST_ADD means; false if there is nothing to ask.
bool dialogs_ask(struct dialogs *dialogs);
/// Another program has changed the document's file `name`: asks whether to keep yours, load theirs or save under another name. `saving`:
/// the user just asked to save; this replaces the answer. false during a drag or under another overlay.
bool dialogs_ask_changed(struct dialogs *dialogs, const char *name, bool saving);
/// Offers recovered work of an earlier run: REQUEST_RECOVER, REQUEST_FORGET, or later.
void dialogs_offer_recovery(struct dialogs *dialogs, const struct recovery_offer *offer);
/// true if a dialog, the help or the welcome card uses the event.
bool dialogs_event(struct dialogs *dialogs, const struct event *event);
/// Whether a dialog is open. It takes every key.
bool dialogs_are_asking(const struct dialogs *dialogs);
/// Opens or closes the key overlay (F1).
void dialogs_help(struct dialogs *dialogs);
/// Opens or closes the command palette (F3), with the rows of a place: 0, or IN_EXAMPLES.
void dialogs_palette(struct dialogs *dialogs, unsigned at);
/// Opens the menu of what can be done at the pointer. Typing goes on in the palette.
void dialogs_menu(struct dialogs *dialogs);
/// Takes the command chosen in the palette or menu; NULL: none.
const struct command *dialogs_take_command(struct dialogs *dialogs);
/// Whether an overlay is open.
bool dialogs_cover(const struct dialogs *dialogs);
/// What part of a dialog the pointer is on.
enum ui_over dialogs_over(const struct dialogs *dialogs);
/// Opens the card for new users.
void dialogs_welcome(struct dialogs *dialogs);
bool dialogs_is_welcoming(const struct dialogs *dialogs);
/// Draws the card for new users beside `figure`, the rigs' rectangle, if it is shown; returns the height of the stage's left side that stays free.
float dialogs_show_welcome(struct dialogs *dialogs, struct rect figure);

#endif
