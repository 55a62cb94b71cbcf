/// State of the editor and its panels: layout, selection, playback, hover, views, requests to the app.
///
/// Knots are remembered by id, splines and tails by index.
#ifndef EDITOR_CORE_STATE_H
#define EDITOR_CORE_STATE_H

#include "base/file.h"
#include "rig/models.h"
#include "rig/posing.h"
#include "scene/edit.h"
#include "scene/evaluate.h"
#include "scene/history.h"
#include "ui/drawlist.h"
#include "ui/event.h"
#include "ui/stage.h"
#include <stdint.h>

enum { CORE_MAX_RECENT = 16, STOPPED_SIZE = 96 /* of what stops an edit, in words */ };

/// The world of the editor, owned by the app.
struct editor_world {
    struct document *document;
    struct history *history;
    const struct evaluation *evaluation; ///< as of the last solve: the frame before, until editor_show()
    const struct models *models;         ///< the characters' models; NULL: none
};

/// A request to the app after a frame's events (files and windows are its business).
enum request_kind {
    REQUEST_NONE,
    REQUEST_NEW,
    REQUEST_OPEN,      ///< path
    REQUEST_ADD,       ///< path: a character or model, to the scene on the table
    REQUEST_SAVE,      ///< to the document's own path, or ask
    REQUEST_SAVE_AS,   ///< path
    REQUEST_OVERWRITE, ///< the document's own file, which somebody else has changed
    REQUEST_KEEP_MINE, ///< the same, but not before the next REQUEST_SAVE
    REQUEST_THEIRS,    ///< the document's file as it is now in place of the document, as a step of the history
    REQUEST_FIGURE,    ///< number: a figure of the paper, or one of the scenes after them
    REQUEST_QUIT,
    REQUEST_RECOVER, ///< the work that was offered
    REQUEST_FORGET,  ///< the same, for good
    REQUEST_SCREENSHOT,
    REQUEST_FULLSCREEN,
    REQUEST_UI_SCALE,    ///< number: 1 larger, -1 smaller, 0 as the display's own
    REQUEST_COPY,        ///< editor_clipboard() onto the clipboard
    REQUEST_PASTE,       ///< an EVENT_PASTE with its text
    REQUEST_EXPORT,      ///< path, wish; answered once it is done
    REQUEST_EXPORT_STOP, ///< the running one; that answers then
};

/// Options of an export. A format ignores those it has no use for; all zero is a good start.
struct export_wish {
    bool part; ///< these frames alone
    double first, last;
    int keys;          ///< a frame; 0: the scene's substeps
    int width, height; ///< of pictures; 0: as the format likes
    char rig[64];      ///< by its name; "": all
    char clip[64];     ///< name of the animation; "": the scene's
    bool is_cubic, is_signed, transparent;
};

struct request {
    enum request_kind kind;
    int number;
    char path[PATH_LIMIT];
    struct export_wish wish;
};

/// Unsaved work that an earlier run left behind.
struct recovery_offer {
    char name[256]; ///< name of its document
    char when[64];  ///< date and time, as text
    int others;     ///< older ones there are besides
};

/// Rectangles of the panels, in logical pixels; made by core_layout().
struct layout {
    struct rect window, stage, curves, inspector, status;
    struct rect ruler;      ///< frame numbers, on top of the plot
    struct rect sheet;      ///< the dope sheet's rows, below the ruler; empty where it is not shown
    struct rect value_axis; ///< numbers left of the plot
    struct rect plot;
    struct rect open;  ///< of the stage, the part that no panel covers
    float stage_share; ///< of the height above the status line; kept when the window changes its size
    float inspector_width;
    float sheet_height; ///< as the curves want it
};

/// F5: the stage fills the window, and panels slide in over it.
struct presenter {
    bool on;
    bool pinned;  ///< Tab: all panels stay
    bool shares;  ///< they take their room from the stage, until they are away again
    bool pointed; ///< the pointer has moved since, so that it may call a panel
    bool side_wanted, below_wanted;
    float side, below; ///< 0 … 1: how far the inspector is in, and the curves with the status line
};

/// The edges that change the panels' sizes: above the curves, left of the inspector.
enum divider { DIVIDER_NONE, DIVIDER_STAGE, DIVIDER_INSPECTOR };

enum panel { PANEL_NONE, PANEL_STAGE, PANEL_CURVES, PANEL_INSPECTOR, PANEL_STATUS };

/// Selected knots of any spline, or splines: one bit an id.
struct selection {
    uint64_t *bits;
    unsigned capacity; ///< ids
};

struct drag_owner;
struct core;

