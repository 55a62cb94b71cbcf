/// Draws background, ground and contact shadows.
#include "base/need.h"
#include "draw/stage.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#define GROUND_RADIUS 3.5f

// Figures between these sizes, in metres, get the same ground; it scales with smaller and larger ones.
static const float SMALL = 0.2f, LARGE = 5.0f;

enum {
    CORNERS = 6,
    SCENERY = 2, ///< background and ground, which come first
    MAX_QUADS = SCENERY + STAGE_MAX_BLOBS,
};

struct corner {
    float clip[4];
    float local[2]; ///< −1 … 1 across the disc's square
    float color[4]; ///< sRGB and opacity
};

struct stage_flat {
    GLuint vertex_array, vertices;
    struct stage_colors colors;
    int quads;
    struct corner corners[MAX_QUADS * CORNERS];
};

/// Corners of two triangles.
static const float square[CORNERS][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};

struct stage_flat *stage_flat_create(void)
{
    struct stage_flat *flat = need_zeroed(1, sizeof *flat);
    glGenVertexArrays(1, &flat->vertex_array);
    glBindVertexArray(flat->vertex_array);
    flat->vertices = gl_buffer(GL_ARRAY_BUFFER, sizeof flat->corners, NULL, GL_DYNAMIC_DRAW);
    gl_attribute(0, 4, GL_FLOAT, sizeof(struct corner), offsetof(struct corner, clip));
    gl_attribute(1, 2, GL_FLOAT, sizeof(struct corner), offsetof(struct corner, local));
    gl_attribute(2, 4, GL_FLOAT, sizeof(struct corner), offsetof(struct corner, color));
    glBindVertexArray(0);
    return flat;
}

void stage_flat_destroy(struct stage_flat *flat)
{
    glDeleteVertexArrays(1, &flat->vertex_array);
    glDeleteBuffers(1, &flat->vertices);
    free(flat);
}

static float ground_radius(const struct stage_view *view)
{
    float largest = 0.0f;
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < view->character_count; c++) {
            const struct figure *figure = view->characters[c].figure;
            largest = fmaxf(largest, figure->hi[k] - figure->lo[k]);
        }
        for (int m = 0; m < view->model_count; m++)
            largest = fmaxf(largest, view->models[m].hi[k] - view->models[m].lo[k]);
    }
    const float scale = largest > LARGE ? largest / LARGE : largest > 0.0f ? fminf(largest / SMALL, 1.0f) : 1.0f;
    return view->has_tail ? fmaxf(GROUND_RADIUS, GROUND_RADIUS * scale) : GROUND_RADIUS * scale;
}

static void set_color(struct corner *corner, uint32_t color, float opacity)
{
    for (int k = 0; k < 3; k++) corner->color[k] = (float)(color >> (24 - 8 * k) & 0xFF) / 255.0f;
    corner->color[3] = opacity;
}

static void add_background(struct stage_flat *flat)
{
    for (int c = 0; c < CORNERS; c++) {
        flat->corners[flat->quads * CORNERS + c] = (struct corner){.clip = {square[c][0], square[c][1], 0.0f, 1.0f}};
    }
    flat->quads++;
}

static void add_disc(struct stage_flat *flat, mat4s clip_from_world, float x, float ground, float z, float radius,
                     uint32_t color, float opacity)
{
    for (int c = 0; c < CORNERS; c++) {
        struct corner *corner = &flat->corners[flat->quads * CORNERS + c];
        const vec4s world = {{x + radius * square[c][0], ground, z + radius * square[c][1], 1.0f}};
        vec4s clip = glms_mat4_mulv(clip_from_world, world);
        *corner = (struct corner){.local = {square[c][0], square[c][1]}};
        glm_vec4_copy(clip.raw, corner->clip);
        set_color(corner, color, opacity);
    }
    flat->quads++;
}

long stage_flat_upload(struct stage_flat *flat, const struct stage_view *view)
{
    const float ground = stage_lowest_ground(view);
    const mat4s clip_from_world = stage_clip_from_world(view);
    flat->quads = 0;
    flat->colors = view->colors;
    add_background(flat);
    add_disc(flat, clip_from_world, view->middle[0], ground, view->middle[1], ground_radius(view),
             view->colors.ground, 1.0f);
    for (int b = 0; b < view->blob_count; b++) {
        const struct shadow_blob *blob = &view->blobs[b];
        add_disc(flat, clip_from_world, blob->x, ground, blob->z, blob->radius, view->colors.shadow, blob->strength);
    }
    const long bytes = flat->quads * CORNERS * (long)sizeof *flat->corners;
    glBindBuffer(GL_ARRAY_BUFFER, flat->vertices);
    glBufferSubData(GL_ARRAY_BUFFER, 0, bytes, flat->corners);
    return bytes;
}

static void set_srgb(GLint location, uint32_t color)
{
    struct corner corner;
    set_color(&corner, color, 1.0f);
    glUniform3fv(location, 1, corner.color);
}

void stage_flat_draw(const struct stage_flat *flat, const struct program *program, int y, int height)
{
    glUseProgram(program->name);
    set_srgb(program->at[AT_TOP], flat->colors.top);
    set_srgb(program->at[AT_BOTTOM], flat->colors.bottom);
    glUniform2f(program->at[AT_ROWS], (float)y, 1.0f / (float)height);
    glUniform1i(program->at[AT_SHADOW], false);
    glBindVertexArray(flat->vertex_array);
    glEnable(GL_BLEND);
    glDepthFunc(GL_ALWAYS);
    glDepthRange(1, 1); // makes the quad write the largest depth, which clears it
    glDrawArrays(GL_TRIANGLES, 0, SCENERY * CORNERS);
    glUniform1i(program->at[AT_SHADOW], true);
    glDrawArrays(GL_TRIANGLES, SCENERY * CORNERS, (flat->quads - SCENERY) * CORNERS);
    glDisable(GL_BLEND);
    glDepthRange(0, 1);
    glBindVertexArray(0);
}
