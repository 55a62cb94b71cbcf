/// Repeats a simulation with smaller steps until it is accurate.
#include "commands/simulate_shake.h"
#include "base/error.h"
#include "base/need.h"
#include "base/progress.h"
#include "commands/progress.h"
#include "model/motion.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// The motion of the nodes, and how it was computed.
struct record {
    int frames, nodes, substeps;
    bool calmed;       ///< some steps were first order
    double cost;       ///< element-steps
    float (*place)[3]; ///< frames × nodes, relative to the base
};

static bool step_frames(const struct shake_job *job, struct integrator *integrator, struct record *record,
                        struct error *error)
{
    struct progress progress = {.started = clock_now(), .lines = job->verbose};
    for (int frame = 0; frame < record->frames; frame++) {
        for (int s = 0; frame > 0 && s < record->substeps; s++) {
            if (integrator_step(integrator)) continue;
            return fail(error, ERROR_INPUT,
                        "frame %d: the simulation became unstable: try a smaller --amplitude or more --damping",
                        frame);
        }
        for (int i = 0; i < record->nodes; i++) {
            float *place = record->place[(size_t)frame * (size_t)record->nodes + (size_t)i];
            for (int c = 0; c < 3; c++) place[c] = (float)integrator->x[i][c];
        }
        progress_show(&progress, frame + 1, record->frames);
    }
    return true;
}

