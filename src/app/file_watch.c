/// Notices that somebody else has written the document's file.
#include "app/state.h"
#include "base/file.h"
#include "editor/editor.h"
#include <stdio.h>
#include <string.h>

void file_watch_note(struct app *app, uint64_t content)
{
    struct own_file *own = &app->own_file;
    snprintf(own->path, sizeof own->path, "%s", app_path(app));
    own->content = content;
}

void file_watch_note_now(struct app *app) { file_watch_note(app, file_content(app_path(app))); }

uint64_t file_watch_known(const struct app *app)
{
    const struct own_file *own = &app->own_file;
    return strcmp(own->path, app_path(app)) == 0 ? own->content
                                                 : 0; // another document's file, back by undo: who knows
}

/// What somebody else has written into the document's file; 0: nothing, or it is gone.
static uint64_t changed_content(const struct app *app)
{
    const uint64_t now = app_path(app)[0] ? file_content(app_path(app)) : 0;
    return now == file_watch_known(app) ? 0 : now;
}

bool file_watch_stops_save(struct app *app)
{
    return changed_content(app) &&
           dialogs_ask_changed(app->table.editor->dialogs, &app->table.editor->core, path_name(app_path(app)), true);
}

void file_watch_look(struct app *app)
{
    const uint64_t now = changed_content(app);
    if (now == 0 || now == app->own_file.asked) return;
    if (dialogs_ask_changed(app->table.editor->dialogs, &app->table.editor->core, path_name(app_path(app)), false))
        app->own_file.asked = now;
}
