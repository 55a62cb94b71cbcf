/// Paint in .npy: float32 of shape (coordinates, vertices, 2), a and ψ of each. Private to src/scene.
#ifndef SCENE_PAINT_FILE_H
#define SCENE_PAINT_FILE_H

#include "scene/paint.h"
#include "scene/text.h"

/// Reads a file. float64, big endian and Fortran order are read, too. NULL with a sentence that names the file, what was
/// expected and what was there.
struct paint *paint_read(const char *path, struct error *error);

/// The same from memory; `name` stands for the path.
struct paint *paint_parse(const char *name, const char *data, size_t size, struct error *error);

/// Writes a file, whole or not at all, with the rights of the file `like`, if there is one.
bool paint_write(const struct paint *paint, const char *path, const char *like, struct error *error);

/// Bytes of the file, and the file appended to a text.
size_t paint_file_size(const struct paint *paint);
void paint_print(struct text *text, const struct paint *paint);

#endif
