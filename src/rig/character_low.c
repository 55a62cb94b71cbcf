/// The lowest vertices of a soft character, for its floor: a few samples at a time, so that most vertices are seen to stay above all of
/// them at once.
#include "rig/pinning_kind.h"
#include "rig/posing_kind.h"
#include <math.h>

enum { BLOCK = 16 }; ///< samples

/// Between what the weights of a coordinate's real and imaginary part are.
struct range {
    double re[2], im[2];
};

/// A coordinate that is driven: its weights at every sample, their range in each block, and over all.
struct driven {
    const struct coordinate *coordinate;
    const double *re, *im;
    struct range *block, all;
};

/// z of a drive at every sample, as pose_character() has it.
static struct driven find_weights(const struct coordinate *coordinate, const struct drive *drive,
                                  const wiggly_curve *curve, int samples, double *room)
{
    const double lag = drive->lag * 3.14159265358979323846 / 180.0, c = cos(lag), s = sin(lag);
    double *re = room, *im = room + samples;
    for (int i = 0; i < samples; i++) {
        re[i] = drive->amplitude * (curve->y[i] + curve->re[i] * c + curve->im[i] * s);
        im[i] = drive->amplitude * (curve->im[i] * c - curve->re[i] * s);
    }
    return (struct driven){
        .coordinate = coordinate, .re = re, .im = im, .block = (struct range *)(room + 2 * samples)};
}

static void widen(double range[2], const double *x, int count)
{
    for (int i = 0; i < count; i++) {
        range[0] = x[i] < range[0] ? x[i] : range[0];
        range[1] = x[i] > range[1] ? x[i] : range[1];
    }
}

static int block_size(int from, int samples) { return samples - from < BLOCK ? samples - from : BLOCK; }

static void find_ranges(struct driven *driven, int samples)
{
    const struct range none = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
    driven->all = none;
    for (int from = 0; from < samples; from += BLOCK) {
        struct range *range = &driven->block[from / BLOCK];
        *range = none;
        widen(range->re, driven->re + from, block_size(from, samples));
        widen(range->im, driven->im + from, block_size(from, samples));
        widen(driven->all.re, range->re, 2);
        widen(driven->all.im, range->im, 2);
    }
}

/// The least of a x over a range of x.
static double least_of(double a, const double range[2]) { return a * range[a < 0]; }

/// How high a vertex is at least in a block, or (-1) in all.
static double least_height(const struct driven *driven, int count, int vertex, double at_rest, int block)
{
    for (int k = 0; k < count; k++) {
        const struct range *range = block < 0 ? &driven[k].all : &driven[k].block[block];
        at_rest += least_of((double)driven[k].coordinate->re[vertex][1], range->re);
        at_rest += least_of(-(double)driven[k].coordinate->im[vertex][1], range->im);
    }
    return at_rest;
}

/// Looks whether a vertex is the lowest in a block; returns how high the lowest are at most.
static double look_at(const struct driven *driven, int count, int vertex, double at_rest, int from, int samples,
                      struct low_point *low)
{
    double height[BLOCK], highest = -INFINITY;
    for (int i = 0; i < samples; i++) height[i] = at_rest;
    for (int k = 0; k < count; k++) {
        const double a = (double)driven[k].coordinate->re[vertex][1], b = (double)driven[k].coordinate->im[vertex][1];
        for (int i = 0; i < samples; i++) height[i] += a * driven[k].re[from + i] - b * driven[k].im[from + i];
    }
    for (int i = 0; i < samples; i++) {
        if (height[i] < low[from + i].height) low[from + i] = (struct low_point){height[i], vertex};
        highest = low[from + i].height > highest ? low[from + i].height : highest;
    }
    return highest;
}

bool character_lowest(const struct posing *posing, int rig, double ceiling, double *room, struct low_point *low)
{
    const struct character_rig *character = &posing->document->rigs[rig].character;
    const struct figure *figure = models_figure(posing->models, document_rig_number(posing->document, rig));
    const int samples = posing->evaluation->samples;
    struct driven driven[CHARACTER_MAX_DRIVES];
    int count = 0;
    double *highest = room + 6 * samples * CHARACTER_MAX_DRIVES; // of the lowest of each block
    if (!figure) return false;
    for (int d = 0; d < character->drive_count; d++) {
        const struct drive *drive = &character->drives[d];
        const int coordinate = figure_find(figure, drive->name);
        if (coordinate < 0) continue;
        driven[count] = find_weights(&figure->character.coordinates[coordinate], drive,
                                     &posing->evaluation->curves[drive->spline], samples, room);
        find_ranges(&driven[count++], samples);
        room += 6 * samples;
    }
    for (int i = 0; i < samples; i++) low[i] = (struct low_point){ceiling, -1};
    for (int from = 0; from < samples; from += BLOCK) highest[from / BLOCK] = ceiling;
    for (int v = 0; v < figure->character.vertex_count; v++) {
        const double at_rest =
            character->position[1] + (double)figure->character.position[v][1] - (double)figure->lo[1];
        if (least_height(driven, count, v, at_rest, -1) >= ceiling) continue;
        for (int from = 0; from < samples; from += BLOCK) {
            double *most = &highest[from / BLOCK];
            if (least_height(driven, count, v, at_rest, from / BLOCK) < *most)
                *most = look_at(driven, count, v, at_rest, from, block_size(from, samples), low);
        }
    }
    return true;
}
