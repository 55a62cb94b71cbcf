/// The stage's state, and functions shared by its files and its tests. Private to the stage.
#ifndef EDITOR_STAGE_STATE_H
#define EDITOR_STAGE_STATE_H

#include "editor/core/state.h"
#include "model/figure.h"
#include "rig/models.h"
#include "rig/posing.h"
#include "rig/swing.h"
#include "ui/drawlist.h"
#include <math.h>

enum { SILHOUETTE_SIDE = 208, SILHOUETTE_POINTS = 4096 };

/// For each grid node the distance inside the shape, pixels; negative outside.
struct silhouette {
    float low[2], high[2]; ///< bounds of the shape
    struct rect area;
    float cell; ///< pixels between nodes
    int columns, rows;
    float inside[SILHOUETTE_SIDE][SILHOUETTE_SIDE]; ///< by row and column
    float blurred[SILHOUETTE_SIDE][SILHOUETTE_SIDE];
    bool followed[SILHOUETTE_SIDE][SILHOUETTE_SIDE]; ///< the edge between a node and the next in its row
    float points[2 * SILHOUETTE_POINTS][2];          ///< the last outline, and room for another
};

/// A channel that a pull controls through a pose at the playhead.
struct tail_drag_axis {
    bool active, swings; ///< swings: its phase counts, too
    int spline;
    double start[2];          ///< value and phase at the press
    double values_per_radian; ///< of bend at the grabbed joint
};

enum { STAGE_MAX_STRANDS = 32, STAGE_MAX_BONES = 2048, RECORD_SAMPLES = 8192, TRAIL_FRAMES = 256, POINT_BASE = -1 };

/// A tail or chain as last posed, from its first joint to its tip.
struct shown_strand {
    int rig;   ///< index in the document
    int model; ///< its fox in the view; −1: none
    struct pose pose;
};

/// A bone of a character, as last posed.
struct shown_bone {
    int model;        ///< rig
    struct bone part; ///< as the skeleton has it
    bool carries;     ///< vertices follow it
    int chain, joint; ///< its chain and number there; −1: none
    uint32_t color;   ///< of the chain's spline
    float ends[2][3]; ///< world
};

/// A moving point of a rig: the end of a tail's or chain's joint, or a character's vertex.
struct rig_point {
    int rig; ///< index in the document
    int at;  ///< joint or vertex; POINT_BASE: a tail's root
};

/// The arcs that can be shown together.
enum trail { TRAIL_OF_TIP, TRAIL_OF_PIN, TRAIL_OF_BODY, TRAILS };

/// The brush's state.
struct painting {
    enum brush_mode stroke; ///< the running stroke's mode, after Shift and Ctrl
    bool covers;            ///< the pointer is over the character, at `spot`
    struct surface_spot spot;
    float x, y;      ///< pointer in the last frame of the stroke
    bool has_dabbed; ///< the stroke has painted in a frame
    struct brush_work {
        struct pool pool;
        int capacity;
        struct reach reach;
        int *vertices; ///< of a dab, and their new values
        float (*values)[2];
        float *steps;       ///< the next smoothing steps
        float (*turned)[2]; ///< complex factor of each vertex by smoothing in this frame; 1 elsewhere
        float *spent;       ///< change of each vertex's phase or amplitude by this stroke
    } work;                 ///< memory for up to `capacity` vertices
};

