/// `wiggly analyze`: turns simulated motions into a character with complex normal coordinates.
#include "analysis/analysis.h"
#include "base/error.h"
#include "base/file.h"
#include "base/names.h"
#include "base/need.h"
#include "commands/commands.h"
#include "commands/companion.h"
#include "commands/report.h"
#include "model/adjacency.h"
#include "model/character.h"
#include "scene/edit.h"
#include "scene/load.h"
#include "scene/warnings.h"
#include "simulation/soft.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILES_MAX = 16, MODES_MAX = ANALYSIS_MODES_MAX, KNOTS_ADDED = 128 };

static const double recommended_bandwidth = 0.1; ///< the spline's default; an analysis of one oscillation cannot tell
static const double fast_warning = 0.01;         ///< share of power near half the frame rate that causes a warning
static const double rigid_warning = 0.5;         ///< share of a coordinate that is a rigid motion of a loose mesh
static const double least_sag = 0.01;            ///< of the swing: a nearer middle leaves the mesh at rest as it is
static const double poor = 0.4;                  ///< error of a motion for which something better is sought
static const double better = 0.8;                ///< times that error: what is worth saying
static const double still = 0.01;                ///< of a coordinate's reach: a vertex that moves less is held
static const double together = 10;               ///< degrees between the lags of parts that move as one
static const double fast_pole = 0.8;             ///< share of half the frame rate; higher frequencies cause a warning

struct job {
    const char *files[FILES_MAX + 1]; ///< NULL-terminated
    const char *rest, *output, *scene, *coordinates, *shake, *pin;
    char rest_found[COMPANION_PATH]; ///< NAME.rest.obj beside the first motion, used unless `rest` is given
    struct mesh_options opening;     ///< of `rest`
    double fps;                      ///< 0: from the files
    enum analysis_method method;
    int modes;
    bool no_normals, straight;
    double lag;           ///< degrees by which the part farthest from what holds the mesh is delayed
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
    struct analysis_plan plan;
    struct analysis analysis;
};

/// Analysis results of a coordinate that its file does not hold.
struct analyzed {
    int rank; ///< rank within its motion, from 0
    double fps;
    const struct component *component; ///< of the open input
    struct knots knots;
};

struct result {
    struct character character;
    struct analyzed *analyzed; ///< one per coordinate
    int filled;                ///< coordinates so far
};

/// Rounded to a millionth, so that files do not depend on the processor LAPACK ran on.
static double rounded(double value) { return round(value * 1e6) / 1e6; }

/// Warns of what makes an analysis wrong or hard to use.
static void warn_of_input(const struct input *in, const struct surface *rest)
{
    const struct analysis *a = &in->analysis;
    const char *path = in->motion.path;

    // A motion centred far from the rest mesh may have other axes, units or an offset.
    double centre[3] = {0}, distance = 0, size = 0;
    for (int n = 0; n < 3 * rest->vertex_count; n++) {
        double at = (double)rest->position[n / 3][n % 3];
        centre[n % 3] += at / rest->vertex_count;
    }
    for (int n = 0; n < 3 * rest->vertex_count; n++) {
        double at = (double)rest->position[n / 3][n % 3], away = a->middle[n / 3][n % 3] - at;
        distance += away * away;
        size += (at - centre[n % 3]) * (at - centre[n % 3]);
    }
    if (distance > 0.25 * size)
        print_line(stderr, "%s: warning: the motion is not centred on the rest mesh; check axes, units and position",
                   path);

    // Frequencies close to half the frame rate are measured badly; those above are not seen.
    const double fastest = fast_pole * in->fps / 2;
    bool fast = a->fast_share > fast_warning;
    for (int k = 0; k < a->count; k++) fast |= a->components[k].frequency > fastest;
    if (fast) {
        print_line(stderr,
                   "%s: warning: parts move faster than %g fps can show (%.1f %% of the motion above %.4g Hz); "
                   "simulate with more frames per second",
                   path, in->fps, 100 * a->fast_share, fastest);
    }

    // A driven motion is no sum of free swings. The method may then find two large motions that nearly cancel.
    if (a->cancelled > 0) {
        print_line(stderr,
                   "%s: warning: left out %d pole%s that only cancel others; if something drives the mesh, "
                   "set --from to the second when it stops, or use --method cpca",
                   path, a->cancelled, a->cancelled > 1 ? "s" : "");
    }

    // Of a mesh that is not known to be held, a coordinate may be a rigid motion.
    for (int k = 0; in->base.base_unknown && k < a->count; k++) {
        const double share = rigid_share((const double complex(*)[3])a->components[k].shape, rest);
        if (share < rigid_warning) continue;
        print_line(stderr,
                   "%s: warning: %.0f %% of coordinate %d moves the whole mesh rigidly; if something carries it, "
                   "name that with "
                   "--pin, or remove all such motion with --pin none",
                   path, 100 * share, k + 1);
    }
}

