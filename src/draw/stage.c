/// Draws the stage: background, ground, contact shadows and rigs with a common camera and light.
#include "draw/stage.h"
#include "base/hash.h"
#include "base/need.h"
#include "draw/posed.h"
#include "model/fox.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

// --- programs

/// Names as in the shaders.
#define UNIFORM_LIST(X)                                                                                              \
    X(AT_CLIP_FROM_WORLD, clip_from_world)                                                                           \
    X(AT_EYE, eye)                                                                                                   \
    X(AT_KEY_FROM, key_from)                                                                                         \
    X(AT_EARTH, earth)                                                                                               \
    X(AT_SEAM, seam)                                                                                                 \
    X(AT_SHADE, shade)                                                                                               \
    X(AT_BLINK, blink)                                                                                               \
    X(AT_HEAD_FROM_BIND, head_from_bind)                                                                             \
    X(AT_LINE, line)                                                                                                 \
    X(AT_BASE, base)                                                                                                 \
    X(AT_PICTURE, picture)                                                                                           \
    X(AT_CUTOFF, cutoff)                                                                                             \
    X(AT_BLENDED, blended)                                                                                           \
    X(AT_BOTH_SIDES, both_sides)                                                                                     \
    X(AT_TOP, top)                                                                                                   \
    X(AT_BOTTOM, bottom)                                                                                             \
    X(AT_PLACE, place)                                                                                               \
    X(AT_FIT, fit)                                                                                                   \
    X(AT_SHADOW, shadow)

#define UNIFORM_PLACE(constant, name) constant,
enum uniform { UNIFORM_LIST(UNIFORM_PLACE) UNIFORMS };
#undef UNIFORM_PLACE

struct program {
    GLuint name;
    GLint at[UNIFORMS]; ///< −1 for a missing uniform; setting it has no effect
};

static const struct {
    const char *vertex, *fragment, *define;
} sources[PROGRAMS] = {
    [PROGRAM_COAT] = {"stage_skirt.vert", "stage_mesh.frag", "FURRED"},
    [PROGRAM_FACE] = {"stage_skirt.vert", "stage_mesh.frag", "FACED"},
    [PROGRAM_PLAIN] = {"stage_skirt.vert", "stage_mesh.frag", NULL},
    [PROGRAM_PICTURED] = {"stage_skirt.vert", "stage_mesh.frag", "PICTURED"},
    [PROGRAM_FLAT] = {"stage_flat.vert", "stage_flat.frag", NULL},
    [PROGRAM_BACKED] = {"stage_flat.vert", "stage_flat.frag", "BACKED"},
};

#define UNIFORM_NAME(constant, name) #name,
static const char *const uniform_names[UNIFORMS] = {UNIFORM_LIST(UNIFORM_NAME)};
#undef UNIFORM_NAME

/// projection · view, column-major.
static mat4s clip_from_world_of(const struct stage_view *view)
{
    return glms_mat4_mul(mat4_from(view->projection), mat4_from(view->view));
}

// --- where the stage moves on the screen

/// Height of the ground under the lowest rig.
static float lowest_ground(const struct stage_view *view)
{
    float lowest = INFINITY;
    for (int m = 0; m < view->model_count; m++) lowest = fminf(lowest, view->models[m].posed.ground);
    return lowest < INFINITY ? lowest : 0.0f;
}

/// A growing box in normalised device coordinates.
struct extent {
    mat4s clip_from_world;
    float lo[2], hi[2];
    bool is_everywhere; ///< something is too close to the camera to project
};

uint64_t stage_backdrop_hash(const struct stage_view *view)
{
    const float ground = lowest_ground(view);
    return hash_bytes(stage_scenery_hash(view), &ground, sizeof ground);
}

