/// Pins: splines solved together, so that the points they move reach given places (docs/mathematics.md, Pins), and bounds.
//
// Each spline is solved without pins (its start and end are the same as with them) and for unit pulls on Re x and Im x at each pinned
// sample, and the response is read at all of these. With R_s the rows' coefficients of spline s and Z_s its compliance,
//
//     S = Σ_s R_sᵀ Z_s R_s / w_s,     (S + diag(φ S_max)) λ = want − Σ_s R_s x_s⁰,
//
// and every spline is solved once more under the pulls R_sᵀ λ / w_s. Rows are the combinations of a sample's pins that can be reached: the
// eigenvectors of B°B°ᵀ, where B is how far each spline's Re x and Im x move the pins. A bound is one row more, whose λ is not below 0.
#include "maths/symmetric.h"
#include "maths/wide.h"
#include "spline/bound_tail.h"
#include "spline/host.h"
#include "spline/one_sided.h"
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Correction rounds, and the miss they tolerate, as a share of the largest target.
enum { MAX_ROUNDS = 3 };
static const double near_enough = 1e-10;

/// The least softness of a bound, so that two nearly equal bounds never contradict each other.
static const double least_soft = 1e-10;

/// Shares of the largest eigenvalue: below the first a direction is out of reach, below the second it is soft.
static const double out_of_reach = 1e-4, firm = 0.04;

/// Smallest share of a bound's own response that the pins may leave; below, no digit is right.
static const double lost = 64 * DBL_EPSILON;

/// One spline of a group.
typedef struct pulled {
    wiggly_solver *solver;
    wiggly_desc desc;    ///< the caller's, with defaults
    wiggly_curve *curve; ///< the caller's
    problem problem;
    system_pulls pulls;
    double scale;    ///< of the system's compliance, to that of its weighted energy
    double spread;   ///< √ of the largest D: the most that pulls move any x, in units of √(energy / scale)
    bound_tail tail; ///< the motion that bounds add after the last knot
    double *e;       ///< that motion, one number per sample
} pulled;

/// One condition: Σ over splines of on[2s] Re x_s + on[2s + 1] Im x_s at a sample is `want`. A bound's is at least that, and `on` is on
/// the sample of each spline that the bound's own is a part of (sample_of()).
typedef struct pin_row {
    int sample;
    int first, count; ///< the rows of that sample
    double want;
    double soft;         ///< its softness, as a share of the largest eigenvalue of S among the sample's rows
    wiggly_bound *bound; ///< or NULL
} pin_row;

struct wiggly_group {
    int most_splines, most_pins, most_knots, most_bounds; ///< capacity
    int splines, pin_count, bound_count;                  ///< of the last call
    pulled *pulled;
    wiggly_pin *pins;
    wiggly_bound *bounds;
    int *order;         ///< of pins, by sample
    int rows, fixed;    ///< how many, and how many of them are the pins'
    pin_row *row;       ///< by sample
    double *on;         ///< 2 × splines numbers a row
    double *scratch;    ///< memory for the conditions of all pins in one sample
    int *pull_of;       ///< per row: the pull on the current spline, or -1
    double *compliance; ///< Z of the current spline, 2P × 2P, and its motion without pulls
    double *alone;
    double *answer; ///< Z R of the current spline, 2P × rows
    double *system; ///< S, the lower triangle, then its factor
    double *soft;   ///< φ S_max of each row
    double *lambda, *miss;
    double *want;    ///< S λ + miss; needed, like all below, only for bounds
    double *reduced; ///< S with the pins' rows held, and want likewise
    double *square;  ///< scratch of the search for bounds that press: bounds × bounds
    double *root, *product, *scale;
    int *pressing;
    bool *presses;
    double slack; ///< tolerance of bounds
    double unit;  ///< a power of two that all values are multiplied by
    one_sided search;
    tail_row *tail_rows; ///< of the current spline
    double *e, *pressed; ///< scratch of its tail
};

// --- memory ----------------------------------------------------------------------------------------------------------

/// One block, but for a solver for each spline.
static wiggly_group *lay_out_group(arena *a, const wiggly_group *capacity, int samples)
{
    const int most = capacity->most_bounds;
    const size_t s = (size_t)capacity->most_splines, pins = (size_t)capacity->most_pins, bounds = (size_t)most;
    const size_t n = (size_t)samples, p = pins + (size_t)(most < samples ? most : samples), rows = 3 * pins + bounds;
    const size_t directions = 3 * (pins > 0 ? pins : 1);
    wiggly_group measured = *capacity, *g = arena_take(a, 1, sizeof *g), *at = g ? g : &measured;
    *at = measured;
    at->pulled = arena_take(a, s, sizeof(pulled));
    for (size_t i = 0; i < s; i++) {
        const pulled of = {.pulls = {.sample = arena_take(a, p, sizeof(int)), .pull = arena_take(a, p, sizeof(cplx))},
                           .e = arena_take(a, bounds > 0 ? n : 0, sizeof(double))};
        if (at->pulled) at->pulled[i] = of;
    }
    at->row = arena_take(a, rows, sizeof(pin_row));
    at->on = arena_take(a, rows, 2 * s * sizeof(double));
    at->scratch = arena_take(a, directions, (4 * s + 2 * directions + 1) * sizeof(double));
    at->order = arena_take(a, pins, sizeof(int));
    at->pull_of = arena_take(a, rows, sizeof(int));
    at->compliance = arena_take(a, 2 * p, 2 * p * sizeof(double));
    at->answer = arena_take(a, 2 * p, rows * sizeof(double));
    at->alone = arena_take(a, 2 * p, sizeof(double));
    at->system = arena_take(a, rows, rows * sizeof(double));
    double **const of_rows[] = {&at->soft, &at->lambda, &at->miss, &at->want};
    for (size_t i = 0; i < sizeof of_rows / sizeof *of_rows; i++) *of_rows[i] = arena_take(a, rows, sizeof(double));
    if (most == 0) return g;
    at->reduced = arena_take(a, rows, rows * sizeof(double));
    at->square = arena_take(a, bounds, bounds * sizeof(double));
    at->pressing = arena_take(a, bounds, sizeof(int));
    at->presses = arena_take(a, bounds, sizeof(bool));
    one_sided *const o = &at->search;
    double **const of_bounds[] = {
        &at->root, &at->scale,       &at->product,      &o->value,           &o->is_open,         &o->move,
        &o->lack,  &o->limit[0].gap, &o->limit[0].push, &o->limit[0].by_gap, &o->limit[0].by_push};
    for (size_t i = 0; i < sizeof of_bounds / sizeof *of_bounds; i++)
        *of_bounds[i] = arena_take(a, bounds, sizeof(double));
    at->tail_rows = arena_take(a, rows, sizeof(tail_row));
    at->e = arena_take(a, n, sizeof(double));
    at->pressed = arena_take(a, n, sizeof(double));
    return g;
}

