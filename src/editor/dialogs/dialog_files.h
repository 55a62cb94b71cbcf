/// How the editor's file dialogs see folders: through functions that the app provides. The editor itself opens no files.
#ifndef EDITOR_DIALOGS_DIALOG_FILES_H
#define EDITOR_DIALOGS_DIALOG_FILES_H

#include "editor/core/world.h"
#include <stdbool.h>

struct editor;

enum { DIALOG_MAX_RECENT = 12 };

/// A file that was opened or saved before.
struct dialog_recent {
    char path[PATH_LIMIT]; ///< absolute
    bool missing;          ///< it is not there any more, or cannot be read
};

/// Writes at most `most` recent files, newest first; returns how many.
typedef int dialog_list_recent(void *user, struct dialog_recent *files, int most);

/// What an export to a format has to choose, besides name and frames.
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
    const char *ending, *holds; ///< ".glb", and a line on what such a file is for
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

/// What was exported last, and from which scene's file.
struct export_memory {
    char path[PATH_LIMIT], scene[PATH_LIMIT];
    struct export_wish wish;
};

/// What the Export dialog begins with.
void editor_set_export(struct editor *editor, const struct export_memory *memory);
/// How far the export is that was asked for; without an end in sight `total` is 0.
void editor_tell_export(struct editor *editor, long done, long total);

/// Somebody else has written the document's file, of that name: asks whether to keep mine, take theirs or save under
/// another name. `saving`: the user has just asked to save, and that request needs no other answer. false where something else
/// lies over the panels, or a drag goes on.
bool editor_ask_changed(struct editor *editor, const char *name, bool saving);

/// Gives the editor access to folders for completion; copied.
void editor_set_files(struct editor *editor, const struct dialog_files *files);

#endif
