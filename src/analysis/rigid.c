/// Fits the motion of a base to a rigid one, frame by frame.
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
#include "analysis/rigid.h"
#include "analysis/basis.h"
#include "analysis/slabs.h"
#include "base/need.h"
#include <math.h>
#include <stdlib.h>

static const double still = 1e-5;     ///< share of the largest motion of a vertex; a vertex that moves less rests
static const double straight = 1e-6;  ///< share of the squared size; a base with less area is a line
static const double nothing = 1e-6;   ///< share of the base's size; a base that moves less rests, up to rounding
static const double least_slow = 0.2; ///< ratio of slow to fast motion of an unknown base; less is not removed
static const double identity = 1e-7;  ///< weight of no rotation

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

/// Whether the base has no area: the second of the spread's invariants is 0.
static bool is_hinge(const struct survey *s)
{
    double area = 0, size = size_of(s);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        area += s->spread[a][a] * s->spread[b][b] - s->spread[a][b] * s->spread[a][b];
    }
    return area <= straight * size * size;
}

static void add_vertex(struct survey *s, const struct slab *slab, int vertex)
{
    const double *x = slab->numbers + 3 * vertex - slab->first;
    double low[3], high[3];
    for (int c = 0; c < 3; c++) low[c] = INFINITY, high[c] = -INFINITY;
    for (int t = 0; t < slab->motion->frames; t++, x += slab->count) {
        for (int c = 0; c < 3; c++) {
            low[c] = fmin(low[c], x[c]);
            high[c] = fmax(high[c], x[c]);
        }
        if (!s->base[vertex]) continue;
        for (int a = 0; a < 3; a++) {
            const double away = (double)s->rest->position[vertex][a] - s->centre[a];
            s->mean[t][a] += x[a] / s->count;
            for (int b = 0; b < 3; b++) s->moment[t][a][b] += away * x[b];
        }
    }
    for (int c = 0; c < 3; c++) s->extent[vertex] += (high[c] - low[c]) * (high[c] - low[c]);
}

static bool read_motion(struct survey *s, const struct motion *motion, struct error *error)
{
    struct slab slab = slab_start(motion);
    while (slab_next(&slab, error)) {
        for (int v = slab.first / 3; v < (slab.first + slab.count) / 3; v++) add_vertex(s, &slab, v);
    }
    return slab_end(&slab);
}

/// Whether resting vertices hold the mesh. It can still turn about a point or a line.
static bool is_held(const struct survey *all)
{
    const int vertices = all->rest->vertex_count;
    struct survey s = {.rest = all->rest, .base = need((size_t)vertices + 1, sizeof *s.base)};
    double largest = 0;
    for (int v = 0; v < vertices; v++) largest = fmax(largest, all->base[v] ? all->extent[v] : 0);
    for (int v = 0; v < vertices; v++) s.base[v] = all->base[v] && all->extent[v] <= still * still * largest;
    measure_rest(&s);
    free(s.base);
    return s.count > 0 && !is_hinge(&s);
}

/// Horn's quaternion of a frame.
static void fit_turn(const struct lapack *lapack, const double m[3][3], double weight, double q[4])
{
    double k[16] = {0}, values[4];
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        k[0] += m[a][a];
        k[1 + a] = m[b][c] - m[c][b];
        k[5 * (1 + a)] = m[a][a] - m[b][b] - m[c][c];
        k[4 * (1 + (a < b ? a : b)) + 1 + (a < b ? b : a)] = m[a][b] + m[b][a];
    }
    k[0] += weight;
    const bool found = lapack->dsyevd(LAPACK_ROWS_FIRST, 'V', 'U', 4, k, 4, values) == 0;
    for (int i = 0; i < 4; i++) q[i] = found ? k[4 * i + 3] : i == 0; // the last column
}

static void fill_turn(const double q[4], double r[3][3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        r[a][a] = q[0] * q[0] + q[1 + a] * q[1 + a] - q[1 + b] * q[1 + b] - q[1 + c] * q[1 + c];
        r[a][b] = 2 * (q[1 + a] * q[1 + b] - q[0] * q[1 + c]);
        r[b][a] = 2 * (q[1 + a] * q[1 + b] + q[0] * q[1 + c]);
    }
}

