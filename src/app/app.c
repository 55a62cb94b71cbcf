/// Starts the app, runs its frames and ends it. A frame: input from window, replay or demo, the document's part, drawing, log.
#include "app/state.h"
#include "base/need.h"
#include "base/png.h"
#include "base/progress.h"
#include "platform/process.h"
#include "rig/import.h"
#include "rig/posing.h"
#include "scene/load.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// --- the document's part of a frame: edit, solve, pose, show

static double microseconds(double from, double to) { return 1e6 * (to - from); }

void workspace_edit(struct workspace *work, double dt, struct frame_row *row)
{
    const double start = clock_now();
    editor_advance(work->editor, dt);
    row->edit_us = microseconds(start, clock_now());
}

void workspace_solve(struct workspace *work, struct frame_row *row)
{
    // The models of a document that is new, restored by undo, or has other models since the last edit.
    const bool is_new = work->models_serial != work->document->serial;
    if (work->models && (is_new || !models_suit(work->models, work->document))) {
        struct error error;
        work->models_serial = work->document->serial;
        if (is_new && !scene_read_paint(work->document, &error)) editor_message(work->editor, true, "%s", error.text);
        if (is_new && !history_is_open(work->history)) history_amend(work->history);
        if (!models_update(work->models, work->document, &error))
            editor_message(work->editor, true, "%s", error.text);
    }
    if (work->models) models_follow(work->models, work->document);
    const double start = clock_now();
    struct evaluation *evaluation = &work->evaluation;
    row->edited = !evaluation_is_of(evaluation, work->document);
    evaluation->models = models_source(work->models);
    evaluation_update(evaluation, work->document, editor_shown(work->editor).look == LOOK_CUBIC);
    row->solver = evaluation_solver(evaluation);
    row->splines_solved = evaluation->solved_splines;
    row->samples = evaluation->solved_samples;
    row->knots = evaluation->solved_knots;
    row->solve_us = microseconds(start, clock_now());
}

void workspace_pose(struct workspace *work, struct frame_row *row)
{
    const double start = clock_now();
    editor_pose(work->editor);
    row->pose_us = microseconds(start, clock_now());
}

void workspace_show(struct workspace *work, struct frame_row *row)
{
    const double start = clock_now();
    editor_show(work->editor);
    row->pose_us += microseconds(start, clock_now());
}

void workspace_free(struct workspace *work)
{
    evaluation_free(&work->evaluation);
    history_destroy(work->history);
    document_destroy(work->document);
    models_destroy(work->models);
    editor_destroy(work->editor);
}

// --- the size of the interface relative to the display's scale

static const double scale_steps[] = {UI_SCALE_LEAST, 1, 1.25, 1.5, 1.75, 2, 2.5, UI_SCALE_MOST};
/// Logical pixels of the layout; a smaller window shows a part of it.
enum { UI_LEAST_WIDTH = 320, UI_LEAST_HEIGHT = 240 };

enum { STEPS = sizeof scale_steps / sizeof *scale_steps };

static const double SHARPEST = 5; ///< device pixels per logical pixel that the glyph atlas can hold

/// Logical pixels that the panels need; in an upright window they lie below each other.
static double least_width(const struct app *app) { return app->display.height > app->display.width ? 360 : 760; }
static double least_height(const struct app *app) { return app->display.height > app->display.width ? 560 : 400; }

static bool has_room(const struct app *app, double scale)
{
    return (double)app->display.width / scale >= least_width(app) &&
           (double)app->display.height / scale >= least_height(app) && (double)app->display.scale * scale <= SHARPEST;
}

void ui_scale_fit(struct app *app)
{
    // The chosen scale, or the largest step below it that fits. A window too small for any keeps its scale.
    const double most = app->figures.ui_scale;
    int step = STEPS - 1;
    while (scale_steps[step] > 1 && (scale_steps[step] > most || !has_room(app, scale_steps[step]))) step--;
    app->ui_scale_shown = most <= 1 || has_room(app, most) ? most : scale_steps[step];
    const float shown = (float)app->ui_scale_shown;
    editor_resize(app->work.editor, fmaxf(app->display.width / shown, UI_LEAST_WIDTH),
                  fmaxf(app->display.height / shown, UI_LEAST_HEIGHT), app->display.scale * shown);
}

