/// Overlapping action from one curve: every joint shows the same spline, a little later in phase than the one before.
#include <stdio.h>
#include <stdlib.h>
#include <wiggly/wiggly.h>

enum { SAMPLES = 97, JOINTS = 8 };

int main(void)
{
    const double lag = 0.35; // radians a joint
    const wiggly_knot knots[] = {{.sample = 0, .value = 0}, {.sample = 24, .value = 1}, {.sample = 60, .value = -1}};
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = SAMPLES;
    desc.frequency.value = 1.2;
    desc.damping.value = 0.1;
    desc.knots = knots;
    desc.knot_count = sizeof knots / sizeof knots[0];

    static double total[SAMPLES], y[SAMPLES], re[SAMPLES], im[SAMPLES], omega[SAMPLES];
    wiggly_curve curve = {.size = sizeof curve, .total = total, .y = y, .re = re, .im = im, .omega = omega};
    wiggly_solver *solver;
    wiggly_status status = wiggly_create(SAMPLES, desc.knot_count, &solver);
    if (status != WIGGLY_OK) return EXIT_FAILURE;
    status = wiggly_solve(solver, &desc, &curve);
    wiggly_destroy(solver);
    if (status >= WIGGLY_ERROR_ARGUMENT) {
        fprintf(stderr, "%s\n", wiggly_status_text(status));
        return EXIT_FAILURE;
    }
    for (int frame = 0; frame <= 240; frame++) { // four seconds, 60 frames each
        wiggly_value value = wiggly_evaluate_at(&curve, frame / 60.0, NULL);
        for (int joint = 0; joint < JOINTS; joint++) {
            printf("%s%.5f", joint ? "," : "", wiggly_lagged(value, joint * lag));
        }
        printf("\n");
    }
    return EXIT_SUCCESS;
}
