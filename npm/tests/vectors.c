/// wiggly_solve() for vectors.test.js: everything is in one array of doubles.
//
// In: per parameter (frequency, damping, bandwidth, equilibrium) a number, then per parameter N of a track; per knot its members in order.
// Out, over the first of them: total, Re x, Im x, N each.
#include <wiggly/more.h>

enum { PARAMETERS = 4, MEMBERS = 9, MOST_NUMBERS = 1 << 18, MOST_KNOTS = 64 };

static double numbers[MOST_NUMBERS];

double *vector_numbers(void) { return numbers; }

int vector_solve(int samples, double step, int mode, int start, int passive, double calm, double wind_up, int knots,
                 int tracks, int method)
{
    wiggly_desc desc = wiggly_default_desc();
    wiggly_knot of[MOST_KNOTS];
    wiggly_param *params[] = {&desc.frequency, &desc.damping, &desc.bandwidth, &desc.equilibrium};
    const double *knot = numbers + PARAMETERS + (ptrdiff_t)PARAMETERS * samples;
    desc.samples = samples, desc.step = step, desc.calm = calm, desc.wind_up = wind_up;
    desc.mode = (wiggly_mode)mode, desc.start = (wiggly_start)start, desc.passive = (wiggly_passive)passive;
    for (int i = 0; i < PARAMETERS; i++) {
        params[i]->value = numbers[i];
        if (tracks & 1 << i) params[i]->track = numbers + PARAMETERS + (ptrdiff_t)i * samples;
    }
    for (int n = 0; n < knots; n++, knot += MEMBERS)
        of[n] = (wiggly_knot){.sample = (int)knot[0],
                              .has_slope = knot[1] != 0,
                              .has_phase = knot[2] != 0,
                              .still = knot[3] != 0,
                              .settles = knot[8] != 0,
                              .value = knot[4],
                              .slope = knot[5],
                              .stiffness = knot[6],
                              .phase = knot[7]};
    desc.knots = of, desc.knot_count = knots;
    static double out[3 * (MOST_NUMBERS / 8)];
    wiggly_curve curve = {.size = sizeof curve, .total = out, .re = out + samples, .im = out + 2 * samples};
    wiggly_solver *solver;
    if (wiggly_create(samples, knots, &solver) != WIGGLY_OK) return WIGGLY_ERROR_MEMORY;
    wiggly_set_method(solver, (wiggly_method)method);
    const wiggly_status status = wiggly_solve(solver, &desc, &curve);
    wiggly_destroy(solver);
    for (int i = 0; i < 3 * samples; i++) numbers[i] = out[i];
    return (int)status;
}

/// Of a spring and a friction the frequency and damping, as the first two numbers.
void vector_spring(double k, double gamma) { wiggly_from_spring(k, gamma, &numbers[0], &numbers[1]); }
