/// The models of a document's characters: read from their files when a document is opened, and kept by path, so that
/// opening another scene with the same ones reads nothing.
#ifndef RIG_CAST_H
#define RIG_CAST_H

#include "model/figure.h"
#include "scene/document.h"

struct cast;

/// NULL where memory is short.
struct cast *cast_create(void);
void cast_destroy(struct cast *cast);

/// Reads what the document's characters need and is not there yet, or has changed on disk; the pointers given out before
/// are stale after it. false with the first sentence where a model is missing or broken, or lacks a coordinate that is
/// asked for; the others are there all the same.
bool cast_update(struct cast *cast, const struct document *document, struct error *error);

/// The figure of the document's i-th character; NULL where it could not be read. `cast` may be NULL.
const struct figure *cast_figure(const struct cast *cast, int character);

#endif
