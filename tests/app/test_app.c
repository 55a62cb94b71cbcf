/// The app's frames and files, without a picture.
#include "blind.h"
#include "documents.h"
#include "folder.h"
#include "questions.h"

#include "scene/load.h"
#include "shown.h"
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { NOBODY = 65534 };

/// At frames 0 and 36.
static const char two_knots[] = "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": "
                                "[{\"frame\": 0, \"value\": 0}, {\"frame\": 36, \"value\": 1}]}]}";

static const char *scene(void) { return folder_path("scene.json"); }

/// Opens a scene in a folder of its own that everybody may read.
static void open_scene(struct blind *blind, const char *text)
{
    assert_int_equal(folder_make(NULL), 0);
    assert_int_equal(chmod(folder, 0755), 0);
    blind_open(blind, folder_file("scene.json", text));
    blind_frame(blind);
}

static void close_scene(struct blind *blind)
{
    blind_close(blind);
    folder_remove(NULL);
}

static const char old_scene[] = "{\"wiggly\": 1, \"frames\": [0, 48], \"rigs\": [{\"type\": \"meadow\"}]}";

/// What an old scene showed and this wiggly does not is said, and saving keeps it.
TEST_OF(struct blind, blind, open_scene(blind, old_scene), close_scene(blind), a_meadow_is_not_lost)
{
    assert_said(blind->app.work.editor, "Meadows are no longer shown");
    blind_key(blind, 'S', MOD_CTRL);
    struct document *saved = document_of_file(scene());
    assert_true(scene_has_meadow(saved));
    document_destroy(saved);
}

static void send_pointer(struct blind *blind, enum event_kind kind, float x, float y)
{
    blind_send(blind, (struct event){.kind = kind, .action = ACTION_PRESS, .clicks = 1, .x = x, .y = y});
}

/// Work is asked about once, and only where it would be lost: a figure that nobody has edited is replaced without a question.
TEST_OF(struct blind, blind, open_scene(blind, two_knots), close_scene(blind), a_figure_asks_before_it_replaces_work)
{
    struct app *app = &blind->app;
    const struct dialog *dialog = dialog_of(app->work.editor);
    blind_key(blind, 'M', 0);
    assert_false(history_is_saved(app->work.history));
    char *edited = text_of_document(app->work.document);
    blind_key(blind, '4', MOD_CTRL);
    assert_int_equal(dialog->kind, DIALOG_UNSAVED);
    blind_key(blind, 'C', 0);
    assert_prints(app->work.document, edited);
    blind_key(blind, '4', MOD_CTRL);
    blind_key(blind, 'S', 0);
    assert_int_equal(dialog->kind, DIALOG_NONE);
    assert_true(app->work.document->spline_count > 1);
    struct document *saved = document_of_file(scene());
    assert_prints(saved, edited);
    document_destroy(saved);
    free(edited);
    const int keys[] = {'1', '9', '7', 'N'};
    for (int k = 0; k < 4; k++) {
        const unsigned serial = app->work.document->serial;
        blind_key(blind, keys[k], MOD_CTRL);
        assert_int_equal(dialog->kind, DIALOG_NONE);
        assert_int_not_equal(app->work.document->serial, serial);
        assert_null(app->work.document->path);
    }
}

/// Events happen in their order: a figure's key before the first movement of a drag ends the press, and the movement is no drag.
TEST_OF(struct blind, blind, open_scene(blind, two_knots), close_scene(blind),
        a_figure_ends_a_press_that_began_in_its_frame)
{
    struct app *app = &blind->app;
    float x, y;
    assert_true(editor_target(app->work.editor, "knot(s,1)", &x, &y, NULL));
    send_pointer(blind, EVENT_POINTER, x, y);
    send_pointer(blind, EVENT_BUTTON, x, y);
    blind_send_key(blind, '4', MOD_CTRL);
    send_pointer(blind, EVENT_POINTER, x, y - 40);
    blind_frame(blind);
    assert_false(history_is_open(app->work.history));
    assert_int_equal(history_count(app->work.history), 0);
    blind_frame(blind);
    assert_true(app->work.document->spline_count > 1);
}

/// Figure 2 is of poles and response: both are in sight at once, from the command line and by its key.
TEST(poles_of_figure_2_are_in_sight)
{
    for (int by_key = 0; by_key < 2; by_key++) {
        struct blind blind;
        float x, y;
        blind_open(&blind, by_key ? NULL : "assets/scenes/figure2.json");
        if (by_key) blind_send_key(&blind, '2', MOD_CTRL);
        blind_frame(&blind);
        blind_frame(&blind);
        struct editor *editor = blind.app.work.editor;
        assert_true(widget_at(editor, "pole.centre", &x, &y));
        const struct draw_command *axis = shown_text(editor, "-1 Hz"); // below the response
        assert_non_null(axis);
        assert_true(axis->y < layout_of(editor)->inspector.y + layout_of(editor)->inspector.h - 40);
        blind_close(&blind);
    }
}