wiggly_status wiggly_group_create(int samples, int knots, int splines, int pins, wiggly_group **group)
{
    return wiggly_group_create_bounded(samples, knots, splines, pins, 0, group);
}

wiggly_status wiggly_group_create_bounded(int samples, int knots, int splines, int pins, int bounds,
                                          wiggly_group **group)
{
    if (!group || samples < 1 || knots < 0 || splines < 1 || pins < 0 || bounds < 0 || pins > WIGGLY_MOST_PINS ||
        bounds > WIGGLY_MOST_PINS || knots > INT_MAX - pins - bounds)
        return WIGGLY_ERROR_ARGUMENT;
    const wiggly_group capacity = {
        .most_splines = splines, .most_pins = pins, .most_knots = knots, .most_bounds = bounds};
    arena size = {0};
    lay_out_group(&size, &capacity, samples);
    if (size.too_large) return WIGGLY_ERROR_MEMORY;
    arena a = {.block = calloc(1, size.used)};
    if (!a.block) return WIGGLY_ERROR_MEMORY;
    *group = lay_out_group(&a, &capacity, samples);
    for (int s = 0; s < splines; s++) {
        const int pulls = pins + (bounds < samples ? bounds : samples);
        wiggly_status status = wiggly_create(samples, knots + pulls, &(*group)->pulled[s].solver);
        if (status == WIGGLY_OK) continue;
        wiggly_group_destroy(*group);
        *group = NULL;
        return status;
    }
    return WIGGLY_OK;
}

void wiggly_group_destroy(wiggly_group *g)
{
    for (int s = 0; g && s < g->most_splines; s++) wiggly_destroy(g->pulled[s].solver);
    free(g);
}

void wiggly_group_set_method(wiggly_group *g, wiggly_method method)
{
    for (int s = 0; s < g->most_splines; s++) wiggly_set_method(g->pulled[s].solver, method);
}

// --- a call's arguments ----------------------------------------------------------------------------------------------

static wiggly_status read_pins(const wiggly_group *g)
{
    for (int i = 0; i < g->pin_count; i++) {
        const wiggly_pin *pin = &g->pins[i];
        if (pin->pull_count < 0 || (pin->pull_count > 0 && !pin->pulls)) return WIGGLY_ERROR_ARGUMENT;
        for (int axis = 0; axis < 3; axis++) {
            if (!isfinite(pin->to[axis])) return WIGGLY_ERROR_NUMBER;
        }
        for (int k = 0; k < 3 * pin->pull_count; k++) {
            const wiggly_pull *pull = &pin->pulls[k / 3];
            if (pull->spline < 0 || pull->spline >= g->splines) return WIGGLY_ERROR_ARGUMENT;
            if (!isfinite(pull->c[k % 3][0]) || !isfinite(pull->c[k % 3][1])) return WIGGLY_ERROR_NUMBER;
        }
    }
    for (int i = 0; i < g->pin_count; i++) { // by sample; pins of one sample keep their order
        int at = i;
        for (; at > 0 && g->pins[g->order[at - 1]].sample > g->pins[i].sample; at--) g->order[at] = g->order[at - 1];
        g->order[at] = i;
    }
    return WIGGLY_OK;
}

/// Copies the caller's descriptions and curves.
static wiggly_status read_splines(wiggly_group *g, const wiggly_desc *descs, wiggly_curve *curves)
{
    for (int s = 0; s < g->splines; s++) {
        pulled *of = &g->pulled[s];
        of->curve = curve_at(curves, curves->size, s);
        if (!curve_fits(of->curve)) return WIGGLY_ERROR_SIZE;
        of->curve->knot = -1;
        wiggly_status status = desc_read(desc_at(descs, s), &of->desc);
        if (status != WIGGLY_OK) return status;
        if (of->desc.samples < 1) return WIGGLY_ERROR_ARGUMENT;
        if (of->desc.knot_count > g->most_knots) return WIGGLY_ERROR_CAPACITY;
        status = problem_check(of->solver, &of->desc, &of->curve->knot);
        if (status != WIGGLY_OK) return status;
    }
    return WIGGLY_OK;
}

static wiggly_status read_bounds(const wiggly_group *g)
{
    for (int s = 0; s < g->splines && g->bound_count > 0; s++) {
        const wiggly_curve *curve = g->pulled[s].curve;
        if (!curve->total || !curve->re || !curve->im) return WIGGLY_ERROR_ARGUMENT;
    }
    for (int b = 0; b < g->bound_count; b++) {
        const wiggly_bound *bound = &g->bounds[b];
        if (!bound->c) return WIGGLY_ERROR_ARGUMENT;
        if (!isfinite(bound->least)) return WIGGLY_ERROR_NUMBER;
        for (int s = 0; s < g->splines; s++) {
            if (bound->sample < 0 || bound->sample >= g->pulled[s].desc.samples) return WIGGLY_ERROR_PIN;
            if (!isfinite(bound->c[s][0]) || !isfinite(bound->c[s][1])) return WIGGLY_ERROR_NUMBER;
        }
    }
    return WIGGLY_OK;
}

