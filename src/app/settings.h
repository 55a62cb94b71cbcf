/// Settings kept between runs: a small JSON file.
///
///     {"theme": "dark", "stage_share": 0.4, "more": true, "recent": ["/home/me/walk.json"]}
///
/// Recent files are listed newest first. Unknown keys are kept, so that an older program does not lose a newer one's settings.
#ifndef APP_SETTINGS_H
#define APP_SETTINGS_H

#include "base/error.h"
#include "editor/editor.h"

struct settings;

/// Reads the settings; a missing file is empty. If the file is broken or unreadable, `error` is set (else ERROR_NONE) and defaults apply.
struct settings *settings_load(const char *path, struct error *error);

/// Reads them for a change; NULL with an error if that would lose a broken file. Other programs wait for settings_free(), at most five
/// seconds.
struct settings *settings_open(const char *path, struct error *error);
void settings_free(struct settings *settings);

/// The value of a key: a string or NULL; a number or `fallback`; true or false, or `fallback`.
const char *settings_get(const struct settings *settings, const char *key);
double settings_number(const struct settings *settings, const char *key, double fallback);
bool settings_flag(const struct settings *settings, const char *key, bool fallback);

void settings_set(struct settings *settings, const char *key, const char *value);
void settings_set_number(struct settings *settings, const char *key, double value);
void settings_set_flag(struct settings *settings, const char *key, bool value);

/// Writes atomically.
bool settings_save(const struct settings *settings, const char *path, struct error *error);

/// Moves a file to the front of the recent files, at most DIALOG_MAX_RECENT, by absolute path.
void recent_note(struct settings *settings, const char *path);

/// Writes the recent files, newest first, with missing ones marked; returns how many.
int recent_list(const struct settings *settings, struct dialog_recent *files, int most);

/// Reads the last export's path and scene, and the choices that suit any scene. Missing ones keep a new dialog's defaults. `scene`: path of
/// the open file, or "".
void export_memory_read(const struct settings *settings, const char *scene, struct export_memory *memory);
void export_memory_write(struct settings *settings, const struct request *request, const char *scene);

#endif
