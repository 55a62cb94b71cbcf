/// Saving, keeping unsaved work and exporting, with each system call failing in turn or being the last: what is on disk is old or new,
/// and whole.
#include "documents.h"
#include "folder.h"

#include "app/film.h"
#include "app/personal.h"
#include "commands/commands.h"
#include "commands/report.h"
#include <errno.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#if !defined __x86_64__ || defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
TEST(all)
{
    print_message("skip - the registers of system calls are x86-64's, and a sanitizer has calls of its own\n");
    skip();
}
#else
// --- runs a function in a child in which one system call fails or is the last, as on a full disk or a power cut

typedef int traced(void *user);

/// The `n`th counted call (from 0; negative: none) fails with `error`. If `error` is 0, the child is killed there; below 0 the call
/// succeeds and the signal −`error` follows.
struct trouble {
    int n, error;
};

/// Calls that change files; only these matter for a crash. Failing to close or remove a file has no remedy, so that is not tested.
static bool counts(unsigned long long call, bool fails)
{
    static const unsigned long long calls[] = {
        SYS_close,  SYS_unlink,   SYS_unlinkat, SYS_openat, SYS_open,      SYS_write,        SYS_writev, SYS_fsync,
        SYS_rename, SYS_renameat, SYS_fchmod,   SYS_fchown, SYS_fsetxattr, SYS_fremovexattr, SYS_link,   SYS_mkdir};
    size_t i = fails ? 3 : 0;
    while (i < sizeof calls / sizeof *calls && calls[i] != call) i++;
    return i < sizeof calls / sizeof *calls;
}

/// Threads' calls count, too. Returns the child's exit status, or -1 if it was killed; `*count` (may be NULL) receives the number of
/// counted calls.
static int trace(traced *run, void *user, struct trouble trouble, int *count)
{
    int status, n = 0;
    const pid_t child = fork();
    if (child == 0) {
        ptrace(PTRACE_TRACEME, 0, NULL, NULL);
        raise(SIGSTOP);
        _exit(run(user));
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    ptrace(PTRACE_SETOPTIONS, child, NULL, (void *)(PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACECLONE | PTRACE_O_EXITKILL));
    pid_t hit = 0, stopped = child; // the thread that made the chosen call; the thread that waits for us
    for (int passed = 0;;) {
        if (stopped) assert_int_equal(ptrace(PTRACE_SYSCALL, stopped, NULL, passed), 0);
        stopped = waitpid(-1, &status, __WALL);
        passed = 0;
        if (WIFEXITED(status) && stopped == child) break;
        if (WIFSIGNALED(status)) fail_msg("signal %d at call %d", WTERMSIG(status), trouble.n);
        if (WIFEXITED(status)) {
            stopped = 0;
            continue;
        }
        if (WSTOPSIG(status) != (SIGTRAP | 0x80)) {
            const bool is_begun = status >> 16 != 0 || (stopped != child && WSTOPSIG(status) == SIGSTOP);
            passed = is_begun ? 0 : WSTOPSIG(status); // a new thread starts with stops caused by tracing
            continue;
        }
        struct user_regs_struct registers;
        ptrace(PTRACE_GETREGS, stopped, NULL, &registers);
        if (hit == stopped && trouble.error < 0) {
            kill(child, -trouble.error);
            hit = 0;
        } else if (hit == stopped && trouble.error) {
            registers.rax = (unsigned long long)-trouble.error;
            ptrace(PTRACE_SETREGS, stopped, NULL, &registers);
            hit = 0;
        } else if (hit == stopped) {
            kill(child, SIGKILL);
            while (waitpid(-1, &status, __WALL) > 0) continue;
            return -1;
        } else if (registers.rax == (unsigned long long)-ENOSYS) { // at the call's entry
            if (counts(registers.orig_rax, trouble.error > 0) && n++ == trouble.n) hit = stopped;
            if (hit != stopped || trouble.error <= 0) continue;
            registers.orig_rax = (unsigned long long)-1;
            ptrace(PTRACE_SETREGS, stopped, NULL, &registers);
        }
    }
    if (count) *count = n;
    return WEXITSTATUS(status);
}

// --- what is traced

enum { COORDINATES = 1, VERTICES = 8, OLD = 24, NEW = 25, NEXT = 26 };

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}], \"rigs\": "
    "[{\"type\": \"character\", \"name\": \"c\", \"model\": \"m.glb\", \"coordinates\": "
    "[{\"name\": \"a\", \"spline\": \"s\"}]}]}";

