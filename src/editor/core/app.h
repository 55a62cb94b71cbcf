/// What the editor and the app know of each other: requests, and what the app lends.
#ifndef EDITOR_CORE_APP_H
#define EDITOR_CORE_APP_H

#include "base/file.h"
#include <stdbool.h>

/// The scene, owned by the app.
struct editor_world {
    struct document *document;
    struct history *history;
    const struct evaluation *evaluation; ///< of the last solve; until editor_show() that is the previous frame's
    const struct models *models;         ///< NULL: none
};

/// What only the app can do, mostly with files and windows.
enum request_kind {
    REQUEST_NONE,
    REQUEST_NEW,
    REQUEST_OPEN,      ///< path
    REQUEST_ADD,       ///< path: a character or model for this scene; number: the active spline
    REQUEST_SAVE,      ///< to the document's path; asks if it has none
    REQUEST_SAVE_AS,   ///< path
    REQUEST_OVERWRITE, ///< the document's file, which another program changed
    REQUEST_KEEP_MINE, ///< keeps the document; the next REQUEST_SAVE overwrites the file
    REQUEST_THEIRS,    ///< loads the document's changed file, in one undo step
    REQUEST_FIGURE,    ///< number: of the paper's figure or built-in scene
    REQUEST_QUIT,
    REQUEST_RECOVER, ///< offered unsaved work
    REQUEST_FORGET,  ///< deletes that work
    REQUEST_SHARE,   ///< a link to the scene
    REQUEST_SCREENSHOT,
    REQUEST_FULLSCREEN,
    REQUEST_UI_SCALE,    ///< number: 1 larger, -1 smaller, 0 the display's own
    REQUEST_COPY,        ///< text to the clipboard
    REQUEST_PASTE,       ///< answered by EVENT_PASTE
    REQUEST_EXPORT,      ///< path, wish; answered when done
    REQUEST_FLESH,       ///< number: a model rig, text: a bone of it or NULL; ends flesh that is being made
    REQUEST_EXPORT_STOP, ///< stops the running export, which then answers
};

/// Export options. A format ignores those it does not have. Zero: defaults.
struct export_wish {
    bool part; ///< only these frames
    double first, last;
    int keys;          ///< per frame; 0: the scene's substeps
    int width, height; ///< of pictures; 0: the format's default
    unsigned rig;      ///< its id; 0: all
    char clip[256];    ///< of the animation; "": the scene's
    bool is_signed, all_clips, transparent;
};

struct request {
    enum request_kind kind;
    int number;
    char path[PATH_LIMIT];
    const char *text;
    struct export_wish wish;
};

/// The last export and its scene file.
struct export_memory {
    char path[PATH_LIMIT], scene[PATH_LIMIT];
    struct export_wish wish;
};

/// Unsaved work of an earlier run.
struct recovery_offer {
    char name[256]; ///< of its document
    char when[64];  ///< date and time
    int others;     ///< number of older ones
};

enum { DIALOG_MAX_RECENT = 12 };

struct dialog_recent {
    char path[PATH_LIMIT]; ///< absolute
    bool missing;          ///< deleted or unreadable
};

/// What status line and Export dialog show of the app.
struct figures {
    double fps, solve_us; ///< frames per second, µs of solving
    double ui_scale;      ///< size of the interface relative to the display's
    float stage_scale;    ///< resolution of the stage per side relative to the window's; 0 means 1
    bool unkept;          ///< unsaved work has no recovery file
    bool makes_flesh;     ///< in the background
    long done, total;     ///< of the running export; total 0: unknown
};

/// What the app does for the editor, which opens no files. Zero: nothing.
struct editor_app {
    void *user;
    /// Carries out a request and answers it by editor_answer(): before it returns, or an export later. No undo step of an event is open.
    void (*carry_out)(void *user, const struct request *request);
    /// Lists the scenes (*.json) and folders (with a trailing '/') in `folder`, sorted. Writes at most `max`, returns how many, or -1 if
    /// the folder cannot be read. NULL: dialogs are plain text fields.
    int (*list)(void *user, const char *folder, char names[][256], int max);
    /// Writes at most `most` recent files, newest first; returns how many. NULL: there are none.
    int (*recent)(void *user, struct dialog_recent *files, int most);
    int format_count;              ///< how many of `export_formats` are offered; 0: no export
    bool in_page;                  ///< it runs in a browser
    bool still;                    ///< no scene plays by itself
    bool stats;                    ///< the status line has frame rate and solve time
    const struct figures *figures; ///< as they are now; NULL: none
};

#endif
