/// Makes and frees characters; makes characters and surfaces from glTF files. A character is the first mesh with morph targets, else the
/// first with triangles.
#include "model/character.h"
#include "model/gltf.h"
#include "model/surface_readers.h"
#include "model/vector.h"
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Normals from triangles, weighted by area; (0, 1, 0) for a vertex without.
static void compute_normals(struct character *c)
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

static float (*white(int count))[3]
{
    float(*color)[3] = malloc((size_t)count * sizeof *color);
    for (int n = 0; color && n < 3 * count; n++) color[n / 3][n % 3] = 1;
    return color;
}

static bool create_coordinates(struct character *c, int count)
{
    size_t vertices = (size_t)c->vertex_count;
    bool whole = true;
    c->coordinates = calloc((size_t)count + 1, sizeof *c->coordinates);
    if (!c->coordinates) return false;
    c->coordinate_count = count;
    for (int i = 0; i < count; i++) {
        c->coordinates[i].re = calloc(vertices, sizeof *c->coordinates[i].re);
        c->coordinates[i].im = calloc(vertices, sizeof *c->coordinates[i].im);
        whole = whole && c->coordinates[i].re && c->coordinates[i].im;
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
        .color = surface->color ? surface->color : white(surface->vertex_count),
        .indices = surface->indices,
        .looks = surface->looks,
    };
    *surface = (struct surface){0};
    if (c->normal && c->color && create_coordinates(c, coordinates)) {
        compute_normals(c);
        return true;
    }
    character_free(c);
    return false;
}