/// Something that writes a file, and what is to be on disk after it.
struct job {
    traced *run;
    int (*version)(void); ///< OLD, NEW, or anything else where it is neither
    void (*next)(void);   ///< what the user does after a crash, or NULL
    struct document *document;
    struct recovery_slot slot;
};

static const char *work(const char *name)
{
    static char paths[4][192];
    static int next;
    next = (next + 1) % 4;
    snprintf(paths[next], sizeof paths[next], "%s/new/%s", folder, name);
    return paths[next];
}

/// Gives document and paint a mark of their version, as unsaved edits.
static void mark(struct document *document, int version)
{
    struct model_rig *rig = first_model(document);
    paint_drop(rig->painted);
    rig->painted = paint_create(COORDINATES, VERTICES);
    assert_non_null(rig->painted);
    for (int v = 0; v < VERTICES; v++) rig->painted->values[v][1] = (float)version;
    rig->painted->version += 1000u * (unsigned)version;
    document->fps = version;
}

/// The exit status of a child: whoever waits for what failed is told.
static int status_of(bool good, const struct error *error) { return good ? 0 : error->text[0] ? 3 : 9; }

static int save(void *user)
{
    struct job *job = user;
    struct error error = {0};
    return status_of(scene_save(job->document, job->document->path, &error), &error);
}

/// Scene and paint belong together.
static int saved_version(void)
{
    struct document *document = document_of_file(work("walk.json"));
    const int version = (int)document->fps;
    const struct paint *paint = first_model(document)->painted;
    assert_non_null(paint);
    for (int v = 0; v < VERTICES; v++) assert_int_equal((int)paint->values[v][1], version);
    document_destroy(document);
    return version;
}

/// Saves once more: there is the scene then, and nothing that an earlier save left.
static void save_next(void)
{
    // For a program looks once for what is left.
    assert_done(file_write_atomic(folder_path("elsewhere"), "", 0, &error));
    struct document *document = document_of_file(work("walk.json"));
    document_set_path(document, work("walk.json"));
    mark(document, NEXT);
    assert_done(scene_save(document, document->path, &error));
    document_destroy(document);
    assert_int_equal(saved_version(), NEXT);
    folder_run("test $(ls -A %s/new | wc -l) = 1 || { ls -A %s/new >&2; false; }");
}

/// Of hundreds of writes of one large file those in the middle differ in nothing: some of them are tried, and all with TRACE_ALL. `make test`
/// tries every eighth call.
static bool is_one_of_many(int n, int count)
{
    enum { ENDS = 6, MIDDLE = 3, QUICK = 8 };
    if (getenv("TRACE_ALL")) return false;
    if (!is_thorough() && n % QUICK) return true;
    if (count < 40 || n < ENDS || n >= count - ENDS) return false;
    return n % (count / MIDDLE) != 0;
}

static void begin_old(void) { folder_run("rm -rf %s/new && cp -r %s/old %s/new"); }

/// Runs it as it is, then with each call failing in three ways, then with each call being the last.
static void torment(const char *what, struct job *job)
{
    static const int errors[] = {ENOSPC, EIO, EACCES, 0};
    int runs = 0;
    for (int e = 0; e < 4; e++) {
        int count = 0;
        begin_old();
        assert_int_equal(job->version(), OLD);
        assert_int_equal(trace(job->run, job, (struct trouble){-1, errors[e]}, &count), 0);
        assert_int_equal(job->version(), NEW);
        assert_true(count > 4);
        for (int n = 0; n < count; n++) {
            if (is_one_of_many(n + e, count)) continue;
            runs++;
            begin_old();
            const int status = trace(job->run, job, (struct trouble){n, errors[e]}, NULL), version = job->version();
            const bool good = version == NEW || (version == OLD && status != 0);
            if (!good || status > 3)
                fail_msg("%s, call %d of %d, error %d: status %d, version %d", what, n, count, errors[e], status,
                         version);
            if (job->next && errors[e] == 0) job->next();
        }
    }
    print_message("           %s: %d runs\n", what, runs);
}

