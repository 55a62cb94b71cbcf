/// The models of a document's characters: read when a document is opened, and cached by path, so that another scene with the same models reads
/// nothing. And how one is prepared.
#ifndef RIG_MODELS_H
#define RIG_MODELS_H

#include "model/figure.h"
#include "model/gltf.h"
#include "rig/background.h"
#include "scene/document.h"

// --- characters

/// A drawn part of a bone. Its own part goes from the node to the child that it leads to, else to a tip. A bone beside that child, such as
/// an ear on a head, also has the link from its parent.
struct bone {
    int node;     ///< the bone
    int from;     ///< where the part begins: the node, or its parent
    int child;    ///< where it ends; −1: in a tip
    float tip[3]; ///< in the node's own space
    bool hidden;  ///< no vertex follows the bone or a child of it: a control, a pole, a leaf
};

struct skeleton {
    struct bone *bones; ///< own parts first, by node
    int count, own;     ///< all parts, own parts
    bool *carries;      ///< by node: whether vertices follow the bone; true for all bones of a file without meshes
    bool *leads;        ///< whether it or a node below it carries
};

/// A character prepared for posing: its file, its rest pose, bounding boxes, and its bones as you see and click them: a line from each
/// joint to the next. Bones are the joints of skins; in a file without skins all nodes that have a parent. A soft one also has a figure.
struct imported {
    struct gltf gltf;
    struct gltf_pose rest;
    struct gltf_bounds bounds;
    struct skeleton skeleton;
    struct figure figure; ///< without vertices: nothing in it is soft
};

/// Reads a .glb or .gltf. On error nothing is left to free.
bool imported_read(struct imported *imported, const char *path, struct error *error);
void imported_free(struct imported *imported);

/// Where a bone begins and ends in a pose, in the character's space.
void skeleton_ends(const struct bone *bone, const struct gltf_pose *pose, float ends[2][3]);

/// Direction of an animal's back, as x and z from its middle: towards its tail's end, else away from glTF's front, +z. False for a character seen
/// from the front: no bone has "tail" in its name, and it is wider than long or has no bones.
bool imported_back(const struct imported *imported, float back[2]);

// --- bones of a chain

struct chain_bones {
    int count;
    int node[ANGLES_MAX_JOINTS]; ///< each the parent of the next
};

/// The bones from one to another below it, both by name. false with a sentence.
bool chain_find(const struct gltf *gltf, const char *from, const char *to, struct chain_bones *bones,
                struct error *error);

/// The bone at the end of the only way down from `from`; −1 and an error if the way branches, or is too long. Below a bone that leads to
/// vertices, the way ends at the last one that carries some.
int chain_end(const struct imported *imported, int from, struct error *error);

// --- pairs

enum { BONE_NAME_SIZE = 1024 };

/// The name of the same bone on the other side: ear_1_L → ear_1_R, LeftHand → RightHand, arm.l.002 → arm.r.002. false where a name has no
/// side, or is too long.
bool bone_other_side(const char *name, char other[BONE_NAME_SIZE]);

/// The bones of the same chain on the other side, by the names of its ends. false if there is none.
bool chain_find_twin(const struct gltf *gltf, const char *from, const char *to, struct chain_bones *bones);

// --- the models of a document

struct models;

struct models *models_create(void);
void models_destroy(struct models *models);

/// Reads the models that are missing or have changed on disk; figures handed out before are stale afterwards. false with the
/// first sentence if a model is missing or broken, or lacks a coordinate, clip, bone or pinned point that the scene names; the others are loaded
/// all the same.
bool models_update(struct models *models, const struct document *document, struct error *error);

/// Whether these are the models of the document's rigs; false if edits have added or removed some since models_update().
bool models_suit(const struct models *models, const struct document *document);

/// Applies the document's paint to the figures of its characters, and gives its tails foxes of their joints: call it once a frame before
/// solving and posing. Only changes cost time, and only the first paint on a character and another number of joints allocate; if the paint
/// is for another model, the character stays plain.
void models_follow(struct models *models, const struct document *document);

/// Whether paint suits a figure: it has as many coordinates and vertices.
bool models_paint_fits(const struct paint *paint, const struct figure *figure);

/// The figure of a model rig, painted; NULL if it is not soft or could not be read. `models` may be NULL.
const struct figure *models_figure(const struct models *models, const struct document *document, int rig);

/// Changes whenever models_update() is called; 0 for none. `models` may be NULL.
uint64_t models_version(const struct models *models);

/// The model of a model rig, or the fox of a tail; NULL: neither, or it could not be read. `models` may be NULL.
const struct imported *models_imported(const struct models *models, const struct document *document, int rig);

/// The picture or film behind the stage. `models` may be NULL; then so is this.
struct background *models_background(const struct models *models);

/// A character's poses: the shown one, one shown beside it, and any other.
enum pose_memory { POSE_UNSEEN, POSE_SHOWN, POSE_BESIDE, POSE_MEMORIES };

/// Memory for a pose. NULL if models_imported() is.
struct gltf_pose *models_pose(const struct models *models, const struct document *document, int rig,
                              enum pose_memory memory);

#endif
