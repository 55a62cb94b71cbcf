/// The rows of a problem for the band (system.h), sample by sample: the jets of a cubic (eq. 6), of a spring (eq. 14, eq. 17) and of a complex
/// spline (eq. 22) with their drive (eq. 25), and the slopes (eq. 9). And their squares.
#include "maths/wide.h"
#include "spline/problem.h"
#include <float.h>
#include <math.h>
#include <string.h>

/// Largest cost of a start, in jets of its first sample; beside a larger one nothing keeps a digit.
static const double heaviest_start = 1e26;

/// If the oscillator's frequency is below this share of the fastest one's, Im x is held.
static const double slow_part = 0.1;

/// y + Re u of a row of the system.
static double about_at(const problem *p, int k)
{
    if (p->start == WIGGLY_LOOP) k = (k + p->count) % p->count;
    return problem_about(p, p->first + k);
}

/// The filter's drive g ÿ, where the equilibrium moves, and the rounding of its differences.
static void set_drive(system_rows *rows, const problem *p, int k, cplx g, double weight)
{
    const bool inner = p->start == WIGGLY_LOOP || (k > 0 && k < p->count - 1);
    rows->drive[k] = (cplx){0, 0};
    if (!inner) return;
    const double here = about_at(p, k), ahead = about_at(p, k + 1) - here, behind = here - about_at(p, k - 1);
    const double off = (fabs(ahead) + fabs(behind) + (p->settled ? 2 * fabs(here) : 0)) + 16 * fabs(ahead - behind);
    rows->drive[k] = cplx_scale(ahead - behind, g);
    rows->drive_error += weight * cplx_norm(g) * (off * off) * (DBL_EPSILON * DBL_EPSILON);
}

static int intervals_of(const problem *p) { return p->start == WIGGLY_LOOP ? p->count : p->count - 1; }

double problem_im_weight(const problem *p, double natural)
{
    double intervals = intervals_of(p), t = intervals * p->desc->step;
    double phase2 = natural * t * (natural * t), phase4 = phase2 * phase2, i2 = intervals * intervals;
    return 1 / (i2 * i2 * (1 + phase4 * phase4));
}

static double highest_from(const problem *p, int from, int to)
{
    double highest = 0;
    poles_fastest(p->desc, p->first + from, p->first + to, &highest);
    return highest;
}

/// The highest frequency between the still knots around row k; `end` receives the later one. Without still knots the range goes to the
/// system's ends, or around a loop's seam.
static double highest_around(const problem *p, int k, int *end)
{
    const int last = problem_rows(p) - 1;
    int before = -1, after = last + 1, latest = last;
    for (int n = 0; n < p->desc->knot_count && p->still >= 0; n++) {
        const int row = p->desc->knots[n].sample - p->first;
        if (!p->desc->knots[n].still) continue;
        if (row <= k && row > before) before = row;
        if (row > k && row < after) after = row;
        if (latest == last || row > latest) latest = row;
    }
    *end = after < last ? after : last;
    double highest = highest_from(p, before < 0 ? 0 : before, *end);
    if (p->start != WIGGLY_LOOP || p->still < 0) return highest;
    if (before < 0) highest = fmax(highest, highest_from(p, latest, last));
    if (after > last) highest = fmax(highest, highest_from(p, 0, p->still));
    return highest;
}

/// The same of many samples, in the unit of all weights; 0 if Im x costs nothing.
WIDEST static void set_im_weights(const problem *p, const double *restrict natural, int count, bool weighted,
                                  double *restrict weight)
{
    const double intervals = intervals_of(p), t = intervals * p->desc->step, i2 = intervals * intervals;
    const double part = i2 * i2, unit = weighted ? p->unit : 0;
    for (int i = 0; i < count; i++) {
        const double phase2 = natural[i] * t * (natural[i] * t), phase4 = phase2 * phase2;
        weight[i] = unit / (part * (1 + phase4 * phase4));
    }
}

