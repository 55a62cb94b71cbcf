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
    return mesh->target_names ? mesh->target_names[target] : NULL;
}

int gltf_vertex_count(const struct gltf *gltf, int node)
{
    const struct gltf_mesh *mesh = gltf->nodes[node].mesh >= 0 ? &gltf->meshes[gltf->nodes[node].mesh] : NULL;
    int count = 0;
    for (int i = 0; mesh && i < mesh->part_count; i++) count += mesh->parts[i].vertex_count;
    return count;
}

void gltf_free(struct gltf *gltf)
{
    for (int i = 0; i < gltf->mesh_count; i++) json_decref(gltf->meshes[i].extras);
    for (int i = 0; i < gltf->image_count; i++) {
        free(gltf->images[i].bytes);
        free(gltf->images[i].pixels);
    }
    free(gltf->not_shown);
    pool_free(&gltf->pool);
    *gltf = (struct gltf){0};
}
