/// The lowest vertices of a soft character, for its floor: vertex by vertex, all samples of one at once.
#include "rig/pinning_kind.h"
#include "rig/posing_kind.h"
#include <math.h>

/// A coordinate that is driven: the weights of its real and imaginary part at every sample, and the largest of each.
struct driven {
    const struct coordinate *coordinate;
    const double *re, *im;
    double largest[2];
};

/// z of a drive at every sample, as pose_character() has it.
static struct driven find_weights(const struct coordinate *coordinate, const struct drive *drive,
                                  const wiggly_curve *curve, int samples, double *room)
{
    const double lag = drive->lag * 3.14159265358979323846 / 180.0, c = cos(lag), s = sin(lag);
    double *re = room, *im = room + samples;
    struct driven driven = {coordinate, re, im, {0, 0}};
    for (int i = 0; i < samples; i++) {
        re[i] = drive->amplitude * (curve->y[i] + curve->re[i] * c + curve->im[i] * s);
        im[i] = drive->amplitude * (curve->im[i] * c - curve->re[i] * s);
        driven.largest[0] = fmax(driven.largest[0], fabs(re[i]));
        driven.largest[1] = fmax(driven.largest[1], fabs(im[i]));
    }
    return driven;
}

/// How high a vertex can be at least.
static double least_height(const struct driven *driven, int count, int vertex, double at_rest)
{
    for (int k = 0; k < count; k++) {
        const struct coordinate *c = driven[k].coordinate;
        at_rest -= driven[k].largest[0] * fabs((double)c->re[vertex][1]);
        at_rest -= driven[k].largest[1] * fabs((double)c->im[vertex][1]);
    }
    return at_rest;
}

static void look_at(const struct driven *driven, int count, int vertex, double at_rest, int samples,
                    struct low_point *low)
{
    for (int i = 0; i < samples; i++) {
        double height = at_rest;
        for (int k = 0; k < count; k++) {
            height += driven[k].re[i] * (double)driven[k].coordinate->re[vertex][1];
            height -= driven[k].im[i] * (double)driven[k].coordinate->im[vertex][1];
        }
        if (height < low[i].height) low[i] = (struct low_point){height, vertex};
    }
}

bool character_lowest(const struct posing *posing, int rig, double ceiling, double *room, struct low_point *low)
{
    const struct character_rig *character = &posing->document->rigs[rig].character;
    const struct figure *figure = models_figure(posing->models, document_rig_number(posing->document, rig));
    const int samples = posing->evaluation->samples;
    struct driven driven[CHARACTER_MAX_DRIVES];
    int count = 0;
    if (!figure) return false;
    for (int d = 0; d < character->drive_count; d++) {
        const struct drive *drive = &character->drives[d];
        const int coordinate = figure_find(figure, drive->name);
        if (coordinate < 0) continue;
        driven[count] = find_weights(&figure->character.coordinates[coordinate], drive,
                                     &posing->evaluation->curves[drive->spline], samples, room);
        count++;
        room += 2 * samples;
    }
    for (int i = 0; i < samples; i++) low[i] = (struct low_point){ceiling, -1};
    for (int v = 0; v < figure->character.vertex_count; v++) {
        const double at_rest =
            character->position[1] + (double)figure->character.position[v][1] - (double)figure->lo[1];
        if (least_height(driven, count, v, at_rest) < ceiling) look_at(driven, count, v, at_rest, samples, low);
    }
    return true;
}
