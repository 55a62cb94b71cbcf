/// Time steps of an elastic body by the generalised-α method (Chung and Hulbert 1993) with ρ∞ = 0.8.
///
/// Second order, one solve a step. Oscillations that the step resolves are nearly undamped: a swing of a fifth of the length at 50
/// steps a period loses 0.4 % of its energy in 100 periods. Unresolved ones lose a fifth per step. The midpoint rule damps nothing,
/// and in large deformations unresolved oscillations gain energy until it fails; BDF2 takes half the energy of the same swing
/// (table in README.md). No such scheme rules out a gain of energy in large deformations. So a step is repeated by backward Euler,
/// which loses energy, if it ends with more than it had plus the loads' work. With x as the unknown a step is
///
///   κ M (x − t) + r C (x − q) = f(x),    κ = (1 − α_m)/((1 − α_f) β h²),    r = γ/(β h)
///
/// with targets t and q from the state before. This is the gradient of a potential, so Newton's method with a definite matrix and a
/// line search descends it however far from rest. Damping is Rayleigh's, C = α M + β K, with the stiffness at the step's start.
#ifndef SIMULATION_INTEGRATOR_H
#define SIMULATION_INTEGRATOR_H

#include "base/error.h"
#include "simulation/body.h"
#include "simulation/lattice.h"
#include <stdbool.h>

enum drive_kind {
    DRIVE_NONE,
    DRIVE_SINE,  ///< one frequency, swelling over its first two periods
    DRIVE_BURST, ///< three periods under a smooth window, then stillness
    DRIVE_SWEEP, ///< from half the frequency to twice it, swelling and fading for a tenth of the time each
    DRIVE_TRACK, ///< a track from a file
};

/// How the base of a shaken body moves: a displacement over time along one direction.
struct base_drive {
    enum drive_kind kind;
    double direction[3]; ///< of length 1
    double size;         ///< the largest displacement, m; for a track, the factor it is multiplied by
    double frequency;    ///< Hz
    double seconds;      ///< length of the whole motion; a sweep takes this long
    struct pool pool;    ///< has the track's samples
    int count;           ///< of these
    double *time;        ///< s, ascending
    double *value;
    double *curvature; ///< second derivatives of the natural cubic spline at the samples
};

/// Reads a track, one "seconds,displacement" a line; headings and blank lines are skipped. Sets kind and samples.
bool drive_read_track(struct base_drive *drive, const char *path, struct error *error);

/// Displacement from the start along the direction, m. All kinds have continuous velocities.
double drive_place(const struct base_drive *drive, double time);

/// Its second derivative, m/s².
double drive_acceleration(const struct base_drive *drive, double time);

/// The second at which the drive ends; infinite if it never ends.
double drive_end(const struct base_drive *drive);

/// A smooth floor under the surface: each vertex below it is pushed up by a spring.
///
/// The springs are part of the potential that a time step minimises, so a stiff floor needs no shorter steps. Each spring belongs
/// to a vertex, is weighted by the area around it, and acts on the nodes of that vertex's tetrahedron: its stiffness
/// w_a w_b k y yᵀ fits the pattern of the body's matrix. There is no friction.
///
/// A vertex that was below at the step's start is also damped, by the impedance √(E ρ) of its area: a floor of the same material
/// would absorb a wave like this. Without it, a vertex that lands lightly bounces with every step. With depth d at the step's end
/// the push is
///
///   max(0, k max(d, 0) + c r (d − q)),    r (d − q) the speed by which it sinks
///
/// It grows with d, so it has a convex potential, and it never pulls.
struct floor {
    struct pool pool; ///< has all below
    const struct lattice *lattice;
    double height;  ///< y, m
    double *spring; ///< k per vertex, N/m
    double *damper; ///< c per vertex, N s/m
    bool *touched;  ///< per vertex: below the floor at the last forces
    bool *damped;   ///< per vertex: below the floor at the step's start
    bool *pushed;   ///< per vertex: pushed at the last forces
    double *origin; ///< q per vertex, m
    double rate;    ///< r, 1/s
    double drag;    ///< J: how far the last forces' potential exceeds the springs' energy
};

/// A floor under the lattice's surface, as stiff as ten times the body's material, a cell thick.
void floor_create(struct floor *floor, const struct lattice *lattice, const struct surface *surface, double height,
                  double young, double density);

/// External loads: gravity, a moving base, a floor. All zero: none.
///
/// The simulation runs in the base's frame. There a base that accelerates by a is a uniform force −m a on all nodes, the pinned
/// nodes stand still and the floor moves. This is exact.
struct loads {
    double gravity;                 ///< down (−y), m/s²
    const struct base_drive *drive; ///< of the base, or NULL
    struct floor *floor;            ///< or NULL
};

struct integrator {
    struct pool pool; ///< has the vectors below
    struct body *body;
    struct loads loads;       ///< none at the start
    double time;              ///< s
    double step;              ///< h, s
    double mass_damping;      ///< Rayleigh's α, 1/s
    double stiffness_damping; ///< Rayleigh's β, s
    double tolerance;         ///< Newton's method stops once no node moves farther than this, m
    double (*x)[3];           ///< positions, m: set them before the first step
    double (*v)[3];           ///< velocities, m/s: likewise
    long newton, gradients;   ///< iterations so far, of Newton's method and of conjugate gradients
    long calmed;              ///< steps so far repeated by backward Euler
    struct integrator_work *work;
};

/// A body at rest, undamped. The body must be ready and outlive it.
void integrator_create(struct integrator *integrator, struct body *body, double step);

/// Moves the body to its equilibrium under the loads at the start, at rest. It must be pinned, or it falls for ever.
bool integrator_find_equilibrium(struct integrator *integrator);

/// One step. False if a number is not finite any more, as under unbounded forces.
bool integrator_step(struct integrator *integrator);

#endif
