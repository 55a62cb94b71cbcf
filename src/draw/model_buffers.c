/// Uploads imported characters and their poses.
#include "draw/model_buffers.h"
#include "base/need.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>

enum { POSITION, NORMAL, UV, COLOR, JOINTS, MORE_JOINTS, WEIGHTS, MORE_WEIGHTS }; // locations in stage_model.vert

/// The arrays of a part one after the other; where each begins.
struct offsets {
    size_t normal, uv, color, joints, weights, end;
};

static struct offsets offsets_of(const struct gltf_part *part)
{
    const size_t count = (size_t)part->vertex_count;
    struct offsets at = {.normal = count * sizeof *part->position};
    at.uv = at.normal + count * sizeof *part->normal;
    at.color = at.uv + (part->uv ? count * sizeof *part->uv : 0);
    at.joints = at.color + (part->color ? count * sizeof *part->color : 0);
    at.weights = at.joints + (part->joints ? count * sizeof *part->joints : 0);
    at.end = at.weights + (part->joints ? count * sizeof *part->weights : 0);
    return at;
}

static void fill(char *to, size_t from, size_t end, const void *data)
{
    if (end > from) memcpy(to + from, data, end - from);
}

/// A buffer of the part's arrays, filled in one go: memory that drawing reads is not written again. Where it is short, it holds what it will.
static void fill_vertices(const struct gltf_part *part, const struct offsets *at)
{
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)at->end, NULL, GL_STATIC_DRAW);
    char *to =
        glMapBufferRange(GL_ARRAY_BUFFER, 0, (GLsizeiptr)at->end, GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (!to) return;
    fill(to, 0, at->normal, part->position);
    fill(to, at->normal, at->uv, part->normal);
    fill(to, at->uv, at->color, part->uv);
    fill(to, at->color, at->joints, part->color);
    fill(to, at->joints, at->weights, part->joints);
    fill(to, at->weights, at->end, part->weights);
    glUnmapBuffer(GL_ARRAY_BUFFER);
}

static long upload_part(const struct gltf_part *part, GLuint *vertices, GLuint *indices)
{
    const struct offsets at = offsets_of(part);
    const size_t index_bytes = (size_t)part->index_count * sizeof *part->indices;
    glGenBuffers(1, vertices);
    glBindBuffer(GL_ARRAY_BUFFER, *vertices);
    fill_vertices(part, &at);
    glGenBuffers(1, indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, *indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)index_bytes, part->indices, GL_STATIC_DRAW);
    return (long)(at.end + index_bytes);
}

static void floats(GLuint index, GLint size, GLsizei stride, size_t offset)
{
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, stride, (const void *)offset);
}

static void whole(GLuint index, size_t offset)
{
    glEnableVertexAttribArray(index);
    glVertexAttribIPointer(index, 4, GL_UNSIGNED_SHORT, sizeof(uint16_t[GLTF_INFLUENCES]), (const void *)offset);
}

/// What has no array takes the values that model_attributes_standard() sets.
static void shape_create(struct model_shape *shape, const struct gltf_part *part, GLuint vertices, GLuint indices,
                         bool morphs)
{
    const struct offsets at = offsets_of(part);
    const GLsizei stride = sizeof *part->weights;
    glGenVertexArrays(1, &shape->vertex_array);
    glBindVertexArray(shape->vertex_array);
    if (morphs) {
        glGenBuffers(1, &shape->morphed);
        glBindBuffer(GL_ARRAY_BUFFER, shape->morphed);
        glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)at.uv, NULL, GL_DYNAMIC_DRAW);
    } else {
        glBindBuffer(GL_ARRAY_BUFFER, vertices);
    }
    floats(POSITION, 3, 0, 0);
    floats(NORMAL, 3, 0, at.normal);
    glBindBuffer(GL_ARRAY_BUFFER, vertices);
    if (part->uv) floats(UV, 2, 0, at.uv);
    if (part->color) floats(COLOR, 4, 0, at.color);
    if (part->joints) {
        whole(JOINTS, at.joints);
        whole(MORE_JOINTS, at.joints + 4 * sizeof(uint16_t));
        floats(WEIGHTS, 4, stride, at.weights);
        floats(MORE_WEIGHTS, 4, stride, at.weights + 4 * sizeof(float));
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    glBindVertexArray(0);
}

static long upload_pictures(struct model_buffers *buffers, const struct gltf *gltf)
{
    const int largest = gl_largest_texture();
    long bytes = 0;
    buffers->white = gl_white();
    for (int i = 0; i < gltf->image_count; i++) {
        const struct gltf_image *image = &gltf->images[i];
        if (!image->pixels || image->width > largest || image->height > largest) continue;
        buffers->pictures[i] = gl_picture(image->pixels, image->width, image->height);
        bytes += 4L * image->width * image->height;
    }
    buffers->image_count = gltf->image_count;
    return bytes;
}

