/// A file that another program, or a second window, writes while it is open here: nobody's work is overwritten without a word.
#include "blind.h"
#include "questions.h"

#include "folder.h"
#include "scene/load.h"
#include "shown.h"
#include <fcntl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static const char theirs[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"theirs\", \"knots\": []}]}";

static void focus(struct blind *blind)
{
    blind_send(blind, (struct event){.kind = EVENT_FOCUS});
    blind_frame(blind);
}

static const char *scene(void) { return folder_path("walk.json"); }

static void write_scene(const char *text)
{
    FILE *file = fopen(scene(), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static bool holds(const char *path, const char *name)
{
    char text[4096] = "", quoted[64];
    FILE *file = fopen(path, "r");
    if (!file) return false;
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    snprintf(quoted, sizeof quoted, "\"name\": \"%s\"", name);
    return strstr(text, quoted) != NULL;
}

/// A scene with a knot that is not saved.
static void open_mine(struct blind *blind)
{
    write_scene("{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"mine\", \"knots\": []}]}");
    blind_open(blind, scene());
    blind_frame(blind);
    blind_key(blind, 'I', 0);
    assert_false(history_is_saved(blind->app.work.history));
}

static void open_changed(struct blind *blind)
{
    open_mine(blind);
    write_scene(theirs);
    blind_key(blind, 'S', MOD_CTRL);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_CHANGED);
    assert_string_equal(dialog_of(blind->app.work.editor)->question.title, "walk.json has changed on the disk");
    assert_true(holds(scene(), "theirs"));
}

#define CHANGED_TEST(name) TEST_OF(struct blind, blind, open_changed(blind), blind_close(blind), name)

CHANGED_TEST(keep_mine_writes_it)
{
    blind_key(blind, 'K', 0);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_NONE);
    assert_true(holds(scene(), "mine"));
    assert_true(history_is_saved(blind->app.work.history));
    blind_key(blind, 'I', MOD_SHIFT);
    blind_key(blind, 'S', MOD_CTRL); // mine again: nothing to ask
    assert_int_equal(asked(blind->app.work.editor), DIALOG_NONE);
}

CHANGED_TEST(take_theirs_can_be_undone)
{
    blind_key(blind, 'T', 0);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_NONE);
    assert_string_equal(blind->app.work.document->splines[0]->name, "theirs");
    assert_string_equal(app_path(&blind->app), scene());
    assert_true(history_is_saved(blind->app.work.history));
    blind_key(blind, 'Z', MOD_CTRL);
    assert_string_equal(blind->app.work.document->splines[0]->name, "mine");
    assert_int_equal(blind->app.work.document->splines[0]->knot_count, 1);
    assert_false(history_is_saved(blind->app.work.history));
}

/// Theirs is no scene any more: the sentence says so, and mine stays on the table.
CHANGED_TEST(broken_theirs_is_not_taken)
{
    write_scene("{");
    blind_key(blind, 'T', 0);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_CHANGED);
    assert_non_null(strstr(asked_error(blind->app.work.editor), "walk.json:1"));
    assert_string_equal(blind->app.work.document->splines[0]->name, "mine");
    blind_key(blind, KEY_ESCAPE, 0);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_NONE);
}

CHANGED_TEST(save_as_keeps_both)
{
    blind_key(blind, KEY_ENTER, 0); // the one that loses nothing
    assert_int_equal(asked(blind->app.work.editor), DIALOG_SAVE_AS);
    ui_text_set(&dialog_of(blind->app.work.editor)->ui.text, folder_path("other.json"));
    blind_key(blind, KEY_ENTER, 0);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_NONE);
    assert_true(holds(scene(), "theirs"));
    assert_true(holds(folder_path("other.json"), "mine"));
}

#define MINE_TEST(name) TEST_OF(struct blind, blind, open_mine(blind), blind_close(blind), name)

/// "Save as" under the same name is a save, too.
MINE_TEST(save_as_over_theirs_asks)
{
    write_scene(theirs);
    blind_key(blind, 'S', MOD_CTRL | MOD_SHIFT);
    blind_key(blind, KEY_ENTER, 0);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_CHANGED);
    assert_true(holds(scene(), "theirs"));
}

