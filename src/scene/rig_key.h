/// Tells whether rigs have changed. Private to src/scene.
#ifndef SCENE_RIG_KEY_H
#define SCENE_RIG_KEY_H

#include "scene/document.h"

/// Of all that moves points of the document's rigs besides the splines' solutions and the models' files; never 0.
uint64_t rigs_key(const struct document *document);

/// Of their pins.
uint64_t pins_key(const struct document *document);

#endif
