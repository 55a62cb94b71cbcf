/// The header of NumPy's .npy files: magic, version, a length, and a Python dictionary such as
/// {'descr': '<f4', 'fortran_order': False, 'shape': (96, 4000, 3), }
#ifndef BASE_NPY_H
#define BASE_NPY_H

#include "base/error.h"
#include <stddef.h>
#include <stdint.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the files' numbers are read as they lie");

enum {
    NPY_START = 12,        ///< bytes up to and including the dictionary's length
    NPY_DICTIONARY = 4096, ///< the longest dictionary we read, bytes
    NPY_HEADER = 128,      ///< the header we write, bytes
    NPY_MAX_LENGTHS = 4,
};

/// The first bytes of every such file.
extern const char npy_magic[6];

/// An array of float32 or float64.
struct npy {
    int64_t data;       ///< where the numbers start
    size_t dictionary;  ///< bytes of it, right before the numbers
    int number_size;    ///< 4 or 8 bytes
    bool swapped;       ///< big endian
    bool columns_first; ///< the first index runs fastest (Fortran order)
    int count;          ///< of lengths
    int64_t lengths[NPY_MAX_LENGTHS];
    char shape[64]; ///< as the file has it, for messages
};

/// Reads the start: where dictionary and numbers are. `path` is for messages.
bool npy_start(struct npy *npy, const char *path, const unsigned char start[NPY_START], struct error *error);

/// Reads the rest from the dictionary, a NUL-terminated text.
bool npy_dictionary(struct npy *npy, const char *path, const char *text, struct error *error);

/// One number, in the file's type and byte order.
double npy_number(const struct npy *npy, const char *at);

/// The header of a float32 array in C order; the numbers follow.
void npy_print_header(const int *lengths, int count, char header[NPY_HEADER]);

#endif
