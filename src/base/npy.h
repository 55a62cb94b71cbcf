/// Numbers in binary files, and the header of NumPy's .npy files: magic, version, a length, and a Python dictionary such as
/// {'descr': '<f4', 'fortran_order': False, 'shape': (96, 4000, 3), }
#ifndef BASE_NPY_H
#define BASE_NPY_H

#include "base/error.h"
#include <stddef.h>
#include <stdint.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the files' numbers are read as they lie");

/// As OpenGL and glTF number them.
enum number_type {
    NUMBER_INT8 = 5120,
    NUMBER_UINT8,
    NUMBER_INT16,
    NUMBER_UINT16,
    NUMBER_INT32,
    NUMBER_UINT32,
    NUMBER_FLOAT32,
    NUMBER_FLOAT64 = 5130
};

/// Bytes of a number.
int number_size(enum number_type type);

/// The number at a place that need not be aligned.
double number_read(const void *at, enum number_type type, bool big_endian);

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
    int number_size;    ///< 4 or 8 bytes
    bool swapped;       ///< big endian
    bool columns_first; ///< the first index runs fastest (Fortran order)
    int count;          ///< of lengths
    int64_t lengths[NPY_MAX_LENGTHS];
    char shape[64]; ///< as the file has it, for messages
};

/// Reads the header from the first bytes of a file, NPY_START + NPY_DICTIONARY of them or all there are. `path` is for messages.
bool npy_read_header(struct npy *npy, const char *path, const char *data, size_t size, struct error *error);

/// One number, in the file's type and byte order.
double npy_number(const struct npy *npy, const char *at);

/// The header of a float32 array in C order; the numbers follow.
void npy_print_header(const int lengths[3], char header[NPY_HEADER]);

#endif