CHANGED_TEST(cancel_writes_nothing)
{
    blind_key(blind, KEY_ESCAPE, 0);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_NONE);
    assert_true(holds(scene(), "theirs"));
    assert_false(history_is_saved(blind->app.work.history));
    blind_key(blind, 'S', MOD_CTRL);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_CHANGED); // asked again
}

/// Saving on the way out asks as well, and the way out goes on afterwards.
MINE_TEST(quitting_asks_as_well)
{
    write_scene(theirs);
    blind_key(blind, 'Q', MOD_CTRL);
    blind_key(blind, 'S', 0);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_CHANGED);
    blind_send(blind, (struct event){.kind = EVENT_KEY, .key = 'K', .action = ACTION_PRESS});
    app_frame(&blind->app);
    app_frame(&blind->app);
    assert_true(blind->app.quit);
    assert_true(holds(scene(), "mine"));
}

MINE_TEST(focus_asks_once_a_change)
{
    focus(blind);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_NONE);
    write_scene(theirs);
    focus(blind);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_CHANGED);
    blind_key(blind, KEY_ESCAPE, 0);
    focus(blind);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_NONE);
    write_scene("{\"wiggly\": 1, \"splines\": [{\"name\": \"once more\", \"knots\": []}]}");
    focus(blind);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_CHANGED);
    blind_key(blind, 'K', 0);
    assert_true(holds(scene(), "once more")); // not before the next save
    blind_key(blind, 'S', MOD_CTRL);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_NONE);
    assert_true(holds(scene(), "mine"));
}

/// Touched, written over with the same content, or copied onto itself: that is no other file.
MINE_TEST(the_same_content_is_no_change)
{
    blind_key(blind, 'S', MOD_CTRL);
    blind_key(blind, 'I', MOD_SHIFT);
    char command[400];
    snprintf(command, sizeof command, "cp %s %s.copy && mv %s.copy %s && touch -d 2001-01-01 %s", scene(), scene(),
             scene(), scene(), scene());
    assert_int_equal(system(command), 0);
    focus(blind);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_NONE);
    assert_int_equal(unlink(scene()), 0); // nor is one that is gone: saving loses nobody's work
    focus(blind);
    blind_key(blind, 'S', MOD_CTRL);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_NONE);
    assert_true(holds(scene(), "mine"));
}

/// The same size, and the same time to the second: what is in it tells.
MINE_TEST(the_content_counts)
{
    struct stat about;
    assert_int_equal(stat(scene(), &about), 0);
    write_scene("{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"MINE\", \"knots\": []}]}");
    assert_int_equal(utimensat(AT_FDCWD, scene(), (struct timespec[]){about.st_mtim, {about.st_mtim.tv_sec, 1}}, 0),
                     0);
    blind_key(blind, 'S', MOD_CTRL);
    assert_int_equal(asked(blind->app.work.editor), DIALOG_CHANGED);
}

TEST(the_mouse_answers)
{
    static const char *const labels[] = {"Take theirs", "Save as", "Cancel", "Keep mine"};
    for (int i = 0; i < 4; i++) {
        struct blind blind;
        open_changed(&blind);
        const struct draw_command *found = shown_text(blind.app.work.editor, labels[i]);
        if (!found) fail_msg("no button “%s”", labels[i]);
        const float x = found->x + 4, y = found->y - 4;
        blind_send(&blind, (struct event){.kind = EVENT_POINTER, .x = x, .y = y});
        for (int press = 1; press >= 0; press--)
            blind_send(&blind, (struct event){.kind = EVENT_BUTTON,
                                              .action = press ? ACTION_PRESS : ACTION_RELEASE,
                                              .clicks = 1,
                                              .x = x,
                                              .y = y});
        blind_frame(&blind);
        assert_int_equal(asked(blind.app.work.editor), i == 1 ? DIALOG_SAVE_AS : DIALOG_NONE);
        assert_int_equal(holds(scene(), "mine"), i == 3);
        blind_close(&blind);
    }
}

