/// Reads meshes: vertices and morph targets, triangles, strips and fans.
#include "base/names.h"
#include "maths/maths.h"
#include "model/gltf_read.h"
#include "model/surface.h"
#include "model/vector.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINES = 1, TRIANGLES = 4, STRIP = 5, FAN = 6 };

// --- vertices

/// The numbers of an attribute, one element per vertex of the part in the file.
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

/// An attribute as rows of `width` floats; NULL if it is missing. A missing fourth component is 1.
static bool read_rows(struct gltf_reader *r, const json_t *attributes, const char *name, int width, int count,
                      void *array)
{
    struct glb_numbers numbers;
    if (!json_object_get(attributes, name)) return true;
    if (!read_numbers(r, attributes, name, width == 4 ? 3 : width, width, count, &numbers)) return false;
    float *const rows = gltf_make(r, (size_t)count, (size_t)width * sizeof *rows), *row = rows;
    memcpy(array, &rows, sizeof rows);
    const double *from = numbers.values;
    for (int i = 0; row && i < count; i++, row += width, from += numbers.components) {
        for (int k = 0; k < width; k++) row[k] = k < numbers.components ? (float)from[k] : 1;
    }
    free(numbers.values);
    return rows;
}

/// Adds four influences, from `first`, to each vertex.
static bool read_four(struct gltf_reader *r, const json_t *attributes, int set, struct gltf_part *part)
{
    struct glb_numbers joints, weights;
    char name[2][16] = {"JOINTS_0", "WEIGHTS_0"};
    bool whole = true;
    name[0][7] = name[1][8] = (char)('0' + set);
    if (!read_numbers(r, attributes, name[0], 4, 4, part->vertex_count, &joints)) return false;
    if (!read_numbers(r, attributes, name[1], 4, 4, part->vertex_count, &weights)) {
        free(joints.values);
        return false;
    }
    for (int n = 0; whole && n < 4 * part->vertex_count; n++) {
        int vertex = n / 4, k = n % 4;
        double joint = joints.values[n], weight = weights.values[n];
        whole = joint >= 0 && joint <= UINT16_MAX && joint == floor(joint) && weight < 1e6;
        part->joints[vertex][4 * set + k] = whole ? (uint16_t)joint : 0;
        part->weights[vertex][4 * set + k] = weight > 0 ? (float)weight : 0;
    }
    free(joints.values);
    free(weights.values);
    return whole ||
           gltf_bad(r, ".attributes.%s: expected numbers of joints, and weights from 0 to 1, got others", name[0]);
}

/// Makes weights sum to 1; a vertex without weights follows its first joint.
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

/// Joints and weights, up to eight per vertex.
static bool read_influences(struct gltf_reader *r, const json_t *attributes, struct gltf_part *part)
{
    if (!json_object_get(attributes, "JOINTS_0")) return true;
    for (int set = 0; set < 2; set++) {
        const char *const joints = set ? "JOINTS_1" : "JOINTS_0", *const weights = set ? "WEIGHTS_1" : "WEIGHTS_0";
        if (json_object_get(attributes, joints) && !json_object_get(attributes, weights))
            return gltf_bad(r, ".attributes: expected %s beside %s, got %s alone", weights, joints, joints);
    }
    part->joints = gltf_make(r, (size_t)part->vertex_count, sizeof *part->joints);
    part->weights = part->joints ? gltf_make(r, (size_t)part->vertex_count, sizeof *part->weights) : NULL;
    if (!part->weights || !read_four(r, attributes, 0, part)) return false;
    if (json_object_get(attributes, "JOINTS_1") && !read_four(r, attributes, 1, part)) return false;
    for (int i = 0; i < part->vertex_count; i++) share_out(part->joints[i], part->weights[i]);
    return !json_object_get(attributes, "JOINTS_2") || gltf_not_shown(r, "more than 8 joints a vertex");
}

static void normalise(float (*normal)[3], int count)
{
    for (int i = 0; normal && i < count; i++) {
        float length = glm_vec3_norm(normal[i]);
        if (fabsf(length - 1) < 1e-6f) continue; // already exact: keep the bits
        if (length > 0 && isfinite(length)) {
            glm_vec3_divs(normal[i], length, normal[i]);
        } else {
            glm_vec3_copy((vec3){0, 1, 0}, normal[i]);
        }
    }
}

