/// OBJ surfaces, without the materials beside them.
#include "surface.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_surface(fuzz_file("fuzz.obj", data, size));
    return 0;
}
