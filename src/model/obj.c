/// Reads OBJ surfaces.
#include "model/obj.h"
#include "base/file.h"
#include "base/progress.h"
#include "model/surface_readers.h"
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT = 1 << 30, SHOWN_MAX = 24 };
enum { TELLING = 1 << 16 }; ///< lines between two words about how far it is

/// A file being read. `line` is cut off its text with a NUL, comments and continuations resolved.
struct reader {
    const char *path;
    const char *text;
    long size;
    char *next, *line;
    int number; ///< of the line, from 1
    struct surface *surface;
    struct surface_builder builder;
    struct error *error;
};

static bool expected(const struct reader *r, const char *what, const char *got)
{
    int shown = (int)strcspn(got, " \t\r");
    if (shown == 0) return fail(r->error, ERROR_INPUT, "%s:%d: expected %s, got nothing", r->path, r->number, what);
    if (shown > SHOWN_MAX) shown = SHOWN_MAX;
    return fail(r->error, ERROR_INPUT, "%s:%d: expected %s, got '%.*s'", r->path, r->number, what, shown, got);
}

static char *skip_space(char *at) { return at + strspn(at, " \t\r"); }

/// Cuts the next line off, joining lines that end in a backslash; false at the end of the text.
static bool next_line(struct reader *r)
{
    if (!*r->next) return false;
    r->line = r->next;
    r->number++;
    for (char *end = r->line;; end++) {
        end += strcspn(end, "\n");
        r->next = *end ? end + 1 : end;
        char *last = end > r->line && end[-1] == '\r' ? end - 1 : end;
        bool joined = *end && last > r->line && last[-1] == '\\';
        if (!joined) {
            *end = '\0';
            break;
        }
        memset(last - 1, ' ', (size_t)(end - last) + 2);
        r->number++;
    }
    r->line[strcspn(r->line, "#")] = '\0';
    return true;
}

/// Up to `count` numbers; returns how many there are before the end of the line, -1 if a word is not a number.
static int read_numbers(const struct reader *r, char *at, double *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        at = skip_space(at);
        if (!*at) return i;
        char *end;
        numbers[i] = (double)strtof(at, &end);
        if (end == at || !strchr(" \t\r", *end) || !isfinite(numbers[i])) {
            expected(r, "a finite number", at);
            return -1;
        }
        at = end;
    }
    return count;
}

/// v x y z [w | r g b]
static bool read_vertex(struct reader *r, char *at)
{
    double numbers[6];
    int count = read_numbers(r, at, numbers, 6);
    if (count < 0) return false;
    if (count < 3) return expected(r, "three coordinates of a vertex", "");
    builder_vertex(&r->builder, numbers);
    if (count < 6) return true;
    const double *wrong = builder_wrong_color(numbers + 3);
    if (wrong)
        return fail(r->error, ERROR_INPUT, "%s:%d: expected a colour from 0 to 1, got %g", r->path, r->number,
                    *wrong);
    builder_color(&r->builder, numbers + 3);
    return true;
}

/// vt u [v [w]], from the lower left of the picture
static bool read_uv(struct reader *r, char *at)
{
    double numbers[2] = {0};
    if (read_numbers(r, at, numbers, 2) < 0) return false;
    builder_uv(&r->builder, numbers[0], 1 - numbers[1]);
    return true;
}

/// The number of texture coordinates that follows a "/"; LOOKS_NONE where there are none such.
static uint32_t uv_of(const struct reader *r, const char *at)
{
    const int count = r->surface->looks.uv_count;
    long index = *at == '/' && at[1] != '/' ? strtol(at + 1, NULL, 10) : 0;
    if (index < 0) index += count + 1;
    return index >= 1 && index <= count ? (uint32_t)index - 1 : LOOKS_NONE;
}

/// A corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1 or backwards from -1 (the newest).
static bool read_corner(struct reader *r, char **at)
{
    char *end, *start = *at;
    const int count = r->surface->vertex_count;
    long index = strtol(start, &end, 10);
    if (index < 0) index += count + 1;
    bool written = end > start && (*end == '/' || strchr(" \t\r", *end));
    if (!written || index < 1 || index > INT_MAX) return expected(r, "the number of a vertex", start);
    if (index > count) {
        char what[64];
        snprintf(what, sizeof what, "a vertex from 1 to %d", count);
        return expected(r, what, start);
    }
    builder_corner(&r->builder, (uint32_t)index - 1, uv_of(r, end));
    *at = skip_space(end + strcspn(end, " \t\r"));
    return true;
}

/// f a b c d … as the fan abc, acd, …
static bool read_face(struct reader *r, char *at)
{
    for (at = skip_space(at); *at;) {
        if (!read_corner(r, &at)) return false;
    }
    const int count = builder_end_polygon(&r->builder);
    if (count < 3)
        return fail(r->error, ERROR_INPUT, "%s:%d: expected a face of three corners or more, got %d", r->path,
                    r->number, count);
    return true;
}

/// The rest of a line: a name, which may have spaces.
static char *name_at(char *at)
{
    at = skip_space(at);
    size_t length = strlen(at);
    while (length > 0 && strchr(" \t\r", at[length - 1])) at[--length] = '\0';
    return at;
}

static bool read_lines(struct reader *r)
{
    while (next_line(r)) {
        if (r->number % TELLING == 0) stage_tell("reading the mesh", r->next - r->text, r->size);
        char *word = skip_space(r->line);
        const size_t length = strcspn(word, " \t\r");
        bool good = true;
        if (length == 1 && *word == 'v') good = read_vertex(r, word + 1);
        if (length == 2 && strncmp(word, "vt", 2) == 0) good = read_uv(r, word + 2);
        if (length == 1 && *word == 'f') good = read_face(r, word + 1);
        if (length == 6 && strncmp(word, "usemtl", 6) == 0)
            r->builder.material = builder_material(&r->builder, name_at(word + 6));
        if (length == 6 && strncmp(word, "mtllib", 6) == 0) mtl_read(r->path, name_at(word + 6), &r->builder);
        if (!good) return false;
    }
    return true;
}

bool obj_read(const char *path, struct surface *surface, struct error *error)
{
    char *text;
    size_t size;
    *surface = (struct surface){0};
    if (!file_read(path, FILE_LIMIT, &text, &size, error)) return false;
    struct reader reader = {
        .path = path, .text = text, .size = (long)size, .next = text, .surface = surface, .error = error};
    reader.builder = (struct surface_builder){.surface = surface, .material = LOOKS_NONE};
    bool done = strlen(text) == size
                    ? read_lines(&reader)
                    : fail(error, ERROR_INPUT, "%s: expected the text of an OBJ file, got binary data", path);
    free(text);
    if (done) return builder_finish(&reader.builder, path, "an OBJ file", error);
    surface_free(surface);
    return false;
}
