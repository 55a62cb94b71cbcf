/// Writing a character of a scene file. Private to src/scene.
#ifndef SCENE_PRINT_CHARACTER_H
#define SCENE_PRINT_CHARACTER_H

#include "scene/document.h"
#include "scene/text.h"

/// `folder` is that of the file that the text is for: where it is not the document's own, paths are rewritten.
void print_character(struct text *text, const struct document *document, const struct character_rig *rig,
                     const char *folder);

#endif
