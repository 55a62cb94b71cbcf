/// Draws tails and their animals, skinned.
#include "base/need.h"
#include "draw/area.h"
#include "draw/painter.h"
#include "draw/stage.h"
#include "draw/stage_skin.h"
#include "model/creature.h"
#include "model/mesh.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

enum { MAX_SKIRT = 6000 }; ///< edges of all animals, about four times as many as any are known to have

/// A mesh on the GPU: what of it does not move.
struct model {
    struct skin_mesh skin;
    GLuint vertex_array, vertices;
};

struct coat_program {
    GLuint program;
    GLint shape, blink;
    struct painter_uniforms shared;
};

struct animals {
    struct coat_program programs[REGIONS];
    struct model models[CREATURE_LEVELS];
    int vertices, triangles;     ///< that all animals of a stage have at most
    float (*place)[3];           ///< of all animals, one after the other; then as many normals
    bool *front;                 ///< of all animals
    uint32_t *seen;              ///< triangles that face the eye
    struct skirt_corner *skirts; ///< of all animals
    GLuint moving, indices;      ///< `place` and `seen` on the GPU
    GLuint skirt_array, skirt;   ///< `skirts` there
};

static void attribute(GLuint index, GLint size, size_t stride, size_t offset)
{
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, (GLsizei)stride, (const void *)offset);
}

static void model_create(struct model *model, int level)
{
    stage_skin_create(&model->skin, level);
    const struct mesh *mesh = &model->skin.mesh;
    glGenVertexArrays(1, &model->vertex_array);
    glBindVertexArray(model->vertex_array);
    glGenBuffers(1, &model->vertices);
    glBindBuffer(GL_ARRAY_BUFFER, model->vertices);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)mesh->vertex_count * sizeof *mesh->vertices), mesh->vertices,
                 GL_STATIC_DRAW);
    attribute(0, 3, sizeof(struct vertex), offsetof(struct vertex, position));
    attribute(1, 3, sizeof(struct vertex), offsetof(struct vertex, mark));
    attribute(2, 1, sizeof(struct vertex), offsetof(struct vertex, bend));
    attribute(6, 1, sizeof(struct vertex), offsetof(struct vertex, open));
    glBindVertexArray(0);
}

static void model_destroy(struct model *model)
{
    glDeleteVertexArrays(1, &model->vertex_array);
    glDeleteBuffers(1, &model->vertices);
    stage_skin_destroy(&model->skin);
}

static void skirt_create(struct animals *painter)
{
    const size_t stride = sizeof(struct skirt_corner);
    glGenVertexArrays(1, &painter->skirt_array);
    glBindVertexArray(painter->skirt_array);
    glGenBuffers(1, &painter->skirt);
    glBindBuffer(GL_ARRAY_BUFFER, painter->skirt);
    attribute(0, 3, stride, offsetof(struct skirt_corner, position));
    attribute(1, 3, stride, offsetof(struct skirt_corner, mark));
    attribute(2, 1, stride, offsetof(struct skirt_corner, bend));
    attribute(6, 1, stride, offsetof(struct skirt_corner, open));
    attribute(3, 3, stride, offsetof(struct skirt_corner, place));
    attribute(4, 3, stride, offsetof(struct skirt_corner, normal));
    attribute(5, 1, stride, offsetof(struct skirt_corner, opacity));
    glBindVertexArray(0);
}

/// What of the coat never changes.
static void set_coat(GLuint program)
{
    static const struct {
        const char *name;
        uint32_t color;
    } colors[] = {{"orange", COAT_FUR}, {"brown", COAT_BAND}, {"white", COAT_TIP}, {"dark", COAT_DARK}};
    float matrix[16], linear[3];
    creature_head_from_bind(matrix);
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "head_from_bind"), 1, GL_FALSE, matrix);
    for (size_t i = 0; i < sizeof colors / sizeof *colors; i++) {
        coat_linear(colors[i].color, linear);
        glUniform3fv(glGetUniformLocation(program, colors[i].name), 1, linear);
    }
}

static bool program_create(struct coat_program *coat, const char *define, struct error *error)
{
    const GLuint program = coat->program = gl_program("stage_mesh.vert", "stage_mesh.frag", define, error);
    if (!program) return false;
    coat->shape = glGetUniformLocation(program, "shape");
    coat->blink = glGetUniformLocation(program, "blink");
    coat->shared = painter_find_uniforms(program);
    set_coat(program);
    return true;
}

