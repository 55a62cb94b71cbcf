/// An imported character made ready for posing: its file, its rest pose, the boxes that its poses are bounded
/// by, and its bones.
#ifndef RIG_IMPORTED_H
#define RIG_IMPORTED_H

#include "rig/skeleton.h"

struct imported {
    struct gltf gltf;
    struct gltf_pose rest;
    struct gltf_bounds bounds;
    struct skeleton skeleton;
};

/// Reads a .glb or .gltf. On error nothing is left to free.
bool imported_read(struct imported *imported, const char *path, struct error *error);
void imported_free(struct imported *imported);

#endif
