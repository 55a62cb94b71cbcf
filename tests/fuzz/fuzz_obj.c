/// OBJ surfaces: what one load and save gives, the next one gives again; colours, which are encoded anew, nearly.
#include "model/surface.h"
#include "surface.h"
#include <stdlib.h>

/// Reads a file and writes it over; NULL where it is refused.
static char *saved(const char *path, size_t *size, struct error *error)
{
    struct surface surface;
    if (!surface_read(path, &surface, error)) return NULL;
    free(surface.color);
    surface.color = NULL;
    fuzz_expect(obj_write(path, &surface, error), error->text);
    surface_free(&surface);
    return fuzz_bytes(path, size);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error error = {0};
    size_t first_size, second_size;
    const char *path = fuzz_file("fuzz.obj", data, size);
    fuzz_surface(path);
    char *first = saved(path, &first_size, &error);
    if (!first) return 0;
    char *second = saved(path, &second_size, &error);
    fuzz_expect(second != NULL, error.text);
    fuzz_same("a surface that is saved, loaded and saved is the same", first, first_size, second, second_size);
    free(first);
    free(second);
    return 0;
}
