/// Starts the app, runs its frames and ends it.
#include "app/app.h"
#include "app/state.h"
#include "base/need.h"
#include "base/progress.h"
#include "platform/process.h"
#include "rig/import.h"
#include "scene/load.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <sys/stat.h>

enum { DEFAULT_WIDTH = 1280, DEFAULT_HEIGHT = 720, HEADLESS_FRAMES = 1200, WARM_UP = 10, REFERENCE_FRAMES = 21 };
enum { LOG_ROWS = 200000 };

/// Whether events come from a file and frames run as fast as they can.
static bool is_replay(const struct app *app) { return app->replay && !app->demo.on; }

/// Opens a window; if that fails, prints why and runs headless.
static bool open_platform(struct app *app, struct error *error)
{
    const struct app_options *o = app->options;
    const struct replay_header *header = app->replay ? replay_get_header(app->replay) : NULL;
    int width = o->width ? o->width : header ? header->width : DEFAULT_WIDTH;
    int height = o->height ? o->height : header ? header->height : DEFAULT_HEIGHT;
    double scale = o->scale > 0 ? o->scale : header ? header->scale : 1;
    if (!o->headless && !o->no_draw) {
        struct error refused = {0};
        int vsync = is_replay(app) || o->frames ? 0 : 1;
        app->platform = platform_window(width, height, "wiggly", vsync, &refused);
        if (app->platform) return true;
        fprintf(stderr, "wiggly: %s; running headless (see wiggly live --help for what it can write)\n",
                refused.text);
    }
    width = (int)lround(width * scale);
    height = (int)lround(height * scale);
    app->platform = o->no_draw ? platform_blind(width, height, (float)scale)
                               : platform_offscreen(width, height, (float)scale, error);
    return app->platform != NULL;
}

/// Opens the log after the first frame. Only a log needs the reference frame measured, so that nobody waits for it at a window.
static bool open_log(struct app *app, struct error *error)
{
    const struct app_options *o = app->options;
    struct frame_header header = {
        .gl_renderer = app->draw ? draw_renderer_name() : NULL,
        .solver = evaluation_solver(&app->table.evaluation),
        .vsync = platform_is_window(app->platform) && !is_replay(app) && !o->frames,
        .warm_up = WARM_UP,
        .reference_ms = NAN,
        .first_frame_ms = 1e3 * process_age(),
    };
    platform_size(app->platform, &header.width, &header.height, &header.scale);
    if (o->log && !header.vsync && app->draw) {
        header.reference_ms = draw_reference_ms(app->draw, header.width, header.height,
                                                header.scale * (float)app->ui_scale_shown, REFERENCE_FRAMES);
        app->lost = true;
        app->last_swap = NAN;
    }
    app->log = framelog_open(o->log, &header, LOG_ROWS, error);
    if (!app->log) return false;
    framelog_push(app->log, &app->row);
    printf("first frame after %.0f ms\n", header.first_frame_ms);
    return true;
}

/// The frames of a run.
struct run {
    struct app *app;
    long frames; ///< 0: unlimited
    bool timed;
};

/// Makes a frame; false after the last.
static bool run_frame(void *user)
{
    const struct run *run = user;
    struct app *app = run->app;
    if (app->options->turns) {
        turns_take();
        app->last_swap = NAN; // the other program's frame came between
    }
    mtx_lock(&app->working);
    app_frame(app);
    mtx_unlock(&app->working);
    if (app->frame == 1 && run->timed && !app->log && !open_log(app, &app->error)) app->failed = true;
    if (app->options->turns && !app->failed) turns_give();
    return !app->quit && !app->failed && !process_was_told_to_end() && (run->frames == 0 || app->frame < run->frames);
}

static bool run_frames(struct app *app, long frames, bool timed, struct error *error)
{
    platform_run(app->platform, run_frame, &(struct run){app, frames, timed});
    if (app->failed) *error = app->error;
    return !app->failed;
}

/// Whether a person, not a script, is working.
static bool is_live(const struct app *app)
{
    return app->platform && platform_is_window(app->platform) && !app->replay;
}

