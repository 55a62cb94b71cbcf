/// The textbook's spline.
#include "textbook.h"
#include <assert.h>
#include <math.h>
#include <string.h>

// --- poles -----------------------------------------------------------------------------------------------------------

static real param_at(wiggly_param param, int sample) { return param.track ? param.track[sample] : param.value; }

static real not_negative(wiggly_param param, int sample) { return fmaxq(param_at(param, sample), 0); }

struct textbook_poles textbook_poles_at(const wiggly_desc *desc, int sample, real floor)
{
    if (desc->mode == WIGGLY_CUBIC) return (struct textbook_poles){.p = 0};
    const bool is_complex = desc->mode == WIGGLY_COMPLEX;
    const real w = 2 * M_PIq * not_negative(desc->frequency, sample);
    real zeta = fmaxq(not_negative(desc->damping, sample), floor);
    if (is_complex) zeta = fminq(zeta, 1);
    struct textbook_poles at = {.natural = w, .d = zeta * w, .k = w * w};
    at.turn = zeta < 1 ? w * sqrtq(1 - zeta * zeta) : 0;
    at.p = -at.d + 1.0Qi * at.turn;
    const number middle = is_complex ? at.p : -at.d;
    const number apart = is_complex ? 1.0Qi * w * fminq(not_negative(desc->bandwidth, sample), 1)
                         : zeta < 1 ? 1.0Qi * at.turn
                                    : (number)(w * sqrtq(zeta * zeta - 1));
    at.s[0] = middle + apart;
    at.s[1] = middle - apart;
    return at;
}

/// Poles of all samples; in a loop the last are the first.
static void fill_poles(const wiggly_desc *desc, real floor, bool loop, struct textbook_poles *at)
{
    const bool varies = desc->frequency.track || desc->damping.track || desc->bandwidth.track;
    for (int i = 0; i < desc->samples; i++)
        at[i] = i > 0 && !varies ? at[0] : textbook_poles_at(desc, loop ? i % (desc->samples - 1) : i, floor);
}

struct textbook_speed textbook_speed_of(const struct textbook_poles *at, real h)
{
    const number l0 = cexpq(at->s[0] * h), l1 = cexpq(at->s[1] * h);
    const bool is_double = at->s[0] == at->s[1];
    struct textbook_speed speed = {.Q = is_double ? 1 / (h * l0) : (at->s[0] - at->s[1]) / (l0 - l1)};
    speed.P = at->s[0] - speed.Q * l0;
    return speed;
}

/// |g|², g = e^{(s₀+s₁)h/2}.
static real gain(const struct textbook_poles *at, real h) { return expq(crealq(at->s[0] + at->s[1]) * h); }

// --- where the motion settles ----------------------------------------------------------------------------------------

/// What is before a sample of y (or what is added to it), also before the domain; and after it.
static real before(const struct textbook *b, const real *y, int i)
{
    if (b->loop) return y[(i + b->samples - 2) % (b->samples - 1)];
    return y[i > 0 ? i - 1 : 0];
}

static real after(const struct textbook *b, const real *y, int i)
{
    if (b->loop) return y[(i + 1) % (b->samples - 1)];
    if (i + 1 < b->samples) return y[i + 1];
    return i > 0 ? 2 * y[i] - y[i - 1] : y[i];
}

static void sort_knots(const wiggly_desc *desc, const wiggly_knot **knots)
{
    for (int n = 0; n < desc->knot_count; n++) {
        int place = n;
        for (; place > 0 && knots[place - 1]->sample > desc->knots[n].sample; place--)
            knots[place] = knots[place - 1];
        knots[place] = &desc->knots[n];
    }
}

/// Samples of the wind-up before a knot of that natural frequency.
static real reach_of(const wiggly_desc *desc, real natural)
{
    return natural > 0 ? fmaxq(1, (real)desc->wind_up * 2 * M_PIq / (natural * (real)desc->step)) : (real)INFINITY;
}

/// Moves y to where knots settle: o of section "Where the motion settles".
static void settle(const wiggly_desc *desc, struct textbook *b)
{
    static const wiggly_knot *knots[TEXTBOOK_MAX];
    static real o[TEXTBOOK_MAX];
    const int period = b->samples - 1, n = desc->knot_count;
    int settling = -1;
    sort_knots(desc, knots);
    for (int k = n - 1; k >= 0; k--) settling = knots[k]->settles ? k : settling;
    b->settles = settling >= 0 && desc->mode != WIGGLY_CUBIC;
    if (!b->settles) return;
    const int from = b->loop ? settling : 0;
    int j = knots[from]->sample;
    real level = knots[from]->settles ? (real)knots[from]->value - b->y[j] : 0;
    for (int i = 0; i < b->samples; i++) o[i] = level;
    for (int k = 1; k < n + b->loop; k++) {
        const wiggly_knot *knot = knots[(from + k) % n];
        const int length = b->loop ? (knot->sample - j + 2 * period - 1) % period + 1 : knot->sample - j;
        const real to = knot->settles ? (real)knot->value - b->y[knot->sample] : level;
        const real reach = reach_of(desc, textbook_poles_at(desc, knot->sample, 0).natural);
        const real begin = b->winds_up ? fmaxq(0, length - reach) : 0;
        for (int i = 0; i < length; i++) {
            const real t = fmaxq(0, (i - begin) / (length - begin));
            o[b->loop ? (j + i) % period : j + i] = level + (to - level) * t * t * t * (10 - 15 * t + 6 * t * t);
        }
        level = to;
        j = knot->sample;
    }
    for (int i = j; !b->loop && i < b->samples; i++) o[i] = level;
    if (b->loop) o[period] = o[0];
    for (int i = 0; i < b->samples; i++) {
        b->y[i] += o[i];
        b->offset_speed[i] = ((b->loop || i < period ? after(b, o, i) : o[i]) - before(b, o, i)) / (2 * b->h);
    }
}

