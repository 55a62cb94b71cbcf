/// Opens motions of any format, and reads columns of them.
#include "model/motion.h"
#include "base/npy.h"
#include "model/motion_format.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

bool motion_read_at(const struct motion *m, int64_t offset, void *bytes, size_t count, struct error *error)
{
    for (size_t done = 0; done < count;) {
        ssize_t got = pread(m->file, (char *)bytes + done, count - done, offset + (int64_t)done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fail(error, ERROR_INPUT, "%s: cannot be read: %s", m->path, strerror(errno));
        if (got == 0)
            return fail(error, ERROR_INPUT, "%s: expected %lld bytes or more, got a file that ends before", m->path,
                        (long long)offset + (long long)count);
        done += (size_t)got;
    }
    return true;
}

bool motion_counts(struct motion *m, int64_t frames, int64_t vertices, struct error *error)
{
    if (frames < 1 || frames > INT32_MAX || vertices < 1 || vertices > INT32_MAX / 3)
        return fail(error, ERROR_INPUT, "%s: expected one frame and one vertex or more, got %lld and %lld", m->path,
                    (long long)frames, (long long)vertices);
    m->frames = (int)frames;
    m->vertices = (int)vertices;
    return true;
}

bool motion_layout(struct motion *m, int64_t size, struct error *error)
{
    m->strides[2] = m->number_size;
    m->strides[1] = 3 * m->strides[2];
    m->strides[0] = m->vertices * m->strides[1];
    int64_t room = (size - m->data) / m->strides[0]; // whole frames; the product might overflow
    if (size >= m->data && room >= m->frames) return true;
    return fail(error, ERROR_INPUT, "%s: expected %d frames of %d vertices, got a file that ends in frame %lld",
                m->path, m->frames, m->vertices, (long long)(room > 0 ? room : 0));
}

static bool read_header(struct motion *m, int64_t size, struct error *error)
{
    char start[sizeof pc2_magic] = {0};
    if (size < (int64_t)sizeof start)
        return fail(error, ERROR_INPUT, "%s: expected a motion (.npy, .pc2 or .mdd), got a file of %lld bytes",
                    m->path, (long long)size);
    if (!motion_read_at(m, 0, start, sizeof start, error)) return false;
    if (memcmp(start, npy_magic, sizeof npy_magic) == 0) return npy_read_header(m, size, error);
    if (memcmp(start, pc2_magic, sizeof pc2_magic) == 0) return pc2_read_header(m, size, error);
    const char *dot = strrchr(m->path, '.'); // MDD has no magic
    if (dot && strcasecmp(dot, ".mdd") == 0) return mdd_read_header(m, size, error);
    return fail(error, ERROR_INPUT, "%s: expected a motion (.npy, .pc2 or .mdd), got something else", m->path);
}

bool motion_open(struct motion *motion, const char *path, struct error *error)
{
    *motion = (struct motion){.path = path, .file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
    struct stat about;
    bool done;
    if (motion->file < 0 || fstat(motion->file, &about) != 0) {
        done = fail(error, ERROR_INPUT, "%s: cannot be opened: %s", path, strerror(errno));
    } else if (!S_ISREG(about.st_mode)) {
        done = fail(error, ERROR_INPUT, "%s: expected a file, got something else", path);
    } else {
        done = read_header(motion, about.st_size, error);
    }
    if (!done) motion_close(motion);
    return done;
}

void motion_close(struct motion *motion)
{
    if (motion->file >= 0) close(motion->file);
    *motion = (struct motion){.file = -1};
}

static double number_at(const struct motion *m, const char *bytes)
{
    if (m->number_size == 4) {
        uint32_t bits;
        float number;
        memcpy(&bits, bytes, sizeof bits);
        if (m->swapped) bits = __builtin_bswap32(bits);
        memcpy(&number, &bits, sizeof number);
        return (double)number;
    }
    uint64_t bits;
    double number;
    memcpy(&bits, bytes, sizeof bits);
    if (m->swapped) bits = __builtin_bswap64(bits);
    memcpy(&number, &bits, sizeof number);
    return number;
}

/// Turns a run of `count` numbers into doubles `stride` apart; returns the first that is not finite, or `count`.
static int convert(const struct motion *m, const char *bytes, int count, double *out, size_t stride)
{
    double sum = 0; // stays 0 unless a number is not finite
    for (int i = 0; i < count; i++) {
        double number = number_at(m, bytes + (size_t)i * (size_t)m->number_size);
        out[(size_t)i * stride] = number;
        sum += 0 * number;
    }
    if (sum == 0) return count;
    for (int i = 0; i < count; i++) {
        if (!isfinite(out[(size_t)i * stride])) return i;
    }
    return count;
}

static bool not_finite(const struct motion *m, int frame, int column, struct error *error)
{
    return fail(error, ERROR_INPUT, "%s: frame %d, vertex %d: expected a finite number, got NaN or infinity", m->path,
                frame, column / 3);
}

/// A run of columns in each frame, as C order has them.
static bool read_rows(const struct motion *m, int first, int count, char *bytes, double *slab, struct error *error)
{
    size_t size = (size_t)count * (size_t)m->number_size;
    for (int i = 0; i < m->frames; i++) {
        int64_t at = m->data + i * m->strides[0] + (int64_t)first * m->number_size;
        if (!motion_read_at(m, at, bytes, size, error)) return false;
        int bad = convert(m, bytes, count, slab + (size_t)i * (size_t)count, 1);
        if (bad < count) return not_finite(m, i, first + bad, error);
    }
    return true;
}

/// All frames of one column after the other, as Fortran order has them.
static bool read_columns(const struct motion *m, int first, int count, char *bytes, double *slab, struct error *error)
{
    size_t size = (size_t)m->frames * (size_t)m->number_size;
    for (int j = 0; j < count; j++) {
        int column = first + j;
        int64_t at = m->data + column / 3 * m->strides[1] + column % 3 * m->strides[2];
        if (!motion_read_at(m, at, bytes, size, error)) return false;
        int bad = convert(m, bytes, m->frames, slab + j, (size_t)count);
        if (bad < m->frames) return not_finite(m, bad, column, error);
    }
    return true;
}

bool motion_columns(const struct motion *motion, int first, int count, double *slab, struct error *error)
{
    size_t numbers = (size_t)(motion->columns_first ? motion->frames : count);
    char *bytes = malloc(numbers * (size_t)motion->number_size);
    if (!bytes) return fail_no_memory(error, motion->path);
    bool done = motion->columns_first ? read_columns(motion, first, count, bytes, slab, error)
                                      : read_rows(motion, first, count, bytes, slab, error);
    free(bytes);
    return done;
}
