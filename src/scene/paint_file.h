/// Paint in a scene's file: "vertices", and "paint", an array of a string for each coordinate, or null for one without
/// paint: base64 of its vertices' a and ψ, little-endian float32. Private to src/scene.
#ifndef SCENE_PAINT_FILE_H
#define SCENE_PAINT_FILE_H

#include "scene/members.h"
#include "scene/reader.h"

/// Reads a character's paint, or the name of its .npy file.
void paint_load(struct reader *reader, const struct value *object, struct rig *rig);

/// Writes them: nothing for paint that changes nothing, and the name alone where that file could not be read.
void paint_print(struct members *members, const struct document *document, const struct rig *rig, const char *folder);

#endif