/// Whether a spline moves a pin.
static bool moves(const wiggly_pin *pin, int spline)
{
    for (int i = 0; i < pin->pull_count; i++) {
        if (pin->pulls[i].spline != spline) continue;
        for (int axis = 0; axis < 3; axis++) {
            if (pin->pulls[i].c[axis][0] != 0 || pin->pulls[i].c[axis][1] != 0) return true;
        }
    }
    return false;
}

/// Whether a spline can be pulled there: it has free motion, and its start is penalised.
static bool can_be_pulled(const pulled *of)
{
    const problem *p = &of->problem;
    const wiggly_desc *desc = p->desc;
    const bool throughout = p->start == WIGGLY_LOOP || !problem_is_asked(p);
    double fastest = 0;
    poles_fastest(desc, p->first, throughout ? desc->samples - 1 : p->latest, &fastest);
    return desc->mode != WIGGLY_CUBIC && desc->calm > 0 && fastest > 0;
}

/// Poses a spline with the pulls of its pins.
static wiggly_status pose_pins(wiggly_group *g, int spline, double weight)
{
    pulled *of = &g->pulled[spline];
    system_pulls *pulls = &of->pulls;
    const wiggly_desc *desc = &of->desc;
    const int end = desc->samples - (desc->start == WIGGLY_LOOP ? 1 : 0); // a loop's last sample is its first
    pulls->count = 0;
    for (int i = 0; i < g->pin_count; i++) {
        const wiggly_pin *pin = &g->pins[g->order[i]];
        if (!moves(pin, spline)) continue;
        if (pin->sample < 0 || pin->sample >= end) return WIGGLY_ERROR_PIN;
        if (pulls->count > 0 && pulls->sample[pulls->count - 1] == pin->sample) continue;
        pulls->pull[pulls->count] = (cplx){0, 0};
        pulls->sample[pulls->count++] = pin->sample;
    }
    pulls->earliest = pulls->count > 0 ? pulls->sample[0] : -1;
    pulls->latest = pulls->count > 0 ? pulls->sample[pulls->count - 1] : -1;
    of->solver->pulls = pulls->count > 0 ? pulls : NULL;
    problem_pose(of->solver, desc, of->solver->y, &of->problem);
    if (pulls->count > 0 && of->problem.count < 3) {
        pulls->count = 0; // too short to be moved by a pull
        of->solver->pulls = NULL;
        problem_pose(of->solver, desc, of->solver->y, &of->problem);
    }
    if (pulls->count > 0 && !can_be_pulled(of)) return WIGGLY_ERROR_PIN;
    of->tail = bound_tail_of(&of->problem, weight);
    of->scale = of->problem.unit * desc->step * desc->step * desc->step / weight;
    return WIGGLY_OK;
}

/// The sample at which a posed spline is pulled for a pull at any sample; -1: nowhere.
static int sample_of(const pulled *of, int sample)
{
    const problem *p = &of->problem;
    if (p->count < 3) return -1;
    if (p->start == WIGGLY_LOOP) return sample == p->count ? 0 : sample;
    if (!problem_is_asked(p)) return -1;
    if (sample < p->first) return p->first;
    return p->settles && sample > p->latest ? p->latest : sample;
}

