/// Finds the program's own scenes: in the tree it was built in or in its installation.
#include "app/assets.h"
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

/// Seen from the program's folder. The installation comes first: beside it may be somebody's own assets/scenes.
static const char *const places[] = {"../share/wiggly/scenes", "../assets/scenes", "../../assets/scenes",
                                     "../../../assets/scenes"};

bool assets_folder(char folder[PATH_LIMIT])
{
    char program[PATH_LIMIT], beside[PATH_LIMIT];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length < 0) return false;
    program[length] = '\0';
    if (!path_folder(program, beside)) return false;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        if (path_resolve(beside, places[i], folder) && access(folder, F_OK) == 0) return true;
    }
    return false;
}

/// Compares folders by identity, not name: one may be mounted in two places.
static bool is_same(const char *folder, const char *other)
{
    struct stat a, b;
    return stat(folder, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool assets_has(const char *path)
{
    char file[PATH_LIMIT], folder[PATH_LIMIT], own[PATH_LIMIT];
    return realpath(path, file) && path_folder(file, folder) && assets_folder(own) && is_same(folder, own);
}
