/// Wind-up by the text of docs/mathematics.md: each gap's rows written out, squared, and solved by plain L D Lᵀ.
#include "textbook_parts.h"
#include <math.h>
#include <string.h>

enum { WIDTH = 6 }; ///< entries of a matrix row up to the diagonal: two unknowns a sample, three samples a row

/// One gap's system: unknowns Re w and Im w of the samples after `s`, to `k`.
static struct gap_system {
    int s, k;
    number start; ///< the known w of sample s
    real matrix[2 * TEXTBOOK_MAX][WIDTH], right[2 * TEXTBOOK_MAX];
    bool fixed[2 * TEXTBOOK_MAX];
    real x[2 * TEXTBOOK_MAX];
} gap;

struct term {
    int sample;
    number by;
};

/// Adds weight·|Σ terms − right|², of its real part alone where `both` is false.
static void add_row(bool both, real weight, int n, const struct term *terms, number right)
{
    for (int part = 0; part < 1 + both; part++) {
        int column[6], count = 0;
        real value[6], rhs = part ? cimagq(right) : crealq(right);
        for (int t = 0; t < n; t++) {
            const number by = terms[t].by, known = by * gap.start;
            if (terms[t].sample == gap.s) {
                rhs -= part ? cimagq(known) : crealq(known);
                continue;
            }
            column[count] = 2 * (terms[t].sample - gap.s - 1);
            value[count++] = part ? cimagq(by) : crealq(by);
            column[count] = column[count - 1] + 1;
            value[count++] = part ? crealq(by) : -cimagq(by);
        }
        for (int i = 0; i < count; i++) {
            gap.right[column[i]] += weight * value[i] * rhs;
            for (int j = 0; j < count; j++) {
                if (column[i] >= column[j])
                    gap.matrix[column[i]][column[i] - column[j]] += weight * value[i] * value[j];
            }
        }
    }
}

static void solve_system(void)
{
    const int n = 2 * (gap.k - gap.s);
    for (int i = 0; i < n; i++) { // known unknowns to the right side
        for (int m = 1; m < WIDTH && m <= i; m++) {
            if (gap.fixed[i] && !gap.fixed[i - m]) gap.right[i - m] -= gap.matrix[i][m] * gap.x[i];
            if (gap.fixed[i - m] && !gap.fixed[i]) gap.right[i] -= gap.matrix[i][m] * gap.x[i - m];
            if (gap.fixed[i] || gap.fixed[i - m]) gap.matrix[i][m] = 0;
        }
        if (gap.fixed[i]) gap.matrix[i][0] = 1, gap.right[i] = gap.x[i];
    }
    for (int i = 0; i < n; i++) {
        for (int m = i < WIDTH - 1 ? i : WIDTH - 1; m >= 0; m--) { // column i − m of row i
            const int j = i - m;
            real sum = gap.matrix[i][m];
            for (int c = j - 1; c >= 0 && i - c < WIDTH; c--)
                sum -= gap.matrix[i][i - c] * gap.matrix[j][j - c] * gap.matrix[c][0];
            gap.matrix[i][m] = m > 0 ? sum / gap.matrix[j][0] : sum;
        }
        gap.x[i] = gap.right[i];
        for (int m = 1; m < WIDTH && m <= i; m++) gap.x[i] -= gap.matrix[i][m] * gap.x[i - m];
    }
    for (int i = 0; i < n; i++) gap.x[i] /= gap.matrix[i][0];
    for (int i = n - 1; i >= 0; i--) {
        for (int m = 1; m < WIDTH && m <= i; m++) gap.x[i - m] -= gap.matrix[i][m] * gap.x[i];
    }
}

static int wrap(const struct textbook *b, int i) { return b->loop ? i % (b->samples - 1) : i; }

static const struct textbook_poles *poles_of(const struct textbook *b, int i) { return &b->at[wrap(b, i)]; }

static number coast(const struct textbook *b, int i)
{
    return cexpq((poles_of(b, i)->p + poles_of(b, i + 1)->p) / 2 * b->h);
}

static real fade(const struct textbook_poles *at)
{
    if (!(at->natural > 0)) return 0;
    const real v = fminq(fmaxq((at->turn / at->natural - 0.3Q) / 0.2Q, 0), 1);
    return v * v * (3 - 2 * v);
}

