/// The app's state. Internal to src/app.
#ifndef APP_STATE_H
#define APP_STATE_H

#include "app/app.h"
#include "app/personal.h"
#include "app/replay.h"
#include "app/resolution.h"
#include "app/table.h"
#include "base/file.h"
#include "draw/draw.h"
#include "platform/platform.h"
#include "scene/edit.h"
#include "scene/history.h"
#include "ui/theme.h"
#include <stdint.h>
#include <threads.h>

#define UI_SCALE_LEAST 0.75
#define UI_SCALE_MOST 3.0

/// A recording that comes with the program and plays itself, over and over, until the first touch.
struct demo {
    bool on;
    double seconds;        ///< since this round began
    long frame;            ///< of the recording
    enum theme_kind theme; ///< before
};

/// The document's own file as it was last seen: another program, or a second window, may write it.
struct own_file {
    uint64_t content; ///< when it was read or written last (file_content())
    uint64_t asked;   ///< content that the user was asked about when the window got the focus
};

struct app {
    const struct app_options *options;
    struct platform *platform;
    struct draw *draw; ///< NULL: frames run to the end, but for the picture
    struct table table;
    char replaceable[PATH_LIMIT]; ///< "save as" was asked for this existing file once
    struct own_file own_file;
    unsigned last_serial; ///< of the documents that were on the table

    thrd_t main_thread;
    mtx_t working; ///< locked while a frame is made, for a thread that runs out of memory and saves the work

    struct export_job *export_job; ///< NULL where nothing is exported
    struct personal *personal;     ///< NULL where nobody sits at a window

    struct replay *replay; ///< of the demo too
    struct demo demo;
    struct recording *recording;
    struct framelog *log;
    struct frame_row row; ///< of the frame in progress
    double gpu_us;        ///< the last that the graphics card told; 0 where it has no clock
    double frame_start, oldest_event;
    double last_swap; ///< when the last frame's swap ended; NAN where the next one's interval means nothing
    bool fixed_clock; ///< every frame is 1/60 s (headless, replays, recordings)
    bool was_idle;    ///< nothing moved by itself before this frame
    bool lost;        ///< the framebuffer does not hold the last frame
    struct {
        float width, height, scale;
    } display;             ///< the window in logical pixels of the display, device pixels to one of them
    double ui_scale;       ///< as chosen: how large everything is, beyond the display's scale
    double ui_scale_shown; ///< as there is room
    struct pace pace;
    struct resolution resolution;
    double process_start; ///< on the clock
    double last_time, next_time, stats_time;
    long frame, stats_frame;
    bool shown_saved; ///< the window's title
    bool paste;       ///< the editor asked for the clipboard's text: it comes with the next frame's events
    bool quit;
    bool failed; ///< with `error`: the run ends
    struct error error;
};

/// Frees everything the app holds; parts that were never made may be NULL.
void app_free(struct app *app);

/// One frame: input, edit, solve, pose, draw, log.
void app_frame(struct app *app);

/// Puts a new editor on the table, in place of the one that is there, for the display's size.
void app_open_editor(struct app *app);

/// Opens a scene file, or the built-in one for NULL; on failure the document on the table stays.
bool app_open(struct app *app, const char *path, struct error *error);

/// Replaces the document on the table.
void app_adopt(struct app *app, struct document *document);

/// The document's own file; "" for an untitled one.
const char *app_path(const struct app *app);

/// Carries out a request: files, window, end.
void app_requests(struct app *app);
/// Keeps the star in the window's title, which says that there is unsaved work.
void app_show_title(struct app *app);

/// Writes unsaved work to the recovery file, else to a new file beside the scene's own one, and adds its
/// path to the error's sentence.
void app_rescue(struct app *app, struct error *error);

/// From now on need() does that where memory runs out. The calling thread is the one that makes frames.
void app_rescue_without_memory(struct app *app);

/// A new size of the window, in logical pixels of the display.
void app_resize(struct app *app, float width, float height, float scale);

/// The document has to do with that content of its own file: it says the same, or the user has seen it.
void file_watch_note(struct app *app, uint64_t content);

/// The content of the document's own file that was noted; 0: unknown.
uint64_t file_watch_known(const struct app *app);

/// The window has the focus again: asks about a changed file, once for each change.
void file_watch_look(struct app *app);

/// Lays the editor out anew for the display's size, as large as is chosen and as leaves room.
void ui_scale_fit(struct app *app);
/// The same, where presenting or leaving has changed what is wanted.
void ui_scale_update(struct app *app);
/// Turns the window's coordinates into the editor's.
void ui_scale_to_ui(const struct app *app, struct event *event);
/// The next step up (1) or down (-1), or the display's own scale (0). Refuses one that leaves the panels no room.
bool ui_scale_step(struct app *app, int direction, struct error *error);

/// The demo's recording, from its start. NULL with a sentence where it is broken.
struct replay *demo_replay(struct error *error);
/// `dt` seconds on; behind the recording's end the next round begins.
bool demo_next(struct app *app, double dt, struct error *error);

/// The folder in which the editor's dialogs look for files.
void app_connect_files(struct app *app);

// The export that the Export dialog asked for, done beside the frames: a copy of the document is solved and written by a thread, films
// are drawn picture by picture.

/// The formats, in the order that the dialog lists them.
extern const struct dialog_format exporting_formats[];
extern const int exporting_format_count;

/// Begins; the answer comes once exporting_step() is done with it. False with a sentence.
bool exporting_start(struct app *app, const struct request *request, struct error *error);
/// Stops a running export, which then writes nothing; without one, does nothing.
void exporting_stop(struct app *app);
/// Continues a running export, once a frame, and tells the editor. Under a fixed clock it ends in the frame it began in.
void exporting_step(struct app *app);

/// Gives up the export that runs, with nothing written.
void app_stop_export(struct app *app);

/// The clipboard's text. NULL, with a message, if there is none or too much.
const char *app_clipboard_text(struct app *app);

/// Redraws the last frame if its stage was drawn at a lower resolution.
void app_draw_exactly(struct app *app);

/// The picture of the last frame as PNG, always an exact one.
bool app_screenshot(struct app *app, const char *path, struct error *error);

#endif
