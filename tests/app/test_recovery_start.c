/// A start after a kill: which scene is on the table, and what is offered.
#include "blind.h"
#include "documents.h"
#include "questions.h"

#include "app/recovery.h"
#include "base/file.h"
#include "folder.h"
#include "shown.h"
#include <fcntl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/// A scene of one spline.
static const char *scene_of(const char *name)
{
    static char text[160];
    snprintf(text, sizeof text,
             "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"%s\", \"knots\": []}]}", name);
    return text;
}

static const char *state_folder(void)
{
    static char path[160];
    snprintf(path, sizeof path, "%s/wiggly", getenv("XDG_STATE_HOME"));
    return path;
}

/// What a killed program leaves behind.
static void leave(const char *original, const char *name)
{
    struct recovery_slot slot;
    assert_done(recovery_claim(state_folder(), &slot, &error));
    struct document *document = document_of_text(scene_of(name));
    struct scene_origin origin = {0};
    snprintf(origin.path, sizeof origin.path, "%s", original);
    assert_done(scene_save_for(document, slot.path, &origin, &error));
    document_destroy(document);
    recovery_release(&slot);
}

static int forget_all(void **state)
{
    char path[PATH_LIMIT + 32];
    (void)state;
    for (int n = 1; n <= 4; n++) {
        snprintf(path, sizeof path, "%s/recovery-%d", state_folder(), n);
        unlink(path);
    }
    return 0;
}

static void start(struct blind *blind, const char *scene)
{
    blind_open(blind, scene);
    personal_start(&blind->app);
    blind_frame(blind);
}

static void end(struct blind *blind)
{
    personal_end(&blind->app, false);
    blind_close(blind);
}

static const struct dialog *dialog(const struct blind *blind) { return dialog_of(blind->app.work.editor); }
static const char *message(const struct blind *blind) { return said(blind->app.work.editor); }
static const char *shown(const struct blind *blind) { return blind->app.work.document->splines[0]->name; }

/// Enter would recover: it is not asked about, so that nothing comes in place of the scene.
TEST_WITH(forget_all, NULL, another_scene_is_shown_and_the_work_kept)
{
    struct blind blind;
    struct recovery_entry entry;
    folder_file("asked.json", scene_of("asked for"));
    leave(folder_path("walk.json"), "recovered");
    start(&blind, folder_path("asked.json"));
    assert_int_equal(dialog(&blind)->kind, DIALOG_NONE);
    assert_non_null(strstr(message(&blind), "Unsaved work on walk.json is kept"));
    blind_key(&blind, KEY_ENTER, 0);
    blind_key(&blind, 'R', 0);
    assert_string_equal(shown(&blind), "asked for");
    end(&blind);
    assert_true(recovery_find(state_folder(), NULL, &entry, NULL));
    recovery_release(&entry.slot);
}

/// The newest one of several scenes is not the one asked for; its own work is offered, and comes once it is wanted.
TEST_WITH(forget_all, NULL, its_own_work_is_offered)
{
    struct blind blind;
    folder_file("asked.json", scene_of("asked for"));
    leave(folder_path("asked.json"), "recovered");
    leave(folder_path("walk.json"), "of another");
    start(&blind, folder_path("asked.json"));
    assert_int_equal(dialog(&blind)->kind, DIALOG_RECOVER);
    assert_non_null(strstr(dialog(&blind)->question.title, "asked.json"));
    assert_string_equal(shown(&blind), "asked for");
    blind_key(&blind, 'R', 0);
    assert_string_equal(shown(&blind), "recovered");
    assert_string_equal(app_path(&blind.app), folder_path("asked.json"));
    end(&blind);
}

TEST_WITH(forget_all, NULL, discarded_work_of_its_own_leaves_the_other)
{
    struct blind blind;
    folder_file("asked.json", scene_of("asked for"));
    leave(folder_path("asked.json"), "recovered");
    leave("", "untitled");
    start(&blind, folder_path("asked.json"));
    blind_key(&blind, 'D', 0);
    assert_int_equal(dialog(&blind)->kind, DIALOG_NONE);
    assert_non_null(strstr(message(&blind), "Unsaved work on an untitled scene is kept"));
    assert_string_equal(shown(&blind), "asked for");
    end(&blind);
    start(&blind, NULL);
    assert_non_null(strstr(dialog(&blind)->question.title, "an untitled scene"));
    end(&blind);
}

/// Named from its own folder before the kill, and from elsewhere after it.
TEST_WITH(forget_all, NULL, a_relative_name_is_the_same_scene)
{
    struct blind blind;
    const int here = open(".", O_RDONLY | O_DIRECTORY);
    folder_file("asked.json", scene_of("asked for"));
    assert_int_equal(chdir(folder), 0);
    leave("asked.json", "recovered");
    assert_int_equal(fchdir(here), 0);
    close(here);
    start(&blind, folder_path("asked.json"));
    blind_key(&blind, 'R', 0);
    assert_string_equal(shown(&blind), "recovered");
    assert_string_equal(app_path(&blind.app), folder_path("asked.json"));
    end(&blind);
}

