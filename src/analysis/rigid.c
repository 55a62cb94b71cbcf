/// Reads a motion in slabs of columns, and fits the motion of a base to a rigid one, frame by frame.
///
/// With the centre r̄ of the base's vertices at rest and M = Σ (r − r̄) (x − x̄)ᵀ over them, Σ |R (r − r̄) − (x − x̄)|² is least for the
/// rotation by the unit quaternion that is the largest eigenvector of (Horn 1987)
///
///     ⎡ Mxx+Myy+Mzz  Myz−Mzy      Mzx−Mxz       Mxy−Myx     ⎤
///     ⎢ ·            Mxx−Myy−Mzz  Mxy+Myx       Mzx+Mxz     ⎥
///     ⎢ ·            ·            −Mxx+Myy−Mzz  Myz+Mzy     ⎥
///     ⎣ ·            ·            ·             −Mxx−Myy+Mzz⎦
///
/// A point or a line leaves rotations open. A little weight on the identity chooses the smallest.
#include "analysis/analysis.h"
#include "base/need.h"
#include "maths/maths.h"
#include "maths/symmetric.h"
#include <math.h>
#include <stdlib.h>

enum { SLAB_NUMBERS = 1 << 20 }; ///< 8 MiB: a slab and its copies fit the cache

/// Some columns of S, those of whole vertices.
struct slab {
    const struct motion *motion;
    int columns, width, first, count; ///< columns in all; in a slab; the slab's first; in this slab
    double *numbers;                  ///< frames × count
};

/// A pass over all slabs: `for (slab = slab_start(m); slab_next(&slab, &error);)`, then slab_end().
static struct slab slab_start(const struct motion *motion)
{
    const int columns = 3 * motion->vertices, width = 3 * (SLAB_NUMBERS / motion->frames / 3 + 1);
    struct slab slab = {.motion = motion, .columns = columns, .width = width < columns ? width : columns};
    slab.numbers = need((size_t)motion->frames * (size_t)slab.width, sizeof *slab.numbers);
    return slab;
}

/// Reads the next slab; false after the last one or on an error.
static bool slab_next(struct slab *slab, struct error *error)
{
    const int left = slab->columns - slab->first - slab->count;
    if (left == 0) return false;
    slab->first += slab->count;
    slab->count = left < slab->width ? left : slab->width;
    if (motion_columns(slab->motion, slab->first, slab->count, slab->numbers, error)) return true;
    slab->count = 0;
    return false;
}

/// Whether all slabs were read.
static bool slab_end(const struct slab *slab)
{
    free(slab->numbers);
    return slab->first + slab->count == slab->columns;
}

static const double still = 1e-5;     ///< share of the largest motion of a vertex; a vertex that moves less rests
static const double straight = 1e-6;  ///< share of the squared size; a base with less area is a line
static const double nothing = 1e-6;   ///< share of the base's size; a base that moves less rests, up to rounding
static const double least_slow = 0.2; ///< ratio of slow to fast motion of an unknown base; less is not removed
static const double identity = 1e-7;  ///< weight of no rotation
static const double certain = 4;      ///< times what the residual explains of a base's turn; less is not removed
static const double calm_part = 0.1;  ///< of the vertices, those that move least: a rigid motion moves them, too

/// Sums over the base's vertices, from the mesh at rest and from one pass over the motion.
struct survey {
    const struct surface *rest;
    bool *base;             ///< per vertex
    double centre[3];       ///< r̄
    double spread[3][3];    ///< Σ (r − r̄) (r − r̄)ᵀ
    int count;              ///< vertices of the base
    double (*moment)[3][3]; ///< M per frame
    double (*mean)[3];      ///< x̄ per frame
    double *extent;         ///< per vertex: squared size of the box that it moves in
    double scatter;         ///< Σ |x − its mean over time|² over the base and all frames
};

/// Centre and spread of the base at rest.
static void measure_rest(struct survey *s)
{
    for (int v = 0; v < s->rest->vertex_count; v++) s->count += s->base[v];
    for (int n = 0; n < 3 * s->rest->vertex_count; n++) {
        if (s->base[n / 3]) s->centre[n % 3] += (double)s->rest->position[n / 3][n % 3] / s->count;
    }
    for (int v = 0; v < s->rest->vertex_count; v++) {
        const float *r = s->rest->position[v];
        for (int n = 0; n < 9 && s->base[v]; n++)
            s->spread[n / 3][n % 3] += ((double)r[n / 3] - s->centre[n / 3]) * ((double)r[n % 3] - s->centre[n % 3]);
    }
}