static void open_edited(struct blind *blind)
{
    open_scene(blind, "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}]}");
    blind_key(blind, 'I', 0);
    assert_false(history_is_saved(blind->app.work.history));
}

static void assert_knots_in_file(const char *path, int knots)
{
    struct document *document = document_of_file(path);
    assert_int_equal(document->splines[0]->knot_count, knots);
    document_destroy(document);
}

/// Ctrl+S fails in one sentence that names the file; the work and the file as it was are there, and nothing else is.
static void assert_save_fails(struct blind *blind)
{
    blind_key(blind, 'S', MOD_CTRL);
    const struct message *message = message_of(blind->app.work.editor);
    assert_true(message->is_error);
    assert_non_null(strstr(message->text, scene()));
    assert_null(strchr(message->text, '\n'));
    assert_false(history_is_saved(blind->app.work.history));
    assert_int_equal(blind->app.work.document->splines[0]->knot_count, 1);
    assert_knots_in_file(scene(), 0);
    char command[128];
    snprintf(command, sizeof command, "[ \"$(ls -A %s)\" = scene.json ]", folder);
    assert_int_equal(system(command), 0);
}

/// The same succeeds once there is nothing in its way.
static void assert_save_succeeds(struct blind *blind)
{
    blind_key(blind, 'S', MOD_CTRL);
    assert_true(history_is_saved(blind->app.work.history));
    assert_knots_in_file(scene(), 1);
    unlink(scene());
    assert_int_equal(rmdir(folder), 0); // there was nothing else
}

#define EDITED_TEST(name) TEST_OF(struct blind, b, open_edited(b), close_scene(b), name)

/// A limit of the process stands for the disk that ends.
EDITED_TEST(work_outlives_a_full_disk)
{
    struct rlimit before, small;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    small = before;
    small.rlim_cur = 100;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    assert_save_fails(b);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_save_succeeds(b);
}

EDITED_TEST(work_outlives_a_folder_that_cannot_be_written)
{
    const bool is_root = geteuid() == 0;
    assert_int_equal(chmod(folder, 0555), 0);
    if (is_root) assert_int_equal(seteuid(NOBODY), 0);
    assert_save_fails(b);
    if (is_root) assert_int_equal(seteuid(0), 0);
    assert_int_equal(chmod(folder, 0755), 0);
    assert_save_succeeds(b);
}

/// Saves again and again, a knot more or less each time, until it is killed.
static void save_for_ever(struct blind *blind)
{
    for (;;) {
        blind_send_key(blind, 'Z', MOD_CTRL);
        blind_key(blind, 'S', MOD_CTRL);
        blind_send_key(blind, 'Y', MOD_CTRL);
        blind_key(blind, 'S', MOD_CTRL);
    }
}

EDITED_TEST(a_file_outlives_a_program_that_is_killed_while_it_saves)
{
    for (int i = 0; i < 20; i++) {
        const pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) save_for_ever(b);
        nanosleep(&(struct timespec){.tv_nsec = 3000000 + 700000 * i}, NULL);
        assert_int_equal(kill(child, SIGKILL), 0);
        assert_int_equal(waitpid(child, NULL, 0), child);
        struct document *document = scene_load(scene(), NULL, NULL);
        assert_non_null(document);
        document_destroy(document);
    }
}

/// The last resort never writes through a link that somebody has put in its way.
EDITED_TEST(a_rescue_follows_no_link)
{
    char victim[128];
    snprintf(victim, sizeof victim, "%s", folder_path("victim"));
    assert_int_equal(symlink(victim, folder_path("scene.recovered.json")), 0);
    struct error error = {0};
    fail(&error, ERROR_ENVIRONMENT, "the end");
    app_rescue(&b->app, &error);
    assert_int_not_equal(access(victim, F_OK), 0);
    assert_non_null(strstr(error.text, folder_path("scene.recovered-2.json")));
    assert_knots_in_file(folder_path("scene.recovered-2.json"), 1);
}

/// Where nothing else can be written, it is a folder that nobody could know of and that is the user's alone.
EDITED_TEST(the_last_place_is_ones_own)
{
    struct stat about;
    char *home = getenv("HOME") ? strdup(getenv("HOME")) : NULL;
    document_set_path(b->app.work.document, "/proc/scene.json");
    setenv("HOME", "/proc", 1);
    struct error error = {0};
    fail(&error, ERROR_ENVIRONMENT, "the end");
    app_rescue(&b->app, &error);
    if (home) setenv("HOME", home, 1);
    free(home);
    char rescued[64] = "";
    const char *place = strstr(error.text, "/tmp/wiggly-");
    if (!place || sscanf(place, "%63[^:]", rescued) != 1) fail_msg("%s", error.text);
    assert_knots_in_file(rescued, 1);
    assert_int_equal(unlink(rescued), 0);
    *strrchr(rescued, '/') = '\0';
    assert_int_equal(stat(rescued, &about), 0);
    assert_int_equal(about.st_mode & 0777, 0700);
    assert_int_equal(rmdir(rescued), 0);
}
