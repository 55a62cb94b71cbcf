/// The scene that `wiggly analyze --scene` writes: a spline, and the character that it drives.
#ifndef COMMANDS_ANALYZE_SCENE_H
#define COMMANDS_ANALYZE_SCENE_H

#include "model/character.h"

/// Writes a scene for the character's file `model`, which must exist. The spline has the first coordinate's frequency and
/// damping. It drives the first of every `modes` coordinates (those of one motion), up to as many as a character in a
/// scene can have.
bool analyze_scene_write(const char *path, const char *model, const struct character *character, int modes,
                         struct error *error);

#endif
