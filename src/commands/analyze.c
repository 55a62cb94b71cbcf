/// `wiggly analyze`: turns simulated motions into a character with complex normal coordinates.
#include "analysis/analysis.h"
#include "base/error.h"
#include "base/file.h"
#include "base/names.h"
#include "base/need.h"
#include "commands/analyze_scene.h"
#include "commands/commands.h"
#include "commands/companion.h"
#include "commands/open_mesh.h"
#include "commands/options.h"
#include "commands/progress.h"
#include "model/character.h"
#include "simulation/soft.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILES_MAX = 16, MODES_MAX = ANALYSIS_MODES_MAX, DIRECTION_SIZE = 64 };

static const double recommended_bandwidth = 0.1; ///< the spline's default; an analysis of one oscillation cannot tell
static const double fast_warning = 0.01;         ///< share of power near half the frame rate that causes a warning
static const double rigid_warning = 0.5;         ///< share of a coordinate that is a rigid motion of a loose mesh
static const double fast_pole = 0.8;             ///< share of half the frame rate; higher frequencies cause a warning

struct job {
    const char *files[FILES_MAX + 1]; ///< NULL-terminated
    const char *rest, *output, *scene, *coordinates, *shake, *pin;
    char rest_found[COMPANION_PATH]; ///< NAME.rest.obj beside the first motion, used unless `rest` is given
    struct mesh_options opening;     ///< of `rest`
    double fps;                      ///< 0: from the files
    int method;                      ///< 0: default, else as in method_of()
    int modes;
    bool no_normals;
    double from;          ///< seconds; below 0: what the files say
    struct region pinned; ///< what `pin` says
    double directions[FILES_MAX][3];
    int direction_count; ///< 0, 1 for all, or one per file
};

/// A motion and what is known of it.
struct input {
    struct motion motion;
    struct companion made; ///< all zero if wiggly did not simulate it
    struct rigid base;
    double fps;
};

struct result {
    struct character character;
    struct analyzed *analyzed; ///< one per coordinate
    int filled;                ///< coordinates so far
};

static enum analysis_method method_of(const struct job *job)
{
    enum { CPCA = 2 }; // index in the option's words
    return job->method == CPCA ? ANALYSIS_CPCA : ANALYSIS_POLES;
}

/// Splits --shake at colons; false if a part is no direction or the number of parts is wrong.
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

/// A unique coordinate name from the file's: "up", then "up-2" … for further modes.
static char *make_name(const char *path, const struct character *character)
{
    struct names names = {.between = "-"};
    const char *base = path_name(path), *dot = strrchr(base, '.');
    const size_t length = dot ? (size_t)(dot - base) : strlen(base);
    char *stem = length > 0 ? name_from(base, length) : need_text("motion");
    for (int i = 0; i < character->coordinate_count; i++) {
        if (character->coordinates[i].name) names_add(&names, character->coordinates[i].name);
    }
    char *name = need_text(names_add(&names, stem));
    names_free(&names);
    free(stem);
    return name;
}

/// Rounded to a millionth, so that files do not depend on the processor LAPACK ran on.
static double rounded(double value) { return round(value * 1e6) / 1e6; }

static void keep(struct coordinate *to, const struct component *c, const struct analysis *analysis, const char *path,
                 const struct character *character)
{
    to->name = make_name(path, character);
    to->frequency = rounded(c->frequency);
    to->damping = rounded(c->damping);
    to->explained = rounded(c->explained);
    to->pca1 = rounded(analysis->pca1);
    to->pca2 = rounded(analysis->pca2);
    for (int n = 0; n < 3 * c->vertices; n++) {
        to->re[n / 3][n % 3] = (float)creal(c->shape[n / 3][n % 3]);
        to->im[n / 3][n % 3] = (float)cimag(c->shape[n / 3][n % 3]);
    }
}

