/// A scene for a glTF character: it stands on the stage and plays its first clip.
#ifndef RIG_IMPORT_H
#define RIG_IMPORT_H

#include "model/gltf.h"
#include "scene/document.h"

/// Whether a file is a character: by its name, .glb or .gltf, or by its first bytes.
bool import_suits(const char *path);

/// A new document without a path, with the character of the file, as import_add() adds it. It takes the first clip's range, from its first key to
/// its last, and the frame rate of the clip's keys. NULL and an error on failure.
struct document *import_scene(const char *path, struct error *error);

/// Adds the character in a file to a document: a soft one, whose first coordinate `spline` drives (-1: a new one), or an imported
/// one, which plays its first clip. False with a sentence.
bool import_add(struct document *document, const char *path, int spline, struct error *error);

/// Makes a model rig play a clip of its file, NULL: none. A scene without splines, or with some that follow the clip and no knots or pins,
/// takes the clip's frame rate and range, and splines that follow it loop if it does.
bool import_choose_clip(struct document *document, int rig, const struct gltf *gltf, const char *clip,
                        enum clip_repeat repeat, struct error *error);

/// A copy of a document in which a model rig plays another clip, by its index, in that clip's frames. It has no pins of chains and no knots of
/// splines that follow the clip, because those were set for the first clip. NULL with a sentence.
struct document *import_with_clip(const struct document *document, int rig, const struct gltf *gltf, int clip,
                                  struct error *error);

#endif