/// Σ |middle − rest|² over vertices and frames, and the largest distance.
static double offset_of(const double (*middle)[3], const struct character *character, int frames, double *farthest)
{
    double offset = *farthest = 0;
    for (int v = 0; v < character->vertex_count; v++) {
        double square = 0;
        for (int c = 0; c < 3; c++) square += pow(middle[v][c] - (double)character->position[v][c], 2);
        *farthest = fmax(*farthest, sqrt(square));
        offset += frames * square;
    }
    return offset;
}

/// The relative error of a motion from that about its middle, which is `offset` from the character's rest.
static double error_with(double left, const struct analysis *a, double offset)
{
    return sqrt((left * left * a->power + offset) / (a->power + offset));
}

/// Says what would leave less of a motion that is hardly explained: more coordinates, else CPCA.
static void seek_better(const struct input *in, double offset, const struct lapack *lapack)
{
    const struct analysis *a = &in->analysis;
    struct analysis_plan tried = in->plan, best = tried;
    double least = a->left;
    for (int other = 0; other < 2 && least > poor; other++) {
        bool found = true;
        if (other) tried.method = ANALYSIS_CPCA, tried.first = 0;
        for (tried.modes = in->plan.modes + !other; found && least > poor && tried.modes <= MODES_MAX;
             tried.modes++) {
            struct analysis more = {0};
            struct error ignored;
            found = analysis_create(&more, lapack, &in->motion, &tried, &ignored) && more.count == tried.modes;
            if (found && more.left < least) least = more.left, best = tried;
            pool_free(&more.pool);
        }
    }
    if (least < better * a->left)
        printf("  with --modes %d%s: %.3g\n", best.modes, best.method == in->plan.method ? "" : " --method cpca",
               error_with(least, a, offset));
    else if (a->left > poor)
        printf("  neither more coordinates nor --method cpca would leave much less\n");
}

static double apart(const float a[3], const float b[3])
{
    return hypot(hypot((double)a[0] - (double)b[0], (double)a[1] - (double)b[1]), (double)a[2] - (double)b[2]);
}

/// Delays the vertices of a coordinate by their distance along the surface from those that it hardly moves: the farthest by `lag` degrees.
static void delay(struct component *c, const struct character *character, double lag)
{
    struct pool pool = {0};
    const float(*at)[3] = (const float(*)[3])character->position;
    const struct adjacency edges = adjacency_create(&pool, at, (const float(*)[3])character->normal, c->vertices,
                                                    character->indices, character->index_count);
    double *away = pool_take(&pool, (size_t)c->vertices, sizeof *away), least = INFINITY, farthest = 0;
    for (int v = 0; v < c->vertices; v++) {
        away[v] = hypot(hypot(cabs(c->shape[v][0]), cabs(c->shape[v][1])), cabs(c->shape[v][2]));
        least = fmin(least, away[v]);
    }
    for (int v = 0; v < c->vertices; v++) away[v] = away[v] <= fmax(least, still * c->reach) ? 0 : INFINITY;
    for (bool nearer = true; nearer;) {
        nearer = false;
        for (int v = 0; v < c->vertices; v++) {
            for (int e = edges.first[v]; e < edges.first[v + 1]; e++) {
                const uint32_t other = edges.other[e];
                const double way = away[other] + apart(at[v], at[other]);
                nearer |= way < away[v];
                away[v] = fmin(away[v], way);
            }
        }
    }
    for (int v = 0; v < c->vertices; v++) farthest = isfinite(away[v]) ? fmax(farthest, away[v]) : farthest;
    for (int v = 0; v < c->vertices; v++) {
        int from = v; // the nearest vertex of the part that is held, for one of another part
        for (int o = 0; !isfinite(away[v]) && o < c->vertices; o++) {
            if (isfinite(away[o]) && (from == v || apart(at[v], at[o]) < apart(at[v], at[from]))) from = o;
        }
        const double complex turn = farthest > 0 ? cexp(-I * lag * M_PI / 180 * away[from] / farthest) : 1;
        for (int k = 0; k < 3; k++) {
            c->shape[v][k] *= turn;
            if (c->bend) c->bend[v][k] *= turn * turn;
        }
    }
    pool_free(&pool);
    component_lags(c);
}

