/// Saves unsaved work when the program cannot go on: to the recovery file, which the next start offers, or else to a new file
/// beside the original.
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
enum { RESERVE = 64 << 20, LONGEST_WAIT = 2 }; ///< bytes put by for the rescue; seconds

/// A place for the work: `folder` "" is the working folder, `name` has no ending.
struct place {
    const char *folder, *name;
    int name_length;
};

static bool write_to(const struct app *app, const struct place *place, char *path, size_t size, struct error *error)
{
    const char *slash = place->folder[0] ? "/" : "";
    for (int i = 1; i <= MAX_NAMES; i++) {
        char number[16] = "";
        if (i > 1) snprintf(number, sizeof number, "-%d", i);
        int length = snprintf(path, size, "%s%s%.*s.recovered%s.json", place->folder, slash, place->name_length,
                              place->name, number);
        if (length >= (int)size) return fail(error, ERROR_ENVIRONMENT, "%s: the path is too long", place->name);
        struct stat about; // of the name itself: a link that leads nowhere is somebody's
        if (lstat(path, &about) != 0) return scene_save(app->table.document, path, error);
    }
    return fail(error, ERROR_ENVIRONMENT, "%s: too many recovered scenes are there already", path);
}

/// Beside the scene's own file, else in the home folder, else in a new folder of ours where all may write: nobody can have put a link
/// there.
static bool write_somewhere(const struct app *app, char *path, size_t size, struct error *error)
{
    const char *home = getenv("HOME"), *own = app_path(app)[0] ? app_path(app) : "untitled.json";
    const char *name = path_name(own), *dot = strrchr(name, '.');
    int stem = (int)(dot && dot > name ? dot - name : (long)strlen(name));
    const struct place places[] = {
        {"", own, (int)(name - own) + stem},
        {home ? home : "", name, stem},
    };
    char shared[] = "/tmp/wiggly-XXXXXX";
    struct error first = {0};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        if (write_to(app, &places[i], path, size, i == 0 ? &first : error)) return true;
    }
    const struct place last = {shared, name, stem};
    if (mkdtemp(shared)) {
        if (write_to(app, &last, path, size, error)) return true;
        rmdir(shared);
    }
    *error = first;
    return false;
}

void app_rescue(struct app *app, struct error *error)
{
    char path[4096];
    struct error trouble = {0}, why = *error;
    if (!app->table.document || history_is_saved(app->table.history)) return;
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

/// In another thread than the frames' it waits for the end of a frame, for then the document is whole; but not for long: the frame may
/// be waiting for that thread.
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
