/// Turns the values of splines into the weights of a character.
#include "rig/posing_kind.h"
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

static bool pose(const struct posing *posing, int rig, double position, const wiggly_value *values,
                 const struct by_hand *by_hand, struct rig_pose *posed)
{
    const struct character_rig *character = &posing->document->rigs[rig]->character;
    const struct figure *figure = models_figure(posing->models, document_rig_number(posing->document, rig));
    (void)position;
    if (!figure) return false;
    posed->character.figure = figure;
    for (int k = 0; k < 3; k++) {
        posed->character.position[k] = (float)(character->position[k] + (by_hand ? by_hand->base[k] : 0));
    }
    pose_character(character, figure, values, posing->look, &posed->character.morph);
    return true;
}

static void bounds(const struct rig_pose *posed, float lo[3], float hi[3])
{
    const struct figure *figure = posed->character.figure;
    morph_bounds(figure, &posed->character.morph, lo, hi);
    for (int k = 0; k < 3; k++) {
        const float at = posed->character.position[k] - (k == 1 ? figure->lo[1] : 0.0f);
        lo[k] += at;
        hi[k] += at;
    }
}

const struct posing_functions character_posing = {pose, bounds, &character_pinning};
