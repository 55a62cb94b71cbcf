/// Draws a meadow: one triangle strip, instanced per reed. Reeds are about one pixel wide, so they are sorted far to near and blended by
/// coverage.
#include "draw/stage.h"

enum { RINGS = 5, CORNERS = 2 * RINGS, INDICES = 6 * (RINGS - 1) };
enum { DEPTHS = 2048 }; ///< depth classes for sorting

/// Ring positions along a reed, in joints from the ground.
static const float rings[RINGS] = {0, 2, 3.7f, 5, 6};

static void make_strip(struct stage_meadows *meadows)
{
    float corners[CORNERS][2];
    GLushort indices[INDICES], *next = indices;
    for (int c = 0; c < CORNERS; c++) {
        corners[c][0] = rings[c / 2];
        corners[c][1] = (float)(c % 2 * 2 - 1);
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

/// Attributes of a reed.
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

/// Depth class of a reed's foot; the farthest is 0.
static int depth_of(const struct stage_view *view, const struct stage_reed *reed, float nearest, float farthest)
{
    const float *m = view->view, *p = reed->place, depth = -(m[2] * p[0] + m[6] * p[1] + m[10] * p[2] + m[14]);
    const float share = (farthest - depth) / fmaxf(farthest - nearest, 1e-6f);
    return (int)(fminf(fmaxf(share, 0), 1) * (DEPTHS - 1));
}

/// Counting sort by depth.
static void sort(struct stage_reed *sorted, const struct stage_view *view)
{
    const struct stage_meadow *meadow = &view->meadow;
    const float *m = view->view, *lo = meadow->lo, *hi = meadow->hi;
    const float middle = -(m[2] * (lo[0] + hi[0]) / 2 + m[10] * (lo[2] + hi[2]) / 2 + m[14]);
    const float half = fabsf(m[2]) * (hi[0] - lo[0]) / 2 + fabsf(m[10]) * (hi[2] - lo[2]) / 2;
    int next[DEPTHS + 1] = {0};
    for (int r = 0; r < meadow->count; r++)
        next[depth_of(view, &meadow->reeds[r], middle - half, middle + half) + 1]++;
    for (int d = 0; d < DEPTHS; d++) next[d + 1] += next[d];
    for (int r = 0; r < meadow->count; r++)
        sorted[next[depth_of(view, &meadow->reeds[r], middle - half, middle + half)]++] = meadow->reeds[r];
}

long stage_meadows_upload(struct stage_meadows *meadows, const struct stage_view *view)
{
    const size_t size = (size_t)view->meadow.count * sizeof *view->meadow.reeds;
    if (size == 0) return 0;
    sort(meadows->sorted, view);
    glBindBuffer(GL_ARRAY_BUFFER, meadows->instances);
    glBufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)size, meadows->sorted);
    return (long)size;
}

void stage_meadows_draw(const struct stage_meadows *meadows, const struct program *program,
                        const struct stage_view *view, float seam)
{
    if (view->meadow.count == 0) return;
    program_use(program, view, seam);
    glUniform2f(program->at[AT_BEND], view->meadow.lag, view->meadow.gain);
    if (seam > 0) glEnable(GL_BLEND);
    glBindVertexArray(meadows->vertex_array);
    glDrawElementsInstanced(GL_TRIANGLES, INDICES, GL_UNSIGNED_SHORT, NULL, view->meadow.count);
    glDisable(GL_BLEND);
    glBindVertexArray(0);
}
