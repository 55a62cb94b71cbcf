/// Reads STL surfaces, text or binary. Triangles stand alone in the file: corners at the same place become one vertex.
#include "base/file.h"
#include "model/surface_readers.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT = 1 << 30, HEAD = 84, FACET = 50, COUNT_AT = 80, CORNERS_AT = 12 };

static void add_corner(struct surface_builder *b, const double position[3])
{
    builder_corner(b, (uint32_t)b->surface->vertex_count, LOOKS_NONE);
    builder_vertex(b, position);
}

/// facet normal … outer loop vertex x y z ×3 endloop endfacet: only the vertices and the ends of facets matter.
static bool read_text(struct words *w, struct surface_builder *b)
{
    double p[3];
    while (words_more(w) && !b->failed) {
        if (words_take(w, "vertex")) {
            for (int k = 0; k < 3; k++) {
                if (!words_number(w, "three coordinates of a vertex", &p[k])) return false;
            }
            add_corner(b, p);
        } else if (words_take(w, "endfacet")) {
            const int corners = builder_end_polygon(b);
            if (corners != 3)
                return fail(w->error, ERROR_INPUT, "%s:%d: expected a facet of three vertices, got %d", w->path,
                            w->line, corners);
        } else if (words_take(w, "solid") || words_take(w, "endsolid")) {
            words_skip_line(w); // behind it comes a name
        } else if (!words_take(w, "facet") && !words_take(w, "outer") && !words_take(w, "endloop")) {
            if (!words_take(w, "normal") && !words_take(w, "loop")) return words_expected(w, "a facet");
            words_skip_line(w);
        }
    }
    if (b->polygon) return words_expected(w, "endfacet");
    return true;
}

static uint32_t word_at(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static bool read_binary(const char *path, const unsigned char *bytes, uint32_t count, struct surface_builder *b,
                        struct error *error)
{
    for (uint32_t i = 0; i < count && !b->failed; i++) {
        for (int corner = 0; corner < 3; corner++) {
            double p[3];
            for (int k = 0; k < 3; k++) {
                const uint32_t word = word_at(bytes + HEAD + (size_t)i * FACET + CORNERS_AT + 12 * corner + 4 * k);
                float number;
                memcpy(&number, &word, sizeof number);
                if (!isfinite(number))
                    return fail(error, ERROR_INPUT, "%s: facet %u: expected finite numbers, got NaN or infinity",
                                path, i);
                p[k] = (double)number;
            }
            add_corner(b, p);
        }
        builder_end_polygon(b);
    }
    return true;
}

/// Text begins with "solid"; but so do some binary files, whose size tells them.
static bool read_either(const char *path, char *data, size_t size, struct surface_builder *b, struct error *error)
{
    const unsigned char *bytes = (const unsigned char *)data;
    const uint32_t count = size >= HEAD ? word_at(bytes + COUNT_AT) : 0;
    const size_t whole = HEAD + (size_t)count * FACET;
    const bool solid = strncmp(data + strspn(data, " \t\r\n"), "solid", 5) == 0;
    if (solid && size != whole) {
        struct words words = {.path = path, .at = data, .line = 1, .error = error};
        return read_text(&words, b);
    }
    if (size < HEAD) return fail(error, ERROR_INPUT, "%s: expected an STL file, got something else", path);
    if (whole <= size) return read_binary(path, bytes, count, b, error);
    return fail(error, ERROR_INPUT, "%s: expected %zu bytes for %u facets, got %zu: it is not whole", path, whole,
                count, size);
}

bool stl_read(const char *path, struct surface *surface, struct error *error)
{
    char *data;
    size_t size;
    *surface = (struct surface){0};
    if (!file_read(path, FILE_LIMIT, &data, &size, error)) return false;
    struct surface_builder builder = {.surface = surface, .material = LOOKS_NONE};
    const bool done = read_either(path, data, size, &builder, error);
    free(data);
    if (done && !builder.failed) builder_merge(&builder);
    if (done) return builder_finish(&builder, path, "an STL file", error);
    surface_free(surface);
    return false;
}
