/// Soft characters: coordinates' weights from splines' values, the models' vertices as points for pins, and the lowest ones for floors.
#include "maths/maths.h"
#include "rig/posing.h"
#include "spline/wide.h"
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
static void drive_turn(const struct drive *drive, double turn[2])
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
        drive_turn(&rig->drives[d], turn);
        add_product(&figure->character.coordinates[coordinate], vertex, turn, c);
    }
}

static const double SLACK = 1e-9; ///< of the size

static bool character_find(const struct posing *posing, const struct pin_query *query, pin_pull *c,
                           struct pin_point *point)
{
    const struct character_rig *character = &posing->document->rigs[query->rig]->character;
    const struct figure *figure = figure_of(posing, query->rig);
    const int vertex = query->pin->point;
    wiggly_value values[RIG_MAX_INPUTS];
    if (!figure || vertex >= figure->character.vertex_count) return false;
    const double sample = document_sample(posing->document, query->pin->frame) + query->later;
    const double read = sample - document_delay(posing->document, query->rig);
    posing_values(posing, query->rig, sample, NULL, values);
    *point = (struct pin_point){.is_linear = read == rint(read)}; // in x of that sample
    for (int k = 0; k < 3; k++) {
        point->size = maths_hypot(point->size, (double)(figure->hi[k] - figure->lo[k]));
        point->at[k] = character->position[k] + (double)figure->character.position[vertex][k];
    }
    point->slack = SLACK * point->size;
    point->at[1] -= (double)figure->lo[1];
    for (int d = 0; d < character->drive_count; d++) {
        const int coordinate = figure_find(figure, character->drives[d].name);
        double turn[2];
        pin_pull moves = {{0}};
        if (coordinate < 0) continue;
        drive_turn(&character->drives[d], turn);
        add_product(&figure->character.coordinates[coordinate], vertex, turn, moves);
        const double y[2] = {character->drives[d].amplitude * values[d].y, 0};
        pin_pull rests = {{0}};
        add_product(&figure->character.coordinates[coordinate], vertex, y, rests);
        for (int k = 0; k < 3; k++)
            point->at[k] += rests[k][0] + moves[k][0] * values[d].re - moves[k][1] * values[d].im;
    }
    for (int i = 0; i < query->count; i++) find_pull(character, figure, vertex, query->splines[i], c[i]);
    return true;
}

static void character_weigh(const struct posing *posing, int rig, const int *splines, int count, double *weights)
{
    const struct character_rig *character = &posing->document->rigs[rig]->character;
    const struct figure *figure = figure_of(posing, rig);
    for (int i = 0; figure && i < count; i++) {
        double sum = 0, areas = 0;
        for (int t = 0; t + 2 < figure->character.index_count; t += 3) {
            const uint32_t *corner = figure->character.indices + t;
            const float(*position)[3] = (const float(*)[3])figure->character.position;
            double u[3], v[3];
            for (int k = 0; k < 3; k++) {
                u[k] = (double)(position[corner[1]][k] - position[corner[0]][k]);
                v[k] = (double)(position[corner[2]][k] - position[corner[0]][k]);
            }
            const double area = maths_hypot(maths_hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]),
                                            u[0] * v[1] - u[1] * v[0]) /
                                2;
            areas += area;
            for (int k = 0; k < 3; k++) {
                pin_pull c = {{0}};
                find_pull(character, figure, (int)corner[k], splines[i], c);
                sum += area / 3 * pinning_square(c);
            }
        }
        if (areas > 0) weights[i] += sum / areas;
    }
}

static const struct pinning_functions character_pinning = {character_find, character_weigh};

