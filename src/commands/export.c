/// `wiggly export`: writes a scene's motion in other programs' formats.
#include "export/export.h"
#include "app/film.h"
#include "base/error.h"
#include "base/file.h"
#include "base/progress.h"
#include "commands/commands.h"
#include "commands/report.h"
#include "platform/process.h"
#include "rig/import.h"
#include "ui/theme.h"
#include <stdio.h>
#include <string.h>

struct job {
    const char *scene, *output, *frames;
    int theme; ///< index of the given word, from 1
    bool quiet, paint;
    struct progress progress;
};

static bool show_frames(void *user, long done, long total)
{
    struct job *job = user;
    if (!job->quiet) progress_show(&job->progress, done > 0 ? done : 1, total);
    return !process_was_told_to_end();
}

int command_export(int argc, char **argv)
{
    struct job job = {0};
    struct export_options o = {.proceed = show_frames, .user = &job};
    char endings[EXPORT_ENDINGS], output[EXPORT_ENDINGS + 16];
    export_endings(0, endings);
    snprintf(output, sizeof output, "required: %s", endings);
    const struct option_spec options[] = {
        {"-o, --output FILE", output, OPTION_OUTPUT, &job.output, 0, 0},
        {"--frames A:B", "frames A to B (default: all)", OPTION_TEXT, &job.frames, 0, 0},
        {"--fps N", "keys or pictures per second (default: a key per sample, a picture per frame)", OPTION_REAL,
         &o.rate, 1e-3, 1e5},
        {"--substeps N", "keys per frame, instead of --fps", OPTION_INT, &o.substeps, 1, 1024},
        {"--clip NAME", "the animation's name (default: the clip's, else the scene's)", OPTION_TEXT, &o.clip, 0, 0},
        {"--rig NAME", "export only this rig (default: all that the format can hold)", OPTION_TEXT, &o.rig, 0, 0},
        {"--all-clips", "put the chains on every clip of the character's file (.glb, .gltf)", OPTION_FLAG,
         &o.all_clips, 0, 0},
        {"--as-shown", "the size and place on the stage, not those of the character's file", OPTION_FLAG, &o.as_shown,
         0, 0},
        {"--signed", "one morph target instead of two, with weights of either sign; Blender clamps them", OPTION_FLAG,
         &o.is_signed, 0, 0},
        {"--size WxH", "size of films and pictures (1280x720; .gif 640x360)", OPTION_SIZE, o.size, 16, 8192},
        OPTION_THEME(&job.theme, "colours of films and pictures (dark)"),
        {"--loops N", "films: play a looping scene N times, each time without its last frame", OPTION_INT, &o.loops,
         1, 10000},
        {"--transparent", "only the rigs, no ground and no shadows (.png, .webm)", OPTION_FLAG, &o.transparent, 0, 0},
        {"--paint", "export a character's paint instead of its motion (.npy)", OPTION_FLAG, &job.paint, 0, 0},
        {"--quiet", "print nothing but errors and warnings", OPTION_FLAG, &job.quiet, 0, 0},
        {0},
    };
    const struct usage usage = {
        .command = "export",
        .operands = "scene.json",
        .summary = "Writes the motion of a scene for other programs. The file's extension chooses the format.",
        .options = options,
    };
    const int result = options_parse(&usage, argc, argv, &job.scene);
    if (result != OPTIONS_RUN) return result;

    int end = 0;
    if (!job.output) return options_wrong(&usage, "-o FILE is missing: name the file to write");
    if (!export_format(job.output))
        return options_wrong(&usage, "--output: expected a name ending in %s, got '%s'", endings, job.output);
    if (job.paint && !path_has_end(job.output, ".npy"))
        return options_wrong(&usage, "--paint: expected an output that ends in .npy, got '%s'", job.output);
    o.has_frames = job.frames != NULL;
    if (job.frames && (sscanf(job.frames, "%lf:%lf%n", &o.first, &o.last, &end) != 2 || job.frames[end]))
        return options_wrong(&usage, "--frames: expected FIRST:LAST, such as 0:48, got '%s'", job.frames);
    if (o.all_clips && (o.clip || job.frames))
        return options_wrong(&usage,
                             "--all-clips keeps names and frames of clips: give it without --clip and --frames");
    if (o.rate > 0 && o.substeps > 0)
        return options_wrong(&usage, "--fps and --substeps both set the number of keys: give one");

    process_catch_end();
    struct opened opened;
    struct error error;
    if (!opened_read(&opened, job.scene, &error)) return options_end(false, &error);
    const struct document *document = opened.document;
    bool done = true;
    if (job.paint) { // of the named character, or of the first one with paint
        const struct paint *paint = NULL;
        for (int i = -1; !paint && (i = document_next_rig(document, RIG_MODEL, i)) >= 0;) {
            if (!o.rig || strcmp(rig_title(document->rigs[i]), o.rig) == 0) paint = document->rigs[i]->model.painted;
        }
        done = paint ? paint_write(paint, job.output, &error)
                     : fail(&error, ERROR_INPUT, "%s: expected paint on %s, got none", job.scene,
                            o.rig ? o.rig : "a character");
        if (done && !job.quiet)
            print_line(stdout, "wrote %s: paint on %d coordinates of %d vertices", job.output, paint->coordinates,
                       paint->vertices);
    } else {
        struct export_report report;
        document_set_path(opened.document, job.scene);
        opened_solve(&opened, SOLVER_BY_LENGTH);
        const struct posing posing = opened_posing(&opened);
        job.progress.started = clock_now();
        if (job.theme) theme_use((enum theme_kind)(job.theme - 1));
        done = export_format(job.output)->film ? film_write(&opened, job.output, &o, &report, &error)
                                               : export_write(&posing, job.output, &o, &report, &error);
        if (!done) progress_clear(&job.progress);
        if (done && *report.note) print_line(stderr, "%s: warning: %s", job.output, report.note);
        if (done && !job.quiet) print_line(stdout, "wrote %s: %s", job.output, report.text);
    }
    opened_free(&opened);
    return options_end(done, &error);
}
