/// What a window remembers for the user from run to run: looks, panels, recent files and the last export.
#include "blind.h"
#include "folder.h"
#include "questions.h"

#include "app/settings.h"
#include "ui/theme.h"
#include <unistd.h>

/// As the app starts in a window; the folders are the test's own.
static void start(struct blind *blind)
{
    setenv("XDG_CONFIG_HOME", folder, 1);
    setenv("XDG_STATE_HOME", folder, 1);
    blind_open(blind, NULL);
    struct platform *platform = blind->app.platform;
    platform->window = (struct window *)platform; // only whether there is one is asked here
    personal_start(&blind->app);
    platform->window = NULL;
    assert_non_null(blind->app.personal);
}

static void end(struct blind *blind)
{
    personal_end(&blind->app, false);
    blind_close(blind);
}

TEST_WITH(folder_make, folder_remove, looks_and_panels_are_as_they_were_left)
{
    struct blind blind;
    const enum theme_kind before = theme_in_use(),
                          other = theme_find("light") == (int)before ? theme_find("dark") : theme_find("light");
    start(&blind);
    theme_use(other);
    blind.app.figures.ui_scale = 1.5;
    core_set_panels(&blind.app.work.editor->core, 0.4, 333);
    assert_false(is_on(blind.app.work.editor, SWITCH_MORE));
    blind_key(&blind, KEY_F9, 0);
    assert_true(is_on(blind.app.work.editor, SWITCH_KEEP));
    blind_key(&blind, 'A', MOD_ALT);
    personal_update(&blind.app);
    end(&blind);
    theme_use(before);

    start(&blind);
    assert_int_equal(theme_in_use(), other);
    assert_near(blind.app.figures.ui_scale, 1.5, 0);
    assert_true(is_on(blind.app.work.editor, SWITCH_MORE));
    assert_false(is_on(blind.app.work.editor, SWITCH_KEEP));
    assert_near(layout_of(blind.app.work.editor)->stage_share, 0.4, 1e-6);
    assert_near(layout_of(blind.app.work.editor)->inspector_width, 333, 1e-9);
    end(&blind);
    theme_use(before);
}

/// The card for new users comes until it has been closed once.
TEST_WITH(folder_make, folder_remove, the_welcome_comes_once)
{
    struct blind blind;
    for (int run = 0; run < 3; run++) {
        start(&blind);
        personal_update(&blind.app);
        assert_int_equal(is_welcoming(blind.app.work.editor), run < 2);
        blind_frame(&blind);
        if (run == 1) {
            blind_key(&blind, KEY_ESCAPE, 0);
            personal_update(&blind.app);
        }
        end(&blind);
    }
}

TEST_WITH(folder_make, folder_remove, files_and_the_last_export_are_remembered)
{
    struct blind blind;
    struct dialog_recent files[DIALOG_MAX_RECENT];
    struct request request = {.wish = {.is_cubic = true, .keys = 3, .width = 640, .height = 360}};
    struct export_memory memory;
    start(&blind);
    personal_note_file(&blind.app, folder_file("one.json", ""));
    personal_note_file(&blind.app, folder_file("two.json", ""));
    snprintf(request.path, sizeof request.path, "%s", folder_path("out.glb"));
    personal_note_export(&blind.app, &request);
    end(&blind);

    start(&blind);
    assert_int_equal(personal_recent(&blind.app, files, DIALOG_MAX_RECENT), 2);
    assert_string_equal(files[0].path, folder_path("two.json"));
    assert_string_equal(files[1].path, folder_path("one.json"));
    struct error error;
    struct settings *settings = settings_load(folder_path("wiggly/settings"), &error);
    assert_true(settings && error.kind == ERROR_NONE);
    export_memory_read(settings, "", &memory);
    settings_free(settings);
    assert_string_equal(memory.path, request.path);
    assert_true(memory.wish.is_cubic);
    assert_int_equal(memory.wish.keys, 3);
    assert_int_equal(memory.wish.width, 640);
    assert_int_equal(memory.wish.height, 360);
    end(&blind);
}

TEST_WITH(folder_make, folder_remove, settings_that_cannot_be_stored_are_said)
{
    struct blind blind;
    start(&blind);
    personal_note_file(&blind.app, folder_file("one.json", ""));
    const struct message *message = message_of(blind.app.work.editor);
    assert_false(message->is_error);
    assert_int_equal(rename(folder_path("wiggly"), folder_path("was")), 0);
    folder_file("wiggly", "");
    personal_note_file(&blind.app, folder_file("two.json", ""));
    assert_true(message->is_error);
    assert_non_null(strstr(message->text, "settings"));
    assert_int_equal(unlink(folder_path("wiggly")), 0);
    end(&blind);
}
