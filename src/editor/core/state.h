/// State of the editor and its panels: layout, selection, playback, hover, views. Knots are stored by id, splines and
/// tails by index.
#ifndef EDITOR_CORE_STATE_H
#define EDITOR_CORE_STATE_H

#include "editor/core/app.h"
#include "rig/camera.h"
#include "rig/models.h"
#include "rig/posing.h"
#include "scene/edit.h"
#include "scene/evaluate.h"
#include "scene/history.h"
#include "scene/simplify.h"
#include "ui/drawlist.h"
#include "ui/event.h"
#include "ui/stage.h"
#include <stdint.h>

enum { STOPPED_SIZE = 96 /* of what stops an edit, in words */ };

/// The panels' rectangles in logical pixels, from core_layout().
struct layout {
    struct rect window, stage, curves, inspector, status;
    struct rect list;       ///< the splines' list, left of the curves
    struct rect range;      ///< frame rate, first and last frame, above the list; empty above a narrow one
    struct rect ruler;      ///< frame numbers above the plot
    struct rect sheet;      ///< the dope sheet's rows below the ruler; empty if closed
    struct rect value_axis; ///< numbers left of the plot
    struct rect plot;
    float stage_share;     ///< of the height above the status line
    float inspector_width; ///< when upright it stands for a height
    bool upright;          ///< the inspector lies below the curves
    float sheet_height;    ///< set by the curves
};

/// Edges that resize panels: above the curves, left of the inspector, above the inspector.
enum divider { DIVIDER_NONE, DIVIDER_STAGE, DIVIDER_INSPECTOR, DIVIDER_BELOW };

enum panel { PANEL_NONE, PANEL_STAGE, PANEL_CURVES, PANEL_INSPECTOR, PANEL_STATUS };

/// A set of ids, one bit each: selected knots, or splines.
struct selection {
    uint64_t *bits;
    unsigned capacity; ///< ids
};

struct drag_owner;
struct hover;
struct inspector;
struct core;

/// The running drag, see drag.h.
struct drag {
    const struct drag_owner *owner; ///< NULL: none
    void *room;                     ///< the panel that started it
    const char *label;              ///< of its undo step; NULL: no edits
    const char *hint;               ///< text for the status line, or NULL
    enum event_button button;
    float x, y; ///< pointer at the last step
    float start_x, start_y;
    double moved_x, moved_y; ///< total movement, fine parts scaled down
    double dt;               ///< seconds since the last frame
    bool moved;              ///< far enough not to be a click
    bool lock_x, lock_y;     ///< only frames, only values
    bool snap;
    bool stale;    ///< the pointer moved since the last edits
    unsigned knot; ///< id of the held knot; 0: none
    bool stopped;  ///< the status line says why it stopped
};

/// A knot before an edit moves it.
struct original {
    int spline;
    struct knot knot;
    double value;       ///< as drawn
    double equilibrium; ///< at the knot, while scaling
};

/// The knots an edit moves, by spline and sample.
struct originals {
    struct original *list;
    int count, capacity;
};

/// A place that a replay names, as in "knot(sway,2)", and the part of the document it names.
struct target {
    char name[256];   ///< may hold anything
    double number[2]; ///< follow the last commas
    int spline;
    const struct knot *knot;
    int rig;
    const struct pin *pin;
};

/// What a target's name belongs to.
enum target_of { OF_NOBODY, OF_ITSELF, OF_SPLINE, OF_KNOT, OF_RIG, OF_PIN };

/// A kind of thing that the pointer meets or a replay names. Each is described beside its code; curves_things and stage_things list them.
struct thing {
    enum mouse_cursor cursor;
    const char *hint; ///< in the status line
    bool is_control;  ///< the hint is its tooltip, too
    unsigned place;   ///< of enum place, for F1; 0: its panel
    void (*press)(void *room, struct core *core, const struct hover *hover, const struct event *event);

    const char *name; ///< in replays; NULL: none
    enum target_of of;
    enum rig_kind rig; ///< OF_RIG
    int numbers;       ///< how many follow the name
    bool (*find)(void *room, const struct core *core, const struct target *target, float xy[2]);
    const char *missing; ///< why the subject has no such place
};

/// The thing under the pointer, in curves and stage.
struct hover {
    const struct thing *thing; ///< NULL: none
    const char *hint;          ///< replaces the thing's
    int spline;
    unsigned knot;
    int handle; ///< of a slope: end, as in curves_handle(); of a warning or box: index; of a limit: 1 for the high one
    int rig, joint;  ///< of a point: joint or vertex
    unsigned pin;    ///< id
    double fraction; ///< of the segment after the joint
    int model, node; ///< of a bone or chain: the character's rig and the bone
    float x, y;      ///< a point on the tail
};

