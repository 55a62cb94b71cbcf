/// Fewer knots for nearly the same motion. From the ends and extremes on, a knot is added where the curve misses one most, until it misses none
/// by more than the tolerance; then each is left out that the others can do without. As noise hinders that, values are fitted to all knots. It tries
/// several frequencies and dampings: with the right ones, a swing goes on without knots.
#include "scene/simplify.h"
#include "maths/symmetric.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST = 128,      ///< knots that are added; for more knots in all, other frequencies are not searched
    FITTED = 12,     ///< numbers that are fitted at most: each takes a solve
    EXPLAINED = 24,  ///< knots that wiggly_explain() sees at most
    STAGES = 4,      ///< sets of more and more knots for which a frequency is refined
    REFINEMENTS = 8, ///< steps
};

/// Solves for the knots that stay; returns the largest error at all.
static double solve(struct simplify *s, double *error)
{
    double largest = 0;
    s->desc.knot_count = 0;
    for (int k = 0; k < s->count; k++) {
        if (s->stays[k]) s->solved[s->desc.knot_count++] = s->knots[k];
    }
    if (wiggly_solve(s->solver, &s->desc, &s->curve) >= WIGGLY_ERROR_ARGUMENT) return INFINITY;
    for (int k = 0; k < s->count; k++) {
        const wiggly_knot *knot = &s->given.knots[k];
        error[k] = knot->still ? 0 : knot->value - s->curve.total[knot->sample];
        largest = fmax(largest, fabs(error[k]));
    }
    return largest;
}

static double solve_given(struct simplify *s)
{
    memcpy(s->knots, s->given.knots, (size_t)s->count * sizeof *s->knots);
    s->knots[0].has_phase |= s->turns;
    return solve(s, s->error);
}

/// Then moves values, and the phase if the first knot turns, so that the squares of the errors are least: the curve is linear in them. Infinite
/// if they are too many.
static double fit(struct simplify *s)
{
    double matrix[FITTED * FITTED] = {0}, by[FITTED] = {0}, *moved[FITTED];
    int n = 0;
    for (int k = s->turns ? -1 : 0; k < s->count; k++) {
        if (k >= 0 && (!s->stays[k] || s->held[k])) continue;
        if (n == FITTED) return INFINITY;
        moved[n++] = k < 0 ? &s->knots[0].phase : &s->knots[k].value;
    }
    for (int i = 0; i < n; i++) {
        double *column = s->column + i * s->count;
        const double before = *moved[i];
        *moved[i] += s->range;
        solve(s, column);
        *moved[i] = before;
        for (int k = 0; k < s->count; k++) {
            column[k] = (s->error[k] - column[k]) / s->range;
            by[i] += column[k] * s->error[k];
            for (int j = 0; j <= i; j++) matrix[n * i + j] += column[k] * s->column[j * s->count + k];
        }
    }
    symmetric_reduce(n, n, matrix);
    symmetric_solve(n, matrix, by);
    for (int i = 0; i < n; i++) *moved[i] += by[i];
    return solve(s, s->column + FITTED * s->count);
}

static bool suffices(struct simplify *s) { return solve_given(s) <= s->tolerance || fit(s) <= s->tolerance; }

/// Adds the knot that the curve with the given values misses most.
static void add_worst(struct simplify *s)
{
    int worst = -1;
    for (int k = 0; k < s->count; k++) {
        if (!s->stays[k] && (worst < 0 || fabs(s->error[k]) > fabs(s->error[worst]))) worst = k;
    }
    if (worst >= 0) s->stays[worst] = true;
}

static void use(struct simplify *s, const double filter[2], bool turns)
{
    s->desc.frequency.value = filter[0];
    s->desc.damping.value = filter[1];
    s->turns = turns;
}

/// Returns how many knots do, fewer than `most`; else all.
static int thin(struct simplify *s, int most)
{
    int count = 0;
    for (int k = 0; k < s->count; k++) count += s->stays[k] = s->kept[k];
    if (most > count + MOST) most = count + MOST;
    for (; count < most && !suffices(s); count++) add_worst(s);
    for (int k = 0; k < s->count && count < most; k++) {
        if (!s->stays[k] || s->kept[k]) continue;
        s->stays[k] = false;
        if (suffices(s)) {
            count--;
        } else {
            s->stays[k] = true;
        }
    }
    return count < most && suffices(s) ? count : s->count;
}

/// Sum of the squares of the errors with fitted values.
static double cost(struct simplify *s, const double filter[2])
{
    const double *error = s->column + FITTED * s->count;
    double sum = 0;
    use(s, filter, s->may_turn);
    solve_given(s);
    if (fit(s) == INFINITY) return INFINITY;
    for (int k = 0; k < s->count; k++) sum += error[k] * error[k];
    return sum;
}

