/// What is soft of a model: coordinates' weights from splines' values and the clip, vertices as points for pins, and the lowest ones for floors.
#include "maths/maths.h"
#include "maths/wide.h"
#include "rig/posing.h"
#include <math.h>

_Static_assert((int)MODEL_MAX_DRIVES <= (int)MORPH_MAX_COORDINATES, "a drive moves a coordinate");

/// z of a drive at a value of its spline.
static void find_weight(const struct drive *drive, const wiggly_value *x, bool stiff, double z[2])
{
    const double lag = stiff ? 0.0 : radians(drive->lag);
    const double re = x->y + x->re * maths_cos(lag) + x->im * maths_sin(lag);
    const double im = stiff ? 0.0 : x->im * maths_cos(lag) - x->re * maths_sin(lag);
    z[0] = drive->amplitude * re;
    z[1] = drive->amplitude * im;
}

void pose_character(const struct model_rig *rig, const struct figure *figure, const wiggly_value *values,
                    enum look look, float *weights)
{
    for (int k = 0; k < rig->drive_count; k++) {
        const struct drive *drive = &rig->drives[k];
        const int coordinate = figure_find(figure, drive->name);
        double z[2];
        if (coordinate < 0) continue;
        const struct coordinate *c = &figure->character.coordinates[coordinate];
        find_weight(drive, &values[k], look == LOOK_STIFF, z);
        for (int p = 0; p < 2; p++) weights[c->target[p]] += (float)(z[p] / c->scale);
    }
    for (int k = 0; k < figure->character.coordinate_count; k++) { // curves go by the sum
        const struct coordinate *c = &figure->character.coordinates[k];
        const double z[2] = {c->scale * (double)weights[c->target[0]], c->scale * (double)weights[c->target[1]]};
        double all[COORDINATE_PARTS];
        if (!c->sq) continue;
        coordinate_weights(c, z, all, NULL);
        for (int p = COORDINATE_STRAIGHT; p < COORDINATE_PARTS; p++)
            weights[c->target[p]] = (float)(coordinate_sign(p) * all[p] / c->scale);
    }
}

/// z of a coordinate by the clip and all drives.
static void find_sum(const struct model_rig *rig, const struct figure *figure, const struct morph *clip,
                     const wiggly_value *values, int coordinate, double z[2])
{
    z[0] = z[1] = 0;
    for (int k = 0; k < clip->count; k++) {
        for (int p = 0; p < 2 && clip->coordinate[k] == coordinate; p++) z[p] += (double)clip->weight[k][p];
    }
    for (int d = 0; d < rig->drive_count; d++) {
        double of[2];
        if (figure_find(figure, rig->drives[d].name) != coordinate) continue;
        find_weight(&rig->drives[d], &values[d], false, of);
        for (int p = 0; p < 2; p++) z[p] += of[p];
    }
}

/// How a spline moves a vertex from where the clip and the drives' values have it (`values` NULL: from rest): Σ A e^{−j·lag} Ñ over the
/// coordinates that it drives. On a curve Ñ is the derivative: of a real function h of z it is ∂h/∂Re z − j ∂h/∂Im z.
static void find_pull(const struct model_rig *rig, const struct figure *figure, const struct morph *clip,
                      const wiggly_value *values, int vertex, int spline, pin_pull c)
{
    for (int d = 0; d < rig->drive_count; d++) {
        const struct drive *drive = &rig->drives[d];
        const int number = drive->spline == spline ? figure_find(figure, drive->name) : -1;
        const double lag = radians(drive->lag); // A e^{−j·lag}
        const double turn[2] = {drive->amplitude * maths_cos(lag), -drive->amplitude * maths_sin(lag)};
        double z[2] = {0}, weights[COORDINATE_PARTS], by[2][COORDINATE_PARTS];
        if (number < 0) continue;
        const struct coordinate *coordinate = &figure->character.coordinates[number];
        if (values) find_sum(rig, figure, clip, values, number, z);
        coordinate_weights(coordinate, z, weights, by);
        for (int k = 0; k < 3; k++) {
            double re = 0, im = 0;
            for (int p = 0; p < coordinate_parts(coordinate); p++) {
                const double part = coordinate_sign(p) * (double)coordinate->parts[p][vertex][k];
                re += part * by[0][p];
                im -= part * by[1][p];
            }
            c[k][0] += turn[0] * re - turn[1] * im;
            c[k][1] += turn[0] * im + turn[1] * re;
        }
    }
}

static const double SLACK = 1e-9; ///< of the size

