/// Makes and frees characters; reads them from glTF files, and writes them. A character is the first mesh with morph
/// targets, else the first with triangles.
#include "base/file.h"
#include "model/figure.h"
#include "model/gltf_write.h"
#include "model/surface.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const coordinate_endings[COORDINATE_PARTS] = {".re", ".im", ".sq", ".re2", ".im2"};

/// Some parts of a coordinate, all zero. False if memory is short.
static bool make_parts(struct character *c, int coordinate, int first, int end)
{
    bool whole = true;
    for (int p = first; p < end; p++) {
        float(**part)[3] = &c->coordinates[coordinate].parts[p];
        *part = calloc((size_t)c->vertex_count, sizeof **part);
        whole = whole && *part;
    }
    return whole;
}

bool character_create(struct character *c, struct surface *surface, int coordinates)
{
    *c = (struct character){
        .vertex_count = surface->vertex_count,
        .index_count = surface->index_count,
        .position = surface->position,
        .normal = malloc((size_t)surface->vertex_count * sizeof *c->normal),
        .color = surface->color ? surface->color : malloc((size_t)surface->vertex_count * sizeof *c->color),
        .indices = surface->indices,
        .looks = surface->looks,
        .coordinates = calloc((size_t)coordinates + 1, sizeof *c->coordinates),
    };
    bool whole = c->normal && c->color && c->coordinates;
    for (int n = 0; whole && !surface->color && n < 3 * c->vertex_count; n++) c->color[n / 3][n % 3] = 1;
    *surface = (struct surface){0};
    for (int i = 0; whole && i < coordinates; i++)
        whole = make_parts(c, c->coordinate_count++, 0, COORDINATE_STRAIGHT);
    if (!whole) {
        character_free(c);
        return false;
    }
    character_find_normals(c);
    return true;
}

bool character_curve(struct character *c, int coordinate)
{
    return make_parts(c, coordinate, COORDINATE_STRAIGHT, COORDINATE_PARTS);
}

void character_find_normals(struct character *c)
{
    memset(c->normal, 0, (size_t)c->vertex_count * sizeof *c->normal);
    for (int i = 0; i + 2 < c->index_count; i += 3) {
        const uint32_t *corner = c->indices + i;
        vec3s normal = triangle_normal(c->position[corner[0]], c->position[corner[1]], c->position[corner[2]]);
        for (int k = 0; k < 3; k++) glm_vec3_add(c->normal[corner[k]], normal.raw, c->normal[corner[k]]);
    }
    for (int i = 0; i < c->vertex_count; i++) {
        float *n = c->normal[i];
        double length = sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]);
        bool known = length > 0 && isfinite(length);
        for (int k = 0; k < 3; k++) n[k] = known ? (float)(n[k] / length) : (float)(k == 1);
    }
}

void character_free(struct character *c)
{
    for (int i = 0; i < c->coordinate_count; i++) {
        free(c->coordinates[i].name);
        free(c->coordinates[i].bone);
        for (int p = 0; p < COORDINATE_PARTS; p++) free(c->coordinates[i].parts[p]);
    }
    free(c->coordinates);
    free(c->position);
    free(c->normal);
    free(c->color);
    free(c->indices);
    looks_free(&c->looks);
    *c = (struct character){0};
}

// --- of glTF files

static const struct gltf_mesh *choose_mesh(const struct gltf *gltf)
{
    const struct gltf_mesh *first = NULL;
    for (int m = 0; m < gltf->mesh_count; m++) {
        const struct gltf_mesh *mesh = &gltf->meshes[m];
        if (mesh->part_count > 0 && mesh->target_count > 0) return mesh;
        if (mesh->part_count > 0 && !first) first = mesh;
    }
    return first;
}

// --- coordinates