/// Keeps a motion's components as coordinates, and reports on each. Time series and knots are for the scene and the table alone.
static void keep_components(const struct job *job, const struct input *in, double left, struct result *result)
{
    const struct analysis *analysis = &in->analysis;
    struct character *character = &result->character;
    const char *base = path_name(in->motion.path), *dot = strrchr(base, '.');
    const size_t length = dot ? (size_t)(dot - base) : strlen(base);
    char *stem = length > 0 ? name_from(base, length) : need_text("motion");
    struct names names = {.between = "-"}; // "up", then "up-2" … for further modes
    for (int i = 0; i < result->filled; i++) names_add(&names, character->coordinates[i].name);
    for (int rank = 0; rank < analysis->count; rank++) {
        struct coordinate *to = &character->coordinates[result->filled];
        struct analyzed *analyzed = &result->analyzed[result->filled++];
        struct component *c = &analysis->components[rank];
        to->name = need_text(names_add(&names, stem));
        to->frequency = rounded(c->frequency);
        to->damping = rounded(c->damping);
        to->explained = rounded(c->explained);
        to->pca1 = rounded(analysis->pca1);
        to->pca2 = rounded(analysis->pca2);
        if (job->lag != 0)
            delay(c, character, job->lag); // the knots go by the time series and the motion's own shape
        for (int n = 0; n < 3 * c->vertices; n++) {
            to->re[n / 3][n % 3] = (float)creal(c->shape[n / 3][n % 3]);
            to->im[n / 3][n % 3] = (float)cimag(c->shape[n / 3][n % 3]);
        }
        to->most = 2; // twice the largest |z| of the time series, which is 1
        if (c->lift && !character_curve(character, result->filled - 1)) need_failed();
        for (int n = 0; c->lift && n < 3 * c->vertices; n++) {
            to->sq[n / 3][n % 3] = (float)c->lift[n / 3][n % 3];
            to->re2[n / 3][n % 3] = (float)creal(c->bend[n / 3][n % 3]);
            to->im2[n / 3][n % 3] = (float)cimag(c->bend[n / 3][n % 3]);
        }
        *analyzed = (struct analyzed){.rank = rank, .fps = in->fps, .component = c};
        const struct knots *knots = job->scene || job->coordinates ? &analyzed->knots : NULL;
        if (knots) knots_create(&analyzed->knots, c, in->fps);

        double along[3];
        for (int k = 0; k < 3; k++) along[k] = printable_number(c->direction[k], 0.01);
        print_line(stdout, "  %s: explains %.2f %%; real PCA's first %.2f %%, its first two %.2f %%", to->name,
                   100 * to->explained, 100 * to->pca1, 100 * to->pca2);
        printf("    frequency %.4g Hz, damping ratio %.3g; mostly along (%.2f, %.2f, %.2f), %.3g m at most\n",
               c->frequency, c->damping, along[0], along[1], along[2], c->reach);
        if (knots) {
            char last[32] = "";
            if (knots->last_frequency != knots->frequency)
                snprintf(last, sizeof last, " to %.4g", knots->last_frequency);
            printf("    spline: \"mode\": \"%s\", \"frequency\": %.4g%s, \"damping\": %.3g, \"bandwidth\": %.3g, %d "
                   "knot%s\n",
                   knots->mode == WIGGLY_REAL ? "real" : "complex", knots->frequency, last, knots->damping,
                   knots->bandwidth, knots->count, knots->count > 1 ? "s" : "");
            printf(
                "    relative error of its motion: %.3g by this spline, %.3g by the coordinate's own time series\n",
                knots->error, component_error(c, c->series));
        } else {
            printf("    spline: \"mode\": \"complex\", \"frequency\": %.4g, \"damping\": %.3g, \"bandwidth\": %g\n",
                   c->frequency, c->damping, recommended_bandwidth);
        }
        printf("    lag over the surface: from %.0f to %.0f degrees, with 5 %% of the motion beyond each end\n",
               printable_number(c->first_lag, 1), printable_number(c->last_lag, 1));
        if (job->lag == 0 && c->last_lag - c->first_lag < together)
            puts("    parts hardly lag: --lag 60 delays them by their distance from what holds the mesh");
    }
    names_free(&names);
    free(stem);
    printf("  relative error of the motion with %d coordinate%s: %.3g; as many real principal components: %.3g\n",
           analysis->count, analysis->count > 1 ? "s" : "", left, analysis->real_left);
    if (analysis->left < analysis->straight)
        printf("    its shapes are curved; with --straight: %.3g\n", analysis->straight);
}

