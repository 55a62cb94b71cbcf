/// State of the stage. Private to the stage.
#ifndef EDITOR_STAGE_STATE_H
#define EDITOR_STAGE_STATE_H

#include "editor/core/state.h"
#include "editor/stage/silhouette.h"
#include "model/figure.h"
#include "rig/camera.h"
#include "rig/models.h"
#include "rig/swing.h"

/// Stiff enough for the body to stand still at both ends of its path, 1/s.
#define RECORD_STIFFNESS 1e5

/// A trial change of one spline's x.
struct what_if {
    int spline;
    double re, im;
};

/// A channel that a pull controls through a pose at the playhead.
struct tail_drag_axis {
    bool active, swings; ///< swings: its phase counts, too
    int spline;
    double start[2];          ///< value and phase at the press
    double values_per_radian; ///< of bend at the grabbed joint
};

enum { STAGE_MAX_STRANDS = 32, STAGE_MAX_BONES = 2048 };

/// A tail or chain as last posed, from its first joint to its tip.
struct shown_strand {
    int rig;   ///< index in the document
    int model; ///< its fox in the view; −1: none
    struct pose pose;
};

/// A bone of an imported character, as last posed.
struct shown_bone {
    int model;        ///< rig
    struct bone part; ///< as the skeleton has it
    bool carries;     ///< vertices follow it
    int chain, joint; ///< its chain and number there; −1: none
    uint32_t color;   ///< of the chain's spline
    float ends[2][3]; ///< world
};

/// The tail or chain held by the pointer.
struct tail_drag {
    int rig, joint;
    double fraction;               ///< of the segment after `joint`
    int sample;                    ///< sample of the knots
    float start[2];                ///< of the grabbed point, pixels
    struct tail_drag_axis axis[2]; ///< by enum axis
    bool applied;                  ///< the open step contains edits
    char hint[128];                ///< which knot it takes along; "": none
};

/// The held body, and how pointer movement maps to the ground or upwards.
struct body_drag {
    int rig;                        ///< tail or imported character
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
};

enum { RECORD_SAMPLES = 8192 };

/// The recorded path of the held body.
struct record {
    bool running;                  ///< until the end of the played range
    int first, count;              ///< samples
    double way[3][RECORD_SAMPLES]; ///< metres from the place in the document
    double seen_position, seen[3]; ///< at the last frame
};

/// A tail or chain whose body is or was moved by hand.
struct drag_inertia {
    unsigned rig; ///< id; 0: none
    bool swings;
    double offset[3], velocity[3];            ///< of the base relative to the document, metres and m/s
    struct swing channel[SCENE_MAX_CHANNELS]; ///< in metres
    double scale[SCENE_MAX_CHANNELS];         ///< swing_scale() of each
};

/// A moving point of a rig: the end of a tail's or chain's joint, or a character's vertex.
struct rig_point {
    int rig; ///< index in the document
    int at;  ///< joint or vertex; POINT_BASE: a tail's root
};

enum { POINT_BASE = -1 };

enum { TRAIL_FRAMES = 256 };

/// The arcs that can be shown together.
enum trail { TRAIL_OF_TIP, TRAIL_OF_PIN, TRAIL_OF_BODY, TRAILS };

/// The vertex that moves most, cached for the last figure.
struct liveliest {
    uint64_t figure, version; ///< the figure's id; 0: none
    int vertex;
};

/// A point of a rig at a frame, cached for the document state `key`.
struct trail_point {
    bool known;
    uint64_t key;
    int frame;
    float place[3];
};

/// The posed surface of the character or fox last pointed at, with room for `capacity` vertices.
struct skin {
    int capacity;
    float (*posed)[3]; ///< world positions
    uint64_t hash;     ///< of the stage and character that `posed` shows
};

/// The last surface point found, with pointer and picture.
struct pointed {
    float x, y;
    uint64_t hash; ///< of the stage
    struct hover hover;
};

/// The pin that is dragged.
struct pin_drag {
    struct rig_point point;
    double frame;
    double start[3];         ///< world, metres
    int axis;                ///< locked axis; −1: none
    double right[3], up[3];  ///< of the screen, world
    double pixels_per_metre; ///< there
};

/// The dragged floor.
struct floor_drag {
    int rig; ///< index in the document
    double start, pixels_per_metre;
};

/// Memory for up to `capacity` vertices.
struct brush_work {
    struct pool pool;
    int capacity;
    struct reach reach;
    int *vertices; ///< of a dab, and their new values
    float (*values)[2];
    float (*steps)[2];  ///< the next smoothing steps
    float (*turned)[2]; ///< complex factor of each vertex by smoothing in this frame; 1 elsewhere
    float *spent;       ///< change of each vertex's phase or amplitude by this stroke
};

/// The brush's state.
struct painting {
    enum brush_mode stroke; ///< the running stroke's mode, after Shift and Ctrl
    bool covers;            ///< the pointer is over the character, at `spot`
    struct surface_spot spot;
    float x, y;      ///< pointer in the last frame of the stroke
    bool has_dabbed; ///< the stroke has painted in a frame
    struct brush_work work;
};

struct stage {
    const struct core *core;
    struct stage_view view;
    struct camera camera;
    struct rect figure;                             ///< see stage_figure(); from the stage's middle, in stage heights
    struct shown_strand strands[STAGE_MAX_STRANDS]; ///< tails, then chains
    int strand_count, tail_count;
    struct shown_bone bones[STAGE_MAX_BONES];
    int bone_count;
    struct hover pressed; ///< where the current drag began
    struct tail_drag tail_drag;
    struct body_drag body_drag;
    struct record record;
    struct drag_inertia inertia[STAGE_MAX_STRANDS];
    struct trail_point trail[TRAILS][TRAIL_FRAMES];
    struct liveliest liveliest;
    struct skin skin;
    struct silhouette silhouette; ///< the current outline
    struct pointed pointed;
    struct pin_drag pin_drag;
    struct floor_drag floor_drag;
    struct painting painting;
};

#endif
