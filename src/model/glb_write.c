/// Writes a character to a .glb file.
#include "base/file.h"
#include "model/figure.h"
#include "model/glb_split.h"
#include "model/gltf_file.h"
#include "model/mtl.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// A file being written.
struct output {
    const struct character *character;
    const struct figure *figure; ///< NULL: targets leave normals as they are
    struct split split;
    struct gltf_file file;
    float (*scratch)[3]; ///< room for a vector a vertex of the file
    json_t *materials, *textures, *images;
};

static bool has_colors(const struct character *c)
{
    for (int n = 0; n < 3 * c->vertex_count; n++) {
        if (c->color[n / 3][n % 3] != 1) return true;
    }
    return false;
}

/// The character's vectors times `sign`, within [lowest, highest], for the vertices of the file.
static json_int_t add_vectors(struct output *o, const float (*vectors)[3], float sign, float lowest, float highest,
                              bool bounds)
{
    for (int v = 0; v < o->split.count; v++) {
        const float *vector = vectors[o->split.source[v]];
        for (int k = 0; k < 3; k++) o->scratch[v][k] = fminf(fmaxf(sign * vector[k], lowest), highest);
    }
    return gltf_file_add(&o->file, ELEMENTS_VECTORS, o->scratch, (size_t)o->split.count, bounds);
}

static json_int_t add_places(struct output *o, const float (*vectors)[3], float sign)
{
    return add_vectors(o, vectors, sign, -INFINITY, INFINITY, true);
}

// --- looks

static void add_texture(struct output *o, const struct looks_material *material, json_t *base)
{
    const char *kind = looks_image_kind(material->image, material->image_size);
    char type[16];
    if (!kind) return;
    snprintf(type, sizeof type, "image/%s", kind);
    const json_int_t view = gltf_file_add_bytes(&o->file, material->image, material->image_size);
    const json_int_t image =
        gltf_append(&o->file, o->images,
                    json_pack("{s:s, s:I, s:s}", "name", material->name, "bufferView", view, "mimeType", type));
    const json_int_t texture = gltf_append(&o->file, o->textures, json_pack("{s:I}", "source", image));
    gltf_set(&o->file, base, "baseColorTexture", json_pack("{s:I}", "index", texture));
}

static void add_material(struct output *o, const struct looks_material *material)
{
    const float *c = material->color;
    json_t *base = json_pack("{s:f, s:f}", "metallicFactor", 0.0, "roughnessFactor", 0.8);
    if (c[0] != 1 || c[1] != 1 || c[2] != 1 || c[3] != 1)
        gltf_set(&o->file, base, "baseColorFactor",
                 json_pack("[f, f, f, f]", (double)c[0], (double)c[1], (double)c[2], (double)c[3]));
    if (material->image) add_texture(o, material, base);
    json_t *json = json_pack("{s:s, s:o}", "name", material->name, "pbrMetallicRoughness", base);
    if (c[3] < 1) gltf_set(&o->file, json, "alphaMode", json_string("BLEND"));
    gltf_append(&o->file, o->materials, json);
}

// --- mesh

static json_t *make_attributes(struct output *o)
{
    const struct character *c = o->character;
    const json_int_t position = add_places(o, (const float(*)[3])c->position, 1);
    const json_int_t normal = add_vectors(o, (const float(*)[3])c->normal, 1, -1, 1, false);
    json_t *attributes = json_pack("{s:I, s:I}", "POSITION", position, "NORMAL", normal);
    if (has_colors(c))
        gltf_set(&o->file, attributes, "COLOR_0",
                 json_integer(add_vectors(o, (const float(*)[3])c->color, 1, 0, 1, false)));
    if (o->split.uv)
        gltf_set(&o->file, attributes, "TEXCOORD_0",
                 json_integer(gltf_file_add(&o->file, ELEMENTS_UVS, o->split.uv, (size_t)o->split.count, false)));
    return attributes;
}

/// Re Ñ and −Im Ñ of each coordinate, and how they turn normals; `turn` has room for a vector a vertex of the character.
static json_t *make_targets(struct output *o, float (*turn)[3])
{
    const struct character *c = o->character;
    json_t *targets = json_array();
    for (int i = 0; i < 2 * c->coordinate_count; i++) {
        const struct coordinate *n = &c->coordinates[i / 2];
        const bool imaginary = i % 2;
        const json_int_t position =
            imaginary ? add_places(o, (const float(*)[3])n->im, -1) : add_places(o, (const float(*)[3])n->re, 1);
        json_t *target = json_pack("{s:I}", "POSITION", position);
        if (o->figure) {
            figure_turn_normals(o->figure, i / 2, imaginary, turn);
            gltf_set(&o->file, target, "NORMAL",
                     json_integer(add_vectors(o, (const float(*)[3])turn, 1, -INFINITY, INFINITY, false)));
        }
        gltf_append(&o->file, targets, target);
    }
    return targets;
}

/// The triangles of one material; `corners` has room for all. −1: none.
static json_int_t add_triangles(struct output *o, uint32_t material, uint32_t *corners)
{
    const struct character *c = o->character;
    const uint32_t *of = c->looks.material;
    size_t count = 0;
    for (int i = 0; i < c->index_count; i++) {
        const uint32_t own = of && of[i / 3] < (uint32_t)c->looks.material_count ? of[i / 3] : LOOKS_NONE;
        if (own == material) corners[count++] = o->split.indices[i];
    }
    return count ? gltf_file_add(&o->file, ELEMENTS_INDICES, corners, count, false) : -1;
}

