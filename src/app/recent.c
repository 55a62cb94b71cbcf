/// The list of recent files in the settings.
#include "app/recent.h"
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char key[] = "recent";

void recent_note(struct settings *settings, const char *path)
{
    char full[PATH_MAX];
    if (realpath(path, full)) settings_push(settings, key, full, DIALOG_MAX_RECENT);
}

int recent_list(const struct settings *settings, struct dialog_recent *files, int most)
{
    int count = 0;
    const char *path;
    for (int n = 0; count < most && (path = settings_get(settings, key, n)) != NULL; n++) {
        struct dialog_recent *file = &files[count];
        if (strlen(path) >= sizeof file->path) continue;
        snprintf(file->path, sizeof file->path, "%s", path);
        file->missing = access(path, R_OK) != 0;
        count++;
    }
    return count;
}
