/// Solves ill-conditioned systems by Givens rotations of the rows themselves.
//
// A row touches at most three neighbouring samples, so U of Q U = R is as narrow as the band:
//
//     | U00 U01 U02             |   Row by row: a rotation takes a row's first entry into the row of U that begins there, until
//     |     U11 U12 U13         |   none begins where the rest of it does. In hand are the rows of U that begin at x_k, x_{k+1},
//     |         U22 U23 U24     |   x_{k+2}. Once all rows that begin at x_k are in, U_k* is done.
//     |             U33 U34 U35 |
//
// In a loop the last two samples, the seam, have their own columns at the right and stay to the end. A rotation involves only two rows, so a
// stiff slope row does not drown the soft ones. As Uᵀ U = L S Lᵀ, the results are U_kk⁻¹, the root of S_k⁻¹, and
// L_ik = (U_kk⁻¹ U_ki)ᵀ.
#include "spline/system.h"
#include <math.h>
#include <string.h>

enum { COLUMNS = 10, SEAM = 6 };

/// A smaller pivot is rounding, because each column had a 1 from a jet. What holds Im x of a slow spline of N samples is N⁻² of it.
static const double lost = 1e-13;

typedef struct walk {
    const system_rows *rows;
    int interior;               ///< samples before the seam
    int k;                      ///< the sample being eliminated
    int slope;                  ///< the next slope row
    double u[COLUMNS][COLUMNS]; ///< of x_k, x_{k+1}, x_{k+2} and, from SEAM on, the seam: re and im of each
} walk;

static bool is_fixed(const walk *w, int sample, int part)
{
    return w->rows->fixed[sample] & (part ? FIXED_IM : FIXED_RE);
}

/// Sets a row's coefficient; fixed unknowns have none.
static void put(const walk *w, double *row, int sample, int part, double value)
{
    const int n = w->rows->count, at = sample < 0 ? sample + n : sample >= n ? sample - n : sample;
    const int column = at >= w->interior ? SEAM + 2 * (at - w->interior) : 2 * (at - w->k);
    if (!is_fixed(w, at, part)) row[column + part] += value;
}

/// Rotates a row into U; its content is lost.
static void take_row(walk *w, double *row)
{
    for (int c = 0; c < COLUMNS; c++) {
        double *u = w->u[c];
        if (row[c] == 0) continue;
        if (u[c] == 0) {
            memcpy(u, row, sizeof w->u[c]);
            return;
        }
        const double size = sqrt(u[c] * u[c] + row[c] * row[c]), cosine = u[c] / size, sine = row[c] / size;
        for (int j = c; j < COLUMNS; j++) {
            const double above = u[j];
            u[j] = cosine * above + sine * row[j];
            row[j] = cosine * row[j] - sine * above;
        }
        row[c] = 0;
    }
}

/// Adds a complex row (two real ones, or one outside complex mode) of coefficients on n samples.
static void add_row(walk *w, double weight, int n, const int *samples, const cplx *c)
{
    const double root = sqrt(weight);
    double re[COLUMNS] = {0}, im[COLUMNS] = {0};
    for (int i = 0; i < n; i++) {
        put(w, re, samples[i], 0, root * c[i].re);
        put(w, re, samples[i], 1, -root * c[i].im);
        put(w, im, samples[i], 0, root * c[i].im);
        put(w, im, samples[i], 1, root * c[i].re);
    }
    take_row(w, re);
    if (w->rows->is_complex) take_row(w, im);
}

static void add_jet(walk *w, int i)
{
    const system_rows *rows = w->rows;
    int n = rows->count;
    cplx a = coefficients_a(&rows->at[i]), b = coefficients_b(&rows->at[i]);
    bool has_before = rows->loop || i > 0, has_after = rows->loop || i < n - 1;
    if (!has_after) a = (cplx){a.re - 1 - rows->tail.re, a.im - rows->tail.im};
    const cplx one = {1, 0};
    if (rows->fixed[i] & FIXED_STILL) { // two rows
        if (has_before) add_row(w, rows->jet_weight[i], 1, (int[]){i - 1}, &b);
        if (has_after) add_row(w, rows->jet_weight[i], 1, (int[]){i + 1}, &one);
        return;
    }
    int samples[3] = {i}, count = 1;
    cplx c[3] = {{-a.re, -a.im}};
    if (has_before) samples[count] = i - 1, c[count++] = b;
    if (has_after) samples[count] = i + 1, c[count++] = one;
    add_row(w, rows->jet_weight[i], count, samples, c);
}

static void add_slope(walk *w, const slope_row *slope)
{
    const stencil s = system_slope_stencil(w->rows, slope);
    const int at[3] = {s.before, s.at, s.after};
    const double root = sqrt(slope->weight);
    double row[COLUMNS] = {0};
    for (int i = 0; i < 3; i++) {
        if (at[i] < 0 || (s.c[i].re == 0 && s.c[i].im == 0)) continue;
        put(w, row, at[i], 0, root * s.c[i].re);
        put(w, row, at[i], 1, -root * s.c[i].im);
    }
    take_row(w, row);
}