static void report_spline(const struct analyzed *analyzed, const struct component *c)
{
    const struct knots *k = &analyzed->knots;
    if (!k->series) {
        printf("    spline: \"mode\": \"complex\", \"frequency\": %.4g, \"damping\": %.3g, \"bandwidth\": %g\n",
               c->frequency, c->damping, recommended_bandwidth);
        return;
    }
    printf("    spline: \"mode\": \"%s\", \"frequency\": %.4g, \"damping\": %.3g, \"bandwidth\": %.3g, %d knot%s\n",
           k->mode == WIGGLY_REAL ? "real" : "complex", k->frequency, k->damping, k->bandwidth, k->count,
           k->count > 1 ? "s" : "");
    printf("    relative error of its motion: %.3g by this spline, %.3g by the coordinate's own time series\n",
           k->error, component_error(c, c->series));
}

static void print_direction(const double vector[3], double length, char text[DIRECTION_SIZE])
{
    double unit[3];
    for (int k = 0; k < 3; k++) unit[k] = printable_number(vector[k] / length, 0.01);
    snprintf(text, DIRECTION_SIZE, "(%.2f, %.2f, %.2f)", unit[0], unit[1], unit[2]);
}

static void report(const struct coordinate *to, const struct analyzed *analyzed, const struct component *c)
{
    print_line(stdout, "  %s: explains %.2f %%; real PCA's first %.2f %%, its first two %.2f %%", to->name,
               100 * to->explained, 100 * to->pca1, 100 * to->pca2);
    char along[DIRECTION_SIZE];
    print_direction(c->direction, 1, along);
    printf("    frequency %.4g Hz, damping ratio %.3g; mostly along %s, %.3g m at most\n", c->frequency, c->damping,
           along, c->reach);
    report_spline(analyzed, c);
    printf("    lag over the surface: from %.0f to %.0f degrees, with 5 %% of the motion beyond each end\n",
           printable_number(c->first_lag, 1), printable_number(c->last_lag, 1));
}

static void report_motion(const struct job *job, const struct input *in, const struct analysis *a)
{
    const struct rigid *base = &in->base;
    print_line(stdout, "%s: %d frames of %d vertices at %g fps", in->motion.path, in->motion.frames,
               in->motion.vertices, in->fps);
    if (base->frames > 0) {
        printf("  removed the motion of the %s: up to %.3g m and %.3g degrees\n", base->whole ? "whole mesh" : "base",
               printable_number(base->travel, 1e-4), printable_number(base->angle, 0.01));
    }
    if (a->count < job->modes)
        printf("  %d of %d coordinates: the motion has no more poles that matter\n", a->count, job->modes);
}

/// Warns of frequencies close to half the frame rate, which are measured badly, or above it, which are not seen.
static void warn_of_speed(const struct motion *motion, const struct analysis *a, double fps)
{
    bool fast = a->fast_share > fast_warning;
    for (int k = 0; k < a->count; k++) fast |= a->components[k].frequency > fast_pole * fps / 2;
    if (fast) {
        print_line(stderr,
                   "%s: warning: parts move faster than %g fps can show (%.1f %% of the motion above %.4g Hz); "
                   "simulate with more frames per second",
                   motion->path, fps, 100 * a->fast_share, fast_pole * fps / 2);
    }
}

/// A driven motion is no sum of free swings. The method may then find two large motions that nearly cancel.
static void warn_of_cancelling(const struct motion *motion, const struct analysis *a)
{
    if (a->cancelled == 0) return;
    print_line(stderr,
               "%s: warning: left out %d pole%s that only cancel others; if something drives the mesh, "
               "set --from to the second when it stops, or use --method cpca",
               motion->path, a->cancelled, a->cancelled > 1 ? "s" : "");
}

/// Of a mesh that is not known to be held, a coordinate may be a rigid motion.
static void warn_of_rigid(const struct input *in, const struct analysis *a, const struct surface *rest)
{
    for (int k = 0; in->base.loose && k < a->count; k++) {
        const double share = rigid_share((const double complex(*)[3])a->components[k].shape, rest);
        if (share < rigid_warning) continue;
        print_line(
            stderr,
            "%s: warning: %.0f %% of coordinate %d is a rigid motion of the whole mesh; name what holds it with "
            "--pin, or --pin none",
            in->motion.path, 100 * share, k + 1);
    }
}