/// The number of parts of the coordinate whose real part a target is, 0: of none; and which targets they are.
static int find_parts(const struct gltf_mesh *mesh, int target, size_t *name_length, int parts[COORDINATE_PARTS])
{
    const char *name = gltf_target_name(mesh, target);
    size_t length = name ? strlen(name) : 0;
    int count = 1;
    if (length < 4 || strcmp(name + length - 3, coordinate_endings[0]) != 0) return 0;
    *name_length = length - 3;
    parts[0] = target;
    for (int t = 0; t < mesh->target_count && count < COORDINATE_PARTS; t++) {
        const char *text = gltf_target_name(mesh, t);
        if (!text || strncmp(text, name, length - 3) != 0 ||
            strcmp(text + length - 3, coordinate_endings[count]) != 0)
            continue;
        parts[count++] = t;
        t = -1;
    }
    return count == COORDINATE_PARTS ? count : count >= COORDINATE_STRAIGHT ? COORDINATE_STRAIGHT : 0;
}

bool gltf_is_soft(const struct gltf *gltf)
{
    const struct gltf_mesh *mesh = choose_mesh(gltf);
    size_t length;
    int parts[COORDINATE_PARTS];
    for (int t = 0; mesh && t < mesh->target_count; t++) {
        if (find_parts(mesh, t, &length, parts) > 0) return true;
    }
    return false;
}

static double real_of(const json_t *object, const char *key)
{
    return json_number_value(json_object_get(object, key));
}

/// Reads a target's vectors. An export scales targets so that weights stay within 0 … 1.
static void take_target(const struct gltf_mesh *mesh, int target, double sign, double scale, float (*vectors)[3])
{
    for (int p = 0, base = 0; p < mesh->part_count; base += gltf_own_vertices(&mesh->parts[p++])) {
        const struct gltf_part *part = &mesh->parts[p];
        if (part->shared || !part->targets[target].position) continue;
        for (int i = 0; i < part->vertex_count; i++) {
            for (int k = 0; k < 3; k++)
                vectors[base + i][k] = (float)(sign * (double)part->targets[target].position[i][k] / scale);
        }
    }
}

// --- its place

/// Moves it where the first node that shows it is, or its skin: a mirroring one reverses the triangles and their normals. Without a node it stays
/// exactly as it is. False if memory is short.
static bool place_as_node(const struct gltf *gltf, const struct gltf_mesh *mesh, struct character *c)
{
    struct gltf_pose rest;
    int node = 0;
    c->node = -1;
    while (node < gltf->node_count && gltf->nodes[node].mesh != mesh - gltf->meshes) node++;
    if (node == gltf->node_count) return true;
    if (!gltf_pose_create(gltf, &rest)) return false;
    const int skin = gltf->nodes[node].skin;
    c->node = node;
    memcpy(c->moved, skin < 0 ? rest.world[node] : rest.joints[gltf->skins[skin].first_joint], sizeof c->moved);
    gltf_pose_free(&rest);
    mat4s m = mat4_from(c->moved);
    const mat4s still = glms_mat4_identity();
    if (memcmp(&m, &still, sizeof m) == 0) return true;
    for (int i = 0; i < c->vertex_count; i++) {
        glm_mat4_mulv3(m.raw, c->position[i], 1, c->position[i]);
        gltf_turn_normal((const float *)m.raw, c->normal[i]);
        for (int k = 0; k < c->coordinate_count; k++) {
            for (int p = 0; p < coordinate_parts(&c->coordinates[k]); p++)
                glm_mat4_mulv3(m.raw, c->coordinates[k].parts[p][i], 0, c->coordinates[k].parts[p][i]);
        }
    }
    for (int i = 0; glms_mat4_det(m) < 0 && i + 2 < c->index_count; i += 3) {
        if (c->looks.joined) c->looks.joined[i / 3] = 0; // a reversed fan begins elsewhere
        uint32_t corner = c->indices[i + 1];
        c->indices[i + 1] = c->indices[i + 2];
        c->indices[i + 2] = corner;
    }
    return true;
}

