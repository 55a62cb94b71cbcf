/// Opens the meshes that commands work on.
#ifndef COMMANDS_OPEN_MESH_H
#define COMMANDS_OPEN_MESH_H

#include "model/surface.h"

/// Start from {.up = "y", .scale = 1}.
struct mesh_options {
    const char *up; ///< the file's axis that points up: x, y or z
    double scale;   ///< metres a unit of the file
};

/// What the options are, as rows of an option table.
#define MESH_OPTIONS(mesh)                                                                                           \
    {"--up", NULL, "AXIS", "the mesh's axis that points up: x, y or z (y)", OPTION_TEXT, &(mesh)->up, 0, 0},         \
    {                                                                                                                \
        "--scale", NULL, "S", "metres per unit of the mesh (1)", OPTION_REAL, &(mesh)->scale, 1e-9, 1e9              \
    }

/// NULL or what is wrong.
const char *mesh_options_check(const struct mesh_options *options);

/// Reads a mesh, turned upright and scaled, and warns of what is left out of it.
bool open_mesh(const char *path, const struct mesh_options *options, struct surface *surface, struct error *error);

#endif
