/// Files that the app writes: nobody's work is lost, whoever else writes them, and whoever may not. And who may do what with them then.
#include "blind.h"
#include "documents.h"
#include "folder.h"
#include "questions.h"

#include "shown.h"
#include <errno.h>
#include <fcntl.h>
#include <grp.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <time.h>
#include <unistd.h>

enum { NOBODY = 65534 };

#define SCENE(name) "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"" name "\", \"knots\": []}]}"

static const char *scene(void) { return folder_path("walk.json"); }
static struct editor *e(const struct blind *b) { return b->app.work.editor; }
static bool is_saved(const struct blind *b) { return history_is_saved(b->app.work.history); }
static const struct spline *first_spline(const struct blind *b) { return b->app.work.document->splines[0]; }

/// As another program writes it, over the same file.
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

/// A scene with a knot that is not saved, in an empty folder that everybody may read.
static void open_mine(struct blind *b)
{
    folder_run("rm -rf %s && mkdir %s && chmod 755 %s");
    write_scene(SCENE("mine"));
    blind_open(b, scene());
    blind_frame(b);
    blind_key(b, 'I', 0);
    assert_false(is_saved(b));
}

#define MINE_TEST(name) TEST_OF(struct blind, b, open_mine(b), blind_close(b), name)

// --- what the user does

/// What an old scene showed and this wiggly does not is said, and saving keeps it.
TEST(a_meadow_is_not_lost)
{
    struct blind b;
    blind_open(&b,
               folder_file("walk.json", "{\"wiggly\": 1, \"frames\": [0, 48], \"rigs\": [{\"type\": \"meadow\"}]}"));
    blind_frame(&b);
    assert_said(e(&b), "Meadows are no longer shown");
    blind_keys(&b, "^S");
    struct document *saved = document_of_file(scene());
    assert_true(scene_has_meadow(saved));
    document_destroy(saved);
    blind_close(&b);
}

/// Work is asked about once, and only where it would be lost: a figure that nobody has edited is replaced without a question.
MINE_TEST(a_figure_asks_before_it_replaces_work)
{
    struct app *app = &b->app;
    char *edited = text_of_document(app->work.document);
    blind_send_example(b, "figure 4");
    blind_frame(b);
    assert_int_equal(asked(e(b)), DIALOG_UNSAVED);
    blind_keys(b, "C");
    assert_prints(app->work.document, edited);
    blind_send_example(b, "figure 4");
    blind_frame(b);
    blind_keys(b, "S");
    assert_int_equal(asked(e(b)), DIALOG_NONE);
    assert_true(app->work.document->spline_count > 1);
    struct document *saved = document_of_file(scene());
    assert_prints(saved, edited);
    document_destroy(saved);
    free(edited);
    for (const char *const *words = (const char *const[]){"figure 1", "hands", "figure 7", NULL}; *words; words++) {
        const unsigned serial = app->work.document->serial;
        blind_send_example(b, *words);
        blind_frame(b);
        assert_int_equal(asked(e(b)), DIALOG_NONE);
        assert_int_not_equal(app->work.document->serial, serial);
        assert_null(app->work.document->path);
    }
}

// --- a disk that is full, a folder that is locked, a program that ends

static void assert_knots_in_file(const char *path, int knots)
{
    struct document *document = document_of_file(path);
    assert_int_equal(document->splines[0]->knot_count, knots);
    document_destroy(document);
}

/// Ctrl+S fails in one sentence that names the file; the work and the file as it was are there, and nothing else is.
static void assert_save_fails(struct blind *b)
{
    blind_keys(b, "^S");
    assert_said_error(e(b), scene());
    assert_null(strchr(said(e(b)), '\n'));
    assert_false(is_saved(b));
    assert_int_equal(first_spline(b)->knot_count, 1);
    assert_knots_in_file(scene(), 0);
    folder_run("[ \"$(ls -A %s)\" = walk.json ]");
}

