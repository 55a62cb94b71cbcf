/// A rig as other programs know one: a mesh with joints or morph targets, and what moves them. What each kind of rig gives is one
/// row, and every file format is made of that alone. Private to src/export.
#ifndef EXPORT_FORM_H
#define EXPORT_FORM_H

#include "export/range.h"

enum { FORM_INFLUENCES = 4, FORM_NAME = 64 };

/// What a kind of rig can be exported as, bits: a mesh with joints or targets, joints, the places of its vertices, all that is in the
/// file that it came from.
enum { FORM_MESH = 1, FORM_JOINTS = 2, FORM_POINTS = 4, FORM_FILE = 8 };

struct form_joint {
    char name[FORM_NAME];
    int parent;      ///< −1: the root
    float offset[3]; ///< at rest, in its parent
    float bind[3];   ///< where it is in the space of the mesh; joints at rest are not turned
};

struct form_target {
    char *name;
    float (*position)[3], (*normal)[3]; ///< how far it moves vertices and turns normals at weight 1
    int group;                          ///< targets of one group keep their proportion
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
    float tip[3];   ///< of a chain, in its last joint
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

#endif
