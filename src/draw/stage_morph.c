/// Moves soft characters on the GPU, by complex morphs.
#include "base/need.h"
#include "draw/painter.h"
#include "draw/skirt.h"
#include "draw/stage.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    TEXELS = 5,                  ///< of one vertex and coordinate, four floats each
    ROW_VERTICES = FIGURE_BLOCK, ///< in one row of the texture
    ROW_FLOATS = 4 * TEXELS * ROW_VERTICES,
    MAX_KEPT = 4, ///< figures kept on the GPU; the least recently used goes
    SLOPE_FLOATS = sizeof(struct slope) / sizeof(float),
};

static const float PHASE_LINE = 1.25f; ///< logical pixels

/// A figure's buffers.
struct model {
    uint64_t id; ///< 0: free
    long used;   ///< when it was drawn last
    GLuint vertex_array, vertices, fine, coarse, coordinates;
    GLsizei fine_count, coarse_count;
    int rows;         ///< of the texture, for one coordinate
    uint64_t version; ///< of the figure that is in it
    struct morph_looks looks;
    struct morph_skirt skirt;
};

/// Skins of vertex colours and phase maps; and those with materials.
enum { PLAIN, PICTURED, PROGRAMS };
enum { COORDINATES_UNIT = 0, PICTURE_UNIT = 1 };

struct morph_program {
    GLuint program;
    struct painter_uniforms shared;
    struct {
        GLint place, shade, count, first_row, weight, map_row, map_axis, dark, line, base, blended;
    } at;
};

struct stage_morph {
    struct morph_program programs[PROGRAMS];
    struct stage_skirt skirt;
    struct model models[MAX_KEPT];
    long clock;
};

static bool program_create(struct morph_program *morph, const char *define, struct error *error)
{
    morph->program = gl_program("stage_character.vert", "stage_mesh.frag", define, error);
    if (!morph->program) return false;
    const struct gl_uniform uniforms[] = {
        {&morph->at.place, "place"},         {&morph->at.shade, "shade"},     {&morph->at.count, "count"},
        {&morph->at.first_row, "first_row"}, {&morph->at.weight, "weight"},   {&morph->at.map_row, "map_row"},
        {&morph->at.map_axis, "map_axis"},   {&morph->at.line, "line"},       {&morph->at.base, "base"},
        {&morph->at.dark, "dark"},           {&morph->at.blended, "blended"},
    };
    gl_find_uniforms(morph->program, uniforms, sizeof uniforms / sizeof *uniforms);
    morph->shared = painter_find_uniforms(morph->program);
    glUseProgram(morph->program);
    glUniform1i(glGetUniformLocation(morph->program, "coordinates"), COORDINATES_UNIT);
    glUniform1i(glGetUniformLocation(morph->program, "picture"), PICTURE_UNIT);
    return true;
}

static void *create(struct error *error)
{
    struct stage_morph *morph = need_zeroed(1, sizeof *morph);
    if (program_create(&morph->programs[PLAIN], NULL, error) &&
        program_create(&morph->programs[PICTURED], "PICTURED", error) && stage_skirt_create(&morph->skirt, error))
        return morph;
    for (int p = 0; p < PROGRAMS; p++) glDeleteProgram(morph->programs[p].program);
    free(morph);
    return NULL;
}

static void model_free(struct model *model)
{
    glDeleteVertexArrays(1, &model->vertex_array);
    glDeleteBuffers(1, &model->vertices);
    glDeleteBuffers(1, &model->fine);
    glDeleteBuffers(1, &model->coarse);
    glDeleteTextures(1, &model->coordinates);
    morph_looks_free(&model->looks);
    morph_skirt_free(&model->skirt);
    *model = (struct model){0};
}

static void destroy(void *state)
{
    struct stage_morph *morph = state;
    for (int i = 0; i < MAX_KEPT; i++) model_free(&morph->models[i]);
    for (int p = 0; p < PROGRAMS; p++) glDeleteProgram(morph->programs[p].program);
    stage_skirt_destroy(&morph->skirt);
    free(morph);
}

/// A row of the texture: what stage_character.vert reads. Zero where it is not full.
static void pack_row(const struct figure *figure, int coordinate, int row, float texels[ROW_FLOATS])
{
    const struct character *c = &figure->character;
    const int first = row * ROW_VERTICES, left = c->vertex_count - first;
    const int count = left < ROW_VERTICES ? left : ROW_VERTICES;
    for (int i = 0; i < count; i++) {
        float *out = texels + 4 * TEXELS * i;
        memcpy(out, c->coordinates[coordinate].re[first + i], 3 * sizeof *out);
        memcpy(out + 3, c->coordinates[coordinate].im[first + i], 3 * sizeof *out);
        memcpy(out + 6, &figure->slopes[coordinate * c->vertex_count + first + i], SLOPE_FLOATS * sizeof *out);
    }
    memset(texels + 4 * TEXELS * count, 0, (size_t)(ROW_VERTICES - count) * 4 * TEXELS * sizeof *texels);
}

