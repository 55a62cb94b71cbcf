/// Writes a character to a .glb file.
#include "base/file.h"
#include "model/figure.h"
#include "model/gltf_shape.h"
#include <string.h>

// --- the file's vertices: one for each pair of a vertex and its texture coordinates

/// The character's vertices come first, in order; then copies of those with several texture coordinates.
struct split {
    int count;
    uint32_t *source;  ///< per vertex of the file: the character's
    uint32_t *indices; ///< as many as the character's, in order
    float (*uv)[2];    ///< NULL: none
};

/// The file's vertices by the character's: the first has its number, `next` is the next copy, 0 the end.
struct chains {
    uint32_t *uv, *next;
};

static uint32_t find_or_add(struct split *s, struct chains *chains, uint32_t vertex, uint32_t uv)
{
    uint32_t at = vertex;
    if (chains->uv[at] == LOOKS_NONE) chains->uv[at] = uv;
    while (chains->uv[at] != uv && chains->next[at]) at = chains->next[at];
    if (chains->uv[at] == uv) return at;
    chains->next[at] = (uint32_t)s->count;
    at = (uint32_t)s->count++;
    s->source[at] = vertex;
    chains->uv[at] = uv;
    chains->next[at] = 0;
    return at;
}

static void split_vertices(struct split *s, const struct character *c, struct chains *chains)
{
    const struct looks *looks = &c->looks;
    s->count = c->vertex_count;
    for (int v = 0; v < c->vertex_count; v++) {
        s->source[v] = (uint32_t)v;
        chains->uv[v] = LOOKS_NONE;
        chains->next[v] = 0;
    }
    for (int i = 0; i < c->index_count; i++) {
        const uint32_t uv = looks->corner ? looks->corner[i] : LOOKS_NONE;
        s->indices[i] = uv == LOOKS_NONE ? c->indices[i] : find_or_add(s, chains, c->indices[i], uv);
    }
    for (int v = 0; s->uv && v < s->count; v++) {
        const uint32_t uv = looks->corner ? chains->uv[v] : (uint32_t)v;
        memcpy(s->uv[v], uv != LOOKS_NONE ? looks->uv[uv] : (float[2]){0}, sizeof *s->uv);
    }
}

static void split_create(struct split *split, struct pool *pool, const struct character *c)
{
    const size_t most = (size_t)c->vertex_count + (c->looks.corner ? (size_t)c->index_count : 0);
    struct chains chains = {.uv = pool_take(pool, most, sizeof *chains.uv),
                            .next = pool_take(pool, most, sizeof *chains.next)};
    *split = (struct split){.source = pool_take(pool, most, sizeof *split->source),
                            .indices = pool_take(pool, (size_t)c->index_count, sizeof *split->indices),
                            .uv = c->looks.uv ? pool_take(pool, most, sizeof *split->uv) : NULL};
    split_vertices(split, c, &chains);
}

// --- the file

/// A file being written.
struct output {
    struct pool pool;
    struct gltf_file file;
    struct gltf_looks looks;
    struct split split;
    struct gltf_shape shape;
};

static void make_targets(struct output *o, const struct figure *figure)
{
    const int count = 2 * figure->character.coordinate_count;
    o->shape.targets = pool_take(&o->pool, (size_t)count, sizeof *o->shape.targets);
    o->shape.target_count = count;
    for (int t = 0; t < count; t++) {
        const struct figure_target own = figure_target_create(figure, t / 2, t % 2, &o->pool);
        o->shape.targets[t] =
            (struct gltf_shape_target){own.name, own.position, (const float(*)[3])own.normal, own.sign, 1};
    }
}

static void open_output(struct output *o, const struct figure *figure)
{
    const struct character *c = &figure->character;
    *o = (struct output){.looks.file = &o->file};
    split_create(&o->split, &o->pool, c);
    o->shape = (struct gltf_shape){.name = "character",
                                   .vertex_count = o->split.count,
                                   .source = o->split.source,
                                   .position = (const float(*)[3])c->position,
                                   .normal = (const float(*)[3])c->normal,
                                   .color = (const float(*)[3])c->color,
                                   .uv = (const float(*)[2])o->split.uv,
                                   .indices = o->split.indices,
                                   .index_count = c->index_count,
                                   .looks = &c->looks,
                                   .character = c};
    make_targets(o, figure);
}

static void close_output(struct output *o)
{
    gltf_looks_free(&o->looks);
    gltf_file_free(&o->file);
    pool_free(&o->pool);
}

static bool write_file(struct output *o, const char *path, struct error *error)
{
    struct file_output out;
    struct error why;
    if (!file_output_open(&out, path, error)) return false;
    json_t *root = json_pack("{s:{s:s, s:s}, s:i, s:[{s:[i]}], s:[{s:s, s:i}], s:[o]}", "asset", "version", "2.0",
                             "generator", "wiggly", "scene", 0, "scenes", "nodes", 0, "nodes", "name", "character",
                             "mesh", 0, "meshes", gltf_shape_json(&o->looks, &o->shape));
    gltf_looks_complete(&o->looks, root);
    if (gltf_file_write(&o->file, root, true, out.stream, &why)) return file_output_commit(&out, error);
    file_output_discard(&out);
    return fail(error, why.kind, "%s: %s", path, why.text);
}

bool character_write(const char *path, const struct character *character, bool turn_normals, struct error *error)
{
    struct figure figure = {.character = *character};
    struct output o;
    if (turn_normals) figure_derive(&figure);
    open_output(&o, &figure);
    const bool done = write_file(&o, path, error);
    close_output(&o);
    figure_forget(&figure);
    return done;
}
