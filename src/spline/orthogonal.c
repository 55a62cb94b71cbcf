/// Factors ill-conditioned systems by Givens rotations of the rows themselves.
//
// A row touches at most three neighbouring samples, so U of Q U = R is as narrow as the band:
//
//     | U00 U01 U02             |   Row by row: a rotation takes a row's first entry into the row of U that begins there, until
//     |     U11 U12 U13         |   none begins where the rest of it does. In hand are the rows of U that begin at x_k, x_{k+1},
//     |         U22 U23 U24     |   x_{k+2}. Once all rows that begin at x_k are in, U_k* is done.
//     |             U33 U34 U35 |
//
// As the band, from both ends: rows that touch none of the samples between are taken there. In a loop the last two samples, the seam, have
// their own columns at the right and stay to the end. A rotation involves only two rows, so a stiff slope row does not drown the soft ones.
// As Uᵀ U = L D Lᵀ, the pivots are U_kk² and what couples them U_kk U_kj.
#include "spline/system.h"
#include <math.h>
#include <string.h>

enum { COLUMNS = BAND_DENSE, SEAM = 6 };

/// Lanes, and the dense block after them.
enum { UP, DOWN, BETWEEN };

typedef struct walk {
    const system_rows *rows;
    int interior, steps; ///< samples before the seam; those that each lane eliminates
    int lane, k;         ///< the lane, and the sample that it eliminates
    double u[COLUMNS]
            [COLUMNS]; ///< of the sample and the two behind it and, from SEAM on, the seam: re and im of each
} walk;