/// Converts the display's coordinates to the editor's.
static void ui_scale_to_ui(const struct app *app, struct event *event)
{
    const float shown = (float)app->ui_scale_shown;
    event->x /= shown;
    event->y /= shown;
    event->scale *= shown;
}

bool ui_scale_step(struct app *app, int direction, struct error *error)
{
    double next = 1;
    int step = 0;
    while (step < STEPS - 1 && scale_steps[step] <= app->figures.ui_scale) step++;
    if (direction > 0) next = fmax(scale_steps[step], app->figures.ui_scale);
    while (step > 0 && scale_steps[step] >= app->figures.ui_scale) step--;
    if (direction < 0) next = fmin(scale_steps[step], app->figures.ui_scale);
    if (next > app->figures.ui_scale && next > 1 && !has_room(app, next)) {
        return fail(error, ERROR_INPUT, "%.0f %% needs a window of %.0f × %.0f, not %.0f × %.0f", 100 * next,
                    least_width(app) * next, least_height(app) * next, (double)app->display.width,
                    (double)app->display.height);
    }
    app->figures.ui_scale = next;
    editor_let_go(app->work.editor); // a held control would jump
    ui_scale_fit(app);
    return true;
}

// --- one frame

enum { MAX_CLIPBOARD = 16 << 20 }; ///< bytes
static const double replay_dt = 1.0 / 60;
static const double idle_wait = 0.5;
static const double longest_step = 1; ///< seconds; playback does not skip ahead after a longer stall

static bool locate(void *user, const char *target, float *x, float *y, struct error *error)
{
    struct app *app = user;
    return editor_target(app->work.editor, target, x, y, error);
}

void app_resize(struct app *app, float width, float height, float scale)
{
    app->display.width = width;
    app->display.height = height;
    app->display.scale = scale;
    ui_scale_fit(app);
}

static void handle_event(struct app *app, const struct event *event)
{
    if (app->recording) recording_event(app->recording, app->frame, event);
    if (event->kind == EVENT_EXPOSE) app->must_redraw = true;
    if (event->kind == EVENT_FOCUS) {
        file_watch_look(app);
        return;
    }
    struct event seen = *event;
    if (event->kind == EVENT_SIZE) {
        app_resize(app, event->x, event->y, event->scale);
        ui_scale_to_ui(app, &seen);
    }
    editor_event(app->work.editor, &seen);
}

/// With a fixed clock, resolution changes depend on frames, so that pictures do not depend on the machine.
static double resolution_now(const struct app *app)
{
    return app->fixed_clock ? (double)app->frame * replay_dt : app->frame_start;
}

