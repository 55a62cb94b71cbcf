/// Measures and frees surfaces; builds them vertex by vertex and polygon by polygon from files: OBJ with its materials, PLY, STL, OFF and glTF;
/// and writes OBJ files.
#include "model/surface.h"
#include "base/file.h"
#include "base/names.h"
#include "base/need.h"
#include "base/npy.h"
#include "base/png.h"
#include "base/progress.h"
#include "model/adjacency.h"
#include "model/gltf.h"
#include "model/vector.h"
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

uint8_t *surface_used_vertices(const struct surface *surface)
{
    uint8_t *used = need_zeroed((size_t)surface->vertex_count + 1, 1);
    for (int i = 0; i < surface->index_count; i++) used[surface->indices[i]] = 1;
    return used;
}

void surface_bounds(const struct surface *surface, double lo[3], double hi[3])
{
    for (int c = 0; c < 3; c++) {
        lo[c] = INFINITY;
        hi[c] = -INFINITY;
    }
    for (int i = 0; i < surface->index_count; i++) {
        const float *p = surface->position[surface->indices[i]];
        for (int c = 0; c < 3; c++) {
            lo[c] = fmin(lo[c], (double)p[c]);
            hi[c] = fmax(hi[c], (double)p[c]);
        }
    }
}

void surface_free(struct surface *surface)
{
    free(surface->position);
    free(surface->color);
    free(surface->indices);
    looks_free(&surface->looks);
    *surface = (struct surface){0};
}

const char *looks_image_kind(const unsigned char *bytes, size_t size)
{
    if (size > 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0) return "png";
    return size > 3 && memcmp(bytes, "\xFF\xD8\xFF", 3) == 0 ? "jpeg" : NULL;
}

/// Bytes of all its pictures.
static size_t looks_image_bytes(const struct looks *looks)
{
    size_t sum = 0;
    for (int m = 0; m < looks->material_count; m++) sum += looks->materials[m].image_size;
    return sum;
}

void looks_free(struct looks *looks)
{
    for (int m = 0; m < looks->material_count; m++) {
        free(looks->materials[m].name);
        free(looks->materials[m].image);
    }
    free(looks->materials);
    free(looks->uv);
    free(looks->corner);
    free(looks->material);
    free(looks->joined);
    free(looks->left_out);
    *looks = (struct looks){0};
}

// --- a surface that grows while a file is read

/// All zero but `surface` and `material`, LOOKS_NONE, at first.
struct surface_builder {
    struct surface *surface;                                                     ///< an empty one at first
    uint32_t material;                                                           ///< of the next triangles
    int vertices, colors, uvs, indices, corners, materials_of, joins, materials; ///< there is room for
    int polygon;                                                                 ///< corners of the open one
    uint32_t first[2], last[2]; ///< its first and its newest corner: vertex, texture coordinates
    bool begun;                 ///< the open one has a triangle
    bool is_flat;               ///< a triangle was left out
    bool failed;                ///< memory ran short and something is missing; stays set
};

enum { COUNT_LIMIT = 1 << 28, COLOR_LIMIT = 1000 };

/// array[count] = *value, in an array that grows. The caller counts. After running out of memory nothing is added.
static bool put(struct surface_builder *b, void *array, int count, int *capacity, const void *value, size_t size)
{
    char *block;
    if (b->failed) return false;
    memcpy(&block, array, sizeof block);
    if (count == *capacity) {
        const int wanted = *capacity ? 2 * *capacity : 256;
        block = count < COUNT_LIMIT ? realloc(block, size * (size_t)wanted) : NULL;
        b->failed = !block;
        if (b->failed) return false;
        *capacity = wanted;
        memcpy(array, &block, sizeof block);
    }
    memcpy(block + (size_t)count * size, value, size);
    return true;
}

/// Colours the newest vertex; those before the first coloured one become white, and so do later ones without.
static void builder_linear_color(struct surface_builder *b, const float rgb[3])
{
    static const float white[3] = {1, 1, 1};
    struct surface *s = b->surface;
    if (s->vertex_count == 0) return;
    for (int i = s->color ? s->vertex_count - 1 : 0; i < s->vertex_count; i++) {
        const float *color = i + 1 < s->vertex_count ? white : rgb;
        if (!put(b, &s->color, i, &b->colors, color, sizeof *s->color)) return;
    }
}

/// Colours the newest vertex, sRGB. Returns the first number that is far outside the range of colours (0 … 1), which could not be written and
/// read again; else NULL.
static const double *builder_color(struct surface_builder *b, const double srgb[3])
{
    float rgb[3];
    for (int k = 0; k < 3; k++) {
        if (!(fabs(srgb[k]) <= COLOR_LIMIT)) return &srgb[k];
        rgb[k] = srgb_to_linear((float)srgb[k]);
    }
    builder_linear_color(b, rgb);
    return NULL;
}

