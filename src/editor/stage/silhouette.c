/// Outlines by marching squares: an edge lies between an inside and an outside node, where the field crosses 0.
#include "editor/stage/silhouette.h"
#include "editor/stage/parts.h"
#include <math.h>
#include <string.h>

enum { LEAST_POINTS = 12 }; ///< smaller outlines are specks

static const float FINEST = 2;   ///< pixels between nodes
static const float AROUND = 8;   ///< pixels beside the stage, so that cut outlines end out of sight
static const float OUTSIDE = -2; ///< cells; smaller values make no difference

void silhouette_clear(struct silhouette *silhouette)
{
    silhouette->low[0] = silhouette->low[1] = INFINITY;
    silhouette->high[0] = silhouette->high[1] = -INFINITY;
}

void silhouette_widen(struct silhouette *silhouette, const float middle[2], float radius)
{
    for (int k = 0; k < 2; k++) {
        silhouette->low[k] = fminf(silhouette->low[k], middle[k] - radius);
        silhouette->high[k] = fmaxf(silhouette->high[k], middle[k] + radius);
    }
}

bool silhouette_open(struct silhouette *silhouette, struct rect stage)
{
    const float *low = silhouette->low, *high = silhouette->high;
    const struct rect box = {low[0], low[1], high[0] - low[0], high[1] - low[1]};
    const struct rect area = rect_intersect(rect_inset(stage, -AROUND), rect_inset(box, -AROUND));
    const float across = fmaxf(area.w, area.h) / (SILHOUETTE_SIDE - 3);
    if (area.w <= 0 || area.h <= 0) return false;
    silhouette->cell = fmaxf(FINEST, across);
    silhouette->area = rect_inset(area, -silhouette->cell);
    silhouette->columns = (int)(silhouette->area.w / silhouette->cell) + 1;
    silhouette->rows = (int)(silhouette->area.h / silhouette->cell) + 1;
    for (int row = 0; row < silhouette->rows; row++) {
        for (int column = 0; column < silhouette->columns; column++)
            silhouette->inside[row][column] = OUTSIDE * silhouette->cell;
        memset(silhouette->followed[row], 0, sizeof silhouette->followed[row]);
    }
    return true;
}

/// The nodes in a box, as first and last column and row. The outermost nodes stay outside, so that every outline closes.
static void find_nodes(const struct silhouette *silhouette, const float low[2], const float high[2], int nodes[2][2])
{
    const float from[2] = {silhouette->area.x, silhouette->area.y};
    const int count[2] = {silhouette->columns, silhouette->rows};
    const double cell = (double)silhouette->cell;
    for (int k = 0; k < 2; k++) {
        nodes[k][0] = (int)fmax(ceil((double)(low[k] - from[k]) / cell), 1);
        nodes[k][1] = (int)fmin(floor((double)(high[k] - from[k]) / cell), count[k] - 2);
    }
}

static void place_node(const struct silhouette *silhouette, int row, int column, float xy[2])
{
    xy[0] = silhouette->area.x + silhouette->cell * (float)column;
    xy[1] = silhouette->area.y + silhouette->cell * (float)row;
}

/// Inline, unlike hypotf(): called for every node of a grid that grows as the view comes closer.
static float length(float x, float y) { return sqrtf(x * x + y * y); }

static float larger(float a, float b) { return a > b ? a : b; }

