/// Rows of values between samples, as floats: what wiggly_evaluate() says, at a fraction of its cost.
//
// A row goes along the curve in even steps, each of which turns the frame's e^{jω_c t} by the same angle, and while the frequency
// stays the same, the frame of one interval serves those after it: each takes one more sample into it,
//     g_{i+2} = e^{−j·turn·(i+2−k)} x_{i+2}   in the frame of interval k,
// and the value is y + Re(e^{j·turn·(t−k)} CatmullRom(g_{i−1} … g_{i+2})). Both turns are products of the one before; sines are taken
// where the frequency changes, and now and then against rounding.
#include "spline/evaluate.h"
#include "spline/poles.h"

/// A complex number in a vector. (re, im)
typedef double pair __attribute__((vector_size(16)));

static inline pair times(pair a, pair b)
{
    pair re = {b[0], b[0]}, im = {-b[1], b[1]}, swapped = {a[1], a[0]};
    return a * re + swapped * im;
}

static inline pair conjugate(pair a) { return (pair){a[0], -a[1]}; }

/// e^{j·angle} to 1e-12: quick, and enough for floats.
static pair unit(double angle)
{
    static const double two_over_pi = 0x1.45f306dc9c883p-1, half_pi = 0x1.921fb544p+0, rest = 0x1.0b4611a626331p-34;
    static const double rounder = 0x1.8p+52; // what it is added to has no fraction
    if (!(fabs(angle) < 1e5)) return (pair){cos(angle), sin(angle)};
    double quarters = angle * two_over_pi + rounder - rounder;
    double r = angle - quarters * half_pi - quarters * rest, r2 = r * r, r4 = r2 * r2;
    double s = (-1.0 / 6 + r2 / 120) + r4 * ((-1.0 / 5040 + r2 / 362880) + r4 * (-1.0 / 39916800 + r2 / 6227020800));
    double c = (1.0 / 24 - r2 / 720) + r4 * ((1.0 / 40320 - r2 / 3628800) + r4 / 479001600);
    s = r + r * r2 * s;
    c = (1 - 0.5 * r2) + r4 * c;
    int quarter = (int)quarters;
    pair turn = quarter & 1 ? (pair){-s, c} : (pair){c, s};
    return quarter & 2 ? -turn : turn;
}

/// Where a row is.
typedef struct row {
    const wiggly_curve *curve;
    double from, by;
    double base;                   ///< position of the interval's u = 0, not wrapped
    cubic plain;                   ///< y; outside complex mode the total
    pair before, here, next, last; ///< x around the interval, in the frame
    double turn;                   ///< of the frame in an interval
    pair once_back, by_step;       ///< e^{−j·turn}, e^{j·turn·by}
    pair into, at;                 ///< what turned `last` into the frame; e^{j·turn·t} at the next value
    int left;                      ///< intervals until all is computed anew
} row;

enum { RENEWED_AFTER = 32 };

static inline pair x_at(const wiggly_curve *curve, int i) { return (pair){curve->re[i], curve->im[i]}; }

/// Goes one interval on: takes the sample after it (-1: there is none) into the frame.
static inline void slide(row *r, int after)
{
    r->into = times(r->into, r->once_back);
    r->before = r->here, r->here = r->next, r->next = r->last;
    r->last = after < 0 ? 2 * r->next - r->here : times(x_at(r->curve, after), r->into);
}

/// Makes the frame that of the interval after sample i, in which the next value is at u.
static void renew(row *r, int before, int i, int after, double u, double turn)
{
    const wiggly_curve *curve = r->curve;
    if (turn != r->turn) {
        r->turn = turn;
        r->once_back = unit(-turn);
        r->by_step = unit(turn * r->by);
    }
    r->here = x_at(curve, i);
    r->next = times(x_at(curve, i + 1), r->once_back);
    r->before = before < 0 ? 2 * r->here - r->next : times(x_at(curve, before), conjugate(r->once_back));
    r->into = times(r->once_back, r->once_back);
    r->last = after < 0 ? 2 * r->next - r->here : times(x_at(curve, after), r->into);
    r->at = unit(turn * u);
    r->left = RENEWED_AFTER;
}