// --- u: q″ + 2d q′ + k q = −y″ in closed form from sample to sample, y linear between them ---------------------------------

/// Where the oscillator is, and how fast.
struct state {
    real q, v;
};

/// Over a time h with d and k that stay.
static struct state step(struct state from, real d, real k, real h)
{
    const real square = d * d - k, r = sqrtq(fabsq(square)), c = square > 0 ? coshq(r * h) : cosq(r * h);
    const real s = r == 0 ? h : (square > 0 ? sinhq(r * h) : sinq(r * h)) / r, e = expq(-d * h);
    return (struct state){e * ((c + d * s) * from.q + s * from.v), e * (-k * s * from.q + (c - d * s) * from.v)};
}

/// From a state just before sample 0 to that just before the last sample; `at` (or NULL) receives the samples' own, q′ in the middle of
/// its jump. `drive` scales y.
static struct state swing(const struct textbook *b, struct state now, real drive, struct state *at)
{
    real d = -1, k = -1;
    struct state of_q = {0}, of_v = {0};
    for (int i = 0;; i++) {
        const real kick = -drive * (after(b, b->y, i) - 2 * b->y[i] + before(b, b->y, i)) / b->h;
        if (at) at[i] = (struct state){now.q, now.v + kick / 2};
        if (i == b->samples - 1) return now;
        now.v += kick;
        const struct textbook_poles *p = &b->swing[i], *next = &b->swing[i + 1];
        if (d != (p->d + next->d) / 2 || k != (p->k + next->k) / 2) {
            d = (p->d + next->d) / 2, k = (p->k + next->k) / 2;
            of_q = step((struct state){1, 0}, d, k, b->h), of_v = step((struct state){0, 1}, d, k, b->h);
        }
        now = (struct state){of_q.q * now.q + of_v.q * now.v, of_q.v * now.q + of_v.v * now.v};
    }
}

/// The state before sample 0 that comes back before the last one; false where there is none. Where nothing pulls back, of the family of
/// periodic swings the one of mean 0.
static bool find_periodic(struct textbook *b, struct state *start, struct state *at)
{
    const int period = b->samples - 1;
    const struct state driven = swing(b, (struct state){0}, 1, NULL);
    bool pulls = false;
    for (int i = 0; i < period; i++) pulls = pulls || b->swing[i].k > 0;
    if (!pulls) {
        real sum = 0;
        *start = (struct state){0, -driven.q / (period * b->h)};
        swing(b, *start, 1, at);
        for (int i = 0; i < period; i++) sum += at[i].q;
        start->q = -sum / period;
        return true;
    }
    const struct state q = swing(b, (struct state){1, 0}, 0, NULL), v = swing(b, (struct state){0, 1}, 0, NULL);
    const real determinant = (1 - q.q) * (1 - v.v) - v.q * q.v;
    b->pivot = (double)fminq(b->pivot, fabsq(determinant));
    *start = (struct state){((1 - v.v) * driven.q + v.q * driven.v) / determinant,
                            ((1 - q.q) * driven.v + q.v * driven.q) / determinant};
    return fabsq(determinant) > 1e-28Q;
}

static real range_of_y(const struct textbook *b, int from, int count)
{
    real low = b->y[from], high = low;
    for (int i = from; i < from + count; i++) low = fminq(low, b->y[i]), high = fmaxq(high, b->y[i]);
    return high - low;
}

/// Im u: the one-sided form, faded out where it would diverge.
static real imaginary(const struct textbook *b, int sample, struct state at)
{
    const struct textbook_poles *p = &b->swing[sample];
    if (!(p->turn > 0)) return 0;
    const real tau = powq(p->turn * (b->samples - 1) * b->h, 8), rho = powq(p->turn / p->natural, 8);
    if (b->settles) at.v += b->offset_speed[sample];
    return -(at.v + p->d * at.q) / p->turn * tau / (1 + tau) * rho / (rho + 1e-8Q);
}

static bool swing_at_calm(const wiggly_desc *desc, struct textbook *b, real calm)
{
    static struct state at[TEXTBOOK_MAX];
    struct state start = {0};
    fill_poles(desc, b->loop ? calm / 20 : 0, b->loop, b->swing);
    if (b->loop && !find_periodic(b, &start, at)) return false;
    swing(b, start, 1, at);
    real largest = 0;
    for (int i = 0; i < b->samples; i++) {
        largest = fmaxq(largest, fabsq(at[i].q));
        b->u[i] = at[i].q + (b->is_complex ? 1.0Qi * imaginary(b, i, at[i]) : 0);
        // y + q has no jump in its speed: y comes from rest at sample 0, as q does.
        b->speed[i] = at[i].v + (after(b, b->y, i) - before(b, b->y, i)) / (2 * b->h);
    }
    return !b->loop || largest <= 10000 * range_of_y(b, 0, b->samples);
}

/// u, and the speed of y + Re u: the oscillator's response to the moving equilibrium.
static void find_forced_response(const wiggly_desc *desc, struct textbook *b)
{
    for (int i = 0; i < b->samples; i++) {
        const bool is_start = i == 0 && !b->loop && b->samples > 1;
        b->u[i] = 0;
        b->speed[i] = (after(b, b->y, i) - (is_start ? 2 * b->y[0] - b->y[1] : before(b, b->y, i))) / (2 * b->h);
    }
    if (b->filter || desc->mode == WIGGLY_CUBIC || range_of_y(b, 0, b->samples) == 0) return;
    b->swing_calmed = !swing_at_calm(desc, b, b->calm) && b->loop && b->calm == 0;
    if (b->swing_calmed) swing_at_calm(desc, b, 0.05Q);
}

