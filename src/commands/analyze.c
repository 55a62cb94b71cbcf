/// `wiggly analyze`: the complex normal coordinates of simulated motions, as a character.
#include "analysis/analysis.h"
#include "commands/analyze_scene.h"
#include "commands/commands.h"
#include "commands/options.h"
#include "model/character.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FILES_MAX = 16, MODES_MAX = ANALYSIS_FRAMES_MIN };

static const double recommended_bandwidth = 0.1; ///< the spline's default; a single oscillation says nothing of it

/// What the command line asks for.
struct job {
    const char *files[FILES_MAX + 1]; ///< NULL behind the last
    const char *rest, *output, *scene, *shake;
    double fps; ///< 0: what the files say
    int modes;
    double directions[FILES_MAX][3];
    int direction_count; ///< 0, 1 for all, or one a file
};

/// Splits --shake at its colons. False if a part is no direction or their number is wrong.
static bool read_directions(struct job *job, int files)
{
    const char *at = job->shake;
    while (at && job->direction_count < files) {
        char part[64];
        size_t length = strcspn(at, ":");
        if (length >= sizeof part) return false;
        memcpy(part, at, length);
        part[length] = '\0';
        if (!options_direction(part, job->directions[job->direction_count++])) return false;
        at = at[length] ? at + length + 1 : NULL;
    }
    return !at && (job->direction_count <= 1 || job->direction_count == files);
}

/// A unique name for a coordinate, from the file's: "up", and "up-2" … for further modes.
static char *make_name(const char *path, const struct character *character)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    const char *dot = strrchr(base, '.');
    int stem = (int)(dot ? (size_t)(dot - base) : strlen(base));
    struct error name; // what fail() leaves is valid UTF-8
    for (int attempt = 1;; attempt++) {
        fail(&name, ERROR_NONE, attempt > 1 ? "%.*s-%d" : "%.*s", stem > 0 ? stem : 6, stem > 0 ? base : "motion",
             attempt);
        bool taken = false;
        for (int i = 0; i < character->coordinate_count; i++) {
            const char *other = character->coordinates[i].name;
            taken |= other && strcmp(other, name.text) == 0;
        }
        if (!taken) return strdup(name.text);
    }
}

static bool keep(struct coordinate *to, const struct component *c, const struct analysis *analysis, const char *path,
                 const struct character *character, struct error *error)
{
    to->name = make_name(path, character);
    if (!to->name) return fail_no_memory(error, path);
    to->frequency = c->frequency;
    to->damping = c->damping;
    to->explained = c->explained;
    to->pca1 = analysis->pca1;
    to->pca2 = analysis->pca2;
    for (int n = 0; n < 3 * c->vertices; n++) {
        to->re[n / 3][n % 3] = (float)creal(c->shape[n / 3][n % 3]);
        to->im[n / 3][n % 3] = (float)cimag(c->shape[n / 3][n % 3]);
    }
    return true;
}

static void report(const struct coordinate *to, const struct component *c)
{
    printf("  %s: explains %.2f %%; real PCA's first %.2f %%, its first two %.2f %%\n", to->name, 100 * to->explained,
           100 * to->pca1, 100 * to->pca2);
    printf("    frequency %.4g Hz, damping ratio %.3g; mostly along (%.2f, %.2f, %.2f), %.3g m at most\n",
           c->frequency, c->damping, c->direction[0], c->direction[1], c->direction[2], c->reach);
    printf("    spline: \"mode\": \"complex\", \"frequency\": %.4g, \"damping\": %.3g, \"bandwidth\": %g\n",
           c->frequency, c->damping, recommended_bandwidth);
    printf(
        "    lag over the surface: from %.0f to %.0f degrees, beyond which 5 %% of the motion lie on either side\n",
        c->first_lag, c->last_lag);
}

static bool check_motion(const struct job *job, const struct motion *motion, const struct surface *rest, double *fps,
                         struct error *error)
{
    if (motion->vertices != rest->vertex_count)
        return fail(error, ERROR_INPUT, "%s: expected %d vertices as %s has, got %d", motion->path,
                    rest->vertex_count, job->rest, motion->vertices);
    *fps = job->fps > 0 ? job->fps : motion->fps;
    if (*fps > 0) return true;
    return fail(error, ERROR_USAGE, "%s: the file has no frame rate: give --fps N", motion->path);
}

/// A coordinate is added to the mesh at rest; a motion centred elsewhere has other axes, units or an offset.
static void warn_of_distance(const struct motion *motion, const struct analysis *analysis, const struct surface *rest)
{
    double centre[3] = {0}, distance = 0, size = 0;
    for (int n = 0; n < 3 * rest->vertex_count; n++)
        centre[n % 3] += (double)rest->position[n / 3][n % 3] / rest->vertex_count;
    for (int n = 0; n < 3 * rest->vertex_count; n++) {
        double at = (double)rest->position[n / 3][n % 3];
        distance += (analysis->mean[n / 3][n % 3] - at) * (analysis->mean[n / 3][n % 3] - at);
        size += (at - centre[n % 3]) * (at - centre[n % 3]);
    }
    if (distance > 0.25 * size) {
        fprintf(stderr, "%s: warning: the motion is not centred on the rest mesh; check axes, units and position\n",
                motion->path);
    }
}

