/// The app's state. Private to src/app.
#ifndef APP_STATE_H
#define APP_STATE_H

#include "app/app.h"
#include "app/replay.h"
#include "base/file.h"
#include "draw/draw.h"
#include "editor/editor.h"
#include "platform/platform.h"
#include "scene/edit.h"
#include "scene/evaluate.h"
#include "scene/history.h"
#include "timing/framelog.h"
#include <stdbool.h>
#include <stdint.h>

#define UI_SCALE_LEAST 0.75
#define UI_SCALE_MOST 3.0

// Keeps up with the display: lowers the stage's resolution while it moves and frames are slow (a still stage is always exact), and paces
// frames.

/// Zero: always full resolution.
struct resolution {
    float moving;    ///< resolution while the stage moves; 0 means 1
    float shown;     ///< resolution on the screen; 0 means 1
    bool adapts;     ///< adapt `moving` to the cost of frames
    uint64_t hash;   ///< of the displayed stage
    double changed;  ///< time of the last change, s
    int slow, quick; ///< leaky counts of slow and quick frames
    int since;       ///< frames since the last step
    bool tried;      ///< the last step raised the resolution
    int patience;    ///< quick frames before trying a step up; grows after each one that failed
};

/// Parses "auto" or a number from 0.25 to 1; false if it is neither.
bool resolution_parse(struct resolution *resolution, const char *text);

/// The resolution for a stage with this `hash`; `now` in seconds.
float resolution_choose(struct resolution *resolution, uint64_t hash, double now);

/// Whether the displayed stage has full resolution.
bool resolution_is_exact(const struct resolution *resolution);

/// Seconds until the stage must be redrawn exactly; INFINITY if it already is.
double resolution_wait(const struct resolution *resolution, double now);

/// Time for a frame with a moving stage, ms.
struct resolution_cost {
    double before;     ///< before drawing
    double draw, swap; ///< on the CPU
    double gpu;        ///< of a recent frame; 0 without GPU timers
};

/// Waiting for the display is not work, so GPU time counts instead of the swap where there is one.
void resolution_measure(struct resolution *resolution, const struct resolution_cost *cost);

// When the next frame may begin. Swaps that wait for the display set the pace; otherwise the app keeps to its refresh rate.

/// Zero: a 60 Hz display, nothing measured yet.
struct pace {
    double period; ///< of the display, s
    bool limits;   ///< swaps do not wait, so the app must
    int run;       ///< consecutive frames that waited for nothing else
    double start;  ///< start of the measurement, s
};

/// Refresh rate in Hz, 0 if unknown. A new rate restarts the measurement.
void pace_set_rate(struct pace *pace, double rate);

/// Call after a swap. `at_once`: the frame did not wait for anything else.
void pace_swapped(struct pace *pace, double now, bool at_once);

/// When the next frame may begin, after one due at `due` that began at `frame_start`.
double pace_next(const struct pace *pace, double due, double frame_start);

// The app.

/// The open document and its part of a frame: no window, no files, no GL. Start from zero, with the parts that a frame needs.
struct workspace {
    struct editor *editor;
    struct document *document;
    struct history *history;
    struct models *models; ///< NULL: characters without models
    struct evaluation evaluation;
    unsigned models_serial; ///< of the document whose models are loaded
};

static inline struct editor_world workspace_world(const struct workspace *work)
{
    return (struct editor_world){work->document, work->history, &work->evaluation, work->models};
}

/// The steps of a frame after its events, in this order. Each adds its time and counts to the row.
/// `dt`: seconds of playback. Also applies running drags.
void workspace_edit(struct workspace *work, double dt, struct frame_row *row);
void workspace_solve(struct workspace *work, struct frame_row *row);
void workspace_pose(struct workspace *work, struct frame_row *row);
/// Builds the draw list.
void workspace_show(struct workspace *work, struct frame_row *row);

void workspace_free(struct workspace *work);

struct app {
    const struct app_options *options;
    struct platform *platform;
    struct draw *draw; ///< NULL: nothing is drawn
    struct workspace work;
    char replaceable[PATH_LIMIT]; ///< existing file that "Save as" may replace if asked again
    struct {
        uint64_t content; ///< file_content() when last read or written
        uint64_t asked;   ///< content the user was already asked about
    } own_file;           ///< the document's, which another program or window may write
    unsigned last_serial; ///< highest document.serial so far

    struct export_job *export_job; ///< NULL: no export
    struct flesh_job *flesh;       ///< NULL: none is made
    struct personal *personal;     ///< NULL: not interactive

