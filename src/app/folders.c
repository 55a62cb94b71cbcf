/// Finds and makes the user's own folders, by the XDG rules.
#include "app/folders.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const struct {
    const char *variable, *below_home;
} places[] = {
    [FOLDER_CONFIG] = {"XDG_CONFIG_HOME", ".config"},
    [FOLDER_STATE] = {"XDG_STATE_HOME", ".local/state"},
};

/// The base directory specification says to ignore a relative path in the variable.
static bool find(enum folder folder, char *path, size_t size, struct error *error)
{
    const char *own = getenv(places[folder].variable), *home = getenv("HOME");
    bool is_set = own && own[0] == '/';
    if (!is_set && (!home || home[0] != '/')) {
        return fail(error, ERROR_ENVIRONMENT, "no home folder: expected HOME or %s, got neither",
                    places[folder].variable);
    }
    int length = is_set ? snprintf(path, size, "%s/wiggly", own)
                        : snprintf(path, size, "%s/%s/wiggly", home, places[folder].below_home);
    return length < (int)size || fail(error, ERROR_ENVIRONMENT, "the path of the folder %s is too long", path);
}

bool folder_make(enum folder folder, char *path, size_t size, struct error *error)
{
    if (!find(folder, path, size, error)) return false;
    for (char *slash = strchr(path + 1, '/');; slash = strchr(slash + 1, '/')) {
        if (slash) *slash = '\0';
        bool made = mkdir(path, 0700) == 0 || errno == EEXIST;
        if (!made) return fail(error, ERROR_ENVIRONMENT, "%s: cannot be made: %s", path, strerror(errno));
        if (!slash) return true;
        *slash = '/';
    }
}
