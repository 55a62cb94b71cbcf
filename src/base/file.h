/// Whole files, read up to a limit, written so that a reader sees the old content or the new, never a mixture; and paths.
#ifndef BASE_FILE_H
#define BASE_FILE_H

#include "base/error.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/// Reads a regular file of at most `limit` bytes into memory that the caller frees, with a terminating NUL that
/// `size` does not count. Errors name the path and say: no such file, a directory, no permission, too large.
bool file_read(const char *path, size_t limit, char **data, size_t *size, struct error *error);

/// Bytes of the UTF-8 byte order mark that a text begins with: 3, or 0 without one.
size_t file_text_mark(const char *text);

/// Reads a text without its byte order mark.
bool file_read_text(const char *path, size_t limit, char **text, size_t *size, struct error *error);

/// Writes a temporary file beside `path`, checks every call, fsyncs, renames. On failure the old file is intact and the temporary one is gone. A
/// symbolic link's target is replaced, not the link. The old file's owner, group, mode and ACL are kept; if the system does not allow that, the
/// new file gives others fewer rights, never more. A file system that knows no rights or no syncing fails nothing, and where it refuses to
/// rename, a new file is copied to its place.
bool file_write_atomic(const char *path, const void *data, size_t size, struct error *error);

/// The same for output written piece by piece. A device or a pipe is written directly, but a pipe must have a reader.
struct file_output {
    FILE *stream;
    const char *path;         ///< the caller's, for messages
    char *target, *temporary; ///< private
};

/// Opens the temporary file. `path` must live until the end.
bool file_output_open(struct file_output *output, const char *path, struct error *error);

/// Checks what was written, fsyncs, renames, and closes; on failure the old file is intact and the temporary one is
/// gone.
bool file_output_commit(struct file_output *output, struct error *error);

/// Closes and removes the temporary file.
void file_output_discard(struct file_output *output);

/// Opens a file to be written in place, line by line, like a log; a pipe must have a reader. NULL and an error on failure.
FILE *file_open_growing(const char *path, struct error *error);

/// Whether a path is a regular file or free, and not guarded; else false and an error. For saves and exports, because devices and pipes keep
/// nothing.
bool file_check_place(const char *path, struct error *error);

/// Removes the temporary files of all open outputs; for the handler of a signal that ends the program.
void file_remove_unfinished(void);

/// Whether two paths are one regular file, also by a link or, where neither exists yet, by the same name in the same folder.
bool file_same(const char *path, const char *other);

// A command must not write over what it reads. A guarded thread notes its files, and every output of it refuses them, by whatever name.

/// Starts or stops noting what this thread reads; what is noted stays guarded. Threads start without a guard.
void file_guard_reads(bool notes);

/// Notes a file that this thread will read, if it is guarded. `as` completes "it is read as …" and must live until it is forgotten; NULL: the path.
void file_note_read(const char *path, const char *as);

/// Guards this file no longer, NULL: none.
void file_forget_reads(const char *path);

/// Whether no such file is guarded; else false and a sentence with both roles.
bool file_check_unread(const char *path, struct error *error);

/// A hash of a file's present content, to tell whether another program has written it; 0 if it cannot be read.
uint64_t file_content(const char *path);

// Paths relative to a folder. Absolute paths stay as they are; "" and NULL mean the working folder.

enum { PATH_LIMIT = 4096 }; ///< bytes of a path, with its end

/// The folder of a file: "a/b.json" → "a", "b.json" → "". false if it is too long.
bool path_folder(const char *path, char folder[PATH_LIMIT]);

/// The name of a file or folder: "a/b.json" → "b.json".
const char *path_name(const char *path);

/// The absolute path, without "." and "..", of a file named from a folder. Symbolic links in the folder's path are
/// followed where it exists. false where it is too long.
bool path_resolve(const char *folder, const char *path, char absolute[PATH_LIMIT]);

/// Rewrites a path relative to one folder as a path relative to another. false if nothing changes or the path is too long.
bool path_rebase(const char *path, const char *from, const char *to, char moved[PATH_LIMIT]);

/// Whether a file's name ends in this, like ".glb", in upper or lower case.
bool path_has_end(const char *path, const char *end);

#endif