bool character_find_pin(const struct posing *posing, const struct pin_query *query, pin_pull *c,
                        struct pin_point *point)
{
    const struct document *document = posing->document;
    const struct model_rig *rig = &document->rigs[query->rig]->model;
    const double sample = document_sample(document, query->pin->frame) + query->later;
    const double read = sample - document_delay(document, query->rig);
    const int vertex = query->pin->point;
    struct rig_pose posed;
    const struct figure *figure = models_figure(posing->models, document, query->rig);
    if (!figure || vertex >= figure->character.vertex_count) return false;
    const struct gltf *gltf = &models_imported(posing->models, document, query->rig)->gltf;
    struct gltf_pose *pose = posing_clip(posing, query->rig, sample, POSE_UNSEEN);
    const float *of = pose->weights + gltf->nodes[figure->character.node].first_weight;
    const struct morph clip = figure_morph(figure, of);
    posing_bend(posing, query->rig, sample, pose, &posed);
    *point = (struct pin_point){.is_linear = read == rint(read)}; // in x of that sample
    for (int r = -1; (r = document_next_chain(document, query->rig, r)) >= 0;) {
        for (int i = 0; i < query->count; i++)
            point->is_linear &= !rig_is_moved(document->rigs[r], query->splines[i]);
    }

    // Moved by its coordinates, in double precision.
    float matrix[16], way[3];
    double shape[3];
    wiggly_value values[RIG_MAX_INPUTS];
    figure_carry(&posed.model, vertex, matrix, way);
    for (int k = 0; k < 3; k++) {
        point->size = maths_hypot(point->size, rig->scale * (double)(figure->hi[k] - figure->lo[k]));
        shape[k] = (double)figure->character.position[vertex][k] + (double)way[k];
    }
    point->slack = SLACK * point->size;
    posing_values(posing, query->rig, sample, values);
    for (int k = 0; k < figure->character.coordinate_count; k++) {
        const struct coordinate *coordinate = &figure->character.coordinates[k];
        double z[2], weights[COORDINATE_PARTS];
        find_sum(rig, figure, &clip, values, k, z);
        coordinate_weights(coordinate, z, weights, NULL);
        for (int n = 0; n < 3 * coordinate_parts(coordinate); n++)
            shape[n % 3] += coordinate_sign(n / 3) * weights[n / 3] * (double)coordinate->parts[n / 3][vertex][n % 3];
        point->is_linear &= !coordinate->sq;
    }

    // Carried into the world.
    double root[12], carried[4][3];
    posing_root(posing, query->rig, root);
    for (int j = 0; j < 4; j++) {
        for (int k = 0; k < 3; k++) {
            carried[j][k] = j == 3 ? root[9 + k] : 0;
            for (int a = 0; a < 3; a++) carried[j][k] += root[3 * a + k] * (double)matrix[4 * j + a];
        }
    }
    for (int k = 0; k < 3; k++) {
        point->at[k] = carried[3][k];
        for (int j = 0; j < 3; j++) point->at[k] += carried[j][k] * shape[j];
    }
    for (int i = 0; i < query->count; i++) {
        pin_pull pull = {{0}};
        find_pull(rig, figure, &clip, values, vertex, query->splines[i], pull);
        for (int k = 0; k < 6; k++) {
            for (int j = 0; j < 3; j++) c[i][k / 2][k % 2] += carried[j][k / 2] * pull[j][k % 2];
        }
    }
    return true;
}

double character_weigh(const struct posing *posing, int rig, int spline)
{
    const struct model_rig *model = &posing->document->rigs[rig]->model;
    const struct figure *figure = models_figure(posing->models, posing->document, rig);
    double sum = 0, areas = 0;
    for (int t = 0; figure && t + 2 < figure->character.index_count; t += 3) {
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
            find_pull(model, figure, NULL, NULL, (int)corner[k], spline, c);
            sum += area / 3 * pinning_square(c);
        }
    }
    return areas > 0 ? model->scale * model->scale * sum / areas : 0;
}

// --- lowest vertices: several samples at a time, so that most vertices can be excluded for all of them at once

/// Samples, and blocks of samples, that are processed together.
enum { BLOCK = 16, ROW = LOW_POINT_ROW / BLOCK };

/// Pairs of a coordinate's parts: Re z and −Im z; of a curved one also Re z² and −Im z², and |z|² beside what has no weight.
static const int pair[LOW_POINT_PAIRS][2] = {{0, 1}, {3, 4}, {2, 2}};
enum { MOST_PAIRS = LOW_POINT_PAIRS * MODEL_MAX_DRIVES };