static void add_box(struct extent *extent, const float lo[3], const float hi[3])
{
    static const float nearest = 1.0e-3f; ///< metres
    for (int corner = 0; corner < 8; corner++) {
        const float world[3] = {corner & 1 ? hi[0] : lo[0], corner & 2 ? hi[1] : lo[1], corner & 4 ? hi[2] : lo[2]};
        const vec4s point = {{world[0], world[1], world[2], 1.0f}};
        const vec4s clip = glms_mat4_mulv(extent->clip_from_world, point);
        if (!(clip.w > nearest)) extent->is_everywhere = true;
        for (int k = 0; clip.w > nearest && k < 2; k++) {
            extent->lo[k] = fminf(extent->lo[k], clip.raw[k] / clip.w);
            extent->hi[k] = fmaxf(extent->hi[k], clip.raw[k] / clip.w);
        }
    }
}

struct area stage_extent(const struct stage_view *view, struct area viewport, int margin)
{
    struct extent extent = {
        .clip_from_world = clip_from_world_of(view), .lo = {INFINITY, INFINITY}, .hi = {-INFINITY, -INFINITY}};
    const float ground = lowest_ground(view);
    for (int m = 0; m < view->model_count; m++) add_box(&extent, view->models[m].lo, view->models[m].hi);
    for (const struct shadow_blob *blob = view->blobs; blob < view->blobs + view->blob_count; blob++) {
        const float lo[3] = {blob->x - blob->radius, ground, blob->z - blob->radius};
        const float hi[3] = {blob->x + blob->radius, ground, blob->z + blob->radius};
        add_box(&extent, lo, hi);
    }
    if (extent.is_everywhere) return viewport;
    if (!(extent.lo[0] <= extent.hi[0])) return (struct area){0};
    const float w = 0.5f * (float)(viewport.x1 - viewport.x0), h = 0.5f * (float)(viewport.y1 - viewport.y0);
    const struct area area = {
        viewport.x0 + area_whole(floorf((1.0f + extent.lo[0]) * w)) - margin,
        viewport.y0 + area_whole(floorf((1.0f - extent.hi[1]) * h)) - margin,
        viewport.x0 + area_whole(ceilf((1.0f + extent.hi[0]) * w)) + margin,
        viewport.y0 + area_whole(ceilf((1.0f - extent.lo[1]) * h)) + margin,
    };
    return area_intersect(area, viewport);
}

// --- background, ground and contact shadows

#define GROUND_RADIUS 3.5f

// Figures between these sizes, in metres, get the same ground; it scales with smaller and larger ones.
static const float SMALL = 0.2f, LARGE = 5.0f;

enum {
    FLAT_CORNERS = 6,
    SCENERY = 2, ///< background and ground, which come first
    MAX_QUADS = SCENERY + STAGE_MAX_BLOBS,
};

struct corner {
    float clip[4];
    float local[2]; ///< −1 … 1 across the disc's square
    float color[4]; ///< sRGB and opacity
};

/// Background, ground and contact shadows: a few quads of one program.
struct stage_flat {
    GLuint vertex_array, vertices;
    int quads;
    struct corner corners[MAX_QUADS * FLAT_CORNERS];
};

/// Corners of two triangles.
static const float square[FLAT_CORNERS][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};

static void set_color(struct corner *corner, uint32_t color, float opacity)
{
    for (int k = 0; k < 3; k++) corner->color[k] = (float)(color >> (24 - 8 * k) & 0xFF) / 255.0f;
    corner->color[3] = opacity;
}

static void add_disc(struct stage_flat *flat, mat4s clip_from_world, float x, float ground, float z, float radius,
                     uint32_t color, float opacity)
{
    for (int c = 0; c < FLAT_CORNERS; c++) {
        struct corner *corner = &flat->corners[flat->quads * FLAT_CORNERS + c];
        const vec4s world = {{x + radius * square[c][0], ground, z + radius * square[c][1], 1.0f}};
        vec4s clip = glms_mat4_mulv(clip_from_world, world);
        *corner = (struct corner){.local = {square[c][0], square[c][1]}};
        glm_vec4_copy(clip.raw, corner->clip);
        set_color(corner, color, opacity);
    }
    flat->quads++;
}

// --- meshes on the GPU