struct playback {
    bool playing;
    double position; ///< in samples, fractional
    double speed;    ///< 1: real time
    long dropped;    ///< scene frames skipped since playback began
    double range[2]; ///< the played frames; infinite: all
};

struct message {
    char text[768];
    bool is_error;
    double seconds_left; ///< for messages that are not errors
};

struct status {
    struct figures shown; ///< the app's of a moment ago
    double age;           ///< seconds since
    long dropped;         ///< as shown
    bool unkept;          ///< as shown
};

enum { CORE_MAX_EDITED = 8 };

/// Edits since the last frame, for the curves' view to follow after the solve.
struct edited {
    bool selection; ///< the selected knots were edited
    int count;      ///< number of splines edited
    int spline[CORE_MAX_EDITED];
};

struct answer {
    const char *name;  ///< of its widget
    const char *label; ///< on it
    int key;           ///< a letter that also answers
};

/// A dialog's question. The last answer changes nothing; Esc gives it.
struct question {
    char title[320];
    char note[256]; ///< smaller text below; an error replaces it
    const struct answer *answers;
    int count; ///< of answers; 0: no question
    bool adds; ///< asks for the file of a character to add instead
    void *of;
    void (*answered)(void *of, int answer); ///< called for any answer but the last
};

/// What core's question is about.
struct subject {
    double fps;
    int first, last;
    int rig;
};

/// The selected character and its display. Zero is a valid start.
struct character_view {
    int character; ///< selected in the inspector: its number among models
    int drive;     ///< the coordinate's drive
    int axis;      ///< axis of the shown phases: x, y, z
};

enum brush_mode {
    BRUSH_ADVANCE,
    BRUSH_DELAY,
    BRUSH_SMOOTH_PHASE,
    BRUSH_MORE,
    BRUSH_LESS,
    BRUSH_SMOOTH_AMPLITUDE,
    BRUSH_ERASE, ///< restores the model
};

/// The selected bone. It survives undo while its character exists.
struct bone_selection {
    bool any;
    int model;     ///< number among models
    uint64_t file; ///< gltf.id of the file
    int node;
};

/// What the next click on a bone does.
enum bone_use { BONE_SELECTED, BONE_FOLLOWED, BONE_FIRST, BONE_LAST };

struct bone_pick {
    enum bone_use use;
    int which; ///< the spline that will follow it, or the chain whose end it becomes
};

/// Paints phase and amplitude onto a character.
struct brush {
    bool on;
    enum brush_mode mode;
    double radius;   ///< of the character's height
    double strength; ///< 0 … 1
};

/// What a user switches on and off: whether it starts on, and what core_flip() says.
#define SWITCH_LIST(X)                                                                                               \
    X(SNAP, true, "Snapping off: hold Ctrl to snap to frames.",                                                      \
      "Snapping on: hold Ctrl to place knots between frames.")                                                       \
    X(AUTO_KEY, false, "Auto-key off: dragging a body moves it for the whole shot.",                                 \
      "Auto-key on: dragging a body sets knots at the playhead.")                                                    \
    X(KEEP, true, "Keep off: what follows an edit swings on from it.",                                               \
      "Keep on: the next free knot becomes a pose, and nothing changes beyond it.")                                  \
    X(LOOP, false, "Playback stops at the end.", "Playback loops.")                                                  \
    X(ONION, false, "Onion skin off.", "Onion skin on: the pose at the knots around the playhead (O).")              \
    X(TRAIL, false, "Motion arc off.",                                                                               \
      "Motion arc on: the path of the tip or liveliest point, one mark per frame (Shift+O).")                        \
    X(GHOST, true, "Ghost off.", "Ghost on: the pose at the knot that is dragged or nudged (F4).")                   \
    X(ORIGINAL, false, "Original off.", "Original on: beside the character, its clip without the chains.")           \
    X(SHEET, false, "Dope sheet off.", "Dope sheet on: drag the marks in time, or a box around them (F7).")          \
    X(PHASE, false, "Phase curve off.", "Phase curve on: a quarter of a swing behind the curve.")                    \
    X(MORE, false, "The inspector shows the main sections (F9).", "The inspector shows all sections (F9).")          \
    X(SECONDS, false, "The ruler shows frames.", "The ruler shows seconds.")                                         \
    X(NORMALISE, false, "All curves share one axis again.",                                                          \
      "Normalised: every curve is as high as the active one. The axis shows the active curve's values.")             \
    X(RECORD, false, "Recording is off.", "The next drag of the body is recorded.")                                  \
    X(PHASE_MAP, false, "Phase map off.", "Phase map on: the colour of a point is its phase.")

