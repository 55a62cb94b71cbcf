/// Unsaved work is kept: what is in a recovery file when, who may have it, what the next start offers, and what is left as memory runs out.
#include "blind.h"
#include "folder.h"
#include "questions.h"
#include "world.h"

#include "app/personal.h"
#include "base/need.h"
#include "shown.h"
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <threads.h>
#include <time.h>
#include <unistd.h>

static void wait_a_moment(void) { nanosleep(&(struct timespec){.tv_nsec = 5000000}, NULL); }

/// Empties the folder.
static void begin(void) { folder_run("rm -rf %s && mkdir -p %s/wiggly"); }

// --- a document and its recovery file

struct keeper {
    struct world world;
    struct autosave *autosave;
};

static struct autosave *open_autosave(void)
{
    struct recovery_slot slot;
    assert_done(recovery_claim(folder, &slot, &error));
    return autosave_open(&slot);
}

static void keeper_open(struct keeper *k)
{
    begin();
    world_open(&k->world);
    k->autosave = open_autosave();
}

static void keeper_close(struct keeper *k)
{
    if (k->autosave) autosave_close(k->autosave, false);
    world_close(&k->world);
}

#define KEEPER_TEST(name) TEST_OF(struct keeper, k, keeper_open(k), keeper_close(k), name)

static bool is_there(const struct autosave *autosave) { return access(autosave->slot.path, F_OK) == 0; }

static struct autosave_work work_of(const struct keeper *k)
{
    return (struct autosave_work){.document = k->world.document,
                                  .path = "/home/me/walk.json",
                                  .revision = history_revision(k->world.history),
                                  .saved = history_is_saved(k->world.history)};
}

static void update(const struct keeper *k, double now)
{
    const struct autosave_work work = work_of(k);
    for (int i = 0; i < 4; i++) { // the thread may still be at the last write
        assert_done(autosave_update(k->autosave, &work, now, &error));
        wait_a_moment();
    }
}

/// Updates until the file is there, or gone: what is due may be refused while the thread is at an earlier write.
static void update_until(const struct keeper *k, double now, bool there)
{
    for (int i = 0; i < 3000 && is_there(k->autosave) != there; i++) update(k, now);
    assert_int_equal(is_there(k->autosave), there);
}

/// Nothing while nothing is unsaved; the first edit at once, later ones a second apart; gone with the save.
KEEPER_TEST(when_a_recovery_file_is_written)
{
    static const struct {
        double now;
        bool edits, there;
    } rows[] = {{10, false, false},  {10.1, true, true},
                {10.9, true, false}, // less than a second after the one before
                {11.2, false, true}, // still within two seconds of the edit
                {20, false, false},  {30, true, true}};
    for (int i = 0; i < 6; i++) {
        if (rows[i].edits) world_must(&k->world, edit_insert(&k->world, SWAY, 5 + i, 5));
        if (rows[i].there) update_until(k, rows[i].now, true);
        update(k, rows[i].now);
        wait_a_moment();
        if (is_there(k->autosave) != rows[i].there) fail_msg("at %g s", rows[i].now);
        if (i < 5) unlink(k->autosave->slot.path); // so that the next write shows
    }
    history_mark_saved(k->world.history);
    update_until(k, 30.1, false);
}

/// Finds what was left behind of a path, or the newest; it is the keeper's document.
static void find(const struct keeper *k, const char *of, struct recovery_entry *entry)
{
    assert_true(recovery_find(folder, of, entry, NULL));
    struct document *document = document_of_file(entry->slot.path);
    char *text = text_of_document(document);
    assert_document(&k->world, text);
    free(text);
    document_destroy(document);
}