/// Attributes of stage_skirt.vert.
enum { POSED_PLACE, POSED_NORMAL, POSED_COLOR, POSED_UV, POSED_PHASE, POSED_COVER };

/// Sets the attributes of looks that lie in each `stride` bytes at an offset.
static void set_look_attributes(size_t stride, size_t offset)
{
    gl_attribute(POSED_COLOR, 4, GL_FLOAT, stride, offset + offsetof(struct posed_look, color));
    gl_attribute(POSED_UV, 2, GL_FLOAT, stride, offset + offsetof(struct posed_look, uv));
    gl_attribute(POSED_PHASE, 2, GL_FLOAT, stride, offset + offsetof(struct posed_look, phase));
    gl_attribute(POSED_COVER, 1, GL_FLOAT, stride, offset + offsetof(struct posed_look, cover));
}

/// Uploads a mesh but for its vertices' places, which change, and its pictures and samplers. Returns the number of bytes.
static long upload_mesh(struct posed *mesh, const struct gltf *gltf)
{
    const size_t vertices = (size_t)mesh->vertex_count, stride = sizeof *mesh->looks;
    const size_t index_bytes = (size_t)mesh->index_count * sizeof *mesh->indices;
    long bytes = (long)(vertices * stride + index_bytes);
    glGenVertexArrays(1, &mesh->vertex_array);
    glBindVertexArray(mesh->vertex_array);
    mesh->moving_buffer = gl_buffer(GL_ARRAY_BUFFER, 2 * vertices * sizeof *mesh->place, NULL, GL_STREAM_DRAW);
    gl_attribute(POSED_PLACE, 3, GL_FLOAT, 0, 0);
    gl_attribute(POSED_NORMAL, 3, GL_FLOAT, 0, vertices * sizeof *mesh->place);
    mesh->look_buffer = gl_buffer(GL_ARRAY_BUFFER, vertices * stride, mesh->looks, GL_STATIC_DRAW);
    set_look_attributes(stride, 0);
    mesh->index_buffer = gl_buffer(GL_ELEMENT_ARRAY_BUFFER, index_bytes, mesh->indices, GL_STATIC_DRAW);
    glBindVertexArray(0);

    mesh->picture_count = gltf->image_count;
    mesh->sampler_count = gltf->material_count;
    mesh->pictures = pool_take(&mesh->pool, (size_t)gltf->image_count, sizeof *mesh->pictures);
    mesh->samplers = pool_take(&mesh->pool, (size_t)gltf->material_count, sizeof *mesh->samplers);
    glGenSamplers(gltf->material_count, mesh->samplers);
    for (int i = 0; i < gltf->image_count; i++) {
        const struct gltf_image *image = &gltf->images[i];
        const int largest = gl_largest_texture();
        if (!image->pixels || image->width > largest || image->height > largest) continue; // it could not be decoded
        mesh->pictures[i] = gl_picture(image->pixels, image->width, image->height);
        bytes += 4L * image->width * image->height;
    }
    for (int m = 0; m < gltf->material_count; m++) {
        const struct gltf_sampler *sampler = &gltf->materials[m].sampler;
        glSamplerParameteri(mesh->samplers[m], GL_TEXTURE_WRAP_S, sampler->wrap[0]);
        glSamplerParameteri(mesh->samplers[m], GL_TEXTURE_WRAP_T, sampler->wrap[1]);
        glSamplerParameteri(mesh->samplers[m], GL_TEXTURE_MIN_FILTER, sampler->far);
        glSamplerParameteri(mesh->samplers[m], GL_TEXTURE_MAG_FILTER, sampler->near);
    }
    for (int p = 0; p < mesh->part_count; p++) {
        struct posed_part *part = &mesh->parts[p];
        const int material = part->own->material, image = material >= 0 ? gltf->materials[material].image : -1;
        part->picture = image >= 0 ? mesh->pictures[image] : 0;
        part->sampler = material >= 0 ? mesh->samplers[material] : 0;
    }
    return bytes;
}