static double size_of(const struct survey *s) { return s->spread[0][0] + s->spread[1][1] + s->spread[2][2]; }

/// Degree of the slow part of an unknown base, and frames of the records in which it is sought; it is the highest in others.
enum { SLOW_DEGREE = 3, LONGEST = 1024 };

enum { PATH = 7 }; ///< x̄ of a frame, and its quaternion times twice the reach, as lengths

/// Replaces rows of the path by least-squares polynomials: the slow part. False if that is small beside the rest.
static bool keep_slow(double *path, int rows, int frames, int degree)
{
    enum { POWERS = SLOW_DEGREE + 1 };
    struct basis basis;
    double *power = need((size_t)frames, sizeof *power), along = 0, left = 0;
    basis_create(&basis, frames, POWERS);
    for (int k = 0; k <= degree; k++) {
        for (int t = 0; t < frames; t++) power[t] = pow((double)t / frames, k);
        basis_append(&basis, power);
    }
    for (double *row = path; row < path + (size_t)rows * (size_t)frames; row += frames) {
        double part[POWERS];
        left += maths_dot(row, row, frames);
        for (int k = 0; k <= degree; k++) {
            part[k] = maths_dot(row, basis.q + (size_t)k * (size_t)frames, frames);
            left -= part[k] * part[k];
            along += k > 0 ? part[k] * part[k] : 0;
        }
        for (int t = 0; t < frames; t++) {
            row[t] = 0;
            for (int k = 0; k <= degree; k++) row[t] += part[k] * basis.q[k * frames + t];
        }
    }
    pool_free(&basis.pool);
    free(power);
    return along > least_slow * left;
}

/// The rotation by a unit quaternion.
static void set_turn(const double q[4], double turn[3][3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        turn[a][a] = q[0] * q[0] + q[1 + a] * q[1 + a] - q[1 + b] * q[1 + b] - q[1 + c] * q[1 + c];
        turn[a][b] = 2 * (q[1 + a] * q[1 + b] - q[0] * q[1 + c]);
        turn[b][a] = 2 * (q[1 + a] * q[1 + b] + q[0] * q[1 + c]);
    }
}

/// R and p of every frame from the path.
static void place_frames(struct rigid *rigid, const struct survey *s, const double *path, int frames)
{
    const double reach = sqrt(size_of(s) / s->count);
    double moved = 0, first[4];
    rigid->travel = rigid->angle = 0;
    for (int t = 0; t < frames; t++) {
        double q[4], square = 0, same = 0, travel = 0, away = 0, (*turn)[3] = rigid->turn[t];
        for (int i = 0; i < 4; i++) square += pow(path[(3 + i) * frames + t], 2);
        for (int i = 0; i < 4; i++) {
            q[i] = path[(3 + i) * frames + t] / sqrt(square);
            first[i] = t == 0 ? q[i] : first[i];
            same += q[i] * first[i];
        }
        set_turn(q, turn);
        for (int a = 0; a < 3; a++) {
            const double at = path[a * frames + t];
            rigid->place[t][a] =
                at - turn[a][0] * s->centre[0] - turn[a][1] * s->centre[1] - turn[a][2] * s->centre[2];
            travel += pow(at - path[a * frames], 2);
            away += pow(at - s->centre[a], 2);
        }
        rigid->travel = fmax(rigid->travel, sqrt(travel));
        rigid->angle = fmax(rigid->angle, 2 * acos(fmin(fabs(same), 1)) * 180 / M_PI);
        moved = fmax(moved, sqrt(away) + 2 * reach * sqrt(fmax(1 - q[0] * q[0], 0)));
    }
    rigid->frames = moved > nothing * reach ? frames : 0;
}

