/// A surface made soft: lattice, body, pinned region and material, ready to be shaken.
#ifndef SIMULATION_SOFT_H
#define SIMULATION_SOFT_H

#include "base/error.h"
#include "model/surface.h"
#include "simulation/body.h"
#include "simulation/integrator.h"
#include "simulation/lattice.h"
#include "simulation/region.h"

/// How a body is moved.
struct shake {
    double direction[3]; ///< of length 1
    double amplitude;    ///< how far the top moves, or the base, as a fraction of soft.size
    bool impulse; ///< starts undeformed, with the velocity that reaches the amplitude; else deformed and at rest
    bool driven;  ///< starts undeformed and at rest: the base moves
};

/// Start from soft_default_options().
struct soft_options {
    int tets;         ///< about how many tetrahedra
    double thickness; ///< as lattice_create() takes it
    struct region pin;
    struct softness softness;
    const struct shake *shake; ///< what the frequency refers to; NULL: the lowest mode
    double young;              ///< Young's modulus, Pa; 0: the one that gives `frequency`
    double frequency;          ///< of the mode that is seen most, Hz, if young is 0
    double poisson;            ///< 0 … 0.49
    double density;            ///< kg/m³
    double damping;            ///< ratio at that mode: half of it by mass, half by stiffness (Rayleigh)
    int modes;                 ///< how many normal modes to find, at least 1
};
struct soft_options soft_default_options(void);

struct soft {
    struct lattice lattice;
    struct body body;
    struct modes modes;    ///< with the body's final stiffness
    int seen;              ///< the mode in which the shake moves the surface most and longest
    double share;          ///< of what is seen of all modes, in that one, 0 … 1
    double bottom, height; ///< of the surface along y, m
    int axis;              ///< along which a shake grows: y, unless the pinned nodes take the whole height
    double low, size;      ///< of the surface along it, m
    double young;          ///< Pa
    double alpha, beta;    ///< Rayleigh's coefficients, 1/s and s
    int pinned;            ///< nodes
    int loose_parts;       ///< parts of the lattice without a pinned node
};

/// `name` is the surface's, for messages. Errors: those of lattice, region and softness, and everything pinned.
bool soft_create(struct soft *soft, const struct surface *surface, const char *name,
                 const struct soft_options *options, struct error *error);
void soft_free(struct soft *soft);

/// The frequency of the mode that is seen most, Hz; 0 if nothing oscillates.
double soft_frequency(const struct soft *soft);

/// Sets the initial state: the displacement, or the velocity, grows with the square of the height above the pinned nodes, or of the
/// depth below them; in a flag at a pole, of how far from the pole. Zero if the base moves.
void soft_shake(const struct soft *soft, const struct shake *shake, struct integrator *integrator);

#endif
