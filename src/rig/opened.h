/// A scene opened for a command: the document, its models, and its splines solved.
#ifndef RIG_OPENED_H
#define RIG_OPENED_H

#include "rig/posing.h"

struct opened {
    struct document *document;
    struct models *models;
    struct evaluation evaluation;
};

/// Reads a scene, or makes one for a glTF character, and reads its models and paint. On failure nothing is left to free.
bool opened_read(struct opened *opened, const char *path, struct error *error);

/// The same for commands that need only the splines: models are read only if an equilibrium follows a joint or a point is pinned.
bool opened_read_splines(struct opened *opened, const char *path, struct error *error);

/// Solves all splines, with the motions that they follow; again after edits.
void opened_solve(struct opened *opened, enum solver_choice solver);

void opened_free(struct opened *opened);

/// The context for posing its rigs.
struct posing opened_posing(const struct opened *opened);

#endif
