/// State of the curves panel, and functions that its files share. Private to the room, and to tests.
#ifndef EDITOR_CURVES_STATE_H
#define EDITOR_CURVES_STATE_H

#include "editor/curves/curves.h"
#include "scene/warnings.h"

enum {
    EDITOR_MAX_COLUMNS = 4096, ///< vertices of one drawn curve
    CURVES_MAX_OTHERS = 9,     ///< splines drawn besides the active one
    CURVES_MAX_RANGES = 256,   ///< splines that can be normalised
    CURVES_FAN = 7,            ///< lagged copies of the active curve
    CURVES_HIT_RADIUS = 10,
};

/// Where a spline's values are drawn, as values of the active one: scale·value + offset.
struct value_map {
    double scale, offset;
};

enum { SHEET_MAX_ROWS = 16 };

/// The dope sheet.
struct dope_sheet {
    int first, rows, total; ///< first row in sight, how many are, and how many there are
    int spline[SHEET_MAX_ROWS];
    unsigned active; ///< id of the active spline when its row was last brought into sight
};

/// Visible part of the curves panel.
struct view {
    double frame0, frame1; ///< at the plot's left and right edge
    double value0, value1; ///< at its bottom and top edge
};

/// The view on its way to an edit.
struct following {
    bool moves;
    struct view goal;
};

/// Use of a box.
enum box_mode { BOX_REPLACE, BOX_ADD, BOX_REMOVE };

/// State of a drag of knots, slopes or a box, besides that of all drags.
struct knot_drag {
    double free_frames; ///< last shift by which no knot was hit
    int handle;         ///< of a slope: which end, as in curves_handle()
    bool collapse;      ///< a click on a selected knot selects it alone, a drag moves all
    enum box_mode box;
    bool in_sheet; ///< the box is around marks of the dope sheet
    bool ripple;   ///< knots after the first moved one of a spline move too
};

/// A drag of a limit.
struct limit_drag {
    int handle;   ///< 0: the low one, 1: the high one
    double value; ///< before
};

/// A drag of a pin on the ruler.
struct pin_time_drag {
    unsigned id;
    double frame;      ///< before
    double free_frame; ///< the last on which its point had no other pin
};

/// What knots are scaled about: the middle of the selection; the equilibrium at the playhead; the equilibrium at each knot; the
/// side of their box across from the handle.
enum pivot { PIVOT_MIDDLE, PIVOT_PLAYHEAD, PIVOT_EQUILIBRIUM, PIVOT_SIDE, PIVOTS };

/// Handles of the box: three rows of three, from its upper left corner; the fifth is none.
enum { BOX_HANDLES = 9, BOX_MIDDLE = 4 };

/// -1: at the left, or at the top; 1: at the right, or at the bottom; 0: between.
static inline int box_column(int handle) { return handle % 3 - 1; }
static inline int box_row(int handle) { return handle / 3 - 1; }
static inline bool box_corner(int handle) { return box_column(handle) && box_row(handle); }

/// Factors of time and value.
struct factors {
    double time, value;
};

/// Scaling of the selected knots, about a frame and a value.
struct scaling {
    enum pivot pivot;
    int handle;                     ///< of the box round the knots, in the hand; -1: begun by S
    double frame, value;            ///< of the pivot; of PIVOT_EQUILIBRIUM, from where the pointer's way is measured
    double edge[2];                 ///< frame and value of the knots at the handle
    double playhead[2], balance[2]; ///< frame and value: of the playhead's pivot; of the equilibrium in the middle
    struct factors by;
    double free_time;              ///< last factor by which no knot was hit
    char typed[16];                ///< one factor or, with a space between them, two in place of the pointer's
    char stopped[2][STOPPED_SIZE]; ///< why time, and value, go no further, or ""
    char sentence[400];
};

enum { FIX_TEXT = 96 };

/// An edit that fixes a warning. Describes itself.
typedef bool remedy(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                    struct error *error);

/// The fix for a warning.
struct fix {
    bool is_chosen; ///< found by trying the remedies once the pointer is on the warning
    remedy *apply;  ///< NULL: nothing helps
    char text[FIX_TEXT];
};

