/// A character prepared for drawing: derivatives for its normals, its ground contact.
///
/// The deformation D(j) = Re(z Ñ_j) moves the surface's tangents t₁, t₂ = n × t₁ to tᵢ + ∂D/∂tᵢ, and the normal to the
/// cross product of both (the cofactors of the surface's deformation gradient applied to n). So each coordinate comes with its
/// derivatives along t₁ and t₂, fitted by least squares to the differences along the edges around a vertex.
#ifndef MODEL_FIGURE_H
#define MODEL_FIGURE_H

#include "model/adjacency.h"
#include "model/character.h"
#include "model/gltf.h"

enum {
    FIGURE_SOLES = 2,
};

/// Derivatives of one part of a coordinate at one vertex, along t₁ and t₂, per metre.
struct slope {
    float u[3], v[3];
};

/// Where the character touches the ground: a disc. Radius 0: nowhere.
struct sole {
    float x, z, radius;
};

struct figure {
    struct character character;
    struct pool pool;     ///< of what follows
    float (*tangent)[3];  ///< t₁ per vertex: unit, across the normal
    struct slope *slopes; ///< [(coordinate · parts + part) · vertex_count + vertex]
    int parts;            ///< COORDINATE_PARTS if any coordinate is curved, else COORDINATE_STRAIGHT
    float (*largest)[3];  ///< per coordinate: the largest |Ñ| over all vertices in x, y and z
    struct adjacency edges;
    float lo[3], hi[3]; ///< box at rest
    float dark;         ///< linear luminance below which a colour belongs to eyes and nose: far darker than the rest
    struct sole soles[FIGURE_SOLES];
    uint64_t id;      ///< unique in this run
    uint64_t version; ///< grows whenever coordinates and slopes change; 0: they never do
};

/// Whether paint has ever changed it: it is not as its file has it.
static inline bool figure_is_painted(const struct figure *figure) { return figure->version > 1; }

/// Whether there is memory for the figure of a character of the size that a file claims.
bool figure_has_room(const struct character *character);

/// Takes a character over, leaves it empty, and derives the rest.
void figure_create(struct figure *figure, struct character *character);

/// Only the derivatives, for a figure with its character set and all else zero: free the pool, and the character stays.
void figure_derive(struct figure *figure);

/// A morph target: `scale` times `position`, and `turn` times `normal`; NULL: it leaves normals as they are.
struct figure_target {
    const char *name; ///< "up.re"
    const float (*position)[3], (*normal)[3];
    float scale, turn;
};

/// A part of a coordinate as a target that turns normals, to first order, where the figure is derived: n = t₁ × t₂, and the coordinate moves both tangents. Its
/// memory is the pool's.
struct figure_target figure_target_create(const struct figure *figure, int coordinate, int part, struct pool *pool);

/// A mesh to be written to a glTF file. Vertices of the file may be several copies of one here; the arrays but `uv` and `indices` are by vertex here.
struct gltf_shape {
    const char *name;
    int vertex_count;       ///< of the file
    const uint32_t *source; ///< which vertex each of the file is; NULL: the same
    const float (*position)[3], (*normal)[3], (*color)[3];
    const float (*uv)[2];          ///< NULL: none
    const uint16_t (*joints)[4];   ///< NULL: it has no skin
    const float (*weights)[4];     ///< as `joints`
    const uint32_t *indices;       ///< vertices of the file
    int index_count;               ///< three a triangle
    const struct looks *looks;     ///< of these; NULL: they have no materials, and are no polygons
    struct figure_target *targets; ///< of a character the parts of its coordinates, then any others
    int target_count;
    const struct coordinate **coordinates; ///< go into the extras
    int coordinate_count;
};

/// Leaves an empty figure.
void figure_free(struct figure *figure);

/// Index of the coordinate of that name, or −1.
int figure_find(const struct figure *figure, const char *name);

// A soft character in motion: the sum of its complex normal coordinates, each turned and scaled by a weight,
// D(j) = Re(Σ_k z_k Ñ_{k,j}), and where they are curved of |z_k|² A_{k,j} + Re(z_k² B_{k,j}).

enum { MORPH_MAX_COORDINATES = 16 }; ///< that move at once

/// The weights of a figure's coordinates at one time.
struct morph {
    int count;
    int coordinate[MORPH_MAX_COORDINATES];                 ///< index in the figure
    float weight[MORPH_MAX_COORDINATES][COORDINATE_PARTS]; ///< coordinate_weights() of z
};