/// For a run that ends before the user can decide about unsaved work.
static bool rescue(struct app *app, bool good, struct error *error)
{
    bool told = process_was_told_to_end(), unsaved = !history_is_saved(app->table.history);
    if (!is_live(app) || !unsaved || (good && !told)) return good;
    if (good) fail(error, ERROR_ENVIRONMENT, "ended by a signal");
    app_rescue(app, error);
    return false;
}

/// Writes the command line's output files: document, log, recording. Continues after a failure and reports the first.
static bool close_files(struct app *app, struct error *error)
{
    const char *result = app->table.document && app->frame > 0 ? app->options->result : NULL;
    struct error other = {0};
    bool good = !result || scene_save(app->table.document, result, error);
    if (app->log) {
        good = framelog_close(app->log, stdout, good ? error : &other) && good;
        printf("largest resident memory %.0f MB\n", process_peak_memory());
    }
    return recording_close(app->recording, app->frame, good ? error : &other) && good;
}

/// Also writes the picture, which needs GL.
static bool finish(struct app *app, struct error *error)
{
    const char *screenshot = app->platform && app->frame > 0 ? app->options->screenshot : NULL;
    struct error other = {0};
    bool good = !screenshot || app_screenshot(app, screenshot, error);
    return close_files(app, good ? error : &other) && good;
}

/// The display and GL are gone: saves the document if possible. The process ends on return, but in a browser.
static void on_lost(void *user)
{
    struct app *app = user;
    struct error error, other = {0};
    fail(&error, ERROR_ENVIRONMENT, "the window or its display is gone");
    app_rescue(app, &error);
    if (platform_in_page()) return; // which is only hidden
    close_files(app, &other);
    fflush(stdout);
    fprintf(stderr, "wiggly live: %s\n", error.text);
}

static bool set_resolution(struct app *app, struct error *error)
{
    const struct app_options *o = app->options;
    bool live = platform_is_window(app->platform) && !o->replay && !o->record;
    const char *scale = o->stage_scale ? o->stage_scale : live ? "auto" : "1";
    return resolution_parse(&app->resolution, scale) ||
           fail(error, ERROR_USAGE, "--stage-scale: expected auto or a number from 0.25 to 1, got '%s'", scale);
}

void app_open_editor(struct app *app)
{
    editor_destroy(app->table.editor);
    app->table.editor = editor_create();
    app->table.editor->core.in_page = platform_in_page();
    app->table.editor->core.still = app->options->still;
    app->table.evaluation.solver = app->options->solver;
    app_connect_files(app);
    ui_scale_fit(app);
}

/// Opens the replay of the command line, or the demo's.
static bool open_replay(struct app *app, struct error *error)
{
    const struct app_options *o = app->options;
    app->demo = (struct demo){.on = o->demo, .theme = theme_in_use()};
    if (!o->demo && !o->replay) return true;
    app->replay = o->demo ? demo_replay(error) : replay_load(o->replay, error);
    return app->replay != NULL;
}

/// A replay only fits its scene; the demo opens its own.
static bool check_scene(const struct app *app, uint64_t hash, struct error *error)
{
    if (!is_replay(app) || replay_get_header(app->replay)->scene_hash == hash) return true;
    return fail(error, ERROR_INPUT, "%s: recorded on another scene: expected hash %016llx, got %016llx",
                app->options->replay, (unsigned long long)replay_get_header(app->replay)->scene_hash,
                (unsigned long long)hash);
}

/// Refuses to write over the scene's models and the files that these name, before any of it is overwritten.
static bool check_outputs(const struct app *app, struct error *error)
{
    const struct app_options *o = app->options;
    const char *const outputs[] = {o->log, o->screenshot, o->record, o->result};
    bool good = true, any = o->frames_dir;
    for (int i = 0; i < 4; i++) any |= outputs[i] != NULL;
    if (!any) return true;
    document_note_models(app->table.document);
    models_update(app->table.models, app->table.document, NULL); // reads their files, which notes them
    for (int i = 0; i < 4 && good; i++) good = !outputs[i] || file_check_unread(outputs[i], error);
    return good;
}

