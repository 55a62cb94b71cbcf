/// An imported character as USD: every node that something shown hangs at is a joint, and each skin of the file a skeleton of these,
/// with a bind pose of its own. Private to src/export.
#ifndef EXPORT_USDA_MODEL_H
#define EXPORT_USDA_MODEL_H

#include "export/gltf_source.h"
#include "export/shot.h"
#include "export/usda_text.h"

/// A joint is a node; or, where its scale stands still and is no half, which is what UsdSkel's keys of scales are, two of them: one
/// that moves, and below it one that scales.
enum usda_joint_part { JOINT_WHOLE, JOINT_UNSCALED, JOINT_SCALE };

struct usda_joint {
    int node, parent; ///< `parent`: of the joints, −1: none
    enum usda_joint_part part;
    bool moves; ///< else it has no keys: it rests
};

struct usda_model {
    struct shot *shot;
    int rig;
    const char *name; ///< of its prim
    FILE *out;
    const struct gltf *gltf;
    struct gltf_source *source;
    struct gltf_place *places; ///< [key · nodes + node], rotations the short way
    float *weights;            ///< [key · weights + weight]
    char (*shapes)[FORM_NAME]; ///< of each weight: what its blend shape is called
    struct usda_joint *joints; ///< parents before their children
    char (*joint_names)[FORM_NAME];
    int joint_count;
    int *joint_of;                ///< of each node: the last of its joints; −1: none
    char (*materials)[FORM_NAME]; ///< what they are called
    char (*prims)[FORM_NAME];     ///< what is in the rig's prim is called; the skeletons first
    int prim_count;
};

/// Writes the prim of a rig. False with a sentence.
bool usda_model_write(struct shot *shot, int rig, const char *name, FILE *out, struct error *error);

/// Where a node is at a key, against its parent.
const struct gltf_place *usda_place(const struct usda_model *model, int key, int node);

/// A name for another prim in the rig's.
const char *usda_prim(struct usda_model *model, const char *wanted);

/// Finds the joints, from all keys.
bool usda_make_joints(struct usda_model *model, struct error *error);

/// Matrices have columns first: of a joint against its parent at rest; of a joint in the character's space as a skeleton was bound to it,
/// or at rest where the skin has no such joint.
void usda_rest(const struct usda_model *model, int joint, double matrix[16]);
void usda_bind(const struct usda_model *model, int skeleton, int joint, double matrix[16]);

/// "((…), …)": rows of vectors, which USD multiplies from the left.
void usda_matrix(FILE *out, const double matrix[16]);

/// Names all materials and writes them, and their textures' files.
bool usda_write_materials(struct usda_model *model, struct error *error);

/// Writes the meshes of all nodes.
void usda_write_meshes(struct usda_model *model);

#endif
