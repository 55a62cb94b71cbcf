/// What is exported: rigs of a document, posed at evenly spaced times. A form describes a rig as other programs know it: a mesh with joints
/// or morph targets, and their motion. Each kind of rig has a row of functions; all formats use only these. Private to src/export.
#ifndef EXPORT_FORM_H
#define EXPORT_FORM_H

#include "base/file.h"
#include "base/names.h"
#include "base/need.h"
#include "export/export.h"

enum { FORM_INFLUENCES = 4, FORMAT_SUMMARY = 96 };

// --- files in a folder beside the exported file; all of them are written, or none

/// Initially zero.
struct sidecars {
    struct sidecar {
        struct file_output output;
        char *path;
        bool is_new; ///< replaces no file
    } * files;
    int count;
    struct pool paths;
    char folder[PATH_LIMIT];
    bool is_new; ///< the folder is new
};

/// Writes a file of the folder under a temporary name. Returns false with an error message.
bool sidecars_add(struct sidecars *sidecars, const char *folder, const char *name, const void *data, size_t size,
                  struct error *error);

/// Renames all files to their final names. On failure the old files stay.
bool sidecars_commit(struct sidecars *sidecars, struct error *error);

/// Removes what was written, committed or not, except files that replaced others.
void sidecars_discard(struct sidecars *sidecars);

// --- formats, and the content of a file

struct export_range {
    const struct posing *posing;
    const struct export_options *options;
    const struct export_format *format;
    int rigs[SCENE_MAX_RIGS]; ///< indices in the document
    int rig_count;
    double first;   ///< frame of the first key
    double spacing; ///< frames between keys
    int key_count;
    const double *frames;         ///< of the keys, where they are not evenly spaced; NULL: they are
    const char *path;             ///< of the exported file
    const char *rig_choice;       ///< the option for choosing a rig, as named in errors
    char *title;                  ///< name of the animation, by default the scene's
    char summary[FORMAT_SUMMARY]; ///< a short description of the result
    long done, total;             ///< keys of all rigs
    struct sidecars sidecars;     ///< files that the exported file refers to
};

bool csv_write(struct export_range *range, FILE *out, struct error *error);
bool points_write(struct export_range *range, FILE *out, struct error *error);
bool gltf_write(struct export_range *range, FILE *out, struct error *error);
bool bvh_write(struct export_range *range, FILE *out, struct error *error);
bool usda_write(struct export_range *range, FILE *out, struct error *error);

/// Writes rigs other than characters that are kept in their files.
bool gltf_write_scene(struct export_range *range, const int *rigs, int count, bool binary, FILE *out,
                      struct error *error);

/// Sets the keys, by the options and the document's range.
bool range_choose_keys(struct export_range *range, struct export_report *report, struct error *error);

/// A key's frame, and its time in seconds from the first.
double range_frame(const struct export_range *range, int key);
double range_seconds(const struct export_range *range, int key);

/// Poses a rig (for a chain its model) at a key. Outside the document loops continue and everything else stands still.
/// Returns false with an error message if the model is missing.
bool range_pose(const struct export_range *range, int rig, int key, struct rig_pose *pose, struct error *error);

/// The matrix that places a character on the stage, if the file is to have it there; NULL: the character stays where its own file
/// has it. Of all other rigs NULL: their forms are in the stage's space.
const float *range_root(const struct export_range *range, int rig, const struct rig_pose *pose);

/// A key's position in the document, samples.
double range_position(const struct export_range *range, int key);

/// Counts a key of a rig as done. Returns false with an error message if the export is to stop.
bool range_proceed(struct export_range *range, struct error *error);

// --- forms

/// How a kind of rig can be exported, as bits: a mesh with joints or targets, joints, vertex positions, the file that it came from, or as
/// part of its model.
enum { FORM_MESH = 1, FORM_JOINTS = 2, FORM_POINTS = 4, FORM_FILE = 8, FORM_IN_MODEL = 16 };

struct form_joint {
    const char *name;
    int node;        ///< of the model
    int parent;      ///< −1: the root
    float offset[3]; ///< at rest, relative to the parent
    float bind[3];   ///< position in the mesh's space; joints at rest are not rotated
    float tip[3];    ///< its end, relative to itself, if it has no child
};