/// What is left behind is the document, byte for byte, with its path; it is offered once nobody runs on it any more.
KEEPER_TEST(work_is_left_behind)
{
    struct recovery_entry entry;
    struct stat about;
    world_must(&k->world, edit_insert(&k->world, SWAY, 5, 5));
    const struct autosave_work work = work_of(k);
    assert_done(autosave_flush(k->autosave, &work, &error));
    assert_int_equal(stat(k->autosave->slot.path, &about), 0);
    assert_int_equal(about.st_mode & 0777, 0600);
    assert_false(recovery_find(folder, NULL, &entry, NULL)); // the running app's own
    autosave_close(k->autosave, true);
    find(k, NULL, &entry);
    assert_string_equal(entry.origin.path, "/home/me/walk.json");
    k->autosave = open_autosave(); // claimed by the one that asks: others take a slot of their own
    assert_string_not_equal(k->autosave->slot.path, entry.slot.path);
    autosave_move(k->autosave, &entry.slot); // recovered: the file stays until the work is saved
    assert_true(is_there(k->autosave));
    history_mark_saved(k->world.history);
    update_until(k, 1, false);
    autosave_close(k->autosave, false);
    assert_false(recovery_find(folder, NULL, &entry, NULL));
    k->autosave = NULL;
}

/// The document's own path comes back whole, up to the longest that the system takes, with whatever a name may hold.
KEEPER_TEST(any_path_comes_back)
{
    static const struct {
        size_t length;
        const char *end;
    } rows[] = {{1023, "walk.json"},  {1024, "walk.json"},    {PATH_LIMIT - 1, "walk.json"},
                {40, "two\nlines\n"}, {PATH_LIMIT - 1, "\n"}, {16, "\xff.json"}};
    autosave_close(k->autosave, false);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct recovery_entry entry;
        char path[PATH_LIMIT];
        const size_t rest = rows[i].length - strlen(rows[i].end);
        for (size_t c = 0; c < rest; c++) path[c] = c % 200 == 0 ? '/' : 'a';
        strcpy(path + rest, rows[i].end);
        struct autosave_work work = work_of(k);
        work.path = path;
        work.content = UINT64_MAX - 7;
        work.saved = false;
        struct autosave *autosave = open_autosave();
        assert_done(autosave_flush(autosave, &work, &error));
        autosave_close(autosave, true);
        find(k, path, &entry);
        assert_string_equal(entry.origin.path, path);
        assert_true(entry.origin.content == UINT64_MAX - 7);
        unlink(entry.slot.path);
        recovery_release(&entry.slot);
    }
    k->autosave = NULL;
}

/// A folder that cannot be written any more is said once, and tried again.
KEEPER_TEST(a_folder_that_is_gone_is_said_once)
{
    struct error error = {0};
    int complaints = 0;
    folder_run("mv %s %s.away");
    world_must(&k->world, edit_insert(&k->world, SWAY, 5, 5));
    for (int i = 0; i < 100; i++) {
        const struct autosave_work work = work_of(k);
        complaints += !autosave_update(k->autosave, &work, i, &error);
        wait_a_moment();
    }
    assert_int_equal(complaints, 1);
    assert_non_null(strstr(error.text, folder));
    folder_run("mv %s.away %s");
    update(k, 1000);
    update_until(k, 2000, true);
}

#define ASKED "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"asked for\", \"knots\": []}]}"

/// Leaves behind what a killed program does: the scene of one spline that is called so, whose own file is `original`.
static void leave(const char *place, const char *original, const char *name)
{
    struct recovery_slot slot;
    struct scene_origin origin = {.content = 0};
    struct document *document = document_of_text(ASKED);
    assert_done(edit_spline_name(document, 0, name, &error));
    assert_done(recovery_claim(place, &slot, &error));
    snprintf(origin.path, sizeof origin.path, "%s", original);
    assert_done(scene_save_for(document, slot.path, &origin, &error));
    document_destroy(document);
    recovery_release(&slot);
}

/// Several left behind: the newest comes first, and the number is told.
TEST(the_newest_comes_first)
{
    static const char *const left[] = {"/a", "/b", "/c"};
    struct recovery_entry entry;
    struct recovery_slot slot;
    begin();
    assert_done(recovery_claim(folder, &slot, &error)); // so that the order of slots is not that of time
    for (int i = 0; i < 3; i++) {
        leave(folder, left[i], "s");
        if (i == 0) recovery_release(&slot);
        nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL); // the clock of file times is a coarse one
    }
    for (int i = 2, count; i >= 0; i--) {
        assert_true(recovery_find(folder, NULL, &entry, &count));
        assert_int_equal(count, i + 1);
        assert_string_equal(entry.origin.path, left[i]);
        unlink(entry.slot.path);
        recovery_release(&entry.slot);
    }
}