static void create_samplers(struct model_buffers *buffers, const struct gltf *gltf)
{
    glGenSamplers(gltf->material_count, buffers->samplers);
    for (int m = 0; m < gltf->material_count; m++) {
        const struct gltf_sampler *sampler = &gltf->materials[m].sampler;
        const GLuint made = buffers->samplers[m];
        glSamplerParameteri(made, GL_TEXTURE_WRAP_S, sampler->wrap[0]);
        glSamplerParameteri(made, GL_TEXTURE_WRAP_T, sampler->wrap[1]);
        glSamplerParameteri(made, GL_TEXTURE_MIN_FILTER, sampler->far);
        glSamplerParameteri(made, GL_TEXTURE_MAG_FILTER, sampler->near);
    }
    buffers->material_count = gltf->material_count;
}

/// Gives each skin, and each mesh without one, its place among the matrices; returns how many there are.
static int lay_out_matrices(int *first, const struct gltf *gltf)
{
    int count = 0;
    for (int n = 0; n < gltf->node_count; n++) {
        const struct gltf_node *node = &gltf->nodes[n];
        first[n] = count;
        if (node->mesh >= 0) count += node->skin >= 0 ? gltf->skins[node->skin].joint_count : 1;
    }
    return count;
}

static void allocate(struct model_buffers *buffers, const struct gltf *gltf, int parts, int shapes)
{
    buffers->vertices = need_zeroed((size_t)parts + 1, sizeof *buffers->vertices);
    buffers->indices = need_zeroed((size_t)parts + 1, sizeof *buffers->indices);
    buffers->pictures = need_zeroed((size_t)gltf->image_count + 1, sizeof *buffers->pictures);
    buffers->samplers = need_zeroed((size_t)gltf->material_count + 1, sizeof *buffers->samplers);
    buffers->shapes = need_zeroed((size_t)shapes + 1, sizeof *buffers->shapes);
    buffers->weights = need_zeroed((size_t)gltf->weight_count + 1, sizeof *buffers->weights);
    buffers->first = need_zeroed((size_t)gltf->node_count + 1, sizeof *buffers->first);
    buffers->row_count = (lay_out_matrices(buffers->first, gltf) + MATRICES_A_ROW - 1) / MATRICES_A_ROW;
    buffers->rows = need_zeroed((size_t)buffers->row_count * FLOATS_A_ROW + 1, sizeof *buffers->rows);
}

static void create_matrices(struct model_buffers *buffers)
{
    glGenTextures(1, &buffers->matrices);
    glBindTexture(GL_TEXTURE_2D, buffers->matrices);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 3 * MATRICES_A_ROW, buffers->row_count > 0 ? buffers->row_count : 1, 0,
                 GL_RGBA, GL_FLOAT, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

/// The shapes of one node, whose mesh's parts begin at `part` in the buffers.
static void add_shapes(struct model_buffers *buffers, const struct gltf *gltf, int node, int part)
{
    const struct gltf_mesh *mesh = &gltf->meshes[gltf->nodes[node].mesh];
    for (int p = 0; p < mesh->part_count; p++) {
        struct model_shape *shape = &buffers->shapes[buffers->shape_count++];
        *shape = (struct model_shape){.node = node, .part = p};
        shape_create(shape, &mesh->parts[p], buffers->vertices[part + p], buffers->indices[part + p],
                     mesh->target_count > 0);
    }
}

long model_buffers_create(struct model_buffers *buffers, const struct gltf *gltf)
{
    int parts = 0, shapes = 0;
    *buffers = (struct model_buffers){.id = gltf->id};
    for (int m = 0; m < gltf->mesh_count; m++) parts += gltf->meshes[m].part_count;
    for (int n = 0; n < gltf->node_count; n++) {
        if (gltf->nodes[n].mesh >= 0) shapes += gltf->meshes[gltf->nodes[n].mesh].part_count;
    }
    allocate(buffers, gltf, parts, shapes);
    long bytes = upload_pictures(buffers, gltf);
    create_samplers(buffers, gltf);
    for (int m = 0; m < gltf->mesh_count; m++) {
        const int first = buffers->part_count;
        for (int p = 0; p < gltf->meshes[m].part_count; p++, buffers->part_count++) {
            bytes +=
                upload_part(&gltf->meshes[m].parts[p], &buffers->vertices[first + p], &buffers->indices[first + p]);
        }
        for (int n = 0; n < gltf->node_count; n++) {
            if (gltf->nodes[n].mesh == m) add_shapes(buffers, gltf, n, first);
        }
    }
    create_matrices(buffers);
    model_skirt_create(&buffers->skirt, gltf);
    for (int w = 0; w < gltf->weight_count; w++) buffers->weights[w] = NAN; // the first pose uploads all
    return bytes;
}

void model_buffers_free(struct model_buffers *buffers)
{
    for (int s = 0; s < buffers->shape_count; s++) {
        glDeleteVertexArrays(1, &buffers->shapes[s].vertex_array);
        glDeleteBuffers(1, &buffers->shapes[s].morphed);
    }
    glDeleteBuffers(buffers->part_count, buffers->vertices);
    glDeleteBuffers(buffers->part_count, buffers->indices);
    glDeleteTextures(buffers->image_count, buffers->pictures);
    glDeleteTextures(1, &buffers->white);
    glDeleteSamplers(buffers->material_count, buffers->samplers);
    glDeleteTextures(1, &buffers->matrices);
    free(buffers->vertices);
    free(buffers->indices);
    free(buffers->pictures);
    free(buffers->samplers);
    free(buffers->shapes);
    free(buffers->weights);
    free(buffers->first);
    free(buffers->rows);
    model_skirt_free(&buffers->skirt);
    *buffers = (struct model_buffers){0};
}

/// root · matrix as three rows.
static void write_rows(const float root[16], const float matrix[16], float *rows)
{
    const mat4s whole = glms_mat4_transpose(glms_mat4_mul(mat4_from(root), mat4_from(matrix)));
    memcpy(rows, whole.raw, 12 * sizeof *rows);
}

static long upload_matrices(struct model_buffers *buffers, const struct gltf *gltf, const struct gltf_pose *pose,
                            const float root[16])
{
    for (int n = 0; n < gltf->node_count; n++) {
        const struct gltf_node *node = &gltf->nodes[n];
        float *rows = buffers->rows + 12 * (size_t)buffers->first[n];
        if (node->mesh < 0) continue;
        if (node->skin < 0) write_rows(root, pose->world[n], rows);
        for (int j = 0; node->skin >= 0 && j < gltf->skins[node->skin].joint_count; j++) {
            write_rows(root, pose->joints[gltf->skins[node->skin].first_joint + j], rows + 12 * j);
        }
    }
    glBindTexture(GL_TEXTURE_2D, buffers->matrices);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 3 * MATRICES_A_ROW, buffers->row_count, GL_RGBA, GL_FLOAT, buffers->rows);
    return (long)buffers->row_count * FLOATS_A_ROW * (long)sizeof(float);
}