/// Index of the pull on a sample, or of the first one after it.
static int search_pull(const system_pulls *pulls, int sample)
{
    int from = 0, to = pulls->count;
    while (from < to) {
        const int middle = (from + to) / 2;
        if (pulls->sample[middle] < sample)
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

static bool is_pulled_at(const system_pulls *pulls, int sample)
{
    const int at = search_pull(pulls, sample);
    return at < pulls->count && pulls->sample[at] == sample;
}

/// Adds a spline's pulls for bounds. A loop's pulls all count as knots, because it has no ends.
static wiggly_status pose_bounds(wiggly_group *g, int spline)
{
    pulled *of = &g->pulled[spline];
    system_pulls *pulls = &of->pulls;
    const bool is_loop = of->problem.start == WIGGLY_LOOP;
    bool is_moved = false;
    for (int b = 0; b < g->bound_count; b++) {
        const double *c = g->bounds[b].c[spline];
        if (c[0] == 0 && c[1] == 0) continue;
        const int sample = sample_of(of, g->bounds[b].sample);
        is_moved = true;
        if (sample < 0 || is_pulled_at(pulls, sample)) continue;
        const int at = search_pull(pulls, sample);
        memmove(pulls->sample + at + 1, pulls->sample + at, sizeof *pulls->sample * (size_t)(pulls->count - at));
        pulls->sample[at] = sample;
        pulls->pull[pulls->count++] = (cplx){0, 0};
        if (is_loop) pulls->earliest = pulls->sample[0], pulls->latest = pulls->sample[pulls->count - 1];
    }
    if (is_moved && !can_be_pulled(of)) return WIGGLY_ERROR_PIN;
    if (pulls->count == 0) return WIGGLY_OK;
    of->solver->pulls = of->problem.pulls = pulls;
    if (is_loop) problem_pose(of->solver, of->problem.desc, of->solver->y, &of->problem);
    return WIGGLY_OK;
}

/// How large an x must be that moves a point by `distance` with the largest coefficient.
static double x_of(double distance, double largest)
{
    const double least = 1e-20; // a point that hardly moves is not reached
    return fabs(distance) / fmax(largest, least);
}

/// Brings the values of all splines, which pins and bounds compare, to a size whose squares a double can hold.
static void scale_all(wiggly_group *g)
{
    double size = 0;
    for (int s = 0; s < g->splines; s++) size = fmax(size, scale_size(g->pulled[s].solver, &g->pulled[s].desc));
    for (int i = 0; i < g->pin_count; i++) {
        const wiggly_pin *pin = &g->pins[i];
        double largest = 0;
        for (int k = 0; k < 6 * pin->pull_count; k++)
            largest = fmax(largest, fabs(pin->pulls[k / 6].c[k % 6 / 2][k % 2]));
        for (int axis = 0; axis < 3; axis++) size = fmax(size, x_of(pin->to[axis], largest));
    }
    for (int b = 0; b < g->bound_count; b++) {
        double largest = 0;
        for (int k = 0; k < 2 * g->splines; k++) largest = fmax(largest, fabs(g->bounds[b].c[k / 2][k % 2]));
        size = fmax(size, x_of(g->bounds[b].least, largest));
    }
    g->unit = scale_for(size);
    for (int s = 0; s < g->splines; s++) scale_values(g->pulled[s].solver, g->unit, &g->pulled[s].desc);
}

// --- rows ------------------------------------------------------------------------------------------------------------

/// How many parts of a spline's x are known at a sample: none, Re x, or both.
static int known_at(const problem *p, int sample)
{
    for (int k = 0; k < p->desc->knot_count; k++) {
        if (p->desc->knots[k].sample == sample) return 1 + problem_is_whole(p, &p->desc->knots[k]);
    }
    return 0;
}

static double softness(double reach)
{
    double ratio = firm / reach, lack = fmax(0, ratio * ratio - 1);
    return lack * lack;
}

/// Adds the rows of the pins of one sample. Splines without pulls there do not take part.
static void add_rows(wiggly_group *g, const int *order, int pin_count)
{
    const int n = 3 * pin_count, columns = 2 * g->splines, sample = g->pins[order[0]].sample, first = g->rows;
    double *b = g->scratch, *held = b + n * columns, *square = held + n * columns, *vectors = square + n * n,
           *values = vectors + n * n, largest = 0;
    memset(b, 0, sizeof *b * (size_t)(n * columns));
    for (int p = 0; p < pin_count; p++) {
        const wiggly_pin *pin = &g->pins[order[p]];
        for (int i = 0; i < pin->pull_count; i++) {
            const wiggly_pull *pull = &pin->pulls[i];
            const pulled *of = &g->pulled[pull->spline];
            if (!is_pulled_at(&of->pulls, sample)) continue;
            for (int axis = 0; axis < 3; axis++) {
                double *at = b + columns * (3 * p + axis) + 2 * pull->spline;
                at[0] += pull->c[axis][0];
                if (of->desc.mode == WIGGLY_COMPLEX) at[1] -= pull->c[axis][1];
            }
        }
    }
    memcpy(held, b, sizeof *b * (size_t)(n * columns));
    for (int s = 0; s < g->splines; s++) { // B°: keyed samples cannot move Re x, poses and still samples neither part
        const int known = known_at(&g->pulled[s].problem, sample);
        for (int r = 0; r < n; r++) memset(held + columns * r + 2 * s, 0, (size_t)known * sizeof *held);
    }
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            double sum = 0;
            for (int k = 0; k < columns; k++) sum += held[columns * i + k] * held[columns * j + k];
            square[n * i + j] = sum;
        }
    }
    symmetric_eigen(n, square, values, vectors);
    largest = fmax(0, values[n - 1]);
    for (int i = 0; i < n; i++) {
        double reach = largest > 0 ? values[i] / largest : 0;
        if (!(reach >= out_of_reach)) continue;
        double *on = g->on + columns * g->rows, want = 0;
        memset(on, 0, sizeof *on * (size_t)columns);
        for (int r = 0; r < n; r++) {
            double part = vectors[n * i + r];
            want += part * g->pins[order[r / 3]].to[r % 3];
            for (int k = 0; k < columns; k++) on[k] += part * b[columns * r + k];
        }
        g->row[g->rows++] = (pin_row){.sample = sample, .first = first, .want = want, .soft = softness(reach)};
    }
    for (int r = first; r < g->rows; r++) g->row[r].count = g->rows - first;
}

/// A bound's coefficients on Re x and Im x of a spline, from c.
static void put_coefficients(const pulled *of, const double c[2], double on[2])
{
    on[0] = c[0];
    on[1] = of->desc.mode == WIGGLY_COMPLEX ? -c[1] : 0;
}

/// How many parts of x cannot move a bound's point, because a knot fixes them.
static int barred(const pulled *of, int sample)
{
    if (bound_tail_moves(&of->tail, sample)) return 0;
    const int at = sample_of(of, sample);
    return at >= 0 ? known_at(&of->problem, at) : 0;
}

double wiggly_group_reach(const wiggly_group *g, const wiggly_bound *bound)
{
    double all = 0, rest = 0;
    for (int s = 0; s < g->splines; s++) {
        const pulled *of = &g->pulled[s];
        double own[2];
        put_coefficients(of, bound->c[s], own);
        const bool is_moved = sample_of(of, bound->sample) >= 0 || bound_tail_moves(&of->tail, bound->sample);
        for (int part = 0; part < 2; part++) {
            const double square = own[part] * own[part];
            all += square;
            if (is_moved && part >= barred(of, bound->sample)) rest += square;
        }
    }
    for (int r = 0; r < g->fixed; r++) { // less what is along the pins' rows
        const double *on = g->on + 2 * g->splines * r;
        double product = 0, square = 0;
        if (g->row[r].sample != bound->sample) continue;
        for (int s = 0; s < g->splines; s++) {
            double own[2];
            put_coefficients(&g->pulled[s], bound->c[s], own);
            for (int part = barred(&g->pulled[s], bound->sample); part < 2; part++) {
                product += own[part] * on[2 * s + part];
                square += on[2 * s + part] * on[2 * s + part];
            }
        }
        rest -= (square > 0 ? product * product / square : 0) / (1 + g->row[r].soft);
    }
    return all > 0 ? fmax(0, rest / all) : 0;
}

// --- the system of the pins ------------------------------------------------------------------------------------------