enum view_switch {
#define SWITCH(name, starts, said_off, said_on) SWITCH_##name,
    SWITCH_LIST(SWITCH)
#undef SWITCH
        SWITCH_COUNT
};

/// The scene as it was kept, for this session.
struct take {
    struct document *document; ///< NULL: none
    struct evaluation evaluation;
    enum look look;
};

/// Simplify, while its tolerance can be changed: until the next other edit.
struct cleaning {
    struct simplify *of;    ///< NULL: not now
    struct spline *was;     ///< the spline as it was
    uint64_t edits, merge;  ///< of the document since; of the undo step
    double tolerance, done; ///< the chosen one, and the one of the present knots
};

/// A knot's indices.
struct knot_place {
    int spline, knot;
};

/// The open undo step, and what its edits leave for the frame.
struct step {
    bool ends;                ///< it is open and ends with this event; a drag's goes on
    struct error error;       ///< of the last failed edit, until core_settle()
    struct originals pressed; ///< the free knots as it began, with the phases they had
    struct originals originals;
    struct edited edited;
    struct seen *seen;     ///< as it began
    double nudged_seconds; ///< remaining time of a nudged knot's ghost
};

/// What keys and commands act on.
struct focus {
    int active;                 ///< spline, or -1
    unsigned active_id;         ///< its id, to find it when the list changes
    unsigned limb;              ///< id of the rig chosen last, see core_limb(); 0: a spline was
    struct selection selection; ///< of knots, and of splines in the list
    unsigned pin;               ///< id of the selected one, so that it survives undo; 0: none
    struct bone_selection bone;
    struct bone_pick pick; ///< until the next edit
    struct character_view characters;
    struct brush brush;
};

/// Where the next pasted knots go: to the playhead, to their own frames, or upside down to the playhead.
enum paste { PASTE_HERE, PASTE_IN_PLACE, PASTE_MIRRORED };

/// The pointer and held keys.
struct input {
    float pointer_x, pointer_y;
    bool finger; ///< is the pointer
    unsigned mods;
    int held_key;   ///< F Z L K while held, else 0
    bool held_used; ///< with an arrow
    bool space_down, space_used;
    enum paste paste; ///< until it comes
    struct drag drag;
    struct hover hover;
};

/// Visible part of the curves panel.
struct plotted {
    double frame0, frame1; ///< at the plot's left and right edge
    double value0, value1; ///< at its bottom and top edge
};

/// What is kept from frame to frame, and never saved with the scene.
struct view {
    struct layout layout;
    float scale;
    struct playback playback;
    int seen_first, seen_substeps; ///< of the scene, as the playhead counts
    enum look look;
    bool on[SWITCH_COUNT];
    struct selection hidden, solo; ///< sets of spline ids
    struct selection folded;       ///< the first splines of folders that the list shows closed
    unsigned visibility;           ///< grows when these change
    struct plotted plot;           ///< of the curves
    struct camera camera;          ///< of the stage
    bool plain;                    ///< the stage without text
    bool shows_poles;              ///< the inspector begins with the picture for Figure 2
    bool refit_stage;              ///< editor_pose() fits the camera: what an edit adds has no place before
    bool returned;                 ///< undo gave back plot and camera
    bool refit_curves;             ///< it shows all curves: they have no values before the solve
};

struct core {
    // The scene, owned by the app: set by editor_open().
    struct document *document;
    struct history *history;
    const struct evaluation *evaluation;
    const struct models *models;
    unsigned serial; ///< of the document
    struct take take;
    struct cleaning cleaning;

    struct step step;
    struct focus focus;
    struct input input;
    struct view view;

    // The app, and the inspector, which other panels do not know: set by editor_create().
    struct editor_app app;
    struct inspector *inspector;
    void (*show_clicked)(struct inspector *inspector, int rig);

    // What it says, and asks the user.
    struct drawlist list;
    struct message message;
    struct status status;
    bool unshown;             ///< the status line must be redrawn
    struct question question; ///< to ask after the event: it ends an edit that the inspector may be in
    struct subject subject;
    char *clipboard; ///< copied knots as text, or NULL
};

#endif
