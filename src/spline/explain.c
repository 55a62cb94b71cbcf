/// The frequency and damping that explain knots best (docs/mathematics.md, Frequency).
#include "maths/maths.h"
#include "maths/symmetric.h"
#include "spline/host.h"
#include "spline/problem.h"
#include <math.h>
#include <string.h>

enum { MOST = 48, PITCHES = 96, DAMPINGS = 10, REFINEMENTS = 24 };

static const double dampings[DAMPINGS] = {0.01, 0.02, 0.035, 0.05, 0.08, 0.12, 0.18, 0.27, 0.4, 0.6};

static const double pluck = 30;      ///< variance of the initial displacement, relative to the noise
static const double blur = 0.03;     ///< share of the mean gap by which a knot may be off its intended time
static const double headroom = 1.25; ///< above one extremum per gap: the smallest gap may be too long
static const double tau = 6.283185307179586;

/// The knots that are used, in order of time.
typedef struct sight {
    double time[MOST], value[MOST]; ///< from the first knot on, seconds; above the equilibrium
    int count;
    double smallest, mean; ///< gap
    bool is_real;
} sight;

/// The earliest MOST knots.
static sight sight_of(const wiggly_desc *desc)
{
    const wiggly_param *y = &desc->equilibrium;
    sight s = {.is_real = desc->mode == WIGGLY_REAL, .smallest = INFINITY};
    double size = 0;
    for (int k = 0; k < desc->knot_count; k++) {
        const wiggly_knot *knot = &desc->knots[k];
        const double time = knot->sample * desc->step;
        if (knot->still || (s.count == MOST && !(time < s.time[MOST - 1]))) continue;
        int at = s.count < MOST ? s.count++ : MOST - 1;
        for (; at > 0 && s.time[at - 1] > time; at--) {
            s.time[at] = s.time[at - 1];
            s.value[at] = s.value[at - 1];
        }
        s.time[at] = time;
        s.value[at] = knot->value - (y->track ? y->track[knot->sample] : y->value);
    }
    for (int k = 0; k < s.count; k++) size = fmax(size, fabs(s.value[k]));
    for (int k = 0; k < s.count; k++) s.value[k] *= scale_for(size); // their squares are a double's
    for (int k = 1; k < s.count; k++) s.smallest = fmin(s.smallest, s.time[k] - s.time[k - 1]);
    if (s.count > 1) s.mean = (s.time[s.count - 1] - s.time[0]) / (s.count - 1);
    return s;
}

/// m/2 log vᵀK⁻¹v + ½ log|K|; infinite if K is numerically singular, or v is 0.
static double cost_of(const sight *s, double frequency, double damping)
{
    const double natural = tau * frequency, decay = damping * natural;
    const double turn = natural * sqrt((1 - damping) * (1 + damping)), missed = natural * blur * s->mean;
    const int n = s->count;
    double k[MOST * MOST], y[MOST], size = 0, volume = 0;
    memcpy(y, s->value, sizeof y);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j <= i; j++) {
            const double apart = s->time[i] - s->time[j], age = s->time[i] + s->time[j] - 2 * s->time[0];
            // The correlation of values this far apart: noise through the filter without bandwidth.
            const double fading = maths_exp(-decay * apart);
            const maths_point at = maths_turn(turn * apart);
            const double kinship =
                s->is_real ? fading * (at.cos + decay / turn * at.sin) : fading * (1 + decay * apart) * at.cos;
            k[n * i + j] = kinship + pluck * maths_exp(-decay * age) * at.cos;
        }
        k[n * i + i] += missed * missed;
    }
    symmetric_reduce(n, n, k);
    symmetric_solve(n, k, y);
    for (int i = 0; i < n; i++) size += s->value[i] * y[i], volume += maths_log(k[n * i + i]);
    return size > 0 ? 0.5 * n * maths_log(size) + volume : INFINITY;
}

static int explain(const wiggly_desc *desc, wiggly_explanation best[2])
{
    wiggly_desc own;
    int wrong;
    bool is_safe;
    if (!best || desc_read(desc, &own) != WIGGLY_OK) return 0;
    if (desc_check(&own, &wrong, &is_safe) != WIGGLY_OK) return 0;
    const sight s = sight_of(&own);
    if (s.count < WIGGLY_FEWEST_EXPLAINED || !(s.smallest > 0)) return 0; // two on one sample
    const double lowest = 0.5 / (s.mean * (s.count - 1)), highest = fmax(headroom * 0.5 / s.smallest, 2 * lowest);
    const double pitch = maths_log(highest / lowest) / (PITCHES - 1), ratio = maths_exp(pitch);
    wiggly_explanation all[PITCHES];
    int count = 0;
    for (int n = 0; n < PITCHES; n++) { // each with its best damping
        const double frequency = lowest * maths_exp(pitch * n);
        all[n] = (wiggly_explanation){frequency, 0, INFINITY};
        for (int d = 0; d < DAMPINGS; d++) {
            const double cost = cost_of(&s, frequency, dampings[d]);
            if (cost < all[n].cost) all[n] = (wiggly_explanation){frequency, dampings[d], cost};
        }
    }
    for (int n = 0; n < PITCHES; n++) {
        const double below = n > 0 ? all[n - 1].cost : INFINITY, above = n + 1 < PITCHES ? all[n + 1].cost : INFINITY;
        if (!isfinite(all[n].cost) || !(all[n].cost < below && all[n].cost <= above)) continue;
        wiggly_explanation found = all[n]; // descends from the grid's best point in steps that halve
        double step = sqrt(ratio), more = 1.25;
        for (int r = 0; r < REFINEMENTS; r++) {
            const wiggly_explanation from = found;
            const double frequency[] = {from.frequency * step, from.frequency / step, from.frequency, from.frequency};
            const double damping[] = {from.damping, from.damping, fmin(from.damping * more, 0.9),
                                      from.damping / more};
            for (int k = 0; k < 4; k++) {
                const double cost = cost_of(&s, frequency[k], damping[k]);
                if (cost < found.cost) found = (wiggly_explanation){frequency[k], damping[k], cost};
            }
            if (found.cost == from.cost) step = sqrt(step), more = sqrt(more);
        }
        if (count == 0 || found.cost < best[0].cost) {
            best[1] = best[0];
            best[0] = found;
        } else if (count == 1 || found.cost < best[1].cost) {
            best[1] = found;
        }
        count++;
    }
    return count < 2 ? count : 2;
}

int wiggly_explain(const wiggly_desc *desc, wiggly_explanation best[2])
{
    const host_state host = host_leave();
    const int found = explain(desc, best);
    host_return(&host);
    return found;
}
