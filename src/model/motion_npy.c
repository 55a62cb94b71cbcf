/// The header of .npy: magic, version, a length, and a Python dictionary such as
/// {'descr': '<f4', 'fortran_order': False, 'shape': (96, 4000, 3), }
#include "model/motion_format.h"
#include <stdlib.h>
#include <string.h>

enum { HEADER_MAX = 4096 };

const char npy_magic[6] = "\x93NUMPY";

static bool bad_header(const struct motion *m, struct error *error)
{
    return fail(error, ERROR_INPUT, "%s: expected the header of an .npy array, got something else", m->path);
}

/// What follows 'key': in the dictionary, or NULL.
static const char *value_of(const char *header, const char *key)
{
    const char *found = strstr(header, key);
    if (!found) return NULL;
    found += strlen(key);
    found += strspn(found, " ");
    if (*found != ':') return NULL;
    return found + 1 + strspn(found + 1, " ");
}

static bool read_type(struct motion *m, const char *header, struct error *error)
{
    static const char *const types[] = {"'<f4'", "'<f8'", "'>f4'", "'>f8'"};
    const char *type = value_of(header, "'descr'");
    bool known = false;
    if (!type) return bad_header(m, error);
    for (int i = 0; i < 4; i++) known |= strncmp(type, types[i], strlen(types[i])) == 0;
    if (!known)
        return fail(error, ERROR_INPUT, "%s: expected numbers of type float32 or float64, got %.*s", m->path,
                    (int)strcspn(type, ","), type);
    m->swapped = type[1] == '>';
    m->number_size = type[3] - '0';
    return true;
}

/// Up to four lengths "(96, 4000, 3)"; returns how many there are, -1 where that is no shape.
static int read_lengths(const char *shape, int64_t lengths[4])
{
    int count = 0;
    const char *at = shape + 1;
    if (*shape != '(') return -1;
    while (count < 4) {
        at += strspn(at, " ,");
        if (*at == ')') return count;
        char *end;
        lengths[count] = strtoll(at, &end, 10);
        if (end == at || lengths[count] < 0) return -1;
        count++;
        at = end;
    }
    return count;
}

static bool read_shape(struct motion *m, const char *header, struct error *error)
{
    const char *shape = value_of(header, "'shape'");
    int64_t lengths[4] = {0};
    int count = shape ? read_lengths(shape, lengths) : -1;
    if (count < 0) return bad_header(m, error);
    bool flat = count == 2 && lengths[1] % 3 == 0;
    if (!flat && !(count == 3 && lengths[2] == 3))
        return fail(error, ERROR_INPUT, "%s: expected an array of shape (frames, vertices, 3), got %.*s", m->path,
                    (int)strcspn(shape, ")") + 1, shape);
    return motion_counts(m, lengths[0], flat ? lengths[1] / 3 : lengths[1], error);
}

/// Fortran order: the first index runs fastest. Of (frames, 3 vertices) vertex and coordinate are one index in which the
/// coordinate runs faster.
static bool set_order(struct motion *m, const char *header, struct error *error)
{
    const char *order = value_of(header, "'fortran_order'");
    if (!order) return bad_header(m, error);
    m->columns_follow = strncmp(order, "True", 4) == 0;
    if (!m->columns_follow) return true;
    int64_t lengths[4], frame = m->number_size, column = frame * m->frames;
    bool flat = read_lengths(value_of(header, "'shape'"), lengths) == 2;
    m->strides[0] = frame;
    m->strides[1] = flat ? 3 * column : column;
    m->strides[2] = flat ? column : column * m->vertices;
    return true;
}

bool npy_read_header(struct motion *m, int64_t size, struct error *error)
{
    unsigned char start[12];
    char header[HEADER_MAX + 1];
    if (!motion_read_at(m, 0, start, sizeof start, error)) return false;
    bool is_short = start[6] == 1; // version 1 has a length of 2 bytes, later ones of 4
    uint32_t length = (uint32_t)start[8] | (uint32_t)start[9] << 8;
    if (!is_short) length |= (uint32_t)start[10] << 16 | (uint32_t)start[11] << 24;
    if (start[6] < 1 || start[6] > 3 || length > HEADER_MAX) return bad_header(m, error);
    m->data = (is_short ? 10 : 12) + (int64_t)length;
    if (!motion_read_at(m, m->data - length, header, length, error)) return false;
    header[length] = '\0';
    return read_type(m, header, error) && read_shape(m, header, error) && motion_layout(m, size, error) &&
           set_order(m, header, error);
}
