/// A soft character in a scene (paper, section 7.2). Its model is a separate file, which is not read here and may be missing.
#ifndef SCENE_CHARACTER_H
#define SCENE_CHARACTER_H

#include "scene/paint.h"

enum { CHARACTER_MAX_DRIVES = 4 };

/// What moves one complex normal coordinate of a character (eq. 30): A e^{−j·lag} x.
struct drive {
    char *name;       ///< of the coordinate in the model
    int spline;       ///< index
    double amplitude; ///< A
    double lag;       ///< degrees
    struct json_t *extra;
};

struct character_rig {
    char *model;           ///< a file, relative to the document's folder unless absolute
    struct paint *painted; ///< NULL: none, or its file could not be read
    char *paint_file;      ///< .npy that the scene names for its paint, or NULL
    double position[3];    ///< metres
    struct drive drives[CHARACTER_MAX_DRIVES];
    int drive_count;
    bool has_floor;
    double floor; ///< height above which all of it is kept, metres of the world
    int phases; ///< axis 0 … 2 along which its first coordinate's phases are shown at first; −1: its own colours
};

#define DRIVE_DEFAULT_AMPLITUDE 1.0

#endif