/// A limit of the process stands for the disk that ends. It succeeds once there is nothing in its way.
MINE_TEST(work_outlives_a_full_disk_and_a_locked_folder)
{
    struct rlimit before, small;
    const bool is_root = geteuid() == 0;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    small = before;
    small.rlim_cur = 100;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    assert_save_fails(b);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_int_equal(chmod(folder, 0555), 0);
    if (is_root) assert_int_equal(seteuid(NOBODY), 0);
    assert_save_fails(b);
    if (is_root) assert_int_equal(seteuid(0), 0);
    assert_int_equal(chmod(folder, 0755), 0);
    blind_keys(b, "^S");
    assert_true(is_saved(b));
    assert_knots_in_file(scene(), 1);
    folder_run("[ \"$(ls -A %s)\" = walk.json ]");
}

/// Rescues the work, and returns where it is then.
static const char *rescue(struct blind *b, const char *beginning)
{
    static char place[128];
    struct error error = {0};
    fail(&error, ERROR_ENVIRONMENT, "the end");
    app_rescue(&b->app, &error);
    const char *found = strstr(error.text, beginning);
    if (!found || sscanf(found, "%127[^:]", place) != 1) fail_msg("%s", error.text);
    assert_knots_in_file(place, 1);
    return place;
}

/// Where nothing else can be written, the last resort is a folder that nobody could know of and that is the user's alone.
MINE_TEST(the_last_place_of_a_rescue_is_ones_own)
{
    struct stat about;
    char *home = getenv("HOME") ? strdup(getenv("HOME")) : NULL;
    setenv("HOME", "/proc", 1);
    char place[128];
    strcpy(place, rescue(b, "/tmp/wiggly-"));
    if (home) setenv("HOME", home, 1);
    free(home);
    assert_int_equal(unlink(place), 0);
    *strrchr(place, '/') = '\0';
    assert_int_equal(stat(place, &about), 0);
    assert_int_equal(about.st_mode & 0777, 0700);
    assert_int_equal(rmdir(place), 0);
}

// --- what another program, or a second window, writes while it is open here

static void open_changed(struct blind *b)
{
    open_mine(b);
    write_scene(SCENE("theirs"));
    blind_keys(b, "^S");
    assert_int_equal(asked(e(b)), DIALOG_CHANGED);
    assert_string_equal(dialog_of(e(b))->question.title, "walk.json has changed on the disk");
    assert_true(holds(scene(), "theirs"));
}

/// Each by its key and by the mouse; then keys, and what is asked, on the disk and on the table after them.
TEST(each_answer_about_a_file_that_has_changed)
{
    static const struct {
        const char *label, *key;
        enum dialog_kind then;
        const char *file;
        bool saved;
        const char *later_keys;
        enum dialog_kind later;
        const char *later_file, *table;
        bool later_saved;
    } rows[] = {
        {"Keep mine", "K", DIALOG_NONE, "mine", true, "+I ^S", DIALOG_NONE, "mine", "mine", true},
        {"Take theirs", "T", DIALOG_NONE, "theirs", true, "^Z", DIALOG_NONE, "theirs", "mine", false},
        {"Save as", "Enter", DIALOG_SAVE_AS, "theirs", false, "Enter", DIALOG_NONE, "theirs", "mine", true},
        {"Cancel", "Esc", DIALOG_NONE, "theirs", false, "^S", DIALOG_CHANGED, "theirs", "mine", false},
    };
    for (int i = 0; i < 8; i++) {
        struct blind b;
        const int r = i / 2;
        open_changed(&b);
        const struct draw_command *found = shown_text(e(&b), rows[r].label);
        if (!found) fail_msg("no button “%s”", rows[r].label);
        if (i % 2)
            blind_click(&b, found->x + 4, found->y - 4);
        else
            blind_keys(&b, rows[r].key);
        if (asked(e(&b)) != rows[r].then || !holds(scene(), rows[r].file) || is_saved(&b) != rows[r].saved)
            fail_msg("%s, %d", rows[r].label, i % 2);
        if (r == 1) {
            assert_string_equal(first_spline(&b)->name, "theirs");
            assert_string_equal(app_path(&b.app), scene());
        }
        if (r == 2) ui_text_set(&dialog_of(e(&b))->ui.text, folder_path("other.json"));
        blind_keys(&b, rows[r].later_keys);
        if (asked(e(&b)) != rows[r].later || !holds(scene(), rows[r].later_file) ||
            strcmp(first_spline(&b)->name, rows[r].table) != 0 || is_saved(&b) != rows[r].later_saved)
            fail_msg("%s, %d, later", rows[r].label, i % 2);
        assert_int_equal(first_spline(&b)->knot_count, 1);
        assert_int_equal(holds(folder_path("other.json"), "mine"), r == 2);
        blind_close(&b);
    }
}