bool stage_morph_fits(const struct figure *figure, int largest, struct error *error)
{
    const struct character *c = &figure->character;
    const int rows = figure_blocks(figure) * c->coordinate_count + 1;
    if (rows <= largest && TEXELS * ROW_VERTICES <= largest) return true;
    return fail(
        error, ERROR_ENVIRONMENT,
        "%d vertices with %d coordinates need a texture of %d × %d, this OpenGL driver takes %d: it stands still",
        c->vertex_count, c->coordinate_count, TEXELS * ROW_VERTICES, rows, largest);
}

static long upload_coordinates(struct model *model, const struct figure *figure)
{
    const struct character *c = &figure->character;
    const int width = TEXELS * ROW_VERTICES;
    model->rows = figure_blocks(figure);
    const int height = model->rows * c->coordinate_count;
    const size_t bytes = (size_t)width * (size_t)(height + 1) * 4 * sizeof(float);
    if (!stage_morph_fits(figure, gl_largest_texture(), NULL)) return 0; // drawn at rest
    float *texels = need_zeroed(1, bytes);
    for (int row = 0; row < height; row++)
        pack_row(figure, row / model->rows, row % model->rows, texels + (size_t)row * ROW_FLOATS);
    glGenTextures(1, &model->coordinates);
    glBindTexture(GL_TEXTURE_2D, model->coordinates);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height + 1, 0, GL_RGBA, GL_FLOAT, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    free(texels);
    return (long)bytes;
}

/// Uploads the rows of a painted figure that changed since the last time.
static long upload_changes(struct model *model, const struct figure *figure)
{
    float texels[ROW_FLOATS];
    long bytes = 0;
    if (!model->coordinates || !figure->changed || figure->version == model->version) return 0;
    glBindTexture(GL_TEXTURE_2D, model->coordinates);
    for (int row = 0; row < model->rows * figure->character.coordinate_count; row++) {
        if (figure->changed[row] <= model->version) continue;
        pack_row(figure, row / model->rows, row % model->rows, texels);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, row, TEXELS * ROW_VERTICES, 1, GL_RGBA, GL_FLOAT, texels);
        bytes += (long)sizeof texels;
    }
    model->version = figure->version;
    return bytes;
}

static GLuint upload_buffer(GLenum target, size_t bytes, const void *data)
{
    GLuint buffer;
    glGenBuffers(1, &buffer);
    glBindBuffer(target, buffer);
    glBufferData(target, (GLsizeiptr)bytes, data, GL_STATIC_DRAW);
    return buffer;
}

