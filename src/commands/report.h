/// Reports on a scene's solution and on a glTF file's contents.
#ifndef COMMANDS_REPORT_H
#define COMMANDS_REPORT_H

#include "rig/models.h"
#include "scene/evaluate.h"
#include <stdio.h>

/// Prints warnings: splines that needed more than a plain solve, unmet pins and floors, and limits that those override.
void solution_warnings(const struct document *document, const struct evaluation *evaluation, const char *path,
                       FILE *out);

/// Prints a glTF character's clips, bones and nodes as a tree, possible chains, and what is not shown.
void contents_print(const struct imported *imported);

#endif
