/// Collects, colours and poses the triangles of models, finds their outlines and builds skirts.
#include "draw/posed.h"
#include "base/need.h"
#include "model/adjacency.h"
#include <stdlib.h>

void posed_free(struct posed *mesh)
{
    pool_free(&mesh->pool);
    *mesh = (struct posed){0};
}

// --- models

/// Gives a part the look of its material. Without one, or where phases hide it, it is plain white.
static void dress(struct posed_part *part, const struct gltf *gltf, bool hidden)
{
    static const struct gltf_material plain = {.color = {1, 1, 1, 1}, .image = -1};
    const struct gltf_part *own = part->own;
    const struct gltf_material *m = own->material < 0 || hidden ? &plain : &gltf->materials[own->material];
    const bool is_face = own->mark && strcmp(m->name, "face") == 0;
    const bool is_plain = m->image < 0 && m->cutoff <= 0.0f && !m->blended && !m->double_sided;
    part->program = is_face ? PROGRAM_FACE : own->mark ? PROGRAM_COAT : is_plain ? PROGRAM_PLAIN : PROGRAM_PICTURED;
    part->material = m;
}

static void look_at(const struct gltf_part *part, int v, struct posed_look *look)
{
    if (part->mark) {
        const float *mark = part->mark[v], *place = part->position[v], *fur = part->fur[v];
        *look = (struct posed_look){{place[0], place[1], place[2], fur[0]}, {mark[0], mark[1]}, {mark[2], fur[1]}, 1};
        return;
    }
    *look = (struct posed_look){.color = {1, 1, 1, 1}, .cover = 1};
    if (part->color) memcpy(look->color, part->color[v], sizeof look->color);
    if (part->uv) memcpy(look->uv, part->uv[v], sizeof look->uv);
}

void posed_from_gltf(struct posed *mesh, const struct gltf *gltf)
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
        return;
    mesh->indices = pool_take(&mesh->pool, indices, sizeof *mesh->indices);
    mesh->neighbours = pool_take(&mesh->pool, indices, sizeof *mesh->neighbours);
    mesh->place = pool_take(&mesh->pool, vertices, sizeof *mesh->place);
    mesh->normal = pool_take(&mesh->pool, vertices, sizeof *mesh->normal);
    mesh->looks = pool_take(&mesh->pool, vertices, sizeof *mesh->looks);
    mesh->front = pool_take(&mesh->pool, indices / 3, sizeof *mesh->front);
    mesh->parts = pool_take(&mesh->pool, parts, sizeof *mesh->parts);
    for (int n = 0; n < gltf->node_count; n++) {
        const int from = mesh->part_count;
        if (gltf->nodes[n].mesh < 0) continue;
        const struct gltf_mesh *shown = &gltf->meshes[gltf->nodes[n].mesh];
        for (int p = 0; p < shown->part_count; p++) {
            const struct gltf_part *part = &shown->parts[p];
            struct posed_part *added = &mesh->parts[mesh->part_count++];
            *added = (struct posed_part){.first = mesh->index_count,
                                         .end = mesh->index_count + part->index_count,
                                         .vertex = mesh->vertex_count,
                                         .node = n,
                                         .own = part};
            dress(added, gltf, false);
            memcpy(mesh->place + added->vertex, part->position, (size_t)part->vertex_count * sizeof *mesh->place);
            for (int v = 0; v < part->vertex_count; v++) look_at(part, v, &mesh->looks[added->vertex + v]);
            for (int i = 0; i < part->index_count; i++)
                mesh->indices[added->first + i] = (uint32_t)added->vertex + part->indices[i];
            mesh->vertex_count += part->vertex_count;
            mesh->index_count = added->end;
        }
        if (from == mesh->part_count) continue;

        // Neighbours across edges. Parts of other nodes share no edges with these.
        const int first = mesh->parts[from].first, count = mesh->index_count - first;
        const float(*place)[3] = (const float(*)[3])mesh->place;
        int *neighbours = mesh->neighbours + first;
        uint32_t *look = need((size_t)count + 1, sizeof *look);
        for (int p = from; p < mesh->part_count; p++) {
            const struct posed_part *part = &mesh->parts[p];
            const bool coat = part->program == PROGRAM_COAT || part->program == PROGRAM_FACE;
            for (int i = part->first; i < part->end; i++)
                look[i - first] =
                    coat ? 0 : neighbours_look(part->own->material, mesh->looks[mesh->indices[i]].color);
        }
        neighbours_find(place, mesh->vertex_count, mesh->indices + first, count, neighbours);
        neighbours_cut(place, mesh->indices + first, look, count, neighbours);
        for (int i = 0; i < count; i++) neighbours[i] += neighbours[i] >= 0 ? first / 3 : 0;
        free(look);
    }
}