/// y at a sample; outside complex mode the total.
static inline double plain_at(const wiggly_curve *curve, int i)
{
    return curve->mode == WIGGLY_COMPLEX ? curve->y[i] : curve->y[i] + curve->re[i];
}

static inline cubic plain_between(const wiggly_curve *curve, int before, int i, int after)
{
    double from = plain_at(curve, i), to = plain_at(curve, i + 1);
    return cubic_through(before < 0 ? 2 * from - to : plain_at(curve, before), from, to,
                         after < 0 ? 2 * to - from : plain_at(curve, after));
}

/// Goes to the interval after sample i, in which the next value is at u.
static inline void enter(row *r, int i, double base, double u)
{
    const wiggly_curve *curve = r->curve;
    bool follows = base == r->base + 1;
    r->base = base;
    int before = evaluate_neighbour(curve, i - 1), after = evaluate_neighbour(curve, i + 2);
    r->plain = plain_between(curve, before, i, after);
    if (curve->mode != WIGGLY_COMPLEX) return;
    double turn = 0.5 * (curve->omega[i] + curve->omega[i + 1]) * curve->step;
    if (r->left-- > 0 && turn == r->turn && follows) {
        slide(r, after);
    } else {
        renew(r, before, i, after, u, turn);
    }
}

/// Writes values from number k on, up to the end of the interval or `count`; returns how far it came.
static inline int write_turning(row *r, int k, int count, double u, float *out, size_t stride)
{
    pair c1 = 0.5 * (r->next - r->before), after = 0.5 * (r->last - r->here), step = r->next - r->here;
    pair c0 = r->here, c2 = 3 * step - 2 * c1 - after, c3 = c1 + after - 2 * step, at = r->at;
    do {
        pair z = c0 + u * (c1 + u * (c2 + u * c3)), turned = at * z;
        out[(size_t)k * stride] = (float)(cubic_at(r->plain, u) + turned[0] - turned[1]);
        at = times(at, r->by_step);
        u = r->from + r->by * ++k - r->base;
    } while (k < count && u >= 0 && u < 1);
    r->at = at;
    return k;
}

static inline int write_plain(const row *r, int k, int count, double u, float *out, size_t stride)
{
    do {
        out[(size_t)k * stride] = (float)cubic_at(r->plain, u);
        u = r->from + r->by * ++k - r->base;
    } while (k < count && u >= 0 && u < 1);
    return k;
}

/// Whether a row can go on from a position: not where the curve is held or x is constant, nor so far round a loop that u is lost.
static inline bool goes_on(const wiggly_curve *curve, double position)
{
    if (curve->start == WIGGLY_LOOP) return curve->samples > 1 && fabs(position) < 1e9;
    return position >= 0 && position >= curve->first && position < curve->samples - 1;
}

/// Whether a block of values that are computed apart is quicker than going on: for long steps, and sooner where the turn changes.
static inline bool is_quicker_apart(const wiggly_curve *curve, int i, double by)
{
    if (curve->mode != WIGGLY_COMPLEX || curve->samples < 4) return false;
    bool changes = i + 2 < curve->samples && curve->omega[i + 2] != curve->omega[i];
    return fabs(by) >= (changes ? 0.1 : 0.4);
}

void wiggly_evaluate_float(const wiggly_curve *curve, double from, double by, int count, float *out, size_t stride)
{
    row r = {.curve = curve, .from = from, .by = by, .turn = NAN};
    for (int k = 0; k < count;) {
        double position = from + by * k, u;
        if (!goes_on(curve, position)) {
            wiggly_value value = wiggly_evaluate(curve, position);
            out[(size_t)k++ * stride] = (float)(value.y + value.re);
            r.left = 0;
            continue;
        }
        int i = evaluate_locate(curve, position, &u);
        if (is_quicker_apart(curve, i, by)) {
            k = evaluate_apart(curve, from, by, k, count, out, stride);
            r.left = 0;
            continue;
        }
        enter(&r, i, position - u, u);
        if (curve->mode == WIGGLY_COMPLEX) {
            k = write_turning(&r, k, count, u, out, stride);
        } else {
            k = write_plain(&r, k, count, u, out, stride);
        }
    }
}
