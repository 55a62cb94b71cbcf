/// Notices that somebody else has written the document's file, or its paint's.
#include "app/state.h"
#include "base/file.h"
#include "editor/dialogs/dialog_files.h"
#include "scene/load.h"
#include <stdio.h>
#include <string.h>

void theirs_note(struct app *app)
{
    struct own_file *own = &app->own_file;
    snprintf(own->path, sizeof own->path, "%s", app_path(app));
    own->stamp = file_stamp(own->path);
    scene_keep_paint(app->table.document);
}

/// Of the scene's file alone.
static bool scene_differs(struct app *app)
{
    struct own_file *own = &app->own_file;
    if (strcmp(own->path, app_path(app)) != 0) return file_stamp(app_path(app)).is_there; // back by undo: who knows
    return file_stamp_differs(own->path, &own->stamp);
}

bool theirs_stop(struct app *app)
{
    const char *name = app_path(app);
    if (!name[0] || (!scene_differs(app) && !scene_paint_theirs(app->table.document, &name))) return false;
    return editor_ask_changed(app->table.editor, path_name(name), true);
}

void theirs_look(struct app *app)
{
    struct own_file *own = &app->own_file;
    const char *name;
    if (!app_path(app)[0]) return;
    const uint64_t paint = scene_paint_theirs(app->table.document, &name);
    const bool differs = scene_differs(app), scene = differs && file_stamp_differs(app_path(app), &own->asked);
    if (!scene && (paint == 0 || paint == own->asked_paint)) return;
    if (differs) name = app_path(app);
    if (!editor_ask_changed(app->table.editor, path_name(name), false)) return;
    own->asked = file_stamp(app_path(app));
    own->asked_paint = paint;
}
