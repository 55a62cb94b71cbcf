/// Draws soft characters: moved by complex morphs once a frame, for their surface and their skirts alike.
#include "base/need.h"
#include "draw/painter.h"
#include "draw/skirt.h"
#include "draw/stage.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_KEPT = 2 * STAGE_MAX_CHARACTERS }; ///< characters kept on the GPU; the least recently drawn goes

static const float PHASE_LINE = 1.25f; ///< logical pixels

/// A figure as one of the stage's characters shows it.
struct model {
    uint64_t id; ///< of the figure, 0: free
    bool is_twin;
    long used;           ///< when it was drawn last
    GLuint triangles[2]; ///< the fine and the coarse ones
    struct surface_look *looks;
    struct stage_surface drawn;
    int map_coordinate, map_axis; ///< whose phases `looks` shows
    uint64_t version;             ///< of the figure in them
    struct morph_looks materials;
    struct morph_skirt skirt;
};

struct stage_morph {
    struct stage_skirt skirt; ///< whose programs draw surfaces too
    struct model models[MAX_KEPT];
    long clock;
};

static void *create(struct error *error)
{
    struct stage_morph *morph = need_zeroed(1, sizeof *morph);
    if (stage_skirt_create(&morph->skirt, error)) return morph;
    free(morph);
    return NULL;
}

static void model_free(struct model *model)
{
    stage_surface_free(&model->drawn);
    glDeleteBuffers(2, model->triangles);
    free(model->looks);
    morph_looks_free(&model->materials);
    morph_skirt_free(&model->skirt);
    *model = (struct model){0};
}

static void destroy(void *state)
{
    struct stage_morph *morph = state;
    for (int i = 0; i < MAX_KEPT; i++) model_free(&morph->models[i]);
    stage_skirt_destroy(&morph->skirt);
    free(morph);
}

/// Its own colour, or that of its phase. The face stays: without eyes nobody sees which way the animal looks.
static void map_color(const struct figure *figure, const float phase[2], float color[3])
{
    float mapped[3];
    const float luminance = 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2];
    const float share = glm_smoothstep(0.3f * figure->dark, figure->dark, luminance);
    phase_color_linear(phase[0], phase[1], mapped);
    glm_vec3_lerp(color, mapped, share, color);
}

static void look_at(const struct stage_character *shown, int vertex, struct surface_look *look)
{
    const struct figure *figure = shown->figure;
    const struct character *c = &figure->character;
    const int map = shown->map_coordinate, axis = shown->map_axis;
    *look = (struct surface_look){.color = {[3] = 1.0f}};
    memcpy(look->color, c->color[vertex], sizeof c->color[vertex]);
    if (c->looks.uv && !c->looks.corner) memcpy(look->uv, c->looks.uv[vertex], sizeof look->uv);
    if (map < 0) return;
    const float largest = figure->largest[map][axis], scale = largest > 0.0f ? 1.0f / largest : 0.0f;
    look->phase[0] = scale * c->coordinates[map].re[vertex][axis];
    look->phase[1] = scale * c->coordinates[map].im[vertex][axis];
    map_color(figure, look->phase, look->color);
}

static void find_looks(struct model *model, const struct stage_character *shown)
{
    model->map_coordinate = shown->map_coordinate;
    model->map_axis = shown->map_axis;
    model->version = shown->figure->version;
    for (int v = 0; v < shown->figure->character.vertex_count; v++) look_at(shown, v, &model->looks[v]);
}

/// Uploads what vertices look like where that has changed; colours of its own do not.
static long update_looks(struct model *model, const struct stage_character *shown)
{
    const bool maps = shown->map_coordinate >= 0;
    if (shown->map_coordinate == model->map_coordinate &&
        (!maps || (shown->map_axis == model->map_axis && shown->figure->version == model->version)))
        return 0;
    find_looks(model, shown);
    return stage_surface_show(&model->drawn, model->looks);
}

