/// How the editor's file dialogs see folders: through functions that the app provides. The editor itself opens no files.
#ifndef EDITOR_DIALOGS_DIALOG_FILES_H
#define EDITOR_DIALOGS_DIALOG_FILES_H

#include <stdbool.h>

struct editor;

enum { DIALOG_MAX_RECENT = 12, DIALOG_PATH_SIZE = 1024 };

/// A file that was opened or saved before.
struct dialog_recent {
    char path[DIALOG_PATH_SIZE]; ///< absolute
    bool missing;                ///< it is not there any more, or cannot be read
};

/// Writes at most `most` recent files, newest first; returns how many.
typedef int dialog_list_recent(void *user, struct dialog_recent *files, int most);

struct dialog_files {
    /// Names in `folder` that a scene can be in: *.json, and folders with a trailing '/'; sorted. Writes at most `max`,
    /// returns how many, or -1 where the folder cannot be read. NULL: the dialogs are plain text fields.
    int (*list)(void *user, const char *folder, char names[][256], int max);
    dialog_list_recent *recent; ///< NULL: there are none
    void *user;
};

/// Gives the editor access to folders for completion; copied.
void editor_set_files(struct editor *editor, const struct dialog_files *files);

#endif
