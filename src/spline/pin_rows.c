/// Which combinations of a sample's pins can be reached: the eigenvectors of B°B°ᵀ. B is how far each spline's Re x and Im x move the pins.
#include "spline/pin_group.h"
#include "spline/symmetric.h"
#include <math.h>
#include <string.h>

/// The least softness of a bound, so that two nearly equal bounds never contradict each other.
static const double least_soft = 1e-10;

/// Shares of the largest eigenvalue: below the first a direction is out of reach, below the second it is soft.
static const double out_of_reach = 1e-4, firm = 0.04;

size_t pin_rows_scratch(int splines, int pins)
{
    size_t directions = 3 * (size_t)pins, columns = 2 * (size_t)splines;
    return 2 * directions * columns + 2 * directions * directions + directions;
}

static bool is_pulled_at(const pulled *spline, int sample)
{
    for (int i = 0; i < spline->pulls.count; i++) {
        if (spline->pulls.sample[i] == sample) return true;
    }
    return false;
}

/// How many parts of a spline's x are known at a sample: none, Re x, or both.
static int known_at(const problem *p, int sample)
{
    for (int k = 0; k < p->desc->knot_count; k++) {
        if (p->desc->knots[k].sample == sample) return 1 + problem_is_whole(p, &p->desc->knots[k]);
    }
    return 0;
}

/// Three rows of B.
static void put_pin(double *b, int columns, const pulled *splines, const wiggly_pin *pin)
{
    memset(b, 0, 3 * (size_t)columns * sizeof *b);
    for (int i = 0; i < pin->pull_count; i++) {
        const wiggly_pull *pull = &pin->pulls[i];
        const pulled *spline = &splines[pull->spline];
        if (!is_pulled_at(spline, pin->sample)) continue;
        bool is_complex = spline->problem.desc->mode == WIGGLY_COMPLEX;
        for (int axis = 0; axis < 3; axis++) {
            b[columns * axis + 2 * pull->spline] += pull->c[axis][0];
            if (is_complex) b[columns * axis + 2 * pull->spline + 1] -= pull->c[axis][1];
        }
    }
}

/// Turns B into B°: keyed samples cannot move Re x, poses and still samples neither part.
static void hold_keyed(double *b, int rows, int columns, const pulled *splines, int sample)
{
    for (int s = 0; s < columns / 2; s++) {
        const int known = known_at(&splines[s].problem, sample);
        for (int r = 0; r < rows; r++) memset(b + columns * r + 2 * s, 0, (size_t)known * sizeof *b);
    }
}

static double softness(double reach)
{
    double ratio = firm / reach, lack = fmax(0, ratio * ratio - 1);
    return lack * lack;
}

static void add_rows(pin_rows *rows, const pulled *splines, const wiggly_pin *pins, const int *order, int pin_count)
{
    const int n = 3 * pin_count, columns = 2 * rows->splines, sample = pins[order[0]].sample;
    double *b = rows->scratch, *held = b + n * columns, *square = held + n * columns, *vectors = square + n * n,
           *values = vectors + n * n, largest = 0;
    for (int p = 0; p < pin_count; p++) put_pin(b + 3 * columns * p, columns, splines, &pins[order[p]]);
    memcpy(held, b, sizeof *b * (size_t)(n * columns));
    hold_keyed(held, n, columns, splines, sample);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            double sum = 0;
            for (int k = 0; k < columns; k++) sum += held[columns * i + k] * held[columns * j + k];
            square[n * i + j] = sum;
        }
    }
    symmetric_eigen(n, square, values, vectors);
    for (int i = 0; i < n; i++) largest = fmax(largest, values[i]);
    const int first = rows->count;
    for (int i = 0; i < n; i++) {
        double reach = largest > 0 ? values[i] / largest : 0;
        if (!(reach >= out_of_reach)) continue;
        double *on = rows->on + columns * rows->count, want = 0;
        memset(on, 0, sizeof *on * (size_t)columns);
        for (int r = 0; r < n; r++) {
            double part = vectors[n * r + i];
            want += part * pins[order[r / 3]].to[r % 3];
            for (int k = 0; k < columns; k++) on[k] += part * b[columns * r + k];
        }
        rows->row[rows->count++] = (pin_row){.sample = sample, .first = first, .want = want, .soft = softness(reach)};
    }
    for (int r = first; r < rows->count; r++) rows->row[r].count = rows->count - first;
}

