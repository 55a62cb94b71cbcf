/// Triangle meshes that are made, and the colours and markings of the coat on them.
#ifndef MODELS_MESH_H
#define MODELS_MESH_H

#include <stdbool.h>
#include <stdint.h>

/// Bind space: metres, y up, the tail straight along +z with its base at the origin.
struct vertex {
    float position[3];
    float normal[3];
    float color[3]; ///< linear RGB
    float bend;     ///< how far it follows the joints: 1 on the tail, 0 on the torso, between where they join
    float open;     ///< share of the light from all around that reaches it, 0 … 1
    float limb[3];  ///< which two parts of the body it hangs on, and its share of the second: see fox.h
    float mark[3];  ///< a coat's markings, see below; `color` is what they come to
};

struct mesh {
    struct vertex *vertices;
    int vertex_count, vertex_capacity;
    uint32_t *indices; ///< triangles, counter-clockwise seen from outside
    int index_count, index_capacity;
};

/// Adds a vertex and returns its index.
uint32_t mesh_vertex(struct mesh *mesh, const struct vertex *vertex);
void mesh_triangle(struct mesh *mesh, uint32_t a, uint32_t b, uint32_t c);

/// Leaves an empty mesh: all zero, as every mesh starts.
void mesh_free(struct mesh *mesh);

// The colours of the animal's coat. Linear RGB.

#define COAT_FUR 0xD98A4Bu
#define COAT_BELLY 0xF2D3ACu
#define COAT_BAND 0x7A4528u
#define COAT_TIP 0xF4F1E8u
#define COAT_DARK 0x2B1D18u /* eyes, nose, inside of ears */

/// sRGB 0xRRGGBB → linear RGB.
void coat_linear(uint32_t srgb, float rgb[3]);

/// rgb = rgb + (to − rgb)·amount.
void coat_mix(float rgb[3], uint32_t to, float amount);

/// A coat is fur with markings, which have clear edges however near one looks: mark[0] is how deep a point lies in what is
/// white, mark[1] in what is dark (metres, negative outside), mark[2] how brown its fur is (0 … 1).
enum { MARK_WHITE, MARK_DARK, MARK_BROWN, MARKS };

/// The colour that markings come to where nothing evaluates them by the pixel.
void coat_marked(const float mark[MARKS], float rgb[3]);

/// Markings of the tail `z` metres from its base, where its skin faces `up` (the y of the direction from its axis, −1 … 1).
void coat_tail(float z, float up, float mark[MARKS]);

#endif
