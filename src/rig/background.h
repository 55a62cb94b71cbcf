/// The picture or film behind the stage. A thread reads pictures ahead into a ring, at most 1280 × 720 each. ffmpeg reads films.
#ifndef RIG_BACKGROUND_H
#define RIG_BACKGROUND_H

#include "base/png.h"
#include "scene/document.h"

struct background;

/// Without a file it needs hardly any memory, else 52 MB.
struct background *background_create(void);
void background_destroy(struct background *background);

/// Whether a path is a folder, or is named like a picture or film.
bool background_suits(const char *path);

/// Call it once a frame. `ahead`: a thread reads; else background_at() does, and waits. False, once, with why the file or a picture of it cannot
/// be shown.
bool background_follow(struct background *background, const struct document *document, bool ahead,
                       struct error *error);

/// The picture at a frame of the scene, of four channels and valid until the next call: one a frame; a film keeps its pace. Beyond its ends the
/// first and the last one. While it is read, the one before; without pixels: none. `id` changes with the pixels.
struct png_picture background_at(struct background *background, double frame, uint64_t *id);

/// Whether a picture is on its way.
bool background_is_behind(const struct background *background);

#endif
