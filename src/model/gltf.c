/// Finds things in a glTF character, and frees it.
#include "model/gltf.h"
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

void gltf_link_nodes(struct gltf *gltf)
{
    for (int n = 0; n < gltf->node_count; n++) gltf->nodes[n].child = gltf->nodes[n].next = -1;
    for (int n = gltf->node_count - 1; n >= 0; n--) {
        struct gltf_node *node = &gltf->nodes[n];
        if (node->parent < 0) continue;
        node->next = gltf->nodes[node->parent].child;
        gltf->nodes[node->parent].child = n;
    }
}

int gltf_find_node(const struct gltf *gltf, const char *name)
{
    for (int n = 0; n < gltf->node_count; n++) {
        if (strcmp(gltf->nodes[n].name, name) == 0) return n;
    }
    return -1;
}

int gltf_find_clip(const struct gltf *gltf, const char *name)
{
    for (int i = 0; name && i < gltf->clip_count; i++) {
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
    for (int i = 0; i < gltf->clip_count; i++) {
        for (int c = 0; c < gltf->clips[i].channel_count; c++) {
            free(gltf->clips[i].channels[c].times);
            free(gltf->clips[i].channels[c].values);
        }
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