/// A path of more than 1,023 bytes, with line breaks: the work goes back where it came from, by Ctrl+S, and the dialogs show where that is.
TEST_WITH(forget_all, NULL, a_long_path_is_the_same_scene)
{
    struct blind blind;
    struct recovery_entry entry;
    char path[PATH_LIMIT], *text;
    size_t size, length = (size_t)snprintf(path, sizeof path, "%s", folder);
    for (int i = 0; i < 9; i++) {
        length += (size_t)snprintf(path + length, sizeof path - length, "/%0200d\n", i);
        assert_int_equal(mkdir(path, 0700), 0);
    }
    snprintf(path + length, sizeof path - length, "/walk.json");
    assert_done(file_write_atomic(path, scene_of("as saved"), strlen(scene_of("as saved")), &error));
    leave(path, "recovered");
    start(&blind, NULL);
    blind_key(&blind, 'R', 0);
    assert_string_equal(app_path(&blind.app), path);
    blind_key(&blind, 'S', MOD_CTRL);
    blind_key(&blind, 'K', 0); // what is in the file is not known: keep mine
    assert_string_equal(message(&blind), "Saved.");
    assert_done(file_read(path, 1 << 16, &text, &size, &error));
    assert_non_null(strstr(text, "recovered"));
    free(text);
    blind_key(&blind, 'S', MOD_CTRL | MOD_SHIFT);
    assert_string_equal(dialog(&blind)->ui.text.bytes, path);
    blind_key(&blind, KEY_ESCAPE, 0);
    blind_key(&blind, 'E', MOD_CTRL);
    snprintf(path + length, sizeof path - length, "/walk.");
    assert_memory_equal(blind.app.work.editor->dialogs->exporting.memory.path, path, strlen(path));
    end(&blind);
    assert_false(recovery_find(state_folder(), NULL, &entry, NULL));
}

static bool is_marked(const struct blind *blind)
{
    return shown_text(blind->app.work.editor, "Autosave fails: save now (Ctrl+S)") != NULL;
}

/// Goes on until it is marked that work has no recovery file, or no longer: a thread writes those, at most one a second.
static void go_on_until(struct blind *blind, bool marked)
{
    for (int i = 0; i < 2000 && is_marked(blind) != marked; i++) {
        nanosleep(&(struct timespec){.tv_nsec = 5000000}, NULL);
        blind_frame(blind);
    }
    assert_int_equal(is_marked(blind), marked);
}

/// Its sentence goes with the next key, the mark stays until there is a recovery file, or nothing to lose.
TEST_WITH(forget_all, NULL, autosave_that_fails_is_marked)
{
    struct blind blind;
    char away[sizeof folder + 16];
    snprintf(away, sizeof away, "%s/away", folder);
    folder_file("asked.json", scene_of("asked for"));
    start(&blind, folder_path("asked.json"));
    assert_int_equal(rename(state_folder(), away), 0);
    blind_key(&blind, 'I', 0);
    go_on_until(&blind, true);
    assert_non_null(strstr(message(&blind), "Unsaved work has no recovery file"));
    blind_key(&blind, KEY_ESCAPE, 0);
    assert_string_equal(message(&blind), "");
    assert_true(is_marked(&blind));
    assert_int_equal(rename(away, state_folder()), 0);
    go_on_until(&blind, false);
    assert_int_equal(rename(state_folder(), away), 0);
    blind_key(&blind, KEY_RIGHT, 0);
    blind_key(&blind, 'I', 0);
    go_on_until(&blind, true);
    blind_key(&blind, 'S', MOD_CTRL);
    go_on_until(&blind, false);
    end(&blind);
    assert_int_equal(rename(away, state_folder()), 0);
}

TEST_WITH(forget_all, NULL, no_autosave_is_marked)
{
    struct blind blind;
    char folder_of_state[160];
    snprintf(folder_of_state, sizeof folder_of_state, "%s", getenv("XDG_STATE_HOME"));
    assert_int_equal(setenv("XDG_STATE_HOME", "/dev/null/none", 1), 0);
    start(&blind, NULL);
    assert_int_equal(setenv("XDG_STATE_HOME", folder_of_state, 1), 0);
    assert_false(is_marked(&blind));
    blind_key(&blind, 'I', 0);
    go_on_until(&blind, true);
    end(&blind);
}

static int prepare(void **state)
{
    if (folder_make(state) != 0 || setenv("XDG_STATE_HOME", folder, 1) != 0) return -1;
    if (setenv("XDG_CONFIG_HOME", folder_path("config"), 1) != 0) return -1;
    return mkdir(state_folder(), 0700);
}

TESTS_BETWEEN(prepare, folder_remove)
