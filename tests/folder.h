/// An empty folder per test or group; folder_make() and folder_remove() are the fixtures.
#ifndef TESTS_FOLDER_H
#define TESTS_FOLDER_H

#include "near.h"

#include "base/file.h"

static char folder[64]; ///< its path

static inline int folder_make(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "/tmp/wiggly-test-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

/// Runs a line of the shell, in which each %s is the folder.
static inline void folder_run(const char *format)
{
    char line[512];
    snprintf(line, sizeof line, format, folder, folder, folder, folder, folder); // NOLINT
    if (system(line) != 0) fail_msg("%s", line);
}

static inline int folder_remove(void **state)
{
    (void)state;
    folder_run("rm -rf %s");
    return 0;
}

/// The path of a file in it. Every second call reuses the storage.
static inline const char *folder_path(const char *name)
{
    static char paths[2][128];
    static int next;
    next = 1 - next;
    snprintf(paths[next], sizeof paths[next], "%s/%s", folder, name);
    return paths[next];
}

/// Writes a file in it; returns its path.
static inline const char *folder_file(const char *name, const char *text)
{
    const char *path = folder_path(name);
    assert_done(file_write_atomic(path, text, strlen(text), &error));
    return path;
}

#endif
