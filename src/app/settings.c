/// Reads and writes the settings file and its recent files.
#include "app/personal.h"
#include "base/file.h"
#include "base/json.h"
#include "base/need.h"
#include "scene/text.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>

enum { PATIENCE = 5000 };

static const size_t LARGEST = 1 << 20;

struct settings {
    json_t *values;
    int lock; ///< descriptor of the locked folder, or -1
};

/// A string, whose bytes that are not UTF-8 survive the file.
static json_t *string_value(const char *string)
{
    struct text quoted = {0};
    text_path(&quoted, string);
    json_t *value = json_loadb(quoted.data, quoted.size, JSON_DECODE_ANY, NULL);
    free(quoted.data);
    return value;
}

struct settings *settings_load(const char *path, struct error *error)
{
    struct settings *settings = need_zeroed(1, sizeof *settings);
    char *text;
    size_t size;
    json_error_t wrong;
    *error = (struct error){0};
    settings->lock = -1;
    settings->values = json_object();
    if (access(path, F_OK) != 0 || !file_read_text(path, LARGEST, &text, &size, error)) return settings;
    json_t *values = json_read(text, size, JSON_REJECT_DUPLICATES, &wrong);
    if (!values)
        fail(error, ERROR_INPUT, "%s:%d: %s: correct or delete this file, else no setting is kept", path, wrong.line,
             wrong.text);
    json_object_update(settings->values, values);
    json_decref(values);
    free(text);
    return settings;
}

struct settings *settings_open(const char *path, struct error *error)
{
    // Locks the folder, because each save replaces the file. Goes on without a lock if it cannot get one in time: a lost setting is better
    // than a hanging window.
    char folder[PATH_LIMIT];
    int lock = -1;
    if (path_folder(path, folder)) lock = open(folder[0] ? folder : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    for (int i = 0; lock >= 0 && i < PATIENCE && flock(lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; i++)
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    struct settings *settings = settings_load(path, error);
    settings->lock = lock;
    if (error->kind == ERROR_NONE) return settings;
    settings_free(settings);
    return NULL;
}

void settings_free(struct settings *settings)
{
    if (!settings) return;
    json_decref(settings->values);
    if (settings->lock >= 0) close(settings->lock);
    free(settings);
}

const char *settings_get(const struct settings *settings, const char *key)
{
    return json_string_value(json_object_get(settings->values, key));
}

double settings_number(const struct settings *settings, const char *key, double fallback)
{
    const json_t *value = json_object_get(settings->values, key);
    return json_is_number(value) ? json_number_value(value) : fallback;
}

bool settings_flag(const struct settings *settings, const char *key, bool fallback)
{
    const json_t *value = json_object_get(settings->values, key);
    return json_is_boolean(value) ? json_is_true(value) : fallback;
}

void settings_set(struct settings *settings, const char *key, const char *value)
{
    json_object_set_new(settings->values, key, string_value(value));
}

void settings_set_number(struct settings *settings, const char *key, double value)
{
    json_object_set_new(settings->values, key, json_real(value));
}

void settings_set_flag(struct settings *settings, const char *key, bool value)
{
    json_object_set_new(settings->values, key, json_boolean(value));
}

bool settings_save(const struct settings *settings, const char *path, struct error *error)
{
    struct file_output output;
    if (!file_output_open(&output, path, error)) return false;
    json_dumpf(settings->values, output.stream, JSON_INDENT(2) | JSON_REAL_PRECISION(15));
    fputc('\n', output.stream);
    return file_output_commit(&output, error);
}

void recent_note(struct settings *settings, const char *path)
{
    char full[PATH_MAX];
    if (!realpath(path, full)) return;
    json_t *recent = json_array(), *old, *own = string_value(full);
    size_t i;
    json_array_append(recent, own);
    json_array_foreach(json_object_get(settings->values, "recent"), i, old)
    {
        if (!json_equal(old, own) && json_array_size(recent) < DIALOG_MAX_RECENT) json_array_append(recent, old);
    }
    json_object_set_new(settings->values, "recent", recent);
    json_decref(own);
}

/// Copies a string if it is there and fits.
static bool read_string(const json_t *value, char *text, size_t size)
{
    const char *string = json_string_value(value);
    if (!string || strlen(string) >= size) return false;
    strcpy(text, string);
    text_read_path(text);
    return true;
}

int recent_list(const struct settings *settings, struct dialog_recent *files, int most)
{
    int count = 0;
    size_t i;
    json_t *path;
    json_array_foreach(json_object_get(settings->values, "recent"), i, path)
    {
        struct dialog_recent *file = &files[count];
        if (count == most || !read_string(path, file->path, sizeof file->path)) continue;
        file->missing = access(file->path, R_OK) != 0;
        count++;
    }
    return count;
}

/// The choices of an export that suit any scene.
static const struct {
    const char *key;
    size_t offset;
    int most; ///< 0: a bool, else an int
} wishes[] = {
    {"export_signed", offsetof(struct export_wish, is_signed), 0},
    {"export_all_clips", offsetof(struct export_wish, all_clips), 0},
    {"export_transparent", offsetof(struct export_wish, transparent), 0},
    {"export_keys", offsetof(struct export_wish, keys), 1024},
    {"export_width", offsetof(struct export_wish, width), 8192},
    {"export_height", offsetof(struct export_wish, height), 8192},
};

void export_memory_read(const struct settings *settings, const char *scene, struct export_memory *memory)
{
    char open[PATH_LIMIT];
    *memory = (struct export_memory){.path = ""};
    read_string(json_object_get(settings->values, "export_path"), memory->path, sizeof memory->path);
    read_string(json_object_get(settings->values, "export_scene"), memory->scene, sizeof memory->scene);
    // The dialog knows the scene by the path it was opened with.
    if (path_resolve("", scene, open) && strcmp(open, memory->scene) == 0)
        snprintf(memory->scene, sizeof memory->scene, "%s", scene);
    for (size_t i = 0; i < sizeof wishes / sizeof *wishes; i++) {
        void *wish = (char *)&memory->wish + wishes[i].offset;
        const double value = settings_number(settings, wishes[i].key, 0);
        if (wishes[i].most == 0)
            *(bool *)wish = settings_flag(settings, wishes[i].key, false);
        else
            *(int *)wish = value >= 1 && value <= wishes[i].most ? (int)value : 0;
    }
}

/// Absolute, because the next run may start in another folder.
static void write_path(struct settings *settings, const char *key, const char *path)
{
    char absolute[PATH_LIMIT];
    const bool resolved = path[0] && path_resolve("", path, absolute);
    settings_set(settings, key, resolved ? absolute : path);
}

void export_memory_write(struct settings *settings, const struct request *request, const char *scene)
{
    write_path(settings, "export_path", request->path);
    write_path(settings, "export_scene", scene);
    for (size_t i = 0; i < sizeof wishes / sizeof *wishes; i++) {
        const void *wish = (const char *)&request->wish + wishes[i].offset;
        if (wishes[i].most == 0)
            settings_set_flag(settings, wishes[i].key, *(const bool *)wish);
        else
            settings_set_number(settings, wishes[i].key, *(const int *)wish);
    }
}
