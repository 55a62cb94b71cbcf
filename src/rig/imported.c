/// Reads imported characters.
#include "rig/imported.h"

bool imported_read(struct imported *imported, const char *path, struct error *error)
{
    *imported = (struct imported){0};
    if (!gltf_read(path, &imported->gltf, error)) return false;
    if (!gltf_pose_create(&imported->gltf, &imported->rest) ||
        !gltf_bounds_create(&imported->gltf, &imported->bounds)) {
        imported_free(imported);
        return fail_no_memory(error, path);
    }
    gltf_pose_clip(&imported->gltf, -1, 0.0, &imported->rest);
    gltf_pose_world(&imported->gltf, &imported->rest);
    skeleton_create(&imported->gltf, &imported->rest, &imported->skeleton);
    return true;
}

void imported_free(struct imported *imported)
{
    skeleton_free(&imported->skeleton);
    gltf_bounds_free(&imported->bounds);
    gltf_pose_free(&imported->rest);
    gltf_free(&imported->gltf);
    *imported = (struct imported){0};
}