/// From each start descends in steps that shrink, with more and more knots.
static void search(struct simplify *s)
{
    wiggly_desc few = s->given;
    wiggly_explanation from[3] = {{s->given.frequency.value, s->given.damping.value, 0}};
    if (few.knot_count > EXPLAINED) few.knot_count = EXPLAINED;
    const int starts = 1 + wiggly_explain(&few, from + 1);
    for (int start = 0; start < starts; start++) {
        double at[2] = {from[start].frequency, fmax(from[start].damping, 0.02)};
        memcpy(s->stays, s->kept, (size_t)s->count * sizeof *s->stays);
        for (int stage = 0; stage < STAGES; stage++) {
            double step[2] = {1.05, 1.6}, least = cost(s, at);
            for (int n = 0; n < REFINEMENTS; n++) {
                const double before = least, here[2] = {at[0], at[1]};
                for (int way = 0; way < 4; way++) {
                    double next[2] = {here[0], here[1]};
                    next[way / 2] *= way % 2 ? step[way / 2] : 1 / step[way / 2];
                    next[1] = fmin(next[1], 0.9);
                    const double now = cost(s, next);
                    if (now < least) memcpy(at, next, sizeof at), least = now;
                }
                if (least == before) step[0] = sqrt(step[0]), step[1] = sqrt(step[1]);
            }
            s->tries[s->try_count][0] = round(at[0] * 100) / 100; // as in files
            s->tries[s->try_count++][1] = round(at[1] * 1000) / 1000;
            for (int more = 0; more < 2; more++) cost(s, at), add_worst(s);
        }
    }
}

struct simplify *simplify_open(const wiggly_desc *desc, const bool *fixed, bool searches)
{
    struct simplify *s = need_zeroed(1, sizeof *s);
    const bool loops = desc->start == WIGGLY_LOOP;
    const int count = desc->knot_count, held = desc->has_low || desc->has_high ? desc->samples : 0;
    const size_t n = (size_t)count;
    wiggly_knot *knots = pool_take(&s->pool, 3 * n, sizeof *knots), *first = knots, *last = knots + count - 1;
    int low = 0, high = 0;
    memcpy(knots, desc->knots, n * sizeof *knots);
    s->count = s->left = count;
    s->given = s->desc = *desc;
    s->given.knots = knots;
    s->knots = knots + n;
    s->desc.knots = s->solved = knots + 2 * n;
    s->stays = pool_take(&s->pool, 3 * n, sizeof *s->stays);
    s->held = s->stays + n;
    s->kept = s->held + n;
    s->error = pool_take(&s->pool, (FITTED + 2) * n, sizeof *s->error);
    s->column = s->error + n;
    s->curve.size = sizeof s->curve;
    s->curve.total = pool_take(&s->pool, (size_t)desc->samples, sizeof *s->curve.total);
    if (wiggly_create(desc->samples, count + held, &s->solver) != WIGGLY_OK) need_failed();
    for (int k = 0; k < count; k++) {
        low = knots[k].value < knots[low].value ? k : low;
        high = knots[k].value > knots[high].value ? k : high;
        s->held[k] = fixed[k] || knots[k].still || knots[k].has_phase;
        s->kept[k] = s->held[k] || (!loops && (&knots[k] == first || &knots[k] == last));
    }
    s->range = high != low ? knots[high].value - knots[low].value : 1;
    s->kept[high] |= loops || knots[high].value > fmax(first->value, last->value) + 0.1 * s->range; // it stands out
    s->kept[low] |= loops || knots[low].value < fmin(first->value, last->value) - 0.1 * s->range;
    s->tries[s->try_count][0] = desc->frequency.value;
    s->tries[s->try_count++][1] = desc->damping.value;
    s->searched = searches && count >= WIGGLY_FEWEST_EXPLAINED && count <= MOST;
    s->may_turn = s->searched && desc->mode == WIGGLY_COMPLEX && desc->start == WIGGLY_FREE && !s->held[0];
    if (s->searched) search(s);
    return s;
}

void simplify_within(struct simplify *s, double tolerance)
{
    const int all = s->try_count;
    int best = 0;
    s->tolerance = tolerance + 1e-9 * s->range; // rounding
    s->left = s->count;
    for (int i = 0; i < (s->may_turn ? 2 * all : all); i++) {
        use(s, s->tries[i % all], i >= all);
        const int left = thin(s, i > 0 && s->left > FITTED ? FITTED + 1 : s->left);
        if (left < s->left) s->left = left, best = i;
    }
    use(s, s->tries[best % all], best >= all);
    if (thin(s, s->count) < s->count) return;
    for (int k = 0; k < s->count; k++) s->stays[k] = true;
    solve_given(s);
}

double simplify_without(struct simplify *s, int knot)
{
    for (int k = 0; k < s->count; k++) s->stays[k] = k != knot;
    solve_given(s);
    return s->given.knots[knot].value - s->error[knot];
}

void simplify_close(struct simplify *s)
{
    if (!s) return;
    wiggly_destroy(s->solver);
    pool_free(&s->pool);
    free(s);
}