/// A curve in logical pixels, a vertex for each column of the cache.
typedef float polyline[EDITOR_MAX_COLUMNS][2];

/// Everything that curves.c draws from the solved splines; rebuilt when `key` changes.
struct curve_cache {
    uint64_t key;
    int count;                           ///< columns; 0 where the scene is out of sight
    double first, by;                    ///< sample of the first column, samples from column to column
    double position[EDITOR_MAX_COLUMNS]; ///< in samples; knots of the active spline are hit exactly
    polyline re, im, equilibrium, fan[CURVES_FAN], others[CURVES_MAX_OTHERS];
    /// Columns hold whole swings: re and im, or the other, is drawn as what it covers.
    bool band, other_band[CURVES_MAX_OTHERS];
    int fan_count, other_count;
    int other_spline[CURVES_MAX_OTHERS];
    unsigned other_id[CURVES_MAX_OTHERS];
    double range[CURVES_MAX_RANGES][2]; ///< lowest and highest value of each spline, where curves are normalised
    int range_count;
};

/// The active curve before a drag, in frames and values so that it survives a change of the view.
struct ghost {
    bool is_shown; ///< the drag edits
    int count;
    bool band;
    double frame[EDITOR_MAX_COLUMNS], value[EDITOR_MAX_COLUMNS];
};

struct curves {
    struct view view;
    struct following following;
    struct dope_sheet sheet;
    struct selection before_box; ///< the selection when a box was begun
    struct knot_drag knot_drag;
    struct scaling scaling;
    struct limit_drag limit_drag;
    struct pin_time_drag pin_drag;
    double range_before[2]; ///< of the played range, when a drag of it began
    struct ghost ghost;
    struct curve_cache cache;
    struct warnings warnings;
    uint64_t warnings_key;                 ///< of the document they were found in
    struct fix fixes[WARNINGS_MAX];        ///< of each
    float scratch[2 * EDITOR_MAX_COLUMNS]; ///< points of a line that is made while it is drawn
};

/// Logical pixels a frame.
double curves_pixels_per_frame(const struct curves *curves, const struct core *core);
/// Logical pixels a unit of value.
double curves_pixels_per_value(const struct curves *curves, const struct core *core);
/// Logical pixels to frame.
double curves_frame(const struct curves *curves, const struct core *core, double x);
/// Logical pixels to value.
double curves_value(const struct curves *curves, const struct core *core, double y);

/// Where a spline's values are drawn.
struct value_map normal_map(const struct curves *curves, const struct core *core, int spline);
/// Height of a value of any spline in logical pixels; normalised curves are scaled.
float curves_y_of(const struct curves *curves, const struct core *core, int spline, double value);
/// The pixel of a knot of a spline.
float curves_knot_y(const struct curves *curves, const struct core *core, int spline, const struct knot *knot);
/// Measures the curves to normalise, but not during a drag, so that other curves keep still.
void normal_update(struct curves *curves, const struct core *core);

/// Rebuilds the polylines where document, view or layout changed since; allocates nothing.
void curves_update(struct curves *curves, struct core *core);
/// The spline whose polyline is one of the others, or -1 where an edit has given it another place since it was drawn.
int curves_other(const struct curves *curves, const struct document *document, int other);
/// Before a drag makes its first edits: keeps a copy of the active curve to show behind it.
void keep_ghost(struct curves *curves, const struct core *core);
/// Where a knot is across the panel, logical pixels: on its sample.
float curves_knot_x(const struct curves *curves, const struct core *core, const struct knot *knot);

/// Index of the first knot at a place across the panel or to the right of it, or the knot before that one; or how many there are.
int curves_knot_from(const struct curves *curves, const struct core *core, const struct spline *spline, double x);

/// Starts to move the selected knots; `knot` is the one under the pointer.
void drag_begin_knots(struct curves *curves, struct core *core, unsigned knot, const struct event *event);
/// Starts to turn the slope of a knot by an end of its handle.
void drag_begin_slope(struct curves *curves, struct core *core, unsigned knot, int handle, const struct event *event);

