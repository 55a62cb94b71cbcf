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

// --- what is shown: where the panels are, what time it is, and the switches of how the scene looks

/// The values in sight of the curves.
static inline double plot_height(const struct core *core) { return core->view.plot.value1 - core->view.plot.value0; }

/// The topmost panel at a point.
enum panel core_panel_at(const struct core *core, float x, float y);
/// Sets the stage's share of the height and the inspector's width.
void core_set_panels(struct core *core, double stage_share, double inspector_width);
/// Lays out all panels in the window.
void core_layout(struct core *core);
/// How near the pointer must be to something that a mouse hits within `pixels`.
float core_reach(const struct core *core, float pixels);
/// The divider at a point, or DIVIDER_NONE.
enum divider core_divider_at(const struct core *core, float x, float y);

/// Plays, or stops at the nearest frame.
void playback_toggle(struct core *core);
/// Advances by `dt` seconds of real time. Counts scene frames that were skipped.
void playback_advance(struct core *core, double dt);
/// Stops at a frame.
void playback_seek(struct core *core, double frame);
/// Stops at the next whole frame in a direction.
void playback_step(struct core *core, int direction);
/// Stops at an end of the range.
void playback_end(struct core *core, int direction);
/// Goes to the next faster (1) or slower (-1) speed between 0.1 and 4; 0: real time.
void playback_change_speed(struct core *core, int direction);

/// First and last played frame: the chosen range within the scene, or the whole scene.
void playback_range(const struct core *core, double range[2]);
/// Whether less than the whole scene is played.
bool playback_is_part(const struct core *core);
/// Sets the played range and shows it in a message; an empty or complete one means the whole scene.
void playback_choose(struct core *core, double first, double last);
/// Sets the range's start (0) or end (1) to the playhead.
void playback_mark(struct core *core, int end);

/// Flips a switch and shows a message.
void core_flip(struct core *core, int which);
/// Chooses the look and shows a message.
void core_set_look(struct core *core, enum look look);
void core_turn_look(struct core *core);
/// The frame at the playhead, fractional.
double core_frame(const struct core *core);
/// A frame as a fractional sample.
double core_position(const struct document *document, double frame);

/// Keeps the scene as "before", solved once; or forgets it (0).
void take_keep(struct core *core, int keep);
/// Whether it is shown: K is held, and no edit is open. And whether on the stage, too: its rigs and samples are those of now.
bool take_is_shown(const struct core *core);
bool take_is_posed(const struct core *core);
/// What a spline or rig was before: the spline's index there, or -1; the rig, or NULL.
int take_spline(const struct core *core, int spline);
const struct rig *take_rig(const struct core *core, int rig);

// --- a drag of the pointer. Only the panel that starts it gets its events

enum drag_answer { DRAG_PASSES, DRAG_USED, DRAG_KEEP, DRAG_TAKE_BACK };

/// A drag's functions, each may be NULL. `room` is the panel that started it.
struct drag_owner {
    enum mouse_cursor cursor;
    bool goes_on; ///< apply() runs every frame and continues from its last edits

    /// Called when the pointer moves.
    void (*move)(void *room, struct core *core);
    /// Called once per frame with movement: edits the document as it was at the start.
    void (*apply)(void *room, struct core *core);
    /// For events other than the pointer's. DRAG_PASSES leaves them to the common handling.
    enum drag_answer (*event)(void *room, struct core *core, const struct event *event);
    /// Called before the undo step closes; `keep` false: before it is reverted.
    void (*end)(void *room, struct core *core, bool keep);
    /// Draws a running drag's marks.
    void (*show)(void *room, struct core *core);
};

extern const struct drag_owner divider_drags[]; ///< by enum divider

/// Whether knots snap to frames; Ctrl inverts the panel's setting.
bool drag_snaps(const struct core *core, unsigned mods);
/// Starts a drag. Its undo step `label` (NULL: no edits) opens when the pointer moves.
void drag_begin(struct core *core, const struct drag_owner *owner, void *room, const char *label,
                const struct event *event);