struct form_target {
    int group;   ///< a coordinate, whose targets are scaled equally
    int source;  ///< its number in the model's mesh
    float scale; ///< times which its weight there is the form's
};

struct form {
    const struct form_kind *kind;
    struct pool pool;   ///< of what is made for it, and its keys
    struct names names; ///< of joints, where these must differ
    const char *name;
    const struct gltf *gltf;      ///< form_gltf()
    const struct gltf_clip *clip; ///< of a character, that plays; NULL: none
    const struct figure *figure;  ///< its soft mesh; NULL: none
    int soft;                     ///< the node of that, if drives move its morph weights; −1: none
    int vertex_count;             ///< for points
    struct gltf_shape shape;      ///< its mesh, where the form holds one, or only its targets' names
    int joint_count;              ///< 0: only the whole mesh and its targets move
    struct form_joint *joints;    ///< of a character the bones that chains bend
    int first_bone;               ///< joints before it only hold the mesh
    struct form_target *targets;  ///< as many as the shape has
    void *owned;                  ///< private to the kind
};

/// Joints and weights at one time.
struct form_key {
    float translation[3]; ///< of the root, metres
    float (*rotation)[4]; ///< of each joint relative to its parent, unit quaternions x y z w
    float (*scale)[3];    ///< of each joint along its own axes; 1 unless the kind sets it
    float (*offset)[3];   ///< of each joint relative to its parent; at rest unless the kind sets it
    float *weight;        ///< of each target
};

/// Receives a named number of a rig at one time: a table column.
typedef void form_column(void *user, double value, const char *format, ...) __attribute__((format(printf, 3, 4)));

struct form_kind {
    unsigned holds; ///< FORM_MESH …
    /// Fills everything but kind and name, from a pose at any time.
    bool (*open)(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                 struct error *error);
    void (*key)(const struct form *form, const struct rig_pose *pose, struct form_key *key);
    /// Numbers that move the rig at a key, always the same columns in the same order. NULL: none.
    void (*columns)(const struct export_range *range, int rig, const struct rig_pose *pose, int key,
                    form_column *column, void *user);
};

/// A character; and its joints, for formats that have only joints.
extern const struct form_kind model_form, skeleton_form;

/// A rig's form functions: of its kind, or of a soft character that stands as it is in its file.
const struct form_kind *form_kind(const struct posing *posing, int rig);

/// A rig's name in files and messages: its own, or its kind's word.
const char *form_name(const struct rig *rig);

/// The model of a pose, with what paint has made of the coordinates in the targets of its mesh, which then leave normals alone. The memory is the
/// pool's.
const struct gltf *form_gltf(const struct rig_pose *pose, struct pool *pool);

/// A name as one word, with "_" for each space, at which readers of text end it. The memory is the pool's.
char *form_word(struct pool *pool, const char *name);

/// Creates a rig's form. Returns false with an error message and nothing to close.
bool form_open(const struct export_range *range, int rig, struct form *form, struct error *error);
void form_close(struct form *form);

/// Vertex positions in the node that has the mesh in a .glb, because programs play a point cache inside that; those of several nodes in
/// the file's space. Or as on the stage.
void form_vertices(const struct form *form, const struct rig_pose *pose, bool as_shown, float (*positions)[3]);

// --- all keys of a rig, for animation formats

/// A row of numbers per key: the root's translation, the joints' rotations, scales and offsets, the targets' weights. Rotations take the
/// short way between keys.
struct keys {
    int count, width, joints;
    float *rows;
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

/// Poses the rig at each key. The keys' memory is the form's.
bool keys_collect(struct export_range *range, int rig, struct form *form, struct keys *keys, struct error *error);

/// A quaternion and its negative are the same rotation; makes `q` the one closer to `before`.
void keys_turn_short_way(const float before[4], float q[4]);

/// Makes the last row equal to the first if they almost are, as in a clip of rounded length.
void keys_close_loop(float *rows, int width, int count);

#endif
