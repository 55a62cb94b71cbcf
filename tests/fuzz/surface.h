/// Reads a surface and checks that it holds together.
#ifndef TESTS_FUZZ_SURFACE_H
#define TESTS_FUZZ_SURFACE_H

#include "fuzz.h"
#include "model/surface.h"

/// Reads a file by the end of its name; every index of what it gives must be within it.
static inline void fuzz_surface(const char *path)
{
    struct error error = {0};
    struct surface surface;
    const bool good = surface_read(path, &surface, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a surface is refused with a sentence");
    if (!good) return;
    const struct looks *looks = &surface.looks;
    for (int i = 0; i < surface.index_count; i++) {
        fuzz_expect(surface.indices[i] < (uint32_t)surface.vertex_count, "a triangle has vertices of the surface");
        fuzz_expect(!looks->corner || looks->corner[i] == LOOKS_NONE || looks->corner[i] < (uint32_t)looks->uv_count,
                    "a corner has texture coordinates of the surface");
    }
    for (int i = 0; looks->material && i < surface.index_count / 3; i++) {
        fuzz_expect(looks->material[i] == LOOKS_NONE || looks->material[i] < (uint32_t)looks->material_count,
                    "a triangle has a material of the surface");
    }
    surface_free(&surface);
}

#endif
