/// The rows of the textbook's energy, each written out and squared.
#include "textbook_parts.h"

/// A complex coefficient of w_k, k counted from the domain's first sample.
struct term {
    int k;
    number by;
};

/// How much of a complex row counts.
enum parts { REAL_PART = 1, BOTH_PARTS = 2 };

/// The lower half alone is kept.
static void add_entry(struct textbook *b, int row, int column, real value)
{
    int n = textbook_place(b, row) - textbook_place(b, column);
    if (n >= 0) b->band[textbook_place(b, row)][n] += value;
}

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
        real value[6], rhs = part ? cimagq(right) : crealq(right);
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

number textbook_knot(const wiggly_desc *desc, const struct textbook *b, const wiggly_knot *knot)
{
    if (knot->still) return 0;
    const number w = (real)knot->value - b->y[knot->sample] - crealq(b->u[knot->sample]);
    if (desc->mode != WIGGLY_COMPLEX || !knot->has_phase) return w;
    return w + 1.0Qi * ((real)knot->phase - cimagq(b->u[knot->sample]));
}

/// The poles of the domain's k-th sample.
static const struct textbook_poles *poles_of(const struct textbook *b, int k) { return &b->at[b->first + k]; }

/// The square of |g|, g = e^{(s₀+s₁)h/2}.
static real gain(const struct textbook_poles *at, real h) { return expq(crealq(at->s[0] + at->s[1]) * h); }

/// Coming to rest at a still sample, and leaving from it.
static void add_still(const wiggly_desc *desc, struct textbook *b, int k)
{
    const struct textbook_poles *at = poles_of(b, k);
    const int m = b->count, i = b->first + k;
    const bool cubic = desc->mode == WIGGLY_CUBIC, ends = b->tied && i == b->last;
    real weight = 2 / (b->h * b->h * b->h) / (b->filter ? 1 : gain(at, b->h));
    number back = cexpq((at->s[0] + at->s[1]) * b->h);
    number before = cubic ? b->y[i] - textbook_y_before(b, i) : 0,
           after = cubic ? b->y[i] - textbook_y_after(b, i) : 0;
    if (b->loop || k > 0) add_row(b, BOTH_PARTS, weight, 1, (struct term[]){{(k + m - 1) % m, back}}, before);
    if (b->loop || (k < m - 1 && !ends)) add_row(b, BOTH_PARTS, weight, 1, (struct term[]){{(k + 1) % m, 1}}, after);
}

static void add_jet(const wiggly_desc *desc, struct textbook *b)
{
    bool driven = b->filter || desc->mode == WIGGLY_CUBIC;
    int m = b->count, from = b->loop ? 0 : 1, to = b->loop ? m - 1 : b->tied ? b->last - b->first : m - 2;
    real cube = b->h * b->h * b->h, size = 1;
    number l0 = 0, l1 = 0, g = 0;
    for (int k = from; k <= to; k++) {
        const struct textbook_poles *at = poles_of(b, k);
        int before = b->loop ? (k + m - 1) % m : k - 1, after = b->loop ? (k + 1) % m : k + 1, i = b->first + k;
        if (k == from || at->s[0] != at[-1].s[0] || at->s[1] != at[-1].s[1]) {
            l0 = cexpq(at->s[0] * b->h), l1 = cexpq(at->s[1] * b->h), g = cexpq((at->s[0] + at->s[1]) * b->h / 2);
            size = gain(at, b->h);
        }
        if (b->still[i]) continue;
        number drive = driven ? g * (textbook_y_after(b, i) - 2 * b->y[i] + textbook_y_before(b, i)) : 0;
        real weight = 1 / cube;
        if (!b->filter) weight /= size;
        if (b->tied && k == b->last - b->first) weight *= 2;
        add_row(b, BOTH_PARTS, weight, 3, (struct term[]){{before, l0 * l1}, {k, -(l0 + l1)}, {after, 1}}, -drive);
    }
    for (int k = 0; k < m; k++) {
        if (b->still[b->first + k]) add_still(desc, b, k);
    }
    if (b->rest && !b->filter) { // r₀ = w₁, w₀ and the one before it being 0
        number drive = driven ? (number)(b->y[1] - b->y[0]) : 0;
        add_row(b, BOTH_PARTS, 2 / (cube * gain(poles_of(b, 0), b->h)), 1, (struct term[]){{1, 1}}, -drive);
    }
}