static bool is_whole(const wiggly_knot *knot) { return knot->still || knot->has_phase; }

static real slope_of(const struct textbook *b, const wiggly_knot *knot)
{
    return (real)knot->slope - b->speed[knot->sample];
}

real textbook_reach(const wiggly_desc *desc, real natural)
{
    return natural > 0 ? fmaxq(1, (real)desc->wind_up * 2 * M_PIq / (natural * (real)desc->step)) : (real)INFINITY;
}

/// The samples after j, to k, from w at j; the round's last gap takes its Im w. Writes them to `w`, by sample of the domain.
static number solve_gap(const wiggly_desc *desc, const struct textbook *b, number from, int j, int k,
                        const wiggly_knot *knot, const real *turned, number *w)
{
    const real h = b->h, sigma = fmaxq(j, k - textbook_reach(desc, poles_of(b, k)->natural));
    int s = (int)floorq(sigma + 0.5Q), low = (int)floorq(sigma);
    if (s < j) s = j;
    number here = from, before = 0;
    for (int i = j; i < s; i++) {
        before = here;
        here *= coast(b, i);
        w[wrap(b, i + 1)] = here;
    }
    const real share = sigma - low;
    const struct textbook_poles *at = poles_of(b, low), *next = share > 0 ? poles_of(b, low + 1) : at;
    const real turn = (1 - share) * cimagq(at->s[0] - at->s[1]) / 2 + share * cimagq(next->s[0] - next->s[1]) / 2;
    const number pole = (1 - share) * at->p + share * next->p;
    number ahead = cexpq(pole * h) * here * cosq(turn * h * (s + 1 - sigma));
    here *= cosq(turn * h * (s - sigma));
    const real m = 2 * fmaxq(0, s - sigma);
    if (m > 0) {
        const struct textbook_poles *own = poles_of(b, s);
        const number l0 = cexpq(own->s[0] * h), l1 = cexpq(own->s[1] * h);
        ahead = (1 - m) * ahead + m * ((l0 + l1) * here - l0 * l1 * cosq(turn * h * (s - 1 - sigma)) * before);
        w[wrap(b, s)] = here;
    }
    memset(gap.matrix, 0, sizeof gap.matrix[0] * 2 * (size_t)(k - s));
    memset(gap.right, 0, sizeof gap.right[0] * 2 * (size_t)(k - s));
    memset(gap.fixed, 0, 2 * (size_t)(k - s));
    gap.s = s, gap.k = k, gap.start = here;
    const struct textbook_poles *end = poles_of(b, k);
    for (int i = s; i <= k; i++) {
        const struct textbook_poles *own = poles_of(b, i);
        const real theta = fminq(i + 0.5Q, k) - fmaxq(i - 0.5Q, sigma);
        const real weight = expq(crealq(end->s[0] + end->s[1] - own->s[0] - own->s[1]) * h) / (theta * h * h * h);
        const number l0 = cexpq(own->s[0] * h), l1 = cexpq(own->s[1] * h), a = l0 + l1, c = l0 * l1;
        if (i == s) {
            add_row(true, weight, 1, (struct term[]){{s + 1, 1}}, ahead);
        } else if (i < k) {
            add_row(true, weight, 3, (struct term[]){{i + 1, 1}, {i, -a}, {i - 1, c}}, 0);
        } else {
            add_row(true, weight, 2, (struct term[]){{k, -a / 2}, {k - 1, c}}, 0);
        }
    }
    const int last = 2 * (k - s - 1);
    const number target = textbook_knot(desc, b, knot);
    gap.fixed[last] = true, gap.x[last] = crealq(target);
    gap.fixed[last + 1] = is_whole(knot) || turned, gap.x[last + 1] = turned ? *turned : cimagq(target);
    if (knot->has_slope && !is_whole(knot) && !turned && fade(end) > 0)
        add_row(false, fade(end) * (knot->stiffness > 0 ? (real)knot->stiffness : 1000), 1,
                (struct term[]){{k, end->p}}, slope_of(b, knot));
    solve_system();
    for (int i = s + 1; i <= k; i++) w[wrap(b, i)] = gap.x[2 * (i - s - 1)] + 1.0Qi * gap.x[2 * (i - s) - 1];
    return w[wrap(b, k)];
}

