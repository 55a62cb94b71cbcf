/// Pins: splines solved together, so that the points they move reach given places (docs/mathematics.md, Pins).
//
// Each spline is solved without pins (its start and end are the same as with them) and for unit pulls on Re x and Im x at each pinned
// sample, and the response is read at all of these. With R_s the rows' coefficients of spline s and Z_s its compliance,
//
//     S = Σ_s R_sᵀ Z_s R_s / w_s,     (S + diag(φ S_max)) λ = want − Σ_s R_s x_s⁰,
//
// and every spline is solved once more under the pulls R_sᵀ λ / w_s.
#include "spline/host.h"
#include "spline/pin_group.h"
#include "spline/symmetric.h"
#include "spline/wide.h"
#include <math.h>
#include <string.h>

/// Correction rounds, and the miss they tolerate, as a share of the largest target.
enum { MAX_ROUNDS = 3 };
static const double near_enough = 1e-10;

// --- arguments -------------------------------------------------------------------------------------------------------

static bool is_finite3(const double *v) { return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]); }

static wiggly_status check_bounds(const wiggly_group *g, int spline_count, const wiggly_bound *bounds,
                                  int bound_count)
{
    if (bound_count < 0 || (bound_count > 0 && !bounds)) return WIGGLY_ERROR_ARGUMENT;
    if (bound_count > g->bounds) return WIGGLY_ERROR_CAPACITY;
    for (int s = 0; s < spline_count && bound_count > 0; s++) {
        const wiggly_curve *curve = g->pulled[s].curve;
        if (!curve->total || !curve->re || !curve->im) return WIGGLY_ERROR_ARGUMENT;
    }
    for (int b = 0; b < bound_count; b++) {
        if (!bounds[b].c) return WIGGLY_ERROR_ARGUMENT;
        if (!isfinite(bounds[b].least)) return WIGGLY_ERROR_NUMBER;
        for (int s = 0; s < spline_count; s++) {
            if (bounds[b].sample < 0 || bounds[b].sample >= g->pulled[s].desc.samples) return WIGGLY_ERROR_PIN;
            if (!isfinite(bounds[b].c[s][0]) || !isfinite(bounds[b].c[s][1])) return WIGGLY_ERROR_NUMBER;
        }
    }
    return WIGGLY_OK;
}

static wiggly_status check_pin(const wiggly_pin *pin, int spline_count)
{
    if (pin->pull_count < 0 || (pin->pull_count > 0 && !pin->pulls)) return WIGGLY_ERROR_ARGUMENT;
    if (!is_finite3(pin->to)) return WIGGLY_ERROR_NUMBER;
    for (int i = 0; i < pin->pull_count; i++) {
        if (pin->pulls[i].spline < 0 || pin->pulls[i].spline >= spline_count) return WIGGLY_ERROR_ARGUMENT;
        for (int axis = 0; axis < 3; axis++) {
            const double *c = pin->pulls[i].c[axis];
            if (!isfinite(c[0]) || !isfinite(c[1])) return WIGGLY_ERROR_NUMBER;
        }
    }
    return WIGGLY_OK;
}

/// Copies the caller's descriptions and curves.
static wiggly_status read_splines(wiggly_group *g, const wiggly_desc *descs, wiggly_curve *curves, int spline_count)
{
    for (int s = 0; s < spline_count; s++) {
        pulled *of = &g->pulled[s];
        of->curve = curve_at(curves, curves->size, s);
        if (!curve_fits(of->curve)) return WIGGLY_ERROR_SIZE;
        of->curve->knot = -1;
        wiggly_status status = desc_read(desc_at(descs, s), &of->desc);
        if (status != WIGGLY_OK) return status;
        if (of->desc.samples < 1) return WIGGLY_ERROR_ARGUMENT;
        if (of->desc.knot_count > g->knots) return WIGGLY_ERROR_CAPACITY;
        status = problem_check(of->solver, &of->desc, &of->curve->knot);
        if (status != WIGGLY_OK) return status;
    }
    return WIGGLY_OK;
}

