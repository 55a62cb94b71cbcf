/// The outline of a shape on the screen: the shape is drawn into a grid, and its edge followed.
#ifndef EDITOR_STAGE_SILHOUETTE_H
#define EDITOR_STAGE_SILHOUETTE_H

#include "ui/drawlist.h"

enum { SILHOUETTE_SIDE = 208, SILHOUETTE_POINTS = 4096 };

/// For each grid node the distance inside the shape, pixels; negative outside.
struct silhouette {
    float low[2], high[2]; ///< bounds of the shape
    struct rect area;
    float cell; ///< pixels between nodes
    int columns, rows;
    float inside[SILHOUETTE_SIDE][SILHOUETTE_SIDE]; ///< by row and column
    float blurred[SILHOUETTE_SIDE][SILHOUETTE_SIDE];
    bool followed[SILHOUETTE_SIDE][SILHOUETTE_SIDE]; ///< the edge between a node and the next in its row
    float points[2 * SILHOUETTE_POINTS][2];          ///< the last outline, and room for another
};

/// Empties the shape.
void silhouette_clear(struct silhouette *silhouette);
/// Extends the grid for a disc.
void silhouette_widen(struct silhouette *silhouette, const float middle[2], float radius);
/// Sets up the grid for all discs; false if none is on the stage.
bool silhouette_open(struct silhouette *silhouette, struct rect stage);
/// Adds two discs and the area between them.
void silhouette_add_link(struct silhouette *silhouette, const float from[2], float from_radius, const float to[2],
                         float to_radius);
/// Adds a triangle; `inside` is its corners' distance inside the shape, pixels.
void silhouette_add_triangle(struct silhouette *silhouette, const float corner[3][2], const float inside[3]);
/// Smooths the steps of triangles.
void silhouette_soften(struct silhouette *silhouette);
/// Follows the next outline larger than a speck into `points`; the last point repeats the first. Returns the number of points, 0 after the
/// last outline.
int silhouette_follow(struct silhouette *silhouette);

#endif