/// The fine or the coarse triangles, sorted by material if that is to be seen.
static void upload_triangles(struct model *model, const struct figure *figure, bool coarse)
{
    const size_t count = (size_t)morph_skirt_count(figure, coarse);
    uint32_t *sorted = model->materials.range_count > 0 ? morph_looks_sort(&model->materials, figure, coarse) : NULL;
    const uint32_t *indices = coarse ? figure->coarse : figure->character.indices;
    glGenBuffers(1, &model->triangles[coarse]);
    glBindBuffer(GL_ARRAY_BUFFER, model->triangles[coarse]);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * sizeof *indices), sorted ? sorted : indices, GL_STATIC_DRAW);
    model->skirt.sorted[coarse] = sorted;
}

static long model_create(struct model *model, const struct stage_character *shown)
{
    const struct figure *figure = shown->figure;
    const size_t vertices = (size_t)figure->character.vertex_count;
    *model = (struct model){.id = figure->id, .is_twin = shown->is_twin};
    model->looks = need(vertices + 1, sizeof *model->looks);
    find_looks(model, shown);
    stage_surface_create(&model->drawn, figure->character.vertex_count, model->looks);
    long bytes = (long)(vertices * sizeof *model->looks) + morph_looks_create(&model->materials, figure);
    for (int coarse = 0; coarse < 2; coarse++) {
        upload_triangles(model, figure, coarse);
        bytes += (long)sizeof(uint32_t) * morph_skirt_count(figure, coarse);
    }
    morph_skirt_create(&model->skirt, figure, &model->materials);
    return bytes;
}

/// Moves it to where it stands, and says what faces the eye.
static long pose(const struct model *model, const struct stage_character *shown, const float eye[3])
{
    const struct figure *figure = shown->figure;
    const struct morph_skirt *skirt = &model->skirt;
    const float place[3] = {shown->position[0], shown->position[1] - figure->lo[1], shown->position[2]};
    for (int v = 0; v < figure->character.vertex_count; v++) {
        morph_vertex(figure, &shown->morph, v, skirt->place[v], skirt->normal[v]);
        for (int k = 0; k < 3; k++) skirt->place[v][k] += place[k];
    }
    const struct skirt_mesh mesh = morph_skirt_mesh(skirt, figure, shown->coarse);
    skirt_face(&mesh, 0, morph_skirt_count(figure, shown->coarse), eye);
    return stage_surface_move(&model->drawn, (const float(*)[3])skirt->place, (const float(*)[3])skirt->normal);
}

/// The character's model or, if it has none, the least recently drawn one.
static int find_model(const struct stage_morph *morph, const struct stage_character *shown)
{
    int oldest = 0;
    for (int i = 0; i < MAX_KEPT; i++) {
        const struct model *model = &morph->models[i];
        if (model->id == shown->figure->id && model->is_twin == shown->is_twin) return i;
        if (model->used < morph->models[oldest].used) oldest = i;
    }
    return oldest;
}

static void upload(void *state, const struct stage_view *view, long *bytes)
{
    struct stage_morph *morph = state;
    morph->clock++;
    for (int i = 0; i < view->character_count; i++) {
        const struct stage_character *shown = &view->characters[i];
        struct model *model = &morph->models[find_model(morph, shown)];
        if (model->id != shown->figure->id || model->is_twin != shown->is_twin) {
            model_free(model);
            *bytes += model_create(model, shown);
        }
        *bytes += update_looks(model, shown) + pose(model, shown, view->eye);
        model->used = morph->clock;
    }
}

/// The triangles of a material: what is seen through comes last, blended.
static void draw_ranges(const struct stage_skirt *program, const struct model *model, bool coarse, bool blended)
{
    for (int r = 0; r < model->materials.range_count; r++) {
        const struct morph_range *range = &model->materials.ranges[coarse][r];
        if (range->count == 0 || (range->color[3] < 1) != blended) continue;
        glUniform4fv(program->at.base, 1, range->color);
        glUniform1i(program->at.blended, blended);
        glBindTexture(GL_TEXTURE_2D, range->picture);
        glDrawElements(GL_TRIANGLES, range->count, GL_UNSIGNED_INT,
                       (const void *)((size_t)range->first * sizeof(uint32_t)));
    }
}