/// Makes it a drag rather than a click, and opens its undo step.
void drag_start_moving(struct core *core);
/// Passes an event to the running drag; true if used.
bool drag_event(struct core *core, const struct event *event);
/// Call once per frame after its events: applies the drag's edits.
void drag_apply(struct core *core, double dt);
/// Reverts the drag's edits so far.
void drag_restart(const struct core *core);
/// Ends the running drag, if any; `keep` false reverts its edits.
void drag_end(struct core *core, bool keep);
/// Draws the running drag's marks if `room` started it.
void drag_show(const void *room, struct core *core);
/// X and Y restrict the drag to frames or values. false for other keys.
bool drag_lock(struct drag *drag, int key);
/// X, Y and Z restrict the drag to an `axis`; again, to none (−1).
bool drag_lock_axis(struct drag *drag, int *axis, int key);
/// Shows why a drag is stopped, while it is; "": it is not.
void drag_say_stopped(struct core *core, const char *why);

// --- edits of the selected knots of all splines

/// Inserts and selects a value or a pose at a frame (whole if `snap`), or selects the knot there. Value NAN: where the curve is; without wind-up,
/// between knots, the curve stays as it is.
void core_insert_knot(struct core *core, double frame, double value, bool snap, enum holds holds);
/// Deletes the selected pin, else the selected knots.
void core_delete(struct core *core);
/// Selects a knot and nothing else, not even a pin.
void core_select_only(struct core *core, unsigned id);
/// Selects the active spline's knots, or those of all shown splines.
void core_select_all(struct core *core, int all_splines);
/// Selects the neighbour of the selected knot, or of the playhead if not exactly one is selected; NULL if none.
const struct knot *core_select_neighbour(struct core *core, int direction);
/// Selects the next knot after the playhead (1) or before it (-1) and goes there; NULL if none.
const struct knot *core_visit_neighbour(struct core *core, int direction);
/// Adds the knot after the last selected one (1) or before the first (-1) to the selection; NULL if none.
const struct knot *core_extend_selection(struct core *core, int direction);
/// Lets the motion settle at the selected knots, or if it does at all of them, at none. Still knots have no value to settle at.
void core_toggle_settles(struct core *core);
/// Makes the selected knots hold that where the curves are now. If all do already, they hold a value only.
void core_set_hold(struct core *core, int holds);

/// Changes of the selected knots' slopes: on as the curve runs, or off; level; aimed at the neighbours (Catmull-Rom); turned in proportion to
/// the visible values; stiffer or less.
enum slopes { SLOPES_TOGGLE, SLOPES_FLAT, SLOPES_SMOOTH, SLOPES_UP, SLOPES_DOWN, SLOPES_FIRMER, SLOPES_SOFTER };
void slopes_set(struct core *core, int how);

/// Copies the selected knots as text; `cut` also deletes them. false if none is selected.
bool core_copy_knots(struct core *core, bool cut);
/// Turns the selected knots upside down about zero.
void core_mirror_knots(struct core *core);
/// Begins to simplify the active spline, or of its knots the selected ones if these are several; or ends it (0). Until then,
/// core_simplify_advance() applies the chosen tolerance once a frame.
void core_simplify(struct core *core, int on);
void core_simplify_advance(struct core *core);
/// Moves the selected knots half way to a cubic through the others; those at the ends of a row stay.
void core_smooth_knots(struct core *core);

/// Pastes knots, the first at the playhead with the others at their distances, and selects them; at their own frames or upside down if
/// input.paste says so, once. If one does not fit, none is pasted.
void core_paste_knots(struct core *core, const char *text);
/// Inserts copies of the selected knots after them and selects the copies.
void core_duplicate_knots(struct core *core);

// --- edits of splines: their list, timing and parameters

/// Activates the next (1) or previous (-1) spline, cyclically.
void core_activate_neighbour(struct core *core, int direction);

