/// Reads files, writes them through a temporary file and a rename, hashes their content, and resolves paths.
#include "base/file.h"
#include "base/hash.h"
#include "base/need.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

static const size_t LARGEST = (size_t)1 << 30;

enum { READ_BLOCK = 1 << 16, MAX_LINKS = 32, MAX_NAMES = 100, LARGEST_ACL = 1 << 16 };

static const char acl_name[] = "system.posix_acl_access";

static bool fail_to(struct error *error, enum error_kind kind, const char *doing, const char *path, int cause)
{
    const bool unread = kind == ERROR_ENVIRONMENT && cause == ENXIO;
    return fail(error, kind, "%s: cannot %s: %s", path, doing,
                unread ? "it is a pipe that nobody reads" : strerror(cause ? cause : EIO));
}

/// Whether the file system lacks what was asked for, as NTFS and CIFS may lack rights or syncing. Other failures are of the file.
static bool is_unsupported(int cause)
{
    return cause == EPERM || cause == ENOTSUP || cause == EOPNOTSUPP || cause == EINVAL || cause == ENOSYS;
}

static bool fail_no_file(struct error *error, enum error_kind kind, const char *path, mode_t mode)
{
    return fail(error, kind, "%s: expected a file, got %s", path,
                S_ISDIR(mode) ? "a directory" : "something else (a device or a pipe)");
}

static bool fail_too_large(const char *path, size_t limit, struct error *error)
{
    return fail(error, ERROR_INPUT, "%s: expected at most %zu MiB, got a larger file", path, limit >> 20);
}

bool file_read(const char *path, size_t limit, char **data, size_t *size, struct error *error)
{
    struct stat status;
    *data = NULL;
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC); // a FIFO would wait for a writer
    if (file < 0) return fail_to(error, ERROR_INPUT, "be opened", path, errno);
    file_note_read(path, NULL);
    bool done = false, good = fstat(file, &status) == 0 && S_ISREG(status.st_mode);
    if (!good) fail_no_file(error, ERROR_INPUT, path, status.st_mode);
    if (good && (size_t)status.st_size > limit) good = fail_too_large(path, limit, error);

    // To the end, or one byte past the limit.
    size_t capacity = status.st_size > 0 ? (size_t)status.st_size + 1 : READ_BLOCK;
    *size = 0;
    if (good) *data = malloc(capacity + 1);
    while (good && !done && *data && *size <= limit) {
        const ssize_t got = read(file, *data + *size, capacity - *size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            good = fail_to(error, ERROR_INPUT, "be read", path, errno);
            break;
        }
        *size += (size_t)got;
        done = got == 0 && *size < capacity;
        if (done) (*data)[*size] = '\0';
        if (*size < capacity) continue;
        capacity += capacity;
        char *larger = realloc(*data, capacity + 1);
        if (!larger) free(*data);
        *data = larger;
    }
    if (good && !*data) good = fail_to(error, ERROR_ENVIRONMENT, "be read", path, ENOMEM);
    if (good && !done) fail_too_large(path, limit, error);
    close(file);
    if (done) return true;
    free(*data);
    *data = NULL;
    return false;
}

size_t file_text_mark(const char *text) { return strncmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0; }

bool file_read_text(const char *path, size_t limit, char **text, size_t *size, struct error *error)
{
    if (!file_read(path, limit, text, size, error)) return false;
    const size_t mark = file_text_mark(*text);
    *size -= mark;
    memmove(*text, *text + mark, *size + 1);
    return true;
}

/// `name` relative to the folder of `path`.
static char *path_beside(const char *path, const char *name)
{
    const char *slash = strrchr(path, '/');
    size_t folder = slash && name[0] != '/' ? (size_t)(slash - path) + 1 : 0;
    char *joined = need(folder + strlen(name) + 1, 1);
    memcpy(joined, path, folder);
    strcpy(joined + folder, name);
    return joined;
}

/// The end of a path's symbolic links, whether or not the file exists. NULL with errno set.
static char *resolve_links(const char *path)
{
    char *target = need_text(path);
    for (int i = 0; i < MAX_LINKS; i++) {
        char link[PATH_MAX];
        ssize_t length = readlink(target, link, sizeof link - 1);
        if (length < 0) return target;
        link[length] = '\0';
        char *next = path_beside(target, link);
        free(target);
        target = next;
    }
    free(target);
    errno = ELOOP;
    return NULL;
}

/// The absolute path of a file that does not exist yet, behind links.
static bool resolve_new(const char *path, char absolute[PATH_LIMIT])
{
    char folder[PATH_LIMIT];
    char *target = resolve_links(path);
    const bool done = target && path_folder(target, folder) && path_resolve(folder, path_name(target), absolute);
    free(target);
    return done;
}