static void open_at_desk(struct blind *blind)
{
    blind_open(blind, scene());
    personal_start(&blind->app);
    blind_frame(blind);
}

static void crash(struct blind *blind)
{
    assert_non_null(personal_rescue(&blind->app));
    personal_end(&blind->app, true);
    blind_close(blind);
}

/// What is recovered began with a file that may be another by now: written before the work was kept, or between the crash and the next
/// start. It is asked about once more where a second crash follows.
TEST(what_others_wrote_before_recovery_is_noticed)
{
    enum { NEVER, ONCE_KEPT, BEFORE };
    for (int when = NEVER; when <= BEFORE; when++) {
        struct blind blind;
        write_scene("{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"mine\", \"knots\": []}]}");
        open_at_desk(&blind);
        blind_key(&blind, 'I', 0);
        if (when == BEFORE) write_scene(theirs);
        crash(&blind);
        if (when == ONCE_KEPT) write_scene(theirs);
        for (int crashes = 0; crashes < 2; crashes++) {
            open_at_desk(&blind);
            assert_int_equal(asked(blind.app.work.editor), DIALOG_RECOVER);
            blind_key(&blind, 'R', 0);
            assert_int_equal(blind.app.work.document->splines[0]->knot_count, 1);
            if (crashes == 0) crash(&blind);
        }
        blind_key(&blind, 'S', MOD_CTRL);
        assert_int_equal(asked(blind.app.work.editor), when == NEVER ? DIALOG_NONE : DIALOG_CHANGED);
        assert_int_equal(holds(scene(), "theirs"), when != NEVER);
        if (when != NEVER) blind_key(&blind, 'K', 0);
        assert_int_equal(asked(blind.app.work.editor), DIALOG_NONE);
        assert_true(holds(scene(), "mine"));
        assert_true(history_is_saved(blind.app.work.history));
        personal_end(&blind.app, false);
        blind_close(&blind);
    }
}

static int prepare(void **state)
{
    if (folder_make(state) != 0) return -1;
    return setenv("XDG_STATE_HOME", folder_path("state"), 1) || setenv("XDG_CONFIG_HOME", folder_path("config"), 1);
}

/// Asks the app for something, and returns what it says about it, once it does.
static const char *answer_to(struct blind *blind, enum request_kind kind, const char *path)
{
    struct core *core = &blind->app.work.editor->core;
    core->message = (struct message){0};
    struct request request = {.kind = kind};
    snprintf(request.path, sizeof request.path, "%s", path ? path : "");
    core_request(core, &request);
    for (int i = 0; i < 2000 && !core->message.text[0]; i++) {
        blind_frame(blind);
        if (i > 1) nanosleep(&(struct timespec){.tv_nsec = 5000000}, NULL); // an export has a thread of its own
    }
    return core->message.text;
}

/// A replay is told that all went well, and the status line where its files are, if anywhere.
MINE_TEST(a_replay_writes_where_it_may)
{
    static const char header[] = "wiggly-replay 1\nsize 1280 720\nframes 1\n";
    static const enum request_kind kinds[] = {REQUEST_EXPORT, REQUEST_SCREENSHOT, REQUEST_SAVE_AS, REQUEST_SAVE};
    char saves[128], own[128];
    const uint64_t before = file_content(scene());
    snprintf(saves, sizeof saves, "%s", folder_path("saves"));
    snprintf(own, sizeof own, "%s", folder_path("own.csv"));
    blind->app.replay = replay_parse("a", header, sizeof header - 1, NULL);
    assert_non_null(blind->app.replay);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const char *text = answer_to(blind, kinds[i], own);
        if (strcmp(text, "Nothing was written: a replay writes only with --saves DIR.") != 0)
            fail_msg("%zu: %s", i, text);
    }
    assert_true(history_is_saved(blind->app.work.history));
    assert_int_not_equal(access(own, F_OK), 0);
    assert_int_equal(mkdir(saves, 0777), 0);
    blind->options.saves = saves;
    assert_non_null(strstr(answer_to(blind, REQUEST_SAVE, NULL), "/saves/own.csv."));
    assert_non_null(strstr(answer_to(blind, REQUEST_SAVE_AS, "/no/../where/else.json"), "/saves/else.json."));
    assert_non_null(strstr(answer_to(blind, REQUEST_SAVE_AS, "/no/where/.."), "expected the path of a file"));
    assert_int_not_equal(access(own, F_OK), 0);
    assert_true(file_content(scene()) == before);
}

