/// A few knots in, a curve out as CSV: the shortest program that uses the library.
#include <stdio.h>
#include <stdlib.h>
#include <wiggly/wiggly.h>

enum { SAMPLES = 121 };

int main(void)
{
    const wiggly_knot knots[] = {
        {.sample = 0, .value = 0, .has_slope = true, .slope = 0, .stiffness = 1000},
        {.sample = 36, .value = 1},
        {.sample = 90, .value = -0.5},
    };
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = SAMPLES;
    desc.frequency.value = 1.0;
    desc.damping.value = 0.1;
    desc.knots = knots;
    desc.knot_count = sizeof knots / sizeof knots[0];

    wiggly_solver *solver;
    wiggly_status status = wiggly_create(SAMPLES, desc.knot_count, &solver);
    if (status != WIGGLY_OK) {
        fprintf(stderr, "%s\n", wiggly_status_text(status));
        return EXIT_FAILURE;
    }
    static double total[SAMPLES], y[SAMPLES], re[SAMPLES], im[SAMPLES], omega[SAMPLES];
    wiggly_curve curve = {.size = sizeof curve, .total = total, .y = y, .re = re, .im = im, .omega = omega};
    status = wiggly_solve(solver, &desc, &curve);
    wiggly_destroy(solver);
    if (status != WIGGLY_OK) fprintf(stderr, "%s\n", wiggly_status_text(status));
    if (status >= WIGGLY_ERROR_ARGUMENT) return EXIT_FAILURE;

    printf("seconds,value,swing\n");
    for (int i = 0; i < SAMPLES; i++) printf("%.6f,%.9f,%.9f\n", i * desc.step, total[i], im[i]);
    return EXIT_SUCCESS;
}
