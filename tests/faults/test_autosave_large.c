/// Recovery files of a large scene, in the app's frames: soon after an edit, of one moment, and there after a kill.
#include "blind.h"
#include "documents.h"

#include "app/recovery.h"
#include "base/file.h"
#include "folder.h"
#include "scene/load.h"
#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { SPLINES = 4, KNOTS = 12500, RATE = 60 };

struct session {
    struct blind blind;
    struct autosave *autosave;
    long frame;
};

/// Knots on every second frame, but for the first two.
static void write_scene(const char *path)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "{\"wiggly\": 1, \"frames\": [0, %d], \"splines\": [", 2 * KNOTS + 4);
    for (int s = 0; s < SPLINES; s++) {
        fprintf(file, "%s{\"name\": \"s%d\", \"knots\": [", s ? ", " : "", s);
        for (int k = 0; k < KNOTS; k++)
            fprintf(file, "%s{\"frame\": %d, \"value\": %.17g}", k ? ",\n" : "", 2 * k + 4, sin(k + s));
        fprintf(file, "]}");
    }
    fprintf(file, "], \"rigs\": []}");
    assert_int_equal(fclose(file), 0);
}

static void open_session(struct session *session)
{
    struct recovery_slot slot;
    char path[128];
    snprintf(path, sizeof path, "%s", folder_path("large.json"));
    write_scene(path);
    *session = (struct session){0};
    blind_open(&session->blind, path);
    assert_done(recovery_claim(folder, &slot, &error));
    session->autosave = autosave_open(&slot);
}

static struct document *document_of(const struct session *session) { return session->blind.app.work.document; }

/// A frame with a key's events, unless it is 0, at the pace of a display. Whether there are edits that no copy has.
static bool frame(struct session *session, int key, unsigned mods)
{
    struct app *app = &session->blind.app;
    if (key) blind_send_key(&session->blind, key, mods);
    blind_frame(&session->blind);
    const struct autosave_work work = {.document = document_of(session),
                                       .path = app_path(app),
                                       .revision = history_revision(app->work.history),
                                       .saved = history_is_saved(app->work.history)};
    assert_done(autosave_update(session->autosave, &work, (double)session->frame++ / RATE, &error));
    return autosave_is_behind(session->autosave, &work);
}

static bool is_there(const struct session *session) { return access(autosave_path(session->autosave), F_OK) == 0; }

/// The thread takes the time that it takes; the display's does not go on meanwhile.
static void wait_for_file(const struct session *session)
{
    for (int i = 0; i < 12000 && !is_there(session); i++) nanosleep(&(struct timespec){.tv_nsec = 5000000}, NULL);
    assert_true(is_there(session));
}

/// As a recovery file says it, but for whose work it is.
static char *text_of(struct session *session)
{
    size_t size;
    char *text = scene_print_for(document_of(session), folder, NULL, &size);
    text[size - strlen("\n}\n")] = '\0';
    return text;
}

static void assert_kept(const char *path, const char *expected)
{
    char *data;
    size_t size;
    assert_done(file_read(path, (size_t)1 << 30, &data, &size, &error));
    assert_true(size > strlen(expected));
    if (strncmp(data, expected, strlen(expected)) != 0) fail_msg("the recovery file has another scene");
    assert_non_null(strstr(data + strlen(expected) - 1, "\n  \"recovers\": { \"file\": "));
    free(data);
}

/// Frames until a copy is with the thread.
static void copy(struct session *session)
{
    while (frame(session, 0, 0)) continue;
}

/// The scene with exactly that edit is on its way to the disk within two seconds of frames, also where a copy has just been taken. The thread
/// must not be waited for: what it takes of the two seconds is a matter of the machine (docs/reliability.md).
static void assert_edit_is_kept(struct session *session)
{
    for (int i = 0; i < 3; i++) frame(session, 0, 0);
    frame(session, 'I', 0);
    copy(session);
    wait_for_file(session);
    assert_int_equal(unlink(autosave_path(session->autosave)), 0);
    frame(session, KEY_RIGHT, 0);
    const long edited = session->frame;
    frame(session, 'I', 0);
    assert_int_equal(document_of(session)->splines[0]->knot_count, KNOTS + 2);
    char *expected = text_of(session);
    copy(session);
    assert_true(session->frame - edited < 2 * RATE);
    wait_for_file(session);
    assert_kept(autosave_path(session->autosave), expected);
    free(expected);
}

/// Edits while the thread writes are not in the file, not even in part; they are in the next.
static void assert_of_one_moment(struct session *session)
{
    assert_int_equal(unlink(autosave_path(session->autosave)), 0);
    for (int i = 1; i < SPLINES; i++) frame(session, KEY_PAGE_DOWN, 0); // whose turn comes last
    frame(session, 'I', 0);
    copy(session);
    assert_int_equal(document_of(session)->splines[SPLINES - 1]->knot_count, KNOTS + 1);
    char *before = text_of(session);
    for (int i = 0; i < 10; i++) frame(session, KEY_UP, MOD_ALT);
    char *after = text_of(session);
    assert_string_not_equal(before, after);
    wait_for_file(session);
    assert_kept(autosave_path(session->autosave), before);
    assert_int_equal(unlink(autosave_path(session->autosave)), 0);
    copy(session);
    wait_for_file(session);
    assert_kept(autosave_path(session->autosave), after);
    free(before);
    free(after);
}

TEST_WITH(folder_make, folder_remove, edits)
{
    struct session session;
    open_session(&session);
    assert_edit_is_kept(&session);
    assert_of_one_moment(&session);
    autosave_close(session.autosave, false);
    blind_close(&session.blind);
}

/// A program that is killed before the next copy leaves the last ones that were written.
TEST_WITH(folder_make, folder_remove, a_kill)
{
    struct recovery_entry entry;
    int status;
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        struct session session;
        open_session(&session);
        frame(&session, 'I', 0);
        copy(&session);
        wait_for_file(&session);
        frame(&session, KEY_RIGHT, 0);
        frame(&session, 'I', 0);
        raise(SIGKILL);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    assert_true(recovery_find(folder, NULL, &entry, NULL));
    struct document *document = document_of_file(entry.slot.path);
    assert_int_equal(document->splines[0]->knot_count, KNOTS + 1);
    assert_int_equal(document->splines[SPLINES - 1]->knot_count, KNOTS);
    recovery_release(&entry.slot);
    document_destroy(document);
}
