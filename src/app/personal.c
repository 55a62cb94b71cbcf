/// The user's settings, recent files and recovery, for interactive windows.
#include "app/personal.h"
#include "app/autosave.h"
#include "app/folders.h"
#include "app/remembered.h"
#include "app/state.h"
#include "base/file.h"
#include "base/need.h"
#include "base/progress.h"
#include "scene/load.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const char settings_name[] = "settings";

struct personal {
    char settings_path[PATH_LIMIT + 16]; ///< "" where there is no folder for it
    char state_folder[PATH_LIMIT];
    struct autosave *autosave;        ///< NULL: unsaved work is not kept
    struct recovery_entry offered;    ///< what the dialog asks about
    bool is_offered;                  ///< `offered` is claimed
    bool is_new;                      ///< somebody who has not been told yet what to try first
    enum theme_kind theme;            ///< as in the settings
    double ui_scale;                  ///< the same
    double stage_share, panels_width; ///< as they were at the start
};

static void complain(struct app *app, const struct error *error)
{
    if (error->kind != ERROR_NONE) core_message(&app->table.editor->core, true, error->text);
}

/// Another window may have changed the file meanwhile: it is read again for every change, and that one waits until it is written. NULL if
/// there is no file to change.
static struct settings *open_settings(const struct app *app)
{
    const struct personal *personal = app->personal;
    struct error ignored;
    return personal && personal->settings_path[0] ? settings_open(personal->settings_path, &ignored) : NULL;
}

static void store_settings(struct app *app, struct settings *settings)
{
    struct error error = {0};
    if (!settings_save(settings, app->personal->settings_path, &error)) complain(app, &error);
    settings_free(settings);
}

static void store_text(struct app *app, const char *key, const char *value)
{
    struct settings *settings = open_settings(app);
    if (!settings) return;
    settings_set(settings, key, value);
    store_settings(app, settings);
}

static void store_number(struct app *app, const char *key, double value)
{
    struct settings *settings = open_settings(app);
    if (!settings) return;
    settings_set_number(settings, key, value);
    store_settings(app, settings);
}

static void start_theme(struct app *app, const struct settings *settings)
{
    const char *name = settings_get(settings, "theme", 0);
    int kind = name ? theme_find(name) : -1;
    if (kind >= 0 && !app->options->theme) theme_use((enum theme_kind)kind);
    app->personal->theme = theme_in_use();
}

static void start_ui_scale(struct app *app, const struct settings *settings)
{
    const double stored = settings_number(settings, "ui_scale", app->ui_scale);
    if (!(app->options->ui_scale > 0)) app->ui_scale = fmin(fmax(stored, UI_SCALE_LEAST), UI_SCALE_MOST);
    app->personal->ui_scale = app->ui_scale;
    ui_scale_fit(app);
}

static void start_settings(struct app *app)
{
    struct personal *personal = app->personal;
    struct error error = {0};
    char folder[PATH_LIMIT];
    if (folder_make(FOLDER_CONFIG, folder, sizeof folder, &error)) {
        snprintf(personal->settings_path, sizeof personal->settings_path, "%s/%s", folder, settings_name);
    }
    struct settings *settings = personal->settings_path[0] ? settings_open(personal->settings_path, &error) : NULL;
    const struct layout *layout = &app->table.editor->core.layout;
    personal->stage_share = (double)layout->stage_share;
    personal->panels_width = (double)layout->inspector_width;
    if (settings) {
        personal->stage_share = settings_number(settings, "stage_share", personal->stage_share);
        personal->panels_width = settings_number(settings, "inspector_width", personal->panels_width);
        core_set_panels(&app->table.editor->core, personal->stage_share, personal->panels_width);
        start_theme(app, settings);
        start_ui_scale(app, settings);
        struct export_memory memory;
        export_memory_read(settings, app_path(app), &memory);
        dialogs_set_export(app->table.editor->dialogs, &memory);
        personal->is_new = !settings_get(settings, "welcomed", 0);
        if (personal->is_new) dialogs_welcome(app->table.editor->dialogs);
    }
    settings_free(settings);
    complain(app, &error);
}

/// Stores the theme once its key has changed it.
static void note_theme(struct app *app)
{
    if (app->personal->theme == theme_in_use()) return;
    app->personal->theme = theme_in_use();
    store_text(app, "theme", theme()->name);
}

/// Stores the scale once it has been changed.
static void note_ui_scale(struct app *app)
{
    if (app->personal->ui_scale == app->ui_scale || app->options->record || app->options->frames) return;
    app->personal->ui_scale = app->ui_scale;
    store_number(app, "ui_scale", app->ui_scale);
}

/// Once closed, the card for new users does not come back.
static void note_welcomed(struct app *app)
{
    if (!app->personal->is_new || dialogs_is_welcoming(app->table.editor->dialogs)) return;
    app->personal->is_new = false;
    store_text(app, "welcomed", "yes");
}

static void end_settings(struct app *app)
{
    struct personal *personal = app->personal;
    const struct layout *layout = &app->table.editor->core.layout;
    const double share = (double)layout->stage_share, width = (double)layout->inspector_width;
    if (share == personal->stage_share && width == personal->panels_width) return;
    store_number(app, "stage_share", share);
    store_number(app, "inspector_width", width);
}

void personal_note_file(struct app *app, const char *path)
{
    struct settings *settings = path[0] ? open_settings(app) : NULL;
    if (!settings) return;
    recent_note(settings, path);
    store_settings(app, settings);
}

