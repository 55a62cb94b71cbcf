/// What the files of src/editor share: the editor's state and the few functions that every panel uses. Private to the
/// folder.
///
/// The document is never kept here: each call is handed the world. Knots are remembered by id, splines and tails by
/// index.
#ifndef EDITOR_CORE_STATE_H
#define EDITOR_CORE_STATE_H

#include "editor/core/panels.h"
#include "editor/editor.h"
#include "editor/stage/brush.h"
#include "editor/stage/characters.h"
#include "rig/camera.h"
#include "rig/follow.h"
#include <stdint.h>

enum {
    EDITOR_MAX_COLUMNS = 4096, ///< vertices of one drawn curve
    EDITOR_MAX_REQUESTS = 8,
    CURVES_MAX_OTHERS = 9,   ///< splines drawn besides the active one
    CURVES_MAX_RANGES = 256, ///< splines that can be normalised
    CURVES_FAN = 7,          ///< lagged copies of the active curve
};

/// Rectangles of the panels, in logical pixels; made by editor_layout().
struct layout {
    struct rect window, stage, curves, inspector, status;
    struct rect ruler;      ///< frame numbers, on top of the plot
    struct rect value_axis; ///< numbers left of the plot
    struct rect plot;
    float stage_share; ///< of the height above the status line; kept when the window changes its size
    float inspector_width;
};

/// How the curves panel shows things; a view, never part of the document.
struct curve_options {
    bool normalise; ///< every curve as high as the active one; the axis shows the active one's values
    bool seconds;   ///< on the ruler, in place of frames
    bool no_snap;   ///< knots go between the frames, and onto them with Ctrl
};

/// Where a spline's values are drawn, as values of the active one: scale·value + offset.
struct value_map {
    double scale, offset;
};

/// Visible part of the curves panel.
struct view {
    double frame0, frame1; ///< at the plot's left and right edge
    double value0, value1; ///< at its bottom and top edge
};

/// Selected knots: one bit an id. Only knots of the active spline are ever selected.
struct selection {
    uint64_t *bits;
    unsigned capacity; ///< ids
};

enum drag_kind {
    DRAG_NONE,
    DRAG_KNOTS,
    DRAG_SLOPE,
    DRAG_BOX,
    DRAG_SCALE, ///< without a button: begun by S, ended by a click or Enter
    DRAG_SCRUB,
    DRAG_RANGE,
    DRAG_PAN,
    DRAG_ORBIT,
    DRAG_STAGE_PAN,
    DRAG_GRAB,
    DRAG_BODY,
    DRAG_PAINT, ///< a stroke of the brush
    DRAG_STAGE_DIVIDER,
    DRAG_INSPECTOR_DIVIDER,
};

/// What a box does with the knots in it.
enum box_mode { BOX_REPLACE, BOX_ADD, BOX_REMOVE };

/// A mouse drag in progress. Its edits are made anew from the original document at every step.
struct drag {
    enum drag_kind kind;
    enum event_button button;
    float x, y; ///< pointer at the last step
    float start_x, start_y;
    double moved_x, moved_y; ///< sum of movements, the fine ones scaled down
    bool moved;              ///< past the threshold below which a press is a click
    bool lock_x, lock_y;     ///< only the frame, only the value may change
    bool snap;
    unsigned knot;          ///< id of the knot under the pointer at the press
    struct knot *originals; ///< of all knots that move, by sample
    int count, capacity;
    double free_frames; ///< last shift by which no knot was hit
    int handle;         ///< DRAG_SLOPE: which end, as in curves_handle()
    bool stale;         ///< the pointer moved since the edits were made
    bool collapse;      ///< a click on a selected knot selects it alone, a drag moves all
    enum box_mode box;  ///< DRAG_BOX
    bool ripple;        ///< DRAG_KNOTS: what comes after the first moved knot moves along in time
    double ripple_from; ///< frame of that knot, before
};

/// The last key that went down in this frame, whose character follows it.
struct press {
    bool used;     ///< by a dialog, a drag, a field …
    bool repeated; ///< it is kept down
};

/// Scaling of the selected knots (DRAG_SCALE), about a frame and a value.
struct scaling {
    bool about_playhead; ///< else about the middle of the selection
    double frame, value; ///< the pivot
    double free_time;    ///< last factor by which no knot was hit
    char typed[16];      ///< a factor in place of the pointer's
    char sentence[256];
};

/// One channel that a grab steers through a knot at the playhead. The solution is affine in the knot's value v: at
/// that sample x = x₀ + v·(1 + j·turn), where `turn` is observed from one step to the next.
struct grab_axis {
    bool active;
    int spline;
    double value; ///< of the knot, in the running step
    double turn;
    double seen_value, seen_im; ///< of an earlier solved frame
    double values_per_radian;   ///< of bend at the grabbed joint
};

