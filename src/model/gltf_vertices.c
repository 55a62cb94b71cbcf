/// Reads the vertices of a part's vertices.
#include "model/gltf_read.h"
#include "model/vector.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// The numbers of an attribute, as many as the part has vertices in the file.
static bool read_numbers(struct gltf_reader *r, const json_t *attributes, const char *name, int least, int most,
                         int count, struct glb_numbers *numbers)
{
    if (!glb_numbers(&r->file, glb_integer(attributes, name, -1), numbers, r->error)) return false;
    if (numbers->components >= least && numbers->components <= most && numbers->count == count) return true;
    gltf_bad(r, ".attributes.%s: expected %d elements of %d numbers, got %d of %d", name, count, most, numbers->count,
             numbers->components);
    free(numbers->values);
    return false;
}

/// Where a vertex has its numbers.
static const double *row_of(const struct glb_numbers *numbers, const struct gltf_vertices *vertices, int vertex)
{
    size_t row = vertices->order ? vertices->order[vertex] : (size_t)vertex;
    return numbers->values + row * (size_t)numbers->components;
}

/// An attribute as rows of `width` floats, NULL where it is missing. Of four, a missing fourth is 1.
static bool read_rows(struct gltf_reader *r, const json_t *attributes, const char *name, int width,
                      const struct gltf_vertices *vertices, float **rows)
{
    struct glb_numbers numbers;
    if (!json_object_get(attributes, name)) return true;
    if (!read_numbers(r, attributes, name, width == 4 ? 3 : width, width, vertices->in_file, &numbers)) return false;
    float *row = *rows = gltf_make(r, (size_t)vertices->count, (size_t)width * sizeof **rows);
    for (int i = 0; row && i < vertices->count; i++, row += width) {
        const double *from = row_of(&numbers, vertices, i);
        for (int k = 0; k < width; k++) row[k] = k < numbers.components ? (float)from[k] : 1;
    }
    free(numbers.values);
    return *rows;
}

/// Adds four influences, from `first`, to each vertex.
static bool read_four(struct gltf_reader *r, const json_t *attributes, int set, const struct gltf_vertices *vertices,
                      struct gltf_part *part)
{
    struct glb_numbers joints, weights;
    char name[2][16] = {"JOINTS_0", "WEIGHTS_0"};
    bool whole = true;
    name[0][7] = name[1][8] = (char)('0' + set);
    if (!read_numbers(r, attributes, name[0], 4, 4, vertices->in_file, &joints)) return false;
    if (!read_numbers(r, attributes, name[1], 4, 4, vertices->in_file, &weights)) {
        free(joints.values);
        return false;
    }
    for (int n = 0; whole && n < 4 * vertices->count; n++) {
        int vertex = n / 4, k = n % 4;
        double joint = row_of(&joints, vertices, vertex)[k], weight = row_of(&weights, vertices, vertex)[k];
        whole = joint >= 0 && joint <= UINT16_MAX && joint == floor(joint) && weight < 1e6;
        part->joints[vertex][4 * set + k] = whole ? (uint16_t)joint : 0;
        part->weights[vertex][4 * set + k] = weight > 0 ? (float)weight : 0;
    }
    free(joints.values);
    free(weights.values);
    return whole ||
           gltf_bad(r, ".attributes.%s: expected numbers of joints, and weights from 0 to 1, got others", name[0]);
}

/// Weights whose sum is 1; a vertex without any follows its first joint.
static void share_out(uint16_t joints[GLTF_INFLUENCES], float weights[GLTF_INFLUENCES])
{
    double sum = 0;
    for (int k = 0; k < GLTF_INFLUENCES; k++) sum += (double)weights[k];
    if (!(sum > 0)) weights[0] = 1, sum = 1;
    for (int k = 0; k < GLTF_INFLUENCES; k++) {
        weights[k] = (float)((double)weights[k] / sum);
        if (weights[k] <= 0) joints[k] = 0;
    }
}

/// Joints and weights, up to eight a vertex.
static bool read_influences(struct gltf_reader *r, const json_t *attributes, const struct gltf_vertices *vertices,
                            struct gltf_part *part)
{
    if (!json_object_get(attributes, "JOINTS_0")) return true;
    part->joints = gltf_make(r, (size_t)vertices->count, sizeof *part->joints);
    part->weights = part->joints ? gltf_make(r, (size_t)vertices->count, sizeof *part->weights) : NULL;
    if (!part->weights || !read_four(r, attributes, 0, vertices, part)) return false;
    if (json_object_get(attributes, "JOINTS_1") && !read_four(r, attributes, 1, vertices, part)) return false;
    for (int i = 0; i < vertices->count; i++) share_out(part->joints[i], part->weights[i]);
    return !json_object_get(attributes, "JOINTS_2") || gltf_not_shown(r, "more than 8 joints a vertex");
}

static void normalise(float (*normal)[3], int count)
{
    for (int i = 0; normal && i < count; i++) {
        float length = glm_vec3_norm(normal[i]);
        if (fabsf(length - 1) < 1e-6f) continue; // ours stay as they are, to the bit
        if (length > 0 && isfinite(length)) {
            glm_vec3_divs(normal[i], length, normal[i]);
        } else {
            glm_vec3_copy((vec3){0, 1, 0}, normal[i]);
        }
    }
}