/// Theirs is no scene any more: the sentence says so, and mine stays on the table.
TEST_OF(struct blind, b, open_changed(b), blind_close(b), broken_theirs_is_not_taken)
{
    write_scene("{");
    blind_keys(b, "T");
    assert_int_equal(asked(e(b)), DIALOG_CHANGED);
    assert_non_null(strstr(asked_error(e(b)), "walk.json:1"));
    assert_string_equal(first_spline(b)->name, "mine");
    blind_keys(b, "Esc");
    assert_int_equal(asked(e(b)), DIALOG_NONE);
}

static void focus(struct blind *b, enum dialog_kind asks)
{
    blind_send(b, (struct event){.kind = EVENT_FOCUS});
    blind_frame(b);
    assert_int_equal(asked(e(b)), asks);
}

/// "Save as" under the same name is a save, too. Saving on the way out asks as well, and the way out goes on afterwards.
MINE_TEST(every_way_of_saving_asks)
{
    write_scene(SCENE("theirs"));
    blind_keys(b, "^+S Enter");
    assert_int_equal(asked(e(b)), DIALOG_CHANGED);
    blind_keys(b, "Esc ^Q S");
    assert_int_equal(asked(e(b)), DIALOG_CHANGED);
    assert_true(holds(scene(), "theirs"));
    blind_send(b, (struct event){.kind = EVENT_KEY, .key = 'K', .action = ACTION_PRESS});
    app_frame(&b->app);
    app_frame(&b->app);
    assert_true(b->app.quit);
    assert_true(holds(scene(), "mine"));
}

MINE_TEST(focus_asks_once_a_change)
{
    focus(b, DIALOG_NONE);
    write_scene(SCENE("theirs"));
    focus(b, DIALOG_CHANGED);
    blind_keys(b, "Esc");
    focus(b, DIALOG_NONE);
    write_scene(SCENE("once more"));
    focus(b, DIALOG_CHANGED);
    blind_keys(b, "K");
    assert_true(holds(scene(), "once more")); // not before the next save
    blind_keys(b, "^S");
    assert_int_equal(asked(e(b)), DIALOG_NONE);
    assert_true(holds(scene(), "mine"));
}

/// Touched, written over with the same content, or copied onto itself: that is no other file. The same size, and the same time to the
/// second: what is in it tells.
MINE_TEST(the_content_counts)
{
    struct stat about;
    assert_int_equal(stat(scene(), &about), 0);
    write_scene(SCENE("MINE"));
    assert_int_equal(utimensat(AT_FDCWD, scene(), (struct timespec[]){about.st_mtim, {about.st_mtim.tv_sec, 1}}, 0),
                     0);
    blind_keys(b, "^S");
    assert_int_equal(asked(e(b)), DIALOG_CHANGED);
    blind_keys(b, "K +I");
    folder_run("cd %s && cp walk.json copy && mv copy walk.json && touch -d 2001-01-01 walk.json");
    focus(b, DIALOG_NONE);
    assert_int_equal(unlink(scene()), 0); // nor is one that is gone: saving loses nobody's work
    focus(b, DIALOG_NONE);
    blind_keys(b, "^S");
    assert_int_equal(asked(e(b)), DIALOG_NONE);
    assert_true(holds(scene(), "mine"));
}

