/// The models of a document's characters, soft and imported: read when a document is opened, and cached by path, so that another scene with the
/// same models reads nothing.
#ifndef RIG_MODELS_H
#define RIG_MODELS_H

#include "model/figure.h"
#include "rig/imported.h"
#include "scene/document.h"

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

/// The figure of the document's i-th character, painted; NULL if it could not be read. `models` may be NULL.
const struct figure *models_figure(const struct models *models, int character);

/// Changes whenever models_update() is called; 0 for none. `models` may be NULL.
uint64_t models_version(const struct models *models);

/// The model of a model rig, or the fox of a tail; NULL: neither, or it could not be read. `models` may be NULL.
const struct imported *models_imported(const struct models *models, const struct document *document, int rig);

/// An imported character's poses: the shown one, one shown beside it, and any other.
enum pose_memory { POSE_UNSEEN, POSE_SHOWN, POSE_BESIDE, POSE_MEMORIES };

/// Memory for a pose. NULL if models_imported() is.
struct gltf_pose *models_pose(const struct models *models, const struct document *document, int rig,
                              enum pose_memory memory);

#endif