/// A primitive for each material that triangles have, and one for those without.
static json_t *make_primitives(struct output *o, uint32_t *corners, float (*turn)[3])
{
    char name[] = "skin";
    const struct looks_material skin = {.name = name, .color = {1, 1, 1, 1}};
    const struct looks *looks = &o->character->looks;
    json_t *primitives = json_array(), *attributes = make_attributes(o), *targets = make_targets(o, turn);
    for (int m = 0; m <= looks->material_count; m++) {
        const bool none = m == looks->material_count;
        const json_int_t indices = add_triangles(o, none ? LOOKS_NONE : (uint32_t)m, corners);
        if (indices < 0) continue;
        json_t *primitive = json_pack("{s:O, s:I, s:I}", "attributes", attributes, "indices", indices, "material",
                                      (json_int_t)json_array_size(o->materials));
        if (json_array_size(targets) > 0) gltf_set(&o->file, primitive, "targets", json_incref(targets));
        add_material(o, none ? &skin : &looks->materials[m]);
        gltf_append(&o->file, primitives, primitive);
    }
    if (!attributes || !targets) o->file.without_memory = true;
    json_decref(attributes);
    json_decref(targets);
    return primitives;
}

static json_t *describe(const struct coordinate *c)
{
    return json_pack("{s:s, s:f, s:f, s:f, s:f, s:f}", "name", c->name, "frequency", c->frequency, "damping",
                     c->damping, "explained", c->explained, "pca1", c->pca1, "pca2", c->pca2);
}

static json_t *make_mesh(struct output *o, json_t *primitives)
{
    const struct character *c = o->character;
    json_t *names = json_array(), *coordinates = json_array(), *weights = json_array();
    for (int i = 0; i < c->coordinate_count; i++) {
        gltf_append(&o->file, names, json_sprintf("%s.re", c->coordinates[i].name));
        gltf_append(&o->file, names, json_sprintf("%s.im", c->coordinates[i].name));
        gltf_append(&o->file, coordinates, describe(&c->coordinates[i]));
        for (int k = 0; k < 2; k++) gltf_append(&o->file, weights, json_integer(0));
    }
    json_t *mesh = json_pack("{s:s, s:o, s:{s:o, s:{s:o}}}", "name", "character", "primitives", primitives, "extras",
                             "targetNames", names, "wiggly", "coordinates", coordinates);
    if (c->coordinate_count > 0) {
        gltf_set(&o->file, mesh, "weights", weights);
    } else {
        json_decref(weights);
    }
    return mesh;
}

/// All but the buffers, which belong to the file; NULL where memory is short or a name is not UTF-8.
static json_t *make_root(struct output *o)
{
    uint32_t *corners = malloc(((size_t)o->character->index_count + 1) * sizeof *corners);
    float(*turn)[3] = malloc(((size_t)o->character->vertex_count + 1) * sizeof *turn);
    json_t *root = NULL;
    if (corners && turn) {
        json_t *mesh = make_mesh(o, make_primitives(o, corners, turn));
        root = json_pack("{s:{s:s, s:s}, s:i, s:[{s:[i]}], s:[{s:s, s:i}], s:[o], s:O}", "asset", "version", "2.0",
                         "generator", "wiggly", "scene", 0, "scenes", "nodes", 0, "nodes", "name", "character",
                         "mesh", 0, "meshes", mesh, "materials", o->materials);
        if (root && json_array_size(o->images) > 0) {
            gltf_set(&o->file, root, "textures", json_incref(o->textures));
            gltf_set(&o->file, root, "images", json_incref(o->images));
        }
    }
    free(corners);
    free(turn);
    return root;
}

static bool write_file(struct output *o, const char *path, struct error *error)
{
    struct file_output out;
    struct error why;
    json_t *root = make_root(o);
    if (!file_output_open(&out, path, error)) {
        json_decref(root);
        return false;
    }
    if (gltf_file_write(&o->file, root, true, out.stream, &why)) return file_output_commit(&out, error);
    file_output_discard(&out);
    return fail(error, why.kind, "%s: %s", path, why.text);
}

bool character_write(const char *path, const struct character *character, bool turn_normals, struct error *error)
{
    struct figure figure = {.character = *character};
    struct output o = {.character = character, .figure = turn_normals ? &figure : NULL};
    bool done = (!turn_normals || figure_derive(&figure)) && split_create(&o.split, character);
    if (done) {
        o.scratch = malloc(((size_t)o.split.count + 1) * sizeof *o.scratch);
        o.materials = json_array();
        o.textures = json_array();
        o.images = json_array();
        done = o.scratch && o.materials && o.textures && o.images;
    }
    done = done ? write_file(&o, path, error) : fail_no_memory(error, path);
    json_decref(o.materials);
    json_decref(o.textures);
    json_decref(o.images);
    free(o.scratch);
    gltf_file_free(&o.file);
    split_free(&o.split);
    figure_forget(&figure);
    return done;
}