/// Analyses one file and appends its coordinates to the character.
static bool analyse(const struct job *job, int file, const struct lapack *lapack, const struct surface *rest,
                    struct character *character, int *filled, struct error *error)
{
    struct motion motion;
    struct analysis analysis = {0};
    double fps = 0;
    if (!motion_open(&motion, job->files[file], error)) return false;
    const double *direction = job->direction_count ? job->directions[job->direction_count > 1 ? file : 0] : NULL;
    bool done = check_motion(job, &motion, rest, &fps, error) &&
                analysis_create(&analysis, lapack, &motion, fps, job->modes, direction, error);
    if (done) warn_of_distance(&motion, &analysis, rest);
    if (done) printf("%s: %d frames of %d vertices at %g fps\n", motion.path, motion.frames, motion.vertices, fps);
    for (int k = 0; done && k < analysis.count; k++) {
        struct coordinate *to = &character->coordinates[(*filled)++];
        done = keep(to, &analysis.components[k], &analysis, motion.path, character, error);
        if (done) report(to, &analysis.components[k]);
    }
    analysis_free(&analysis);
    motion_close(&motion);
    return done;
}

static bool analyse_files(const struct job *job, const struct lapack *lapack, const struct surface *rest,
                          struct character *character, struct error *error)
{
    int files = 0, filled = 0;
    while (job->files[files]) files++;
    if (!character_create(character, rest, files * job->modes)) return fail_no_memory(error, job->rest);
    bool done = true;
    for (int i = 0; done && i < files; i++) done = analyse(job, i, lapack, rest, character, &filled, error);
    return done && character_write(job->output, character, error) &&
           (!job->scene || analyze_scene_write(job->scene, job->output, character, job->modes, error));
}

static bool run(const struct job *job, struct error *error)
{
    struct surface rest;
    struct character character = {0};
    struct lapack lapack;
    char description[128];
    if (!lapack_load(&lapack, description, sizeof description))
        return fail(error, ERROR_ENVIRONMENT, "LAPACKE and OpenBLAS: %s", description);
    bool done = surface_read(job->rest, &rest, error);
    if (done) done = analyse_files(job, &lapack, &rest, &character, error);
    character_free(&character);
    surface_free(&rest);
    lapack_unload(&lapack);
    return done;
}

/// Checks what the table of options cannot; NULL or what is wrong.
static const char *check(struct job *job)
{
    int files = 0;
    while (job->files[files]) files++;
    if (!job->rest) return "--rest mesh.obj is missing: name the mesh at rest";
    if (!job->output) return "-o creature.glb is missing: name the file to write";
    if (!read_directions(job, files))
        return "--shake: expected up, side, front or a vector x,y,z, one for all files or one each with : between";
    return NULL;
}

int command_analyze(int argc, char **argv)
{
    struct job job = {.modes = 1};
    const struct option_spec options[] = {
        {"--rest", NULL, "FILE", "required: the mesh at rest (OBJ), with the same vertices in the same order",
         OPTION_TEXT, &job.rest, 0, 0},
        {"--output", "-o", "FILE", "required: the character to write (.glb)", OPTION_TEXT, &job.output, 0, 0},
        {"--fps", NULL, "N", "frames per second; required for .npy and .pc2", OPTION_REAL, &job.fps, 1e-3, 100000},
        {"--modes", NULL, "K", "coordinates per motion, largest first (1)", OPTION_INT, &job.modes, 1, MODES_MAX},
        {"--shake", NULL, "DIR",
         "direction of the shake: up, side, front or x,y,z; one for all or one per file (up:side)", OPTION_TEXT,
         &job.shake, 0, 0},
        {"--scene", NULL, "FILE", "write a scene that drives the character too", OPTION_TEXT, &job.scene, 0, 0},
    };
    const struct usage usage = {
        .command = "analyze",
        .operands = "up.npy [side.npy ...]",
        .summary = "Finds the complex normal coordinate of each motion (.npy, .pc2, .mdd) and writes a character.",
        .options = options,
        .option_count = sizeof options / sizeof options[0],
        .operand_minimum = 1,
        .operand_maximum = FILES_MAX,
    };
    enum options_result result = options_parse(&usage, argc, argv, job.files);
    if (result != OPTIONS_RUN) return (int)result;
    const char *wrong = check(&job);
    if (wrong) return (int)options_wrong(&usage, "%s", wrong);
    struct error error;
    if (run(&job, &error)) return 0;
    fprintf(stderr, "%s\n", error.text);
    return (int)error.kind;
}
