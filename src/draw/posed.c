/// Collects and poses the triangles of characters.
#include "draw/posed.h"
#include "base/need.h"
#include "model/adjacency.h"
#include <stdlib.h>

static void allocate(struct posed *mesh, size_t vertices, size_t indices, size_t parts)
{
    *mesh = (struct posed){.map_coordinate = -1};
    mesh->indices = pool_take(&mesh->pool, indices, sizeof *mesh->indices);
    mesh->neighbours = pool_take(&mesh->pool, indices, sizeof *mesh->neighbours);
    mesh->place = pool_take(&mesh->pool, vertices, sizeof *mesh->place);
    mesh->normal = pool_take(&mesh->pool, vertices, sizeof *mesh->normal);
    mesh->looks = pool_take(&mesh->pool, vertices, sizeof *mesh->looks);
    mesh->front = pool_take(&mesh->pool, indices / 3, sizeof *mesh->front);
    mesh->parts = pool_take(&mesh->pool, parts, sizeof *mesh->parts);
}

void posed_free(struct posed *mesh)
{
    pool_free(&mesh->pool);
    *mesh = (struct posed){0};
}

/// Finds neighbours across edges, starting at a part. Earlier parts share no edges with later ones.
static void find_neighbours(struct posed *mesh, int from)
{
    if (from == mesh->part_count) return;
    const int first = mesh->parts[from].first, count = mesh->index_count - first;
    const float(*place)[3] = (const float(*)[3])mesh->place;
    const uint32_t *indices = mesh->indices + first;
    int *neighbours = mesh->neighbours + first;
    uint32_t *look = need((size_t)count + 1, sizeof *look);
    for (int p = from; p < mesh->part_count; p++) {
        const struct posed_part *part = &mesh->parts[p];
        const bool coat = part->program == PROGRAM_COAT || part->program == PROGRAM_FACE;
        for (int i = part->first; i < part->end; i++)
            look[i - first] = coat ? 0 : neighbours_look(part->material, mesh->looks[mesh->indices[i]].color);
    }
    neighbours_find(place, mesh->vertex_count, indices, count, neighbours);
    neighbours_cut(place, indices, look, count, neighbours);
    for (int i = 0; i < count; i++) neighbours[i] += neighbours[i] >= 0 ? first / 3 : 0;
    free(look);
}

// --- imported characters and foxes

static bool allocate_gltf(struct posed *mesh, const struct gltf *gltf)
{
    size_t vertices = 0, indices = 0, parts = 0;
    for (int n = 0; n < gltf->node_count; n++) {
        if (gltf->nodes[n].mesh < 0) continue;
        const struct gltf_mesh *shown = &gltf->meshes[gltf->nodes[n].mesh];
        vertices += (size_t)gltf_vertex_count(gltf, n);
        parts += (size_t)shown->part_count;
        for (int p = 0; p < shown->part_count; p++) indices += (size_t)shown->parts[p].index_count;
    }
    *mesh = (struct posed){0};
    if (!need_has_room(vertices * (2 * sizeof *mesh->place + sizeof *mesh->looks) +
                       indices * 8 * sizeof *mesh->neighbours))
        return false;
    allocate(mesh, vertices, indices, parts);
    return true;
}

static enum stage_program program_of(const struct gltf_part *part, const struct gltf_material *material)
{
    if (part->mark) return strcmp(material->name, "face") == 0 ? PROGRAM_FACE : PROGRAM_COAT;
    const bool plain =
        material->image < 0 && material->cutoff <= 0.0f && !material->blended && !material->double_sided;
    return plain ? PROGRAM_PLAIN : PROGRAM_PICTURED;
}

static void look_at_part(const struct gltf_part *part, int vertex, struct posed_look *look)
{
    static const float white[4] = {1, 1, 1, 1};
    if (part->mark) {
        const float *mark = part->mark[vertex], *place = part->position[vertex];
        *look = (struct posed_look){{place[0], place[1], place[2], part->fur[vertex][0]},
                                    {mark[0], mark[1]},
                                    {mark[2], part->fur[vertex][1]},
                                    1};
        return;
    }
    memcpy(look->color, part->color ? part->color[vertex] : white, sizeof look->color);
    look->cover = 1;
    if (part->uv) memcpy(look->uv, part->uv[vertex], sizeof look->uv);
}

