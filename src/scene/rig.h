/// A rig: something that splines move. Each kind has its part in every layer: how it is read, written and copied (rigs.c here), posed
/// (rig/posing.c), put on the stage (editor/stage/stage.c), drawn (draw/stage.c) and edited (editor/inspector/inspector.c).
#ifndef SCENE_RIG_H
#define SCENE_RIG_H

#include "base/error.h"
#include "scene/parameter.h"
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

struct document;

// --- channels: splines that bend joints, each joint later than the one before, or move a part of the fox's body

enum {
    ANGLES_MAX_JOINTS = 256,
    RAMP_MAX_POINTS = 32, ///< and at least 2
};

/// How they are written in the file.
enum angle_form { ANGLES_ONE, ANGLES_EACH, ANGLES_RAMP };

/// The angle at a place from 0 (the first joint) to 1 (the last): linear between points, constant outside.
struct ramp_point {
    double at, angle;
};

/// Degrees.
struct angles {
    enum angle_form form;
    int count; ///< number of joints for ANGLES_EACH, of points for ANGLES_RAMP
    union {
        double value[ANGLES_MAX_JOINTS]; ///< value[0] alone of ANGLES_ONE
        struct ramp_point ramp[RAMP_MAX_POINTS];
    };
};

/// The angle of a joint, of `joints` in all. Joints beyond the last number of ANGLES_EACH have the last one.
double angles_at(const struct angles *angles, int joint, int joints);

/// Lag of a joint behind the first: a single number times `joint`; else the joint's own number.
double angles_lag(const struct angles *lag, int joint, int joints);

/// Its number of angles: 1, one per joint, or one per point of the ramp. And each of them.
int angles_count(const struct angles *angles);
double angles_number(const struct angles *angles, int index);
void angles_set_number(struct angles *angles, int index, double degrees);
/// The angle farthest from 0, and scaling all so that it becomes `degrees` (from 0 on, all become that).
double angles_largest(const struct angles *angles);
void angles_scale(struct angles *angles, double degrees);

bool angles_equal(const struct angles *a, const struct angles *b);

enum { SCENE_MAX_CHANNELS = 64 }; ///< per rig

/// What a channel does: bend joints about an axis, or move a part of the body. Tails do not twist; only tails move parts of a body.
enum axis {
    AXIS_SIDE,
    AXIS_UP,
    AXIS_TWIST,
    AXIS_LOOK,    ///< turns the head sideways, degrees
    AXIS_NOD,     ///< lifts it, degrees
    AXIS_EARS,    ///< lays the ears back, degrees; their tips by as much again, and later
    AXIS_BREATH,  ///< widens the chest, percent
    AXIS_STRETCH, ///< makes the body taller at the same volume, percent
    AXIS_BLINK,   ///< closes the lids, percent
    AXES
};

/// Whether it bends joints; else it moves the body.
bool axis_bends(enum axis axis);

/// Its word in files, and the unit of its gain.
const char *axis_word(enum axis axis);
const char *axis_unit(enum axis axis);

/// A visible gain for a new channel.
double axis_gain(enum axis axis);

/// The part of its spline that a channel bends by: the total y + Re(e^{−j·n·lag} x), or that without the equilibrium y. The latter is for rigs
/// on something that moves: y is the base's motion, and x is relative to it.
enum channel_part { PART_TOTAL, PART_DISPLACEMENT };

struct channel {
    int spline; ///< index
    enum axis axis;
    enum channel_part of;
    struct angles lag;  ///< see angles_lag()
    struct angles gain; ///< degrees (or percent) per unit of the spline; a part of the body uses the first
    struct json_t *extra;
};

#define CHANNEL_DEFAULT_LAG 6.5  /* degrees a joint */
#define CHANNEL_DEFAULT_GAIN 5.0 /* degrees (or percent) a unit of the spline, where a file names none */

// --- kinds of rig

enum {
    TAIL_MAX_JOINTS = ANGLES_MAX_JOINTS,
    SCENE_MAX_JOINTS = 200000, ///< over all tails, counted once and for each channel
};

