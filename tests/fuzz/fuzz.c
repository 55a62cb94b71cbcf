/// Files for the fuzz targets, and what they assert.
#include "fuzz.h"
#include "base/file.h"
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[64], last[128];

static void remove_folder(void)
{
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    if (system(command) != 0) perror(folder);
}

static void make_folder(void)
{
    snprintf(folder, sizeof folder, "%s/wiggly-fuzz-XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
    if (!mkdtemp(folder)) abort();
    atexit(remove_folder);
}

const char *fuzz_file(const char *name, const void *data, size_t size)
{
    if (!folder[0]) make_folder();
    snprintf(last, sizeof last, "%s/%s", folder, name);
    int file = open(last, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || write(file, data, size) != (ssize_t)size || close(file) != 0) abort();
    return last;
}

char *fuzz_bytes(const char *path, size_t *size)
{
    char *data;
    fuzz_expect(file_read(path, (size_t)1 << 30, &data, size, NULL), "a file that was written can be read");
    return data;
}

void fuzz_same(const char *what, const void *a, size_t a_size, const void *b, size_t b_size)
{
    if (a_size == b_size && memcmp(a, b, a_size) == 0) return;
    fprintf(stderr, "first:\n%.*s\nsecond:\n%.*s\n", (int)a_size, (const char *)a, (int)b_size, (const char *)b);
    fuzz_expect(false, what);
}

void fuzz_expect(bool good, const char *what)
{
    if (good) return;
    fprintf(stderr, "not true: %s\n", what);
    abort();
}
