/// Materials of OBJ files.
#include "surface.h"
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char obj[] = "mtllib fuzz.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl red\nf 1/1 2/1 3/1\n";
    fuzz_file("fuzz.mtl", data, size);
    fuzz_surface(fuzz_file("fuzz.obj", obj, strlen(obj)));
    return 0;
}
