/// The parameters of a spline, one row each, with everything that files, edits, the solver's description and the editor need.
///
/// To add one, add a constant here, where it belongs in the file, a row in parameter.c, and a member of wiggly_desc that the
/// solver uses.
#ifndef SCENE_PARAMETER_H
#define SCENE_PARAMETER_H

#include <stdatomic.h>
#include <stdbool.h>
#include <wiggly/more.h>

/// The part of a joint's motion that is followed: degrees about world up, metres across the chain's direction or up, or what its acceleration does
/// to the model's first coordinate that the spline drives.
enum motion_of { MOTION_TURN, MOTION_ACROSS, MOTION_UP, MOTION_BASE, MOTION_KINDS };

/// The file's words for them, ended by NULL.
extern const char *const motion_words[];

struct json_t;

/// The motion of a joint, in its model's clip, relative to its mean over the clip.
struct joint_motion {
    atomic_int holders; ///< splines
    char *model;        ///< the name of a model rig, else its file
    char *joint;        ///< its name; not looked up here
    enum motion_of of;
    double gain; ///< factor
    char *chain; ///< the chain whose direction counts, or NULL
    struct json_t *extra;
};

/// A copy with one holder.
struct joint_motion *motion_create(const struct joint_motion *motion);
bool motion_equals(const struct joint_motion *a, const struct joint_motion *b);

/// NULL is fine, as of the next.
void motion_hold(struct joint_motion *motion);
void motion_drop(struct joint_motion *motion);

/// A number, the index of a word, another spline's total, or a joint's motion in a clip.
struct param {
    double value;                ///< used if it follows nothing
    int track;                   ///< index of the followed spline, or -1
    struct joint_motion *motion; ///< the followed joint, or NULL; a spline holds it
};

/// A constant, and the track of a spline.
static inline struct param param_number(double value) { return (struct param){.value = value, .track = -1}; }
static inline struct param param_track(int spline) { return (struct param){.track = spline}; }

static inline bool param_follows(const struct param *param) { return param->track >= 0 || param->motion; }

/// In the order in which files and the inspector list them.
enum parameter {
    PARAMETER_MODE,
    PARAMETER_FREQUENCY,
    PARAMETER_DAMPING,
    PARAMETER_BANDWIDTH,
    PARAMETER_CALM,
    PARAMETER_WIND_UP,
    PARAMETER_EQUILIBRIUM,
    PARAMETER_START,
    PARAMETER_PASSIVE,
    PARAMETER_LOW, ///< low and high are one member of the file, "limits": [low, high]
    PARAMETER_HIGH,
    PARAMETER_VARIATION, ///< likewise: "variation": { "seed", "amount" }
    PARAMETER_SEED,
    PARAMETER_COUNT
};

enum parameter_kind {
    PARAMETER_TRACK,  ///< a number or a track: a wiggly_param of the description
    PARAMETER_NUMBER, ///< a number only: a double
    PARAMETER_CHOICE, ///< one of several words: an enum
    PARAMETER_LIMIT,  ///< a number, or none: infinite
    PARAMETER_WHOLE,  ///< a whole number: an int
};

enum {
    IN_COMPLEX = 1 << WIGGLY_COMPLEX,
    IN_REAL = 1 << WIGGLY_REAL,
    IN_CUBIC = 1 << WIGGLY_CUBIC,
    IN_ALL = IN_COMPLEX | IN_REAL | IN_CUBIC,
};

enum { PARAMETER_MAX_WORDS = 3 };

struct parameter_row {
    const char *name; ///< on screen, and in the file
    const char *key;  ///< in the file, where that is another
    const char *unit; ///< on screen, or NULL; a wind-up's numbers are periods
    const char *hint, *undo;
    enum parameter_kind kind;
    unsigned modes;          ///< that use it: IN_COMPLEX | …
    size_t place;            ///< in wiggly_desc
    double minimum, maximum; ///< of a constant
    double complex_maximum;  ///< in complex mode, if different, else 0
    double usual;            ///< end of its slider (a frequency's is at most half the sample rate); 0: no slider
    double standard;         ///< if a file does not contain it
    bool is_quiet;           ///< with that value a file contains it never; else if the mode uses it
    double fresh;            ///< of a new spline
    double step;             ///< of arrow keys, in `unit`; below 1 two decimals are shown
    const char *words[PARAMETER_MAX_WORDS + 1]; ///< of a choice, in the file
    const char *labels[PARAMETER_MAX_WORDS];    ///< on screen
};

extern const struct parameter_row parameter_rows[PARAMETER_COUNT];

double parameter_maximum(enum parameter parameter, enum wiggly_mode mode);

/// A value clamped to the range of constants in that mode.
double parameter_clamped(enum parameter parameter, enum wiggly_mode mode, double value);

/// Its key in a file.
static inline const char *parameter_key(enum parameter parameter)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    return row->key ? row->key : row->name;
}

/// The first parameter with that key in a file; PARAMETER_COUNT if there is none.
enum parameter parameter_find(const char *name);

/// Writes a parameter to its place in the description.
void parameter_describe(enum parameter parameter, double value, const double *track, wiggly_desc *desc);

#endif
