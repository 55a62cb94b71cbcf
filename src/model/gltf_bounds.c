/// Boxes of what follows each joint.
#include "model/gltf_bounds.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>

/// Adds a vertex, with the room that its morph targets may take it through.
static void add_vertex(struct gltf_follower *follower, const struct gltf_mesh *mesh, const struct gltf_part *part,
                       int v)
{
    for (int k = 0; k < 3; k++) {
        float reach = 0.0f;
        for (int t = 0; t < mesh->target_count; t++) {
            if (part->targets[t].position) reach += fabsf(part->targets[t].position[v][k]);
        }
        follower->lo[k] = fminf(follower->lo[k], part->position[v][k] - reach);
        follower->hi[k] = fmaxf(follower->hi[k], part->position[v][k] + reach);
    }
}

static void add_part(struct gltf_follower *followers, const struct gltf_mesh *mesh, const struct gltf_part *part,
                     bool skinned)
{
    for (int v = 0; v < part->vertex_count; v++) {
        for (int i = 0; i < (skinned && part->joints ? GLTF_INFLUENCES : 1); i++) {
            int joint = skinned && part->joints ? part->joints[v][i] : 0;
            if (!part->joints || !skinned || part->weights[v][i] > 0.0f) add_vertex(&followers[joint], mesh, part, v);
        }
    }
}

static int follower_count(const struct gltf *gltf, const struct gltf_node *node)
{
    if (node->mesh < 0) return 0;
    return node->skin < 0 ? 1 : gltf->skins[node->skin].joint_count;
}

bool gltf_bounds_create(const struct gltf *gltf, struct gltf_bounds *bounds)
{
    size_t total = 1;
    for (int n = 0; n < gltf->node_count; n++) total += (size_t)follower_count(gltf, &gltf->nodes[n]);
    *bounds = (struct gltf_bounds){.followers = malloc(total * sizeof *bounds->followers)};
    if (!bounds->followers) return false;
    for (int n = 0; n < gltf->node_count; n++) {
        const struct gltf_node *node = &gltf->nodes[n];
        const int count = follower_count(gltf, node);
        struct gltf_follower *first = bounds->followers + bounds->count;
        for (int f = 0; f < count; f++) {
            first[f] = (struct gltf_follower){
                n, node->skin < 0 ? -1 : f, {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        }
        for (int p = 0; count > 0 && p < gltf->meshes[node->mesh].part_count; p++)
            add_part(first, &gltf->meshes[node->mesh], &gltf->meshes[node->mesh].parts[p], node->skin >= 0);
        for (int f = 0; f < count; f++) { // most joints of a large skin move a small part of one mesh, or nothing
            if (first[f].lo[0] <= first[f].hi[0]) bounds->followers[bounds->count++] = first[f];
        }
    }
    return true;
}

void gltf_bounds_free(struct gltf_bounds *bounds)
{
    free(bounds->followers);
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
        const struct gltf_follower *follower = &bounds->followers[f];
        const struct gltf_node *node = &gltf->nodes[follower->node];
        const float *m = follower->joint < 0 ? pose->world[follower->node]
                                             : pose->joints[gltf->skins[node->skin].first_joint + follower->joint];
        for (int k = 0; k < 3; k++) {
            float middle = m[12 + k], reach = 0.0f;
            for (int a = 0; a < 3; a++) {
                middle += m[4 * a + k] * 0.5f * (follower->lo[a] + follower->hi[a]);
                reach += fabsf(m[4 * a + k]) * 0.5f * (follower->hi[a] - follower->lo[a]);
            }
            lo[k] = fminf(lo[k], middle - reach);
            hi[k] = fmaxf(hi[k], middle + reach);
        }
    }
    for (int k = 0; k < 3 && !(lo[0] <= hi[0]); k++) lo[k] = hi[k] = 0.0f;
}