static struct document *painted_scene(void)
{
    folder_run("rm -rf %s/old %s/new && mkdir %s/new");
    struct document *document = document_of_text(scene);
    document->folder = strdup(work("x"));
    *strrchr(document->folder, '/') = '\0';
    document_set_path(document, work("walk.json"));
    mark(document, OLD);
    assert_done(scene_save(document, document->path, &error));
    folder_run("cp -r %s/new %s/old");
    mark(document, NEW);
    return document;
}

TEST(a_save_with_paint)
{
    struct job job = {save, saved_version, save_next, painted_scene(), {0}};
    torment("a save with paint", &job);
    document_destroy(job.document);
}

/// Unsaved work, by autosave.
static int autosave(void *user)
{
    struct job *job = user;
    struct error error = {0};
    const struct autosave_work unsaved = {.document = job->document, .path = "/walk.json", .revision = 7};
    struct autosave *autosave = autosave_open(&job->slot);
    const bool good = autosave_flush(autosave, &unsaved, &error);
    autosave_close(autosave, true);
    return status_of(good, &error);
}

static int autosaved_version(void)
{
    struct document *document = document_of_file(work("recovery-1"));
    const int version = (int)document->fps;
    document_destroy(document);
    return version;
}

TEST(unsaved_work)
{
    struct job job = {autosave, autosaved_version, NULL, painted_scene(), {.lock = -1}};
    snprintf(job.slot.path, sizeof job.slot.path, "%s", work("recovery-1"));
    folder_run("rm -rf %s/old/*");
    job.document->fps = OLD;
    folder_run("rm -rf %s/new && mkdir %s/new");
    assert_int_equal(autosave(&job), 0);
    folder_run("cp %s/new/recovery-1 %s/old");
    job.document->fps = NEW;
    torment("unsaved work", &job);
    document_destroy(job.document);
}

/// An export, and what it writes: its own file last.
static const struct output {
    const char *scene, *files[3];
    const struct film_file_kind *film;
    bool is_like_another; ///< but for its bytes: only with TRACE_ALL
} outputs[] = {
    {"assets/scenes/tail.json", {"out.glb"}, NULL, false},
    {"assets/scenes/tail.json", {"out.gltf"}, NULL, true},
    {"assets/scenes/dog.json", {"out_textures/tag_0.png", "out.usda"}, NULL, false},
    {"assets/scenes/tail.json", {"out.bvh"}, NULL, false},
    {"assets/scenes/tail.json", {"out.csv"}, NULL, true},
    {"assets/scenes/tail.json", {"out.pc2"}, NULL, true},
    {"assets/scenes/tail.json", {"out.mdd"}, NULL, true},
    {"assets/scenes/tail.json", {"out.npy"}, NULL, false},
    {NULL, {"out-0001.png", "out-0002.png"}, &film_png, false},
    {NULL, {"out.gif"}, &film_gif, false},
    {NULL, {"out.mp4"}, &film_ffmpeg, false}, // .webm but for the words to ffmpeg
};

enum { SIDE = 16, MOST_FILES = 2 };

static const struct output *output; ///< whose turn it is
static struct content {
    char *data;
    size_t size;
} expected[MOST_FILES];

static int make_film(const struct film_file_kind *kind, const char *path)
{
    static unsigned char pixels[2 * 4 * SIDE * SIDE];
    struct error error = {0};
    off_t bytes;
    for (size_t i = 0; i < sizeof pixels; i++) pixels[i] = (unsigned char)(i * i / 97);
    struct film_file *film = film_file_open(kind, path, &(struct film_shape){SIDE, SIDE, 24, 2, film_mp4}, &error);
    if (!film) return status_of(false, &error);
    enum film_state state = FILM_DONE;
    for (int i = 0; i < 3 && state == FILM_DONE; i++) {
        do
            state = i < 2 ? kind->put(film, pixels + i * 4 * SIDE * SIDE, true, &error)
                          : kind->finish(film, true, &bytes, &error);
        while (state == FILM_RUNS);
    }
    film_file_close(film);
    return status_of(state == FILM_DONE, &error);
}