/// All rows of varying parameters, block by block. Weights are relative to the first sample's |g|⁻².
static void set_varying(system_rows *rows, const problem *p, bool weighted)
{
    const wiggly_desc *desc = p->desc;
    const bool oscillates = problem_oscillates(p);
    const double floor = problem_least_damping(p);
    poles_block block;
    double *const weight = rows->jet_weight, reference = 0, highest = 0;
    int end = -1; // the end of the range of `highest`
    for (int k = 0; k < rows->count; k += POLES_BLOCK) {
        const int count = rows->count - k < POLES_BLOCK ? rows->count - k : POLES_BLOCK;
        const size_t size = sizeof(double) * (size_t)count;
        poles_block_fill(desc, p->first + k, count, floor, &block);
        if (k == 0 && oscillates) reference = block.exponent[0];
        for (int i = 0; i < count; i++) weight[k + i] = oscillates ? block.exponent[i] - reference : 0;
        poles_block_exp(weight + k, count, weight + k);
        memcpy(rows->m_re + k, block.m_re, size), memcpy(rows->m_im + k, block.m_im, size);
        memcpy(rows->p_re + k, block.p_re, size), memcpy(rows->p_im + k, block.p_im, size);
        memcpy(rows->loss_m + k, block.loss_m, size), memcpy(rows->loss_p + k, block.loss_p, size);
        for (int i = 0; i < count; i++) {
            rows->unknown = rows->unknown || (oscillates && block.exponent[i] >= HEAVIEST);
            if (block.exponent[i] <= FAST) continue;
            const poles own = poles_at(desc, p->first + k + i, floor);
            const coefficients at = poles_coefficients(&own, desc->step);
            if (!rows->fast) memset(rows->rest, 0, sizeof *rows->rest * (size_t)rows->count);
            rows->fast = true;
            rows->rest[k + i] = at.rest;
            rows->m_re[k + i] = at.m.re, rows->m_im[k + i] = at.m.im;
            rows->p_re[k + i] = at.p.re, rows->p_im[k + i] = at.p.im;
            const coefficient_loss loss = poles_fast_loss(&own, desc->step, &at);
            rows->loss_m[k + i] = loss.m, rows->loss_p[k + i] = loss.p;
        }
        for (int i = 0; i < count && rows->driven; i++) {
            const double turn = desc->mode == WIGGLY_COMPLEX ? block.centre[i] * desc->step : 0;
            set_drive(rows, p, k + i, cplx_exp((cplx){-0.5 * block.exponent[i], turn}), weight[k + i]);
        }
        if (rows->is_complex) set_im_weights(p, block.natural, count, weighted, rows->im_weight + k);
        for (int i = 0; i < count && rows->is_complex && oscillates; i++) {
            if (k + i > end) highest = highest_around(p, k + i, &end);
            if (!(block.natural[i] < slow_part * highest)) continue;
            const double ratio = block.natural[i] / (slow_part * highest), lack = 1 - ratio * ratio,
                         whole = highest * desc->step * (highest * desc->step); // the cost times h⁴
            rows->im_weight[k + i] += whole * whole * lack * lack * p->unit;
        }
    }
}

/// Coefficients, drives and weights of jets and Im x of every row.
static void set_filter(wiggly_solver *solver, const problem *p)
{
    chain_forget(&solver->chain); // its tables share the matrix's memory
    system_rows *rows = &solver->rows;
    const wiggly_desc *desc = p->desc;
    const bool weighted = rows->is_complex && (p->start != WIGGLY_REST || problem_is_asked(p));
    rows->is_constant = poles_are_constant(desc);
    rows->driven = !problem_oscillates(p) && p->about;
    rows->drive_error = 0;
    if (!rows->is_constant) {
        rows->own_loss = (coefficient_loss){0, 0};
        set_varying(rows, p, weighted);
        return;
    }
    const poles *at = &problem_filter(solver, p)->at;
    rows->own = poles_coefficients(at, desc->step);
    rows->own_loss = poles_loss(at, desc->step, !rows->is_complex);
    rows->own_im = weighted ? problem_im_weight(p, at->natural) * p->unit : 0;
    rows->fast = cplx_norm(rows->own.rest.a) + cplx_norm(rows->own.rest.b) > 0;
    if (rows->fast) rows->own_loss = poles_fast_loss(at, desc->step, &rows->own);
    for (int k = 0; k < rows->count && rows->driven; k++) set_drive(rows, p, k, rows->own.g, 1);
}

/// From which sides an oscillator's speed at a row is seen, or that the free motion determines it.
typedef struct sides {
    bool ahead, behind, tied;
} sides;

