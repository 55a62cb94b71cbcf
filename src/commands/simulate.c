/// `wiggly simulate`: shakes a mesh as a soft body, or finds its normal modes.
#include "analysis/analysis.h"
#include "base/error.h"
#include "base/file.h"
#include "base/need.h"
#include "base/progress.h"
#include "commands/commands.h"
#include "commands/companion.h"
#include "commands/report.h"
#include "model/motion.h"
#include "model/surface.h"
#include "simulation/soft.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double slow_warning = 1 / 8.0; ///< of the frequency asked for: a lowest mode below it causes a warning
static const double drive_ratio = 1.375;    ///< of drive and body by default: parts follow one after another

struct job {
    const char *mesh, *output;
    struct mesh_options opening;
    char rest[COMPANION_PATH]; ///< path of the rest mesh beside the output
    const char *shake_text, *drive_text, *pin_text, *soft_text;
    double amplitude, damping; ///< NAN: by default
    double seconds;            ///< NAN until make_body() chooses it
    double fps;
    double accuracy; ///< allowed relative RMS error
    double budget;   ///< millions of element-steps
    int substeps;    ///< per frame; 0: by accuracy
    struct shake shake;
    struct loads loads;
    struct base_drive drive;
    struct soft_options soft;
    double floor; ///< height above the lowest point; below 0: none
    bool world;   ///< positions in the world, not relative to the base
    bool modal, verbose;
};

// --- a shake, simulated to a requested accuracy
//
// The motion is simulated twice, the second time with steps r times shorter. For a scheme of
// second order the finer error is 1/(r² − 1) of the difference; if backward Euler calmed some steps, which is first order, 1/(r − 1).
// While that is too large, steps get shorter. Chaotic or undamped motions may never get accurate, so the search has a budget of element-
// steps: Newton iterations (or a hundred of conjugate gradients) times elements, which is the same on every machine. The first two
// simulations always run.

/// How many frames are written.
static int shake_frames(const struct job *job) { return (int)fmax(1, round(job->seconds * job->fps)); }

/// The motion of the nodes, and how it was computed.
struct record {
    int frames, nodes, substeps;
    bool calmed;       ///< some steps were first order
    double cost;       ///< element-steps
    float (*place)[3]; ///< frames × nodes, relative to the base
};