/// From the n-th knot on to the last; in a loop round to the first.
static number run(const wiggly_desc *desc, const struct textbook *b, const wiggly_knot *const *knots, number from,
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

void textbook_wind_up(const wiggly_desc *desc, struct textbook *b)
{
    static number w[TEXTBOOK_MAX];
    static const wiggly_knot *knots[TEXTBOOK_MAX];
    textbook_sorted(desc, knots);
    memset(w, 0, sizeof w[0] * (size_t)b->samples);
    if (desc->knot_count == 0) return;
    const wiggly_knot *first = knots[0];
    const struct textbook_poles *at = poles_of(b, first->sample);
    number start = textbook_knot(desc, b, first);
    if (b->rest) {
        start = run(desc, b, knots, 0, -1, NULL, w);
    } else if (b->loop) {
        real turned = cimagq(start);
        if (!is_whole(first)) {
            const real a = cimagq(run(desc, b, knots, crealq(start), 0, NULL, w));
            const real c = cimagq(run(desc, b, knots, crealq(start) + 1.0Qi, 0, NULL, w)) - a;
            turned = a * (1 - c) / ((1 - c) * (1 - c) + c * c * 1e-4Q);
        }
        w[first->sample] = crealq(start) + 1.0Qi * turned;
        run(desc, b, knots, w[first->sample], 0, &turned, w);
    } else {
        if (first->has_slope && !is_whole(first) && fade(at) > 0) {
            const int next = desc->knot_count > 1 ? knots[1]->sample : b->samples - 1;
            const real tau = powq(at->turn * (next - first->sample) * b->h, 4);
            start +=
                1.0Qi * (crealq(at->p) * crealq(start) - slope_of(b, first)) / at->turn * fade(at) * tau / (1 + tau);
        }
        w[first->sample] = start;
        run(desc, b, knots, start, 0, NULL, w);
    }
    for (int i = b->last; !b->loop && i + 1 < b->samples; i++) w[i + 1] = coast(b, i) * w[i];
    for (int k = 0; k < b->count; k++)
        b->x[2 * k] = crealq(w[b->first + k]), b->x[2 * k + 1] = cimagq(w[b->first + k]);
}

/// o of section "Where the motion settles", and y with it.
void textbook_settle(const wiggly_desc *desc, struct textbook *b)
{
    static const wiggly_knot *knots[TEXTBOOK_MAX];
    static real o[TEXTBOOK_MAX];
    const int period = b->samples - 1;
    int n = desc->knot_count, settling = -1;
    textbook_sorted(desc, knots);
    for (int k = n - 1; k >= 0; k--) settling = knots[k]->settles ? k : settling;
    b->settles = settling >= 0 && desc->mode != WIGGLY_CUBIC;
    if (!b->settles) return;
    const int from = b->loop ? settling : 0;
    int j = knots[from]->sample;
    real level = knots[from]->settles ? (real)knots[from]->value - b->y[j] : 0;
    for (int i = 0; i < b->samples; i++) o[i] = level;
    for (int k = 1; k < n + b->loop; k++) {
        const wiggly_knot *knot = knots[(from + k) % n];
        const int gap_length = b->loop ? (knot->sample - j + 2 * period - 1) % period + 1 : knot->sample - j;
        const real to = knot->settles ? (real)knot->value - b->y[knot->sample] : level;
        const real reach = textbook_reach(desc, textbook_poles_at(desc, knot->sample, 0).natural);
        const real begin = b->winds_up ? fmaxq(0, gap_length - reach) : 0;
        for (int i = 0; i < gap_length; i++) {
            const real t = fmaxq(0, (i - begin) / (gap_length - begin));
            o[b->loop ? (j + i) % period : j + i] = level + (to - level) * t * t * t * (10 - 15 * t + 6 * t * t);
        }
        level = to;
        j = knot->sample;
    }
    for (int i = j; !b->loop && i < b->samples; i++) o[i] = level;
    if (b->loop) o[period] = o[0];
    for (int i = 0; i < b->samples; i++) {
        const int before = i > 0     ? i - 1
                           : b->loop ? period - 1
                                     : 0,
                  after = i < period ? i + 1
                          : b->loop  ? 1
                                     : period;
        b->y[i] += o[i];
        b->offset_speed[i] = (o[after] - o[before]) / (2 * b->h);
    }
}
