/// A soft character in a scene (paper, section 7.2). Its model is a separate file, which is not read here and may be missing.
#ifndef SCENE_CHARACTER_H
#define SCENE_CHARACTER_H

#include "base/file.h"
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

/// What the app knows of the file of a character's paint, the same in all versions of the character: it is noted, not edited.
struct paint_file {
    atomic_int holders;
    char *path;              ///< relative to the document's folder unless absolute; NULL: none
    uint64_t version;        ///< of the paint that it holds; 0: it holds something else
    struct file_stamp stamp; ///< the file as it was then
};

struct paint_file *paint_file_create(void);
struct paint_file *paint_file_hold(struct paint_file *file);
void paint_file_drop(struct paint_file *file);

/// Makes a copy of it that nobody else holds.
void paint_file_part(struct paint_file **file);

struct character_rig {
    char *model;             ///< a file, relative to the document's folder unless absolute
    struct paint *painted;   ///< NULL: none, or its file could not be read
    struct paint_file *file; ///< that its paint is from or goes to
    double position[3];      ///< metres
    struct drive drives[CHARACTER_MAX_DRIVES];
    int drive_count;
    bool has_floor;
    double floor; ///< height above which all of it is kept, metres of the world
    int phases; ///< axis 0 … 2 along which its first coordinate's phases are shown at first; −1: its own colours
};

#define DRIVE_DEFAULT_AMPLITUDE 1.0

#endif
