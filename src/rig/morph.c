#include "rig/morph.h"
#include <math.h>

_Static_assert((int)CHARACTER_MAX_DRIVES <= (int)MORPH_MAX_COORDINATES, "a drive moves a coordinate");

void pose_character(const struct character_rig *rig, const struct figure *figure, const wiggly_value *values,
                    enum look look, struct morph *morph)
{
    morph->count = 0;
    for (int k = 0; k < rig->drive_count; k++) {
        const struct drive *drive = &rig->drives[k];
        const wiggly_value *x = &values[k];
        const int coordinate = figure_find(figure, drive->name);
        if (coordinate < 0) continue;
        const bool stiff = look == LOOK_STIFF;
        const double lag = stiff ? 0.0 : drive->lag * 3.14159265358979323846 / 180.0;
        const double re = x->y + x->re * cos(lag) + x->im * sin(lag);
        const double im = stiff ? 0.0 : x->im * cos(lag) - x->re * sin(lag);
        morph->coordinate[morph->count] = coordinate;
        morph->weight[morph->count][0] = (float)(drive->amplitude * re);
        morph->weight[morph->count][1] = (float)(drive->amplitude * im);
        morph->count++;
    }
}