/// The degree of the curve that is the slow part of an unknown base: the periods that the mesh swings by itself, seen from its own rigid
/// motion, in the record. A curve of a higher one takes some of the swing along. −1 on an error.
static int find_degree(const struct rigid *rigid, const struct lapack *lapack, const struct motion *motion,
                       struct error *error)
{
    const size_t n = (size_t)motion->frames;
    if (n < ANALYSIS_FRAMES_MIN || n > LONGEST) return SLOW_DEGREE;
    double *gram = need(n * n + n, sizeof *gram), *ones = gram + n * n;
    struct pole poles[SUBSPACE_POLES_MAX];
    struct basis basis;
    basis_create(&basis, motion->frames, 3);
    for (size_t t = 0; t < n; t++) ones[t] = 1;
    basis_append(&basis, ones);
    int degree = slabs_gram(lapack, motion, rigid, gram, NULL, error) ? SLOW_DEGREE : -1;
    const int found = degree > 0 ? subspace_poles(lapack, gram, motion->frames, poles) : 0;
    if (found > 0 && exponentials_choose(poles, found, 1, 0, gram, &basis) > 0)
        degree = (int)fmin(fmax(round(carg(poles[0].z) * motion->frames / (2 * M_PI)), 1), SLOW_DEGREE);
    pool_free(&basis.pool);
    free(gram);
    return degree;
}

/// Fits all frames. Of an unknown base, only the slow part counts: the rest may be the swing.
static bool fit_frames(struct rigid *rigid, const struct lapack *lapack, const struct survey *s,
                       const struct motion *motion, bool known, struct error *error)
{
    const int frames = motion->frames;
    const double size = size_of(s), reach = sqrt(size / s->count);
    double *path = need(PATH * (size_t)frames, sizeof *path), before[4] = {1}, turn_mean[3][3] = {{0}}, mean[3] = {0};
    for (int t = 0; t < frames; t++) {
        double k[16] = {0}, values[4], vectors[16], same = 0, (*m)[3] = s->moment[t];
        const double *q = vectors + 12; // of the largest value
        for (int a = 0; a < 3; a++) {   // Horn's matrix
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            k[0] += m[a][a];
            k[1 + a] = k[4 * (1 + a)] = m[b][c] - m[c][b];
            k[5 * (1 + a)] = m[a][a] - m[b][b] - m[c][c];
            k[4 * (1 + a) + 1 + b] = k[4 * (1 + b) + 1 + a] = m[a][b] + m[b][a];
        }
        k[0] += identity * size;
        symmetric_eigen(4, k, values, vectors);
        for (int i = 0; i < 4; i++) same += q[i] * before[i];
        for (int i = 0; i < 4; i++) {
            before[i] = copysign(1, same) * q[i];
            path[(3 + i) * frames + t] = (reach > 0 ? 2 * reach : 1) * before[i];
        }
        for (int a = 0; a < 3; a++) path[a * frames + t] = s->mean[t][a];
        double turn[3][3];
        set_turn(before, turn);
        for (int n = 0; n < 9; n++) turn_mean[n / 3][n % 3] += turn[n / 3][n % 3] / frames;
        for (int a = 0; a < 3; a++) mean[a] += s->mean[t][a] / frames;
    }
    rigid->base_unknown = !known;
    rigid->turn = pool_take(&rigid->pool, (size_t)frames, sizeof *rigid->turn);
    rigid->place = pool_take(&rigid->pool, (size_t)frames, sizeof *rigid->place);
    bool done = true, follows = true;
    if (known) {
        // A base whose vertices tremble seems to turn, and what is far from it swings with that. With m the mean over the frames, r' = r − r̄,
        // x' = x − x̄ and S = Σ r' r'ᵀ, the turn explains Σ |(R − m(R)) r'|² = n tr(S − m(R) S m(R)ᵀ) of Σ |x' − m(x')|². Of what is left,
        // trembling in 3 N − 6 ways, 3 more would explain as much as each of those.
        double turning = size * frames, left = s->scatter;
        for (int n = 0; n < 27; n++)
            turning -= frames * turn_mean[n / 9][n / 3 % 3] * s->spread[n / 3 % 3][n % 3] * turn_mean[n / 9][n % 3];
        for (int t = 0; t < frames; t++)
            for (int a = 0; a < 3; a++) left -= s->count * pow(s->mean[t][a] - mean[a], 2);
        left = fmax(left - turning, 0) / fmax(s->count - 2, 1);
        if (!(turning > certain * left)) keep_slow(path + 3 * (size_t)frames, PATH - 3, frames, 0);
    } else {
        place_frames(rigid, s, path, frames);
        const int degree = find_degree(rigid, lapack, motion, error);
        done = degree >= 0;
        follows = done && keep_slow(path, PATH, frames, degree);
        rigid->frames = 0;
    }
    if (follows) place_frames(rigid, s, path, frames);
    free(path);
    return done;
}

