/// What a window remembers for the user from run to run: the settings file, looks, panels, recent files and the last export.
#include "blind.h"
#include "folder.h"
#include "questions.h"

#include "app/personal.h"
#include "ui/theme.h"
#include <sys/wait.h>
#include <unistd.h>

static int prepare(void **state)
{
    if (folder_make(state) != 0) return -1;
    blind_home(folder);
    return 0;
}

#define FOLDER_TEST(name) TEST_WITH(prepare, folder_remove, name)

// --- the file

static struct settings *load_file(const char *path)
{
    struct error error;
    struct settings *settings = settings_load(path, &error);
    assert_non_null(settings);
    if (error.kind != ERROR_NONE) fail_msg("%s", error.text);
    return settings;
}

static struct settings *load(const char *text) { return load_file(folder_file("settings", text)); }

/// What this program does not know is there again after a save.
FOLDER_TEST(unknown_keys_stay)
{
    char *data;
    size_t size;
    struct settings *settings = load("\xEF\xBB\xBF{\"theme\": \"dark\", \"future\": {\"a\": [1, 0.1, null]}}");
    assert_string_equal(settings_get(settings, "theme"), "dark");
    settings_set(settings, "theme", "light");
    settings_set_number(settings, "inspector_width", 300.25);
    settings_set_flag(settings, "more", true);
    assert_done(settings_save(settings, folder_path("settings"), &error));
    assert_done(file_read(folder_path("settings"), 1 << 20, &data, &size, &error));
    assert_string_equal(data, "{\n  \"theme\": \"light\",\n  \"future\": {\n    \"a\": [\n      1,\n      0.1,\n"
                              "      null\n    ]\n  },\n  \"inspector_width\": 300.25,\n  \"more\": true\n}\n");
    free(data);
    settings_free(settings);
}

/// A value of another kind is none.
FOLDER_TEST(values_of_each_kind)
{
    static const struct {
        const char *key;
        double number; ///< NAN: none
        int flag;      ///< −1: none
        const char *string;
    } rows[] = {{"a", 0.25, -1, NULL},
                {"b", NAN, -1, "wide"},
                {"c", NAN, true, NULL},
                {"d", 3, -1, NULL},
                {"e", NAN, -1, NULL}};
    struct settings *settings = load("{\"a\": 0.25, \"b\": \"wide\", \"c\": true, \"d\": 3}");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *key = rows[i].key;
        const double number = settings_number(settings, key, 77);
        const char *string = settings_get(settings, key);
        assert_near(number, isnan(rows[i].number) ? 77 : rows[i].number, 0);
        if (settings_flag(settings, key, true) != (rows[i].flag != 0) ||
            settings_flag(settings, key, false) != (rows[i].flag == 1) || !string != !rows[i].string ||
            (string && strcmp(string, rows[i].string) != 0))
            fail_msg("%s: %g \"%s\"", key, number, string ? string : "-");
    }
    settings_free(settings);
}

/// A broken file is said and stays as it is, so that nothing that can be mended is lost.
FOLDER_TEST(broken_settings)
{
    struct error error;
    const char *path = folder_file("settings", "{\"theme\": \"dark\",\n\"more\" true}");
    struct settings *settings = settings_load(path, &error);
    assert_non_null(settings);
    assert_int_equal(error.kind, ERROR_INPUT);
    assert_non_null(strstr(error.text, "settings:2: "));
    assert_null(settings_get(settings, "theme"));
    settings_free(settings);
    for (int i = 0; i < 2; i++) { // or a directory in its place
        assert_null(settings_open(i ? folder : path, &error));
        assert_int_equal(error.kind, ERROR_INPUT);
    }
    settings_free(load_file(folder_path("none")));
}

// --- recent files

/// Newest first, at most so many, each once, with those that are gone marked. Any name of a file is read back as it was.
FOLDER_TEST(recent_files)
{
    static const char *const names[] = {"a\nb", " c ", "\"d\\", "\xFFgr\xC3\xBC\xC3n"};
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
    assert_string_equal(path_name(files[0].path), "9.json");
    assert_false(files[0].missing);
    assert_string_equal(path_name(files[1].path), "14.json");
    assert_true(files[1].missing);
    assert_string_equal(path_name(files[11].path), "3.json");
    for (int i = 1; i < count; i++) assert_string_not_equal(path_name(files[i].path), "9.json");
    for (int i = 0; i < 4; i++) recent_note(settings, folder_file(names[i], "{}"));
    assert_done(settings_save(settings, folder_path("settings"), &error));
    settings_free(settings);
    settings = load_file(folder_path("settings"));
    assert_int_equal(recent_list(settings, files, 5), 5);
    for (int i = 0; i < 4; i++) {
        assert_string_equal(path_name(files[3 - i].path), names[i]);
        assert_false(files[3 - i].missing);
    }
    settings_free(settings);
}

enum { ROUNDS = 5, EACH = DIALOG_MAX_RECENT / 2 };

