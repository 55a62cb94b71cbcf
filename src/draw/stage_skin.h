/// The animal's skin as it is drawn: moved once a frame, on the CPU, for both passes (stage_draw()), and of its triangles those alone that may
/// change a pixel. A software rasteriser pays for every vertex and triangle that it is handed.
#ifndef DRAW_STAGE_SKIN_H
#define DRAW_STAGE_SKIN_H

#include "model/mesh.h"
#include "model/pose.h"
#include <stdbool.h>

/// What is drawn by a program of its own, so that each pixel pays only for what it is part of: what the face is on, and the rest.
enum region { REGION_COAT, REGION_FACE, REGIONS };

/// A mesh that every animal is drawn with, its triangles by region.
struct skin_mesh {
    struct mesh mesh;
    int first[REGIONS + 1]; ///< indices
};

/// False if memory runs out.
bool stage_skin_create(struct skin_mesh *skin, int level);

/// One animal as it stands: arrays of as many as its mesh has vertices.
struct skin {
    float (*place)[3], (*normal)[3]; ///< world
    float *facing;                   ///< cosine between the normal and the direction to the eye
};

void stage_skin_pose(const struct skin_mesh *mesh, const struct pose *pose, const float eye[3],
                     const struct skin *skin);

/// Writes the indices of a region's triangles that may change a pixel, and returns how many. With `seam` 0 those are what faces the eye, in
/// the pass that softens silhouettes (`seam` as in stage_mesh.vert) what is near one.
int stage_skin_seen(const struct skin_mesh *mesh, const struct skin *skin, enum region region, const float eye[3],
                    float seam, uint32_t *indices);

#endif