struct stage {
    const struct core *core;
    struct stage_view view;
    struct rect figure;                             ///< see stage_figure(); from the stage's middle, in stage heights
    struct shown_strand strands[STAGE_MAX_STRANDS]; ///< tails, then chains
    int strand_count, tail_count;
    struct shown_bone bones[STAGE_MAX_BONES];
    int bone_count;
    struct hover pressed; ///< where the current drag began
    struct tail_drag {
        int rig, joint;
        double fraction;               ///< of the segment after `joint`
        int sample;                    ///< sample of the knots
        float start[2];                ///< of the grabbed point, pixels
        struct tail_drag_axis axis[2]; ///< by enum axis
        bool applied;                  ///< the open step contains edits
        char hint[128];                ///< which knot it takes along; "": none
    } tail_drag;                       ///< the tail or chain held by the pointer
    struct body_drag {
        int rig;                        ///< tail or character
        bool begun;                     ///< the pointer has moved
        bool lifts;                     ///< moving up the screen lifts the body, instead of moving it away
        int axis;                       ///< locked axis; −1: none
        double rise;                    ///< metres up the screen per metre upwards
        double lowest;                  ///< least movement upwards, where it sits on the ground
        double pixels_per_metre;        ///< at the body
        double pitch;                   ///< metres up the screen per metre away from the eye
        double right[2];                ///< x and z of the screen's right
        double offset[3];               ///< shown offset from the document, metres
        bool hangs[SCENE_MAX_CHANNELS]; ///< channels that swing with it
        bool loops;                     ///< all of its splines loop
    } body_drag;                        ///< the held body, and how pointer movement maps to the ground or upwards
    struct record {
        bool running;                  ///< until the end of the played range
        int first, count;              ///< samples
        double way[3][RECORD_SAMPLES]; ///< metres from the place in the document
        double seen_position, seen[3]; ///< at the last frame
    } record;                          ///< the recorded path of the held body
    struct drag_inertia {
        unsigned rig; ///< id; 0: none
        bool swings;
        double offset[3], velocity[3];            ///< of the base relative to the document, metres and m/s
        struct swing channel[SCENE_MAX_CHANNELS]; ///< in metres
        double scale[SCENE_MAX_CHANNELS];         ///< swing_scale() of each
    } inertia[STAGE_MAX_STRANDS];                 ///< of tails and chains whose body is or was moved by hand
    struct trail_point {
        uint64_t key; ///< 0: none
        int frame;
        float place[3];
    } trail[TRAILS][TRAIL_FRAMES]; ///< points of a rig at a frame, cached for the document state `key`
    struct liveliest {
        uint64_t figure, version; ///< the figure's id; 0: none
        int vertex;
    } liveliest; ///< the vertex that moves most, cached for the last figure
    struct skin {
        int capacity;
        float (*posed)[3]; ///< world positions
        uint64_t hash;     ///< of the stage and character that `posed` shows
    } skin; ///< the posed surface of the character or fox last pointed at, with room for `capacity` vertices
    struct silhouette silhouette; ///< the current outline
    struct pointed {
        float x, y;
        uint64_t hash; ///< of the stage
        struct hover hover;
    } pointed; ///< the last surface point found, with pointer and picture
    struct pin_drag {
        struct rig_point point;
        double frame;
        double start[3];         ///< world, metres
        int axis;                ///< locked axis; −1: none
        double right[3], up[3];  ///< of the screen, world
        double pixels_per_metre; ///< there
    } pin_drag;                  ///< the pin that is dragged
    double floor_scale;          ///< of the dragged floor, pixels per metre
    struct painting painting;
};

/// Each poses a rig of its kind into the stage view, with its shadow.
void stage_pose_tail(struct stage *stage, const struct core *core, int rig);
void stage_pose_chain(struct stage *stage, const struct core *core, int rig);
void stage_pose_model(struct stage *stage, const struct core *core, int rig);

/// The things of the stage. A press edits nothing until the pointer moves.
extern const struct thing thing_tail, thing_chain, thing_bone, thing_body, thing_point, thing_pin, thing_floor;

static inline bool is_strand(const struct hover *hover)
{
    return hover->thing == &thing_tail || hover->thing == &thing_chain;
}

/// Inputs of posing, in the editor's look.
struct posing stage_posing(const struct core *core);
/// The same, with the held body and its follow-through.
struct posing stage_posing_by_hand(const struct stage *stage);
/// Projects a point to the screen; false if it is behind the eye.
bool stage_project_point(const struct stage *stage, const float point[3], float xy[2]);
/// The direction from the eye through a point of the screen.
void stage_ray(const struct stage *stage, float x, float y, float direction[3]);
/// On a stage in rectangle `r`, the rectangle around the corners of a box that are in front of the eye; false if some are not.
bool stage_project_box(const struct stage *stage, struct rect r, const float lo[3], const float hi[3],
                       struct rect *around);

/// Dims the stage below texts, so that they are legible over any character.
void stage_scrim(struct core *core, struct rect box);
/// A small text with its baseline at (x, y), on a scrim.
void stage_note(struct core *core, float x, float y, enum font font, uint32_t color, const char *text);
/// A ring where a tail or chain is held or can be grabbed.
void stage_ring(struct core *core, const float xy[2]);
/// End of a drag that never moved: a click on a bone, or on nothing.
void stage_click(void *room, struct core *core, bool keep);

/// Pixels per metre facing the eye, at a place.
double stage_pixels_per_metre(const struct stage *stage, const float place[3]);
/// How far a drag goes along an axis whose unit is (across, up) on the screen.
double stage_along(double across, double up, const struct drag *drag);
/// A soft character as shown, by its rig. NULL if not shown.
const struct stage_model *stage_soft_shown(const struct stage *stage, int rig);

/// The distance between a character and its clip alone, metres; 0: that is not shown. Of other rigs 0.
float models_aside(const struct core *core, int rig);
/// Shows a character, or a tail's fox. NULL if the view is full.
struct stage_model *models_show(struct stage_view *view, const struct rig_pose *posed);

/// A rig's strand as last shown, or NULL.
const struct shown_strand *strand_of(const struct stage *stage, int rig);
/// Poses a strand with the movement by hand; `change` to its inputs may be NULL. False if it or its model is missing.
bool strand_pose(const struct stage *stage, int rig, double position, const struct by_hand *change,
                 struct rig_pose *pose);
/// Projects a point of a tail or chain, as last posed: `fraction` 0 … 1 of the way from joint to joint + 1.
bool stage_project(const struct stage *stage, int rig, int joint, double fraction, float xy[2]);
/// Grab distance of a tail from its centre line, pixels.
#define STRAND_REACH 16.0f
/// Updates `hover` (a tail) and `nearest` (pixels) if a point of the strand is nearer.
void strand_nearer(const struct stage *stage, int rig, const struct pose *strand, const float p[2], float *nearest,
                   struct hover *hover);