/// The highest frequency of the domain's samples between the still ones around k, both included.
static real highest_around(const struct textbook *b, int k, int held)
{
    real top = poles_of(b, k)->natural;
    for (int way = -1; way <= 1; way += 2) {
        for (int n = 0, i = k; n < held && !b->still[b->first + i]; n++) {
            i += way;
            if (b->loop) i = (i + held) % held;
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
    real t = (b->loop ? b->count : b->count - 1) * b->h, t4 = t * t * t * t;
    int held = b->tied ? b->last - b->first + 1 : b->count;
    real top = 0;
    for (int k = 0; k < held; k++) {
        const bool is_beside =
            k > 0 && !b->still[b->first + k] && !b->still[b->first + k - 1]; // has the same around it
        if (!b->filter && !is_beside) top = highest_around(b, k, held);
        real natural = poles_of(b, k)->natural, w2 = natural * natural;
        real weight = b->h / (t4 * (1 + w2 * w2 * w2 * w2 * t4 * t4));
        if (top > 0) {
            real lack = fmaxq(0, 1 - 100 * w2 / (top * top));
            weight += b->h * (top * top * top * top) * lack * lack;
        }
        add_entry(b, 2 * k + 1, 2 * k + 1, weight);
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
    struct textbook_poles at = textbook_poles_at(desc, peak, 0.05Q);
    number l0 = cexpq(at.s[0] * b->h), l1 = cexpq(at.s[1] * b->h), a = l0 + l1, bb = -l0 * l1;
    real h00 = -expm1q(2 * b->h * crealq(at.s[0] + at.s[1]));
    real determinant =
        expm1q(2 * b->h * crealq(at.s[0])) * expm1q(2 * b->h * crealq(at.s[1])) * powq(cabsq(1 - l0 * conjq(l1)), 2);
    real scale = b->calm / (b->h * b->h * b->h) / (b->filter ? 1 : gain(&at, b->h));
    if (!(scale * h00 > 0)) return;
    b->open = false;
    number lean = -conjq(a + conjq(a) * bb) / h00; // the form is h00 |w₀ + lean·w̃₁|² + determinant/h00 |w̃₁|²
    number from0 = 0, from1 = 1;                   // w̃₁ = from0·w₀ + from1·w₁
    if (!b->filter) {
        struct textbook_speed here = textbook_speed_of(&b->at[b->first], b->h), there = textbook_speed_of(&at, b->h);
        from0 = (here.P - there.P) / there.Q;
        from1 = here.Q / there.Q;
    }
    add_row(b, BOTH_PARTS, scale * h00, 2, (struct term[]){{0, 1 + lean * from0}, {1, lean * from1}}, 0);
    add_row(b, BOTH_PARTS, scale * determinant / h00, 2, (struct term[]){{0, from0}, {1, from1}}, 0);
}

/// Eq. 9 as the paper has it: the total's step to the next sample.
static void add_step_slope(struct textbook *b, int k, real slope, real stiffness)
{
    int from = b->loop || k + 1 < b->count ? k : k - 1, to = b->loop ? (k + 1) % b->count : from + 1;
    real known = (b->y[b->first + to] - b->y[b->first + from]) / b->h;
    add_row(b, REAL_PART, stiffness, 2, (struct term[]){{from, -1 / b->h}, {to, 1 / b->h}}, slope - known);
}

/// The speed at the sample itself, as its poles have it from either side.
static void add_slope(struct textbook *b, int k, real slope, real stiffness)
{
    const struct textbook_poles *at = poles_of(b, k);
    int m = b->count;
    if (b->filter) {
        add_step_slope(b, k, slope, stiffness);
        return;
    }
    real wanted = slope - b->speed[b->first + k];
    if (b->tied && b->first + k == b->last) {
        if (b->is_complex) add_row(b, REAL_PART, stiffness, 1, (struct term[]){{k, at->p}}, wanted);
        return;
    }
    struct textbook_speed forward = textbook_speed_of(at, b->h), backward = textbook_speed_of(at, -b->h);
    real one_sided = stiffness / (1 + b->h * stiffness / 2), both = stiffness / (1 + b->h * stiffness / 4);
    if (!b->loop && k == 0) {
        add_row(b, REAL_PART, one_sided, 2, (struct term[]){{k, forward.P}, {k + 1, forward.Q}}, wanted);
    } else if (!b->loop && k == m - 1) {
        add_row(b, REAL_PART, one_sided, 2, (struct term[]){{k, backward.P}, {k - 1, backward.Q}}, wanted);
    } else {
        int before = (k + m - 1) % m, after = (k + 1) % m;
        add_row(b, REAL_PART, both, 3,
                (struct term[]){{before, backward.Q / 2}, {k, (forward.P + backward.P) / 2}, {after, forward.Q / 2}},
                wanted);
    }
}

/// What knots ask for, and what is implied.
static void add_knots(const wiggly_desc *desc, struct textbook *b, bool level)
{
    bool any_slope = false;
    for (int n = 0; n < desc->knot_count; n++) {
        const wiggly_knot *knot = &desc->knots[n];
        int k = knot->sample - b->first;
        any_slope = any_slope || knot->has_slope;
        number w = textbook_knot(desc, b, knot);
        b->fixed[2 * k] = true;
        b->x[2 * k] = crealq(w);
        if (knot->still || (b->is_complex && knot->has_phase))
            b->fixed[2 * k + 1] = true, b->x[2 * k + 1] = cimagq(w);
        if (knot->has_slope) add_slope(b, k, knot->slope, knot->stiffness);
    }
    bool alone = desc->knot_count == 1 && !any_slope && !b->loop && b->open && !b->tied && !desc->knots[0].still;
    if (level || alone) add_slope(b, b->earliest - b->first, 0, 1000);
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
    b->tie = 1;
    b->tie_rest = b->y[b->last] - textbook_y_after(b, b->last);
    if (!b->is_complex) return;
    struct textbook_speed speed = textbook_speed_of(at, b->h);
    b->tie = (at->p - speed.P) / speed.Q;
    b->tie_rest = 0;
}

void textbook_assemble(const wiggly_desc *desc, struct textbook *b, bool level)
{
    tie_end(desc, b);
    int end = b->tied ? b->last - b->first : b->count - 1;
    for (int k = 0; k < b->count; k++) {
        b->used[2 * k] = k <= end;
        b->used[2 * k + 1] = k <= end && b->is_complex;
    }
    for (int i = 0; b->rest && i < (b->filter ? 4 : 2); i++) b->fixed[i] = true;
    add_jet(desc, b);
    hold_imaginary(b);
    add_start(desc, b);
    add_knots(desc, b, level);
}
