/// The files that the settings remember.
#include "app/remembered.h"
#include "base/file.h"
#include <limits.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void recent_note(struct settings *settings, const char *path)
{
    char full[PATH_MAX];
    if (realpath(path, full)) settings_push(settings, "recent", full, DIALOG_MAX_RECENT);
}

int recent_list(const struct settings *settings, struct dialog_recent *files, int most)
{
    int count = 0;
    const char *path;
    for (int n = 0; count < most && (path = settings_get(settings, "recent", n)) != NULL; n++) {
        struct dialog_recent *file = &files[count];
        if (strlen(path) >= sizeof file->path) continue;
        snprintf(file->path, sizeof file->path, "%s", path);
        file->missing = access(path, R_OK) != 0;
        count++;
    }
    return count;
}

static const struct {
    const char *key;
    size_t offset;
} flags[] = {
    {"export_tangents", offsetof(struct export_wish, is_cubic)},
    {"export_signed", offsetof(struct export_wish, is_signed)},
    {"export_transparent", offsetof(struct export_wish, transparent)},
};

static const struct {
    const char *key;
    size_t offset;
    int most;
} numbers[] = {
    {"export_keys", offsetof(struct export_wish, keys), 1024},
    {"export_width", offsetof(struct export_wish, width), 8192},
    {"export_height", offsetof(struct export_wish, height), 8192},
};

static void read_text(const struct settings *settings, const char *key, char *text, size_t size)
{
    const char *value = settings_get(settings, key, 0);
    if (value && strlen(value) < size) snprintf(text, size, "%s", value);
}

void export_memory_read(const struct settings *settings, const char *scene, struct export_memory *memory)
{
    char *wish = (char *)&memory->wish, open[PATH_LIMIT];
    *memory = (struct export_memory){.path = ""};
    read_text(settings, "export_path", memory->path, sizeof memory->path);
    read_text(settings, "export_scene", memory->scene, sizeof memory->scene);
    // The dialog knows the scene by the path that it was opened by.
    if (path_resolve("", scene, open) && strcmp(open, memory->scene) == 0)
        snprintf(memory->scene, sizeof memory->scene, "%s", scene);
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++) {
        const char *value = settings_get(settings, flags[i].key, 0);
        *(bool *)(void *)(wish + flags[i].offset) = value && strcmp(value, "yes") == 0;
    }
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const double value = settings_number(settings, numbers[i].key, 0);
        *(int *)(void *)(wish + numbers[i].offset) = value >= 1 && value <= numbers[i].most ? (int)value : 0;
    }
}

/// Absolute, because the next run may begin in another folder.
static void write_path(struct settings *settings, const char *key, const char *path)
{
    char absolute[PATH_LIMIT];
    const bool resolved = path[0] && path_resolve("", path, absolute);
    settings_set(settings, key, resolved ? absolute : path);
}

void export_memory_write(struct settings *settings, const struct request *request, const char *scene)
{
    const char *wish = (const char *)&request->wish;
    write_path(settings, "export_path", request->path);
    write_path(settings, "export_scene", scene);
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++) {
        settings_set(settings, flags[i].key, *(const bool *)(const void *)(wish + flags[i].offset) ? "yes" : "no");
    }
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        settings_set_number(settings, numbers[i].key, *(const int *)(const void *)(wish + numbers[i].offset));
}
