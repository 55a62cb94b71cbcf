/// Stands in for the reader of glTF characters until it is here: every file is refused.
#include "model/gltf.h"
#include <string.h>

bool gltf_read(const char *path, struct gltf *gltf, struct error *error)
{
    *gltf = (struct gltf){0};
    return fail(error, ERROR_INPUT, "%s: expected a file that can be read, got glTF", path);
}

void gltf_free(struct gltf *gltf) { *gltf = (struct gltf){0}; }

int gltf_find_node(const struct gltf *gltf, const char *name)
{
    for (int i = 0; i < gltf->node_count; i++) {
        if (strcmp(gltf->nodes[i].name, name) == 0) return i;
    }
    return -1;
}

int gltf_find_clip(const struct gltf *gltf, const char *name)
{
    for (int i = 0; i < gltf->clip_count; i++) {
        if (strcmp(gltf->clips[i].name, name) == 0) return i;
    }
    return -1;
}

bool gltf_pose_create(const struct gltf *gltf, struct gltf_pose *pose)
{
    (void)gltf;
    *pose = (struct gltf_pose){0};
    return false;
}

void gltf_pose_free(struct gltf_pose *pose) { *pose = (struct gltf_pose){0}; }

void gltf_pose_clip(const struct gltf *gltf, int clip, double time, struct gltf_pose *pose)
{
    (void)gltf, (void)clip, (void)time, (void)pose;
}

void gltf_pose_world(const struct gltf *gltf, struct gltf_pose *pose) { (void)gltf, (void)pose; }

void gltf_joint_matrix(const struct gltf *gltf, const struct gltf_pose *pose, int skin, int joint, float matrix[16])
{
    (void)gltf, (void)pose, (void)skin, (void)joint;
    memset(matrix, 0, 16 * sizeof *matrix);
}

void gltf_pose_vertices(const struct gltf *gltf, const struct gltf_pose *pose, int node, float (*positions)[3],
                        float (*normals)[3])
{
    (void)gltf, (void)pose, (void)node, (void)positions, (void)normals;
}

int gltf_vertex_count(const struct gltf *gltf, int node)
{
    const struct gltf_mesh *mesh = gltf->nodes[node].mesh >= 0 ? &gltf->meshes[gltf->nodes[node].mesh] : NULL;
    int count = 0;
    for (int i = 0; mesh && i < mesh->part_count; i++) count += mesh->parts[i].vertex_count;
    return count;
}
