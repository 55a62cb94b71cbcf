/// Exports in the background.
#include "app/film.h"
#include "app/state.h"
#include "base/need.h"
#include "rig/import.h"
#include <stdatomic.h>
#include <stdlib.h>
#include <threads.h>

enum { WIDTH = 1280, HEIGHT = 720, SMALL_WIDTH = 640, SMALL_HEIGHT = 360 };
enum {
    MORPHS = CHOICE_KEYS | CHOICE_RIG | CHOICE_CLIP | CHOICE_SIGNED,
    POINTS = CHOICE_KEYS | CHOICE_RIG | CHOICE_ONE
};

const struct dialog_format exporting_formats[] = {
    {".glb", "character and motion: Blender, three.js, game engines", .choices = MORPHS | CHOICE_CUBIC},
    {".gltf", "the same as readable text", .choices = MORPHS | CHOICE_CUBIC},
    {".usda", "character and motion: USD, Houdini, Omniverse", .choices = MORPHS & ~CHOICE_CLIP},
    {".bvh", "joints and their motion: motion-capture tools", .choices = POINTS | CHOICE_JOINTS},
    {".csv", "every spline and angle as a table", .choices = CHOICE_KEYS | CHOICE_RIG},
    {".pc2", "every vertex at every key: Blender's Mesh Cache", .choices = POINTS},
    {".mdd", "the same for Maya, LightWave and others", .choices = POINTS},
    {".npy", "the same as an array: Python", .choices = POINTS},
    {".gif", "a small film that repeats: messages, README files", CHOICE_SIZE, SMALL_WIDTH, SMALL_HEIGHT,
     film_pictures},
    {".mp4", "a film that plays everywhere", CHOICE_SIZE, WIDTH, HEIGHT, film_pictures},
    {".webm", "a film for web pages", CHOICE_SIZE | CHOICE_ALPHA, WIDTH, HEIGHT, film_pictures},
    {".png", "one numbered picture per frame", CHOICE_SIZE | CHOICE_ALPHA, WIDTH, HEIGHT, film_pictures},
};
enum { FORMATS = sizeof exporting_formats / sizeof *exporting_formats };

int exporting_format_count(void)
{
    int count = FORMATS;
    while (!film_can(exporting_formats[count - 1].ending)) count--;
    return count;
}

struct export_job {
    struct request request;
    struct opened opened; ///< a copy of the document, so that you can go on editing
    struct film *film;    ///< while it is being drawn
    thrd_t thread;
    bool threaded; ///< the thread must be joined
    atomic_long done, total;
    atomic_bool stop, ended;
    bool prepared, good; ///< the thread's: solved; what it did last went well
    struct error error;
    struct export_report report;
};

static bool proceed(void *user, long done, long total)
{
    struct export_job *job = user;
    atomic_store(&job->total, total);
    atomic_store(&job->done, done);
    return !atomic_load(&job->stop);
}

static struct export_options options_of(struct export_job *job)
{
    const struct export_wish *wish = &job->request.wish;
    const char *path = job->request.path;
    const bool all_clips = wish->all_clips && (path_has_end(path, ".glb") || path_has_end(path, ".gltf"));
    const struct document *document = job->opened.document;
    const char *name = NULL;
    for (int i = 0; i < document->rig_count && wish->rig > 0; i++) {
        const struct rig *rig = document->rigs[i];
        if (rig->id == wish->rig) name = rig->name ? rig->name : rig_word(rig->kind);
    }
    return (struct export_options){.rig = name,
                                   .rig_choice = "\"rig\"",
                                   .clip = wish->clip[0] && !all_clips ? wish->clip : NULL,
                                   .all_clips = all_clips,
                                   .has_frames = wish->part && !all_clips,
                                   .first = wish->first,
                                   .last = wish->last,
                                   .substeps = wish->keys,
                                   .is_signed = wish->is_signed,
                                   .is_cubic = wish->is_cubic,
                                   .size = {wish->width, wish->height},
                                   .transparent = wish->transparent,
                                   .proceed = proceed,
                                   .user = job};
}

static bool write_motion(struct export_job *job)
{
    const struct posing posing = opened_posing(&job->opened);
    const struct export_options options = options_of(job);
    return export_write(&posing, job->request.path, &options, &job->report, &job->error);
}

