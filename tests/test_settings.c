/// The settings file, and the list of recent files in it.
#include "blind.h"

#include "app/settings.h"
#include "base/file.h"
#include "folder.h"
#include <sys/wait.h>
#include <unistd.h>

static struct settings *load(const char *text)
{
    struct error error;
    struct settings *settings = settings_load(folder_file("settings", text), &error);
    assert_non_null(settings);
    if (error.kind != ERROR_NONE) fail_msg("%s", error.text);
    return settings;
}

static void assert_saved(const struct settings *settings, const char *expected)
{
    char *data;
    size_t size;
    assert_done(settings_save(settings, folder_path("settings"), &error));
    assert_done(file_read(folder_path("settings"), 1 << 20, &data, &size, &error));
    assert_string_equal(data, expected);
    free(data);
}

/// What this program does not know, remarks included, is there again after a save.
TEST_WITH(folder_make, folder_remove, test_unknown_lines_stay)
{
    struct settings *settings = load("# mine\ntheme = dark\n\nfuture = 1 = 2\n");
    assert_string_equal(settings_get(settings, "future", 0), "1 = 2");
    assert_null(settings_get(settings, "future", 1));
    settings_set(settings, "theme", "light");
    settings_set_number(settings, "inspector_width", 300);
    assert_saved(settings, "# mine\ntheme = light\n\nfuture = 1 = 2\ninspector_width = 300\n");
    settings_free(settings);
}

TEST_WITH(folder_make, folder_remove, test_numbers)
{
    struct settings *settings = load("a = 0.25\nb = wide\nc =\nd = inf\n");
    assert_near(settings_number(settings, "a", 1), 0.25, 0);
    assert_near(settings_number(settings, "b", 1), 1, 0);
    assert_near(settings_number(settings, "c", 1), 1, 0);
    assert_near(settings_number(settings, "d", 1), 1, 0);
    assert_near(settings_number(settings, "e", 2), 2, 0);
    settings_free(settings);
}

/// One sentence about the first broken line; the others count.
TEST_WITH(folder_make, folder_remove, test_broken)
{
    struct error error;
    struct settings *settings =
        settings_load(folder_file("settings", "theme dark\n= x\ninspector_width = 300\n"), &error);
    assert_non_null(settings);
    assert_int_equal(error.kind, ERROR_INPUT);
    assert_non_null(strstr(error.text, "settings:1: expected key = value, got \"theme dark\""));
    assert_near(settings_number(settings, "inspector_width", 0), 300, 0);
    settings_free(settings);
    settings = settings_load(folder, &error); // a directory in its place
    assert_non_null(settings);
    assert_int_equal(error.kind, ERROR_INPUT);
    settings_free(settings);
    settings = settings_load(folder_path("none"), &error);
    assert_non_null(settings);
    assert_int_equal(error.kind, ERROR_NONE);
    settings_free(settings);
}

/// A byte order mark is no part of a line, which may come first the next time.
TEST_WITH(folder_make, folder_remove, test_byte_order_marks)
{
    struct settings *settings = load("\xEF\xBB\xBFtheme = dark\n\xEF\xBB\xBF\xEF\xBB\xBF own = 1\n");
    assert_saved(settings, "theme = dark\nown = 1\n");
    settings_free(settings);
}

/// Values that a line cannot hold are left out, never written so that they read back as others.
TEST_WITH(folder_make, folder_remove, test_unstorable)
{
    struct settings *settings = load("recent = /a\n");
    recent_note(settings, folder_file("b\nrecent = c", "{}"));
    recent_note(settings, folder_file("d ", "{}"));
    settings_set(settings, "theme", "light\n");
    assert_saved(settings, "recent = /a\n");
    settings_free(settings);
}

TEST_WITH(folder_make, folder_remove, test_recent)
{
    struct settings *settings = load("theme = dark\n");
    struct dialog_recent files[DIALOG_MAX_RECENT + 4];
    char name[32];
    for (int i = 0; i < 15; i++) {
        snprintf(name, sizeof name, "%d.json", i);
        recent_note(settings, folder_file(name, "{}"));
    }
    recent_note(settings, folder_path("9.json")); // again: it moves to the top
    assert_int_equal(unlink(folder_path("14.json")), 0);
    int count = recent_list(settings, files, DIALOG_MAX_RECENT + 4);
    assert_int_equal(count, DIALOG_MAX_RECENT);
    assert_non_null(strstr(files[0].path, "/9.json"));
    assert_false(files[0].missing);
    assert_non_null(strstr(files[1].path, "/14.json"));
    assert_true(files[1].missing);
    assert_non_null(strstr(files[11].path, "/3.json"));
    for (int i = 1; i < count; i++) assert_null(strstr(files[i].path, "/9.json"));
    settings_free(settings);
}

enum { ROUNDS = 5, EACH = DIALOG_MAX_RECENT / 2 };

static const char *name_of(int window, int i)
{
    static char name[32];
    snprintf(name, sizeof name, "%d-%d.json", window, i);
    return name;
}

/// One window opens its files, each of which is a change of the settings.
static void open_files(int window)
{
    struct blind blind;
    blind_open(&blind, NULL);
    personal_start(&blind.app);
    for (int i = 0; i < EACH; i++) personal_note_file(&blind.app, folder_path(name_of(window, i)));
    personal_end(&blind.app, false);
    blind_close(&blind);
    _exit(0);
}

/// Two windows change the file at the same time: it holds what both have changed.
TEST_WITH(folder_make, folder_remove, test_two_windows)
{
    struct dialog_recent files[DIALOG_MAX_RECENT];
    assert_int_equal(setenv("XDG_CONFIG_HOME", folder, 1), 0);
    assert_int_equal(setenv("XDG_STATE_HOME", folder, 1), 0);
    for (int i = 0; i < 2 * EACH; i++) folder_file(name_of(i % 2, i / 2), "{}");
    for (int round = 0; round < ROUNDS; round++) {
        struct error error;
        unlink(folder_path("wiggly/settings"));
        for (int window = 0; window < 2; window++) {
            if (fork() == 0) open_files(window);
        }
        for (int window = 0, status; window < 2; window++) {
            assert_true(wait(&status) > 0);
            assert_int_equal(status, 0);
        }
        struct settings *settings = settings_load(folder_path("wiggly/settings"), &error);
        assert_non_null(settings);
        assert_int_equal(recent_list(settings, files, DIALOG_MAX_RECENT), 2 * EACH);
        settings_free(settings);
    }
}
