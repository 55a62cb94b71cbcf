/// Reads and writes OBJ surfaces and their materials.
#include "base/file.h"
#include "base/png.h"
#include "base/progress.h"
#include "model/surface_readers.h"
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT_LIMIT = 16 << 20, SHOWN_MAX = 24, LIBRARY_NAME = 256 };
enum { TELLING = 1 << 16 }; ///< lines between two progress reports

/// A text being read, line by line.
struct lines {
    char *next, *line; ///< `line` ends with a NUL, without comments and with continuations joined
    int number;        ///< from 1
    bool joins;        ///< a line that ends in a backslash continues on the next
};

static char *skip_space(char *at) { return at + strspn(at, " \t\r"); }

/// Reads the next line; false at the end of the text.
static bool next_line(struct lines *l)
{
    if (!*l->next) return false;
    l->line = l->next;
    l->number++;
    for (char *end = l->line;; end++) {
        end += strcspn(end, "\n");
        l->next = *end ? end + 1 : end;
        char *last = end > l->line && end[-1] == '\r' ? end - 1 : end;
        bool joined = l->joins && *end && last > l->line && last[-1] == '\\';
        if (!joined) {
            *end = '\0';
            break;
        }
        memset(last - 1, ' ', (size_t)(end - last) + 2);
        l->number++;
    }
    l->line[strcspn(l->line, "#")] = '\0';
    return true;
}

/// The text after the line's first word if that is `word`; else NULL.
static char *behind(const struct lines *l, const char *word)
{
    char *at = skip_space(l->line);
    const size_t length = strlen(word);
    return strncmp(at, word, length) == 0 && strchr(" \t\r", at[length]) ? skip_space(at + length) : NULL;
}

/// The rest of a line: a name, possibly with spaces.
static char *name_at(char *at)
{
    size_t length = strlen(at);
    while (length > 0 && strchr(" \t\r", at[length - 1])) at[--length] = '\0';
    return at;
}

// --- materials

static void note(struct looks *looks, const char *name)
{
    if (!looks->left_out) looks->left_out = strdup(name);
}

/// The path of a file named in another one's folder; '\\' separates folders, too.
static bool read_beside(const char *path, const char *name, size_t limit, char **data, size_t *size)
{
    char folder[PATH_LIMIT], plain[PATH_LIMIT], place[PATH_LIMIT];
    if (snprintf(plain, sizeof plain, "%s", name) >= (int)sizeof plain || !path_folder(path, folder)) return false;
    for (char *c = plain; *c; c++) {
        if (*c == '\\') *c = '/';
    }
    return path_resolve(folder, plain, place) && file_read_text(place, limit, data, size, NULL);
}

/// The rest of a map's line after its options, each followed by numbers or on/off.
static const char *map_name(const char *at)
{
    while (*at == '-' && strchr(at, ' ')) {
        at += strcspn(at, " \t");
        for (at += strspn(at, " \t"); *at;) {
            const size_t length = strcspn(at, " \t");
            const bool word = strncmp(at, "on", length) == 0 || strncmp(at, "off", length) == 0;
            char *end;
            strtod(at, &end);
            if (!word && end != at + length) break;
            at += length;
            at += strspn(at, " \t");
        }
    }
    return at;
}

static void read_image(const char *path, const char *value, struct looks *looks, struct looks_material *material)
{
    const char *name = map_name(value);
    char *data = NULL;
    size_t size = 0;
    const size_t room = LOOKS_IMAGES_LIMIT - looks_image_bytes(looks);
    if (material->image) return;
    if (!read_beside(path, name, room, &data, &size) || !looks_image_kind((unsigned char *)data, size)) {
        free(data);
        note(looks, name);
        return;
    }
    material->image = (unsigned char *)data;
    material->image_size = size;
}

static bool in_range(const char *text, float *value)
{
    const float number = strtof(text, NULL);
    if (!(number >= 0 && number <= 1)) return false;
    *value = number;
    return true;
}