bool rigid_find(struct rigid *rigid, const struct lapack *lapack, const struct motion *motion,
                const struct surface *rest, const bool *base, struct error *error)
{
    const size_t frames = (size_t)motion->frames, vertices = (size_t)rest->vertex_count;
    struct survey s = {.rest = rest};
    struct pool work = {0};
    uint8_t *used = surface_used_vertices(rest);
    *rigid = (struct rigid){0};
    s.base = pool_take(&work, vertices + 1, sizeof *s.base);
    s.moment = pool_take(&work, frames, sizeof *s.moment);
    s.mean = pool_take(&work, frames, sizeof *s.mean);
    s.extent = pool_take(&work, vertices + 1, sizeof *s.extent);
    rigid->whole = true;
    for (size_t v = 0; v < vertices; v++) {
        s.base[v] = used[v] && (!base || base[v]);
        rigid->whole &= s.base[v] == used[v];
    }
    measure_rest(&s);
    bool done = true;
    if (s.count > 0) {
        struct slab slab = slab_start(motion);
        while (slab_next(&slab, error)) {
            for (int v = slab.first / 3; v < (slab.first + slab.count) / 3; v++) {
                const double *x = slab.numbers + 3 * v - slab.first;
                double low[3], high[3], sum[3] = {0};
                for (int c = 0; c < 3; c++) low[c] = INFINITY, high[c] = -INFINITY;
                for (int t = 0; t < motion->frames; t++, x += slab.count) {
                    for (int c = 0; c < 3; c++) {
                        low[c] = fmin(low[c], x[c]);
                        high[c] = fmax(high[c], x[c]);
                    }
                    for (int a = 0; s.base[v] && a < 3; a++) {
                        const double away = (double)rest->position[v][a] - s.centre[a];
                        const double moved = x[a] - (double)rest->position[v][a];
                        sum[a] += moved;
                        s.scatter += moved * moved;
                        s.mean[t][a] += x[a] / s.count;
                        for (int b = 0; b < 3; b++) s.moment[t][a][b] += away * x[b];
                    }
                }
                for (int c = 0; c < 3; c++) {
                    s.extent[v] += (high[c] - low[c]) * (high[c] - low[c]);
                    s.scatter -= sum[c] * sum[c] / motion->frames;
                }
            }
        }
        done = slab_end(&slab);
    }

    // Resting vertices may hold the mesh, unless they lie on a point or a line: then it can still turn.
    bool held = false;
    if (done && !base) {
        struct survey still_ones = {.rest = rest, .base = pool_take(&work, vertices + 1, sizeof *s.base)};
        double largest = 0, area = 0;
        for (size_t v = 0; v < vertices; v++) largest = fmax(largest, s.base[v] ? s.extent[v] : 0);
        for (size_t v = 0; v < vertices; v++)
            still_ones.base[v] = s.base[v] && s.extent[v] <= still * still * largest;
        measure_rest(&still_ones);
        const double size = size_of(&still_ones), (*spread)[3] = (const double(*)[3])still_ones.spread;
        for (int a = 0; a < 3; a++) { // the second of the spread's invariants
            const int b = (a + 1) % 3;
            area += spread[a][a] * spread[b][b] - spread[a][b] * spread[a][b];
        }
        held = still_ones.count > 0 && area > straight * size * size;
    }
    if (done && s.count > 0 && !held) done = fit_frames(rigid, lapack, &s, motion, base, error);
    free(used);
    pool_free(&work);
    return done;
}

