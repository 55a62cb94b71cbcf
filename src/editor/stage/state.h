/// The state of the stage. Private to the room.
#ifndef EDITOR_STAGE_STATE_H
#define EDITOR_STAGE_STATE_H

#include "editor/core/state.h"
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
struct grab_axis {
    bool active;
    int spline;
    double value; ///< of the knot, in the running step
    double turn;
    double seen_value, seen_im; ///< of an earlier solved frame
    double values_per_radian;   ///< of bend at the grabbed joint
};

enum { STAGE_MAX_STRANDS = 32, STAGE_MAX_BONES = 2048 };

/// A tail or chain as a row of points, from its first joint to its tip.
struct strand {
    int rig; ///< in the document
    bool is_chain;
    int count;
    float point[ANGLES_MAX_JOINTS + 1][3]; ///< world
};

/// A bone of an imported character as it was last posed.
struct shown_bone {
    int model, node;  ///< the character's rig, and the node that turns it
    int chain, joint; ///< the chain that it is of and its number there; −1: none
    uint32_t color;   ///< of the chain's spline
    float ends[2][3]; ///< world
};

/// The tail or chain held by the pointer.
struct grab {
    int rig, joint;
    double fraction;          ///< of the segment after `joint`
    int sample;               ///< on which the knots are set
    float start[2];           ///< where the grabbed point was, pixels
    struct grab_axis axis[2]; ///< by enum axis
    bool applied;             ///< the open step holds edits
};

/// The body held by the pointer, and how the pointer's way becomes one over the ground.
struct hold {
    int tail;
    bool begun;              ///< the pointer has moved
    double pixels_per_metre; ///< at the body
    double pitch;            ///< metres up the screen for one away from the eye
    double right[2];         ///< x and z of what is to the right on the screen
};

enum { RECORD_SAMPLES = 8192 };

/// The way of the held body while it is recorded.
struct record {
    bool running;                   ///< it goes on; ends with what is played
    int first, count;               ///< samples
    double way[3][RECORD_SAMPLES];  ///< metres from where the document has it
    double seen_position, seen[3];  ///< at the last frame
    bool hangs[SCENE_MAX_CHANNELS]; ///< channels that swung
};

/// A tail whose body is or was moved by hand.
struct sway {
    bool swings;
    double offset[3], velocity[3]; ///< of the base from where the document has it, metres and metres per second
    struct swing channel[SCENE_MAX_CHANNELS]; ///< in metres
    double scale[SCENE_MAX_CHANNELS];         ///< swing_scale() of each
};

enum { TRAIL_FRAMES = 256 };

/// The tip of a tail at a frame, as it was when the document was at `key`.
struct trail_point {
    bool known;
    uint64_t key;
    int frame;
    float tip[3];
};

/// Memory for figures of up to `capacity` vertices.
struct brush_work {
    int capacity;
    struct reach reach;
    float (*posed)[3]; ///< positions in the world
    int *vertices;     ///< of a dab, and their new values
    float (*values)[2];
    float (*steps)[2];  ///< that smoothing is about to make
    float (*turned)[2]; ///< by what smoothing has multiplied each vertex in this frame; 1 for all others
};

/// The brush at work.
struct painting {
    enum brush_mode stroke; ///< what the running stroke does (Shift and Ctrl make it another than the one chosen)
    bool covers;            ///< the pointer is over the character, at `spot`
    struct surface_spot spot;
    uint64_t posed_hash; ///< of the stage and the character on it that `posed` was made for
    float x, y;          ///< pointer in the last frame of the running stroke
    bool has_dabbed;     ///< the running stroke has come to a frame
    struct brush_work work;
};

/// A reed that something passes: how it is pushed, and what its own swing adds to that, radians towards +x and +z.
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
    struct stage_view view;
    struct meadow_view meadow;
    struct camera camera;
    struct strand strands[STAGE_MAX_STRANDS]; ///< shown
    int strand_count;
    struct shown_bone bones[STAGE_MAX_BONES];
    int bone_count;
    struct hover pressed; ///< what the running drag began on
    struct grab grab;
    struct hold hold;
    struct record record;
    struct sway sway[STAGE_MAX_TAILS];
    struct trail_point trail[TRAIL_FRAMES];
    struct painting painting;
};

#endif