/// Also frees its memory.
static void delete_mesh(struct posed *mesh)
{
    glDeleteVertexArrays(1, &mesh->vertex_array);
    glDeleteBuffers(3, (const GLuint[]){mesh->moving_buffer, mesh->look_buffer, mesh->index_buffer});
    glDeleteTextures(mesh->picture_count, mesh->pictures);
    glDeleteSamplers(mesh->sampler_count, mesh->samplers);
    posed_free(mesh);
}

// --- the cache

enum { PICTURE_UNIT = 1 };
enum { EDGES = 768, CORNERS = SKIRT_CORNERS * EDGES }; ///< edges whose skirts are drawn in one call
/// The cache holds more meshes than a picture shows; a mesh unused for FORGOTTEN pictures is freed.
enum { MAX_KEPT = STAGE_MAX_MODELS + 4, FORGOTTEN = 1000 };

static const float PHASE_LINE = 1.25f; ///< logical pixels

/// A cached mesh.
struct kept {
    uint64_t id; ///< of the file; 0: none
    long used;   ///< number of the last picture that showed it
    struct posed mesh;
    float shade[2]; ///< heights: the ground's, and how far above it the ground's shade reaches
    float blink;
};

/// Laid out like meshes, at fixed addresses: llvmpipe recompiles a shader for each layout, and Mesa is slow if a vertex array changes
/// often.
struct skirts {
    float place[CORNERS][3], normal[CORNERS][3];
    struct posed_look look[CORNERS];
};

struct stage_renderer {
    struct program programs[PROGRAMS];
    struct stage_flat flat;
    struct kept kept[MAX_KEPT];
    const struct kept *shown[STAGE_MAX_MODELS]; ///< in this picture
    int shown_count;
    long clock; ///< counts pictures
    GLuint white;
    GLuint behind; ///< the background's picture
    uint64_t behind_id;
    GLuint skirt_array, skirt_buffer, skirt_indices;
    struct skirts *skirts;
};

static long add_model(struct stage_renderer *stage, const struct stage_model *shown, const float eye[3])
{
    const struct model_pose *posed = &shown->posed;
    const struct gltf *gltf = posed->gltf;
    struct kept *found = NULL, *oldest = stage->kept;
    long bytes = 0;

    // A cached mesh of this file that this picture does not use yet, as several rigs may share a file. Otherwise an empty entry, after freeing
    // the least recently used mesh and all unused for long.
    for (struct kept *kept = stage->kept; kept < stage->kept + MAX_KEPT && !found; kept++) {
        if (kept->id == gltf->id && kept->used < stage->clock) found = kept;
        if (kept->used < oldest->used) oldest = kept;
    }
    for (struct kept *kept = stage->kept; kept < stage->kept + MAX_KEPT && !found; kept++) {
        if (kept != oldest && stage->clock - kept->used <= FORGOTTEN) continue;
        delete_mesh(&kept->mesh);
        *kept = (struct kept){0};
    }
    struct kept *kept = found ? found : oldest;
    struct posed *mesh = &kept->mesh;
    if (kept->id == 0) {
        posed_from_gltf(mesh, gltf);
        bytes += upload_mesh(mesh, gltf);
    }
    if (posed_map(mesh, shown)) {
        const size_t size = (size_t)mesh->vertex_count * sizeof *mesh->looks;
        glBindBuffer(GL_ARRAY_BUFFER, mesh->look_buffer);
        glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)size, mesh->looks, GL_STATIC_DRAW);
        bytes += (long)size;
    }
    posed_pose(mesh, shown, eye);
    const GLsizeiptr half = (GLsizeiptr)((size_t)mesh->vertex_count * sizeof *mesh->place);
    glBindBuffer(GL_ARRAY_BUFFER, mesh->moving_buffer);
    glBufferData(GL_ARRAY_BUFFER, 2 * half, NULL, GL_STREAM_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, 0, half, mesh->place);
    glBufferSubData(GL_ARRAY_BUFFER, half, half, mesh->normal);
    kept->id = gltf->id;
    kept->used = stage->clock;
    kept->shade[0] = posed->ground;
    kept->shade[1] = shown->dusk;
    kept->blink = gltf->weight_count > 0 && !posed->figure ? posed->pose->weights[0] : 0.0f;
    stage->shown[stage->shown_count++] = kept;
    return bytes + 2 * (long)half;
}

