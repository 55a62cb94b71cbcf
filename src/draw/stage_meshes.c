/// Draws imported characters, foxes and soft characters with materials and skirts.
#include "base/need.h"
#include "draw/posed.h"
#include "model/fox.h"
#include <stdlib.h>
#include <string.h>

enum { PICTURE_UNIT = 1 };
enum { EDGES = 768, CORNERS = SKIRT_CORNERS * EDGES }; ///< edges whose skirts are drawn in one call
/// The cache holds more meshes than a picture shows; a mesh unused for FORGOTTEN pictures is freed.
enum {
    MAX_SHOWN = STAGE_MAX_CHARACTERS + STAGE_MAX_MODELS,
    MAX_KEPT = MAX_SHOWN + STAGE_MAX_CHARACTERS,
    FORGOTTEN = 1000
};

static const float PHASE_LINE = 1.25f; ///< logical pixels

enum mesh_kind { MESH_NONE, MESH_MODEL, MESH_FINE, MESH_COARSE };

struct kept {
    enum mesh_kind kind;
    uint64_t id; ///< of the file or figure
    long used;   ///< number of the last picture that showed it
    struct posed mesh;
};

/// A mesh in this picture.
struct shown {
    const struct posed *mesh;
    float shade[2]; ///< heights: the ground's, and how far above it the ground's shade reaches
    float blink;
};

/// Laid out like meshes, at fixed addresses: llvmpipe recompiles a shader for each layout, and Mesa is slow if a vertex array changes
/// often.
struct skirts {
    float place[CORNERS][3], normal[CORNERS][3];
    struct posed_look look[CORNERS];
};

struct stage_meshes {
    const struct program *programs;
    struct kept kept[MAX_KEPT];
    struct shown shown[MAX_SHOWN];
    int shown_count;
    long clock; ///< counts pictures
    GLuint white;
    GLuint skirt_array, skirt_buffer, skirt_indices;
    struct skirts *skirts;
};

static void create_skirts(struct stage_meshes *meshes)
{
    static const uint16_t quad[] = {0, 1, 2, 0, 2, 3};
    uint16_t *indices = need(6 * EDGES, sizeof *indices);
    for (int i = 0; i < 6 * EDGES; i++) indices[i] = (uint16_t)(SKIRT_CORNERS * (i / 6) + quad[i % 6]);
    meshes->skirts = need(1, sizeof *meshes->skirts);
    glGenVertexArrays(1, &meshes->skirt_array);
    glBindVertexArray(meshes->skirt_array);
    meshes->skirt_buffer = gl_buffer(GL_ARRAY_BUFFER, sizeof *meshes->skirts, NULL, GL_STREAM_DRAW);
    gl_attribute(POSED_PLACE, 3, GL_FLOAT, 0, offsetof(struct skirts, place));
    gl_attribute(POSED_NORMAL, 3, GL_FLOAT, 0, offsetof(struct skirts, normal));
    posed_look_attributes(sizeof *meshes->skirts->look, offsetof(struct skirts, look));
    meshes->skirt_indices = gl_buffer(GL_ELEMENT_ARRAY_BUFFER, 6 * EDGES * sizeof *indices, indices, GL_STATIC_DRAW);
    glBindVertexArray(0);
    free(indices);
}

struct stage_meshes *stage_meshes_create(const struct program programs[PROGRAMS])
{
    struct stage_meshes *meshes = need_zeroed(1, sizeof *meshes);
    float head_from_bind[16];
    meshes->programs = programs;
    fox_head_from_bind(head_from_bind);
    glUseProgram(programs[PROGRAM_FACE].name);
    glUniformMatrix4fv(programs[PROGRAM_FACE].at[AT_HEAD_FROM_BIND], 1, GL_FALSE, head_from_bind);
    glUseProgram(programs[PROGRAM_PICTURED].name);
    glUniform1i(programs[PROGRAM_PICTURED].at[AT_PICTURE], PICTURE_UNIT);
    meshes->white = gl_picture((const unsigned char[]){255, 255, 255, 255}, 1, 1);
    create_skirts(meshes);
    return meshes;
}

void stage_meshes_destroy(struct stage_meshes *meshes)
{
    for (int i = 0; i < MAX_KEPT; i++) posed_delete(&meshes->kept[i].mesh);
    glDeleteTextures(1, &meshes->white);
    glDeleteVertexArrays(1, &meshes->skirt_array);
    glDeleteBuffers(2, (const GLuint[]){meshes->skirt_buffer, meshes->skirt_indices});
    free(meshes->skirts);
    free(meshes);
}

// --- the cache

static void drop(struct kept *kept)
{
    posed_delete(&kept->mesh);
    *kept = (struct kept){0};
}

