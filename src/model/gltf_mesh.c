/// Reads meshes: triangles, strips and fans, their vertices and morph targets.
#include "model/gltf_read.h"
#include "model/surface.h"
#include "model/vector.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINES = 1, TRIANGLES = 4, STRIP = 5, FAN = 6 };

/// The corners as the file has them; in order where it has no indices.
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

/// The triangles of strips and fans, turned as glTF says; `corners` is used up.
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
    free(corners);
    part->indices = indices;
    part->index_count = 3 * triangles;
    return indices;
}

/// Leaves out triangles that name a vertex twice, by which strips jump.
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

static void normalise(float (*normal)[3], int count)
{
    for (int i = 0; i < count; i++) {
        float length = glm_vec3_norm(normal[i]);
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

static bool read_uv(struct gltf_reader *r, const json_t *attributes, const struct gltf_vertices *vertices,
                    struct gltf_part *part)
{
    static const struct gltf_uv plain = {.scale = {1, 1}};
    const struct gltf_uv *uv = part->material >= 0 ? &r->uvs[part->material] : &plain;
    char name[32];
    float *rows = NULL;
    snprintf(name, sizeof name, "TEXCOORD_%d", uv->set);
    if (!gltf_rows(r, attributes, name, 2, vertices, &rows)) {
        free(rows);
        return false;
    }
    part->uv = (float(*)[2])rows;
    place_uv(uv, part->uv, vertices->count);
    return true;
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
        bool read = gltf_rows(r, target, "POSITION", 3, vertices, &position) &&
                    (vertices->order || gltf_rows(r, target, "NORMAL", 3, vertices, &normal));
        part->targets[i] = (struct gltf_target){(float(*)[3])position, (float(*)[3])normal};
        if (!read) return false;
    }
    return part->targets;
}

/// Reads the attributes. `vertices` says which of the file's vertices the part has.
static bool read_vertices(struct gltf_reader *r, const json_t *primitive, const struct gltf_vertices *vertices,
                          int targets, int *joints, struct gltf_part *part)
{
    const json_t *attributes = json_object_get(primitive, "attributes");
    float *position = NULL, *normal = NULL, *color = NULL;
    part->vertex_count = vertices->count;
    bool read = gltf_rows(r, attributes, "POSITION", 3, vertices, &position) &&
                (vertices->order || gltf_rows(r, attributes, "NORMAL", 3, vertices, &normal)) &&
                gltf_rows(r, attributes, "COLOR_0", 4, vertices, &color);
    part->position = (float(*)[3])position;
    part->normal = (float(*)[3])normal;
    part->color = (float(*)[4])color;
    if (!read || (vertices->order && !make_flat(r, part))) return false;
    normalise(part->normal, part->vertex_count);
    return read_uv(r, attributes, vertices, part) && gltf_read_influences(r, attributes, vertices, part, joints) &&
           read_targets(r, json_object_get(primitive, "targets"), vertices, targets, part);
}

static bool read_part(struct gltf_reader *r, const json_t *primitive, int mode, int targets, int *joints,
                      struct gltf_part *part)
{
    const json_t *attributes = json_object_get(primitive, "attributes");
    const json_t *position =
        json_array_get(gltf_array(r, "accessors"), (size_t)glb_integer(attributes, "POSITION", -1));
    int64_t in_file = glb_integer(position, "count", -1);
    uint32_t *corners;
    int count;
    if (in_file < 1) return gltf_bad(r, ".attributes.POSITION: expected an accessor, got none");
    if (!glb_is_stored(&r->file, glb_integer(attributes, "POSITION", -1)))
        return gltf_bad(r, ".attributes.POSITION: expected positions that are in the file, got none");
    if ((size_t)in_file > r->file.room / sizeof *part->position)
        return gltf_bad(r, ".attributes.POSITION: expected at most %zu vertices in a file of this size, got %lld",
                        r->file.room / sizeof *part->position, (long long)in_file);
    if (!gltf_index(r, primitive, "material", r->gltf->material_count, &part->material)) return false;
    if (!read_corners(r, primitive, (int)in_file, &corners, &count)) {
        free(corners);
        return false;
    }
    if (!make_triangles(r, mode, corners, count, part)) return false;
    drop_repeats(part);
    if (part->index_count == 0) return gltf_not_shown(r, "triangles without area");
    struct gltf_vertices vertices = {.in_file = (int)in_file, .count = (int)in_file};
    part->flat = !json_object_get(attributes, "NORMAL");
    part->has_polygons =
        !part->flat && json_object_get(json_object_get(primitive, "extensions"), GLTF_POLYGONS) != NULL;
    if (part->flat) {
        vertices.order = part->indices;
        vertices.count = part->index_count;
    }
    if (!read_vertices(r, primitive, &vertices, targets, joints, part)) return false;
    for (int i = 0; part->flat && i < part->index_count; i++) part->indices[i] = (uint32_t)i;
    return true;
}

/// Whether a primitive has triangles; what else it has is named.
static bool has_triangles(struct gltf_reader *r, const json_t *primitive, int64_t mode, bool *shown)
{
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

static bool read_mesh(struct gltf_reader *r, const json_t *json, size_t number)
{
    const json_t *primitives = json_object_get(json, "primitives"), *primitive;
    struct gltf_mesh *mesh = &r->gltf->meshes[number];
    size_t i;
    gltf_at(r, "meshes[%zu]", number);
    if (!json_is_array(primitives)) return gltf_bad(r, ".primitives: expected an array, got something else");
    mesh->name = gltf_name(r, json, "mesh", number);
    mesh->parts = mesh->name ? gltf_make(r, json_array_size(primitives), sizeof *mesh->parts) : NULL;
    if (!mesh->parts) return false;
    mesh->target_count = (int)json_array_size(json_object_get(json_array_get(primitives, 0), "targets"));
    json_array_foreach(primitives, i, primitive)
    {
        int64_t mode = glb_integer(primitive, "mode", TRIANGLES);
        bool shown;
        gltf_at(r, "meshes[%zu].primitives[%zu]", number, i);
        if (!has_triangles(r, primitive, mode, &shown)) return false;
        if (!shown) continue;
        struct gltf_part *part = &mesh->parts[mesh->part_count++];
        if (!read_part(r, primitive, (int)mode, mesh->target_count, &r->joints_of[number], part)) return false;
        if (part->index_count > 0) continue;
        free(part->indices);
        part->indices = NULL;
        mesh->part_count--;
    }
    gltf_at(r, "meshes[%zu]", number);
    mesh->weights = gltf_make(r, (size_t)mesh->target_count, sizeof *mesh->weights);
    return mesh->weights && gltf_reals(r, json, "weights", mesh->weights, (size_t)mesh->target_count);
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

/// A mesh without normals has corners of its own for each triangle.
static size_t count_in_primitive(const struct gltf_reader *r, const json_t *primitive)
{
    const json_t *attributes = json_object_get(primitive, "attributes");
    const bool flat = !json_object_get(attributes, "NORMAL");
    const int64_t mode = glb_integer(primitive, "mode", TRIANGLES),
                  position = glb_integer(attributes, "POSITION", -1),
                  counted = flat ? glb_integer(primitive, "indices", position) : position,
                  count = glb_integer(json_array_get(gltf_array(r, "accessors"), (size_t)counted), "count", 0);
    if (mode < TRIANGLES || count < (flat ? 3 : 1)) return 0;
    return (size_t)(!flat ? count : mode == TRIANGLES ? count - count % 3 : 3 * (count - 2));
}

bool gltf_count_vertices(const struct gltf_reader *r, size_t *total)
{
    const json_t *meshes = gltf_array(r, "meshes"), *mesh, *node, *primitive;
    const size_t mesh_count = json_array_size(meshes);
    size_t *count = calloc(mesh_count + 1, sizeof *count), i, k;
    if (!count) return false;
    json_array_foreach(meshes, i, mesh){json_array_foreach(json_object_get(mesh, "primitives"), k,
                                                           primitive){count[i] += count_in_primitive(r, primitive);
}
}
*total = 0;
json_array_foreach(gltf_array(r, "nodes"), i, node)
{
    const int64_t shown = glb_integer(node, "mesh", -1);
    if (shown >= 0 && (size_t)shown < mesh_count) *total += count[shown];
}
free(count);
return true;
}