static void crash(struct blind *b)
{
    assert_non_null(personal_rescue(&b->app));
    blind_leave(b, true);
}

/// What is recovered began with a file that may be another by now: written before the work was kept, or between the crash and the next
/// start. It is asked about once more where a second crash follows.
TEST(what_others_wrote_before_recovery_is_noticed)
{
    enum { NEVER, ONCE_KEPT, BEFORE };
    for (int when = NEVER; when <= BEFORE; when++) {
        struct blind b;
        write_scene(SCENE("mine"));
        blind_arrive(&b, scene());
        blind_keys(&b, "I");
        if (when == BEFORE) write_scene(SCENE("theirs"));
        crash(&b);
        if (when == ONCE_KEPT) write_scene(SCENE("theirs"));
        for (int crashes = 0; crashes < 2; crashes++) {
            blind_arrive(&b, scene());
            assert_int_equal(asked(e(&b)), DIALOG_RECOVER);
            blind_keys(&b, "R");
            assert_int_equal(first_spline(&b)->knot_count, 1);
            if (crashes == 0) crash(&b);
        }
        blind_keys(&b, "^S");
        assert_int_equal(asked(e(&b)), when == NEVER ? DIALOG_NONE : DIALOG_CHANGED);
        assert_int_equal(holds(scene(), "theirs"), when != NEVER);
        if (when != NEVER) blind_keys(&b, "K");
        assert_int_equal(asked(e(&b)), DIALOG_NONE);
        assert_true(holds(scene(), "mine"));
        assert_true(is_saved(&b));
        blind_leave(&b, false);
    }
}

// --- what is asked of the app, where it may not write

/// Asks the app for something; it must say this, once it does.
static void ask(struct blind *b, enum request_kind kind, const char *path, const char *says)
{
    struct core *core = &e(b)->core;
    struct request request = {.kind = kind};
    core->message = (struct message){0};
    snprintf(request.path, sizeof request.path, "%s", path ? path : "");
    core_request(core, &request);
    for (int i = 0; i < 2000 && !core->message.text[0]; i++) {
        blind_frame(b);
        if (i > 1) nanosleep(&(struct timespec){.tv_nsec = 5000000}, NULL); // an export has a thread of its own
    }
    if (!strstr(said(e(b)), says)) fail_msg("%d, %s: \"%s\"", (int)kind, path, said(e(b)));
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
    assert_done(b->app.replay = replay_parse("a", header, sizeof header - 1, &error));
    for (int i = 0; i < 4; i++) {
        ask(b, kinds[i], own, "Nothing was written: a replay writes only with --saves DIR.");
        assert_string_equal(said(e(b)), "Nothing was written: a replay writes only with --saves DIR.");
    }
    assert_true(is_saved(b));
    assert_int_not_equal(access(own, F_OK), 0);
    assert_int_equal(mkdir(saves, 0777), 0);
    b->options.saves = saves;
    ask(b, REQUEST_SAVE, NULL, "/saves/own.csv.");
    ask(b, REQUEST_SAVE_AS, "/no/../where/else.json", "/saves/else.json.");
    ask(b, REQUEST_SAVE_AS, "/no/where/..", "expected the path of a file");
    assert_int_not_equal(access(own, F_OK), 0);
    assert_true(file_content(scene()) == before);
}

