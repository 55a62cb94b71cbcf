/// A game's idle cycle: solved once in the game's own memory, then only read, at whatever rate the game renders.
#include <math.h>
#include <stdalign.h>
#include <stdio.h>
#include <stdlib.h>
#include <wiggly/wiggly.h>

enum { SAMPLES = 49, KNOTS = 2, ARENA_BYTES = 1 << 20 };

/// What an engine's own allocator would hand out.
static alignas(64) unsigned char arena[ARENA_BYTES];
static double total[SAMPLES], y[SAMPLES], re[SAMPLES], im[SAMPLES], omega[SAMPLES];

int main(void)
{
    const wiggly_knot knots[KNOTS] = {{.sample = 0, .value = -1}, {.sample = 20, .value = 1}};
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = SAMPLES; // two seconds: the last sample is the first one again
    desc.start = WIGGLY_LOOP;
    desc.frequency.value = 1.5;
    desc.damping.value = 0.08;
    desc.knots = knots;
    desc.knot_count = KNOTS;

    size_t bytes = wiggly_memsize(SAMPLES, KNOTS);
    wiggly_solver *solver;
    wiggly_curve curve = {.size = sizeof curve, .total = total, .y = y, .re = re, .im = im, .omega = omega};
    wiggly_status status = wiggly_create_at(arena, sizeof arena, SAMPLES, KNOTS, &solver);
    if (status == WIGGLY_OK) status = wiggly_solve(solver, &desc, &curve);
    if (status != WIGGLY_OK) {
        fprintf(stderr, "%s (%zu bytes asked for)\n", wiggly_status_text(status), bytes);
        return EXIT_FAILURE;
    }

    const double cycle = (SAMPLES - 1) * desc.step, frame = 1.0 / 144;
    double previous = wiggly_lagged(wiggly_evaluate_at(&curve, 0, NULL), 0), largest_step = 0;
    for (double time = frame; time < 3 * cycle; time += frame) {
        double value = wiggly_lagged(wiggly_evaluate_at(&curve, time, NULL), 0);
        largest_step = fmax(largest_step, fabs(value - previous));
        previous = value;
    }
    printf("solver memory %zu bytes, largest change in a frame over three cycles %.4f\n", bytes, largest_step);
    return largest_step < 0.2 ? EXIT_SUCCESS : EXIT_FAILURE; // a pop at the seam would be far larger
}