/// Opening one would wait for whoever is at its other end; the app goes on, and the work stays unsaved.
TEST(a_pipe_is_neither_read_nor_written)
{
    static const struct {
        enum request_kind kind;
        const char *name;
        int times; ///< what is there is replaced when it is asked for again
    } asked_for[] = {{REQUEST_OVERWRITE, NULL, 1},
                     {REQUEST_SAVE_AS, "pipe.json", 2},
                     {REQUEST_EXPORT, "pipe.csv", 2},
                     {REQUEST_OPEN, "pipe.json", 1},
                     {REQUEST_ADD, "pipe.glb", 1}};
    struct blind blind;
    struct stat about;
    char recovery[160];
    snprintf(recovery, sizeof recovery, "%s/wiggly/recovery-1", getenv("XDG_STATE_HOME"));
    open_mine(&blind);
    unlink(recovery);
    assert_int_equal(mkfifo(recovery, 0600), 0);
    alarm(60); // it would wait for ever
    personal_start(&blind.app);
    personal_end(&blind.app, false);
    unlink(recovery);
    for (size_t i = 0; i < sizeof asked_for / sizeof *asked_for; i++) {
        char path[128];
        snprintf(path, sizeof path, "%s", asked_for[i].name ? folder_path(asked_for[i].name) : scene());
        unlink(path);
        assert_int_equal(mkfifo(path, 0600), 0);
        const char *text = "";
        for (int k = 0; k < asked_for[i].times; k++) text = answer_to(&blind, asked_for[i].kind, path);
        if (!strstr(text, "expected a file, got something else")) fail_msg("%s: \"%s\"", path, text);
        assert_int_equal(stat(path, &about), 0);
        assert_true(S_ISFIFO(about.st_mode));
    }
    assert_false(history_is_saved(blind.app.work.history));
    alarm(0);
    blind_close(&blind);
}

/// Neither a save nor an export replaces a model of the scene, nor an export the scene's own file, however often it is asked for.
TEST(what_the_scene_is_read_from_stays)
{
    static const struct {
        enum request_kind kind;
        const char *name;
    } asked_for[] = {{REQUEST_EXPORT, "dog.glb"},
                     {REQUEST_EXPORT, "linked.glb"},
                     {REQUEST_SAVE_AS, "dog.glb"},
                     {REQUEST_SAVE_AS, "linked.glb"},
                     {REQUEST_EXPORT, "walk.csv"}};
    struct blind blind;
    char command[256], own[128];
    snprintf(command, sizeof command, "cp assets/models/dog.glb %s && ln -s dog.glb %s/linked.glb", folder, folder);
    assert_int_equal(system(command), 0);
    snprintf(own, sizeof own, "%s",
             folder_file("walk.csv", "{\"wiggly\": 1, \"frames\": [0, 9], \"rigs\": "
                                     "[{\"type\": \"model\", \"model\": \"dog.glb\"}]}"));
    const uint64_t model = file_content(folder_path("dog.glb")), scene = file_content(own);
    blind_open(&blind, own);
    blind_frame(&blind);
    for (size_t i = 0; i < sizeof asked_for / sizeof *asked_for; i++) {
        for (int times = 0; times < 2; times++) {
            const char *text = answer_to(&blind, asked_for[i].kind, folder_path(asked_for[i].name));
            if (!strstr(text, "this scene is read from it: choose another name"))
                fail_msg("%s: \"%s\"", asked_for[i].name, text);
        }
        assert_true(file_content(folder_path("dog.glb")) == model);
        assert_true(file_content(own) == scene);
    }
    const char *text = answer_to(&blind, REQUEST_EXPORT, folder_path("other.glb"));
    if (!strstr(text, "Wrote")) fail_msg("%s", text);
    blind_close(&blind);
}

TESTS_BETWEEN(prepare, folder_remove)