/// Opening one would wait for whoever is at its other end; the app goes on, and the work stays unsaved. What is there is replaced when it
/// is asked for again.
MINE_TEST(a_pipe_is_neither_read_nor_written)
{
    static const struct {
        enum request_kind kind;
        const char *name;
        int times;
    } rows[] = {{REQUEST_OVERWRITE, "walk.json", 1},
                {REQUEST_SAVE_AS, "pipe.json", 2},
                {REQUEST_EXPORT, "pipe.csv", 2},
                {REQUEST_OPEN, "pipe.json", 1},
                {REQUEST_ADD, "pipe.glb", 1}};
    struct stat about;
    char recovery[160];
    snprintf(recovery, sizeof recovery, "%s/wiggly/recovery-1", folder);
    assert_int_equal(mkdir(folder_path("wiggly"), 0700) | mkfifo(recovery, 0600), 0);
    alarm(60); // it would wait for ever
    personal_start(&b->app);
    personal_end(&b->app, false);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char path[128];
        snprintf(path, sizeof path, "%s", folder_path(rows[i].name));
        unlink(path);
        assert_int_equal(mkfifo(path, 0600), 0);
        for (int k = 1; k <= rows[i].times; k++)
            ask(b, rows[i].kind, path, k == rows[i].times ? "expected a file, got something else" : "");
        assert_int_equal(stat(path, &about), 0);
        assert_true(S_ISFIFO(about.st_mode));
    }
    assert_false(is_saved(b));
    alarm(0);
}

/// Neither a save nor an export replaces a model of the scene, nor an export the scene's own file, however often it is asked for.
TEST(what_the_scene_is_read_from_stays)
{
    static const struct {
        enum request_kind kind;
        const char *name;
    } rows[] = {{REQUEST_EXPORT, "dog.glb"},     {REQUEST_EXPORT, "linked.glb"}, {REQUEST_SAVE_AS, "dog.glb"},
                {REQUEST_SAVE_AS, "linked.glb"}, {REQUEST_EXPORT, "walk.csv"},   {REQUEST_EXPORT, "back.png"}};
    struct blind b;
    char own[128];
    folder_run("cp assets/models/dog.glb %s && ln -s dog.glb %s/linked.glb");
    strcpy(own,
           folder_file("walk.csv",
                       "{\"wiggly\": 1, \"frames\": [0, 9], \"rigs\": "
                       "[{\"type\": \"model\", \"model\": \"dog.glb\"}], \"background\": {\"file\": \"back.png\"}}"));
    folder_run("cp assets/pictures/pull.png %s/back.png");
    const uint64_t model = file_content(folder_path("dog.glb")), before = file_content(own);
    blind_open(&b, own);
    blind_frame(&b);
    for (size_t i = 0; i < 2 * sizeof rows / sizeof *rows; i++) {
        ask(&b, rows[i / 2].kind, folder_path(rows[i / 2].name), "this scene is read from it: choose another name");
        assert_true(file_content(folder_path("dog.glb")) == model && file_content(own) == before);
    }
    ask(&b, REQUEST_EXPORT, folder_path("other.glb"), "Wrote");
    blind_close(&b);
}

/// What is dropped on the window: a picture, a film or a folder of pictures goes behind the scene, by a path from its folder.
TEST(a_background_is_added)
{
    static const unsigned char pixel[4] = {9, 9, 9, 255};
    static const struct {
        const char *name, *file, *says;
    } rows[] = {{"back.png", "back.png", ""},
                {"walk", "walk", ""},
                {"none", "walk", "/none: the background is missing: expected a picture, a film or a folder of .png"},
                {"gone.png", "walk", "/gone.png: the background is missing"},
                {"walk.txt", "walk", ""},
                {"", ".", ""}};
    struct blind b;
    char own[128];
    folder_run("mkdir %s/walk %s/none");
    assert_done(png_write(folder_path("walk/1.png"), 1, 1, pixel, &error));
    assert_done(png_write(folder_path("back.png"), 1, 1, pixel, &error));
    strcpy(own, folder_file("new.json", "{\"wiggly\": 1, \"frames\": [0, 9]}"));
    blind_open(&b, own);
    const struct document *document = b.app.work.document;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        blind_drop(&b, folder_path(rows[i].name));
        blind_frame(&b);
        assert_string_equal(document->background.file, rows[i].file);
        if (!strstr(said(e(&b)), rows[i].says)) fail_msg("\"%s\" lacks \"%s\"", said(e(&b)), rows[i].says);
        blind_key(&b, KEY_ESCAPE, 0); // whether to save
    }
    blind_frame(&b);
    assert_true(editor_stage(e(&b))->behind.pixels != NULL);
    blind_key(&b, 'Z', MOD_CTRL);
    assert_string_equal(document->background.file, "walk");
    blind_key(&b, 'Z', MOD_CTRL);
    assert_string_equal(document->background.file, "back.png");
    blind_key(&b, 'Z', MOD_CTRL);
    assert_null(document->background.file);
    blind_frame(&b);
    assert_null(editor_stage(e(&b))->behind.pixels);
    blind_close(&b);
}

