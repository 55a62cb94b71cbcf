/// What is exported: rigs of a document, posed at evenly spaced times. A rig is here as other programs know one: a mesh with joints or morph
/// targets, and what moves them. What each kind of rig gives is one row, and every file format is made of that alone. Private to src/export.
#ifndef EXPORT_FORM_H
#define EXPORT_FORM_H

#include "base/file.h"
#include "export/export.h"
#include "model/motion.h"

enum { FORM_INFLUENCES = 4, FORM_NAME = 64, FORMAT_SUMMARY = 96 };

// --- files in a folder of their own beside the one that is written: all of them are there in the end, or none

/// All zero at first.
struct sidecars {
    struct sidecar {
        struct file_output output;
        char *path;
        bool is_new; ///< none was there before
    } * files;
    int count;
    char folder[PATH_LIMIT];
    bool is_new; ///< so is the folder
};

/// Writes a file of a folder into a temporary one. False with a sentence.
bool sidecars_add(struct sidecars *sidecars, const char *folder, const char *name, const void *data, size_t size,
                  struct error *error);

/// Gives all files their names. On failure the old files stay.
bool sidecars_commit(struct sidecars *sidecars, struct error *error);

/// Removes what was written, committed or not, unless it has replaced something.
void sidecars_discard(struct sidecars *sidecars);

/// Keeps what was committed.
void sidecars_free(struct sidecars *sidecars);

// --- a format, and what goes into a file of it

struct export_range {
    const struct posing *posing;
    const struct export_options *options;
    const struct format *format;
    int rigs[SCENE_MAX_RIGS]; ///< by index in the document
    int rig_count;
    double first;   ///< frame of the first key
    double spacing; ///< frames from one key to the next
    int key_count;
    const char *path;             ///< of the file that is written
    const char *rig_choice;       ///< how a rig is chosen, for sentences
    char title[FORM_NAME];        ///< what the animation may be called: as the scene
    char summary[FORMAT_SUMMARY]; ///< what was written, in a few words
    long done, total;             ///< keys of all rigs
    struct sidecars sidecars;     ///< files that the one that is written names
};

struct format {
    const char *ending;
    bool without_rigs; ///< it makes sense without one
    unsigned holds;    ///< of what a kind of rig gives (FORM_MESH …); 0: any kind
    bool one_rig;      ///< it holds one rig
    bool is_binary;    ///< of two containers
    bool has_tangents; ///< keys may have some
    enum motion_form motion;
    /// Writes all of it to a stream, whose errors the caller sees, and the summary.
    bool (*write)(struct export_range *range, FILE *out, struct error *error);
};

bool csv_write(struct export_range *range, FILE *out, struct error *error);
bool points_write(struct export_range *range, FILE *out, struct error *error);
bool gltf_write(struct export_range *range, FILE *out, struct error *error);
bool bvh_write(struct export_range *range, FILE *out, struct error *error);
bool usda_write(struct export_range *range, FILE *out, struct error *error);

/// Writes a rig that is no imported character as a .glb of its own.
bool gltf_write_rig(struct export_range *range, int rig, FILE *out, struct error *error);

/// Has a range continue with the same rigs of another document.
bool range_take(struct export_range *range, const struct posing *posing, const struct export_options *options,
                struct error *error);

/// The frame of a key, and its time in seconds from the first.
double range_frame(const struct export_range *range, double key);
double range_seconds(const struct export_range *range, double key);

/// Poses a rig of the document, a chain's model, at a key; between two keys for one that is not whole. Outside of the document loops go on, and all
/// else stands still. False with a sentence if the rig's model is missing.
bool range_pose(const struct export_range *range, int rig, double key, struct rig_pose *pose, struct error *error);

/// Where a rig's form stands in the file, as a matrix: where the stage has it; NULL: at the origin, as in an imported character's own
/// file.
const float *range_root(const struct export_range *range, int rig, const struct rig_pose *pose);

/// A spline's value at a key.
wiggly_value range_value(const struct export_range *range, int spline, double key);

/// Whether a key's time is within the document.
bool range_is_inside(const struct export_range *range, double key);

/// Counts a key of a rig as done. False with a sentence if the export is to stop.
bool range_proceed(struct export_range *range, struct error *error);

// --- forms

/// What a kind of rig can be exported as, bits: a mesh with joints or targets, joints, the places of its vertices, all that is in the
/// file that it came from; or as a part of its model.
enum { FORM_MESH = 1, FORM_JOINTS = 2, FORM_POINTS = 4, FORM_FILE = 8, FORM_IN_MODEL = 16 };

struct form_joint {
    char name[FORM_NAME];
    int parent;      ///< −1: the root
    float offset[3]; ///< at rest, in its parent
    float bind[3];   ///< where it is in the space of the mesh; joints at rest are not turned
    float tip[3];    ///< where it ends, in itself, if no joint hangs on it
};

