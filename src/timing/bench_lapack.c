/// A solver's system in LAPACK's storage, and the times of LAPACK's banded solvers.
#include "timing/bench_lapack.h"
#include "base/clock.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { KD = 5, COMPLEX_KD = 2 };

bool banded_create(struct banded *b, int samples)
{
    size_t n = (size_t)samples, band = 2 * n * (KD + 1), right = 2 * n * (1 + MOST_BORDER);
    *b = (struct banded){.samples = samples,
                         .band = calloc(2 * (band + right), sizeof(double)),
                         .hermitian = calloc(n * (COMPLEX_KD + 2), sizeof(double complex))};
    if (!b->band || !b->hermitian) return false;
    b->right = b->band + band;
    b->band_copy = b->right + right;
    b->right_copy = b->band_copy + band;
    b->hermitian_right = b->hermitian + n * (COMPLEX_KD + 1);
    return true;
}

void banded_destroy(struct banded *b)
{
    free(b->band);
    free(b->hermitian);
}

/// A number of a block below the diagonal.
static double below(const double *blocks, int block, int width, int row, int column)
{
    return width == 2 ? blocks[4 * block + 2 * row + column] : blocks[block];
}

static double on_diagonal(const pentadiagonal *m, int block, int row, int column)
{
    return m->width == 2 ? m->diagonal[3 * block + row + column] : m->diagonal[block];
}

/// Entries that would stand below the last row are never read.
static void fill_band(struct banded *b, const pentadiagonal *m)
{
    int width = m->width, kd = b->band_width;
    memset(b->band, 0, sizeof(double) * (size_t)(b->unknowns * (kd + 1)));
    for (int k = 0; k < b->unknowns / width; k++) {
        for (int part = 0; part < width; part++) {
            double *column = b->band + (size_t)(width * k + part) * (size_t)(kd + 1);
            for (int row = part; row < width; row++) column[row - part] = on_diagonal(m, k, row, part);
            for (int row = 0; row < width; row++) {
                column[width + row - part] = below(m->below, k, width, row, part);
                column[2 * width + row - part] = below(m->below2, k, width, row, part);
            }
        }
    }
}

/// Puts the block of a sample of the band and one of the border, of which `rows` says whether it belongs to the rows of `blocks`.
static void put_border(struct banded *b, const double *blocks, int block, int sample, int of_border, bool rows)
{
    for (int i = 0; i < b->width; i++) {
        for (int j = 0; j < b->width; j++) {
            int column = 1 + b->width * of_border + j;
            b->right[(size_t)column * (size_t)b->unknowns + (size_t)(b->width * sample + i)] =
                rows ? below(blocks, block, b->width, j, i) : below(blocks, block, b->width, i, j);
        }
    }
}

/// What couples the last two samples with the others, and with each other.
static void fill_border(struct banded *b, const pentadiagonal *m)
{
    int n = m->count, width = m->width;
    memset(b->right + b->unknowns, 0, sizeof(double) * (size_t)b->border * (size_t)b->unknowns);
    put_border(b, m->below2, n - 4, n - 4, 0, true);
    put_border(b, m->below, n - 3, n - 3, 0, true);
    put_border(b, m->below2, n - 3, n - 3, 1, true);
    put_border(b, m->below2, n - 2, 0, 0, false);
    put_border(b, m->below, n - 1, 0, 1, false);
    put_border(b, m->below2, n - 1, 1, 1, false);
    for (int i = 0; i < width; i++) {
        for (int j = 0; j < width; j++) {
            b->corner[i][j] = on_diagonal(m, n - 2, i, j);
            b->corner[width + i][width + j] = on_diagonal(m, n - 1, i, j);
            b->corner[width + i][j] = b->corner[j][width + i] = below(m->below, n - 2, width, i, j);
        }
    }
}

void banded_fill(struct banded *b, wiggly_solver *solver)
{
    const pentadiagonal *m = &solver->matrix;
    system_gradient(&solver->rows);
    b->width = m->width;
    b->band_width = m->width == 2 ? KD : 2;
    b->border = m->cyclic ? 2 * m->width : 0;
    b->unknowns = m->width * m->count - b->border;
    fill_band(b, m);
    memcpy(b->right, solver->rows.gradient, sizeof(double) * (size_t)b->unknowns);
    if (!b->border) return;
    fill_border(b, m);
    memcpy(b->corner_right, solver->rows.gradient + b->unknowns, sizeof(double) * (size_t)b->border);
}