static sides sides_of(const problem *p, int k)
{
    bool loop = p->start == WIGGLY_LOOP, last = p->settles && p->first + k == p->latest;
    return (sides){.ahead = loop || (k + 1 < p->count && !last),
                   .behind = loop || k > 0,
                   .tied = last && p->desc->mode == WIGGLY_COMPLEX};
}

slope_row problem_slope(const problem *p, int sample, double slope, double stiffness)
{
    const int k = sample - p->first, samples = p->desc->samples;
    const double h = p->desc->step;
    if (!problem_oscillates(p)) { // the paper's slope (eq. 9): a difference of the total
        const bool last = p->start != WIGGLY_LOOP && k == p->count - 1;
        const double from = about_at(p, last ? k - 1 : k), to = about_at(p, last ? k : k + 1);
        return (slope_row){.sample = k,
                           .ahead.re = last ? 0 : 1,
                           .behind.re = last ? 1 : 0,
                           .weight = fmin(stiffness * h, STIFFEST),
                           .target = h * slope - (to - from),
                           .target_error = 2 * DBL_EPSILON * (fabs(h * slope) + fabs(to - from))};
    }

    // The oscillator's: a speed seen from both sides, or from one at an end.
    const sides from = sides_of(p, k);
    const int count = from.ahead + from.behind;
    const double known = p->response.speed ? p->response.speed[sample] : 0;
    slope_row row = {.sample = k, .target = h * (slope - known), .weight = stiffness * h};
    if (!from.tied) {
        if (count == 0) return (slope_row){.sample = k};
        row.weight /= 1 + row.weight / (2 * count);
        if (count == 1 && p->y && !p->about && sample > 0 && sample + 1 < samples) { // a cubic's total bends with y
            const double bend = 0.5 * ((p->y[sample + 1] - p->y[sample]) - (p->y[sample] - p->y[sample - 1]));
            row.target += k == 0 ? bend : -bend;
        }
    }
    row.weight = fmin(row.weight, STIFFEST) * p->unit;
    row.target_error = 4 * DBL_EPSILON * h * (fabs(slope) + fabs(known));
    return row;
}

/// Adds a slope. An oscillator's speed is that by the poles from both sides, or from one at an end; on the tail, the tail's.
static void add_slope(system_rows *rows, const problem *p, int sample, double slope, double stiffness)
{
    slope_row row = problem_slope(p, sample, slope, stiffness);
    if (!(row.weight > 0)) return;
    const double h = p->desc->step;
    const sides from = sides_of(p, row.sample);
    if (problem_oscillates(p) && from.tied) {
        const poles own = poles_at(p->desc, p->latest, 0);
        row.here = cplx_scale(h, poles_passive(&own));
        row.loss.x = 8 * DBL_EPSILON * cplx_size(row.here);
    } else if (problem_oscillates(p)) {
        const poles at = poles_at(p->desc, sample, problem_least_damping(p));
        const double part = 1.0 / (from.ahead + from.behind);
        const speed_form forward = poles_speed(&at, h, false), backward = poles_speed(&at, h, true);
        row.loss.cut = forward.loss.cut || backward.loss.cut;
        row.loss.x = part * (from.ahead * forward.loss.x + from.behind * backward.loss.x);
        row.loss.e = part * fmax(forward.loss.e, backward.loss.e);
        if (from.ahead) row.here = cplx_scale(part, forward.on_x), row.ahead = cplx_scale(part, forward.on_e);
        if (from.behind) row.here = cplx_add(row.here, cplx_scale(part, backward.on_x));
        if (from.behind) row.behind = cplx_scale(part, backward.on_e);
    }
    rows->slopes[rows->slope_count++] = row;
}

bool problem_implies_slope(const problem *p)
{
    if (p->level_slope) return true;
    const wiggly_knot *knot = p->desc->knots;
    bool alone = p->desc->knot_count == 1 && !p->pulls && !knot->has_slope && !knot->still;
    return alone && p->free_end && !(p->settles && p->desc->mode == WIGGLY_COMPLEX);
}