/// A cached mesh of this file or figure that this picture does not use yet, as several rigs may share a file. Otherwise an empty entry,
/// after freeing the least recently used mesh and all unused for long.
static struct kept *find(struct stage_meshes *meshes, enum mesh_kind kind, uint64_t id)
{
    struct kept *oldest = &meshes->kept[0];
    for (int i = 0; i < MAX_KEPT; i++) {
        struct kept *kept = &meshes->kept[i];
        if (kept->kind == kind && kept->id == id && kept->used < meshes->clock) return kept;
        if (kept->used < oldest->used) oldest = kept;
    }
    for (int i = 0; i < MAX_KEPT; i++) {
        struct kept *kept = &meshes->kept[i];
        if (kept == oldest || meshes->clock - kept->used > FORGOTTEN) drop(kept);
    }
    return oldest;
}

static void show(struct stage_meshes *meshes, struct kept *kept, enum mesh_kind kind, uint64_t id, struct shown shown)
{
    kept->kind = kind;
    kept->id = id;
    kept->used = meshes->clock;
    shown.mesh = &kept->mesh;
    meshes->shown[meshes->shown_count++] = shown;
}

static long add_character(struct stage_meshes *meshes, const struct stage_character *shown, const float eye[3])
{
    const struct figure *figure = shown->figure;
    const enum mesh_kind kind = shown->coarse ? MESH_COARSE : MESH_FINE;
    struct kept *kept = find(meshes, kind, figure->id);
    struct posed *mesh = &kept->mesh;
    long bytes = 0;
    if (kept->kind == MESH_NONE) {
        posed_from_figure(mesh, figure, shown->coarse);
        bytes += posed_upload(mesh) + posed_upload_figure_pictures(mesh, &figure->character.looks);
    }
    if (posed_map_figure(mesh, shown)) bytes += posed_upload_looks(mesh);
    posed_pose_figure(mesh, shown, eye);
    show(meshes, kept, kind, figure->id,
         (struct shown){.shade = {shown->position[1], 0.3f * (figure->hi[1] - figure->lo[1])}});
    return bytes + posed_upload_places(mesh);
}

static long add_model(struct stage_meshes *meshes, const struct stage_model *shown, const float eye[3])
{
    const struct gltf *gltf = shown->gltf;
    struct kept *kept = find(meshes, MESH_MODEL, gltf->id);
    struct posed *mesh = &kept->mesh;
    long bytes = 0;
    if (kept->kind == MESH_NONE) {
        posed_from_gltf(mesh, gltf);
        bytes += posed_upload(mesh) + posed_upload_gltf_pictures(mesh, gltf);
    }
    posed_pose_gltf(mesh, shown, eye);
    show(meshes, kept, MESH_MODEL, gltf->id,
         (struct shown){.shade = {shown->ground, shown->dusk},
                        .blink = gltf->weight_count > 0 ? shown->pose->weights[0] : 0.0f});
    return bytes + posed_upload_places(mesh);
}

long stage_meshes_upload(struct stage_meshes *meshes, const struct stage_view *view)
{
    long bytes = 0;
    meshes->clock++;
    meshes->shown_count = 0;
    for (int c = 0; c < view->character_count; c++) bytes += add_character(meshes, &view->characters[c], view->eye);
    for (int m = 0; m < view->model_count; m++) bytes += add_model(meshes, &view->models[m], view->eye);
    return bytes;
}

// --- the picture

/// The program for a part's surface or its skirts.
static enum stage_program program_of(const struct posed_part *part, bool skirts)
{
    return skirts && part->program == PROGRAM_PLAIN ? PROGRAM_PICTURED : part->program;
}

static void use_material(const struct stage_meshes *meshes, const struct program *program,
                         const struct posed_part *part, bool skirts)
{
    const bool is_pictured = part->program == PROGRAM_PICTURED;
    glUniform4fv(program->at[AT_BASE], 1, part->base);
    glUniform1f(program->at[AT_CUTOFF], part->cutoff);
    glUniform1i(program->at[AT_BLENDED], part->blended);
    glUniform1i(program->at[AT_BOTH_SIDES], part->both_sides && !skirts);
    glBindTexture(GL_TEXTURE_2D, is_pictured && part->picture ? part->picture : meshes->white);
    glBindSampler(PICTURE_UNIT, part->sampler);
}

enum kind { SOLID, MASKED, BLENDED };

static enum kind kind_of(const struct posed_part *part)
{
    if (part->blended) return BLENDED;
    return part->cutoff > 0.0f ? MASKED : SOLID;
}