void character_free(struct character *c)
{
    for (int i = 0; i < c->coordinate_count; i++) {
        free(c->coordinates[i].name);
        free(c->coordinates[i].re);
        free(c->coordinates[i].im);
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

enum { COUNT_LIMIT = 1 << 28 };

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

/// The character's vertex number of a part's first vertex; `next` receives the next part's.
static int first_vertex(const struct gltf_part *part, int *next)
{
    const int first = part->shared ? 0 : *next;
    *next += part->shared ? 0 : part->vertex_count;
    return first;
}

// --- surface

static bool reserve(const struct gltf_mesh *mesh, struct surface *s)
{
    size_t vertices = 0, indices = 0;
    bool uv = false;
    for (int p = 0; p < mesh->part_count; p++) {
        vertices += mesh->parts[p].shared ? 0 : (size_t)mesh->parts[p].vertex_count;
        indices += (size_t)mesh->parts[p].index_count;
        uv = uv || mesh->parts[p].uv;
    }
    if (vertices > COUNT_LIMIT || indices > COUNT_LIMIT) return false;
    s->vertex_count = (int)vertices;
    s->index_count = (int)indices;
    s->position = calloc(vertices, sizeof *s->position);
    s->color = calloc(vertices, sizeof *s->color);
    s->indices = calloc(indices, sizeof *s->indices);
    s->looks.material = calloc(indices / 3, sizeof *s->looks.material);
    s->looks.joined = calloc(indices / 3, sizeof *s->looks.joined);
    s->looks.uv = uv ? calloc(vertices, sizeof *s->looks.uv) : NULL;
    s->looks.uv_count = uv ? (int)vertices : 0;
    return s->position && s->color && s->indices && s->looks.material && s->looks.joined && (!uv || s->looks.uv);
}

static void add_vertices(struct surface *s, int base, const struct gltf_part *part)
{
    const size_t count = (size_t)part->vertex_count;
    memcpy(s->position + base, part->position, count * sizeof *s->position);
    if (part->uv) memcpy(s->looks.uv + base, part->uv, count * sizeof *part->uv);
    for (int i = 0; i < part->vertex_count; i++) {
        for (int k = 0; k < 3; k++) s->color[base + i][k] = part->color ? part->color[i][k] : 1;
    }
}

/// The base colour and, if it takes at most `room`, the bytes of its picture.
static bool copy_look(const struct gltf *gltf, int number, size_t room, struct looks_material *look)
{
    const struct gltf_material *material = &gltf->materials[number];
    for (int k = 0; k < 4; k++) look->color[k] = glm_clamp(material->color[k], 0, 1);
    const struct gltf_image *image = material->image >= 0 ? &gltf->images[material->image] : NULL;
    if (look->image || !image || image->size > room || !looks_image_kind(image->bytes, image->size)) return true;
    look->image = malloc(image->size);
    if (!look->image) return false;
    memcpy(look->image, image->bytes, image->size);
    look->image_size = image->size;
    return true;
}

/// Copies the materials into empty looks, with their PNG or JPEG pictures. False if memory is short.
static bool copy_looks(const struct gltf *gltf, struct looks *looks)
{
    size_t room = LOOKS_IMAGES_LIMIT;
    looks->materials = calloc((size_t)gltf->material_count + 1, sizeof *looks->materials);
    if (!looks->materials) return false;
    for (int m = 0; m < gltf->material_count; m++) {
        struct looks_material *look = &looks->materials[looks->material_count++];
        look->name = strdup(gltf->materials[m].name);
        if (!look->name || !copy_look(gltf, m, room, look)) return false;
        room -= look->image_size;
    }
    return true;
}

/// All parts of a mesh as one surface.
static bool make_surface(const struct gltf *gltf, const struct gltf_mesh *mesh, struct surface *s)
{
    int next = 0, index = 0;
    if (!reserve(mesh, s) || !copy_looks(gltf, &s->looks)) return false;
    for (int p = 0; p < mesh->part_count; p++) {
        const struct gltf_part *part = &mesh->parts[p];
        const int base = first_vertex(part, &next);
        if (!part->shared) add_vertices(s, base, part);
        for (int i = 0; i < part->index_count; i++, index++) {
            s->indices[index] = (uint32_t)base + part->indices[i];
            if (i % 3 > 0) continue;
            s->looks.material[index / 3] = part->material >= 0 ? (uint32_t)part->material : LOOKS_NONE;
            s->looks.joined[index / 3] = gltf_joins(part, i);
        }
    }
    looks_drop_unused(&s->looks, s->index_count / 3);
    return true;
}

// --- coordinates

/// The target called `name` followed by `part`, or −1.
static int target_called(const struct gltf_mesh *mesh, const char *name, size_t length, const char *part)
{
    for (int t = 0; t < mesh->target_count; t++) {
        const char *text = gltf_target_name(mesh, t);
        if (text && strlen(text) == length + strlen(part) && strncmp(text, name, length) == 0 &&
            strcmp(text + length, part) == 0)
            return t;
    }
    return -1;
}

/// Whether a target is the real part of a coordinate, and which target is its imaginary part.
static bool is_coordinate(const struct gltf_mesh *mesh, int target, size_t *name_length, int *im)
{
    const char *name = gltf_target_name(mesh, target);
    size_t length = name ? strlen(name) : 0;
    if (length < 4 || strcmp(name + length - 3, ".re") != 0) return false;
    *name_length = length - 3;
    *im = target_called(mesh, name, length - 3, ".im");
    return *im >= 0;
}

bool gltf_is_soft(const struct gltf *gltf)
{
    const struct gltf_mesh *mesh = choose_mesh(gltf);
    size_t length;
    int im;
    for (int t = 0; mesh && t < mesh->target_count; t++) {
        if (is_coordinate(mesh, t, &length, &im)) return true;
    }
    return false;
}

static double real_of(const json_t *object, const char *key)
{
    return json_number_value(json_object_get(object, key));
}

/// The coordinate's entry in our extras, or NULL.
static const json_t *known_of(const struct gltf_mesh *mesh, const char *name)
{
    size_t i;
    const json_t *known;
    json_array_foreach(json_object_get(json_object_get(mesh->extras, "wiggly"), "coordinates"), i, known)
    {
        const char *called = json_string_value(json_object_get(known, "name"));
        if (called && strcmp(called, name) == 0) return known;
    }
    return NULL;
}

/// Reads a target's vectors. An export scales targets so that weights stay within 0 … 1.
static void take_target(const struct gltf_mesh *mesh, int target, double sign, double scale, float (*vectors)[3])
{
    int next = 0;
    for (int p = 0; p < mesh->part_count; p++) {
        const struct gltf_part *part = &mesh->parts[p];
        const int base = first_vertex(part, &next);
        if (part->shared || !part->targets[target].position) continue;
        for (int i = 0; i < part->vertex_count; i++) {
            for (int k = 0; k < 3; k++)
                vectors[base + i][k] = (float)(sign * (double)part->targets[target].position[i][k] / scale);
        }
    }
}

static bool take_coordinates(const struct gltf_mesh *mesh, struct character *c)
{
    struct coordinate *coordinate = c->coordinates;
    for (int t = 0; t < mesh->target_count; t++) {
        size_t length;
        int im;
        if (!is_coordinate(mesh, t, &length, &im)) continue;
        coordinate->name = strndup(gltf_target_name(mesh, t), length);
        if (!coordinate->name) return false;
        const json_t *known = known_of(mesh, coordinate->name);
        const double scale = real_of(known, "scale") > 0 ? real_of(known, "scale") : 1;
        coordinate->frequency = real_of(known, "frequency");
        coordinate->damping = real_of(known, "damping");
        coordinate->explained = real_of(known, "explained");
        coordinate->pca1 = real_of(known, "pca1");
        coordinate->pca2 = real_of(known, "pca2");
        take_target(mesh, t, 1, scale, coordinate->re);
        take_target(mesh, im, -1, scale, coordinate->im);
        coordinate++;
    }
    return true;
}

// --- its place

/// Moves a character to its node's place. A mirroring node reverses the triangles and their normals.
static void place(struct character *c, mat4s m)
{
    for (int i = 0; i < c->vertex_count; i++) {
        glm_mat4_mulv3(m.raw, c->position[i], 1, c->position[i]);
        gltf_turn_normal((const float *)m.raw, c->normal[i]);
        for (int k = 0; k < c->coordinate_count; k++) {
            glm_mat4_mulv3(m.raw, c->coordinates[k].re[i], 0, c->coordinates[k].re[i]);
            glm_mat4_mulv3(m.raw, c->coordinates[k].im[i], 0, c->coordinates[k].im[i]);
        }
    }
    for (int i = 0; glms_mat4_det(m) < 0 && i + 2 < c->index_count; i += 3) {
        if (c->looks.joined) c->looks.joined[i / 3] = 0; // a reversed fan begins elsewhere
        uint32_t corner = c->indices[i + 1];
        c->indices[i + 1] = c->indices[i + 2];
        c->indices[i + 2] = corner;
    }
}

/// Moves it where the first node that shows it is. Without a node it stays exactly as it is. False if memory is short.
static bool place_as_node(const struct gltf *gltf, const struct gltf_mesh *mesh, struct character *c)
{
    struct gltf_pose rest;
    bool moved = false;
    int node = 0;
    while (node < gltf->node_count && gltf->nodes[node].mesh != mesh - gltf->meshes) node++;
    if (node == gltf->node_count) return true;
    if (!gltf_pose_create(gltf, &rest)) return false;
    for (int n = 0; n < 16; n++) moved = moved || rest.world[node][n] != (n % 5 == 0);
    if (moved) place(c, mat4_from(rest.world[node]));
    gltf_pose_free(&rest);
    return true;
}

// --- the whole character

static bool make_character(const struct gltf *gltf, const struct gltf_mesh *mesh, int coordinates,
                           struct character *c)
{
    struct surface surface = {0};
    int next = 0;
    const bool made = make_surface(gltf, mesh, &surface) && character_create(c, &surface, coordinates);
    surface_free(&surface);
    if (!made) return false;
    for (int p = 0; p < mesh->part_count; p++) {
        const struct gltf_part *part = &mesh->parts[p];
        const int base = first_vertex(part, &next);
        if (!part->shared && part->normal)
            memcpy(c->normal + base, part->normal, (size_t)part->vertex_count * sizeof *part->normal);
    }
    return take_coordinates(mesh, c) && place_as_node(gltf, mesh, c);
}

static bool read_character(const struct gltf *gltf, struct character *c, struct error *error)
{
    const struct gltf_mesh *mesh = choose_mesh(gltf);
    size_t vertices = 0, coordinates = 0, length;
    int im;
    if (!mesh)
        return fail(error, ERROR_INPUT, "%s: expected a mesh of triangles, got %s", gltf->path,
                    gltf->not_shown ? gltf->not_shown : "none");
    for (int p = 0; p < mesh->part_count; p++)
        vertices += mesh->parts[p].shared ? 0 : (size_t)mesh->parts[p].vertex_count;
    for (int t = 0; t < mesh->target_count; t++) coordinates += is_coordinate(mesh, t, &length, &im);
    if (vertices * coordinates > gltf->room / (2 * sizeof *c->position))
        return fail(error, ERROR_INPUT, "%s: expected at most %zu vertices in a file of this size, got %zu times %zu",
                    gltf->path, gltf->room / (2 * sizeof *c->position), coordinates, vertices);
    return make_character(gltf, mesh, (int)coordinates, c) || fail_no_memory(error, gltf->path);
}

bool character_read(const char *path, struct character *character, struct error *error)
{
    struct gltf gltf;
    *character = (struct character){0};
    if (!gltf_read_stored(path, &gltf, error)) return false;
    const bool done = read_character(&gltf, character, error);
    gltf_free(&gltf);
    if (!done) character_free(character);
    return done;
}

// --- everything a file shows at rest, as one surface

static uint32_t add_material(struct surface_builder *b, const struct gltf *gltf, int number)
{
    const uint32_t index = builder_material(b, gltf->materials[number].name);
    if (index == LOOKS_NONE) return index;
    const size_t used = looks_image_bytes(&b->surface->looks);
    const size_t room = used < LOOKS_IMAGES_LIMIT ? LOOKS_IMAGES_LIMIT - used : 0;
    b->failed = b->failed || !copy_look(gltf, number, room, &b->surface->looks.materials[index]);
    return index;
}

static void add_part(struct surface_builder *b, const struct gltf *gltf, const struct gltf_part *part,
                     float (*position)[3])
{
    const int first = b->surface->vertex_count, first_uv = b->surface->looks.uv_count;
    b->material = part->material >= 0 ? add_material(b, gltf, part->material) : LOOKS_NONE;
    for (int i = 0; i < part->vertex_count && !b->failed; i++) {
        const double p[3] = {(double)position[i][0], (double)position[i][1], (double)position[i][2]};
        builder_vertex(b, p);
        if (part->color) {
            const float *c = part->color[i];
            const float rgb[3] = {glm_clamp(c[0], 0, 1), glm_clamp(c[1], 0, 1), glm_clamp(c[2], 0, 1)};
            builder_linear_color(b, rgb);
        }
        if (part->uv) builder_uv(b, (double)part->uv[i][0], (double)part->uv[i][1]);
    }
    for (int i = 0; i + 2 < part->index_count && !b->failed; i += 3) {
        const uint32_t *corner = part->indices + i;
        const bool joined = gltf_joins(part, i);
        if (!joined) builder_end_polygon(b);
        for (int k = joined ? 2 : 0; k < 3; k++)
            builder_corner(b, (uint32_t)first + corner[k], part->uv ? (uint32_t)first_uv + corner[k] : LOOKS_NONE);
    }
    builder_end_polygon(b);
}

static bool add_nodes(struct surface_builder *b, const struct gltf *gltf, const struct gltf_pose *pose)
{
    for (int n = 0; n < gltf->node_count; n++) {
        const int count = gltf_vertex_count(gltf, n);
        if (count == 0) continue;
        float(*position)[3] = malloc((size_t)count * sizeof *position);
        if (!position) return false;
        gltf_pose_vertices(gltf, pose, n, position, NULL);
        const struct gltf_mesh *mesh = &gltf->meshes[gltf->nodes[n].mesh];
        for (int p = 0, first = 0; p < mesh->part_count; first += mesh->parts[p++].vertex_count)
            add_part(b, gltf, &mesh->parts[p], position + first);
        free(position);
    }
    return true;
}

bool gltf_surface_read(struct words *words, struct surface_builder *builder)
{
    struct gltf gltf;
    struct gltf_pose pose;
    if (!gltf_read_stored(words->path, &gltf, words->error)) return false;
    const bool posed = gltf_pose_create(&gltf, &pose); // at rest
    builder->failed = !posed || !add_nodes(builder, &gltf, &pose) || builder->failed;
    if (posed) gltf_pose_free(&pose);
    gltf_free(&gltf);
    return true;
}
