/// Draws a meadow: one strip of triangles, instanced for every reed.
#include "base/need.h"
#include "draw/painter.h"
#include "draw/stage.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

enum { RINGS = 5, CORNERS = 2 * RINGS - 1, INDICES = 6 * (RINGS - 1) - 3 };

/// Joints from the ground at which a reed has corners; one at its tip.
static const float rings[RINGS] = {0, 2, 3.7f, 5, 6};

struct reeds {
    GLuint program, vertex_array, corners, indices, instances;
    GLint bend;
    struct painter_uniforms shared;
};

static void make_strip(struct reeds *painter)
{
    float corners[CORNERS][2];
    GLushort indices[INDICES], *next = indices;
    for (int c = 0; c < CORNERS; c++) {
        corners[c][0] = rings[c / 2];
        corners[c][1] = c + 1 == CORNERS ? 0.0f : (float)(c % 2 * 2 - 1);
    }
    for (int c = 0; c + 2 < CORNERS; c++) {
        *next++ = (GLushort)c;
        *next++ = (GLushort)(c + 1 + c % 2);
        *next++ = (GLushort)(c + 2 - c % 2);
    }
    glGenBuffers(1, &painter->corners);
    glBindBuffer(GL_ARRAY_BUFFER, painter->corners);
    glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof corners[0], NULL);
    glGenBuffers(1, &painter->indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, painter->indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof indices, indices, GL_STATIC_DRAW);
}

/// What differs from reed to reed.
static void make_instances(struct reeds *painter)
{
    static const size_t offsets[] = {offsetof(struct stage_reed, place), offsetof(struct stage_reed, still),
                                     offsetof(struct stage_reed, pushed)};
    glGenBuffers(1, &painter->instances);
    glBindBuffer(GL_ARRAY_BUFFER, painter->instances);
    glBufferData(GL_ARRAY_BUFFER, STAGE_MAX_REEDS * sizeof(struct stage_reed), NULL, GL_STREAM_DRAW);
    for (GLuint i = 0; i < 3; i++) {
        glEnableVertexAttribArray(i + 1);
        glVertexAttribPointer(i + 1, 4, GL_FLOAT, GL_FALSE, sizeof(struct stage_reed), (const void *)offsets[i]);
        glVertexAttribDivisor(i + 1, 1);
    }
}

static void destroy(void *state)
{
    struct reeds *painter = state;
    glDeleteVertexArrays(1, &painter->vertex_array);
    glDeleteBuffers(1, &painter->corners);
    glDeleteBuffers(1, &painter->indices);
    glDeleteBuffers(1, &painter->instances);
    if (painter->program) glDeleteProgram(painter->program);
    free(painter);
}

static void *create(struct error *error)
{
    struct reeds *painter = need_zeroed(1, sizeof *painter);
    painter->program = gl_program("stage_meadow.vert", "stage_mesh.frag", NULL, error);
    if (!painter->program) {
        free(painter);
        return NULL;
    }
    painter->bend = glGetUniformLocation(painter->program, "bend");
    painter->shared = painter_find_uniforms(painter->program);
    glGenVertexArrays(1, &painter->vertex_array);
    glBindVertexArray(painter->vertex_array);
    make_strip(painter);
    make_instances(painter);
    glBindVertexArray(0);
    return painter;
}

static void upload(void *state, const struct stage_view *view, long *bytes)
{
    const struct reeds *painter = state;
    const size_t size = (size_t)view->meadow.count * sizeof *view->meadow.reeds;
    if (size == 0) return;
    glBindBuffer(GL_ARRAY_BUFFER, painter->instances);
    glBufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)size, view->meadow.reeds);
    *bytes += (long)size;
}

static void draw(const void *state, const struct stage_view *view, float scale, float seam)
{
    const struct reeds *painter = state;
    (void)scale;
    if (view->meadow.count == 0 || seam > 0) return; // too thin for a second skin
    painter_use(painter->program, &painter->shared, view, seam);
    glUniform2f(painter->bend, view->meadow.lag, view->meadow.gain);
    glBindVertexArray(painter->vertex_array);
    glDrawElementsInstanced(GL_TRIANGLES, INDICES, GL_UNSIGNED_SHORT, NULL, view->meadow.count);
    glBindVertexArray(0);
}

static float ground(const struct stage_view *view) { return view->meadow.count > 0 ? 0 : INFINITY; }

static void add_extent(const struct stage_view *view, struct extent *extent)
{
    if (view->meadow.count > 0) extent_add_box(extent, view->meadow.lo, view->meadow.hi);
}

const struct painter meadow_painter = {create, destroy, upload, draw, ground, add_extent};
