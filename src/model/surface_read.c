/// Reads surfaces of any format; and PLY, STL and OFF files.
#include "base/file.h"
#include "base/npy.h"
#include "model/surface_readers.h"
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// --- PLY, as text or binary in either byte order
//
// A header lists elements, and for each its properties: a number, or a list preceded by its length. Everything is read in the file's order,
// number by number. Kept are x y z, colours and texture coordinates of vertices, the vertex lists of faces, and the triangles of strips.

enum { ELEMENTS_MAX = 16, PROPERTIES_MAX = 64 };
enum format { TEXT, LITTLE, BIG };
enum role { OTHER, X, Y, Z, RED, GREEN, BLUE, U, V, ROLES, CORNERS, STRIPS };

struct property {
    enum number_type count_type; ///< type of a list's length; 0: not a list
    enum number_type type;
    enum role role;
};

struct element {
    bool vertices;
    long count;
    struct property properties[PROPERTIES_MAX];
    int property_count;
    bool has[ROLES];
};

struct ply {
    struct words *words; ///< in the header, then in the text
    enum format format;
    struct element elements[ELEMENTS_MAX];
    int element_count;
    long vertex_count; ///< in the file; its faces may come first
    bool textured;     ///< vertices have texture coordinates
    struct surface_builder *builder;
};

static const struct {
    const char *name;
    enum number_type type;
} types[] = {
    {"char", NUMBER_INT8},   {"uchar", NUMBER_UINT8},   {"short", NUMBER_INT16},     {"ushort", NUMBER_UINT16},
    {"int", NUMBER_INT32},   {"uint", NUMBER_UINT32},   {"float", NUMBER_FLOAT32},   {"double", NUMBER_FLOAT64},
    {"int8", NUMBER_INT8},   {"uint8", NUMBER_UINT8},   {"int16", NUMBER_INT16},     {"uint16", NUMBER_UINT16},
    {"int32", NUMBER_INT32}, {"uint32", NUMBER_UINT32}, {"float32", NUMBER_FLOAT32}, {"float64", NUMBER_FLOAT64}};

static const struct {
    const char *name;
    enum role role;
} roles[] = {{"x", X},
             {"y", Y},
             {"z", Z},
             {"red", RED},
             {"green", GREEN},
             {"blue", BLUE},
             {"diffuse_red", RED},
             {"diffuse_green", GREEN},
             {"diffuse_blue", BLUE},
             {"s", U},
             {"t", V},
             {"u", U},
             {"v", V},
             {"texture_u", U},
             {"texture_v", V}};

static bool ply_read_type(struct words *w, enum number_type *type)
{
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        *type = types[i].type;
        if (words_take(w, types[i].name)) return true;
    }
    return words_expected(w, "a type of numbers");
}

/// A property's role, by its name.
static enum role ply_read_role(struct words *w, bool of_vertices, bool list)
{
    if (!of_vertices)
        return list && (words_take(w, "vertex_indices") || words_take(w, "vertex_index")) ? CORNERS : OTHER;
    for (size_t i = 0; !list && i < sizeof roles / sizeof *roles; i++) {
        if (words_take(w, roles[i].name)) return roles[i].role;
    }
    return OTHER;
}

static bool ply_read_property(struct words *w, struct element *e)
{
    struct property *p = &e->properties[e->property_count];
    if (e->property_count == PROPERTIES_MAX) return words_expected(w, "at most 64 properties");
    *p = (struct property){0};
    const bool list = words_take(w, "list");
    if ((list && !ply_read_type(w, &p->count_type)) || !ply_read_type(w, &p->type)) return false;
    p->role = ply_read_role(w, e->vertices, list);
    if (p->role < ROLES) e->has[p->role] = true;
    if (p->role == OTHER) words_skip_line(w); // its name
    e->property_count++;
    return true;
}