/// kill −9 at any moment of a save leaves the old document or the new one, whole. The larger one takes several writes.
TEST(a_save_that_is_killed_leaves_one_of_two)
{
    struct world small, large;
    char path[80];
    int seen[2] = {0, 0};
    const int kills = quick_or_all(30, 60);
    begin();
    world_open(&small);
    world_open(&large);
    world_must(&large, edit_frames(&large, 0, 4000));
    for (int f = 31; f < 4000; f++) world_must(&large, edit_insert(&large, SWAY, f, sin(f)));
    const char *texts[] = {world_print(&small), world_print(&large)};
    snprintf(path, sizeof path, "%s/mine.json", folder);
    assert_done(scene_save(small.document, path, &error));
    srand(7);
    // Until one save was cut short at least; on a loaded machine they take longer.
    for (int i = 0, status; i < kills || !seen[0] || !seen[1]; i++) {
        assert_true(i < 20 * kills);
        const pid_t child = fork();
        assert_true(child >= 0);
        for (int n = child ? INT_MAX : 0; n < INT_MAX; n++)
            if (!scene_save(n % 2 ? large.document : small.document, path, NULL)) _exit(1);
        nanosleep(&(struct timespec){.tv_nsec = 1000 * (1000 + rand() % 40000) * (1 + i / kills)}, NULL);
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
        assert_true(WIFSIGNALED(status));
        char *data;
        size_t size;
        assert_done(file_read(path, 1 << 24, &data, &size, &error));
        const bool is_large = strcmp(data, texts[1]) == 0;
        if (!is_large) assert_string_equal(data, texts[0]);
        seen[is_large]++;
        free(data);
    }
    world_close(&small);
    world_close(&large);
}

// --- a large scene in the app's frames: soon after an edit, and of one moment

enum { SPLINES = 4, RATE = 60 };

struct large {
    struct blind blind;
    struct autosave *autosave;
    long frame;
};

static int knots(void) { return quick_or_all(1500, 12500); }

/// Knots on every second frame, but for the first two.
static void large_open(struct large *l)
{
    begin();
    FILE *file = fopen(folder_path("large.json"), "w");
    assert_non_null(file);
    fprintf(file, "{\"wiggly\": 1, \"frames\": [0, %d], \"splines\": [", 2 * knots() + 4);
    for (int s = 0; s < SPLINES; s++) {
        fprintf(file, "%s{\"name\": \"s%d\", \"knots\": [", s ? ", " : "", s);
        for (int i = 0; i < knots(); i++)
            fprintf(file, "%s{\"frame\": %d, \"value\": %.17g}", i ? ",\n" : "", 2 * i + 4, sin(i + s));
        fprintf(file, "]}");
    }
    fprintf(file, "]}");
    assert_int_equal(fclose(file), 0);
    blind_open(&l->blind, folder_path("large.json"));
    l->autosave = open_autosave();
}

static const struct document *document_of(const struct large *l) { return l->blind.app.work.document; }

/// A frame with a key's events, unless it is 0, at the pace of a display. Whether there are edits that no copy has.
static bool frame(struct large *l, int key, unsigned mods)
{
    struct app *app = &l->blind.app;
    if (key) blind_send_key(&l->blind, key, mods);
    blind_frame(&l->blind);
    const struct autosave_work work = {.document = document_of(l),
                                       .path = app_path(app),
                                       .revision = history_revision(app->work.history),
                                       .saved = history_is_saved(app->work.history)};
    assert_done(autosave_update(l->autosave, &work, (double)l->frame++ / RATE, &error));
    return autosave_is_behind(l->autosave, &work);
}