/// Adds the materials of a file in an OBJ file's folder. Unreadable pictures, and those neither PNG nor JPEG, are left out and noted in the
/// looks.
static void read_materials(const char *obj_path, const char *name, struct surface_builder *builder)
{
    struct looks *looks = &builder->surface->looks;
    uint32_t current = LOOKS_NONE;
    struct lines lines = {0};
    char *text = NULL, *at;
    size_t size;
    if (!read_beside(obj_path, name, TEXT_LIMIT, &text, &size)) {
        note(looks, name);
        return;
    }
    for (lines.next = text; next_line(&lines);) {
        if ((at = behind(&lines, "newmtl"))) current = builder_material(builder, name_at(at));
        if (current == LOOKS_NONE) continue;
        struct looks_material *material = &looks->materials[current];
        if ((at = behind(&lines, "Kd"))) {
            for (int k = 0; k < 3; k++) in_range(at, &material->color[k]), strtof(at, &at);
        } else if ((at = behind(&lines, "d"))) {
            in_range(at, &material->color[3]);
        } else if ((at = behind(&lines, "Tr")) && in_range(at, &material->color[3])) {
            material->color[3] = 1 - material->color[3];
        } else if ((at = behind(&lines, "map_Kd"))) {
            read_image(obj_path, name_at(at), looks, material);
        }
    }
    free(text);
}

// --- surfaces

struct reader {
    const char *path;
    struct lines lines;
    struct surface_builder *builder;
    struct error *error;
};

static bool expected(const struct reader *r, const char *what, const char *got)
{
    int shown = (int)strcspn(got, " \t\r");
    if (shown == 0)
        return fail(r->error, ERROR_INPUT, "%s:%d: expected %s, got nothing", r->path, r->lines.number, what);
    if (shown > SHOWN_MAX) shown = SHOWN_MAX;
    return fail(r->error, ERROR_INPUT, "%s:%d: expected %s, got '%.*s'", r->path, r->lines.number, what, shown, got);
}

/// Up to `count` numbers; returns how many the line has, -1 if a word is not a number.
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
    builder_vertex(r->builder, numbers);
    if (count < 6) return true;
    const double *wrong = builder_wrong_color(numbers + 3);
    if (wrong)
        return fail(r->error, ERROR_INPUT, "%s:%d: expected a colour from 0 to 1, got %g", r->path, r->lines.number,
                    *wrong);
    builder_color(r->builder, numbers + 3);
    return true;
}

/// A corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1 or backwards from -1 (the newest).
static bool read_corner(struct reader *r, char **at)
{
    char *end, *start = *at;
    const int count = r->builder->surface->vertex_count;
    long index = strtol(start, &end, 10);
    if (index < 0) index += count + 1;
    bool written = end > start && (*end == '/' || strchr(" \t\r", *end));
    if (!written || index < 1 || index > INT_MAX) return expected(r, "the number of a vertex", start);
    if (index > count) {
        char what[64];
        snprintf(what, sizeof what, "a vertex from 1 to %d", count);
        return expected(r, what, start);
    }
    const int uv_count = r->builder->surface->looks.uv_count;
    long uv = *end == '/' && end[1] != '/' ? strtol(end + 1, NULL, 10) : 0;
    if (uv < 0) uv += uv_count + 1;
    builder_corner(r->builder, (uint32_t)index - 1, uv >= 1 && uv <= uv_count ? (uint32_t)uv - 1 : LOOKS_NONE);
    *at = skip_space(end + strcspn(end, " \t\r"));
    return true;
}

bool obj_read(struct words *words, struct surface_builder *builder)
{
    const char *text = words->at;
    const long size = words->end - text;
    struct reader r = {
        .path = words->path, .lines = {.next = words->at, .joins = true}, .builder = builder, .error = words->error};
    if (memchr(text, '\0', (size_t)size))
        return fail(r.error, ERROR_INPUT, "%s: expected the text of an OBJ file, got binary data", r.path);
    while (!builder->failed && next_line(&r.lines)) {
        if (r.lines.number % TELLING == 0) stage_tell("reading the mesh", r.lines.next - text, size);
        const struct lines *l = &r.lines;
        char *at;
        if ((at = behind(l, "v"))) {
            if (!read_vertex(&r, at)) return false;
        } else if ((at = behind(l, "vt"))) { // u [v [w]], from the lower left of the picture
            double numbers[2] = {0};
            if (read_numbers(&r, at, numbers, 2) < 0) return false;
            builder_uv(builder, numbers[0], 1 - numbers[1]);
        } else if ((at = behind(l, "f"))) { // a b c d … as the fan abc, acd, …
            while (*at) {
                if (!read_corner(&r, &at)) return false;
            }
            const int count = builder_end_polygon(builder);
            if (count < 3)
                return fail(r.error, ERROR_INPUT, "%s:%d: expected a face of three corners or more, got %d", r.path,
                            l->number, count);
        } else if ((at = behind(l, "usemtl"))) {
            builder->material = builder_material(builder, name_at(at));
        } else if ((at = behind(l, "mtllib"))) {
            read_materials(r.path, name_at(at), builder);
        }
    }
    return true;
}