struct form_target {
    struct figure_target figure; ///< how far it moves vertices and turns normals at weight 1
    int group;                   ///< targets of one group keep their proportion
};

struct form {
    const struct form_kind *kind;
    char name[FORM_NAME];
    int vertex_count;
    const float (*position)[3], (*normal)[3], (*color)[3]; ///< colours are linear
    const uint32_t *indices;
    int index_count;
    const struct looks *looks; ///< its materials, polygons and texture coordinates, one a vertex; NULL: none
    int joint_count;           ///< 0: the mesh moves as a whole, and by its targets
    struct form_joint *joints;
    int first_bone; ///< joints before it only carry the mesh
    uint16_t (*slots)[FORM_INFLUENCES];
    float (*weights)[FORM_INFLUENCES];
    int target_count;
    struct form_target *targets;
    const struct character *character; ///< whose coordinates the targets are, or NULL
    void *owned;                       ///< the kind's own
};

/// Where joints and weights are at one time.
struct form_key {
    float translation[3]; ///< of the root, metres
    float (*rotation)[4]; ///< of each joint in its parent, unit quaternions x y z w
    float (*scale)[3];    ///< of each joint, along its own axes; 1 unless its kind sets it
    float (*offset)[3];   ///< of each joint in its parent, as at rest unless its kind sets it
    float *weight;        ///< of each target
};

/// Takes a named number of a rig at one time: a column of a table.
typedef void form_column(void *user, double value, const char *format, ...) __attribute__((format(printf, 3, 4)));

struct form_kind {
    unsigned holds; ///< FORM_MESH …
    /// Fills all but kind and name, from a pose at any time. On failure close() frees what there is.
    bool (*open)(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                 struct error *error);
    void (*close)(struct form *form);
    void (*key)(const struct form *form, const struct rig_pose *pose, struct form_key *key);
    /// Where the vertices are, as the stage shows them.
    void (*vertices)(const struct form *form, const struct rig_pose *pose, float (*positions)[3]);
    /// What moves the rig at a key: always the same columns in the same order. NULL: it has none.
    void (*columns)(const struct export_range *range, int rig, const struct rig_pose *pose, double key,
                    form_column *column, void *user);
};

/// tail_form …
#define FORM_KIND(constant, name) extern const struct form_kind name##_form;
RIG_KIND_LIST(FORM_KIND)
#undef FORM_KIND

/// The joints of an imported character, in place of its row's form, for formats of joints alone.
extern const struct form_kind skeleton_form;

/// How a kind is exported; NULL if it is not.
const struct form_kind *form_kind(enum rig_kind kind);

/// Columns of the angles in degrees by which the channels of a tail or chain bend its joints.
void form_channels(const struct export_range *range, int rig, const struct rig_pose *pose, double key,
                   form_column *column, void *user);

/// What a rig is called in files and messages: its name, or its kind's word.
const char *form_name(const struct rig *rig);

/// The form of a rig. False with a sentence, and nothing to close.
bool form_open(const struct export_range *range, int rig, struct form *form, struct error *error);
void form_close(struct form *form);

/// What the form of an imported character knows besides, in form.owned. Its joints are the nodes that move, first the bones that chains
/// bend, and its targets are those of all nodes.
struct model_body {
    const struct gltf *gltf;
    const struct gltf_clip *clip; ///< that plays; NULL: none
    int *node;                    ///< of each joint
    int *joint_of;                ///< of each node, −1: none
    int bone_count;
};

// --- the keys of one rig, collected: what animation formats hold

/// A row of numbers for each key: the translation of the root, the rotations of all joints, their scales, their offsets, the weights of all
/// targets. Rotations go the short way from key to key.
struct keys {
    int count, width, joints;
    float *rows;
    float *
        slopes; ///< how fast the curves change at the keys, by second; NULL unless tangents were asked for and the format has them
    bool travels; ///< the translation changes
};

// Columns of a row.
static inline int keys_rotation(int joint) { return 3 + 4 * joint; }
static inline int keys_scale(const struct keys *keys, int joint) { return 3 + 4 * keys->joints + 3 * joint; }
static inline int keys_offset(const struct keys *keys, int joint) { return 3 + 7 * keys->joints + 3 * joint; }
static inline int keys_weight(const struct keys *keys, int target) { return 3 + 10 * keys->joints + target; }

static inline const float *keys_at(const struct keys *keys, int key, int column)
{
    return keys->rows + (size_t)key * (size_t)keys->width + column;
}

/// Poses the rig at each key. False with a sentence, and nothing to free.
bool keys_collect(struct export_range *range, int rig, const struct form *form, struct keys *keys,
                  struct error *error);
void keys_free(struct keys *keys);

/// A quaternion and its negative are the same rotation: makes `q` the one nearer to `before`.
void keys_turn_short_way(const float before[4], float q[4]);

/// Makes the last row equal the first if they nearly are, as in a clip whose length is rounded.
void keys_close_loop(float *rows, int width, int count);

#endif
