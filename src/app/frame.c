/// One frame of the app: input from window, replay or demo, the document's frame, drawing, log.
#include "app/state.h"
#include "base/embedded.h"
#include "base/progress.h"
#include "platform/process.h"
#include <limits.h>
#include <math.h>
#include <stdio.h>

static const double replay_dt = 1.0 / 60;
static const double idle_wait = 0.5;
static const double longest_step = 1; ///< seconds; playback does not skip ahead after a longer stall

static double microseconds(double from, double to) { return 1e6 * (to - from); }

static bool locate(void *user, const char *target, float *x, float *y, struct error *error)
{
    struct app *app = user;
    return editor_target(app->table.editor, target, x, y, error);
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
    if (event->kind == EVENT_EXPOSE) app->lost = true;
    if (event->kind == EVENT_FOCUS) {
        file_watch_look(app);
        return;
    }
    struct event seen = *event;
    if (event->kind == EVENT_SIZE) {
        app_resize(app, event->x, event->y, event->scale);
        ui_scale_to_ui(app, &seen);
    }
    editor_event(app->table.editor, &seen);
    app_requests(app);
}

static void play_events(struct app *app)
{
    const long frame = app->demo.on ? app->demo.frame : app->frame;
    const bool forgives = app->demo.on && !app->fixed_clock; // a target may be hidden in a window of another size
    struct event event;
    do {
        app->error.kind = ERROR_NONE;
        while (replay_next(app->replay, frame, locate, app, &event, &app->error)) {
            if (isnan(app->oldest_event)) app->oldest_event = app->frame_start;
            handle_event(app, &event);
        }
    } while (forgives && app->error.kind != ERROR_NONE);
    if (app->error.kind != ERROR_NONE) app->failed = true;
}

struct replay *demo_replay(struct error *error)
{
    const struct embedded *file = embedded_find("demo/demo.replay");
    return replay_parse("demo.replay", (const char *)file->data, file->size, error);
}

/// Restarts the demo exactly as it began.
static bool start_anew(struct app *app, struct error *error)
{
    theme_use(app->demo.theme);
    app_open_editor(app);
    return app_open(app, NULL, error);
}

bool demo_next(struct app *app, double dt, struct error *error)
{
    struct demo *demo = &app->demo;
    demo->seconds += dt;
    demo->frame = (long)(60 * demo->seconds + 0.5);
    if (demo->frame < replay_get_header(app->replay)->frames) return true;
    replay_destroy(app->replay);
    app->replay = demo_replay(error);
    demo->seconds = 0;
    demo->frame = 0;
    return app->replay && start_anew(app, error);
}

/// Whether an event means that someone wants control.
static bool is_touch(const struct event *event)
{
    const bool pressed = event->kind == EVENT_KEY || event->kind == EVENT_BUTTON;
    return (pressed && event->action == ACTION_PRESS) || event->kind == EVENT_WHEEL || event->kind == EVENT_DROP;
}

/// Ends the demo with the start scene and the user's settings.
static bool stop_demo(struct app *app, struct error *error)
{
    replay_destroy(app->replay);
    app->replay = NULL;
    app->demo.on = false;
    if (!start_anew(app, error)) return false;
    if (platform_is_window(app->platform)) personal_start(app);
    return true;
}

/// Plays the demo's next frame, or ends the demo.
static void play_demo(struct app *app)
{
    const double dt = app->frame == 0 ? 0 : app->fixed_clock ? replay_dt : app->frame_start - app->last_time;
    history_mark_saved(app->table.history); // no question about the demo's edits
    if (!demo_next(app, fmin(fmax(dt, 0), longest_step), &app->error)) app->failed = true;
}

/// Whether a window event goes to the editor. The first touch ends a demo; closing the window during a demo loses nothing.
static bool is_for_editor(struct app *app, const struct event *event)
{
    if (!app->replay || event->kind == EVENT_EXPOSE) return true;
    if (!app->demo.on) return event->kind == EVENT_CLOSE;
    app->quit |= event->kind == EVENT_CLOSE;
    if (is_touch(event) && !stop_demo(app, &app->error)) app->failed = true;
    return event->kind == EVENT_SIZE || event->kind == EVENT_DROP;
}

