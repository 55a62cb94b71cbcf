/// `wiggly simulate`: shakes a closed mesh as a soft body, or finds its normal modes.
#include "base/clock.h"
#include "base/file.h"
#include "commands/commands.h"
#include "commands/options.h"
#include "commands/progress.h"
#include "model/motion.h"
#include "model/obj.h"
#include "simulation/soft.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

struct job {
    const char *mesh, *output;
    char rest[4096]; ///< the rest mesh beside the output
    const char *shake_text;
    struct shake shake;
    struct soft_options soft;
    double seconds, fps;
    int substeps;
    bool modal, verbose;
};

/// One frame: the integrator's substeps, then the surface.
static bool simulate_frame(const struct job *job, const struct soft *soft, struct integrator *integrator, int frame,
                           float (*position)[3], struct error *error)
{
    for (int s = 0; frame > 0 && s < job->substeps; s++) {
        if (progress_interrupted()) return fail(error, ERROR_ENVIRONMENT, "interrupted; nothing was written");
        if (integrator_step(integrator)) continue;
        return fail(error, ERROR_INPUT,
                    "frame %d: the simulation became unstable: try more --substeps or a smaller --amplitude", frame);
    }
    lattice_embed(&soft->lattice, (const double(*)[3])integrator->x, position);
    return true;
}

static bool write_frames(const struct job *job, const struct soft *soft, struct integrator *integrator, int frames,
                         float (*position)[3], struct error *error)
{
    struct motion_writer writer;
    const double started = clock_now();
    struct progress progress = {.started = started, .lines = job->verbose};
    if (!motion_write_open(&writer, job->output, frames, soft->lattice.vertex_count, error)) return false;
    for (int frame = 0; frame < frames; frame++) {
        if (!simulate_frame(job, soft, integrator, frame, position, error) ||
            !motion_write_frame(&writer, (const float(*)[3])position, error)) {
            motion_write_discard(&writer);
            return false;
        }
        progress_show(&progress, frame + 1, frames);
    }
    if (!motion_write_commit(&writer, error)) return false;
    printf("%s: %d frames of %d vertices at %g fps, in %.1f s\n", job->output, frames, soft->lattice.vertex_count,
           job->fps, clock_now() - started);
    return true;
}

static bool shake(const struct job *job, const struct soft *soft, const struct surface *surface, struct body *body,
                  struct error *error)
{
    struct integrator integrator;
    int frames = (int)fmax(1, round(job->seconds * job->fps));
    float(*position)[3] = calloc((size_t)soft->lattice.vertex_count + 1, sizeof *position);
    bool good = position && integrator_create(&integrator, body, 1 / (job->fps * job->substeps));
    if (!good) {
        free(position);
        return fail_no_memory(error, job->mesh);
    }
    memcpy(position, surface->position, (size_t)surface->vertex_count * sizeof *position); // strays stay there
    integrator.mass_damping = soft->alpha;
    integrator.stiffness_damping = soft->beta;
    integrator.tolerance = 1e-4 * soft->lattice.cell; // Newton's next step would be a thousandth of that
    soft_shake(soft, &job->shake, &integrator);
    good = write_frames(job, soft, &integrator, frames, position, error);
    integrator_free(&integrator);
    free(position);
    return good;
}

/// Each mode's displacement of the vertices, scaled so that the largest is 1.
static bool write_modes(const struct job *job, const struct soft *soft, struct error *error)
{
    const int vertices = soft->lattice.vertex_count, nodes = soft->body.node_count;
    struct motion_writer writer;
    float(*shape)[3] = calloc((size_t)vertices + 1, sizeof *shape);
    if (!shape) return fail_no_memory(error, job->mesh);
    bool good = motion_write_open(&writer, job->output, soft->modes.count, vertices, error);
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
        good = motion_write_frame(&writer, (const float(*)[3])shape, error);
        if (!good) motion_write_discard(&writer);
    }
    good = good && motion_write_commit(&writer, error);
    free(shape);
    if (!good) return false;
    printf("%4s %12s\n", "mode", "Hz");
    for (int k = 0; k < soft->modes.count; k++) printf("%4d %12.6g\n", k + 1, soft->modes.frequency[k]);
    printf("%s: %d modes of %d vertices\n", job->output, soft->modes.count, vertices);
    return true;
}

static bool run(const struct job *job, struct error *error)
{
    struct surface surface = {0};
    struct soft soft;
    if (!surface_read(job->mesh, &surface, error)) return false;
    bool good = soft_create(&soft, &surface, job->mesh, &job->soft, error);
    if (good) {
        printf("%s: %d tetrahedra, %d nodes, %d of them pinned; Young's modulus %.4g Pa, lowest mode %.4g Hz\n",
               job->mesh, soft.lattice.tet_count, soft.body.node_count, soft.pinned, soft.young,
               soft.modes.count ? soft.modes.frequency[0] : 0);
        if (soft.lattice.repair[0]) printf("%s: %s\n", job->mesh, soft.lattice.repair);
        fflush(stdout);
        if (soft.loose_parts > 0) {
            fprintf(stderr, "%s: warning: %d of %d separate parts are not pinned and will drift\n", job->mesh,
                    soft.loose_parts, soft.lattice.part_count);
        }
        good = job->modal ? write_modes(job, &soft, error) : shake(job, &soft, &surface, &soft.body, error);
        good = good && obj_write(job->rest, &surface, error);
        if (good) printf("%s: the mesh at rest\n", job->rest);
        soft_free(&soft);
    }
    surface_free(&surface);
    return good;
}

