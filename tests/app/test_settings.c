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

/// What this program does not know is there again after a save.
TEST_WITH(folder_make, folder_remove, test_unknown_keys_stay)
{
    struct settings *settings = load("\xEF\xBB\xBF{\"theme\": \"dark\", \"future\": {\"a\": [1, 0.1, null]}}");
    assert_string_equal(settings_get(settings, "theme"), "dark");
    settings_set(settings, "theme", "light");
    settings_set_number(settings, "inspector_width", 300.25);
    settings_set_flag(settings, "more", true);
    assert_saved(settings,
                 "{\n  \"theme\": \"light\",\n  \"future\": {\n    \"a\": [\n      1,\n      0.1,\n      null\n"
                 "    ]\n  },\n  \"inspector_width\": 300.25,\n  \"more\": true\n}\n");
    settings_free(settings);
}

TEST_WITH(folder_make, folder_remove, test_values_of_another_kind)
{
    struct settings *settings = load("{\"a\": 0.25, \"b\": \"wide\", \"c\": true, \"d\": 3}");
    assert_near(settings_number(settings, "a", 1), 0.25, 0);
    assert_near(settings_number(settings, "b", 1), 1, 0);
    assert_near(settings_number(settings, "d", 1), 3, 0);
    assert_near(settings_number(settings, "e", 2), 2, 0);
    assert_true(settings_flag(settings, "c", false));
    assert_true(settings_flag(settings, "a", true));
    assert_null(settings_get(settings, "a"));
    settings_free(settings);
}

/// A broken file is said and stays as it is, so that nothing that can be mended is lost.
TEST_WITH(folder_make, folder_remove, test_broken)
{
    struct error error;
    const char *path = folder_file("settings", "{\"theme\": \"dark\",\n\"more\" true}");
    struct settings *settings = settings_load(path, &error);
    assert_non_null(settings);
    assert_int_equal(error.kind, ERROR_INPUT);
    assert_non_null(strstr(error.text, "settings:2: "));
    assert_null(settings_get(settings, "theme"));
    settings_free(settings);
    assert_null(settings_open(path, &error));
    assert_int_equal(error.kind, ERROR_INPUT);
    assert_null(settings_open(folder, &error)); // a directory in its place
    assert_int_equal(error.kind, ERROR_INPUT);
    settings = settings_load(folder_path("none"), &error);
    assert_non_null(settings);
    assert_int_equal(error.kind, ERROR_NONE);
    settings_free(settings);
}

/// Earlier versions wrote lines.
TEST_WITH(folder_make, folder_remove, test_lines)
{
    struct settings *settings =
        load("# mine\ntheme = dark\r\nrecent = /b = c \nrecent = /a\nmore = yes\nui_scale = 1.5\n");
    struct dialog_recent files[2];
    assert_string_equal(settings_get(settings, "theme"), "dark");
    assert_near(settings_number(settings, "ui_scale", 1), 1.5, 0);
    assert_true(settings_flag(settings, "more", false));
    assert_int_equal(recent_list(settings, files, 2), 2);
    assert_string_equal(files[0].path, "/b = c ");
    assert_string_equal(files[1].path, "/a");
    settings_free(settings);
}

/// Any name of a file is read back as it was.
TEST_WITH(folder_make, folder_remove, test_names)
{
    static const char *const names[] = {"a\nb", " c ", "\"d\\", "\xFFgr\xC3\xBC\xC3n"};
    struct settings *settings = load("{}");
    for (int i = 0; i < 4; i++) recent_note(settings, folder_file(names[i], "{}"));
    assert_done(settings_save(settings, folder_path("settings"), &error));
    settings_free(settings);
    struct error error;
    settings = settings_load(folder_path("settings"), &error);
    struct dialog_recent files[5];
    assert_int_equal(recent_list(settings, files, 5), 4);
    for (int i = 0; i < 4; i++) {
        assert_string_equal(path_name(files[3 - i].path), names[i]);
        assert_false(files[3 - i].missing);
    }
    settings_free(settings);
}

TEST_WITH(folder_make, folder_remove, test_recent)
{
    struct settings *settings = load("{\"theme\": \"dark\"}");
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
