/// The core of the editor: edits, messages, requests to the app, splines, layout, playback. It asks before an edit loses or moves something
/// else.
#ifndef EDITOR_CORE_CORE_H
#define EDITOR_CORE_CORE_H

#include "editor/core/state.h"

/// Resets selection, playhead and views for a new document.
void core_open(struct core *core);
/// The path of the document's file, or ""; its name, or "untitled".
const char *core_path(const struct core *core);
const char *core_title(const struct core *core);
/// Notes an edit of a spline, or of its selected knots if it is -1.
void core_edited(struct core *core, int spline);
/// Opens the undo step for the edits that follow, and clears the last message; `merge` as in history_begin(). The end of the event closes it.
/// An edit that fails writes core->step.error, and all of the step is reverted. false while a drag's step is open, because others must not mix with it.
bool core_step(struct core *core, const char *label, uint64_t merge);
/// Closes the step of this event, if any. The editor calls it; a drag's step stays open.
void core_close(struct core *core);
/// Closes the open step, with what is seen at its end.
void core_end(struct core *core);
/// Call after edits in a drag: the editor follows the document, and core->step.error goes to the status line.
void core_settle(struct core *core);
/// Call after edits in an open step: of each spline that winds up and whose knots have changed, the next free knot becomes a pose with the phase
/// it had when the step began. So nothing changes beyond it. Not in a drag with Alt held, or if that is switched off.
void core_keep_following(struct core *core);
/// Sets a spline's parameter, which then no longer follows another spline. Edits.
bool core_set_parameter(struct core *core, int spline, enum parameter parameter, double value);
/// A parameter's value at a sample, clamped to its range, even if it follows another spline.
double core_parameter_at(const struct core *core, const struct spline *spline, enum parameter parameter, int sample);
/// Sets a knot, or inserts it if its id is 0. Edits.
bool core_put_knot(struct core *core, int spline, const struct knot *knot);
/// Fails if a spline's knots are locked against edits by hand.
bool core_check_lock(const struct core *core, int spline, struct error *error);
/// The knot at a sample, or a new one with id 0.
struct knot core_knot_at(const struct document *document, int spline, int sample);
/// Call after edits, undo, redo and a new document: keeps the active spline and the playhead's frame. See editor_refresh().
void core_refresh(struct core *core);
/// Undoes (-1) or redoes (1) a step.
void core_undo(struct core *core, int direction);
/// Undoes or redoes until `done` steps are done.
void core_jump(struct core *core, size_t done);
/// Closes the undo step of this event, then the app carries out a request. It may replace the document.
void core_request(struct core *core, const struct request *request);
/// A question to ask after the event; the caller fills in its text.
struct question *core_ask(struct core *core, const struct answer *answers, int count,
                          void (*answered)(void *core, int answer));
/// In a page, drops the browser's own home folder from a sentence: no user knows it.
void core_drop_home(const struct core *core, char *text);
/// Shows a message in the status line: an error until the next key or click, others for some seconds.
void core_message(struct core *core, bool is_error, const char *format, ...) __attribute__((format(printf, 3, 4)));
/// Moves a knot within its spline's limits. `why` says what held it: "held by the limit 1.2 of sway at frame 14".
void core_hold(const struct spline *spline, struct knot *knot, char why[STOPPED_SIZE]);
/// The knot's drawn value; for a still one, its curve's.
double core_knot_value(const struct core *core, int spline, const struct knot *knot);
/// Appends the reason an edit stopped to a sentence, unless it is "".
void core_add_stopped(const char *why, char *text, size_t size);
/// Shows the reason an edit stopped in the status line.
void core_stopped(struct core *core, const char *why);
struct spline *core_active_spline(const struct core *core);
/// Describes a spline for the solver, whichever comparison is shown; the caller frees its knots.
wiggly_desc core_describe(const struct core *core, int spline, bool cubic, wiggly_knot **knots);
/// Activates a spline and clears the selection.
void core_activate(struct core *core, int spline);
/// The same for a spline chosen by itself: Feel then acts on no other.
void core_choose(struct core *core, int spline);
/// Activates a spline and keeps the selection.
void core_turn_to(struct core *core, int spline);
/// Rounds to the power of ten at or below `resolution` (> 0), so that dragged values have no meaningless decimals in files.
double core_round(double value, double resolution);
/// A spline's colour 0xRRGGBBAA: its own or the theme's.
uint32_t spline_list_color(const struct document *document, int spline);
/// Whether the curves show a spline: a solo one if any is, else one that is not hidden.
bool spline_list_shows(const struct core *core, int spline);
/// Whether edits of splines act on one: the active one, and those that are selected in the list.
bool core_is_chosen(const struct core *core, int spline);
/// How many that are.
int core_chosen_count(const struct core *core);
/// The active spline if the curves show it, else NULL.
const struct spline *spline_list_seen(const struct core *core);

/// A set of ids: selected knots, or splines.
bool selection_has(const struct selection *selection, unsigned id);
void selection_set(struct selection *selection, unsigned id, bool selected);
void selection_clear(struct selection *selection);
/// Removes ids from `id` on, which will be reused.
void selection_drop_from(struct selection *selection, unsigned id);
int selection_count(const struct selection *selection, const struct spline *spline);
/// Index of the spline's only selected knot, or -1.
int selection_single(const struct selection *selection, const struct spline *spline);
void selection_copy(struct selection *to, const struct selection *from);

#define SELECTED_START                                                                                               \
    (struct knot_place) { -1, -1 }

static inline const struct knot *knot_at(const struct document *document, struct knot_place at)
{
    return &document->splines[at.spline]->knots[at.knot];
}

/// Goes to the next selected knot, by spline and sample; false after the last.
bool selected_next(const struct core *core, struct knot_place *at);
int selected_count(const struct core *core);
/// If only another spline's knots are selected, activates that spline.
void selected_activate(struct core *core);

void originals_add(struct originals *originals, int spline, const struct knot *knot);
/// Collects the selected knots in `originals`; `later`: also all knots after each spline's first one.
void core_collect(struct core *core, bool later);

/// Computes an original's new knot.
typedef struct knot knot_rule(const struct core *core, const void *how, const struct original *original);

enum room { ROOM_FREE, ROOM_OCCUPIED, ROOM_OUTSIDE };

/// Whether the knots fit where a rule, which keeps or reverses their order, puts them: in range, on different frames, and off other knots.
/// If not, `why` says "a knot would leave the range" or the like. The document must be as when they were collected.
enum room originals_room(const struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE]);
/// Moves the knots, which must fit. `why` says which one a limit holds, core->step.error why it failed. Edits.
bool originals_put(struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE]);

/// A merge key for history_begin() that makes equal nudges of the same knots one undo step.
uint64_t core_merge_key(const struct core *core, uint64_t kind);

/// What a knot holds: a value, a pose (value and phase), or stillness.
enum holds { HOLDS_VALUE, HOLDS_POSE, HOLDS_STILL };
static inline enum holds knot_holds(const struct knot *knot)
{
    return knot->still ? HOLDS_STILL : knot->has_phase ? HOLDS_POSE : HOLDS_VALUE;
}

#endif