/// Writes a scene for the character file `model`, with one spline per coordinate, as many coordinates as a scene allows. The first
/// coordinate of every motion comes before the second of any.
static bool analyze_write_scene(const char *path, const char *model, const struct character *character,
                                const struct analyzed *analyzed, struct error *error)
{
    char folder[PATH_LIMIT], name[] = "character", *file = need_text(path_name(model));
    struct document *document = document_create();
    if (path_folder(model, folder) && folder[0]) document->folder = need_text(folder);
    struct drive drives[MODEL_MAX_DRIVES];
    struct rig rig = {
        .kind = RIG_MODEL, .name = name, .model = {.model = file, .scale = 1, .phases = -1, .drives = drives}};
    int chosen[MODEL_MAX_DRIVES], count = 0;
    double fps = 0, seconds = 0;
    for (int rank = 0; rank < character->coordinate_count; rank++) {
        for (int i = 0; i < character->coordinate_count && count < MODEL_MAX_DRIVES; i++) {
            if (analyzed[i].rank == rank) chosen[count++] = i;
        }
    }
    for (int i = 0; i < count; i++) {
        const struct analyzed *each = &analyzed[chosen[i]];
        fps = fmax(fps, each->fps);
        seconds = fmax(seconds, (each->component->frames - 1) / each->fps);
    }
    bool done = edit_fps(document, fps, false, error) &&
                edit_range(document, 0, (int)round(fps * seconds), RANGE_REFUSE, error);
    for (int i = 0; done && i < count; i++) {
        char *driver = character->coordinates[chosen[i]].name;
        const struct analyzed *each = &analyzed[chosen[i]];
        const struct knots *knots = &each->knots;
        const struct {
            enum parameter parameter;
            double value;
        } set[] = {{PARAMETER_MODE, knots->mode},
                   {PARAMETER_FREQUENCY, knots->frequency},
                   {PARAMETER_DAMPING, knots->damping},
                   {PARAMETER_WIND_UP, 0}, // the fit is to the whole curve
                   {PARAMETER_BANDWIDTH, knots->bandwidth}};
        drives[rig.model.drive_count++] = (struct drive){.name = driver, .spline = i, .amplitude = 1};
        done = edit_spline_add(document, -1, driver, NULL, error);
        for (int p = 0; done && p < (knots->mode == WIGGLY_COMPLEX ? 5 : 4); p++) {
            const struct param value = param_number(set[p].value);
            done = edit_parameter(document, i, set[p].parameter, &value, error);
        }
        for (int k = 0; done && k < knots->count; k++) {
            const double frame = knots->frame[k] * document->fps / each->fps;
            const struct knot knot = {.frame = round(frame * 1000) / 1000,
                                      .value = knots->value[k],
                                      .slope = knots->sloped ? knots->slope[k] : 0,
                                      .has_slope = knots->sloped,
                                      .stiffness = KNOT_DEFAULT_STIFFNESS};
            done = edit_knot_insert(document, i, &knot, error);
        }
    }
    for (int i = 0; done && i < count; i++) { // a frequency that changes is a spline of its own: a straight line
        const struct analyzed *each = &analyzed[chosen[i]];
        const struct knots *knots = &each->knots;
        const struct param cubic = param_number(WIGGLY_CUBIC), track = param_track(document->spline_count);
        const double end = round((each->component->frames - 1) * document->fps / each->fps);
        const double slope = (knots->last_frequency - knots->frequency) * document->fps / end;
        char called[256];
        if (slope == 0) continue;
        snprintf(called, sizeof called, "%.200s frequency", character->coordinates[chosen[i]].name);
        done = edit_spline_add(document, -1, called, NULL, error) &&
               edit_parameter(document, track.track, PARAMETER_MODE, &cubic, error) &&
               edit_parameter(document, i, PARAMETER_FREQUENCY, &track, error);
        for (int k = 0; done && k < 2; k++) {
            const struct knot knot = {k * end, k == 0 ? knots->frequency : knots->last_frequency, .has_slope = true,
                                      .slope = slope, .stiffness = KNOT_DEFAULT_STIFFNESS};
            done = edit_knot_insert(document, track.track, &knot, error);
        }
    }

    // Where the app would warn of a far swing or of a drift, a knot on the curve, which so stays as it is. After the last knot the curve
    // follows one pole, from that as a pose.
    struct evaluation evaluation = {0};
    for (int added = 0; done && added < KNOTS_ADDED; added++) {
        struct warnings found = {0};
        evaluation_update(&evaluation, document, false);
        for (int i = 0; i < count; i++) warnings_add(document, &evaluation, i, &found);
        int w = 0;
        while (w < found.count && found.list[w].kind != WARNING_FAR && found.list[w].kind != WARNING_DRIFT) w++;
        if (w == found.count) break;
        const struct spline *spline = document->splines[found.list[w].spline];
        const struct knot *last = &spline->knots[spline->knot_count - 1];
        struct knot knot = {
            .frame = found.list[w].frame, .value = found.list[w].value, .stiffness = KNOT_DEFAULT_STIFFNESS};
        if (knot.frame > last->frame && spline_mode(spline) == WIGGLY_COMPLEX) {
            const int sample = document_sample(document, last->frame);
            knot = *last;
            knot.has_slope = false;
            knot.has_phase = true;
            knot.phase = evaluation.curves[found.list[w].spline].im[sample];
            done = edit_knot_set(document, found.list[w].spline, &knot, error);
        } else {
            done = edit_knot_insert(document, found.list[w].spline, &knot, error);
        }
    }
    evaluation_free(&evaluation);
    done = done && edit_rig_add(document, &rig, error) && scene_save(document, path, error);
    document_destroy(document);
    free(file);
    return done;
}