/// Simulates the whole motion once.
static bool simulate(const struct shake_job *job, struct soft *soft, struct record *record, struct error *error)
{
    struct integrator integrator;
    integrator_create(&integrator, &soft->body, 1 / (job->fps * record->substeps));
    integrator.mass_damping = soft->alpha;
    integrator.stiffness_damping = soft->beta;
    integrator.tolerance = 1e-4 * soft->lattice.cell; // Newton's next iteration would change a thousandth of that
    integrator.loads = job->loads;
    bool good = true;
    if (job->loads.gravity > 0 && soft->pinned > 0 && soft->loose_parts == 0 && !integrator_settle(&integrator))
        good = fail(error, ERROR_INPUT, "%s: the body finds no rest under its weight: try a higher --frequency",
                    job->mesh);
    if (good) {
        soft_shake(soft, &job->shake, &integrator);
        good = step_frames(job, &integrator, record, error);
    }
    record->calmed = integrator.calmed > 0;
    record->cost = ((double)integrator.newton + (double)integrator.gradients / 100) * soft->body.element_count;
    integrator_free(&integrator);
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

/// Steps per frame for the first run: 48 per period of the fastest known motion.
static int first_substeps(const struct shake_job *job, const struct soft *soft)
{
    enum { STEPS_A_PERIOD = 48 };
    const struct drive *drive = job->loads.drive;
    double frequency = soft_frequency(soft);
    if (drive && drive->kind != DRIVE_TRACK)
        frequency = fmax(frequency, drive->frequency * (drive->kind == DRIVE_SWEEP ? 2 : 1));
    return (int)fmax(1, ceil(STEPS_A_PERIOD * frequency / job->fps));
}

/// Simulates until the error is small enough or the budget is used up. `fine` ends as the motion; `error_left` is −1 if unknown.
static bool refine(const struct shake_job *job, struct soft *soft, struct record *fine, struct record *coarse,
                   double *error_left, struct error *error)
{
    enum { FINEST = 512 };
    static const double LEAST = 1.5; // steps shorter by less tell too little
    double used = 0;
    *error_left = -1;
    fine->substeps = job->substeps ? job->substeps : first_substeps(job, soft);
    if (!simulate(job, soft, fine, error)) return false;
    for (double next = 2; !job->substeps && (*error_left < 0 || *error_left > job->accuracy);) {
        used += fine->cost;
        // Shorter steps need fewer iterations each, so the cost grows at most in proportion.
        if (*error_left >= 0) next = fmin(next, (job->budget - used) / fine->cost);
        int finer = (int)ceil(fine->substeps * next);
        if (*error_left >= 0 && (finer > FINEST || next < LEAST)) return true;
        struct record swap = *coarse;
        *coarse = *fine;
        *fine = swap;
        fine->substeps = finer;
        if (!simulate(job, soft, fine, error)) return false;
        *error_left = estimate_error(fine, coarse, soft->body.mass);
        next = fmax(LEAST, fmin(4, 1.1 * sqrt(*error_left / job->accuracy)));
        if (job->verbose) fprintf(stderr, "%d steps a frame: error %.2g %%\n", fine->substeps, 100 * *error_left);
    }
    return true;
}

/// Moves the surface with the nodes in `x`.
static void embed_frame(const struct shake_job *job, const struct soft *soft, const struct record *record, int frame,
                        double (*x)[3], float (*position)[3])
{
    const struct drive *drive = job->world ? job->loads.drive : NULL;
    double base = drive ? drive_place(drive, frame / job->fps) : 0;
    for (int i = 0; i < record->nodes; i++) {
        const float *place = record->place[(size_t)frame * (size_t)record->nodes + (size_t)i];
        for (int c = 0; c < 3; c++) x[i][c] = (double)place[c] + (drive ? base * drive->direction[c] : 0);
    }
    lattice_embed(&soft->lattice, (const double(*)[3])x, position);
}

static bool write_frames(const struct shake_job *job, const struct soft *soft, const struct surface *surface,
                         const struct record *record, struct file_output *output, struct error *error)
{
    const size_t vertices = (size_t)soft->lattice.vertex_count;
    float(*position)[3] = need_zeroed(vertices + 1, sizeof *position);
    double(*x)[3] = need_zeroed((size_t)record->nodes + 1, sizeof *x);
    memcpy(position, surface->position,
           (size_t)surface->vertex_count *
               sizeof *position); // vertices outside the lattice keep their rest positions
    for (int frame = 0; frame < record->frames && !ferror(output->stream); frame++) {
        embed_frame(job, soft, record, frame, x, position);
        fwrite(position, sizeof *position, vertices, output->stream);
        stage_tell("writing the motion", frame + 1, record->frames);
    }
    free(position);
    free(x);
    return file_output_commit(output, error);
}

static void report(const struct shake_job *job, const struct soft *soft, const struct record *record, double left,
                   double started)
{
    print_line(stdout, "%s: %d frames of %d vertices at %g fps, in %.1f s", job->output, record->frames,
               soft->lattice.vertex_count, job->fps, clock_now() - started);
    if (left < 0) {
        printf("  %d steps a frame; the error was not measured\n", record->substeps);
    } else {
        printf("  %d steps a frame; error of the motion %.2g %%\n", record->substeps, 100 * left);
    }
    if (job->loads.drive && drive_end(job->loads.drive) < job->seconds)
        printf("  the drive stops at %.4g s; then the body swings freely\n", drive_end(job->loads.drive));
    if (left > job->accuracy) {
        fflush(stdout);
        print_line(
            stderr,
            "%s: warning: expected an error of the motion of at most %.3g %%, got %.2g %% when the search ended: "
            "--substeps %d or a larger --budget may come nearer, unless the motion is chaotic",
            job->output, 100 * job->accuracy, 100 * left, (int)fmin(2 * record->substeps, 1000));
    }
}

int shake_frames(const struct shake_job *job) { return (int)fmax(1, round(job->seconds * job->fps)); }

bool simulate_shake(const struct shake_job *job, struct soft *soft, const struct surface *surface,
                    struct error *error)
{
    const int frames = shake_frames(job), nodes = soft->body.node_count;
    struct record fine = {.frames = frames, .nodes = nodes}, coarse = fine;
    struct file_output output;
    const double started = clock_now();
    double left;
    if (!need_has_room(2 * (size_t)frames * (size_t)nodes * sizeof *fine.place))
        return fail_no_memory(error, job->mesh);
    if (!motion_start(&output, job->output, frames, soft->lattice.vertex_count, error)) return false;
    fine.place = need_zeroed((size_t)frames * (size_t)nodes, sizeof *fine.place);
    coarse.place = need_zeroed((size_t)frames * (size_t)nodes, sizeof *coarse.place);
    bool good = refine(job, soft, &fine, &coarse, &left, error);
    if (good) {
        good = write_frames(job, soft, surface, &fine, &output, error);
        if (good) report(job, soft, &fine, left, started);
    } else {
        file_output_discard(&output);
    }
    free(fine.place);
    free(coarse.place);
    return good;
}
