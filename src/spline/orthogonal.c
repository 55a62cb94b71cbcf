/// Solves long domains by Householder on the rows themselves.
//
// A row touches at most three neighbouring samples, so U is as narrow as the band:
//
//     | U00 U01 U02             |   Sample by sample: the rows that are left from before (they touch x_k and x_{k+1}) and those
//     |     U11 U12 U13         |   that begin at x_k are stacked and made triangular. The top gives the rows U_k*, the rest is
//     |         U22 U23 U24     |   what is left for x_{k+1}.
//     |             U33 U34 U35 |
//
// In a loop the last two samples, the seam, are columns of their own at the right and are solved last. A reflection starts from
// the row with the largest entry, so that stiff slope rows do not wash out soft ones.
#include "spline/system.h"
#include <math.h>
#include <string.h>

enum { COLUMNS = 10, SEAM = 6, MAX_ROWS = 40 };

/// A pivot below this is rounding, every column having had a 1 of a jet in it; what holds Im x of a slow spline of N samples is N⁻² of it.
static const double lost = 1e-13;

/// Rows in hand: columns are x_k, x_{k+1}, x_{k+2} and from SEAM on the seam's two samples, re and im of each.
typedef struct stack {
    double row[MAX_ROWS][COLUMNS];
    int rows;
} stack;

typedef struct walk {
    const system_rows *rows;
    int interior; ///< samples before the seam
    int k;        ///< sample that is being eliminated
    int slope;    ///< next slope row
    stack stack;
} walk;

/// Column of a sample's real part while x_k is being eliminated.
static int column_of(const walk *w, int sample)
{
    int n = w->rows->count;
    if (sample >= n) sample -= n;
    if (sample < 0) sample += n;
    return sample >= w->interior ? SEAM + 2 * (sample - w->interior) : 2 * (sample - w->k);
}

static double *new_row(walk *w)
{
    double *row = w->stack.row[w->stack.rows++];
    memset(row, 0, sizeof w->stack.row[0]);
    return row;
}

/// A complex row (two real ones, or one outside complex mode) of coefficients on n samples, times a weight's root.
static void add_row(walk *w, double root, int n, const int *samples, const cplx *c)
{
    double *re = new_row(w), *im = w->rows->is_complex ? new_row(w) : NULL;
    for (int i = 0; i < n; i++) {
        int column = column_of(w, samples[i]);
        re[column] += root * c[i].re;
        if (!im) continue;
        re[column + 1] -= root * c[i].im;
        im[column] += root * c[i].im;
        im[column + 1] += root * c[i].re;
    }
}

static void add_jet(walk *w, int i)
{
    const system_rows *rows = w->rows;
    int n = rows->count;
    cplx a = coefficients_a(&rows->at[i]), b = coefficients_b(&rows->at[i]);
    double root = sqrt(rows->jet_weight[i]);
    bool has_before = rows->loop || i > 0, has_after = rows->loop || i < n - 1;
    if (!has_after) a = (cplx){a.re - 1 - rows->tail.re, a.im - rows->tail.im};
    int samples[3] = {i}, count = 1;
    cplx c[3] = {{-a.re, -a.im}};
    if (has_before) samples[count] = i - 1, c[count++] = b;
    if (has_after) samples[count] = i + 1, c[count++] = (cplx){1, 0};
    add_row(w, root, count, samples, c);
}

static void add_slope(walk *w, const slope_row *slope)
{
    const stencil s = system_slope_stencil(w->rows, slope);
    const int at[3] = {s.before, s.at, s.after};
    double *row = new_row(w), root = sqrt(slope->weight);
    for (int i = 0; i < 3; i++) {
        if (at[i] < 0 || (s.c[i].re == 0 && s.c[i].im == 0)) continue;
        int column = column_of(w, at[i]);
        row[column] += root * s.c[i].re;
        row[column + 1] -= root * s.c[i].im;
    }
}

static void add_imaginary(walk *w, int sample)
{
    if (w->rows->is_complex) new_row(w)[column_of(w, sample) + 1] = sqrt(w->rows->im_weight[sample]);
}

static void add_start(walk *w)
{
    for (int i = 0; i < 2; i++) {
        const struct start_row *row = &w->rows->start.row[i];
        if (row->weight > 0)
            add_row(w, sqrt(row->weight), 2, (int[]){0, 1}, (cplx[]){cplx_sub(row->on_x, row->on_e), row->on_e});
    }
}

/// The first sample that a slope row touches.
static int first_of(const slope_row *slope)
{
    return slope->behind.re == 0 && slope->behind.im == 0 ? slope->sample : slope->sample - 1;
}

/// Whether a slope row reaches across the seam: then it belongs to the first step.
static bool crosses_seam(const walk *w, const slope_row *slope)
{
    return w->rows->loop && (first_of(slope) < 0 || slope->sample == w->rows->count - 1);
}

