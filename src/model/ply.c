/// Reads PLY surfaces, as text or binary in either byte order.
///
/// A header lists elements, and for each its properties: a number, or a list preceded by its length. Everything is read in the file's order,
/// number by number. Kept are x y z, colours and texture coordinates of vertices, the vertex lists of faces, and the triangles of strips.
#include "base/npy.h"
#include "model/surface_readers.h"
#include <limits.h>
#include <math.h>
#include <string.h>

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

// --- header

static bool read_type(struct words *w, enum number_type *type)
{
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        *type = types[i].type;
        if (words_take(w, types[i].name)) return true;
    }
    return words_expected(w, "a type of numbers");
}

/// A property's role, by its name.
static enum role read_role(struct words *w, bool of_vertices, bool list)
{
    if (!of_vertices)
        return list && (words_take(w, "vertex_indices") || words_take(w, "vertex_index")) ? CORNERS : OTHER;
    for (size_t i = 0; !list && i < sizeof roles / sizeof *roles; i++) {
        if (words_take(w, roles[i].name)) return roles[i].role;
    }
    return OTHER;
}

static bool read_property(struct words *w, struct element *e)
{
    struct property *p = &e->properties[e->property_count];
    if (e->property_count == PROPERTIES_MAX) return words_expected(w, "at most 64 properties");
    *p = (struct property){0};
    const bool list = words_take(w, "list");
    if ((list && !read_type(w, &p->count_type)) || !read_type(w, &p->type)) return false;
    p->role = read_role(w, e->vertices, list);
    if (p->role < ROLES) e->has[p->role] = true;
    if (p->role == OTHER) words_skip_line(w); // its name
    e->property_count++;
    return true;
}

static bool read_element(struct ply *ply)
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
        } else if (!read_property(w, e)) {
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

static bool read_format(struct ply *ply)
{
    static const char *const formats[] = {
        [TEXT] = "ascii", [LITTLE] = "binary_little_endian", [BIG] = "binary_big_endian"};
    struct words *w = ply->words;
    for (int f = TEXT; f <= BIG; f++) {
        ply->format = (enum format)f;
        if (words_take(w, formats[f])) {
            words_skip_line(w);
            return true;
        }
    }
    return words_expected(w, "ascii, binary_little_endian or binary_big_endian");
}

static bool read_header(struct ply *ply)
{
    struct words *w = ply->words;
    if (!words_take(w, "ply"))
        return fail(w->error, ERROR_INPUT, "%s: expected a PLY file, got something else", w->path);
    while (!words_take(w, "end_header")) {
        bool good = true;
        if (words_take(w, "format")) {
            good = read_format(ply);
        } else if (words_take(w, "element")) {
            good = read_element(ply);
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

// --- numbers

/// Infinity and NaN are refused if `used`; unused properties may have them.
static bool next_number(struct ply *ply, enum number_type type, bool used, double *number)
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

// --- elements

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

static bool read_list(struct ply *ply, const struct property *p)
{
    struct words *w = ply->words;
    struct strip strip = {0};
    double length, number;
    if (!next_number(ply, p->count_type, true, &length)) return false;
    if (length < 0) return fail(w->error, ERROR_INPUT, "%s: expected the length of a list, got %g", w->path, length);
    for (double i = 0; i < length && !ply->builder->failed; i++) {
        if (!next_number(ply, p->type, p->role != OTHER, &number)) return false;
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

static double largest_of(enum number_type type)
{
    return type == NUMBER_UINT8 ? 255 : type == NUMBER_UINT16 ? 65535 : 1;
}

static bool read_one(struct ply *ply, const struct element *e)
{
    double values[ROLES] = {0}, number;
    for (int i = 0; i < e->property_count; i++) {
        const struct property *p = &e->properties[i];
        if (p->count_type) {
            if (!read_list(ply, p)) return false;
        } else {
            if (!next_number(ply, p->type, p->role != OTHER, &number)) return false;
            const bool color = p->role >= RED && p->role <= BLUE;
            if (p->role < ROLES) values[p->role] = color ? number / largest_of(p->type) : number;
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

static bool read_elements(struct ply *ply)
{
    for (int i = 0; i < ply->element_count; i++) {
        const struct element *e = &ply->elements[i];
        if (!e->vertices) continue;
        ply->vertex_count += e->count;
        ply->textured = e->has[U] && e->has[V];
    }
    for (int i = 0; i < ply->element_count; i++) {
        const struct element *e = &ply->elements[i];
        for (long n = 0; n < e->count && e->property_count > 0 && !ply->builder->failed; n++) {
            if (!read_one(ply, e)) return false;
        }
    }
    return true;
}

bool ply_read(struct words *words, struct surface_builder *builder)
{
    struct ply ply = {.words = words, .builder = builder};
    return read_header(&ply) && read_elements(&ply);
}
