/// Draws a meadow: one strip of triangles, instanced for every reed.
#include "draw/stage.h"

enum { RINGS = 5, CORNERS = 2 * RINGS - 1, INDICES = 6 * (RINGS - 1) - 3 };

/// Joints from the ground at which a reed has corners; one at its tip.
static const float rings[RINGS] = {0, 2, 3.7f, 5, 6};

static void make_strip(struct stage_meadows *meadows)
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
    meadows->corners = gl_buffer(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    gl_attribute(0, 2, GL_FLOAT, sizeof corners[0], 0);
    meadows->indices = gl_buffer(GL_ELEMENT_ARRAY_BUFFER, sizeof indices, indices, GL_STATIC_DRAW);
}

/// What differs from reed to reed.
static void make_instances(struct stage_meadows *meadows)
{
    static const size_t offsets[] = {offsetof(struct stage_reed, place), offsetof(struct stage_reed, still),
                                     offsetof(struct stage_reed, pushed)};
    meadows->instances =
        gl_buffer(GL_ARRAY_BUFFER, STAGE_MAX_REEDS * sizeof(struct stage_reed), NULL, GL_STREAM_DRAW);
    for (GLuint i = 0; i < 3; i++) {
        gl_attribute(i + 1, 4, GL_FLOAT, sizeof(struct stage_reed), offsets[i]);
        glVertexAttribDivisor(i + 1, 1);
    }
}

void stage_meadows_create(struct stage_meadows *meadows)
{
    glGenVertexArrays(1, &meadows->vertex_array);
    glBindVertexArray(meadows->vertex_array);
    make_strip(meadows);
    make_instances(meadows);
    glBindVertexArray(0);
}

void stage_meadows_destroy(struct stage_meadows *meadows)
{
    glDeleteVertexArrays(1, &meadows->vertex_array);
    glDeleteBuffers(3, (const GLuint[]){meadows->corners, meadows->indices, meadows->instances});
}

long stage_meadows_upload(const struct stage_meadows *meadows, const struct stage_view *view)
{
    const size_t size = (size_t)view->meadow.count * sizeof *view->meadow.reeds;
    if (size == 0) return 0;
    glBindBuffer(GL_ARRAY_BUFFER, meadows->instances);
    glBufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)size, view->meadow.reeds);
    return (long)size;
}

void stage_meadows_draw(const struct stage_meadows *meadows, const struct program *program,
                        const struct stage_view *view)
{
    if (view->meadow.count == 0) return;
    program_use(program, view, 0.0f);
    glUniform2f(program->at[AT_BEND], view->meadow.lag, view->meadow.gain);
    glBindVertexArray(meadows->vertex_array);
    glDrawElementsInstanced(GL_TRIANGLES, INDICES, GL_UNSIGNED_SHORT, NULL, view->meadow.count);
    glBindVertexArray(0);
}