static void builder_vertex(struct surface_builder *b, const double position[3])
{
    static const float white[3] = {1, 1, 1};
    struct surface *s = b->surface;
    const float p[3] = {(float)position[0], (float)position[1], (float)position[2]};
    if (!put(b, &s->position, s->vertex_count, &b->vertices, p, sizeof p)) return;
    s->vertex_count++;
    if (s->color) builder_linear_color(b, white);
}

static void builder_uv(struct surface_builder *b, double u, double v)
{
    struct looks *looks = &b->surface->looks;
    const float uv[2] = {(float)u, (float)v};
    if (put(b, &looks->uv, looks->uv_count, &b->uvs, uv, sizeof uv)) looks->uv_count++;
}

/// The next corner of the open polygon, which becomes a fan of triangles. `uv` may be LOOKS_NONE. A triangle that names a vertex twice is left
/// out.
static void builder_corner(struct surface_builder *b, uint32_t vertex, uint32_t uv)
{
    const uint32_t corner[2] = {vertex, uv}, *const corners[3] = {b->first, b->last, corner};
    struct surface *s = b->surface;
    struct looks *looks = &s->looks;
    const int n = s->index_count;
    if (b->polygon >= 2 && triangle_repeats((const uint32_t[]){b->first[0], b->last[0], vertex})) {
        b->is_flat = true;
    } else if (b->polygon >=
               2) { // behind one that was left out it is a fan of its own, unless that was its last corner
        const uint8_t joined = b->begun && b->last[0] == s->indices[n - 1] && b->last[1] == looks->corner[n - 1];
        bool added = put(b, &looks->material, n / 3, &b->materials_of, &b->material, sizeof b->material) &&
                     put(b, &looks->joined, n / 3, &b->joins, &joined, sizeof joined);
        for (int k = 0; k < 3; k++) {
            added = added && put(b, &s->indices, n + k, &b->indices, corners[k], sizeof(uint32_t)) &&
                    put(b, &looks->corner, n + k, &b->corners, corners[k] + 1, sizeof(uint32_t));
        }
        if (added) s->index_count += 3;
        b->begun = true;
    }
    memcpy(b->polygon ? b->last : b->first, corner, sizeof corner);
    b->polygon++;
}

/// Closes the polygon and returns how many corners it had.
static int builder_end_polygon(struct surface_builder *b)
{
    const int corners = b->polygon;
    b->polygon = 0;
    b->begun = false;
    return corners;
}

/// The material of that name; a new one is white.
static uint32_t builder_material(struct surface_builder *b, const char *name)
{
    struct looks *looks = &b->surface->looks;
    const struct looks_material material = {.name = name_from(name, strlen(name)), .color = {1, 1, 1, 1}};
    int m = 0;
    while (m < looks->material_count && strcmp(looks->materials[m].name, material.name) != 0) m++;
    if (m == looks->material_count &&
        put(b, &looks->materials, looks->material_count, &b->materials, &material, sizeof material))
        return (uint32_t)looks->material_count++;
    free(material.name);
    b->failed |= m == looks->material_count;
    return b->failed ? LOOKS_NONE : (uint32_t)m;
}

/// Makes triangles of vertices, three each, and merges those at the same place.
static void builder_merge(struct surface_builder *b)
{
    struct surface *s = b->surface;
    const uint32_t count = (uint32_t)s->vertex_count;
    struct pool work = {0};
    struct spot *spots = pool_take(&work, count, sizeof *spots);
    uint32_t *name =
        pool_take(&work, count, sizeof *name); // first the earliest at its place, then that one's new number
    spots_sort((const float(*)[3])s->position, s->vertex_count, spots);
    spots_first(spots, s->vertex_count, name);
    s->vertex_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        const bool is_first = name[i] == i;
        if (is_first) memmove(s->position[s->vertex_count], s->position[i], sizeof *s->position);
        name[i] = is_first ? (uint32_t)s->vertex_count++ : name[name[i]];
        builder_corner(b, name[i], LOOKS_NONE);
        if (i % 3 == 2) builder_end_polygon(b);
    }
    pool_free(&work);
}