/// The mesh at rest, whose arrays stay the character's.
static struct surface rest_of(const struct character *c)
{
    return (struct surface){.position = c->position,
                            .color = c->color,
                            .vertex_count = c->vertex_count,
                            .indices = c->indices,
                            .index_count = c->index_count};
}

/// How the base moves: what --pin names, else what a simulation pinned, else what rests.
static bool find_base(const struct job *job, struct input *in, const struct surface *rest,
                      const struct lapack *lapack, struct error *error)
{
    const bool simulated = in->made.frames > 0;
    struct region region = job->pinned;
    if (!job->pin && simulated && !region_parse(in->made.pin, &region))
        return fail(error, ERROR_INPUT, "%s: expected a region in what simulate wrote beside it, got \"%s\"",
                    in->motion.path, in->made.pin);
    if (!job->pin && simulated && !in->made.world && region.kind != REGION_NONE) return true;
    if (!job->pin && !simulated) return rigid_find(&in->base, lapack, &in->motion, rest, NULL, error);
    bool *pinned = need((size_t)rest->vertex_count + 1, sizeof *pinned);
    for (int v = 0; v < rest->vertex_count; v++) pinned[v] = region.kind == REGION_NONE;
    bool done =
        region.kind == REGION_NONE || region_vertices(&region, rest, pinned) > 0 ||
        fail(error, ERROR_INPUT, "%s: no vertex is in the region of --pin: name one that holds some", job->rest);
    done = done && rigid_find(&in->base, lapack, &in->motion, rest, pinned, error);
    free(pinned);
    return done;
}

/// Opens a motion and finds what is known of it.
static bool open_input(const struct job *job, int file, const struct surface *rest, const struct lapack *lapack,
                       struct input *in, struct error *error)
{
    const struct motion *motion = &in->motion;
    if (!motion_open(&in->motion, job->files[file], error)) return false;
    if (motion->vertices != rest->vertex_count)
        return fail(error, ERROR_INPUT, "%s: expected %d vertices as %s has, got %d", motion->path,
                    rest->vertex_count, job->rest, motion->vertices);
    if (!companion_read(motion->path, motion->frames, motion->vertices, &in->made, error)) return false;
    in->fps = job->fps > 0 ? job->fps : motion->fps > 0 ? motion->fps : in->made.fps;
    if (!(in->fps > 0)) return fail(error, ERROR_USAGE, "%s: the file has no frame rate: give --fps N", motion->path);
    return find_base(job, in, rest, lapack, error);
}

/// Warns if a motion is centred far from the rest mesh: it may have other axes, units or an offset.
static void warn_of_distance(const struct motion *motion, const struct analysis *analysis,
                             const struct character *rest)
{
    double centre[3] = {0}, distance = 0, size = 0;
    for (int n = 0; n < 3 * rest->vertex_count; n++) {
        double at = (double)rest->position[n / 3][n % 3];
        centre[n % 3] += at / rest->vertex_count;
    }
    for (int n = 0; n < 3 * rest->vertex_count; n++) {
        double at = (double)rest->position[n / 3][n % 3];
        double away = analysis->mean[n / 3][n % 3] - at;
        distance += away * away;
        size += (at - centre[n % 3]) * (at - centre[n % 3]);
    }
    if (distance > 0.25 * size) {
        print_line(stderr, "%s: warning: the motion is not centred on the rest mesh; check axes, units and position",
                   motion->path);
    }
}

/// Keeps time series and knots, which only the scene and the coordinate table need.
static void keep_course(const struct job *job, struct analyzed *to, struct component *c, int rank, double fps)
{
    *to = (struct analyzed){.rank = rank, .fps = fps, .frames = c->frames};
    if (!job->scene && !job->coordinates) return;
    knots_create(&to->knots, c, fps);
    to->series = need((size_t)c->frames, sizeof *to->series);
    memcpy(to->series, c->series, (size_t)c->frames * sizeof *to->series);
}

