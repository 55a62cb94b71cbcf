/// Triangle meshes under construction, and their coat's colours and markings.
#ifndef MODELS_MESH_H
#define MODELS_MESH_H

#include "model/gltf_write.h"
#include <stdbool.h>
#include <stdint.h>

/// Bind space: metres, y up, the tail straight along +z with its base at the origin.
struct vertex {
    float position[3];
    float normal[3];
    float color[3]; ///< linear RGB
    float bend;     ///< 1 on the tail, 0 on the torso, between at the seam
    float open;     ///< share of ambient light, 0 … 1
    float limb[3];  ///< two parts of the body, and its weight for the second: see fox.h
    float mark[3];  ///< a coat's markings, see below; `color` is their result
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

/// Leaves an empty mesh, all zero.
void mesh_free(struct mesh *mesh);

/// Writes a model's .glb; takes the JSON over, adds what the file has, and frees that.
bool model_write(const char *path, struct gltf_file *file, json_t *root, struct error *error);

// Colours of the coat. Linear RGB.

#define COAT_FUR 0xD98A4Bu
#define COAT_BELLY 0xF2D3ACu
#define COAT_BAND 0x7A4528u
#define COAT_TIP 0xF4F1E8u
#define COAT_DARK 0x2B1D18u /* eyes, nose, inside of ears */

/// sRGB 0xRRGGBB → linear RGB.
void coat_linear(uint32_t srgb, float rgb[3]);

/// rgb = rgb + (to − rgb)·amount.
void coat_mix(float rgb[3], uint32_t to, float amount);

/// A coat is fur with markings, whose edges stay sharp at any distance: mark[0] is a point's depth inside the white, mark[1] inside the
/// dark (metres, negative outside), mark[2] the share of brown (0 … 1).
enum { MARK_WHITE, MARK_DARK, MARK_BROWN, MARKS };

/// The markings' colour for meshes that are not coloured per pixel.
void coat_marked(const float mark[MARKS], float rgb[3]);

/// Markings of the tail `z` metres from its base, on skin that faces `up` (y of the direction from the axis, −1 … 1).
void coat_tail(float z, float up, float mark[MARKS]);

#endif