static bool ply_read_element(struct ply *ply)
{
    struct words *w = ply->words;
    if (ply->element_count == ELEMENTS_MAX) return words_expected(w, "at most 16 elements");
    struct element *e = &ply->elements[ply->element_count++];
    words_more(w);
    e->vertices = words_take(w, "vertex");
    const bool strips = !e->vertices && words_take(w, "tristrips");
    if (!e->vertices && !strips) w->at += strcspn(w->at, " \t\r\n"); // its name
    if (!words_integer(w, "the number of an element", 0, INT_MAX, &e->count)) return false;
    for (;;) {
        if (words_take(w, "comment")) {
            words_skip_line(w);
        } else if (!words_take(w, "property")) {
            break;
        } else if (!ply_read_property(w, e)) {
            return false;
        }
    }
    for (int i = 0; strips && i < e->property_count; i++) {
        if (e->properties[i].role == CORNERS) e->properties[i].role = STRIPS;
    }
    if (e->vertices && !(e->has[X] && e->has[Y] && e->has[Z]))
        return fail(w->error, ERROR_INPUT, "%s: expected vertices with x, y and z, got others", w->path);
    return true;
}

static bool ply_read_header(struct ply *ply)
{
    static const char *const formats[] = {
        [TEXT] = "ascii", [LITTLE] = "binary_little_endian", [BIG] = "binary_big_endian"};
    struct words *w = ply->words;
    if (!words_take(w, "ply"))
        return fail(w->error, ERROR_INPUT, "%s: expected a PLY file, got something else", w->path);
    while (!words_take(w, "end_header")) {
        bool good = true;
        if (words_take(w, "format")) {
            int f = 0;
            while (f < 3 && !words_take(w, formats[f])) f++;
            ply->format = (enum format)f;
            good = f < 3 || words_expected(w, "ascii, binary_little_endian or binary_big_endian");
            if (good) words_skip_line(w);
        } else if (words_take(w, "element")) {
            good = ply_read_element(ply);
        } else if (words_more(w)) {
            words_skip_line(w); // a comment, or another program's line without that word
        } else {
            good = words_expected(w, "a header that ends in end_header");
        }
        if (!good) return false;
    }
    words_skip_line(w);
    if (*w->at == '\n') w->at++;
    w->line++;
    return true;
}

/// Infinity and NaN are refused if `used`; unused properties may have them.
static bool ply_read_number(struct ply *ply, enum number_type type, bool used, double *number)
{
    struct words *w = ply->words;
    if (ply->format == TEXT) return words_number(w, "a number", number);
    const int size = number_size(type);
    if (w->end - w->at < size)
        return fail(w->error, ERROR_INPUT, "%s: expected as many numbers as the header says, got the end of the file",
                    w->path);
    *number = number_read(w->at, type, ply->format == BIG);
    w->at += size;
    return !used || isfinite(*number) ||
           fail(w->error, ERROR_INPUT, "%s: expected finite numbers, got NaN or infinity", w->path);
}

/// The newest corners of a triangle strip.
struct strip {
    uint32_t last[2];
    int length;
};

/// Adds the triangle that ends at this corner; −1 begins a new strip.
static void add_to_strip(struct surface_builder *b, struct strip *strip, long vertex)
{
    if (vertex < 0) {
        strip->length = 0;
        return;
    }
    if (strip->length >= 2) {
        const int odd = strip->length % 2;
        builder_corner(b, strip->last[odd], LOOKS_NONE);
        builder_corner(b, strip->last[!odd], LOOKS_NONE);
        builder_corner(b, (uint32_t)vertex, LOOKS_NONE);
        builder_end_polygon(b);
    }
    strip->last[0] = strip->last[1];
    strip->last[1] = (uint32_t)vertex;
    strip->length++;
}