/// Waits, then handles events. false if nothing needs a frame.
static bool take_input(struct app *app)
{
    double wait_start = clock_now();
    bool wanted = app->fixed_clock || app->frame == 0 || editor_wants_frames(app->work.editor) || app->paste ||
                  app->export_job || app->fetches || background_is_behind(models_background(app->work.models));
    app->was_idle = !wanted;

    // The next frame waits for input until it is due, or longer if nothing moves. A live recording never skips frames, because its clock
    // counts them.
    double wait = fmax(0, app->next_time - clock_now());
    if (app->recording && !app->replay) process_sleep(wait);
    if (app->fixed_clock) {
        wait = 0;
    } else if (!wanted) {
        wait = fmin(personal_is_behind(app) ? replay_dt : idle_wait, resolution_wait(&app->resolution, clock_now()));
    }
    int count = 0;
    const struct event *events = platform_events(app->platform, wait, &count);
    bool exact_due = !app->fixed_clock && resolution_wait(&app->resolution, clock_now()) == 0;
    app->frame_start = clock_now();
    bool rested = !wanted && (count == 0 || app->frame_start - wait_start > replay_dt);
    if (rested) app->last_swap = NAN; // the frame after a rest is not late
    if (!wanted && count == 0 && !exact_due) return false;
    app->oldest_event = NAN;
    app->row = (struct frame_row){.frame = app->frame, .wait_us = microseconds(wait_start, app->frame_start)};
    app->row.allocations = allocation_count();

    // Clipboard text that the editor asked for comes as an event, so that it is recorded.
    const char *text = app->paste ? platform_clipboard(app->platform) : "";
    if (app->paste && (!text || !*text))
        editor_message(app->work.editor, false, "The clipboard has no text.");
    else if (app->paste && strlen(text) > MAX_CLIPBOARD)
        editor_message(app->work.editor, true, "The clipboard holds more than 16 MB, too much for knots.");
    else if (app->paste)
        handle_event(app, &(struct event){.kind = EVENT_PASTE, .text = text});
    app->paste = false;
    for (int i = 0; i < count; i++) {
        const enum event_kind kind = events[i].kind;
        if (app->replay && kind != EVENT_EXPOSE && kind != EVENT_CLOSE) continue;
        if (isnan(app->oldest_event)) app->oldest_event = events[i].time;
        struct event event = events[i];
        if (event.kind != EVENT_SIZE) ui_scale_to_ui(app, &event); // recorded in the display's pixels
        handle_event(app, &event);
    }
    if (app->replay && !app->failed) {
        struct event event;
        app->error.kind = ERROR_NONE;
        while (replay_next(app->replay, app->frame, locate, app, &event, &app->error)) {
            if (isnan(app->oldest_event)) app->oldest_event = app->frame_start;
            handle_event(app, &event);
        }
        app->failed = app->error.kind != ERROR_NONE;
    }
    app->row.input_us = microseconds(app->frame_start, clock_now());
    return true;
}

static struct draw_input draw_input(const struct app *app, float stage_scale)
{
    struct draw_input input = {
        .keeps = !app->must_redraw && platform_keeps(app->platform),
        .list = editor_shown(app->work.editor).list,
        .stage = editor_stage(app->work.editor),
        .frame = app->frame,
        .stage_scale = stage_scale,
    };
    platform_size(app->platform, &input.width, &input.height, &input.scale);
    input.scale *= (float)app->ui_scale_shown;
    return input;
}

bool app_screenshot(struct app *app, const char *path, struct error *error)
{
    if (!app->draw) return fail(error, ERROR_ENVIRONMENT, "%s: nothing is drawn, so there is no picture", path);
    const struct draw_input input = draw_input(app, 1);
    struct draw_cost cost;
    if (!resolution_is_exact(&app->resolution)) draw_frame(app->draw, &input, &cost);
    unsigned char *pixels = need(4 * (size_t)input.width * (size_t)input.height, 1);
    draw_read(input.width, input.height, pixels);
    const bool done = png_write(path, input.width, input.height, pixels, error);
    free(pixels);
    return done;
}

