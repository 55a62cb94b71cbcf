/// Simulates a soft body to a requested accuracy, and has the options of the commands that do so.
#include "commands/shaking.h"
#include "analysis/analysis.h"
#include "base/need.h"
#include "base/progress.h"
#include "commands/report.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double drive_ratio = 1.375; ///< of drive and body by default: parts follow one after another

// --- a shake, simulated to a requested accuracy
//
// The motion is simulated twice, the second time with steps r times shorter. For a scheme of
// second order the finer error is 1/(r² − 1) of the difference; if backward Euler calmed some steps, which is first order, 1/(r − 1).
// While that is too large, steps get shorter. Chaotic or undamped motions may never get accurate, so the search has a budget of element-
// steps: Newton iterations (or a hundred of conjugate gradients) times elements, which is the same on every machine. The first two
// simulations always run.

/// Simulates the whole motion once.
static bool simulate_once(const struct shaking *s, struct soft *soft, struct record *record, struct error *error)
{
    struct integrator integrator;
    integrator_create(&integrator, &soft->body, 1 / (s->fps * record->substeps));
    integrator.mass_damping = soft->alpha;
    integrator.stiffness_damping = soft->beta;
    integrator.tolerance = 1e-4 * soft->lattice.cell; // Newton's next iteration would change a thousandth of that
    integrator.loads = s->loads;
    bool good = true;
    if (s->loads.gravity > 0 && soft->pinned > 0 && soft->unpinned_parts == 0 &&
        !integrator_find_equilibrium(&integrator))
        good = fail(error, ERROR_INPUT, "%s: the body finds no rest under its weight: try a higher --frequency",
                    s->name);
    if (good) soft_shake(soft, &s->shake, &integrator);
    struct progress progress = {.started = clock_now(), .lines = s->verbose};
    for (int frame = 0; good && frame < record->frames; frame++) {
        for (int step = 0; good && frame > 0 && step < record->substeps; step++) good = integrator_step(&integrator);
        if (!good)
            fail(error, ERROR_INPUT,
                 "frame %d: the simulation became unstable: try a smaller --amplitude or more --damping", frame);
        for (int i = 0; good && i < record->nodes; i++) {
            float *place = record->place[(size_t)frame * (size_t)record->nodes + (size_t)i];
            for (int c = 0; c < 3; c++) place[c] = (float)integrator.x[i][c];
        }
        if (good) progress_show(&progress, frame + 1, record->frames);
    }
    record->calmed = integrator.calmed > 0;
    record->cost = ((double)integrator.newton + (double)integrator.gradients / 100) * soft->body.element_count;
    pool_free(&integrator.pool);
    return good;
}

/// The finer motion's mass-weighted error relative to its amplitude around the mean.
static double estimate_error(const struct record *fine, const struct record *coarse, const double *mass)
{
    double difference = 0, motion = 0, ratio = (double)fine->substeps / coarse->substeps;
    for (int i = 0; i < 3 * fine->nodes; i++) {
        double sum = 0, squares = 0;
        for (int f = 0; f < fine->frames; f++) {
            size_t at = (size_t)f * (size_t)fine->nodes + (size_t)(i / 3);
            double first = (double)fine->place[i / 3][i % 3], place = (double)fine->place[at][i % 3];
            double apart = place - (double)coarse->place[at][i % 3];
            sum += place - first;
            squares += (place - first) * (place - first);
            difference += mass[i / 3] * apart * apart;
        }
        motion += mass[i / 3] * fmax(0, squares - sum * sum / fine->frames);
    }
    bool first_order = fine->calmed || coarse->calmed;
    return motion > 0 ? sqrt(difference / motion) / (first_order ? ratio - 1 : ratio * ratio - 1) : 0;
}

bool record_create(struct record *record, const struct shaking *by, struct soft *soft, struct error *error)
{
    enum { FINEST = 512, STEPS_A_PERIOD = 48 };
    static const double LEAST = 1.5; // steps shorter by less tell too little
    *record = (struct record){.frames = shaking_frames(by), .nodes = soft->body.node_count, .left = -1};
    const size_t count = (size_t)record->frames * (size_t)record->nodes;
    if (!need_has_room(2 * count * sizeof *record->place)) return fail_no_memory(error, by->name);
    struct record coarse = *record;
    record->place = need_zeroed(count, sizeof *record->place);
    coarse.place = need_zeroed(count, sizeof *coarse.place);
    const struct base_drive *drive = by->loads.drive;
    double fastest = soft_frequency(soft), used = 0; // of what is known; of the budget
    if (drive && drive->kind != DRIVE_TRACK)
        fastest = fmax(fastest, drive->frequency * (drive->kind == DRIVE_SWEEP ? 2 : 1));
    record->substeps = by->substeps ? by->substeps : (int)fmax(1, ceil(STEPS_A_PERIOD * fastest / by->fps));
    bool done = simulate_once(by, soft, record, error);
    for (double next = 2, left = -1; done && !by->substeps && (left < 0 || left > by->accuracy);) {
        used += record->cost;
        // Shorter steps need fewer iterations each, so the cost grows at most in proportion.
        if (left >= 0) next = fmin(next, (1e6 * by->budget - used) / record->cost);
        const int finer = (int)ceil(record->substeps * next);
        if (left >= 0 && (finer > FINEST || next < LEAST)) break;
        const struct record swap = coarse;
        coarse = *record;
        *record = swap;
        record->substeps = finer;
        done = simulate_once(by, soft, record, error);
        if (!done) break;
        record->left = left = estimate_error(record, &coarse, soft->body.mass);
        next = fmax(LEAST, fmin(4, 1.1 * sqrt(left / by->accuracy)));
        if (by->verbose) fprintf(stderr, "%d steps a frame: error %.2g %%\n", record->substeps, 100 * left);
    }
    free(coarse.place);
    if (done) record->moved = need((size_t)record->nodes + 1, sizeof *record->moved);
    if (!done) record_free(record);
    return done;
}