static void draw_parts(const struct stage_meshes *meshes, const struct posed *mesh, enum stage_program program,
                       enum kind first, enum kind last)
{
    for (int p = 0; p < mesh->part_count; p++) {
        const struct posed_part *part = &mesh->parts[p];
        if (part->program != program || kind_of(part) < first || kind_of(part) > last) continue;
        use_material(meshes, &meshes->programs[program], part, false);
        glFrontFace(part->mirrored ? GL_CW : GL_CCW);
        if (part->both_sides) glDisable(GL_CULL_FACE);
        glDrawElements(GL_TRIANGLES, part->end - part->first, GL_UNSIGNED_INT,
                       (const void *)((size_t)part->first * sizeof *mesh->indices));
        glEnable(GL_CULL_FACE);
    }
    glFrontFace(GL_CCW);
}

/// The second pass draws masked surfaces again, because their edges fade over the background.
static void draw_surface(const struct stage_meshes *meshes, const struct posed *mesh, enum stage_program program,
                         bool second)
{
    glBindVertexArray(mesh->vertex_array);
    if (second) {
        draw_parts(meshes, mesh, program, MASKED, MASKED);
        return;
    }
    glEnable(GL_BLEND);
    draw_parts(meshes, mesh, program, SOLID, MASKED);
    glDepthMask(GL_FALSE);
    draw_parts(meshes, mesh, program, BLENDED, BLENDED);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

static void put(struct skirts *skirts, int corner, const struct skirt_vertex *from)
{
    memcpy(skirts->place[corner], from->place, sizeof from->place);
    memcpy(skirts->normal[corner], from->normal, sizeof from->normal);
    skirts->look[corner] = from->look;
}

static void draw_edges(const struct stage_meshes *meshes, int count)
{
    if (count == 0) return;
    glBindBuffer(GL_ARRAY_BUFFER, meshes->skirt_buffer);
    const struct skirts *skirts = meshes->skirts;
    const size_t corners = (size_t)(SKIRT_CORNERS * count), looks = corners * sizeof *skirts->look;
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(offsetof(struct skirts, look) + looks), NULL, GL_STREAM_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, offsetof(struct skirts, place), (GLsizeiptr)(corners * sizeof *skirts->place),
                    skirts->place);
    glBufferSubData(GL_ARRAY_BUFFER, offsetof(struct skirts, normal), (GLsizeiptr)(corners * sizeof *skirts->normal),
                    skirts->normal);
    glBufferSubData(GL_ARRAY_BUFFER, offsetof(struct skirts, look), (GLsizeiptr)looks, skirts->look);
    glDrawElements(GL_TRIANGLES, 6 * count, GL_UNSIGNED_SHORT, NULL);
}

static void draw_skirts(const struct stage_meshes *meshes, const struct posed *mesh, enum stage_program program,
                        const float eye[3], float seam)
{
    glBindVertexArray(meshes->skirt_array);
    glDisable(GL_CULL_FACE);
    for (int p = 0; p < mesh->part_count; p++) {
        const struct posed_part *part = &mesh->parts[p];
        int count = 0;
        if (program_of(part, true) != program) continue;
        use_material(meshes, &meshes->programs[program], part, true);
        for (int i = skirt_next(mesh, part, part->first); i < part->end; i = skirt_next(mesh, part, i + 1)) {
            struct skirt_vertex hung[SKIRT_CORNERS];
            skirt_hang(mesh, part, i, eye, seam, hung);
            for (int c = 0; c < SKIRT_CORNERS; c++) put(meshes->skirts, SKIRT_CORNERS * count + c, &hung[c]);
            if (++count < EDGES) continue;
            draw_edges(meshes, count);
            count = 0;
        }
        draw_edges(meshes, count);
    }
    glEnable(GL_CULL_FACE);
}

static bool has_program(const struct posed *mesh, enum stage_program program, bool skirts)
{
    int p = mesh->part_count;
    while (--p >= 0 && program_of(&mesh->parts[p], skirts) != program) continue;
    return p >= 0;
}

void stage_meshes_draw(const struct stage_meshes *meshes, const struct stage_view *view, float scale, float seam)
{
    const bool second = seam > 0.0f;
    glActiveTexture(GL_TEXTURE0 + PICTURE_UNIT);
    for (enum stage_program which = 0; which < PROGRAM_FLAT; which++) {
        const struct program *program = &meshes->programs[which];
        for (int s = 0; s < meshes->shown_count; s++) {
            const struct shown *shown = &meshes->shown[s];
            if (!has_program(shown->mesh, which, second)) continue;
            program_use(program, view, seam);
            glUniform2fv(program->at[AT_SHADE], 1, shown->shade);
            glUniform1f(program->at[AT_BLINK], shown->blink);
            glUniform1f(program->at[AT_LINE], shown->mesh->map_coordinate >= 0 ? PHASE_LINE * scale : 0.0f);
            draw_surface(meshes, shown->mesh, which, second);
            if (second) draw_skirts(meshes, shown->mesh, which, view->eye, seam);
        }
    }
    glBindSampler(PICTURE_UNIT, 0);
    glActiveTexture(GL_TEXTURE0);
    glBindVertexArray(0);
}