/// How far inside the link a point is.
static float depth_in_link(const float p[2], const float a[2], float a_radius, const float b[2], float b_radius)
{
    const float dx = b[0] - a[0], dy = b[1] - a[1], t = segment_nearest(a, b, p);
    const float between = a_radius + t * (b_radius - a_radius) - length(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
    const float at_a = a_radius - length(p[0] - a[0], p[1] - a[1]),
                at_b = b_radius - length(p[0] - b[0], p[1] - b[1]);
    return larger(between, larger(at_a, at_b));
}

void silhouette_add_link(struct silhouette *silhouette, const float from[2], float from_radius, const float to[2],
                         float to_radius)
{
    const float reach = fmaxf(from_radius, to_radius) - OUTSIDE * silhouette->cell;
    const float low[2] = {fminf(from[0], to[0]) - reach, fminf(from[1], to[1]) - reach};
    const float high[2] = {fmaxf(from[0], to[0]) + reach, fmaxf(from[1], to[1]) + reach};
    int nodes[2][2];
    find_nodes(silhouette, low, high, nodes);
    for (int row = nodes[1][0]; row <= nodes[1][1]; row++) {
        for (int column = nodes[0][0]; column <= nodes[0][1]; column++) {
            float p[2];
            place_node(silhouette, row, column, p);
            float *inside = &silhouette->inside[row][column];
            *inside = larger(*inside, depth_in_link(p, from, from_radius, to, to_radius));
        }
    }
}

/// Twice a triangle's area, positive if its corners are clockwise on the screen.
static float turn(const float a[2], const float b[2], const float c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

void silhouette_add_triangle(struct silhouette *silhouette, const float corner[3][2], const float inside[3])
{
    float low[2], high[2];
    int nodes[2][2];
    for (int k = 0; k < 2; k++) {
        low[k] = fminf(corner[0][k], fminf(corner[1][k], corner[2][k]));
        high[k] = fmaxf(corner[0][k], fmaxf(corner[1][k], corner[2][k]));
    }
    find_nodes(silhouette, low, high, nodes);
    const float area = turn(corner[0], corner[1], corner[2]), most = -OUTSIDE * silhouette->cell;
    for (int row = nodes[1][0]; row <= nodes[1][1] && area != 0; row++) {
        for (int column = nodes[0][0]; column <= nodes[0][1]; column++) {
            float *node = &silhouette->inside[row][column], share[3], p[2];
            if (*node >= most) continue; // another triangle has set it, as on a body's far side
            place_node(silhouette, row, column, p);
            for (int k = 0; k < 3; k++) share[k] = turn(corner[(k + 1) % 3], corner[(k + 2) % 3], p) / area;
            if (!(share[0] >= 0 && share[1] >= 0 && share[2] >= 0)) continue;
            const float depth = share[0] * inside[0] + share[1] * inside[1] + share[2] * inside[2];
            *node = larger(*node, depth < most ? depth : most);
        }
    }
}

void silhouette_soften(struct silhouette *silhouette)
{
    for (int row = 1; row + 1 < silhouette->rows; row++) {
        for (int column = 1; column + 1 < silhouette->columns; column++) {
            float sum = 0;
            for (int k = -1; k <= 1; k++) {
                const float *there = &silhouette->inside[row + k][column];
                sum += there[-1] + there[0] + there[1];
            }
            silhouette->blurred[row][column] = sum / 9;
        }
    }
    for (int row = 1; row + 1 < silhouette->rows; row++)
        memcpy(&silhouette->inside[row][1], &silhouette->blurred[row][1],
               (size_t)(silhouette->columns - 2) * sizeof silhouette->inside[row][1]);
}

enum side { SIDE_TOP, SIDE_RIGHT, SIDE_BOTTOM, SIDE_LEFT };

/// Whether the outline crosses a side of the cell with this upper left node, and where; `xy` may be NULL.
static bool crosses(const struct silhouette *silhouette, int row, int column, enum side side, float xy[2])
{
    const int rows[2] = {row + (side == SIDE_BOTTOM), row + (side != SIDE_TOP)};
    const int columns[2] = {column + (side == SIDE_RIGHT), column + (side != SIDE_LEFT)};
    const float a = silhouette->inside[rows[0]][columns[0]], b = silhouette->inside[rows[1]][columns[1]];
    if (!xy || (a >= 0) == (b >= 0)) return (a >= 0) != (b >= 0);
    const float along = a / (a - b) * silhouette->cell;
    place_node(silhouette, rows[0], columns[0], xy);
    xy[0] += along * (float)(columns[1] - columns[0]);
    xy[1] += along * (float)(rows[1] - rows[0]);
    return true;
}

/// The side where the outline leaves. If all four are crossed, it turns left around the corner.
static enum side leave(const struct silhouette *silhouette, int row, int column, enum side in)
{
    static const enum side order[] = {1, 3, 2};
    for (int i = 0; i < 3; i++) {
        const enum side out = (in + order[i]) % 4;
        if (crosses(silhouette, row, column, out, NULL)) return out;
    }
    return in;
}

/// Follows the outline that crosses a cell's upper side downwards, until it closes.
static int follow_from(struct silhouette *silhouette, int row, int column)
{
    static const int down[4] = {-1, 0, 1, 0}, right[4] = {0, 1, 0, -1};
    const int first_row = row, first_column = column;
    enum side in = SIDE_TOP;
    int count = 0;
    do {
        if (in == SIDE_TOP) silhouette->followed[row][column] = true;
        if (in == SIDE_BOTTOM) silhouette->followed[row + 1][column] = true;
        if (count < SILHOUETTE_POINTS - 1) crosses(silhouette, row, column, in, silhouette->points[count++]);
        const enum side out = leave(silhouette, row, column, in);
        if (out == in) break;
        row += down[out];
        column += right[out];
        in = (out + 2) % 4;
    } while (row != first_row || column != first_column || in != SIDE_TOP);
    memcpy(silhouette->points[count], silhouette->points[0], sizeof silhouette->points[0]);
    return count + 1;
}

int silhouette_follow(struct silhouette *silhouette)
{
    for (int row = 1; row + 1 < silhouette->rows; row++) {
        for (int column = 0; column + 1 < silhouette->columns; column++) {
            if (silhouette->followed[row][column] || !crosses(silhouette, row, column, SIDE_TOP, NULL)) continue;
            const int count = follow_from(silhouette, row, column);
            if (count > LEAST_POINTS) return count;
        }
    }
    return 0;
}