void app_frame(struct app *app)
{
    struct workspace *work = &app->work;
    struct frame_row *row = &app->row;
    flesh_step(app);
    app->figures.makes_flesh = app->flesh != NULL;
    if (!take_input(app)) {
        personal_update(app);
        return;
    }
    exporting_step(app);
    // Seconds of playback. A recording's clock counts frames of equal length. What starts now did not move during a pause.
    double passed = app->fixed_clock ? replay_dt : fmin(fmax(app->frame_start - app->last_time, 0), longest_step);
    if (app->frame == 0 || (app->was_idle && !app->fixed_clock) || exporting_draws(app)) passed = 0;
    app->last_time = app->frame_start;
    app->next_time = app->fixed_clock ? fmax(app->next_time + replay_dt, app->frame_start)
                                      : pace_next(&app->pace, app->next_time, app->frame_start);
    workspace_edit(work, passed, row);
    app_show_title(app);
    personal_update(app);
    app->fetches = false; // characters of a new document
    for (int r = 0; work->models_serial != work->document->serial && r < work->document->rig_count; r++) {
        char path[PATH_LIMIT];
        app->fetches |= document_model_path(work->document, r, path) && platform_fetches(path);
    }
    if (app->failed || app->fetches) return;
    struct error error;
    if (!background_follow(models_background(work->models), work->document, !app->fixed_clock, &error))
        editor_message(work->editor, true, "%s", error.text);
    workspace_solve(work, row);
    workspace_pose(work, row);
    app->figures.stage_scale =
        resolution_choose(&app->resolution, editor_stage(work->editor)->hash, resolution_now(app));
    workspace_show(work, row);
    row->upload_us = row->draw_us = row->gpu_us = row->swap_us = NAN;
    row->uploaded_bytes = -1;
    if (app->draw) {
        const struct draw_input input = draw_input(app, app->resolution.shown);
        struct draw_cost cost = {0};
        draw_frame(app->draw, &input, &cost);
        app->must_redraw = false;
        const double swap_start = clock_now();
        platform_swap(app->platform);
        const double swapped = clock_now();
        pace_swapped(&app->pace, swapped, !app->was_idle && cost.rectangles > 0);
        row->upload_us = cost.upload_us;
        row->draw_us = cost.draw_us;
        if (cost.gpu_us >= 0) app->gpu_us = cost.gpu_us;
        if (app->log && cost.gpu_us >= 0) framelog_gpu(app->log, cost.gpu_frame, cost.gpu_us);
        row->uploaded_bytes = cost.uploaded_bytes;
        row->swap_us = microseconds(swap_start, swapped);
    }

    // Completes and logs the row, and judges the resolution by it.
    const double end = clock_now();
    row->t_s = app->frame_start - app->process_start;
    row->frame_ms = 1e3 * (end - app->frame_start);
    row->frame_interval_ms = 1e3 * (end - app->last_swap);
    app->last_swap = end;
    row->event_to_swap_us = isnan(app->oldest_event) ? NAN : microseconds(app->oldest_event, end);
    row->allocations = allocation_count() - row->allocations;

    if (app->draw && app->resolution.changed == resolution_now(app)) {
        struct resolution_cost cost = {
            .draw = 1e-3 * (row->upload_us + row->draw_us), .swap = 1e-3 * row->swap_us, .gpu = 1e-3 * app->gpu_us};
        cost.before = row->frame_ms - cost.draw - cost.swap;
        // A browser draws after the frame, and calls for the next when it keeps up.
        if (platform_in_page()) cost.swap = row->frame_interval_ms - cost.before - cost.draw;
        resolution_measure(&app->resolution, &cost);
    }
    if (app->draw) platform_cursor(app->platform, editor_cursor(app->work.editor));

    if (app->log) framelog_push(app->log, row);
    double now = clock_now();
    if (now - app->stats_time >= 0.5) {
        bool seen = app->stats_time > 0 && platform_is_window(app->platform); // offscreen nothing runs in real time
        double fps = seen ? (double)(app->frame - app->stats_frame) / (now - app->stats_time) : 0;
        app->figures.fps = fps;
        app->figures.solve_us = row->solve_us;
        app->stats_time = now;
        app->stats_frame = app->frame;
        pace_set_rate(&app->pace, platform_refresh_rate(app->platform));
    }
    if (app->options->frames_dir) {
        char path[PATH_MAX + 32]; // longer than any path the system accepts
        snprintf(path, sizeof path, "%s/frame_%05ld.png", app->options->frames_dir, app->frame);
        if (!app_screenshot(app, path, &app->error)) app->failed = true;
    }
    app->frame++;
}

// --- start and end

enum { DEFAULT_WIDTH = 1280, DEFAULT_HEIGHT = 720, HEADLESS_FRAMES = 1200, WARM_UP = 10 };
enum { LOG_ROWS = 1 << 16 };