/// Uploads the four arrays of vectors one after the other, then texture coordinates.
static long upload_vertices(struct model *model, const struct figure *figure)
{
    const struct character *c = &figure->character;
    const size_t bytes = 3 * sizeof(float) * (size_t)c->vertex_count;
    const size_t uv = c->looks.uv && !c->looks.corner ? 2 * sizeof(float) * (size_t)c->vertex_count : 0;
    const void *const arrays[] = {c->position, c->normal, figure->tangent, c->color};
    model->vertices = upload_buffer(GL_ARRAY_BUFFER, 4 * bytes + uv, NULL);
    char *out = glMapBufferRange(GL_ARRAY_BUFFER, 0, (GLsizeiptr)(4 * bytes + uv),
                                 GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (out && uv) memcpy(out + 4 * bytes, c->looks.uv, uv);
    if (uv) {
        glEnableVertexAttribArray(4);
        glVertexAttribPointer(4, 2, GL_FLOAT, GL_FALSE, 0, (const void *)(4 * bytes));
    }
    for (GLuint a = 0; a < 4; a++) {
        if (out) memcpy(out + a * bytes, arrays[a], bytes);
        glEnableVertexAttribArray(a);
        glVertexAttribPointer(a, 3, GL_FLOAT, GL_FALSE, 0, (const void *)(a * bytes));
    }
    glUnmapBuffer(GL_ARRAY_BUFFER);
    return (long)(4 * bytes + uv);
}

/// The fine or the coarse triangles, sorted by material if that is to be seen.
static GLuint upload_triangles(struct model *model, const struct figure *figure, bool coarse)
{
    const struct character *c = &figure->character;
    const size_t count = (size_t)(coarse ? figure->coarse_count : c->index_count);
    uint32_t *sorted = model->looks.range_count > 0 ? morph_looks_sort(&model->looks, figure, coarse) : NULL;
    if (!sorted) morph_looks_free(&model->looks);
    const uint32_t *indices = coarse ? figure->coarse : c->indices;
    const GLuint buffer = upload_buffer(GL_ELEMENT_ARRAY_BUFFER, sizeof *sorted * count, sorted ? sorted : indices);
    model->skirt.sorted[coarse] = sorted;
    return buffer;
}

static long model_upload(struct model *model, const struct figure *figure)
{
    const struct character *c = &figure->character;
    const size_t fine = sizeof(uint32_t) * (size_t)c->index_count;
    const size_t coarse = sizeof(uint32_t) * (size_t)figure->coarse_count;
    *model = (struct model){.id = figure->id,
                            .version = figure->version,
                            .fine_count = c->index_count,
                            .coarse_count = figure->coarse_count};
    glGenVertexArrays(1, &model->vertex_array);
    glBindVertexArray(model->vertex_array);
    long bytes = upload_vertices(model, figure) + upload_coordinates(model, figure) +
                 morph_looks_create(&model->looks, figure);
    model->coarse = upload_triangles(model, figure, true);
    model->fine = upload_triangles(model, figure, false);
    glBindVertexArray(0);
    morph_skirt_create(&model->skirt, figure, &model->looks);
    return bytes + (long)(fine + coarse);
}

/// The figure's model or, if it has none, the least recently drawn one.
static struct model *find_model(struct stage_morph *morph, const struct figure *figure)
{
    struct model *oldest = &morph->models[0];
    for (int i = 0; i < MAX_KEPT; i++) {
        struct model *model = &morph->models[i];
        if (model->id == figure->id) return model;
        if (model->used < oldest->used) oldest = model;
    }
    return oldest;
}

static void upload(void *state, const struct stage_view *view, long *bytes)
{
    struct stage_morph *morph = state;
    morph->clock++;
    for (int i = 0; i < view->character_count; i++) {
        const struct figure *figure = view->characters[i].figure;
        struct model *model = find_model(morph, figure);
        if (model->id != figure->id && model->used < morph->clock) {
            model_free(model);
            *bytes += model_upload(model, figure);
        }
        if (model->id == figure->id) *bytes += upload_changes(model, figure);
        model->used = morph->clock;
    }
}

/// What is seen through comes last, blended.
static void draw_ranges(const struct morph_program *morph, const struct model *model, bool coarse, bool blended)
{
    for (int r = 0; r < model->looks.range_count; r++) {
        const struct morph_range *range = &model->looks.ranges[coarse][r];
        if (range->count == 0 || (range->color[3] < 1) != blended) continue;
        glUniform4fv(morph->at.base, 1, range->color);
        glUniform1i(morph->at.blended, blended);
        glBindTexture(GL_TEXTURE_2D, range->picture);
        glDrawElements(GL_TRIANGLES, range->count, GL_UNSIGNED_INT,
                       (const void *)((size_t)range->first * sizeof(uint32_t)));
    }
}

static void draw_pictured(const struct morph_program *morph, const struct model *model, bool coarse)
{
    glActiveTexture(GL_TEXTURE0 + PICTURE_UNIT);
    draw_ranges(morph, model, coarse, false);
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    draw_ranges(morph, model, coarse, true);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glActiveTexture(GL_TEXTURE0 + COORDINATES_UNIT);
}

static int program_of(const struct model *model, const struct stage_character *shown)
{
    return model->looks.range_count > 0 && shown->map_coordinate < 0 ? PICTURED : PLAIN;
}

/// Heights: of the ground, and of the dusk above it.
static void set_shade(GLint at, const struct stage_character *shown)
{
    glUniform2f(at, shown->position[1], 0.3f * (shown->figure->hi[1] - shown->figure->lo[1]));
}

static void draw_character(const struct morph_program *morph, const struct model *model,
                           const struct stage_character *shown, float scale)
{
    const struct figure *figure = shown->figure;
    const float *p = shown->position;
    GLint first_row[MORPH_MAX_COORDINATES] = {0};
    float axis[3] = {0};
    for (int k = 0; k < shown->morph.count; k++) first_row[k] = model->rows * shown->morph.coordinate[k];
    glUniform3f(morph->at.place, p[0], p[1] - figure->lo[1], p[2]);
    set_shade(morph->at.shade, shown);
    glUniform1i(morph->at.count, model->coordinates ? shown->morph.count : 0);
    glUniform1iv(morph->at.first_row, MORPH_MAX_COORDINATES, first_row);
    glUniform2fv(morph->at.weight, MORPH_MAX_COORDINATES, shown->morph.weight[0]);
    const bool mapped = shown->map_coordinate >= 0 && model->coordinates;
    const float largest = mapped ? figure->largest[shown->map_coordinate][shown->map_axis] : 0.0f;
    axis[shown->map_axis] = largest > 0.0f ? 1.0f / largest : 0.0f;
    glUniform1i(morph->at.map_row, mapped ? model->rows * shown->map_coordinate : -1);
    glUniform3fv(morph->at.map_axis, 1, axis);
    glUniform1f(morph->at.dark, figure->dark);
    glUniform1f(morph->at.line, mapped ? PHASE_LINE * scale : 0.0f);
    glBindVertexArray(model->vertex_array);
    glBindTexture(GL_TEXTURE_2D, model->coordinates);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, shown->coarse ? model->coarse : model->fine);
    if (program_of(model, shown) == PICTURED) {
        draw_pictured(morph, model, shown->coarse);
        return;
    }
    glDrawElements(GL_TRIANGLES, shown->coarse ? model->coarse_count : model->fine_count, GL_UNSIGNED_INT, NULL);
}

