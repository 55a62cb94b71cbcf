/// The user's settings, recent files and recovery, in interactive windows.
#include "app/personal.h"
#include "app/state.h"
#include "base/file.h"
#include "base/names.h"
#include "base/need.h"
#include "base/progress.h"
#include "rig/import.h"
#include "scene/load.h"
#include "ui/theme.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/// The settings other than files.
struct choices {
    enum theme_kind theme;
    double ui_scale;
    struct editor_choices editor;
};

struct personal {
    char settings_path[PATH_LIMIT + 16]; ///< "" without a folder
    char state_folder[PATH_LIMIT];
    struct autosave *autosave;     ///< NULL: no autosave
    struct recovery_entry offered; ///< the file that the dialog asks about
    bool is_offered;               ///< `offered` is locked by this program
    struct choices choices;        ///< as last saved
};

/// Makes the user's folder, $XDG_CONFIG_HOME/wiggly or else ~/.config/wiggly, readable by the user only, and writes its path. The base
/// directory specification says to ignore a relative path in the variable.
static bool make_folder(const char *variable, const char *below_home, char path[PATH_LIMIT], struct error *error)
{
    const char *own = getenv(variable), *home = getenv("HOME");
    const bool is_set = own && own[0] == '/';
    if (!is_set && (!home || home[0] != '/'))
        return fail(error, ERROR_ENVIRONMENT, "no home folder: expected HOME or %s, got neither", variable);
    const int length = is_set ? snprintf(path, PATH_LIMIT, "%s/wiggly", own)
                              : snprintf(path, PATH_LIMIT, "%s/%s/wiggly", home, below_home);
    if (length >= PATH_LIMIT) return fail(error, ERROR_ENVIRONMENT, "the path of the folder %s is too long", path);
    for (char *slash = strchr(path + 1, '/');; slash = strchr(slash + 1, '/')) {
        if (slash) *slash = '\0';
        bool made = mkdir(path, 0700) == 0 || errno == EEXIST;
        if (!made) return fail(error, ERROR_ENVIRONMENT, "%s: cannot be made: %s", path, strerror(errno));
        if (!slash) return true;
        *slash = '/';
    }
}

static void complain(struct app *app, const struct error *error)
{
    if (error->kind != ERROR_NONE) editor_message(app->work.editor, true, "%s", error->text);
}

/// Reads the settings again before every change, because another window may have written them; locks them until written. NULL without a
/// file, or with a broken one.
static struct settings *open_settings(struct app *app)
{
    const struct personal *personal = app->personal;
    struct error error = {0};
    if (!personal || !personal->settings_path[0]) return NULL;
    struct settings *settings = settings_open(personal->settings_path, &error);
    complain(app, &error);
    return settings;
}

static void store_settings(struct app *app, struct settings *settings)
{
    struct error error = {0};
    if (!settings_save(settings, app->personal->settings_path, &error)) complain(app, &error);
    settings_free(settings);
}

static struct choices choices_of(const struct app *app)
{
    return (struct choices){theme_in_use(), app->figures.ui_scale, editor_choices(app->work.editor)};
}

/// Saves changed settings. Panel sizes change during drags and are saved only at the end.
static void note_choices(struct app *app, bool ends)
{
    struct choices before = app->personal->choices, now = choices_of(app);
    const struct editor_choices *was = &before.editor;
    struct editor_choices *is = &now.editor;
    is->is_welcomed |= was->is_welcomed; // once closed, the card for new users stays closed
    if (!ends) is->stage_share = was->stage_share, is->inspector_width = was->inspector_width;
    const bool has_moved = is->stage_share != was->stage_share || is->inspector_width != was->inspector_width;
    if (now.theme == before.theme && now.ui_scale == before.ui_scale && !has_moved &&
        is->is_welcomed == was->is_welcomed && is->more == was->more && is->keep == was->keep)
        return;
    app->personal->choices = now;
    struct settings *settings = open_settings(app);
    if (!settings) return;
    if (now.theme != before.theme) settings_set(settings, "theme", theme()->name);
    if (now.ui_scale != before.ui_scale) settings_set_number(settings, "ui_scale", now.ui_scale);
    if (has_moved) settings_set_number(settings, "stage_share", is->stage_share);
    if (has_moved) settings_set_number(settings, "inspector_width", is->inspector_width);
    if (is->is_welcomed && !was->is_welcomed) settings_set_flag(settings, "welcomed", true);
    if (is->more != was->more) settings_set_flag(settings, "more", is->more);
    if (is->keep != was->keep) settings_set_flag(settings, "keep", is->keep);
    store_settings(app, settings);
}