/// The tail held by the pointer.
struct grab {
    int tail, joint;
    double fraction;          ///< of the segment after `joint`
    int sample;               ///< on which the knots are set
    float start[2];           ///< where the grabbed point was, pixels
    struct grab_axis axis[2]; ///< by enum axis
    bool applied;             ///< the open step holds edits
};

/// The body held by the pointer, and how the pointer's way becomes one over the ground.
struct body {
    int tail;
    double pixels_per_metre; ///< at the body
    double pitch;            ///< metres up the screen for one away from the eye
    double right[2];         ///< x and z of what is to the right on the screen
};

enum { RECORD_SAMPLES = 8192 };

/// Firm enough that the body stands still at both ends of its way, 1/s.
#define RECORD_STIFFNESS 1e5

/// The way of the held body while it is recorded.
struct record {
    bool armed;                     ///< the next drag of a body is recorded from its start
    bool running;                   ///< it goes on; ends with what is played
    int first, count;               ///< samples
    double way[3][RECORD_SAMPLES];  ///< metres from where the document has it
    double seen_position, seen[3];  ///< at the last frame
    bool hangs[SCENE_MAX_CHANNELS]; ///< channels that swung
};

/// A tail whose body is or was moved by hand.
struct follow {
    bool swings;
    double offset[3], velocity[3]; ///< of the base from where the document has it, metres and metres per second
    struct follower channel[SCENE_MAX_CHANNELS]; ///< in metres
    double scale[SCENE_MAX_CHANNELS];            ///< follow_scale() of each
};

enum { TRAIL_FRAMES = 256 };

/// The tip of a tail at a frame, as it was when the document was at `key`.
struct trail_point {
    bool known;
    uint64_t key;
    int frame;
    float tip[3];
};

/// What is shown over the stage; stays as it is when another document is opened.
struct overlays {
    bool onion, trail;
    struct trail_point trail_point[TRAIL_FRAMES];
};

/// What the pointer is over in the curves and on the stage.
enum hover_kind {
    HOVER_NONE,
    HOVER_KNOT,
    HOVER_SLOPE,
    HOVER_CURVE,
    HOVER_RULER,
    HOVER_UNITS,
    HOVER_WARNING,
    HOVER_JOINT,
    HOVER_BODY,
    HOVER_PLAY,
    HOVER_LOOP,
    HOVER_SPEED,
};

struct hover {
    enum hover_kind kind;
    int spline;
    unsigned knot;
    int handle; ///< HOVER_SLOPE: which end, as in curves_handle(); HOVER_WARNING: which one
    int tail, joint;
    double fraction; ///< of the segment after the joint
    float x, y;      ///< of the point on the tail
};

enum warning_kind {
    WARNING_SWING, ///< the curve goes further than twice its knots
    WARNING_RATE,  ///< a frequency near half the sample rate
    WARNING_DRIFT, ///< bandwidth times the periods between two knots
};

/// Something about the active spline that nobody wants.
struct warning {
    enum warning_kind kind;
    double frame, value; ///< the place (not of a rate)
    double from, to;     ///< frames of the knots around it
    double amount;       ///< swing in heights of the knots; Hz; periods
    double limit;        ///< Hz that would be fine; bandwidth as it is
    double remedy;       ///< value of a knot at the place; substeps; bandwidth
};

enum { WARNINGS_MAX = 16 };

/// How far the search for them is: a spline of millions of samples is searched over many frames.
struct warning_search {
    bool running;
    int measured; ///< knots whose heights are in `highest`
    int next;     ///< knot from whose span it goes on
    double frequency, bandwidth, highest;
    struct warning drift; ///< the worst; amount 0: none
};

struct warnings {
    uint64_t key; ///< of what they were found in
    int spline;   ///< whose they are
    int count;
    struct warning_search search;
    struct warning list[WARNINGS_MAX];
};

struct playback {
    bool playing;
    bool looping;    ///< over the range that is played (Ctrl+L)
    double position; ///< in samples; may lie between two
    double speed;    ///< 1: real time
    long dropped;    ///< frames of the scene that no picture showed, since it plays
    bool has_range;  ///< a part is played: these frames
    double range[2];
    bool had_range; ///< the same before a drag
    double old_range[2];
};

/// A curve in logical pixels, a vertex for each column of the cache.
typedef float polyline[EDITOR_MAX_COLUMNS][2];

