/// Saves unsaved work when the program must end: to the recovery file, or else to a new file beside the original.
#include "app/state.h"
#include "base/file.h"
#include "base/need.h"
#include "scene/load.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MAX_NAMES = 1000 };
enum { RESERVE = 64 << 20, LONGEST_WAIT = 2 }; ///< bytes reserved for the rescue; seconds

/// Writes the work into a folder ("": working folder) under an unused name made of `name`.
static bool write_to(const struct app *app, const char *folder, const char *name, char *path, size_t size,
                     struct error *error)
{
    const char *dot = strrchr(name, '.');
    const int stem = (int)(dot && dot > name ? dot - name : (long)strlen(name));
    for (int i = 1; i <= MAX_NAMES; i++) {
        char number[16] = "";
        if (i > 1) snprintf(number, sizeof number, "-%d", i);
        int length =
            snprintf(path, size, "%s%s%.*s.recovered%s.json", folder, folder[0] ? "/" : "", stem, name, number);
        if (length >= (int)size) return fail(error, ERROR_ENVIRONMENT, "%s: the path is too long", name);
        struct stat about; // lstat: even a dangling link is someone's
        if (lstat(path, &about) != 0) return scene_save(app->table.document, path, error);
    }
    return fail(error, ERROR_ENVIRONMENT, "%s: too many recovered scenes are there already", path);
}

/// Tries the scene's folder, the home folder, then a new folder of our own in the temporary directory, where nobody can have planted a
/// link. A file system may refuse the scene's name, with its longer end, so a plain one is tried there, too. Reports the first failure.
static bool write_somewhere(const struct app *app, char *path, size_t size, struct error *error)
{
    char beside[PATH_LIMIT], shared[] = "/tmp/wiggly-XXXXXX";
    const char *home = getenv("HOME"), *plain = "untitled.json";
    const char *own = app_path(app)[0] ? path_name(app_path(app)) : plain;
    struct error other;
    path_folder(app_path(app), beside);
    if (write_to(app, beside, own, path, size, error)) return true;
    if (write_to(app, home ? home : "", own, path, size, &other)) return true;
    if (write_to(app, beside, plain, path, size, &other)) return true;
    if (write_to(app, home ? home : "", plain, path, size, &other)) return true;
    if (!mkdtemp(shared)) return false;
    if (write_to(app, shared, plain, path, size, &other)) return true;
    rmdir(shared);
    return false;
}

void app_rescue(struct app *app, struct error *error)
{
    char path[4096];
    struct error trouble = {0}, why = *error;
    if (app->replay || !app->table.document || history_is_saved(app->table.history))
        return; // a replay can be played again
    const char *kept = personal_rescue(app);
    if (kept) {
        fail(error, why.kind, "%s; the unsaved scene is safe in %s, and the next start offers to recover it",
             why.text, kept);
    } else if (write_somewhere(app, path, sizeof path, &trouble)) {
        fail(error, why.kind, "%s; the unsaved scene is in %s: open it to continue", why.text, path);
    } else {
        fail(error, why.kind, "%s; the unsaved scene is lost: %s", why.text, trouble.text);
    }
}

/// Other threads wait for the end of the frame, when the document is consistent, but not long: the frame may wait for them.
static void on_no_memory(void *user, struct error *error)
{
    struct app *app = user;
    struct timespec until;
    timespec_get(&until, TIME_UTC);
    until.tv_sec += LONGEST_WAIT;
    if (!thrd_equal(thrd_current(), app->main_thread)) mtx_timedlock(&app->working, &until);
    app_rescue(app, error);
}

void app_rescue_without_memory(struct app *app)
{
    app->main_thread = thrd_current();
    need_keep(RESERVE, on_no_memory, app);
}
