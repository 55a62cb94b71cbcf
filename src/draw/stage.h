/// The stage's renderer: background, ground, contact shadows and rigs. Private to draw/.
#ifndef DRAW_STAGE_H
#define DRAW_STAGE_H

#include "base/error.h"
#include "draw/area.h"
#include "draw/gl.h"
#include "model/vector.h"
#include "ui/stage.h"

// The programs of all that is on it.

enum stage_program {
    PROGRAM_COAT,
    PROGRAM_FACE,     ///< the surface under a face
    PROGRAM_PLAIN,    ///< opaque surfaces, neither masked nor pictured: their pixels are cheaper
    PROGRAM_PICTURED, ///< any other mesh, and all skirts but coats'
    PROGRAM_MEADOW,
    PROGRAM_FLAT,
    PROGRAMS
};

/// Named as in the shaders.
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
    X(AT_BEND, bend)                                                                                                 \
    X(AT_TOP, top)                                                                                                   \
    X(AT_BOTTOM, bottom)                                                                                             \
    X(AT_ROWS, rows)                                                                                                 \
    X(AT_SHADOW, shadow)

#define UNIFORM_PLACE(constant, name) constant,
enum uniform { UNIFORM_LIST(UNIFORM_PLACE) UNIFORMS };
#undef UNIFORM_PLACE

struct program {
    GLuint name;
    GLint at[UNIFORMS]; ///< −1 where it has none, and setting that does nothing
};

/// Uses a program, with the camera, the light and the softness of edges.
void program_use(const struct program *program, const struct stage_view *view, float seam);

/// projection · view, column-major.
mat4s stage_clip_from_world(const struct stage_view *view);

// All of it together.

struct stage_renderer;

struct stage_renderer *stage_renderer_create(struct error *error);
void stage_renderer_destroy(struct stage_renderer *renderer);

/// Uploads posed meshes, ground and shadows of `view`. Adds to `bytes`. Allocates only for meshes seen for the first time.
void stage_upload(struct stage_renderer *renderer, const struct stage_view *view, long *bytes);

/// Draws what was uploaded into a rectangle of the framebuffer (device pixels; x, y from the bottom left, as in
/// GL), scissored by the caller. Clears depth itself. Leaves depth test, culling and blending off.
void stage_draw(struct stage_renderer *renderer, const struct stage_view *view, int x, int y, int width, int height);

/// The rigs alone, over the whole of a framebuffer, without the soft edges that blend into what is behind.
void stage_draw_rigs(struct stage_renderer *renderer, const struct stage_view *view, int width, int height);

// A picture of the stage that is drawn beside the screen.

struct stage_target {
    GLuint framebuffer, color, depth;
    int width, height;
};

/// Binds a framebuffer of that size; false if the driver cannot make it.
bool stage_target_bind(struct stage_target *target, int width, int height);
void stage_target_destroy(struct stage_target *target);

/// Where the stage goes in a framebuffer of `height` pixels, and how much of it shows.
struct stage_place {
    struct area viewport, visible;
    int height;
};

/// Draws the visible part at `scale` (below 1) of the viewport's pixels and enlarges it. false, with nothing drawn, if the
/// driver cannot make the framebuffer.
bool stage_target_draw(struct stage_target *target, struct stage_renderer *renderer, const struct stage_view *view,
                       struct stage_place place, float scale);

// Where on the screen the stage moves, so that the rest need not be redrawn.

/// Hash of background and lit ground: while it stays the same, so do all pixels outside stage_extent() of both frames.
uint64_t stage_backdrop_hash(const struct stage_view *view);

/// The pixels of `viewport` that rigs and shadows may touch, with `margin` pixels around them.
struct area stage_extent(const struct stage_view *view, struct area viewport, int margin);

/// Height of the ground under the lowest rig.
float stage_lowest_ground(const struct stage_view *view);

// The flat parts of the stage: background, ground and contact shadows, as a few quads of one program.

struct stage_flat;

struct stage_flat *stage_flat_create(void);
void stage_flat_destroy(struct stage_flat *flat);

/// Makes this frame's quads and uploads them; returns how many bytes that were.
long stage_flat_upload(struct stage_flat *flat, const struct stage_view *view);

/// Covers the viewport, whose lowest row is `y`, with the caller's blend function. Leaves blending off.
void stage_flat_draw(const struct stage_flat *flat, const struct program *program, int y, int height);

// Reeds.

struct stage_meadows {
    GLuint vertex_array, corners, indices, instances;
    struct stage_reed sorted[STAGE_MAX_REEDS]; ///< from the farthest to the nearest
};

void stage_meadows_create(struct stage_meadows *meadows);
void stage_meadows_destroy(struct stage_meadows *meadows);
/// Returns how many bytes that were.
long stage_meadows_upload(struct stage_meadows *meadows, const struct stage_view *view);
/// `seam` as for meshes: with it, edges blend into what is behind.
void stage_meadows_draw(const struct stage_meadows *meadows, const struct program *program,
                        const struct stage_view *view, float seam);

// Imported characters, foxes and soft characters.

struct stage_meshes;

struct stage_meshes *stage_meshes_create(const struct program programs[PROGRAMS]);
void stage_meshes_destroy(struct stage_meshes *meshes);
/// Poses all that are in view; returns how many bytes were uploaded.
long stage_meshes_upload(struct stage_meshes *meshes, const struct stage_view *view);
/// `scale` is device pixels a logical one. `seam` is metres a pixel at a distance of 1 m in the pass that softens silhouettes, else 0.
void stage_meshes_draw(const struct stage_meshes *meshes, const struct stage_view *view, float scale, float seam);

#endif
