/// A small document under edit, and makers of edits, for the tests of edits and of their history.
#ifndef TESTS_WORLD_H
#define TESTS_WORLD_H

#include "scene/edit_kinds.h"
#include "scene/load.h"

/// The splines of the document: three knots; spring and friction from rest; a loop that follows the first.
enum { SWAY, PLUCK, LOOP };

struct world {
    struct document *document;
    struct history *history;
    struct error error; ///< of the last edit that was refused
};

void world_open(struct world *world);
void world_close(struct world *world);

/// The document's canonical text; freed by the caller.
char *world_print(const struct world *world);
void assert_document(const struct world *world, const char *expected);

/// An edit inside an open step; an edit as a step of its own; the same, which must be possible.
bool world_apply(struct world *world, struct edit edit);
bool world_step(struct world *world, struct edit edit);
void world_must(struct world *world, struct edit edit);

/// The edit is refused with that sentence, and leaves document and history as they were.
void assert_refused(struct world *world, struct edit edit, const char *sentence);

/// The edit changes the text as a step that undo takes back byte by byte and redo makes again, as which it stays.
void assert_reversible(struct world *world, struct edit edit);

/// Undoes all, and says how many steps there were.
int world_undo_all(struct world *world);

struct edit edit_insert(int spline, double frame, double value);
struct edit edit_move(const struct world *world, int spline, int knot, double frame, double value);
struct edit edit_number(int spline, enum parameter parameter, double value);
struct edit edit_track(int spline, enum parameter parameter, int track);
struct edit edit_mode(int spline, enum wiggly_mode mode);
struct edit edit_start(int spline, enum wiggly_start start);
struct edit range_edit(int first, int last);

#endif
