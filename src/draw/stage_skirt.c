/// Draws the skirts of what the GPU moves.
#include "base/need.h"
#include "draw/skirt.h"
#include "model/adjacency.h"
#include "model/vector.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

enum { EDGES = 8192, CORNERS = 4 }; ///< that are drawn at once; of an edge
enum { PICTURE_UNIT = 1 };
enum { PLACE, NORMAL, COLOR, UV, PHASE, COVER }; ///< locations in stage_skirt.vert

/// Pixels that the skirt is nearer to the eye where the surface goes on: it may lean towards the eye.
static const float LIFT = 2.0f;

static void attribute(GLuint index, GLint size, size_t stride, size_t offset)
{
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, (GLsizei)stride, (const void *)offset);
}

/// Two triangles an edge.
static void upload_indices(uint16_t *indices)
{
    static const uint16_t quad[] = {0, 1, 2, 0, 2, 3};
    for (int i = 0; i < 6 * EDGES; i++) indices[i] = (uint16_t)(CORNERS * (i / 6) + quad[i % 6]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(6 * EDGES * sizeof *indices), indices, GL_STATIC_DRAW);
}

static void create_buffers(struct stage_skirt *skirt, uint16_t *indices)
{
    const size_t stride = sizeof(struct skirt_vertex);
    glGenVertexArrays(1, &skirt->vertex_array);
    glBindVertexArray(skirt->vertex_array);
    glGenBuffers(1, &skirt->buffer);
    glBindBuffer(GL_ARRAY_BUFFER, skirt->buffer);
    attribute(PLACE, 3, stride, offsetof(struct skirt_vertex, place));
    attribute(NORMAL, 3, stride, offsetof(struct skirt_vertex, normal));
    attribute(COLOR, 4, stride, offsetof(struct skirt_vertex, color));
    attribute(UV, 2, stride, offsetof(struct skirt_vertex, uv));
    attribute(PHASE, 2, stride, offsetof(struct skirt_vertex, phase));
    attribute(COVER, 1, stride, offsetof(struct skirt_vertex, cover));
    glGenBuffers(1, &skirt->indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, skirt->indices);
    upload_indices(indices);
    glBindVertexArray(0);
}

static bool create_plain(struct stage_skirt *skirt, struct error *error)
{
    const GLuint program = skirt->plain.program = gl_program("stage_skirt.vert", "stage_mesh.frag", NULL, error);
    if (!program) return false;
    skirt->plain.shade = glGetUniformLocation(program, "shade");
    skirt->plain.line = glGetUniformLocation(program, "line");
    skirt->plain.shared = painter_find_uniforms(program);
    glUseProgram(program);
    glUniform4f(glGetUniformLocation(program, "base"), 1.0f, 1.0f, 1.0f, 1.0f);
    return true;
}

void stage_plain_use(const struct stage_skirt *skirt, const struct stage_view *view, const float shade[2], float line)
{
    painter_use(skirt->plain.program, &skirt->plain.shared, view, 0.0f);
    glUniform2fv(skirt->plain.shade, 1, shade);
    glUniform1f(skirt->plain.line, line);
}

bool stage_skirt_create(struct stage_skirt *skirt, struct error *error)
{
    uint16_t *indices = need(6 * EDGES, sizeof *indices);
    *skirt = (struct stage_skirt){.vertices = need(CORNERS * EDGES, sizeof *skirt->vertices)};
    if (create_plain(skirt, error))
        skirt->program = gl_program("stage_skirt.vert", "stage_mesh.frag", "PICTURED", error);
    if (skirt->program) {
        skirt->shared = painter_find_uniforms(skirt->program);
        const struct gl_uniform uniforms[] = {
            {&skirt->at.shade, "shade"},           {&skirt->at.line, "line"},
            {&skirt->at.cutoff, "cutoff"},         {&skirt->at.blended, "blended"},
            {&skirt->at.both_sides, "both_sides"}, {&skirt->at.base, "base"},
        };
        gl_find_uniforms(skirt->program, uniforms, sizeof uniforms / sizeof *uniforms);
        glUseProgram(skirt->program);
        glUniform1i(glGetUniformLocation(skirt->program, "picture"), PICTURE_UNIT);
        skirt->white = gl_white();
        create_buffers(skirt, indices);
    } else {
        glDeleteProgram(skirt->plain.program);
        free(skirt->vertices);
    }
    free(indices);
    return skirt->program != 0;
}