/// For each row, finds the pull at its sample.
static void match_rows(wiggly_group *g, const pulled *of)
{
    for (int r = 0; r < g->rows; r++) {
        const int sample = r < g->fixed ? g->row[r].sample : sample_of(of, g->row[r].sample);
        g->pull_of[r] = is_pulled_at(&of->pulls, sample) ? search_pull(&of->pulls, sample) : -1;
    }
}

WIDEST static void add_two(double *restrict sum, double u, const double *restrict a, double v,
                           const double *restrict b, int count)
{
    for (int i = 0; i < count; i++) sum[i] += u * a[i] + v * b[i];
}

/// Adds the effect of bounds after a spline's last knot to the lower triangle of S.
static void add_tail(wiggly_group *g, int spline)
{
    const bound_tail *tail = &g->pulled[spline].tail;
    for (int r = g->fixed; r < g->rows; r++) {
        const wiggly_bound *bound = g->row[r].bound;
        if (bound_tail_moves(tail, bound->sample))
            g->tail_rows[r] = bound_tail_row(tail, bound->sample, bound->c[spline]);
    }
    for (int r = g->fixed; r < g->rows; r++) {
        if (!bound_tail_moves(tail, g->row[r].sample)) continue;
        memset(g->e, 0, sizeof *g->e * (size_t)tail->desc.samples);
        bound_tail_press(tail, &g->tail_rows[r], 1, g->pressed, g->e);
        for (int k = r; k < g->rows; k++) {
            if (bound_tail_moves(tail, g->row[k].sample))
                g->system[g->rows * k + r] += bound_tail_see(tail, &g->tail_rows[k], g->e);
        }
    }
}

static void read_pulled(const pulled *of, double *x)
{
    for (int i = 0; i < of->pulls.count; i++)
        memcpy(x + 2 * i, of->solver->rows.x + 2 * (of->pulls.sample[i] - of->problem.first), 2 * sizeof *x);
}

/// x at the pulled samples from knots and equilibrium alone.
static bool find_alone(const pulled *of, double *alone)
{
    const problem *p = &of->problem;
    problem_set_rows(of->solver, p);
    const minimum found = solver_minimise(of->solver);
    if (!found.solved || (found.lost && p->free_end)) return false;
    read_pulled(of, alone);
    for (int i = 0; i < of->pulls.count; i++) {
        int sample = of->pulls.sample[i];
        if (p->response.total) alone[2 * i] += p->about[sample] - p->y[sample];
        if (p->response.im) alone[2 * i + 1] += p->response.im[sample];
    }
    return true;
}

/// Finds x of a spline at its pulled samples under single pulls, and without any, by two solves per pull with one factor. Adds it to the lower
/// triangle of S, and subtracts its motion without pulls from the targets. False if the spline is singular.
static bool respond(wiggly_group *g, int spline)
{
    pulled *of = &g->pulled[spline];
    const int n = g->rows, width = 2 * of->pulls.count;
    double *const z = g->compliance;
    memset(of->pulls.pull, 0, sizeof *of->pulls.pull * (size_t)of->pulls.count);
    of->spread = 0;
    if (!find_alone(of, g->alone)) {
        of->problem.level_slope = true; // as for a spline without pins
        if (!of->problem.free_end || !find_alone(of, g->alone)) return false;
    }
    for (int i = 0; i < width; i++) {
        memset(z + width * i, 0, sizeof *z * (size_t)width);
        if (i % 2 == 1 && !of->solver->rows.is_complex) continue;
        system_forget_known(&of->solver->rows);
        of->pulls.pull[i / 2] = (cplx){i % 2 == 0, i % 2 == 1};
        const minimum found = solver_find(of->solver);
        of->pulls.pull[i / 2] = (cplx){0, 0};
        if (!found.solved) return false;
        read_pulled(of, z + width * i);
    }
    for (int i = 0; i < width; i++) { // what is left of symmetry: S is nearly singular where pins and bounds meet
        for (int j = 0; j < i; j++) z[width * i + j] = z[width * j + i] = 0.5 * (z[width * i + j] + z[width * j + i]);
    }
    of->spread = of->solver->band.largest;
    match_rows(g, of);
    const double *const all_on = g->on + 2 * spline;
    for (int k = 0; k < width; k++) {
        for (int r = 0; r < n; r++) {
            const double *on = all_on + 2 * g->splines * r, *at = z + width * k + 2 * g->pull_of[r];
            g->answer[n * k + r] = g->pull_of[r] < 0 ? 0 : at[0] * on[0] + at[1] * on[1];
        }
    }
    for (int r = 0; r < n; r++) {
        const double *on = all_on + 2 * g->splines * r;
        const int i = 2 * g->pull_of[r];
        if (i < 0) continue;
        add_two(g->system + n * r, of->scale * on[0], g->answer + n * i, of->scale * on[1], g->answer + n * (i + 1),
                r + 1);
        g->miss[r] -= on[0] * g->alone[i] + on[1] * g->alone[i + 1];
    }
    return true;
}

/// Softens directions that can barely be reached.
static void soften(wiggly_group *g)
{
    const int n = g->rows;
    for (int from = 0, count; from < n; from += count) {
        count = g->row[from].count;
        double *block = g->scratch, *vectors = block + count * count, *values = vectors + count * count, most = 0,
               softest = 0;
        for (int i = 0; i < count; i++) softest = fmax(softest, g->row[from + i].soft);
        if (softest > 0) {
            for (int i = 0; i < count * count; i++) {
                const int row = from + i / count, column = from + i % count;
                block[i] = g->system[row > column ? n * row + column : n * column + row];
            }
            symmetric_eigen(count, block, values, vectors);
            most = fmax(0, values[count - 1]);
        }
        for (int i = from; i < from + count; i++) {
            g->soft[i] = g->row[i].soft * most;
            g->system[n * i + i] += g->soft[i];
        }
    }
}

// --- which bounds push -----------------------------------------------------------------------------------------------

