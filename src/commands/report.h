/// What commands tell of a scene or a character: what pins leave, and what a glTF file holds.
#ifndef COMMANDS_REPORT_H
#define COMMANDS_REPORT_H

#include "model/gltf.h"
#include "scene/evaluate.h"

/// Who is told something; its sentence is printable.
typedef void report_tell(void *user, const char *sentence);

/// Tells what there is to say once a scene is solved: of each spline, each pin that is not met, each floor that is not, and what of each
/// spline they pass over.
void solution_warnings(const struct document *document, const struct evaluation *evaluation, report_tell *tell,
                       void *user);

/// Prints what a glTF character holds, for a user who does not know the file: its clips, its bones and other nodes, each under its parent, the chains that can be made, and what is not shown.
void contents_print(const struct gltf *gltf);

#endif