/// The running drag; see drag.h.
struct drag {
    const struct drag_owner *owner; ///< NULL: nothing is dragged
    void *room;                     ///< the panel that began it
    const char *label;              ///< of its step in the history; NULL: it edits nothing
    const char *hint;               ///< the status line's sentence while it runs, or NULL
    enum event_button button;
    float x, y; ///< pointer at the last step
    float start_x, start_y;
    double moved_x, moved_y; ///< sum of movements, the fine ones scaled down
    double dt;               ///< seconds since the last frame
    bool moved;              ///< past the threshold below which a press is a click
    bool lock_x, lock_y;     ///< only the frame, only the value may change
    bool snap;
    bool stale;    ///< the pointer moved since the edits were made
    unsigned knot; ///< id of the active spline's knot that is held; 0: none
    bool stopped;  ///< the status line names the reason
};

/// A knot as it was before the edit that moves it.
struct original {
    int spline;
    struct knot knot;
    double equilibrium; ///< at the knot; known while it is scaled
};

/// The knots that an edit moves, by spline and in each of them by sample.
struct originals {
    struct original *list;
    int count, capacity;
};

/// The item under the pointer, in the curves and on the stage.
enum hover_kind {
    HOVER_NONE,
    HOVER_KNOT,
    HOVER_SLOPE,
    HOVER_CURVE,
    HOVER_RULER,
    HOVER_UNITS,
    HOVER_SHEET, ///< the dope sheet's switch
    HOVER_ROW,   ///< of the dope sheet, beside its marks
    HOVER_WARNING,
    HOVER_JOINT, ///< of a tail, or of a chain
    HOVER_BONE,  ///< of an imported character, without a chain
    HOVER_BODY,
    HOVER_PLAY,
    HOVER_LOOP,
    HOVER_SPEED,
    HOVER_AUTO_KEY,
    HOVER_UI_SCALE,
    HOVER_PRESENT,
    HOVER_LIMIT,
    HOVER_BOX,   ///< a handle of the box round the selected knots
    HOVER_POINT, ///< of a rig, that can be pinned
    HOVER_PIN,   ///< on the stage or the ruler
    HOVER_FLOOR, ///< of the rig, a character
};

struct hover {
    enum hover_kind kind;
    int spline;
    unsigned knot;
    int handle; ///< HOVER_SLOPE: which end, as in curves_handle(); HOVER_WARNING, HOVER_BOX: which one; HOVER_LIMIT: 1: the high one
    int rig,
        joint; ///< HOVER_BODY: of the tail; HOVER_JOINT: of the tail or chain; HOVER_POINT: a joint whose end it is, or a vertex
    unsigned pin;    ///< HOVER_PIN: its id
    double fraction; ///< of the segment after the joint
    int model, node; ///< of HOVER_BONE and of a chain's HOVER_JOINT: the character's rig and the bone
    float x, y;      ///< of the point on the tail
};

struct playback {
    bool playing;
    bool looping;    ///< over the range that is played (Ctrl+L)
    double position; ///< in samples; may lie between two
    double speed;    ///< 1: real time
    long dropped;    ///< frames of the scene that no picture showed, since it plays
    double range[2]; ///< frames of the part that is played, as far as the scene has them; of all: infinite
};

struct message {
    char text[768];
    bool is_error;
    double seconds_left; ///< of a message that is not an error
};

/// Figures of the status line.
struct figures {
    double fps, solve_us; ///< frames a second, microseconds of solving
};

struct status {
    struct figures told, shown; ///< by the app last, and as taken over for a while
    double age;                 ///< seconds since that
    long dropped;               ///< as shown
    float stage_scale;          ///< the stage's resolution relative to the window's, per side; 0 means 1
};

enum { CORE_MAX_EDITED = 8 };

/// Edits that the curves have not shown yet, as they are not solved: their view follows.
struct edited {
    bool selection; ///< the selected knots
    int count;      ///< all knots of these splines
    int spline[CORE_MAX_EDITED];
};

struct answer {
    const char *name;  ///< of its button
    const char *label; ///< on it
    int key;           ///< letter that answers as well
};

/// A question that a dialog asks. The last answer is the one that changes nothing; Esc gives it.
struct question {
    char title[320];
    char note[256]; ///< below it, unless the dialog has an error to show
    const struct answer *answers;
    int count;
    void (*answered)(void *dialogs, struct core *core, int answer); ///< by another than the last
};

/// Subject of core's question.
struct subject {
    double fps;
    int first, last;
    int rig;
};