// --- the system ------------------------------------------------------------------------------------------------------

static void clear_system(struct textbook *b, int samples, bool folded)
{
    const size_t n = 2 * (size_t)samples;
    b->size = 2 * samples;
    b->folded = folded;
    memset(b->band, 0, sizeof b->band[0] * n);
    memset(b->right, 0, sizeof(real) * n);
    memset(b->x, 0, sizeof(real) * n);
    memset(b->fixed, 0, n);
    memset(b->used, true, n);
}

/// An unknown's row in the band.
static int place_of(const struct textbook *b, int unknown)
{
    const int k = unknown / 2, folded = 4 * k < b->size ? 2 * k : b->size - 2 * k - 1;
    return 2 * (b->folded ? folded : k) + unknown % 2;
}

real textbook_entry(const struct textbook *b, int row, int column)
{
    const int i = place_of(b, row), j = place_of(b, column), n = i > j ? i - j : j - i;
    return n < TEXTBOOK_BAND ? b->band[i > j ? i : j][n] : 0;
}

/// The lower half alone is kept.
static void add_entry(struct textbook *b, int row, int column, real value)
{
    const int n = place_of(b, row) - place_of(b, column);
    if (n >= 0) b->band[place_of(b, row)][n] += value;
}

/// A complex coefficient of w_k.
struct term {
    int k;
    number by;
};

/// How much of a complex row counts.
enum parts { REAL_PART = 1, BOTH_PARTS = 2 };

/// Adds weight·|Σ terms − right|².
static void add_row(struct textbook *b, enum parts parts, real weight, int n, const struct term *terms, number right)
{
    int column[6];
    number by[3];
    for (int t = 0; t < n; t++) {
        int k = terms[t].k;
        by[t] = terms[t].by;
        if (b->tied && k == b->last - b->first + 1) {
            right -= by[t] * b->tie_rest;
            by[t] *= b->tie;
            k--;
        }
        column[2 * t] = 2 * k;
        column[2 * t + 1] = 2 * k + 1;
    }
    for (int part = 0; part < (int)(b->is_complex ? parts : REAL_PART); part++) {
        const real rhs = part ? cimagq(right) : crealq(right);
        real value[6];
        for (int t = 0; t < n; t++) {
            value[2 * t] = part ? cimagq(by[t]) : crealq(by[t]);
            value[2 * t + 1] = !b->is_complex ? 0 : part ? crealq(by[t]) : -cimagq(by[t]);
        }
        for (int i = 0; i < 2 * n; i++) {
            b->right[column[i]] += weight * value[i] * rhs;
            for (int j = 0; j < 2 * n; j++) add_entry(b, column[i], column[j], weight * value[i] * value[j]);
        }
    }
}

static void fix(struct textbook *b, int unknown, real value) { b->fixed[unknown] = true, b->x[unknown] = value; }

/// L D Lᵀ of the band of the book that was solved last, place by place; what is fixed or not used has no row.
static struct factor {
    int width; ///< entries per row: of three samples, or of five where a loop is folded
    real l[2 * TEXTBOOK_MAX][TEXTBOOK_BAND], d[2 * TEXTBOOK_MAX];
    int unknown[2 * TEXTBOOK_MAX]; ///< at each place
    bool has_row[2 * TEXTBOOK_MAX];
} factor;

static int first_in_band(int i) { return i < factor.width ? 0 : i - factor.width + 1; }

/// False if a pivot is next to nothing.
static bool factorise(struct textbook *b)
{
    struct factor *f = &factor;
    f->width = b->folded ? TEXTBOOK_BAND : 6;
    for (int u = 0; u < b->size; u++) {
        f->unknown[place_of(b, u)] = u;
        f->has_row[place_of(b, u)] = b->used[u] && !b->fixed[u];
    }
    for (int i = 0; i < b->size; i++) {
        real ld[TEXTBOOK_BAND]; // l and d multiplied, of this row
        f->d[i] = 1;
        memset(f->l[i], 0, sizeof f->l[i]);
        if (!f->has_row[i]) continue;
        for (int j = first_in_band(i); j <= i; j++) {
            real sum = f->has_row[j] ? b->band[i][i - j] : 0;
            for (int k = first_in_band(i); k < j; k++) sum -= ld[i - k] * f->l[j][j - k];
            ld[i - j] = sum;
            if (j < i) f->l[i][i - j] = sum / f->d[j];
            if (j == i) f->d[i] = sum;
        }
        b->pivot = (double)fminq(b->pivot, b->band[i][0] > 0 ? f->d[i] / b->band[i][0] : 0);
        if (!(f->d[i] > 1e-28Q * b->band[i][0])) return false;
    }
    return true;
}

/// z, by places, becomes the solution.
static void substitute(int n, real *z)
{
    const struct factor *f = &factor;
    for (int i = 0; i < n; i++) {
        for (int k = first_in_band(i); k < i; k++) z[i] -= f->l[i][i - k] * z[k];
    }
    for (int i = n - 1; i >= 0; i--) {
        z[i] /= f->d[i];
        for (int k = i + 1; k < n && k < i + f->width; k++) z[i] -= f->l[k][k - i] * z[k];
    }
}

static real z[2 * TEXTBOOK_MAX];

