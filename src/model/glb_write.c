/// Writes a character to a .glb file.
#include "base/file.h"
#include "model/character.h"
#include "model/glb.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ARRAY_BUFFER = 34962, ELEMENT_ARRAY_BUFFER = 34963 };

/// A file being written: its JSON, and the vectors that its binary chunk will hold, in the order of the accessors.
struct output {
    const struct character *character;
    FILE *stream;
    json_t *views, *accessors;
    size_t size; ///< of the binary chunk so far
};

static bool has_colors(const struct character *c)
{
    for (int n = 0; n < 3 * c->vertex_count; n++) {
        if (c->color[n / 3][n % 3] != 1) return true;
    }
    return false;
}

/// Adds a buffer view of `size` bytes with one accessor, and returns the accessor's number.
static json_int_t add_accessor(struct output *o, size_t size, int target, int type, int count, const char *shape)
{
    json_int_t index = (json_int_t)json_array_size(o->accessors);
    json_array_append_new(o->views, json_pack("{s:i, s:I, s:I, s:i}", "buffer", 0, "byteOffset", (json_int_t)o->size,
                                              "byteLength", (json_int_t)size, "target", target));
    json_array_append_new(o->accessors, json_pack("{s:I, s:i, s:i, s:s}", "bufferView", index, "componentType", type,
                                                  "count", count, "type", shape));
    o->size += size;
    return index;
}

/// Bounds of the vectors times `sign`: what positions must state.
static void add_bounds(struct output *o, json_int_t accessor, const float (*vectors)[3], float sign)
{
    json_t *low = json_array(), *high = json_array(), *object = json_array_get(o->accessors, (size_t)accessor);
    for (int k = 0; k < 3; k++) {
        float least = INFINITY, most = -INFINITY;
        for (int i = 0; i < o->character->vertex_count; i++) {
            least = fminf(least, sign * vectors[i][k]);
            most = fmaxf(most, sign * vectors[i][k]);
        }
        json_array_append_new(low, json_real((double)least));
        json_array_append_new(high, json_real((double)most));
    }
    json_object_set_new(object, "min", low);
    json_object_set_new(object, "max", high);
}

static json_int_t add_vectors(struct output *o)
{
    int count = o->character->vertex_count;
    return add_accessor(o, (size_t)count * sizeof(float[3]), ARRAY_BUFFER, GLB_FLOAT, count, "VEC3");
}

static json_int_t add_positions(struct output *o, const float (*vectors)[3], float sign)
{
    json_int_t accessor = add_vectors(o);
    add_bounds(o, accessor, vectors, sign);
    return accessor;
}

static json_t *describe(const struct coordinate *c)
{
    return json_pack("{s:s, s:f, s:f, s:f, s:f, s:f}", "name", c->name, "frequency", c->frequency, "damping",
                     c->damping, "explained", c->explained, "pca1", c->pca1, "pca2", c->pca2);
}

static json_t *make_primitive(struct output *o)
{
    const struct character *c = o->character;
    json_int_t indices = add_accessor(o, (size_t)c->index_count * sizeof *c->indices, ELEMENT_ARRAY_BUFFER,
                                      GLB_UNSIGNED_INT, c->index_count, "SCALAR");
    json_int_t position = add_positions(o, (const float(*)[3])c->position, 1), normal = add_vectors(o);
    json_t *attributes = json_pack("{s:I, s:I}", "POSITION", position, "NORMAL", normal);
    if (has_colors(c)) json_object_set_new(attributes, "COLOR_0", json_integer(add_vectors(o)));
    json_t *targets = json_array();
    for (int i = 0; i < c->coordinate_count; i++) {
        json_int_t re = add_positions(o, (const float(*)[3])c->coordinates[i].re, 1);
        json_int_t im = add_positions(o, (const float(*)[3])c->coordinates[i].im, -1);
        json_array_append_new(targets, json_pack("{s:I}", "POSITION", re));
        json_array_append_new(targets, json_pack("{s:I}", "POSITION", im));
    }
    json_t *primitive = json_pack("{s:o, s:I, s:i}", "attributes", attributes, "indices", indices, "material", 0);
    if (c->coordinate_count > 0) {
        json_object_set_new(primitive, "targets", targets);
    } else {
        json_decref(targets);
    }
    return primitive;
}

