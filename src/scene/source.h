/// A scene file's text: its limits, and the lines and paths that messages name. jansson knows positions of syntax
/// errors only.
#ifndef SCENE_SOURCE_H
#define SCENE_SOURCE_H

#include "base/error.h"
#include <stddef.h>

enum {
    SOURCE_MAX_BYTES = 256 << 20,
    SOURCE_MAX_DEPTH = 64,        ///< levels of brackets
    SOURCE_MAX_OBJECTS = 2000000, ///< and
    SOURCE_MAX_VALUES = 8000000,  ///< bound the memory that parsing takes
    PATH_TEXT_SIZE = 256,
};

/// A place in a file: a key or an index below another place. The root has no parent. Lives on the stack of the
/// reader.
struct where {
    const struct where *parent;
    const char *key; ///< NULL: an element of an array
    size_t index;
};

/// A position in the text, before a token.
struct cursor {
    const char *at;
    int line;
};

/// Where the last element looked up in an array was, so that messages in the order of the file take linear time in
/// all.
struct finger {
    const char *array;
    size_t index;
    struct cursor cursor;
};

struct source {
    const char *name; ///< the file, for messages
    const char *text; ///< followed by a NUL
    size_t size;
    struct finger fingers[SOURCE_MAX_DEPTH];
};

/// Refuses what would take too much memory or stack to parse: depth and counts of brackets and commas, in one pass.
bool source_check_limits(const struct source *source, struct error *error);

/// The line of a place in a text that has been parsed; that of the nearest place above where there is no such key.
int source_line(struct source *source, const struct where *where);

/// "splines[0].knots[2].frame"; "scene" for the root.
void where_path(const struct where *where, char path[PATH_TEXT_SIZE]);

/// The path of what starts before byte `offset` and has not ended there; the text need be valid up to there only.
void source_path_at(const struct source *source, size_t offset, char path[PATH_TEXT_SIZE]);

#endif
