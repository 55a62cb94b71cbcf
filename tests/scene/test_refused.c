/// File systems that refuse rights, syncing, renaming or a name: what they know is used, and the work is kept.
#include "blind.h"

#include "folder.h"
#include "questions.h"
#include "scene/load.h"
#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum call { NONE, FSYNC, FCHMOD, RENAME };

static struct {
    enum call call;
    int error;
} refused;

static int answer(enum call call, long done)
{
    if (refused.call != call) return (int)done;
    errno = refused.error;
    return -1;
}

// In place of libc's.
int fsync(int file) { return answer(FSYNC, syscall(SYS_fsync, file)); }
int fchmod(int file, mode_t mode)
{
    return answer(FCHMOD, refused.call == FCHMOD ? 0 : syscall(SYS_fchmod, file, mode));
}
int rename(const char *from, const char *to)
{
    return answer(RENAME, refused.call == RENAME ? 0 : syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

static void assert_holds(const char *path, const char *text)
{
    size_t size;
    char *data;
    assert_done(file_read(path, 100, &data, &size, &error));
    assert_string_equal(data, text);
    free(data);
}

static int count_files(void)
{
    char command[128];
    int count = -1;
    snprintf(command, sizeof command, "ls -A %s | wc -l", folder);
    FILE *list = popen(command, "r");
    if (fscanf(list, "%d", &count) != 1) count = -1;
    pclose(list);
    return count;
}

TEST_WITH(folder_make, folder_remove, rights_and_syncing)
{
    static const struct {
        enum call call;
        int error;
        bool is_saved;
    } cases[] = {
        {FSYNC, EINVAL, true},  {FSYNC, ENOSYS, true},      {FSYNC, ENOTSUP, true}, {FSYNC, EPERM, true},
        {FSYNC, EIO, false},    {FSYNC, ENOSPC, false},     {FCHMOD, EPERM, true},  {FCHMOD, ENOSYS, true},
        {FCHMOD, EINVAL, true}, {FCHMOD, EOPNOTSUPP, true}, {FCHMOD, EIO, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct error error = {0};
        struct stat about;
        const char *path = folder_file("scene", "old");
        assert_int_equal(chmod(path, 0666), 0);
        refused.call = cases[i].call;
        refused.error = cases[i].error;
        const bool is_saved = file_write_atomic(path, "new", 3, &error);
        refused.call = NONE;
        if (is_saved != cases[i].is_saved) fail_msg("case %zu: %s", i, error.text);
        assert_holds(path, is_saved ? "new" : "old");
        assert_int_equal(count_files(), 1);
        assert_int_equal(stat(path, &about), 0);
        assert_int_equal(about.st_mode & 0777, cases[i].call == FCHMOD && is_saved ? 0600 : 0666);
    }
}

TEST_WITH(folder_make, folder_remove, renaming)
{
    struct error error = {0};
    folder_file("old", "old");
    refused.call = RENAME;
    refused.error = EPERM;
    assert_true(file_write_atomic(folder_path("new"), "new", 3, &error));
    assert_false(file_write_atomic(folder_path("old"), "new", 3, &error));
    refused.call = NONE;
    assert_holds(folder_path("new"), "new");
    assert_holds(folder_path("old"), "old");
    assert_int_equal(count_files(), 2);
}

/// Opens a scene of this name, edits it, and lets the program end.
static void rescue(const char *name, enum call call, struct error *error)
{
    static const char scene[] =
        "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}]}";
    struct blind blind;
    char path[400];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_true(file_write_atomic(path, scene, sizeof scene - 1, error));
    blind_open(&blind, path);
    blind_frame(&blind);
    blind_key(&blind, 'I', 0);
    assert_false(history_is_saved(blind.app.work.history));
    refused.call = call;
    refused.error = EPERM;
    fail(error, ERROR_ENVIRONMENT, "the end");
    app_rescue(&blind.app, error);
    refused.call = NONE;
    blind_close(&blind);
}

static void assert_work_in(const char *name, const struct error *error)
{
    if (!strstr(error->text, name)) fail_msg("\"%s\" does not name %s", error->text, name);
    struct document *document = scene_load(folder_path(name), NULL, NULL);
    assert_non_null(document);
    assert_int_equal(document->splines[0]->knot_count, 1);
    document_destroy(document);
}

TEST_WITH(folder_make, folder_remove, a_rescue_without_renaming)
{
    struct error error = {0};
    rescue("walk.json", RENAME, &error);
    assert_work_in("walk.recovered.json", &error);
}

/// The name is as long as a name can be.
TEST_WITH(folder_make, folder_remove, a_rescue_of_a_long_name)
{
    struct error error = {0};
    char name[256];
    memset(name, 'w', 255);
    memcpy(name + 250, ".json", 6);
    rescue(name, NONE, &error);
    assert_work_in("untitled.recovered.json", &error);
}
