/// Compares a file with what it was.
#include "base/stamp.h"
#include "base/file.h"
#include "base/hash.h"
#include <stdlib.h>
#include <sys/stat.h>

static const size_t LARGEST = (size_t)1 << 30;

static struct file_stamp look(const char *path)
{
    struct stat about;
    if (stat(path, &about) != 0) return (struct file_stamp){0};
    return (struct file_stamp){.is_there = true,
                               .device = about.st_dev,
                               .inode = about.st_ino,
                               .size = about.st_size,
                               .modified = about.st_mtim};
}

static bool same_file(const struct file_stamp *a, const struct file_stamp *b)
{
    return a->is_there == b->is_there && a->device == b->device && a->inode == b->inode && a->size == b->size &&
           a->modified.tv_sec == b->modified.tv_sec && a->modified.tv_nsec == b->modified.tv_nsec;
}

struct file_stamp file_stamp(const char *path)
{
    struct file_stamp stamp = look(path);
    struct error error;
    char *data;
    size_t size;
    if (!stamp.is_there || !file_read(path, LARGEST, &data, &size, &error)) return stamp;
    stamp.content = hash_bytes(HASH_START, data, size);
    free(data);
    return stamp;
}

bool file_stamp_differs(const char *path, struct file_stamp *stamp)
{
    struct file_stamp now = look(path);
    if (!now.is_there || same_file(&now, stamp)) return false;
    now = file_stamp(path);
    if (!stamp->is_there || now.size != stamp->size || now.content != stamp->content) return true;
    *stamp = now;
    return false;
}