/// What is known of a knot's sample, and its slope. A still knot has two jets, to rest and from rest, each counted twice.
static void set_knot(system_rows *rows, const problem *p, const wiggly_knot *knot)
{
    const int k = knot->sample - p->first;
    rows->fixed[k] |= FIXED_RE;
    rows->x[2 * k] = problem_knot_re(p, knot);
    if (knot->still) rows->fixed[k] |= FIXED_IM | FIXED_STILL;
    if (knot->still && !(p->settles && knot->sample == p->latest)) { // the tail's is done
        rows->fixed[k] |= JET_TWICE;
        if (rows->driven) rows->drive[k] = (cplx){0, 0};
        if (k == 0) rows->jet_from = 0;
        if (k == rows->count - 1) rows->jet_to = k;
    }
    if (rows->is_complex && knot->has_phase) {
        rows->fixed[k] |= FIXED_IM;
        rows->x[2 * k + 1] = problem_knot_im(p, knot);
    }
    if (knot->has_slope) add_slope(rows, p, knot->sample, knot->slope, knot_stiffness(knot));
}

double problem_noise(const problem *p)
{
    return 2 * DBL_EPSILON * extent_size(extent_of(p->y, p->desc->samples)) + p->response.rounding;
}

/// Whether Im x can be other than 0: not where both poles are conjugate or real all the way and no pose asks for it.
static bool turns(wiggly_solver *solver, const problem *p)
{
    const wiggly_desc *desc = p->desc;
    if (desc->mode != WIGGLY_COMPLEX) return false;
    if (p->pulls) return true;
    for (int n = 0; n < desc->knot_count; n++) {
        if (desc->knots[n].has_phase && problem_knot_im(p, &desc->knots[n]) != 0) return true;
    }
    const bool constant = poles_are_constant(desc);
    for (int k = 0; k < (constant ? 1 : problem_rows(p)); k++) {
        const poles at = constant ? problem_filter(solver, p)->at : poles_at(desc, p->first + k, 0);
        if (at.s[0].im != -at.s[1].im) return true;
    }
    return false;
}

void problem_set_rows(wiggly_solver *solver, const problem *p)
{
    system_rows *rows = &solver->rows;
    rows->loop = p->start == WIGGLY_LOOP;
    rows->fast = false;
    rows->is_complex = turns(solver, p);
    rows->count = problem_rows(p);
    rows->jet_from = rows->loop ? 0 : 1;
    rows->jet_to = rows->loop ? rows->count - 1 : rows->count - 2;
    rows->start = p->cost;
    rows->unknown = problem_oscillates(p) && p->cost.row[0].weight > heaviest_start;
    rows->pulls = p->pulls;
    rows->first = p->first;
    rows->noise = p->about ? problem_noise(p) : 0;
    memset(rows->x, 0, sizeof *rows->x * 2 * (size_t)rows->count);
    memset(rows->fixed, rows->is_complex ? 0 : FIXED_IM, (size_t)rows->count);
    set_filter(solver, p);
    rows->tail = (cplx){0, 0};
    rows->tail_loss = 0;
    if (p->settles) { // the last knot's jet, counted twice, with the free motion after it
        rows->jet_to = rows->count > 1 ? rows->count - 1 : -1;
        if (rows->count > 1) rows->fixed[rows->count - 1] |= JET_TWICE;
    }
    if (p->settles && p->desc->mode == WIGGLY_COMPLEX) {
        const poles own = poles_at(p->desc, p->latest, 0);
        const speed_form ahead = poles_speed(&own, p->desc->step, false);
        const double moved = 8 * DBL_EPSILON * cplx_size(poles_passive(&own)) * p->desc->step;
        rows->tail = poles_tail(poles_passive(&own), &ahead, p->desc->step);
        rows->tail_loss = (moved + ahead.loss.x + cplx_size(rows->tail) * ahead.loss.e) / cplx_size(ahead.on_e);
    }
    rows->slope_count = 0;
    if (p->start == WIGGLY_REST) { // w_0 is 0, and the filter's w_1, too; the oscillator's costs a jet
        rows->fixed[0] = FIXED_RE | FIXED_IM;
        if (problem_oscillates(p)) {
            rows->jet_from = 0;
            rows->fixed[0] |= JET_TWICE;
        } else {
            rows->fixed[1] = FIXED_RE | FIXED_IM;
            if (p->y && !p->about) rows->x[2] = p->y[1] - p->level;
        }
    }
    if (problem_implies_slope(p)) add_slope(rows, p, p->earliest, 0, USUAL_STIFFNESS);
    for (int n = 0; n < p->desc->knot_count; n++) set_knot(rows, p, &p->desc->knots[solver->order[n]]);
    rows->response = problem_response_error(p);
    rows->unknown = rows->unknown || !(p->response.error < INFINITY);
    const bool slips = p->thorough && rows->response > 0 && p->still < 0; // a still knot holds w, and not the total
    rows->slip = slips ? forced_response_slip(p->desc, &p->response, rows) : INFINITY;
}

