/// Motion in .npy: shape (frames, vertices, 3) or (frames, 3 vertices).
#include "base/npy.h"
#include "model/motion_format.h"

static bool set_shape(struct motion *m, const struct npy *npy, struct error *error)
{
    bool flat = npy->count == 2 && npy->lengths[1] % 3 == 0;
    if (!flat && !(npy->count == 3 && npy->lengths[2] == 3))
        return fail(error, ERROR_INPUT, "%s: expected an array of shape (frames, vertices, 3), got %s", m->path,
                    npy->shape);
    return motion_counts(m, npy->lengths[0], flat ? npy->lengths[1] / 3 : npy->lengths[1], error);
}

/// Fortran order: the first index runs fastest. Of (frames, 3 vertices) vertex and coordinate are one index in which the
/// coordinate runs faster.
static void set_order(struct motion *m, const struct npy *npy)
{
    int64_t column = (int64_t)m->number_size * m->frames;
    bool flat = npy->count == 2;
    m->columns_first = npy->columns_first;
    if (!m->columns_first) return;
    m->strides[1] = flat ? 3 * column : column;
    m->strides[2] = flat ? column : column * m->vertices;
}

bool npy_read_header(struct motion *m, int64_t size, struct error *error)
{
    unsigned char start[NPY_START];
    char text[NPY_DICTIONARY + 1];
    struct npy npy;
    if (!motion_read_at(m, 0, start, sizeof start, error) || !npy_start(&npy, m->path, start, error)) return false;
    m->data = npy.data;
    if (!motion_read_at(m, m->data - (int64_t)npy.dictionary, text, npy.dictionary, error)) return false;
    text[npy.dictionary] = '\0';
    if (!npy_dictionary(&npy, m->path, text, error)) return false;
    m->swapped = npy.swapped;
    m->number_size = npy.number_size;
    if (!set_shape(m, &npy, error) || !motion_layout(m, size, error)) return false;
    set_order(m, &npy);
    return true;
}