/// Drops texture coordinates without corners, and materials without triangles. Fails if no vertices or no
/// triangles remain; `kind` is for the message, as in "a PLY file". On failure the surface is empty.
static bool builder_finish(struct surface_builder *b, const char *path, const char *kind, struct error *error)
{
    struct surface *s = b->surface;
    struct looks *looks = &s->looks;
    const char *missing = s->vertex_count == 0 ? "vertices" : s->index_count == 0 && !b->is_flat ? "faces" : NULL;
    bool textured = false;
    if (b->failed || missing || s->index_count == 0) {
        surface_free(s);
        if (b->failed) return fail_no_memory(error, path);
        if (missing) return fail(error, ERROR_INPUT, "%s: expected %s with %s, got none", path, kind, missing);
        return fail(error, ERROR_INPUT, "%s: expected %s with faces of three different vertices, got others alone",
                    path, kind);
    }

    for (int i = 0; i < s->index_count; i++) textured = textured || looks->corner[i] != LOOKS_NONE;
    if (!textured) {
        free(looks->uv);
        free(looks->corner);
        looks->uv = NULL;
        looks->corner = NULL;
        looks->uv_count = 0;
    }
    bool dressed = false, polygons = false;
    for (int t = 0; t < s->index_count / 3; t++) {
        dressed = dressed || looks->material[t] < (uint32_t)looks->material_count;
        polygons = polygons || looks->joined[t];
    }
    if (!dressed) {
        free(looks->material);
        looks->material = NULL;
    }
    if (!polygons) {
        free(looks->joined);
        looks->joined = NULL;
    }
    return true;
}

// --- the words of a text

struct words {
    const char *path;
    char *at;         ///< ends in a NUL
    const char *end;  ///< where that NUL is
    int line;         ///< from 1
    const char *over; ///< what an error says where no word follows
    struct error *error;
};

enum { SHOWN_MAX = 24 };

static void words_skip(struct words *w) { w->at += strcspn(w->at, " \t\r\n"); }
static void words_skip_line(struct words *w) { w->at += strcspn(w->at, "\n"); }

/// Goes to the next word, past comments from "#" to the end of a line; false at the end of the text.
static bool words_more(struct words *w)
{
    for (;; w->at++) {
        if (*w->at == '#') words_skip_line(w);
        if (!*w->at) return false;
        if (*w->at == '\n') w->line++;
        if (!strchr(" \t\r\n\f\v", *w->at)) return true;
    }
}

/// "file:line: expected …, got …"
static bool words_expected(struct words *w, const char *what)
{
    if (!words_more(w))
        return fail(w->error, ERROR_INPUT, "%s:%d: expected %s, got %s", w->path, w->line, what, w->over);
    int shown = (int)strcspn(w->at, " \t\r\n");
    if (shown > SHOWN_MAX) shown = SHOWN_MAX;
    return fail(w->error, ERROR_INPUT, "%s:%d: expected %s, got '%.*s'", w->path, w->line, what, shown, w->at);
}

/// Takes the next word if it is this one, in capitals or not.
static bool words_take(struct words *w, const char *word)
{
    const size_t length = strlen(word);
    if (!words_more(w) || strncasecmp(w->at, word, length) != 0 || !strchr(" \t\r\n", w->at[length])) return false;
    w->at += length;
    return true;
}

static bool words_number(struct words *w, const char *what, double *number)
{
    if (!words_more(w)) return words_expected(w, what);
    char *end;
    *number = strtod(w->at, &end);
    if (end == w->at || !strchr(" \t\r\n", *end) || !isfinite((float)*number)) return words_expected(w, what);
    w->at = end;
    return true;
}

static bool words_integer(struct words *w, const char *what, long least, long most, long *number)
{
    if (!words_more(w)) return words_expected(w, what);
    char *end;
    *number = strtol(w->at, &end, 10);
    if (end == w->at || !strchr(" \t\r\n", *end) || *number < least || *number > most) return words_expected(w, what);
    w->at = end;
    return true;
}

// --- OBJ, and the materials that it names

enum { TEXT_LIMIT = 16 << 20, LIBRARY_NAME = 256 };
enum { TELLING = 1 << 16 }; ///< lines between two progress reports

/// Lets the words be those of the line at `next`, and goes to the one after it; false at the end of the text. The line ends with a NUL,
/// without its comment. `joins`: a line that ends in a backslash continues on the next.
static bool obj_next_line(struct words *w, char **next, bool joins)
{
    if (!**next) return false;
    char *const line = w->at = *next;
    w->line++;
    for (char *end = line;; end++) {
        end += strcspn(end, "\n");
        *next = *end ? end + 1 : end;
        char *last = end > line && end[-1] == '\r' ? end - 1 : end;
        bool joined = joins && *end && last > line && last[-1] == '\\';
        if (!joined) {
            *end = '\0';
            break;
        }
        memset(last - 1, ' ', (size_t)(end - last) + 2);
        w->line++;
    }
    line[strcspn(line, "#")] = '\0';
    return true;
}

/// The rest of a line: a name, possibly with spaces.
static char *obj_name(struct words *w)
{
    words_more(w);
    size_t length = strlen(w->at);
    while (length > 0 && strchr(" \t\r", w->at[length - 1])) w->at[--length] = '\0';
    return w->at;
}