// --- the picture of the meshes

/// The program for a part's surface or its skirts.
static enum stage_program program_of(const struct posed_part *part, bool skirts)
{
    return skirts && part->program == PROGRAM_PLAIN ? PROGRAM_PICTURED : part->program;
}

static void use_material(const struct stage_renderer *stage, const struct program *program,
                         const struct posed_part *part, bool skirts)
{
    const bool is_pictured = part->program == PROGRAM_PICTURED;
    glUniform4fv(program->at[AT_BASE], 1, part->material->color);
    glUniform1f(program->at[AT_CUTOFF], part->material->cutoff);
    glUniform1i(program->at[AT_BLENDED], part->material->blended);
    glUniform1i(program->at[AT_BOTH_SIDES], part->material->double_sided && !skirts);
    glBindTexture(GL_TEXTURE_2D, is_pictured && part->picture ? part->picture : stage->white);
    glBindSampler(PICTURE_UNIT, part->sampler);
}

enum kind { SOLID, MASKED, BLENDED };

static enum kind kind_of(const struct posed_part *part)
{
    if (part->material->blended) return BLENDED;
    return part->material->cutoff > 0.0f ? MASKED : SOLID;
}

static void draw_parts(const struct stage_renderer *stage, const struct posed *mesh, enum stage_program program,
                       enum kind first, enum kind last)
{
    for (int p = 0; p < mesh->part_count; p++) {
        const struct posed_part *part = &mesh->parts[p];
        if (part->program != program || kind_of(part) < first || kind_of(part) > last) continue;
        use_material(stage, &stage->programs[program], part, false);
        glFrontFace(part->mirrored ? GL_CW : GL_CCW);
        if (part->material->double_sided) glDisable(GL_CULL_FACE);
        glDrawElements(GL_TRIANGLES, part->end - part->first, GL_UNSIGNED_INT,
                       (const void *)((size_t)part->first * sizeof *mesh->indices));
        glEnable(GL_CULL_FACE);
    }
    glFrontFace(GL_CCW);
}

static void draw_edges(const struct stage_renderer *stage, int count)
{
    if (count == 0) return;
    glBindBuffer(GL_ARRAY_BUFFER, stage->skirt_buffer);
    const struct skirts *skirts = stage->skirts;
    const size_t corners = (size_t)(SKIRT_CORNERS * count), looks = corners * sizeof *skirts->look;
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(offsetof(struct skirts, look) + looks), NULL, GL_STREAM_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, offsetof(struct skirts, place), (GLsizeiptr)(corners * sizeof *skirts->place),
                    skirts->place);
    glBufferSubData(GL_ARRAY_BUFFER, offsetof(struct skirts, normal), (GLsizeiptr)(corners * sizeof *skirts->normal),
                    skirts->normal);
    glBufferSubData(GL_ARRAY_BUFFER, offsetof(struct skirts, look), (GLsizeiptr)looks, skirts->look);
    glDrawElements(GL_TRIANGLES, 6 * count, GL_UNSIGNED_SHORT, NULL);
}

static void draw_skirts(const struct stage_renderer *stage, const struct posed *mesh, enum stage_program program,
                        const float eye[3], float seam)
{
    glBindVertexArray(stage->skirt_array);
    glDisable(GL_CULL_FACE);
    for (int p = 0; p < mesh->part_count; p++) {
        const struct posed_part *part = &mesh->parts[p];
        int count = 0;
        if (program_of(part, true) != program) continue;
        use_material(stage, &stage->programs[program], part, true);
        for (int i = skirt_next(mesh, part, part->first); i < part->end; i = skirt_next(mesh, part, i + 1)) {
            struct skirts *skirts = stage->skirts;
            const int at = SKIRT_CORNERS * count;
            skirt_hang(mesh, part, i, eye, seam, skirts->place + at, skirts->normal + at, skirts->look + at);
            if (++count < EDGES) continue;
            draw_edges(stage, count);
            count = 0;
        }
        draw_edges(stage, count);
    }
    glEnable(GL_CULL_FACE);
}

