/// Files that tests write: a folder per test below TEST_OUT, emptied by its test.
#ifndef TESTS_TEMPORARY_H
#define TESTS_TEMPORARY_H

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

/// The path of a file called `name`. Every fourth call reuses the storage.
static inline const char *temporary_path(const char *name)
{
    static char paths[4][512];
    static int next;
    const char *place = getenv("TEST_OUT");
    next = (next + 1) % 4;
    if (!place) place = "/tmp";
    mkdir(place, 0777);
    snprintf(paths[next], sizeof paths[next], "%s/%s", place, name);
    return paths[next];
}

/// Writes a file of `size` bytes and returns its path. A failure ends the program.
static inline const char *temporary_file(const char *name, const void *bytes, size_t size)
{
    const char *path = temporary_path(name);
    unlink(path); // truncating and rewriting a file would wait for the disk
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(bytes, 1, size, file) != size || fclose(file) != 0) abort();
    return path;
}

#endif
