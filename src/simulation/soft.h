/// A surface made soft: lattice, body, pinned region and material, ready to be shaken.
#ifndef SIMULATION_SOFT_H
#define SIMULATION_SOFT_H

#include "base/error.h"
#include "model/surface.h"
#include "simulation/integrator.h"
#include <stdint.h>

// Which nodes are pinned: the option --pin.

enum region_kind {
    REGION_FOOT,   ///< up to `size` above the surface's lowest point, below 0: a twentieth of its height
    REGION_NONE,   ///< nowhere
    REGION_PLANE,  ///< behind the plane through `point`, on the side opposite to `normal`
    REGION_SPHERE, ///< within `size` of `point`
    REGION_COLOR,  ///< around vertices of this colour
    REGION_BONES,  ///< within `size` of a line, where the mesh is mostly held, and parts that nothing else holds
};

struct region {
    enum region_kind kind;
    double point[3], normal[3], size; ///< m
    uint32_t color;                   ///< 0xRRGGBB, sRGB
    const double (*line)[2][3];       ///< of REGION_BONES: both ends, m
    int line_count;
    const double *held; ///< of REGION_BONES: a share of 0 … 1 per vertex
};

/// The distance of a point from the nearest of the region's lines, m.
double region_distance(const struct region *region, const double point[3]);

/// What region_parse() takes, for error texts.
#define REGION_FORMS "a height, none, plane:x,y,z,nx,ny,nz, sphere:x,y,z,r or color:RRGGBB"

/// H, none, plane:x,y,z,nx,ny,nz, sphere:x,y,z,r or color:RRGGBB. False if it is none of these.
bool region_parse(const char *text, struct region *region);

/// Whether each vertex of the surface is in the region, which is not REGION_NONE; returns how many are.
int region_vertices(const struct region *region, const struct surface *surface, bool *inside);

// How much softer than the material each element is, set by --soft.
//
// A weight w of 0 … 1 makes the stiffness N^−w times the material's: equal steps of w are equal ratios.

struct softness {
    const char *from; ///< "distance", "color" or a .npy file; NULL: the same everywhere
    double times;     ///< N: how many times softer where the weight is 1
};

/// Sets the elements' stiffness. distance: w is the path through the body from the pinned nodes, 1 where it is longest. color:
/// w is the vertex's brightness, 0 black, 1 white or brighter. FILE.npy: one number of 0 … 1 a vertex. Errors: no colours, nothing
/// pinned, a file that does not fit; `name` is the surface's.
bool softness_apply(const struct softness *softness, const struct lattice *lattice, const struct surface *surface,
                    const char *name, struct body *body, struct error *error);

// The soft body.

/// How a body is moved.
struct shake {
    double direction[3]; ///< of length 1; zero: along all three axes, one after another
    double amplitude;    ///< how far the top moves, or the base, as a fraction of soft.size
    bool impulse; ///< starts undeformed, with the velocity that reaches the amplitude; else deformed and at rest
    bool driven;  ///< starts undeformed and at rest: the base moves
};

/// Start from soft_default_options().
struct soft_options {
    int tets;         ///< about how many tetrahedra
    double thickness; ///< as in struct lattice_options
    struct region pin;
    struct softness softness;
    const struct shake *shake; ///< what the frequency refers to; NULL: the lowest mode
    double young;              ///< Young's modulus, Pa; 0: the one that gives `frequency`
    double frequency;          ///< of the mode that is seen most, Hz, if young is 0
    double poisson;            ///< 0 … 0.49
    double density;            ///< kg/m³
    double damping;            ///< ratio at that mode: half of it by mass, half by stiffness (Rayleigh)
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
    double held[2];        ///< range of the pinned nodes along it, m; the surface's low end if none is pinned
    double farthest;       ///< how far the surface reaches beyond that, m
    double young;          ///< Pa
    double alpha, beta;    ///< Rayleigh's coefficients, 1/s and s
    int pinned;            ///< nodes
    double depth;          ///< of REGION_BONES: of what is held around the lines, m; at least about half a cell
    int unpinned_parts;    ///< parts of the lattice without a pinned node
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