enum { PATH = 7 }; ///< x̄ of a frame, and its quaternion times twice the reach, as lengths

/// Replaces each row of the path by its least-squares cubic: the slow part. False if that is small beside the rest.
static bool smooth(double *path, int frames)
{
    enum { POWERS = 4 };
    struct basis basis;
    double *power = need((size_t)frames, sizeof *power), along = 0, left = 0;
    basis_create(&basis, frames, POWERS);
    for (int k = 0; k < POWERS; k++) {
        for (int t = 0; t < frames; t++) power[t] = pow((double)t / frames, k);
        basis_append(&basis, power);
    }
    for (double *row = path; row < path + (size_t)PATH * (size_t)frames; row += frames) {
        double part[POWERS];
        left += basis_dot(row, row, frames);
        for (int k = 0; k < POWERS; k++) {
            part[k] = basis_dot(row, basis.q + (size_t)k * (size_t)frames, frames);
            left -= part[k] * part[k];
            along += k > 0 ? part[k] * part[k] : 0;
        }
        for (int t = 0; t < frames; t++) {
            row[t] = 0;
            for (int k = 0; k < POWERS; k++) row[t] += part[k] * basis.q[k * frames + t];
        }
    }
    basis_free(&basis);
    free(power);
    return along > least_slow * left;
}

/// R and p of every frame from the path.
static void follow(struct rigid *rigid, const struct survey *s, const double *path, double reach, int frames)
{
    double moved = 0, first[4];
    rigid->turn = need((size_t)frames, sizeof *rigid->turn);
    rigid->place = need((size_t)frames, sizeof *rigid->place);
    for (int t = 0; t < frames; t++) {
        double q[4], size = 0, same = 0, travel = 0, away = 0;
        for (int i = 0; i < 4; i++) size += pow(path[(3 + i) * frames + t], 2);
        for (int i = 0; i < 4; i++) {
            q[i] = path[(3 + i) * frames + t] / sqrt(size);
            first[i] = t == 0 ? q[i] : first[i];
            same += q[i] * first[i];
        }
        fill_turn(q, rigid->turn[t]);
        for (int a = 0; a < 3; a++) {
            const double *r = rigid->turn[t][a], mean = path[a * frames + t];
            rigid->place[t][a] = mean - r[0] * s->centre[0] - r[1] * s->centre[1] - r[2] * s->centre[2];
            travel += pow(mean - path[a * frames], 2);
            away += pow(mean - s->centre[a], 2);
        }
        rigid->travel = fmax(rigid->travel, sqrt(travel));
        rigid->angle = fmax(rigid->angle, 2 * acos(fmin(fabs(same), 1)) * 180 / M_PI);
        moved = fmax(moved, sqrt(away) + 2 * reach * sqrt(fmax(1 - q[0] * q[0], 0)));
    }
    rigid->frames = moved > nothing * reach ? frames : 0;
}

/// Fits all frames. Of an unknown base, only the slow part counts: the rest may be the swing.
static void fit(struct rigid *rigid, const struct lapack *lapack, const struct survey *s, int frames, bool known)
{
    const double size = size_of(s), reach = sqrt(size / s->count);
    double *path = need(PATH * (size_t)frames, sizeof *path), before[4] = {1};
    for (int t = 0; t < frames; t++) {
        double q[4], same = 0;
        fit_turn(lapack, (const double(*)[3])s->moment[t], identity * size, q);
        for (int i = 0; i < 4; i++) same += q[i] * before[i];
        for (int i = 0; i < 4; i++) {
            before[i] = copysign(1, same) * q[i];
            path[(3 + i) * frames + t] = (reach > 0 ? 2 * reach : 1) * before[i];
        }
        for (int a = 0; a < 3; a++) path[a * frames + t] = s->mean[t][a];
    }
    rigid->loose = !known;
    if (known || smooth(path, frames)) follow(rigid, s, path, reach, frames);
    free(path);
}

