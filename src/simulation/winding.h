/// Generalised winding numbers: how often a surface, even an open one, goes round a point.
///
/// Each triangle counts with the solid angle it is seen under, divided by 4π (Jacobson et al. 2013). Inside a closed surface the sum is 1,
/// outside 0; near a hole it passes smoothly from one to the other, and ½ closes the hole. Triangles that are far away for their size
/// count together, as a dipole (Barill et al. 2018).
#ifndef SIMULATION_WINDING_H
#define SIMULATION_WINDING_H

#include "model/surface.h"
#include <stdbool.h>

struct winding_node {
    double middle[3]; ///< of its triangles, weighted by area
    double area[3];   ///< sum of their normals, as long as their areas
    double radius;    ///< reaches all their corners from the middle
    int first, count; ///< of its triangles in `order`
    int second;       ///< its second child; the first is the next node. 0: a leaf
};

struct winding {
    const struct surface *surface;
    int *order; ///< triangles
    struct winding_node *nodes;
    int node_count;
};

/// The surface must outlive it.
void winding_create(struct winding *winding, const struct surface *surface);
void winding_free(struct winding *winding);

double winding_at(const struct winding *winding, const double point[3]);

#endif