/// A target that a part lacks leaves it alone.
static bool read_targets(struct gltf_reader *r, const json_t *targets, int count, struct gltf_part *part)
{
    part->targets = gltf_make(r, (size_t)count, sizeof *part->targets);
    for (int i = 0; part->targets && i < count; i++) {
        const json_t *target = json_array_get(targets, (size_t)i);
        struct gltf_target *to = &part->targets[i];
        if (!read_rows(r, target, "POSITION", 3, part->vertex_count, &to->position)) return false;
        if (part->normal && !r->stored && !read_rows(r, target, "NORMAL", 3, part->vertex_count, &to->normal))
            return false;
    }
    return part->targets;
}

/// The fox's own attributes, which glTF does not define. In other files these names may mean anything, so unsuitable ones are ignored.
static bool read_coat(struct gltf_reader *r, const json_t *attributes, struct gltf_part *part)
{
    static const char *const names[] = {"_MARK", "_FUR"};
    const json_t *accessors = gltf_array(r, "accessors");
    for (int i = 0; i < 2; i++) {
        const json_t *accessor = json_array_get(accessors, (size_t)glb_integer(attributes, names[i], -1));
        const char *shape = json_string_value(json_object_get(accessor, "type"));
        if (!shape || strcmp(shape, i ? "VEC2" : "VEC3") != 0 ||
            glb_integer(accessor, "count", -1) != part->vertex_count)
            return true;
    }
    return read_rows(r, attributes, names[0], 3, part->vertex_count, &part->mark) &&
           read_rows(r, attributes, names[1], 2, part->vertex_count, &part->fur);
}

/// Reads the attributes and targets of a part's vertices, except texture coordinates; missing ones are NULL.
static bool read_vertices(struct gltf_reader *r, const json_t *primitive, int targets, struct gltf_part *part)
{
    const json_t *attributes = json_object_get(primitive, "attributes");
    const int count = part->vertex_count;
    if (!read_rows(r, attributes, "POSITION", 3, count, &part->position) ||
        !read_rows(r, attributes, "NORMAL", 3, count, &part->normal) ||
        !read_rows(r, attributes, "COLOR_0", 4, count, &part->color))
        return false;
    normalise(part->normal, count);
    return read_coat(r, attributes, part) && read_influences(r, attributes, part) &&
           read_targets(r, json_object_get(primitive, "targets"), targets, part);
}

/// Moves texture coordinates to where the material has them on its texture (KHR_texture_transform).
static void place_uv(const struct gltf_uv *uv, float (*at)[2], int count)
{
    float c = maths_cosf(uv->rotation), s = maths_sinf(uv->rotation);
    for (int i = 0; at && i < count; i++) {
        float u = at[i][0] * uv->scale[0], v = at[i][1] * uv->scale[1];
        at[i][0] = c * u + s * v + uv->offset[0];
        at[i][1] = -s * u + c * v + uv->offset[1];
    }
}

static bool read_uv(struct gltf_reader *r, const json_t *attributes, struct gltf_part *part)
{
    static const struct gltf_uv plain = {.scale = {1, 1}};
    const struct gltf_uv *uv = part->material >= 0 ? &r->uvs[part->material] : &plain;
    char name[32];
    snprintf(name, sizeof name, "TEXCOORD_%d", uv->set);
    if (!read_rows(r, attributes, name, 2, part->vertex_count, &part->uv)) return false;
    place_uv(uv, part->uv, part->vertex_count);
    return true;
}

// --- triangles

/// The corners in the file's order; without indices, in order of vertices.
static bool read_corners(struct gltf_reader *r, const json_t *primitive, int vertices, uint32_t **corners, int *count)
{
    struct glb_numbers numbers = {.count = vertices, .components = 1};
    bool indexed = json_object_get(primitive, "indices"), good;
    *corners = NULL;
    if (indexed && !glb_numbers(&r->file, glb_integer(primitive, "indices", -1), &numbers, r->error)) return false;
    good = numbers.components == 1 || gltf_bad(r, ".indices: expected one number each, got %d", numbers.components);
    if (good) *corners = gltf_make(r, (size_t)numbers.count, sizeof **corners);
    good = good && *corners;
    for (int i = 0; good && i < numbers.count; i++) {
        double index = indexed ? numbers.values[i] : i;
        good = (index >= 0 && index < vertices && index == floor(index)) ||
               gltf_bad(r, ".indices: expected numbers from 0 to %d, got %g at place %d", vertices - 1, index, i);
        if (good) (*corners)[i] = (uint32_t)index;
    }
    *count = numbers.count;
    free(numbers.values);
    return good;
}