/// What the weights of its mesh's morph targets say; coordinates at 0 are left out.
struct morph figure_morph(const struct figure *figure, const float *weights);

/// Adds a coordinate with the weight z.
void morph_add(struct morph *morph, const struct figure *figure, int coordinate, const double z[2]);

/// The position and unit normal of a vertex, as the stage's vertex shader computes them. `normal` may be NULL.
void morph_vertex(const struct figure *figure, const struct morph *morph, int vertex, float position[3],
                  float normal[3]);

/// A model where it stands, in a pose of its file.
struct model_pose {
    const struct gltf *gltf;
    const struct gltf_pose *pose; ///< memory that other poses use, too: see where it comes from
    float root[16];               ///< its space → world
    float ground;                 ///< height of the ground under it, metres
    const struct figure *figure;  ///< its soft mesh, or NULL
    struct morph morph;           ///< of that
};

/// Where the pose takes a vertex that its coordinates have moved. First `way` is added, by the clip's other morph targets; then `matrix`, Σ wⱼ Jⱼ
/// of its joints or that of its node, takes it into the model's space.
void figure_carry(const struct model_pose *model, int vertex, float matrix[16], float way[3]);

/// Places and unit normals of all its vertices in the world, v′ = Σ wⱼ Jⱼ (v + D), and a box that is widened to hold them. Any may be NULL.
/// Allocates nothing.
void figure_vertices(const struct model_pose *model, float (*places)[3], float (*normals)[3], float lo[3],
                     float hi[3]);

/// The place of one.
void figure_vertex(const struct model_pose *model, int vertex, float place[3]);

/// The lowest of those that coordinates move, below a height that becomes its own; −1: none is.
int figure_lowest(const struct model_pose *model, float *height);

// A figure whose coordinates are turned and scaled vertex by vertex: Ñ' = Ñ e^{a + jψ}, A' = A e^{2a}, B' = B e^{2(a + jψ)}.
// Everything else is shared with the plain figure.

struct painted {
    struct figure figure; ///< with coordinates, slopes and largest amplitudes of its own
    const struct figure *plain;
    float (*applied)[2]; ///< a and ψ that it has, at coordinate · vertex_count + vertex
    bool *stale;         ///< vertices whose slopes must be refitted
};

/// A copy of the plain figure, which must outlive it. NULL if memory is short.
struct painted *painted_create(const struct figure *plain);
void painted_destroy(struct painted *painted);

/// Applies the paint (NULL: none; laid out as `applied`). Recomputes only what has changed, and increases figure.version if anything has.
/// Allocates nothing.
void painted_update(struct painted *painted, const float (*paint)[2]);

// Distances along a figure's surface from a few spots on it, up to a limit: a brush must not reach what is near only
// through the air.
//
// Shortest paths along edges zigzag, and are up to 16 % too long on a regular mesh; straight lines are too short
// where the surface bends. The distance is the larger of the straight line and the path along edges shortened by 16 %: circles
// on flat surfaces stay round.

enum { REACH_MAX_SPOTS = 8 }; ///< at once

/// A point in a triangle.
struct surface_spot {
    uint32_t corner[3];
    float weight[3]; ///< their sum is 1
};

struct reach {
    float *distance; ///< by vertex, metres at rest; INFINITY beyond the limit
    int *vertices;   ///< those within it
    int count, capacity;
    // private
    float *along;       ///< shortest way along edges so far, INFINITY: none
    int *queue;         ///< a ring of vertices whose neighbours have not heard of that
    bool *waits;        ///< of each vertex: it is in the queue
    int first, waiting; ///< of the queue
};

/// For a figure of so many vertices; its memory is the pool's.
void reach_create(struct reach *reach, struct pool *pool, int vertices);

/// Finds distances from the nearest of the spots. Allocates nothing.
void reach_find(struct reach *reach, const struct figure *figure, const struct surface_spot *spots, int count,
                float limit);

// Where a ray hits what is posed.

/// Distance along the ray to the front of a triangle, or a negative number; `uv` are the weights of the second and third corner.
float pick_triangle(const float *const corner[3], const float eye[3], const float direction[3], float uv[2]);

/// The nearest triangle that faces the eye; false if there is none. `direction` need not be of unit length.
bool pick_ray(const struct figure *figure, const float (*posed)[3], const float eye[3], const float direction[3],
              struct surface_spot *spot);

#endif