static void add_gltf_part(struct posed *mesh, const struct gltf *gltf, int node, const struct gltf_part *part)
{
    static const struct gltf_material plain = {.color = {1, 1, 1, 1}, .image = -1};
    const struct gltf_material *material = part->material < 0 ? &plain : &gltf->materials[part->material];
    struct posed_part *added = &mesh->parts[mesh->part_count++];
    *added = (struct posed_part){.first = mesh->index_count,
                                 .end = mesh->index_count + part->index_count,
                                 .vertex = mesh->vertex_count,
                                 .node = node,
                                 .program = program_of(part, material),
                                 .material = part->material,
                                 .cutoff = material->cutoff,
                                 .blended = material->blended,
                                 .both_sides = material->double_sided};
    memcpy(added->base, material->color, sizeof added->base);
    memcpy(mesh->place + added->vertex, part->position, (size_t)part->vertex_count * sizeof *mesh->place);
    for (int v = 0; v < part->vertex_count; v++) look_at_part(part, v, &mesh->looks[added->vertex + v]);
    for (int i = 0; i < part->index_count; i++)
        mesh->indices[added->first + i] = (uint32_t)added->vertex + part->indices[i];
    mesh->vertex_count += part->vertex_count;
    mesh->index_count = added->end;
}

void posed_from_gltf(struct posed *mesh, const struct gltf *gltf)
{
    if (!allocate_gltf(mesh, gltf)) return;
    for (int n = 0; n < gltf->node_count; n++) {
        const int from = mesh->part_count;
        if (gltf->nodes[n].mesh < 0) continue;
        const struct gltf_mesh *shown = &gltf->meshes[gltf->nodes[n].mesh];
        for (int p = 0; p < shown->part_count; p++) add_gltf_part(mesh, gltf, n, &shown->parts[p]);
        find_neighbours(mesh, from);
    }
}

void posed_pose_gltf(struct posed *mesh, const struct stage_model *shown, const float eye[3])
{
    const struct gltf *gltf = shown->gltf;
    mat4s to_world = mat4_from(shown->root);
    for (int p = 0; p < mesh->part_count; p++) {
        struct posed_part *part = &mesh->parts[p];
        const int node = part->node;
        part->mirrored = gltf->nodes[node].skin < 0 && glms_mat4_det(mat4_from(shown->pose->world[node])) < 0.0f;
        if (p == 0 || part[-1].node != node)
            gltf_pose_vertices(gltf, shown->pose, node, mesh->place + part->vertex, mesh->normal + part->vertex);
    }
    for (int v = 0; v < mesh->vertex_count; v++) {
        glm_mat4_mulv3(to_world.raw, mesh->place[v], 1.0f, mesh->place[v]);
        glm_mat4_mulv3(to_world.raw, mesh->normal[v], 0.0f, mesh->normal[v]);
    }
    posed_face(mesh, eye);
}

// --- soft characters

/// The vertex's own colour or that of its phase. The face keeps its colour: without eyes nobody sees which way the animal looks.
static void map_color(const struct figure *figure, const float phase[2], float color[3])
{
    float mapped[3];
    const float luminance = 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2];
    const float share = glm_smoothstep(0.3f * figure->dark, figure->dark, luminance);
    phase_color_linear(phase[0], phase[1], mapped);
    glm_vec3_lerp(color, mapped, share, color);
}

static void look_at(const struct figure *figure, int map, int axis, int vertex, struct posed_look *look)
{
    const struct character *c = &figure->character;
    *look = (struct posed_look){.color = {[3] = 1.0f}, .cover = 1.0f};
    memcpy(look->color, c->color[vertex], sizeof c->color[vertex]);
    if (c->looks.uv && !c->looks.corner) memcpy(look->uv, c->looks.uv[vertex], sizeof look->uv);
    if (map < 0) return;
    const float largest = figure->largest[map][axis], scale = largest > 0.0f ? 1.0f / largest : 0.0f;
    look->phase[0] = scale * c->coordinates[map].re[vertex][axis];
    look->phase[1] = scale * c->coordinates[map].im[vertex][axis];
    map_color(figure, look->phase, look->color);
}