bool file_same(const char *path, const char *other)
{
    char first[PATH_LIMIT], second[PATH_LIMIT];
    struct stat a, b;
    const bool a_exists = stat(path, &a) == 0, b_exists = stat(other, &b) == 0;
    if (a_exists && b_exists) return S_ISREG(a.st_mode) && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
    return !a_exists && !b_exists && resolve_new(path, first) && resolve_new(other, second) &&
           strcmp(first, second) == 0;
}

/// The files that a thread reads. They are kept by path and compared as files, because a save gives a path another file.
static _Thread_local struct {
    struct read_file {
        char *path, *as;
    } * files;
    size_t count;
    bool notes;
} reads;

void file_guard_reads(bool notes) { reads.notes = notes; }

void file_note_read(const char *path, const char *as)
{
    if (!reads.notes) return;
    for (size_t i = 0; i < reads.count; i++) {
        if (strcmp(reads.files[i].path, path) == 0) return;
    }
    reads.files = need_more(reads.files, reads.count + 1, sizeof *reads.files);
    reads.files[reads.count++] = (struct read_file){need_text(path), need_text(as ? as : path)};
}

void file_forget_reads(const char *path)
{
    size_t kept = 0;
    for (size_t i = 0; i < reads.count; i++) {
        const struct read_file file = reads.files[i];
        if (path && !file_same(file.path, path)) {
            reads.files[kept++] = file;
        } else {
            free(file.path);
            free(file.as);
        }
    }
    reads.count = kept;
    if (kept > 0) return;
    free(reads.files);
    reads.files = NULL;
}

bool file_check_unread(const char *path, struct error *error)
{
    for (size_t i = 0; i < reads.count; i++) {
        if (file_same(path, reads.files[i].path))
            return fail(error, ERROR_USAGE, "%s: cannot be written, because it is read as %s: name another file",
                        path, reads.files[i].as);
    }
    return true;
}

