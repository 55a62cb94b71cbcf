/// A soft character in a scene (paper, section 7.2). Its model is a separate file, which is not read here and may be missing.
#ifndef SCENE_CHARACTER_H
#define SCENE_CHARACTER_H

#include "base/file.h"
#include "scene/paint.h"

enum { CHARACTER_MAX_DRIVES = 4 };

/// What moves one complex normal coordinate of a character (eq. 30): A e^{−j·lag} x.
struct drive {
    const char *name; ///< of the coordinate in the model; owned by the document
    int spline;       ///< index
    double amplitude; ///< A
    double lag;       ///< degrees
    struct json_t *extra;
};

struct character_rig {
    char *model, *paint;    ///< files, relative to the document's folder unless absolute; paint may be NULL
    struct paint *painted;  ///< NULL: none, or the file `paint` could not be read
    uint64_t filed;         ///< the version of `painted` that the file `paint` holds; 0: it holds something else
    struct file_stamp file; ///< that file as it was then
    double position[3];     ///< metres
    struct drive drives[CHARACTER_MAX_DRIVES];
    int drive_count;
    bool has_floor;
    double floor; ///< height above which all of it is kept, metres of the world
    int phases; ///< axis 0 … 2 along which its first coordinate's phases are shown at first; −1: its own colours
};

#define DRIVE_DEFAULT_AMPLITUDE 1.0

#endif
