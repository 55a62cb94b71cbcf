/// PLY surfaces.
#include "surface.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_surface(fuzz_file("fuzz.ply", data, size));
    return 0;
}