/// Frames until a copy is with the thread.
static void copy(struct large *l)
{
    while (frame(l, 0, 0)) continue;
}

/// As a recovery file says it, but for whose work it is.
static char *text_of(struct large *l)
{
    size_t size;
    char *text = scene_print(document_of(l), folder, NULL, &size);
    text[size - strlen("\n}\n")] = '\0';
    return text;
}

/// The thread takes the time that it takes; the display's does not go on meanwhile. Removes the file.
static void assert_kept(const struct large *l, const char *expected)
{
    char *data;
    size_t size;
    for (int i = 0; i < 12000 && !is_there(l->autosave); i++) wait_a_moment();
    assert_done(file_read(l->autosave->slot.path, (size_t)1 << 30, &data, &size, &error));
    const size_t length = expected ? strlen(expected) : 0;
    if (expected && (size < length || strncmp(data, expected, length) != 0))
        fail_msg("the recovery file has another scene");
    assert_non_null(strstr(data + (expected ? length - 1 : 0), "\n  \"recovers\": { \"file\": "));
    free(data);
    assert_int_equal(unlink(l->autosave->slot.path), 0);
}

/// The scene with exactly that edit is on its way to the disk within two seconds of frames, also where a copy has just been taken. The thread
/// must not be waited for: what it takes of the two seconds is a matter of the machine (tests/README.md). Edits while the thread writes
/// are not in the file, not even in part; they are in the next.
TEST_OF(struct large, l, large_open(l), (autosave_close(l->autosave, false), blind_close(&l->blind)),
        a_large_scene_is_kept_soon_and_of_one_moment)
{
    for (int i = 0; i < 3; i++) frame(l, 0, 0);
    frame(l, 'I', 0);
    copy(l);
    assert_kept(l, NULL);
    frame(l, KEY_RIGHT, 0);
    const long edited = l->frame;
    frame(l, 'I', 0);
    assert_int_equal(document_of(l)->splines[0]->knot_count, knots() + 2);
    char *expected = text_of(l);
    copy(l);
    assert_true(l->frame - edited < 2 * RATE);
    assert_kept(l, expected);
    free(expected);

    for (int i = 1; i < SPLINES; i++) frame(l, KEY_PAGE_DOWN, 0); // whose turn comes last
    frame(l, 'I', 0);
    copy(l);
    assert_int_equal(document_of(l)->splines[SPLINES - 1]->knot_count, knots() + 1);
    char *before = text_of(l);
    for (int i = 0; i < 10; i++) frame(l, KEY_UP, MOD_ALT);
    char *after = text_of(l);
    assert_string_not_equal(before, after);
    assert_kept(l, before);
    copy(l);
    assert_kept(l, after);
    free(before);
    free(after);
}

// --- a start after a kill: which scene is on the table, and what is offered

static struct editor *e(const struct blind *b) { return b->app.work.editor; }
static const char *title(const struct blind *b) { return dialog_of(e(b))->question.title; }
static const char *shown(const struct blind *b) { return b->app.work.document->splines[0]->name; }
static const char *state_folder(void) { return folder_path("wiggly"); }

