/// What commands tell of a scene or a character: what pins leave, and what a glTF file holds.
#ifndef COMMANDS_REPORT_H
#define COMMANDS_REPORT_H

#include "model/gltf.h"
#include "scene/evaluate.h"

// What there is to say about a scene's pins once it is solved.

/// Calls `tell` with a sentence for each pin that is not met, for each floor that is not, and for what of each spline they pass over.
void pin_warnings(const struct document *document, const struct evaluation *evaluation,
                  void (*tell)(void *user, const char *sentence), void *user);

// What a glTF character holds, printed for a user who does not know the file.

/// Its clips, its bones and other nodes, each under its parent, the ways down to a tip that chains can be made of, and what is not shown.
void contents_print(const struct gltf *gltf);

#endif