/// Makes a frame; false after the last.
static bool run_frame(void *user)
{
    struct app *app = user;
    const struct app_options *o = app->options;
    const bool timed = app->frames > 0 || o->log;
    if (o->turns) {
        turns_take();
        app->last_swap = NAN; // the other program's frame came between
    }
    app_frame(app);
    if (app->frame == 1 && timed && !app->log) {
        struct frame_header header = {
            .gl_renderer = app->draw ? draw_renderer_name() : NULL,
            .solver = evaluation_solver(&app->work.evaluation),
            .vsync = platform_is_window(app->platform) && !app->replay && !o->frames,
            .warm_up = WARM_UP,
            .first_frame_ms = 1e3 * process_age(),
        };
        platform_size(app->platform, &header.width, &header.height, &header.scale);
        app->log = framelog_open(o->log, &header, LOG_ROWS, &app->error);
        if (app->log) {
            framelog_push(app->log, &app->row);
            printf("first frame after %.0f ms\n", header.first_frame_ms);
        } else {
            app->failed = true;
        }
    }
    if (o->turns && !app->failed) turns_give();
    return !app->quit && !app->failed && !process_was_told_to_end() && (app->frames == 0 || app->frame < app->frames);
}

/// Whether a person, not a script, is working.
static bool is_live(const struct app *app)
{
    return app->platform && platform_is_window(app->platform) && !app->replay;
}

/// Writes the command line's output files: document, log, recording. Continues after a failure and reports the first.
static bool close_files(struct app *app, struct error *error)
{
    const char *result = app->work.document && app->frame > 0 ? app->options->result : NULL;
    struct error other = {0};
    bool good = !result || scene_save(app->work.document, result, error);
    if (app->log) {
        good = framelog_close(app->log, stdout, good ? error : &other) && good;
        printf("largest resident memory %.0f MB\n", process_peak_memory());
    }
    return recording_close(app->recording, app->frame, good ? error : &other) && good;
}