static double *reduced_row_of(const wiggly_group *g, int i)
{
    return &g->reduced[g->rows * (g->fixed + i) + g->fixed];
}

/// The conditions of the search are the bounds; where λ holds the pins, they are S' λ ≥ want'.
static bool bounds_begin(void *user)
{
    wiggly_group *g = user;
    for (int i = 0; i < g->search.count; i++) {
        g->search.value[i] = -g->want[g->fixed + i];
        g->search.is_open[i] = reduced_row_of(g, i)[i] > 0;
    }
    g->search.limit[0].at = 0;
    return true;
}

/// With stiffness D and its root E, (S'⁻¹ + D)⁻¹ = S' − S' E (1 + E S' E)⁻¹ E S'.
static bool bounds_factor(void *user, const double *stiffness)
{
    wiggly_group *g = user;
    const int m = g->search.count;
    for (int i = 0; i < m; i++) {
        const double *row = reduced_row_of(g, i);
        g->root[i] = sqrt(stiffness[i]);
        for (int j = 0; j <= i; j++) g->square[m * i + j] = (i == j) + g->root[i] * row[j] * g->root[j];
    }
    symmetric_reduce(m, m, g->square);
    return true;
}

static void bounds_solve(void *user, double *force)
{
    const wiggly_group *g = user;
    const int m = g->search.count;
    symmetric_multiply(m, g->rows, reduced_row_of(g, 0), force, g->product);
    memcpy(force, g->product, sizeof *force * (size_t)m);
    for (int i = 0; i < m; i++) g->product[i] *= g->root[i];
    symmetric_solve(m, g->square, g->product);
    for (int i = 0; i < m; i++) g->product[i] *= g->root[i];
    for (int i = 0; i < m; i++) {
        for (int j = 0; j < m; j++)
            force[i] -= (i >= j ? reduced_row_of(g, i)[j] : reduced_row_of(g, j)[i]) * g->product[j];
    }
}

/// λ with the pushing bounds as equalities. It is right if none of them pulls and no other bound is violated. If not, the worst one is
/// exchanged and all is solved again: nearly equal bounds are hard to tell apart.
static bool bounds_finish(void *user)
{
    wiggly_group *g = user;
    const int m = g->search.count;
    double *lambda = g->lambda + g->fixed;
    const double *want = g->want + g->fixed;
    for (int i = 0; i < m; i++) g->presses[i] = one_sided_holds(&g->search, i) > 0;
    for (int exchanges = 0; exchanges <= m; exchanges++) {
        int count = 0, worst = -1;
        double most = g->slack;
        for (int i = 0; i < m; i++) {
            if (g->presses[i]) g->pressing[count++] = i;
        }
        for (int i = 0; i < count; i++) {
            g->product[i] = want[g->pressing[i]];
            for (int j = 0; j <= i; j++) g->square[count * i + j] = reduced_row_of(g, g->pressing[i])[g->pressing[j]];
        }
        symmetric_reduce(count, count, g->square);
        symmetric_solve(count, g->square, g->product);
        memset(lambda, 0, sizeof *lambda * (size_t)m);
        for (int i = 0; i < count; i++) lambda[g->pressing[i]] = g->product[i];
        symmetric_multiply(m, g->rows, reduced_row_of(g, 0), lambda, g->product);
        for (int i = 0; i < m; i++) {
            const double miss = g->presses[i] ? -lambda[i] : want[i] - g->product[i];
            if (g->scale[i] > 0 && miss / g->scale[i] > most) most = miss / g->scale[i], worst = i;
        }
        if (worst < 0) {
            for (int i = 0; i < m; i++) lambda[i] = fmax(lambda[i], 0);
            return true;
        }
        g->presses[worst] = !g->presses[worst];
    }
    return false;
}

/// λ for the rows' targets g->want, not below 0 for bounds. False if it is not found.
static bool find_pushes(wiggly_group *g)
{
    const int n = g->rows, fixed = g->fixed;
    double *a = g->reduced;
    g->slack = 0;
    for (int r = 0; r < n; r++) g->slack = fmax(g->slack, near_enough * fabs(g->want[r]));
    memcpy(a, g->system, sizeof *a * (size_t)(n * n));
    symmetric_reduce(n, fixed, a);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < i && j < fixed; j++) g->want[i] -= a[n * i + j] * g->want[j];
        if (i < fixed) g->want[i] /= a[n * i + i];
    }
    for (int i = fixed; i < n; i++) { // in units of each bound's own response; 0 if the pins determine it
        const double own = a[n * i + i];
        g->scale[i - fixed] = own > lost * g->system[n * i + i] ? 1 / sqrt(own) : 0;
        g->want[i] *= g->scale[i - fixed];
    }
    for (int i = fixed; i < n; i++) {
        for (int k = fixed; k <= i; k++) a[n * i + k] *= g->scale[i - fixed] * g->scale[k - fixed];
    }
    one_sided *o = &g->search;
    o->user = g, o->begin = bounds_begin, o->factor = bounds_factor, o->solve = bounds_solve,
    o->finish = bounds_finish;
    o->count = n - fixed, o->limits = 1, o->limit[0].sign = 1;
    memset(g->lambda + fixed, 0, sizeof *g->lambda * (size_t)o->count);
    const bool found = one_sided_solve(o, 0);
    for (int i = fixed; i < n; i++) g->lambda[i] *= g->scale[i - fixed];
    for (int i = fixed - 1; i >= 0; i--) {
        g->lambda[i] = g->want[i];
        for (int k = i + 1; k < n; k++) g->lambda[i] -= a[n * k + i] * g->lambda[k];
        g->lambda[i] /= a[n * i + i];
    }
    return found;
}

// --- the curves ------------------------------------------------------------------------------------------------------

