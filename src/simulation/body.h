/// An elastic body: nodes with masses, tetrahedra, its energy, forces and stiffness in any position, and its normal modes at rest.
///
/// Masses are lumped: a quarter of each element's at each of its nodes.
#ifndef SIMULATION_BODY_H
#define SIMULATION_BODY_H

#include "simulation/blocks.h"
#include "simulation/element.h"
#include <stdbool.h>

struct body {
    struct pool pool; ///< has all below
    int node_count, element_count;
    double (*rest)[3];        ///< m
    double *mass;             ///< kg
    bool *pinned;             ///< never moves: the caller says so
    struct element *elements; ///< of positive volume
    struct material material;
    struct svd *svd;          ///< scratch: of each element's F at the last body_forces()
    int (*place)[16];         ///< of each element's blocks in the matrix, or −1 where a node is pinned
    struct blocks stiffness;  ///< what body_stiffness() fills
    struct conjugate scratch; ///< for systems of that size
};

/// The body of `element_count` tetrahedra, tets[e] naming four nodes. `fraction` says how much of each is filled, or is
/// NULL (all); density in kg/m³. False where an element is flat.
bool body_create(struct body *body, const double (*rest)[3], int node_count, const int (*tets)[4],
                 const double *fraction, int element_count, struct material material, double density);
void body_free(struct body *body);

/// Once nodes are pinned, before anything below.
void body_ready(struct body *body);

/// The forces at the positions x (N; 0 at pinned nodes); returns the energy (J).
double body_forces(struct body *body, const double (*x)[3], double (*force)[3]);

/// K = −∂f/∂x at the last body_forces(), made semidefinite, into body->stiffness. Rows and columns of pinned nodes are
/// those of the identity.
void body_stiffness(struct body *body);

/// ½ Σ m v², J.
double body_kinetic(const struct body *body, const double (*v)[3]);

// Classical normal coordinates: K φ = ω² M φ at rest, by simultaneous diagonalisation of stiffness and mass (Goldstein).

/// The lowest normal modes. A free body's six rigid ones are skipped.
struct modes {
    int count;
    double *frequency;  ///< Hz, ascending
    double (*shape)[3]; ///< count × node_count rows: mode k of node i at [k · node_count + i]; φᵀMφ = 1
};

/// The `count` lowest ones, or as many as there are.
void modes_create(struct modes *modes, struct body *body, int count);
void modes_free(struct modes *modes);

#endif
