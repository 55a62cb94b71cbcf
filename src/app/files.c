/// Carries out the editor's requests about files, exports, clipboard, window and quitting. Notices when another program writes the
/// document's file.
#include "app/film.h"
#include "app/state.h"
#include "base/embedded.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/need.h"
#include "editor/editor.h"
#include "rig/import.h"
#include "scene/load.h"
#include <dirent.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <threads.h>
#include <unistd.h>

// --- exports: a thread solves and writes a copy of the document; films are drawn frame by frame

int exporting_format_count(void)
{
    int count = EXPORT_FORMATS;
    // A browser has no ffmpeg, and would make a download of each picture of many.
    while (platform_in_page() && export_formats[count - 1].film > FILM_GIF) count--;
    return count;
}

static bool is_film(const char *path) { return export_format(path)->film != FILM_NONE; }

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
    const bool all_clips = wish->all_clips && (export_format(path)->choices & CHOICE_CLIPS);
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
                                   .size = {wish->width, wish->height},
                                   .transparent = wish->transparent,
                                   .proceed = proceed,
                                   .user = job};
}

/// Solves, then writes.
static void work_on_job(struct export_job *job)
{
    struct opened *opened = &job->opened;
    if (job->prepared) {
        const struct posing posing = opened_posing(opened);
        const struct export_options options = options_of(job);
        job->good = export_write(&posing, job->request.path, &options, &job->report, &job->error);
    } else {
        job->good = models_update(opened->models, opened->document, &job->error);
        if (job->good) opened_solve(opened, SOLVER_BY_LENGTH);
    }
    if (job->prepared || !job->good || is_film(job->request.path)) atomic_store(&job->ended, true);
    job->prepared = true;
}

static int run_job(void *user)
{
    struct export_job *job = user;
    file_guard_reads(true);
    while (!atomic_load(&job->ended)) work_on_job(job);
    file_forget_reads(NULL);
    return 0;
}

/// FILM_RUNS while any format has more to do.
static enum film_state continue_job(struct export_job *job, bool wait)
{
    if (!job->film) {
        if (!job->threaded && !atomic_load(&job->ended)) work_on_job(job); // late frames are better than no export
        if (!(wait && job->threaded) && !atomic_load(&job->ended)) return FILM_RUNS;
        if (job->threaded) thrd_join(job->thread, NULL);
        job->threaded = false;
        if (!job->good) return FILM_FAILED;
        if (!is_film(job->request.path)) return FILM_DONE;
    }
    if (!job->film) {
        const struct export_options options = options_of(job);
        job->film = film_open(&job->opened, job->request.path, &options, &job->error);
        return job->film ? FILM_RUNS : FILM_FAILED;
    }
    const enum film_state state = film_step(job->film, wait, &job->error);
    if (state == FILM_DONE) film_report(job->film, &job->report);
    return state;
}

void exporting_step(struct app *app)
{
    struct export_job *job = app->export_job;
    if (!job) return;
    enum film_state state = continue_job(job, app->fixed_clock);
    while (app->fixed_clock && state == FILM_RUNS) state = continue_job(job, true);
    app->figures.done = atomic_load(&job->done);
    app->figures.total = atomic_load(&job->total);
    if (state == FILM_RUNS) return;
    const struct request *request = &job->request;
    const struct export_report *report = &job->report;
    const bool done = state == FILM_DONE, stopped = !done && atomic_load(&job->stop);
    editor_answer(app->work.editor, request, done, stopped ? "Cancelled. Nothing was written." : job->error.text);
    if (done) {
        editor_message(app->work.editor, false, "Wrote %s: %s.%s%s%s", request->path, report->text,
                       *report->note ? " Note: " : "", report->note, *report->note ? "." : "");
        personal_note_export(app, request);
    }
    app_stop_export(app);
}

bool exporting_draws(const struct app *app) { return app->export_job && app->export_job->film; }

void app_stop_export(struct app *app)
{
    struct export_job *job = app->export_job;
    if (!job) return;
    atomic_store(&job->stop, true);
    if (job->threaded) thrd_join(job->thread, NULL);
    film_close(job->film);
    opened_free(&job->opened);
    free(job);
    app->export_job = NULL;
}

// --- files

/// The scene "New" opens: a spline without knots, and a tail that follows it.
static const char new_scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.1,"
    " \"wind_up\": 0.5, \"knots\": [{\"frame\": 0, \"value\": 0}]}],"
    " \"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"position\": [0, 0.26, 0], \"rest\": 2,"
    " \"spline\": \"sway\"}]}";