static void draw_pictured(const struct stage_skirt *program, const struct model *model, bool coarse)
{
    draw_ranges(program, model, coarse, false);
    glEnable(GL_BLEND);
    glDepthMask(GL_FALSE);
    draw_ranges(program, model, coarse, true);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

static bool is_pictured(const struct model *model, const struct stage_character *shown)
{
    return model->materials.range_count > 0 && shown->map_coordinate < 0;
}

static void draw_surface(const struct stage_skirt *program, const struct model *model,
                         const struct stage_character *shown)
{
    glBindVertexArray(model->drawn.vertex_array);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, model->triangles[shown->coarse]);
    if (is_pictured(model, shown)) {
        draw_pictured(program, model, shown->coarse);
    } else {
        glDrawElements(GL_TRIANGLES, morph_skirt_count(shown->figure, shown->coarse), GL_UNSIGNED_INT, NULL);
    }
}

static void look_of_skirt(const void *context, uint32_t vertex, struct skirt_vertex *out)
{
    const struct model *model = context;
    const struct surface_look *look = &model->looks[vertex];
    memcpy(out->normal, model->skirt.normal[vertex], sizeof out->normal);
    memcpy(out->color, look->color, sizeof out->color);
    memcpy(out->uv, look->uv, sizeof out->uv);
    memcpy(out->phase, look->phase, sizeof out->phase);
}

static void draw_skirts(const struct stage_skirt *program, const struct model *model,
                        const struct stage_character *shown, const float eye[3], float seam)
{
    const bool coarse = shown->coarse;
    const struct skirt_mesh mesh = morph_skirt_mesh(&model->skirt, shown->figure, coarse);
    if (!is_pictured(model, shown)) {
        stage_skirt_draw(program, &mesh, 0, morph_skirt_count(shown->figure, coarse), false, eye, seam, look_of_skirt,
                         model);
        return;
    }
    for (int r = 0; r < model->materials.range_count; r++) {
        const struct morph_range *range = &model->materials.ranges[coarse][r];
        glUniform4fv(program->at.base, 1, range->color);
        glUniform1i(program->at.blended, range->color[3] < 1.0f);
        glBindTexture(GL_TEXTURE_2D, range->picture);
        stage_skirt_draw(program, &mesh, range->first, range->first + range->count, false, eye, seam, look_of_skirt,
                         model);
    }
}

/// Uses the program for a character, and sets its light.
static void use_program(const struct stage_morph *morph, const struct stage_view *view,
                        const struct stage_character *shown, bool plain, float line, float seam)
{
    const float shade[2] = {shown->position[1], 0.3f * (shown->figure->hi[1] - shown->figure->lo[1])};
    if (plain) {
        stage_plain_use(&morph->skirt, view, shade, line);
        return;
    }
    stage_skirt_use(&morph->skirt, view, seam);
    glUniform2fv(morph->skirt.at.shade, 1, shade);
    glUniform1f(morph->skirt.at.line, line);
}

static void draw(const void *state, const struct stage_view *view, float scale, float seam)
{
    const struct stage_morph *morph = state;
    for (int i = 0; i < view->character_count; i++) {
        const struct stage_character *shown = &view->characters[i];
        const struct model *model = &morph->models[find_model(morph, shown)];
        const float line = shown->map_coordinate >= 0 ? PHASE_LINE * scale : 0.0f;
        use_program(morph, view, shown, seam == 0.0f && !is_pictured(model, shown), line, seam);
        if (seam > 0.0f) {
            draw_skirts(&morph->skirt, model, shown, view->eye, seam);
        } else {
            draw_surface(&morph->skirt, model, shown);
        }
    }
    stage_skirt_leave();
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
