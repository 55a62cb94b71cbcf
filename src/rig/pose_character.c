/// Soft characters: coordinates' weights from splines' values, and the models' vertices as points for pins.
#include "maths/maths.h"
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
        const double lag = stiff ? 0.0 : radians(drive->lag);
        const double re = x->y + x->re * maths_cos(lag) + x->im * maths_sin(lag);
        const double im = stiff ? 0.0 : x->im * maths_cos(lag) - x->re * maths_sin(lag);
        morph->coordinate[morph->count] = coordinate;
        morph->weight[morph->count][0] = (float)(drive->amplitude * re);
        morph->weight[morph->count][1] = (float)(drive->amplitude * im);
        morph->count++;
    }
}

static const struct figure *figure_of(const struct posing *posing, int rig)
{
    return models_figure(posing->models, document_rig_number(posing->document, rig));
}

/// A e^{−j·lag}
static void turn_of(const struct drive *drive, double turn[2])
{
    const double lag = radians(drive->lag);
    turn[0] = drive->amplitude * maths_cos(lag);
    turn[1] = -drive->amplitude * maths_sin(lag);
}

/// Adds z Ñ of a coordinate at a vertex (eq. 29, with more of them eq. 30).
static void add_product(const struct coordinate *coordinate, int vertex, const double z[2], pin_pull c)
{
    for (int k = 0; k < 3; k++) {
        const double re = (double)coordinate->re[vertex][k], im = (double)coordinate->im[vertex][k];
        c[k][0] += z[0] * re - z[1] * im;
        c[k][1] += z[0] * im + z[1] * re;
    }
}

/// How a spline moves a vertex: Σ A e^{−j·lag} Ñ over the coordinates that it drives.
static void find_pull(const struct character_rig *rig, const struct figure *figure, int vertex, int spline,
                      pin_pull c)
{
    for (int d = 0; d < rig->drive_count; d++) {
        const int coordinate = rig->drives[d].spline == spline ? figure_find(figure, rig->drives[d].name) : -1;
        double turn[2];
        if (coordinate < 0) continue;
        turn_of(&rig->drives[d], turn);
        add_product(&figure->character.coordinates[coordinate], vertex, turn, c);
    }
}

static bool find(const struct posing *posing, int rig, double sample, int which, const int *splines, int count,
                 pin_pull *c, struct pin_point *point)
{
    const struct character_rig *character = &posing->document->rigs[rig]->character;
    const struct figure *figure = figure_of(posing, rig);
    wiggly_value values[RIG_MAX_INPUTS];
    if (!figure || which >= figure->character.vertex_count) return false;
    posing_values(posing, rig, sample, NULL, values);
    *point = (struct pin_point){.is_linear = true};
    for (int k = 0; k < 3; k++) {
        point->size = maths_hypot(point->size, (double)(figure->hi[k] - figure->lo[k]));
        point->at[k] = character->position[k] + (double)figure->character.position[which][k];
    }
    point->at[1] -= (double)figure->lo[1];
    for (int d = 0; d < character->drive_count; d++) {
        const int coordinate = figure_find(figure, character->drives[d].name);
        double turn[2];
        pin_pull moves = {{0}};
        if (coordinate < 0) continue;
        turn_of(&character->drives[d], turn);
        add_product(&figure->character.coordinates[coordinate], which, turn, moves);
        const double y[2] = {character->drives[d].amplitude * values[d].y, 0};
        pin_pull rests = {{0}};
        add_product(&figure->character.coordinates[coordinate], which, y, rests);
        for (int k = 0; k < 3; k++)
            point->at[k] += rests[k][0] + moves[k][0] * values[d].re - moves[k][1] * values[d].im;
    }
    for (int i = 0; i < count; i++) find_pull(character, figure, which, splines[i], c[i]);
    return true;
}

/// |c|² at a vertex.
static double square_at(const struct character_rig *rig, const struct figure *figure, int vertex, int spline)
{
    pin_pull c = {{0}};
    find_pull(rig, figure, vertex, spline, c);
    return pinning_square(c);
}

static double area_of(const struct figure *figure, const uint32_t corner[3])
{
    const float(*position)[3] = (const float(*)[3])figure->character.position;
    const float *a = position[corner[0]], *b = position[corner[1]], *c = position[corner[2]];
    const double u[3] = {(double)(b[0] - a[0]), (double)(b[1] - a[1]), (double)(b[2] - a[2])};
    const double v[3] = {(double)(c[0] - a[0]), (double)(c[1] - a[1]), (double)(c[2] - a[2])};
    return maths_hypot(maths_hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]), u[0] * v[1] - u[1] * v[0]) /
           2;
}

/// The coarse mesh is enough for a mean.
static void weigh(const struct posing *posing, int rig, const int *splines, int count, double *weights)
{
    const struct character_rig *character = &posing->document->rigs[rig]->character;
    const struct figure *figure = figure_of(posing, rig);
    for (int i = 0; figure && i < count; i++) {
        double sum = 0, areas = 0;
        for (int t = 0; t + 2 < figure->coarse_count; t += 3) {
            const uint32_t *corner = &figure->coarse[t];
            const double area = area_of(figure, corner);
            areas += area;
            for (int k = 0; k < 3; k++) sum += area / 3 * square_at(character, figure, (int)corner[k], splines[i]);
        }
        if (areas > 0) weights[i] += sum / areas;
    }
}

static const struct pinning_functions pinning = {find, weigh};

static bool pose(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
                 struct rig_pose *posed)
{
    const struct character_rig *character = &posing->document->rigs[rig]->character;
    const struct figure *figure = figure_of(posing, rig);
    wiggly_value values[RIG_MAX_INPUTS];
    if (!figure) return false;
    posing_values(posing, rig, position, by_hand, values);
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

const struct posing_functions character_posing = {pose, bounds, &pinning};
