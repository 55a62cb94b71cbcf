/// The headers of the point caches PC2 and MDD.
///
///     PC2, little endian                          MDD, big endian
///     0   char[12]  "POINTCACHE2\0"               0   int32    frames F
///     12  int32     version, 1                    4   int32    points
///     16  int32     points                        8   float[F] times in seconds
///     20  float     first frame
///     24  float     frames a sample
///     28  int32     samples
///     then float32 x y z of each point of each frame, in both
#include "model/motion_format.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PC2_HEADER = 32, MDD_HEADER = 8 };

const char pc2_magic[12] = "POINTCACHE2";

bool pc2_read_header(struct motion *m, int64_t size, struct error *error)
{
    int32_t numbers[5];
    if (!motion_read_at(m, sizeof pc2_magic, numbers, sizeof numbers, error)) return false;
    if (numbers[0] != 1)
        return fail(error, ERROR_INPUT, "%s: expected version 1 of PC2, got %d", m->path, (int)numbers[0]);
    m->data = PC2_HEADER;
    m->number_size = 4;
    return motion_counts(m, numbers[4], numbers[1], error) && motion_layout(m, size, error);
}

static int32_t big_endian(const unsigned char b[4])
{
    return (int32_t)((uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3]);
}

static double time_at(const unsigned char *times, int frame)
{
    int32_t bits = big_endian(times + 4 * (size_t)frame);
    float time;
    memcpy(&time, &bits, sizeof time);
    return (double)time;
}

/// Frames per second where the times are evenly apart, within a hundredth of a step (they are floats); else 0.
static double fps_of_times(const unsigned char *times, int frames)
{
    double first = time_at(times, 0), step = (time_at(times, frames - 1) - first) / (frames - 1);
    if (!(step > 0) || !isfinite(step)) return 0;
    for (int i = 1; i < frames - 1; i++) {
        if (!(fabs(time_at(times, i) - first - i * step) <= 0.01 * step)) return 0;
    }
    double fps = 1 / step, whole = round(fps);
    return fabs(fps - whole) < 1e-4 * fps ? whole : fps;
}

bool mdd_read_header(struct motion *m, int64_t size, struct error *error)
{
    unsigned char counts[MDD_HEADER];
    if (!motion_read_at(m, 0, counts, sizeof counts, error)) return false;
    if (!motion_counts(m, big_endian(counts), big_endian(counts + 4), error)) return false;
    m->data = MDD_HEADER + 4 * (int64_t)m->frames;
    m->number_size = 4;
    m->swapped = true;
    if (!motion_layout(m, size, error)) return false;
    size_t bytes = 4 * (size_t)m->frames;
    unsigned char *times = malloc(bytes);
    if (!times) return fail_no_memory(error, m->path);
    bool done = motion_read_at(m, MDD_HEADER, times, bytes, error);
    if (done) m->fps = m->frames > 1 ? fps_of_times(times, m->frames) : 0;
    free(times);
    return done;
}
