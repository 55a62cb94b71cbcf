/// The main() of each room of tests: tests/ROOM/test_FILE.c make build/tests/ROOM, and add themselves before main() begins.
#include "near.h"

#include <assert.h>

static struct file {
    const char *name; ///< "test_FILE.c"
    CMFixtureFunction set_up, tear_down;
    struct CMUnitTest tests[64];
    int lines[64];
    size_t count;
} files[64];
static size_t file_count;

static struct file *file_named(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    for (size_t i = 0; i < file_count; i++)
        if (strcmp(files[i].name, name) == 0) return &files[i];
    assert(file_count < sizeof files / sizeof *files);
    files[file_count].name = name;
    return &files[file_count++];
}

void tests_add(const char *path, int line, struct CMUnitTest test)
{
    struct file *file = file_named(path);
    assert(file->count < sizeof file->tests / sizeof *file->tests);
    size_t i = file->count++;
    for (; i > 0 && file->lines[i - 1] > line; i--) {
        file->tests[i] = file->tests[i - 1];
        file->lines[i] = file->lines[i - 1];
    }
    file->tests[i] = test;
    file->lines[i] = line;
}

void tests_between(const char *path, CMFixtureFunction set_up, CMFixtureFunction tear_down)
{
    struct file *file = file_named(path);
    file->set_up = set_up;
    file->tear_down = tear_down;
}

int main(int argc, char **argv)
{
    for (size_t i = 0; argc > 1 && i < file_count; i++) {
        const struct file *file = &files[i];
        const size_t length = strlen(argv[1]);
        if (strncmp(file->name, argv[1], length) != 0 || strcmp(file->name + length, ".c") != 0) continue;
        if (argc > 2) cmocka_set_test_filter(argv[2]);
        return _cmocka_run_group_tests(file->name, file->tests, file->count, file->set_up, file->tear_down);
    }
    fprintf(stderr, "usage: %s FILE [CASE]; a case may be a pattern, and the files are\n", argv[0]);
    for (size_t i = 0; i < file_count; i++)
        fprintf(stderr, "  %.*s\n", (int)strlen(files[i].name) - 2, files[i].name);
    return 2;
}
