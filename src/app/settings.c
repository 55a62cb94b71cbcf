/// Reads and writes the settings file and its recent files.
#include "app/settings.h"
#include "base/file.h"
#include "base/need.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>

enum { MAX_LINES = 1000, PATIENCE = 5000 };

static const size_t LARGEST = 1 << 20;

/// A line: key and value, or (key NULL) a comment.
struct line {
    char *key, *value;
};

struct settings {
    struct line lines[MAX_LINES];
    int count;
    int lock; ///< descriptor of the locked folder, or -1
};

static void drop_line(struct settings *settings, int at)
{
    free(settings->lines[at].key);
    free(settings->lines[at].value);
    settings->count--;
    memmove(&settings->lines[at], &settings->lines[at + 1],
            (size_t)(settings->count - at) * sizeof settings->lines[0]);
}

/// Inserts a line at `at` if there is room.
static void insert_line(struct settings *settings, int at, const char *key, const char *value)
{
    if (settings->count == MAX_LINES) return;
    memmove(&settings->lines[at + 1], &settings->lines[at],
            (size_t)(settings->count - at) * sizeof settings->lines[0]);
    settings->lines[at] = (struct line){key ? need_text(key) : NULL, need_text(value)};
    settings->count++;
}

static char *trim(char *text)
{
    // A byte order mark goes in any line: where those before it are ignored, it comes first the next time.
    for (size_t mark = 1; mark > 0; text += mark) {
        text += strspn(text, " \t\r");
        mark = file_text_mark(text);
    }
    size_t length = strlen(text);
    while (length > 0 && strchr(" \t\r", text[length - 1])) text[--length] = '\0';
    return text;
}

struct settings *settings_load(const char *path, struct error *error)
{
    struct settings *settings = need_zeroed(1, sizeof *settings);
    char *data, *rest;
    size_t size;
    *error = (struct error){0};
    settings->lock = -1;
    if (access(path, F_OK) != 0 || !file_read(path, LARGEST, &data, &size, error)) return settings;
    rest = data;
    for (int number = 1; rest && *rest && number <= MAX_LINES; number++) {
        char *line = trim(strsep(&rest, "\n")), *equals = strchr(line, '=');
        if (line[0] == '\0' || line[0] == '#') {
            insert_line(settings, settings->count, NULL, line);
        } else if (equals && equals > line) {
            *equals = '\0';
            insert_line(settings, settings->count, trim(line), trim(equals + 1));
        } else if (error->kind == ERROR_NONE) {
            fail(error, ERROR_INPUT, "%s:%d: expected key = value, got \"%.40s\": ignoring this line", path, number,
                 line);
        }
    }
    if (rest && *rest && error->kind == ERROR_NONE)
        fail(error, ERROR_INPUT, "%s:%d: expected at most %d lines, got more: ignoring the rest", path, MAX_LINES + 1,
             MAX_LINES);
    free(data);
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
    return settings;
}

void settings_free(struct settings *settings)
{
    if (!settings) return;
    while (settings->count > 0) drop_line(settings, settings->count - 1);
    if (settings->lock >= 0) close(settings->lock);
    free(settings);
}

/// Index of the `n`th line with a key, or -1.
static int find_line(const struct settings *settings, const char *key, int n)
{
    for (int i = 0; i < settings->count; i++) {
        const char *other = settings->lines[i].key;
        if (other && strcmp(other, key) == 0 && n-- == 0) return i;
    }
    return -1;
}

const char *settings_get(const struct settings *settings, const char *key, int n)
{
    int at = find_line(settings, key, n);
    return at >= 0 ? settings->lines[at].value : NULL;
}

double settings_number(const struct settings *settings, const char *key, double fallback)
{
    const char *text = settings_get(settings, key, 0);
    char *end = NULL;
    double value = text ? strtod(text, &end) : NAN;
    return text && end != text && *end == '\0' && isfinite(value) ? value : fallback;
}

/// Whether the value survives the file: no line break, no space at the ends.
static bool is_storable(const char *value)
{
    size_t length = strlen(value);
    return !strchr(value, '\n') &&
           (length == 0 || (!strchr(" \t\r", value[0]) && !strchr(" \t\r", value[length - 1])));
}

void settings_set(struct settings *settings, const char *key, const char *value)
{
    const int first = find_line(settings, key, 0);
    for (int at = first; at >= 0; at = find_line(settings, key, 0)) drop_line(settings, at);
    if (is_storable(value)) insert_line(settings, first >= 0 ? first : settings->count, key, value);
}

void settings_set_number(struct settings *settings, const char *key, double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.6g", value);
    settings_set(settings, key, text);
}

bool settings_save(const struct settings *settings, const char *path, struct error *error)
{
    struct file_output output;
    if (!file_output_open(&output, path, error)) return false;
    for (int i = 0; i < settings->count; i++) {
        const struct line *line = &settings->lines[i];
        fprintf(output.stream, "%s%s%s\n", line->key ? line->key : "", line->key ? " = " : "", line->value);
    }
    return file_output_commit(&output, error);
}

void recent_note(struct settings *settings, const char *path)
{
    static const char key[] = "recent";
    char full[PATH_MAX];
    if (!realpath(path, full) || !is_storable(full)) return;
    int first = find_line(settings, key, 0);
    for (int n = 0, at; (at = find_line(settings, key, n)) >= 0;) {
        if (strcmp(settings->lines[at].value, full) == 0) {
            drop_line(settings, at);
        } else {
            n++;
        }
    }
    insert_line(settings, first >= 0 ? first : settings->count, key, full);
    for (int at; (at = find_line(settings, key, DIALOG_MAX_RECENT)) >= 0;) drop_line(settings, at);
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
    {"export_all_clips", offsetof(struct export_wish, all_clips)},
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
    // The dialog knows the scene by the path it was opened with.
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

/// Absolute, because the next run may start in another folder.
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