/// Adds the effect of bounds after the last knot to a curve.
static void press_tail(wiggly_group *g, int spline, wiggly_curve *curve)
{
    pulled *of = &g->pulled[spline];
    bool any = false;
    for (int r = g->fixed; r < g->rows; r++) {
        const wiggly_bound *bound = g->row[r].bound;
        if (g->lambda[r] == 0 || !bound_tail_moves(&of->tail, bound->sample)) continue;
        if (!any) memset(of->e, 0, sizeof *of->e * (size_t)of->tail.desc.samples);
        const tail_row row = bound_tail_row(&of->tail, bound->sample, bound->c[spline]);
        bound_tail_press(&of->tail, &row, g->lambda[r], g->pressed, of->e);
        any = true;
    }
    if (!any) return;
    bound_tail_add(&of->tail, of->e, curve);
    for (int i = of->tail.begin + 1; i < of->tail.end; i++) {
        curve->total[i] += of->e[i];
        if (curve->floats) curve->floats[(size_t)i * (curve->stride ? curve->stride : 1)] = (float)curve->total[i];
    }
}

/// Solves all splines under the pulls that λ gives.
static wiggly_status solve_splines(wiggly_group *g)
{
    wiggly_status worst = WIGGLY_OK;
    for (int s = 0; s < g->splines; s++) {
        pulled *of = &g->pulled[s];
        memset(of->pulls.pull, 0, sizeof *of->pulls.pull * (size_t)of->pulls.count);
        match_rows(g, of);
        for (int r = 0; r < g->rows; r++) {
            if (g->pull_of[r] < 0) continue;
            const double *on = g->on + 2 * g->splines * r + 2 * s, force = of->scale * g->lambda[r];
            cplx *pull = &of->pulls.pull[g->pull_of[r]];
            pull->re += on[0] * force, pull->im += on[1] * force;
        }
        const wiggly_status status = solver_solve_scaled(of->solver, &of->desc, of->curve);
        press_tail(g, s, of->curve);
        worst = status > worst ? status : worst;
    }
    return worst;
}

/// x of a solved spline: from the caller's arrays, else from the solver's.
static cplx solved_x(const pulled *of, int sample)
{
    const wiggly_curve *curve = of->curve;
    return (cplx){(curve->re ? curve->re : of->solver->re)[sample], (curve->im ? curve->im : of->solver->im)[sample]};
}

/// Re(c x) at a bound's point.
static double see_bound(const wiggly_group *g, const wiggly_bound *bound)
{
    double sum = 0;
    for (int s = 0; s < g->splines; s++) {
        const wiggly_curve *curve = g->pulled[s].curve;
        sum += bound->c[s][0] * curve->re[bound->sample] - bound->c[s][1] * curve->im[bound->sample];
    }
    return sum;
}

/// Finds the rows' misses; true if these are negligible compared with the targets.
static bool find_miss(wiggly_group *g)
{
    double most = 0, size = 0;
    for (int r = 0; r < g->rows; r++) {
        const pin_row *row = &g->row[r];
        const double *on = g->on + 2 * g->splines * r;
        double miss = row->want - g->soft[r] * g->lambda[r];
        size = fmax(size, fabs(row->want));
        if (row->bound) {
            const double seen = see_bound(g, row->bound);
            miss = row->want - seen - g->soft[r] * g->lambda[r];
            size = fmax(size, fabs(seen));
        }
        for (int s = 0; s < g->splines && !row->bound; s++) {
            if (on[2 * s] == 0 && on[2 * s + 1] == 0) continue;
            const cplx x = solved_x(&g->pulled[s], row->sample);
            const double seen = on[2 * s] * x.re + on[2 * s + 1] * x.im;
            miss -= seen;
            size = fmax(size, fabs(seen));
        }
        g->miss[r] = miss;
        if (!row->bound || g->lambda[r] > 0 || miss > 0) most = fmax(most, fabs(miss));
    }
    return most <= near_enough * size;
}

/// Adds what the misses leave to the curves' errors: the pulls that would meet them have that energy, Σ λ S λ, and so move no x by more than
/// √(D energy).
static wiggly_status add_miss(wiggly_group *g, double energy, wiggly_status status)
{
    for (int s = 0; s < g->splines && status < WIGGLY_ERROR_ARGUMENT; s++) {
        const pulled *of = &g->pulled[s];
        if (of->pulls.count == 0) continue;
        const double moved = of->spread * sqrt(of->scale * energy);
        const wiggly_status own = solver_add_error(of->solver, of->curve, moved, WIGGLY_OK);
        status = own > status ? own : status;
    }
    return status;
}

/// λ and the curves if all rows are equalities.
static wiggly_status pull_pins(wiggly_group *g)
{
    const int n = g->rows;
    wiggly_status status = WIGGLY_OK;
    symmetric_reduce(n, n, g->system);
    for (int round = 0, met = 0;; round++) {
        const double energy = symmetric_solve(n, g->system, g->miss);
        const wiggly_status judged = met || round == MAX_ROUNDS ? add_miss(g, energy, status) : status;
        if (round == MAX_ROUNDS || (met && judged == status)) return judged;
        for (int r = 0; r < n; r++) g->lambda[r] += g->miss[r];
        status = solve_splines(g);
        met = find_miss(g);
    }
}

/// λ and the curves if some rows are bounds.
static wiggly_status press_bounds(wiggly_group *g)
{
    const int n = g->rows;
    wiggly_status status = solve_splines(g);
    bool met = find_miss(g);
    for (int round = 0; round < MAX_ROUNDS && !met; round++) {
        for (int r = 0; r < n; r++) { // S λ + the misses: the targets for a λ computed from scratch
            g->want[r] = g->miss[r];
            for (int k = 0; k < n; k++) g->want[r] += g->system[r > k ? n * r + k : n * k + r] * g->lambda[k];
        }
        const bool found = find_pushes(g);
        status = solve_splines(g);
        if (!found && status < WIGGLY_INEXACT) status = WIGGLY_INEXACT;
        met = find_miss(g);
    }
    double energy = 0; // of each row alone
    for (int r = 0; r < n && !met; r++) {
        const bool is_free = r >= g->fixed && g->lambda[r] == 0 && g->miss[r] <= 0;
        if (!is_free) energy += g->miss[r] * (g->miss[r] / g->system[(n + 1) * r]);
    }
    return add_miss(g, energy, status);
}