/// Writes R and the spline's x of every coordinate, one row per frame, as CSV: frame, NAME.re, NAME.im, NAME.fit.re, NAME.fit.im.
/// Fields stay empty after a motion's end.
static bool analyze_write_coordinates(const char *path, const struct character *character,
                                      const struct analyzed *analyzed, struct error *error)
{
    static const char *const suffixes[] = {".re", ".im", ".fit.re", ".fit.im"};
    const int count = character->coordinate_count;
    struct file_output output;
    int frames = 0;
    if (!file_output_open(&output, path, error)) return false;
    FILE *out = output.stream;
    fputs("frame", out);
    for (int i = 0; i < 4 * count; i++) {
        fputc(',', out);
        print_field(out, character->coordinates[i / 4].name, suffixes[i % 4]);
    }
    fputc('\n', out);
    for (int i = 0; i < count; i++)
        frames = analyzed[i].component->frames > frames ? analyzed[i].component->frames : frames;
    for (int t = 0; t < frames && !ferror(out); t++) {
        fprintf(out, "%d", t);
        for (int i = 0; i < count; i++) {
            const struct component *c = analyzed[i].component;
            if (t >= c->frames) {
                fputs(",,,,", out);
                continue;
            }
            const double complex r = c->series[t], x = analyzed[i].knots.series[t];
            fprintf(out, ",%.9g,%.9g,%.9g,%.9g", creal(r), cimag(r), creal(x), cimag(x));
        }
        fputc('\n', out);
    }
    return file_output_commit(&output, error);
}