bool rigid_find(struct rigid *rigid, const struct lapack *lapack, const struct motion *motion,
                const struct surface *rest, const bool *base, struct error *error)
{
    const size_t frames = (size_t)motion->frames, vertices = (size_t)rest->vertex_count;
    struct survey s = {.rest = rest};
    uint8_t *used = surface_used_vertices(rest);
    *rigid = (struct rigid){0};
    s.base = need(vertices + 1, sizeof *s.base);
    s.moment = need_zeroed(frames, sizeof *s.moment);
    s.mean = need_zeroed(frames, sizeof *s.mean);
    s.extent = need_zeroed(vertices + 1, sizeof *s.extent);
    rigid->whole = true;
    for (size_t v = 0; v < vertices; v++) {
        s.base[v] = used[v] && (!base || base[v]);
        rigid->whole &= s.base[v] == used[v];
    }
    measure_rest(&s);
    const bool done = s.count == 0 || read_motion(&s, motion, error);
    if (done && s.count > 0 && (base || !is_held(&s))) fit(rigid, lapack, &s, motion->frames, base);
    free(used);
    free(s.base);
    free(s.moment);
    free(s.mean);
    free(s.extent);
    return done;
}

void rigid_free(struct rigid *rigid)
{
    free(rigid->turn);
    free(rigid->place);
    *rigid = (struct rigid){0};
}

void rigid_undo(const struct rigid *rigid, double *numbers, int columns)
{
    for (int t = 0; t < rigid->frames; t++) {
        const double(*r)[3] = (const double(*)[3])rigid->turn[t], *p = rigid->place[t];
        for (double *x = numbers + (size_t)t * (size_t)columns, *end = x + columns; x < end; x += 3) {
            const double away[3] = {x[0] - p[0], x[1] - p[1], x[2] - p[2]};
            for (int c = 0; c < 3; c++) x[c] = r[0][c] * away[0] + r[1][c] * away[1] + r[2][c] * away[2];
        }
    }
}

/// An orthonormal basis of the small rigid motions of all vertices that faces use: translations, and turns e × r.
static void create_motions(struct basis *basis, const struct surface *rest, const uint8_t *used)
{
    enum { TURN = 3, MOTIONS = 6 };
    const int columns = 3 * rest->vertex_count;
    double *motion = need((size_t)columns, sizeof *motion);
    basis_create(basis, columns, MOTIONS);
    for (int m = 0; m < MOTIONS; m++) {
        const int a = m % 3, b = (a + 1) % 3, c = (a + 2) % 3;
        for (int v = 0; v < rest->vertex_count; v++) {
            const float *r = rest->position[v];
            motion[3 * v + a] = used[v] && m < TURN;
            motion[3 * v + b] = used[v] && m >= TURN ? -(double)r[c] : 0;
            motion[3 * v + c] = used[v] && m >= TURN ? (double)r[b] : 0;
        }
        basis_append(basis, motion);
    }
    free(motion);
}

double rigid_share(const double complex (*shape)[3], const struct surface *rest)
{
    const int columns = 3 * rest->vertex_count;
    uint8_t *used = surface_used_vertices(rest);
    double *part = need((size_t)columns, sizeof *part), whole = 0, rigid = 0;
    struct basis basis;
    create_motions(&basis, rest, used);
    for (int imaginary = 0; imaginary < 2; imaginary++) {
        for (int n = 0; n < columns; n++) {
            const double complex u = used[n / 3] ? shape[n / 3][n % 3] : 0;
            part[n] = imaginary ? cimag(u) : creal(u);
        }
        whole += basis_dot(part, part, columns);
        for (int k = 0; k < basis.count; k++)
            rigid += pow(basis_dot(part, basis.q + (size_t)k * (size_t)columns, columns), 2);
    }
    basis_free(&basis);
    free(part);
    free(used);
    return whole > 0 ? rigid / whole : 0;
}