bool character_read(const char *path, struct character *c, struct error *error)
{
    struct gltf gltf;
    *c = (struct character){0};
    if (!gltf_read_stored(path, &gltf, error)) return false;
    const bool made = character_from_gltf(&gltf, c, error);
    gltf_free(&gltf);
    return made;
}

bool character_from_gltf(const struct gltf *gltf, struct character *c, struct error *error)
{
    size_t vertices = 0, coordinates = 0, arrays = 0, length, i;
    int parts[COORDINATE_PARTS] = {0};
    *c = (struct character){0};
    const size_t most = gltf->room / (2 * sizeof *c->position);
    const struct gltf_mesh *mesh = choose_mesh(gltf);
    for (int p = 0; mesh && p < mesh->part_count; p++) vertices += (size_t)gltf_own_vertices(&mesh->parts[p]);
    for (int t = 0; mesh && t < mesh->target_count; t++) {
        const int count = find_parts(mesh, t, &length, parts);
        coordinates += count > 0;
        arrays += (size_t)count;
    }
    bool made = mesh || fail(error, ERROR_INPUT, "%s: expected a mesh of triangles, got %s", gltf->path,
                             gltf->not_shown ? gltf->not_shown : "none");
    made = made &&
           (vertices * arrays <= 2 * most ||
            fail(error, ERROR_INPUT, "%s: expected at most %zu vertices in a file of this size, got %zu times %zu",
                 gltf->path, most, coordinates, vertices));
    if (!made) return false;

    struct surface surface = {0};
    made = surface_of_mesh(gltf, mesh, &surface) && character_create(c, &surface, (int)coordinates);
    surface_free(&surface);
    for (int p = 0, base = 0; made && p < mesh->part_count; base += gltf_own_vertices(&mesh->parts[p++])) {
        const struct gltf_part *part = &mesh->parts[p];
        if (!part->shared && part->normal)
            memcpy(c->normal + base, part->normal, (size_t)part->vertex_count * sizeof *part->normal);
    }

    struct coordinate *coordinate = c->coordinates;
    for (int t = 0; made && t < mesh->target_count; t++) {
        const json_t *known = NULL, *entry;
        const int count = find_parts(mesh, t, &length, parts);
        if (count == 0) continue;
        coordinate->name = strndup(gltf_target_name(mesh, t), length);
        made = coordinate->name &&
               (count == COORDINATE_STRAIGHT || character_curve(c, (int)(coordinate - c->coordinates)));
        if (!made) break;
        json_array_foreach(json_object_get(json_object_get(mesh->extras, "wiggly"), "coordinates"), i, entry)
        {
            const char *called = json_string_value(json_object_get(entry, "name"));
            if (!known && called && strcmp(called, coordinate->name) == 0) known = entry;
        }
        const double scale = coordinate->scale = real_of(known, "scale") > 0 ? real_of(known, "scale") : 1;
        memcpy(coordinate->target, parts, sizeof parts);
        coordinate->frequency = real_of(known, "frequency");
        coordinate->damping = real_of(known, "damping");
        coordinate->explained = real_of(known, "explained");
        coordinate->pca1 = real_of(known, "pca1");
        coordinate->pca2 = real_of(known, "pca2");
        coordinate->most = real_of(known, "most") > 0 ? real_of(known, "most") : INFINITY;
        for (int p = 0; p < count; p++) take_target(mesh, parts[p], p == 1 ? -1 : 1, scale, coordinate->parts[p]);
        const char *bone = json_string_value(json_object_get(known, "bone"));
        coordinate->bone = bone ? strdup(bone) : NULL;
        for (i = 0; i < 3; i++)
            coordinate->base[i] = json_number_value(json_array_get(json_object_get(known, "base"), i)),
            coordinate->at[i] = json_number_value(json_array_get(json_object_get(known, "at"), i));
        coordinate++;
    }
    made = (made && place_as_node(gltf, mesh, c)) || fail_no_memory(error, gltf->path);
    if (!made) character_free(c);
    return made;
}