static bool solve(struct textbook *b)
{
    const struct factor *f = &factor;
    if (!factorise(b)) return false;
    for (int i = 0; i < b->size; i++) {
        const int u = f->unknown[i];
        z[i] = f->has_row[i] ? b->right[u] : 0;
        for (int place = first_in_band(i); f->has_row[i] && place < b->size && place < i + f->width; place++) {
            const int k = f->unknown[place];
            if (b->fixed[k] && b->used[k]) z[i] -= textbook_entry(b, u, k) * b->x[k];
        }
    }
    substitute(b->size, z);
    for (int i = 0; i < b->size; i++) {
        if (f->has_row[i]) b->x[f->unknown[i]] = z[i];
    }
    return true;
}

double textbook_inverse(const struct textbook *b)
{
    double most = 0;
    for (int signs = 1; b->solved && signs <= 4; signs++) {
        for (int i = 0; i < b->size; i++)
            z[i] = factor.has_row[i] ? (i * 7 % 5 < signs ? -1 : 1) * sqrtq(b->band[i][0]) : 0;
        substitute(b->size, z);
        for (int i = 0; i < b->size; i++) most = (double)fmaxq(most, fabsq(z[i]) * sqrtq(b->band[i][0]));
    }
    return most;
}

// --- the rows of the energy ------------------------------------------------------------------------------------------

static bool is_whole(const wiggly_knot *knot) { return knot->still || knot->has_phase; }

/// A knot's target w; unspecified parts are 0.
static number target_of(const struct textbook *b, const wiggly_knot *knot)
{
    if (knot->still) return 0;
    const number w = (real)knot->value - b->y[knot->sample] - crealq(b->u[knot->sample]);
    if (!b->is_complex || !knot->has_phase) return w;
    return w + 1.0Qi * ((real)knot->phase - cimagq(b->u[knot->sample]));
}

/// The poles of the domain's k-th sample.
static const struct textbook_poles *poles_of(const struct textbook *b, int k) { return &b->at[b->first + k]; }

/// Coming to rest at a still sample, and leaving from it.
static void add_still(struct textbook *b, bool is_cubic, int k)
{
    const struct textbook_poles *at = poles_of(b, k);
    const int m = b->count, i = b->first + k;
    const real weight = 2 / (b->h * b->h * b->h) / (b->filter ? 1 : gain(at, b->h));
    const number back = cexpq((at->s[0] + at->s[1]) * b->h);
    const number from = is_cubic ? b->y[i] - before(b, b->y, i) : 0, to = is_cubic ? b->y[i] - after(b, b->y, i) : 0;
    if (b->loop || k > 0) add_row(b, BOTH_PARTS, weight, 1, (struct term[]){{(k + m - 1) % m, back}}, from);
    if (b->loop || (k < m - 1 && !(b->tied && i == b->last)))
        add_row(b, BOTH_PARTS, weight, 1, (struct term[]){{(k + 1) % m, 1}}, to);
}

static void add_jets(const wiggly_desc *desc, struct textbook *b)
{
    const bool is_cubic = desc->mode == WIGGLY_CUBIC, driven = b->filter || is_cubic;
    const int m = b->count, from = b->loop ? 0 : 1, to = b->loop ? m - 1 : b->tied ? b->last - b->first : m - 2;
    const real cube = b->h * b->h * b->h;
    real size = 1;
    number l0 = 0, l1 = 0, g = 0;
    for (int k = from; k <= to; k++) {
        const struct textbook_poles *at = poles_of(b, k);
        const int i = b->first + k;
        if (k == from || at->s[0] != at[-1].s[0] || at->s[1] != at[-1].s[1]) {
            l0 = cexpq(at->s[0] * b->h), l1 = cexpq(at->s[1] * b->h), g = cexpq((at->s[0] + at->s[1]) * b->h / 2);
            size = gain(at, b->h);
        }
        if (b->still[i]) continue;
        const number drive = driven ? g * (after(b, b->y, i) - 2 * b->y[i] + before(b, b->y, i)) : 0;
        const real weight = (b->tied && i == b->last ? 2 : 1) / cube / (b->filter ? 1 : size);
        add_row(b, BOTH_PARTS, weight, 3,
                (struct term[]){{(k + m - 1) % m, l0 * l1}, {k, -(l0 + l1)}, {b->loop ? (k + 1) % m : k + 1, 1}},
                -drive);
    }
    for (int k = 0; k < m; k++) {
        if (b->still[b->first + k]) add_still(b, is_cubic, k);
    }
    if (b->rest && !b->filter) // r₀ = w₁, w₀ and the one before it being 0
        add_row(b, BOTH_PARTS, 2 / (cube * gain(poles_of(b, 0), b->h)), 1, (struct term[]){{1, 1}},
                driven ? b->y[0] - b->y[1] : 0);
}

/// The highest frequency of the domain's samples between the still ones around k, both included.
static real highest_around(const struct textbook *b, int k, int held)
{
    real top = poles_of(b, k)->natural;
    for (int way = -1; way <= 1; way += 2) {
        for (int n = 0, i = k; n < held && !b->still[b->first + i]; n++) {
            i = b->loop ? (i + way + held) % held : i + way;
            if (i < 0 || i >= held) break;
            top = fmaxq(top, poles_of(b, i)->natural);
        }
    }
    return top;
}

/// Im w must not float where little or nothing drives it.
static void hold_imaginary(struct textbook *b)
{
    if (!b->is_complex || (b->rest && b->earliest < 0)) return;
    const real t = (b->loop ? b->count : b->count - 1) * b->h, t4 = t * t * t * t;
    const int held = b->tied ? b->last - b->first + 1 : b->count;
    real top = 0;
    for (int k = 0; k < held; k++) {
        const bool *still = &b->still[b->first + k];
        const bool is_beside = k > 0 && !still[0] && !still[-1]; // has the same around it
        if (!b->filter && !is_beside) top = highest_around(b, k, held);
        const real natural = poles_of(b, k)->natural, w2 = natural * natural;
        const real lack = top > 0 ? fmaxq(0, 1 - 100 * w2 / (top * top)) : 0;
        add_entry(b, 2 * k + 1, 2 * k + 1,
                  b->h / (t4 * (1 + w2 * w2 * w2 * w2 * t4 * t4)) + b->h * (top * top * top * top) * lack * lack);
    }
}

