/// Beams of cubes, each cut into six tetrahedra (Kuhn), for the tests of the simulation.
#ifndef TESTS_BEAM_H
#define TESTS_BEAM_H

#include "simulation/body.h"
#include <stdint.h>

/// A beam along x from the origin. Freed with beam_free().
struct beam {
    int nodes, tets;
    double (*rest)[3];
    int (*tet)[4];
};

/// cells[0] × cells[1] × cells[2] cubes of edge `edge`.
void beam_create(struct beam *beam, const int cells[3], double edge);
void beam_free(struct beam *beam);

/// Its body; the nodes at x = 0 pinned where `clamped`.
void beam_body(const struct beam *beam, struct material material, double density, bool clamped, struct body *body);

/// Numbers in −1 … 1, the same in every run.
double beam_random(uint64_t *state);

#endif