static bool programs_create(struct animals *painter, struct error *error)
{
    static const char *const defines[REGIONS] = {[REGION_COAT] = "FURRED", [REGION_FACE] = "FACED"};
    for (int region = 0; region < REGIONS; region++) {
        if (!program_create(&painter->programs[region], defines[region], error)) return false;
    }
    return true;
}

static const struct model *model_of(const struct animals *painter, int animals)
{
    return &painter->models[creature_level(animals)];
}

/// Room for as many animals as a stage can have.
static void room_create(struct animals *painter)
{
    for (int animals = 1; animals <= STAGE_MAX_TAILS; animals++) {
        const struct mesh *mesh = &model_of(painter, animals)->skin.mesh;
        painter->vertices = area_max(painter->vertices, animals * mesh->vertex_count);
        painter->triangles = area_max(painter->triangles, animals * mesh->index_count / 3);
    }
    painter->place = need(2 * (size_t)painter->vertices, sizeof *painter->place);
    painter->front = need((size_t)painter->triangles, sizeof *painter->front);
    painter->seen = need(3 * (size_t)painter->triangles, sizeof *painter->seen);
    painter->skirts = need((size_t)MAX_SKIRT * SKIRT_CORNERS, sizeof *painter->skirts);
    glGenBuffers(1, &painter->moving);
    glGenBuffers(1, &painter->indices);
    skirt_create(painter);
}

static void destroy(void *state)
{
    struct animals *painter = state;
    for (int level = 0; level < CREATURE_LEVELS; level++) model_destroy(&painter->models[level]);
    glDeleteBuffers(1, &painter->moving);
    glDeleteBuffers(1, &painter->indices);
    glDeleteVertexArrays(1, &painter->skirt_array);
    glDeleteBuffers(1, &painter->skirt);
    for (int region = 0; region < REGIONS; region++) {
        if (painter->programs[region].program) glDeleteProgram(painter->programs[region].program);
    }
    free(painter->place);
    free(painter->front);
    free(painter->seen);
    free(painter->skirts);
    free(painter);
}

static void *create(struct error *error)
{
    struct animals *painter = need_zeroed(1, sizeof *painter);
    if (!programs_create(painter, error)) {
        destroy(painter);
        return NULL;
    }
    for (int level = 0; level < CREATURE_LEVELS; level++) model_create(&painter->models[level], level);
    room_create(painter);
    return painter;
}

static struct skin skin_of(const struct animals *painter, const struct model *model, int tail)
{
    const int first = tail * model->skin.mesh.vertex_count, triangle = tail * model->skin.mesh.index_count / 3;
    return (struct skin){painter->place + first, painter->place + painter->vertices + first,
                         painter->front + triangle};
}

static void upload(void *state, const struct stage_view *view, long *bytes)
{
    const struct animals *painter = state;
    const struct model *model = model_of(painter, view->tail_count);
    const size_t half = (size_t)painter->vertices * sizeof *painter->place;
    const size_t used = (size_t)(view->tail_count * model->skin.mesh.vertex_count) * sizeof *painter->place;
    if (view->tail_count == 0) return;
    for (int t = 0; t < view->tail_count; t++) {
        const struct skin skin = skin_of(painter, model, t);
        stage_skin_pose(&model->skin, &view->tails[t].pose, view->eye, &skin);
    }
    glBindBuffer(GL_ARRAY_BUFFER, painter->moving);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(2 * half), NULL, GL_STREAM_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)used, painter->place);
    glBufferSubData(GL_ARRAY_BUFFER, (GLintptr)half, (GLsizeiptr)used, painter->place + painter->vertices);
    *bytes += 2 * (long)used;
}

/// Of a pass: what is drawn of region r and animal t begins at [r][t] and ends where the next begins.
typedef GLsizei runs[REGIONS][STAGE_MAX_TAILS + 1];

static void upload_seen(const struct animals *painter, const struct model *model, const struct stage_view *view,
                        runs first)
{
    GLsizei count = 0;
    for (int region = 0; region < REGIONS; region++) {
        for (int t = 0; t < view->tail_count; t++) {
            const struct skin skin = skin_of(painter, model, t);
            first[region][t] = count;
            count += stage_skin_seen(&model->skin, &skin, (enum region)region, painter->seen + count);
        }
        first[region][view->tail_count] = count;
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, painter->indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)((size_t)count * sizeof *painter->seen), painter->seen,
                 GL_STREAM_DRAW);
}

