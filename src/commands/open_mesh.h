/// Opens the meshes that commands work on.
#ifndef COMMANDS_OPEN_MESH_H
#define COMMANDS_OPEN_MESH_H

#include "model/surface.h"

/// Start from {.scale = 1}.
struct mesh_options {
    int up;       ///< the file's up axis: 1 x, 2 y, 3 z; 0: y
    double scale; ///< metres per unit of the file
};

/// Rows of an option table.
#define MESH_OPTIONS(mesh)                                                                                           \
    {"--up", NULL, "x|y|z", "the mesh's axis that points up (y)", OPTION_WORD, &(mesh)->up, 0, 0},                   \
    {                                                                                                                \
        "--scale", NULL, "S", "metres per unit of the mesh (1)", OPTION_REAL, &(mesh)->scale, 1e-9, 1e9              \
    }

/// Reads a mesh, turns it upright, scales it, and warns about what was left out.
bool open_mesh(const char *path, const struct mesh_options *options, struct surface *surface, struct error *error);

#endif