/// `scale` is device pixels per logical pixel. `seam` is metres per pixel at a distance of 1 m in the pass that softens outlines, else 0.
static void draw_meshes(const struct stage_renderer *stage, const struct stage_view *view, float scale, float seam)
{
    const bool second = seam > 0.0f;
    const mat4s clip_from_world = clip_from_world_of(view);
    struct corner bounce;
    set_color(&bounce, view->colors.bounce, 1.0f);
    for (int k = 0; k < 3; k++) bounce.color[k] = srgb_to_linear(bounce.color[k]);
    glActiveTexture(GL_TEXTURE0 + PICTURE_UNIT);
    for (enum stage_program which = 0; which < PROGRAM_FLAT; which++) {
        const struct program *program = &stage->programs[which];
        for (int s = 0; s < stage->shown_count; s++) {
            const struct kept *shown = stage->shown[s];
            const struct posed *mesh = &shown->mesh;
            int p = mesh->part_count;
            while (--p >= 0 && program_of(&mesh->parts[p], second) != which) continue;
            if (p < 0) continue;
            glUseProgram(program->name);
            glUniformMatrix4fv(program->at[AT_CLIP_FROM_WORLD], 1, GL_FALSE, clip_from_world.raw[0]);
            glUniform3fv(program->at[AT_EYE], 1, view->eye);
            glUniform3fv(program->at[AT_KEY_FROM], 1, view->key_from);
            glUniform3fv(program->at[AT_EARTH], 1, bounce.color);
            glUniform1f(program->at[AT_SEAM], seam);
            glUniform2fv(program->at[AT_SHADE], 1, shown->shade);
            glUniform1f(program->at[AT_BLINK], shown->blink);
            glUniform1f(program->at[AT_LINE], mesh->phases ? PHASE_LINE * scale : 0.0f);
            glBindVertexArray(mesh->vertex_array);
            if (second) {
                // Masked surfaces again, because their edges fade over the background.
                draw_parts(stage, mesh, which, MASKED, MASKED);
                draw_skirts(stage, mesh, which, view->eye, seam);
                continue;
            }
            glEnable(GL_BLEND);
            draw_parts(stage, mesh, which, SOLID, MASKED);
            glDepthMask(GL_FALSE);
            draw_parts(stage, mesh, which, BLENDED, BLENDED);
            glDepthMask(GL_TRUE);
            glDisable(GL_BLEND);
        }
    }
    glBindSampler(PICTURE_UNIT, 0);
    glActiveTexture(GL_TEXTURE0);
    glBindVertexArray(0);
}

// --- the whole stage

struct stage_renderer *stage_renderer_create(struct error *error)
{
    struct stage_renderer *stage = need_zeroed(1, sizeof *stage);
    for (int p = 0; p < PROGRAMS; p++) {
        struct program *program = &stage->programs[p];
        program->name = gl_program(sources[p].vertex, sources[p].fragment, sources[p].define, error);
        for (int u = 0; program->name && u < UNIFORMS; u++)
            program->at[u] = glGetUniformLocation(program->name, uniform_names[u]);
        if (program->name) continue;
        stage_renderer_destroy(stage);
        return NULL;
    }

    glGenVertexArrays(1, &stage->flat.vertex_array);
    glBindVertexArray(stage->flat.vertex_array);
    stage->flat.vertices = gl_buffer(GL_ARRAY_BUFFER, sizeof stage->flat.corners, NULL, GL_DYNAMIC_DRAW);
    gl_attribute(0, 4, GL_FLOAT, sizeof(struct corner), offsetof(struct corner, clip));
    gl_attribute(1, 2, GL_FLOAT, sizeof(struct corner), offsetof(struct corner, local));
    gl_attribute(2, 4, GL_FLOAT, sizeof(struct corner), offsetof(struct corner, color));
    glBindVertexArray(0);

