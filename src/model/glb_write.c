/// Writes a character to a .glb file.
#include "base/file.h"
#include "model/figure.h"
#include "model/glb_split.h"
#include "model/gltf_looks.h"
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
    struct gltf_looks looks;
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

/// A primitive for each material that triangles have, and one for those without.
static json_t *make_primitives(struct output *o, float (*turn)[3])
{
    const struct gltf_triangles triangles = {&o->character->looks, o->split.indices, o->character->index_count};
    json_t *attributes = make_attributes(o), *targets = make_targets(o, turn);
    json_t *primitives = gltf_looks_primitives(&o->looks, &triangles, attributes, targets);
    if (!targets) o->file.without_memory = true;
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
    float(*turn)[3] = malloc(((size_t)o->character->vertex_count + 1) * sizeof *turn);
    json_t *root = NULL;
    if (turn) {
        root = json_pack("{s:{s:s, s:s}, s:i, s:[{s:[i]}], s:[{s:s, s:i}], s:[o]}", "asset", "version", "2.0",
                         "generator", "wiggly", "scene", 0, "scenes", "nodes", 0, "nodes", "name", "character",
                         "mesh", 0, "meshes", make_mesh(o, make_primitives(o, turn)));
        gltf_looks_complete(&o->looks, root);
    }
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
    struct output o = {.character = character, .figure = turn_normals ? &figure : NULL, .looks.file = &o.file};
    if (turn_normals) figure_derive(&figure);
    bool done = split_create(&o.split, character);
    if (done) {
        o.scratch = malloc(((size_t)o.split.count + 1) * sizeof *o.scratch);
        done = o.scratch;
    }
    done = done ? write_file(&o, path, error) : fail_no_memory(error, path);
    free(o.scratch);
    gltf_looks_free(&o.looks);
    gltf_file_free(&o.file);
    split_free(&o.split);
    figure_forget(&figure);
    return done;
}