static bool ply_read_list(struct ply *ply, const struct property *p)
{
    struct words *w = ply->words;
    struct strip strip = {0};
    double length, number;
    if (!ply_read_number(ply, p->count_type, true, &length)) return false;
    if (length < 0) return fail(w->error, ERROR_INPUT, "%s: expected the length of a list, got %g", w->path, length);
    for (double i = 0; i < length && !ply->builder->failed; i++) {
        if (!ply_read_number(ply, p->type, p->role != OTHER, &number)) return false;
        if (p->role != CORNERS && p->role != STRIPS) continue;
        const bool ends = p->role == STRIPS && number < 0;
        if (!ends && !(number >= 0 && number < (double)ply->vertex_count && number == floor(number)))
            return fail(w->error, ERROR_INPUT, "%s: expected a vertex from 0 to %ld, got %g", w->path,
                        ply->vertex_count - 1, number);
        if (p->role == STRIPS) {
            add_to_strip(ply->builder, &strip, (long)number);
        } else {
            builder_corner(ply->builder, (uint32_t)number, ply->textured ? (uint32_t)number : LOOKS_NONE);
        }
    }
    if (p->role == CORNERS) builder_end_polygon(ply->builder);
    return true;
}

static bool ply_read_one(struct ply *ply, const struct element *e)
{
    double values[ROLES] = {0}, number;
    for (int i = 0; i < e->property_count; i++) {
        const struct property *p = &e->properties[i];
        if (p->count_type) {
            if (!ply_read_list(ply, p)) return false;
        } else {
            if (!ply_read_number(ply, p->type, p->role != OTHER, &number)) return false;
            const double largest = p->type == NUMBER_UINT8 ? 255 : p->type == NUMBER_UINT16 ? 65535 : 1;
            const bool color = p->role >= RED && p->role <= BLUE;
            if (p->role < ROLES) values[p->role] = color ? number / largest : number;
        }
    }
    if (!e->vertices) return true;
    builder_vertex(ply->builder, values + X);
    if (e->has[RED] && e->has[GREEN] && e->has[BLUE]) {
        const double *wrong = builder_wrong_color(values + RED);
        if (wrong)
            return fail(ply->words->error, ERROR_INPUT, "%s: vertex %d: expected a colour from 0 to 1, got %g",
                        ply->words->path, ply->builder->surface->vertex_count, *wrong);
        builder_color(ply->builder, values + RED);
    }
    if (e->has[U] && e->has[V]) builder_uv(ply->builder, values[U], 1 - values[V]);
    return true;
}

bool ply_read(struct words *words, struct surface_builder *builder)
{
    struct ply ply = {.words = words, .builder = builder};
    if (!ply_read_header(&ply)) return false;
    for (int i = 0; i < ply.element_count; i++) {
        const struct element *e = &ply.elements[i];
        if (!e->vertices) continue;
        ply.vertex_count += e->count;
        ply.textured = e->has[U] && e->has[V];
    }
    for (int i = 0; i < ply.element_count; i++) {
        const struct element *e = &ply.elements[i];
        for (long n = 0; n < e->count && e->property_count > 0 && !builder->failed; n++) {
            if (!ply_read_one(&ply, e)) return false;
        }
    }
    return true;
}

// --- STL, text or binary: the file's triangles are separate; corners at the same place become one vertex

enum { HEAD = 84, FACET = 50, COUNT_AT = 80, CORNERS_AT = 12 };

static void stl_add_corner(struct surface_builder *b, const double position[3])
{
    builder_corner(b, (uint32_t)b->surface->vertex_count, LOOKS_NONE);
    builder_vertex(b, position);
}

