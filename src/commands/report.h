/// What commands report on a scene or a character: what was not met, and what a glTF file holds.
#ifndef COMMANDS_REPORT_H
#define COMMANDS_REPORT_H

#include "model/gltf.h"
#include "scene/evaluate.h"

/// Receives a printable sentence.
typedef void report_tell(void *user, const char *sentence);

/// Reports on a solved scene: splines that were not simply solved, pins and floors that are not met, and limits that these override.
void solution_warnings(const struct document *document, const struct evaluation *evaluation, report_tell *tell,
                       void *user);

/// Prints what a glTF character holds, for a user who does not know the file: clips, bones and other nodes, each under its parent, the
/// chains that can be made, and what is not shown.
void contents_print(const struct gltf *gltf);

#endif