/// A tail (paper, section 7.1): joints that splines bend, each later than the one before.
struct tail {
    struct channel *channels; ///< first, as in every kind of rig that has some (rig.h)
    int channel_count;
    int joints; ///< 1 … TAIL_MAX_JOINTS
    double length;
    struct param position[3]; ///< metres; a track is the spline's total
    struct angles rest;
};

#define TAIL_DEFAULT_JOINTS 24
#define TAIL_DEFAULT_LENGTH 1.6 /* m */

enum { MODEL_MAX_DRIVES = 4 };

/// The drive of a complex normal coordinate of a character (paper, section 7.2, eq. 30): A e^{−j·lag} x.
struct drive {
    char *name;       ///< of the coordinate in the model
    int spline;       ///< index
    double amplitude; ///< A
    double lag;       ///< degrees
    struct json_t *extra;
};

#define DRIVE_DEFAULT_AMPLITUDE 1.0

/// Whether a clip begins again after its end: as its keys say, or as the user does.
enum clip_repeat { REPEAT_BY_CLIP, REPEAT_ONCE, REPEAT_LOOP };

/// A character: a glTF file with what it has, perhaps bones and clips, perhaps complex normal coordinates. It may be missing and is not read
/// here.
struct model_rig {
    char *model;          ///< the file, relative to the document's folder unless absolute
    char *clip;           ///< the animation that it plays; NULL: it stands at rest
    int repeat;           ///< enum clip_repeat
    double position[3];   ///< metres
    double scale;         ///< times the file's metres; above 0
    double turn;          ///< degrees about world up
    struct drive *drives; ///< at most MODEL_MAX_DRIVES
    int drive_count;
    struct paint *painted; ///< NULL: none, or its file could not be read
    char *paint_file;      ///< .npy file of its paint, or NULL
    bool has_floor;
    double floor; ///< height of its floor, metres of the world
    int phases; ///< axis 0 … 2 along which its first coordinate's phases are shown at first; −1: the model's colours
};

/// Joints of a character that splines bend on top of its clip.
struct chain {
    struct channel *channels; ///< first, as in every kind of rig that has some (rig.h)
    int channel_count;
    char *model;     ///< the name of a model rig, else its file
    char *from, *to; ///< names of the first joint and the last; not looked up here
    double turn;     ///< degrees by which its axes are turned about its own direction
    bool mirror;     ///< side and twist change sign
};

enum {
    SCENE_MAX_PINS = 1024,      ///< over all rigs together
    SCENE_MAX_PINNED = 1 << 20, ///< samples, counted for each pin and each spline that it moves
    FLOOR_PINS = 50,            ///< as which a floor counts there
};

/// A place for a point of a rig at a frame. All splines that drive the rig are solved through it.
struct pin {
    double frame;         ///< as written; may be fractional
    int point;            ///< a vertex of a character's soft mesh; the end of a joint of a tail or chain
    double to[3];         ///< metres of the world
    unsigned id;          ///< as a knot's
    struct json_t *extra; ///< unknown keys of the file, owned by the document, or NULL
};

enum rig_kind { RIG_TAIL, RIG_MODEL, RIG_CHAIN, RIG_KINDS };

enum { RIG_MAX_INPUTS = 64 }; ///< of a rig of any kind

struct rig {
    atomic_int holders; ///< documents
    unsigned id;        ///< as a knot's
    enum rig_kind kind;
    char *name;    ///< NULL where the file has none
    double offset; ///< frames by which all that its splines do comes later
    union {
        struct {
            struct channel *channels;
            int channel_count;
        } bent; ///< what each kind that channels bend begins with
        struct tail tail;
        struct model_rig model;
        struct chain chain;
    };
    struct pin *pins; ///< by frame, then by point; at most one of a point on a sample
    int pin_count;
    struct json_t *extra;
};

/// The file's word for a kind: "tail" …
const char *rig_word(enum rig_kind kind);

