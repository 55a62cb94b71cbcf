/// Reads and writes motions: for each format a reader of its header and a writer of its start.
#include "model/motion.h"
#include "base/npy.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the files' numbers are read as they lie");

enum { PC2_HEADER = 32, MDD_HEADER = 8 };

static const char pc2_magic[12] = "POINTCACHE2"; ///< first bytes of a PC2 file

/// Reads exactly `count` bytes at `offset`; a shorter file is an error.
static bool read_at(const struct motion *m, int64_t offset, void *bytes, size_t count, struct error *error)
{
    if (m->memory) memcpy(bytes, m->memory + offset, count);
    for (size_t done = m->memory ? count : 0; done < count;) {
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

/// Checks a header's counts: 3 · vertices must fit, too.
static bool set_counts(struct motion *m, int64_t frames, int64_t vertices, struct error *error)
{
    if (frames < 1 || frames > INT32_MAX || vertices < 1 || vertices > INT32_MAX / 3)
        return fail(error, ERROR_INPUT, "%s: expected one frame and one vertex or more, got %lld and %lld", m->path,
                    (long long)frames, (long long)vertices);
    m->frames = (int)frames;
    m->vertices = (int)vertices;
    return true;
}

/// Sets the strides of numbers in C order and checks that the file is long enough.
static bool set_layout(struct motion *m, int64_t size, struct error *error)
{
    m->strides[2] = m->number_size;
    m->strides[1] = 3 * m->strides[2];
    m->strides[0] = m->vertices * m->strides[1];
    int64_t room = (size - m->data) / m->strides[0]; // in frames, because the product might overflow
    if (size >= m->data && room >= m->frames) return true;
    return fail(error, ERROR_INPUT, "%s: expected %d frames of %d vertices, got a file that ends in frame %lld",
                m->path, m->frames, m->vertices, (long long)(room > 0 ? room : 0));
}

// --- NumPy's .npy, an array of shape (frames, vertices, 3) or (frames, 3 vertices), and the point caches PC2 and MDD
//
//     PC2, little endian                          MDD, big endian
//     0   char[12]  "POINTCACHE2\0"               0   int32    frames F
//     12  int32     version, 1                    4   int32    points
//     16  int32     points                        8   float[F] times in seconds
//     20  float     first frame
//     24  float     frames a sample
//     28  int32     samples
//     then float32 x y z of each point of each frame, in both

static bool read_header(struct motion *m, int64_t size, struct error *error)
{
    char start[sizeof pc2_magic] = {0};
    if (size < (int64_t)sizeof start)
        return fail(error, ERROR_INPUT, "%s: expected a motion (.npy, .pc2 or .mdd), got a file of %lld bytes",
                    m->path, (long long)size);
    if (!read_at(m, 0, start, sizeof start, error)) return false;
    if (memcmp(start, npy_magic, sizeof npy_magic) == 0) {
        char head[NPY_START + NPY_DICTIONARY];
        struct npy npy;
        const size_t there = size < (int64_t)sizeof head ? (size_t)size : sizeof head;
        if (!read_at(m, 0, head, there, error) || !npy_read_header(&npy, m->path, head, there, error)) return false;
        m->data = npy.data;
        m->swapped = npy.swapped;
        m->number_size = npy.number_size;
        const bool flat = npy.count == 2 && npy.lengths[1] % 3 == 0;
        if (!flat && !(npy.count == 3 && npy.lengths[2] == 3))
            return fail(error, ERROR_INPUT, "%s: expected an array of shape (frames, vertices, 3), got %s", m->path,
                        npy.shape);
        if (!set_counts(m, npy.lengths[0], flat ? npy.lengths[1] / 3 : npy.lengths[1], error) ||
            !set_layout(m, size, error))
            return false;

        // Fortran order: the first index runs fastest. In (frames, 3 vertices), vertex and coordinate are one index in which the coordinate runs
        // faster.
        const int64_t column = (int64_t)m->number_size * m->frames;
        m->columns_first = npy.columns_first;
        if (!m->columns_first) return true;
        m->strides[1] = flat ? 3 * column : column;
        m->strides[2] = flat ? column : column * m->vertices;
        return true;
    }
    if (memcmp(start, pc2_magic, sizeof pc2_magic) == 0) {
        int32_t numbers[5];
        if (!read_at(m, sizeof pc2_magic, numbers, sizeof numbers, error)) return false;
        if (numbers[0] != 1)
            return fail(error, ERROR_INPUT, "%s: expected version 1 of PC2, got %d", m->path, (int)numbers[0]);
        m->data = PC2_HEADER;
        m->number_size = 4;
        return set_counts(m, numbers[4], numbers[1], error) && set_layout(m, size, error);
    }
    if (!path_has_end(m->path, ".mdd")) // which has no magic number
        return fail(error, ERROR_INPUT, "%s: expected a motion (.npy, .pc2 or .mdd), got something else", m->path);
    if (!set_counts(m, (int64_t)number_read(start, NUMBER_INT32, true),
                    (int64_t)number_read(start + 4, NUMBER_INT32, true), error))
        return false;
    m->data = MDD_HEADER + 4 * (int64_t)m->frames;
    m->number_size = 4;
    m->swapped = true;
    if (!set_layout(m, size, error)) return false;
    size_t bytes = 4 * (size_t)m->frames;
    char *times = malloc(bytes);
    if (!times) return fail_no_memory(error, m->path);
    const bool done = read_at(m, MDD_HEADER, times, bytes, error);
    if (done && m->frames > 1) { // frames per second if the times are equally spaced to a hundredth of a step; else 0
        const double start_at = number_read(times, NUMBER_FLOAT32, true),
                     end = number_read(times + bytes - 4, NUMBER_FLOAT32, true);
        const double step = (end - start_at) / (m->frames - 1), fps = 1 / step, whole = round(fps);
        bool even = step > 0 && isfinite(step);
        for (int i = 1; even && i < m->frames - 1; i++) {
            const double at = number_read(times + 4 * (size_t)i, NUMBER_FLOAT32, true);
            even = fabs(at - start_at - i * step) <= 0.01 * step;
        }
        if (even) m->fps = fabs(fps - whole) < 1e-4 * fps ? whole : fps;
    }
    free(times);
    return done;
}

bool motion_open(struct motion *motion, const char *path, struct error *error)
{
    *motion = (struct motion){.path = path, .file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
    struct stat status;
    bool done;
    if (motion->file < 0 || fstat(motion->file, &status) != 0) {
        done = fail(error, ERROR_INPUT, "%s: cannot be opened: %s", path, strerror(errno));
    } else if (!S_ISREG(status.st_mode)) {
        done = fail(error, ERROR_INPUT, "%s: expected a file, got something else", path);
    } else {
        done = read_header(motion, status.st_size, error);
    }
    if (!done) motion_close(motion);
    return done;
}

struct motion motion_of_memory(const float (*positions)[3], int frames, int vertices, double fps, const char *name)
{
    struct motion m = {frames, vertices, fps, name, .file = -1, .memory = (const char *)positions, .number_size = 4};
    set_layout(&m, INT64_MAX, NULL);
    return m;
}

void motion_close(struct motion *motion)
{
    if (motion->file >= 0) close(motion->file);
    *motion = (struct motion){.file = -1};
}

bool motion_columns(const struct motion *motion, int first, int count, double *slab, struct error *error)
{
    const struct motion *m = motion;
    const bool columns =
        m->columns_first; // all frames of one column after the other, else the columns frame by frame
    const int pieces = columns ? count : m->frames, numbers = columns ? m->frames : count;
    const size_t size = (size_t)numbers * (size_t)m->number_size;
    const enum number_type type = m->number_size == 4 ? NUMBER_FLOAT32 : NUMBER_FLOAT64;
    char *bytes = malloc(size);
    if (!bytes) return fail_no_memory(error, m->path);
    bool done = true;
    for (int i = 0; done && i < pieces; i++) {
        const int column = columns ? first + i : first, frame = columns ? 0 : i;
        const int64_t at = columns ? column / 3 * m->strides[1] + column % 3 * m->strides[2]
                                   : frame * m->strides[0] + (int64_t)column * m->number_size;
        double *out = slab + (columns ? (size_t)i : (size_t)i * (size_t)count);
        done = read_at(m, m->data + at, bytes, size, error);
        if (!done) break;
        const size_t stride = columns ? (size_t)count : 1;
        double sum = 0; // stays 0 if all numbers are finite
        for (int n = 0; n < numbers; n++) {
            const double number = number_read(bytes + (size_t)n * (size_t)m->number_size, type, m->swapped);
            out[(size_t)n * stride] = number;
            sum += 0 * number;
        }
        int bad = sum == 0 ? numbers : 0;
        while (bad < numbers && isfinite(out[(size_t)bad * stride])) bad++;
        done = bad == numbers ||
               fail(error, ERROR_INPUT, "%s: frame %d, vertex %d: expected a finite number, got NaN or infinity",
                    m->path, columns ? bad : frame, (columns ? column : column + bad) / 3);
    }
    free(bytes);
    return done;
}

// --- writing

/// A number of four bytes, big endian.
static void print_swapped(FILE *out, const void *number)
{
    uint32_t bits;
    memcpy(&bits, number, sizeof bits);
    bits = __builtin_bswap32(bits);
    fwrite(&bits, sizeof bits, 1, out);
}

void motion_print_start(FILE *out, enum motion_form form, const struct motion_span *span)
{
    if (form == MOTION_NPY) {
        char header[NPY_HEADER];
        npy_print_header((const int[]){span->frames, span->vertices, 3}, header);
        fwrite(header, 1, sizeof header, out);
    } else if (form == MOTION_PC2) {
        const int32_t before[2] = {1, span->vertices}, after = span->frames;
        const float time[2] = {(float)span->first, (float)span->spacing};
        fwrite(pc2_magic, 1, sizeof pc2_magic, out);
        fwrite(before, 4, 2, out);
        fwrite(time, 4, 2, out);
        fwrite(&after, 4, 1, out);
    } else {
        print_swapped(out, &span->frames);
        print_swapped(out, &span->vertices);
        for (int i = 0; i < span->frames; i++) {
            const float time = (float)(span->first + i * span->spacing);
            print_swapped(out, &time);
        }
    }
}

void motion_print_frame(FILE *out, enum motion_form form, const float (*position)[3], int vertices)
{
    if (form != MOTION_MDD) {
        fwrite(position, sizeof *position, (size_t)vertices, out);
        return;
    }
    for (int i = 0; i < vertices; i++) {
        for (int k = 0; k < 3; k++) print_swapped(out, &position[i][k]);
    }
}

bool motion_start(struct file_output *output, const char *path, int frames, int vertices, struct error *error)
{
    const struct motion_span span = {.frames = frames, .vertices = vertices, .spacing = 1};
    if (!file_output_open(output, path, error)) return false;
    motion_print_start(output->stream, path_has_end(path, ".pc2") ? MOTION_PC2 : MOTION_NPY, &span);
    return true;
}
