/// Triangle surfaces: the rest meshes that are simulated and analysed, and how they look.
#ifndef MODEL_SURFACE_H
#define MODEL_SURFACE_H

#include "base/error.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// No texture coordinates, or no material.
#define LOOKS_NONE UINT32_MAX

/// Limit for the bytes of a surface's pictures together, because many materials may name one small file.
enum { LOOKS_IMAGES_LIMIT = 256 << 20 };

struct looks_material {
    char *name;
    float color[4];       ///< base colour, linear, with opacity
    unsigned char *image; ///< its texture: the bytes of a PNG or JPEG file, or NULL
    size_t image_size;
};

/// The look of a surface besides places and colours. Members are NULL if it has none.
struct looks {
    float (*uv)[2]; ///< texture coordinates, (0, 0) the upper left of the picture
    int uv_count;
    uint32_t
        *corner; ///< per index: which texture coordinates, or LOOKS_NONE; NULL: each vertex has those of its number
    uint32_t *material; ///< per triangle: its material, or LOOKS_NONE
    uint8_t *joined;    ///< per triangle: 1 if it continues the polygon (a fan) of the triangle before
    struct looks_material *materials;
    int material_count;
    char *left_out; ///< a file of materials or a picture that could not be read, to show
};

/// Metres, right-handed, y up; triangles counter-clockwise seen from outside. All zero is the empty surface.
struct surface {
    float (*position)[3];
    float (*color)[3]; ///< linear RGB per vertex, or NULL
    int vertex_count;
    uint32_t *indices; ///< three a triangle
    int index_count;
    struct looks looks;
};

/// Whether a triangle names a vertex twice. Such triangles have no area; no reader keeps them.
static inline bool triangle_repeats(const uint32_t corner[3])
{
    return corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0];
}

/// Reads a mesh: OBJ, STL, PLY, OFF, .glb or .gltf by the end of its name (any other is read as OBJ). Vertices keep the file's order and
/// number, which is what simulations refer to; those of an STL file, which has none, are the different places in the order of their first
/// appearance. Polygons become fans of triangles. Errors name the file, the place in it, what was expected and what was found. Memory is
/// bounded by the file's size.
///
/// Of an OBJ file's materials names, Kd, d and map_Kd (PNG, JPEG) are read; normals, groups and lines are ignored. Colours after a
/// position (`v x y z r g b`) are sRGB in the file, as Blender writes them; a vertex without one is white if others have one.
bool surface_read(const char *path, struct surface *surface, struct error *error);

/// Writes positions, colours, texture coordinates and polygons with 9 digits, so that they read back equal (colours except for a float's last
/// bit), and for materials NAME.mtl with pictures NAME-1.png … beside it. Atomic, like file_output_commit().
bool obj_write(const char *path, const struct surface *surface, struct error *error);

/// Per vertex: 1 if a triangle has it. The caller frees it.
uint8_t *surface_used_vertices(const struct surface *surface);

/// The box around the vertices that triangles have, m; lo > hi if there are none.
void surface_bounds(const struct surface *surface, double lo[3], double hi[3]);

/// Leaves an empty surface.
void surface_free(struct surface *surface);

/// Whether its look is visible: a colour other than white, or a picture.
bool looks_show(const struct looks *looks);

/// Drops materials if no triangle has one, and polygons if all are triangles.
void looks_drop_unused(struct looks *looks, int triangles);

/// "png" or "jpeg" by a picture's first bytes, or NULL.
const char *looks_image_kind(const unsigned char *bytes, size_t size);

/// Bytes of all its pictures.
size_t looks_image_bytes(const struct looks *looks);

void looks_free(struct looks *looks);

// --- private to src/model: readers by file format

// A surface that grows while a file is read.

/// All zero but `surface` and `material`, LOOKS_NONE, at first.
struct surface_builder {
    struct surface *surface;                                                     ///< an empty one at first
    uint32_t material;                                                           ///< of the next triangles
    int vertices, colors, uvs, indices, corners, materials_of, joins, materials; ///< there is room for
    int polygon;                                                                 ///< corners of the open one
    uint32_t first[2], last[2]; ///< its first and its newest corner: vertex, texture coordinates
    bool failed;                ///< memory ran short and something is missing; stays set
};

void builder_vertex(struct surface_builder *builder, const double position[3]);

/// Colours the newest vertex, sRGB; those before the first coloured one become white, and so do later ones without.
void builder_color(struct surface_builder *builder, const double srgb[3]);
/// The first of three numbers that is far outside the range of colours (0 … 1), which could not be written and read again; NULL: none.
const double *builder_wrong_color(const double srgb[3]);
void builder_linear_color(struct surface_builder *builder, const float rgb[3]);

/// Texture coordinates, numbered from 0.
void builder_uv(struct surface_builder *builder, double u, double v);

/// The next corner of the open polygon, which becomes a fan of triangles. `uv` may be LOOKS_NONE.
void builder_corner(struct surface_builder *builder, uint32_t vertex, uint32_t uv);

/// Closes the polygon and returns how many corners it had.
int builder_end_polygon(struct surface_builder *builder);

/// The material of that name; a new one is white.
uint32_t builder_material(struct surface_builder *builder, const char *name);

/// Drops triangles that name a vertex twice, texture coordinates without corners, and materials without triangles. Fails if no vertices or no
/// triangles remain; `kind` is for the message, as in "a PLY file". On failure the surface is empty.
bool builder_finish(struct surface_builder *builder, const char *path, const char *kind, struct error *error);

/// Merges vertices at the same place, which have no colours.
void builder_merge(struct surface_builder *builder);

// A file being read, and the words of a text, one after the other.

struct words {
    const char *path;
    char *at;        ///< ends in a NUL
    const char *end; ///< where that NUL is
    int line;        ///< from 1
    struct error *error;
};

/// Goes to the next word, past comments from "#" to the end of a line; false at the end of the text.
bool words_more(struct words *words);

/// Takes the next word if it is this one, in capitals or not.
bool words_take(struct words *words, const char *word);
void words_skip(struct words *words);
void words_skip_line(struct words *words);

/// Reads a finite number, or a whole one from `least` to `most`. Fails with what was expected.
bool words_number(struct words *words, const char *what, double *number);
bool words_integer(struct words *words, const char *what, long least, long most, long *number);

/// "file:line: expected …, got …"
bool words_expected(struct words *words, const char *what);

/// For surface_read(), which completes the surface: all that a .glb or .gltf file shows, at rest. It opens the file itself.
bool gltf_surface_read(struct words *words, struct surface_builder *builder);

#endif