static bool character_rig_pose(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
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

static void character_rig_bounds(const struct rig_pose *posed, float lo[3], float hi[3])
{
    const struct figure *figure = posed->character.figure;
    morph_bounds(figure, &posed->character.morph, lo, hi);
    for (int k = 0; k < 3; k++) {
        const float at = posed->character.position[k] - (k == 1 ? figure->lo[1] : 0.0f);
        lo[k] += at;
        hi[k] += at;
    }
}

// --- lowest vertices: several samples at a time, so that most vertices can be excluded for all of them at once

/// Samples, and blocks of samples, that are processed together.
enum { BLOCK = 16, ROW = LOW_POINT_ROW / BLOCK };

/// A driven coordinate: its weights at every sample, and their range in each block and in all.
struct driven {
    const struct coordinate *coordinate;
    double *re, *im;
    double *re_range[2], *im_range[2];
    double re_all[2], im_all[2];
};

static double *take_room(double **room, int count)
{
    double *taken = *room;
    *room += count;
    return taken;
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

/// A vertex's height by coordinate: a Re z − b Im z.
struct moves {
    double at_rest, a[CHARACTER_MAX_DRIVES], b[CHARACTER_MAX_DRIVES];
};

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
WIDEST static bool look_at_block(const struct driven *driven, int count, const struct moves *moves, int vertex,
                                 int from, double *restrict low, double *restrict lowest)
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
    // The lowest vertices so far: per sample the height and index, per block the largest of these heights.
    double *lowest = take_room(&room, BLOCK * blocks), *vertex = take_room(&room, BLOCK * blocks);
    double *highest = take_room(&room, blocks);
    for (int d = 0; d < character->drive_count; d++) {
        const int coordinate = figure_find(figure, character->drives[d].name);
        if (coordinate < 0) continue;
        struct driven *one = &driven[count++];
        *one = (struct driven){.coordinate = &figure->character.coordinates[coordinate],
                               .re = take_room(&room, BLOCK * blocks),
                               .im = take_room(&room, BLOCK * blocks),
                               .re_range = {take_room(&room, blocks), take_room(&room, blocks)},
                               .im_range = {take_room(&room, blocks), take_room(&room, blocks)}};

        // z at every sample, as in pose_character(); after the last sample it stays.
        const struct drive *drive = &character->drives[d];
        const wiggly_curve *curve = &posing->evaluation->curves[drive->spline];
        const double lag = radians(drive->lag), c = maths_cos(lag), s = maths_sin(lag);
        for (int i = 0; i < BLOCK * blocks; i++) {
            const int at = i < samples ? i : samples - 1;
            one->re[i] = drive->amplitude * (curve->y[at] + curve->re[at] * c + curve->im[at] * s);
            one->im[i] = drive->amplitude * (curve->im[at] * c - curve->re[at] * s);
        }
        find_ranges(one->re, blocks, one->re_range, one->re_all);
        find_ranges(one->im, blocks, one->im_range, one->im_all);
    }
    for (int i = 0; i < BLOCK * blocks; i++) lowest[i] = ceiling, vertex[i] = -1;
    for (int b = 0; b < blocks; b++) highest[b] = ceiling;
    for (int v = 0; v < figure->character.vertex_count; v++) {
        moves.at_rest = character->position[1] + (double)figure->character.position[v][1] - (double)figure->lo[1];
        double least = moves.at_rest; // a lower bound of the vertex's height
        for (int k = 0; k < count; k++) {
            const double a = moves.a[k] = (double)driven[k].coordinate->re[v][1];
            const double b = moves.b[k] = (double)driven[k].coordinate->im[v][1];
            least += a * driven[k].re_all[a < 0];
            least -= b * driven[k].im_all[b > 0];
        }
        bool may[ROW];
        for (int row = 0; least < ceiling && row < blocks; row += ROW) {
            if (!may_be_low(driven, count, &moves, row, highest + row, may)) continue;
            for (int b = row; b < row + ROW; b++) {
                double *height = lowest + BLOCK * b;
                if (!may[b - row] || !look_at_block(driven, count, &moves, v, BLOCK * b, height, vertex + BLOCK * b))
                    continue;
                highest[b] = height[0];
                for (int i = 1; i < BLOCK; i++) highest[b] = height[i] > highest[b] ? height[i] : highest[b];
            }
        }
    }
    for (int i = 0; i < samples; i++) low[i] = (struct low_point){lowest[i], (int)vertex[i]};
    return true;
}

const struct posing_functions character_posing = {character_rig_pose, character_rig_bounds, &character_pinning};