static void keep_all(const struct job *job, const struct analysis *analysis, const struct motion *motion, double fps,
                     struct result *result)
{
    for (int k = 0; k < analysis->count; k++) {
        struct coordinate *to = &result->character.coordinates[result->filled];
        struct analyzed *analyzed = &result->analyzed[result->filled++];
        struct component *c = &analysis->components[k];
        keep(to, c, analysis, motion->path, &result->character);
        keep_course(job, analyzed, c, k, fps);
        report(to, analyzed, c);
    }
    printf("  relative error of the motion with %d coordinate%s: %.3g; as many real principal components: %.3g\n",
           analysis->count, analysis->count > 1 ? "s" : "", analysis->left, analysis->real_left);
}

/// Analyses a file and appends its coordinates.
static bool analyse(const struct job *job, int file, const struct lapack *lapack, struct result *result,
                    struct error *error)
{
    const struct surface rest = rest_of(&result->character);
    struct input in = {.motion.file = -1};
    struct analysis analysis = {0};
    bool done = open_input(job, file, &rest, lapack, &in, error);
    const bool directed = job->direction_count > 0;
    const double driven = job->from >= 0 ? job->from * in.fps : in.made.from * in.made.fps; // frames
    const struct analysis_plan plan = {
        .method = method_of(job),
        .fps = in.fps,
        .modes = job->modes,
        .first = method_of(job) == ANALYSIS_CPCA ? 0 : (int)fmin(ceil(driven), ANALYSIS_FRAMES_MAX),
        .direction = directed             ? job->directions[job->direction_count > 1 ? file : 0]
                     : in.made.frames > 0 ? in.made.shake
                                          : NULL,
        .base = &in.base,
    };
    done = done && analysis_create(&analysis, lapack, &in.motion, &plan, error);
    if (done) {
        warn_of_distance(&in.motion, &analysis, &result->character);
        warn_of_speed(&in.motion, &analysis, in.fps);
        warn_of_cancelling(&in.motion, &analysis);
        warn_of_rigid(&in, &analysis, &rest);
        report_motion(job, &in, &analysis);
        keep_all(job, &analysis, &in.motion, in.fps, result);
    }
    analysis_free(&analysis);
    rigid_free(&in.base);
    motion_close(&in.motion);
    return done;
}

/// Frees coordinates without poles.
static void drop_unused(struct result *result)
{
    struct character *c = &result->character;
    while (c->coordinate_count > result->filled) {
        struct coordinate *last = &c->coordinates[--c->coordinate_count];
        free(last->re);
        free(last->im);
    }
}

static bool analyse_files(const struct job *job, const struct lapack *lapack, struct surface *rest,
                          struct result *result, struct error *error)
{
    int files = 0;
    while (job->files[files]) files++;
    result->analyzed = need_zeroed((size_t)(files * job->modes), sizeof *result->analyzed);
    if (!character_create(&result->character, rest, files * job->modes)) return fail_no_memory(error, job->rest);
    for (int i = 0; i < files; i++) {
        if (!analyse(job, i, lapack, result, error)) return false;
    }
    drop_unused(result);
    const struct character *character = &result->character;
    const char *const also[] = {job->scene,
                                job->coordinates}; // all or none, though more was read than the command line named
    for (int i = 0; i < 2; i++) {
        if (also[i] && !file_check_unread(also[i], error)) return false;
    }
    return character_write(job->output, character, !job->no_normals, error) &&
           (!job->scene || analyze_scene_write(job->scene, job->output, character, result->analyzed, error)) &&
           (!job->coordinates || analyze_coordinates_write(job->coordinates, character, result->analyzed, error));
}

static void free_result(struct result *result)
{
    for (int i = 0; i < result->filled; i++) {
        free(result->analyzed[i].series);
        knots_free(&result->analyzed[i].knots);
    }
    free(result->analyzed);
    character_free(&result->character);
}

