/// Collects triangles and draws them in order with few calls.
#include "draw/batch.h"
#include "base/need.h"
#include "base/progress.h"
#include <stddef.h>
#include <stdlib.h>

static void create_buffers(struct batch *batch)
{
    const size_t stride = sizeof(struct batch_vertex);
    glGenVertexArrays(1, &batch->array);
    glGenBuffers(1, &batch->vertex_buffer);
    glGenBuffers(1, &batch->index_buffer);
    glBindVertexArray(batch->array);
    glBindBuffer(GL_ARRAY_BUFFER, batch->vertex_buffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, batch->index_buffer);
    gl_attribute(0, 2, GL_FLOAT, stride, offsetof(struct batch_vertex, x));
    gl_attribute(1, 2, GL_FLOAT, stride, offsetof(struct batch_vertex, u));
    gl_attribute(2, 4, GL_UNSIGNED_BYTE, stride, offsetof(struct batch_vertex, color));
    gl_attribute(3, 3, GL_FLOAT, stride, offsetof(struct batch_vertex, across));
    glBindVertexArray(0);
}

bool batch_create(struct batch *batch, struct error *error)
{
    *batch = (struct batch){
        .vertices = need_zeroed(BATCH_VERTICES, sizeof *batch->vertices),
        .indices = need_zeroed(BATCH_INDICES, sizeof *batch->indices),
        .parts = need_zeroed(BATCH_PARTS, sizeof *batch->parts),
    };
    batch->program = gl_program("ui.vert", "ui.frag", NULL, error);
    if (!batch->program) {
        batch_destroy(batch);
        return false;
    }
    batch->framebuffer_uniform = glGetUniformLocation(batch->program, "framebuffer");
    batch->atlas_size_uniform = glGetUniformLocation(batch->program, "atlas_size");
    create_buffers(batch);
    return true;
}

void batch_destroy(struct batch *batch)
{
    if (batch->program) {
        glDeleteProgram(batch->program);
        glDeleteVertexArrays(1, &batch->array);
        glDeleteBuffers(1, &batch->vertex_buffer);
        glDeleteBuffers(1, &batch->index_buffer);
    }
    free(batch->vertices);
    free(batch->indices);
    free(batch->parts);
    *batch = (struct batch){0};
}

void batch_begin(struct batch *batch, int width, int height, GLuint texture, int texture_width, int texture_height)
{
    batch->vertex_count = batch->index_count = batch->part_count = 0;
    batch->generation++;
    batch->width = width;
    batch->height = height;
    batch->texture = texture;
    batch->texture_width = texture_width;
    batch->texture_height = texture_height;
    batch->upload_us = 0.0;
    batch->uploaded_bytes = 0;
    batch->scissor = (struct area){0, 0, width, height};
}

static bool same_area(struct area a, struct area b)
{
    return a.x0 == b.x0 && a.y0 == b.y0 && a.x1 == b.x1 && a.y1 == b.y1;
}

/// Ends the current part after the indices so far.
static void close_part(struct batch *batch)
{
    if (batch->part_count == 0) return;
    struct batch_part *last = &batch->parts[batch->part_count - 1];
    if (!last->is_fill) last->count = batch->index_count - last->first;
}

/// Starts a new part; there must be room.
static struct batch_part *open_part(struct batch *batch)
{
    close_part(batch);
    if (batch->part_count == BATCH_PARTS) batch_flush(batch);
    struct batch_part *part = &batch->parts[batch->part_count++];
    *part = (struct batch_part){.scissor = batch->scissor, .first = batch->index_count};
    return part;
}

void batch_fill(struct batch *batch, struct area area, uint32_t color)
{
    struct area visible = area_intersect(area, batch->scissor);
    if (area_empty(visible)) return;
    struct batch_part *part = open_part(batch);
    part->scissor = visible;
    part->is_fill = true;
    part->fill = color;
}

uint32_t batch_reserve(struct batch *batch, int vertices, int indices)
{
    if (vertices > BATCH_VERTICES - batch->vertex_count || indices > BATCH_INDICES - batch->index_count)
        batch_flush(batch);
    const struct batch_part *last = batch->part_count ? &batch->parts[batch->part_count - 1] : NULL;
    if (!last || last->is_fill || !same_area(last->scissor, batch->scissor)) open_part(batch);
    return (uint32_t)batch->vertex_count;
}

void batch_apply_scissor(struct area area, int height)
{
    glScissor(area.x0, height - area.y1, area.x1 - area.x0, area.y1 - area.y0);
}

static void upload(struct batch *batch)
{
    double start = clock_now();
    size_t vertex_bytes = (size_t)batch->vertex_count * sizeof *batch->vertices;
    size_t index_bytes = (size_t)batch->index_count * sizeof *batch->indices;
    // New storage each time, so that the driver need not wait until the GPU has read the old one.
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)vertex_bytes, batch->vertices, GL_STREAM_DRAW);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)index_bytes, batch->indices, GL_STREAM_DRAW);
    batch->uploaded_bytes += (long)(vertex_bytes + index_bytes);
    batch->upload_us += 1e6 * (clock_now() - start);
}

static void set_state(const struct batch *batch)
{
    glViewport(0, 0, batch->width, batch->height);
    glUseProgram(batch->program);
    glUniform2f(batch->framebuffer_uniform, (float)batch->width, (float)batch->height);
    glUniform2f(batch->atlas_size_uniform, (float)batch->texture_width, (float)batch->texture_height);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, batch->texture);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

static float channel(uint32_t color, int shift) { return (float)(color >> shift & 0xFFu) / 255.0f; }

static void draw_part(const struct batch *batch, const struct batch_part *part)
{
    batch_apply_scissor(part->scissor, batch->height);
    if (part->is_fill) {
        glClearColor(channel(part->fill, 24), channel(part->fill, 16), channel(part->fill, 8),
                     channel(part->fill, 0));
        glClear(GL_COLOR_BUFFER_BIT);
    } else if (part->count > 0) {
        const void *offset = (const void *)((size_t)part->first * sizeof *batch->indices);
        glDrawElements(GL_TRIANGLES, part->count, GL_UNSIGNED_INT, offset);
    }
}

void batch_flush(struct batch *batch)
{
    close_part(batch);
    if (batch->part_count > 0) {
        glBindVertexArray(batch->array);
        glBindBuffer(GL_ARRAY_BUFFER, batch->vertex_buffer);
        upload(batch);
        set_state(batch);
        for (int i = 0; i < batch->part_count; i++) draw_part(batch, &batch->parts[i]);
        glBindVertexArray(0);
        glDisable(GL_BLEND);
    }
    batch->vertex_count = batch->index_count = batch->part_count = 0;
    batch->generation++;
}
