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

/// Reads and validates a scene. On failure returns NULL with the first error in `error`. With `problems` it reports every problem, as
/// `wiggly check` does; NULL drops warnings and further errors.
struct document *scene_load(const char *path, struct problems *problems, struct error *error);

/// The same from memory; `name` stands for the path in messages.
struct document *scene_parse(const char *name, const char *text, size_t size, struct problems *problems,
                             struct error *error);

/// The canonical text: known keys in their fixed order, then unknown ones in theirs; knots by sample; numbers as the shortest text that
/// reads back equal. scene_parse() of it gives an equal document. The caller frees it.
char *scene_print(const struct document *document, size_t *size);

/// The same for a file in `folder` (document.h), into `*buffer` of `*capacity` bytes (at first NULL and 0), which grows as needed and
/// which the caller frees: printing the same document repeatedly allocates nothing.
void scene_print_into(const struct document *document, const char *folder, char **buffer, size_t *capacity,
                      size_t *size);

/// Saves the paint of the document's characters, each as an .npy file beside the scene (which the document then names), and then the
/// scene, in one step: on failure, and after a crash at any time, the old scene is intact with its old paint, or the new one is
/// there with the new. A failure leaves no new file.
bool scene_save(struct document *document, const char *path, struct error *error);

/// Reads the paint that the document's characters name and do not have yet. If a file is missing or broken, it reads the others
/// and returns false with the first error; the character then moves as its model does, and the name stays in the document.
bool scene_read_paint(struct document *document, struct error *error);

/// What other programs have made of the document's paint files since they were read or written here: a number that changes with their
/// content; 0: they are as they were, or gone. `name` then is the first of those files, as the document has it.
uint64_t scene_paint_theirs(struct document *document, const char **name);

/// The user has seen that: the next save writes the document's own paint again.
void scene_keep_paint(struct document *document);

/// Appends a NUL and all paint, if there is any, to a text of scene_print_into(), for a recovery file.
void scene_print_paint(const struct document *document, char **buffer, size_t *capacity, size_t *size);

/// Gives the document the paint that scene_print_paint() printed: `text` is what follows the NUL, and must end with one itself.
/// `name` stands for the path in messages.
bool scene_parse_paint(struct document *document, const char *name, const char *text, size_t size,
                       struct error *error);

/// Hash of the canonical text, for replays (64-bit FNV-1a).
uint64_t scene_hash(const struct document *document);

#endif