/// Simulates the whole motion once.
static bool simulate_once(const struct job *job, struct soft *soft, struct record *record, struct error *error)
{
    struct integrator integrator;
    integrator_create(&integrator, &soft->body, 1 / (job->fps * record->substeps));
    integrator.mass_damping = soft->alpha;
    integrator.stiffness_damping = soft->beta;
    integrator.tolerance = 1e-4 * soft->lattice.cell; // Newton's next iteration would change a thousandth of that
    integrator.loads = job->loads;
    bool good = true;
    if (job->loads.gravity > 0 && soft->pinned > 0 && soft->unpinned_parts == 0 &&
        !integrator_find_equilibrium(&integrator))
        good = fail(error, ERROR_INPUT, "%s: the body finds no rest under its weight: try a higher --frequency",
                    job->mesh);
    if (good) soft_shake(soft, &job->shake, &integrator);
    struct progress progress = {.started = clock_now(), .lines = job->verbose};
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

/// Simulates until the error is small enough or the budget is used up. `fine` ends as the motion; `error_left` is −1 if unknown.
static bool simulate_to_accuracy(const struct job *job, struct soft *soft, struct record *fine, struct record *coarse,
                                 double *error_left, struct error *error)
{
    enum { FINEST = 512, STEPS_A_PERIOD = 48 };
    static const double LEAST = 1.5; // steps shorter by less tell too little
    double used = 0;
    *error_left = -1;
    const struct base_drive *drive = job->loads.drive;
    double fastest = soft_frequency(soft); // of what is known
    if (drive && drive->kind != DRIVE_TRACK)
        fastest = fmax(fastest, drive->frequency * (drive->kind == DRIVE_SWEEP ? 2 : 1));
    fine->substeps = job->substeps ? job->substeps : (int)fmax(1, ceil(STEPS_A_PERIOD * fastest / job->fps));
    if (!simulate_once(job, soft, fine, error)) return false;
    for (double next = 2; !job->substeps && (*error_left < 0 || *error_left > job->accuracy);) {
        used += fine->cost;
        // Shorter steps need fewer iterations each, so the cost grows at most in proportion.
        if (*error_left >= 0) next = fmin(next, (1e6 * job->budget - used) / fine->cost);
        int finer = (int)ceil(fine->substeps * next);
        if (*error_left >= 0 && (finer > FINEST || next < LEAST)) return true;
        struct record swap = *coarse;
        *coarse = *fine;
        *fine = swap;
        fine->substeps = finer;
        if (!simulate_once(job, soft, fine, error)) return false;
        *error_left = estimate_error(fine, coarse, soft->body.mass);
        next = fmax(LEAST, fmin(4, 1.1 * sqrt(*error_left / job->accuracy)));
        if (job->verbose) fprintf(stderr, "%d steps a frame: error %.2g %%\n", fine->substeps, 100 * *error_left);
    }
    return true;
}

/// Simulates, writes the motion and prints the cost. Of `soft` it changes only the body's scratch memory.
static bool simulate_shake(const struct job *job, struct soft *soft, const struct surface *surface,
                           struct error *error)
{
    const int frames = shake_frames(job), nodes = soft->body.node_count, vertices = soft->lattice.vertex_count;
    const struct base_drive *drive = job->loads.drive;
    struct record fine = {.frames = frames, .nodes = nodes}, coarse = fine;
    struct file_output output;
    const double started = clock_now();
    double left;
    if (!need_has_room(2 * (size_t)frames * (size_t)nodes * sizeof *fine.place))
        return fail_no_memory(error, job->mesh);
    if (!motion_start(&output, job->output, frames, vertices, error)) return false;
    fine.place = need_zeroed((size_t)frames * (size_t)nodes, sizeof *fine.place);
    coarse.place = need_zeroed((size_t)frames * (size_t)nodes, sizeof *coarse.place);
    bool good = simulate_to_accuracy(job, soft, &fine, &coarse, &left, error);
    if (good) {
        float(*position)[3] = need_zeroed((size_t)vertices + 1, sizeof *position);
        double(*x)[3] = need_zeroed((size_t)nodes + 1, sizeof *x);
        // Vertices outside the lattice keep their rest positions.
        memcpy(position, surface->position, (size_t)surface->vertex_count * sizeof *position);
        for (int frame = 0; frame < frames && !ferror(output.stream); frame++) {
            const double base = job->world && drive ? drive_place(drive, frame / job->fps) : 0;
            for (int i = 0; i < nodes; i++) {
                const float *place = fine.place[(size_t)frame * (size_t)nodes + (size_t)i];
                for (int c = 0; c < 3; c++)
                    x[i][c] = (double)place[c] + (job->world && drive ? base * drive->direction[c] : 0);
            }
            lattice_embed(&soft->lattice, (const double(*)[3])x, position);
            fwrite(position, sizeof *position, (size_t)vertices, output.stream);
            progress_report("writing the motion", frame + 1, frames);
        }
        free(position);
        free(x);
        good = file_output_commit(&output, error);
    } else {
        file_output_discard(&output);
    }
    free(fine.place);
    free(coarse.place);
    if (!good) return false;

    print_line(stdout, "%s: %d frames of %d vertices at %g fps, in %.1f s", job->output, frames, vertices, job->fps,
               clock_now() - started);
    if (left < 0) {
        printf("  %d steps a frame; the error was not measured\n", fine.substeps);
    } else {
        printf("  %d steps a frame; error of the motion %.2g %%\n", fine.substeps, 100 * left);
    }
    if (drive && drive_end(drive) < job->seconds)
        printf("  the drive stops at %.4g s; then the body swings freely\n", drive_end(drive));
    if (left > job->accuracy) {
        fflush(stdout);
        print_line(
            stderr,
            "%s: warning: expected an error of the motion of at most %.3g %%, got %.2g %% when the search ended: "
            "--substeps %d or a larger --budget may come nearer, unless the motion is chaotic",
            job->output, 100 * job->accuracy, 100 * left, (int)fmin(2 * fine.substeps, 1000));
    }
    return true;
}

// --- the command

/// Drives the base, or lets the body swing freely; each has defaults of its own.
static void set_swing(struct job *job, enum drive_kind kind)
{
    const bool driven = kind != DRIVE_NONE;
    job->drive.kind = kind;
    job->shake.driven = driven;
    job->shake.amplitude = isfinite(job->amplitude) ? job->amplitude : driven ? 0.05 : 0.2;
    job->soft.damping = isfinite(job->damping) ? job->damping : driven ? 0.2 : 0.03;
    job->soft.softness.from = job->soft_text ? job->soft_text : driven ? "distance" : NULL;
}

/// Makes the body, tuned to what moves it. Where time is too short, the burst that nobody asked for gives way to a free swing.
static bool make_body(struct job *job, struct soft *soft, const struct surface *surface, struct error *error)
{
    if (!soft_create(soft, surface, job->mesh, &job->soft, error)) return false;

    // By default 4 s or more, 8 periods, and 4 after the drive, but no longer than analyze takes. A burst ends in time for analyze a
    // period before the end.
    struct base_drive *drive = &job->drive;
    const double period = 1 / soft_frequency(soft);
    if (drive->frequency == 0) drive->frequency = drive_ratio / period;
    const double end = drive_end(drive), stops = isfinite(end) ? end : 0;
    const double seconds = isfinite(job->seconds)
                               ? job->seconds
                               : fmin(fmax(fmax(4, 8 * period), stops + 4 * period), ANALYSIS_FRAMES_MAX / job->fps);
    const bool fits = stops + fmax(period, ANALYSIS_FRAMES_MIN / job->fps) <= seconds;
    if (!fits && drive->kind != DRIVE_NONE && !job->drive_text) {
        print_line(stdout,
                   "%s: swings freely, because a burst of %.4g s and a period of %.4g s do not fit into %.4g s",
                   job->mesh, end, period, seconds);
        soft_free(soft);
        set_swing(job, DRIVE_NONE);
        return make_body(job, soft, surface, error);
    }
    if (!fits && drive->kind != DRIVE_NONE && isfinite(end) && period <= seconds)
        print_line(
            stderr,
            "%s: warning: a drive of %.4g s and a period of %.4g s do not fit into %.4g s, so analyze may take "
            "the drive for the body's swing; choose a longer time",
            job->mesh, end, period, seconds);
    job->seconds = seconds;
    return true;
}

/// Writes each mode's displacement, scaled to a maximum of 1.
static bool write_modes(const struct job *job, const struct soft *soft, struct error *error)
{
    const int vertices = soft->lattice.vertex_count, nodes = soft->body.node_count;
    struct file_output output;
    float(*shape)[3] = need_zeroed((size_t)vertices + 1, sizeof *shape);
    bool good = motion_start(&output, job->output, soft->modes.count, vertices, error);
    for (int k = 0; good && k < soft->modes.count; k++) {
        lattice_embed(&soft->lattice, (const double(*)[3])(soft->modes.shape + (size_t)k * (size_t)nodes), shape);
        float largest = 0;
        for (int i = 0; i < vertices; i++) {
            const float *d = shape[i];
            largest = fmaxf(largest, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        }
        float scale = largest > 0 ? 1 / sqrtf(largest) : 1;
        for (int i = 0; i < vertices; i++) {
            for (int c = 0; c < 3; c++) shape[i][c] *= scale;
        }
        fwrite(shape, sizeof *shape, (size_t)vertices, output.stream);
    }
    good = good && file_output_commit(&output, error);
    free(shape);
    if (!good) return false;
    printf("%4s %12s\n", "mode", "Hz");
    for (int k = 0; k < soft->modes.count; k++) printf("%4d %12.6g\n", k + 1, soft->modes.frequency[k]);
    print_line(stdout, "%s: %d modes of %d vertices", job->output, soft->modes.count, vertices);
    return true;
}

static bool simulate_mesh(struct job *job, struct error *error)
{
    struct surface surface = {0};
    struct soft soft;
    progress_end_when_interrupted();
    progress_show_stages(job->verbose);
    if (job->drive.kind == DRIVE_TRACK && !drive_read_track(&job->drive, job->drive_text, error)) return false;
    bool good = file_check_unread(job->rest, error) && open_mesh(job->mesh, &job->opening, &surface, error) &&
                make_body(job, &soft, &surface, error);
    if (good) {
        print_line(stdout,
                   "%s: %d tetrahedra, %d nodes, %d of them pinned; Young's modulus %.4g Pa, lowest mode %.4g Hz",
                   job->mesh, soft.lattice.tet_count, soft.body.node_count, soft.pinned, soft.young,
                   soft.modes.count ? soft.modes.frequency[0] : 0);
        if (!job->modal) {
            printf("  seen most: mode %d, %.4g Hz, with %.0f %% of the motion\n", soft.seen + 1,
                   soft_frequency(&soft), 100 * soft.share);
            if (!job->drive_text && (job->shake.impulse || soft.pinned == 0))
                printf("  swings freely, because of %s\n", job->shake.impulse ? "--impulse" : "--pin none");
        }
        if (soft.lattice.repair[0]) print_line(stdout, "%s: %s", job->mesh, soft.lattice.repair);
        fflush(stdout);
        const double lowest = soft.modes.count ? soft.modes.frequency[0] : 0, period = 1 / soft_frequency(&soft);
        if (!job->modal && period > job->seconds) {
            print_line(
                stderr,
                "%s: warning: %.4g s show less than a period, %.4g s, so analyze cannot find the frequency; choose a "
                "longer time, of at most %d frames, or a stiffer body",
                job->mesh, job->seconds, period, ANALYSIS_FRAMES_MAX);
        }
        if (!job->modal && lowest < slow_warning * soft_frequency(&soft)) {
            print_line(stderr,
                       "%s: warning: the lowest mode, of %.2g Hz, is far below the %.2g Hz of the one that is seen "
                       "most; if it sways slowly, --pin more of it",
                       job->mesh, lowest, soft_frequency(&soft));
        }
        if (soft.unpinned_parts > 0 && soft.pinned > 0) {
            print_line(stderr, "%s: warning: %d of %d separate parts are not pinned and will drift", job->mesh,
                       soft.unpinned_parts, soft.lattice.part_count);
        }

        if (job->modal) {
            good = write_modes(job, &soft, error);
        } else {
            struct base_drive *drive = &job->drive;
            struct floor floor = {0};
            if (drive->kind != DRIVE_NONE) { // it moves the base along the shake
                memcpy(drive->direction, job->shake.direction, sizeof drive->direction);
                drive->size = drive->kind == DRIVE_TRACK ? 1 : job->shake.amplitude * soft.size;
                drive->seconds = job->seconds;
                job->loads.drive = drive;
            }
            if (job->floor >= 0) {
                floor_create(&floor, &soft.lattice, &surface, soft.bottom + job->floor, soft.young,
                             job->soft.density);
                job->loads.floor = &floor;
            }
            good = simulate_shake(job, &soft, &surface, error);
            pool_free(&floor.pool);

            // What analyze needs to know of the motion.
            struct companion made = {.frames = shake_frames(job), .vertices = surface.vertex_count, .fps = job->fps};
            const double end = job->loads.drive ? drive_end(drive) : 0;
            made.from = end < job->seconds ? end : 0;
            made.world = job->world;
            memcpy(made.shake, job->shake.direction, sizeof made.shake);
            if (job->pin_text)
                snprintf(made.pin, sizeof made.pin, "%s", job->pin_text);
            else
                snprintf(made.pin, sizeof made.pin, "%.6g", 0.05 * soft.height);
            good = good && companion_write(job->output, &made, error);
        }
        good = good && obj_write(job->rest, &surface, error);
        if (good) print_line(stdout, "%s: the mesh at rest", job->rest);
        soft_free(&soft);
    }
    surface_free(&surface);
    pool_free(&job->drive.pool);
    return good;
}

/// Checks what the option table cannot; NULL or an error text.
static const char *check_job(struct job *job)
{
    if (!job->output) return "-o FILE is missing: name the file to write";
    if (job->modal && !path_has_end(job->output, ".npy"))
        return "--output: expected a name ending in .npy for --modal";
    if (!path_has_end(job->output, ".npy") && !path_has_end(job->output, ".pc2"))
        return "--output: expected a name ending in .npy or .pc2";
    if (!companion_path(job->output, ".rest.obj", job->rest)) return "--output: the name is too long";
    if (!options_direction(job->shake_text, job->shake.direction))
        return "--shake: expected up, side, front or a vector x,y,z";
    if (job->pin_text && !region_parse(job->pin_text, &job->soft.pin)) return "--pin: expected " REGION_FORMS;
    if (job->pin_text && strlen(job->pin_text) >= COMPANION_PIN) return "--pin: expected fewer than 128 characters";
    set_swing(job, DRIVE_NONE);
    if (!job->modal) {                                                         // an unknown name of a drive is a file
        static const char *const kinds[] = {"none", "sine", "burst", "sweep"}; // as in enum drive_kind
        const bool impulse = job->shake.impulse, unpinned = job->soft.pin.kind == REGION_NONE;
        const bool adjusted = job->drive.frequency > 0 || job->world;
        enum drive_kind kind = DRIVE_NONE;
        if (!job->drive_text && adjusted) job->drive_text = "burst";
        const char *text = job->drive_text ? job->drive_text : impulse || unpinned ? "none" : "burst";
        while (kind < DRIVE_TRACK && strcmp(text, kinds[kind]) != 0) kind++;
        set_swing(job, kind);
        if (kind == DRIVE_NONE && adjusted) return "--drive-frequency and --world need a drive, got none";
        if (kind != DRIVE_NONE && impulse) return "--impulse and a drive both start the motion: give one";
        if (kind != DRIVE_NONE && unpinned) return "--drive moves the pinned part, but --pin none pins nothing";
        if (kind == DRIVE_TRACK && !path_has_end(text, ".csv"))
            return "--drive: expected burst, sine, sweep, a track's FILE.csv or none";
        if (kind == DRIVE_TRACK && (isfinite(job->amplitude) || job->drive.frequency > 0))
            return "--drive: a track has its own size in metres and time: leave out --amplitude and "
                   "--drive-frequency";
    }

    // Stiffness and mass; 0: not given.
    const struct soft_options usual = soft_default_options();
    struct soft_options *soft = &job->soft;
    if (soft->young > 0 && soft->frequency > 0) return "--young and --frequency both set the stiffness: give one";
    if (soft->density > 0 && soft->young == 0)
        return "--density needs --young: with --frequency the stiffness follows the mass and the motion stays the "
               "same";
    if (soft->frequency == 0) soft->frequency = usual.frequency;
    if (soft->density == 0) soft->density = usual.density;
    return NULL;
}

/// Modes among which the one that is seen most is found.
enum { MODES_SEARCHED = 24 };

static const struct job start = {.opening = {.scale = 1},
                                 .amplitude = NAN,
                                 .damping = NAN,
                                 .seconds = NAN,
                                 .fps = 24,
                                 .accuracy = 0.02,
                                 .budget = 20,
                                 .shake_text = "up",
                                 .floor = -1};

int command_simulate(int argc, char **argv)
{
    struct job job = start;
    int modes = 0;
    job.soft = soft_default_options();
    job.soft.frequency = job.soft.density = 0;
    const struct option_spec options[] = {
        {"-o, --output FILE",
         "required: NAME.npy or NAME.pc2 (--modal: .npy); beside it NAME.rest.obj, NAME.simulation.json",
         OPTION_OUTPUT, &job.output, 0, 0},
        MESH_OPTIONS(&job.opening),
        {"--shake DIR", "up, side, front or a vector x,y,z (up)", OPTION_TEXT, &job.shake_text, 0, 0},
        {"--amplitude A",
         "how far the base moves, relative to the height (0.05); swinging freely, how far the top moves (0.2)",
         OPTION_REAL, &job.amplitude, -2, 2},
        {"--impulse", "swing freely from a push, not deformed", OPTION_FLAG, &job.shake.impulse, 0, 0},
        {"--drive WHAT",
         "what shakes the pinned base: burst (default), sine, sweep, a track of seconds,metres in FILE.csv, or "
         "none: swing freely",
         OPTION_TEXT, &job.drive_text, 0, 0},
        {"--drive-frequency HZ", "frequency of burst, sine or mid-sweep (1.375 times that of the body)", OPTION_REAL,
         &job.drive.frequency, 1e-3, 1e3},
        {"--world", "write the motion as seen from outside, not from the base", OPTION_FLAG, &job.world, 0, 0},
        {"--seconds S", "duration in seconds (4, or 8 periods of the body)", OPTION_REAL, &job.seconds, 1e-3, 3600},
        {"--fps N", "frames per second (24)", OPTION_REAL, &job.fps, 1, 1000},
        {"--accuracy E", "allowed error, relative to the size of the motion; sets the steps (0.02)", OPTION_REAL,
         &job.accuracy, 1e-4, 1},
        {"--budget M", "end the search for those steps after M million element-steps (20)", OPTION_REAL, &job.budget,
         0, 1e6},
        {"--substeps N", "integrator steps per frame, instead of --accuracy", OPTION_INT, &job.substeps, 1, 1000},
        {"--tets N", "approximate number of tetrahedra (3000)", OPTION_INT, &job.soft.tets, 50, 200000},
        {"--thickness H", "make the mesh a sheet H metres thick; 0: close its openings, however large", OPTION_REAL,
         &job.soft.thickness, 0, 1e6},
        {"--pin WHERE",
         "pin below a height (1/20 of the mesh), none, plane:x,y,z,nx,ny,nz, sphere:x,y,z,r, color:RRGGBB",
         OPTION_TEXT, &job.pin_text, 0, 0},
        {"--frequency HZ", "frequency of the mode seen most (--modal: the lowest); sets the stiffness (2)",
         OPTION_REAL, &job.soft.frequency, 1e-3, 1e3},
        {"--young E", "Young's modulus in Pa, instead of --frequency", OPTION_REAL, &job.soft.young, 1e-6, 1e15},
        {"--soft MAP",
         "soften by distance (from the pin, the default with a drive), color (brightness) or FILE.npy (0 to 1 "
         "per vertex)",
         OPTION_TEXT, &job.soft_text, 0, 0},
        {"--softness N", "how many times softer where the map is 1 (8)", OPTION_REAL, &job.soft.softness.times, 1e-3,
         1e3},
        {"--poisson NU", "Poisson's ratio (0.35)", OPTION_REAL, &job.soft.poisson, 0, 0.49},
        {"--density RHO", "density in kg/m^3, only with --young (1000)", OPTION_REAL, &job.soft.density, 1e-6, 1e9},
        {"--damping Z", "damping ratio of that mode (0.2; swinging freely 0.03)", OPTION_REAL, &job.damping, 0, 1},
        {"--gravity G", "gravity in m/s^2 (0); a pinned body starts at rest under it", OPTION_REAL,
         &job.loads.gravity, 0, 1e4},
        {"--floor H", "a smooth floor at H above the lowest point", OPTION_REAL, &job.floor, 0, 1e6},
        {"--modal K", "write the K lowest normal modes instead of a shake", OPTION_INT, &modes, 1, 200},
        {"--verbose", "show progress even if standard error is not a terminal", OPTION_FLAG, &job.verbose, 0, 0},
        {0},
    };
    const struct usage usage = {
        .command = "simulate",
        .operands = "MESH",
        .summary = "Shakes a mesh (OBJ, STL, PLY, OFF, glTF) as a soft body (finite elements) and writes its "
                   "vertices in every frame.",
        .options = options,
    };
    const int result = options_parse(&usage, argc, argv, &job.mesh);
    if (result != OPTIONS_RUN) return result;
    job.modal = modes > 0;
    job.soft.modes = job.modal ? modes : MODES_SEARCHED;
    if (!job.modal) job.soft.shake = &job.shake;
    const char *wrong = check_job(&job);
    if (wrong) return options_wrong(&usage, "%s", wrong);
    struct error error;
    return options_end(simulate_mesh(&job, &error), &error);
}