static void obj_note(struct looks *looks, const char *name)
{
    if (!looks->left_out) looks->left_out = strdup(name);
}

/// The path of a file named in another one's folder; '\\' separates folders, too.
static bool obj_read_beside(const char *path, const char *name, size_t limit, char **data, size_t *size)
{
    char folder[PATH_LIMIT], plain[PATH_LIMIT], place[PATH_LIMIT];
    if (snprintf(plain, sizeof plain, "%s", name) >= (int)sizeof plain || !path_folder(path, folder)) return false;
    for (char *c = plain; *c; c++) {
        if (*c == '\\') *c = '/';
    }
    return path_resolve(folder, plain, place) && file_read_text(place, limit, data, size, NULL);
}

static bool obj_in_range(const char *text, float *value)
{
    const float number = strtof(text, NULL);
    if (!(number >= 0 && number <= 1)) return false;
    *value = number;
    return true;
}

/// Adds the materials of a file in an OBJ file's folder. Unreadable pictures, and those neither PNG nor JPEG, are left out and noted in the
/// looks.
static void obj_read_materials(const char *obj_path, const char *name, struct surface_builder *builder)
{
    struct looks *looks = &builder->surface->looks;
    uint32_t current = LOOKS_NONE;
    struct words words = {0}, *const w = &words;
    char *text = NULL, *next;
    size_t size;
    if (!obj_read_beside(obj_path, name, TEXT_LIMIT, &text, &size)) {
        obj_note(looks, name);
        return;
    }
    for (next = text; obj_next_line(w, &next, false);) {
        if (words_take(w, "newmtl")) current = builder_material(builder, obj_name(w));
        if (current == LOOKS_NONE) continue;
        struct looks_material *material = &looks->materials[current];
        if (words_take(w, "Kd")) {
            for (int k = 0; k < 3; k++) obj_in_range(w->at, &material->color[k]), strtof(w->at, &w->at);
        } else if (words_take(w, "d")) {
            obj_in_range(w->at, &material->color[3]);
        } else if (words_take(w, "Tr")) {
            if (obj_in_range(w->at, &material->color[3])) material->color[3] = 1 - material->color[3];
        } else if (words_take(w, "map_Kd") && !material->image) {
            const char *picture = obj_name(w); // behind options, each followed by numbers or on/off
            while (*picture == '-' && strchr(picture, ' ')) {
                picture += strcspn(picture, " \t");
                for (picture += strspn(picture, " \t"); *picture;) {
                    const size_t length = strcspn(picture, " \t");
                    const bool word = strncmp(picture, "on", length) == 0 || strncmp(picture, "off", length) == 0;
                    char *end;
                    strtod(picture, &end);
                    if (!word && end != picture + length) break;
                    picture += length;
                    picture += strspn(picture, " \t");
                }
            }
            char *data = NULL;
            const size_t room = LOOKS_IMAGES_LIMIT - looks_image_bytes(looks);
            if (obj_read_beside(obj_path, picture, room, &data, &size) &&
                looks_image_kind((unsigned char *)data, size)) {
                material->image = (unsigned char *)data;
                material->image_size = size;
            } else {
                free(data);
                obj_note(looks, picture);
            }
        }
    }
    free(text);
}

/// Up to `count` numbers; returns how many the line has, -1 if a word is not a number.
static int obj_read_numbers(struct words *w, double *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        if (!words_more(w)) return i;
        if (!words_number(w, "a finite number", &numbers[i])) return -1;
    }
    return count;
}