/// Opens and analyses a motion; the mesh at rest is the character's. The base is what --pin names, else what a simulation pinned, else what
/// rests.
static bool analyse_file(const struct job *job, int file, const struct character *character,
                         const struct lapack *lapack, struct input *in, struct error *error)
{
    const struct surface resting = {.position = character->position,
                                    .color = character->color,
                                    .vertex_count = character->vertex_count,
                                    .indices = character->indices,
                                    .index_count = character->index_count};
    const struct motion *motion = &in->motion;
    if (!motion_open(&in->motion, job->files[file], error)) return false;
    if (motion->vertices != resting.vertex_count)
        return fail(error, ERROR_INPUT, "%s: expected %d vertices as %s has, got %d", motion->path,
                    resting.vertex_count, job->rest, motion->vertices);
    if (!companion_read(motion->path, motion->frames, motion->vertices, &in->made, error)) return false;
    in->fps = job->fps > 0 ? job->fps : motion->fps > 0 ? motion->fps : in->made.fps;
    if (!(in->fps > 0)) return fail(error, ERROR_USAGE, "%s: the file has no frame rate: give --fps N", motion->path);

    const bool simulated = in->made.frames > 0, is_known = job->pin || simulated;
    struct region region = job->pinned;
    if (!job->pin && simulated && !region_parse(in->made.pin, &region))
        return fail(error, ERROR_INPUT, "%s: expected a region in what simulate wrote beside it, got \"%s\"",
                    motion->path, in->made.pin);
    if (job->pin || !simulated || in->made.world || region.kind == REGION_NONE) { // else the motion is from the base
        bool *pinned = need((size_t)resting.vertex_count + 1, sizeof *pinned);
        for (int v = 0; v < resting.vertex_count; v++) pinned[v] = region.kind == REGION_NONE;
        bool found =
            !is_known || region.kind == REGION_NONE || region_vertices(&region, &resting, pinned) > 0 ||
            fail(error, ERROR_INPUT, "%s: no vertex is in the region of --pin: name one that holds some", job->rest);
        found = found && rigid_find(&in->base, lapack, motion, &resting, is_known ? pinned : NULL, error);
        free(pinned);
        if (!found) return false;
    }
    const double driven = job->from >= 0 ? job->from * in->fps : in->made.from * in->made.fps; // frames
    in->plan = (struct analysis_plan){
        .method = job->method,
        .fps = in->fps,
        .modes = job->modes,
        .first = job->method == ANALYSIS_CPCA ? 0 : (int)fmin(ceil(driven), ANALYSIS_FRAMES_MAX),
        .direction = job->direction_count > 0 ? job->directions[job->direction_count > 1 ? file : 0]
                     : simulated              ? in->made.shake
                                              : NULL,
        .base = &in->base,
        .straight = job->straight,
    };
    if (!analysis_create(&in->analysis, lapack, &in->motion, &in->plan, error)) return false;
    warn_of_input(in, &resting);
    return true;
}

