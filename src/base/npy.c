/// Reads numbers of .npy files, and reads and writes their headers.
#include "base/npy.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int number_size(enum number_type type)
{
    return type == NUMBER_FLOAT64 ? 8 : type >= NUMBER_INT32 ? 4 : type >= NUMBER_INT16 ? 2 : 1;
}

double number_read(const void *at, enum number_type type, bool big_endian)
{
    union {
        unsigned char bytes[8];
        int8_t int8;
        int16_t int16;
        int32_t int32;
        uint64_t whole;
        float float32;
        double float64;
    } number = {.whole = 0};
    const int size = number_size(type);
    for (int i = 0; i < size; i++) number.bytes[i] = ((const unsigned char *)at)[big_endian ? size - 1 - i : i];
    switch (type) {
    case NUMBER_INT8:
        return number.int8;
    case NUMBER_INT16:
        return number.int16;
    case NUMBER_INT32:
        return number.int32;
    case NUMBER_FLOAT32:
        return (double)number.float32;
    case NUMBER_FLOAT64:
        return number.float64;
    default:
        return (double)number.whole;
    }
}

const char npy_magic[6] = "\x93NUMPY";

static bool bad_header(const char *path, struct error *error)
{
    return fail(error, ERROR_INPUT, "%s: expected the header of an .npy array, got something else", path);
}

/// The text after 'key': in the dictionary, or NULL.
static const char *value_of(const char *text, const char *key)
{
    const char *found = strstr(text, key);
    if (!found) return NULL;
    found += strlen(key);
    found += strspn(found, " ");
    if (*found != ':') return NULL;
    return found + 1 + strspn(found + 1, " ");
}

bool npy_read_header(struct npy *npy, const char *path, const char *data, size_t size, struct error *error)
{
    char text[NPY_DICTIONARY + 1];
    const unsigned char *start = (const unsigned char *)data;
    *npy = (struct npy){0};
    if (size < NPY_START) return fail(error, ERROR_INPUT, "%s: expected a .npy file, got %zu bytes", path, size);
    const bool is_short = start[6] == 1; // version 1 has a length of 2 bytes, later versions of 4
    uint32_t length = (uint32_t)start[8] | (uint32_t)start[9] << 8;
    if (!is_short) length |= (uint32_t)start[10] << 16 | (uint32_t)start[11] << 24;
    const bool good = memcmp(start, npy_magic, sizeof npy_magic) == 0 && start[6] >= 1 && start[6] <= 3;
    if (!good || length > NPY_DICTIONARY) return bad_header(path, error);
    npy->data = (is_short ? 10 : 12) + (int64_t)length;
    if (npy->data > (int64_t)size)
        return fail(error, ERROR_INPUT, "%s: expected a header of %lld bytes, got %zu", path, (long long)npy->data,
                    size);
    memcpy(text, data + npy->data - length, length);
    text[length] = '\0';

    static const char *const types[] = {"'<f4'", "'<f8'", "'>f4'", "'>f8'"};
    const char *type = value_of(text, "'descr'");
    bool known = false;
    if (!type) return bad_header(path, error);
    for (int i = 0; i < 4; i++) known |= strncmp(type, types[i], strlen(types[i])) == 0;
    if (!known)
        return fail(error, ERROR_INPUT, "%s: expected numbers of type float32 or float64, got %.*s", path,
                    (int)strcspn(type, ","), type);
    npy->swapped = type[1] == '>';
    npy->number_size = type[3] - '0';

    const char *shape = value_of(text, "'shape'"), *order = value_of(text, "'fortran_order'");
    if (!shape || !order || *shape != '(') return bad_header(path, error);
    snprintf(npy->shape, sizeof npy->shape, "%.*s", (int)strcspn(shape, ")") + 1, shape);
    for (const char *at = shape + 1; npy->count < NPY_MAX_LENGTHS; npy->count++) { // such as "(96, 4000, 3)"
        char *end;
        at += strspn(at, " ,");
        if (*at == ')') break;
        npy->lengths[npy->count] = strtoll(at, &end, 10);
        if (end == at || npy->lengths[npy->count] < 0) return bad_header(path, error);
        at = end;
    }
    npy->columns_first = strncmp(order, "True", 4) == 0;
    return true;
}

double npy_number(const struct npy *npy, const char *at)
{
    return number_read(at, npy->number_size == 4 ? NUMBER_FLOAT32 : NUMBER_FLOAT64, npy->swapped);
}

void npy_print_header(const int lengths[3], char header[NPY_HEADER])
{
    enum { PRELUDE = 10 };
    char text[NPY_HEADER - PRELUDE + 1];
    int length = snprintf(text, sizeof text, "{'descr': '<f4', 'fortran_order': False, 'shape': (%d, %d, %d), }",
                          lengths[0], lengths[1], lengths[2]);
    memcpy(header, npy_magic, sizeof npy_magic);
    memcpy(header + sizeof npy_magic, (const char[]){1, 0, NPY_HEADER - PRELUDE, 0}, 4);
    memset(header + PRELUDE, ' ', NPY_HEADER - PRELUDE); // so that the numbers start at a multiple of 64 bytes
    memcpy(header + PRELUDE, text, (size_t)length);
    header[NPY_HEADER - 1] = '\n';
}
