/// Makes flesh: this program's own command runs beside the app, so that you can go on editing, and if memory runs out only the command ends.
#include "app/state.h"
#include "base/child.h"
#include "base/need.h"
#include "rig/import.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct flesh_job {
    struct child child;
    unsigned rig; ///< its id
    char *model;  ///< its file when the job began, as the scene has it
    char *part;   ///< a bone, or a file of paint; NULL: the whole mesh
    bool painted; ///< it is that file, which goes with the job
    char output[PATH_LIMIT];
};

/// The first free of "walk-flesh.glb", "walk-flesh-2.glb" … beside the scene, for a model "walk.glb" or one of these.
static bool name_output(const struct app *app, const char *model, char output[PATH_LIMIT], struct error *error)
{
    char folder[PATH_LIMIT], name[PATH_LIMIT], path[PATH_LIMIT];
    const char *const stem = path_name(model), *const dot = strrchr(stem, '.'), *const flesh = strstr(stem, "-flesh");
    const size_t length = flesh ? (size_t)(flesh - stem) : dot ? (size_t)(dot - stem) : strlen(stem);
    if (!path_folder(app_path(app), folder)) folder[0] = '\0';
    for (int number = 1; number == 1 || access(output, F_OK) == 0; number++) {
        snprintf(name, sizeof name, number > 1 ? "%.*s-flesh-%d.glb" : "%.*s-flesh.glb", (int)length, stem, number);
        if (!path_resolve(folder, name, path)) return fail(error, ERROR_INPUT, "%s: the path is too long", folder);
        if (!app_place_file(app, path, output, error)) return false;
    }
    return file_check_place(output, error);
}

/// If paint raises an amplitude somewhere, a temporary file of it becomes the part.
static bool choose_by_paint(struct flesh_job *job, const struct paint *paint, struct error *error)
{
    const size_t count = paint ? (size_t)paint->coordinates * (size_t)paint->vertices : 0;
    size_t n = 0;
    while (n < count && !(paint->values[n][0] > 0)) n++;
    if (n == count) return true;
    job->part = need_text("/tmp/wiggly-XXXXXX.npy");
    const int file = mkstemps(job->part, (int)strlen(".npy"));
    if (file < 0) return fail(error, ERROR_ENVIRONMENT, "%s: cannot be written", job->part);
    job->painted = true;
    close(file);
    return paint_write(paint, job->part, error);
}

bool flesh_start(struct app *app, const struct request *request, struct error *error)
{
    char model[PATH_LIMIT];
    if (app->flesh) {
        flesh_stop(app);
        editor_message(app->work.editor, false, "Stopped. Nothing was written.");
        return true;
    }
    if (platform_in_page()) return fail(error, ERROR_INPUT, "Flesh is made by the desktop app.");
    if (!app_path(app)[0]) return fail(error, ERROR_INPUT, "Save the scene first: flesh is written beside it.");
    if (app->replay && !app->options->saves) {
        app_tell_placed(app, "");
        return true;
    }
    const struct document *document = app->work.document;
    const struct rig *rig = document->rigs[request->number];
    struct flesh_job *job = app->flesh = need_zeroed(1, sizeof *job);
    job->rig = rig->id;
    job->model = need_text(rig->model.model);
    if (request->text) job->part = need_text(request->text);
    bool good = name_output(app, job->model, job->output, error) &&
                (job->part || choose_by_paint(job, rig->model.painted, error));
    if (good) {
        char *const arguments[] = {"/proc/self/exe", "flesh", model, "-o", job->output, job->part ? "--part" : NULL,
                                   job->part,        NULL};
        document_model_path(document, request->number, model);
        const int cause = child_start(&job->child, arguments, -1, -1);
        good = cause == 0 || fail(error, ERROR_ENVIRONMENT, "flesh cannot be made: %s", strerror(cause));
    }
    if (good)
        editor_message(app->work.editor, false, "Making flesh of %s. Run the command again to stop.",
                       request->text ? request->text : rig_title(rig));
    else
        flesh_stop(app);
    return good;
}

/// The file is there: shows the character by it, in one undo step.
static void take_flesh(struct app *app, const struct flesh_job *job)
{
    struct document *document = app->work.document;
    struct error error;
    int rig = 0;
    editor_let_go(app->work.editor); // a drag may run
    while (rig < document->rig_count && document->rigs[rig]->id != job->rig) rig++;
    if (rig == document->rig_count || strcmp(document->rigs[rig]->model.model, job->model) != 0) {
        editor_message(app->work.editor, true, "Wrote %s, but its character is no longer here.", job->output);
        return;
    }
    const int before = document->rigs[rig]->model.drive_count;
    history_begin(app->work.history, "Make flesh", 0);
    const bool done = import_flesh(document, rig, job->output, job->painted, &error);
    if (!done) history_restart(app->work.history);
    history_end(app->work.history);
    editor_refresh(app->work.editor);
    const int added = document->rigs[rig]->model.drive_count - before;
    if (done)
        editor_message(app->work.editor, false, "Made flesh: %d channel%s of %s, in %s.", added,
                       added == 1 ? "" : "s", rig_title(document->rigs[rig]), path_name(job->output));
    else
        editor_message(app->work.editor, true, "%s", error.text);
}

void flesh_step(struct app *app)
{
    enum { PATIENCE = 100 }; // milliseconds
    struct flesh_job *job = app->flesh;
    if (!job) return;
    enum child_state state = child_state(&job->child, 0);
    while (app->fixed_clock && state == CHILD_RUNS) state = child_state(&job->child, PATIENCE);
    if (state == CHILD_RUNS) return;
    if (state == CHILD_DONE) {
        take_flesh(app, job);
    } else {
        static const char command[] = "wiggly flesh: ";
        char words[400];
        child_last_words(&job->child, words, sizeof words);
        const bool named = strncmp(words, command, strlen(command)) == 0;
        editor_message(app->work.editor, true, "%s", words + (named ? strlen(command) : 0));
    }
    flesh_stop(app);
}

void flesh_stop(struct app *app)
{
    struct flesh_job *job = app->flesh;
    if (!job) return;
    child_end(&job->child);
    if (job->painted) unlink(job->part);
    free(job->part);
    free(job->model);
    free(job);
    app->flesh = NULL;
}