static const struct model *find_uploaded(const struct stage_morph *morph, const struct figure *figure)
{
    for (int m = 0; m < MAX_KEPT; m++) {
        if (morph->models[m].id == figure->id) return &morph->models[m];
    }
    return NULL;
}

static void draw_skins(const struct stage_morph *morph, const struct stage_view *view, float scale)
{
    for (int p = 0; p < PROGRAMS; p++) {
        const struct morph_program *program = &morph->programs[p];
        bool used = false;
        for (int i = 0; i < view->character_count; i++) {
            const struct stage_character *shown = &view->characters[i];
            const struct model *model = find_uploaded(morph, shown->figure);
            if (!model || program_of(model, shown) != p) continue;
            if (!used) painter_use(program->program, &program->shared, view, 0.0f);
            used = true;
            draw_character(program, model, shown, scale);
        }
    }
}

static void draw_skirts(const struct stage_morph *morph, const struct stage_view *view, float scale, float seam)
{
    stage_skirt_use(&morph->skirt, view, seam);
    for (int i = 0; i < view->character_count; i++) {
        struct stage_character shown = view->characters[i];
        const struct model *model = find_uploaded(morph, shown.figure);
        if (!model) continue;
        if (!model->coordinates) { // drawn at rest
            shown.morph.count = 0;
            shown.map_coordinate = -1;
        }
        set_shade(morph->skirt.at.shade, &shown);
        glUniform1f(morph->skirt.at.line, shown.map_coordinate >= 0 ? PHASE_LINE * scale : 0.0f);
        morph_skirt_draw(&model->skirt, &morph->skirt, view, &shown, &model->looks, seam);
    }
    stage_skirt_leave();
}

static void draw(const void *state, const struct stage_view *view, float scale, float seam)
{
    if (view->character_count == 0) return;
    if (seam > 0.0f)
        draw_skirts(state, view, scale, seam);
    else
        draw_skins(state, view, scale);
    glBindVertexArray(0);
}

static float ground(const struct stage_view *view)
{
    float lowest = INFINITY;
    for (int c = 0; c < view->character_count; c++) lowest = fminf(lowest, view->characters[c].position[1]);
    return lowest;
}

/// The box at rest, grown by the amplitudes.
static void add_extent(const struct stage_view *view, struct extent *extent)
{
    for (int c = 0; c < view->character_count; c++) {
        const struct stage_character *shown = &view->characters[c];
        const struct figure *figure = shown->figure;
        float lo[3], hi[3];
        for (int k = 0; k < 3; k++) {
            float reach = 0.0f;
            for (int d = 0; d < shown->morph.count; d++) {
                const float *weight = shown->morph.weight[d];
                reach += hypotf(weight[0], weight[1]) * figure->largest[shown->morph.coordinate[d]][k];
            }
            const float place = shown->position[k] - (k == 1 ? figure->lo[1] : 0.0f);
            lo[k] = place + figure->lo[k] - reach;
            hi[k] = place + figure->hi[k] + reach;
        }
        extent_add_box(extent, lo, hi);
    }
}

const struct painter character_painter = {create, destroy, upload, draw, ground, add_extent};
