/// Many threads: a solver of its own for each of a game's threads, and a batch, which brings its threads along. Both give the same
/// bits. (The threads here are POSIX threads; a solver does not mind whose they are.)
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <wiggly/wiggly.h>

enum { THREADS = 4, SPLINES = 64, SAMPLES = 121, KNOTS = 3 };

static wiggly_knot knots[SPLINES][KNOTS];
static wiggly_desc descs[SPLINES];
static double alone[SPLINES][SAMPLES], together[SPLINES][SAMPLES];

typedef struct share {
    pthread_t thread;
    int first; ///< its splines are this one and every THREADS-th after it
    wiggly_status worst;
} share;

static void describe(int i)
{
    knots[i][0] = (wiggly_knot){.sample = 0, .value = 0};
    knots[i][1] = (wiggly_knot){.sample = 24 + i % 30, .value = 1};
    knots[i][2] = (wiggly_knot){.sample = 90, .value = -0.5};
    descs[i] = wiggly_default_desc();
    descs[i].samples = SAMPLES;
    descs[i].frequency.value = 1 + 0.01 * i;
    descs[i].damping.value = 0.1;
    descs[i].knots = knots[i];
    descs[i].knot_count = KNOTS;
}

static void *solve_share(void *argument)
{
    share *mine = argument;
    wiggly_solver *solver;
    mine->worst = wiggly_create(SAMPLES, KNOTS, &solver);
    if (mine->worst != WIGGLY_OK) return NULL;
    for (int i = mine->first; i < SPLINES; i += THREADS) {
        wiggly_curve curve = {.size = sizeof curve, .total = alone[i]};
        wiggly_status status = wiggly_solve(solver, &descs[i], &curve);
        if (status > mine->worst) mine->worst = status;
    }
    wiggly_destroy(solver);
    return NULL;
}

static wiggly_status solve_by_own_threads(void)
{
    share shares[THREADS];
    wiggly_status worst = WIGGLY_OK;
    for (int t = 0; t < THREADS; t++) {
        shares[t].first = t;
        if (pthread_create(&shares[t].thread, NULL, solve_share, &shares[t]) != 0) exit(EXIT_FAILURE);
    }
    for (int t = 0; t < THREADS; t++) {
        pthread_join(shares[t].thread, NULL);
        if (shares[t].worst > worst) worst = shares[t].worst;
    }
    return worst;
}

static wiggly_status solve_by_batch(void)
{
    wiggly_batch *batch;
    wiggly_curve curves[SPLINES];
    for (int i = 0; i < SPLINES; i++) curves[i] = (wiggly_curve){.size = sizeof(wiggly_curve), .total = together[i]};
    wiggly_status status = wiggly_batch_create(SAMPLES, KNOTS, THREADS, &batch);
    if (status != WIGGLY_OK) return status;
    for (int frame = 0; frame < 3 && status == WIGGLY_OK; frame++) {
        status = wiggly_batch_solve(batch, descs, curves, NULL, SPLINES); // its threads wait in between
    }
    wiggly_batch_destroy(batch);
    return status;
}

int main(void)
{
    for (int i = 0; i < SPLINES; i++) describe(i);
    wiggly_status worst = solve_by_own_threads();
    if (worst == WIGGLY_OK) worst = solve_by_batch();
    if (worst != WIGGLY_OK) {
        fprintf(stderr, "%s\n", wiggly_status_text(worst));
        return EXIT_FAILURE;
    }
    bool same = memcmp(alone, together, sizeof alone) == 0;
    printf("%d splines on %d threads, twice: %s\n", SPLINES, THREADS, same ? "the same bits" : "different");
    return same ? EXIT_SUCCESS : EXIT_FAILURE;
}