// --- writing

/// "folder/up.rest.obj" → "folder/up.rest" and the ending; false where that is too long.
static bool name_beside(const char *obj_path, const char *ending, char path[PATH_LIMIT])
{
    const int stem = (int)strlen(obj_path) - (path_has_end(obj_path, ".obj") ? 4 : 0);
    return snprintf(path, PATH_LIMIT, "%.*s%s", stem, obj_path, ending) < PATH_LIMIT;
}

/// Writes materials and pictures beside an OBJ file; `name` is the material file's name in it.
static bool write_library(const char *obj_path, const struct looks *looks, char name[LIBRARY_NAME],
                          struct error *error)
{
    char path[PATH_LIMIT];
    struct file_output output;
    if (!name_beside(obj_path, ".mtl", path) || snprintf(name, LIBRARY_NAME, "%s", path_name(path)) >= LIBRARY_NAME)
        return fail(error, ERROR_INPUT, "%s: the name is too long", obj_path);
    if (!file_output_open(&output, path, error)) return false;
    for (int m = 0; m < looks->material_count; m++) {
        const struct looks_material *material = &looks->materials[m];
        const float *c = material->color;
        fprintf(output.stream, "newmtl %s\nKd %.9g %.9g %.9g\nd %.9g\n", material->name, (double)c[0], (double)c[1],
                (double)c[2], (double)c[3]);
        if (!material->image) continue;
        char ending[32], picture[PATH_LIMIT];
        const char *kind = looks_image_kind(material->image, material->image_size);
        snprintf(ending, sizeof ending, "-%d.%s", m + 1, kind && *kind == 'j' ? "jpg" : "png");
        const bool named =
            name_beside(obj_path, ending, picture) || fail(error, ERROR_INPUT, "%s: the name is too long", obj_path);
        if (!named || !file_write_atomic(picture, material->image, material->image_size, error)) {
            file_output_discard(&output);
            return false;
        }
        fprintf(output.stream, "map_Kd %s\n", path_name(picture));
    }
    return file_output_commit(&output, error);
}

static void write_corner(FILE *out, const struct surface *s, int index)
{
    fprintf(out, " %u", s->indices[index] + 1);
    if (s->looks.corner && s->looks.corner[index] != LOOKS_NONE) fprintf(out, "/%u", s->looks.corner[index] + 1);
}

bool obj_write(const char *path, const struct surface *surface, struct error *error)
{
    const struct looks *looks = &surface->looks;
    struct file_output output;
    char library[LIBRARY_NAME];
    if (looks->material && !write_library(path, looks, library, error)) return false;
    if (!file_output_open(&output, path, error)) return false;
    FILE *out = output.stream;
    if (looks->material) fprintf(out, "mtllib %s\n", library);
    for (int i = 0; i < surface->vertex_count; i++) {
        const float *p = surface->position[i];
        fprintf(out, "v %.9g %.9g %.9g", (double)p[0], (double)p[1], (double)p[2]);
        for (int k = 0; surface->color && k < 3; k++)
            fprintf(out, " %.9g", (double)srgb_from_linear(surface->color[i][k]));
        fputc('\n', out);
    }
    for (int i = 0; i < looks->uv_count; i++)
        fprintf(out, "vt %.9g %.9g\n", (double)looks->uv[i][0], 1 - (double)looks->uv[i][1]);

    uint32_t material = LOOKS_NONE;
    for (int i = 0; i + 2 < surface->index_count; i += 3) {
        const uint32_t own = looks->material ? looks->material[i / 3] : LOOKS_NONE;
        if (own != material && own != LOOKS_NONE) {
            const char *name = looks->materials[own].name;
            const size_t length = strlen(name); // a backslash at the end of a line would join it to the next one
            fprintf(out, "usemtl %s%s\n", name, length > 0 && name[length - 1] == '\\' ? " " : "");
        }
        material = own;
        fputs("f", out);
        for (int k = 0; k < 3; k++) write_corner(out, surface, i + k);
        for (; looks->joined && i + 5 < surface->index_count && looks->joined[i / 3 + 1]; i += 3)
            write_corner(out, surface, i + 5); // a polygon is a fan: each further triangle adds its last corner
        fputc('\n', out);
    }
    return file_output_commit(&output, error);
}
