/// The document: a scene file (docs/scene-format.md) in memory. Everything on screen is a function of it.
///
/// A document is a value: document_copy() shares splines and rigs by reference count (`holders`). Shared ones are never written to; edit.h,
/// the only code that changes a loaded document, clones them first. Knots are sorted by sample, at most one on each.
#ifndef SCENE_DOCUMENT_H
#define SCENE_DOCUMENT_H

#include "base/error.h"
#include "base/file.h"
#include "scene/parameter.h"
#include "scene/rig.h"
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <wiggly/wiggly.h>

enum {
    SCENE_MAX_SUBSTEPS = 1024,
    SPLINE_MAX_SAMPLES = 100000, ///< per spline
    LIMITED_MAX_SAMPLES = 20000, ///< per spline, if one has a low or high limit
    SCENE_MAX_SAMPLES = 1000000, ///< over all splines together
    SCENE_MAX_LIMITED = 200000,  ///< over those with a low or high limit
    SCENE_MAX_KNOTS = 100000,    ///< over all splines together
    SCENE_MAX_FPS = 100000,
    SCENE_MAX_FRAME = 1000000000, ///< limit of first and last, either sign
    SCENE_MAX_RIGS = 1024,
};

struct json_t;

/// Problems of a file, each one sentence "file:line: path: expected …, got …".
struct problems {
    void (*report)(void *user, bool is_error, const char *sentence); ///< warnings have is_error = false
    void *user;
    int errors, warnings; ///< counted by the callee; start at 0
};

struct knot {
    double frame;     ///< as written; may be fractional
    double value;     ///< of a still one, what it had before, or NaN; not saved then
    double slope;     ///< value per second
    double stiffness; ///< 1/s
    double phase;     ///< Im x of a pose
    bool has_slope;
    bool has_phase; ///< it is a pose
    bool still;     ///< it has neither slope nor phase, does not settle, and its value has no effect
    bool settles;   ///< the equilibrium comes to its value and stays
    unsigned
        id; ///< unique in the document, as those of splines, rigs and pins, kept through edits and undo; not saved
    struct json_t *extra; ///< unknown keys of the file, owned by the document, or NULL
};

struct spline {
    atomic_int holders; ///< documents and other owners
    char *name;
    struct param parameter[PARAMETER_COUNT];
    struct knot *knots; ///< by sample
    int knot_count;
    int color;    ///< 0xRRGGBB, or -1: from the theme, in turn
    char *folder; ///< of the list, or NULL
    bool locked;  ///< the curves leave it alone
    unsigned id;  ///< like a knot's
    struct json_t *extra;
};

static inline enum wiggly_mode spline_mode(const struct spline *spline)
{
    return (enum wiggly_mode)spline->parameter[PARAMETER_MODE].value;
}

static inline enum wiggly_start spline_start(const struct spline *spline)
{
    return (enum wiggly_start)spline->parameter[PARAMETER_START].value;
}

/// The picture or film behind the stage.
struct background_file {
    char *file; ///< a picture, a film or a folder of pictures; NULL: none
    int offset; ///< the picture shown at frame 0
    struct json_t *extra;
};

struct document {
    char *path;      ///< of its own file, NULL for an untitled one; not saved
    unsigned serial; ///< tells opened documents apart; not saved
    char *about;     ///< what the scene shows and what to try, or NULL
    double fps;
    int substeps;
    int first_frame, last_frame;
    struct spline **splines;
    int spline_count;
    struct rig **rigs; ///< in the order of the file
    int rig_count;
    struct background_file background;
    char *folder;     ///< where relative paths start; NULL: the working folder
    unsigned next_id; ///< of a knot, pin, spline or rig
    uint64_t edits;   ///< new after every edit: no other state of any document has it; not saved
    struct json_t *extra;
    struct json_t *owned; ///< what `extra` pointers point into; never changed once loaded
};

/// An empty document: 24 fps, frames 0 … 120, no splines.
struct document *document_create(void);

/// NULL is fine.
void document_destroy(struct document *document);

/// A copy that shares splines and rigs, for another thread too.
struct document *document_copy(const struct document *document);

/// Moves `other` into a document; `other` is destroyed.
void document_become(struct document *document, struct document *other);

/// Gives `edits` a new number; call it after writing to a document outside of its splines and rigs.
void document_touch(struct document *document);

/// Sets the path of the document's own file; "" or NULL: untitled.
void document_set_path(struct document *document, const char *path);

/// The absolute path of a rig's model; false if it has none, or one that is too long.
bool document_model_path(const struct document *document, int rig, char path[PATH_LIMIT]);

/// The same of the background.
bool document_background_path(const struct document *document, char path[PATH_LIMIT]);

/// Guards the models and background of a document (file_note_read()), also those that will not be read.
void document_note_models(const struct document *document);

/// Bytes that a document holds and `other` (NULL: none) does not, without unknown keys.
size_t document_bytes_beside(const struct document *document, const struct document *other);

/// A spline without knots and a name, with the file format's defaults. It has one holder, as has a clone.
struct spline *spline_create(void);
struct spline *spline_clone(const struct spline *spline);
struct spline *spline_hold(struct spline *spline);
/// NULL is fine.
void spline_drop(struct spline *spline);

/// The spline or rig at an index, for writing: a shared one is replaced by a clone.
struct spline *document_own_spline(struct document *document, int spline);
struct rig *document_own_rig(struct document *document, int rig);

/// Inserts a spline before the one at an index, or appends a rig; the document becomes its holder.
void document_insert_spline(struct document *document, int at, struct spline *spline);
void document_add_rig(struct document *document, struct rig *rig);

/// Removes one and drops it.
void document_remove_spline(struct document *document, int at);
void document_remove_rig(struct document *document, int at);