static const char *name_of(int window, int i)
{
    static char name[32];
    snprintf(name, sizeof name, "%d-%d.json", window, i);
    return name;
}

/// Two windows open files at the same time, each of which is a change of the settings: the file holds what both have changed.
FOLDER_TEST(two_windows)
{
    struct dialog_recent files[DIALOG_MAX_RECENT];
    for (int i = 0; i < 2 * EACH; i++) folder_file(name_of(i % 2, i / 2), "{}");
    for (int round = 0; round < ROUNDS; round++) {
        unlink(folder_path("wiggly/settings"));
        for (int window = 0; window < 2; window++) {
            const pid_t child = fork();
            assert_true(child >= 0);
            if (child != 0) continue;
            struct blind b;
            blind_open(&b, NULL);
            personal_start(&b.app);
            for (int i = 0; i < EACH; i++) personal_note_file(&b.app, folder_path(name_of(window, i)));
            blind_leave(&b, false);
            _exit(0);
        }
        for (int window = 0, status; window < 2; window++) {
            assert_true(wait(&status) > 0);
            assert_int_equal(status, 0);
        }
        struct settings *settings = load_file(folder_path("wiggly/settings"));
        assert_int_equal(recent_list(settings, files, DIALOG_MAX_RECENT), 2 * EACH);
        settings_free(settings);
    }
}

// --- the window

/// As the app starts in a window.
static void start(struct blind *b)
{
    blind_open(b, NULL);
    struct platform *platform = b->app.platform;
    platform->window = (struct window *)platform; // only whether there is one is asked here
    personal_start(&b->app);
    platform->window = NULL;
    assert_non_null(b->app.personal);
}

FOLDER_TEST(looks_and_panels_are_as_they_were_left)
{
    struct blind b;
    const enum theme_kind before = theme_in_use(), other = before == THEME_LIGHT ? THEME_DARK : THEME_LIGHT;
    start(&b);
    theme_use(other);
    b.app.figures.ui_scale = 1.5;
    core_set_panels(&b.app.work.editor->core, 0.4, 333);
    assert_false(is_on(b.app.work.editor, SWITCH_MORE));
    blind_key(&b, KEY_F9, 0);
    assert_true(is_on(b.app.work.editor, SWITCH_KEEP));
    blind_keys(&b, "!A");
    personal_update(&b.app);
    blind_leave(&b, false);
    theme_use(before);

    start(&b);
    assert_int_equal(theme_in_use(), other);
    assert_near(b.app.figures.ui_scale, 1.5, 0);
    assert_true(is_on(b.app.work.editor, SWITCH_MORE));
    assert_false(is_on(b.app.work.editor, SWITCH_KEEP));
    assert_near(layout_of(b.app.work.editor)->stage_share, 0.4, 1e-6);
    assert_near(layout_of(b.app.work.editor)->inspector_width, 333, 1e-9);
    blind_leave(&b, false);
    theme_use(before);
}

/// The card for new users comes until it has been closed once.
FOLDER_TEST(the_welcome_comes_once)
{
    for (int run = 0; run < 3; run++) {
        struct blind b;
        start(&b);
        personal_update(&b.app);
        assert_int_equal(is_welcoming(b.app.work.editor), run < 2);
        blind_frame(&b);
        if (run == 1) {
            blind_keys(&b, "Esc");
            personal_update(&b.app);
        }
        blind_leave(&b, false);
    }
}

/// What cannot be stored is said.
FOLDER_TEST(files_and_the_last_export_are_remembered)
{
    struct blind b;
    struct dialog_recent files[DIALOG_MAX_RECENT];
    struct request request = {.wish = {.is_signed = true, .keys = 3, .width = 640, .height = 360}};
    struct export_memory memory;
    start(&b);
    personal_note_file(&b.app, folder_file("one.json", ""));
    personal_note_file(&b.app, folder_file("two.json", ""));
    snprintf(request.path, sizeof request.path, "%s", folder_path("out.glb"));
    personal_note_export(&b.app, &request);
    blind_leave(&b, false);

    start(&b);
    assert_int_equal(personal_recent(&b.app, files, DIALOG_MAX_RECENT), 2);
    assert_string_equal(files[0].path, folder_path("two.json"));
    assert_string_equal(files[1].path, folder_path("one.json"));
    struct settings *settings = load_file(folder_path("wiggly/settings"));
    export_memory_read(settings, "", &memory);
    settings_free(settings);
    assert_string_equal(memory.path, request.path);
    assert_true(memory.wish.is_signed && memory.wish.keys == 3);
    assert_true(memory.wish.width == 640 && memory.wish.height == 360);
    assert_false(said_error(b.app.work.editor));
    assert_int_equal(rename(folder_path("wiggly"), folder_path("was")), 0);
    folder_file("wiggly", "");
    personal_note_file(&b.app, folder_path("one.json"));
    assert_said_error(b.app.work.editor, "settings");
    assert_int_equal(unlink(folder_path("wiggly")), 0);
    blind_leave(&b, false);
}
