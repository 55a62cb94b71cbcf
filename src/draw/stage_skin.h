/// The animal's skin as it is drawn: moved once a frame, on the CPU, and of its triangles those alone that face the eye, as a software
/// rasteriser pays for every vertex and triangle that it is handed. Where the skin turns away from the eye, a skirt a pixel wide sticks out of it and
/// fades: that softens outlines, and those of a leg before another too, without multisampling.
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
    int *
        neighbours; ///< per index, of the edge from it to the triangle's next: the triangle on its other side, −1 where the mesh ends
};

void stage_skin_create(struct skin_mesh *skin, int level);
void stage_skin_destroy(struct skin_mesh *skin);

/// One animal as it stands: arrays of as many as its mesh has vertices or triangles.
struct skin {
    float (*place)[3], (*normal)[3]; ///< world
    bool *front;                     ///< whether a triangle faces the eye
};

void stage_skin_pose(const struct skin_mesh *mesh, const struct pose *pose, const float eye[3],
                     const struct skin *skin);

/// Writes the indices of a region's triangles that face the eye, and returns how many.
int stage_skin_seen(const struct skin_mesh *mesh, const struct skin *skin, enum region region, uint32_t *indices);

/// A vertex of the skirt: one of the skin's, with all that stage_mesh.vert knows of it.
struct skirt_corner {
    float position[3], mark[3], bend, open;
    float place[3], normal[3]; ///< world
    float opacity;             ///< 1 on the skin, 0 a pixel off it
};

enum { SKIRT_CORNERS = 6 }; ///< along one edge of the mesh: two triangles

/// Writes the skirt along a region's edges where the skin turns away from the eye, at most `room` of them, and returns how many edges.
/// `pixel` is metres a pixel at a distance of 1 m.
int stage_skin_skirt(const struct skin_mesh *mesh, const struct skin *skin, enum region region, const float eye[3],
                     float pixel, struct skirt_corner *corners, int room);

#endif
