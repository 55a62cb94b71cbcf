/// Collects triangles on the CPU and draws them in painter's order with few calls. Private to draw/.
#ifndef DRAW_BATCH_H
#define DRAW_BATCH_H

#include "base/error.h"
#include "draw/area.h"
#include "draw/gl.h"
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
    bool is_fill;
    uint32_t fill;
};

struct batch {
    GLuint program, array, vertex_buffer, index_buffer;
    GLint framebuffer_uniform, atlas_size_uniform;
    struct batch_vertex *vertices;
    uint32_t *indices;
    struct batch_part *parts;
    int vertex_count, index_count, part_count;
    unsigned generation; ///< changes with every flush, which invalidates earlier indices
    int width, height;   ///< framebuffer
    struct area scissor; ///< of shapes added next; set by the caller
    GLuint texture;
    int texture_width, texture_height;
    double upload_us;
    long uploaded_bytes; ///< both since batch_begin()
};

bool batch_create(struct batch *batch, struct error *error);
void batch_destroy(struct batch *batch);

/// Starts a frame of width × height device pixels with an atlas texture.
void batch_begin(struct batch *batch, int width, int height, GLuint texture, int texture_width, int texture_height);

/// Fills an area with an opaque colour 0xRRGGBBAA. For large areas this is cheaper than triangles.
void batch_fill(struct batch *batch, struct area area, uint32_t color);

/// Makes room, flushing if necessary, and returns the index of the next vertex.
uint32_t batch_reserve(struct batch *batch, int vertices, int indices);

static inline void batch_add(struct batch *batch, struct batch_vertex vertex)
{
    batch->vertices[batch->vertex_count++] = vertex;
}

static inline void batch_triangle(struct batch *batch, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *out = batch->indices + batch->index_count;
    out[0] = a;
    out[1] = b;
    out[2] = c;
    batch->index_count += 3;
}

/// Uploads and draws everything, then empties the batch.
void batch_flush(struct batch *batch);

/// Calls glScissor for an area counted from the top of a framebuffer of `height` pixels.
void batch_apply_scissor(struct area area, int height);

#endif
