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

/// Whether a primitive has the vertices of another, as ours with several materials do: then they are read once.
static bool shares(const json_t *primitive, const json_t *other)
{
    return other && json_equal(json_object_get(primitive, "attributes"), json_object_get(other, "attributes")) &&
           json_equal(json_object_get(primitive, "targets"), json_object_get(other, "targets"));
}

/// The vertices of another part; its texture coordinates too, where both materials have them at the same place.
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

/// How many vertices a primitive has in the file; false where they cannot be read.
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

/// Reads a primitive; `like` has the vertices of the mesh's first part, if there is one.
static bool read_part(struct gltf_reader *r, const json_t *primitive, const json_t *like, struct gltf_mesh *mesh,
                      struct gltf_part *part)
{
    const json_t *attributes = json_object_get(primitive, "attributes");
    struct gltf_vertices vertices = {0};
    uint32_t *corners;
    int count;
    if (!count_in_file(r, attributes, &vertices.in_file)) return false;
    if (!gltf_index(r, primitive, "material", r->gltf->material_count, &part->material)) return false;
    if (!read_corners(r, primitive, vertices.in_file, &corners, &count)) {
        free(corners);
        return false;
    }
    if (!make_triangles(r, (int)glb_integer(primitive, "mode", TRIANGLES), corners, count, part)) return false;
    drop_repeats(part);
    if (part->index_count == 0) return gltf_not_shown(r, "triangles without area");
    part->flat = !r->stored && !json_object_get(attributes, "NORMAL");
    part->has_polygons =
        !part->flat && json_object_get(json_object_get(primitive, "extensions"), GLTF_POLYGONS) != NULL;
    vertices.order = part->flat ? part->indices : NULL;
    vertices.count = part->flat ? part->index_count : vertices.in_file;
    if (!part->flat && shares(primitive, like)) {
        share(r, part, mesh->parts);
    } else {
        if (!gltf_read_vertices(r, primitive, &vertices, mesh->target_count, part)) return false;
        for (int n = 0; part->joints && n < vertices.count * GLTF_INFLUENCES; n++) {
            const int joint = part->joints[n / GLTF_INFLUENCES][n % GLTF_INFLUENCES];
            if (joint >= r->joints_of[mesh - r->gltf->meshes]) r->joints_of[mesh - r->gltf->meshes] = joint + 1;
        }
    }
    if (!part->uv && !gltf_read_uv(r, attributes, &vertices, part)) return false;
    for (int i = 0; part->flat && i < part->index_count; i++) part->indices[i] = (uint32_t)i;
    return true;
}

/// Whether a primitive has triangles; what else it has is named.
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
    mesh->target_count = (int)json_array_size(json_object_get(json_array_get(primitives, 0), "targets"));
    json_array_foreach(primitives, i, primitive)
    {
        bool shown;
        gltf_at(r, "meshes[%zu].primitives[%zu]", number, i);
        if (!has_triangles(r, primitive, &shown)) return false;
        if (!shown) continue;
        struct gltf_part *part = &mesh->parts[mesh->part_count++];
        if (!read_part(r, primitive, first, mesh, part)) return false;
        if (!first && part->index_count > 0) first = primitive;
        if (part->index_count > 0) continue;
        free(part->indices);
        part->indices = NULL;
        mesh->part_count--;
    }
    gltf_at(r, "meshes[%zu]", number);
    mesh->extras = json_incref(json_object_get(json, "extras"));
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
    const bool flat = !r->stored && !json_object_get(attributes, "NORMAL");
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
