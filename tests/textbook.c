/// The textbook's spline: its domain, its dense system and what follows from the answer.
#include "textbook.h"

#include "textbook_parts.h"
#include <assert.h>
#include <math.h>
#include <string.h>

static const real least_pivot = 1e-28Q;
static const double blow_up = 1e4;

static void find_knots(const wiggly_desc *desc, struct textbook *b)
{
    b->earliest = b->last = -1;
    for (int n = 0; n < desc->knot_count; n++) {
        int sample = desc->knots[n].sample;
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
    b->open = b->tied = b->swing_calmed = false;
    for (int i = 0; i < b->samples; i++) {
        bool wraps = b->loop && i == b->samples - 1;
        b->y[i] = wraps ? b->y[0] : textbook_param(desc->equilibrium, i);
    }
    textbook_fill_poles(desc, b->loop ? calm / 20 : 0, b->loop, b->at);
    textbook_swing(desc, b);
    int n = 2 * b->count;
    for (int i = 0; i < n; i++) memset(b->matrix[i], 0, sizeof(real) * (size_t)n);
    memset(b->right, 0, sizeof b->right);
    memset(b->x, 0, sizeof b->x);
    memset(b->fixed, 0, sizeof b->fixed);
    memset(b->used, 0, sizeof b->used);
}

/// Nothing that could move x (or w): no knots, and no drive in the rows.
static bool is_still(const wiggly_desc *desc, const struct textbook *b)
{
    if (desc->knot_count > 0) return false;
    if (!b->loop) return !b->rest;
    bool moves = false, rings = false;
    for (int i = 0; i < b->count; i++) {
        moves = moves || b->y[i] != b->y[0];
        rings = rings || b->at[i].natural > 0;
    }
    return !b->filter || !moves || !rings;
}

/// Too short for a row: each its knot's, else the earliest knot's.
static void solve_short(const wiggly_desc *desc, struct textbook *b)
{
    for (int pass = 0; pass < 2; pass++) {
        for (int n = 0; n < desc->knot_count; n++) {
            int sample = desc->knots[n].sample;
            real w = (real)desc->knots[n].value - b->y[sample] - crealq(b->u[sample]);
            for (int k = 0; k < b->count; k++) {
                if (pass == 0 ? sample == b->earliest : k == sample - b->first) b->x[2 * k] = w;
            }
        }
    }
}

/// Cholesky, row by row from each row's first entry on.
static bool solve(struct textbook *b)
{
    static real l[2 * TEXTBOOK_MAX][2 * TEXTBOOK_MAX];
    real z[2 * TEXTBOOK_MAX];
    int map[2 * TEXTBOOK_MAX], from[2 * TEXTBOOK_MAX], n = 0;
    for (int i = 0; i < 2 * b->count; i++) {
        if (b->used[i] && !b->fixed[i]) map[n++] = i;
    }
    for (int i = 0; i < n; i++) {
        const real *row = b->matrix[map[i]];
        z[i] = b->right[map[i]];
        for (int j = 0; j < 2 * b->count; j++) {
            if (b->fixed[j] && b->used[j]) z[i] -= row[j] * b->x[j];
        }
        for (from[i] = 0; from[i] < i && row[map[from[i]]] == 0;) from[i]++;
        for (int j = from[i]; j <= i; j++) {
            real sum = row[map[j]];
            for (int k = from[i] > from[j] ? from[i] : from[j]; k < j; k++) sum -= l[i][k] * l[j][k];
            if (i == j) b->pivot = (double)fminq(b->pivot, row[map[i]] > 0 ? sum / row[map[i]] : 0);
            if (i == j && !(sum > least_pivot * row[map[i]])) return false;
            l[i][j] = i == j ? sqrtq(sum) : sum / l[j][j];
        }
        for (int k = from[i]; k < i; k++) z[i] -= l[i][k] * z[k];
        z[i] /= l[i][i];
    }
    for (int i = n - 1; i >= 0; i--) {
        z[i] /= l[i][i];
        b->x[map[i]] = z[i];
        for (int k = from[i]; k < i; k++) z[k] -= l[i][k] * z[i];
    }
    return true;
}

/// max |w| against the size of what was asked for.
static void measure_growth(const wiggly_desc *desc, struct textbook *b)
{
    real low = b->y[b->first], high = low, scale = 0, largest = 0, t = (b->loop ? b->count : b->count - 1) * b->h;
    for (int k = 0; k < b->count; k++) {
        low = fminq(low, b->y[b->first + k]);
        high = fmaxq(high, b->y[b->first + k]);
        largest = fmaxq(largest, cabsq(b->x[2 * k] + 1.0Qi * b->x[2 * k + 1]));
    }
    scale = high - low;
    for (int n = 0; n < desc->knot_count; n++) {
        const wiggly_knot *knot = &desc->knots[n];
        scale = fmaxq(scale, fabsq((real)knot->value - b->y[knot->sample] - crealq(b->u[knot->sample])));
        if (knot->has_slope) scale = fmaxq(scale, t * fabsq((real)knot->slope));
    }
    b->growth = scale > 0 ? (double)(largest / scale) : 0;
}

/// The motion that is given after the last knot.
static void continue_after_last(struct textbook *b)
{
    for (int i = b->last; i + 1 < b->samples; i++) {
        int k = i - b->first;
        number w = b->x[2 * k] + 1.0Qi * b->x[2 * k + 1];
        w = b->is_complex ? w * cexpq((b->at[i].p + b->at[i + 1].p) / 2 * b->h) : w + b->y[i] - b->y[i + 1];
        b->x[2 * k + 2] = crealq(w);
        b->x[2 * k + 3] = cimagq(w);
    }
}

bool textbook_as(const wiggly_desc *desc, wiggly_status status, struct textbook *b, double *total, double *re,
                 double *im)
{
    bool calmed = status != WIGGLY_OK && desc->calm == 0;
    open_book(desc, calmed ? 0.05Q : (real)desc->calm, b);
    if (is_still(desc, b)) {
        // w = 0
    } else if (b->count < 3) {
        solve_short(desc, b);
    } else {
        textbook_assemble(desc, b, status == WIGGLY_LEVELLED);
        if (!solve(b)) return false;
    }
    textbook_fill(b, total, re, im);
    if (b->count >= 3) measure_growth(desc, b);
    return true;
}

void textbook_fill(struct textbook *b, double *total, double *re, double *im)
{
    if (b->tied) continue_after_last(b);
    for (int i = 0; i < b->samples; i++) {
        int j = b->loop ? i % b->count : i, k = j < b->first ? 0 : j - b->first;
        number x = b->u[j] + b->x[2 * k] + 1.0Qi * b->x[2 * k + 1];
        re[i] = (double)crealq(x);
        im[i] = (double)cimagq(x);
        total[i] = (double)(b->y[j] + crealq(x));
    }
}

static bool is_singular(const struct textbook *b, bool solved) { return b->open && (!solved || b->growth > blow_up); }

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