void personal_note_export(struct app *app, const struct request *request)
{
    struct settings *settings = open_settings(app);
    if (!settings) return;
    export_memory_write(settings, request, app_path(app));
    store_settings(app, settings);
}

int personal_recent(void *user, struct dialog_recent *files, int most)
{
    struct app *app = user;
    struct error error = {0};
    struct settings *settings = app->personal ? settings_load(app->personal->settings_path, &error) : NULL;
    int count = settings ? recent_list(settings, files, most) : 0;
    settings_free(settings);
    return count;
}

/// What the document was called whose work a file has.
static const char *name_of(const struct recovery_entry *entry)
{
    return entry->origin.path[0] ? path_name(entry->origin.path) : "an untitled scene";
}

/// Says what else is there, for a start without a scene.
static void mention(struct app *app)
{
    struct recovery_entry entry;
    char sentence[400];
    if (!recovery_find(app->personal->state_folder, NULL, &entry, NULL)) return;
    snprintf(sentence, sizeof sentence, "Unsaved work on %.255s is kept: start wiggly without a scene to recover it.",
             name_of(&entry));
    core_message(&app->table.editor->core, false, sentence);
    recovery_release(&entry.slot);
}

/// Asks about the newest file left behind. Whoever names a scene gets that, and is asked about work on no other.
static void offer(struct app *app)
{
    struct personal *personal = app->personal;
    struct recovery_entry *entry = &personal->offered;
    struct recovery_offer shown = {0};
    const bool named = app->options->scene != NULL;
    int count;
    personal->is_offered = recovery_find(personal->state_folder, named ? app_path(app) : NULL, entry, &count);
    if (!personal->is_offered) {
        if (named) mention(app);
        return;
    }
    snprintf(shown.name, sizeof shown.name, "%.255s", name_of(entry));
    struct tm local;
    if (!localtime_r(&entry->time, &local) ||
        strftime(shown.when, sizeof shown.when, "%d %B %Y, %H:%M:%S", &local) == 0) {
        snprintf(shown.when, sizeof shown.when, "an unknown day");
    }
    shown.others = count - 1;
    dialogs_offer_recovery(app->table.editor->dialogs, &shown);
}

static void start_autosave(struct app *app)
{
    struct personal *personal = app->personal;
    struct error error = {0};
    struct recovery_slot slot;
    if (!folder_make(FOLDER_STATE, personal->state_folder, sizeof personal->state_folder, &error) ||
        !recovery_claim(personal->state_folder, &slot, &error)) {
        complain(app, &error);
        return;
    }
    personal->autosave = autosave_open(&slot);
}

void personal_start(struct app *app)
{
    const struct app_options *o = app->options;
    app->personal = need_zeroed(1, sizeof *app->personal);
    start_autosave(app);
    if (o->record || o->frames) return; // a script must not depend on who runs it
    start_settings(app);
    personal_note_file(app, app_path(app));
    if (app->personal->autosave) offer(app);
}

static struct autosave_work work_of(const struct app *app)
{
    return (struct autosave_work){.document = app->table.document,
                                  .path = app_path(app),
                                  .revision = history_revision(app->table.history),
                                  .content = file_watch_known(app),
                                  .saved = history_is_saved(app->table.history)};
}

void personal_update(struct app *app)
{
    struct error error = {0};
    if (!app->personal) return;
    note_theme(app);
    note_ui_scale(app);
    note_welcomed(app);
    struct autosave *autosave = app->personal->autosave;
    const struct autosave_work work = work_of(app);
    if (autosave && !autosave_update(autosave, &work, clock_now(), &error)) complain(app, &error);
    editor_tell_unkept(app->table.editor, !work.saved && (!autosave || autosave_fails(autosave)));
}

bool personal_is_behind(const struct app *app)
{
    if (!app->personal || !app->personal->autosave) return false;
    const struct autosave_work work = work_of(app);
    return autosave_is_behind(app->personal->autosave, &work);
}

bool personal_recover(struct app *app, struct error *error)
{
    struct personal *personal = app->personal;
    if (!personal || !personal->is_offered) return true;
    struct document *document = scene_load(personal->offered.slot.path, NULL, error);
    if (!document) return false;
    document_set_path(document, personal->offered.origin.path);
    app_adopt(app, document);
    file_watch_note(app, personal->offered.origin.content); // what was written since is theirs
    history_mark_unsaved(app->table.history);
    autosave_move(personal->autosave, &personal->offered.slot);
    personal->is_offered = false;
    return true;
}

bool personal_forget(struct app *app, struct error *error)
{
    (void)error;
    struct personal *personal = app->personal;
    if (!personal || !personal->is_offered) return true;
    recovery_remove(&personal->offered.slot);
    recovery_release(&personal->offered.slot);
    offer(app);
    return true;
}

const char *personal_rescue(struct app *app)
{
    struct error error;
    if (!app->personal || !app->personal->autosave) return NULL;
    struct autosave_work work = work_of(app);
    bool kept = autosave_flush(app->personal->autosave, &work, &error);
    return kept ? autosave_path(app->personal->autosave) : NULL;
}

void personal_end(struct app *app, bool keep)
{
    struct personal *personal = app->personal;
    if (!personal) return;
    end_settings(app);
    if (personal->is_offered) recovery_release(&personal->offered.slot);
    autosave_close(personal->autosave, keep && !history_is_saved(app->table.history));
    free(personal);
    app->personal = NULL;
}
