/// Exports beside the frames.
#include "app/exporting.h"
#include "app/film.h"
#include "app/state.h"
#include "rig/models.h"
#include "scene/load.h"
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>

enum { WIDTH = 1280, HEIGHT = 720, SMALL_WIDTH = 640, SMALL_HEIGHT = 360 };
enum { MORPHS = CHOICE_KEYS | CHOICE_RIG | CHOICE_CLIP | CHOICE_SIGNED, POINTS = CHOICE_KEYS | CHOICE_RIG | CHOICE_ONE };

const struct dialog_format exporting_formats[] = {
    {".glb", "character and motion: Blender, three.js, game engines", .choices = MORPHS | CHOICE_CUBIC},
    {".gltf", "the same as readable text", .choices = MORPHS | CHOICE_CUBIC},
    {".usda", "character and motion: USD, Houdini, Omniverse", .choices = MORPHS},
    {".bvh", "joints and their motion: motion-capture tools", .choices = POINTS},
    {".csv", "every spline and angle as a table", .choices = CHOICE_KEYS | CHOICE_RIG},
    {".pc2", "every vertex at every key: Blender's Mesh Cache", .choices = POINTS},
    {".mdd", "the same for Maya, LightWave and others", .choices = POINTS},
    {".npy", "the same as an array: Python", .choices = POINTS},
    {".mp4", "a film that plays everywhere", CHOICE_SIZE, WIDTH, HEIGHT},
    {".webm", "a film for web pages", CHOICE_SIZE | CHOICE_ALPHA, WIDTH, HEIGHT},
    {".gif", "a small film that repeats: messages, README files", CHOICE_SIZE, SMALL_WIDTH, SMALL_HEIGHT},
    {".png", "a picture a frame, numbered", CHOICE_SIZE | CHOICE_ALPHA, WIDTH, HEIGHT},
};
const int exporting_format_count = sizeof exporting_formats / sizeof *exporting_formats;

struct exporting {
    struct request request;
    struct document *document; ///< a copy: the user may go on
    struct models *models;
    struct evaluation evaluation;
    struct film *film; ///< while it is drawn
    thrd_t thread;
    bool threaded; ///< it is to be waited for
    atomic_long done, total;
    atomic_bool stop, ended;
    bool good; ///< what the thread has come to
    struct error error;
    struct export_report report;
};

static struct document *parse_copy(const struct document *document, const char *text, size_t size,
                                   struct error *error)
{
    const char *end = memchr(text, '\0', size), *name = document->path ? document->path : "untitled";
    struct document *copy = scene_parse(name, text, end ? (size_t)(end - text) : size, NULL, error);
    if (!copy) return NULL;
    if (document->folder) copy->folder = strdup(document->folder);
    bool good = document_set_path(copy, document->path) || fail_no_memory(error, name);
    if (good && end) good = scene_parse_paint(copy, name, end + 1, size - (size_t)(end + 1 - text), error);
    if (good) return copy;
    document_destroy(copy);
    return NULL;
}

static struct document *copy_document(const struct document *document, struct error *error)
{
    char *text = NULL;
    size_t capacity = 0, size = 0;
    struct document *copy = NULL;
    if (scene_print_into(document, document->folder, &text, &capacity, &size) &&
        scene_print_paint(document, &text, &capacity, &size)) {
        copy = parse_copy(document, text, size, error);
    } else {
        fail_no_memory(error, "export");
    }
    free(text);
    return copy;
}

static bool proceed(void *user, long done, long total)
{
    struct exporting *exporting = user;
    atomic_store(&exporting->total, total);
    atomic_store(&exporting->done, done);
    return !atomic_load(&exporting->stop);
}

static bool write_motion(struct exporting *exporting)
{
    const struct export_wish *wish = &exporting->request.wish;
    const struct posing posing = {
        .document = exporting->document, .evaluation = &exporting->evaluation, .models = exporting->models};
    const struct export_options options = {.rig = wish->rig[0] ? wish->rig : NULL,
                                           .clip = wish->clip[0] ? wish->clip : NULL,
                                           .has_frames = wish->part,
                                           .first = wish->first,
                                           .last = wish->last,
                                           .substeps = wish->keys,
                                           .is_signed = wish->is_signed,
                                           .is_cubic = wish->is_cubic,
                                           .proceed = proceed,
                                           .user = exporting};
    return export_write(&posing, exporting->request.path, &options, &exporting->report, &exporting->error);
}

/// Solves the splines and reads the models.
static bool prepare(struct exporting *exporting)
{
    struct document *document = exporting->document;
    struct error *error = &exporting->error;
    if (!models_update(exporting->models, document, error) ||
        !evaluation_resize(&exporting->evaluation, document, error))
        return false;
    evaluation_update(&exporting->evaluation, document, NULL, false);
    models_paint(exporting->models, document);
    return true;
}