static wiggly_status check(wiggly_group *g, const wiggly_desc *descs, const double *weights, wiggly_curve *curves,
                           int spline_count, const wiggly_pin *pins, int pin_count)
{
    if (!g || !descs || !weights || !curves || spline_count < 1 || pin_count < 0 || (pin_count > 0 && !pins))
        return WIGGLY_ERROR_ARGUMENT;
    if (spline_count > g->splines || pin_count > g->pins) return WIGGLY_ERROR_CAPACITY;
    for (int s = 0; s < spline_count; s++) {
        if (!(weights[s] > 0 && weights[s] < INFINITY)) return WIGGLY_ERROR_NUMBER;
    }
    for (int i = 0; i < pin_count; i++) {
        wiggly_status status = check_pin(&pins[i], spline_count);
        if (status != WIGGLY_OK) return status;
    }
    return read_splines(g, descs, curves, spline_count);
}

/// Sorts pins by sample; pins of one sample keep their order.
static void order_pins(wiggly_group *g, const wiggly_pin *pins, int pin_count)
{
    for (int i = 0; i < pin_count; i++) {
        int at = i;
        for (; at > 0 && pins[g->order[at - 1]].sample > pins[i].sample; at--) g->order[at] = g->order[at - 1];
        g->order[at] = i;
    }
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

static void find_pulls(wiggly_group *g, int spline, const wiggly_pin *pins, int pin_count)
{
    system_pulls *pulls = &g->pulled[spline].pulls;
    pulls->count = 0;
    for (int i = 0; i < pin_count; i++) {
        const wiggly_pin *pin = &pins[g->order[i]];
        if (!moves(pin, spline)) continue;
        if (pulls->count == 0 || pulls->sample[pulls->count - 1] != pin->sample)
            pulls->sample[pulls->count++] = pin->sample;
    }
    for (int i = 0; i < pulls->count; i++) pulls->pull[i] = (cplx){0, 0};
    pulls->earliest = pulls->count > 0 ? pulls->sample[0] : -1;
    pulls->latest = pulls->count > 0 ? pulls->sample[pulls->count - 1] : -1;
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

/// Whether all pulls are on samples of the spline; a loop's last sample is its first.
static bool are_inside(const system_pulls *pulls, const wiggly_desc *desc)
{
    int end = desc->samples - (desc->start == WIGGLY_LOOP ? 1 : 0);
    return pulls->count == 0 || (pulls->sample[0] >= 0 && pulls->sample[pulls->count - 1] < end);
}

static wiggly_status pose_spline(pulled *of, double weight)
{
    wiggly_solver *solver = of->solver;
    const wiggly_desc *desc = &of->desc;
    if (!are_inside(&of->pulls, desc)) return WIGGLY_ERROR_PIN;
    solver->pulls = of->pulls.count > 0 ? &of->pulls : NULL;
    problem_pose(solver, desc, solver->y, &of->problem);
    if (of->pulls.count > 0 && of->problem.count < 3) {
        of->pulls.count = 0; // too short to be moved by a pull
        solver->pulls = NULL;
        problem_pose(solver, desc, solver->y, &of->problem);
    }
    if (of->pulls.count > 0 && !can_be_pulled(of)) return WIGGLY_ERROR_PIN;
    of->tail = bound_tail_of(&of->problem, weight);
    of->scale = of->problem.unit * desc->step * desc->step * desc->step / weight;
    return WIGGLY_OK;
}

static wiggly_status pose(wiggly_group *g, const double *weights, int spline_count, const wiggly_pin *pins,
                          int pin_count)
{
    for (int s = 0; s < spline_count; s++) {
        find_pulls(g, s, pins, pin_count);
        wiggly_status status = pose_spline(&g->pulled[s], weights[s]);
        if (status != WIGGLY_OK) return status;
    }
    return WIGGLY_OK;
}

/// Index of the pull on a sample; `count` if there is none.
static int find_pull(const system_pulls *pulls, int sample)
{
    int from = 0, to = pulls->count;
    if (sample < 0) return pulls->count;
    while (from < to) {
        const int middle = (from + to) / 2;
        if (pulls->sample[middle] < sample)
            from = middle + 1;
        else
            to = middle;
    }
    return from < pulls->count && pulls->sample[from] == sample ? from : pulls->count;
}

/// Adds a pull for a bound at a sample. A loop's pulls all count as knots, because it has no ends.
static void add_pull(system_pulls *pulls, int sample, bool is_loop)
{
    int at = pulls->count;
    if (find_pull(pulls, sample) < pulls->count) return;
    for (; at > 0 && pulls->sample[at - 1] > sample; at--) pulls->sample[at] = pulls->sample[at - 1];
    pulls->sample[at] = sample;
    pulls->pull[pulls->count++] = (cplx){0, 0};
    if (is_loop) pulls->earliest = pulls->sample[0], pulls->latest = pulls->sample[pulls->count - 1];
}

/// Prepares a spline for bounds.
static wiggly_status pose_bounds(wiggly_group *g, int spline, const wiggly_bound *bounds, int bound_count)
{
    pulled *of = &g->pulled[spline];
    const bool is_loop = of->problem.start == WIGGLY_LOOP;
    bool is_moved = false;
    for (int b = 0; b < bound_count; b++) {
        if (bounds[b].c[spline][0] == 0 && bounds[b].c[spline][1] == 0) continue;
        const int sample = pin_rows_sample(of, bounds[b].sample);
        is_moved = true;
        if (sample >= 0) add_pull(&of->pulls, sample, is_loop);
    }
    if (is_moved && !can_be_pulled(of)) return WIGGLY_ERROR_PIN;
    if (of->pulls.count == 0) return WIGGLY_OK;
    of->solver->pulls = of->problem.pulls = &of->pulls;
    if (is_loop) problem_pose(of->solver, of->problem.desc, of->solver->y, &of->problem);
    return WIGGLY_OK;
}

// --- the system of the pins ------------------------------------------------------------------------------------------

/// For each row, finds the pull at its sample. Pins are in the same order as pulls.
static void match_rows(const pin_rows *rows, const pulled *of, int *pull_of)
{
    const system_pulls *pulls = &of->pulls;
    for (int r = 0, i = 0; r < rows->fixed; r++) {
        while (i < pulls->count && pulls->sample[i] < rows->row[r].sample) i++;
        pull_of[r] = i < pulls->count && pulls->sample[i] == rows->row[r].sample ? i : -1;
    }
    for (int r = rows->fixed; r < rows->count; r++) {
        const int i = find_pull(pulls, pin_rows_sample(of, rows->row[r].sample));
        pull_of[r] = i < pulls->count ? i : -1;
    }
}

WIDEST static void add_two(double *restrict sum, double u, const double *restrict a, double v,
                           const double *restrict b, int count)
{
    for (int i = 0; i < count; i++) sum[i] += u * a[i] + v * b[i];
}

/// Adds a spline to the lower triangle of S, and subtracts its motion without pulls from the targets.
static void add_spline(wiggly_group *g, int spline)
{
    const pulled *of = &g->pulled[spline];
    const pin_rows *rows = &g->rows;
    const int n = rows->count, width = 2 * of->pulls.count, columns = 2 * rows->splines;
    match_rows(rows, of, g->pull_of);
    for (int k = 0; k < width; k++) {
        const double *z = g->compliance + width * k;
        for (int r = 0; r < n; r++) {
            const double *on = rows->on + columns * r + 2 * spline;
            int i = 2 * g->pull_of[r];
            g->answer[n * k + r] = i < 0 ? 0 : z[i] * on[0] + z[i + 1] * on[1];
        }
    }
    for (int r = 0; r < n; r++) {
        const double *on = rows->on + columns * r + 2 * spline;
        int i = 2 * g->pull_of[r];
        if (i < 0) continue;
        add_two(g->system + n * r, of->scale * on[0], g->answer + n * i, of->scale * on[1], g->answer + n * (i + 1),
                r + 1);
        g->miss[r] -= on[0] * g->alone[i] + on[1] * g->alone[i + 1];
    }
}

/// Adds the effect of bounds after a spline's last knot to the lower triangle of S.
static void add_tail(wiggly_group *g, int spline)
{
    const bound_tail *tail = &g->pulled[spline].tail;
    const pin_rows *rows = &g->rows;
    for (int r = rows->fixed; r < rows->count; r++) {
        const wiggly_bound *bound = rows->row[r].bound;
        if (bound_tail_moves(tail, bound->sample))
            g->tail_rows[r] = bound_tail_row(tail, bound->sample, bound->c[spline]);
    }
    for (int r = rows->fixed; r < rows->count; r++) {
        if (!bound_tail_moves(tail, rows->row[r].sample)) continue;
        memset(g->e, 0, sizeof *g->e * (size_t)tail->desc.samples);
        bound_tail_press(tail, &g->tail_rows[r], 1, g->pressed, g->e);
        for (int k = r; k < rows->count; k++) {
            if (bound_tail_moves(tail, rows->row[k].sample))
                g->system[rows->count * k + r] += bound_tail_see(tail, &g->tail_rows[k], g->e);
        }
    }
}

static void read_pulled(const pulled *of, double *x)
{
    const system_rows *rows = &of->solver->rows;
    for (int i = 0; i < of->pulls.count; i++) {
        const double *at = rows->x + 2 * (of->pulls.sample[i] - of->problem.first);
        x[2 * i] = at[0];
        x[2 * i + 1] = at[1];
    }
}

/// x at the pulled samples from knots and equilibrium alone.
static bool find_alone(pulled *of, double *alone)
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

/// x at the pulled samples under single pulls, and without any: two solves per pull with one factor. False if the system is singular.
static bool respond_alone(pulled *of, double *compliance, double *alone)
{
    const int count = of->pulls.count, width = 2 * count;
    system_rows *rows = &of->solver->rows;
    memset(of->pulls.pull, 0, sizeof *of->pulls.pull * (size_t)count);
    of->spread = 0;
    if (!find_alone(of, alone)) {
        of->problem.level_slope = true; // as for a spline without pins
        if (!of->problem.free_end || !find_alone(of, alone)) return false;
    }
    for (int i = 0; i < width; i++) {
        double *row = compliance + width * i;
        memset(row, 0, sizeof *row * (size_t)width);
        if (i % 2 == 1 && !rows->is_complex) continue;
        system_forget_known(rows);
        of->pulls.pull[i / 2] = (cplx){i % 2 == 0, i % 2 == 1};
        const minimum found = solver_find(of->solver);
        of->pulls.pull[i / 2] = (cplx){0, 0};
        if (!found.solved) return false;
        read_pulled(of, row);
    }
    for (int i = 0; i < width; i++) { // what is left of symmetry: S is nearly singular where pins and bounds meet
        for (int j = 0; j < i; j++) {
            double *a = &compliance[width * i + j], *b = &compliance[width * j + i];
            *a = *b = 0.5 * (*a + *b);
        }
    }
    of->spread = of->solver->band.largest;
    return true;
}

/// Solves each spline for S and for the miss without pulls. False if one cannot be solved.
static bool respond(wiggly_group *g, int spline_count)
{
    const int n = g->rows.count;
    bool all = true;
    memset(g->system, 0, sizeof *g->system * (size_t)(n * n));
    for (int r = 0; r < n; r++) g->miss[r] = g->rows.row[r].want;
    for (int s = 0; s < spline_count; s++) {
        pulled *of = &g->pulled[s];
        if (g->rows.count > g->rows.fixed) add_tail(g, s);
        if (of->pulls.count == 0) continue;
        if (respond_alone(of, g->compliance, g->alone)) {
            add_spline(g, s);
        } else {
            all = false;
        }
    }
    return all;
}

/// Softens directions that can barely be reached.
static void soften(wiggly_group *g)
{
    const int n = g->rows.count;
    for (int from = 0, count; from < n; from += count) {
        count = g->rows.row[from].count;
        double *block = g->rows.scratch, *vectors = block + count * count, *values = vectors + count * count,
               most = 0, softest = 0;
        for (int i = 0; i < count; i++) softest = fmax(softest, g->rows.row[from + i].soft);
        for (int i = 0; i < count && softest > 0; i++) {
            for (int j = 0; j <= i; j++)
                block[count * i + j] = block[count * j + i] = g->system[n * (from + i) + from + j];
        }
        if (softest > 0) symmetric_eigen(count, block, values, vectors);
        for (int i = 0; i < count && softest > 0; i++) most = fmax(most, values[i]);
        for (int i = from; i < from + count; i++) {
            g->soft[i] = g->rows.row[i].soft * most;
            g->system[n * i + i] += g->soft[i];
        }
    }
}

/// The pulls on a spline, from λ.
static void set_pulls(wiggly_group *g, int spline)
{
    pulled *of = &g->pulled[spline];
    const pin_rows *rows = &g->rows;
    for (int i = 0; i < of->pulls.count; i++) of->pulls.pull[i] = (cplx){0, 0};
    match_rows(rows, of, g->pull_of);
    for (int r = 0; r < rows->count; r++) {
        if (g->pull_of[r] < 0) continue;
        const double *on = rows->on + 2 * rows->splines * r + 2 * spline, force = of->scale * g->lambda[r];
        cplx *pull = &of->pulls.pull[g->pull_of[r]];
        pull->re += on[0] * force, pull->im += on[1] * force;
    }
}

/// Adds the effect of bounds after the last knot to a curve.
static void press_tail(wiggly_group *g, int spline, wiggly_curve *curve)
{
    pulled *of = &g->pulled[spline];
    const pin_rows *rows = &g->rows;
    bool any = false;
    for (int r = rows->fixed; r < rows->count; r++) {
        const wiggly_bound *bound = rows->row[r].bound;
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

static wiggly_status solve_splines(wiggly_group *g)
{
    wiggly_status worst = WIGGLY_OK;
    for (int s = 0; s < g->rows.splines; s++) {
        pulled *of = &g->pulled[s];
        set_pulls(g, s);
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
    for (int s = 0; s < g->rows.splines; s++) {
        const wiggly_curve *curve = g->pulled[s].curve;
        sum += bound->c[s][0] * curve->re[bound->sample] - bound->c[s][1] * curve->im[bound->sample];
    }
    return sum;
}

/// Finds the rows' misses; true if these are negligible compared with the targets.
static bool find_miss(wiggly_group *g)
{
    const pin_rows *rows = &g->rows;
    double most = 0, size = 0;
    for (int r = rows->fixed; r < rows->count; r++) {
        const double seen = see_bound(g, rows->row[r].bound);
        g->miss[r] = rows->row[r].want - seen - g->soft[r] * g->lambda[r];
        size = fmax(size, fmax(fabs(rows->row[r].want), fabs(seen)));
        if (g->lambda[r] > 0 || g->miss[r] > 0) most = fmax(most, fabs(g->miss[r]));
    }
    for (int r = 0; r < rows->fixed; r++) {
        const double *on = rows->on + 2 * rows->splines * r;
        double miss = rows->row[r].want - g->soft[r] * g->lambda[r];
        size = fmax(size, fabs(rows->row[r].want));
        for (int s = 0; s < rows->splines; s++) {
            if (on[2 * s] == 0 && on[2 * s + 1] == 0) continue;
            cplx x = solved_x(&g->pulled[s], rows->row[r].sample);
            double seen = on[2 * s] * x.re + on[2 * s + 1] * x.im;
            miss -= seen;
            size = fmax(size, fabs(seen));
        }
        g->miss[r] = miss;
        most = fmax(most, fabs(miss));
    }
    return most <= near_enough * size;
}

/// Adds what the misses leave to the curves' errors: the pulls that would meet them have that energy, Σ λ S λ, and so move no x by more than
/// √(D energy).
static wiggly_status add_miss(wiggly_group *g, double energy, wiggly_status status)
{
    for (int s = 0; s < g->rows.splines && status < WIGGLY_ERROR_ARGUMENT; s++) {
        const pulled *of = &g->pulled[s];
        if (of->pulls.count == 0) continue;
        const double moved = of->spread * sqrt(of->scale * energy);
        const wiggly_status own = solver_add_error(of->solver, of->curve, moved, WIGGLY_OK);
        status = own > status ? own : status;
    }
    return status;
}

/// λ and the curves if all rows are equalities.
static wiggly_status pull(wiggly_group *g)
{
    const int n = g->rows.count;
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

/// S λ + the misses: the targets for a λ computed from scratch.
static void find_want(wiggly_group *g)
{
    const int n = g->rows.count;
    for (int r = 0; r < n; r++) {
        g->want[r] = g->miss[r];
        for (int k = 0; k < n; k++) g->want[r] += g->system[r > k ? n * r + k : n * k + r] * g->lambda[k];
    }
}

/// λ and the curves if some rows are bounds.
static wiggly_status press(wiggly_group *g)
{
    wiggly_status status = solve_splines(g);
    bool met = find_miss(g);
    for (int round = 0; round < MAX_ROUNDS && !met; round++) {
        find_want(g);
        const bool found = bounds_find_pushes(g, near_enough);
        status = solve_splines(g);
        if (!found && status < WIGGLY_INEXACT) status = WIGGLY_INEXACT;
        met = find_miss(g);
    }
    double energy = 0; // of each row alone
    for (int r = 0; r < g->rows.count && !met; r++) {
        const bool is_free = r >= g->rows.fixed && g->lambda[r] == 0 && g->miss[r] <= 0;
        if (!is_free) energy += g->miss[r] * (g->miss[r] / g->system[(g->rows.count + 1) * r]);
    }
    return add_miss(g, energy, status);
}

static void tell_bounds(const wiggly_group *g, wiggly_bound *bounds, int bound_count)
{
    for (int b = 0; b < bound_count; b++)
        bounds[b].left = (bounds[b].least * g->unit - see_bound(g, &bounds[b])) / g->unit;
    for (int r = g->rows.fixed; r < g->rows.count; r++) g->rows.row[r].bound->push = g->lambda[r] / g->unit;
}

double wiggly_group_reach(const wiggly_group *g, const wiggly_bound *bound)
{
    return pin_rows_reach(&g->rows, g->pulled, bound);
}

static void tell_left(const wiggly_group *g, wiggly_pin *pins, int pin_count)
{
    for (int i = 0; i < pin_count; i++) {
        wiggly_pin *pin = &pins[i];
        for (int axis = 0; axis < 3; axis++) pin->left[axis] = pin->to[axis] * g->unit;
        for (int k = 0; k < pin->pull_count; k++) {
            const wiggly_pull *pull = &pin->pulls[k];
            if (!moves(pin, pull->spline)) continue;
            cplx x = solved_x(&g->pulled[pull->spline], pin->sample);
            for (int axis = 0; axis < 3; axis++) pin->left[axis] -= pull->c[axis][0] * x.re - pull->c[axis][1] * x.im;
        }
        for (int axis = 0; axis < 3; axis++) pin->left[axis] /= g->unit;
    }
}

/// How large an x must be that moves a point by `distance` with the largest coefficient.
static double x_of(double distance, double largest)
{
    const double least = 1e-20; // a point that hardly moves is not reached
    return fabs(distance) / fmax(largest, least);
}

/// Brings the values of all splines, which pins and bounds compare, to a size whose squares a double can hold.
static void scale_all(wiggly_group *g, int spline_count, const wiggly_pin *pins, int pin_count,
                      const wiggly_bound *bounds, int bound_count)
{
    double size = 0;
    for (int s = 0; s < spline_count; s++) size = fmax(size, scale_size(g->pulled[s].solver, &g->pulled[s].desc));
    for (int i = 0; i < pin_count; i++) {
        const wiggly_pin *pin = &pins[i];
        double largest = 0;
        for (int k = 0; k < 6 * pin->pull_count; k++)
            largest = fmax(largest, fabs(pin->pulls[k / 6].c[k % 6 / 2][k % 2]));
        for (int axis = 0; axis < 3; axis++) size = fmax(size, x_of(pin->to[axis], largest));
    }
    for (int b = 0; b < bound_count; b++) {
        double largest = 0;
        for (int k = 0; k < 2 * spline_count; k++) largest = fmax(largest, fabs(bounds[b].c[k / 2][k % 2]));
        size = fmax(size, x_of(bounds[b].least, largest));
    }
    g->unit = scale_for(size);
    for (int s = 0; s < spline_count; s++) scale_values(g->pulled[s].solver, g->unit, &g->pulled[s].desc);
}

static wiggly_status solve(wiggly_group *g, const wiggly_desc *descs, const double *weights, wiggly_curve *curves,
                           int spline_count, wiggly_pin *pins, int pin_count, wiggly_bound *bounds, int bound_count)
{
    wiggly_status status = check(g, descs, weights, curves, spline_count, pins, pin_count);
    if (status != WIGGLY_OK) return status;
    status = check_bounds(g, spline_count, bounds, bound_count);
    if (status != WIGGLY_OK) return status;
    order_pins(g, pins, pin_count);
    scale_all(g, spline_count, pins, pin_count, bounds, bound_count);
    status = pose(g, weights, spline_count, pins, pin_count);
    for (int s = 0; s < spline_count && status == WIGGLY_OK && bound_count > 0; s++)
        status = pose_bounds(g, s, bounds, bound_count);
    if (status != WIGGLY_OK) return status;
    g->rows.splines = spline_count;
    pin_rows_find(&g->rows, g->pulled, pins, g->order, pin_count);
    pin_rows_add_bounds(&g->rows, g->pulled, bounds, bound_count);
    const int n = g->rows.count;
    for (int r = 0; r < n; r++) g->rows.row[r].want *= g->unit;
    const bool all = respond(g, spline_count);
    soften(g);
    memset(g->lambda, 0, sizeof *g->lambda * (size_t)n);
    status = n > g->rows.fixed ? press(g) : pull(g);
    tell_left(g, pins, pin_count);
    if (bound_count > 0) tell_bounds(g, bounds, bound_count);
    for (int s = 0; s < spline_count; s++)
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
    const host_state host = host_leave();
    const wiggly_status status = solve(g, descs, weights, curves, spline_count, pins, pin_count, bounds, bound_count);
    host_return(&host);
    return status;
}