void pin_rows_find(pin_rows *rows, const pulled *splines, const wiggly_pin *pins, const int *order, int pin_count)
{
    rows->count = 0;
    for (int from = 0, to; from < pin_count; from = to) {
        for (to = from + 1; to < pin_count && pins[order[to]].sample == pins[order[from]].sample; to++) {
        }
        add_rows(rows, splines, pins, order + from, to - from);
    }
    rows->fixed = rows->count;
}

// --- bounds ----------------------------------------------------------------------------------------------------------

int pin_rows_sample(const pulled *spline, int sample)
{
    const problem *p = &spline->problem;
    if (p->count < 3) return -1;
    if (p->start == WIGGLY_LOOP) return sample == p->count ? 0 : sample;
    if (!problem_is_asked(p)) return -1;
    if (sample < p->first) return p->first;
    return p->settles && sample > p->latest ? p->latest : sample;
}

/// A bound's coefficients on Re x and Im x of its spline, from c.
static void put_coefficients(const pulled *spline, const double c[2], double on[2])
{
    on[0] = c[0];
    on[1] = spline->problem.desc->mode == WIGGLY_COMPLEX ? -c[1] : 0;
}

/// How many parts of x cannot move a bound's point, because a knot fixes them.
static int barred(const pulled *spline, int sample)
{
    const int at = pin_rows_sample(spline, sample);
    return at >= 0 && !bound_tail_moves(&spline->tail, sample) ? known_at(&spline->problem, at) : 0;
}

/// Squared component of a bound's direction along a pin's row.
static double square_along(const pin_rows *rows, const pulled *splines, const wiggly_bound *bound, const double *on)
{
    double product = 0, square = 0;
    for (int s = 0; s < rows->splines; s++) {
        double own[2];
        put_coefficients(&splines[s], bound->c[s], own);
        for (int part = barred(&splines[s], bound->sample); part < 2; part++) {
            product += own[part] * on[2 * s + part];
            square += on[2 * s + part] * on[2 * s + part];
        }
    }
    return square > 0 ? product * product / square : 0;
}

double pin_rows_reach(const pin_rows *rows, const pulled *splines, const wiggly_bound *bound)
{
    double all = 0, rest = 0;
    for (int s = 0; s < rows->splines; s++) {
        double own[2];
        put_coefficients(&splines[s], bound->c[s], own);
        const bool moves =
            pin_rows_sample(&splines[s], bound->sample) >= 0 || bound_tail_moves(&splines[s].tail, bound->sample);
        for (int part = 0; part < 2; part++) {
            const double square = own[part] * own[part];
            all += square;
            if (moves && part >= barred(&splines[s], bound->sample)) rest += square;
        }
    }
    for (int r = 0; r < rows->fixed; r++) {
        if (rows->row[r].sample != bound->sample) continue;
        rest -= square_along(rows, splines, bound, rows->on + 2 * rows->splines * r) / (1 + rows->row[r].soft);
    }
    return all > 0 ? fmax(0, rest / all) : 0;
}

/// After the last knot x is e^{p…} times x at the knot.
static void turn_to_last(const pulled *spline, int sample, double on[2])
{
    const problem *p = &spline->problem;
    double re, im;
    if (!p->settles || sample <= p->latest) return;
    problem_fill_tail(spline->solver, p, (cplx){1, 0}, sample - p->latest, 1, &re, &im);
    const double c[2] = {on[0], on[1]};
    on[0] = c[0] * re + c[1] * im;
    on[1] = c[1] * re - c[0] * im;
}

void pin_rows_add_bounds(pin_rows *rows, const pulled *splines, wiggly_bound *bounds, int bound_count)
{
    for (int b = 0; b < bound_count; b++) {
        const double reach = pin_rows_reach(rows, splines, &bounds[b]);
        bounds[b].push = 0;
        if (!(reach >= out_of_reach)) continue;
        double *on = rows->on + 2 * rows->splines * rows->count;
        for (int s = 0; s < rows->splines; s++) {
            put_coefficients(&splines[s], bounds[b].c[s], on + 2 * s);
            turn_to_last(&splines[s], bounds[b].sample, on + 2 * s);
        }
        rows->row[rows->count] = (pin_row){.sample = bounds[b].sample,
                                           .first = rows->count,
                                           .count = 1,
                                           .want = bounds[b].least,
                                           .soft = softness(reach) / reach + least_soft,
                                           .bound = &bounds[b]};
        rows->count++;
    }
}
