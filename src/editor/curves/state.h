/// State of the curves panel and functions its files share. Private to this folder and tests.
#ifndef EDITOR_CURVES_STATE_H
#define EDITOR_CURVES_STATE_H

#include "editor/curves/curves.h"
#include "scene/warnings.h"
#include "ui/widgets.h"

enum {
    EDITOR_MAX_COLUMNS = 4096, ///< vertices per curve
    CURVES_MAX_OTHERS = 9,     ///< drawn splines besides the active one
    CURVES_MAX_RANGES = 256,   ///< splines that can be normalised
    CURVES_FAN = 7,            ///< lagged copies of the active curve
    CURVES_HIT_RADIUS = 10,
    SHEET_MAX_ROWS = 6, ///< more scroll
};

/// Maps a spline's values to the active one's: scale·value + offset.
struct value_map {
    double scale, offset;
};

struct dope_sheet {
    struct ui_list list; ///< in rows
    int rows;            ///< visible
    int spline[SHEET_MAX_ROWS];
    unsigned active; ///< id of the spline last scrolled into view
};

enum box_mode { BOX_REPLACE, BOX_ADD, BOX_REMOVE };

/// A drag of knots, slopes, a limit, a pin's mark or a box.
struct knot_drag {
    double free_frames; ///< last shift that hit no knot
    double free_frame;  ///< last frame without another pin of that point
    int handle;         ///< end of a slope handle, as in curves_handle(); of a limit: 1 for the high one
    bool collapse;      ///< a click on a selected knot selects it alone
    enum box_mode box;
    bool in_sheet; ///< the box is on the dope sheet
    bool ripple;   ///< later knots move too
};

/// The pivot: the middle of the selection, the playhead's equilibrium, the equilibrium at each knot, or the box's opposite side.
enum pivot { PIVOT_MIDDLE, PIVOT_PLAYHEAD, PIVOT_EQUILIBRIUM, PIVOT_SIDE, PIVOTS };

struct factors {
    double time, value;
};

struct scaling {
    enum pivot pivot;
    int handle;          ///< of the selection box; -1: started by S
    double frame, value; ///< the pivot; for PIVOT_EQUILIBRIUM, the point the pointer's distance is measured from
    double edge[2];      ///< frame and value of the knots at the handle
    double playhead[2], balance[2]; ///< frame and value of PIVOT_PLAYHEAD; of the equilibrium in the middle
    struct factors by;
    char typed[16];                ///< one factor, or two with a space; replaces the pointer's
    char stopped[2][STOPPED_SIZE]; ///< what stopped time, and value, or ""
    char sentence[400];
};

enum { FIX_TEXT = 96 };

/// The edit that fixes a warning.
struct fix {
    bool is_chosen; ///< chosen when the pointer first reaches the warning
    int rank;       ///< among the remedies of that kind of warning; -1: nothing helps
    char text[FIX_TEXT];
};

/// A curve in logical pixels, one vertex per column.
typedef float polyline[EDITOR_MAX_COLUMNS][2];

/// The curves' vertices; rebuilt when `key` changes.
struct curve_cache {
    uint64_t key;
    int count;                           ///< columns; 0 if the scene is not visible
    double first, by;                    ///< sample of the first column; samples per column
    double position[EDITOR_MAX_COLUMNS]; ///< in samples; exact at the active spline's knots
    polyline re, im, equilibrium, fan[CURVES_FAN], others[CURVES_MAX_OTHERS];
    /// A column covers whole swings: re and im, or the other curve, is drawn as a band.
    bool band, other_band[CURVES_MAX_OTHERS];
    int fan_count, other_count;
    unsigned other_id[CURVES_MAX_OTHERS]; ///< the splines
    double range[CURVES_MAX_RANGES][2];   ///< lowest and highest value of each normalised spline
    int range_count;
};

/// The active curve before a drag or Simplify, in frames and values so that it survives panning and zooming.
struct ghost {
    uint64_t of; ///< UINT64_MAX: the drag, which has edited; 0: nothing; else which Simplify
    int count;
    bool band;
    double frame[EDITOR_MAX_COLUMNS], value[EDITOR_MAX_COLUMNS];
};

struct curves {
    bool moves; ///< the view, towards the goal that an edit set
    struct plotted goal;
    uint64_t followed; ///< edits of the document when last looked at
    int open;          ///< curves that do not end as they start, counted while that can be seen
    uint64_t open_of;  ///< edits of the document as they were counted
    struct dope_sheet sheet;
    struct selection before_box; ///< the selection before a box was drawn
    struct knot_drag knot_drag;
    struct scaling scaling;
    double range_before[2]; ///< the played range before a drag of it
    struct ghost ghost;
    struct curve_cache cache;
    struct warnings warnings;
    uint64_t warnings_key;                 ///< of the document the warnings belong to
    struct fix fixes[WARNINGS_MAX];        ///< one per warning
    float scratch[2 * EDITOR_MAX_COLUMNS]; ///< points of a line while it is drawn
};