static bool ends_in(const char *path, const char *extension)
{
    size_t length = strlen(path), tail = strlen(extension);
    return length > tail && strcasecmp(path + length - tail, extension) == 0;
}

/// Sets stiffness and mass, 0 meaning not given. NULL or what is wrong.
static const char *set_material(struct soft_options *soft)
{
    const struct soft_options usual = soft_default_options();
    if (soft->young > 0 && soft->frequency > 0) return "--young and --frequency both set the stiffness: give one";
    if (soft->density > 0 && soft->young == 0)
        return "--density needs --young: with --frequency the stiffness follows the mass, and the motion stays the "
               "same";
    if (soft->frequency == 0) soft->frequency = usual.frequency;
    if (soft->density == 0) soft->density = usual.density;
    return NULL;
}

/// Checks what the table of options cannot; NULL or what is wrong.
static const char *check(struct job *job)
{
    if (!job->output) return "-o FILE is missing: name the file to write";
    if (job->modal && !ends_in(job->output, ".npy")) return "--output: expected a name ending in .npy for --modal";
    if (!ends_in(job->output, ".npy") && !ends_in(job->output, ".pc2"))
        return "--output: expected a name ending in .npy or .pc2";
    if (strlen(job->output) + 16 > sizeof job->rest) return "--output: the name is too long";
    if (!options_direction(job->shake_text, job->shake.direction))
        return "--shake: expected up, side, front or a vector x,y,z";
    snprintf(job->rest, sizeof job->rest, "%.*s.rest.obj", (int)strlen(job->output) - 4, job->output);
    return set_material(&job->soft);
}

int command_simulate(int argc, char **argv)
{
    struct job job = {.soft = soft_default_options(),
                      .shake = {.amplitude = 0.2},
                      .shake_text = "up",
                      .seconds = 4,
                      .fps = 24,
                      .substeps = 8};
    int modes = 0;
    job.soft.frequency = job.soft.density = 0;
    const struct option_spec options[] = {
        {"--output", "-o", "FILE",
         "required: NAME.npy or NAME.pc2 (--modal: .npy); the rest mesh goes to NAME.rest.obj", OPTION_TEXT,
         &job.output, 0, 0},
        {"--shake", NULL, "DIR", "up, side, front or a vector x,y,z (default: up)", OPTION_TEXT, &job.shake_text, 0,
         0},
        {"--amplitude", NULL, "A", "how far the top moves, relative to the height (0.2)", OPTION_REAL,
         &job.shake.amplitude, -2, 2},
        {"--impulse", NULL, NULL, "start with a push instead of a deformation", OPTION_FLAG, &job.shake.impulse, 0,
         0},
        {"--seconds", NULL, "S", "duration in seconds (4)", OPTION_REAL, &job.seconds, 1e-3, 3600},
        {"--fps", NULL, "N", "frames per second (24)", OPTION_REAL, &job.fps, 1, 1000},
        {"--substeps", NULL, "N", "integrator steps per frame (8)", OPTION_INT, &job.substeps, 1, 1000},
        {"--tets", NULL, "N", "approximate number of tetrahedra (3000)", OPTION_INT, &job.soft.tets, 50, 200000},
        {"--pin", NULL, "H", "pin everything up to H above the lowest point (1/20 of the height)", OPTION_REAL,
         &job.soft.pin, 0, 1e6},
        {"--frequency", NULL, "HZ", "frequency of the lowest mode; sets the stiffness (2)", OPTION_REAL,
         &job.soft.frequency, 1e-3, 1e3},
        {"--young", NULL, "E", "Young's modulus in Pa, instead of --frequency", OPTION_REAL, &job.soft.young, 1e-6,
         1e15},
        {"--poisson", NULL, "NU", "Poisson's ratio (0.35)", OPTION_REAL, &job.soft.poisson, 0, 0.49},
        {"--density", NULL, "RHO", "density in kg/m^3, only with --young (1000)", OPTION_REAL, &job.soft.density,
         1e-6, 1e9},
        {"--damping", NULL, "Z", "damping ratio at the lowest mode (0.03)", OPTION_REAL, &job.soft.damping, 0, 1},
        {"--modal", NULL, "K", "write the K lowest normal modes instead of a shake", OPTION_INT, &modes, 1, 200},
        {"--verbose", NULL, NULL, "show progress even if standard error is not a terminal", OPTION_FLAG, &job.verbose,
         0, 0},
    };
    const struct usage usage = {
        .command = "simulate",
        .operands = "mesh.obj",
        .summary = "Shakes a closed mesh as a soft body (finite elements) and writes its vertices in every frame.",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .operand_minimum = 1,
        .operand_maximum = 1,
    };
    enum options_result result = options_parse(&usage, argc, argv, &job.mesh);
    if (result != OPTIONS_RUN) return (int)result;
    job.modal = modes > 0;
    if (job.modal) job.soft.modes = modes;
    const char *wrong = check(&job);
    if (wrong) return (int)options_wrong(&usage, "%s", wrong);
    progress_catch_interrupts();
    struct error error;
    if (run(&job, &error)) return 0;
    fprintf(stderr, "wiggly simulate: %s\n", error.text);
    return (int)error.kind;
}
