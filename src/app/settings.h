/// What the program remembers of its user from run to run: one small text file of lines `key = value`.
///
///     # wiggly's settings
///     theme = dark
///     recent = /home/me/walk.json
///
/// A key may come more than once (recent files: newest first). Lines with other keys are kept as they are, so that an older
/// program does not forget what a newer one keeps.
#ifndef APP_SETTINGS_H
#define APP_SETTINGS_H

#include "base/error.h"

struct settings;

/// Reads a settings file; one that is not there is an empty one. A broken line or an unreadable file is one sentence in
/// `error` (kind ERROR_NONE otherwise) and defaults in its place. NULL only where memory is short.
struct settings *settings_load(const char *path, struct error *error);
void settings_free(struct settings *settings);

/// The `n`th value of a key (from 0), or NULL; and the first one as a number, `fallback` where it is none.
const char *settings_get(const struct settings *settings, const char *key, int n);
double settings_number(const struct settings *settings, const char *key, double fallback);

/// Gives a key one value in place of all it had. A value that could not be read back (a line break in it) is left out.
void settings_set(struct settings *settings, const char *key, const char *value);
void settings_set_number(struct settings *settings, const char *key, double value);
/// Puts a value before the key's others, dropping an equal one, and keeps the first `most`.
void settings_push(struct settings *settings, const char *key, const char *value, int most);

/// Writes the file, atomically.
bool settings_save(const struct settings *settings, const char *path, struct error *error);

#endif