static void upload_skirts(const struct animals *painter, const struct model *model, const struct stage_view *view,
                          float pixel, runs first)
{
    int count = 0;
    for (int region = 0; region < REGIONS; region++) {
        for (int t = 0; t < view->tail_count; t++) {
            const struct skin skin = skin_of(painter, model, t);
            first[region][t] = SKIRT_CORNERS * count;
            count += stage_skin_skirt(&model->skin, &skin, (enum region)region, view->eye, pixel,
                                      painter->skirts + SKIRT_CORNERS * count, MAX_SKIRT - count);
        }
        first[region][view->tail_count] = SKIRT_CORNERS * count;
    }
    glBindBuffer(GL_ARRAY_BUFFER, painter->skirt);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)(SKIRT_CORNERS * count) * sizeof *painter->skirts),
                 painter->skirts, GL_STREAM_DRAW);
}

static void use_coat(const struct coat_program *coat, const struct pose *pose)
{
    glUniform2f(coat->shape, pose_length(pose) / CREATURE_TAIL_LENGTH, pose->ground);
    if (coat->blink >= 0) glUniform1f(coat->blink, pose->limbs.blink);
}

static void draw_skins(const struct animals *painter, const struct model *model, int tail, GLsizei first,
                       GLsizei count)
{
    const size_t stride = sizeof *painter->place, half = (size_t)painter->vertices * stride;
    const size_t offset = (size_t)(tail * model->skin.mesh.vertex_count) * stride;
    attribute(3, 3, stride, offset);
    attribute(4, 3, stride, half + offset);
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, (const void *)((size_t)first * sizeof(GLuint)));
}

static void draw(const void *state, const struct stage_view *view, float scale, float seam)
{
    const struct animals *painter = state;
    const struct model *model = model_of(painter, view->tail_count);
    runs first;
    (void)scale;
    if (view->tail_count == 0) return;
    glBindVertexArray(seam > 0.0f ? painter->skirt_array : model->vertex_array);
    if (seam > 0.0f) {
        upload_skirts(painter, model, view, seam, first);
    } else {
        upload_seen(painter, model, view, first);
        glBindBuffer(GL_ARRAY_BUFFER, painter->moving);
        glVertexAttrib1f(5, 1.0f); // opaque
    }
    for (int region = 0; region < REGIONS; region++) {
        const struct coat_program *coat = &painter->programs[region];
        painter_use(coat->program, &coat->shared, view, seam);
        for (int t = 0; t < view->tail_count; t++) {
            const GLsizei from = first[region][t], count = first[region][t + 1] - from;
            use_coat(coat, &view->tails[t].pose);
            if (seam > 0.0f) {
                glDrawArrays(GL_TRIANGLES, from, count);
            } else {
                draw_skins(painter, model, t, from, count);
            }
        }
    }
    glBindVertexArray(0);
}

static float ground(const struct stage_view *view)
{
    float lowest = INFINITY;
    for (int t = 0; t < view->tail_count; t++) lowest = fminf(lowest, view->tails[t].pose.ground);
    return lowest;
}

/// Skin follows joints that are at most 2.5 segments away (see model/tail_skin.h), so it stays within a sphere around each.
static void add_pose(struct extent *extent, const struct pose *pose)
{
    float lo[3], hi[3];
    const float length = pose_length(pose), segment = length / (float)(pose->count - 1);
    const float reach = hypotf(2.5f * segment, CREATURE_BRUSH_RADIUS * length / CREATURE_TAIL_LENGTH);
    pose_bounds(pose, lo, hi);
    extent_add_box(extent, lo, hi);
    for (int n = 0; n < pose->count; n++) {
        for (int k = 0; k < 3; k++) {
            lo[k] = pose->matrix[n][12 + k] - reach;
            hi[k] = pose->matrix[n][12 + k] + reach;
        }
        extent_add_box(extent, lo, hi);
    }
}

static void add_extent(const struct stage_view *view, struct extent *extent)
{
    for (int t = 0; t < view->tail_count; t++) add_pose(extent, &view->tails[t].pose);
}

const struct painter tail_painter = {create, destroy, upload, draw, ground, add_extent};