static int export_it(void *user)
{
    static char export_[] = "export", frames[] = "--frames=0:3", to[] = "-o";
    char scene_[64], path[192];
    const int last = output->files[1] ? 1 : 0;
    (void)user;
    if (output->film) return make_film(output->film, work(last ? "out.png" : output->files[0]));
    snprintf(scene_, sizeof scene_, "%s", output->scene);
    snprintf(path, sizeof path, "%s", work(output->files[last]));
    if (!freopen("/dev/null", "w", stdout) || !freopen("/dev/null", "w", stderr)) return 1;
    return command_export(5, (char *[]){export_, scene_, frames, to, path, NULL});
}

/// Each file is old or new, and none is old once the last is new. Numbered pictures may be gone instead of old.
static int exported_version(void)
{
    int old = 0, version = 0;
    for (int i = 0; i < MOST_FILES && output->files[i]; i++) {
        struct content found;
        if (!file_read(work(output->files[i]), 1 << 24, &found.data, &found.size, NULL)) {
            if (output->film != &film_png) return 0;
            version = OLD;
            old++;
            continue;
        }
        const bool is_new = found.size == expected[i].size && memcmp(found.data, expected[i].data, found.size) == 0;
        const bool is_old = found.size == 4 && memcmp(found.data, "old\n", 4) == 0;
        free(found.data);
        if (!is_new && !is_old) return 0;
        old += is_old;
        version = is_new ? NEW : OLD;
    }
    return version == NEW && old > 0 ? 0 : version;
}

TEST(exports)
{
    const bool has_ffmpeg = system("ffmpeg -version >/dev/null 2>&1") == 0;
    struct job job = {export_it, exported_version, NULL, NULL, {0}};
    for (size_t o = 0; o < sizeof outputs / sizeof *outputs; o++) {
        output = &outputs[o];
        if (output->film == &film_ffmpeg && !has_ffmpeg) continue;
        if (output->is_like_another && !getenv("TRACE_ALL")) continue;
        if (output->film && !is_thorough()) continue;
        folder_run("rm -rf %s/old %s/new && mkdir %s/new");
        assert_int_equal(trace(export_it, NULL, (struct trouble){-1, 0}, NULL), 0);
        folder_run("cp -r %s/new %s/old");
        for (int i = 0; i < MOST_FILES && output->files[i]; i++) {
            char path[192];
            assert_done(file_read(work(output->files[i]), 1 << 24, &expected[i].data, &expected[i].size, &error));
            snprintf(path, sizeof path, "%s/old/%s", folder, output->files[i]);
            assert_done(file_write_atomic(path, "old\n", 4, &error));
        }
        torment(output->files[output->files[1] ? 1 : 0], &job);
        for (int i = 0; i < MOST_FILES; i++) free(expected[i].data);
        memset(expected, 0, sizeof expected);
    }
}

static int write_one(void *user)
{
    struct file_output one;
    struct error error;
    (void)user;
    progress_end_when_interrupted();
    if (!file_output_open(&one, work("one"), &error)) return 9;
    fputs("one", one.stream);
    return file_output_commit(&one, &error) ? 0 : 9;
}

TEST(a_command_that_is_told_to_end_leaves_no_temporary_file)
{
    int count = 0;
    folder_run("rm -rf %s/new && mkdir %s/new");
    assert_int_equal(trace(write_one, NULL, (struct trouble){-1, -SIGTERM}, &count), 0);
    for (int n = 0; n < count; n++) {
        folder_run("rm -f %s/new/one");
        const int status = trace(write_one, NULL, (struct trouble){n, -SIGTERM}, NULL);
        assert_true(status == 3 || n == count - 1);
        folder_run("test -z \"$(find %s/new -name '.wiggly*')\"");
    }
}
#endif

TESTS_BETWEEN(folder_make, folder_remove)
