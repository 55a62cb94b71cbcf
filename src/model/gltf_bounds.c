/// Boxes around what each joint carries.
#include "model/gltf.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>

/// Adds a vertex, with the room that its morph targets may take it through.
static void add_vertex(struct gltf_box *box, const struct gltf_mesh *mesh, const struct gltf_part *part, int v)
{
    for (int k = 0; k < 3; k++) {
        float reach = 0.0f;
        for (int t = 0; t < mesh->target_count; t++) {
            if (part->targets[t].position) reach += fabsf(part->targets[t].position[v][k]);
        }
        box->lo[k] = fminf(box->lo[k], part->position[v][k] - reach);
        box->hi[k] = fmaxf(box->hi[k], part->position[v][k] + reach);
    }
}

static void add_part(struct gltf_box *boxes, const struct gltf_mesh *mesh, const struct gltf_part *part, bool skinned)
{
    for (int v = 0; v < part->vertex_count; v++) {
        for (int i = 0; i < (skinned && part->joints ? GLTF_INFLUENCES : 1); i++) {
            int joint = skinned && part->joints ? part->joints[v][i] : 0;
            if (!part->joints || !skinned || part->weights[v][i] > 0.0f) add_vertex(&boxes[joint], mesh, part, v);
        }
    }
}

static int box_count(const struct gltf *gltf, const struct gltf_node *node)
{
    if (node->mesh < 0) return 0;
    return node->skin < 0 ? 1 : gltf->skins[node->skin].joint_count;
}

bool gltf_bounds_create(const struct gltf *gltf, struct gltf_bounds *bounds)
{
    size_t total = 1;
    for (int n = 0; n < gltf->node_count; n++) total += (size_t)box_count(gltf, &gltf->nodes[n]);
    *bounds = (struct gltf_bounds){.boxes = malloc(total * sizeof *bounds->boxes)};
    if (!bounds->boxes) return false;
    for (int n = 0; n < gltf->node_count; n++) {
        const struct gltf_node *node = &gltf->nodes[n];
        const int count = box_count(gltf, node);
        struct gltf_box *first = bounds->boxes + bounds->count;
        for (int f = 0; f < count; f++) {
            first[f] = (struct gltf_box){
                n, node->skin < 0 ? -1 : f, {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        }
        for (int p = 0; count > 0 && p < gltf->meshes[node->mesh].part_count; p++)
            add_part(first, &gltf->meshes[node->mesh], &gltf->meshes[node->mesh].parts[p], node->skin >= 0);
        for (int f = 0; f < count; f++) { // most joints of a large skin move a small part of one mesh, or nothing
            if (first[f].lo[0] <= first[f].hi[0]) bounds->boxes[bounds->count++] = first[f];
        }
    }
    return true;
}

void gltf_bounds_free(struct gltf_bounds *bounds)
{
    free(bounds->boxes);
    *bounds = (struct gltf_bounds){0};
}

void gltf_bounds_at(const struct gltf_bounds *bounds, const struct gltf *gltf, const struct gltf_pose *pose,
                    float lo[3], float hi[3])
{
    for (int k = 0; k < 3; k++) {
        lo[k] = INFINITY;
        hi[k] = -INFINITY;
    }
    for (int f = 0; f < bounds->count; f++) {
        const struct gltf_box *box = &bounds->boxes[f];
        const struct gltf_node *node = &gltf->nodes[box->node];
        const float *m =
            box->joint < 0 ? pose->world[box->node] : pose->joints[gltf->skins[node->skin].first_joint + box->joint];
        for (int k = 0; k < 3; k++) {
            float middle = m[12 + k], reach = 0.0f;
            for (int a = 0; a < 3; a++) {
                middle += m[4 * a + k] * 0.5f * (box->lo[a] + box->hi[a]);
                reach += fabsf(m[4 * a + k]) * 0.5f * (box->hi[a] - box->lo[a]);
            }
            lo[k] = fminf(lo[k], middle - reach);
            hi[k] = fmaxf(hi[k], middle + reach);
        }
    }
    for (int k = 0; k < 3 && !(lo[0] <= hi[0]); k++) lo[k] = hi[k] = 0.0f;
}