void stage_skirt_destroy(struct stage_skirt *skirt)
{
    glDeleteProgram(skirt->program);
    glDeleteProgram(skirt->plain.program);
    glDeleteTextures(1, &skirt->white);
    glDeleteVertexArrays(1, &skirt->vertex_array);
    glDeleteBuffers(1, &skirt->buffer);
    glDeleteBuffers(1, &skirt->indices);
    free(skirt->vertices);
}

void stage_skirt_use(const struct stage_skirt *skirt, const struct stage_view *view, float seam)
{
    painter_use(skirt->program, &skirt->shared, view, seam);
    glUniform1i(skirt->at.blended, 0);
    glUniform1i(skirt->at.both_sides, 0);
    glUniform1f(skirt->at.cutoff, 0.0f);
    glUniform1f(skirt->at.line, 0.0f);
    glUniform4f(skirt->at.base, 1.0f, 1.0f, 1.0f, 1.0f);
    glVertexAttrib1f(COVER, 1.0f);
    glActiveTexture(GL_TEXTURE0 + PICTURE_UNIT);
    glBindTexture(GL_TEXTURE_2D, skirt->white);
}

void stage_skirt_leave(void)
{
    glBindSampler(PICTURE_UNIT, 0);
    glActiveTexture(GL_TEXTURE0);
}

static void draw_edges(const struct stage_skirt *skirt, int count)
{
    if (count == 0) return;
    glBindBuffer(GL_ARRAY_BUFFER, skirt->buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)(CORNERS * count) * sizeof *skirt->vertices), skirt->vertices,
                 GL_STREAM_DRAW);
    glDrawElements(GL_TRIANGLES, 6 * count, GL_UNSIGNED_SHORT, NULL);
}

/// The surface at one end of an edge; on its back turned to the eye.
static void look_at(const struct skirt_mesh *mesh, int corner, bool back, skirt_look *look, const void *context,
                    struct skirt_vertex *out)
{
    const uint32_t vertex = mesh->indices[corner];
    look(context, vertex, out);
    out->cover = 1.0f;
    for (int k = 0; k < 3; k++) {
        out->place[k] = mesh->place[vertex][k];
        if (back) out->normal[k] = -out->normal[k];
    }
}

/// Takes the place in the picture half a pixel back into the triangle: on its edge, what is read may come from the picture's other side.
static void pull_in(const struct skirt_mesh *mesh, int corner, const float eye[3], float seam, skirt_look *look,
                    const void *context, struct skirt_vertex ends[2])
{
    struct skirt_vertex third;
    const int opposite = next_corner(next_corner(corner));
    const float *place = mesh->place[mesh->indices[opposite]];
    const vec3s from = vec3_from(ends[0].place), edge = glms_vec3_sub(vec3_from(ends[1].place), from);
    const float area = glms_vec3_norm(glms_vec3_cross(edge, glms_vec3_sub(vec3_from(place), from)));
    const float pixel = seam * glms_vec3_distance(from, vec3_from(eye));
    const float share = fminf(0.5f * pixel * glms_vec3_norm(edge) / fmaxf(area, 1e-12f), 0.5f);
    look(context, mesh->indices[opposite], &third);
    for (int e = 0; e < 2; e++) {
        for (int k = 0; k < 2; k++) ends[e].uv[k] += share * (third.uv[k] - ends[e].uv[k]);
    }
}