/// The character that is worked on, and how it is looked at; zero is a valid start.
struct character_view {
    int character, drive; ///< selected in the inspector
    bool mapped;          ///< the selected coordinate's phases as colours
    int axis;             ///< of movement whose phases are shown: x, y, z
    bool compare;         ///< beside each character its stiff twin, without phases
};

enum brush_mode {
    BRUSH_ADVANCE,
    BRUSH_DELAY,
    BRUSH_SMOOTH_PHASE,
    BRUSH_MORE,
    BRUSH_LESS,
    BRUSH_SMOOTH_AMPLITUDE,
    BRUSH_ERASE, ///< restore the model
};

/// The bone that is selected. It is found again after undo, as long as its character is there.
struct bone_selection {
    bool any;
    int model;     ///< number of its rig among those of imported characters
    uint64_t file; ///< gltf.id of its file
    int node;
};

/// The pin that is selected. Its id finds it again after undo.
struct pin_selection {
    bool any;
    unsigned id;
};

/// Use of the next click on a bone; otherwise it selects it.
enum bone_use { BONE_SELECTED, BONE_FOLLOWED, BONE_FIRST, BONE_LAST };

struct bone_pick {
    enum bone_use use;
    int which; ///< the spline that is to follow it, or the chain that is to begin or end with it
};

/// The brush that paints phase and amplitude onto a character's surface.
struct brush {
    bool on;
    enum brush_mode mode;
    double radius;   ///< share of the character's height
    double strength; ///< 0 … 1
};

/// Overlays on the stage; kept when another document is opened.
struct overlays {
    bool onion, trail;
    bool ghost; ///< the pose at the knot that is dragged or nudged
};

/// How the curves panel shows things; a view, never part of the document.
struct curve_options {
    bool normalise; ///< every curve as high as the active one; the axis shows the active one's values
    bool seconds;   ///< on the ruler, in place of frames
    bool sheet;     ///< the dope sheet is open
    bool phase;     ///< the imaginary part of the active curve, from which its phase is seen
};

/// A knot by its indices.
struct knot_place {
    int spline, knot;
};

struct core {
    struct document *document; ///< the document, the app's, as the next three: set by editor_open()
    struct history *history;
    const struct evaluation *evaluation;
    const struct models *models;

    struct layout layout;
    float scale;
    double ui_scale; ///< part of it that the user has chosen
    struct presenter presenter;
    int active;                       ///< spline, -1 where there is none
    unsigned active_id;               ///< its id, by which it is found again when the list has changed
    unsigned recent[CORE_MAX_RECENT]; ///< ids of those that were active before, the last one first
    struct selection selection;
    struct selection hidden, solo; ///< splines, by their ids
    unsigned visibility;           ///< grows whenever these change
    double visible;                ///< the height of the values that the curves show
    bool no_snap;                  ///< knots go between the frames, and onto them with Ctrl
    int seen_first, seen_substeps; ///< of the scene, which the playhead's position counts in
    struct playback playback;
    struct drag drag;
    struct originals originals;
    struct edited edited;
    struct hover hover;
    enum look look;
    float pointer_x, pointer_y;
    unsigned mods;
    int held_key; ///< F Z B C L while pressed, else 0
    bool space_down, space_used;

    struct character_view characters;
    struct bone_selection bone;
    struct bone_pick pick; ///< ends with the next edit
    struct pin_selection pin;
    int clicked; ///< the rig on the stage that was clicked, from 1, until the inspector shows it
    struct brush brush;
    struct overlays overlays;
    struct curve_options curves;
    double nudged_seconds; ///< that the ghost of the nudged knot is still shown
    bool auto_key;         ///< a body that is dragged gets knots at the playhead, else the whole shot moves
    bool record_armed;     ///< the next drag of a body is recorded from its start
    bool more;             ///< the inspector shows all sections and controls
    bool plain;            ///< a picture of the stage without text over it
    bool refit_stage;      ///< all of the stage is to be in sight
    bool refit_curves;     ///< all curves are to be, once they are solved

    unsigned serial;       ///< of the document on the table
    char title[256];       ///< the file's name, or "untitled"
    char path[PATH_LIMIT]; ///< of the document's own file, or ""
    struct message message;
    struct status status;
    struct error error;       ///< of the last edit that failed, until core_settle()
    bool unkept;              ///< unsaved work has no recovery file
    bool unshown;             ///< something of the status line has changed since it was drawn
    struct question question; ///< the next question, before an edit; no answers: none
    struct subject subject;
    char *clipboard;        ///< knots that were copied, as text; NULL at first
    struct request request; ///< the app carries it out after the event
    struct drawlist list;
};

#endif