/// Appends a spline with a knot at the playhead and activates it. The others act on the chosen splines: copies them, removes them (and asks if
/// something follows them), moves them in the list, flips what shows and locks them, puts them into a folder or takes them out.
enum list_change {
    LIST_ADD,
    LIST_COPY,
    LIST_REMOVE,
    LIST_UP,
    LIST_DOWN,
    LIST_FOLDER,
    LIST_SOLO,
    LIST_HIDE,
    LIST_LOCK
};
void spline_list_change(struct core *core, int change);
/// Moves the chosen splines before the one at an index, into a folder (NULL: none).
void spline_list_place(struct core *core, int to, const char *folder);
/// The row of splines first … end − 1, a folder's or one. Whether it acts on a spline, too: that is among them, or selected as the one is.
bool spline_list_acts(const struct core *core, int first, int end, int spline);
/// Shows that row's splines alone, hides or locks them; or no longer.
void spline_list_flip(struct core *core, enum list_change change, int first, int end);
/// Whether two splines, which may lie outside the list, are in one folder.
bool spline_list_together(const struct document *document, int a, int b);
/// Value of a track at the playhead, within the parameter's limits.
double spline_list_present(const struct core *core, int spline, enum parameter parameter);
/// Sets the frame rate; asks whether knots keep their frames or seconds.
void spline_list_fps(struct core *core, double fps);
/// Sets the range; asks whether to move or delete knots outside.
void spline_list_range(struct core *core, int first, int last);

/// Closes all curves: each ends as it starts. A knot on the last frame goes, because that frame then repeats the first.
void core_close_curves(struct core *core);

/// Sets the frequency and damping that explain the knots best, or second best if those are set already.
void core_find_frequency(struct core *core);

enum { LIMB_NONE = -1, LIMB_ROWS = -2 };
/// What Feel acts on, whichever was chosen last: LIMB_ROWS, several rows of the list; a rig, while the active spline bends or drives it; or LIMB_NONE,
/// the active spline alone.
int core_limb(const struct core *core);
/// Whether a spline is one of a limb's.
bool core_is_felt(const struct core *core, int limb, int spline);
/// Sets a parameter of the active spline. Frequency, damping and wind-up also change for the limb's other splines that use
/// them: to the same value if `alike`, else by core_in_step(). What follows a spline still does. Edits.
bool core_set_felt(struct core *core, int limb, enum parameter parameter, double value, bool alike,
                   struct error *error);
/// Sets a channel's lag, and scales those of the limb's other channels that bend, of rows those that they drive. Edits.
bool core_set_lag(struct core *core, int limb, struct channel_place at, const struct angles *lag,
                  struct error *error);
/// A number changed by the factor that took another from `before` to `now`. From 0 there is none: a 0 becomes `now`, others stay.
double core_in_step(double other, double before, double now);

/// The channel the active spline moves, of the limb if possible, else the first channel of all; NULL if there are none.
const struct channel *core_active_channel(const struct core *core, int *rig, int *channel);
/// End of a parameter's slider; 0: none.
double core_slider_end(const struct document *document, const struct spline *spline, enum parameter parameter);
/// Initial value of a limit: a little beyond the knots.
double core_fresh_limit(const struct spline *spline, enum parameter parameter);
/// Steps the frequency while F is held, with Z the damping, with L the lag.
void core_nudge_parameter(struct core *core, int direction);
/// Goes to the next kind of spline, cyclically.
void core_cycle_mode(struct core *core);

/// Lets the motion of a limb settle at all of its knots, which then hold values alone; or if the active spline does, at none. The second: of the
/// limb that Feel acts on.
void core_pose_to_pose(struct core *core, int limb);
void core_toggle_pose_to_pose(struct core *core);

// --- edits of rigs: tails, characters with their bones, chains and paint, pins. Each is one undo step

/// What new users should drag: the first of these kinds the scene has.
enum lead { LEAD_TAIL, LEAD_CHARACTER, LEAD_CHAIN, LEAD_MODEL, LEAD_MESH, LEAD_NOTHING, LEADS };
enum lead rigs_lead(const struct core *core);
/// Whether a character has bones to click. One that could not be read counts.
bool rigs_have_bones(const struct core *core);
bool rigs_have_knots(const struct document *document);

/// Adds a tail beside the other rigs, bent by the active spline or a new one.
void rigs_add_tail(struct core *core);
/// Adds a copy moved by the same splines. A character's chains are copied too.
void rigs_copy(struct core *core, int rig);
/// Removes a rig and its chains. Asks whether to delete splines that move nothing else. Splines that follow one of its joints keep their
/// value at the playhead.
void rigs_ask_remove(struct core *core, int rig);

// --- bones of characters

/// The character of a model rig, or NULL if its file could not be read.
const struct imported *bones_character(const struct core *core, int model);
/// The selected bone's node, and its character's rig; −1 if none is selected or the character is gone.
int bones_selected(const struct core *core, int *model);
enum { BONES_TITLE = 512 };
/// A bone's name, with its rig's before it if there are several characters: "dog 2/tail_1".
const char *bones_title(const struct document *document, int model, const char *name, char title[BONES_TITLE]);
/// A click on a bone answers a pick, else selects the bone.
void bones_clicked(struct core *core, int model, int node);

