/// The models of a document's characters: read from their files when a document is opened, and kept by path, so that
/// opening another scene with the same ones reads nothing.
#ifndef RIG_MODELS_H
#define RIG_MODELS_H

#include "model/painted.h"
#include "scene/document.h"

struct models;

/// NULL where memory is short.
struct models *models_create(void);
void models_destroy(struct models *models);

/// Reads what the document's characters need and is not there yet, or has changed on disk; the pointers given out before
/// are stale after it. false with the first sentence where a model is missing or broken, or lacks a coordinate that is
/// asked for; the others are there all the same.
bool models_update(struct models *models, const struct document *document, struct error *error);

/// Puts the document's paint onto the figures of its characters: after models_update() did, to be called once a frame, before they
/// are posed. Only what has changed costs anything, and only the first paint on a character allocates; where there is
/// no memory for that, or the paint is for another model, the character stays plain.
void models_paint(struct models *models, const struct document *document);

/// Whether paint is for a figure: it has as many coordinates and vertices.
bool models_paint_fits(const struct paint *paint, const struct figure *figure);

/// The figure of the document's i-th character, painted; NULL where it could not be read. `models` may be NULL.
const struct figure *models_figure(const struct models *models, int character);

#endif