    struct replay *replay; ///< NULL: events come from the user
    struct recording *recording;
    struct framelog *log;
    struct frame_row row; ///< timing of the current frame
    double gpu_us;        ///< last measured; 0 without GPU timers
    double frame_start, oldest_event;
    double last_swap; ///< end of the last swap; NAN if the next interval means nothing
    bool fixed_clock; ///< every frame is 1/60 s (headless, replays, recordings)
    bool was_idle;    ///< nothing was moving before this frame
    bool must_redraw; ///< the framebuffer does not hold the last frame
    struct {
        float width, height, scale;
    } display;              ///< the window in the display's logical pixels; device pixels per logical pixel
    struct figures figures; ///< for the editor
    double ui_scale_shown;  ///< figures.ui_scale or what fits
    struct pace pace;
    struct resolution resolution;
    double process_start; ///< on this clock
    double last_time, next_time, stats_time;
    long frame, stats_frame;
    long frames;        ///< of the run; 0: unlimited
    bool shown_saved;   ///< in the window's title
    uint64_t described; ///< hash of the last platform_describe()
    bool fetches;       ///< no frame is drawn until the document's characters are there
    bool paste;         ///< clipboard text to deliver with the next events
    bool quit;
    bool failed; ///< `error` ends the run
    struct error error;
};

/// Frees everything; parts may be NULL.
void app_free(struct app *app);

/// Runs one frame: input, edit, solve, pose, draw, log.
void app_frame(struct app *app);

/// Replaces the editor by a new one for the display's size, and carries out its requests.
void app_open_editor(struct app *app);

/// Opens a scene file, or the built-in scene for NULL. On failure the document stays.
bool app_open(struct app *app, const char *path, struct error *error);

/// Replaces the document.
void app_adopt(struct app *app, struct document *document);

/// Path of the document's file; "" if untitled.
const char *app_path(const struct app *app);

/// Updates the window's title and its star for unsaved work.
void app_show_title(struct app *app);

/// Writes unsaved work to the recovery file, or else to a new file beside the scene's, and adds the path to the error's text.
void app_rescue(struct app *app, struct error *error);

/// Handles a new window size, in the display's logical pixels.
void app_resize(struct app *app, float width, float height, float scale);

/// Call on focus: asks about a changed file, once per change.
void file_watch_look(struct app *app);

/// Lays out the editor for the display's size, as large as chosen or as fits.
void ui_scale_fit(struct app *app);
/// The next step up (1) or down (-1), or the display's scale (0). Refuses one that leaves the panels no room.
bool ui_scale_step(struct app *app, int direction, struct error *error);

// What belongs to the user, not a document: settings, recent files, autosave. Headless runs, replays and recordings neither read nor write
// any of it.

/// Call at a window with an open document: applies settings, starts autosave, offers recovered work. Failures go to the status line.
void personal_start(struct app *app);

/// Call once per frame, and while idle.
void personal_update(struct app *app);

/// Whether unsaved work waits for personal_update().
bool personal_is_behind(const struct app *app);

/// Writes at most `most` recent files, newest first; returns how many.
int personal_recent(struct app *app, struct dialog_recent *files, int most);

/// Call when a document's file was opened or saved.
void personal_note_file(struct app *app, const char *path);

/// Stores the last export for the Export dialog.
void personal_note_export(struct app *app, const struct request *request);

/// Opens the offered recovery file, or deletes it and offers the next.
bool personal_recover(struct app *app, struct error *error);
void personal_forget(struct app *app);

/// Writes unsaved work to the recovery file and waits for it. Returns the path, or NULL if it failed.
const char *personal_rescue(struct app *app);

/// `keep`: the user could not decide about unsaved work, so its recovery file stays.
void personal_end(struct app *app, bool keep);

// Exports in the background: a thread solves and writes a copy of the document; films are drawn frame by frame.

/// How many of `export_formats` can be made here: all but some films.
int exporting_format_count(void);

/// Call once per frame: continues the export and tells the editor. With a fixed clock it finishes in the frame it began in.
void exporting_step(struct app *app);
/// Whether a film is being drawn. Playback stands still meanwhile, so that the stage is not drawn twice.
bool exporting_draws(const struct app *app);

/// Stops the export without writing anything.
void app_stop_export(struct app *app);

// Flesh that is made in the background, by a process.

/// Begins to make flesh of a model: of a bone and those below it, else where its paint raises the amplitude, else of all. Ends what is being made.
bool flesh_start(struct app *app, const struct request *request, struct error *error);
/// Call once per frame, also while idle. With a fixed clock it waits for the end.
void flesh_step(struct app *app);
/// Leaves nothing behind.
void flesh_stop(struct app *app);

/// Where a file is written. A replay chooses no folder: what it writes goes to that of --saves, by its name alone, else nowhere (""). To the
/// replay, all is as it was recorded.
bool app_place_file(const struct app *app, const char *path, char placed[PATH_LIMIT], struct error *error);
/// Tells where a replay's file is.
void app_tell_placed(struct app *app, const char *placed);

/// Saves the last frame as PNG, at full resolution.
bool app_screenshot(struct app *app, const char *path, struct error *error);

#endif