void record_free(struct record *record)
{
    free(record->place);
    free(record->moved);
}

void record_embed(const struct record *record, int frame, const struct soft *soft, const double offset[3],
                  float (*position)[3])
{
    for (int i = 0; i < record->nodes; i++) {
        const float *place = record->place[(size_t)frame * (size_t)record->nodes + (size_t)i];
        for (int c = 0; c < 3; c++) record->moved[i][c] = (double)place[c] + offset[c];
    }
    lattice_embed(&soft->lattice, (const double(*)[3])record->moved, position);
}

// --- options

struct shaking shaking_default(void)
{
    struct shaking by = {.amplitude = NAN,
                         .damping = NAN,
                         .seconds = NAN,
                         .fps = 24,
                         .accuracy = 0.02,
                         .budget = 20,
                         .soft = soft_default_options()};
    by.soft.frequency = by.soft.density = 0;
    return by;
}

void shaking_options(struct shaking *by, struct option_spec *options)
{
    struct soft_options *soft = &by->soft;
    const struct option_spec shared[] = {
        {"--drive-frequency HZ", "frequency of burst, sine or mid-sweep (1.375 times that of the body)", OPTION_REAL,
         &by->drive.frequency, 1e-3, 1e3},
        {"--seconds S", "duration in seconds (4, or 8 periods of the body)", OPTION_REAL, &by->seconds, 1e-3, 3600},
        {"--accuracy E", "allowed error, relative to the size of the motion; sets the steps (0.02)", OPTION_REAL,
         &by->accuracy, 1e-4, 1},
        {"--budget M", "end the search for those steps after M million element-steps (20)", OPTION_REAL, &by->budget,
         0, 1e6},
        {"--substeps N", "integrator steps per frame, instead of --accuracy", OPTION_INT, &by->substeps, 1, 1000},
        {"--tets N", "approximate number of tetrahedra (3000)", OPTION_INT, &soft->tets, 50, 200000},
        {"--thickness H", "make the mesh a sheet H metres thick; 0: close its openings, however large", OPTION_REAL,
         &soft->thickness, 0, 1e6},
        {"--frequency HZ", "frequency of the mode seen most; sets the stiffness (2)", OPTION_REAL, &soft->frequency,
         1e-3, 1e3},
        {"--young E", "Young's modulus in Pa, instead of --frequency", OPTION_REAL, &soft->young, 1e-6, 1e15},
        {"--softness N", "how many times softer where the map is 1 (8)", OPTION_REAL, &soft->softness.times, 1e-3,
         1e3},
        {"--poisson NU", "Poisson's ratio (0.35)", OPTION_REAL, &soft->poisson, 0, 0.49},
        {"--density RHO", "density in kg/m^3, only with --young (1000)", OPTION_REAL, &soft->density, 1e-6, 1e9},
        {"--verbose", "show progress even if standard error is not a terminal", OPTION_FLAG, &by->verbose, 0, 0},
    };
    while (options->words) options++;
    memcpy(options, shared, sizeof shared);
}

const char *shaking_check(struct shaking *by)
{
    const struct soft_options usual = soft_default_options();
    struct soft_options *soft = &by->soft;
    if (soft->young > 0 && soft->frequency > 0) return "--young and --frequency both set the stiffness: give one";
    if (soft->density > 0 && soft->young == 0)
        return "--density needs --young: with --frequency the stiffness follows the mass and the motion stays the "
               "same";
    if (soft->frequency == 0) soft->frequency = usual.frequency;
    if (soft->density == 0) soft->density = usual.density;
    return NULL;
}

void shaking_drive(struct shaking *by, enum drive_kind kind)
{
    const bool driven = kind != DRIVE_NONE;
    by->drive.kind = kind;
    by->shake.driven = driven;
    by->shake.amplitude = isfinite(by->amplitude) ? by->amplitude : driven ? 0.05 : 0.2;
    by->soft.damping = isfinite(by->damping) ? by->damping : driven ? 0.2 : 0.03;
    by->soft.softness.from = by->soft_text ? by->soft_text : driven ? "distance" : NULL;
}

double shaking_seconds(struct shaking *by, const struct soft *soft, bool *fits)
{
    const double period = 1 / soft_frequency(soft);
    if (by->drive.frequency == 0) by->drive.frequency = drive_ratio / period;
    const double end = drive_end(&by->drive), stops = isfinite(end) ? end : 0;
    const double seconds = isfinite(by->seconds)
                               ? by->seconds
                               : fmin(fmax(fmax(4, 8 * period), stops + 4 * period), ANALYSIS_FRAMES_MAX / by->fps);
    *fits = stops + fmax(period, ANALYSIS_FRAMES_MIN / by->fps) <= seconds;
    return seconds;
}

int shaking_frames(const struct shaking *by) { return (int)fmax(1, round(by->seconds * by->fps)); }
