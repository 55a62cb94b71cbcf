/// Names that differ from each other, in UTF-8.
#ifndef BASE_NAMES_H
#define BASE_NAMES_H

#include "base/need.h"
#include <stdbool.h>
#include <stdint.h>

/// Names that are taken. Starts as zeros, apart from what is to be unlike the usual.
struct names {
    const char *between; ///< goes before a number; NULL: " "
    int number;          ///< the first number to try; 0: 2
    size_t most;         ///< bytes of a name, at least 16; 0: any number
    struct pool pool;
    void *tree;
};

/// `wanted`, cut at a letter if it is too long, and with a number if that is taken: "bone", "bone 2", "bone 3" … The name is taken from
/// then on, and lives as long as the set.
const char *names_add(struct names *names, const char *wanted) __attribute__((returns_nonnull));
bool names_has(const struct names *names, const char *name);
void names_free(struct names *names);

/// Whether nothing of a letter, or of a name, can be seen: it is a space or a control character.
bool letter_is_blank(uint32_t letter);
bool name_is_blank(const char *name);

/// The number of bytes, at most `most`, that the beginning of a text takes up to the end of a letter: use it as the precision of %.*s.
int name_fit(const char *text, size_t most);

/// A copy of the first `length` bytes, from need(), with U+FFFD for each byte that is not UTF-8.
char *name_from(const char *text, size_t length);

#endif