    float head_from_bind[16];
    fox_head_from_bind(head_from_bind);
    glUseProgram(stage->programs[PROGRAM_FACE].name);
    glUniformMatrix4fv(stage->programs[PROGRAM_FACE].at[AT_HEAD_FROM_BIND], 1, GL_FALSE, head_from_bind);
    glUseProgram(stage->programs[PROGRAM_PICTURED].name);
    glUniform1i(stage->programs[PROGRAM_PICTURED].at[AT_PICTURE], PICTURE_UNIT);
    stage->white = gl_picture((const unsigned char[]){255, 255, 255, 255}, 1, 1);

    static const uint16_t quad[] = {0, 1, 2, 0, 2, 3};
    uint16_t *indices = need(6 * EDGES, sizeof *indices);
    for (int i = 0; i < 6 * EDGES; i++) indices[i] = (uint16_t)(SKIRT_CORNERS * (i / 6) + quad[i % 6]);
    stage->skirts = need(1, sizeof *stage->skirts);
    glGenVertexArrays(1, &stage->skirt_array);
    glBindVertexArray(stage->skirt_array);
    stage->skirt_buffer = gl_buffer(GL_ARRAY_BUFFER, sizeof *stage->skirts, NULL, GL_STREAM_DRAW);
    gl_attribute(POSED_PLACE, 3, GL_FLOAT, 0, offsetof(struct skirts, place));
    gl_attribute(POSED_NORMAL, 3, GL_FLOAT, 0, offsetof(struct skirts, normal));
    set_look_attributes(sizeof *stage->skirts->look, offsetof(struct skirts, look));
    stage->skirt_indices = gl_buffer(GL_ELEMENT_ARRAY_BUFFER, 6 * EDGES * sizeof *indices, indices, GL_STATIC_DRAW);
    glBindVertexArray(0);
    free(indices);
    return stage;
}

void stage_renderer_destroy(struct stage_renderer *stage)
{
    if (!stage) return;
    for (int p = 0; p < PROGRAMS; p++) glDeleteProgram(stage->programs[p].name);
    glDeleteVertexArrays(1, &stage->flat.vertex_array);
    glDeleteBuffers(1, &stage->flat.vertices);
    for (int i = 0; i < MAX_KEPT; i++) delete_mesh(&stage->kept[i].mesh);
    glDeleteTextures(2, (const GLuint[]){stage->white, stage->behind});
    glDeleteVertexArrays(1, &stage->skirt_array);
    glDeleteBuffers(2, (const GLuint[]){stage->skirt_buffer, stage->skirt_indices});
    free(stage->skirts);
    free(stage);
}

