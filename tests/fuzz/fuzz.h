/// How the fuzzer's inputs are changed (mutate.c).
#ifndef TESTS_FUZZ_H
#define TESTS_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Changes an input within `most` bytes and returns its new size; the same seed changes it in the same way.
typedef size_t fuzz_mutate(uint8_t *data, size_t size, size_t most, unsigned seed);

/// As bytes; as JSON, of which it changes members, numbers and lengths; the same of what stands before a NUL; and the JSON of a .gltf or
/// a .glb, whose frame it keeps whole. What is no JSON is changed as bytes.
fuzz_mutate mutate_bytes, mutate_json, mutate_before_nul, mutate_gltf;

/// Whether an input begins as a .glb does.
bool fuzz_is_glb(const uint8_t *data, size_t size);

#endif