static bool run(const struct job *job, struct error *error)
{
    struct surface rest;
    struct result result = {0};
    struct lapack lapack;
    char description[128];
    if (!lapack_load(&lapack, description, sizeof description))
        return fail(error, ERROR_ENVIRONMENT, "LAPACKE and OpenBLAS: %s", description);
    bool done = open_mesh(job->rest, &job->opening, &rest, error);
    if (done) done = analyse_files(job, &lapack, &rest, &result, error);
    free_result(&result);
    surface_free(&rest);
    lapack_unload(&lapack);
    return done;
}

/// Checks what the option table cannot; NULL or an error text.
static const char *check(struct job *job)
{
    int files = 0;
    while (job->files[files]) files++;
    if (!job->rest && companion_path(job->files[0], ".rest.obj", job->rest_found) &&
        access(job->rest_found, R_OK) == 0)
        job->rest = job->rest_found;
    if (!job->rest) return "--rest mesh.obj is missing: name the mesh at rest";
    if (job->pin && !region_parse(job->pin, &job->pinned)) return "--pin: expected " REGION_FORMS;
    if (!job->output) return "-o creature.glb is missing: name the file to write";
    if (job->from > 0 && method_of(job) == ANALYSIS_CPCA)
        return "--from has no effect with --method cpca: leave one out";
    if (!read_directions(job, files))
        return "--shake: expected up, side, front or a vector x,y,z; one for all files, or one per file (up:side)";
    return NULL;
}

int command_analyze(int argc, char **argv)
{
    struct job job = {.modes = 1, .opening = {.scale = 1}, .from = -1};
    const struct option_spec options[] = {
        {"--rest", NULL, "FILE",
         "mesh at rest (OBJ, STL, PLY, OFF, glTF), the same vertices in order (that of the simulation)", OPTION_INPUT,
         &job.rest, 0, 0},
        MESH_OPTIONS(&job.opening),
        {"--output", "-o", "FILE", "required: the character to write (.glb)", OPTION_OUTPUT, &job.output, 0, 0},
        {"--fps", NULL, "N", "frames per second (those of the file or of the simulation)", OPTION_REAL, &job.fps,
         1e-3, 100000},
        {"--modes", NULL, "K", "coordinates per motion, most important first (1)", OPTION_INT, &job.modes, 1,
         MODES_MAX},
        {"--no-normals", NULL, NULL, "leave out the morph targets' normals: a smaller file, the same in wiggly",
         OPTION_FLAG, &job.no_normals, 0, 0},
        {"--shake", NULL, "DIR",
         "direction of the shake: up, side, front or x,y,z; one for all or one per file, up:side (the simulation's)",
         OPTION_TEXT, &job.shake, 0, 0},
        {"--pin", NULL, "WHERE",
         "what holds the mesh, as in simulate: its motion is removed; none: nothing (the simulation's)", OPTION_TEXT,
         &job.pin, 0, 0},
        {"--method", NULL, "poles|cpca", "one coordinate per pole (default), or complex principal components",
         OPTION_WORD, &job.method, 0, 0},
        {"--from", NULL, "S", "the second when the drive stops: poles are found from there on (the simulation's)",
         OPTION_REAL, &job.from, 0, 1e6},
        {"--scene", NULL, "FILE", "also write a scene whose knots repeat the motions", OPTION_OUTPUT, &job.scene, 0,
         0},
        {"--coordinates", NULL, "FILE", "also write the time series of each coordinate and its spline, as CSV",
         OPTION_OUTPUT, &job.coordinates, 0, 0},
    };
    const struct usage usage = {
        .command = "analyze",
        .operands = "up.npy [side.npy ...]",
        .summary = "Finds the complex normal coordinate of each motion (.npy, .pc2, .mdd) and writes a character.",
        .options = options,
        .option_count = sizeof options / sizeof options[0],
        .operand_maximum = FILES_MAX,
    };
    enum options_result result = options_parse(&usage, argc, argv, job.files);
    if (result != OPTIONS_RUN) return (int)result;
    const char *wrong = check(&job);
    if (wrong) return (int)options_wrong(&usage, "%s", wrong);
    progress_end_when_interrupted();
    struct error error;
    return options_end(run(&job, &error), &error);
}