static void start_settings(struct app *app)
{
    struct personal *personal = app->personal;
    struct editor_choices choices = editor_choices(app->work.editor);
    struct error error = {0};
    struct export_memory memory;
    char folder[PATH_LIMIT];
    if (!make_folder("XDG_CONFIG_HOME", ".config", folder, &error)) {
        complain(app, &error);
        return;
    }
    snprintf(personal->settings_path, sizeof personal->settings_path, "%s/settings", folder);
    struct settings *settings = settings_load(personal->settings_path, &error);
    const char *name = settings_get(settings, "theme");
    const int kind = name ? theme_find(name) : -1;
    if (kind >= 0 && !app->options->theme) theme_use((enum theme_kind)kind);
    choices.stage_share = settings_number(settings, "stage_share", choices.stage_share);
    choices.inspector_width = settings_number(settings, "inspector_width", choices.inspector_width);
    choices.more = settings_flag(settings, "more", false);
    choices.keep = settings_flag(settings, "keep", true);
    choices.is_welcomed = settings_flag(settings, "welcomed", false);
    editor_choose(app->work.editor, &choices);
    const double scale = settings_number(settings, "ui_scale", app->figures.ui_scale);
    if (!(app->options->ui_scale > 0)) app->figures.ui_scale = fmin(fmax(scale, UI_SCALE_LEAST), UI_SCALE_MOST);
    ui_scale_fit(app);
    personal->choices = choices_of(app);
    export_memory_read(settings, app_path(app), &memory);
    dialogs_set_export(editor_dialogs(app->work.editor), &memory);
    settings_free(settings);
    complain(app, &error);
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

int personal_recent(struct app *app, struct dialog_recent *files, int most)
{
    struct error error = {0};
    struct settings *settings = app->personal ? settings_load(app->personal->settings_path, &error) : NULL;
    int count = settings ? recent_list(settings, files, most) : 0;
    settings_free(settings);
    return count;
}

/// The document name for a recovery file.
static const char *name_of(const struct recovery_entry *entry)
{
    return entry->origin.path[0] ? path_name(entry->origin.path) : "an untitled scene";
}

/// Offers the newest recovery file. A start with a scene offers that scene's only, but in a page, whose link may be older than the work.
static void offer(struct app *app)
{
    struct personal *personal = app->personal;
    struct recovery_entry *entry = &personal->offered;
    struct recovery_offer shown = {0};
    const bool named = app->options->scene && !platform_in_page();
    int count;
    personal->is_offered = recovery_find(personal->state_folder, named ? app_path(app) : NULL, entry, &count);
    if (!personal->is_offered) {
        struct recovery_entry other;
        if (!named || !recovery_find(personal->state_folder, NULL, &other, NULL)) return;
        editor_message(app->work.editor, false,
                       "Unsaved work on %.*s is kept: start wiggly without a scene to recover it.",
                       name_fit(name_of(&other), 255), name_of(&other));
        recovery_release(&other.slot);
        return;
    }
    printable(name_of(entry), shown.name, sizeof shown.name);
    struct tm local;
    if (!localtime_r(&entry->time, &local) ||
        strftime(shown.when, sizeof shown.when, "%d %B %Y, %H:%M:%S", &local) == 0) {
        snprintf(shown.when, sizeof shown.when, "an unknown day");
    }
    shown.others = count - 1;
    dialogs_offer_recovery(editor_dialogs(app->work.editor), &shown);
}

void personal_start(struct app *app)
{
    const struct app_options *o = app->options;
    struct personal *personal = app->personal = need_zeroed(1, sizeof *personal);
    struct error error = {0};
    struct recovery_slot slot;
    if (make_folder("XDG_STATE_HOME", ".local/state", personal->state_folder, &error) &&
        recovery_claim(personal->state_folder, &slot, &error))
        personal->autosave = autosave_open(&slot);
    complain(app, &error);
    if (o->record || o->frames) return; // a script must not depend on the user
    start_settings(app);
    personal_note_file(app, o->scene && !app_path(app)[0] && import_suits(o->scene) ? o->scene : app_path(app));
    if (personal->autosave) offer(app);
}

static struct autosave_work work_of(const struct app *app)
{
    return (struct autosave_work){.document = app->work.document,
                                  .path = app_path(app),
                                  .revision = history_revision(app->work.history),
                                  .content = app->own_file.content,
                                  .saved = history_is_saved(app->work.history)};
}

void personal_update(struct app *app)
{
    struct error error = {0};
    if (!app->personal) return;
    note_choices(app, false);
    struct autosave *autosave = app->personal->autosave;
    const struct autosave_work work = work_of(app);
    if (autosave && !autosave_update(autosave, &work, clock_now(), &error)) complain(app, &error);
    app->figures.unkept = !work.saved && (!autosave || autosave->complained);
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
    app->own_file.content = personal->offered.origin.content; // a later write counts as another program's
    history_mark_unsaved(app->work.history);
    autosave_move(personal->autosave, &personal->offered.slot);
    personal->is_offered = false;
    return true;
}

void personal_forget(struct app *app)
{
    struct personal *personal = app->personal;
    if (!personal || !personal->is_offered) return;
    unlink(personal->offered.slot.path);
    recovery_release(&personal->offered.slot);
    offer(app);
}

const char *personal_rescue(struct app *app)
{
    struct error error;
    if (!app->personal || !app->personal->autosave) return NULL;
    struct autosave_work work = work_of(app);
    bool kept = autosave_flush(app->personal->autosave, &work, &error);
    return kept ? app->personal->autosave->slot.path : NULL;
}

void personal_end(struct app *app, bool keep)
{
    struct personal *personal = app->personal;
    if (!personal) return;
    note_choices(app, true);
    if (personal->is_offered) recovery_release(&personal->offered.slot);
    autosave_close(personal->autosave, keep && !history_is_saved(app->work.history));
    free(personal);
    app->personal = NULL;
}