/// Around the strip: along the edge on the surface, and back off it.
static void hang(const struct skirt_mesh *mesh, int corner, const float eye[3], float seam, skirt_look *look,
                 const void *context, struct skirt_vertex out[CORNERS])
{
    float normal[2][3], off[2][3];
    const bool back = !mesh->front[corner / 3];
    look_at(mesh, corner, back, look, context, &out[0]);
    look_at(mesh, next_corner(corner), back, look, context, &out[1]);
    pull_in(mesh, corner, eye, seam, look, context, out);
    for (int e = 0; e < 2; e++) memcpy(normal[e], out[e].normal, sizeof normal[e]);
    skirt_out(mesh, corner, (const float(*)[3])normal, eye, seam, off);
    for (int e = 0; e < 2; e++) {
        struct skirt_vertex *outer = &out[3 - e];
        *outer = out[e];
        outer->cover = 0.0f;
        for (int k = 0; k < 3; k++) outer->place[k] += off[e][k];
    }
    for (int c = 0; mesh->neighbours[corner] == NEIGHBOUR_CUT && c < CORNERS; c++) {
        for (int k = 0; k < 3; k++) out[c].place[k] += LIFT * seam * (eye[k] - out[c].place[k]);
    }
}

void stage_skirt_draw(const struct stage_skirt *skirt, const struct skirt_mesh *mesh, int first, int end,
                      bool both_sides, const float eye[3], float seam, skirt_look *look, const void *context)
{
    int count = 0;
    glBindVertexArray(skirt->vertex_array);
    glDisable(GL_CULL_FACE);
    for (int i = skirt_next(mesh, first, end, both_sides); i < end; i = skirt_next(mesh, i + 1, end, both_sides)) {
        hang(mesh, i, eye, seam, look, context, skirt->vertices + CORNERS * count);
        if (++count < EDGES) continue;
        draw_edges(skirt, count);
        count = 0;
    }
    draw_edges(skirt, count);
    glEnable(GL_CULL_FACE);
}

void stage_surface_create(struct stage_surface *surface, int count, const struct surface_look *looks)
{
    const size_t stride = sizeof *looks;
    surface->count = count;
    glGenVertexArrays(1, &surface->vertex_array);
    glBindVertexArray(surface->vertex_array);
    glGenBuffers(1, &surface->moving);
    glBindBuffer(GL_ARRAY_BUFFER, surface->moving);
    attribute(PLACE, 3, 0, 0);
    attribute(NORMAL, 3, 0, (size_t)count * sizeof(float[3]));
    glGenBuffers(1, &surface->looks);
    stage_surface_show(surface, looks);
    attribute(COLOR, 4, stride, offsetof(struct surface_look, color));
    attribute(UV, 2, stride, offsetof(struct surface_look, uv));
    attribute(PHASE, 2, stride, offsetof(struct surface_look, phase));
    glBindVertexArray(0);
}

void stage_surface_free(struct stage_surface *surface)
{
    glDeleteVertexArrays(1, &surface->vertex_array);
    glDeleteBuffers(1, &surface->moving);
    glDeleteBuffers(1, &surface->looks);
}

long stage_surface_move(const struct stage_surface *surface, const float (*place)[3], const float (*normal)[3])
{
    const GLsizeiptr half = (GLsizeiptr)((size_t)surface->count * sizeof *place);
    glBindBuffer(GL_ARRAY_BUFFER, surface->moving);
    glBufferData(GL_ARRAY_BUFFER, 2 * half, NULL, GL_STREAM_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, 0, half, place);
    glBufferSubData(GL_ARRAY_BUFFER, half, half, normal);
    return 2 * (long)half;
}

long stage_surface_show(const struct stage_surface *surface, const struct surface_look *looks)
{
    const GLsizeiptr bytes = (GLsizeiptr)((size_t)surface->count * sizeof *looks);
    glBindBuffer(GL_ARRAY_BUFFER, surface->looks);
    glBufferData(GL_ARRAY_BUFFER, bytes, looks, GL_STATIC_DRAW);
    return (long)bytes;
}
