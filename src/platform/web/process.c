/// The process in a browser, which has no signals and never waits; and calls of the system that Emscripten lacks.
#include "platform/process.h"
#include <dlfcn.h>
#include <emscripten.h>
#include <errno.h>
#include <math.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/types.h>
#include <sys/xattr.h>

/// The page begins at 0.
double process_age(void) { return 1e-3 * emscripten_get_now(); }
double process_peak_memory(void) { return NAN; }
void process_sleep(double seconds) { (void)seconds; }
void process_catch_end(void) {}
bool process_was_told_to_end(void) { return false; }

bool turns_open(bool first)
{
    (void)first;
    return false;
}
void turns_take(void) {}
void turns_give(void) {}

// Not in this C library, or of no use in a browser.

int posix_spawnp(pid_t *process, const char *file, const posix_spawn_file_actions_t *actions,
                 const posix_spawnattr_t *attributes, char *const arguments[], char *const environment[])
{
    (void)process, (void)file, (void)actions, (void)attributes, (void)arguments, (void)environment;
    return ENOSYS;
}

ssize_t getxattr(const char *path, const char *name, void *value, size_t size)
{
    (void)path, (void)name, (void)value, (void)size;
    return -1;
}

int fsetxattr(int file, const char *name, const void *value, size_t size, int flags)
{
    (void)file, (void)name, (void)value, (void)size, (void)flags;
    return -1;
}

int fremovexattr(int file, const char *name)
{
    (void)file, (void)name;
    return -1;
}

void *dlopen(const char *file, int mode)
{
    (void)file, (void)mode;
    return NULL;
}

void *dlsym(void *library, const char *name)
{
    (void)library, (void)name;
    return NULL;
}

int dlclose(void *library)
{
    (void)library;
    return 0;
}

long allocation_count(void) { return 0; }
