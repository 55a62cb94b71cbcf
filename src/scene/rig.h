/// A rig: something that splines move. Each kind is a row in every layer: how it is read, written and copied (rig_kind.c here), posed
/// (rig/posing.c), put on the stage (editor/stage/stage.c), drawn (draw/stage.c) and edited (editor/inspector/inspector.c).
#ifndef SCENE_RIG_H
#define SCENE_RIG_H

#include "scene/channel.h"
#include "scene/character.h"
#include "scene/parameter.h"
#include <stdatomic.h>
#include <stddef.h>

enum { TAIL_MAX_JOINTS = ANGLES_MAX_JOINTS };

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

/// An imported character: a glTF file, which is not read here and may be missing.
struct model_rig {
    char *model;        ///< the file, relative to the document's folder unless absolute
    char *clip;         ///< of its animations, the one that it plays; NULL: it stands at rest
    double position[3]; ///< metres
    double scale;       ///< times the file's metres; above 0
    double turn;        ///< degrees about world up
};

/// Joints of an imported character that splines bend on top of its clip.
struct chain {
    struct channel *channels; ///< first, as in every kind of rig that has some (rig.h)
    int channel_count;
    char *model;     ///< the name of a model rig, or its file
    bool by_file;    ///< `model` is the file
    char *from, *to; ///< names of the first joint and the last; not looked up here
    double turn;     ///< degrees by which its axes are turned about its own direction
    bool mirror;     ///< side and twist change sign
};

enum { MEADOW_MAX_REEDS = 4096 };

/// Reeds that all swing by one spline, each by a variation of its own.
struct meadow_rig {
    int spline;
    int count;        ///< reeds, 1 … MEADOW_MAX_REEDS
    int seed;         ///< of their places and variations
    double area[2];   ///< metres along x and z, round the origin
    double height;    ///< of a reed, metres
    double variation; ///< amount of each reed's
    double lag, gain; ///< degrees a joint
};

enum { SCENE_MAX_PINS = 1024 }; ///< over all rigs together

/// At one frame, a point of a rig is to be at a place. All splines that drive the rig are solved through it.
struct pin {
    double frame;         ///< as written; may be fractional
    int point;            ///< of a character: a vertex of its model; of a tail or chain: a joint, whose end it is
    double to[3];         ///< metres of the world
    unsigned id;          ///< unique among the document's knots and pins, kept through edits and undo; not saved
    struct json_t *extra; ///< unknown keys of the file, owned by the document, or NULL
};

/// Every kind: its constant RIG_… and the name that its rows of functions begin with. Layers make their tables from this list.
#define RIG_KIND_LIST(KIND)                                                                                          \
    KIND(RIG_TAIL, tail)                                                                                             \
    KIND(RIG_CHARACTER, character) KIND(RIG_MODEL, model) KIND(RIG_CHAIN, chain) KIND(RIG_MEADOW, meadow)

#define RIG_CONSTANT(constant, name) constant,
enum rig_kind { RIG_KIND_LIST(RIG_CONSTANT) RIG_KINDS };
#undef RIG_CONSTANT

enum { RIG_MAX_INPUTS = 64 }; ///< of a rig of any kind

struct rig {
    atomic_int holders; ///< documents
    unsigned id;        ///< unique among the rigs, kept through edits and undo; not saved
    enum rig_kind kind;
    char *name; ///< NULL where the file has none
    union {
        struct {
            struct channel *channels;
            int channel_count;
        } bent; ///< what each kind that channels bend begins with
        struct tail tail;
        struct character_rig character;
        struct model_rig model;
        struct chain chain;
        struct meadow_rig meadow;
    };
    struct pin *pins; ///< by frame, then by point; at most one of a point on a sample
    int pin_count;
    struct json_t *extra;
};

/// The file's word for a kind: "tail" …
const char *rig_word(enum rig_kind kind);

/// What to call it in a sentence: its name, or the file or joint that it is about.
const char *rig_title(const struct rig *rig);

/// Whether it is a character that is kept above a floor.
static inline bool rig_has_floor(const struct rig *rig)
{
    return rig->kind == RIG_CHARACTER && rig->character.has_floor;
}

/// The splines that bend or drive it, by index: those of its channels or drives.
int rig_input_count(const struct rig *rig);
int rig_input(const struct rig *rig, int input);

/// The same of what moves the points of a rig that pins hold; −1 for an input that moves but the body. And the first of these, −1: none.
int rig_point_input(const struct rig *rig, int input);
int rig_point_spline(const struct rig *rig);

/// Its channels and how many; NULL and 0 for a kind that has none.
struct channel *rig_channels(const struct rig *rig, int *count);

/// What a point that can be pinned is called in the file, "vertex" or "joint"; NULL: such a rig takes no pins.
const char *rig_pin_key(const struct rig *rig);

/// A rig of a kind as a file has it that says no more, without a name or an id. It has one holder.
struct rig *rig_create(enum rig_kind kind);

/// A clone has one holder; what it holds is its own, but for paint and what is known of its file, which are counted.
struct rig *rig_clone(const struct rig *rig);
struct rig *rig_hold(struct rig *rig);
void rig_drop(struct rig *rig);

/// Whether the numbers of what an edit changed may be saved; −0 becomes 0.
bool rig_check(struct rig *rig, struct error *error);

/// Whether two are the same but for name, pins and unknown keys.
bool rig_equals(const struct rig *a, const struct rig *b);

/// Bytes that it takes and another (or NULL) does not, not counting unknown keys.
size_t rig_bytes(const struct rig *rig, const struct rig *other);

#endif