static bool start(struct app *app, struct error *error)
{
    const struct app_options *o = app->options;
    if (o->theme) theme_use((enum theme_kind)(o->theme - 1));
    if (!open_replay(app, error)) return false;
    font_init();
    if (!open_platform(app, error) || !set_resolution(app, error)) return false;
    int width, height;
    float scale;
    platform_size(app->platform, &width, &height, &scale);
    app->display.width = (float)width / scale;
    app->display.height = (float)height / scale;
    app->display.scale = scale;
    app->ui_scale = o->ui_scale > 0 ? o->ui_scale : app->replay ? replay_get_header(app->replay)->ui_scale : 1;
    if (!o->no_draw && !(app->draw = draw_create(scale, error))) return false;
    app_open_editor(app);
    app->table.models = models_create();
    app->table.history = history_create(NULL);
    if (!app_open(app, o->scene, error)) {
        if (!o->scene || !platform_in_page() || !is_live(app)) return false;
        fprintf(stderr, "wiggly live: %s; the start scene opens instead\n", error->text); // not an empty page
        if (!app_open(app, NULL, error)) return false;
    }
    uint64_t hash = scene_hash(app->table.document);
    if (!check_scene(app, hash, error) || !check_outputs(app, error)) return false;
    if (o->record) {
        struct replay_header header = {.width = (int)lroundf((float)width / scale),
                                       .height = (int)lroundf((float)height / scale),
                                       .scale = (double)scale,
                                       .ui_scale = app->ui_scale,
                                       .scene_hash = hash};
        if (!(app->recording = recording_open(o->record, &header, error))) return false;
    }
    if (o->frames_dir) mkdir(o->frames_dir, 0777);
    if (o->saves) mkdir(o->saves, 0777);
    bool window = platform_is_window(app->platform);
    app->fixed_clock = !window || is_replay(app) || app->recording;
    app->lost = true;
    if (window) {
        platform_on_lost(on_lost, app);
        if (!is_replay(app)) process_catch_end();
    }
    if (is_live(app)) {
        file_guard_reads(false);
        if (!o->scene || !import_suits(o->scene)) file_forget_reads(o->scene); // the user may save it
        personal_start(app);
        app_rescue_without_memory(app);
    }
    if (o->welcome) dialogs_welcome(app->table.editor->dialogs);
    return true;
}

void app_free(struct app *app)
{
    app_stop_export(app);
    table_free(&app->table);
    draw_destroy(app->draw);
    platform_destroy(app->platform);
    replay_destroy(app->replay);
}

int app_run(const struct app_options *options, struct error *error)
{
    struct app app = {.options = options, .last_swap = NAN};
    if (options->turns && !turns_open(options->turns == 1)) {
        fail(error, ERROR_USAGE, "--turns: descriptors 3 and 4 must be pipes to and from the other program");
        return ERROR_USAGE;
    }
    double age = process_age();
    app.process_start = clock_now() - (isnan(age) ? 0 : age);
    if (options->gl_debug) platform_debug_gl();
    mtx_init(&app.working, mtx_timed);
    bool good = start(&app, error);
    if (good) {
        long frames = options->frames                    ? options->frames
                      : app.demo.on && !app.fixed_clock  ? 0
                      : app.replay                       ? replay_get_header(app.replay)->frames
                      : platform_is_window(app.platform) ? 0
                                                         : HEADLESS_FRAMES;
        good = rescue(&app, run_frames(&app, frames, frames > 0 || options->log, error), error);
    }
    struct error late = {0};
    if (!finish(&app, good ? error : &late)) good = false;
    platform_on_lost(NULL, NULL); // a rescue would save the document, which is freed below
    personal_end(&app, !good);    // autosave's thread may still run out of memory
    need_keep(0, NULL, NULL);
    app_free(&app);
    mtx_destroy(&app.working);
    int complaints = platform_gl_complaints();
    if (good && complaints > 0)
        good = fail(error, ERROR_ENVIRONMENT, "--gl-debug: the OpenGL driver complained %d times", complaints);
    return good ? 0 : error->kind == ERROR_NONE ? ERROR_ENVIRONMENT : (int)error->kind;
}
