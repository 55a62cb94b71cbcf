/// Resolves paths against a folder, and makes them relative to it.
#include "base/file.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

const char *path_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool path_folder(const char *path, char folder[PATH_LIMIT])
{
    const char *slash = strrchr(path, '/');
    size_t length = slash ? (size_t)(slash - path) : 0;
    if (slash == path) length = 1; // the root keeps its slash
    if (length >= PATH_LIMIT) return false;
    memcpy(folder, path, length);
    folder[length] = '\0';
    return true;
}

/// Removes ".", ".." and repeated slashes from an absolute path.
static void normalise(char *path)
{
    char *out = path;
    for (const char *in = path; *in;) {
        while (*in == '/') in++;
        size_t length = strcspn(in, "/");
        if (length == 2 && memcmp(in, "..", 2) == 0) {
            while (out > path && *--out != '/') continue;
        } else if (length > 0 && !(length == 1 && *in == '.')) {
            *out++ = '/';
            memmove(out, in, length);
            out += length;
        }
        in += length;
    }
    if (out == path) *out++ = '/';
    *out = '\0';
}

/// The absolute path of a folder; if it does not exist, links and dots stay.
static bool absolute_folder(const char *folder, char absolute[PATH_LIMIT])
{
    char working[PATH_LIMIT];
    if (strlen(folder) >= PATH_LIMIT) return false;
    if (realpath(folder, absolute)) return true;
    if (folder[0] == '/') {
        strcpy(absolute, folder);
        return true;
    }
    return getcwd(working, sizeof working) && snprintf(absolute, PATH_LIMIT, "%s/%s", working, folder) < PATH_LIMIT;
}

bool path_resolve(const char *folder, const char *path, char absolute[PATH_LIMIT])
{
    char base[PATH_LIMIT];
    if (path[0] == '/') {
        if (strlen(path) >= PATH_LIMIT) return false;
        strcpy(absolute, path);
    } else {
        if (!absolute_folder(folder && folder[0] ? folder : ".", base)) return false;
        if (snprintf(absolute, PATH_LIMIT, "%s/%s", base, path) >= PATH_LIMIT) return false;
    }
    normalise(absolute);
    return true;
}

/// An absolute path relative to an absolute folder.
static bool relative(const char *path, const char *folder, char out[PATH_LIMIT])
{
    size_t common = 0; // bytes of the leading names that are the same
    for (size_t i = 0;; i++) {
        bool path_ends = path[i] == '/' || path[i] == '\0', folder_ends = folder[i] == '/' || folder[i] == '\0';
        if (path_ends && folder_ends) common = i;
        if (path[i] != folder[i] || path[i] == '\0') break;
    }
    size_t used = 0;
    const char *rest = folder + common;
    for (; *rest; rest++) {
        if (*rest != '/' || rest[1] == '\0') continue;
        if (used + 4 > PATH_LIMIT) return false;
        memcpy(out + used, "../", 4);
        used += 3;
    }
    const char *below = path + common + (path[common] == '/');
    if (used + strlen(below) + 1 > PATH_LIMIT) return false;
    strcpy(out + used, below);
    return true;
}

bool path_rebase(const char *path, const char *from, const char *to, char moved[PATH_LIMIT])
{
    char old_folder[PATH_LIMIT], new_folder[PATH_LIMIT], absolute[PATH_LIMIT];
    if (path[0] == '/' || strcmp(from ? from : "", to ? to : "") == 0) return false;
    if (!path_resolve(from, ".", old_folder) || !path_resolve(to, ".", new_folder)) return false;
    if (strcmp(old_folder, new_folder) == 0) return false;
    return path_resolve(from, path, absolute) && relative(absolute, new_folder, moved);
}

bool path_has_end(const char *path, const char *end)
{
    size_t length = strlen(path), n = strlen(end);
    return length > n && strcasecmp(path + length - n, end) == 0;
}