/// Delivers the clipboard text the editor asked for as an event, so that it is recorded.
static void paste(struct app *app)
{
    if (!app->paste) return;
    app->paste = false;
    const char *text = app_clipboard_text(app);
    if (text) handle_event(app, &(struct event){.kind = EVENT_PASTE, .text = text});
}

/// With a fixed clock, resolution changes depend on frames, so that pictures do not depend on the machine.
static double resolution_now(const struct app *app)
{
    return app->fixed_clock ? (double)app->frame * replay_dt : app->frame_start;
}

/// How long the next frame may wait for input: until it is due, or longer if nothing moves. A live recording never skips frames, because
/// its clock counts them.
static double waiting_time(const struct app *app, bool wanted)
{
    double left = fmax(0, app->next_time - clock_now());
    if (app->recording && !app->replay) process_sleep(left);
    if (app->fixed_clock) return 0;
    if (wanted) return left;
    return fmin(personal_is_behind(app) ? replay_dt : idle_wait, resolution_wait(&app->resolution, clock_now()));
}

/// Waits, then handles events. false if nothing needs a frame.
static bool take_input(struct app *app)
{
    double wait_start = clock_now();
    bool wanted = app->fixed_clock || app->frame == 0 || editor_wants_frames(app->table.editor) || app->paste ||
                  app->export_job || app->demo.on || app->fetches;
    app->was_idle = !wanted;
    int count = 0;
    const struct event *events = platform_events(app->platform, waiting_time(app, wanted), &count);
    bool exact_due = !app->fixed_clock && resolution_wait(&app->resolution, clock_now()) == 0;
    app->frame_start = clock_now();
    bool rested = !wanted && (count == 0 || app->frame_start - wait_start > replay_dt);
    if (rested) app->last_swap = NAN; // the frame after a rest is not late
    if (!wanted && count == 0 && !exact_due) return false;
    app->oldest_event = NAN;
    app->row = (struct frame_row){.frame = app->frame, .wait_us = microseconds(wait_start, app->frame_start)};
    app->row.allocations = allocation_count();
    paste(app);
    for (int i = 0; i < count; i++) {
        if (!is_for_editor(app, &events[i])) continue;
        if (isnan(app->oldest_event)) app->oldest_event = events[i].time;
        struct event event = events[i];
        if (event.kind != EVENT_SIZE) ui_scale_to_ui(app, &event); // recorded in the display's pixels
        handle_event(app, &event);
    }
    if (app->demo.on && !app->failed) play_demo(app);
    if (app->replay && !app->failed) play_events(app);
    app->row.input_us = microseconds(app->frame_start, clock_now());
    return true;
}

/// A recording's clock counts frames of equal length.
static double next_time(const struct app *app)
{
    if (app->fixed_clock) return fmax(app->next_time + replay_dt, app->frame_start);
    return pace_next(&app->pace, app->next_time, app->frame_start);
}

static double step(struct app *app)
{
    double dt = app->fixed_clock ? replay_dt : fmin(fmax(app->frame_start - app->last_time, 0), longest_step);
    bool starts =
        app->frame == 0 || (app->was_idle && !app->fixed_clock); // what starts now did not move during the pause
    app->last_time = app->frame_start;
    app->next_time = next_time(app);
    return starts ? 0 : dt;
}

/// Chooses the stage's resolution and reports it to the status line.
static void choose_resolution(struct app *app)
{
    struct editor *editor = app->table.editor;
    const float scale = resolution_choose(&app->resolution, editor_stage(editor)->hash, resolution_now(app));
    editor->core.status.stage_scale = scale;
}

static struct draw_input draw_input(const struct app *app, float stage_scale)
{
    struct draw_input input = {
        .keeps = !app->lost && platform_keeps(app->platform),
        .list = &app->table.editor->core.list,
        .stage = editor_stage(app->table.editor),
        .frame = app->frame,
        .stage_scale = stage_scale,
    };
    platform_size(app->platform, &input.width, &input.height, &input.scale);
    input.scale *= (float)app->ui_scale_shown;
    return input;
}