/// The joint end nearest to a point of a tail or chain (a point); nothing if it is behind the eye.
struct hover strand_end(const struct stage *stage, const struct hover *between);

/// The bone at a point of the stage, or its chain.
struct hover bone_hover(const struct stage *stage, const struct core *core, float x, float y);

/// Draws bones: all of the character under the pointer, and those from the selected bone to its tip.
void bones_show(const struct stage *stage, struct core *core);

/// The floor's edge at a point of the stage.
struct hover floors_hover(const struct stage *stage, float x, float y);

/// A marker at a point of the stage; else, if nothing else was `found`, a surface point to pin.
struct hover pins_hover(struct stage *stage, const struct core *core, const struct hover *found, float x, float y);

/// Draws markers, highlights, and the path of the held or selected point.
void pins_show(struct stage *stage, struct core *core);

/// Handles a press on the stage; true if it starts a stroke.
bool brush_press(struct stage *stage, struct core *core, const struct event *event);
/// Finds the surface point under the pointer, and the brush's reach. Call after posing.
void brush_pose(struct stage *stage, struct core *core, bool covered);

/// Draws the ring on the surface and, above the legend, the brush's mode and the paint at the pointer.
void brush_show(struct stage *stage, struct core *core);

/// The body at a point of the stage nearest to the eye, at a position in samples.
struct hover body_hover(struct stage *stage, double position, float x, float y);
/// Starts to drag a body, or the character of a bone, over the ground or, with Ctrl, up and across. X, Y and Z lock an axis; R records.
void press_body(void *room, struct core *core, const struct hover *hover, const struct event *event);
/// A ring around the body under the pointer or held, its path, and the motion recorded so far.
void body_show(struct stage *stage, struct core *core);

/// Stops a body's follow-through at once.
void drag_inertia_stop(struct stage *stage, const struct document *document, int body);

bool record_has_motion(const struct stage *stage);
/// Chooses knots (indices from 0) so that a cubic through them, level at both ends, stays within `tolerance` of `count` values, one per
/// sample. At most `capacity` (at least 2). Returns their number. Allocates.
int record_simplify(const double *values, int count, double tolerance, int *knots, int capacity);

/// Whether the document has the tail or chain, and the joint.
bool tail_drag_holds(const struct document *document, int rig, int joint);

/// The tail or chain that the active spline moves, else the first; -1 if none is visible.
int overlay_rig(const struct stage *stage, const struct core *core);
/// The point for the arc: the tip of the tail or chain that the active spline moves, else the vertex of the selected character that moves
/// most. It may not exist (point_exists()).
struct rig_point overlay_point(struct stage *stage, const struct core *core);
/// Onion skin, ghost and motion arc, whichever are on: one function each, which the last function of overlays.c calls.
void overlays_show(struct stage *stage, struct core *core);

/// The arc of a point of a rig.
void path_show(struct stage *stage, struct core *core, enum trail which, struct rig_point point);

/// Height of the scene's description at the top of a stage, pixels; 0 without one.
float caption_height(struct rect place, const struct document *document);

/// Legend of the phase map, and all floors: brighter if touched, in the warning colour if a character is below.
void characters_show(const struct stage *stage, struct core *core);

/// Position on the segment a … b nearest to p, 0 … 1.
static inline float segment_nearest(const float a[2], const float b[2], const float p[2])
{
    const float dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    const float along = (p[0] - a[0]) * dx + (p[1] - a[1]) * dy;
    return square > 0 ? fmaxf(0, fminf(1, along / square)) : 0;
}

/// The vertex nearest to a point of a surface.
static inline int spot_vertex(const struct surface_spot *spot)
{
    const float *weight = spot->weight;
    const int last = weight[1] > weight[0] ? 1 : 0;
    return (int)spot->corner[weight[2] > weight[last] ? 2 : last];
}

/// Poses a soft character's surface, unless done already. False if not shown.
bool skin_pose(struct stage *stage, int rig);
/// The posed figure's surface point at a point of the stage; false if none.
bool skin_spot(const struct stage *stage, const struct figure *figure, float x, float y, struct surface_spot *spot);

/// Empties the shape.
void silhouette_clear(struct silhouette *silhouette);
/// Extends the grid for a disc.
void silhouette_widen(struct silhouette *silhouette, const float middle[2], float radius);
/// Sets up the grid for all discs; false if none is on the stage.
bool silhouette_open(struct silhouette *silhouette, struct rect stage);
/// Adds a triangle; `inside` is its corners' distance inside the shape, pixels.
void silhouette_add_triangle(struct silhouette *silhouette, const float corner[3][2], const float inside[3]);
/// Smooths the steps of triangles.
void silhouette_soften(struct silhouette *silhouette);
/// Follows the next outline larger than a speck into `points`; the last point repeats the first. Returns the number of points, 0 after the
/// last outline.
int silhouette_follow(struct silhouette *silhouette);

#endif
