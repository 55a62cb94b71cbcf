/// A document under edit, for tests of edits and history. Edits are said in words: world_do(world, "move sway 0 20.5 7").
#ifndef TESTS_WORLD_H
#define TESTS_WORLD_H

#include "documents.h"

#include "scene/edit.h"
#include "scene/history.h"

/// The splines of the small document: three knots; spring and friction from rest; a loop that follows the first.
enum { SWAY, PLUCK, LOOP };

struct world {
    struct document *document;
    struct history *history;
    struct error error;      ///< of the last refused edit
    struct document *before; ///< the open step of world_edit(), or NULL
    const char *label;       ///< of the previous step
    char **printed;          ///< texts returned by world_print()
    int printed_count;
};

void world_open(struct world *world);
/// The same with another scene.
void world_open_scene(struct world *world, const char *scene);
void world_close(struct world *world);

/// The document's canonical text, valid as long as the world.
const char *world_print(struct world *world);
void assert_document(const struct world *world, const char *expected);

/// The document in an open step, which this opens if necessary: `world_must(&world, edit_joints(world_edit(&world), 0, 12, &world.error))`.
struct document *world_edit(struct world *world);
/// An edit of scene/edit.h in such a step: assert_reversible(world, EDIT(edit_joints, 0, 12)).
#define EDIT(edit, ...) edit(world_edit(world), __VA_ARGS__, &world->error)

/// An edit in words, in such a step. Splines and rigs go by name or index; a knot, channel, drive or pin by its index,
/// a knot also by its frame: @85.
///
///     insert SPLINE FRAME VALUE           move SPLINE KNOT FRAME VALUE      knot SPLINE KNOT MEMBER VALUE     remove SPLINE KNOT
///     set SPLINE PARAMETER VALUE          track SPLINE PARAMETER SPLINE     settle SPLINE 0|1
///     follow SPLINE PARAMETER MODEL JOINT OF GAIN CHAIN                     names, or '' and - for an empty one and none
///     add PLACE NAME FRAME VALUE          copy SPLINE    drop SPLINE        order SPLINE PLACE
///     name SPLINE NAME                    color SPLINE NUMBER
///     folder SPLINE [NAME]                lock SPLINE 0|1
///     fps RATE [keep]                     substeps N                        range FIRST LAST refuse|move|trim
///     angles RIG CHANNEL KIND NUMBER …    numbers, or of a ramp PLACE:DEGREES
///     bend RIG CHANNEL SPLINE AXIS OF     channel RIG SPLINE AXIS OF        unchannel RIG CHANNEL
///     background [FILE OFFSET]
///     tail RIG SPLINE                     unrig RIG      rename RIG NAME    joints RIG COUNT
///     length RIG VALUE                    place RIG AXIS VALUE              ride RIG AXIS SPLINE
///     clip RIG NAME                       turn RIG DEGREES                  floor RIG HEIGHT                   offset RIG FRAMES
///     drive RIG DRIVE SPLINE AMPLITUDE LAG NAME                             undrive RIG DRIVE
///     pin RIG FRAME POINT X Y Z           repin RIG PIN FRAME POINT X Y Z   unpin RIG PIN
bool world_do(struct world *world, const char *edit);
/// Edits with ';' between them, each in a step of its own. The last step stays open.
bool world_do_all(struct world *world, const char *edits);

/// Each of some edits with '|' between them, of a scene of its own: the last step is refused with this sentence; where that is NULL, it is done;
/// where "", done and no step.
void assert_edits(const char *scene, const char *edits, const char *says);

/// Closes the step of an edit that succeeded or failed; the second requires success.
bool world_step(struct world *world, bool done);
void world_must(struct world *world, bool done);

/// The edit failed with this message and left document and history unchanged.
void assert_refused(struct world *world, bool done, const char *sentence);

/// The edit is one step that undo reverts byte by byte and redo repeats; it stays done.
void assert_reversible(struct world *world, bool done);

/// Undoes everything; returns the number of steps.
int world_undo_all(struct world *world);

// Edits of the world's document, as by world_edit().

bool edit_insert(struct world *world, int spline, double frame, double value);
bool edit_frames(struct world *world, int first, int last);
/// Sets a channel's spline, axis or part; −1 keeps it.
bool edit_bend(struct world *world, int rig, int channel, int spline, int axis, int of);

/// A test of a world opened by `opens` and closed afterwards: WORLD_TEST(name, world_open(world)) { … }.
#define WORLD_TEST(name, opens) TEST_OF(struct world, world, opens, world_close(world), name)

#endif
