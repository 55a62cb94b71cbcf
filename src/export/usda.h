/// A rig as USD: of an imported character its own model, of any other rig the one that its glTF file would hold. Every node that something
/// shown hangs at is a joint, and each skin a skeleton of these, with a bind pose of its own. Private to src/export.
#ifndef EXPORT_USDA_H
#define EXPORT_USDA_H

#include "export/form.h"
#include "model/gltf.h"
#include <stdio.h>

/// Names that are taken, all zero at first.
struct usda_names {
    void *tree;
    int count;
};

/// A node is one joint; or two, if its scale is constant and no half-precision number, as UsdSkel's scales are: one that moves, and
/// below it one that scales.
enum usda_joint_part { JOINT_WHOLE, JOINT_UNSCALED, JOINT_SCALE };

struct usda_joint {
    int node, parent; ///< `parent`: of the joints, −1: none
    enum usda_joint_part part;
    bool moves; ///< else it has no keys: it rests
    char name[FORM_NAME];
    double world[16]; ///< at rest in the character's space; columns first, as all matrices
};

struct usda_model {
    struct pool pool;
    struct export_range *range;
    int rig;
    const char *name; ///< of its prim
    FILE *out;
    const struct gltf *gltf;
    bool is_own;               ///< not an imported character: the only clip of its model has its keys
    struct gltf_place *places; ///< [key · nodes + node], rotations the short way
    float *weights;            ///< [key · weights + weight]
    char (*shapes)[FORM_NAME]; ///< of each weight: the name of its blend shape
    struct usda_joint *joints; ///< parents before their children
    int joint_count;
    int *joint_of;                ///< of each node: the last of its joints; −1: none
    int *slot_of;                 ///< of each node: which joint of skin `slots` it is; −1: none
    int slots;                    ///< −1: none yet
    char (*materials)[FORM_NAME]; ///< their names
    char (*prims)[FORM_NAME];     ///< names in the rig's prim; the skeletons first
    int prim_count;
    struct usda_names prim_names;
};

/// Writes the prim of a rig. False with a sentence. All of the model but what it is made of is zero.
bool usda_model_write(struct usda_model *model, struct error *error);

/// Of a joint in the character's space as a skeleton was bound to it, or at rest where the skin has no such joint.
void usda_bind(struct usda_model *model, int skeleton, int joint, double matrix[16]);

/// Names all materials and writes them, and their textures' files.
bool usda_write_materials(struct usda_model *model, struct error *error);

/// Writes the meshes of all nodes. False with a sentence.
void usda_write_meshes(struct usda_model *model);

// --- text

/// A name of letters, digits and "_": "up.-re" → "up_minus_re"; another one than those that are taken, by a number behind it. It must stay
/// where it is as long as the names.
void usda_unique(struct usda_names *names, const char *wanted, char name[FORM_NAME]);
void usda_names_free(struct usda_names *names);

/// A name for another prim in the rig's.
const char *usda_prim(struct usda_model *model, const char *wanted);

/// "before(x, y, z)"
void usda_vector(FILE *out, const char *before, const float *numbers);

/// "((…), …)": rows of vectors, which USD multiplies from the left.
void usda_matrix(FILE *out, const double matrix[16]);

#endif
