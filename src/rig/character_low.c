/// The lowest vertices of a soft character, for its floor: several samples at a time, so that most vertices can be excluded for all of them
/// at once.
#include "maths/maths.h"
#include "rig/posing_kind.h"
#include "spline/wide.h"
#include <math.h>

/// Samples, and blocks of samples, that are processed together.
enum { BLOCK = 16, ROW = LOW_POINT_ROW / BLOCK };

/// A driven coordinate: its weights at every sample, and their range in each block and in all.
struct driven {
    const struct coordinate *coordinate;
    double *re, *im;
    double *re_range[2], *im_range[2];
    double re_all[2], im_all[2];
};

/// The lowest vertices so far: per sample the height and index, per block the largest of these heights.
struct lowest {
    double *height, *vertex, *highest;
    int blocks; ///< whole rows of blocks
};

static double *take(double **room, int count)
{
    double *taken = *room;
    *room += count;
    return taken;
}

/// z of a drive at every sample, as in pose_character(); after the last sample it stays.
static void find_weights(const struct drive *drive, const wiggly_curve *curve, int samples, struct driven *driven,
                         int room)
{
    const double lag = radians(drive->lag), c = maths_cos(lag), s = maths_sin(lag);
    for (int i = 0; i < room; i++) {
        const int at = i < samples ? i : samples - 1;
        driven->re[i] = drive->amplitude * (curve->y[at] + curve->re[at] * c + curve->im[at] * s);
        driven->im[i] = drive->amplitude * (curve->im[at] * c - curve->re[at] * s);
    }
}

static void find_ranges(const double *x, int blocks, double *const range[2], double all[2])
{
    all[0] = INFINITY, all[1] = -INFINITY;
    for (int b = 0; b < blocks; b++) {
        double low = INFINITY, high = -INFINITY;
        for (int i = BLOCK * b; i < BLOCK * (b + 1); i++) {
            low = x[i] < low ? x[i] : low;
            high = x[i] > high ? x[i] : high;
        }
        range[0][b] = low;
        range[1][b] = high;
        all[0] = fmin(all[0], low);
        all[1] = fmax(all[1], high);
    }
}

static void drive(const struct coordinate *coordinate, const struct drive *drive, const wiggly_curve *curve,
                  int samples, int blocks, double **room, struct driven *driven)
{
    *driven = (struct driven){.coordinate = coordinate,
                              .re = take(room, BLOCK * blocks),
                              .im = take(room, BLOCK * blocks),
                              .re_range = {take(room, blocks), take(room, blocks)},
                              .im_range = {take(room, blocks), take(room, blocks)}};
    find_weights(drive, curve, samples, driven, BLOCK * blocks);
    find_ranges(driven->re, blocks, driven->re_range, driven->re_all);
    find_ranges(driven->im, blocks, driven->im_range, driven->im_all);
}

/// A vertex's height by coordinate: a Re z − b Im z.
struct moves {
    double at_rest, a[CHARACTER_MAX_DRIVES], b[CHARACTER_MAX_DRIVES];
};

/// A lower bound of a vertex's height.
static double least_height(const struct driven *driven, int count, const struct moves *moves)
{
    double least = moves->at_rest;
    for (int k = 0; k < count; k++) {
        least += moves->a[k] * driven[k].re_all[moves->a[k] < 0];
        least -= moves->b[k] * driven[k].im_all[moves->b[k] > 0];
    }
    return least;
}

/// Marks the blocks of a row in which a vertex may be lower than those found; returns whether there are any.
WIDEST static bool may_be_low(const struct driven *driven, int count, const struct moves *moves, int from,
                              const double *restrict highest, bool *restrict may)
{
    double least[ROW];
    int any = 0;
    for (int i = 0; i < ROW; i++) least[i] = moves->at_rest;
    for (int k = 0; k < count; k++) {
        const double a = moves->a[k], b = moves->b[k];
        const double *restrict re = driven[k].re_range[a < 0] + from, *restrict im = driven[k].im_range[b > 0] + from;
        for (int i = 0; i < ROW; i++) least[i] += a * re[i] - b * im[i];
    }
    for (int i = 0; i < ROW; i++) any += may[i] = least[i] < highest[i];
    return any > 0;
}