/// Removes files beside the target that programs which have ended left, once for each folder that is written to in turn. One of
/// another machine is locked while its program runs.
static void sweep_stale(const char *target)
{
    static _Thread_local uint64_t swept;
    char *path = path_beside(target, ".");
    const uint64_t folder = hash_bytes(HASH_START, path, strlen(path));
    DIR *directory = folder != swept ? opendir(path) : NULL;
    swept = folder;
    free(path);
    if (!directory) return;
    for (const struct dirent *entry; (entry = readdir(directory)) != NULL;) {
        const char *name = entry->d_name;
        long owner;
        int number, end = 0;
        if (sscanf(name, ".wiggly-%ld-%d.tmp%n", &owner, &number, &end) != 2 || end == 0 || name[end]) continue;
        if (owner <= 0 || owner == (long)getpid() || kill((pid_t)owner, 0) == 0 || errno != ESRCH) continue;
        // Open for writing, though nothing is written: otherwise NFS cannot lock it.
        int file = openat(dirfd(directory), name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (file < 0) continue;
        if (flock(file, LOCK_EX | LOCK_NB) == 0) unlinkat(dirfd(directory), name, 0);
        close(file);
    }
    closedir(directory);
}

/// Temporary files being written, so that a program told to end can remove them. If there are more, the next output removes the rest.
static char *_Atomic unfinished[8];

static void replace_unfinished(char *before, char *now)
{
    for (size_t i = 0; i < sizeof unfinished / sizeof *unfinished; i++) {
        char *held = before;
        if (atomic_compare_exchange_strong(&unfinished[i], &held, now)) return;
    }
}

void file_remove_unfinished(void)
{
    for (size_t i = 0; i < sizeof unfinished / sizeof *unfinished; i++) {
        const char *path = atomic_load(&unfinished[i]);
        if (path) unlink(path);
    }
}

/// Creates a file beside the target; the kernel applies the umask. Returns the descriptor or -1 with errno set.
static int create_beside(const char *target, mode_t mode, char **temporary)
{
    for (int i = 0; i < MAX_NAMES; i++) {
        char name[64];
        snprintf(name, sizeof name, ".wiggly-%ld-%d.tmp", (long)getpid(), i);
        *temporary = path_beside(target, name);
        need_at_end = file_remove_unfinished;
        replace_unfinished(NULL, *temporary); // a signal may come as soon as the file exists
        int file = open(*temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (file >= 0) {
            flock(file, LOCK_EX | LOCK_NB); // shows sweep_stale() that it is in use
            return file;
        }
        int cause = errno;
        replace_unfinished(*temporary, NULL);
        free(*temporary);
        *temporary = NULL;
        errno = cause;
        if (errno != EEXIST) return -1;
    }
    return -1;
}

/// Gives a new file the owner, group, mode and ACL of an old one. If group or ACL cannot be set, group and others get only the rights that
/// both had: members of the old group are others now. If the mode cannot be set, the file stays private as it was created.
static bool keep_rights(int file, const char *path, const struct stat *old)
{
    unsigned char acl[LARGEST_ACL];
    const ssize_t size = getxattr(path, acl_name, acl, sizeof acl);
    const bool has_owner = fchown(file, old->st_uid, old->st_gid) == 0;
    const bool has_group = has_owner || fchown(file, (uid_t)-1, old->st_gid) == 0;
    fremovexattr(file, acl_name); // inherited from the folder
    const bool kept = has_group && (size < 0 || fsetxattr(file, acl_name, acl, (size_t)size, 0) == 0);

    // The common rights of everyone but the owner: the group, others, and each ACL entry (8 bytes: tag, rights, id).
    enum { VERSION = 4, ENTRY = 8, OWNER = 1 };
    mode_t common = old->st_mode >> 3 & old->st_mode & 7;
    for (ssize_t at = VERSION; at + ENTRY <= size; at += ENTRY) {
        if (acl[at] != OWNER) common &= acl[at + 2];
    }
    const mode_t rest = kept ? old->st_mode & 0077 : common << 3 | common;
    return fchmod(file, (old->st_mode & 0700) | rest) == 0 || is_unsupported(errno);
}

/// Opens a file, device or pipe to be overwritten in place. A FIFO without a reader is refused, because opening it would block.
static int open_in_place(const char *path, int flags)
{
    const int file = open(path, O_WRONLY | O_NONBLOCK | O_CLOEXEC | flags, 0666);
    if (file >= 0) fcntl(file, F_SETFL, fcntl(file, F_GETFL) & ~O_NONBLOCK);
    return file;
}

FILE *file_open_growing(const char *path, struct error *error)
{
    if (!file_check_unread(path, error)) return NULL;
    const int file = open_in_place(path, O_CREAT | O_TRUNC);
    FILE *stream = file >= 0 ? fdopen(file, "w") : NULL;
    if (stream) return stream;
    fail_to(error, ERROR_ENVIRONMENT, "be written", path, errno);
    if (file >= 0) close(file);
    return NULL;
}

bool file_check_place(const char *path, struct error *error)
{
    struct stat status;
    return file_check_unread(path, error) && (stat(path, &status) != 0 || S_ISREG(status.st_mode) ||
                                              fail_no_file(error, ERROR_ENVIRONMENT, path, status.st_mode));
}

/// Opens the output: a temporary file beside the target, or the target itself if it is a device or pipe.
static int open_target(const char *path, struct file_output *output)
{
    struct stat old;
    const bool exists = stat(path, &old) == 0;
    if (exists && S_ISDIR(old.st_mode)) {
        errno = EISDIR;
        return -1;
    }
    if (exists && !S_ISREG(old.st_mode)) return open_in_place(path, 0);
    if (exists && access(path, W_OK) != 0) return -1;
    output->target = resolve_links(path);
    if (!output->target) return -1;
    sweep_stale(output->target);
    int file = create_beside(output->target, exists ? 0600 : 0666, &output->temporary);
    if (file >= 0 && exists && !keep_rights(file, path, &old)) {
        close(file);
        return -1;
    }
    return file;
}

bool file_output_open(struct file_output *output, const char *path, struct error *error)
{
    *output = (struct file_output){.path = path};
    if (!file_check_unread(path, error)) return false;
    int file = open_target(path, output);
    if (file >= 0) output->stream = fdopen(file, "wb");
    if (output->stream) return true;
    int cause = errno;
    if (file >= 0) close(file);
    file_output_discard(output);
    return fail_to(error, ERROR_ENVIRONMENT, "be written", path, cause);
}

/// Forgets the temporary file.
static void forget_temporary(struct file_output *output)
{
    if (output->temporary) replace_unfinished(output->temporary, NULL);
    free(output->temporary);
    output->temporary = NULL;
}

static bool sync_file(int file) { return fsync(file) == 0 || is_unsupported(errno); }

/// Copies a complete file to a new one.
static bool copy_to_new(const char *from, const char *to)
{
    char block[READ_BLOCK];
    struct stat status;
    const int in = open(from, O_RDONLY | O_CLOEXEC);
    const int out = in >= 0 && fstat(in, &status) == 0
                        ? open(to, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, status.st_mode & 0777)
                        : -1;
    ssize_t got = 0;
    while (out >= 0 && (got = read(in, block, sizeof block)) > 0) {
        if (write(out, block, (size_t)got) != got) break;
    }
    bool done = out >= 0 && got == 0 && sync_file(out);
    if (out >= 0) done = close(out) == 0 && done;
    if (out >= 0 && !done) unlink(to);
    if (in >= 0) close(in);
    return done;
}

bool file_output_commit(struct file_output *output, struct error *error)
{
    FILE *stream = output->stream;
    bool replaces = output->temporary != NULL;
    bool done = !ferror(stream) && fflush(stream) == 0 && (!replaces || sync_file(fileno(stream)));
    int cause = errno;
    output->stream = NULL;
    if (fclose(stream) != 0 && done) {
        done = false;
        cause = errno;
    }
    if (done && replaces) {
        done = rename(output->temporary, output->target) == 0;
        cause = errno;
        // Where renaming is refused, a copy can still make a new file, but not replace an old one whole.
        const bool copied = !done && copy_to_new(output->temporary, output->target);
        if (copied) unlink(output->temporary);
        done |= copied;
    }
    if (done && replaces) {
        forget_temporary(output);
        // The folder's entry must be on the disk, too. If the file system cannot do that, the content is still safe.
        char *folder = path_beside(output->target, ".");
        const int file = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        free(folder);
        if (file >= 0) {
            fsync(file);
            close(file);
        }
    }
    if (!done) fail_to(error, ERROR_ENVIRONMENT, "be written", output->path, cause);
    file_output_discard(output);
    return done;
}

void file_output_discard(struct file_output *output)
{
    if (output->stream) fclose(output->stream);
    if (output->temporary) unlink(output->temporary);
    forget_temporary(output);
    free(output->target);
    *output = (struct file_output){0};
}

bool file_write_atomic(const char *path, const void *data, size_t size, struct error *error)
{
    struct file_output output;
    if (!file_output_open(&output, path, error)) return false;
    fwrite(data, 1, size, output.stream);
    return file_output_commit(&output, error); // which sees what went wrong
}

uint64_t file_content(const char *path)
{
    char *data;
    size_t size;
    if (!file_read(path, LARGEST, &data, &size, NULL)) return 0;
    const uint64_t content = hash_bytes(HASH_START, data, size);
    free(data);
    return content ? content : 1;
}

// --- paths

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

bool path_resolve(const char *folder, const char *path, char absolute[PATH_LIMIT])
{
    char real[PATH_LIMIT], working[PATH_LIMIT] = "";
    if (path[0] == '/') {
        if (strlen(path) >= PATH_LIMIT) return false;
        strcpy(absolute, path);
    } else { // of a folder that does not exist, links and dots stay
        if (!folder || !folder[0]) folder = ".";
        if (strlen(folder) >= PATH_LIMIT) return false;
        const bool exists = realpath(folder, real);
        if (!exists && folder[0] != '/' && !getcwd(working, sizeof working)) return false;
        if (snprintf(absolute, PATH_LIMIT, "%s%s%s/%s", working, *working ? "/" : "", exists ? real : folder, path) >=
            PATH_LIMIT)
            return false;
    }

    char *out = absolute; // without ".", ".." and repeated slashes
    for (const char *in = absolute; *in;) {
        while (*in == '/') in++;
        size_t length = strcspn(in, "/");
        if (length == 2 && memcmp(in, "..", 2) == 0) {
            while (out > absolute && *--out != '/') continue;
        } else if (length > 0 && !(length == 1 && *in == '.')) {
            *out++ = '/';
            memmove(out, in, length);
            out += length;
        }
        in += length;
    }
    if (out == absolute) *out++ = '/';
    *out = '\0';
    return true;
}

bool path_rebase(const char *path, const char *from, const char *to, char moved[PATH_LIMIT])
{
    char old_folder[PATH_LIMIT], new_folder[PATH_LIMIT], absolute[PATH_LIMIT];
    if (path[0] == '/' || strcmp(from ? from : "", to ? to : "") == 0) return false;
    if (!path_resolve(from, ".", old_folder) || !path_resolve(to, ".", new_folder)) return false;
    if (strcmp(old_folder, new_folder) == 0) return false;
    if (!path_resolve(from, path, absolute)) return false;

    size_t common = 0, used = 0; // bytes of the leading names that are the same
    for (size_t i = 0;; i++) {
        const char a = absolute[i], b = new_folder[i];
        if ((a == '/' || a == '\0') && (b == '/' || b == '\0')) common = i;
        if (a != b || a == '\0') break;
    }
    for (const char *rest = new_folder + common; *rest; rest++) {
        if (*rest != '/' || rest[1] == '\0') continue;
        if (used + 4 > PATH_LIMIT) return false;
        memcpy(moved + used, "../", 4);
        used += 3;
    }
    const char *below = absolute + common + (absolute[common] == '/');
    if (used + strlen(below) + 1 > PATH_LIMIT) return false;
    strcpy(moved + used, below);
    return true;
}

bool path_has_end(const char *path, const char *end)
{
    size_t length = strlen(path), n = strlen(end);
    return length > n && strcasecmp(path + length - n, end) == 0;
}
