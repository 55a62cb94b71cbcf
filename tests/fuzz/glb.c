/// Changes glTF files, binary and text, as what they are.
#include "fuzz.h"
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

enum { HEADER = 12, CHUNK = 8 };

static uint32_t word_at(const uint8_t *data)
{
    uint32_t word;
    memcpy(&word, data, sizeof word);
    return word;
}

static void put_word(uint8_t *data, size_t word)
{
    const uint32_t bits = (uint32_t)word;
    memcpy(data, &bits, sizeof bits);
}

bool fuzz_is_glb(const uint8_t *data, size_t size) { return size >= HEADER + CHUNK && memcmp(data, "glTF", 4) == 0; }

/// Keeps the frame of a .glb whole: its chunk of JSON is changed as JSON, padded, and the lengths say so.
static size_t mutate_glb(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    const size_t start = HEADER + CHUNK, length = word_at(data + HEADER), end = start + length;
    if (length > size - start || most < size + 4) return LLVMFuzzerMutate(data, size, most);
    if (seed % 8 == 0 && size > end + CHUNK) // the numbers in the other chunk
        return end + CHUNK + LLVMFuzzerMutate(data + end + CHUNK, size - end - CHUNK, size - end - CHUNK);
    const size_t behind = size - end;
    size_t now = fuzz_mutate_json(data, size, most - 4, start, end, seed);
    if (now < start + behind || !fuzz_is_glb(data, now) || word_at(data + HEADER) != length)
        return now; // changed as bytes
    size_t json = now - start - behind, padding = (4 - json % 4) % 4;
    memmove(data + start + json + padding, data + start + json, behind);
    memset(data + start + json, ' ', padding);
    put_word(data + HEADER, json + padding);
    put_word(data + 8, now + padding);
    return now + padding;
}

size_t fuzz_mutate_gltf(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_is_glb(data, size) ? mutate_glb(data, size, most, seed)
                                   : fuzz_mutate_json(data, size, most, 0, size, seed);
}
