/// Reads and writes OBJ surfaces.
#include "model/obj.h"
#include "base/file.h"
#include "base/srgb.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT = 1 << 30, COUNT_LIMIT = 1 << 28, SHOWN_MAX = 24 };

/// A file being read. `line` is cut off its text with a NUL, comments and continuations resolved.
struct reader {
    const char *path;
    char *next, *line;
    int number; ///< of the line, from 1
    struct surface *surface;
    int vertex_capacity, color_capacity, index_capacity;
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

/// Makes room for one more element of `size` bytes.
static bool reserve(void **elements, size_t size, int count, int *capacity)
{
    if (count < *capacity) return true;
    int wanted = *capacity ? 2 * *capacity : 1024;
    void *larger = count < COUNT_LIMIT ? realloc(*elements, size * (size_t)wanted) : NULL;
    if (!larger) return false;
    *elements = larger;
    *capacity = wanted;
    return true;
}

/// Up to `count` numbers; returns how many there are before the end of the line, -1 if a word is not a number.
static int read_numbers(const struct reader *r, char *at, float *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        at = skip_space(at);
        if (!*at) return i;
        char *end;
        numbers[i] = strtof(at, &end);
        if (end == at || !strchr(" \t\r", *end) || !isfinite(numbers[i])) {
            expected(r, "a finite number", at);
            return -1;
        }
        at = end;
    }
    return count;
}

/// Colours the newest vertex; those before the first coloured one become white.
static bool add_color(struct reader *r, const float srgb[3])
{
    struct surface *s = r->surface;
    int first = s->color ? s->vertex_count : 0;
    for (int i = first; i <= s->vertex_count; i++) {
        void *colors = s->color;
        if (!reserve(&colors, sizeof *s->color, i, &r->color_capacity)) return fail_no_memory(r->error, r->path);
        s->color = colors;
        for (int k = 0; k < 3; k++) s->color[i][k] = i < s->vertex_count ? 1 : srgb_to_linear(srgb[k]);
    }
    return true;
}

/// v x y z [w | r g b]
static bool read_vertex(struct reader *r, char *at)
{
    static const float white[3] = {1, 1, 1};
    struct surface *s = r->surface;
    float numbers[6];
    int count = read_numbers(r, at, numbers, 6);
    if (count < 0) return false;
    if (count < 3) return expected(r, "three coordinates of a vertex", "");
    void *positions = s->position;
    if (!reserve(&positions, sizeof *s->position, s->vertex_count, &r->vertex_capacity))
        return fail_no_memory(r->error, r->path);
    s->position = positions;
    memcpy(s->position[s->vertex_count], numbers, sizeof *s->position);
    const float *color = count == 6 ? numbers + 3 : s->color ? white : NULL;
    if (color && !add_color(r, color)) return false;
    s->vertex_count++;
    return true;
}

/// A corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1 or backwards from -1 (the newest).
static bool read_corner(const struct reader *r, char **at, uint32_t *corner)
{
    char *end, *start = *at;
    long index = strtol(start, &end, 10);
    if (index < 0) index += r->surface->vertex_count + 1;
    bool written = end > start && (*end == '/' || strchr(" \t\r", *end));
    if (!written || index < 1 || index > COUNT_LIMIT) return expected(r, "the number of a vertex", start);
    *corner = (uint32_t)index - 1;
    *at = skip_space(end + strcspn(end, " \t\r"));
    return true;
}

static bool add_index(struct reader *r, uint32_t index)
{
    struct surface *s = r->surface;
    void *indices = s->indices;
    if (!reserve(&indices, sizeof *s->indices, s->index_count, &r->index_capacity))
        return fail_no_memory(r->error, r->path);
    s->indices = indices;
    s->indices[s->index_count++] = index;
    return true;
}

/// f a b c d … as the fan abc, acd, …
static bool read_face(struct reader *r, char *at)
{
    uint32_t first = 0, before = 0, corner = 0;
    int count = 0;
    for (at = skip_space(at); *at; count++) {
        char *start = at;
        if (!read_corner(r, &at, &corner)) return false;
        if (corner >= (uint32_t)r->surface->vertex_count) {
            char what[64];
            snprintf(what, sizeof what, "a vertex from 1 to %d", r->surface->vertex_count);
            return expected(r, what, start);
        }
        if (count == 0) first = corner;
        if (count >= 2 && !(add_index(r, first) && add_index(r, before) && add_index(r, corner))) return false;
        before = corner;
    }
    if (count < 3)
        return fail(r->error, ERROR_INPUT, "%s:%d: expected a face of three corners or more, got %d", r->path,
                    r->number, count);
    return true;
}

static bool read_lines(struct reader *r)
{
    while (next_line(r)) {
        char *word = skip_space(r->line);
        size_t length = strcspn(word, " \t\r");
        bool good = true;
        if (length == 1 && *word == 'v') good = read_vertex(r, word + 1);
        if (length == 1 && *word == 'f') good = read_face(r, word + 1);
        if (!good) return false;
    }
    if (r->surface->vertex_count == 0)
        return fail(r->error, ERROR_INPUT, "%s: expected an OBJ file with vertices, got none", r->path);
    if (r->surface->index_count == 0)
        return fail(r->error, ERROR_INPUT, "%s: expected an OBJ file with faces, got none", r->path);
    return true;
}

bool obj_read(const char *path, struct surface *surface, struct error *error)
{
    char *text;
    size_t size;
    *surface = (struct surface){0};
    if (!file_read(path, FILE_LIMIT, &text, &size, error)) return false;
    struct reader reader = {.path = path, .next = text, .surface = surface, .error = error};
    bool done;
    if (strlen(text) == size) {
        done = read_lines(&reader);
    } else {
        done = fail(error, ERROR_INPUT, "%s: expected the text of an OBJ file, got binary data", path);
    }
    free(text);
    if (!done) surface_free(surface);
    return done;
}

static void write_surface(FILE *out, const struct surface *s)
{
    for (int i = 0; i < s->vertex_count; i++) {
        const float *p = s->position[i];
        fprintf(out, "v %.9g %.9g %.9g", (double)p[0], (double)p[1], (double)p[2]);
        for (int k = 0; s->color && k < 3; k++) fprintf(out, " %.9g", (double)srgb_from_linear(s->color[i][k]));
        fputc('\n', out);
    }
    for (int i = 0; i + 2 < s->index_count; i += 3)
        fprintf(out, "f %u %u %u\n", s->indices[i] + 1, s->indices[i + 1] + 1, s->indices[i + 2] + 1);
}

bool obj_write(const char *path, const struct surface *surface, struct error *error)
{
    struct file_output output;
    if (!file_output_open(&output, path, error)) return false;
    write_surface(output.stream, surface);
    return file_output_commit(&output, error);
}

void surface_bounds(const struct surface *surface, double lo[3], double hi[3])
{
    for (int c = 0; c < 3; c++) {
        lo[c] = INFINITY;
        hi[c] = -INFINITY;
        for (int i = 0; i < surface->vertex_count; i++) {
            lo[c] = fmin(lo[c], (double)surface->position[i][c]);
            hi[c] = fmax(hi[c], (double)surface->position[i][c]);
        }
    }
}

void surface_free(struct surface *surface)
{
    free(surface->position);
    free(surface->color);
    free(surface->indices);
    *surface = (struct surface){0};
}
