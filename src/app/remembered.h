/// The files that the settings remember: recent scenes, and the last export.
#ifndef APP_REMEMBERED_H
#define APP_REMEMBERED_H

#include "app/settings.h"
#include "editor/editor.h"

/// Moves a file's absolute path to the top of the recent files, of which there are at most DIALOG_MAX_RECENT.
void recent_note(struct settings *settings, const char *path);

/// Writes the recent files, newest first; returns how many. Missing files are marked.
int recent_list(const struct settings *settings, struct dialog_recent *files, int most);

/// The last export: where to, from which scene, and the choices that suit another scene too. What is not in the settings is as in a new
/// dialog. `scene` is the path of the file that is open, or "".
void export_memory_read(const struct settings *settings, const char *scene, struct export_memory *memory);
void export_memory_write(struct settings *settings, const struct request *request, const char *scene);

#endif
