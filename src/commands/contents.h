/// What a glTF character holds, printed for a user who does not know the file.
#ifndef COMMANDS_CONTENTS_H
#define COMMANDS_CONTENTS_H

#include "model/gltf.h"

/// Its clips, its bones and other nodes, each under its parent, the ways down to a tip that chains can be made of, and what is not shown.
void contents_print(const struct gltf *gltf);

#endif
