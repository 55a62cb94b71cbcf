/// What the fuzz targets share. Each target is one file, fuzz_READER.c, that hands the fuzzer's bytes to a reader (`make fuzz`).
#ifndef TESTS_FUZZ_H
#define TESTS_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// What libFuzzer calls: a run of one input; and, where a target knows its format, how an input is changed.
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);

/// Writes a file, in memory where the system can, and returns its path; the same storage at each call.
const char *fuzz_file(const char *name, const void *data, size_t size);

/// The bytes of a file that the reader's own writer has made; the caller frees them.
char *fuzz_bytes(const char *path, size_t *size);

/// Ends the run as a finding where two saves of the same differ. `what` says of what.
void fuzz_same(const char *what, const void *a, size_t a_size, const void *b, size_t b_size);

/// Ends the run as a finding.
void fuzz_expect(bool good, const char *what);

/// Changes JSON that lies between `start` and `end` of an input: parses it, changes members, numbers and lengths, and prints it.
/// What is no JSON is changed as bytes. Returns the new size of the whole, of at most `most` bytes.
size_t fuzz_mutate_json(uint8_t *data, size_t size, size_t most, size_t start, size_t end, unsigned seed);

/// Whether an input begins as a .glb does.
bool fuzz_is_glb(const uint8_t *data, size_t size);

/// Changes the JSON of a .gltf or a .glb, whose frame it keeps whole. Returns the new size, of at most `most` bytes.
size_t fuzz_mutate_gltf(uint8_t *data, size_t size, size_t most, unsigned seed);

#endif
