/// A rig as USD: of an imported character its own model, of any other rig the one that its glTF file would hold. Every node that something
/// shown hangs at is a joint, and each skin a skeleton of these, with a bind pose of its own. Private to src/export.
#ifndef EXPORT_USDA_H
#define EXPORT_USDA_H

#include "export/form.h"
#include "model/gltf.h"
#include <stdio.h>

/// A node is one joint; or two, if its scale is constant and no half-precision number, as UsdSkel's scales are: one that moves, and
/// below it one that scales.
enum usda_joint_part { JOINT_WHOLE, JOINT_UNSCALED, JOINT_SCALE };

struct usda_joint {
    int node, parent; ///< `parent`: of the joints, −1: none
    enum usda_joint_part part;
    bool moves;               ///< else it has no keys: it rests
    const char *name, *title; ///< `title`: the node's, which the name may not be
    double world[16];         ///< at rest in the character's space; columns first, as all matrices
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
    struct usda_shape {
        const char *token, *prim; ///< its name in arrays, and that of its prim
    } * shapes;                   ///< of each weight
    struct usda_joint *joints;    ///< parents before their children
    int joint_count;
    int *joint_of;          ///< of each node: the last of its joints; −1: none
    int *slot_of;           ///< of each node: which joint of skin `slots` it is; −1: none
    int slots;              ///< −1: none yet
    const char **materials; ///< their prims
    const char **skeletons;
    struct names prims, joint_names, shape_tokens, shape_prims, material_prims;
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

/// A set of names of prims, or of joints.
struct names usda_names(void);

/// Takes a name of letters, digits and "_": "up.-re" → "up_minus_re". All are ASCII, because older readers take no other names of prims;
/// of joints, which are paths in strings, they may be of any script.
const char *usda_name(struct names *names, const char *wanted, bool any_script);

/// A string in quotes.
void usda_string(FILE *out, const char *text);

/// Begins a prim, up to its first brace. `title` is what people read where it differs from its name. `api`: what its schemas are; NULL: none.
void usda_begin(FILE *out, int indent, const char *type, const char *name, const char *title, const char *api);

/// "before(x, y, z)"
void usda_vector(FILE *out, const char *before, const float *numbers);

/// "((…), …)": rows of vectors, which USD multiplies from the left.
void usda_matrix(FILE *out, const double matrix[16]);

#endif