/// out = base + Σ weight · target
static void morph(const struct gltf_part *part, const float *weights, int targets, float (*position)[3],
                  float (*normal)[3])
{
    memcpy(position, part->position, (size_t)part->vertex_count * sizeof *position);
    memcpy(normal, part->normal, (size_t)part->vertex_count * sizeof *normal);
    for (int t = 0; t < targets; t++) {
        const struct gltf_target *target = &part->targets[t];
        const float weight = weights[t];
        if (weight == 0.0f) continue;
        for (int v = 0; target->position && v < part->vertex_count; v++) {
            for (int k = 0; k < 3; k++) position[v][k] += weight * target->position[v][k];
        }
        for (int v = 0; target->normal && v < part->vertex_count; v++) {
            for (int k = 0; k < 3; k++) normal[v][k] += weight * target->normal[v][k];
        }
    }
}

static long upload_morphed(const struct model_shape *shape, const struct gltf_mesh *mesh, const float *weights)
{
    const struct gltf_part *part = &mesh->parts[shape->part];
    const size_t bytes = offsets_of(part).uv;
    glBindBuffer(GL_ARRAY_BUFFER, shape->morphed);
    void *out =
        glMapBufferRange(GL_ARRAY_BUFFER, 0, (GLsizeiptr)bytes, GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (!out) return 0;
    float(*position)[3] = out;
    morph(part, weights, mesh->target_count, position, position + part->vertex_count);
    glUnmapBuffer(GL_ARRAY_BUFFER);
    return (long)bytes;
}

long model_buffers_pose(struct model_buffers *buffers, const struct gltf *gltf, const struct gltf_pose *pose,
                        const float root[16])
{
    if (!buffers->rows) return 0;
    long bytes = upload_matrices(buffers, gltf, pose, root);
    for (int s = 0; s < buffers->shape_count; s++) {
        const struct model_shape *shape = &buffers->shapes[s];
        const struct gltf_node *node = &gltf->nodes[shape->node];
        const struct gltf_mesh *mesh = &gltf->meshes[node->mesh];
        const float *weights = pose->weights + node->first_weight;
        if (!shape->morphed) continue;
        if (memcmp(weights, buffers->weights + node->first_weight, (size_t)mesh->target_count * sizeof *weights) == 0)
            continue;
        bytes += upload_morphed(shape, mesh, weights);
    }
    memcpy(buffers->weights, pose->weights, (size_t)gltf->weight_count * sizeof *pose->weights);
    return bytes;
}
