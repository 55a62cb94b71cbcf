/// The state of the curves panel. Private to the room.
#ifndef EDITOR_CURVES_STATE_H
#define EDITOR_CURVES_STATE_H

#include "editor/core/state.h"

enum {
    EDITOR_MAX_COLUMNS = 4096, ///< vertices of one drawn curve
    CURVES_MAX_OTHERS = 9,     ///< splines drawn besides the active one
    CURVES_MAX_RANGES = 256,   ///< splines that can be normalised
    CURVES_FAN = 7,            ///< lagged copies of the active curve
    CURVES_HIT_RADIUS = 10,
};

/// How the curves panel shows things; a view, never part of the document.
struct curve_options {
    bool normalise; ///< every curve as high as the active one; the axis shows the active one's values
    bool seconds;   ///< on the ruler, in place of frames
};

/// Where a spline's values are drawn, as values of the active one: scale·value + offset.
struct value_map {
    double scale, offset;
};

enum { SHEET_MAX_ROWS = 16 };

/// The dope sheet.
struct dope_sheet {
    bool shown;
    int first, rows, total; ///< first row in sight, how many are, and how many there are
    int spline[SHEET_MAX_ROWS];
    unsigned active; ///< id of the active spline when its row was last brought into sight
};

/// Visible part of the curves panel.
struct view {
    double frame0, frame1; ///< at the plot's left and right edge
    double value0, value1; ///< at its bottom and top edge
};

/// The view on its way to what was edited.
struct following {
    bool moves;
    struct view goal;
};

/// What a box does with the knots in it.
enum box_mode { BOX_REPLACE, BOX_ADD, BOX_REMOVE };

/// What a drag of knots, slopes or a box has besides what all drags have.
struct knot_drag {
    double free_frames; ///< last shift by which no knot was hit
    int handle;         ///< of a slope: which end, as in curves_handle()
    bool collapse;      ///< a click on a selected knot selects it alone, a drag moves all
    enum box_mode box;
    bool in_sheet; ///< the box is around marks of the dope sheet
    bool ripple;   ///< what comes after the first moved knot of a spline moves along in time
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

enum warning_kind {
    WARNING_SWING, ///< the curve swings more than twice as far as its knots
    WARNING_RATE,  ///< a frequency near half the sample rate
    WARNING_DRIFT, ///< bandwidth times the periods between two knots
    WARNING_SLOPE, ///< a slope between knots on the samples beside it, which say it all
};

/// A problem of the active spline.
struct warning {
    enum warning_kind kind;
    double frame, value; ///< the place (not of a rate)
    double from, to;     ///< frames of the knots around it
    double amount;       ///< swing in heights of the knots; Hz; periods
    double limit;        ///< Hz that would be fine; bandwidth as it is
    double remedy;       ///< value of a knot at the place; substeps; bandwidth
};

enum { WARNINGS_MAX = 16 };

struct warnings {
    uint64_t key; ///< of what they were found in
    int count;
    struct warning list[WARNINGS_MAX];
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

/// The active curve as it was before a drag, in frames and values so that it survives a change of the view.
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
    struct curve_options options;
    struct selection before_box; ///< the selection when a box was begun
    struct knot_drag knot_drag;
    struct scaling scaling;
    struct limit_drag limit_drag;
    struct pin_time_drag pin_drag;
    struct ghost ghost;
    struct curve_cache cache;
    struct warnings warnings;
    float scratch[2 * EDITOR_MAX_COLUMNS]; ///< points of a line that is made while it is drawn
};

#endif
