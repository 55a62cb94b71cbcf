/// The outline of a shape on the screen: the shape is painted onto a grid, and its edge followed.
#ifndef EDITOR_STAGE_SILHOUETTE_H
#define EDITOR_STAGE_SILHOUETTE_H

#include "ui/drawlist.h"

enum { SILHOUETTE_SIDE = 208, SILHOUETTE_POINTS = 4096 };

/// How far inside each node of the grid is, pixels; negative outside.
struct silhouette {
    float low[2], high[2]; ///< of the shape
    struct rect area;
    float cell; ///< pixels from node to node
    int columns, rows;
    float inside[SILHOUETTE_SIDE][SILHOUETTE_SIDE]; ///< by row and column
    float blurred[SILHOUETTE_SIDE][SILHOUETTE_SIDE];
    bool followed[SILHOUETTE_SIDE][SILHOUETTE_SIDE]; ///< the edge between a node and the next of its row
    float points[2 * SILHOUETTE_POINTS][2]; ///< of the outline that was followed last, and as much room again
};

/// Nothing yet.
void silhouette_clear(struct silhouette *silhouette);
/// Makes room for a disc to be painted.
void silhouette_widen(struct silhouette *silhouette, const float middle[2], float radius);
/// Opens the grid for all discs; false where none is on the stage.
bool silhouette_open(struct silhouette *silhouette, struct rect stage);
/// Two discs and the area between them.
void silhouette_add_link(struct silhouette *silhouette, const float from[2], float from_radius, const float to[2],
                         float to_radius);
/// A triangle whose corners are that far inside, pixels.
void silhouette_add_triangle(struct silhouette *silhouette, const float corner[3][2], const float inside[3]);
/// Rounds the steps of triangles off.
void silhouette_soften(struct silhouette *silhouette);
/// Follows the next outline that can be told from a speck into `points`, closed: the last point is the first. How many, 0 after the
/// last outline.
int silhouette_follow(struct silhouette *silhouette);

#endif
