/// What is soft of a model: coordinates' weights from splines' values and the clip, vertices as points for pins, and the lowest ones for floors.
#include "maths/maths.h"
#include "rig/posing.h"
#include "spline/wide.h"
#include <math.h>

_Static_assert((int)MODEL_MAX_DRIVES <= (int)MORPH_MAX_COORDINATES, "a drive moves a coordinate");

void pose_character(const struct model_rig *rig, const struct figure *figure, const wiggly_value *values,
                    enum look look, float *weights)
{
    for (int k = 0; k < rig->drive_count; k++) {
        const struct drive *drive = &rig->drives[k];
        const wiggly_value *x = &values[k];
        const int coordinate = figure_find(figure, drive->name);
        if (coordinate < 0) continue;
        const struct coordinate *c = &figure->character.coordinates[coordinate];
        const bool stiff = look == LOOK_STIFF;
        const double lag = stiff ? 0.0 : radians(drive->lag);
        const double re = x->y + x->re * maths_cos(lag) + x->im * maths_sin(lag);
        const double im = stiff ? 0.0 : x->im * maths_cos(lag) - x->re * maths_sin(lag);
        weights[c->target[0]] += (float)(drive->amplitude * re / c->scale);
        weights[c->target[1]] += (float)(drive->amplitude * im / c->scale);
    }
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
static void find_pull(const struct model_rig *rig, const struct figure *figure, int vertex, int spline, pin_pull c)
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

static bool model_find(const struct posing *posing, const struct pin_query *query, pin_pull *c,
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
    const float *weights = posing_clip(posing, query->rig, sample, POSE_UNSEEN)->weights;
    const struct morph clip = figure_morph(figure, weights + gltf->nodes[figure->character.node].first_weight);
    if (!rig_pose(posing, query->rig, sample, NULL, &posed)) return false;
    *point = (struct pin_point){.is_linear = read == rint(read)}; // in x of that sample
    for (int r = -1; (r = document_next_chain(document, query->rig, r)) >= 0;) {
        for (int i = 0; i < query->count; i++)
            point->is_linear &= !rig_is_moved(document->rigs[r], query->splines[i]);
    }

    // Moved by its coordinates, in double precision.
    const struct coordinate *coordinates = figure->character.coordinates;
    float matrix[16], way[3];
    pin_pull shape = {{0}};
    wiggly_value values[RIG_MAX_INPUTS];
    figure_carry(&posed.model, vertex, matrix, way);
    for (int k = 0; k < 3; k++) {
        point->size = maths_hypot(point->size, rig->scale * (double)(figure->hi[k] - figure->lo[k]));
        shape[k][0] = (double)figure->character.position[vertex][k] + (double)way[k];
    }
    point->slack = SLACK * point->size;
    for (int k = 0; k < clip.count; k++) {
        const double z[2] = {(double)clip.weight[k][0], (double)clip.weight[k][1]};
        add_product(&coordinates[clip.coordinate[k]], vertex, z, shape);
    }
    posing_values(posing, query->rig, sample, NULL, values);
    for (int d = 0; d < rig->drive_count; d++) {
        const int coordinate = figure_find(figure, rig->drives[d].name);
        double turn[2];
        if (coordinate < 0) continue;
        drive_turn(&rig->drives[d], turn);
        const double z[2] = {rig->drives[d].amplitude * values[d].y + turn[0] * values[d].re - turn[1] * values[d].im,
                             turn[0] * values[d].im + turn[1] * values[d].re};
        add_product(&coordinates[coordinate], vertex, z, shape);
    }

    // Carried into the world.
    double root[12], carried[4][3];
    posing_root(posing, query->rig, NULL, root);
    for (int j = 0; j < 4; j++) {
        for (int k = 0; k < 3; k++) {
            carried[j][k] = j == 3 ? root[9 + k] : 0;
            for (int a = 0; a < 3; a++) carried[j][k] += root[3 * a + k] * (double)matrix[4 * j + a];
        }
    }
    for (int k = 0; k < 3; k++) {
        point->at[k] = carried[3][k];
        for (int j = 0; j < 3; j++) point->at[k] += carried[j][k] * shape[j][0];
    }
    for (int i = 0; i < query->count; i++) {
        pin_pull pull = {{0}};
        find_pull(rig, figure, vertex, query->splines[i], pull);
        for (int k = 0; k < 6; k++) {
            for (int j = 0; j < 3; j++) c[i][k / 2][k % 2] += carried[j][k / 2] * pull[j][k % 2];
        }
    }
    return true;
}

static void model_weigh(const struct posing *posing, int rig, const int *splines, int count, double *weights)
{
    const struct model_rig *model = &posing->document->rigs[rig]->model;
    const struct figure *figure = models_figure(posing->models, posing->document, rig);
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
                find_pull(model, figure, (int)corner[k], splines[i], c);
                sum += area / 3 * pinning_square(c);
            }
        }
        if (areas > 0) weights[i] += model->scale * model->scale * sum / areas;
    }
}

const struct pinning_functions model_pinning = {model_find, model_weigh};

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
    double at_rest, a[MODEL_MAX_DRIVES], b[MODEL_MAX_DRIVES];
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
        if (!rig_pose(posing, rig, i + delay, NULL, &posed)) return false;
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
    struct driven driven[MODEL_MAX_DRIVES];
    struct moves moves;
    int count = 0;
    if (!figure) return false;
    if (model->clip || document_next_chain(posing->document, rig, -1) >= 0)
        return lowest_posed(posing, rig, ceiling, low);
    // The lowest vertices so far: per sample the height and index, per block the largest of these heights.
    double *lowest = take_room(&room, BLOCK * blocks), *vertex = take_room(&room, BLOCK * blocks);
    double *highest = take_room(&room, blocks);
    for (int d = 0; d < model->drive_count; d++) {
        const int coordinate = figure_find(figure, model->drives[d].name);
        if (coordinate < 0) continue;
        struct driven *one = &driven[count++];
        *one = (struct driven){.coordinate = &figure->character.coordinates[coordinate],
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
        }
        find_ranges(one->re, blocks, one->re_range, one->re_all);
        find_ranges(one->im, blocks, one->im_range, one->im_all);
    }
    for (int i = 0; i < BLOCK * blocks; i++) lowest[i] = ceiling, vertex[i] = -1;
    for (int b = 0; b < blocks; b++) highest[b] = ceiling;
    for (int v = 0; v < figure->character.vertex_count; v++) {
        moves.at_rest =
            model->position[1] + model->scale * ((double)figure->character.position[v][1] - (double)figure->lo[1]);
        double least = moves.at_rest; // a lower bound of the vertex's height
        for (int k = 0; k < count; k++) {
            const double a = moves.a[k] = model->scale * (double)driven[k].coordinate->re[v][1];
            const double b = moves.b[k] = model->scale * (double)driven[k].coordinate->im[v][1];
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
