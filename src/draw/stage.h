/// The stage's renderer: background, ground, contact shadows and rigs. Private to draw/.
#ifndef DRAW_STAGE_H
#define DRAW_STAGE_H

#include "base/error.h"
#include "draw/area.h"
#include "draw/gl.h"
#include "model/vector.h"
#include "ui/stage.h"

// Shader programs.

enum stage_program {
    PROGRAM_COAT,
    PROGRAM_FACE,     ///< the fox's head: a coat with a face
    PROGRAM_PLAIN,    ///< opaque surfaces without mask or picture; cheaper per pixel
    PROGRAM_PICTURED, ///< all other meshes, and all skirts except coats'
    PROGRAM_FLAT,
    PROGRAMS
};

/// Names as in the shaders.
#define UNIFORM_LIST(X)                                                                                              \
    X(AT_CLIP_FROM_WORLD, clip_from_world)                                                                           \
    X(AT_EYE, eye)                                                                                                   \
    X(AT_KEY_FROM, key_from)                                                                                         \
    X(AT_EARTH, earth)                                                                                               \
    X(AT_SEAM, seam)                                                                                                 \
    X(AT_SHADE, shade)                                                                                               \
    X(AT_BLINK, blink)                                                                                               \
    X(AT_HEAD_FROM_BIND, head_from_bind)                                                                             \
    X(AT_LINE, line)                                                                                                 \
    X(AT_BASE, base)                                                                                                 \
    X(AT_PICTURE, picture)                                                                                           \
    X(AT_CUTOFF, cutoff)                                                                                             \
    X(AT_BLENDED, blended)                                                                                           \
    X(AT_BOTH_SIDES, both_sides)                                                                                     \
    X(AT_TOP, top)                                                                                                   \
    X(AT_BOTTOM, bottom)                                                                                             \
    X(AT_ROWS, rows)                                                                                                 \
    X(AT_SHADOW, shadow)

#define UNIFORM_PLACE(constant, name) constant,
enum uniform { UNIFORM_LIST(UNIFORM_PLACE) UNIFORMS };
#undef UNIFORM_PLACE

struct program {
    GLuint name;
    GLint at[UNIFORMS]; ///< −1 for a missing uniform; setting it has no effect
};

/// Uses a program and sets camera, light and the softness of edges.
void program_use(const struct program *program, const struct stage_view *view, float seam);

/// projection · view, column-major.
mat4s stage_clip_from_world(const struct stage_view *view);

// The whole stage.

struct stage_renderer;

struct stage_renderer *stage_renderer_create(struct error *error);
void stage_renderer_destroy(struct stage_renderer *renderer);

/// Uploads posed meshes, ground and shadows of `view`. Adds to `bytes`. Allocates only for new meshes.
void stage_upload(struct stage_renderer *renderer, const struct stage_view *view, long *bytes);

/// Draws the upload into a rectangle of the framebuffer, in device pixels from the bottom left as in GL. The caller sets the scissor.
/// Clears depth. Leaves depth test, culling and blending off.
void stage_draw(struct stage_renderer *renderer, const struct stage_view *view, int x, int y, int width, int height);

/// Draws only rigs, over a whole framebuffer, without the soft edges that blend into the background.
void stage_draw_rigs(struct stage_renderer *renderer, const struct stage_view *view, int width, int height);

// The stage drawn offscreen.

struct stage_target {
    GLuint framebuffer, color, depth;
    int width, height;
};

/// Binds a framebuffer of this size; false if the driver cannot create it.
bool stage_target_bind(struct stage_target *target, int width, int height);
void stage_target_destroy(struct stage_target *target);

/// Viewport and visible part in a framebuffer of `height` pixels.
struct stage_place {
    struct area viewport, visible;
    int height;
};

/// Draws the visible part at `scale` (below 1) of the viewport's pixels and enlarges it. Returns false and draws nothing if the driver
/// cannot create the framebuffer.
bool stage_target_draw(struct stage_target *target, struct stage_renderer *renderer, const struct stage_view *view,
                       struct stage_place place, float scale);

// Where the stage moves on the screen, so that the rest need not be redrawn.

/// Hash of background and lit ground. If it stays the same, so do all pixels outside stage_extent() of both frames.
uint64_t stage_backdrop_hash(const struct stage_view *view);

/// The pixels of `viewport` that rigs and shadows may touch, with `margin` pixels around them.
struct area stage_extent(const struct stage_view *view, struct area viewport, int margin);

/// Height of the ground under the lowest rig.
float stage_lowest_ground(const struct stage_view *view);

// Background, ground and contact shadows: a few quads of one program.

struct stage_flat;

struct stage_flat *stage_flat_create(void);
void stage_flat_destroy(struct stage_flat *flat);

/// Builds and uploads this frame's quads; returns the number of bytes.
long stage_flat_upload(struct stage_flat *flat, const struct stage_view *view);

/// Covers the viewport, with its lowest row at `y` and the caller's blend function. Leaves blending off.
void stage_flat_draw(const struct stage_flat *flat, const struct program *program, int y, int height);

// Imported characters, foxes and soft characters.

struct stage_meshes;

struct stage_meshes *stage_meshes_create(const struct program programs[PROGRAMS]);
void stage_meshes_destroy(struct stage_meshes *meshes);
/// Poses all visible meshes; returns the number of uploaded bytes.
long stage_meshes_upload(struct stage_meshes *meshes, const struct stage_view *view);
/// `scale` is device pixels per logical pixel. `seam` is metres per pixel at a distance of 1 m in the pass that softens outlines, else 0.
void stage_meshes_draw(const struct stage_meshes *meshes, const struct stage_view *view, float scale, float seam);

#endif