/// A pair of parts: their weights at every sample, and their range in each block and in all.
struct driven {
    const float (*a)[3], (*b)[3];
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

/// A vertex's height by pair: a re − b im.
struct moves {
    double at_rest, a[MOST_PAIRS], b[MOST_PAIRS];
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

/// The same for a model that its clip or a chain moves: of the vertices that a coordinate moves, posed sample by sample.
static bool lowest_posed(const struct posing *posing, int rig, double ceiling, struct low_point *low)
{
    const double delay = document_delay(posing->document, rig);
    for (int i = 0; i < posing->evaluation->samples; i++) {
        struct rig_pose posed;
        float height = (float)ceiling;
        if (!rig_pose(posing, rig, i + delay, &posed)) return false;
        const int vertex = figure_lowest(&posed.model, &height);
        low[i] = (struct low_point){vertex < 0 ? ceiling : (double)height, vertex};
    }
    return true;
}

bool character_lowest(const struct posing *posing, int rig, double ceiling, double *room, struct low_point *low)
{
    const struct model_rig *model = &posing->document->rigs[rig]->model;
    const struct figure *figure = models_figure(posing->models, posing->document, rig);
    const int samples = posing->evaluation->samples;
    const int blocks = low_point_samples(samples) / BLOCK;
    struct driven driven[MOST_PAIRS];
    struct moves moves;
    int count = 0;
    if (!figure) return false;
    if (model->clip || document_next_chain(posing->document, rig, -1) >= 0)
        return lowest_posed(posing, rig, ceiling, low);
    // The lowest vertices so far: per sample the height and index, per block the largest of these heights.
    double *lowest = take_room(&room, BLOCK * blocks), *vertex = take_room(&room, BLOCK * blocks);
    double *highest = take_room(&room, blocks);
    for (int d = 0; d < model->drive_count; d++) {
        const int number = figure_find(figure, model->drives[d].name);
        if (number < 0) continue;
        const struct coordinate *coordinate = &figure->character.coordinates[number];
        struct driven *const one = &driven[count], *const end = one + (coordinate->sq ? LOW_POINT_PAIRS : 1);
        for (int n = 0; one + n < end; n++)
            driven[count++] = (struct driven){.a = (const float(*)[3])coordinate->parts[pair[n][0]],
                                              .b = (const float(*)[3])coordinate->parts[pair[n][1]],
                                              .re = take_room(&room, BLOCK * blocks),
                                              .im = take_room(&room, BLOCK * blocks),
                                              .re_range = {take_room(&room, blocks), take_room(&room, blocks)},
                                              .im_range = {take_room(&room, blocks), take_room(&room, blocks)}};

        // z at every sample, as in pose_character(); after the last sample it stays.
        const struct drive *drive = &model->drives[d];
        const wiggly_curve *curve = &posing->evaluation->curves[drive->spline];
        const double lag = radians(drive->lag), c = maths_cos(lag), s = maths_sin(lag);
        for (int i = 0; i < BLOCK * blocks; i++) {
            const int at = i < samples ? i : samples - 1;
            one->re[i] = drive->amplitude * (curve->y[at] + curve->re[at] * c + curve->im[at] * s);
            one->im[i] = drive->amplitude * (curve->im[at] * c - curve->re[at] * s);
            if (!coordinate->sq) continue;
            double weights[COORDINATE_PARTS];
            coordinate_weights(coordinate, (const double[2]){one->re[i], one->im[i]}, weights, NULL);
            for (int n = 1; one + n < end; n++) {
                one[n].re[i] = weights[pair[n][0]];
                one[n].im[i] = pair[n][1] == pair[n][0] ? 0 : weights[pair[n][1]];
            }
        }
        for (struct driven *each = one; each < end; each++) {
            find_ranges(each->re, blocks, each->re_range, each->re_all);
            find_ranges(each->im, blocks, each->im_range, each->im_all);
        }
    }
    for (int i = 0; i < BLOCK * blocks; i++) lowest[i] = ceiling, vertex[i] = -1;
    for (int b = 0; b < blocks; b++) highest[b] = ceiling;
    for (int v = 0; v < figure->character.vertex_count; v++) {
        moves.at_rest =
            model->position[1] + model->scale * ((double)figure->character.position[v][1] - (double)figure->lo[1]);
        double least = moves.at_rest; // a lower bound of the vertex's height
        for (int k = 0; k < count; k++) {
            const double a = moves.a[k] = model->scale * (double)driven[k].a[v][1];
            const double b = moves.b[k] = model->scale * (double)driven[k].b[v][1];
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
