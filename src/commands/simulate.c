/// `wiggly simulate`: shakes a mesh as a soft body, or finds its normal modes.
#include "analysis/analysis.h"
#include "base/error.h"
#include "base/file.h"
#include "base/need.h"
#include "commands/commands.h"
#include "commands/companion.h"
#include "commands/open_mesh.h"
#include "commands/options.h"
#include "commands/progress.h"
#include "commands/simulate_shake.h"
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
    double amplitude, damping, seconds; ///< NAN: by default
    double budget;                      ///< millions of element-steps
    struct shake_job shake;
    struct drive drive;
    struct soft_options soft;
    double floor; ///< height above the lowest point; below 0: none
    bool modal;
};

/// Drives the base, or lets the body swing freely; each has defaults of its own.
static void set_swing(struct job *job, enum drive_kind kind)
{
    struct shake *shake = &job->shake.shake;
    job->drive.kind = kind;
    shake->driven = kind != DRIVE_NONE;
    shake->amplitude = isfinite(job->amplitude) ? job->amplitude : shake->driven ? 0.05 : 0.2;
    job->soft.damping = isfinite(job->damping) ? job->damping : shake->driven ? 0.2 : 0.03;
    job->soft.softness.from = job->soft_text ? job->soft_text : shake->driven ? "distance" : NULL;
}

/// Sets how fast the drive is and how long the motion: by default 4 s or more, 8 periods, and 4 after the drive, but no longer than
/// analyze takes. Returns whether a burst ends in time for analyze: a period before the end.
static bool set_times(struct job *job, const struct soft *soft)
{
    struct drive *drive = &job->drive;
    struct shake_job *shake = &job->shake;
    const double period = 1 / soft_frequency(soft);
    if (drive->frequency == 0) drive->frequency = drive_ratio / period;
    const double end = isfinite(drive_end(drive)) ? drive_end(drive) : 0;
    shake->seconds = isfinite(job->seconds)
                         ? job->seconds
                         : fmin(fmax(fmax(4, 8 * period), end + 4 * period), ANALYSIS_FRAMES_MAX / shake->fps);
    return end + fmax(period, ANALYSIS_FRAMES_MIN / shake->fps) <= shake->seconds;
}

/// Makes the body, tuned to what moves it. Where time is too short, the burst that nobody asked for gives way to a free swing.
static bool make_body(struct job *job, struct soft *soft, const struct surface *surface, struct error *error)
{
    if (!soft_create(soft, surface, job->mesh, &job->soft, error)) return false;
    const bool fits = set_times(job, soft);
    const double end = drive_end(&job->drive), period = 1 / soft_frequency(soft);
    if (fits || job->drive.kind == DRIVE_NONE) return true;
    if (job->drive_text) {
        if (isfinite(end) && period <= job->shake.seconds)
            print_line(stderr,
                       "%s: warning: a drive of %.4g s and a period of %.4g s do not fit into %.4g s, so analyze may "
                       "take the drive for the body's swing; choose a longer time",
                       job->mesh, end, period, job->shake.seconds);
        return true;
    }
    print_line(stdout, "%s: swings freely, because a burst of %.4g s and a period of %.4g s do not fit into %.4g s",
               job->mesh, end, period, job->shake.seconds);
    soft_free(soft);
    set_swing(job, DRIVE_NONE);
    return make_body(job, soft, surface, error);
}

/// Moves the base along the shake.
static void start_drive(struct job *job, const struct soft *soft)
{
    struct drive *drive = &job->drive;
    if (drive->kind == DRIVE_NONE) return;
    memcpy(drive->direction, job->shake.shake.direction, sizeof drive->direction);
    drive->size = drive->kind == DRIVE_TRACK ? 1 : job->shake.shake.amplitude * soft->size;
    drive->seconds = job->shake.seconds;
    job->shake.loads.drive = drive;
}

/// What analyze needs to know of the motion.
static bool write_companion(const struct job *job, const struct soft *soft, const struct surface *surface,
                            struct error *error)
{
    const struct shake_job *shake = &job->shake;
    struct companion made = {.frames = shake_frames(shake), .vertices = surface->vertex_count, .fps = shake->fps};
    const double end = shake->loads.drive ? drive_end(shake->loads.drive) : 0;
    made.from = end < shake->seconds ? end : 0;
    made.world = shake->world;
    memcpy(made.shake, shake->shake.direction, sizeof made.shake);
    if (job->pin_text)
        snprintf(made.pin, sizeof made.pin, "%s", job->pin_text);
    else
        snprintf(made.pin, sizeof made.pin, "%.6g", 0.05 * soft->height);
    return companion_write(job->output, &made, error);
}

