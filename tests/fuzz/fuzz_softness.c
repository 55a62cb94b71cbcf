/// Maps of softness in .npy, over the corners of an octahedron: no element gets stiffer than the material, none limp.
#include "fuzz.h"
#include "simulation/soft.h"
#include <math.h>
#include <stdlib.h>

static float corners[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
static uint32_t sides[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
static const struct surface octahedron = {
    .position = corners, .vertex_count = 6, .indices = sides, .index_count = 24};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct lattice lattice;
    static struct body body;
    struct error error = {0};
    if (!body.elements) {
        fuzz_expect(
            lattice_create(&lattice, &octahedron, &(struct lattice_options){60, NAN, -1}, "octahedron", &error),
            error.text);
        body.element_count = lattice.tet_count;
        body.elements = calloc((size_t)lattice.tet_count, sizeof *body.elements);
    }
    const struct softness softness = {.from = fuzz_file("fuzz.npy", data, size), .times = 8};
    const bool good = softness_apply(&softness, &lattice, &octahedron, "octahedron", &body, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a map of softness is refused with a sentence");
    for (int e = 0; good && e < body.element_count; e++) {
        const double stiffness = body.elements[e].stiffness;
        fuzz_expect(stiffness > 0.124 && stiffness < 1.001, "stiffness is from an eighth to the material's");
    }
    return 0;
}