/// All rows whose first interior sample is x_k.
static void add_rows(walk *w)
{
    const system_rows *rows = w->rows;
    if (w->k == 0) {
        add_start(w);
        if (rows->jet_from == 0) add_jet(w, 0);
        if (rows->loop) add_jet(w, rows->count - 1);
        for (int s = 0; s < rows->slope_count; s++) {
            if (crosses_seam(w, &rows->slopes[s])) add_slope(w, &rows->slopes[s]);
        }
    }
    if (w->k + 1 <= rows->jet_to && w->k + 1 < rows->count - (rows->loop ? 1 : 0)) add_jet(w, w->k + 1);
    add_imaginary(w, w->k);
    for (; w->slope < rows->slope_count && first_of(&rows->slopes[w->slope]) <= w->k; w->slope++) {
        if (!crosses_seam(w, &rows->slopes[w->slope])) add_slope(w, &rows->slopes[w->slope]);
    }
}

static bool is_fixed(const walk *w, int sample, int part)
{
    return w->rows->fixed[sample] & (part ? FIXED_IM : FIXED_RE);
}

static void clear_column(walk *w, int column)
{
    for (int r = 0; r < w->stack.rows; r++) w->stack.row[r][column] = 0;
}

static void clear_fixed(walk *w)
{
    for (int s = 0; s < 3; s++) {
        int sample = w->k + s;
        for (int part = 0; part < 2 && sample < w->interior; part++) {
            if (is_fixed(w, sample, part)) clear_column(w, 2 * s + part);
        }
    }
    for (int s = w->interior; s < w->rows->count; s++) {
        for (int part = 0; part < 2; part++) {
            if (is_fixed(w, s, part)) clear_column(w, column_of(w, s) + part);
        }
    }
}

static void swap_rows(stack *s, int a, int b)
{
    double kept[COLUMNS];
    memcpy(kept, s->row[a], sizeof kept);
    memcpy(s->row[a], s->row[b], sizeof kept);
    memcpy(s->row[b], kept, sizeof kept);
}

/// Reflects rows `top` … so that column `c` is 0 below `top`. false where the column is 0 already, top included, or not finite.
static bool reflect(walk *w, int top, int c)
{
    stack *s = &w->stack;
    int largest = top;
    for (int r = top + 1; r < s->rows; r++) {
        if (fabs(s->row[r][c]) > fabs(s->row[largest][c])) largest = r;
    }
    if (top >= s->rows || s->row[largest][c] == 0) return false;
    swap_rows(s, top, largest);
    double *pivot = s->row[top], below = 0;
    for (int r = top + 1; r < s->rows;
         r++) { // the reflection's vector is (1 + length, v…), v kept in the column itself
        s->row[r][c] /= pivot[c];
        below += s->row[r][c] * s->row[r][c];
    }
    double length = sqrt(1 + below), head = 1 + length, scale = 1 / (length * head);
    for (int j = c + 1; j < COLUMNS; j++) {
        double dot = head * pivot[j];
        for (int r = top + 1; r < s->rows; r++) dot += s->row[r][c] * s->row[r][j];
        dot *= scale;
        pivot[j] -= head * dot;
        for (int r = top + 1; r < s->rows; r++) s->row[r][j] -= s->row[r][c] * dot;
    }
    pivot[c] *= -length;
    for (int r = top + 1; r < s->rows; r++) s->row[r][c] = 0;
    return pivot[c] * 0 == 0;
}

/// Triangular rows for the unknowns of a sample in columns `first` …, from row `top` on; `fixed` ones become the identity's.
static pentadiagonal_rank eliminate(walk *w, int sample, int first, int *top)
{
    pentadiagonal_rank rank = RANK_FULL;
    for (int part = 0; part < 2; part++) {
        int c = first + part;
        if (is_fixed(w, sample, part)) { // an empty row of its own, kept in place
            new_row(w);
            swap_rows(&w->stack, *top, w->stack.rows - 1);
            w->stack.row[*top][c] = 1;
        } else {
            if (!reflect(w, *top, c)) return RANK_BROKEN;
            if (fabs(w->stack.row[*top][c]) < lost) rank = RANK_WEAK;
        }
        (*top)++;
    }
    return rank;
}

/// Writes U_k* and leaves what is below it, triangular and moved one sample to the left.
static void finish_step(walk *w, pentadiagonal *m)
{
    stack *s = &w->stack;
    int k = w->k, top = 2;
    double *d = m->diagonal + 3 * k;
    d[0] = s->row[0][0], d[1] = s->row[0][1], d[2] = s->row[1][1];
    for (int part = 0; part < 2; part++) {
        memcpy(m->below + 4 * k + 2 * part, s->row[part] + 2, 2 * sizeof(double));
        memcpy(m->below2 + 4 * k + 2 * part, s->row[part] + 4, 2 * sizeof(double));
        if (m->cyclic) memcpy(m->border + 4 * (2 * k + part), s->row[part] + SEAM, 4 * sizeof(double));
    }
    for (int c = 2; c < COLUMNS; c++) top += reflect(w, top, c);
    int rows = 0;
    for (int r = 2; r < top; r++, rows++) {
        double *to = s->row[rows];
        const double *from = s->row[r];
        memmove(to, from + 2, 4 * sizeof(double));
        memset(to + 4, 0, 2 * sizeof(double));
        memcpy(to + SEAM, from + SEAM, 4 * sizeof(double));
    }
    s->rows = rows;
}

