/// Slots of recovery files, locked by the program that uses them.
#include "app/recovery.h"
#include "base/file.h"
#include "base/need.h"
#include "scene/load.h"
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static const char first_line[] = "wiggly-recovery 1";
static const size_t LARGEST = (size_t)1 << 30;

/// The lock file is never removed: that would let two programs hold two locks of one name.
static bool claim_slot(const char *folder, int n, struct recovery_slot *slot)
{
    char lock[PATH_LIMIT + 16];
    int length = snprintf(slot->path, sizeof slot->path, "%s/recovery-%d", folder, n);
    if (length >= (int)sizeof slot->path) {
        errno = ENAMETOOLONG;
        return false;
    }
    snprintf(lock, sizeof lock, "%s.lock", slot->path);
    slot->lock = open(lock, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (slot->lock < 0) return false;
    if (flock(slot->lock, LOCK_EX | LOCK_NB) == 0) return true;
    int cause = errno;
    close(slot->lock);
    errno = cause;
    return false;
}

bool recovery_claim(const char *folder, struct recovery_slot *slot, struct error *error)
{
    for (int n = 1; n <= RECOVERY_SLOTS; n++) {
        if (claim_slot(folder, n, slot)) {
            if (access(slot->path, F_OK) != 0) return true;
            recovery_release(slot);
        } else if (errno != EWOULDBLOCK) {
            return fail(error, ERROR_ENVIRONMENT, "%s: cannot write a recovery file there: %s", folder,
                        strerror(errno));
        }
    }
    return fail(error, ERROR_ENVIRONMENT, "%s: there are %d recovery files already: recover or discard some", folder,
                RECOVERY_SLOTS);
}

void recovery_release(struct recovery_slot *slot)
{
    if (slot->lock >= 0) close(slot->lock);
    slot->lock = -1;
}

/// The document in the text after the first line: the scene and, after a NUL, its paint.
static struct document *parse_work(const char *path, const char *text, size_t size, struct error *error)
{
    const char *end = memchr(text, '\0', size);
    struct document *document = scene_parse(path, text, end ? (size_t)(end - text) : size, NULL, error);
    if (!document || !end) return document;
    if (scene_parse_paint(document, path, end + 1, size - (size_t)(end + 1 - text), error)) return document;
    document_destroy(document);
    return NULL;
}

/// Reads the line of a stamp; returns its length, or 0 where there is none.
static int parse_stamp(const char *line, struct file_stamp *stamp)
{
    long long size;
    unsigned long long content;
    int length;
    if (sscanf(line, "file %lld %llx%n", &size, &content, &length) != 2 || line[length] != '\n') return 0;
    *stamp = (struct file_stamp){.is_there = true, .size = size, .content = content};
    return length + 1;
}

/// A name may hold line breaks, but no NUL: in the first line each stands for the other.
static void swap_line_breaks(char *path, size_t length, char from, char to)
{
    for (size_t i = 0; i < length; i++) {
        if (path[i] == from) path[i] = to;
    }
}

/// The path in a file's first line, "" if there is none, and the stamp (may be NULL) in its second.
static void read_original(const char *path, char original[PATH_LIMIT], struct file_stamp *stamp)
{
    char start[PATH_LIMIT + 128];
    const size_t prefix = sizeof first_line;                        // with a space in place of its end
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC); // a FIFO would wait for a writer
    original[0] = '\0';
    if (file < 0) return;
    const ssize_t size = read(file, start, sizeof start - 1);
    close(file);
    if (size < 0) return;
    start[size] = '\0';
    const char *end = memchr(start, '\n', (size_t)size);
    const bool good = end && strncmp(start, first_line, prefix - 1) == 0 && start[prefix - 1] == ' ';
    const size_t length = good ? (size_t)(end - start) - prefix : 0;
    if (!good || length >= PATH_LIMIT) return;
    memcpy(original, start + prefix, length);
    original[length] = '\0';
    swap_line_breaks(original, length, '\0', '\n');
    if (stamp) parse_stamp(end + 1, stamp);
}

/// Whether a slot's file has work on that document.
static bool is_of(const char *path, const char *of)
{
    char original[PATH_LIMIT], kept[PATH_LIMIT], wanted[PATH_LIMIT];
    read_original(path, original, NULL);
    return original[0] && path_resolve(NULL, original, kept) && path_resolve(NULL, of, wanted) &&
           strcmp(kept, wanted) == 0;
}

bool recovery_find(const char *folder, const char *of, struct recovery_entry *entry, int *count)
{
    struct timespec newest = {0};
    int found = 0;
    for (int n = 1; n <= RECOVERY_SLOTS; n++) {
        struct recovery_slot slot;
        struct stat about;
        char path[PATH_LIMIT];
        snprintf(path, sizeof path, "%s/recovery-%d", folder, n);
        if (stat(path, &about) != 0 || (of && !is_of(path, of)) || !claim_slot(folder, n, &slot)) continue;
        bool newer = found++ == 0 || about.st_mtim.tv_sec > newest.tv_sec ||
                     (about.st_mtim.tv_sec == newest.tv_sec && about.st_mtim.tv_nsec > newest.tv_nsec);
        if (newer && found > 1) recovery_release(&entry->slot);
        if (newer) {
            newest = about.st_mtim;
            entry->slot = slot;
        } else {
            recovery_release(&slot);
        }
    }
    if (count) *count = found;
    if (found == 0) return false;
    entry->time = newest.tv_sec;
    entry->stamp = (struct file_stamp){0};
    read_original(entry->slot.path, entry->original, &entry->stamp);
    return true;
}

struct document *recovery_read(const struct recovery_slot *slot, struct error *error)
{
    char *data;
    size_t size;
    struct document *document = NULL;
    if (!file_read(slot->path, LARGEST, &data, &size, error)) return NULL;
    const char *line_end = memchr(data, '\n', size);
    if (line_end && strncmp(data, first_line, sizeof first_line - 1) == 0) {
        struct file_stamp stamp;
        const char *text = line_end + 1;
        text += parse_stamp(text, &stamp);
        document = parse_work(slot->path, text, size - (size_t)(text - data), error);
        if (document) document->folder = need_text(RECOVERY_FOLDER);
    } else {
        fail(error, ERROR_INPUT, "%s:1: expected \"%s\", got something else", slot->path, first_line);
    }
    free(data);
    return document;
}

bool recovery_write(const struct recovery_slot *slot, const char *original, const struct file_stamp *stamp,
                    const char *text, size_t size, struct error *error)
{
    struct file_output output;
    char absolute[PATH_LIMIT]; // the next start may have another working folder
    const bool fits = original[0] && path_resolve(NULL, original, absolute); // else it is recovered as untitled
    const size_t length = fits ? strlen(absolute) : 0;
    if (!file_output_open(&output, slot->path, error)) return false;
    fchmod(fileno(output.stream), 0600); // the work is nobody else's
    swap_line_breaks(absolute, length, '\n', '\0');
    fprintf(output.stream, "%s ", first_line);
    fwrite(absolute, 1, length, output.stream);
    fputc('\n', output.stream);
    if (fits && stamp && stamp->is_there)
        fprintf(output.stream, "file %lld %llx\n", (long long)stamp->size, (unsigned long long)stamp->content);
    fwrite(text, 1, size, output.stream);
    return file_output_commit(&output, error);
}

void recovery_remove(const struct recovery_slot *slot) { unlink(slot->path); }