/// A scene whose background is missing opens all the same, says so once, and keeps the entry.
TEST(a_missing_background_is_kept)
{
    struct blind b;
    char own[128];
    strcpy(own,
           folder_file("gone.json", "{\"wiggly\": 1, \"frames\": [0, 9], \"background\": {\"file\": \"gone.mp4\"}}"));
    blind_open(&b, own);
    blind_frame(&b);
    assert_said_error(e(&b), "/gone.mp4: the background is missing");
    hush(e(&b));
    blind_frame(&b);
    assert_string_equal(said(e(&b)), "");
    ask(&b, REQUEST_SAVE, NULL, "Saved.");
    folder_run("grep -q '\"background\": { \"file\": \"gone.mp4\" }' %s/gone.json");
    blind_close(&b);
}

// --- who may do what with a file that is written anew: the same as before, or less where the system does not let us keep it

enum { ME = 1001, SHE = 1002, HE = 1003, OURS = 2001 }; // users, each with a group of that number, and one more group

enum { USER_OBJ = 1, USER = 2, GROUP_OBJ = 4, MASK = 16, OTHER = 32 };

#define ANY_ID ((uint32_t)-1)

/// An ACL as the kernel has it.
struct acl {
    uint32_t version;
    struct {
        uint16_t tag, rights;
        uint32_t id;
    } entries[6];
};

#define ACL(...)                                                                                                     \
    {                                                                                                                \
        2, { {USER_OBJ, 6, ANY_ID}, __VA_ARGS__ }                                                                    \
    }

static const struct acl one_named =
    ACL({USER, 6, SHE}, {GROUP_OBJ, 4, ANY_ID}, {MASK, 6, ANY_ID}, {OTHER, 0, ANY_ID});
static const struct acl one_reads =
    ACL({USER, 4, SHE}, {GROUP_OBJ, 6, ANY_ID}, {MASK, 6, ANY_ID}, {OTHER, 6, ANY_ID});
static const struct acl one_locked_out =
    ACL({USER, 0, SHE}, {GROUP_OBJ, 6, ANY_ID}, {MASK, 6, ANY_ID}, {OTHER, 6, ANY_ID});

static const char file_acl[] = "system.posix_acl_access", folder_acl[] = "system.posix_acl_default";

static size_t acl_size(const struct acl *acl)
{
    size_t count = 0;
    while (count < 6 && acl->entries[count].tag) count++;
    return offsetof(struct acl, entries) + count * sizeof acl->entries[0];
}