/// What the swing at a free start costs.
static void add_start(const wiggly_desc *desc, struct textbook *b)
{
    b->open = b->loop ? b->calm == 0 : !b->rest && !b->still[b->first];
    if (b->loop || b->rest || b->still[b->first]) return;
    int peak = b->first;
    const int end = b->first_still < 0 ? b->last : b->first_still;
    for (int i = b->first; !b->filter && i <= end; i++) {
        if (b->at[i].natural > b->at[peak].natural) peak = i;
    }
    const struct textbook_poles at = textbook_poles_at(desc, peak, 0.05Q);
    const number l0 = cexpq(at.s[0] * b->h), l1 = cexpq(at.s[1] * b->h), a = l0 + l1, c = -l0 * l1;
    const real h00 = -expm1q(2 * b->h * crealq(at.s[0] + at.s[1]));
    const real determinant =
        expm1q(2 * b->h * crealq(at.s[0])) * expm1q(2 * b->h * crealq(at.s[1])) * powq(cabsq(1 - l0 * conjq(l1)), 2);
    const real scale = b->calm / (b->h * b->h * b->h) / (b->filter ? 1 : gain(&at, b->h));
    if (!(scale * h00 > 0)) return;
    b->open = false;
    const number lean = -conjq(a + conjq(a) * c) / h00; // the form is h00 |w₀ + lean·w̃₁|² + determinant/h00 |w̃₁|²
    number from0 = 0, from1 = 1;                        // w̃₁ = from0·w₀ + from1·w₁
    if (!b->filter) {
        const struct textbook_speed here = textbook_speed_of(poles_of(b, 0), b->h),
                                    there = textbook_speed_of(&at, b->h);
        from0 = (here.P - there.P) / there.Q;
        from1 = here.Q / there.Q;
    }
    add_row(b, BOTH_PARTS, scale * h00, 2, (struct term[]){{0, 1 + lean * from0}, {1, lean * from1}}, 0);
    add_row(b, BOTH_PARTS, scale * determinant / h00, 2, (struct term[]){{0, from0}, {1, from1}}, 0);
}

/// The speed at the sample itself, as its poles have it from either side; of the filter as Eq. 9 of the paper has it, the total's step to the
/// next sample.
static void add_slope(struct textbook *b, int k, real slope, real stiffness)
{
    const struct textbook_poles *at = poles_of(b, k);
    const int m = b->count;
    if (b->filter) {
        const int from = b->loop || k + 1 < m ? k : k - 1, to = b->loop ? (k + 1) % m : from + 1;
        const real known = (b->y[b->first + to] - b->y[b->first + from]) / b->h;
        add_row(b, REAL_PART, stiffness, 2, (struct term[]){{from, -1 / b->h}, {to, 1 / b->h}}, slope - known);
        return;
    }
    const real wanted = slope - b->speed[b->first + k];
    if (b->tied && b->first + k == b->last) {
        if (b->is_complex) add_row(b, REAL_PART, stiffness, 1, (struct term[]){{k, at->p}}, wanted);
        return;
    }
    const struct textbook_speed forward = textbook_speed_of(at, b->h), backward = textbook_speed_of(at, -b->h);
    if (b->loop || (k > 0 && k < m - 1)) {
        const struct term terms[] = {
            {(k + m - 1) % m, backward.Q / 2}, {k, (forward.P + backward.P) / 2}, {(k + 1) % m, forward.Q / 2}};
        add_row(b, REAL_PART, stiffness / (1 + b->h * stiffness / 4), 3, terms, wanted);
    } else {
        const struct textbook_speed speed = k == 0 ? forward : backward;
        const struct term terms[] = {{k, speed.P}, {k == 0 ? 1 : k - 1, speed.Q}};
        add_row(b, REAL_PART, stiffness / (1 + b->h * stiffness / 2), 2, terms, wanted);
    }
}

/// What knots ask for, and what is implied. `level` adds slope 0 at the earliest knot.
static void add_knots(const wiggly_desc *desc, struct textbook *b, bool level)
{
    bool any_slope = false;
    for (int n = 0; n < desc->knot_count; n++) {
        const wiggly_knot *knot = &desc->knots[n];
        const int k = knot->sample - b->first;
        const number w = target_of(b, knot);
        any_slope = any_slope || knot->has_slope;
        fix(b, 2 * k, crealq(w));
        if (knot->still || (b->is_complex && knot->has_phase)) fix(b, 2 * k + 1, cimagq(w));
        if (knot->has_slope) add_slope(b, k, knot->slope, knot->stiffness);
    }
    const bool alone = desc->knot_count == 1 && !any_slope && !b->loop && b->open && !b->tied;
    if (level || (alone && !desc->knots[0].still)) add_slope(b, b->earliest - b->first, 0, 1000);
}

