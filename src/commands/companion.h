/// What `wiggly simulate` and `wiggly analyze` share: opening a mesh, and NAME.simulation.json beside a motion, which says what
/// simulate did, so that analyze need not be told.
#ifndef COMMANDS_COMPANION_H
#define COMMANDS_COMPANION_H

#include "base/error.h"
#include "model/surface.h"
#include <stdbool.h>

enum { COMPANION_PATH = 4096, COMPANION_PIN = 128 };

struct companion {
    int frames, vertices; ///< of the motion; 0: there is no such file
    double fps;
    double shake[3]; ///< direction, of length 1
    double from;     ///< second at which the drive ended within the motion, else 0
    char pin[COMPANION_PIN];
    bool world; ///< seen from outside: the pinned base moves
};

/// The path of a file beside a motion: "a/up.npy" and ".rest.obj" give "a/up.rest.obj". False if it is too long.
bool companion_path(const char *motion, const char *end, char path[COMPANION_PATH]);

bool companion_write(const char *motion, const struct companion *companion, struct error *error);

/// Reads the file beside a motion of so many frames and vertices. All zero if there is none; one of another motion is left out with
/// a warning. Errors name the file and what was expected.
bool companion_read(const char *motion, int frames, int vertices, struct companion *companion, struct error *error);

/// Start from {.scale = 1}.
struct mesh_options {
    int up;       ///< the file's up axis: 1 x, 2 y, 3 z; 0: y
    double scale; ///< metres per unit of the file
};

/// Rows of an option table.
#define MESH_OPTIONS(mesh)                                                                                           \
    {"--up x|y|z", "the mesh's axis that points up (y)", OPTION_WORD, &(mesh)->up, 0, 0},                            \
    {                                                                                                                \
        "--scale S", "metres per unit of the mesh (1)", OPTION_REAL, &(mesh)->scale, 1e-9, 1e9                       \
    }

/// Reads a mesh, turns it upright, scales it, and warns about what was left out.
bool open_mesh(const char *path, const struct mesh_options *options, struct surface *surface, struct error *error);

#endif