/// Its name in a sentence: its own, else its file, joint or kind.
const char *rig_title(const struct rig *rig);

/// Whether it is a character that is kept above a floor.
static inline bool rig_has_floor(const struct rig *rig) { return rig->kind == RIG_MODEL && rig->model.has_floor; }

/// The splines that bend or drive it, by index: those of its channels or drives.
int rig_input_count(const struct rig *rig);
int rig_input(const struct rig *rig, int input);

/// The place of the n-th index of a spline: its inputs', then those of a tail's position, −1 where it follows none. NULL: there are no more.
int *rig_spline(struct rig *rig, int n);

/// The same for inputs that can move pinned points; −1 for an input that moves only the body. And the first such spline; −1: none.
int rig_point_input(const struct rig *rig, int input);
int rig_point_spline(const struct rig *rig);

/// Whether a spline is such an input.
bool rig_is_moved(const struct rig *rig, int spline);

/// Its channels and how many; NULL and 0 if its kind has none.
struct channel *rig_channels(const struct rig *rig, int *count);

/// The file's word for a point that can be pinned, "vertex" or "joint".
const char *rig_pin_key(const struct rig *rig);

/// A rig of a kind with the file format's defaults, without a name or an id. It has one holder.
struct rig *rig_create(enum rig_kind kind);

/// A clone with one holder. It shares only paint and unknown keys, which are counted.
struct rig *rig_clone(const struct rig *rig);
struct rig *rig_hold(struct rig *rig);
void rig_drop(struct rig *rig);

/// Whether an edited rig is allowed in a document. Turns −0 into 0 and looks up a chain's model.
bool rig_check(const struct document *document, struct rig *rig, struct error *error);

/// Whether two are equal except for name, pins and unknown keys.
bool rig_equals(const struct rig *a, const struct rig *b);

/// Bytes that it takes and another (or NULL) does not, not counting unknown keys.
size_t rig_bytes(const struct rig *rig, const struct rig *other);

// --- paint on a character: changes how far and how early each vertex swings
//
//     Ñ' = Ñ e^{a + jψ}
//
// for each coordinate Ñ of the model and each vertex. Zero changes nothing; a positive ψ leads; a never reverses a motion.

/// The limits of a and |ψ| (radians) in a file.
#define PAINT_MOST_SWELL 10.0f
#define PAINT_MOST_LEAD 1000.0f

struct paint {
    atomic_int holders;        ///< rigs
    int coordinates, vertices; ///< of its model
    float (*values)[2];        ///< a and ψ at coordinate · vertices + vertex
    uint64_t version;          ///< new after every change; never repeats
};

/// Paint that changes nothing, with one holder.
struct paint *paint_create(int coordinates, int vertices);
struct paint *paint_hold(struct paint *paint);
/// NULL is fine.
void paint_drop(struct paint *paint);

/// Whether it changes nothing at all; and on one coordinate.
bool paint_is_plain(const struct paint *paint);
bool paint_is_plain_at(const struct paint *paint, int coordinate);

/// Whether a coordinate's values are within the limits; NaN is not.
bool paint_check(const struct paint *paint, int coordinate, struct error *error);

/// Bytes of memory; 0 for NULL.
size_t paint_bytes(const struct paint *paint);

/// New values for some vertices of one coordinate, as a brush makes them in a frame.
struct dab {
    int coordinate, count;
    const int *vertices;      ///< each at most once
    const float (*values)[2]; ///< a and ψ of each
};

/// Applies a dab to the paint; shared paint is copied first.
void paint_dab(struct paint **paint, const struct dab *dab);

/// Reads an .npy file of shape (coordinates, vertices, 2). float64, big endian and Fortran order are read, too. NULL with a sentence that names the file, what was
/// expected and what was there.
struct paint *paint_read(const char *path, struct error *error);

/// Writes an .npy file, whole or not at all.
bool paint_write(const struct paint *paint, const char *path, struct error *error);

#endif
