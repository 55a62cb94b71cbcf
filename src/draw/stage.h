/// The stage's renderer: background, ground, contact shadows and rigs. Private to draw/.
#ifndef DRAW_STAGE_H
#define DRAW_STAGE_H

#include "base/error.h"
#include "draw/area.h"
#include "draw/gl.h"
#include "ui/stage.h"

struct stage_renderer;

struct stage_renderer *stage_renderer_create(struct error *error);
void stage_renderer_destroy(struct stage_renderer *renderer);

/// Uploads what `view` needs: joint matrices, ground and shadows; meshes were made once. Adds to `bytes`. Allocates
/// nothing.
void stage_upload(struct stage_renderer *renderer, const struct stage_view *view, long *bytes);

/// Draws what was uploaded into a rectangle of the framebuffer (device pixels; x, y from the bottom left, as in
/// GL), scissored by the caller. Clears depth itself. Leaves depth test, culling and blending off.
void stage_draw(struct stage_renderer *renderer, const struct stage_view *view, int x, int y, int width, int height);

/// The rigs alone, over the whole of a framebuffer, without the soft edges that blend into what is behind.
void stage_draw_rigs(struct stage_renderer *renderer, const struct stage_view *view, int width, int height);

// A smaller picture of the stage, drawn first and then enlarged onto the panel.

struct stage_target {
    GLuint framebuffer, color, depth;
    int width, height;
};

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

/// Extends it by a box in world space.
struct extent;
void extent_add_box(struct extent *extent, const float lo[3], const float hi[3]);

// What lies flat on the stage: background, ground and contact shadows, as a few quads of one shader.

struct stage_flat;

struct stage_flat *stage_flat_create(struct error *error);
void stage_flat_destroy(struct stage_flat *flat);

/// Makes this frame's quads and uploads them; returns how many bytes that were.
long stage_flat_upload(struct stage_flat *flat, const struct stage_view *view);

/// Covers the viewport, whose lowest row is `y`, with the caller's blend function. Leaves blending off.
void stage_flat_draw(const struct stage_flat *flat, int y, int height);

#endif
