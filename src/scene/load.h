/// Scene files: read, check, write (docs/scene-format.md).
#ifndef SCENE_LOAD_H
#define SCENE_LOAD_H

#include "scene/document.h"
#include <stddef.h>

/// Problems of a file, each one sentence "file:line: path: expected …, got …".
struct problems {
    void (*report)(void *user, bool is_error, const char *sentence); ///< warnings have is_error = false
    void *user;
    int errors, warnings; ///< counted by the callee; start at 0
};

/// Reads and validates a scene. With `problems`, every problem found is reported (`wiggly check`), else only the
/// first error. Returns NULL and fills `error` with the first error. `problems` may be NULL; warnings are then
/// dropped.
struct document *scene_load(const char *path, struct problems *problems, struct error *error);

/// The same from memory; `name` stands for the path in messages.
struct document *scene_parse(const char *name, const char *text, size_t size, struct problems *problems,
                             struct error *error);

/// The canonical text: keys in the spec's order then unknown ones in theirs, knots by sample, numbers as the shortest
/// text that reads back equal. Freed by the caller; NULL where memory is short. scene_parse() of it gives an equal
/// document.
char *scene_print(const struct document *document, size_t *size);

/// The same for a file in `folder` (document.h), into `*buffer` of `*capacity` bytes (NULL and 0 to begin with), which grows
/// where it must and stays the caller's to free: printing the same document again and again allocates nothing. false where
/// memory is short.
bool scene_print_into(const struct document *document, const char *folder, char **buffer, size_t *capacity,
                      size_t *size);

/// scene_print() into a file, atomically; before it the paint of its characters, each into an .npy file of its own beside it (the
/// document then knows these as its paint's files). On failure the old scene is intact and no new file is left.
bool scene_save(struct document *document, const char *path, struct error *error);

/// Reads the paint that the document's characters name and that is not there yet; without it they are as their models are.
/// false with the first sentence where a file is missing or broken: its name stays in the document, and the others are
/// read all the same.
bool scene_read_paint(struct document *document, struct error *error);

/// Appends a NUL and all paint to a text of scene_print_into(), for a recovery file; nothing where there is none.
bool scene_print_paint(const struct document *document, char **buffer, size_t *capacity, size_t *size);

/// Gives paint that was printed so to the document; `text` is what follows the NUL, and must itself be followed by one. `name` stands for the path in messages.
bool scene_parse_paint(struct document *document, const char *name, const char *text, size_t size,
                       struct error *error);

/// Hash of the canonical text, for replays (64-bit FNV-1a).
uint64_t scene_hash(const struct document *document);

#endif
