/// Interface of the overlays: dialogs, help, the card for new users.
#ifndef EDITOR_DIALOGS_DIALOGS_H
#define EDITOR_DIALOGS_DIALOGS_H

#include "editor/core/state.h"
#include "ui/widgets.h"

// How the dialogs see folders: through functions that the app provides. The editor itself opens no files.

enum { DIALOG_MAX_RECENT = 12 };

/// A file that was opened or saved before.
struct dialog_recent {
    char path[PATH_LIMIT]; ///< absolute
    bool missing;          ///< it is not there any more, or cannot be read
};

/// Writes at most `most` recent files, newest first; returns how many.
typedef int dialog_list_recent(void *user, struct dialog_recent *files, int most);

/// Choices of an export format, besides name and frames.
enum dialog_choice {
    CHOICE_KEYS = 1,   ///< keys a frame
    CHOICE_RIG = 2,    ///< one rig or all
    CHOICE_ONE = 4,    ///< the file holds but one
    CHOICE_CLIP = 8,   ///< the animation's name
    CHOICE_CUBIC = 16, ///< linear or cubic keys
    CHOICE_SIGNED = 32,
    CHOICE_SIZE = 64, ///< it is pictures
    CHOICE_ALPHA = 128,
    CHOICE_JOINTS = 256, ///< it holds tails and chains
};

/// A file format that motion is exported to.
struct dialog_format {
    const char *ending, *holds; ///< ".glb", and a line on its use
    unsigned choices;           ///< of enum dialog_choice
    int width, height;          ///< CHOICE_SIZE: the size it likes
};

struct dialog_files {
    /// Names in `folder` that a scene can be in: *.json, and folders with a trailing '/'; sorted. Writes at most `max`,
    /// returns how many, or -1 where the folder cannot be read. NULL: the dialogs are plain text fields.
    int (*list)(void *user, const char *folder, char names[][256], int max);
    dialog_list_recent *recent; ///< NULL: there are none
    const struct dialog_format *formats;
    int format_count; ///< 0: nothing is exported
    void *user;
};

/// The last export, and its scene's file.
struct export_memory {
    char path[PATH_LIMIT], scene[PATH_LIMIT];
    struct export_wish wish;
};

struct dialogs;

struct command;

/// `commands`: those that F1 shows.
struct dialogs *dialogs_create(const struct command *commands, int count);
void dialogs_destroy(struct dialogs *dialogs);
/// Gives the dialogs access to folders; copied.
void dialogs_set_files(struct dialogs *dialogs, const struct dialog_files *files);
/// Asks where to save.
void dialogs_save_as(struct dialogs *dialogs, const struct core *core);
/// Opens the Export dialog.
void dialogs_export(struct dialogs *dialogs, const struct core *core);
/// Sets the Export dialog's first choices.
void dialogs_set_export(struct dialogs *dialogs, const struct export_memory *memory);
/// How far the export is that was asked for; without an end in sight `total` is 0.
void dialogs_tell_export(struct dialogs *dialogs, long done, long total);
/// Does `after` (REQUEST_NEW, REQUEST_FIGURE, REQUEST_OPEN with a path, or without: asks for one, REQUEST_QUIT), but asks first
/// where work would be lost: Save, Discard, Cancel. `after` then follows only when the save has succeeded.
void dialogs_leave(struct dialogs *dialogs, struct core *core, const struct request *after);
/// The app's answer to what the dialog has asked for: it closes and goes on with `after`, or stays and says why not. false
/// where it waits for no such answer.
bool dialogs_answer(struct dialogs *dialogs, struct core *core, const struct request *request, bool ok,
                    const char *text);
/// Draws the help and the dialog.
void dialogs_show(struct dialogs *dialogs, struct core *core);
/// Asks core's question, or which file REQUEST_ADD is about; false where there is nothing to ask.
bool dialogs_ask(struct dialogs *dialogs, struct core *core);
/// Somebody else has written the document's file, of that name: asks whether to keep mine, take theirs or save under
/// another name. `saving`: the user has just asked to save, and that request needs no other answer. false where something else
/// lies over the panels, or a drag goes on.
bool dialogs_ask_changed(struct dialogs *dialogs, const struct core *core, const char *name, bool saving);
/// Asks about unsaved work of an earlier run: REQUEST_RECOVER, REQUEST_FORGET, or nothing yet.
void dialogs_offer_recovery(struct dialogs *dialogs, const struct recovery_offer *offer);
/// true where an open dialog, the help or the card for new users takes the event.
bool dialogs_event(struct dialogs *dialogs, struct core *core, const struct event *event);
/// Whether a dialog is open, which takes every key.
bool dialogs_are_asking(const struct dialogs *dialogs);
/// Shows all keys, or no longer.
void dialogs_help(struct dialogs *dialogs, const struct core *core);
/// Shows all commands, or no longer.
void dialogs_palette(struct dialogs *dialogs);
/// The command that was chosen of them; NULL: none.
const struct command *dialogs_take_command(struct dialogs *dialogs);
/// Whether something lies over the panels.
bool dialogs_cover(const struct dialogs *dialogs);
/// The same, with the place under the pointer.
bool dialogs_over(const struct dialogs *dialogs, enum ui_over *over);
/// How far down the left side of the stage is free.
float dialogs_bottom(const struct dialogs *dialogs, const struct core *core);
/// Shows the card for new users.
void dialogs_welcome(struct dialogs *dialogs);
/// Whether it is still to be seen.
bool dialogs_is_welcoming(const struct dialogs *dialogs);
/// Gets every event, to show keys as they are pressed.
void dialogs_note(struct dialogs *dialogs, const struct event *event);
/// Time passes: shown keys fade, and the demo's pointer glides.
void dialogs_advance(struct dialogs *dialogs, const struct core *core, double dt);
/// Whether it is still to be seen.
bool dialogs_want_frames(const struct dialogs *dialogs, const struct core *core);
/// While presenting, and in a demo: the pressed keys, caption and pointer.
void dialogs_show_input(const struct dialogs *dialogs, struct core *core);
/// The card for new users on the stage, beside `figure`, the rectangle of the rigs.
void dialogs_show_welcome(struct dialogs *dialogs, struct core *core, struct rect figure);

#endif
