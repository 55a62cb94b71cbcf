/// Reads OFF surfaces as text, with optional colours (C), normals (N) and texture coordinates (ST) at vertices.
#include "model/surface_readers.h"
#include <limits.h>
#include <string.h>
#include <strings.h>

enum { NUMBERS_MAX = 16 };

struct off {
    struct words *words;
    struct surface_builder *builder;
    bool colors, normals, uvs;
    long vertices, faces;
};

/// Whether the number of edges is there. Some programs leave it out: then the next line is the first vertex, of three numbers or more.
static bool has_edges(struct words *w, int line)
{
    struct words ahead = *w;
    if (!words_more(&ahead) || ahead.line == line) return true;
    line = ahead.line;
    words_skip(&ahead);
    return !words_more(&ahead) || ahead.line != line;
}

/// The word [ST][C][N]OFF, which is optional; the counts may follow it without a space.
static bool read_head(struct off *o)
{
    long edges;
    struct words *w = o->words;
    if (words_more(w) && strchr("SCNOscno", *w->at)) {
        o->uvs = strncasecmp(w->at, "ST", 2) == 0;
        w->at += o->uvs ? 2 : 0;
        o->colors = *w->at == 'C' || *w->at == 'c';
        w->at += o->colors;
        o->normals = *w->at == 'N' || *w->at == 'n';
        w->at += o->normals;
        if (strncasecmp(w->at, "OFF", 3) != 0 || !strchr(" \t\r\n0123456789", w->at[3]))
            return words_expected(w, "OFF");
        w->at += 3;
        if (words_take(w, "BINARY"))
            return fail(w->error, ERROR_INPUT, "%s: expected an OFF file as text, got a binary one", w->path);
    }
    return words_integer(w, "the number of vertices", 0, INT_MAX, &o->vertices) &&
           words_integer(w, "the number of faces", 0, INT_MAX, &o->faces) &&
           (!has_edges(w, w->line) || words_integer(w, "the number of edges", 0, LONG_MAX, &edges));
}

/// x y z [nx ny nz] [r g b a] [s t]; colours are 0 … 1, or 0 … 255.
static bool read_vertex(struct off *o)
{
    double numbers[NUMBERS_MAX];
    const int color = o->normals ? 6 : 3, uv = color + (o->colors ? 4 : 0), count = uv + (o->uvs ? 2 : 0);
    for (int i = 0; i < count; i++) {
        if (!words_number(o->words, "a coordinate of a vertex", &numbers[i])) return false;
    }
    builder_vertex(o->builder, numbers);
    if (o->colors) {
        double *rgb = numbers + color;
        const bool bytes = rgb[0] > 1 || rgb[1] > 1 || rgb[2] > 1;
        for (int k = 0; k < 3; k++) rgb[k] = rgb[k] / (bytes ? 255 : 1);
        const double *wrong = builder_wrong_color(rgb);
        if (wrong)
            return fail(o->words->error, ERROR_INPUT, "%s:%d: expected a colour from 0 to 1, or to 255, got %g",
                        o->words->path, o->words->line, *wrong * (bytes ? 255 : 1));
        builder_color(o->builder, rgb);
    }
    if (o->uvs) builder_uv(o->builder, numbers[uv], 1 - numbers[uv + 1]);
    return true;
}

/// n i j k … and possibly a colour up to the line's end
static bool read_face(struct off *o)
{
    long corners, vertex;
    if (!words_integer(o->words, "a face of three corners or more", 1, INT_MAX, &corners)) return false;
    for (long i = 0; i < corners; i++) {
        if (!words_integer(o->words, "the number of a vertex, from 0", 0, o->builder->surface->vertex_count - 1,
                           &vertex))
            return false;
        builder_corner(o->builder, (uint32_t)vertex, o->uvs ? (uint32_t)vertex : LOOKS_NONE);
    }
    builder_end_polygon(o->builder);
    words_skip_line(o->words);
    return true;
}

bool off_read(struct words *words, struct surface_builder *builder)
{
    struct off o = {.words = words, .builder = builder};
    if (!read_head(&o)) return false;
    for (long i = 0; i < o.vertices && !builder->failed; i++) {
        if (!read_vertex(&o)) return false;
    }
    for (long i = 0; i < o.faces && !builder->failed; i++) {
        if (!read_face(&o)) return false;
    }
    return true;
}
