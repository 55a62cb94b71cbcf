/// Finds things in a glTF character, and frees it.
#include "model/gltf.h"
#include "model/gltf_read.h"
#include <stdlib.h>
#include <string.h>

static int compare_names(const void *a, const void *b)
{
    const struct gltf_called *p = a, *q = b;
    const int order = strcmp(p->name, q->name);
    return order ? order : p->node - q->node;
}

bool gltf_link_nodes(struct gltf *gltf)
{
    gltf->called = malloc(((size_t)gltf->node_count + 1) * sizeof *gltf->called);
    if (!gltf->called) return false;
    for (int n = 0; n < gltf->node_count; n++) {
        gltf->nodes[n].child = gltf->nodes[n].next = -1;
        gltf->called[n] = (struct gltf_called){gltf->nodes[n].name, n};
    }
    for (int n = gltf->node_count - 1; n >= 0; n--) {
        struct gltf_node *node = &gltf->nodes[n];
        if (node->parent < 0) continue;
        node->next = gltf->nodes[node->parent].child;
        gltf->nodes[node->parent].child = n;
    }
    qsort(gltf->called, (size_t)gltf->node_count, sizeof *gltf->called, compare_names);
    return true;
}

int gltf_find_node(const struct gltf *gltf, const char *name)
{
    int first = 0, end = gltf->node_count;
    while (first < end) {
        const int middle = first + (end - first) / 2;
        if (strcmp(gltf->called[middle].name, name) < 0) {
            first = middle + 1;
        } else {
            end = middle;
        }
    }
    const bool found = first < gltf->node_count && strcmp(gltf->called[first].name, name) == 0;
    return found ? gltf->called[first].node : -1;
}

int gltf_find_clip(const struct gltf *gltf, const char *name)
{
    for (int i = 0; i < gltf->clip_count; i++) {
        if (strcmp(gltf->clips[i].name, name) == 0) return i;
    }
    return -1;
}

const char *gltf_target_name(const struct gltf_mesh *mesh, int target)
{
    return json_string_value(json_array_get(json_object_get(mesh->extras, "targetNames"), (size_t)target));
}

int gltf_vertex_count(const struct gltf *gltf, int node)
{
    const struct gltf_mesh *mesh = gltf->nodes[node].mesh >= 0 ? &gltf->meshes[gltf->nodes[node].mesh] : NULL;
    int count = 0;
    for (int i = 0; mesh && i < mesh->part_count; i++) count += mesh->parts[i].vertex_count;
    return count;
}

static void free_vertices(struct gltf_part *part, int targets)
{
    for (int i = 0; part->targets && i < targets; i++) {
        free(part->targets[i].position);
        free(part->targets[i].normal);
    }
    free(part->targets);
    free(part->position);
    free(part->normal);
    free(part->color);
    free(part->joints);
    free(part->weights);
    free(part->along);
    free(part->mark);
    free(part->fur);
}

static void free_mesh(struct gltf_mesh *mesh)
{
    for (int i = 0; i < mesh->part_count; i++) {
        if (!mesh->parts[i].shared) free_vertices(&mesh->parts[i], mesh->target_count);
        if (i == 0 || mesh->parts[i].uv != mesh->parts[0].uv) free(mesh->parts[i].uv);
        free(mesh->parts[i].indices);
    }
    json_decref(mesh->extras);
    free(mesh->parts);
    free(mesh->weights);
    free(mesh->name);
}

static void free_clips(struct gltf *gltf)
{
    struct gltf_owned *owned = gltf->owned;
    for (size_t i = 0; owned && i < owned->count; i++) free(owned->accessors[i].values);
    free(owned);
    for (int i = 0; i < gltf->clip_count; i++) {
        free(gltf->clips[i].name);
        free(gltf->clips[i].channels);
    }
    free(gltf->clips);
}

void gltf_free(struct gltf *gltf)
{
    for (int i = 0; i < gltf->node_count; i++) free(gltf->nodes[i].name);
    for (int i = 0; i < gltf->mesh_count; i++) free_mesh(&gltf->meshes[i]);
    for (int i = 0; i < gltf->image_count; i++) {
        free(gltf->images[i].name);
        free(gltf->images[i].bytes);
        free(gltf->images[i].pixels);
    }
    for (int i = 0; i < gltf->skin_count; i++) {
        free(gltf->skins[i].joints);
        free(gltf->skins[i].inverse_bind);
    }
    free_clips(gltf);
    free(gltf->nodes);
    free(gltf->order);
    free(gltf->called);
    free(gltf->skins);
    free(gltf->meshes);
    for (int i = 0; i < gltf->material_count; i++) free(gltf->materials[i].name);
    free(gltf->materials);
    free(gltf->images);
    free(gltf->weights);
    free(gltf->not_shown);
    free(gltf->path);
    *gltf = (struct gltf){0};
}