static bool keeps_key(void *user, int key, unsigned mods)
{
    const struct app *app = user;
    return app->work.editor && editor_keeps(app->work.editor, key, mods);
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

static bool start_app(struct app *app, struct error *error)
{
    const struct app_options *o = app->options;
    if (o->theme) theme_use((enum theme_kind)(o->theme - 1));
    if (o->replay && !(app->replay = replay_load(o->replay, error))) return false;
    font_init();

    // A window; if that fails, it says why and runs headless.
    const struct replay_header *header = app->replay ? replay_get_header(app->replay) : NULL;
    int width = o->width ? o->width : header ? header->width : DEFAULT_WIDTH;
    int height = o->height ? o->height : header ? header->height : DEFAULT_HEIGHT;
    const double wanted = o->scale > 0 ? o->scale : header ? header->scale : 1;
    float scale = (float)wanted;
    if (!o->headless && !o->no_draw) {
        struct error refused = {0};
        const int vsync = app->replay || o->frames ? 0 : 1;
        app->platform = platform_window(width, height, "wiggly", vsync, &refused);
        if (!app->platform)
            fprintf(stderr, "wiggly: %s; running headless (see wiggly live --help for what it can write)\n",
                    refused.text);
    }
    width = (int)lround(width * wanted);
    height = (int)lround(height * wanted);
    if (!app->platform)
        app->platform =
            o->no_draw ? platform_blind(width, height, scale) : platform_offscreen(width, height, scale, error);
    if (!app->platform) return false;
    const bool window = platform_is_window(app->platform);
    const char *stage_scale = o->stage_scale ? o->stage_scale : window && !o->replay && !o->record ? "auto" : "1";
    if (!resolution_parse(&app->resolution, stage_scale))
        return fail(error, ERROR_USAGE, "--stage-scale: expected auto or a number from 0.25 to 1, got '%s'",
                    stage_scale);
    platform_size(app->platform, &width, &height, &scale);
    app->display.width = (float)width / scale;
    app->display.height = (float)height / scale;
    app->display.scale = scale;
    app->figures.ui_scale = o->ui_scale > 0 ? o->ui_scale : header ? header->ui_scale : 1;
    if (!o->no_draw && !(app->draw = draw_create(scale, error))) return false;
    app_open_editor(app);
    app->work.models = models_create();
    app->work.history = history_create(NULL);
    if (!app_open(app, o->scene, error)) {
        if (!o->scene || !platform_in_page() || !is_live(app)) return false;
        fprintf(stderr, "wiggly live: %s; the start scene opens instead\n", error->text); // not an empty page
        if (!app_open(app, NULL, error)) return false;
    }
    uint64_t hash = scene_hash(app->work.document);
    // A replay only fits its scene.
    if (header && header->scene_hash != hash)
        return fail(error, ERROR_INPUT, "%s: recorded on another scene: expected hash %016llx, got %016llx",
                    o->replay, (unsigned long long)header->scene_hash, (unsigned long long)hash);

    // No output may replace the scene's models and the files that these name. Updating the models reads those files, which notes them.
    const char *const outputs[] = {o->log, o->screenshot, o->record, o->result};
    bool writes = o->frames_dir;
    for (int i = 0; i < 4; i++) writes |= outputs[i] != NULL;
    if (writes) {
        document_note_models(app->work.document);
        models_update(app->work.models, app->work.document, NULL);
    }
    for (int i = 0; i < 4; i++) {
        if (outputs[i] && !file_check_unread(outputs[i], error)) return false;
    }
    if (o->record) {
        const struct replay_header own = {.width = (int)lroundf((float)width / scale),
                                          .height = (int)lroundf((float)height / scale),
                                          .scale = (double)scale,
                                          .ui_scale = app->figures.ui_scale,
                                          .scene_hash = hash};
        if (!(app->recording = recording_open(o->record, &own, error))) return false;
    }
    if (o->frames_dir) mkdir(o->frames_dir, 0777);
    if (o->saves) mkdir(o->saves, 0777);
    app->fixed_clock = !window || app->replay || app->recording;
    app->must_redraw = true;
    if (window) {
        platform_listen((struct platform_calls){on_lost, keeps_key, app});
        if (!app->replay) process_catch_end();
    }
    if (is_live(app)) {
        file_guard_reads(false);
        if (!o->scene || !import_suits(o->scene)) file_forget_reads(o->scene); // the user may save it
        personal_start(app);
    }
    if (o->welcome) dialogs_welcome(editor_dialogs(app->work.editor));
    return true;
}

void app_free(struct app *app)
{
    app_stop_export(app);
    flesh_stop(app);
    workspace_free(&app->work);
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
    bool good = start_app(&app, error);
    if (good) {
        app.frames = options->frames                    ? options->frames
                     : app.replay                       ? replay_get_header(app.replay)->frames
                     : platform_is_window(app.platform) ? 0
                                                        : HEADLESS_FRAMES;
        platform_run(app.platform, run_frame, &app);
        good = !app.failed;
        if (!good) *error = app.error;

        // The run may end before the user can decide about unsaved work.
        const bool told = process_was_told_to_end();
        if (is_live(&app) && !history_is_saved(app.work.history) && (!good || told)) {
            if (good) fail(error, ERROR_ENVIRONMENT, "ended by a signal");
            app_rescue(&app, error);
            good = false;
        }
    }
    const char *screenshot = app.platform && app.frame > 0 ? options->screenshot : NULL; // needs GL
    struct error late = {0};
    if (screenshot && !app_screenshot(&app, screenshot, good ? error : &late)) good = false;
    if (!close_files(&app, good ? error : &late)) good = false;
    platform_listen((struct platform_calls){0}); // a rescue would save the document, which is freed below
    personal_end(&app, !good);
    app_free(&app);
    int complaints = platform_gl_complaints();
    if (good && complaints > 0)
        good = fail(error, ERROR_ENVIRONMENT, "--gl-debug: the OpenGL driver complained %d times", complaints);
    return good ? 0 : error->kind == ERROR_NONE ? ERROR_ENVIRONMENT : (int)error->kind;
}