static bool obj_read(struct words *w, struct surface_builder *builder)
{
    const char *text = w->at;
    char *next = w->at;
    const long size = w->end - text;
    w->line = 0;
    w->over = "nothing"; // on its line
    if (memchr(text, '\0', (size_t)size))
        return fail(w->error, ERROR_INPUT, "%s: expected the text of an OBJ file, got binary data", w->path);
    while (!builder->failed && obj_next_line(w, &next, true)) {
        if (w->line % TELLING == 0) progress_report("reading the mesh", next - text, size);
        if (words_take(w, "v")) {
            double numbers[6]; // x y z [w | r g b]
            const int count = obj_read_numbers(w, numbers, 6);
            if (count < 0) return false;
            if (count < 3) return words_expected(w, "three coordinates of a vertex");
            builder_vertex(builder, numbers);
            const double *wrong = count == 6 ? builder_color(builder, numbers + 3) : NULL;
            if (wrong)
                return fail(w->error, ERROR_INPUT, "%s:%d: expected a colour from 0 to 1, got %g", w->path, w->line,
                            *wrong);
        } else if (words_take(w, "vt")) { // u [v [w]], from the lower left of the picture
            double numbers[2] = {0};
            if (obj_read_numbers(w, numbers, 2) < 0) return false;
            builder_uv(builder, numbers[0], 1 - numbers[1]);
        } else if (words_take(w, "f")) { // a b c d … as the fan abc, acd, …
            while (words_more(w)) { // v, v/vt, v//vn or v/vt/vn, counted from 1 or backwards from -1 (the newest)
                char *end;
                const int vertices = builder->surface->vertex_count, uvs = builder->surface->looks.uv_count;
                long index = strtol(w->at, &end, 10);
                if (index < 0) index += vertices + 1;
                const bool written = end > w->at && (*end == '/' || strchr(" \t\r", *end));
                if (!written || index < 1 || index > INT_MAX) return words_expected(w, "the number of a vertex");
                char what[64];
                snprintf(what, sizeof what, "a vertex from 1 to %d", vertices);
                if (index > vertices) return words_expected(w, what);
                long uv = *end == '/' && end[1] != '/' ? strtol(end + 1, NULL, 10) : 0;
                if (uv < 0) uv += uvs + 1;
                builder_corner(builder, (uint32_t)index - 1, uv >= 1 && uv <= uvs ? (uint32_t)uv - 1 : LOOKS_NONE);
                words_skip(w);
            }
            const int count = builder_end_polygon(builder);
            if (count < 3)
                return fail(w->error, ERROR_INPUT, "%s:%d: expected a face of three corners or more, got %d", w->path,
                            w->line, count);
        } else if (words_take(w, "usemtl")) {
            builder->material = builder_material(builder, obj_name(w));
        } else if (words_take(w, "mtllib")) {
            obj_read_materials(w->path, obj_name(w), builder);
        }
    }
    return true;
}

/// "folder/up.rest.obj" → "folder/up.rest" and the ending; false where that is too long.
static bool obj_name_beside(const char *obj_path, const char *ending, char path[PATH_LIMIT])
{
    const int stem = (int)strlen(obj_path) - (path_has_end(obj_path, ".obj") ? 4 : 0);
    return snprintf(path, PATH_LIMIT, "%.*s%s", stem, obj_path, ending) < PATH_LIMIT;
}

static void obj_write_corner(FILE *out, const struct surface *s, int index)
{
    fprintf(out, " %u", s->indices[index] + 1);
    if (s->looks.corner && s->looks.corner[index] != LOOKS_NONE) fprintf(out, "/%u", s->looks.corner[index] + 1);
}

bool obj_write(const char *path, const struct surface *surface, struct error *error)
{
    const struct looks *looks = &surface->looks;
    struct file_output output;
    char library[PATH_LIMIT] = "";
    if (looks->material) { // materials and pictures are files beside it
        if (!obj_name_beside(path, ".mtl", library) || strlen(path_name(library)) >= LIBRARY_NAME)
            return fail(error, ERROR_INPUT, "%s: the name is too long", path);
        if (!file_output_open(&output, library, error)) return false;
        for (int m = 0; m < looks->material_count; m++) {
            const struct looks_material *material = &looks->materials[m];
            const float *c = material->color;
            fprintf(output.stream, "newmtl %s\nKd %.9g %.9g %.9g\nd %.9g\n", material->name, (double)c[0],
                    (double)c[1], (double)c[2], (double)c[3]);
            if (!material->image) continue;
            char ending[32], picture[PATH_LIMIT];
            const char *kind = looks_image_kind(material->image, material->image_size);
            snprintf(ending, sizeof ending, "-%d.%s", m + 1, kind && *kind == 'j' ? "jpg" : "png");
            const bool named =
                obj_name_beside(path, ending, picture) || fail(error, ERROR_INPUT, "%s: the name is too long", path);
            if (!named || !file_write_atomic(picture, material->image, material->image_size, error)) {
                file_output_discard(&output);
                return false;
            }
            fprintf(output.stream, "map_Kd %s\n", path_name(picture));
        }
        if (!file_output_commit(&output, error)) return false;
    }
    if (!file_output_open(&output, path, error)) return false;
    FILE *out = output.stream;
    if (looks->material) fprintf(out, "mtllib %s\n", path_name(library));
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
        for (int k = 0; k < 3; k++) obj_write_corner(out, surface, i + k);
        for (; looks->joined && i + 5 < surface->index_count && looks->joined[i / 3 + 1]; i += 3)
            obj_write_corner(out, surface, i + 5); // a polygon is a fan: each further triangle adds its last corner
        fputc('\n', out);
    }
    return file_output_commit(&output, error);
}

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
    bool textured;     ///< all vertices have texture coordinates
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