/// Everything that curves.c draws from the solved splines; rebuilt when `key` changes.
struct curve_cache {
    uint64_t key;
    int count;                           ///< columns; 0 where the scene is out of sight
    double by;                           ///< samples from column to column
    double position[EDITOR_MAX_COLUMNS]; ///< in samples; knots of the active spline are hit exactly
    polyline re, im, equilibrium, fan[CURVES_FAN], others[CURVES_MAX_OTHERS];
    int fan_count, other_count;
    int other_spline[CURVES_MAX_OTHERS];
    double range[CURVES_MAX_RANGES][2]; ///< lowest and highest value of each spline, where curves are normalised
    int range_count;
};

/// The active curve as it was before a drag, in frames and values so that it survives a change of the view.
struct ghost {
    bool visible;
    int count;
    double frame[EDITOR_MAX_COLUMNS], value[EDITOR_MAX_COLUMNS];
};

struct message {
    char text[768];
    bool is_error;
    double seconds_left; ///< of a message that is not an error
};

struct editor {
    struct layout layout;
    float scale;
    struct view view;
    struct curve_options options;
    int active;         ///< spline, -1 where there is none
    unsigned active_id; ///< its id, by which it is found again when the list has changed
    struct selection selection;
    struct selection before_box;   ///< the selection when a box was begun
    struct selection hidden, solo; ///< splines, by their ids
    unsigned visibility;           ///< grows whenever these change
    int seen_first, seen_substeps; ///< of the scene, which the playhead's position counts in
    struct playback playback;
    struct drag drag;
    struct scaling scaling;
    struct grab grab;
    struct body body;
    struct record record;
    struct overlays overlays;
    struct follow follow[STAGE_MAX_TAILS];
    struct hover hover;
    struct ghost ghost;
    struct curve_cache cache;
    struct warnings warnings;
    float scratch[2 * EDITOR_MAX_COLUMNS]; ///< points of a line that is made while it is drawn
    enum look look;
    float pointer_x, pointer_y;
    unsigned mods;
    struct press press;
    int held_key; ///< F Z B C L while pressed, else 0
    bool space_down, space_used;

    struct camera camera;
    bool fitted; ///< camera and curves view, at the first editor_pose() of a document
    struct stage_view stage;
    struct character_view characters;
    struct brush brush;

    struct inspector inspector;
    struct dialog dialog;
    struct help help;
    bool welcome; ///< the card for somebody who is new is shown
    struct status status;

    unsigned serial; ///< of the document on the table
    char title[256]; ///< the file's name, or "untitled"
    char path[1024]; ///< of the document's own file, or ""
    struct message message;
    double fps, solve_us; ///< from editor_set_stats()
    float stage_scale;    ///< from editor_set_stage_scale(); 0 means 1

    char *clipboard; ///< knots that were copied, as text; NULL at first
    struct request requests[EDITOR_MAX_REQUESTS];
    int request_count;
    struct drawlist list;
};

/// Rectangles of all panels for the window's size.
void editor_layout(struct editor *editor);

/// Applies one edit inside the open step; on failure the sentence goes to the status line.
bool editor_edit(struct editor *editor, const struct editor_world *world, const struct edit *edit);
/// One edit as a step of its own; `merge` as in history_begin().
bool editor_step(struct editor *editor, const struct editor_world *world, const char *label, uint64_t merge,
                 const struct edit *edit);
/// An edit with everything else zero (tracks -1): fill in what the kind needs.
struct edit editor_edit_of(enum edit_kind kind, int spline);

/// Queues a request to the app; `path` may be NULL.
void editor_request(struct editor *editor, enum request_kind kind, const char *path);

/// The same for a figure of the paper.
void editor_request_figure(struct editor *editor, int number);

/// The active spline, or NULL. editor_activate() also drops the selection and
/// shows the tail's channel that it moves.
struct spline *editor_active_spline(const struct editor *editor, const struct editor_world *world);
void editor_activate(struct editor *editor, const struct editor_world *world, int spline);

void editor_set_look(struct editor *editor, enum look look);

/// Frame (fractional) that is shown.
double editor_frame(const struct editor *editor, const struct document *document);

/// Undo and redo; what they take away leaves the selection.
void editor_undo(struct editor *editor, const struct editor_world *world);
void editor_redo(struct editor *editor, const struct editor_world *world);
/// Undoes or does again until `done` of the history's steps are done.
void editor_jump(struct editor *editor, const struct editor_world *world, size_t done);

/// Memory for the document's knots in selection and drags; allocates only where knots were added.
void editor_reserve(struct editor *editor, const struct document *document);

bool selection_has(const struct selection *selection, unsigned id);
void selection_set(struct selection *selection, unsigned id, bool selected);
void selection_clear(struct selection *selection);
/// Forgets the ids from `id` on, which are to be given again.
void selection_drop_from(struct selection *selection, unsigned id);
int selection_count(const struct selection *selection, const struct spline *spline);
/// Index of the only selected knot of the spline, or -1.
int selection_single(const struct selection *selection, const struct spline *spline);

#endif