static pentadiagonal_rank eliminate_seam(walk *w, pentadiagonal *m)
{
    pentadiagonal_rank rank = RANK_FULL;
    int top = 0;
    for (int sample = w->interior; sample < w->rows->count; sample++) add_imaginary(w, sample);
    for (int s = w->slope; s < w->rows->slope_count; s++) {
        if (!crosses_seam(w, &w->rows->slopes[s])) add_slope(w, &w->rows->slopes[s]);
    }
    clear_fixed(w);
    for (int s = 0; s < 2; s++) {
        pentadiagonal_rank of_sample = eliminate(w, w->interior + s, SEAM + 2 * s, &top);
        rank = of_sample < rank ? of_sample : rank;
        if (rank == RANK_BROKEN) return rank;
    }
    for (int r = 0; r < BORDER_MAX; r++) memcpy(m->corner[r], w->stack.row[r] + SEAM, sizeof m->corner[r]);
    return rank;
}

pentadiagonal_rank orthogonal_factor(const system_rows *rows, pentadiagonal *m)
{
    walk w = {.rows = rows, .interior = rows->loop ? rows->count - 2 : rows->count};
    m->count = rows->count;
    m->is_complex = rows->is_complex;
    m->cyclic = rows->loop;
    pentadiagonal_rank rank = RANK_FULL;
    for (w.k = 0; w.k < w.interior; w.k++) {
        int top = 0;
        add_rows(&w);
        clear_fixed(&w);
        pentadiagonal_rank step = eliminate(&w, w.k, 0, &top);
        rank = step < rank ? step : rank;
        if (rank == RANK_BROKEN) return rank;
        finish_step(&w, m);
    }
    if (!rows->loop) return rank;
    pentadiagonal_rank seam = eliminate_seam(&w, m);
    return seam < rank ? seam : rank;
}

/// y_k = U_kk⁻ᵀ (b_k − U_{k−1,k}ᵀ y_{k−1} − U_{k−2,k}ᵀ y_{k−2}); the seam's part of b loses what the interior takes.
static void solve_transposed(const pentadiagonal *m, int interior, double *b)
{
    for (int k = 0; k < interior; k++) {
        const double *u = m->diagonal + 3 * k;
        double *y = b + 2 * k;
        for (int part = 0; part < 2; part++) {
            for (int r = 0; r < 2; r++) {
                if (k > 0) y[part] -= m->below[4 * (k - 1) + 2 * r + part] * b[2 * (k - 1) + r];
                if (k > 1) y[part] -= m->below2[4 * (k - 2) + 2 * r + part] * b[2 * (k - 2) + r];
            }
        }
        y[0] /= u[0];
        y[1] = (y[1] - u[1] * y[0]) / u[2];
        for (int c = 0; m->cyclic && c < BORDER_MAX; c++) {
            for (int r = 0; r < 2; r++) b[2 * interior + c] -= m->border[4 * (2 * k + r) + c] * y[r];
        }
    }
}

static void solve_seam(const pentadiagonal *m, double *b)
{
    for (int c = 0; c < BORDER_MAX; c++) {
        for (int r = 0; r < c; r++) b[c] -= m->corner[r][c] * b[r];
        b[c] /= m->corner[c][c];
    }
    for (int r = BORDER_MAX - 1; r >= 0; r--) {
        for (int c = r + 1; c < BORDER_MAX; c++) b[r] -= m->corner[r][c] * b[c];
        b[r] /= m->corner[r][r];
    }
}

void orthogonal_solve(const pentadiagonal *m, double *b)
{
    const int interior = m->cyclic ? m->count - 2 : m->count;
    solve_transposed(m, interior, b);
    if (m->cyclic) solve_seam(m, b + 2 * interior);
    for (int k = interior - 1; k >= 0; k--) {
        const double *u = m->diagonal + 3 * k;
        double *x = b + 2 * k;
        for (int part = 0; part < 2; part++) {
            for (int c = 0; c < 2; c++) {
                if (k + 1 < interior) x[part] -= m->below[4 * k + 2 * part + c] * b[2 * (k + 1) + c];
                if (k + 2 < interior) x[part] -= m->below2[4 * k + 2 * part + c] * b[2 * (k + 2) + c];
            }
            for (int c = 0; m->cyclic && c < BORDER_MAX; c++)
                x[part] -= m->border[4 * (2 * k + part) + c] * b[2 * interior + c];
        }
        x[1] /= u[2];
        x[0] = (x[0] - u[1] * x[1]) / u[0];
    }
}
