/// Pictures in PNG and JPEG, as textures have them: every pixel of what is taken is there, and no more than is allowed.
#include "fuzz.h"
#include "model/gltf.h"
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    enum { MOST = 1 << 24 };
    struct error error = {0};
    struct gltf_image image = {0};
    const bool good = gltf_decode_image(data, size, MOST, &image, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a picture is refused with a sentence");
    if (!good) return 0;
    const size_t bytes = 4 * (size_t)image.width * (size_t)image.height;
    fuzz_expect(bytes > 0 && bytes <= MOST, "a picture has its size");
    unsigned sum = 0;
    for (size_t i = 0; i < bytes; i++) sum += image.pixels[i];
    fuzz_expect(sum <= 255 * bytes, "pixels are bytes");
    free(image.pixels);
    return 0;
}