/// A phase map shows no materials.
static void dress(struct posed *mesh, const struct looks *looks)
{
    for (int p = 0; p < mesh->part_count; p++) {
        static const struct looks_material none = {.color = {1, 1, 1, 1}};
        struct posed_part *part = &mesh->parts[p];
        const bool is_seen = part->material >= 0 && mesh->map_coordinate < 0;
        const struct looks_material *material = is_seen ? &looks->materials[part->material] : &none;
        memcpy(part->base, material->color, sizeof part->base);
        part->blended = part->base[3] < 1.0f;
        part->program = material->image || part->blended || part->both_sides ? PROGRAM_PICTURED : PROGRAM_PLAIN;
    }
}

/// The triangles of a material; −1: those with none of the first `materials`.
static void add_material(struct posed *mesh, const struct figure *figure, bool coarse, int material, int materials)
{
    const struct character *c = &figure->character;
    const uint32_t *indices = coarse ? figure->coarse : c->indices;
    const int count = coarse ? figure->coarse_count : c->index_count;
    struct posed_part *part = &mesh->parts[mesh->part_count];
    *part = (struct posed_part){.first = mesh->index_count, .material = material};
    for (int i = 0; i < count; i += 3) {
        const uint32_t of =
            materials > 0 ? c->looks.material[coarse ? figure->coarse_from[i / 3] : (uint32_t)i / 3] : 0;
        if ((of < (uint32_t)materials ? (int)of : -1) != material) continue;
        memcpy(mesh->indices + mesh->index_count, indices + i, 3 * sizeof *indices);
        mesh->index_count += 3;
    }
    part->end = mesh->index_count;
    mesh->part_count += part->end > part->first;
}

void posed_from_figure(struct posed *mesh, const struct figure *figure, bool coarse)
{
    const struct character *c = &figure->character;
    const int count = coarse ? figure->coarse_count : c->index_count;
    const int materials = looks_show(&c->looks) ? c->looks.material_count : 0;
    allocate(mesh, (size_t)c->vertex_count, (size_t)count, (size_t)materials + 1);
    mesh->vertex_count = c->vertex_count;
    memcpy(mesh->place, c->position, (size_t)c->vertex_count * sizeof *mesh->place);
    for (int v = 0; v < c->vertex_count; v++) look_at(figure, -1, 0, v, &mesh->looks[v]);
    for (int m = 0; m < materials; m++) add_material(mesh, figure, coarse, m, materials);
    add_material(mesh, figure, coarse, -1, materials);
    find_neighbours(mesh, 0);
    bool open = false; // then its back can be seen, as a flag's
    for (int i = 0; i < mesh->index_count; i++) open = open || mesh->neighbours[i] == NEIGHBOUR_NONE;
    for (int p = 0; p < mesh->part_count; p++) mesh->parts[p].both_sides = open;
    dress(mesh, &c->looks);
}

bool posed_map_figure(struct posed *mesh, const struct stage_character *shown)
{
    const struct figure *figure = shown->figure;
    const int map = shown->map_coordinate, axis = shown->map_axis;
    if (map == mesh->map_coordinate && (map < 0 || (axis == mesh->map_axis && figure->version == mesh->map_version)))
        return false;
    mesh->map_coordinate = map;
    mesh->map_axis = axis;
    mesh->map_version = figure->version;
    for (int v = 0; v < mesh->vertex_count; v++) look_at(figure, map, axis, v, &mesh->looks[v]);
    dress(mesh, &figure->character.looks);
    return true;
}

void posed_pose_figure(struct posed *mesh, const struct stage_character *shown, const float eye[3])
{
    const struct figure *figure = shown->figure;
    const float place[3] = {shown->position[0], shown->position[1] - figure->lo[1], shown->position[2]};
    for (int v = 0; v < mesh->vertex_count; v++) {
        morph_vertex(figure, &shown->morph, v, mesh->place[v], mesh->normal[v]);
        for (int k = 0; k < 3; k++) mesh->place[v][k] += place[k];
    }
    posed_face(mesh, eye);
}
