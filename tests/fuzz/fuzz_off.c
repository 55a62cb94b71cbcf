/// OFF surfaces.
#include "surface.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_surface(fuzz_file("fuzz.off", data, size));
    return 0;
}