/// The first vertex of a part in its figure.
static int figure_first(const struct posed *mesh, const struct posed_part *part, int first)
{
    int at = 0;
    for (int p = first; &mesh->parts[p] < part && !part->own->shared; p++)
        at += mesh->parts[p].own->shared ? 0 : mesh->parts[p].own->vertex_count;
    return at;
}

bool posed_map(struct posed *mesh, const struct stage_model *shown)
{
    const struct figure *figure = shown->posed.figure;
    const int map = figure ? shown->map_coordinate : -1, axis = shown->map_axis;
    uint64_t phases = 0;
    if (map >= 0)
        phases = hash_word(hash_word(hash_word(HASH_START, figure->id), figure->version), (uint64_t)(3 * map + axis));
    if (phases == mesh->phases) return false;
    mesh->phases = phases;
    int first = figure ? 0 : mesh->part_count;
    while (first < mesh->part_count && mesh->parts[first].node != figure->character.node) first++;
    for (int p = first; p < mesh->part_count && mesh->parts[p].node == mesh->parts[first].node; p++) {
        struct posed_part *part = &mesh->parts[p];
        const int from = figure_first(mesh, part, first);
        dress(part, shown->posed.gltf, map >= 0);
        for (int v = 0; v < part->own->vertex_count; v++) {
            struct posed_look *look = &mesh->looks[part->vertex + v];
            look_at(part->own, v, look);
            if (map < 0) continue;

            // The colour by its phase. The face keeps its own: without eyes nobody sees which way the animal looks.
            const struct coordinate *shown_by = &figure->character.coordinates[map];
            const float largest = figure->largest[map][axis], scale = largest > 0.0f ? 1.0f / largest : 0.0f;
            float *color = look->color, mapped[3];
            look->phase[0] = scale * shown_by->re[from + v][axis];
            look->phase[1] = scale * shown_by->im[from + v][axis];
            const float luminance = 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2];
            const float share = glm_smoothstep(0.3f * figure->dark, figure->dark, luminance);
            phase_color_linear(look->phase[0], look->phase[1], mapped);
            glm_vec3_lerp(color, mapped, share, color);
        }
    }
    return true;
}

void posed_pose(struct posed *mesh, const struct stage_model *shown, const float eye[3])
{
    const struct model_pose *posed = &shown->posed;
    const struct gltf *gltf = posed->gltf;
    const int soft = posed->figure ? posed->figure->character.node : -1;
    mat4s to_world = mat4_from(posed->root);
    for (int p = 0; p < mesh->part_count; p++) {
        struct posed_part *part = &mesh->parts[p];
        const int node = part->node, end = part->vertex + gltf_vertex_count(gltf, node);
        part->mirrored = gltf->nodes[node].skin < 0 && glms_mat4_det(mat4_from(posed->pose->world[node])) < 0.0f;
        if (p > 0 && part[-1].node == node) continue;
        float(*place)[3] = mesh->place + part->vertex, (*normal)[3] = mesh->normal + part->vertex;
        if (node != soft) {
            gltf_pose_vertices(gltf, posed->pose, node, place, normal);
            for (int v = part->vertex; v < end; v++) {
                glm_mat4_mulv3(to_world.raw, mesh->place[v], 1.0f, mesh->place[v]);
                glm_mat4_mulv3(to_world.raw, mesh->normal[v], 0.0f, mesh->normal[v]);
            }
            continue;
        }
        figure_vertices(posed, place, normal, NULL, NULL);
        int last = p; // parts that share the figure's vertices get copies, from behind
        while (last + 1 < mesh->part_count && mesh->parts[last + 1].node == node) last++;
        for (; last > p; last--) {
            const struct posed_part *copy = &mesh->parts[last];
            const int from = figure_first(mesh, copy, p);
            const size_t size = (size_t)copy->own->vertex_count * sizeof *place;
            memmove(mesh->place + copy->vertex, place + from, size);
            memmove(mesh->normal + copy->vertex, normal + from, size);
        }
    }

    // The triangles that face the eye, or nearly. Near the limit the rasteriser decides, because it rounds.
    static const float slack = 1e-6f; // squared cosine
    for (int p = 0; p < mesh->part_count; p++) {
        const struct posed_part *part = &mesh->parts[p];
        for (int i = part->first; i < part->end; i += 3) {
            const uint32_t *corner = mesh->indices + i;
            const float *a = mesh->place[corner[0]];
            const vec3s normal = triangle_normal(a, mesh->place[corner[1]], mesh->place[corner[2]]);
            const vec3s to_eye = glms_vec3_sub(vec3_from(eye), vec3_from(a));
            const float facing = (part->mirrored ? -1.0f : 1.0f) * glms_vec3_dot(normal, to_eye);
            mesh->front[i / 3] =
                facing >= 0.0f || facing * facing < slack * glms_vec3_norm2(normal) * glms_vec3_norm2(to_eye);
        }
    }
}