/// Sets a row's coefficient; fixed unknowns have none.
static void put(const walk *w, double *row, int sample, int part, double value)
{
    const int begin = w->lane == BETWEEN ? w->steps : w->k, away = w->lane == DOWN ? begin - sample : sample - begin;
    const int column = sample >= w->interior ? SEAM + 2 * (sample - w->interior) : 2 * away;
    if (!(w->rows->fixed[sample] & (part ? FIXED_IM : FIXED_RE))) row[column + part] += value;
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

/// Whether a row on these samples is taken now: where it begins.
static bool begins_here(const walk *w, const int samples[3])
{
    int least = w->interior, most = -1;
    for (int i = 0; i < 3; i++) {
        if (samples[i] < 0 || samples[i] >= w->interior) continue;
        least = samples[i] < least ? samples[i] : least;
        most = samples[i] > most ? samples[i] : most;
    }
    if (least < w->steps) return w->lane == UP && least == w->k;
    if (most >= w->interior - w->steps) return w->lane == DOWN && most == w->k;
    return w->lane == BETWEEN;
}

/// Adds a complex row of coefficients on up to three samples, as two real ones, or one outside complex mode or if it is `real`: Re(c x).
static void add_row(walk *w, double weight, bool real, const stencil *s)
{
    if (!(weight > 0) || !begins_here(w, s->at)) return;
    const double root = sqrt(weight);
    double re[COLUMNS] = {0}, im[COLUMNS] = {0};
    for (int i = 0; i < 3; i++) {
        if (s->at[i] < 0) continue;
        put(w, re, s->at[i], 0, root * s->c[i].re);
        put(w, re, s->at[i], 1, -root * s->c[i].im);
        put(w, im, s->at[i], 0, root * s->c[i].im);
        put(w, im, s->at[i], 1, root * s->c[i].re);
    }
    take_row(w, re);
    if (w->rows->is_complex && !real) take_row(w, im);
}

/// A row on one sample.
static stencil row_on(int sample, cplx c) { return (stencil){.at = {-1, sample, -1}, .c = {[1] = c}}; }

/// Adds the slopes on a sample.
static void add_slopes(walk *w, int sample)
{
    const system_rows *rows = w->rows;
    int from = 0, to = rows->slope_count;
    while (from < to) {
        const int middle = (from + to) / 2;
        if (rows->slopes[middle].sample < sample) {
            from = middle + 1;
        } else {
            to = middle;
        }
    }
    for (; from < rows->slope_count && rows->slopes[from].sample == sample; from++) {
        stencil s = system_slope_stencil(rows, &rows->slopes[from]);
        for (int i = 0; i < 3; i++) {
            if (s.c[i].re == 0 && s.c[i].im == 0) s.at[i] = -1;
        }
        add_row(w, rows->slopes[from].weight, true, &s);
    }
}

/// Adds the rows of a sample that begin here.
static void add_rows(walk *w, int sample)
{
    const system_rows *rows = w->rows;
    const jet_row jet = system_jet(rows, sample);
    const int before = system_beside(rows, sample, -1), after = system_beside(rows, sample, 1);
    if (rows->fixed[sample] & FIXED_STILL) { // two jets
        const stencil back = row_on(before, jet.before), ahead = row_on(after, (cplx){1, 0});
        add_row(w, jet.weight, false, &back);
        add_row(w, jet.weight, false, &ahead);
    } else {
        const stencil s = {.at = {before, sample, after}, .c = {jet.before, jet.own, {1, 0}}};
        add_row(w, jet.weight, false, &s);
    }
    add_slopes(w, sample);
    const stencil im = row_on(sample, (cplx){0, -1});
    if (rows->is_complex) add_row(w, rows->is_constant ? rows->own_im : rows->im_weight[sample], true, &im);
    for (int i = 0; sample == 0 && i < 2; i++) {
        const struct start_row *row = &rows->start.row[i];
        const stencil s = {.at = {-1, 0, rows->count > 1 ? 1 : -1},
                           .c = {{0, 0}, system_start_on_x(rows, row), row->on_e}};
        add_row(w, row->weight, false, &s);
    }
}

/// The pivot of an unknown; that of a fixed one is 1. False: there is none.
static bool close_row(walk *w, int sample, int column, int part)
{
    double *pivot = &w->u[column][column];
    if (w->rows->fixed[sample] & (part ? FIXED_IM : FIXED_RE)) *pivot = 1;
    return fabs(*pivot) > 0 && fabs(*pivot) < INFINITY;
}

/// Hands over the rows of a sample, and goes on to the next one.
static bool finish_step(walk *w, int step, band_matrix *m)
{
    double(*u)[COLUMNS] = w->u;
    for (int part = 0; part < 2; part++) {
        if (!close_row(w, w->k, part, part)) return false;
        if (part == 0 || m->is_complex) band_put_row(m, step, w->lane, part, u[part] + part, u[part] + SEAM);
    }
    for (int r = 0; r < SEAM; r++) {
        const bool is_new = r + 2 >= SEAM;
        for (int c = 0; c < COLUMNS; c++) {
            const int from = c < SEAM ? c + 2 : c;
            u[r][c] = is_new || (c < SEAM && from >= SEAM) ? 0 : u[r + 2][from];
        }
    }
    return true;
}

/// Rows that a lane has left, into the dense block.
static void take_left(walk *between, const walk *w)
{
    const int last = w->interior - 2 * w->steps - 1;
    for (int r = 0; r < COLUMNS; r++) {
        double row[COLUMNS] = {0};
        for (int c = 0; c < 4; c++) row[w->lane == DOWN ? 2 * (last - c / 2) + c % 2 : c] = w->u[r][c];
        memcpy(row + SEAM, w->u[r] + SEAM, (COLUMNS - SEAM) * sizeof *row);
        take_row(between, row);
    }
}

/// What is between the lanes, in the order of the band's dense block.
static bool finish_between(walk *w, band_matrix *m)
{
    const int parts = m->is_complex ? 2 : 1, middle = band_middle(m), samples = middle + (m->cyclic ? 2 : 0);
    int column[BAND_DENSE] = {0};
    for (int s = 0; s < samples; s++) {
        for (int part = 0; part < parts; part++) {
            const int at = s < middle ? 2 * s : SEAM + 2 * (s - middle);
            column[parts * s + part] = at + part;
            if (!close_row(w, s < middle ? w->steps + s : w->interior + s - middle, at + part, part)) return false;
        }
    }
    double dense[BAND_DENSE][BAND_DENSE];
    for (int i = 0; i < samples * parts; i++) {
        for (int j = i; j < samples * parts; j++) dense[i][j] = w->u[column[i]][column[j]];
    }
    band_put_dense(m, dense);
    return true;
}

bool orthogonal_factor(const system_rows *rows, band_matrix *m)
{
    walk between = {.rows = rows, .interior = band_interior(m), .steps = band_steps(m), .lane = BETWEEN};
    m->is_factor = false;
    for (int lane = UP; lane <= DOWN && between.steps > 0; lane++) {
        walk w = {.rows = rows, .interior = between.interior, .steps = between.steps, .lane = lane};
        for (int step = 0; step < w.steps; step++) {
            w.k = lane == UP ? step : w.interior - 1 - step;
            for (int by = -1; by <= 1; by++) { // those that begin here lie on it, or beside it
                const int at = system_beside(rows, w.k, by);
                if (at >= 0) add_rows(&w, at);
            }
            if (!finish_step(&w, step, m)) return false;
        }
        take_left(&between, &w);
    }
    for (int sample = 0; sample < rows->count; sample++) add_rows(&between, sample);
    return finish_between(&between, m);
}