/// facet normal … outer loop vertex x y z ×3 endloop endfacet, in capitals or not; "end loop" in two words, too. Only vertices and ends of
/// facets matter.
static bool stl_read_text(struct words *w, struct surface_builder *b)
{
    double p[3];
    while (words_more(w) && !b->failed) {
        const bool ends = words_take(w, "end");
        if (!ends && words_take(w, "vertex")) {
            for (int k = 0; k < 3; k++) {
                if (!words_number(w, "three coordinates of a vertex", &p[k])) return false;
            }
            stl_add_corner(b, p);
        } else if (words_take(w, "endfacet") || (ends && words_take(w, "facet"))) {
            const int corners = builder_end_polygon(b);
            if (corners != 3)
                return fail(w->error, ERROR_INPUT, "%s:%d: expected a facet of three vertices, got %d", w->path,
                            w->line, corners);
        } else if (words_take(w, "solid") || words_take(w, "endsolid")) {
            // Its name goes to the end of the line, or to the first facet where the file is a single line.
            while (*w->at && *w->at != '\n' && strncasecmp(w->at, "facet normal", 12) != 0) w->at++;
        } else if (words_take(w, "normal")) {
            for (int k = 0; k < 3 && words_more(w) && !strchr("oO", *w->at); k++) words_skip(w); // up to "outer"
        } else if (!words_take(w, "facet") && !words_take(w, "outer") && !words_take(w, "loop") &&
                   !words_take(w, "endloop")) {
            return words_expected(w, "a facet");
        }
    }
    if (b->polygon) return words_expected(w, "endfacet");
    return true;
}

static bool stl_read_binary(struct words *w, uint32_t count, struct surface_builder *b)
{
    for (uint32_t i = 0; i < count && !b->failed; i++) {
        for (int corner = 0; corner < 3; corner++) {
            const char *at = w->at + HEAD + (size_t)i * FACET + CORNERS_AT + 12 * corner;
            double p[3];
            for (int k = 0; k < 3; k++) {
                p[k] = number_read(at + 4 * k, NUMBER_FLOAT32, false);
                if (!isfinite(p[k]))
                    return fail(w->error, ERROR_INPUT, "%s: facet %u: expected finite numbers, got NaN or infinity",
                                w->path, i);
            }
            stl_add_corner(b, p);
        }
        builder_end_polygon(b);
    }
    return true;
}

bool stl_read(struct words *w, struct surface_builder *b)
{
    const size_t size = (size_t)(w->end - w->at);
    const uint32_t count = size >= HEAD ? (uint32_t)number_read(w->at + COUNT_AT, NUMBER_UINT32, false) : 0;
    const size_t whole = HEAD + (size_t)count * FACET;
    // Text begins with "solid", but so do some binary files; their size identifies them.
    const bool text = strncasecmp(w->at + strspn(w->at, " \t\r\n"), "solid", 5) == 0 && size != whole;
    if (!text && size < HEAD)
        return fail(w->error, ERROR_INPUT, "%s: expected an STL file, got something else", w->path);
    if (!text && whole > size)
        return fail(w->error, ERROR_INPUT, "%s: expected %zu bytes for %u facets, got %zu: the file is cut off",
                    w->path, whole, count, size);
    if (text ? !stl_read_text(w, b) : !stl_read_binary(w, count, b)) return false;
    if (!b->failed) builder_merge(b);
    return true;
}

// --- OFF: text, with optional colours (C), normals (N) and texture coordinates (ST) at vertices

enum { NUMBERS_MAX = 16 };

/// Whether the number of edges is there. Some programs leave it out: then the next line is the first vertex, of three numbers or more.
static bool off_has_edges(const struct words *w)
{
    struct words ahead = *w;
    if (!words_more(&ahead) || ahead.line == w->line) return true;
    const int line = ahead.line;
    words_skip(&ahead);
    return !words_more(&ahead) || ahead.line != line;
}