/// What glTF wants where there are no normals: each triangle with vertices of its own, and flat.
static bool make_flat(struct gltf_reader *r, struct gltf_part *part)
{
    part->normal = gltf_make(r, (size_t)part->vertex_count, sizeof *part->normal);
    for (int i = 0; part->normal && i + 2 < part->index_count; i += 3) {
        float(*corner)[3] = part->position + i;
        vec3s normal = triangle_normal(corner[0], corner[1], corner[2]);
        for (int k = 0; k < 3; k++) glm_vec3_copy(normal.raw, part->normal[i + k]);
    }
    return part->normal;
}

static bool read_targets(struct gltf_reader *r, const json_t *targets, const struct gltf_vertices *vertices,
                         int count, struct gltf_part *part)
{
    if ((size_t)count != json_array_size(targets))
        return gltf_bad(r, ".targets: expected %d as in the mesh's first primitive, got %zu", count,
                        json_array_size(targets));
    part->targets = gltf_make(r, (size_t)count, sizeof *part->targets);
    for (int i = 0; part->targets && i < count; i++) {
        const json_t *target = json_array_get(targets, (size_t)i);
        float *position = NULL, *normal = NULL;
        bool read = read_rows(r, target, "POSITION", 3, vertices, &position) &&
                    (vertices->order || r->stored || read_rows(r, target, "NORMAL", 3, vertices, &normal));
        part->targets[i] = (struct gltf_target){(float(*)[3])position, (float(*)[3])normal};
        if (!read) return false;
    }
    return part->targets;
}

/// What the fox has and no standard names; in other files what is called so may be anything, and is left out unless it suits.
static bool read_coat(struct gltf_reader *r, const json_t *attributes, const struct gltf_vertices *vertices,
                      struct gltf_part *part)
{
    static const char *const names[] = {"_MARK", "_FUR"};
    const json_t *accessors = gltf_array(r, "accessors");
    float *rows[2] = {NULL, NULL};
    for (int i = 0; i < 2; i++) {
        const json_t *accessor = json_array_get(accessors, (size_t)glb_integer(attributes, names[i], -1));
        const char *shape = json_string_value(json_object_get(accessor, "type"));
        if (!shape || strcmp(shape, i ? "VEC2" : "VEC3") != 0 ||
            glb_integer(accessor, "count", -1) != vertices->in_file)
            return true;
    }
    const bool read = read_rows(r, attributes, names[0], 3, vertices, &rows[0]) &&
                      read_rows(r, attributes, names[1], 2, vertices, &rows[1]);
    part->mark = (float(*)[3])rows[0];
    part->fur = (float(*)[2])rows[1];
    return read;
}

bool gltf_read_vertices(struct gltf_reader *r, const json_t *primitive, const struct gltf_vertices *vertices,
                        int targets, struct gltf_part *part)
{
    const json_t *attributes = json_object_get(primitive, "attributes");
    float *position = NULL, *normal = NULL, *color = NULL;
    part->vertex_count = vertices->count;
    bool read = read_rows(r, attributes, "POSITION", 3, vertices, &position) &&
                (vertices->order || read_rows(r, attributes, "NORMAL", 3, vertices, &normal)) &&
                read_rows(r, attributes, "COLOR_0", 4, vertices, &color);
    part->position = (float(*)[3])position;
    part->normal = (float(*)[3])normal;
    part->color = (float(*)[4])color;
    if (!read || (vertices->order && !make_flat(r, part))) return false;
    normalise(part->normal, part->vertex_count);
    return read_coat(r, attributes, vertices, part) && read_influences(r, attributes, vertices, part) &&
           read_targets(r, json_object_get(primitive, "targets"), vertices, targets, part);
}

// --- texture coordinates

/// Puts texture coordinates where the material has them on its texture (KHR_texture_transform).
static void place_uv(const struct gltf_uv *uv, float (*at)[2], int count)
{
    float c = cosf(uv->rotation), s = sinf(uv->rotation);
    for (int i = 0; at && i < count; i++) {
        float u = at[i][0] * uv->scale[0], v = at[i][1] * uv->scale[1];
        at[i][0] = c * u + s * v + uv->offset[0];
        at[i][1] = -s * u + c * v + uv->offset[1];
    }
}

bool gltf_read_uv(struct gltf_reader *r, const json_t *attributes, const struct gltf_vertices *vertices,
                  struct gltf_part *part)
{
    static const struct gltf_uv plain = {.scale = {1, 1}};
    const struct gltf_uv *uv = part->material >= 0 ? &r->uvs[part->material] : &plain;
    char name[32];
    float *rows = NULL;
    snprintf(name, sizeof name, "TEXCOORD_%d", uv->set);
    if (!read_rows(r, attributes, name, 2, vertices, &rows)) {
        free(rows);
        return false;
    }
    part->uv = (float(*)[2])rows;
    place_uv(uv, part->uv, vertices->count);
    return true;
}
