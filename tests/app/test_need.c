/// Memory that runs out ends the program with one sentence, exit status 3, nothing half-written, and the work in the recovery file of autosave.
#include "blind.h"
#include "folder.h"

#include "base/file.h"
#include "base/need.h"
#include "scene/load.h"
#include <sys/wait.h>
#include <threads.h>
#include <unistd.h>

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

static int need_too_much(void *user)
{
    (void)user;
    need(SIZE_MAX, 2);
    return 0;
}

static void run_threads(void)
{
    thrd_t threads[4];
    for (int i = 0; i < 4; i++) {
        if (thrd_create(&threads[i], need_too_much, NULL) != thrd_success) _exit(9);
    }
    for (int i = 0; i < 4; i++) thrd_join(threads[i], NULL);
}

TEST(threads_end_it_once)
{
    assert_int_equal(run_apart(run_threads), 3);
    assert_string_equal(said, "wiggly: out of memory\n");
}

/// The app at a desk with a knot that autosave has kept, as memory runs out in a thread.
static void run_app(void)
{
    struct blind blind;
    setenv("XDG_STATE_HOME", folder_path("state"), 1);
    setenv("XDG_CONFIG_HOME", folder_path("config"), 1);
    blind_open(&blind, NULL);
    personal_start(&blind.app);
    blind_frame(&blind);
    blind_send_key(&blind, KEY_RIGHT, 0);
    blind_send_key(&blind, 'I', 0);
    blind_frame(&blind);
    if (!scene_save(blind.app.work.document, folder_path("expected.json"), NULL)) _exit(9);
    while (personal_is_behind(&blind.app)) personal_update(&blind.app);
    while (access(folder_path("state/wiggly/recovery-1"), F_OK) != 0)
        thrd_sleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    run_threads();
}

TEST(the_work_is_kept)
{
    char command[512];
    assert_int_equal(run_apart(run_app), 3);
    assert_string_equal(said, "wiggly: out of memory\n");
    snprintf(command, sizeof command, "cmp %s/state/wiggly/recovery-1 %s/expected.json", folder, folder);
    assert_int_equal(system(command), 0);
}

TESTS_BETWEEN(folder_make, folder_remove)