bool off_read(struct words *w, struct surface_builder *b)
{
    bool uvs = false, colors = false, normals = false;
    long vertices, faces, edges, corners, vertex;
    if (words_more(w) &&
        strchr("SCNOscno", *w->at)) { // [ST][C][N]OFF is optional; the counts may follow it without a space
        uvs = strncasecmp(w->at, "ST", 2) == 0;
        w->at += uvs ? 2 : 0;
        colors = *w->at == 'C' || *w->at == 'c';
        w->at += colors;
        normals = *w->at == 'N' || *w->at == 'n';
        w->at += normals;
        if (strncasecmp(w->at, "OFF", 3) != 0 || !strchr(" \t\r\n0123456789", w->at[3]))
            return words_expected(w, "OFF");
        w->at += 3;
        if (words_take(w, "BINARY"))
            return fail(w->error, ERROR_INPUT, "%s: expected an OFF file as text, got a binary one", w->path);
    }
    if (!words_integer(w, "the number of vertices", 0, INT_MAX, &vertices) ||
        !words_integer(w, "the number of faces", 0, INT_MAX, &faces) ||
        (off_has_edges(w) && !words_integer(w, "the number of edges", 0, LONG_MAX, &edges)))
        return false;

    // x y z [nx ny nz] [r g b a] [s t]; colours are 0 … 1, or 0 … 255.
    const int color = normals ? 6 : 3, uv = color + (colors ? 4 : 0), count = uv + (uvs ? 2 : 0);
    for (long i = 0; i < vertices && !b->failed; i++) {
        double numbers[NUMBERS_MAX], *rgb = numbers + color;
        for (int k = 0; k < count; k++) {
            if (!words_number(w, "a coordinate of a vertex", &numbers[k])) return false;
        }
        builder_vertex(b, numbers);
        if (colors) {
            const bool bytes = rgb[0] > 1 || rgb[1] > 1 || rgb[2] > 1;
            for (int k = 0; k < 3; k++) rgb[k] = rgb[k] / (bytes ? 255 : 1);
            const double *wrong = builder_wrong_color(rgb);
            if (wrong)
                return fail(w->error, ERROR_INPUT, "%s:%d: expected a colour from 0 to 1, or to 255, got %g", w->path,
                            w->line, *wrong * (bytes ? 255 : 1));
            builder_color(b, rgb);
        }
        if (uvs) builder_uv(b, numbers[uv], 1 - numbers[uv + 1]);
    }

    for (long i = 0; i < faces && !b->failed; i++) { // n i j k … and possibly a colour up to the line's end
        if (!words_integer(w, "a face of three corners or more", 1, INT_MAX, &corners)) return false;
        for (long k = 0; k < corners; k++) {
            if (!words_integer(w, "the number of a vertex, from 0", 0, b->surface->vertex_count - 1, &vertex))
                return false;
            builder_corner(b, (uint32_t)vertex, uvs ? (uint32_t)vertex : LOOKS_NONE);
        }
        builder_end_polygon(b);
        words_skip_line(w);
    }
    return true;
}

// --- any format

enum { FILE_LIMIT = 1 << 30 };

bool surface_read(const char *path, struct surface *surface, struct error *error)
{
    static const struct {
        const char *end, *kind;
        bool (*read)(struct words *words, struct surface_builder *builder);
    } formats[] = {{".stl", "an STL file", stl_read},           {".ply", "a PLY file", ply_read},
                   {".off", "an OFF file", off_read},           {".glb", "a glTF file", gltf_surface_read},
                   {".gltf", "a glTF file", gltf_surface_read}, {"", "an OBJ file", obj_read}};
    struct words words = {.path = path, .line = 1, .error = error};
    struct surface_builder builder = {.surface = surface, .material = LOOKS_NONE};
    char *data = NULL;
    size_t size = 0;
    int i = 0;
    *surface = (struct surface){0};
    while (formats[i].end[0] && !path_has_end(path, formats[i].end)) i++;
    if (formats[i].read != gltf_surface_read && !file_read_text(path, FILE_LIMIT, &data, &size, error)) return false;
    if (data) words.at = data, words.end = data + size; // the glTF reader opens the file itself
    const bool done = formats[i].read(&words, &builder);
    free(data);
    if (done) return builder_finish(&builder, path, formats[i].kind, error);
    surface_free(surface);
    return false;
}