/// Number of joints of a tail or chain; 1 for a chain whose bones are missing.
int bones_joints(const struct core *core, int rig);

/// Sets a model rig's clip (NULL: none) and whether it repeats, in one step. import_choose_clip() sets the scene's length.
void bones_choose_clip(struct core *core, int model, const char *clip, enum clip_repeat repeat);

/// Lists a character's bones below `top` (−1: all) in file order, at most `most`. Returns how many.
int bones_below(const struct imported *character, int top, int *nodes, int most);

/// Makes a spline's equilibrium follow a joint of a model rig (−1: the best one), in one step. Keeps the kind of motion, the gain and the
/// reference chain; the first time, they suit a chain the spline bends.
void bones_follow(struct core *core, int spline, int model, int node);
/// Moves a chain's first or last bone, in one step. A first bone beside the old end makes the chain go on to its own tip. Splines that
/// follow the last bone follow the new one.
void bones_set_end(struct core *core, int chain, bool first, int node);

/// Makes the selected bone and those down to the tip a chain. With `follow` the chain swings after its motion in the clip. Its first spline
/// becomes active.
void bones_make_chain(struct core *core, int follow);

/// Has flesh made of the selected bone and those below it; else of what paint chooses of the selected character, or all of it. The second time it ends that.
void rigs_make_flesh(struct core *core);

/// A chain whose bones have twins on the other side (ear_L and ear_R, LeftEar and RightEar) that no chain begins at: `chain` if it
/// has, else the last; -1: none.
int bones_mirrorable(const struct core *core, int chain);
/// Makes the chain of the twins, mirrored, by the same splines.
void bones_make_twin(struct core *core, int chain);

// --- the selected soft character and its brush

/// Whether a rig is a character with coordinates, in the scene or in its file.
bool rigs_is_soft(const struct core *core, int rig);
/// The rig that is selected, else the first that is soft; −1: there is none. And it.
int characters_rig(const struct core *core);
const struct model_rig *characters_selected(const struct core *core);
const struct coordinate *characters_coordinate(const struct core *core);
/// The selected character's figure, or NULL, and its coordinate.
const struct figure *characters_figure(const struct core *core, int *coordinate);
/// Turns the brush on or off. It stays off unless a character with a coordinate is selected.
void characters_set_brush(struct core *core, bool on);
/// Gives the selected character blank paint of the figure's size. Edits.
bool characters_blank_paint(struct core *core, const struct figure *figure);
/// Removes the selected character's paint in one undo step.
void characters_clean_paint(struct core *core);

// --- pins: at most one is selected, among all rigs

/// A pin's indices; start from PINS_START.
struct pin_place {
    int rig, at;
};
#define PINS_START                                                                                                   \
    (struct pin_place) { 0, -1 }
/// Goes to the next pin, rig by rig; NULL after the last.
const struct pin *pins_next(const struct document *document, struct pin_place *place);
/// The selected pin and its rig, or NULL; and whether there is one.
const struct pin *pins_selected(const struct core *core, int *rig);
bool pins_any_selected(const struct core *core);
/// The colour of a rig's pins: its first spline's.
uint32_t pins_color(const struct document *document, int rig);
void pins_visit(struct core *core, const struct pin *pin);
/// A whole frame at the playhead, within the scene.
double pins_frame_here(const struct core *core, int rig);
/// In the open step, pins a point or moves its pin at that frame; selects the pin.
bool pins_put(struct core *core, int rig, int point, double frame, const double to[3]);
/// The same at the playhead, in its own step.
void pins_put_here(struct core *core, int rig, int point, const double to[3]);
/// Reports that the splines under a rig's pins were edited.
void pins_tell(struct core *core, int rig);
/// Replaces the pin with that id, or adds one if it is 0. Edits.
bool pins_set(struct document *document, int rig, const struct pin *pin, struct error *error);
/// Moves the selected pin by metres. Repeated nudges are one undo step.
void pins_nudge(struct core *core, const double by[3]);
/// Moves the selected pin by frames, past other pins of its point. Repeated moves are one undo step.
void pins_retime(struct core *core, int frames);
/// Selects the pin after (1) or before (-1) the selected one, by frame.
void pins_select_neighbour(struct core *core, int direction);