static const struct {
    const char *what;
    uid_t writer;
    gid_t more; ///< a group that the writer is in besides
    uid_t owner;
    gid_t group;
    mode_t mode;
    const struct acl *acl;
    bool inherits; ///< the folder gives new files an ACL
    uid_t new_owner;
    gid_t new_group;
    mode_t new_mode;
    bool keeps_acl;
} cases[] = {
    {"another group's, root", 0, 0, 0, OURS, 0640, NULL, false, 0, OURS, 0640, false},
    {"another user's, root", 0, 0, ME, OURS, 0664, NULL, false, ME, OURS, 0664, false},
    {"an ACL, root", 0, 0, SHE, OURS, 0660, &one_named, false, SHE, OURS, 0660, true},
    {"an ACL", ME, 0, ME, ME, 0660, &one_named, false, ME, ME, 0660, true},
    {"a group of mine", ME, OURS, ME, OURS, 0660, NULL, false, ME, OURS, 0660, false},
    {"another group's", ME, 0, ME, OURS, 0664, NULL, false, ME, ME, 0644, false},
    {"another group's, closed to others", ME, 0, ME, OURS, 0660, NULL, false, ME, ME, 0600, false},
    {"another group's, which is locked out", ME, 0, ME, OURS, 0606, NULL, false, ME, ME, 0600, false},
    {"another group's, which may read", ME, 0, ME, OURS, 0646, NULL, false, ME, ME, 0644, false},
    {"another user's, by a group", ME, 0, SHE, ME, 0664, NULL, false, ME, ME, 0664, false},
    {"another user's with an ACL, by a group", ME, SHE, SHE, ME, 0666, &one_reads, false, ME, ME, 0666, true},
    {"another group's with an ACL", ME, 0, ME, OURS, 0666, &one_reads, false, ME, ME, 0644, false},
    {"another group's, somebody locked out", ME, 0, ME, OURS, 0666, &one_locked_out, false, ME, ME, 0600, false},
    {"none in a folder with one", ME, 0, ME, ME, 0640, NULL, true, ME, ME, 0640, false},
    {"none in a folder with one, another group's", ME, 0, ME, OURS, 0664, NULL, true, ME, ME, 0644, false},
};

static bool set_acl(const char *path, const char *name, const struct acl *acl)
{
    if (!acl || setxattr(path, name, acl, acl_size(acl), 0) == 0) return true;
    print_message("skip - this file system has no ACLs\n");
    return false;
}

/// Writes a file as another user.
static void write_as(uid_t user, gid_t more, const char *path)
{
    int status;
    const pid_t child = fork();
    if (child == 0) {
        struct error error;
        if (user != 0 && (setgroups(more ? 1 : 0, &more) != 0 || setgid(user) != 0 || setuid(user) != 0)) _exit(2);
        _exit(file_write_atomic(path, "new", 3, &error) ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

TEST(rights_are_kept_or_fewer)
{
    if (geteuid() != 0) {
        print_message("skip - only root can be several users\n");
        skip();
    }
    umask(022);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct acl acl = {0};
        struct stat about;
        char place[80], path[88];
        snprintf(place, sizeof place, "%s/%zu", folder, i);
        snprintf(path, sizeof path, "%s/file", place);
        assert_int_equal(mkdir(place, 0777) | chmod(place, 0777) | chmod(folder, 0777), 0);
        assert_int_equal(mknod(path, S_IFREG | 0600, 0), 0);
        assert_int_equal(chown(path, cases[i].owner, cases[i].group) | chmod(path, cases[i].mode), 0);
        if (!set_acl(path, file_acl, cases[i].acl)) continue;
        if (!set_acl(place, folder_acl, cases[i].inherits ? &one_named : NULL)) continue;
        write_as(cases[i].writer, cases[i].more, path);
        assert_int_equal(stat(path, &about), 0);
        const ssize_t size = getxattr(path, file_acl, &acl, sizeof acl);
        if (about.st_size != 3 || about.st_uid != cases[i].new_owner || about.st_gid != cases[i].new_group ||
            (about.st_mode & 07777) != cases[i].new_mode)
            fail_msg("%s: now of %u:%u, mode %o", cases[i].what, about.st_uid, about.st_gid, about.st_mode & 07777);
        const bool kept = size > 0 && cases[i].acl && memcmp(&acl, cases[i].acl, acl_size(cases[i].acl)) == 0;
        if (cases[i].keeps_acl ? !kept : size >= 0) fail_msg("%s: the ACL", cases[i].what);
    }
}

static int prepare(void **state)
{
    if (folder_make(state) != 0) return -1;
    blind_home(folder);
    return 0;
}

TESTS_BETWEEN(prepare, folder_remove)
