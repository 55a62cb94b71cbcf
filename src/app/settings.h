/// Settings kept between runs: a small text file of lines `key = value`.
///
///     # wiggly's settings
///     theme = dark
///     recent = /home/me/walk.json
///
/// A key may come more than once (recent files: newest first). Lines with unknown keys are kept, so that an older
/// program does not lose what a newer one stored.
#ifndef APP_SETTINGS_H
#define APP_SETTINGS_H

#include "base/error.h"
#include "editor/editor.h"

struct settings;

/// Reads a settings file; a missing one counts as empty. For a broken line or an unreadable file, `error` gets one sentence
/// (else ERROR_NONE) and defaults apply.
struct settings *settings_load(const char *path, struct error *error);

/// The same to change them: another program that does so waits for settings_free(), at most five seconds.
struct settings *settings_open(const char *path, struct error *error);
void settings_free(struct settings *settings);

/// The `n`th value of a key (from 0), or NULL; and the first one as a number, `fallback` if it is none.
const char *settings_get(const struct settings *settings, const char *key, int n);
double settings_number(const struct settings *settings, const char *key, double fallback);

/// Replaces all values of a key by one. A value that could not be read back (with a line break) is dropped.
void settings_set(struct settings *settings, const char *key, const char *value);
void settings_set_number(struct settings *settings, const char *key, double value);
/// Puts a value first among the key's values, dropping an equal one, and keeps the first `most`.
void settings_push(struct settings *settings, const char *key, const char *value, int most);

/// Writes the file, atomically.
bool settings_save(const struct settings *settings, const char *path, struct error *error);

/// Moves a file's absolute path to the top of the recent files, of which there are at most DIALOG_MAX_RECENT.
void recent_note(struct settings *settings, const char *path);

/// Writes the recent files, newest first; returns how many. Missing files are marked.
int recent_list(const struct settings *settings, struct dialog_recent *files, int most);

/// The last export: its path, its scene, and the choices that suit other scenes too. Choices missing from the settings are those of a new
/// dialog. `scene` is the path of the file that is open, or "".
void export_memory_read(const struct settings *settings, const char *scene, struct export_memory *memory);
void export_memory_write(struct settings *settings, const struct request *request, const char *scene);

#endif