/// Checks whether a vertex is the lowest at each sample of a block.
WIDEST static bool look_at(const struct driven *driven, int count, const struct moves *moves, int vertex, int from,
                           double *restrict low, double *restrict lowest)
{
    double height[BLOCK];
    int lower = 0;
    for (int i = 0; i < BLOCK; i++) height[i] = moves->at_rest;
    for (int k = 0; k < count; k++) {
        const double a = moves->a[k], b = moves->b[k];
        const double *restrict re = driven[k].re + from, *restrict im = driven[k].im + from;
        for (int i = 0; i < BLOCK; i++) height[i] += a * re[i] - b * im[i];
    }
    for (int i = 0; i < BLOCK; i++) lower += height[i] < low[i];
    if (lower == 0) return false;
    for (int i = 0; i < BLOCK; i++) {
        const bool is_lower = height[i] < low[i];
        low[i] = is_lower ? height[i] : low[i];
        lowest[i] = is_lower ? vertex : lowest[i];
    }
    return true;
}

static double largest(const double *x, int count)
{
    double most = x[0];
    for (int i = 1; i < count; i++) most = x[i] > most ? x[i] : most;
    return most;
}

static void look_everywhere(const struct driven *driven, int count, const struct moves *moves, int vertex,
                            struct lowest *found)
{
    bool may[ROW];
    for (int row = 0; row < found->blocks; row += ROW) {
        if (!may_be_low(driven, count, moves, row, found->highest + row, may)) continue;
        for (int b = row; b < row + ROW; b++) {
            double *height = found->height + BLOCK * b;
            if (may[b - row] && look_at(driven, count, moves, vertex, BLOCK * b, height, found->vertex + BLOCK * b))
                found->highest[b] = largest(height, BLOCK);
        }
    }
}

bool character_lowest(const struct posing *posing, int rig, double ceiling, double *room, struct low_point *low)
{
    const struct character_rig *character = &posing->document->rigs[rig]->character;
    const struct figure *figure = models_figure(posing->models, document_rig_number(posing->document, rig));
    const int samples = posing->evaluation->samples;
    const int blocks = low_point_samples(samples) / BLOCK;
    struct driven driven[CHARACTER_MAX_DRIVES];
    struct moves moves;
    int count = 0;
    if (!figure) return false;
    struct lowest found = {take(&room, BLOCK * blocks), take(&room, BLOCK * blocks), take(&room, blocks), blocks};
    for (int d = 0; d < character->drive_count; d++) {
        const int coordinate = figure_find(figure, character->drives[d].name);
        if (coordinate < 0) continue;
        drive(&figure->character.coordinates[coordinate], &character->drives[d],
              &posing->evaluation->curves[character->drives[d].spline], samples, blocks, &room, &driven[count++]);
    }
    for (int i = 0; i < BLOCK * blocks; i++) found.height[i] = ceiling, found.vertex[i] = -1;
    for (int b = 0; b < blocks; b++) found.highest[b] = ceiling;
    for (int v = 0; v < figure->character.vertex_count; v++) {
        moves.at_rest = character->position[1] + (double)figure->character.position[v][1] - (double)figure->lo[1];
        for (int k = 0; k < count; k++) {
            moves.a[k] = (double)driven[k].coordinate->re[v][1];
            moves.b[k] = (double)driven[k].coordinate->im[v][1];
        }
        if (least_height(driven, count, &moves) < ceiling) look_everywhere(driven, count, &moves, v, &found);
    }
    for (int i = 0; i < samples; i++) low[i] = (struct low_point){found.height[i], (int)found.vertex[i]};
    return true;
}