static int work(void *user)
{
    struct exporting *exporting = user;
    exporting->good = prepare(exporting);
    if (exporting->good && !film_knows(exporting->request.path)) exporting->good = write_motion(exporting);
    atomic_store(&exporting->ended, true);
    return 0;
}

static void destroy(struct exporting *exporting)
{
    if (exporting->threaded) thrd_join(exporting->thread, NULL);
    film_close(exporting->film);
    evaluation_free(&exporting->evaluation);
    models_destroy(exporting->models);
    document_destroy(exporting->document);
    free(exporting);
}

bool exporting_start(struct app *app, const struct request *request, struct error *error)
{
    if (app->exporting) return fail(error, ERROR_INPUT, "Another export is running.");
    struct exporting *exporting = calloc(1, sizeof *exporting);
    if (!exporting) return fail_no_memory(error, request->path);
    exporting->request = *request;
    exporting->document = copy_document(app->table.document, error);
    if (exporting->document && !(exporting->models = models_create())) fail_no_memory(error, request->path);
    if (exporting->models) {
        exporting->threaded = thrd_create(&exporting->thread, work, exporting) == thrd_success;
        if (!exporting->threaded) fail(error, ERROR_ENVIRONMENT, "%s: no thread can be started", request->path);
    }
    if (!exporting->threaded) {
        destroy(exporting);
        return false;
    }
    app->exporting = exporting;
    return true;
}

void exporting_stop(struct app *app)
{
    if (app->exporting) atomic_store(&app->exporting->stop, true);
}

static enum film_state begin_film(struct exporting *exporting)
{
    const struct export_wish *wish = &exporting->request.wish;
    const struct editor_world world = {
        .document = exporting->document, .evaluation = &exporting->evaluation, .models = exporting->models};
    const struct film_options options = {.width = wish->width,
                                         .height = wish->height,
                                         .has_frames = wish->part,
                                         .first = wish->first,
                                         .last = wish->last,
                                         .transparent = wish->transparent};
    exporting->film = film_open(&world, exporting->request.path, &options, &exporting->error);
    return exporting->film ? FILM_RUNS : FILM_FAILED;
}

/// FILM_RUNS while there is more to do, of whichever format.
static enum film_state go_on(struct exporting *exporting, bool wait)
{
    if (exporting->threaded) {
        if (!wait && !atomic_load(&exporting->ended)) return FILM_RUNS;
        thrd_join(exporting->thread, NULL);
        exporting->threaded = false;
        if (!exporting->good) return FILM_FAILED;
        if (!film_knows(exporting->request.path)) return FILM_DONE;
    }
    if (atomic_load(&exporting->stop)) {
        fail(&exporting->error, ERROR_ENVIRONMENT, "interrupted; nothing was written");
        return FILM_FAILED;
    }
    if (!exporting->film) return begin_film(exporting);
    enum film_state state = film_step(exporting->film, wait, &exporting->error);
    long done, total;
    film_progress(exporting->film, &done, &total);
    atomic_store(&exporting->total, total);
    atomic_store(&exporting->done, done);
    if (state == FILM_DONE) film_report(exporting->film, &exporting->report);
    return state;
}

static void answer(struct app *app, bool done)
{
    struct exporting *exporting = app->exporting;
    const struct request *request = &exporting->request;
    const struct export_report *report = &exporting->report;
    char text[sizeof request->path + 300];
    const bool stopped = !done && atomic_load(&exporting->stop);
    editor_answer(app->table.editor, request, done, stopped ? "Cancelled. Nothing was written." : exporting->error.text);
    if (!done) return;
    snprintf(text, sizeof text, "Wrote %s: %s.%s%s%s", request->path, report->text, *report->note ? " Note: " : "",
             report->note, *report->note ? "." : "");
    editor_message(app->table.editor, false, text);
    personal_note_export(app, request);
}

void exporting_step(struct app *app)
{
    struct exporting *exporting = app->exporting;
    if (!exporting) return;
    enum film_state state = go_on(exporting, app->fixed_clock);
    while (app->fixed_clock && state == FILM_RUNS) state = go_on(exporting, true);
    editor_tell_export(app->table.editor, atomic_load(&exporting->done), atomic_load(&exporting->total));
    if (state == FILM_RUNS) return;
    answer(app, state == FILM_DONE);
    exporting_free(app);
}

void exporting_free(struct app *app)
{
    exporting_stop(app);
    if (app->exporting) destroy(app->exporting);
    app->exporting = NULL;
}