static wiggly_status solve_group(wiggly_group *g, const wiggly_desc *descs, const double *weights,
                                 wiggly_curve *curves)
{
    for (int s = 0; s < g->splines; s++) {
        if (!(weights[s] > 0 && weights[s] < INFINITY)) return WIGGLY_ERROR_NUMBER;
    }
    wiggly_status status = read_pins(g);
    if (status == WIGGLY_OK) status = read_splines(g, descs, curves);
    if (status == WIGGLY_OK) status = read_bounds(g);
    if (status != WIGGLY_OK) return status;
    scale_all(g);
    for (int s = 0; s < g->splines && status == WIGGLY_OK; s++) status = pose_pins(g, s, weights[s]);
    for (int s = 0; s < g->splines && status == WIGGLY_OK && g->bound_count > 0; s++) status = pose_bounds(g, s);
    if (status != WIGGLY_OK) return status;
    for (int from = 0, to; from < g->pin_count; from = to) {
        const int sample = g->pins[g->order[from]].sample;
        for (to = from + 1; to < g->pin_count && g->pins[g->order[to]].sample == sample;) to++;
        add_rows(g, g->order + from, to - from);
    }
    g->fixed = g->rows;

    // The rows of bounds, except those that knots and pins determine.
    for (int b = 0; b < g->bound_count; b++) {
        wiggly_bound *const bound = &g->bounds[b];
        const double reach = wiggly_group_reach(g, bound);
        bound->push = 0;
        if (!(reach >= out_of_reach)) continue;
        for (int s = 0; s < g->splines; s++) {
            const problem *p = &g->pulled[s].problem;
            double *on = g->on + 2 * g->splines * g->rows + 2 * s, re, im;
            put_coefficients(&g->pulled[s], bound->c[s], on);
            if (!p->settles || bound->sample <= p->latest) continue;
            // After the last knot x is e^{p…} times x at the knot.
            problem_fill_tail(g->pulled[s].solver, p, (cplx){1, 0}, bound->sample - p->latest, 1, &re, &im);
            const double c[2] = {on[0], on[1]};
            on[0] = c[0] * re + c[1] * im;
            on[1] = c[1] * re - c[0] * im;
        }
        g->row[g->rows] = (pin_row){.sample = bound->sample,
                                    .first = g->rows,
                                    .count = 1,
                                    .want = bound->least,
                                    .soft = softness(reach) / reach + least_soft,
                                    .bound = bound};
        g->rows++;
    }

    const int n = g->rows;
    bool all = true;
    memset(g->system, 0, sizeof *g->system * (size_t)(n * n));
    memset(g->lambda, 0, sizeof *g->lambda * (size_t)n);
    for (int r = 0; r < n; r++) g->miss[r] = g->row[r].want *= g->unit;
    for (int s = 0; s < g->splines; s++) {
        if (n > g->fixed) add_tail(g, s);
        if (g->pulled[s].pulls.count > 0 && !respond(g, s)) all = false;
    }
    soften(g);
    status = n > g->fixed ? press_bounds(g) : pull_pins(g);

    // What is left of pins and bounds.
    for (int i = 0; i < g->pin_count; i++) {
        wiggly_pin *pin = &g->pins[i];
        for (int axis = 0; axis < 3; axis++) pin->left[axis] = pin->to[axis] * g->unit;
        for (int k = 0; k < pin->pull_count; k++) {
            const wiggly_pull *by = &pin->pulls[k];
            if (!moves(pin, by->spline)) continue;
            const cplx x = solved_x(&g->pulled[by->spline], pin->sample);
            for (int axis = 0; axis < 3; axis++) pin->left[axis] -= by->c[axis][0] * x.re - by->c[axis][1] * x.im;
        }
        for (int axis = 0; axis < 3; axis++) pin->left[axis] /= g->unit;
    }
    for (int b = 0; b < g->bound_count; b++)
        g->bounds[b].left = (g->bounds[b].least * g->unit - see_bound(g, &g->bounds[b])) / g->unit;
    for (int r = g->fixed; r < g->rows; r++) g->row[r].bound->push = g->lambda[r] / g->unit;
    for (int s = 0; s < g->splines; s++)
        solver_scale_back(g->pulled[s].solver, desc_at(descs, s), g->pulled[s].curve);
    return all ? status : WIGGLY_SINGULAR;
}

wiggly_status wiggly_group_solve(wiggly_group *g, const wiggly_desc *descs, const double *weights,
                                 wiggly_curve *curves, int spline_count, wiggly_pin *pins, int pin_count)
{
    return wiggly_group_solve_bounded(g, descs, weights, curves, spline_count, pins, pin_count, NULL, 0);
}

wiggly_status wiggly_group_solve_bounded(wiggly_group *g, const wiggly_desc *descs, const double *weights,
                                         wiggly_curve *curves, int spline_count, wiggly_pin *pins, int pin_count,
                                         wiggly_bound *bounds, int bound_count)
{
    if (!g || !descs || !weights || !curves || spline_count < 1 || pin_count < 0 || (pin_count > 0 && !pins) ||
        bound_count < 0 || (bound_count > 0 && !bounds))
        return WIGGLY_ERROR_ARGUMENT;
    if (spline_count > g->most_splines || pin_count > g->most_pins || bound_count > g->most_bounds)
        return WIGGLY_ERROR_CAPACITY;
    g->splines = spline_count, g->pin_count = pin_count, g->bound_count = bound_count;
    g->pins = pins, g->bounds = bounds;
    g->rows = g->fixed = 0;
    const host_state host = host_leave();
    const wiggly_status status = solve_group(g, descs, weights, curves);
    host_return(&host);
    return status;
}