// --- writing

bool character_write(const char *path, const struct character *character, bool turn_normals, struct error *error)
{
    struct figure figure = {.character = *character};
    struct pool pool = {0};
    struct gltf_file file = {0};
    if (turn_normals) figure_derive(&figure);

    // The vertices of the file: one for each pair of a vertex and its texture coordinates. The character's come first, in order; then copies
    // of those with several texture coordinates.
    const struct looks *own = &character->looks;
    const size_t most = (size_t)character->vertex_count + (own->corner ? (size_t)character->index_count : 0);
    uint32_t *uv_of = pool_take(&pool, most, sizeof *uv_of), *next = pool_take(&pool, most, sizeof *next);
    uint32_t *source = pool_take(&pool, most, sizeof *source); // per vertex of the file: the character's
    uint32_t *indices = pool_take(&pool, (size_t)character->index_count, sizeof *indices);
    float(*uv_at)[2] = own->uv ? pool_take(&pool, most, sizeof *uv_at) : NULL;
    int count = character->vertex_count;
    for (int v = 0; v < character->vertex_count; v++) {
        source[v] = (uint32_t)v;
        uv_of[v] = LOOKS_NONE;
    }
    for (int i = 0; i < character->index_count; i++) {
        const uint32_t vertex = character->indices[i], uv = own->corner ? own->corner[i] : LOOKS_NONE;
        uint32_t at = vertex; // of its copies, the first of which has its number: `next` is the next copy, 0 the end
        if (uv != LOOKS_NONE) {
            if (uv_of[at] == LOOKS_NONE) uv_of[at] = uv;
            while (uv_of[at] != uv && next[at]) at = next[at];
            if (uv_of[at] != uv) {
                next[at] = (uint32_t)count;
                at = (uint32_t)count++;
                source[at] = vertex;
                uv_of[at] = uv;
            }
        }
        indices[i] = at;
    }
    for (int v = 0; uv_at && v < count; v++) {
        const uint32_t uv = own->corner ? uv_of[v] : (uint32_t)v;
        memcpy(uv_at[v], uv != LOOKS_NONE ? own->uv[uv] : (float[2]){0}, sizeof *uv_at);
    }

    struct gltf_shape shape = {.name = "character",
                               .vertex_count = count,
                               .source = source,
                               .position = (const float(*)[3])character->position,
                               .normal = (const float(*)[3])character->normal,
                               .color = (const float(*)[3])character->color,
                               .uv = (const float(*)[2])uv_at,
                               .indices = indices,
                               .index_count = character->index_count,
                               .looks = &character->looks,
                               .coordinates =
                                   pool_take(&pool, (size_t)character->coordinate_count, sizeof *shape.coordinates)};
    shape.targets = pool_take(&pool, COORDINATE_PARTS * (size_t)character->coordinate_count, sizeof *shape.targets);
    for (int k = 0; k < character->coordinate_count; k++) {
        shape.coordinates[shape.coordinate_count++] = &character->coordinates[k];
        for (int p = 0; p < coordinate_parts(&character->coordinates[k]); p++)
            shape.targets[shape.target_count++] = figure_target_create(&figure, k, p, &pool);
    }

    file.root = json_pack("{s:{s:s, s:s}, s:i, s:[{s:[i]}], s:[{s:s, s:i}]}", "asset", "version", "2.0", "generator",
                          "wiggly", "scene", 0, "scenes", "nodes", 0, "nodes", "name", "character", "mesh", 0);
    gltf_append_to(&file, file.root, "meshes", gltf_shape_json(&file, &shape));
    const bool done = gltf_file_save(&file, path, error);
    gltf_file_free(&file);
    pool_free(&pool);
    pool_free(&figure.pool);
    return done;
}