static bool analyse_files(const struct job *job, int files, struct error *error)
{
    struct surface rest;
    struct result result = {0};
    struct character *character = &result.character;
    struct lapack lapack;
    char description[128];
    if (!lapack_load(&lapack, description, sizeof description))
        return fail(error, ERROR_ENVIRONMENT, "LAPACKE and OpenBLAS: %s", description);
    bool done = open_mesh(job->rest, &job->opening, &rest, error);
    if (done) {
        result.analyzed = need_zeroed((size_t)(files * job->modes), sizeof *result.analyzed);
        done = character_create(character, &rest, files * job->modes) || fail_no_memory(error, job->rest);
    }
    struct input in[FILES_MAX] = {0};
    for (int f = 0; f < files; f++) in[f].motion.file = -1;
    for (int f = 0; done && f < files; f++) done = analyse_file(job, f, character, &lapack, &in[f], error);
    double moved =
        0; // how far the rest that the motions swing about, on average over all frames, is from the mesh at rest at most
    if (done) {
        double(*middle)[3] = need_zeroed((size_t)character->vertex_count + 1, sizeof *middle), power = 0;
        int frames = 0;
        for (int f = 0; f < files; f++) frames += in[f].motion.frames;
        for (int f = 0; f < files; f++) {
            power += in[f].analysis.power;
            for (int n = 0; n < 3 * character->vertex_count; n++)
                middle[n / 3][n % 3] += in[f].analysis.middle[n / 3][n % 3] * in[f].motion.frames / frames;
        }
        const double offset = offset_of((const double(*)[3])middle, character, frames, &moved);
        if (offset <= least_sag * least_sag * power) moved = 0; // so near that the character keeps the mesh
        for (int n = 0; moved > 0 && n < 3 * character->vertex_count; n++)
            character->position[n / 3][n % 3] = (float)middle[n / 3][n % 3];
        if (moved > 0) character_find_normals(character);
        free(middle);
    }
    for (int f = 0; done && f < files; f++) { // appends the file's coordinates
        const struct motion *motion = &in[f].motion;
        const struct rigid *base = &in[f].base;
        const struct analysis *a = &in[f].analysis;
        double away;
        const double offset = offset_of((const double(*)[3])a->middle, character, motion->frames, &away);
        print_line(stdout, "%s: %d frames of %d vertices at %g fps", motion->path, motion->frames, motion->vertices,
                   in[f].fps);
        if (base->frames > 0)
            printf("  removed the motion of the %s: up to %.3g m and %.3g degrees\n",
                   base->whole ? "whole mesh" : "base", printable_number(base->travel, 1e-4),
                   printable_number(base->angle, 0.01));
        if (a->count < job->modes)
            printf("  %d of %d coordinates: the motion has no more poles that matter\n", a->count, job->modes);
        if (offset > least_sag * least_sag * a->power)
            printf("  swings about a shape up to %.3g m from the character's rest: that counts as error\n", away);
        keep_components(job, &in[f], error_with(a->left, a, offset), &result);
        seek_better(&in[f], offset, &lapack);
    }
    if (moved > 0)
        print_line(stdout, "%s: its rest is what the motion swings about, up to %.3g m from %s", job->output, moved,
                   job->rest);
    while (done && character->coordinate_count > result.filled) { // those without poles
        struct coordinate *last = &character->coordinates[--character->coordinate_count];
        for (int p = 0; p < COORDINATE_PARTS; p++) free(last->parts[p]);
    }

    // All files are written or none, though more was read than the command line named.
    done = done && (!job->scene || file_check_unread(job->scene, error)) &&
           (!job->coordinates || file_check_unread(job->coordinates, error)) &&
           character_write(job->output, character, !job->no_normals, error) &&
           (!job->scene || analyze_write_scene(job->scene, job->output, character, result.analyzed, error)) &&
           (!job->coordinates || analyze_write_coordinates(job->coordinates, character, result.analyzed, error));
    for (int f = 0; f < files; f++) {
        pool_free(&in[f].analysis.pool);
        pool_free(&in[f].base.pool);
        motion_close(&in[f].motion);
    }
    for (int i = 0; i < result.filled; i++) free(result.analyzed[i].knots.series);
    free(result.analyzed);
    character_free(character);
    surface_free(&rest);
    lapack_unload(&lapack);
    return done;
}

