/// The spline by a dense textbook solver.
#include "textbook.h"
#include <complex.h>
#include <math.h>
#include <string.h>

typedef long double complex number;

static const long double pi = 3.141592653589793238462643383279502884L;

static long double at(wiggly_param p, int i) { return p.track ? p.track[i] : p.value; }

static void poles(const wiggly_desc *d, int i, long double floor, number s[2], long double *omega)
{
    long double w, zeta;
    s[0] = s[1] = *omega = 0;
    if (d->mode == WIGGLY_CUBIC) return;
    if (d->spring_friction) {
        long double k = fmaxl(at(d->spring, i), 0), gamma = fmaxl(at(d->friction, i), 0);
        w = sqrtl(k);
        if (w == 0) {
            s[1] = -gamma;
            return;
        }
        zeta = gamma / (2 * w);
    } else {
        w = 2 * pi * fmaxl(at(d->frequency, i), 0);
        zeta = fmaxl(at(d->damping, i), 0);
    }
    zeta = fmaxl(zeta, floor);
    *omega = w;
    if (d->mode == WIGGLY_REAL) {
        number root = csqrtl((number)(zeta * zeta - 1));
        s[0] = w * (-zeta + root);
        s[1] = w * (-zeta - root);
        return;
    }
    zeta = fminl(zeta, 1);
    long double beta = fminl(fmaxl(at(d->bandwidth, i), 0), 1);
    number p = -zeta * w + I * w * sqrtl(1 - zeta * zeta);
    s[0] = p + I * beta * w;
    s[1] = p - I * beta * w;
}

/// Adds weight·|Σ c_k x_k − right|², one complex row; in cubic and real mode its real part only.
static void add_row(struct textbook *b, bool is_complex, long double weight, int n, const int *index, const number *c,
                    number right)
{
    for (int part = 0; part < (is_complex ? 2 : 1); part++) {
        int column[6];
        long double value[6], rhs = part ? cimagl(right) : creall(right);
        for (int k = 0; k < n; k++) {
            column[2 * k] = 2 * index[k];
            column[2 * k + 1] = 2 * index[k] + 1;
            value[2 * k] = part ? cimagl(c[k]) : creall(c[k]);
            value[2 * k + 1] = is_complex ? (part ? creall(c[k]) : -cimagl(c[k])) : 0;
        }
        for (int i = 0; i < 2 * n; i++) {
            b->right[column[i]] += weight * value[i] * rhs;
            for (int j = 0; j < 2 * n; j++) b->matrix[column[i]][column[j]] += weight * value[i] * value[j];
        }
    }
}

static int earliest_knot(const wiggly_desc *d)
{
    int earliest = d->samples;
    for (int k = 0; k < d->knot_count; k++) {
        if (d->knots[k].sample < earliest) earliest = d->knots[k].sample;
    }
    return earliest;
}

