/// Turns draw lists into anti-aliased triangles: shapes, lines and text. Private to draw/.
#ifndef DRAW_PAINT_H
#define DRAW_PAINT_H

#include "base/error.h"
#include "draw/gl.h"
#include "ui/font.h"
#include <stdint.h>

/// Position in device pixels from the top left; texel in the glyph atlas; colour bytes R, G, B, A. Coverage is clamp(reach − |across|) ·
/// clamp(along) · texel.
struct batch_vertex {
    float x, y;
    float u, v;
    unsigned char color[4];
    float across, reach, along;
};

enum { BATCH_VERTICES = 1 << 16, BATCH_INDICES = 3 << 16, BATCH_PARTS = 512 };

/// Triangles under one scissor, or an area to fill with a colour.
struct batch_part {
    struct area scissor;
    int first, count;
    uint32_t fill; ///< 0: triangles
};

/// Collects triangles on the CPU.
struct batch {
    GLuint program, array, vertex_buffer, index_buffer, texture;
    GLint framebuffer_uniform, atlas_size_uniform;
    struct batch_vertex *vertices;
    uint32_t *indices;
    struct batch_part *parts;
    int vertex_count, index_count, part_count;
    unsigned generation; ///< changes with every flush, which invalidates earlier indices
    int width, height;   ///< framebuffer
    struct area scissor; ///< of shapes added next
    struct line_scratch *scratch;
    const struct atlas *atlas;
    float scale; ///< device pixels per logical pixel
    double upload_us;
    long uploaded_bytes; ///< both since batch_begin()
};

bool batch_create(struct batch *batch, struct error *error);
void batch_destroy(struct batch *batch);

/// Starts a frame of width × height device pixels with an atlas in a texture.
void batch_begin(struct batch *batch, int width, int height, float scale, const struct atlas *atlas, GLuint texture);

/// Uploads and draws everything, then empties the batch.
void batch_flush(struct batch *batch);

/// Adds every command of a draw list that touches `area`, in order and clipped to it.
void paint_list(struct batch *batch, const struct drawlist *list, struct area area);

#endif