/// Frame to logical pixels, clamped to a few thousand around the plot.
float curves_x(const struct core *core, double frame);
/// Value to logical pixels, clamped likewise.
float curves_y(const struct core *core, double value);
/// A place in the plot; false if it is not visible.
bool curves_in_plot(const struct core *core, double frame, double value, float xy[2]);
/// Position of a slope handle's end: before (0) or after (1) the knot.
void curves_handle(const struct core *core, const struct knot *knot, int end, float xy[2]);
double curves_pixels_per_frame(const struct core *core);
double curves_pixels_per_value(const struct core *core);
double curves_frame(const struct core *core, double x);
double curves_value(const struct core *core, double y);

/// The cosine and sine of the lags of the active spline's copies, spread evenly along the tail or chain that it bends, and the samples by which
/// its offset delays them; returns how many.
int curves_fan(const struct core *core, double turn[CURVES_FAN][2], double *delay);

/// How a spline's values are drawn.
struct value_map normal_map(const struct curves *curves, const struct core *core, int spline);
/// A knot's height in logical pixels, normalised if that is on.
float curves_knot_y(const struct curves *curves, const struct core *core, int spline, const struct knot *knot);

/// The spline of another curve's vertices, or -1 if it is gone.
int curves_other(const struct curves *curves, const struct document *document, int other);
/// Copies the active curve before a drag's first edit, to show it behind.
void keep_ghost(struct curves *curves, const struct core *core);
/// A knot's x in logical pixels: that of its sample.
float curves_knot_x(const struct core *core, const struct knot *knot);

/// Index of the first knot at or right of an x, or of the knot before that one; the number of knots if there is none.
int curves_knot_from(const struct core *core, const struct spline *spline, double x);

extern const struct thing thing_knot, thing_mark, thing_slope, thing_curve, thing_active_curve, thing_box,
    thing_warning, thing_seam, thing_limit, thing_row, thing_ruler, thing_units, thing_sheet, thing_pin_time;

/// Draws a spline's knots, in the plot (`row` NAN) or at the height `row` of the dope sheet.
void knots_show(const struct curves *curves, struct core *core, int spline, float row);
/// Whether `distance` is at most `*best`; if so stores it there.
static inline bool is_nearest(float distance, float *best)
{
    if (distance > *best) return false;
    *best = distance;
    return true;
}

/// Finds a spline's knot nearest to a point and closer than `reach`, by is_nearest(); returns its distance, else `reach`. On the dope sheet,
/// where only x counts, y is NAN.
float nearest_knot(const struct curves *curves, const struct core *core, int of, const float xy[2], float reach,
                   struct hover *hover);

/// The pin mark at a point of the ruler.
struct hover ruler_pins_hover(const struct core *core, float x, float y);

/// The dope sheet's rows with their names.
struct rect sheet_area(const struct core *core);
struct rect sheet_switch(const struct core *core);
struct hover sheet_hover(const struct curves *curves, const struct core *core, float x, float y);
/// Whether a box touches a spline's row.
bool sheet_row_in(const struct curves *curves, const struct core *core, int spline, struct rect box);
void sheet_show(const struct curves *curves, struct core *core);

void scale_box_hover(const struct curves *curves, const struct core *core, float x, float y, struct hover *hover);
/// Draws the box around several selected knots.
void scale_box_show(const struct curves *curves, struct core *core, bool handles);
/// On a curve, in a row of the dope sheet or beside all: a click chooses, a double-click inserts a knot, a drag selects with a box (Shift adds,
/// Ctrl or Alt removes).
void curves_press_empty(void *room, struct core *core, const struct hover *hover, const struct event *event);

/// Length in pixels: 12 more for ten times the stiffness.
double handle_length(double stiffness);
double handle_stiffness(double length);

/// The corner left of the ruler, with its unit.
struct rect ruler_corner(const struct core *core);

/// Finds the warnings if document or view changed. Allocates nothing.
void warnings_update(struct curves *curves, const struct core *core);

void warnings_show(const struct curves *curves, struct core *core);
/// The text under the pointer and what a click does. Drawn last, above everything else; the fix is chosen here.
void warnings_show_words(struct curves *curves, struct core *core);

#endif
