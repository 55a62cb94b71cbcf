/// A scene file's text: its limits, and the lines and paths for messages. jansson gives positions of syntax errors only.
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

/// A place in a file: a key or an index below another place. The root has no parent.
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

/// Where the last element looked up in an array was, so that messages in file order take linear time in all.
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

/// Refuses text that would take too much memory or stack to parse, by counting brackets and commas.
bool source_check_limits(const struct source *source, struct error *error);

/// The line of a place in a parsed text; if there is no such key, of the nearest place above.
int source_line(struct source *source, const struct where *where);

/// "splines[0].knots[2].frame"; "scene" for the root.
void where_path(const struct where *where, char path[PATH_TEXT_SIZE]);

/// The path of what is open at byte `offset`; the text need only be valid up to there.
void source_path_at(const struct source *source, size_t offset, char path[PATH_TEXT_SIZE]);

#endif