/// In a browser, the first of the recent files: opens the browser's own dialog.
#define ELSEWHERE "On this device …"

/// Relative to the program's folder. The installed path comes first, because a folder beside it could have unrelated assets/scenes.
static const char *const places[] = {"../share/wiggly/scenes", "../assets/scenes", "../../assets/scenes",
                                     "../../../assets/scenes"};

/// Finds the folder of the bundled scenes; false if there is none.
static bool assets_folder(char folder[PATH_LIMIT])
{
    char program[PATH_LIMIT], beside[PATH_LIMIT];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length < 0) return false;
    program[length] = '\0';
    if (!path_folder(program, beside)) return false;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        if (path_resolve(beside, places[i], folder) && access(folder, F_OK) == 0) return true;
    }
    return false;
}

/// Whether a file, after following links, is in the folder of bundled scenes. A folder can be mounted twice, so its identity counts.
static bool assets_has(const char *path)
{
    char file[PATH_LIMIT], folder[PATH_LIMIT], own[PATH_LIMIT];
    struct stat a, b;
    return realpath(path, file) && path_folder(file, folder) && assets_folder(own) && stat(folder, &a) == 0 &&
           stat(own, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

const char *app_path(const struct app *app) { return app->work.document->path ? app->work.document->path : ""; }

/// Content hash of the document's file if another program changed it; 0: unchanged, or gone.
static uint64_t changed_content(const struct app *app)
{
    const uint64_t now = app_path(app)[0] ? file_content(app_path(app)) : 0;
    return now == app->own_file.content ? 0 : now;
}

/// Asks about a changed file. `saves`: the user tried to save, so the question replaces saving.
static bool ask_changed(struct app *app, bool saves)
{
    return dialogs_ask_changed(editor_dialogs(app->work.editor), path_name(app_path(app)), saves);
}

void file_watch_look(struct app *app)
{
    const uint64_t now = changed_content(app);
    if (now == 0 || now == app->own_file.asked) return;
    if (ask_changed(app, false)) app->own_file.asked = now;
}

static void show_title(struct app *app)
{
    const char *name = app_path(app)[0] ? path_name(app_path(app)) : "untitled";
    char title[512], shown[400];
    printable(name, shown, sizeof shown);
    app->shown_saved = history_is_saved(app->work.history);
    snprintf(title, sizeof title, "%s%s — wiggly", app->shown_saved ? "" : "*", shown);
    platform_title(app->platform, title);
}

enum { DESCRIPTION = 1024, NAMED = 12 }; ///< bytes; names of a kind

static const char *end_of_names(int count) { return count == 0 ? "nothing" : count > NAMED ? " and more" : ""; }

void app_show_title(struct app *app)
{
    if (history_is_saved(app->work.history) != app->shown_saved) show_title(app);
    if (!platform_in_page()) return;

    // For a screen reader: what is shown.
    const struct document *document = app->work.document;
    const int rigs = document->rig_count, splines = document->spline_count;
    char text[DESCRIPTION] = "On the stage: ";
    for (int r = 0; r < rigs && r < NAMED; r++)
        print_more(text, DESCRIPTION, "%s%s", r ? ", " : "", rig_title(document->rigs[r]));
    print_more(text, DESCRIPTION, "%s%s", end_of_names(rigs), ". Splines: ");
    for (int s = 0; s < splines && s < NAMED; s++)
        print_more(text, DESCRIPTION, "%s%s", s ? ", " : "", document->splines[s]->name);
    print_more(text, DESCRIPTION, "%s%s", end_of_names(splines),
               editor_shown(app->work.editor).plays ? ". It plays." : ". It is paused.");
    const uint64_t hash = hash_bytes(HASH_START, text, strlen(text));
    if (hash != app->described) platform_describe(app->platform, text);
    app->described = hash;
}

void app_adopt(struct app *app, struct document *document)
{
    flesh_stop(app);
    if (app->personal) file_forget_reads(NULL); // of the scene before
    document_destroy(app->work.document);
    app->work.document = document;
    document->serial = ++app->last_serial;
    app->own_file.content = app->own_file.asked = 0;
    history_clear(app->work.history, document);
    history_mark_saved(app->work.history);
    struct editor_world world = workspace_world(&app->work);
    editor_open(app->work.editor, &world);
    if (scene_has_meadow(document))
        editor_message(app->work.editor, false, "Meadows are no longer shown; the file keeps them.");
    show_title(app);
}

/// Built-in scenes find their models in the folder of bundled scenes.
static struct document *parse_built_in(const char *name, struct error *error)
{
    char path[64], folder[PATH_LIMIT];
    snprintf(path, sizeof path, "scenes/%s", name);
    const struct embedded *file = embedded_find(path);
    struct document *document = scene_parse(name, (const char *)file->data, file->size, NULL, error);
    if (document && assets_folder(folder)) document->folder = need_text(folder);
    return document;
}

/// Shows the subject of a paper's figure.
static void show_subject(struct app *app, const char *name)
{
    editor_show_subject(app->work.editor, strcmp(name, "figure2.json") == 0, strcmp(name, "figure3.json") == 0);
}

bool app_open(struct app *app, const char *path, struct error *error)
{
    if (path && strlen(path) >= PATH_LIMIT)
        return fail(error, ERROR_INPUT, "expected a path of at most %d bytes, got %zu: %s", PATH_LIMIT - 1,
                    strlen(path), path);
    const bool imports = path && import_suits(path);
    const uint64_t content =
        path && !imports ? file_content(path) : 0; // before parsing: a later write is another program's
    struct document *document = imports ? import_scene(path, error)
                                : path  ? scene_load(path, NULL, error)
                                        : parse_built_in("tail.json", error);
    if (!document) return false;
    // Saving must overwrite neither a character's file nor a bundled scene.
    bool is_users = path && !imports && !assets_has(path);
    if (is_users) document_set_path(document, path);
    app_adopt(app, document);
    if (path && !is_users) show_subject(app, path_name(path));
    app->own_file.content = content;
    personal_note_file(app, imports ? path : app_path(app));
    return true;
}

bool app_place_file(const struct app *app, const char *path, char placed[PATH_LIMIT], struct error *error)
{
    const char *saves = app->options->saves, *name = path_name(path);
    const bool is_name = *name && strcmp(name, ".") != 0 && strcmp(name, "..") != 0;
    const int length = !app->replay ? snprintf(placed, PATH_LIMIT, "%s", path)
                       : saves      ? snprintf(placed, PATH_LIMIT, "%s/%s", saves, name)
                                    : snprintf(placed, PATH_LIMIT, "%s", "");
    return (is_name && length < PATH_LIMIT) || fail(error, ERROR_INPUT, "%s: expected the path of a file", path);
}

void app_tell_placed(struct app *app, const char *placed)
{
    if (placed[0])
        editor_message(app->work.editor, false, "Saved %s.", placed);
    else
        editor_message(app->work.editor, false, "Nothing was written: a replay writes only with --saves DIR.");
}

static bool save(struct app *app, const char *path, struct error *error)
{
    char placed[PATH_LIMIT];
    if (!app_place_file(app, path, placed, error)) return false;
    if (placed[0] && (!file_check_place(placed, error) || !scene_save(app->work.document, placed, error)))
        return false;
    history_set_path(app->work.history, path);
    history_mark_saved(app->work.history);
    app->own_file.content = file_content(app_path(app));
    show_title(app);
    personal_note_file(app, app_path(app));
    editor_message(app->work.editor, false, "Saved.");
    if (app->replay) app_tell_placed(app, placed);
    return true;
}

/// F12: saves to the first free wiggly-NNNN.png, in the scene's folder, else the working folder.
static bool take_picture(struct app *app, struct error *error)
{
    char folder[PATH_LIMIT], name[32], path[PATH_LIMIT], placed[PATH_LIMIT];
    int number = 0;
    if (!path_folder(app_path(app), folder)) folder[0] = '\0';
    do {
        snprintf(name, sizeof name, "wiggly-%04d.png", ++number);
        if (!path_resolve(folder, name, path)) return fail(error, ERROR_INPUT, "%s: the path is too long", folder);
        if (!app_place_file(app, path, placed, error)) return false;
    } while (placed[0] && access(placed, F_OK) == 0);
    if (placed[0] && !app_screenshot(app, placed, error)) return false;
    app_tell_placed(app, placed);
    return true;
}

/// Refuses to write over what the document is read from (its models or, for an export, its own file), and once over another existing file, which it allows when repeated.
static bool may_replace(struct app *app, const struct request *request, struct error *error)
{
    char path[PATH_LIMIT];
    const bool is_download = platform_in_page() && request->kind == REQUEST_EXPORT; // the browser replaces no file
    const struct document *document = app->work.document;
    bool is_read = request->kind == REQUEST_EXPORT && file_same(request->path, app_path(app));
    for (int r = 0; r < document->rig_count && !is_read; r++)
        is_read = document_model_path(document, r, path) && file_same(request->path, path);
    is_read |= document_background_path(document, path) && file_same(request->path, path);
    if (is_read)
        return fail(error, ERROR_INPUT, "%s: this scene is read from it: choose another name", request->path);
    if (!app_place_file(app, request->path, path, error) || !file_check_unread(path, error)) return false;
    if (access(path, F_OK) != 0 || strcmp(request->path, app_path(app)) == 0 || strcmp(path, app->replaceable) == 0 ||
        is_download)
        return true;
    snprintf(app->replaceable, sizeof app->replaceable, "%s", path);
    return fail(error, ERROR_INPUT, "%s already exists: press Enter again to replace it", path);
}

/// Starts an export; exporting_step() answers when it is done.
static bool start_export(struct app *app, const struct request *request, struct error *error)
{
    struct request placed = *request;
    if (!app_place_file(app, request->path, placed.path, error)) return false;
    if (!placed.path[0]) {
        editor_answer(app->work.editor, request, true, "");
        app_tell_placed(app, placed.path);
        return true;
    }
    if (app->export_job) return fail(error, ERROR_INPUT, "Another export is running.");
    if (!app->draw && is_film(placed.path))
        return fail(error, ERROR_ENVIRONMENT, "%s: pictures need OpenGL, which is missing", placed.path);
    struct export_job *job = need_zeroed(1, sizeof *job);
    job->request = placed;
    job->opened.document = document_copy(app->work.document);
    job->opened.models = models_create();
    job->threaded = thrd_create(&job->thread, run_job, job) == thrd_success;
    app->export_job = job;
    return true;
}

static bool do_request(struct app *app, const struct request *request, struct error *error)
{
    switch (request->kind) {
    case REQUEST_NONE:
        return true;
    case REQUEST_NEW: {
        struct document *document = scene_parse("new", new_scene, sizeof new_scene - 1, NULL, error);
        if (!document) return false;
        app_adopt(app, document);
        return true;
    }
    case REQUEST_FIGURE: { // of the paper, the dog or the hands, untitled
        static const char *const names[] = {"figure1.json", "figure2.json", "figure3.json",
                                            "figure4.json", "figure5.json", "figure6.json",
                                            "figure7.json", "dog.json",     "hands.json"};
        const char *name = names[request->number - 1];
        struct document *document = parse_built_in(name, error);
        if (!document) return false;
        app_adopt(app, document);
        show_subject(app, name);
        return true;
    }
    case REQUEST_OPEN:
        if (strcmp(request->path, ELSEWHERE) != 0) return app_open(app, request->path, error);
        platform_choose_file(app->platform);
        return true;
    case REQUEST_ADD: {
        editor_let_go(app->work.editor);
        struct document *document = app->work.document;
        const bool behind = background_suits(request->path);
        char whole[PATH_LIMIT], file[PATH_LIMIT]; // relative even where it is chosen by its whole path
        if (!path_resolve(NULL, request->path, whole) || !path_rebase(whole + 1, "/", document->folder, file))
            strcpy(file, request->path);
        if (!*file) strcpy(file, "."); // the scene's own folder
        history_begin(app->work.history, behind ? "Set background" : "Add character", 0);
        const bool added =
            behind ? edit_background(document, &(struct background_file){.file = file}, error) &&
                         background_follow(models_background(app->work.models), document, !app->fixed_clock, error)
                   : import_add(document, request->path, request->number, error);
        if (!added) history_restart(app->work.history);
        history_end(app->work.history);
        editor_refresh(app->work.editor);
        if (added && !behind) editor_show_last(app->work.editor);
        return added;
    }
    case REQUEST_SAVE:
    case REQUEST_OVERWRITE:
        return save(app, app_path(app), error);
    case REQUEST_SAVE_AS:
        return may_replace(app, request, error) && save(app, request->path, error);
    case REQUEST_KEEP_MINE:
        app->own_file.content = file_content(app_path(app));
        history_mark_unsaved(app->work.history);
        return true;
    case REQUEST_THEIRS: { // undo brings back the document
        struct document *document = scene_load(app_path(app), NULL, error);
        if (!document) return false;
        document_set_path(document, app_path(app));
        document->serial = ++app->last_serial;
        editor_let_go(app->work.editor); // a drag may have begun since
        history_begin(app->work.history, "Take theirs", 0);
        document_become(app->work.document, document);
        history_end(app->work.history);
        history_mark_saved(app->work.history);
        editor_refresh(app->work.editor);
        show_title(app);
        app->own_file.content = file_content(app_path(app));
        return true;
    }
    case REQUEST_EXPORT:
        return may_replace(app, request, error) && start_export(app, request, error);
    case REQUEST_EXPORT_STOP:
        if (app->export_job) atomic_store(&app->export_job->stop, true);
        return true;
    case REQUEST_FLESH:
        return flesh_start(app, request, error);
    case REQUEST_QUIT:
        app->quit = true;
        return true;
    case REQUEST_RECOVER:
        return personal_recover(app, error);
    case REQUEST_FORGET:
        personal_forget(app);
        return true;
    case REQUEST_SCREENSHOT:
        return take_picture(app, error);
    case REQUEST_SHARE: {
        size_t size;
        char *scene = scene_print(app->work.document, app->work.document->folder, NULL, &size);
        platform_share(app->platform, scene);
        free(scene);
        return true;
    }
    case REQUEST_FULLSCREEN:
        platform_toggle_fullscreen(app->platform);
        return true;
    case REQUEST_UI_SCALE:
        return ui_scale_step(app, request->number, error);
    case REQUEST_COPY:
        // a replay must leave the user's clipboard alone
        if (!app->replay) platform_set_clipboard(app->platform, request->text);
        return true;
    case REQUEST_PASTE:
        app->paste = !app->replay; /* a replay has the text that was pasted when it was recorded */
        return true;
    }
    return true;
}

static void carry_out(void *user, const struct request *request)
{
    struct app *app = user;
    struct error error = {0};
    const bool saves = request->kind == REQUEST_SAVE ||
                       (request->kind == REQUEST_SAVE_AS && strcmp(request->path, app_path(app)) == 0);
    if (saves && changed_content(app) && ask_changed(app, true)) return;
    const bool done = do_request(app, request, &error);
    const bool goes_on = done && request->kind == REQUEST_EXPORT;
    if (!goes_on) editor_answer(app->work.editor, request, done, error.text);
}

static int compare_names(const void *a, const void *b) { return strcmp(a, b); }

static int list_folder(void *user, const char *folder, char names[][256], int max)
{
    (void)user;
    DIR *directory = opendir(folder[0] ? folder : ".");
    if (!directory) return -1;
    int count = 0;
    struct dirent *entry;
    while (count < max && (entry = readdir(directory)) != NULL) {
        char path[PATH_LIMIT + 256];
        struct stat status;
        snprintf(path, sizeof path, "%s/%s", folder[0] ? folder : ".", entry->d_name);
        if (entry->d_name[0] == '.' || strlen(entry->d_name) > 254 || stat(path, &status) != 0) continue;
        bool is_folder = S_ISDIR(status.st_mode);
        if (is_folder || path_has_end(path, ".json") || path_has_end(path, ".glb") || path_has_end(path, ".gltf") ||
            background_suits(path))
            snprintf(names[count++], 256, "%.254s%s", entry->d_name, is_folder ? "/" : "");
    }
    closedir(directory);
    qsort(names, (size_t)count, sizeof names[0], compare_names);
    return count;
}

static int list_recent(void *user, struct dialog_recent *list, int max)
{
    const int first = platform_in_page();
    if (first) list[0] = (struct dialog_recent){.path = ELSEWHERE};
    return first + personal_recent(user, list + first, max - first);
}

void app_open_editor(struct app *app)
{
    editor_destroy(app->work.editor);
    app->work.editor = editor_create(&(struct editor_app){.user = app,
                                                          .carry_out = carry_out,
                                                          .list = list_folder,
                                                          .recent = list_recent,
                                                          .format_count = exporting_format_count(),
                                                          .in_page = platform_in_page(),
                                                          .still = app->options->still,
                                                          .stats = app->options->stats,
                                                          .figures = &app->figures});
    app->work.evaluation.solver = app->options->solver;
    ui_scale_fit(app);
}
