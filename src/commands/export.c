/// wiggly export: writes the motion of a scene into the files of other programs.
#include "export/export.h"
#include "base/clock.h"
#include "commands/commands.h"
#include "commands/options.h"
#include "commands/progress.h"
#include "rig/models.h"
#include "scene/load.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct job {
    const char *scene, *output, *frames, *keys;
    struct export_options options;
    bool quiet;
    struct progress progress;
};

static bool proceed(void *user, long done, long total)
{
    struct job *job = user;
    if (!job->quiet) progress_show(&job->progress, done, total);
    return !progress_interrupted();
}

static bool write_export(struct job *job, const struct posing *posing, struct error *error)
{
    struct export_report report;
    job->options.proceed = proceed;
    job->options.user = job;
    job->progress.started = clock_now();
    const bool done = export_write(posing, job->output, &job->options, &report, error);
    if (!done) progress_clear(&job->progress);
    if (done && *report.note) fprintf(stderr, "%s: warning: %s\n", job->output, report.note);
    if (done && !job->quiet) printf("wrote %s: %s\n", job->output, report.text);
    return done;
}

/// Solves the splines and reads the models.
static bool export_document(struct job *job, struct document *document, struct error *error)
{
    struct evaluation evaluation = {0};
    struct models *models = models_create();
    bool done = models ? scene_read_paint(document, error) : fail_no_memory(error, job->scene);
    done = done && models_update(models, document, error) && evaluation_resize(&evaluation, document, error);
    if (done) {
        const struct posing posing = {.document = document, .evaluation = &evaluation, .models = models};
        evaluation_update(&evaluation, document, NULL, false);
        done = write_export(job, &posing, error);
    }
    evaluation_free(&evaluation);
    models_destroy(models);
    return done;
}

static bool run(struct job *job, struct error *error)
{
    struct document *document = scene_load(job->scene, NULL, error);
    if (!document) return false;
    const bool done = document_set_path(document, job->scene) ? export_document(job, document, error)
                                                              : fail_no_memory(error, job->scene);
    document_destroy(document);
    return done;
}

/// "A:B"
static bool read_frames(const char *text, struct export_options *options)
{
    int end = 0;
    options->has_frames = true;
    return sscanf(text, "%lf:%lf%n", &options->first, &options->last, &end) == 2 && text[end] == '\0';
}

/// Checks what the table of options cannot.
static enum options_result check(const struct usage *usage, struct job *job)
{
    char endings[EXPORT_ENDINGS];
    if (!job->output) return options_wrong(usage, "-o FILE is missing: name the file to write");
    export_endings(endings);
    if (!export_knows(job->output))
        return options_wrong(usage, "--output: expected a name ending in %s, got '%s'", endings, job->output);
    if (job->frames && !read_frames(job->frames, &job->options))
        return options_wrong(usage, "--frames: expected FIRST:LAST, such as 0:48, got '%s'", job->frames);
    if (job->options.rate > 0 && job->options.substeps > 0)
        return options_wrong(usage, "--fps and --substeps both say how many keys there are: give one");
    job->options.is_cubic = strcmp(job->keys, "cubic") == 0;
    if (!job->options.is_cubic && strcmp(job->keys, "linear") != 0)
        return options_wrong(usage, "--keys: expected linear or cubic, got '%s'", job->keys);
    return OPTIONS_RUN;
}

int command_export(int argc, char **argv)
{
    struct job job = {.keys = "linear"};
    struct export_options *o = &job.options;
    const struct option_spec options[] = {
        {"--output", "-o", "FILE", "required: .glb, .gltf, .usda, .bvh, .csv, .pc2, .mdd or .npy, by its name's end",
         OPTION_TEXT, &job.output, 0, 0},
        {"--frames", NULL, "A:B", "from frame A to frame B (default: all)", OPTION_TEXT, &job.frames, 0, 0},
        {"--fps", NULL, "N", "N keys a second (default: one a sample of the scene)", OPTION_REAL, &o->rate, 1e-3,
         1e5},
        {"--substeps", NULL, "N", "N keys a frame, instead of --fps", OPTION_INT, &o->substeps, 1, 1024},
        {"--clip", NULL, "NAME", "what the animation is called (default: as the scene's file)", OPTION_TEXT, &o->clip,
         0, 0},
        {"--rig", NULL, "NAME", "that rig alone (default: all that the file can hold)", OPTION_TEXT, &o->rig, 0, 0},
        {"--signed", NULL, NULL, "one morph target instead of two, with weights of either sign; Blender clamps them",
         OPTION_FLAG, &o->is_signed, 0, 0},
        {"--keys", NULL, "KIND", "linear (default) or cubic, with tangents (.glb, .gltf)", OPTION_TEXT, &job.keys, 0,
         0},
        {"--quiet", NULL, NULL, "print nothing but errors and warnings", OPTION_FLAG, &job.quiet, 0, 0},
    };
    const struct usage usage = {
        .command = "export",
        .operands = "scene.json",
        .summary = "Writes the motion of a scene into a file of another program's, by the end of its name.",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .operand_minimum = 1,
        .operand_maximum = 1,
    };
    enum options_result result = options_parse(&usage, argc, argv, &job.scene);
    if (result == OPTIONS_RUN) result = check(&usage, &job);
    if (result != OPTIONS_RUN) return (int)result;
    progress_catch_interrupts();
    struct error error;
    if (run(&job, &error)) return 0;
    fprintf(stderr, "%s\n", error.text);
    return (int)error.kind;
}