/// Whether the motion after the last knot is given, and how the sample behind it follows.
static void tie_end(const wiggly_desc *desc, struct textbook *b)
{
    b->tied = !b->filter && !b->loop && desc->knot_count > 0 && desc->mode != WIGGLY_REAL;
    if (!b->tied) return;
    const struct textbook_poles *at = &b->at[b->last];
    for (int n = 0; n < desc->knot_count; n++) {
        if (desc->knots[n].sample == b->last && desc->knots[n].has_slope)
            b->tied = b->is_complex && at->turn > 0.3Q * at->natural;
    }
    const struct textbook_speed speed = textbook_speed_of(at, b->h);
    b->tie = b->is_complex ? (at->p - speed.P) / speed.Q : 1;
    b->tie_rest = b->is_complex ? 0 : b->y[b->last] - after(b, b->y, b->last);
}

static void assemble(const wiggly_desc *desc, struct textbook *b, bool level)
{
    tie_end(desc, b);
    const int end = b->tied ? b->last - b->first : b->count - 1;
    for (int k = 0; k < b->count; k++) {
        b->used[2 * k] = k <= end;
        b->used[2 * k + 1] = k <= end && b->is_complex;
    }
    for (int i = 0; b->rest && i < (b->filter ? 4 : 2); i++) fix(b, i, 0);
    add_jets(desc, b);
    hold_imaginary(b);
    add_start(desc, b);
    add_knots(desc, b, level);
}

// --- wind-up, by the text of docs/mathematics.md: each gap's rows written out, and solved --------------------------------

static int wrap(const struct textbook *b, int i) { return b->loop ? i % (b->samples - 1) : i; }

static const struct textbook_poles *poles_at(const struct textbook *b, int i) { return &b->at[wrap(b, i)]; }

static number coast(const struct textbook *b, int i)
{
    return cexpq((poles_at(b, i)->p + poles_at(b, i + 1)->p) / 2 * b->h);
}

static real fade(const struct textbook_poles *at)
{
    if (!(at->natural > 0)) return 0;
    const real v = fminq(fmaxq((at->turn / at->natural - 0.3Q) / 0.2Q, 0), 1);
    return v * v * (3 - 2 * v);
}

static real slope_of(const struct textbook *b, const wiggly_knot *knot)
{
    return (real)knot->slope - b->speed[knot->sample];
}

/// The samples after j, to k, from w at j; the round's last gap takes its Im w. Writes them to `w`, by sample of the domain.
static number solve_gap(const wiggly_desc *desc, struct textbook *b, number from, int j, int k,
                        const wiggly_knot *knot, const real *turned, number *w)
{
    const real h = b->h, sigma = fmaxq(j, k - reach_of(desc, poles_at(b, k)->natural));
    const int low = (int)floorq(sigma), nearest = (int)floorq(sigma + 0.5Q), s = nearest < j ? j : nearest;
    number here = from, previous = 0;
    for (int i = j; i < s; i++) {
        previous = here;
        here *= coast(b, i);
        w[wrap(b, i + 1)] = here;
    }
    const real share = sigma - low;
    const struct textbook_poles *at = poles_at(b, low), *next = share > 0 ? poles_at(b, low + 1) : at,
                                *end = poles_at(b, k);
    const real turn = (1 - share) * cimagq(at->s[0] - at->s[1]) / 2 + share * cimagq(next->s[0] - next->s[1]) / 2;
    const number pole = (1 - share) * at->p + share * next->p;
    number ahead = cexpq(pole * h) * here * cosq(turn * h * (s + 1 - sigma));
    here *= cosq(turn * h * (s - sigma));
    const real m = 2 * fmaxq(0, s - sigma);
    if (m > 0) {
        const struct textbook_poles *own = poles_at(b, s);
        const number l0 = cexpq(own->s[0] * h), l1 = cexpq(own->s[1] * h);
        ahead = (1 - m) * ahead + m * ((l0 + l1) * here - l0 * l1 * cosq(turn * h * (s - 1 - sigma)) * previous);
        w[wrap(b, s)] = here;
    }
    clear_system(b, k - s + 1, false); // of sample s, known, and those after it
    fix(b, 0, crealq(here)), fix(b, 1, cimagq(here));
    for (int i = s; i <= k; i++) {
        const struct textbook_poles *own = poles_at(b, i);
        const real theta = fminq(i + 0.5Q, k) - fmaxq(i - 0.5Q, sigma);
        const real weight = expq(crealq(end->s[0] + end->s[1] - own->s[0] - own->s[1]) * h) / (theta * h * h * h);
        const number l0 = cexpq(own->s[0] * h), l1 = cexpq(own->s[1] * h), a = l0 + l1, c = l0 * l1;
        const int n = i - s;
        if (i == s) {
            add_row(b, BOTH_PARTS, weight, 1, (struct term[]){{1, 1}}, ahead);
        } else if (i < k) {
            add_row(b, BOTH_PARTS, weight, 3, (struct term[]){{n + 1, 1}, {n, -a}, {n - 1, c}}, 0);
        } else {
            add_row(b, BOTH_PARTS, weight, 2, (struct term[]){{n, -a / 2}, {n - 1, c}}, 0);
        }
    }
    const int last = b->size - 2;
    const number target = target_of(b, knot);
    fix(b, last, crealq(target));
    if (is_whole(knot) || turned) fix(b, last + 1, turned ? *turned : cimagq(target));
    if (knot->has_slope && !is_whole(knot) && !turned && fade(end) > 0)
        add_row(b, REAL_PART, fade(end) * (knot->stiffness > 0 ? (real)knot->stiffness : 1000), 1,
                (struct term[]){{k - s, end->p}}, slope_of(b, knot));
    solve(b);
    for (int i = s + 1; i <= k; i++) w[wrap(b, i)] = b->x[2 * (i - s)] + 1.0Qi * b->x[2 * (i - s) + 1];
    return w[wrap(b, k)];
}