// --- the rows squared into the band (the normal equations of eq. 6, 9 and 25)
//
// Rᵀ W R from the rows, block by block. With A_i = 2 + m_i and B_i = 1 + m_i + p_i the jet row i is
// (B_i, −A_i, 1) on x_{i−1}, x_i, x_{i+1}, so that
//
//     D_k = |A_k|² + |B_{k+1}|² + 1        E_k = −A_k − A_{k+1}* B_{k+1}        F_k = B_{k+1}
//
// of weighted rows. With constant poles all samples share one block; only those beside an end, a slope or a still knot have their own.

jet_row system_jet(const system_rows *rows, int i)
{
    const coefficients at = system_coefficients(rows, i);
    const cplx a = coefficients_a(&at);
    jet_row row = {.own = {-a.re, -a.im}, .before = coefficients_b(&at)};
    if (rows->fixed[i] & FIXED_STILL) {
        row.own.re += 1;
    } else if (!rows->loop && i == rows->count - 1) {
        row.own = cplx_add(row.own, (cplx){1 + rows->tail.re, rows->tail.im});
    }
    if (i < rows->jet_from || i > rows->jet_to) return row;
    row.weight = rows->is_constant ? 1 : rows->jet_weight[i];
    if (rows->fixed[i] & JET_TWICE) row.weight *= 2;
    return row;
}

static void put_complex(double *at, cplx z) { at[0] += z.re, at[1] -= z.im, at[2] += z.im, at[3] += z.re; }

/// The jets' part of the blocks of a sample and those beside it, from the rows around each.
static void set_own_around(const system_rows *rows, band_matrix *m, int i)
{
    for (int by = -1; by <= 1; by++) {
        const int k = system_beside(rows, i, by);
        if (k < 0 || m->marks[k] & BAND_OWN) continue;
        band_block *block = band_own(m, k);
        const int next = system_beside(rows, k, 1), before = system_beside(rows, k, -1);
        const jet_row own = system_jet(rows, k);
        double d = own.weight * cplx_norm(own.own);
        *block = (band_block){.d = {0}};
        if (before >= 0) d += system_jet(rows, before).weight;
        if (next >= 0) {
            const jet_row after = system_jet(rows, next);
            const bool ends = !rows->loop && next == rows->count - 1, still = rows->fixed[k] & FIXED_STILL;
            d += after.weight * cplx_norm(after.before);
            put_complex(block->e, cplx_scale(after.weight, cplx_mul(cplx_conj(after.own), after.before)));
            put_complex(block->e, cplx_scale(own.weight, still ? (cplx){-1, 0} : own.own));
            if (!ends && !(rows->fixed[next] & FIXED_STILL))
                put_complex(block->f, cplx_scale(after.weight, after.before));
        }
        block->d[0] = block->d[2] = d;
        if (rows->is_complex) block->d[2] += rows->is_constant ? rows->own_im : rows->im_weight[k];
    }
}

stencil system_slope_stencil(const system_rows *rows, const slope_row *slope)
{
    const int k = slope->sample;
    stencil s = {.at = {system_beside(rows, k, -1), k, system_beside(rows, k, 1)},
                 .c = {cplx_scale(-1, slope->behind), cplx_add(slope->here, cplx_sub(slope->behind, slope->ahead)),
                       slope->ahead}};
    if (s.at[2] < 0) s.c[1] = cplx_add(s.c[1], cplx_mul(slope->ahead, (cplx){1 + rows->tail.re, rows->tail.im}));
    return s;
}