/// Names of properties that different programs write.
static const char *const roles[ROLES][3] = {[X] = {"x"},
                                            [Y] = {"y"},
                                            [Z] = {"z"},
                                            [RED] = {"red", "diffuse_red"},
                                            [GREEN] = {"green", "diffuse_green"},
                                            [BLUE] = {"blue", "diffuse_blue"},
                                            [U] = {"s", "u", "texture_u"},
                                            [V] = {"t", "v", "texture_v"}};

static bool ply_read_type(struct words *w, enum number_type *type)
{
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        *type = types[i].type;
        if (words_take(w, types[i].name)) return true;
    }
    return words_expected(w, "a type of numbers");
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

static bool ply_read_one(struct ply *ply, const struct element *e)
{
    struct words *w = ply->words;
    struct surface_builder *b = ply->builder;
    double values[ROLES] = {0}, number;
    for (int i = 0; i < e->property_count; i++) {
        const struct property *p = &e->properties[i];
        if (!p->count_type) {
            if (!ply_read_number(ply, p->type, p->role != OTHER, &number)) return false;
            const double largest = p->type == NUMBER_UINT8 ? 255 : p->type == NUMBER_UINT16 ? 65535 : 1;
            const bool color = p->role >= RED && p->role <= BLUE;
            if (p->role < ROLES) values[p->role] = color ? number / largest : number;
            continue;
        }
        uint32_t last[2] = {0}; // the newest corners of a triangle strip
        int strip = 0;          // and how many it has
        double length;
        if (!ply_read_number(ply, p->count_type, true, &length)) return false;
        if (length < 0)
            return fail(w->error, ERROR_INPUT, "%s: expected the length of a list, got %g", w->path, length);
        for (double n = 0; n < length && !b->failed; n++) {
            if (!ply_read_number(ply, p->type, p->role != OTHER, &number)) return false;
            if (p->role != CORNERS && p->role != STRIPS) continue;
            const bool ends = p->role == STRIPS && number < 0;
            if (!ends && !(number >= 0 && number < (double)ply->vertex_count && number == floor(number)))
                return fail(w->error, ERROR_INPUT, "%s: expected a vertex from 0 to %ld, got %g", w->path,
                            ply->vertex_count - 1, number);
            const uint32_t vertex = ends ? 0 : (uint32_t)number;
            if (p->role == CORNERS) {
                builder_corner(b, vertex, ply->textured ? vertex : LOOKS_NONE);
                continue;
            }
            if (!ends && strip >= 2) { // the triangle that ends at this corner
                builder_corner(b, last[strip % 2], LOOKS_NONE);
                builder_corner(b, last[strip % 2 == 0], LOOKS_NONE);
                builder_corner(b, vertex, LOOKS_NONE);
                builder_end_polygon(b);
            }
            last[0] = last[1];
            last[1] = vertex;
            strip = ends ? 0 : strip + 1;
        }
        if (p->role == CORNERS) builder_end_polygon(b);
    }
    if (!e->vertices) return true;
    builder_vertex(b, values + X);
    if (e->has[RED] && e->has[GREEN] && e->has[BLUE]) {
        const double *wrong = builder_color(b, values + RED);
        if (wrong)
            return fail(w->error, ERROR_INPUT, "%s: vertex %d: expected a colour from 0 to 1, got %g", w->path,
                        b->surface->vertex_count, *wrong);
    }
    if (ply->textured) builder_uv(b, values[U], 1 - values[V]);
    return true;
}