static bool shake(struct job *job, struct soft *soft, const struct surface *surface, struct error *error)
{
    struct floor floor = {0};
    start_drive(job, soft);
    if (job->floor >= 0) {
        floor_create(&floor, &soft->lattice, surface, soft->bottom + job->floor, soft->young, job->soft.density);
        job->shake.loads.floor = &floor;
    }
    const bool good = simulate_shake(&job->shake, soft, surface, error) && write_companion(job, soft, surface, error);
    floor_free(&floor);
    return good;
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

static void report_body(const struct job *job, const struct soft *soft)
{
    print_line(stdout, "%s: %d tetrahedra, %d nodes, %d of them pinned; Young's modulus %.4g Pa, lowest mode %.4g Hz",
               job->mesh, soft->lattice.tet_count, soft->body.node_count, soft->pinned, soft->young,
               soft->modes.count ? soft->modes.frequency[0] : 0);
    if (!job->modal) {
        printf("  seen most: mode %d, %.4g Hz, with %.0f %% of the motion\n", soft->seen + 1, soft_frequency(soft),
               100 * soft->share);
        if (!job->drive_text && (job->shake.shake.impulse || soft->pinned == 0))
            printf("  swings freely, because of %s\n", job->shake.shake.impulse ? "--impulse" : "--pin none");
    }
    if (soft->lattice.repair[0]) print_line(stdout, "%s: %s", job->mesh, soft->lattice.repair);
    fflush(stdout);
    const double lowest = soft->modes.count ? soft->modes.frequency[0] : 0, period = 1 / soft_frequency(soft);
    if (!job->modal && period > job->shake.seconds) {
        print_line(
            stderr,
            "%s: warning: %.4g s show less than a period, %.4g s, so analyze cannot find the frequency; choose a "
            "longer time, of at most %d frames, or a stiffer body",
            job->mesh, job->shake.seconds, period, ANALYSIS_FRAMES_MAX);
    }
    if (!job->modal && lowest < slow_warning * soft_frequency(soft)) {
        print_line(
            stderr,
            "%s: warning: the lowest mode, of %.2g Hz, is far below the %.2g Hz of the one that is seen most; if it "
            "sways slowly, --pin more of it",
            job->mesh, lowest, soft_frequency(soft));
    }
    if (soft->loose_parts > 0 && soft->pinned > 0) {
        print_line(stderr, "%s: warning: %d of %d separate parts are not pinned and will drift", job->mesh,
                   soft->loose_parts, soft->lattice.part_count);
    }
}

static bool run(struct job *job, struct error *error)
{
    struct surface surface = {0};
    struct soft soft;
    progress_end_when_interrupted();
    progress_show_stages(job->shake.verbose);
    if (job->drive.kind == DRIVE_TRACK && !drive_read_track(&job->drive, job->drive_text, error)) return false;
    bool good = file_check_unread(job->rest, error) && open_mesh(job->mesh, &job->opening, &surface, error) &&
                make_body(job, &soft, &surface, error);
    if (good) {
        report_body(job, &soft);
        good = job->modal ? write_modes(job, &soft, error) : shake(job, &soft, &surface, error);
        good = good && obj_write(job->rest, &surface, error);
        if (good) print_line(stdout, "%s: the mesh at rest", job->rest);
        soft_free(&soft);
    }
    surface_free(&surface);
    drive_free(&job->drive);
    return good;
}

/// Sets stiffness and mass; 0: not given. NULL or an error text.
static const char *set_material(struct soft_options *soft)
{
    const struct soft_options usual = soft_default_options();
    if (soft->young > 0 && soft->frequency > 0) return "--young and --frequency both set the stiffness: give one";
    if (soft->density > 0 && soft->young == 0)
        return "--density needs --young: with --frequency the stiffness follows the mass and the motion stays the "
               "same";
    if (soft->frequency == 0) soft->frequency = usual.frequency;
    if (soft->density == 0) soft->density = usual.density;
    return NULL;
}

/// Parses --drive; an unknown name is a file. NULL or an error text.
static const char *set_drive(struct job *job)
{
    static const char *const kinds[] = {"none", "sine", "burst", "sweep"}; // as in enum drive_kind
    const bool impulse = job->shake.shake.impulse, loose = job->soft.pin.kind == REGION_NONE;
    const bool adjusted = job->drive.frequency > 0 || job->shake.world;
    enum drive_kind kind = DRIVE_NONE;
    if (!job->drive_text && adjusted) job->drive_text = "burst";
    const char *text = job->drive_text ? job->drive_text : impulse || loose ? "none" : "burst";
    while (kind < DRIVE_TRACK && strcmp(text, kinds[kind]) != 0) kind++;
    set_swing(job, kind);
    if (kind == DRIVE_NONE) return adjusted ? "--drive-frequency and --world need a drive, got none" : NULL;
    if (impulse) return "--impulse and a drive both start the motion: give one";
    if (loose) return "--drive moves the pinned part, but --pin none pins nothing";
    if (kind != DRIVE_TRACK) return NULL;
    if (!path_has_end(text, ".csv")) return "--drive: expected burst, sine, sweep, a track's FILE.csv or none";
    if (isfinite(job->amplitude) || job->drive.frequency > 0)
        return "--drive: a track has its own size in metres and time: leave out --amplitude and --drive-frequency";
    return NULL;
}

/// Checks what the option table cannot; NULL or an error text.
static const char *check(struct job *job)
{
    if (!job->output) return "-o FILE is missing: name the file to write";
    if (job->modal && !path_has_end(job->output, ".npy"))
        return "--output: expected a name ending in .npy for --modal";
    if (!path_has_end(job->output, ".npy") && !path_has_end(job->output, ".pc2"))
        return "--output: expected a name ending in .npy or .pc2";
    if (!companion_path(job->output, ".rest.obj", job->rest)) return "--output: the name is too long";
    if (!options_direction(job->shake_text, job->shake.shake.direction))
        return "--shake: expected up, side, front or a vector x,y,z";
    if (job->pin_text && !region_parse(job->pin_text, &job->soft.pin)) return "--pin: expected " REGION_FORMS;
    if (job->pin_text && strlen(job->pin_text) >= COMPANION_PIN) return "--pin: expected fewer than 128 characters";
    job->shake.mesh = job->mesh;
    job->shake.output = job->output;
    job->shake.budget = 1e6 * job->budget;
    set_swing(job, DRIVE_NONE);
    const char *wrong = job->modal ? NULL : set_drive(job);
    return wrong ? wrong : set_material(&job->soft);
}

/// Modes among which the one that is seen most is found.
enum { MODES_SEARCHED = 24 };

static const struct job start = {.opening = {.scale = 1},
                                 .amplitude = NAN,
                                 .damping = NAN,
                                 .seconds = NAN,
                                 .shake = {.fps = 24, .accuracy = 0.02},
                                 .budget = 20,
                                 .shake_text = "up",
                                 .floor = -1};

int command_simulate(int argc, char **argv)
{
    struct job job = start;
    struct shake_job *shake = &job.shake;
    int modes = 0;
    job.soft = soft_default_options();
    job.soft.frequency = job.soft.density = 0;
    const struct option_spec options[] = {
        {"--output", "-o", "FILE",
         "required: NAME.npy or NAME.pc2 (--modal: .npy); beside it NAME.rest.obj, NAME.simulation.json",
         OPTION_OUTPUT, &job.output, 0, 0},
        MESH_OPTIONS(&job.opening),
        {"--shake", NULL, "DIR", "up, side, front or a vector x,y,z (up)", OPTION_TEXT, &job.shake_text, 0, 0},
        {"--amplitude", NULL, "A",
         "how far the base moves, relative to the height (0.05); swinging freely, how far the top moves (0.2)",
         OPTION_REAL, &job.amplitude, -2, 2},
        {"--impulse", NULL, NULL, "swing freely from a push, not deformed", OPTION_FLAG, &shake->shake.impulse, 0, 0},
        {"--drive", NULL, "WHAT",
         "what shakes the pinned base: burst (default), sine, sweep, a track of seconds,metres in FILE.csv, or none: "
         "swing freely",
         OPTION_TEXT, &job.drive_text, 0, 0},
        {"--drive-frequency", NULL, "HZ", "frequency of burst, sine or mid-sweep (1.375 times that of the body)",
         OPTION_REAL, &job.drive.frequency, 1e-3, 1e3},
        {"--world", NULL, NULL, "write the motion as seen from outside, not from the base", OPTION_FLAG,
         &shake->world, 0, 0},
        {"--seconds", NULL, "S", "duration in seconds (4, or 8 periods of the body)", OPTION_REAL, &job.seconds, 1e-3,
         3600},
        {"--fps", NULL, "N", "frames per second (24)", OPTION_REAL, &shake->fps, 1, 1000},
        {"--accuracy", NULL, "E", "allowed error, relative to the size of the motion; sets the steps (0.02)",
         OPTION_REAL, &shake->accuracy, 1e-4, 1},
        {"--budget", NULL, "M", "end the search for those steps after M million element-steps (20)", OPTION_REAL,
         &job.budget, 0, 1e6},
        {"--substeps", NULL, "N", "integrator steps per frame, instead of --accuracy", OPTION_INT, &shake->substeps,
         1, 1000},
        {"--tets", NULL, "N", "approximate number of tetrahedra (3000)", OPTION_INT, &job.soft.tets, 50, 200000},
        {"--thickness", NULL, "H", "make the mesh a sheet H metres thick; 0: close its openings, however large",
         OPTION_REAL, &job.soft.thickness, 0, 1e6},
        {"--pin", NULL, "WHERE",
         "pin below a height (1/20 of the mesh), none, plane:x,y,z,nx,ny,nz, sphere:x,y,z,r, color:RRGGBB",
         OPTION_TEXT, &job.pin_text, 0, 0},
        {"--frequency", NULL, "HZ", "frequency of the mode seen most (--modal: the lowest); sets the stiffness (2)",
         OPTION_REAL, &job.soft.frequency, 1e-3, 1e3},
        {"--young", NULL, "E", "Young's modulus in Pa, instead of --frequency", OPTION_REAL, &job.soft.young, 1e-6,
         1e15},
        {"--soft", NULL, "MAP",
         "soften by distance (from the pin, the default with a drive), color (brightness) or FILE.npy (0 to 1 per "
         "vertex)",
         OPTION_TEXT, &job.soft_text, 0, 0},
        {"--softness", NULL, "N", "how many times softer where the map is 1 (8)", OPTION_REAL,
         &job.soft.softness.times, 1e-3, 1e3},
        {"--poisson", NULL, "NU", "Poisson's ratio (0.35)", OPTION_REAL, &job.soft.poisson, 0, 0.49},
        {"--density", NULL, "RHO", "density in kg/m^3, only with --young (1000)", OPTION_REAL, &job.soft.density,
         1e-6, 1e9},
        {"--damping", NULL, "Z", "damping ratio of that mode (0.2; swinging freely 0.03)", OPTION_REAL, &job.damping,
         0, 1},
        {"--gravity", NULL, "G", "gravity in m/s^2 (0); a pinned body starts at rest under it", OPTION_REAL,
         &shake->loads.gravity, 0, 1e4},
        {"--floor", NULL, "H", "a smooth floor at H above the lowest point", OPTION_REAL, &job.floor, 0, 1e6},
        {"--modal", NULL, "K", "write the K lowest normal modes instead of a shake", OPTION_INT, &modes, 1, 200},
        {"--verbose", NULL, NULL, "show progress even if standard error is not a terminal", OPTION_FLAG,
         &shake->verbose, 0, 0},
    };
    const struct usage usage = {
        .command = "simulate",
        .operands = "MESH",
        .summary = "Shakes a mesh (OBJ, STL, PLY, OFF, glTF) as a soft body (finite elements) and writes its "
                   "vertices in every frame.",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .operand_maximum = 1,
    };
    enum options_result result = options_parse(&usage, argc, argv, &job.mesh);
    if (result != OPTIONS_RUN) return (int)result;
    job.modal = modes > 0;
    job.soft.modes = job.modal ? modes : MODES_SEARCHED;
    if (!job.modal) job.soft.shake = &shake->shake;
    const char *wrong = check(&job);
    if (wrong) return (int)options_wrong(&usage, "%s", wrong);
    struct error error;
    return options_end(run(&job, &error), &error);
}