// --- skirts

/// Pixels towards the eye for skirts on a continuing surface, which may itself lean towards the eye.
static const float LIFT = 2.0f;

int skirt_next(const struct posed *mesh, const struct posed_part *part, int from)
{
    for (int i = from; i < part->end; i++) {
        const int other = mesh->neighbours[i];
        const bool front = mesh->front[i / 3];
        if (other < 0 ? front || part->material->double_sided : front && !mesh->front[other]) return i;
    }
    return part->end;
}

void skirt_hang(const struct posed *mesh, const struct posed_part *part, int corner, const float eye[3], float seam,
                float (*place)[3], float (*normal)[3], struct posed_look *look)
{
    const bool front = mesh->front[corner / 3], open = mesh->neighbours[corner] < 0;
    const float side = front == part->mirrored ? -1.0f : 1.0f; // the triangle is to the left of its edge
    const uint32_t *const triangle = mesh->indices + corner / 3 * 3;
    for (int e = 0; e < 2;
         e++) { // the edge's ends, with normals towards the eye; without normals they are the triangle's
        const uint32_t vertex = mesh->indices[e ? next_corner(corner) : corner];
        vec3s out = vec3_from(mesh->normal[vertex]);
        if (glms_vec3_norm2(out) == 0)
            out = glms_vec3_scale(glms_vec3_normalize(triangle_normal(
                                      mesh->place[triangle[0]], mesh->place[triangle[1]], mesh->place[triangle[2]])),
                                  part->mirrored ? -1.0f : 1.0f);
        look[e] = mesh->looks[vertex];
        glm_vec3_copy(mesh->place[vertex], place[e]);
        glm_vec3_scale(out.raw, front ? 1.0f : -1.0f, normal[e]);
    }

    // Texture coordinates move half a pixel into the triangle: a lookup at its edge may hit the opposite side of the picture.
    const uint32_t third = mesh->indices[next_corner(next_corner(corner))];
    const vec3s from = vec3_from(place[0]), edge = glms_vec3_sub(vec3_from(place[1]), from);
    const float area = glms_vec3_norm(glms_vec3_cross(edge, glms_vec3_sub(vec3_from(mesh->place[third]), from)));
    const float pixel = seam * glms_vec3_distance(from, vec3_from(eye));
    const float share = fminf(0.5f * pixel * glms_vec3_norm(edge) / fmaxf(area, 1e-12f), 0.5f);
    for (int e = 0; e < 2; e++) {
        for (int k = 0; k < 2; k++) look[e].uv[k] += share * (mesh->looks[third].uv[k] - look[e].uv[k]);

        // One pixel out, across the line of sight: along the vertex normal, so that skirts of consecutive edges meet. If that does not point
        // away from the edge, across the edge.
        const vec3s ray = glms_vec3_sub(vec3_from(place[e]), vec3_from(eye)), up = vec3_from(normal[e]);
        const vec3s off_edge = glms_vec3_scale(glms_vec3_normalize(glms_vec3_cross(ray, edge)), side);
        const float depth = glms_vec3_dot(up, ray) / glms_vec3_norm2(ray);
        const vec3s along = glms_vec3_normalize(glms_vec3_sub(up, glms_vec3_scale(ray, depth)));
        const vec3s way = open || glms_vec3_dot(along, off_edge) < 0.3f ? off_edge : along;
        vec3s off = glms_vec3_scale(way, seam * glms_vec3_norm(ray));
        const int outer = 3 - e;
        glm_vec3_add(place[e], off.raw, place[outer]);
        glm_vec3_copy(normal[e], normal[outer]);
        look[outer] = look[e];
        look[outer].cover = 0.0f;
    }
    for (int c = 0; mesh->neighbours[corner] == NEIGHBOUR_CUT && c < SKIRT_CORNERS; c++) {
        for (int k = 0; k < 3; k++) place[c][k] += LIFT * seam * (eye[k] - place[c][k]);
    }
}
