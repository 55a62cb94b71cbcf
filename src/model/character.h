/// A character: a rest mesh and the complex normal coordinates that it oscillates in (the paper's section 7.2), and its file.
///
/// creature.glb is plain glTF 2.0. Each coordinate is two morph targets, NAME.re = Re Ñ and NAME.im = −Im Ñ, so that with
/// the weights Re z and Im z of z = A e^{jφ} x the deformation is Re(z Ñ) (eq. 29, eq. 30) in a viewer that takes negative weights.
/// A curved coordinate adds |z|² A + Re(z² B) as NAME.sq = A, NAME.re2 = Re B and NAME.im2 = Im B with the weights |z|², Re z² and −Im z².
/// Targets may turn normals too, to first order. First come all vertices of the mesh at rest in their order, then copies of those that have
/// several texture coordinates; each material is a primitive, and all share the vertices. The mesh's
/// extras say {"targetNames": […], "wiggly": {"coordinates": [{"name", "frequency", "damping", …, of flesh "base" and "bone"}]}}; "scale" there says
/// by how much an export has scaled its targets up, "most" the largest |z| that the curves are known for.
#ifndef MODEL_CHARACTER_H
#define MODEL_CHARACTER_H

#include "base/error.h"
#include "model/surface.h"
#include <stdbool.h>
#include <stdint.h>

/// The arrays of a coordinate: of a straight one only the first two. The weights of `im` and `im2` count negative: Re(z Ñ).
enum { COORDINATE_STRAIGHT = 2, COORDINATE_PARTS = 5 };

/// ".re" …
extern const char *const coordinate_endings[COORDINATE_PARTS];

/// One complex normal coordinate Ñ: how far and how much later each vertex moves when x does. Unknown numbers
/// are 0.
struct coordinate {
    char *name;
    double frequency;  ///< Hz, undamped
    double damping;    ///< ratio
    double explained;  ///< share of the complex variance, 0 … 1
    double pca1, pca2; ///< shares that the first and the first two real principal components explain, 0 … 1
    double base[3]; ///< g: x'' + 2ζω x' + ω² x = −g·a for Re x where the base accelerates by a, in m/s² along
                    ///< the model's axes
    double at[3]; ///< the point of the bone, along its own axes, whose acceleration that is: the middle of the flesh
    char *bone;   ///< the bone that is its base; NULL: none is known
    double most;  ///< the largest |z| that the curves are known for; beyond it they go on as straight as they can
    union {
        struct {
            float (*re)[3];             ///< Re Ñ, metres a unit of the spline, per vertex
            float (*im)[3];             ///< Im Ñ; a vertex with a positive argument of Ñ leads
            float (*sq)[3];             ///< A; NULL, as the next two: points do not move on curves
            float (*re2)[3], (*im2)[3]; ///< Re B and Im B
        };
        float (*parts[COORDINATE_PARTS])[3];
    };
    int target[COORDINATE_PARTS]; ///< of its file's mesh: NAME.re …
    double scale;                 ///< times which those have it
};

static inline int coordinate_parts(const struct coordinate *c)
{
    return c->sq ? COORDINATE_PARTS : COORDINATE_STRAIGHT;
}

/// −1: a part's weight counts negative.
static inline double coordinate_sign(int part) { return part == 1 || part == COORDINATE_PARTS - 1 ? -1 : 1; }

/// The weights Re z, Im z, |z|², Re z² and Im z². Where r = |z| is above `most`, m, the last three are continued linearly in r, with m(2r − m) in
/// place of r²: once differentiable. `by` (may be NULL) receives their derivatives by Re z and by Im z.
void coordinate_weights(const struct coordinate *c, const double z[2], double weights[COORDINATE_PARTS],
                        double by[2][COORDINATE_PARTS]);

/// All zero is the empty character. Metres, y up, triangles counter-clockwise seen from outside.
struct character {
    int vertex_count;
    float (*position)[3], (*normal)[3];
    float (*color)[3]; ///< linear RGB, 1 where the file has none
    uint32_t *indices;
    int index_count;
    struct looks looks; ///< materials of the triangles, texture coordinates
    struct coordinate *coordinates;
    int coordinate_count;
    int node;        ///< the first that shows its mesh in its file; −1: none
    float moved[16]; ///< from the mesh to the model at rest: the node's matrix, or its skin's first joint's
};

/// A character at rest: takes the surface over and leaves it empty, with normals from its triangles and `coordinates` coordinates with zero
/// Ñ and no names. False if memory is short.
bool character_create(struct character *character, struct surface *surface, int coordinates);

/// Makes a coordinate curved, with A and B of 0. False if memory is short.
bool character_curve(struct character *character, int coordinate);

/// Normals from triangles, weighted by area; (0, 1, 0) for a vertex without.
void character_find_normals(struct character *character);

/// Reads a .glb or .gltf: the first mesh with morph targets (else the first mesh), all its triangles as one. Coordinates are the
/// pairs of morph targets called NAME.re and NAME.im; without our extras their numbers are 0. Normals are computed where
/// there are none. The first node that shows the mesh, or its skin, places it. Errors name the file, the place in it, what was expected and
/// what was found.
bool character_read(const char *path, struct character *character, struct error *error);
struct gltf;
/// The same of a file that has been read.
bool character_from_gltf(const struct gltf *gltf, struct character *character, struct error *error);

/// Writes a .glb, whole or not at all. Without `turn_normals` targets move only vertices and the file is two fifths smaller; on reading,
/// figure_derive() replaces them.
bool character_write(const char *path, const struct character *character, bool turn_normals, struct error *error);

/// Writes a copy of the file that `gltf` was read from, as a .glb, with coordinates of a mesh as further morph targets: their Ñ has a row for
/// each vertex of all its parts, one after the other. All else stays as it is; clips with weights of this mesh get zeros for the new ones.
bool coordinates_write(const char *path, const struct gltf *gltf, int mesh, const struct coordinate *coordinates,
                       int count, struct error *error);

/// Leaves an empty character.
void character_free(struct character *character);

#endif