/// From the n-th knot on to the last; in a loop round to the first.
static number wind_up_from(const wiggly_desc *desc, struct textbook *b, const wiggly_knot *const *knots, number from,
                           int n, const real *turned, number *w)
{
    for (int j = n < 0 ? 0 : knots[n]->sample; n + 1 < desc->knot_count + b->loop; n++) {
        const wiggly_knot *next = knots[(n + 1) % desc->knot_count];
        const bool closes = n + 1 == desc->knot_count;
        const int k = next->sample + (closes ? b->samples - 1 : 0);
        from = solve_gap(desc, b, from, j, k, next, closes ? turned : NULL, w);
        j = k;
    }
    return from;
}

/// w of a spline that winds up.
static void wind_up(const wiggly_desc *desc, struct textbook *b)
{
    static number w[TEXTBOOK_MAX];
    static const wiggly_knot *knots[TEXTBOOK_MAX];
    sort_knots(desc, knots);
    memset(w, 0, sizeof w[0] * (size_t)b->samples);
    const wiggly_knot *first = knots[0];
    const struct textbook_poles *at = poles_at(b, first->sample);
    number start = target_of(b, first);
    const double pivot = b->pivot; // not that of a gap
    if (b->rest) {
        wind_up_from(desc, b, knots, 0, -1, NULL, w);
    } else if (b->loop) {
        real turned = cimagq(start);
        if (!is_whole(first)) {
            const real a = cimagq(wind_up_from(desc, b, knots, crealq(start), 0, NULL, w));
            const real c = cimagq(wind_up_from(desc, b, knots, crealq(start) + 1.0Qi, 0, NULL, w)) - a;
            turned = a * (1 - c) / ((1 - c) * (1 - c) + c * c * 1e-4Q);
        }
        w[first->sample] = crealq(start) + 1.0Qi * turned;
        wind_up_from(desc, b, knots, w[first->sample], 0, &turned, w);
    } else {
        if (first->has_slope && !is_whole(first) && fade(at) > 0) {
            const int next = desc->knot_count > 1 ? knots[1]->sample : b->samples - 1;
            const real tau = powq(at->turn * (next - first->sample) * b->h, 4);
            start +=
                1.0Qi * (crealq(at->p) * crealq(start) - slope_of(b, first)) / at->turn * fade(at) * tau / (1 + tau);
        }
        w[first->sample] = start;
        wind_up_from(desc, b, knots, start, 0, NULL, w);
    }
    for (int i = b->last; !b->loop && i + 1 < b->samples; i++) w[i + 1] = coast(b, i) * w[i];
    clear_system(b, b->count, false);
    b->pivot = pivot;
    for (int k = 0; k < b->count; k++)
        b->x[2 * k] = crealq(w[b->first + k]), b->x[2 * k + 1] = cimagq(w[b->first + k]);
}

// --- the curve -------------------------------------------------------------------------------------------------------

static void find_knots(const wiggly_desc *desc, struct textbook *b)
{
    b->earliest = b->last = b->first_still = -1;
    memset(b->still, 0, sizeof b->still);
    for (int n = 0; n < desc->knot_count; n++) {
        const int sample = desc->knots[n].sample;
        b->still[sample] = desc->knots[n].still;
        if (desc->knots[n].still && (b->first_still < 0 || sample < b->first_still)) b->first_still = sample;
        if (b->earliest < 0 || sample < b->earliest) b->earliest = sample;
        if (sample > b->last) b->last = sample;
    }
}

/// The domain, y, poles and u; everything else 0.
static void open_book(const wiggly_desc *desc, real calm, struct textbook *b)
{
    assert(desc->samples <= TEXTBOOK_MAX);
    b->samples = desc->samples;
    b->is_complex = desc->mode == WIGGLY_COMPLEX;
    b->filter = desc->passive == WIGGLY_FILTER;
    b->loop = desc->start == WIGGLY_LOOP;
    b->h = desc->step;
    b->calm = calm;
    find_knots(desc, b);
    b->rest = desc->start == WIGGLY_REST && b->earliest != 0 && b->earliest != 1;
    b->first = b->loop || b->rest || b->earliest < 0 ? 0 : b->earliest;
    b->count = b->loop ? b->samples - 1 : b->samples - b->first;
    b->pivot = 1;
    b->growth = 0;
    b->open = b->tied = b->swing_calmed = b->solved = false;
    for (int i = 0; i < b->samples; i++)
        b->y[i] = b->loop && i == b->samples - 1 ? b->y[0] : param_at(desc->equilibrium, i);
    b->winds_up = desc->wind_up > 0 && b->is_complex && !b->filter && !desc->has_low && !desc->has_high;
    settle(desc, b);
    fill_poles(desc, b->loop ? calm / 20 : 0, b->loop, b->at);
    find_forced_response(desc, b);
    clear_system(b, b->count > 2 ? b->count : 2, b->loop);
    b->size = 2 * b->count;
}

/// Nothing that could move w: no knots, and no drive in the rows.
static bool is_still(const wiggly_desc *desc, const struct textbook *b)
{
    bool rings = false;
    for (int i = 0; i < b->count; i++) rings = rings || b->at[i].natural > 0;
    if (desc->knot_count > 0) return false;
    if (!b->loop) return !b->rest;
    return !b->filter || !rings || range_of_y(b, 0, b->count) == 0;
}

/// Too short for a row: each its knot's, else the earliest knot's, of an oscillator's cubic as it is in the total.
static void solve_short(const wiggly_desc *desc, struct textbook *b)
{
    const bool as_total = desc->mode == WIGGLY_CUBIC && !b->filter;
    for (int pass = 0; pass < 2; pass++) {
        for (int n = 0; n < desc->knot_count; n++) {
            const wiggly_knot *knot = &desc->knots[n];
            const number w = target_of(b, knot);
            for (int k = 0; k < b->count; k++) {
                const int sample = b->first + k;
                if (pass == 0 ? knot->sample != b->earliest : knot->sample != sample) continue;
                b->x[2 * k] = crealq(w) + (as_total ? b->y[knot->sample] - b->y[sample] : 0);
                if (is_whole(knot)) b->x[2 * k + 1] = cimagq(w);
            }
        }
    }
}