void stage_upload(struct stage_renderer *stage, const struct stage_view *view, long *bytes)
{
    stage->clock++;
    stage->shown_count = 0;
    for (int m = 0; m < view->model_count; m++) *bytes += add_model(stage, &view->models[m], view->eye);

    const struct png_picture *behind = &view->behind;
    if (behind->pixels && view->behind_id != stage->behind_id) {
        if (!stage->behind) stage->behind = gl_picture(behind->pixels, 1, 1);
        glBindTexture(GL_TEXTURE_2D, stage->behind);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, behind->width, behind->height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     behind->pixels);
        *bytes += 4L * behind->width * behind->height;
        stage->behind_id = view->behind_id;
    }

    // The ground is as large as the largest figure needs.
    float largest = 0.0f;
    for (int k = 0; k < 3; k++) {
        for (int m = 0; m < view->model_count; m++)
            largest = fmaxf(largest, view->models[m].hi[k] - view->models[m].lo[k]);
    }
    const float scale = largest > LARGE ? largest / LARGE : largest > 0.0f ? fminf(largest / SMALL, 1.0f) : 1.0f;
    const float radius = GROUND_RADIUS * (view->has_tail ? fmaxf(scale, 1.0f) : scale);

    struct stage_flat *flat = &stage->flat;
    const float ground = lowest_ground(view);
    const mat4s clip_from_world = clip_from_world_of(view);
    flat->quads = 0;
    for (int c = 0; c < FLAT_CORNERS; c++) {
        flat->corners[flat->quads * FLAT_CORNERS + c] =
            (struct corner){.clip = {square[c][0], square[c][1], 0.0f, 1.0f}};
    }
    flat->quads++;
    add_disc(flat, clip_from_world, view->middle[0], ground, view->middle[1], radius, view->colors.ground, 1.0f);
    for (int b = 0; b < view->blob_count; b++) {
        const struct shadow_blob *blob = &view->blobs[b];
        add_disc(flat, clip_from_world, blob->x, ground, blob->z, blob->radius, view->colors.shadow, blob->strength);
    }
    const long flat_bytes = flat->quads * FLAT_CORNERS * (long)sizeof *flat->corners;
    glBindBuffer(GL_ARRAY_BUFFER, flat->vertices);
    glBufferSubData(GL_ARRAY_BUFFER, 0, flat_bytes, flat->corners);
    *bytes += flat_bytes;
}

/// Background, ground and shadows cover the viewport.
static void draw_flat(struct stage_renderer *stage, const struct stage_view *view, int x, int y, int width,
                      int height)
{
    const struct program *program = &stage->programs[view->behind.pixels ? PROGRAM_BACKED : PROGRAM_FLAT];
    struct corner top, bottom;
    set_color(&top, view->colors.top, 1.0f);
    set_color(&bottom, view->colors.bottom, 1.0f);
    glUseProgram(program->name);
    glUniform3fv(program->at[AT_TOP], 1, top.color);
    glUniform3fv(program->at[AT_BOTTOM], 1, bottom.color);
    glUniform4f(program->at[AT_PLACE], (float)x, (float)y, 1.0f / (float)width, 1.0f / (float)height);
    if (view->behind.pixels) { // as large as fits
        const float aspect = (float)width / (float)height * (float)view->behind.height / (float)view->behind.width;
        glUniform2f(program->at[AT_FIT], fmaxf(aspect, 1.0f), fmaxf(1.0f / aspect, 1.0f));
        glBindTexture(GL_TEXTURE_2D, stage->behind);
    }
    glUniform1i(program->at[AT_SHADOW], false);
    glBindVertexArray(stage->flat.vertex_array);
    glEnable(GL_BLEND);
    glDepthFunc(GL_ALWAYS);
    glDepthRange(1, 1); // makes the quad write the largest depth, which clears it
    glDrawArrays(GL_TRIANGLES, 0, (view->behind.pixels ? 1 : SCENERY) * FLAT_CORNERS); // no ground covers a picture
    glUniform1i(program->at[AT_SHADOW], true);
    glDrawArrays(GL_TRIANGLES, SCENERY * FLAT_CORNERS, (stage->flat.quads - SCENERY) * FLAT_CORNERS);
    glDisable(GL_BLEND);
    glDepthRange(0, 1);
    glBindVertexArray(0);
}

void stage_draw(struct stage_renderer *stage, const struct stage_view *view, int x, int y, int width, int height,
                bool transparent)
{
    const float scale = (float)height / view->viewport.h, seam = 2.0f / (view->projection[5] * (float)height);
    glViewport(x, y, width, height);
    glEnable(GL_DEPTH_TEST);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    if (transparent)
        glClear(GL_DEPTH_BUFFER_BIT);
    else
        draw_flat(stage, view, x, y, width, height);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    draw_meshes(stage, view, scale, 0.0f);
    // Anti-aliased edges without multisampling: skirts (draw/posed.h) fade out over the background or the animal itself.
    glEnable(GL_BLEND);
    if (!transparent) draw_meshes(stage, view, scale, seam);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
}
