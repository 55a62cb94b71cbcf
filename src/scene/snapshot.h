/// A copy of a document as it was at one moment, taken in pieces while frames go on: what is small at once, the knots a slice at a
/// time. A knot that is changed before its turn is copied just before. Another thread can then print it.
#ifndef SCENE_SNAPSHOT_H
#define SCENE_SNAPSHOT_H

#include "scene/document.h"
#include <stddef.h>

struct snapshot;

/// NULL if memory runs out.
struct snapshot *snapshot_create(void);
void snapshot_destroy(struct snapshot *snapshot);

/// Begins to copy the document as it is now, for a file in `folder` (load.h), and gives up a copy that is not whole yet. false if memory
/// runs out. Memory is kept from one copy to the next.
bool snapshot_begin(struct snapshot *snapshot, struct document *document, const char *folder);

/// Copies up to `knots` more. Whether the copy is whole.
bool snapshot_continue(struct snapshot *snapshot, int knots);

/// Copies the rest.
void snapshot_finish(struct snapshot *snapshot);

/// The document no longer matters to it.
void snapshot_give_up(struct snapshot *snapshot);

/// Whether it was begun and is not whole yet; one that was given up is neither.
bool snapshot_is_running(const struct snapshot *snapshot);

/// The text of a whole copy, as scene_print_into() and scene_print_paint() would have printed the document.
bool snapshot_print(struct snapshot *snapshot, char **buffer, size_t *capacity, size_t *size);

/// A knot of the document's spline at `spline` is taken out next, or was put in: of the copy that the document is in, if there is one.
void snapshot_knot_goes(const struct document *document, int spline, int at);
void snapshot_knot_came(const struct document *document, int spline, int at);

#endif
