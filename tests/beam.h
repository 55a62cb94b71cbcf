/// Beams of cubes, each cut into six tetrahedra (Kuhn), for simulation tests.
#ifndef TESTS_BEAM_H
#define TESTS_BEAM_H

#include "near.h"

#include "simulation/body.h"
#include "simulation/integrator.h"
#include <stdint.h>

/// A beam along x from the origin, its body, and a test's results.
struct beam {
    int nodes, tets;
    double (*rest)[3];
    int (*tet)[4];
    struct body body;
    struct modes modes;
    struct integrator integrator;
};

/// cells[0] × cells[1] × cells[2] cubes of edge `edge` and density 1000. `clamped`: the nodes at x = 0 are pinned.
void beam_open(struct beam *beam, const int cells[3], double edge, struct material material, bool clamped);

/// Frees everything.
void beam_close(struct beam *beam);

#define BEAM_TEST(name, opens) TEST_OF(struct beam, beam, opens, beam_close(beam), name)

/// Pseudo-random numbers in −1 … 1, the same in every run.
double beam_random(uint64_t *state);

#endif
