/// The textbook's spline: its domain, its dense system and what follows from the answer.

#include "textbook_parts.h"
#include <assert.h>
#include <math.h>
#include <string.h>

static const real least_pivot = 1e-28Q;
static const double blow_up = 1e4;

void textbook_sorted(const wiggly_desc *desc, const wiggly_knot **knots)
{
    for (int n = 0; n < desc->knot_count; n++) {
        int place = n;
        for (; place > 0 && knots[place - 1]->sample > desc->knots[n].sample; place--)
            knots[place] = knots[place - 1];
        knots[place] = &desc->knots[n];
    }
}

static void find_knots(const wiggly_desc *desc, struct textbook *b)
{
    b->earliest = b->last = b->first_still = -1;
    memset(b->still, 0, sizeof b->still);
    for (int n = 0; n < desc->knot_count; n++) {
        int sample = desc->knots[n].sample;
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
    for (int i = 0; i < b->samples; i++) {
        bool wraps = b->loop && i == b->samples - 1;
        b->y[i] = wraps ? b->y[0] : textbook_param(desc->equilibrium, i);
    }
    b->winds_up = desc->wind_up > 0 && b->is_complex && !b->filter && !desc->has_low && !desc->has_high;
    textbook_settle(desc, b);
    textbook_fill_poles(desc, b->loop ? calm / 20 : 0, b->loop, b->at);
    textbook_forced_response(desc, b);
    size_t n = 2 * (size_t)(b->count > 2 ? b->count : 2);
    memset(b->band, 0, sizeof b->band[0] * n);
    memset(b->right, 0, sizeof(real) * n);
    memset(b->x, 0, sizeof(real) * n);
    memset(b->fixed, 0, n);
    memset(b->used, 0, n);
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

/// Too short for a row: each its knot's, else the earliest knot's, of an oscillator's cubic as it is in the total.
static void solve_short(const wiggly_desc *desc, struct textbook *b)
{
    for (int pass = 0; pass < 2; pass++) {
        for (int n = 0; n < desc->knot_count; n++) {
            const wiggly_knot *knot = &desc->knots[n];
            int sample = knot->sample;
            number w = textbook_knot(desc, b, knot);
            const bool whole = knot->still || knot->has_phase;
            for (int k = 0; k < b->count; k++) {
                if (pass == 0 && sample != b->earliest) continue;
                if (pass == 1 && k != sample - b->first) continue;
                b->x[2 * k] = crealq(w);
                if (whole) b->x[2 * k + 1] = cimagq(w);
                if (pass == 0 && sample == b->earliest && desc->mode == WIGGLY_CUBIC && !b->filter)
                    b->x[2 * k] += b->y[sample] - b->y[b->first + k];
            }
        }
    }
}

int textbook_place(const struct textbook *b, int unknown)
{
    int k = unknown / 2, folded = 2 * k < b->count ? 2 * k : 2 * (b->count - k) - 1;
    return 2 * (b->loop ? folded : k) + unknown % 2;
}

real textbook_entry(const struct textbook *b, int row, int column)
{
    int i = textbook_place(b, row), j = textbook_place(b, column), n = i > j ? i - j : j - i;
    return n < TEXTBOOK_BAND ? b->band[i > j ? i : j][n] : 0;
}

/// L D Lᵀ of the band, place by place; what is fixed or not used has no row.
struct factor {
    int width; ///< entries per row: of three samples, or of five where a loop is folded
    real l[2 * TEXTBOOK_MAX][TEXTBOOK_BAND], d[2 * TEXTBOOK_MAX];
    int unknown[2 * TEXTBOOK_MAX]; ///< at each place; -1: no row
};

static int first_in_band(const struct factor *f, int i) { return i < f->width ? 0 : i - f->width + 1; }

static bool factorise(struct textbook *b, int n, struct factor *f)
{
    f->width = b->loop ? TEXTBOOK_BAND : 6;
    for (int u = 0; u < n; u++) f->unknown[textbook_place(b, u)] = b->used[u] && !b->fixed[u] ? u : -1;
    for (int i = 0; i < n; i++) {
        real ld[TEXTBOOK_BAND]; // l and d multiplied, of this row
        f->d[i] = 1;
        memset(f->l[i], 0, sizeof f->l[i]);
        if (f->unknown[i] < 0) continue;
        for (int j = first_in_band(f, i); j <= i; j++) {
            real sum = f->unknown[j] < 0 ? 0 : b->band[i][i - j];
            for (int k = first_in_band(f, i); k < j; k++) sum -= ld[i - k] * f->l[j][j - k];
            ld[i - j] = sum;
            if (j < i) f->l[i][i - j] = sum / f->d[j];
            if (j == i) f->d[i] = sum;
        }
        b->pivot = (double)fminq(b->pivot, b->band[i][0] > 0 ? f->d[i] / b->band[i][0] : 0);
        if (!(f->d[i] > least_pivot * b->band[i][0])) return false;
    }
    return true;
}

/// z, by places, becomes the solution.
static void substitute(const struct factor *f, int n, real *z)
{
    for (int i = 0; i < n; i++) {
        for (int k = first_in_band(f, i); k < i; k++) z[i] -= f->l[i][i - k] * z[k];
    }
    for (int i = n - 1; i >= 0; i--) {
        z[i] /= f->d[i];
        for (int k = i + 1; k < n && k < i + f->width; k++) z[i] -= f->l[k][k - i] * z[k];
    }
}

static struct factor factor; // of the book that was solved last

static bool solve(struct textbook *b)
{
    static real z[2 * TEXTBOOK_MAX];
    static int at[2 * TEXTBOOK_MAX]; // unknown of each place, known ones too
    const struct factor *f = &factor;
    const int n = 2 * b->count;
    if (!factorise(b, n, &factor)) return false;
    for (int u = 0; u < n; u++) at[textbook_place(b, u)] = u;
    for (int i = 0; i < n; i++) {
        const int u = f->unknown[i];
        z[i] = u < 0 ? 0 : b->right[u];
        for (int place = first_in_band(f, i); u >= 0 && place < n && place < i + f->width; place++) {
            const int k = at[place];
            if (b->fixed[k] && b->used[k]) z[i] -= textbook_entry(b, u, k) * b->x[k];
        }
    }
    substitute(f, n, z);
    for (int i = 0; i < n; i++) {
        if (f->unknown[i] >= 0) b->x[f->unknown[i]] = z[i];
    }
    b->solved = true;
    return true;
}

double textbook_inverse(const struct textbook *b)
{
    static real z[2 * TEXTBOOK_MAX];
    const int n = 2 * b->count;
    double most = 0;
    for (int signs = 1; b->solved && signs <= 4; signs++) {
        for (int i = 0; i < n; i++)
            z[i] = factor.unknown[i] < 0 ? 0 : (i * 7 % 5 < signs ? -1 : 1) * sqrtq(b->band[i][0]);
        substitute(&factor, n, z);
        for (int i = 0; i < n; i++) most = (double)fmaxq(most, fabsq(z[i]) * sqrtq(b->band[i][0]));
    }
    return most;
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
        number w = textbook_knot(desc, b, knot);
        scale = fmaxq(scale, fmaxq(fabsq(crealq(w)), fabsq(cimagq(w))));
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
    if (b->winds_up) {
        textbook_wind_up(desc, b);
    } else if (is_still(desc, b)) {
        // w = 0
    } else if (b->count < 3) {
        solve_short(desc, b);
    } else {
        textbook_assemble(desc, b, status == WIGGLY_LEVELLED);
        if (!solve(b)) return false;
    }
    textbook_fill(b, total, re, im);
    if (b->count >= 3 && !b->winds_up) measure_growth(desc, b);
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
