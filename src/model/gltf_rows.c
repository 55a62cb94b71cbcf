/// Reads the attributes of a part's vertices.
#include "model/gltf_read.h"
#include <math.h>
#include <stdlib.h>

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

bool gltf_rows(struct gltf_reader *r, const json_t *attributes, const char *name, int width,
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
static void normalise(uint16_t joints[GLTF_INFLUENCES], float weights[GLTF_INFLUENCES])
{
    double sum = 0;
    for (int k = 0; k < GLTF_INFLUENCES; k++) sum += (double)weights[k];
    if (!(sum > 0)) weights[0] = 1, sum = 1;
    for (int k = 0; k < GLTF_INFLUENCES; k++) {
        weights[k] = (float)((double)weights[k] / sum);
        if (weights[k] <= 0) joints[k] = 0;
    }
}

bool gltf_read_influences(struct gltf_reader *r, const json_t *attributes, const struct gltf_vertices *vertices,
                          struct gltf_part *part, int *joints)
{
    if (!json_object_get(attributes, "JOINTS_0")) return true;
    part->joints = gltf_make(r, (size_t)vertices->count, sizeof *part->joints);
    part->weights = part->joints ? gltf_make(r, (size_t)vertices->count, sizeof *part->weights) : NULL;
    if (!part->weights || !read_four(r, attributes, 0, vertices, part)) return false;
    if (json_object_get(attributes, "JOINTS_1") && !read_four(r, attributes, 1, vertices, part)) return false;
    for (int i = 0; i < vertices->count; i++) {
        normalise(part->joints[i], part->weights[i]);
        for (int k = 0; k < GLTF_INFLUENCES; k++)
            if (part->joints[i][k] >= *joints) *joints = part->joints[i][k] + 1;
    }
    return !json_object_get(attributes, "JOINTS_2") || gltf_not_shown(r, "more than 8 joints a vertex");
}
