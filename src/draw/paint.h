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

/// Uploads and draws everything, then empties the batch.
void batch_flush(struct batch *batch);

// Draw lists.

enum { LINE_POINTS = 8192 };

struct line_point {
    float x, y;
    float along; ///< distance from the nearer end + 1/2, or 1 if the line is closed
};

/// Working memory: a line in device pixels, and one of its dashes.
struct line_scratch {
    struct line_point points[LINE_POINTS], dash[LINE_POINTS];
};

struct painter {
    struct batch *batch;
    struct line_scratch *scratch;
    const struct atlas *atlas;
    float scale;
};

/// Adds every command that touches `area`, in order and clipped to it.
void paint_list(const struct painter *painter, const struct drawlist *list, struct area area);

#endif