double rigid_share(const double complex (*shape)[3], const struct surface *rest)
{
    enum { TURN = 3, MOTIONS = 6, FEWEST = 4 };
    const int columns = 3 * rest->vertex_count;
    const size_t room = (size_t)columns;
    uint8_t *used = surface_used_vertices(rest);
    double *weights = need((MOTIONS + 2) * room, sizeof *weights), *part = weights + MOTIONS * room;
    double *size = part + room, whole = 0, left = 0;

    // Of the vertices that faces use, those that move least.
    int count = 0;
    for (int v = 0; v < rest->vertex_count; v++) {
        size[v] = 0;
        for (int c = 0; c < 3; c++) size[v] += creal(shape[v][c] * conj(shape[v][c]));
        if (used[v]) part[count++] = size[v];
    }
    qsort(part, (size_t)count, sizeof *part, maths_compare);
    const double most = count > 0 ? part[(int)fmin(fmax(calm_part * count, FEWEST), count) - 1] : 0;

    // Weights that fit small rigid motions to those: translations, and turns e × r.
    struct basis basis;
    basis_create(&basis, columns, MOTIONS);
    for (int m = 0; m < MOTIONS; m++) {
        const int a = m % 3, b = (a + 1) % 3, c = (a + 2) % 3;
        for (int v = 0; v < rest->vertex_count; v++) {
            const float *r = rest->position[v];
            const bool calm = used[v] && size[v] <= most;
            part[3 * v + a] = calm && m < TURN;
            part[3 * v + b] = calm && m >= TURN ? -(double)r[c] : 0;
            part[3 * v + c] = calm && m >= TURN ? (double)r[b] : 0;
        }
        basis_append(&basis, part);
    }
    basis_weights(&basis, weights);
    for (int imaginary = 0; imaginary < 2; imaginary++) {
        double along[MOTIONS];
        for (int n = 0; n < columns; n++)
            part[n] = imaginary ? cimag(shape[n / 3][n % 3]) : creal(shape[n / 3][n % 3]);
        for (size_t m = 0; m < MOTIONS; m++) along[m] = maths_dot(weights + m * room, part, columns);
        for (int n = 0; n < columns; n++) {
            if (!used[n / 3]) continue;
            const int a = n % 3, b = (a + 1) % 3, c = (a + 2) % 3;
            const float *r = rest->position[n / 3];
            const double rigid = along[a] + along[TURN + b] * (double)r[c] - along[TURN + c] * (double)r[b];
            whole += part[n] * part[n];
            left += (part[n] - rigid) * (part[n] - rigid);
        }
    }
    pool_free(&basis.pool);
    free(weights);
    free(used);
    return whole > 0 ? fmax(1 - left / whole, 0) : 0;
}

/// The next slab as the analysis has it: seen from the base, without each column's mean, which goes to `means` unless that is NULL.
static bool read_seen_from(struct slab *slab, const struct rigid *base, double *means, struct error *error)
{
    if (!slab_next(slab, error)) return false;
    const int frames = slab->motion->frames, count = slab->count;
    for (int t = 0; base && t < base->frames; t++) { // y = Rᵀ (x − p)
        const double(*r)[3] = (const double(*)[3])base->turn[t], *p = base->place[t];
        for (double *x = slab->numbers + (size_t)t * (size_t)count, *end = x + count; x < end; x += 3) {
            const double away[3] = {x[0] - p[0], x[1] - p[1], x[2] - p[2]};
            for (int c = 0; c < 3; c++) x[c] = r[0][c] * away[0] + r[1][c] * away[1] + r[2][c] * away[2];
        }
    }
    for (int j = 0; j < count; j++) {
        double sum = 0, *column = slab->numbers + j;
        for (int i = 0; i < frames; i++) sum += column[(size_t)i * (size_t)count];
        double mean = sum / frames;
        if (means) means[slab->first + j] = mean;
        for (int i = 0; i < frames; i++) column[(size_t)i * (size_t)count] -= mean;
    }
    return true;
}

bool slabs_gram(const struct lapack *lapack, const struct motion *motion, const struct rigid *base, double *gram,
                double *means, struct error *error)
{
    size_t n = (size_t)motion->frames;
    struct slab slab = slab_start(motion);
    for (size_t i = 0; i < n * n; i++) gram[i] = 0;
    while (read_seen_from(&slab, base, means, error))
        lapack->dsyrk(LAPACK_ROWS_FIRST, BLAS_LOWER, BLAS_PLAIN, motion->frames, slab.count, 1, slab.numbers,
                      slab.count, 1, gram, motion->frames);
    if (!slab_end(&slab)) return false;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i + 1; j < n; j++) gram[i * n + j] = gram[j * n + i];
    }
    return true;
}

bool slabs_combine(const struct lapack *lapack, const struct motion *motion, const struct rigid *base,
                   const double *weights, int rows, double *combined, struct error *error)
{
    struct slab slab = slab_start(motion);
    while (read_seen_from(&slab, base, NULL, error))
        lapack->dgemm(LAPACK_ROWS_FIRST, BLAS_PLAIN, BLAS_PLAIN, rows, slab.count, motion->frames, 1, weights,
                      motion->frames, slab.numbers, slab.count, 0, combined + slab.first, slab.columns);
    return slab_end(&slab);
}