int command_analyze(int argc, char **argv)
{
    struct job job = {.modes = 1, .opening = {.scale = 1}, .from = -1};
    int method = 0;
    const struct option_spec options[] = {
        {"--rest FILE",
         "mesh at rest (OBJ, STL, PLY, OFF, glTF), the same vertices in order (that of the simulation)", OPTION_INPUT,
         &job.rest, 0, 0},
        MESH_OPTIONS(&job.opening),
        {"-o, --output FILE", "required: the character to write (.glb)", OPTION_OUTPUT, &job.output, 0, 0},
        {"--fps N", "frames per second (those of the file or of the simulation)", OPTION_REAL, &job.fps, 1e-3,
         100000},
        {"--modes K", "coordinates per motion, most important first (1)", OPTION_INT, &job.modes, 1, MODES_MAX},
        {"--no-normals", "leave out the morph targets' normals: a smaller file, the same in wiggly", OPTION_FLAG,
         &job.no_normals, 0, 0},
        {"--straight", "no curved shapes, even where vertices swing on arcs: eq. 29 of the paper alone", OPTION_FLAG,
         &job.straight, 0, 0},
        {"--shake DIR",
         "direction of the shake: up, side, front or x,y,z; one for all or one per file, up:side "
         "(the simulation's)",
         OPTION_TEXT, &job.shake, 0, 0},
        {"--pin WHERE",
         "what holds the mesh, as in simulate: its motion is removed; none: nothing (the simulation's)", OPTION_TEXT,
         &job.pin, 0, 0},
        {"--method poles|cpca", "one coordinate per pole (default), or complex principal components", OPTION_WORD,
         &method, 0, 0},
        {"--from S", "the second when the drive stops: poles are found from there on (the simulation's)", OPTION_REAL,
         &job.from, 0, 1e6},
        {"--lag DEGREES", "delay parts by their distance from what holds the mesh, the farthest by so much (0)",
         OPTION_REAL, &job.lag, -3600, 3600},
        {"--scene FILE", "also write a scene whose knots repeat the motions", OPTION_OUTPUT, &job.scene, 0, 0},
        {"--coordinates FILE", "also write the time series of each coordinate and its spline, as CSV", OPTION_OUTPUT,
         &job.coordinates, 0, 0},
        {0},
    };
    const struct usage usage = {
        .command = "analyze",
        .operands = "up.npy [side.npy ...]",
        .summary = "Finds the complex normal coordinate of each motion (.npy, .pc2, .mdd) and writes a character.",
        .options = options,
        .operand_maximum = FILES_MAX,
    };
    const int result = options_parse(&usage, argc, argv, job.files);
    if (result != OPTIONS_RUN) return result;

    int files = 0;
    job.method = method == 2 ? ANALYSIS_CPCA : ANALYSIS_POLES;
    while (job.files[files]) files++;
    if (!job.rest && companion_path(job.files[0], ".rest.obj", job.rest_found) && access(job.rest_found, R_OK) == 0)
        job.rest = job.rest_found;

    // --shake is split at colons: one direction for all files, or one per file.
    bool is_directed = true;
    const char *at = job.shake;
    while (at && is_directed && job.direction_count < files) {
        char part[64];
        const size_t length = strcspn(at, ":");
        snprintf(part, sizeof part, "%.*s", (int)length, at);
        is_directed = length < sizeof part && options_direction(part, job.directions[job.direction_count++]);
        at = at[length] ? at + length + 1 : NULL;
    }
    is_directed = is_directed && !at && (job.direction_count <= 1 || job.direction_count == files);
    const char *wrong = NULL;
    if (!job.rest)
        wrong = "--rest mesh.obj is missing: name the mesh at rest";
    else if (job.pin && !region_parse(job.pin, &job.pinned))
        wrong = "--pin: expected " REGION_FORMS;
    else if (!job.output)
        wrong = "-o creature.glb is missing: name the file to write";
    else if (job.from > 0 && job.method == ANALYSIS_CPCA)
        wrong = "--from has no effect with --method cpca: leave one out";
    else if (!is_directed)
        wrong = "--shake: expected up, side, front or a vector x,y,z; one for all files, or one per file (up:side)";
    if (wrong) return options_wrong(&usage, "%s", wrong);
    progress_end_when_interrupted();
    struct error error;
    return options_end(analyse_files(&job, files, &error), &error);
}