/// Number of samples N of every spline.
int document_samples(const struct document *document);

/// Whether `splines` splines may have `samples` samples each; `limited` of them have a low or high limit.
bool document_check_samples(int splines, int limited, long long samples, struct error *error);

/// Whether its tails have no more joints than a frame can pose.
bool document_check_joints(const struct document *document, struct error *error);

/// The largest number of frames that the document's splines allow.
int document_longest(const struct document *document);

/// Whether a spline of the document loops; new splines then loop too.
bool document_loops(const struct document *document);

/// How many splines of the document have a low or high limit.
int document_count_limited(const struct document *document);

/// Seconds between samples.
double document_step(const struct document *document);

/// The sample that a frame falls on, ⌊(frame − first)·substeps + ½⌋, clamped to ±INT_MAX/2; it may lie outside 0 … N−1.
int document_sample(const struct document *document, double frame);

/// The frame of a sample.
double document_frame(const struct document *document, int sample);

/// Samples by which a rig's offset delays it.
double document_delay(const struct document *document, int rig);

/// The last sample that may have a knot; in a loop the very last sample repeats the first.
int document_last_knot_sample(const struct document *document, const struct spline *spline);

/// Whether a knot or pin may be on that frame, if `last` is the last sample that may have one; if not, `error` says why.
bool document_has_frame(const struct document *document, double frame, int last, struct error *error);

/// Index of the spline with that name, or -1.
int document_find_spline(const struct document *document, const char *name);

/// Whether there is a spline at that index; sets an error if not.
bool document_has_spline(const struct document *document, int spline, struct error *error);

/// Index of the spline with that id, or -1.
int document_find_spline_id(const struct document *document, unsigned id);

/// Index of the first rig of a kind after another, or of all if that is -1; -1 if there is none.
int document_next_rig(const struct document *document, enum rig_kind kind, int before);

/// Index of the n-th rig of a kind, from 0 on, or -1; and how many there are.
int document_find_rig(const struct document *document, enum rig_kind kind, int n);
int document_count_rigs(const struct document *document, enum rig_kind kind);

/// A rig's number among those of its kind.
int document_rig_number(const struct document *document, int rig);

/// The n-th tail, or NULL.
struct tail *document_tail(const struct document *document, int n);

/// Index of the model rig with that name, else of the first with that file; -1 if there is none. No edit gives a rig the name of a file by which
/// something refers to a model.
int document_find_model(const struct document *document, const char *text);

/// As document_next_rig(), of the chains on a model.
int document_next_chain(const struct document *document, int model, int before);

/// Index of the chain with that name, or -1.
int document_find_chain(const struct document *document, const char *name);

/// Whether the equilibrium of a spline follows a joint of the model or chain at `rig`.
bool document_follows(const struct document *document, int spline, int rig);

/// Index of the knot on that sample, or -1 (binary search).
int spline_find_knot(const struct document *document, const struct spline *spline, int sample);

/// Index of the first knot on that sample or after it, or the number of knots.
int spline_lower_bound(const struct document *document, const struct spline *spline, int sample);

/// Whether it has a low or high limit.
bool spline_is_limited(const struct spline *spline);

/// The lowest and highest value of the knots, at least one, from `first` to before `end`.
void spline_values(const struct spline *spline, int first, int end, double range[2]);

/// Whether the motion settles at all knots that are not still, at least one.
bool spline_settles(const struct spline *spline);

/// Index of the knot with that id, or -1.
int spline_find_id(const struct spline *spline, unsigned id);
/// The value, clamped to the spline's limits.
double spline_within(const struct spline *spline, double value);

/// "x", "y" or "z".
const char *coordinate_name(int index);

#define KNOT_DEFAULT_STIFFNESS 1000.0 /* 1/s */

// --- references to splines, and the order in which to solve them: each after those that it follows by tracks

/// Memory for a search: one element of each for every spline.
struct order_space {
    int *stack;
    unsigned char *next;
};

/// A cycle of tracks: this parameter of this spline leads back to the spline.
struct order_cycle {
    int spline;
    enum parameter parameter;
};

/// Writes all splines into `order`, leaders first and otherwise in file order. Tracks that the mode ignores count too, so that a change
/// of mode cannot close a cycle. false with the cycle if there is one.
bool scene_order(const struct document *document, struct order_space space, int *order, struct order_cycle *cycle);

/// Whether there is such an order; allocates what it needs.
bool scene_has_order(const struct document *document, struct order_cycle *cycle);

/// Whether a spline's solution depends on that parameter, in its own mode or as a cubic.
bool spline_uses(const struct spline *spline, enum parameter parameter, bool cubic);

/// Marks, of the first `count` splines, this one and all that follow it, directly or not: those that it cannot follow itself.
/// Allocates nothing; takes up to count² steps.
void scene_followers(const struct document *document, int spline, bool *followers, int count);

enum reference_kind {
    REFERENCE_TRACK,    ///< a spline's parameter that follows
    REFERENCE_POSITION, ///< a coordinate of a rig's position that follows
    REFERENCE_CHANNEL,  ///< an input of a rig that has channels
    REFERENCE_DRIVE,    ///< an input of another rig: a coordinate of a character
};

/// All zero before the first reference.
struct reference {
    enum reference_kind kind;
    int owner;  ///< index of the spline or rig
    int which;  ///< enum parameter, coordinate 0 … 2, channel, or drive
    int spline; ///< index of the spline
    int number; ///< number of this owner's next reference
};

/// Goes on to the next reference; false after the last.
bool reference_next(const struct document *document, struct reference *reference);

/// Makes a reference refer to another spline.
void reference_set(struct document *document, const struct reference *reference, int spline);

/// How many references there are to a spline.
int reference_count(const struct document *document, int spline);

#endif
