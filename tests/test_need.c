/// Memory that runs out ends the program with one sentence, exit status 3, nothing half-written, and the work in the recovery file.
#include "blind.h"
#include "folder.h"

#include "base/file.h"
#include "base/need.h"
#include "scene/load.h"
#include <sys/resource.h>
#include <sys/wait.h>
#include <threads.h>
#include <unistd.h>

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
enum { CAN_LIMIT = 0 }; // the sanitizer's shadow memory is in the way
#else
enum { CAN_LIMIT = 1 };
#endif

enum { MIB = 1 << 20, RESERVE = 32 * MIB };

static char said[2048];

/// Runs it in a process of its own and returns its exit status; what it says is in `said`.
static int run_apart(void (*run)(void))
{
    char path[128];
    int status;
    snprintf(path, sizeof path, "%s", folder_path("said"));
    const pid_t child = fork();
    if (child == 0) {
        if (!freopen(path, "w", stderr)) _exit(9);
        run();
        _exit(0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    said[fread(said, 1, sizeof said - 1, file)] = '\0';
    fclose(file);
    return WEXITSTATUS(status);
}

/// From now on no more address space than there is.
static void limit_memory(void)
{
    char line[256];
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file || !fgets(line, sizeof line, file) || sscanf(line, "%ld", &pages) != 1) _exit(9);
    fclose(file);
    const rlim_t now = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE);
    if (setrlimit(RLIMIT_AS, &(struct rlimit){now, RLIM_INFINITY}) != 0) _exit(9);
}

static void use_all(void)
{
    for (;;) need(MIB, 1);
}

TEST(memory_is_what_was_asked_for)
{
    char *text = need_text("wiggly");
    assert_string_equal(text, "wiggly");
    text = need_more(text, 100, 1);
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

TEST(a_sentence_and_nothing_half_written)
{
    char command[160];
    assert_int_equal(run_apart(overflow), 3);
    assert_string_equal(said, "wiggly: out of memory\n");
    snprintf(command, sizeof command, "[ -z \"$(find %s -name '.wiggly*' -o -name half)\" ]", folder);
    assert_int_equal(system(command), 0);
}

static void uses_reserve(void *user, struct error *error)
{
    void *memory = malloc(RESERVE - MIB);
    fail(error, error->kind, "%s, %s", error->text, memory ? (const char *)user : "and no reserve");
}

static void run_with_reserve(void)
{
    static char words[] = "but kept";
    need_keep(RESERVE, uses_reserve, words);
    limit_memory();
    use_all();
}

TEST(the_rescue_has_the_reserve)
{
    if (!CAN_LIMIT) skip();
    assert_int_equal(run_apart(run_with_reserve), 3);
    assert_string_equal(said, "wiggly: out of memory, but kept\n");
}

static void needs_more(void *user, struct error *error)
{
    (void)error;
    (void)user;
    need(SIZE_MAX, 2);
}

static void run_twice_short(void)
{
    need_keep(0, needs_more, NULL);
    need(SIZE_MAX, 2);
}

TEST(a_rescue_that_runs_out_ends_there)
{
    assert_int_equal(run_apart(run_twice_short), 3);
    assert_string_equal(said, "wiggly: out of memory; work since the last autosave is lost\n");
}

static int work(void *user)
{
    (void)user;
    limit_memory();
    use_all(); // in the end from the reserve, and no more than that
    return 0;
}

/// Waits for a thread that also runs out, as one that writes a file does.
static void waits(void *user, struct error *error)
{
    thrd_t thread;
    if (thrd_create(&thread, work, user) != thrd_success) _exit(9);
    struct timespec moment = {.tv_nsec = 200000000};
    thrd_sleep(&moment, NULL);
    fail(error, error->kind, "%s, first", error->text);
}

static void run_threads(void)
{
    need_keep(RESERVE, waits, NULL);
    need(SIZE_MAX, 2);
}

TEST(the_first_thread_ends_it)
{
    if (!CAN_LIMIT) skip();
    assert_int_equal(run_apart(run_threads), 3);
    assert_string_equal(said, "wiggly: out of memory, first\n");
}

static int need_too_much(void *user)
{
    (void)user;
    need(SIZE_MAX, 2);
    return 0;
}

/// The app at a desk with a knot that is not saved, as memory runs out in `run`.
static void run_app(int (*run)(void *user), bool apart)
{
    struct blind blind;
    thrd_t thread;
    setenv("XDG_STATE_HOME", folder_path("state"), 1);
    setenv("XDG_CONFIG_HOME", folder_path("config"), 1);
    blind_open(&blind, NULL);
    mtx_init(&blind.app.working, mtx_timed);
    personal_start(&blind.app);
    blind_frame(&blind);
    blind_send_key(&blind, KEY_RIGHT, 0);
    blind_send_key(&blind, 'I', 0);
    blind_frame(&blind);
    if (!scene_save(blind.app.table.document, folder_path("expected.json"), NULL)) _exit(9);
    app_rescue_without_memory(&blind.app);
    mtx_lock(&blind.app.working);
    if (!apart) run(NULL);
    if (thrd_create(&thread, run, NULL) != thrd_success) _exit(9);
    mtx_unlock(&blind.app.working); // the frame ends
    thrd_join(thread, NULL);
}

static void run_in_frame(void) { run_app(need_too_much, false); }
static void run_in_thread(void) { run_app(need_too_much, true); }

TEST(the_work_is_kept)
{
    char command[512];
    void (*const runs[])(void) = {run_in_frame, run_in_thread};
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        assert_int_equal(run_apart(runs[i]), 3);
        snprintf(command, sizeof command,
                 "wiggly: out of memory; the unsaved scene is safe in %s/state/wiggly/recovery-1, and the next start "
                 "offers to recover it\n",
                 folder);
        assert_string_equal(said, command);
        snprintf(command, sizeof command,
                 "cmp %s/state/wiggly/recovery-1 %s/expected.json && rm %s/state/wiggly/recovery-1", folder, folder,
                 folder);
        assert_int_equal(system(command), 0);
    }
}

int main(void) { return tests_run(folder_make, folder_remove); }
