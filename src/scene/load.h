/// Scene files: read, check, write (docs/scene-format.md).
#ifndef SCENE_LOAD_H
#define SCENE_LOAD_H

#include "base/file.h"
#include "scene/document.h"
#include <stddef.h>

/// Reads and validates a scene. On failure returns NULL with the first error in `error`. With `problems` it reports every problem, as
/// `wiggly check` does; NULL drops warnings and further errors.
struct document *scene_load(const char *path, struct problems *problems, struct error *error);

/// The same from memory; messages show `name` for the path.
struct document *scene_parse(const char *name, const char *text, size_t size, struct problems *problems,
                             struct error *error);

/// Whether its file has a meadow, which older versions showed. Only saving knows of it.
bool scene_has_meadow(const struct document *document);

/// The scene that a recovery file belongs to, its last member:
///
///     "recovers": { "file": "/home/me/walk.json", "content": "5f3a91c07be2d846" }
///
/// An untitled document's file has no such member; nor has one whose path is not UTF-8, which JSON cannot hold.
struct scene_origin {
    char path[PATH_LIMIT]; ///< of the document's own file, or ""
    uint64_t content;      ///< of that file when it was last read or written (file_content()); 0: unknown
};

/// Reads that member of a file; all zeros if there is none.
struct scene_origin scene_read_origin(const char *path);

/// The canonical text: known keys in their fixed order, then unknown ones in theirs; knots by sample; numbers as the shortest text that
/// reads back equal. scene_parse() of it gives an equal document. For a file in `folder` (document.h), with its `origin` unless that is NULL.
/// The caller frees it.
char *scene_print(const struct document *document, const char *folder, const struct scene_origin *origin,
                  size_t *size);

/// Writes the canonical text into a file, whole or not at all; paths in it are relative to the file's folder.
bool scene_save(const struct document *document, const char *path, struct error *error);

/// The same with its `origin`, readable by this user alone.
bool scene_save_for(const struct document *document, const char *path, const struct scene_origin *origin,
                    struct error *error);

/// Reads the paint that a scene keeps in .npy files. If a file is missing or broken, it reads the others
/// and returns false with the first error; the character then moves as its model does, and the name stays in the document.
bool scene_read_paint(struct document *document, struct error *error);

/// Hash of the canonical text, for replays (64-bit FNV-1a).
uint64_t scene_hash(const struct document *document);

// --- knots as text, for the clipboard: JSON as in a scene file's "knots", and CSV from elsewhere

/// Knots outside a document, without ids and unknown keys.
struct knot_list {
    struct knot *knots; ///< in the order of the text
    char **splines;     ///< names of the splines that they are of; each, and all of it, may be NULL
    int count;
};

/// A JSON array with one knot a line, as in a scene file; where it is known, "spline" says which one it is of. The caller frees
/// it.
char *knots_print(const struct knot_list *list);

/// Reads what knots_print() writes, an object with "knots" (a scene file's spline), or CSV lines frame,value[,slope[,stiffness[,im]]], the value `still` for
/// a still knot, also with semicolons or tabs, and then with decimal commas; blank lines and `#` comments are skipped. Under a header, columns go by name; frame and value
/// are the first and second column if it does not name them. If there are no knots, returns false with a
/// sentence "name:line: …: expected …, got …" and an empty list.
bool knots_parse(const char *name, const char *text, struct knot_list *list, struct error *error);

void knot_list_free(struct knot_list *list);

#endif
