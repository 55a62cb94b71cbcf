/// A fast 64-bit hash that tells whether something has changed. Not against adversaries.
#ifndef BASE_HASH_H
#define BASE_HASH_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define HASH_START 0x9E3779B97F4A7C15u

/// Folds one word into a hash; the order of words matters.
static inline uint64_t hash_word(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * 0xD6E8FEB86659FD93u;
    return hash ^ (hash >> 32);
}

/// Folds `size` bytes into a hash, eight at a time.
static inline uint64_t hash_bytes(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    uint64_t word;
    for (; size >= sizeof word; bytes += sizeof word, size -= sizeof word) {
        memcpy(&word, bytes, sizeof word);
        hash = hash_word(hash, word);
    }
    word = 0;
    if (size) memcpy(&word, bytes, size);
    return hash_word(hash, word ^ (uint64_t)size << 56);
}

#endif