/// The triangles of strips and fans, oriented as glTF requires.
static bool make_triangles(struct gltf_reader *r, int mode, uint32_t *corners, int count, struct gltf_part *part)
{
    part->indices = corners;
    part->index_count = count - count % 3;
    if (mode == TRIANGLES) return true;
    int triangles = count > 2 ? count - 2 : 0;
    uint32_t *indices = gltf_make(r, (size_t)triangles, 3 * sizeof *indices);
    for (int i = 0; indices && i < triangles; i++) {
        int second = mode == FAN ? i + 2 : i + 1 + i % 2, third = mode == FAN ? 0 : i + 2 - i % 2;
        indices[3 * i] = corners[mode == FAN ? i + 1 : i];
        indices[3 * i + 1] = corners[second];
        indices[3 * i + 2] = corners[third];
    }
    part->indices = indices;
    part->index_count = 3 * triangles;
    return indices;
}

/// Leaves out triangles that name a vertex twice, with which strips jump.
static void drop_repeats(struct gltf_part *part)
{
    int kept = 0;
    for (int i = 0; i + 2 < part->index_count; i += 3) {
        if (triangle_repeats(part->indices + i)) continue;
        memmove(part->indices + kept, part->indices + i, 3 * sizeof *part->indices);
        kept += 3;
    }
    part->index_count = kept;
}

/// Whether a primitive shares another's vertices, like ours with several materials: they are then read once.
static bool shares(const json_t *primitive, const json_t *other)
{
    return other && json_equal(json_object_get(primitive, "attributes"), json_object_get(other, "attributes")) &&
           json_equal(json_object_get(primitive, "targets"), json_object_get(other, "targets"));
}

/// Copies another part's vertices; its texture coordinates too, if both materials place them equally.
static void share(const struct gltf_reader *r, struct gltf_part *part, const struct gltf_part *other)
{
    const struct gltf_uv *uvs = r->uvs;
    struct gltf_part shared = *other;
    if (part->material != other->material && (part->material < 0 || other->material < 0 ||
                                              memcmp(&uvs[part->material], &uvs[other->material], sizeof *uvs) != 0))
        shared.uv = NULL;
    shared.indices = part->indices;
    shared.index_count = part->index_count;
    shared.material = part->material;
    shared.has_polygons = part->has_polygons;
    shared.shared = true;
    *part = shared;
}

/// Number of a primitive's vertices in the file; false if unreadable.
static bool count_in_file(struct gltf_reader *r, const json_t *attributes, int *count)
{
    const int64_t accessor = glb_integer(attributes, "POSITION", -1);
    const json_t *position = json_array_get(gltf_array(r, "accessors"), (size_t)accessor);
    const int64_t in_file = glb_integer(position, "count", -1);
    const size_t most = r->file.room / sizeof(float[3]);
    if (in_file < 1) return gltf_bad(r, ".attributes.POSITION: expected an accessor, got none");
    if (!glb_is_stored(&r->file, accessor))
        return gltf_bad(r, ".attributes.POSITION: expected positions that are in the file, got none");
    if ((size_t)in_file > most)
        return gltf_bad(r, ".attributes.POSITION: expected at most %zu vertices in a file of this size, got %lld",
                        most, (long long)in_file);
    *count = (int)in_file;
    return true;
}

/// Reads a primitive; `like` is the mesh's first part or NULL, whose vertices it may share.
static bool read_part(struct gltf_reader *r, const json_t *primitive, const json_t *like, struct gltf_mesh *mesh,
                      struct gltf_part *part)
{
    const json_t *attributes = json_object_get(primitive, "attributes");
    uint32_t *corners;
    int count;
    if (!count_in_file(r, attributes, &part->vertex_count)) return false;
    if (!gltf_index(r, primitive, "material", r->gltf->material_count, &part->material)) return false;
    if (!read_corners(r, primitive, part->vertex_count, &corners, &count)) return false;
    if (!make_triangles(r, (int)glb_integer(primitive, "mode", TRIANGLES), corners, count, part)) return false;
    drop_repeats(part);
    if (part->index_count == 0) return gltf_not_shown(r, "triangles without area");
    part->has_polygons = json_object_get(json_object_get(primitive, "extensions"), GLTF_POLYGONS);
    if (shares(primitive, like)) {
        share(r, part, mesh->parts);
    } else {
        int *joints = &r->joints_of[mesh - r->gltf->meshes];
        if (!read_vertices(r, primitive, mesh->target_count, part)) return false;
        for (int n = 0; part->joints && n < part->vertex_count * GLTF_INFLUENCES; n++) {
            const int joint = part->joints[n / GLTF_INFLUENCES][n % GLTF_INFLUENCES];
            if (joint >= *joints) *joints = joint + 1;
        }
    }
    return part->uv || read_uv(r, attributes, part);
}

