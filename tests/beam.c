/// Beams of cubes for the tests of the simulation.
#include "beam.h"
#include "near.h"

static void make_cubes(struct beam *beam, const int cells[3], double edge)
{
    static const int axes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    int points[3] = {cells[0] + 1, cells[1] + 1, cells[2] + 1};
    beam->nodes = points[0] * points[1] * points[2];
    beam->tets = 6 * cells[0] * cells[1] * cells[2];
    beam->rest = calloc((size_t)beam->nodes, sizeof *beam->rest);
    beam->tet = calloc((size_t)beam->tets, sizeof *beam->tet);
    assert_true(beam->rest && beam->tet);
    const int step[3] = {points[1] * points[2], points[2], 1};
    for (int i = 0; i < beam->nodes; i++) {
        const int at[3] = {i / step[0], i / points[2] % points[1], i % points[2]};
        for (int c = 0; c < 3; c++) beam->rest[i][c] = at[c] * edge;
    }
    int t = 0;
    for (int i = 0; i < beam->nodes; i++) {
        if (i / step[0] == cells[0] || i / points[2] % points[1] == cells[1] || i % points[2] == cells[2]) continue;
        for (int k = 0; k < 6; k++, t++) { // from one corner to the opposite one along the axes in this order
            beam->tet[t][0] = i;
            for (int a = 0; a < 3; a++) beam->tet[t][a + 1] = beam->tet[t][a] + step[axes[k][a]];
        }
    }
}

void beam_open(struct beam *beam, const int cells[3], double edge, struct material material, bool clamped)
{
    *beam = (struct beam){0};
    make_cubes(beam, cells, edge);
    const struct body_mesh mesh = {(const double(*)[3])beam->rest, beam->nodes, (const int(*)[4])beam->tet, NULL,
                                   beam->tets};
    assert_true(body_create(&beam->body, &mesh, material, 1000));
    for (int i = 0; i < beam->nodes; i++) {
        if (clamped && beam->rest[i][0] < 1e-9) beam->body.pinned[i] = true;
    }
    body_ready(&beam->body);
}

void beam_close(struct beam *beam)
{
    if (beam->integrator.work) integrator_free(&beam->integrator);
    modes_free(&beam->modes);
    body_free(&beam->body);
    free(beam->rest);
    free(beam->tet);
}

double beam_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / (double)(1ull << 52) - 1;
}
