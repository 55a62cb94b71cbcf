/// Keeps the list of what a save adds and removes, and acts on one that a killed program left. It holds numbers, not names: whatever is
/// in it, nothing is removed but paint named after the scene.
#include "scene/leftovers.h"
#include "base/file.h"
#include "base/json.h"
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LARGEST_SCENE = 1 << 28, LARGEST_LIST = 1 << 14, MANY_NUMBERS = 10000 };

bool leftovers_name(const char *scene, int number, char file[PATH_LIMIT])
{
    const char *name = path_name(scene), *dot = strrchr(name, '.');
    const int stem = (int)(dot && dot > name ? dot - scene : (long)strlen(scene));
    char suffix[16] = "";
    if (number > 1) snprintf(suffix, sizeof suffix, "-%d", number);
    return snprintf(file, PATH_LIMIT, "%.*s-paint%s.npy", stem, scene, suffix) < PATH_LIMIT;
}

/// Whether a text in it has the name.
static bool has_text(json_t *json, const char *name)
{
    const char *key;
    json_t *value;
    size_t i;
    json_object_foreach(json, key, value) if (has_text(value, name)) return true;
    json_array_foreach(json, i, value) if (has_text(value, name)) return true;
    return json_is_string(json) && strstr(json_string_value(json), name);
}

/// Whether a scene may name a file. Most have no escapes, and need not be parsed.
static bool may_name(const char *data, size_t size, const char *name)
{
    json_error_t error;
    if (memmem(data, size, name, strlen(name))) return true;
    if (!memchr(data, '\\', size)) return false;
    json_t *json = json_read(data, size, 0, &error);
    const bool named = !json || has_text(json, name);
    json_decref(json);
    return named;
}

/// Whether a scene in the folder may name a file: a copy of the scene may be the only one that does.
static bool is_named(const char *folder, const char *name)
{
    DIR *directory = opendir(folder[0] ? folder : ".");
    bool named = !directory;
    const struct dirent *entry;
    while (!named && (entry = readdir(directory)) != NULL) {
        char path[PATH_LIMIT], *data;
        size_t size;
        if (!path_has_end(entry->d_name, ".json")) continue;
        const bool read =
            path_resolve(folder, entry->d_name, path) && file_read(path, LARGEST_SCENE, &data, &size, NULL);
        named = !read || may_name(data, size, name);
        if (read) free(data);
    }
    if (directory) closedir(directory);
    return named;
}

void leftovers_remove(const char *file)
{
    char folder[PATH_LIMIT];
    if (path_folder(file, folder) && access(file, F_OK) == 0 && !is_named(folder, path_name(file))) unlink(file);
}

/// Removes what the list names. Each number counts once, for all scenes in the folder are read for it.
static void act_on(const struct leftovers *leftovers)
{
    char list[LARGEST_LIST], file[PATH_LIMIT], *rest = list;
    bool tried[MANY_NUMBERS] = {false};
    const ssize_t size = read(leftovers->file, list, sizeof list - 1);
    if (size < 0 || size == sizeof list - 1) return; // no save writes as much
    list[size] = '\0';
    for (long number; (number = strtol(rest, &rest, 10)) > 0 && number < MANY_NUMBERS;) {
        if (!tried[number] && leftovers_name(leftovers->scene, (int)number, file)) leftovers_remove(file);
        tried[number] = true;
    }
}

void leftovers_open(struct leftovers *leftovers, const char *scene)
{
    const char *name = path_name(scene);
    *leftovers = (struct leftovers){.scene = scene, .file = -1};
    if (snprintf(leftovers->path, PATH_LIMIT, "%.*s.%s.saving", (int)(name - scene), scene, name) >= PATH_LIMIT)
        leftovers->path[0] = '\0';
    leftovers->file = open(leftovers->path, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (leftovers->file < 0) return;
    struct stat about;
    const bool is_list = fstat(leftovers->file, &about) == 0 && S_ISREG(about.st_mode);
    if (is_list && flock(leftovers->file, LOCK_EX | LOCK_NB) == 0) {
        act_on(leftovers);
        leftovers_close(leftovers);
    } else {
        close(leftovers->file);
        leftovers->file = -1;
    }
}

void leftovers_note(struct leftovers *leftovers, const char *file)
{
    char own[PATH_LIMIT], real[PATH_LIMIT], line[16], end[2];
    int number = 1;
    const char *mark = strstr(path_name(file), "-paint");
    for (const char *next = mark; next; next = strstr(next + 1, "-paint"))
        mark = next; // the scene's name may have one
    if (!mark || (sscanf(mark, "-paint-%d.np%1[y]", &number, end) != 2 && strcmp(mark, "-paint.npy") != 0)) return;
    if (!leftovers_name(leftovers->scene, number, own) || !path_resolve(NULL, own, real)) return;
    if (!path_resolve(NULL, file, own) || strcmp(own, real) != 0) return;
    if (leftovers->file < 0) {
        leftovers->file = open(leftovers->path, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
        if (leftovers->file >= 0) flock(leftovers->file, LOCK_EX | LOCK_NB);
    }
    const int length = snprintf(line, sizeof line, "%d\n", number);
    if (leftovers->file >= 0 && write(leftovers->file, line, (size_t)length) == length) fsync(leftovers->file);
}

void leftovers_close(struct leftovers *leftovers)
{
    if (leftovers->file < 0) return;
    unlink(leftovers->path);
    close(leftovers->file);
    leftovers->file = -1;
}