/// The active spline's limits, dashed.
void limits_show(const struct curves *curves, struct core *core);

/// Draws the knots of a spline that are small unless they are selected, those of the dope sheet with the height of their row, else NAN.
void knots_show(const struct curves *curves, struct core *core, int spline, float row);
/// Whether something is at least as near as the best so far, or may be; `best` is how far.
static inline bool is_nearest(float distance, float *best)
{
    if (distance > *best) return false;
    *best = distance;
    return true;
}

/// The nearest knot of one spline, where it is nearer than `reach`, likewise; returns its distance, else `reach`.
float nearest_knot(const struct curves *curves, const struct core *core, int of, float row, float x, float y,
                   float reach, struct hover *hover);

/// The pin whose mark on the ruler is there, or HOVER_NONE.
struct hover ruler_pins_hover(const struct curves *curves, const struct core *core, float x, float y);
/// Selects it, goes to its frame and starts to drag it.
void ruler_pins_begin(struct curves *curves, struct core *core, const struct hover *hover, const struct event *event);
/// The marks of all pins.
void ruler_pins_show(const struct curves *curves, struct core *core);

/// Its rows with their names, and the triangle that opens it.
struct rect sheet_area(const struct core *core);
struct rect sheet_switch(const struct core *core);
/// The mark or the row at a point of its area.
struct hover sheet_hover(const struct curves *curves, const struct core *core, float x, float y);
/// A press beside the marks: the spline becomes the active one; a double click inserts a knot on its curve, a drag begins a box.
void sheet_press_row(struct curves *curves, struct core *core, int spline, const struct event *event);
/// The row of a spline that a box on the sheet touches: its height, else NAN.
float sheet_row_in(const struct curves *curves, const struct core *core, int spline, struct rect box);
/// Scrolls it; false where the wheel means something else.
bool sheet_wheel(struct curves *curves, struct core *core, const struct event *event);
/// Rows, marks, names, and its switch in the ruler's corner.
void sheet_show(const struct curves *curves, struct core *core);

/// Starts to scale by a handle of the box round the selected knots: about its other side or, with Alt, the equilibrium.
void scale_begin_handle(struct curves *curves, struct core *core, int handle, const struct event *event);
/// The handle at a point.
void scale_box_hover(const struct curves *curves, const struct core *core, float x, float y, struct hover *hover);
/// The box round the selected knots, where there are several, and its handles.
void scale_box_show(const struct curves *curves, struct core *core, bool handles);
/// Starts to select knots of the drawn curves by a box; Shift adds them, Ctrl or Alt removes them.
void box_begin(struct curves *curves, struct core *core, const struct event *event);
/// Starts to choose the part that is played.
void range_begin(struct curves *curves, struct core *core, const struct event *event);

/// The handle's length in pixels says how firmly the slope is held, 12 for each power of ten.
double handle_length(double stiffness);
/// The stiffness that a length of the handle stands for.
double handle_stiffness(double length);
/// Where the playhead's frame number is, on the ruler; empty where the playhead is out of sight.
struct rect playhead_tag(const struct curves *curves, const struct core *core);

/// The corner left of the ruler, with its unit.
struct rect ruler_corner(const struct core *core);
/// Grids, numbers and ruler; part of curves_show().
void grid_show(const struct curves *curves, struct core *core);

/// Finds them where document or look have changed since; allocates nothing.
void warnings_update(struct curves *curves, const struct core *core);

/// Where a warning's marker is, in logical pixels; false where it is out of sight.
bool warning_place(const struct curves *curves, const struct core *core, const struct warning *warning, float xy[2]);
/// The markers.
void warnings_show(const struct curves *curves, struct core *core);
/// Words under the pointer, with what a click does, which is tried now; after everything else, so that nothing lies over them.
void warnings_show_words(struct curves *curves, struct core *core);

/// Fixes a warning, as one undo step.
void warning_remedy(struct curves *curves, struct core *core, int index);

#endif
