/// What draws all rigs of one kind that are on the stage, and what all painters share. Private to the stage's files of draw/.
#ifndef DRAW_PAINTER_H
#define DRAW_PAINTER_H

#include "draw/gl.h"
#include "model/vector.h"
#include "ui/stage.h"

struct extent;

struct painter {
    void *(*create)(struct error *error); ///< its state; NULL with a sentence
    void (*destroy)(void *state);
    /// Uploads what is new in this frame; adds to `bytes`. Allocates only for what is seen for the first time.
    void (*upload)(void *state, const struct stage_view *view, long *bytes);
    /// `scale` is device pixels a logical one. `seam` is metres a pixel at a distance of 1 m in the pass that softens silhouettes, else 0.
    void (*draw)(const void *state, const struct stage_view *view, float scale, float seam);
    /// Height of the ground under the lowest of them; INFINITY where there are none.
    float (*ground)(const struct stage_view *view);
    /// Adds the boxes around them (draw/stage.h).
    void (*extent)(const struct stage_view *view, struct extent *extent);
};

/// One a kind of rigs that is drawn in a way of its own, in the order in which they are drawn.
#define PAINTER_LIST(PAINTER) PAINTER(character) PAINTER(model) PAINTER(meadow)

#define PAINTER_COUNT(name) +1
enum { PAINTERS = PAINTER_LIST(PAINTER_COUNT) };
#undef PAINTER_COUNT

/// character_painter …
#define PAINTER(name) extern const struct painter name##_painter;
PAINTER_LIST(PAINTER)
#undef PAINTER
extern const struct painter *const painters[PAINTERS];

/// Uniforms that the program of every painter has.
struct painter_uniforms {
    GLint clip_from_world, eye, key_from, earth, seam;
};

struct painter_uniforms painter_find_uniforms(GLuint program);

/// Uses the program and sets its camera and light.
void painter_use(GLuint program, const struct painter_uniforms *at, const struct stage_view *view, float seam);

/// projection · view, column-major.
mat4s stage_clip_from_world(const struct stage_view *view);

#endif
