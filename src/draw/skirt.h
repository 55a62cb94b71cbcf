/// Where a mesh's outlines are as the eye sees them, and the skirt that hangs there: a strip a pixel wide that sticks out of the surface and fades.
/// That softens outlines, those of a leg before another too, without multisampling. Private to the stage's files of draw/.
#ifndef DRAW_SKIRT_H
#define DRAW_SKIRT_H

#include <stdbool.h>
#include <stdint.h>

/// A mesh as it stands.
struct skirt_mesh {
    const uint32_t *indices;
    const int *neighbours; ///< model/triangle_neighbours.h
    const float (*place)[3];
    bool *front;   ///< of each triangle, whether it faces the eye: skirt_face() says
    bool mirrored; ///< triangles are clockwise seen from outside
};

/// Says which triangles face the eye, of the indices first … end − 1.
void skirt_face(const struct skirt_mesh *mesh, int first, int end, const float eye[3]);

/// Of the edges from the corners first … end − 1 the first where what is seen ends: where it turns away from the eye, and where the mesh
/// ends. `end` where there is none.
int skirt_next(const struct skirt_mesh *mesh, int first, int end, bool both_sides);

/// How far the skirt sticks out at both ends of the edge from a corner: a pixel, across the line of sight. `normal` are the skin's there.
/// `pixel` is metres a pixel at a distance of 1 m.
void skirt_out(const struct skirt_mesh *mesh, int corner, const float normal[2][3], const float eye[3], float pixel,
               float out[2][3]);

#endif