static number unknown_at(const struct textbook *b, int k) { return b->x[2 * k] + 1.0Qi * b->x[2 * k + 1]; }

/// max |w| against the size of what was asked for.
static void measure_growth(const wiggly_desc *desc, struct textbook *b)
{
    const real t = (b->loop ? b->count : b->count - 1) * b->h;
    real scale = range_of_y(b, b->first, b->count), largest = 0;
    for (int k = 0; k < b->count; k++) largest = fmaxq(largest, cabsq(unknown_at(b, k)));
    for (int n = 0; n < desc->knot_count; n++) {
        const wiggly_knot *knot = &desc->knots[n];
        const number w = target_of(b, knot);
        scale = fmaxq(scale, fmaxq(fabsq(crealq(w)), fabsq(cimagq(w))));
        if (knot->has_slope) scale = fmaxq(scale, t * fabsq((real)knot->slope));
    }
    b->growth = scale > 0 ? (double)(largest / scale) : 0;
}

/// The motion that is given after the last knot.
static void continue_after_last(struct textbook *b)
{
    for (int i = b->last; i + 1 < b->samples; i++) {
        const int k = i - b->first;
        number w = unknown_at(b, k);
        w = b->is_complex ? w * cexpq((b->at[i].p + b->at[i + 1].p) / 2 * b->h) : w + b->y[i] - b->y[i + 1];
        b->x[2 * k + 2] = crealq(w);
        b->x[2 * k + 3] = cimagq(w);
    }
}

void textbook_fill(struct textbook *b, double *total, double *re, double *im)
{
    if (b->tied) continue_after_last(b);
    for (int i = 0; i < b->samples; i++) {
        const int j = b->loop ? i % b->count : i;
        const number x = b->u[j] + unknown_at(b, j < b->first ? 0 : j - b->first);
        re[i] = (double)crealq(x);
        im[i] = (double)cimagq(x);
        total[i] = (double)(b->y[j] + crealq(x));
    }
}

bool textbook_as(const wiggly_desc *desc, wiggly_status status, struct textbook *b, double *total, double *re,
                 double *im)
{
    const bool calmed = status != WIGGLY_OK && desc->calm == 0;
    open_book(desc, calmed ? 0.05Q : (real)desc->calm, b);
    if (b->winds_up && desc->knot_count > 0) {
        wind_up(desc, b);
    } else if (b->winds_up || is_still(desc, b)) {
        // w = 0
    } else if (b->count < 3) {
        solve_short(desc, b);
    } else {
        assemble(desc, b, status == WIGGLY_LEVELLED);
        b->solved = solve(b);
        if (!b->solved) return false;
    }
    textbook_fill(b, total, re, im);
    if (b->count >= 3 && !b->winds_up) measure_growth(desc, b);
    return true;
}

static bool is_singular(const struct textbook *b, bool solved) { return b->open && (!solved || b->growth > 1e4); }

bool textbook_curve(const wiggly_desc *desc, struct textbook *b, wiggly_status *status, double *total, double *re,
                    double *im)
{
    *status = WIGGLY_OK;
    bool solved = textbook_as(desc, *status, b, total, re, im);
    if (is_singular(b, solved) && desc->calm == 0) {
        *status = WIGGLY_CALMED;
        solved = textbook_as(desc, *status, b, total, re, im);
    }
    if (is_singular(b, solved) && !b->loop && b->earliest >= 0) {
        *status = WIGGLY_LEVELLED;
        solved = textbook_as(desc, *status, b, total, re, im);
    }
    if (b->swing_calmed && *status == WIGGLY_OK) *status = WIGGLY_CALMED;
    if (is_singular(b, solved)) solved = false;
    if (!solved) *status = WIGGLY_SINGULAR;
    return solved;
}

// --- behind the last knot L: w = e^{p…} w_L + e, e the real oscillator's motion from rest at L under what presses it ---------

real textbook_tail_pull(const struct textbook *b, const real *e, int count, int sample)
{
    real sum = 0;
    for (int i = sample - 1; i <= sample + 1; i++) {
        if (i < 0 || i + 1 >= count) continue;
        const struct textbook_poles *at = &b->at[b->last + i];
        const real decay = expq(-at->d * b->h);
        const real by[3] = {decay * decay, -2 * decay * cosq(at->turn * b->h),
                            1}; // on the samples before, at and after
        const real force = by[2] * e[i + 1] + by[1] * e[i] + (i > 0 ? by[0] * e[i - 1] : 0);
        sum += by[sample - i + 1] * force / (decay * decay);
    }
    return -sum / (b->h * b->h * b->h);
}

// Between samples q = e^{−dt} (e_i cos ω_d t + B sin ω_d t), so that −(q' + d q) / ω_d = −B, of the side from which it is seen.
real textbook_tail_im(const struct textbook *b, const real *e, int count, int sample)
{
    const struct textbook_poles *at = &b->at[b->last + sample];
    const real decay = expq(-at->d * b->h), c = cosq(at->turn * b->h), s = sinq(at->turn * b->h);
    const real behind = (e[sample] * c - e[sample - 1] * decay) / s;
    if (sample + 1 == count) return -behind;
    return -(behind + (e[sample + 1] / decay - e[sample] * c) / s) / 2;
}