static void measure(struct app *app)
{
    const struct frame_row *row = &app->row;
    struct resolution_cost cost = {
        .draw = 1e-3 * (row->upload_us + row->draw_us), .swap = 1e-3 * row->swap_us, .gpu = 1e-3 * app->gpu_us};
    cost.before = row->frame_ms - cost.draw - cost.swap;
    // A browser draws after the frame, and calls for the next when it keeps up.
    if (platform_in_page()) cost.swap = row->frame_interval_ms - cost.before - cost.draw;
    resolution_measure(&app->resolution, &cost);
}

static void draw(struct app *app)
{
    struct draw_input input = draw_input(app, app->resolution.shown);
    struct draw_cost cost = {0};
    draw_frame(app->draw, &input, &cost);
    app->lost = false;
    double swap_start = clock_now();
    platform_swap(app->platform);
    double end = clock_now();
    pace_swapped(&app->pace, end, !app->was_idle && cost.rectangles > 0);
    app->row.upload_us = cost.upload_us;
    app->row.draw_us = cost.draw_us;
    if (cost.gpu_us >= 0) app->gpu_us = cost.gpu_us;
    if (app->log && cost.gpu_us >= 0) framelog_gpu(app->log, cost.gpu_frame, cost.gpu_us);
    app->row.uploaded_bytes = cost.uploaded_bytes;
    app->row.swap_us = microseconds(swap_start, end);
}

static void end_row(struct app *app)
{
    double end = clock_now();
    app->row.t_s = app->frame_start - app->process_start;
    app->row.frame_ms = 1e3 * (end - app->frame_start);
    app->row.frame_interval_ms = 1e3 * (end - app->last_swap);
    app->last_swap = end;
    app->row.event_to_swap_us = isnan(app->oldest_event) ? NAN : microseconds(app->oldest_event, end);
    app->row.allocations = allocation_count() - app->row.allocations;
}

static void after_drawing(struct app *app)
{
    if (app->resolution.changed == resolution_now(app)) measure(app);
    platform_cursor(app->platform, app->demo.on ? CURSOR_ARROW : editor_cursor(app->table.editor));
}

void app_draw_exactly(struct app *app)
{
    if (!app->draw || resolution_is_exact(&app->resolution)) return;
    struct draw_input input = draw_input(app, 1);
    struct draw_cost cost;
    draw_frame(app->draw, &input, &cost);
}

static void log_frame(struct app *app)
{
    if (app->log) framelog_push(app->log, &app->row);
    double now = clock_now();
    if (now - app->stats_time >= 0.5) {
        bool seen = app->stats_time > 0 && platform_is_window(app->platform); // offscreen nothing runs in real time
        double fps = seen ? (double)(app->frame - app->stats_frame) / (now - app->stats_time) : 0;
        app->table.editor->core.status.told = (struct figures){fps, app->row.solve_us};
        app->stats_time = now;
        app->stats_frame = app->frame;
        pace_set_rate(&app->pace, platform_refresh_rate(app->platform));
    }
    if (!app->options->frames_dir) return;
    char path[PATH_MAX + 32]; // longer than any path the system accepts
    snprintf(path, sizeof path, "%s/frame_%05ld.png", app->options->frames_dir, app->frame);
    if (!app_screenshot(app, path, &app->error)) app->failed = true;
}

/// Whether characters of a new document must be fetched first.
static bool is_fetching(const struct table *table)
{
    const struct document *document = table->document;
    bool any = false;
    if (table->models_serial == document->serial) return false;
    for (int r = 0; r < document->rig_count; r++) {
        char path[PATH_LIMIT];
        any |= document_model_path(document, r, path) && platform_fetches(path);
    }
    return any;
}

void app_frame(struct app *app)
{
    struct table *table = &app->table;
    struct frame_row *row = &app->row;
    if (!take_input(app)) {
        personal_update(app);
        return;
    }
    exporting_step(app);
    const double passed = step(app);
    table_edit(table, exporting_draws(app) ? 0 : passed, row);
    app_show_title(app);
    ui_scale_update(app);
    personal_update(app);
    app->fetches = is_fetching(table);
    if (app->failed || app->fetches) return;
    table_solve(table, row);
    table_pose(table, row);
    choose_resolution(app);
    table_show(table, row);
    row->upload_us = row->draw_us = row->gpu_us = row->swap_us = NAN;
    row->uploaded_bytes = -1;
    if (app->draw) draw(app);
    end_row(app);
    if (app->draw) after_drawing(app);
    log_frame(app);
    app->frame++;
}
