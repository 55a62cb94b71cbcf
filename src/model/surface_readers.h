/// Shared by the readers of surfaces: the surface being read, and words of text files. Private to src/model.
#ifndef MODEL_SURFACE_READERS_H
#define MODEL_SURFACE_READERS_H

#include "base/error.h"
#include "model/surface.h"
#include <stdbool.h>

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