/// The blocks of varying rows, as if all around them were jets of the usual kind.
WIDEST static void square(int count, const double *restrict mr, const double *restrict mi, const double *restrict pr,
                          const double *restrict pi, const double *restrict w, double *restrict d,
                          double *restrict e_re, double *restrict e_im, double *restrict f_re, double *restrict f_im)
{
    for (int k = 0; k < count; k++) {
        const double a = 2 + mr[k], ai = mi[k];
        const double c = 2 + mr[k + 1], ci = mi[k + 1], b = (c - 1) + pr[k + 1], bi = ci + pi[k + 1];
        const double own = w[k], next = w[k + 1];
        d[k] = own * (a * a + ai * ai) + next * (b * b + bi * bi) + (k > 0 ? w[k - 1] : 0);
        f_re[k] = next * b, f_im[k] = next * bi;
        e_re[k] = -(own * a + next * (c * b + ci * bi));
        e_im[k] = -(own * ai + next * (c * bi - ci * b));
    }
}

void system_matrix(const system_rows *rows, band_matrix *m)
{
    const int n = rows->count;
    m->count = n;
    m->is_complex = rows->is_complex;
    m->cyclic = rows->loop;
    m->is_alike = rows->is_constant;
    m->is_kept = false;
    m->marks = rows->fixed;
    m->im_weight = rows->is_complex && !rows->is_constant ? rows->im_weight : NULL;
    m->stiffness = NULL;
    for (int k = 0; k < n; k++) rows->fixed[k] &= (unsigned char)~(BAND_OWN | BAND_BESIDE);
    if (rows->is_constant) {
        const cplx a = coefficients_a(&rows->own), b = coefficients_b(&rows->own);
        m->alike = (band_block){.d = {0}};
        m->alike.d[0] = m->alike.d[2] = cplx_norm(a) + cplx_norm(b) + 1;
        put_complex(m->alike.e, cplx_scale(-1, cplx_add(a, cplx_mul(cplx_conj(a), b))));
        put_complex(m->alike.f, b);
        if (rows->is_complex) m->alike.d[2] += rows->own_im;
    } else if (n > 1) {
        square(n - 1, rows->m_re, rows->m_im, rows->p_re, rows->p_im, rows->jet_weight, m->d, m->e_re, m->e_im,
               m->f_re, m->f_im);
    }
    for (int k = 0; k < n && !rows->loop; k++) { // the rows beside an end
        if (k <= rows->jet_from || k >= rows->jet_to) set_own_around(rows, m, k);
        if (k == rows->jet_from && k < rows->jet_to) k = rows->jet_to - 1;
    }
    const bool each = rows->fast && !rows->is_constant;
    for (int k = 0; k < n; k++) {
        if (each || rows->fixed[k] & (FIXED_STILL | JET_TWICE)) set_own_around(rows, m, k);
    }
    if (rows->loop && !rows->is_constant) set_own_around(rows, m, 0), set_own_around(rows, m, n - 1);
    for (int r = 0; r < rows->slope_count; r++) { // the slopes (eq. 9)
        const stencil s = system_slope_stencil(rows, &rows->slopes[r]);
        const double w = rows->slopes[r].weight;
        for (int pair = 0; pair < 9; pair++) {
            const int i = pair / 3, j = pair % 3;
            if (j > i || s.at[i] < 0 || s.at[j] < 0) continue;
            band_block *block = band_own(m, s.at[j]);
            const cplx to = s.c[i], from = s.c[j];
            double *c = i - j == 2 ? block->f : block->e; // w (Re to·z')(Re from·z), rows z', columns z
            if (i == j) {
                block->d[0] += w * (to.re * to.re), block->d[1] -= w * (to.re * to.im);
                block->d[2] += w * (to.im * to.im);
            } else {
                c[0] += w * (to.re * from.re), c[1] -= w * (to.re * from.im);
                c[2] -= w * (to.im * from.re), c[3] += w * (to.im * from.im);
            }
        }
    }
    for (int i = 0; i < 2; i++) { // the start's rows
        const struct start_row *row = &rows->start.row[i];
        if (!(row->weight > 0)) continue;
        const cplx on_x0 = system_start_on_x(rows, row);
        band_block *block = band_own(m, 0);
        const double first = row->weight * cplx_norm(on_x0), second = row->weight * cplx_norm(row->on_e);
        block->d[0] += first, block->d[2] += first;
        if (n == 1) continue;
        put_complex(block->e, cplx_scale(row->weight, cplx_mul(cplx_conj(row->on_e), on_x0)));
        block = band_own(m, 1);
        block->d[0] += second, block->d[2] += second;
    }
}