/// Work on another scene is kept, and Enter recovers nothing in place of the one that was asked for. Its own is offered, though another's is
/// newer, whatever name of its file is in the recovery file, and comes once it is wanted.
TEST(a_start_with_a_scene_offers_its_own_work)
{
    static const struct {
        const char *left, *left_later; ///< whose work: files of the folder; "": untitled
        enum dialog_kind asks;
        const char *keys, *says, *shows;
        int remain;
    } rows[] = {
        {NULL, "walk.json", DIALOG_NONE, "", "Unsaved work on walk.json is kept", "asked for", 1},
        {NULL, "walk.json", DIALOG_NONE, "Enter R", "", "asked for", 1},
        {"asked.json", "walk.json", DIALOG_RECOVER, "R", "", "recovered", 1},
        {"asked.json", "", DIALOG_RECOVER, "D", "Unsaved work on an untitled scene is kept", "asked for", 1},
        {"./asked.json", NULL, DIALOG_RECOVER, "R", "", "recovered", 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct blind b;
        struct recovery_entry entry;
        char asked_for[128], place[128], path[200];
        int remain = 0;
        begin();
        strcpy(place, state_folder());
        strcpy(asked_for, folder_file("asked.json", ASKED));
        for (int k = 0; k < 2; k++) {
            const char *left = k ? rows[i].left_later : rows[i].left;
            const int here = open(".", O_RDONLY | O_DIRECTORY);
            snprintf(path, sizeof path, "%s/%s", folder, left ? left : "");
            if (left && left[0] == '.')
                assert_int_equal(chdir(folder), 0); // named from its own folder before the kill
            if (left) leave(place, !left[0] ? "" : left[0] == '.' ? left + 2 : path, k ? "of another" : "recovered");
            assert_int_equal(fchdir(here), 0);
            close(here);
        }
        blind_arrive(&b, asked_for);
        if (asked(e(&b)) != rows[i].asks || strcmp(shown(&b), "asked for") != 0) fail_msg("row %zu", i);
        if (rows[i].asks == DIALOG_RECOVER) assert_non_null(strstr(title(&b), "asked.json"));
        blind_keys(&b, rows[i].keys);
        assert_said(e(&b), rows[i].says);
        if (asked(e(&b)) != DIALOG_NONE || strcmp(shown(&b), rows[i].shows) != 0) fail_msg("row %zu", i);
        assert_string_equal(app_path(&b.app), asked_for);
        blind_leave(&b, false);
        if (recovery_find(place, NULL, &entry, &remain)) recovery_release(&entry.slot);
        assert_int_equal(remain, rows[i].remain);
        if (remain == 0 || rows[i].left_later[0]) continue;
        blind_arrive(&b, NULL);
        assert_non_null(strstr(title(&b), "an untitled scene"));
        blind_leave(&b, false);
    }
}

/// A path of more than 1,023 bytes, with line breaks: the work goes back where it came from, by Ctrl+S, and the dialogs show where that is.
TEST(a_long_path_is_the_same_scene)
{
    struct blind b;
    struct recovery_entry entry;
    char path[PATH_LIMIT], *text;
    begin();
    size_t size, length = (size_t)snprintf(path, sizeof path, "%s", folder);
    for (int i = 0; i < 9; i++) {
        length += (size_t)snprintf(path + length, sizeof path - length, "/%0200d\n", i);
        assert_int_equal(mkdir(path, 0700), 0);
    }
    snprintf(path + length, sizeof path - length, "/walk.json");
    assert_done(file_write_atomic(path, ASKED, strlen(ASKED), &error));
    leave(state_folder(), path, "recovered");
    blind_arrive(&b, NULL);
    blind_keys(&b, "R");
    assert_string_equal(app_path(&b.app), path);
    blind_keys(&b, "^S K"); // what is in the file is not known: keep mine
    assert_string_equal(said(e(&b)), "Saved.");
    assert_done(file_read(path, 1 << 16, &text, &size, &error));
    assert_non_null(strstr(text, "recovered"));
    free(text);
    blind_keys(&b, "^+S");
    assert_string_equal(typed(e(&b)), path);
    blind_keys(&b, "Esc ^E");
    snprintf(path + length, sizeof path - length, "/walk.");
    assert_memory_equal(e(&b)->dialogs->exporting.memory.path, path, strlen(path));
    blind_leave(&b, false);
    assert_false(recovery_find(state_folder(), NULL, &entry, NULL));
}

static bool is_marked(const struct blind *b) { return shown_text(e(b), "Autosave fails: save now (Ctrl+S)") != NULL; }

/// Goes on until it is marked that work has no recovery file, or no longer: a thread writes those, at most one a second.
static void go_on_until(struct blind *b, bool marked)
{
    for (int i = 0; i < 2000 && is_marked(b) != marked; i++) {
        wait_a_moment();
        blind_frame(b);
    }
    assert_int_equal(is_marked(b), marked);
}

/// Its sentence goes with the next key, the mark stays until there is a recovery file, or nothing to lose.
TEST(autosave_that_fails_is_marked)
{
    struct blind b;
    begin();
    blind_arrive(&b, folder_file("asked.json", ASKED));
    folder_run("mv %s/wiggly %s/away");
    blind_keys(&b, "I");
    go_on_until(&b, true);
    assert_said(e(&b), "Unsaved work has no recovery file");
    blind_keys(&b, "Esc");
    assert_string_equal(said(e(&b)), "");
    assert_true(is_marked(&b));
    folder_run("mv %s/away %s/wiggly");
    go_on_until(&b, false);
    folder_run("mv %s/wiggly %s/away");
    blind_keys(&b, "Right I");
    go_on_until(&b, true);
    blind_keys(&b, "^S");
    go_on_until(&b, false);
    blind_leave(&b, false);
    blind_home("/dev/null/none"); // nor can it begin
    blind_arrive(&b, NULL);
    blind_home(folder);
    assert_false(is_marked(&b));
    blind_keys(&b, "I");
    go_on_until(&b, true);
    blind_leave(&b, false);
}

// --- memory that runs out ends the program with one sentence, exit status 3, nothing half-written, and the work in its recovery file

TEST(memory_is_what_was_asked_for)
{
    char *text = need_more(need_text("wiggly"), 100, 1);
    assert_string_equal(text, "wiggly");
    free(text);
    int *zeros = need_zeroed(1000, sizeof *zeros);
    for (int i = 0; i < 1000; i++) assert_int_equal(zeros[i], 0);
    free(zeros);
    free(need(0, 8));
    free(need_more(NULL, 0, 8));
}

static void overflow(void)
{
    struct file_output output;
    if (!file_output_open(&output, folder_path("half"), NULL)) _exit(9);
    fputs("half", output.stream);
    need(SIZE_MAX / 2, 3);
}

static int need_too_much(void *user)
{
    (void)user;
    need(SIZE_MAX, 2);
    return 0;
}

/// All of them together end it once.
static void run_threads(void)
{
    thrd_t threads[4];
    for (int i = 0; i < 4; i++)
        if (thrd_create(&threads[i], need_too_much, NULL) != thrd_success) _exit(9);
    for (int i = 0; i < 4; i++) thrd_join(threads[i], NULL);
}

/// The app at a desk with a knot that autosave has kept, as memory runs out in a thread.
static void run_app(void)
{
    struct blind b;
    blind_arrive(&b, NULL);
    blind_keys(&b, "Right I");
    if (!scene_save(b.app.work.document, folder_path("expected.json"), NULL)) _exit(9);
    while (personal_is_behind(&b.app)) personal_update(&b.app);
    while (access(folder_path("wiggly/recovery-1"), F_OK) != 0) wait_a_moment();
    run_threads();
}

TEST(no_memory_ends_the_program_with_one_sentence)
{
    static const struct {
        void (*run)(void);
        const char *then;
    } rows[] = {{overflow, "[ -z \"$(find %s -name '.wiggly*' -o -name half)\" ]"},
                {run_threads, "true"},
                {run_app, "cmp %s/wiggly/recovery-1 %s/expected.json"}};
    begin();
    for (int i = 0, status; i < 3; i++) {
        char *said_last;
        size_t size;
        const pid_t child = fork();
        if (child == 0) {
            if (!freopen(folder_path("said"), "w", stderr)) _exit(9);
            rows[i].run();
            _exit(0);
        }
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_true(WIFEXITED(status));
        assert_int_equal(WEXITSTATUS(status), 3);
        assert_done(file_read(folder_path("said"), 1 << 16, &said_last, &size, &error));
        assert_string_equal(said_last, "wiggly: out of memory\n");
        free(said_last);
        folder_run(rows[i].then);
    }
}

static int prepare(void **state)
{
    if (folder_make(state) != 0) return -1;
    blind_home(folder);
    return 0;
}

TESTS_BETWEEN(prepare, folder_remove)
