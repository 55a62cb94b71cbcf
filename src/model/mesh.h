/// Triangle meshes that are generated at start-up.
#ifndef MODEL_MESH_H
#define MODEL_MESH_H

#include <stdbool.h>
#include <stdint.h>

/// Bind space: metres, y up, the tail straight along +z with its base at the origin.
struct vertex {
    float position[3];
    float normal[3];
    float color[3]; ///< linear RGB
    float bend;     ///< how far it follows the joints: 1 on the tail, 0 on the torso, between where they join
    float open;     ///< share of the light from all around that reaches it, 0 … 1
    float limb[3];  ///< which two parts of the body it hangs on, and its share of the second: see limbs.h
    float mark[3];  ///< a coat's markings, see coat.h; `color` is what they come to
};

struct mesh {
    struct vertex *vertices;
    int vertex_count, vertex_capacity;
    uint32_t *indices; ///< triangles, counter-clockwise seen from outside
    int index_count, index_capacity;
};

/// Adds a vertex and returns its index.
uint32_t mesh_vertex(struct mesh *mesh, const struct vertex *vertex);
void mesh_triangle(struct mesh *mesh, uint32_t a, uint32_t b, uint32_t c);

/// Leaves an empty mesh: all zero, as every mesh starts.
void mesh_free(struct mesh *mesh);

#endif
