/// The stage's renderer: background, ground, contact shadows and rigs. Private to draw/.
#ifndef DRAW_STAGE_H
#define DRAW_STAGE_H

#include "base/error.h"
#include "draw/gl.h"
#include "model/vector.h"
#include "ui/stage.h"

/// Shader programs.
enum stage_program {
    PROGRAM_COAT,
    PROGRAM_FACE,     ///< the fox's head: a coat with a face
    PROGRAM_PLAIN,    ///< opaque surfaces without mask or picture; cheaper per pixel
    PROGRAM_PICTURED, ///< all other meshes, and all skirts except coats'
    PROGRAM_FLAT,
    PROGRAM_BACKED, ///< PROGRAM_FLAT with a picture behind
    PROGRAMS
};

struct stage_renderer;

struct stage_renderer *stage_renderer_create(struct error *error);
void stage_renderer_destroy(struct stage_renderer *renderer);

/// Uploads posed meshes, ground and shadows of `view`. Adds to `bytes`. Allocates only for new meshes.
void stage_upload(struct stage_renderer *renderer, const struct stage_view *view, long *bytes);

/// Draws the upload into a rectangle of the framebuffer, in device pixels from the bottom left as in GL. The caller sets the scissor.
/// Clears depth. Leaves depth test, culling and blending off. Transparent: only rigs, without the soft edges that blend into the background.
void stage_draw(struct stage_renderer *renderer, const struct stage_view *view, int x, int y, int width, int height,
                bool transparent);

// Where the stage moves on the screen, so that the rest need not be redrawn.

/// Hash of background and lit ground. If it stays the same, so do all pixels outside stage_extent() of both frames.
uint64_t stage_backdrop_hash(const struct stage_view *view);

/// The pixels of `viewport` that rigs and shadows may touch, with `margin` pixels around them.
struct area stage_extent(const struct stage_view *view, struct area viewport, int margin);

#endif