// --- commands for keys, F1 and the palette. The table is in editor/commands.c

struct editor;
struct curves;

/// Bits for the place under the pointer. F1 begins with ten rows about it.
enum place {
    ON_CURVES = 1,
    ON_KNOT = 2,
    ON_TIME = 4, ///< ruler, dope sheet, status line
    ON_STAGE = 8,
    ON_PIN = 16,
    ON_INSPECTOR = 32,
    IN_STAGE_MENU = 64, ///< only a right-click on the stage lists it
    IN_EXAMPLES = 128,  ///< only the list of examples has it
    IN_CURVES_MENU = 256,
    ON_ROW = 512 ///< of the splines' list
};

/// What a command needs.
enum need {
    NEEDS_NOTHING,
    NEEDS_UNDO,
    NEEDS_REDO,
    NEEDS_SPLINE,
    NEEDS_SWING,    ///< a spline that is not cubic
    NEEDS_KNOTS,    ///< a spline with knots
    NEEDS_SELECTED, ///< a selected knot
    NEEDS_CHOSEN,   ///< a selected knot or pin
    NEEDS_PIN,
    NEEDS_BONE,
    NEEDS_RIG,
    NEEDS_TAIL, ///< or a chain
    NEEDS_TWIN, ///< a chain that can be mirrored
    NEEDS_PINNABLE,
    NEEDS_BODY,
    NEEDS_MODEL,
    NEEDS_PAINT, ///< a character with a coordinate
    NEEDS_PAGE,  ///< the app runs in a browser
    NEEDS_NO_PAGE,
    NEEDS_COUNT
};

/// When a command's key works.
enum when {
    REPEATS = 1,  ///< also while the key is held
    ANY_TIME = 2, ///< also during a drag, while its undo step is open
    EARLY = 4,    ///< before a drag, the inspector or a popup get the key
    PINS = 8,     ///< goes from pin to pin if one is selected
    IN_STEPS = 16 ///< also with Shift (larger steps) or Ctrl (smaller ones)
};

enum { CHORD_TYPED = 1 << 8 /* among `mods`: it is the typed character, wherever a keyboard has it */ };

/// A key with exactly these modifiers.
struct chord {
    int key; ///< or character; 0: none
    unsigned mods;
};

enum { COMMAND_KEYS = 96 }; ///< bytes for a key's name, or a gesture's

/// The heading of the commands that the palette lists last.
extern const char ABOUT_FILE[];

/// A row of the table. A row with a name and without a function is a gesture, listed only in F1.
struct command {
    const char *name;    ///< NULL: not listed
    const char *also;    ///< other words for it, which the palette finds; NULL for a gesture
    const char *heading; ///< a row with this alone heads those behind it in F1; "": those are not in F1
    unsigned at;         ///< of enum place
    struct chord chord;
    enum need needs;
    unsigned when;       ///< of enum when
    const char *gesture; ///< of the mouse or a held key; replaces the chord
    void (*run)(struct editor *editor, int argument);
    void (*act)(struct core *core);
    void (*core)(struct core *core, int argument);
    void (*curves)(struct curves *curves, struct core *core, int argument);
    void (*inspector)(struct inspector *inspector, int argument);
    const struct knot *(*knot)(struct core *core, int argument); ///< returns the knot to scroll to
    const char *section;                                         ///< inspector section to open
    enum request_kind request;                                   ///< gets the argument as its number
    int argument;
};

/// false for a gesture.
bool command_runs(const struct command *command);
/// What is missing for each need, as in "Select a knot first."; NULL: nothing.
void needs_missing(const struct core *core, const char *missing[NEEDS_COUNT]);
/// Keys that a browser keeps for itself: reload, its address, tabs and history.
bool command_is_browsers(int key, unsigned mods);
/// Its key, "Ctrl+Shift+Z", or its gesture; "" for neither, or, in a page, for a key that is the browser's own.
void command_keys(const struct command *command, bool in_page, char text[COMMAND_KEYS]);
/// A key's name, as "Esc", "PgUp", "←", or NULL.
const char *command_key_name(int key);

#endif