static json_t *make_mesh(struct output *o)
{
    const struct character *c = o->character;
    json_t *names = json_array(), *coordinates = json_array(), *weights = json_array();
    for (int i = 0; i < c->coordinate_count; i++) {
        json_array_append_new(names, json_sprintf("%s.re", c->coordinates[i].name));
        json_array_append_new(names, json_sprintf("%s.im", c->coordinates[i].name));
        json_array_append_new(coordinates, describe(&c->coordinates[i]));
        for (int k = 0; k < 2; k++) json_array_append_new(weights, json_integer(0));
    }
    json_t *mesh = json_pack("{s:s, s:[o], s:{s:o, s:{s:o}}}", "name", "character", "primitives", make_primitive(o),
                             "extras", "targetNames", names, "wiggly", "coordinates", coordinates);
    if (c->coordinate_count > 0) {
        json_object_set_new(mesh, "weights", weights);
    } else {
        json_decref(weights);
    }
    return mesh;
}

/// The whole JSON; NULL where memory is short or a name is not UTF-8.
static json_t *make_json(struct output *o)
{
    o->views = json_array();
    o->accessors = json_array();
    json_t *mesh = make_mesh(o);
    json_t *material = json_pack("{s:s, s:{s:f, s:f}}", "name", "skin", "pbrMetallicRoughness", "metallicFactor", 0.0,
                                 "roughnessFactor", 0.8);
    return json_pack("{s:{s:s, s:s}, s:i, s:[{s:[i]}], s:[{s:s, s:i}], s:[o], s:[o], s:[{s:I}], s:o, s:o}", "asset",
                     "version", "2.0", "generator", "wiggly", "scene", 0, "scenes", "nodes", 0, "nodes", "name",
                     "character", "mesh", 0, "meshes", mesh, "materials", material, "buffers", "byteLength",
                     (json_int_t)o->size, "bufferViews", o->views, "accessors", o->accessors);
}

static void write_words(FILE *out, uint32_t a, uint32_t b)
{
    const uint32_t words[2] = {a, b};
    fwrite(words, sizeof words, 1, out);
}

/// Vectors times `sign`, within [lowest, highest].
static void write_vectors(struct output *o, const float (*vectors)[3], float sign, float lowest, float highest)
{
    for (int i = 0; i < o->character->vertex_count; i++) {
        float vector[3];
        for (int k = 0; k < 3; k++) vector[k] = fminf(fmaxf(sign * vectors[i][k], lowest), highest);
        fwrite(vector, sizeof vector, 1, o->stream);
    }
}

/// The binary chunk, in the order of make_primitive().
static void write_binary(struct output *o)
{
    const struct character *c = o->character;
    fwrite(c->indices, sizeof *c->indices, (size_t)c->index_count, o->stream);
    write_vectors(o, (const float(*)[3])c->position, 1, -INFINITY, INFINITY);
    write_vectors(o, (const float(*)[3])c->normal, 1, -1, 1);
    if (has_colors(c)) write_vectors(o, (const float(*)[3])c->color, 1, 0, 1);
    for (int i = 0; i < c->coordinate_count; i++) {
        write_vectors(o, (const float(*)[3])c->coordinates[i].re, 1, -INFINITY, INFINITY);
        write_vectors(o, (const float(*)[3])c->coordinates[i].im, -1, -INFINITY, INFINITY);
    }
}

/// Header, JSON padded with spaces, binary chunk (whose size is a multiple of 4 as it is).
static void write_chunks(struct output *o, const char *text)
{
    size_t length = strlen(text), padded = (length + 3) / 4 * 4;
    write_words(o->stream, GLB_MAGIC, 2);
    uint32_t total = (uint32_t)(12 + 8 + padded + 8 + o->size);
    fwrite(&total, sizeof total, 1, o->stream);
    write_words(o->stream, (uint32_t)padded, GLB_JSON);
    fprintf(o->stream, "%s%*s", text, (int)(padded - length), "");
    write_words(o->stream, (uint32_t)o->size, GLB_BIN);
    write_binary(o);
}

bool character_write(const char *path, const struct character *character, struct error *error)
{
    struct output output = {.character = character};
    struct file_output file;
    json_t *json = make_json(&output);
    char *text = json ? json_dumps(json, JSON_COMPACT | JSON_REAL_PRECISION(17)) : NULL;
    json_decref(json);
    if (!text || output.size > UINT32_MAX / 2) {
        free(text);
        return fail(error, ERROR_ENVIRONMENT, "%s: not enough memory, or a coordinate's name is not UTF-8", path);
    }
    bool done = file_output_open(&file, path, error);
    if (done) {
        output.stream = file.stream;
        write_chunks(&output, text);
        done = file_output_commit(&file, error);
    }
    free(text);
    return done;
}
