/// The state of the stage. Private to the room.
#ifndef EDITOR_STAGE_STATE_H
#define EDITOR_STAGE_STATE_H

#include "editor/core/state.h"
#include "editor/stage/silhouette.h"
#include "model/reach.h"
#include "rig/camera.h"
#include "rig/swing.h"

/// Firm enough that the body stands still at both ends of its way, 1/s.
#define RECORD_STIFFNESS 1e5

/// A change of one spline's x, to see what would happen.
struct what_if {
    int spline;
    double re, im;
};

/// One channel that a grab steers through a knot at the playhead. The solution is affine in the knot's value v: at
/// that sample x = x₀ + v·(1 + j·turn), where `turn` is observed from one step to the next.
struct tail_drag_axis {
    bool active;
    int spline;
    double value; ///< of the knot, in the running step
    double turn;
    double seen_value, seen_im; ///< of an earlier solved frame
    double values_per_radian;   ///< of bend at the grabbed joint
};

enum { STAGE_MAX_STRANDS = 32, STAGE_MAX_BONES = 2048 };

/// A tail or chain as it was last posed, from its first joint to its tip.
struct shown_strand {
    int rig;   ///< in the document
    int model; ///< a tail's fox, in the view; −1: none
    struct pose pose;
};

/// A bone of an imported character as it was last posed.
struct shown_bone {
    int model, node;  ///< the character's rig, and the node that turns it
    int chain, joint; ///< the chain that it is of and its number there; −1: none
    uint32_t color;   ///< of the chain's spline
    float ends[2][3]; ///< world
};

/// The tail or chain held by the pointer.
struct tail_drag {
    int rig, joint;
    double fraction;               ///< of the segment after `joint`
    int sample;                    ///< on which the knots are set
    float start[2];                ///< where the grabbed point was, pixels
    struct tail_drag_axis axis[2]; ///< by enum axis
    bool applied;                  ///< the open step holds edits
};

/// The body held by the pointer, and how the pointer's way becomes one over the ground, or up.
struct body_drag {
    int rig;                        ///< a tail or an imported character
    bool begun;                     ///< the pointer has moved
    bool lifts;                     ///< up the screen is up, not away
    int axis;                       ///< the only one along which it moves; −1: as the pointer does
    double rise;                    ///< metres up the screen for one upwards
    double lowest;                  ///< of the way upwards: there it sits on the ground
    double pixels_per_metre;        ///< at the body
    double pitch;                   ///< metres up the screen for one away from the eye
    double right[2];                ///< x and z of the screen's right
    double offset[3];               ///< metres from where the document has it, as shown
    bool hangs[SCENE_MAX_CHANNELS]; ///< channels that swing with it
    bool loops;                     ///< so do all of their splines
};

enum { RECORD_SAMPLES = 8192 };

/// The way of the held body while it is recorded.
struct record {
    bool running;                  ///< it goes on; ends with the played range
    int first, count;              ///< samples
    double way[3][RECORD_SAMPLES]; ///< metres from where the document has it
    double seen_position, seen[3]; ///< at the last frame
};

/// A tail or chain whose body is or was moved by hand.
struct drag_inertia {
    unsigned rig; ///< its id; 0: none
    bool swings;
    double offset[3], velocity[3]; ///< of the base from where the document has it, metres and metres per second
    struct swing channel[SCENE_MAX_CHANNELS]; ///< in metres
    double scale[SCENE_MAX_CHANNELS];         ///< swing_scale() of each
};

/// A point of a rig that goes where it takes it: the end of a joint of a tail or chain, or a vertex of a character.
struct rig_point {
    int rig; ///< in the document
    int at;  ///< the joint or vertex; POINT_BASE: where a tail begins
};

enum { POINT_BASE = -1 };

enum { TRAIL_FRAMES = 256 };

/// The arcs that can be shown at once.
enum trail { TRAIL_OF_TIP, TRAIL_OF_PIN, TRAIL_OF_BODY, TRAILS };

/// The vertex of a character that moves most, of the figure that was asked about last.
struct liveliest {
    uint64_t figure, version; ///< figure's id; 0: none yet
    int vertex;
};

/// A point of a rig at a frame, as it was when the document was at `key`.
struct trail_point {
    bool known;
    uint64_t key;
    int frame;
    float place[3];
};

/// The surface of the character or fox that was last pointed at, as the stage shows it; memory for up to `capacity` vertices.
struct skin {
    int capacity;
    float (*posed)[3]; ///< positions in the world
    uint64_t hash;     ///< of the stage and the character on it that `posed` was made for
};

/// The last surface point that was found, under which point of which picture.
struct pointed {
    float x, y;
    uint64_t hash; ///< of the stage
    struct hover hover;
};

/// The pin that is dragged.
struct pin_drag {
    struct rig_point point;
    double frame;
    double start[3];         ///< metres of the world
    int axis;                ///< the only one along which it moves; −1: as the pointer does
    double right[3], up[3];  ///< of the picture, world
    double pixels_per_metre; ///< there
};

/// The floor that is dragged.
struct floor_drag {
    int rig; ///< in the document
    double start, pixels_per_metre;
};

/// Memory for figures of up to `capacity` vertices.
struct brush_work {
    int capacity;
    struct reach reach;
    int *vertices; ///< of a dab, and their new values
    float (*values)[2];
    float (*steps)[2];  ///< that smoothing is about to make
    float (*turned)[2]; ///< by what smoothing has multiplied each vertex in this frame; 1 for all others
    float *spent;       ///< how far the running stroke has moved each vertex's phase or amplitude
};

/// The brush at work.
struct painting {
    enum brush_mode stroke; ///< mode of the running stroke (Shift and Ctrl change the chosen one)
    bool covers;            ///< the pointer is over the character, at `spot`
    struct surface_spot spot;
    float x, y;      ///< pointer in the last frame of the running stroke
    bool has_dabbed; ///< the running stroke has come to a frame
    struct brush_work work;
};

/// A reed that a body passes: how far it is pushed, and its own swing on top, radians towards +x and +z.
struct brushed_reed {
    double pushed[2], speed[2], q[2], v[2];
};

struct meadow_view {
    struct stage_reed reeds[MEADOW_MAX_REEDS];
    struct brushed_reed brushed[MEADOW_MAX_REEDS];
    double dt; ///< seconds since it was last posed
    bool swings;
};

struct stage {
    const struct core *core;
    struct stage_view view;
    struct meadow_view meadow;
    struct camera camera;
    struct rect figure; ///< see stage_figure(); from the middle of the stage, in heights of it
    struct shown_strand strands[STAGE_MAX_STRANDS]; ///< shown: tails, then chains
    int strand_count, tail_count;
    struct shown_bone bones[STAGE_MAX_BONES];
    int bone_count;
    struct hover pressed; ///< the item that the running drag began on
    struct tail_drag tail_drag;
    struct body_drag body_drag;
    struct record record;
    struct drag_inertia inertia[STAGE_MAX_STRANDS];
    struct trail_point trail[TRAILS][TRAIL_FRAMES];
    struct liveliest liveliest;
    struct skin skin;
    struct silhouette silhouette; ///< of the current outline
    struct pointed pointed;
    struct pin_drag pin_drag;
    struct floor_drag floor_drag;
    struct painting painting;
};

#endif
