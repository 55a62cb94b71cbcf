/// Tells whether somebody else has written a file since it was read or written here.
#ifndef BASE_STAMP_H
#define BASE_STAMP_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>
#include <time.h>

/// A file as it was at some time.
struct file_stamp {
    bool is_there;
    dev_t device;
    ino_t inode;
    off_t size;
    struct timespec modified;
    uint64_t content; ///< its hash
};

/// The file as it is now.
struct file_stamp file_stamp(const char *path);

/// Whether there is a file with another content now. One that was only touched or copied over itself is not another; the stamp then
/// becomes its own.
bool file_stamp_differs(const char *path, struct file_stamp *stamp);

#endif
