/// Notices that somebody else has written the document's file.
#include "app/state.h"
#include "editor/dialogs/dialog_files.h"
#include <stdio.h>
#include <string.h>

void theirs_note(struct app *app)
{
    struct own_file *own = &app->own_file;
    snprintf(own->path, sizeof own->path, "%s", app_path(app));
    own->stamp = file_stamp(own->path);
}

bool theirs_differs(struct app *app)
{
    struct own_file *own = &app->own_file;
    if (!app_path(app)[0]) return false;
    if (strcmp(own->path, app_path(app)) != 0) return file_stamp(app_path(app)).is_there; // back by undo: who knows
    return file_stamp_differs(own->path, &own->stamp);
}

void theirs_look(struct app *app)
{
    struct own_file *own = &app->own_file;
    if (!theirs_differs(app) || !file_stamp_differs(app_path(app), &own->asked)) return;
    if (editor_ask_changed(app->table.editor, false)) own->asked = file_stamp(app_path(app));
}