static bool prepare(struct export_job *job)
{
    struct opened *opened = &job->opened;
    if (!models_update(opened->models, opened->document, &job->error)) return false;
    opened_solve(opened, SOLVER_BY_LENGTH);
    return true;
}

/// Solves, then writes.
static void work_on(struct export_job *job)
{
    job->good = job->prepared ? write_motion(job) : prepare(job);
    if (job->prepared || !job->good || film_knows(job->request.path)) atomic_store(&job->ended, true);
    job->prepared = true;
}

static int work(void *user)
{
    struct export_job *job = user;
    file_guard_reads(true);
    while (!atomic_load(&job->ended)) work_on(job);
    file_forget_reads(NULL);
    return 0;
}

static void destroy(struct export_job *job)
{
    if (job->threaded) thrd_join(job->thread, NULL);
    film_close(job->film);
    opened_free(&job->opened);
    free(job);
}

bool exporting_start(struct app *app, const struct request *request, struct error *error)
{
    if (app->export_job) return fail(error, ERROR_INPUT, "Another export is running.");
    if (!app->draw && film_knows(request->path))
        return fail(error, ERROR_ENVIRONMENT, "%s: pictures need OpenGL, which is missing", request->path);
    struct export_job *job = need_zeroed(1, sizeof *job);
    job->request = *request;
    struct opened *opened = &job->opened;
    opened->document = document_copy(app->table.document);
    opened->models = models_create();
    job->threaded = thrd_create(&job->thread, work, job) == thrd_success;
    app->export_job = job;
    return true;
}

void exporting_stop(struct app *app)
{
    if (app->export_job) atomic_store(&app->export_job->stop, true);
}

static enum film_state begin_film(struct export_job *job)
{
    const struct export_options options = options_of(job);
    job->film = film_open(&job->opened, job->request.path, &options, &job->error);
    return job->film ? FILM_RUNS : FILM_FAILED;
}

/// FILM_RUNS while any format has more to do.
static enum film_state go_on(struct export_job *job, bool wait)
{
    if (!job->film) {
        if (!job->threaded && !atomic_load(&job->ended)) work_on(job); // late frames are better than no export
        if (!(wait && job->threaded) && !atomic_load(&job->ended)) return FILM_RUNS;
        if (job->threaded) thrd_join(job->thread, NULL);
        job->threaded = false;
        if (!job->good) return FILM_FAILED;
        if (!film_knows(job->request.path)) return FILM_DONE;
    }
    if (atomic_load(&job->stop)) {
        fail(&job->error, ERROR_ENVIRONMENT, "interrupted; nothing was written");
        return FILM_FAILED;
    }
    if (!job->film) return begin_film(job);
    enum film_state state = film_step(job->film, wait, &job->error);
    long done, total;
    film_progress(job->film, &done, &total);
    atomic_store(&job->total, total);
    atomic_store(&job->done, done);
    if (state == FILM_DONE) film_report(job->film, &job->report);
    return state;
}

static void answer(struct app *app, bool done)
{
    struct export_job *job = app->export_job;
    const struct request *request = &job->request;
    const struct export_report *report = &job->report;
    const bool stopped = !done && atomic_load(&job->stop);
    editor_answer(app->table.editor, request, done, stopped ? "Cancelled. Nothing was written." : job->error.text);
    if (!done) return;
    core_message(&app->table.editor->core, false, "Wrote %s: %s.%s%s%s", request->path, report->text,
                 *report->note ? " Note: " : "", report->note, *report->note ? "." : "");
    personal_note_export(app, request);
}

void exporting_step(struct app *app)
{
    struct export_job *job = app->export_job;
    if (!job) return;
    enum film_state state = go_on(job, app->fixed_clock);
    while (app->fixed_clock && state == FILM_RUNS) state = go_on(job, true);
    dialogs_tell_export(app->table.editor->dialogs, atomic_load(&job->done), atomic_load(&job->total));
    if (state == FILM_RUNS) return;
    answer(app, state == FILM_DONE);
    app_stop_export(app);
}

bool exporting_draws(const struct app *app) { return app->export_job && app->export_job->film; }

void app_stop_export(struct app *app)
{
    exporting_stop(app);
    if (app->export_job) destroy(app->export_job);
    app->export_job = NULL;
}