void textbook_assemble(const wiggly_desc *d, struct textbook *b)
{
    memset(b, 0, sizeof *b);
    bool loop = d->start == WIGGLY_LOOP,
         rest = d->start == WIGGLY_REST && (d->knot_count == 0 || earliest_knot(d) > 1);
    bool is_complex = d->mode == WIGGLY_COMPLEX;
    b->first = loop || rest ? 0 : earliest_knot(d);
    int m = b->count = loop ? d->samples - 1 : d->samples - b->first;
    long double h = d->step, t = (loop ? m : m - 1) * h, y[TEXTBOOK_MAX];
    for (int k = 0; k < m; k++) y[k] = at(d->equilibrium, b->first + k);
    for (int k = 0; k < m; k++) {
        number s[2];
        long double omega;
        poles(d, b->first + k, loop ? d->calm / 20 : 0, s, &omega);
        number l0 = cexpl(s[0] * h), l1 = cexpl(s[1] * h);
        if (loop || (k > 0 && k < m - 1)) {
            int before = (k + m - 1) % m, after = (k + 1) % m;
            number drive = (y[after] - 2 * y[k] + y[before]) * cexpl((s[0] + s[1]) * h / 2);
            add_row(b, is_complex, 1 / (h * h * h), 3, (int[]){after, k, before}, (number[]){1, -(l0 + l1), l0 * l1},
                    -drive);
        }
        if (is_complex && !(rest && d->knot_count == 0)) {
            b->matrix[2 * k + 1][2 * k + 1] += h / (powl(t, 4) * (1 + powl(omega * t, 8)));
        }
    }
    long double cost = 0;
    if (!loop && !rest) {
        number s[2];
        long double omega;
        poles(d, b->first, 0.05L, s, &omega);
        number l0 = cexpl(s[0] * h), l1 = cexpl(s[1] * h), a = l0 + l1, bb = -l0 * l1;
        cost = d->calm * (1 - cabsl(bb) * cabsl(bb)) / (h * h * h);
        number off = -(long double)d->calm * (a + conjl(a) * bb) / (h * h * h);
        if (cost > 0) { // x* H x as |√H00 (x0 + H10*/H00 x1)|² + (H00 − |H10|²/H00) |x1|²
            add_row(b, is_complex, cost, 2, (int[]){0, 1}, (number[]){1, conjl(off) / cost}, 0);
            long double rest_cost = fmaxl(cost - cabsl(off) * cabsl(off) / cost, 0);
            add_row(b, is_complex, rest_cost, 1, (int[]){1}, (number[]){1}, 0);
        }
    }
    bool any_slope = false;
    for (int k = 0; k < d->knot_count; k++) any_slope = any_slope || d->knots[k].has_slope;
    for (int k = 0; k < d->knot_count; k++) {
        const wiggly_knot *knot = &d->knots[k];
        int j = knot->sample - b->first;
        bool implied = !loop && !rest && d->knot_count == 1 && !any_slope && !(cost > 0);
        long double slope = knot->has_slope ? knot->slope : 0, stiffness = knot->has_slope ? knot->stiffness : 1000;
        int p = loop || j + 1 < m ? j : j - 1, q = loop ? (j + 1) % m : p + 1;
        if (knot->has_slope || implied) {
            add_row(b, false, stiffness, 2, (int[]){p, q}, (number[]){-1 / h, 1 / h}, slope - (y[q] - y[p]) / h);
        }
        b->fixed[2 * j] = true;
        b->x[2 * j] = (long double)knot->value - y[j];
    }
    for (int k = 0; rest && k < 4; k++) b->fixed[k] = true;
    for (int k = 0; k < m; k++) {
        b->used[2 * k] = true;
        b->used[2 * k + 1] = is_complex;
    }
}

bool textbook_solve(struct textbook *b)
{
    static long double l[2 * TEXTBOOK_MAX][2 * TEXTBOOK_MAX];
    long double z[2 * TEXTBOOK_MAX];
    int map[2 * TEXTBOOK_MAX], n = 0;
    for (int i = 0; i < 2 * b->count; i++) {
        if (b->used[i] && !b->fixed[i]) map[n++] = i;
    }
    for (int i = 0; i < n; i++) {
        z[i] = b->right[map[i]];
        for (int j = 0; j < 2 * b->count; j++) {
            if (b->fixed[j]) z[i] -= b->matrix[map[i]][j] * b->x[j];
        }
        for (int j = 0; j <= i; j++) {
            long double sum = b->matrix[map[i]][map[j]];
            for (int k = 0; k < j; k++) sum -= l[i][k] * l[j][k];
            if (i == j && !(sum > 1e-13L * b->matrix[map[i]][map[i]])) return false;
            l[i][j] = i == j ? sqrtl(sum) : sum / l[j][j];
        }
        for (int k = 0; k < i; k++) z[i] -= l[i][k] * z[k];
        z[i] /= l[i][i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) z[i] -= l[k][i] * z[k];
        z[i] /= l[i][i];
        b->x[map[i]] = z[i];
    }
    return true;
}