/// Solves a small symmetric positive definite system by Cholesky's method.
static void solve_corner(double s[MOST_BORDER][MOST_BORDER], double *x, int n)
{
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < j; k++) s[j][j] -= s[j][k] * s[j][k];
        s[j][j] = sqrt(s[j][j]);
        for (int i = j + 1; i < n; i++) {
            for (int k = 0; k < j; k++) s[i][j] -= s[i][k] * s[j][k];
            s[i][j] /= s[j][j];
        }
    }
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++) x[i] -= s[i][k] * x[k];
        x[i] /= s[i][i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) x[i] -= s[k][i] * x[k];
        x[i] /= s[i][i];
    }
}

/// Product of a column of the border with a solution: only its first two samples and its last two are not 0.
static double border_product(const struct banded *b, int border, const double *solution)
{
    const double *column = b->right + (size_t)(1 + border) * (size_t)b->unknowns;
    int ends = 2 * b->width;
    double sum = 0;
    for (int i = 0; i < ends; i++) sum += column[i] * solution[i];
    for (int i = b->unknowns - ends; i < b->unknowns; i++) sum += column[i] * solution[i];
    return sum;
}

/// From the solutions of the band for all right-hand sides to that of the whole.
static void solve_border(struct banded *b)
{
    size_t n = (size_t)b->unknowns;
    double schur[MOST_BORDER][MOST_BORDER];
    for (int i = 0; i < b->border; i++) {
        b->corner_solution[i] = b->corner_right[i] - border_product(b, i, b->right_copy);
        for (int j = 0; j <= i; j++)
            schur[i][j] = b->corner[i][j] - border_product(b, i, b->right_copy + (size_t)(1 + j) * n);
    }
    solve_corner(schur, b->corner_solution, b->border);
    for (int i = 0; i < b->border; i++) {
        const double *column = b->right_copy + (size_t)(1 + i) * n;
        for (size_t k = 0; k < n; k++) b->right_copy[k] -= b->corner_solution[i] * column[k];
    }
}

double banded_solve(struct banded *b, const struct lapack *lapack)
{
    int columns = 1 + b->border;
    memcpy(b->band_copy, b->band, sizeof(double) * (size_t)b->unknowns * (size_t)(b->band_width + 1));
    memcpy(b->right_copy, b->right, sizeof(double) * (size_t)b->unknowns * (size_t)columns);
    double start = clock_now();
    int info = lapack->dpbsv(LAPACK_COLUMNS_FIRST, 'L', b->unknowns, b->band_width, columns, b->band_copy,
                             b->band_width + 1, b->right_copy, b->unknowns);
    if (info == 0 && b->border) solve_border(b);
    double time = clock_now() - start;
    return info == 0 ? time : NAN;
}

double banded_solve_hermitian(struct banded *b, const struct lapack *lapack, const wiggly_solver *solver)
{
    const system_rows *rows = &solver->rows;
    int n = rows->count;
    memset(b->hermitian, 0, sizeof(double complex) * (size_t)(n * (COMPLEX_KD + 1)));
    for (int i = 1; i < n - 1; i++) {
        double complex a = 2 + rows->at[i].m.re + rows->at[i].m.im * I,
                       beta = a - 1 + rows->at[i].p.re + rows->at[i].p.im * I;
        double complex *before = b->hermitian + (i - 1) * 3, *here = before + 3, *after = here + 3;
        before[0] += conj(beta) * beta, before[1] -= conj(a) * beta, before[2] += beta;
        here[0] += conj(a) * a, here[1] -= a;
        after[0] += 1;
    }
    for (int i = 0; i < n; i++) b->hermitian[3 * i] += rows->fixed[i] ? 1e3 : 1e-9, b->hermitian_right[i] = 1;
    double start = clock_now();
    int info = lapack->zpbsv(LAPACK_COLUMNS_FIRST, 'L', n, COMPLEX_KD, 1, b->hermitian, COMPLEX_KD + 1,
                             b->hermitian_right, n);
    double time = clock_now() - start;
    return info == 0 ? time : NAN;
}
