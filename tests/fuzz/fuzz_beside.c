/// A .gltf and a file beside it, which it may name as a buffer and as a picture. An input is the text, a NUL, and that file.
#include "rig/models.h"
#include "surface.h"
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error error = {0};
    struct imported imported;
    const uint8_t *nul = memchr(data, '\0', size);
    const size_t text = nul ? (size_t)(nul - data) : size, behind = nul ? text + 1 : size;
    fuzz_file("fuzz.bin", data + behind, size - behind);
    const char *path = fuzz_file("fuzz.gltf", data, text);
    const bool good = imported_read(&imported, path, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a model is refused with a sentence");
    if (good) imported_free(&imported);
    fuzz_surface(path);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    const uint8_t *nul = memchr(data, '\0', size);
    return fuzz_mutate_json(data, size, most, 0, nul ? (size_t)(nul - data) : size, seed);
}