static bool ply_read(struct words *w, struct surface_builder *builder)
{
    struct ply ply = {.words = w, .builder = builder};
    static const char *const formats[] = {
        [TEXT] = "ascii", [LITTLE] = "binary_little_endian", [BIG] = "binary_big_endian"};
    if (!words_take(w, "ply"))
        return fail(w->error, ERROR_INPUT, "%s: expected a PLY file, got something else", w->path);
    while (!words_take(w, "end_header")) {
        if (words_take(w, "format")) {
            int f = 0;
            while (f < 3 && !words_take(w, formats[f])) f++;
            ply.format = (enum format)f;
            if (f == 3) return words_expected(w, "ascii, binary_little_endian or binary_big_endian");
            words_skip_line(w);
            continue;
        }
        if (!words_take(w, "element")) {
            if (!words_more(w)) return words_expected(w, "a header that ends in end_header");
            words_skip_line(w); // a comment, or another program's line without that word
            continue;
        }
        if (ply.element_count == ELEMENTS_MAX) return words_expected(w, "at most 16 elements");
        struct element *e = &ply.elements[ply.element_count++];
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
            } else {
                struct property *p = &e->properties[e->property_count];
                if (e->property_count == PROPERTIES_MAX) return words_expected(w, "at most 64 properties");
                *p = (struct property){0};
                const bool list = words_take(w, "list");
                if ((list && !ply_read_type(w, &p->count_type)) || !ply_read_type(w, &p->type)) return false;
                if (!e->vertices && list && (words_take(w, "vertex_indices") || words_take(w, "vertex_index")))
                    p->role = CORNERS;
                for (int i = 0; e->vertices && !list && p->role == OTHER && i < 3 * ROLES; i++) {
                    if (roles[i / 3][i % 3] && words_take(w, roles[i / 3][i % 3])) p->role = (enum role)(i / 3);
                }
                if (p->role < ROLES) e->has[p->role] = true;
                if (p->role == OTHER) words_skip_line(w); // its name
                e->property_count++;
            }
        }
        for (int i = 0; strips && i < e->property_count; i++) {
            if (e->properties[i].role == CORNERS) e->properties[i].role = STRIPS;
        }
        if (e->vertices && !(e->has[X] && e->has[Y] && e->has[Z]))
            return fail(w->error, ERROR_INPUT, "%s: expected vertices with x, y and z, got others", w->path);
    }
    words_skip_line(w);
    if (*w->at == '\n') w->at++;
    w->line++;
    for (int i = 0; i < ply.element_count; i++) {
        const struct element *e = &ply.elements[i];
        if (!e->vertices) continue;
        ply.textured = (ply.textured || ply.vertex_count == 0) && e->has[U] && e->has[V];
        ply.vertex_count += e->count;
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

static bool stl_read(struct words *w, struct surface_builder *b)
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
    double p[3];
    int corners = 0; // of the facet
    // facet normal … outer loop vertex x y z ×3 endloop endfacet, in capitals or not; "end loop" in two words, too. Only vertices and ends
    // of facets matter.
    while (text && words_more(w) && !b->failed) {
        const bool ends = words_take(w, "end");
        if (!ends && words_take(w, "vertex")) {
            for (int k = 0; k < 3; k++) {
                if (!words_number(w, "three coordinates of a vertex", &p[k])) return false;
            }
            builder_vertex(b, p);
            corners++;
        } else if (words_take(w, "endfacet") || (ends && words_take(w, "facet"))) {
            if (corners != 3)
                return fail(w->error, ERROR_INPUT, "%s:%d: expected a facet of three vertices, got %d", w->path,
                            w->line, corners);
            corners = 0;
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
    if (corners > 0) return words_expected(w, "endfacet");
    for (uint32_t i = 0; !text && i < count && !b->failed; i++) {
        for (int corner = 0; corner < 3; corner++) {
            const char *at = w->at + HEAD + (size_t)i * FACET + CORNERS_AT + 12 * corner;
            for (int k = 0; k < 3; k++) {
                p[k] = number_read(at + 4 * k, NUMBER_FLOAT32, false);
                if (!isfinite(p[k]))
                    return fail(w->error, ERROR_INPUT, "%s: facet %u: expected finite numbers, got NaN or infinity",
                                w->path, i);
            }
            builder_vertex(b, p);
        }
    }
    if (!b->failed) builder_merge(b);
    return true;
}

// --- OFF: text, with optional colours (C), normals (N) and texture coordinates (ST) at vertices

enum { NUMBERS_MAX = 16 };

static bool off_read(struct words *w, struct surface_builder *b)
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
        !words_integer(w, "the number of faces", 0, INT_MAX, &faces))
        return false;
    // Some programs leave out the number of edges: then the next line is the first vertex, of three numbers or more.
    struct words ahead = *w;
    const bool is_next_line = words_more(&ahead) && ahead.line != w->line;
    const int line = ahead.line;
    words_skip(&ahead);
    const bool has_edges = !is_next_line || !words_more(&ahead) || ahead.line != line;
    if (has_edges && !words_integer(w, "the number of edges", 0, LONG_MAX, &edges)) return false;

    // x y z [nx ny nz] [r g b a] [s t]; colours are 0 … 1, or 0 … 255.
    const int color = normals ? 6 : 3, uv = color + (colors ? 4 : 0), count = uv + (uvs ? 2 : 0);
    for (long i = 0; i < vertices && !b->failed; i++) {
        double numbers[NUMBERS_MAX] = {0}, *rgb = numbers + color;
        for (int k = 0; k < count; k++) {
            if (!words_number(w, "a coordinate of a vertex", &numbers[k])) return false;
        }
        builder_vertex(b, numbers);
        if (colors) {
            const bool bytes = rgb[0] > 1 || rgb[1] > 1 || rgb[2] > 1;
            for (int k = 0; k < 3; k++) rgb[k] = rgb[k] / (bytes ? 255 : 1);
            const double *wrong = builder_color(b, rgb);
            if (wrong)
                return fail(w->error, ERROR_INPUT, "%s:%d: expected a colour from 0 to 1, or to 255, got %g", w->path,
                            w->line, *wrong * (bytes ? 255 : 1));
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

// --- glTF

/// Adds a part of a mesh with its vertices at these places (NULL: its first part has them), its material and its PNG or JPEG picture.
/// `every_uv`: each vertex gets texture coordinates.
static void gltf_add_part(struct surface_builder *b, const struct gltf *gltf, const struct gltf_part *part,
                          const float (*position)[3], bool every_uv)
{
    struct surface *s = b->surface;
    const uint32_t first = position ? (uint32_t)s->vertex_count : 0;
    const uint32_t first_uv = position ? (uint32_t)s->looks.uv_count : 0;
    b->material = LOOKS_NONE;
    if (part->material >= 0) {
        const struct gltf_material *material = &gltf->materials[part->material];
        const struct gltf_image *image = material->image >= 0 ? &gltf->images[material->image] : NULL;
        b->material = builder_material(b, material->name);
        if (b->failed) return;
        struct looks_material *look = &s->looks.materials[b->material];
        for (int k = 0; k < 4; k++) look->color[k] = glm_clamp(material->color[k], 0, 1);
        const bool fits = image && looks_image_bytes(&s->looks) + image->size <= LOOKS_IMAGES_LIMIT;
        if (!look->image && fits && looks_image_kind(image->bytes, image->size)) {
            look->image = malloc(image->size);
            b->failed = !look->image;
            if (b->failed) return;
            memcpy(look->image, image->bytes, image->size);
            look->image_size = image->size;
        }
    }
    for (int i = 0; position && i < part->vertex_count && !b->failed; i++) {
        const float *at = position[i];
        builder_vertex(b, (const double[]){(double)at[0], (double)at[1], (double)at[2]});
        if (part->color) {
            float rgb[3];
            for (int k = 0; k < 3; k++) rgb[k] = glm_clamp(part->color[i][k], 0, 1);
            builder_linear_color(b, rgb);
        }
        if (part->uv) {
            builder_uv(b, (double)part->uv[i][0], (double)part->uv[i][1]);
        } else if (every_uv) {
            builder_uv(b, 0, 0);
        }
    }
    for (int i = 0; i + 2 < part->index_count && !b->failed; i += 3) {
        const uint32_t *corner = part->indices + i;
        const bool joined = gltf_joins(part, i);
        if (!joined) builder_end_polygon(b);
        for (int k = joined ? 2 : 0; k < 3; k++)
            builder_corner(b, first + corner[k], part->uv || every_uv ? first_uv + corner[k] : LOOKS_NONE);
    }
    builder_end_polygon(b);
}

bool surface_of_mesh(const struct gltf *gltf, const struct gltf_mesh *mesh, struct surface *surface)
{
    struct surface_builder b = {.surface = surface};
    bool has_uv = false;
    for (int p = 0; p < mesh->part_count; p++) has_uv = has_uv || mesh->parts[p].uv;
    for (int p = 0; p < mesh->part_count; p++) {
        const struct gltf_part *part = &mesh->parts[p];
        gltf_add_part(&b, gltf, part, part->shared ? NULL : (const float(*)[3])part->position, has_uv);
    }
    const bool done = builder_finish(&b, gltf->path, "a glTF file", NULL);
    free(surface->looks.corner); // each vertex has those of its number
    surface->looks.corner = NULL;
    return done;
}

/// All that a file shows, at rest. It opens the file itself.
static bool gltf_surface_read(struct words *words, struct surface_builder *b)
{
    struct gltf gltf;
    struct gltf_pose pose;
    if (!gltf_read_stored(words->path, &gltf, words->error)) return false;
    b->failed = !gltf_pose_create(&gltf, &pose); // at rest
    for (int n = 0; !b->failed && n < gltf.node_count; n++) {
        const int count = gltf_vertex_count(&gltf, n);
        if (count == 0) continue;
        float(*position)[3] = malloc((size_t)count * sizeof *position);
        b->failed = !position;
        if (b->failed) break;
        gltf_pose_vertices(&gltf, &pose, n, position, NULL);
        const struct gltf_mesh *mesh = &gltf.meshes[gltf.nodes[n].mesh];
        for (int p = 0, next = 0; p < mesh->part_count && !b->failed; next += mesh->parts[p++].vertex_count)
            gltf_add_part(b, &gltf, &mesh->parts[p], (const float(*)[3])position + next, false);
        free(position);
    }
    gltf_pose_free(&pose);
    gltf_free(&gltf);
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
    struct words words = {.path = path, .line = 1, .over = "the end of the file", .error = error};
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
