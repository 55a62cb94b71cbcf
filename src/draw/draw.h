/// The renderer: draws a draw list and a stage into the current framebuffer; decides nothing.
///
/// Where the target keeps its content, only what changed since the last frame is drawn: draw_frame() compares the commands
/// of both frames cell by cell and redraws the rectangles that differ, with the scissor on.
#ifndef DRAW_DRAW_H
#define DRAW_DRAW_H

#include "base/error.h"
#include "ui/drawlist.h"
#include "ui/stage.h"
#include <stdint.h>

struct draw;

/// Compiles shaders, rasterises the fonts for `scale`, makes buffers. A context must be current.
struct draw *draw_create(float scale, struct error *error);
void draw_destroy(struct draw *draw);

/// One frame to draw.
struct draw_input {
    int width, height; ///< framebuffer, device pixels
    float scale;       ///< device pixels a logical pixel
    bool keeps;        ///< the framebuffer still holds the last frame; false forces everything
    const struct drawlist *list;
    const struct stage_view *stage; ///< drawn below the list, in its viewport; NULL where there is none
    long frame;                     ///< its number, returned with its GPU time
    /// The stage's resolution: below 1 it is drawn smaller and enlarged; 0 means 1.
    float stage_scale;
};

/// Cost of drawing. Times in microseconds.
struct draw_cost {
    double upload_us, draw_us;
    double gpu_us;  ///< of an earlier frame, where the driver has timer queries; else negative
    long gpu_frame; ///< the number of that frame
    long uploaded_bytes;
    int rectangles; ///< that were redrawn
    long pixels;    ///< inside them
};

void draw_frame(struct draw *draw, const struct draw_input *input, struct draw_cost *cost);

/// Reads the framebuffer back: width·height·4 bytes, top row first, alpha 255.
void draw_read(int width, int height, unsigned char *rgba);

/// Draws and finishes a fixed reference frame (the same geometry always, nothing from the document) `count` times and
/// returns the median in milliseconds: the yardstick in the log's header. The framebuffer then no longer holds the last frame.
double draw_reference_ms(struct draw *draw, int width, int height, float scale, int count);

/// Renderer and version strings of the context.
const char *draw_renderer_name(void);

// Pictures of the stage alone, drawn beside the frame on the screen and read back.

struct picture;

/// Framebuffer and renderer for pictures of one size; a context must be current. NULL with a sentence.
struct picture *picture_create(int width, int height, struct error *error);
/// NULL is fine.
void picture_destroy(struct picture *picture);

/// Draws the stage over the whole picture: width·height·4 bytes, top row first, which stay until the next picture. Transparent: rigs alone,
/// without ground and shadows, and 0 where there is nothing.
const unsigned char *picture_draw(struct picture *picture, const struct stage_view *view, bool transparent);

#endif
