/// How the editor's file dialogs see folders: through functions that the app provides. The editor itself opens no files.
#ifndef EDITOR_DIALOG_FILES_H
#define EDITOR_DIALOG_FILES_H

struct editor;

struct dialog_files {
    /// Names in `folder` that a scene can be in: *.json, and folders with a trailing '/'; sorted. Writes at most `max`,
    /// returns how many, or -1 where the folder cannot be read. NULL: the dialogs are plain text fields.
    int (*list)(void *user, const char *folder, char names[][256], int max);
    void *user;
};

/// Gives the editor access to folders for completion; copied.
void editor_set_files(struct editor *editor, const struct dialog_files *files);

#endif