static void add_imaginary(walk *w, int sample)
{
    double row[COLUMNS] = {0};
    put(w, row, sample, 1, sqrt(w->rows->im_weight[sample]));
    take_row(w, row);
}

static void add_start(walk *w)
{
    for (int i = 0; i < 2; i++) {
        const struct start_row *row = &w->rows->start.row[i];
        if (row->weight > 0)
            add_row(w, row->weight, 2, (int[]){0, 1}, (cplx[]){cplx_sub(row->on_x, row->on_e), row->on_e});
    }
}

/// The first sample of a slope row.
static int first_of(const slope_row *slope)
{
    return slope->behind.re == 0 && slope->behind.im == 0 ? slope->sample : slope->sample - 1;
}

/// Whether a row begins in the seam: it is then added in the first step.
static bool begins_in_seam(const walk *w, const slope_row *slope)
{
    const int first = first_of(slope);
    return first < 0 || first >= w->interior;
}

/// Adds all rows whose first interior sample is x_k; in the first step also those that begin in the seam.
static void add_rows(walk *w)
{
    const system_rows *rows = w->rows;
    if (w->k == 0) {
        if (rows->jet_from == 0) add_jet(w, 0);
        if (rows->loop) add_jet(w, rows->count - 1);
        for (int s = 0; s < rows->slope_count; s++) {
            if (begins_in_seam(w, &rows->slopes[s])) add_slope(w, &rows->slopes[s]);
        }
        for (int sample = w->interior; sample < rows->count; sample++) add_imaginary(w, sample);
    }
    if (w->k + 1 <= rows->jet_to && w->k + 1 < rows->count - (rows->loop ? 1 : 0)) add_jet(w, w->k + 1);
    add_imaginary(w, w->k);
    for (; w->slope < rows->slope_count && first_of(&rows->slopes[w->slope]) <= w->k; w->slope++) {
        if (!begins_in_seam(w, &rows->slopes[w->slope])) add_slope(w, &rows->slopes[w->slope]);
    }
    if (w->k == 0) add_start(w);
}

/// Checks the pivots of a sample, from column `c` on; those of fixed unknowns are 1.
static pentadiagonal_rank close_sample(walk *w, int sample, int c)
{
    pentadiagonal_rank rank = RANK_FULL;
    for (int part = 0; part < 2; part++) {
        double *pivot = &w->u[c + part][c + part];
        if (is_fixed(w, sample, part)) *pivot = 1;
        if (!(fabs(*pivot) > 0 && fabs(*pivot) < INFINITY)) return RANK_BROKEN;
        if (fabs(*pivot) < lost) rank = RANK_WEAK;
    }
    return rank;
}

/// Stores U_k's row and goes on to the next sample.
static void finish_step(walk *w, pentadiagonal *m)
{
    double(*u)[COLUMNS] = w->u, *d = m->diagonal + 3 * w->k;
    double *const to[] = {m->below + 4 * w->k, m->below2 + 4 * w->k, m->border + BORDER_ROW * w->k};
    d[0] = 1 / u[0][0], d[2] = 1 / u[1][1], d[1] = -u[0][1] * d[0] * d[2];
    for (int c = 2; c < (m->cyclic ? COLUMNS : SEAM); c++) {
        double *at = c < SEAM ? to[c / 2 - 1] + 2 * (c % 2) : to[2] + 2 * (c - SEAM);
        at[0] = u[0][c], at[1] = u[1][c];
    }
    for (int r = 0; r < SEAM; r++) {
        const bool is_new = r + 2 >= SEAM;
        for (int c = 0; c < COLUMNS; c++) {
            const int from = c < SEAM ? c + 2 : c;
            u[r][c] = is_new || (c < SEAM && from >= SEAM) ? 0 : u[r + 2][from];
        }
    }
}

pentadiagonal_rank orthogonal_factor(const system_rows *rows, pentadiagonal *m)
{
    walk w = {.rows = rows, .interior = rows->loop ? rows->count - 2 : rows->count};
    m->count = rows->count;
    m->is_complex = rows->is_complex;
    m->cyclic = rows->loop;
    m->is_rooted = true;
    pentadiagonal_rank rank = RANK_FULL;
    for (w.k = 0; w.k < rows->count; w.k++) {
        const bool in_seam = w.k >= w.interior;
        if (!in_seam) add_rows(&w);
        const pentadiagonal_rank step = close_sample(&w, w.k, in_seam ? SEAM + 2 * (w.k - w.interior) : 0);
        rank = step < rank ? step : rank;
        if (rank == RANK_BROKEN) return rank;
        if (!in_seam) finish_step(&w, m);
    }
    for (int r = 0; r < BORDER_MAX; r++) {
        for (int c = 0; c <= r; c++) m->corner[r][c] = w.u[SEAM + c][SEAM + r];
    }
    return rank;
}
