/// Reads STL surfaces, text or binary. The file's triangles are separate; corners at the same place become one vertex.
#include "base/npy.h"
#include "model/surface_readers.h"
#include <math.h>
#include <string.h>
#include <strings.h>

enum { HEAD = 84, FACET = 50, COUNT_AT = 80, CORNERS_AT = 12 };

static void add_corner(struct surface_builder *b, const double position[3])
{
    builder_corner(b, (uint32_t)b->surface->vertex_count, LOOKS_NONE);
    builder_vertex(b, position);
}

/// A solid's name goes to the end of its line, or to the first facet where the file is a single line.
static void skip_name(struct words *w)
{
    while (*w->at && *w->at != '\n' && strncasecmp(w->at, "facet normal", 12) != 0) w->at++;
}

/// facet normal … outer loop vertex x y z ×3 endloop endfacet, in capitals or not; "end loop" in two words, too. Only vertices and ends of
/// facets matter.
static bool read_text(struct words *w, struct surface_builder *b)
{
    double p[3];
    while (words_more(w) && !b->failed) {
        const bool ends = words_take(w, "end");
        if (!ends && words_take(w, "vertex")) {
            for (int k = 0; k < 3; k++) {
                if (!words_number(w, "three coordinates of a vertex", &p[k])) return false;
            }
            add_corner(b, p);
        } else if (words_take(w, "endfacet") || (ends && words_take(w, "facet"))) {
            const int corners = builder_end_polygon(b);
            if (corners != 3)
                return fail(w->error, ERROR_INPUT, "%s:%d: expected a facet of three vertices, got %d", w->path,
                            w->line, corners);
        } else if (words_take(w, "solid") || words_take(w, "endsolid")) {
            skip_name(w);
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

static bool read_binary(struct words *w, uint32_t count, struct surface_builder *b)
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
            add_corner(b, p);
        }
        builder_end_polygon(b);
    }
    return true;
}

/// Text begins with "solid", but so do some binary files; their size identifies them.
static bool read_either(struct words *w, struct surface_builder *b)
{
    const size_t size = (size_t)(w->end - w->at);
    const uint32_t count = size >= HEAD ? (uint32_t)number_read(w->at + COUNT_AT, NUMBER_UINT32, false) : 0;
    const size_t whole = HEAD + (size_t)count * FACET;
    const bool solid = strncasecmp(w->at + strspn(w->at, " \t\r\n"), "solid", 5) == 0;
    if (solid && size != whole) return read_text(w, b);
    if (size < HEAD) return fail(w->error, ERROR_INPUT, "%s: expected an STL file, got something else", w->path);
    if (whole <= size) return read_binary(w, count, b);
    return fail(w->error, ERROR_INPUT, "%s: expected %zu bytes for %u facets, got %zu: the file is cut off", w->path,
                whole, count, size);
}

bool stl_read(struct words *words, struct surface_builder *builder)
{
    const bool done = read_either(words, builder);
    if (done && !builder->failed) builder_merge(builder);
    return done;
}
