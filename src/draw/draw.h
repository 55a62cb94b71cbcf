/// Draws a draw list and a stage into the current framebuffer. If the framebuffer keeps its content, draw_frame() redraws only rectangles
/// that changed since the last frame.
#ifndef DRAW_DRAW_H
#define DRAW_DRAW_H

#include "base/error.h"
#include "ui/drawlist.h"
#include "ui/stage.h"

struct draw;

/// Compiles shaders, rasterises the fonts for `scale` and creates buffers. Needs a current context.
struct draw *draw_create(float scale, struct error *error);
void draw_destroy(struct draw *draw);

/// One frame to draw.
struct draw_input {
    int width, height; ///< framebuffer, device pixels
    float scale;       ///< device pixels per logical pixel
    bool keeps;        ///< the framebuffer still holds the last frame; false redraws everything
    const struct drawlist *list;
    const struct stage_view *stage; ///< drawn below the list, in its viewport, or NULL
    long frame;                     ///< frame number, returned with the GPU time
    /// Resolution of the stage: below 1 it is drawn smaller and enlarged; 0 means 1.
    float stage_scale;
};

/// Cost of drawing. Times in microseconds.
struct draw_cost {
    double upload_us, draw_us;
    double gpu_us;  ///< of an earlier frame; negative without timer queries
    long gpu_frame; ///< number of that frame
    long uploaded_bytes;
    int rectangles; ///< redrawn
    long pixels;    ///< in these rectangles
};

void draw_frame(struct draw *draw, const struct draw_input *input, struct draw_cost *cost);

/// Reads the framebuffer back: width·height·4 bytes, top row first, alpha 255.
void draw_read(int width, int height, unsigned char *rgba);

/// Renderer and version strings of the context.
const char *draw_renderer_name(void);

// Pictures of the stage alone, drawn offscreen and read back.

struct picture;

/// Framebuffer and renderer for pictures of one size; needs a current context. NULL with an error message.
struct picture *picture_create(int width, int height, struct error *error);
/// Accepts NULL.
void picture_destroy(struct picture *picture);

/// Begins to draw the stage over the whole picture. Transparent: only rigs, without ground and shadows, alpha 0 elsewhere.
void picture_draw(struct picture *picture, const struct stage_view *view, bool transparent);
/// The last picture drawn: width·height·4 bytes, top row first, valid until the next call. NULL while it is being drawn, unless `wait`.
const unsigned char *picture_take(struct picture *picture, bool wait);

#endif