/// Whether a primitive has triangles; lists it as not shown otherwise.
static bool has_triangles(struct gltf_reader *r, const json_t *primitive, bool *shown)
{
    const int64_t mode = glb_integer(primitive, "mode", TRIANGLES);
    const json_t *attributes = json_object_get(primitive, "attributes");
    *shown = false;
    if (mode < 0 || mode > FAN) return gltf_bad(r, ".mode: expected a number from 0 to 6, got something else");
    if (mode < TRIANGLES) return gltf_not_shown(r, mode < LINES ? "points" : "lines");
    if (!json_object_get(attributes, "POSITION")) return gltf_not_shown(r, "meshes without positions");
    *shown = true;
    const json_t *draco = json_object_get(json_object_get(primitive, "extensions"), "KHR_draco_mesh_compression");
    const json_t *accessors = gltf_array(r, "accessors");
    const json_t *position = json_array_get(accessors, (size_t)glb_integer(attributes, "POSITION", -1));
    if (draco && !json_object_get(position, "bufferView"))
        return gltf_bad(r, ": expected a mesh that is not compressed, got Draco; export without compression");
    return true;
}

/// glTF has no place for the names of targets: most programs write them beside the mesh's targets, VRM 0.x beside each primitive's, and its
/// first writers inside each target. NULL: none.
static const char *find_target_name(const json_t *mesh, size_t target)
{
    const json_t *primitives = json_object_get(mesh, "primitives"), *of = mesh;
    for (size_t i = 0; of; of = json_array_get(primitives, i++)) {
        const json_t *own = json_array_get(json_object_get(of, "targets"), target);
        const json_t *more =
            json_object_get(own, "extras") ? json_object_get(own, "extras") : json_object_get(own, "extra");
        const json_t *names = json_object_get(json_object_get(of, "extras"), "targetNames");
        const char *name = json_string_value(names ? json_array_get(names, target) : json_object_get(more, "name"));
        if (name && !name_is_blank(name)) return name;
    }
    return NULL;
}

static bool read_target_names(struct gltf_reader *r, const json_t *json, struct gltf_mesh *mesh)
{
    mesh->target_names = gltf_make(r, (size_t)mesh->target_count, sizeof *mesh->target_names);
    for (int t = 0; mesh->target_names && t < mesh->target_count; t++) {
        const char *name = find_target_name(json, (size_t)t);
        if (name && !(mesh->target_names[t] = gltf_text(r, name))) return false;
    }
    return mesh->target_names;
}

static bool read_mesh(struct gltf_reader *r, const json_t *json, size_t number)
{
    const json_t *primitives = json_object_get(json, "primitives"), *primitive;
    const json_t *first = NULL;
    struct gltf_mesh *mesh = &r->gltf->meshes[number];
    size_t i;
    gltf_at(r, "meshes[%zu]", number);
    if (!json_is_array(primitives)) return gltf_bad(r, ".primitives: expected an array, got something else");
    mesh->name = gltf_name(r, json, "mesh", number);
    mesh->parts = mesh->name ? gltf_make(r, json_array_size(primitives), sizeof *mesh->parts) : NULL;
    if (!mesh->parts) return false;
    json_array_foreach(primitives, i, primitive)
    {
        const int targets = (int)json_array_size(json_object_get(primitive, "targets"));
        if (targets > mesh->target_count) mesh->target_count = targets;
    }
    json_array_foreach(primitives, i, primitive)
    {
        bool shown;
        gltf_at(r, "meshes[%zu].primitives[%zu]", number, i);
        if (!has_triangles(r, primitive, &shown)) return false;
        if (!shown) continue;
        struct gltf_part *part = &mesh->parts[mesh->part_count];
        if (!read_part(r, primitive, first, mesh, part)) return false;
        if (part->index_count > 0 && mesh->part_count++ == 0) first = primitive;
    }
    gltf_at(r, "meshes[%zu]", number);
    mesh->extras = json_incref(json_object_get(json, "extras"));
    mesh->weights = gltf_make(r, (size_t)mesh->target_count, sizeof *mesh->weights);
    return mesh->weights && read_target_names(r, json, mesh) &&
           gltf_reals(r, json, "weights", mesh->weights, (size_t)mesh->target_count);
}

bool gltf_read_meshes(struct gltf_reader *r)
{
    const json_t *meshes = gltf_array(r, "meshes"), *mesh;
    size_t i, count = json_array_size(meshes);
    gltf_at(r, "meshes");
    r->gltf->meshes = gltf_make(r, count, sizeof *r->gltf->meshes);
    r->joints_of = r->gltf->meshes ? gltf_make(r, count, sizeof *r->joints_of) : NULL;
    if (!r->joints_of) return false;
    r->gltf->mesh_count = (int)count;
    json_array_foreach(meshes, i, mesh)
    {
        if (!read_mesh(r, mesh, i)) return false;
    }
    return true;
}
