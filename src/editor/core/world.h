/// What the editor is handed, and what it asks of the app. Types alone.
#ifndef EDITOR_CORE_WORLD_H
#define EDITOR_CORE_WORLD_H

#include "base/file.h"
#include "rig/models.h"
#include "rig/posing.h"
#include "scene/edit.h"
#include "scene/evaluate.h"
#include "scene/history.h"
#include "ui/drawlist.h"
#include "ui/event.h"
#include "ui/stage.h"

/// What the editor works on, owned by the app.
struct editor_world {
    struct document *document;
    struct history *history;
    const struct evaluation *evaluation; ///< as of the last solve: the frame before, until editor_show()
    const struct models *models;         ///< the characters' models; NULL: none
};

/// What the editor asks of the app after a frame's events (files and windows are not its business).
enum request_kind {
    REQUEST_NONE,
    REQUEST_NEW,
    REQUEST_OPEN,      ///< path
    REQUEST_ADD,       ///< path: a character or model, to the scene on the table
    REQUEST_SAVE,      ///< to the document's own path, or ask
    REQUEST_SAVE_AS,   ///< path
    REQUEST_OVERWRITE, ///< the document's own file, which somebody else has changed
    REQUEST_KEEP_MINE, ///< the same, but not before the next REQUEST_SAVE
    REQUEST_THEIRS,    ///< the document's file as it is now in place of the document, as a step of the history
    REQUEST_FIGURE,    ///< number: a figure of the paper in place of the document, as a step of the history
    REQUEST_QUIT,
    REQUEST_RECOVER, ///< the work that was offered
    REQUEST_FORGET,  ///< the same, for good
    REQUEST_SCREENSHOT,
    REQUEST_FULLSCREEN,
    REQUEST_UI_SCALE,    ///< number: 1 larger, -1 smaller, 0 as the display's own
    REQUEST_COPY,        ///< editor_clipboard() onto the clipboard
    REQUEST_PASTE,       ///< an EVENT_PASTE with what is there
    REQUEST_EXPORT,      ///< path, wish; answered once it is done
    REQUEST_EXPORT_STOP, ///< the running one; that answers then
};

/// How motion is to be exported. What a format has no use for is ignored; all zero is a good start.
struct export_wish {
    bool part; ///< these frames alone
    double first, last;
    int keys;          ///< a frame; 0: the scene's substeps
    int width, height; ///< of pictures; 0: as the format likes
    char rig[64];      ///< by its name; "": all
    char clip[64];     ///< what the animation is called; "": as the scene
    bool is_cubic, is_signed, transparent;
};

struct request {
    enum request_kind kind;
    int number;
    char path[PATH_LIMIT];
    struct export_wish wish;
};

/// Unsaved work that an earlier run left behind.
struct recovery_offer {
    char name[256]; ///< what its document was called
    char when[64];  ///< date and time, as text
    int others;     ///< older ones there are besides
};

#endif
