/// Whole lists of tails, for edits that change which there are or how they are built.
#ifndef SCENE_TAIL_LIST_H
#define SCENE_TAIL_LIST_H

#include "scene/document.h"
#include <stddef.h>

/// Tails with everything that they own, and where the document's characters stand among them.
struct tail_list {
    struct tail *tails;
    int count;
    int *tails_before; ///< of each character
    int character_count;
};

/// A copy of a document's tails with room for `more`; NULL where memory is short.
struct tail_list *tail_list_copy(const struct document *document, int more);
void tail_list_free(struct tail_list *list);

/// Takes one out; the characters behind it move up.
void tail_list_remove(struct tail_list *list, int index);

/// Swaps a document's tails with a list's.
void tail_list_swap(struct tail_list *list, struct document *document);

/// Memory that a list takes.
size_t tail_list_bytes(const struct tail_list *list);

/// A copy of one tail, name and channels its own. On failure nothing is left to be freed.
bool tail_copy(const struct tail *tail, struct tail *copy);

#endif
