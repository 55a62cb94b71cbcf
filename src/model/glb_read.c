/// Reads a character from a .glb file.
#include "model/character.h"
#include "model/glb_looks.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COUNT_LIMIT = 1 << 28, TRIANGLES = 4 };

/// The numbers of an accessor that must have this many components and, unless 0, this many elements.
static bool read_numbers(const struct glb *glb, int64_t accessor, int components, int count,
                         struct glb_numbers *numbers, struct error *error)
{
    if (!glb_numbers(glb, accessor, numbers, error)) return false;
    bool fits = numbers->components == components || (components == 3 && numbers->components == 4);
    if (fits && (count == 0 || numbers->count == count)) return true;
    fail(error, ERROR_INPUT, "%s: accessors[%lld]: expected %d elements of %d numbers, got %d of %d", glb->path,
         (long long)accessor, count ? count : numbers->count, components, numbers->count, numbers->components);
    free(numbers->values);
    return false;
}

static int64_t attribute(const json_t *primitive, const char *name)
{
    return glb_integer(json_object_get(primitive, "attributes"), name, -1);
}

/// Whether a primitive has the vertices of the first one, as ours with several materials do: then they are read once.
static bool shares(const json_t *primitives, size_t i)
{
    const json_t *first = json_array_get(primitives, 0), *other = json_array_get(primitives, i);
    return i > 0 && json_equal(json_object_get(first, "attributes"), json_object_get(other, "attributes")) &&
           json_equal(json_object_get(first, "targets"), json_object_get(other, "targets"));
}

static int64_t vertex_count_of(const struct glb *glb, const json_t *primitive)
{
    int64_t position = attribute(primitive, "POSITION");
    const json_t *accessors = json_object_get(glb->json, "accessors");
    return position >= 0 ? glb_integer(json_array_get(accessors, (size_t)position), "count", 0) : 0;
}

/// Reads x y z (of x y z w too) of each element into `vectors`.
static bool read_vectors(const struct glb *glb, int64_t accessor, int count, float (*vectors)[3], float sign,
                         struct error *error)
{
    struct glb_numbers numbers;
    if (!read_numbers(glb, accessor, 3, count, &numbers, error)) return false;
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) vectors[i][k] = sign * (float)numbers.values[i * numbers.components + k];
    }
    free(numbers.values);
    return true;
}

static bool read_colors(const struct glb *glb, const json_t *primitive, int count, float (*color)[3],
                        struct error *error)
{
    int64_t accessor = attribute(primitive, "COLOR_0");
    if (accessor >= 0) return read_vectors(glb, accessor, count, color, 1, error);
    for (int n = 0; n < 3 * count; n++) color[n / 3][n % 3] = 1;
    return true;
}

/// The triangles of a primitive whose vertices start at `base`; without indices they are in order. Those that name a vertex twice are left
/// out.
static bool read_indices(struct glb *glb, const json_t *primitive, int base, int count, struct surface *s,
                         struct error *error)
{
    struct glb_numbers numbers = {.count = count};
    int64_t accessor = glb_integer(primitive, "indices", -1);
    if (accessor >= 0 && !read_numbers(glb, accessor, 1, 0, &numbers, error)) return false;
    if (!glb_take_room(glb, (size_t)numbers.count, sizeof *s->indices, error)) {
        free(numbers.values);
        return false;
    }
    size_t total = (size_t)s->index_count + (size_t)numbers.count;
    uint32_t *larger = total <= COUNT_LIMIT ? realloc(s->indices, (total + 1) * sizeof *larger) : NULL;
    bool good = larger && numbers.count % 3 == 0;
    if (larger) s->indices = larger;
    for (int i = 0; good && i < numbers.count; i++) {
        double index = numbers.values ? numbers.values[i] : i;
        good = index >= 0 && index < count;
        if (good) s->indices[s->index_count++] = (uint32_t)base + (uint32_t)index;
        if (i % 3 == 2 && good && triangle_repeats(s->indices + s->index_count - 3)) s->index_count -= 3;
    }
    free(numbers.values);
    if (!larger) return fail_no_memory(error, glb->path);
    return good ||
           fail(error, ERROR_INPUT, "%s: accessors[%lld]: expected three vertices of %d a triangle, got others",
                glb->path, (long long)accessor, count);
}

static bool check_primitive(const struct glb *glb, const json_t *primitive, struct error *error)
{
    const json_t *extensions = json_object_get(primitive, "extensions");
    if (json_object_get(extensions, "KHR_draco_mesh_compression"))
        return fail(error, ERROR_INPUT, "%s: expected a mesh that is not compressed, got Draco", glb->path);
    if (glb_integer(primitive, "mode", TRIANGLES) != TRIANGLES)
        return fail(error, ERROR_INPUT, "%s: expected a mesh of triangles, got strips, lines or points", glb->path);
    if (vertex_count_of(glb, primitive) < 1)
        return fail(error, ERROR_INPUT, "%s: expected a mesh with positions, got none", glb->path);
    return glb_is_stored(glb, attribute(primitive, "POSITION")) ||
           fail(error, ERROR_INPUT, "%s: accessors[%lld]: expected positions that are in the file, got none",
                glb->path, (long long)attribute(primitive, "POSITION"));
}

/// The vertices of a primitive, unless it has those of the first, then its triangles and how they look.
static bool read_primitive(struct glb *glb, const json_t *primitive, bool shared, struct surface *s,
                           struct error *error)
{
    const int base = shared ? 0 : s->vertex_count, count = (int)vertex_count_of(glb, primitive);
    const struct glb_piece piece = {primitive, base, shared ? 0 : count, s->index_count};
    if (!shared) {
        if (!read_vectors(glb, attribute(primitive, "POSITION"), count, s->position + base, 1, error)) return false;
        if (!read_colors(glb, primitive, count, s->color + base, error)) return false;
        s->vertex_count += count;
    }
    return read_indices(glb, primitive, base, count, s, error) && glb_read_looks(glb, &piece, s, error);
}

/// All primitives of a mesh as one surface, with room for that many coordinates.
static bool read_surface(struct glb *glb, const json_t *primitives, int coordinates, struct surface *s,
                         struct error *error)
{
    int64_t total = 0;
    size_t i;
    const json_t *primitive;
    json_array_foreach(primitives, i, primitive)
    {
        if (!check_primitive(glb, primitive, error)) return false;
        if (!shares(primitives, i)) total += vertex_count_of(glb, primitive);
    }
    int64_t with_targets = total <= COUNT_LIMIT ? total * (1 + (int64_t)coordinates) : total;
    if (with_targets > COUNT_LIMIT)
        return fail(error, ERROR_INPUT, "%s: expected at most %d vertices with those of the coordinates, got %lld",
                    glb->path, COUNT_LIMIT, (long long)with_targets);
    if (!glb_take_room(glb, (size_t)with_targets, 2 * sizeof *s->position, error)) return false;
    if (!glb_read_materials(glb, &s->looks, error)) return false;
    s->looks.uv_count = (int)total;
    s->position = calloc((size_t)total, sizeof *s->position);
    s->color = calloc((size_t)total, sizeof *s->color);
    if (!s->position || !s->color) return fail_no_memory(error, glb->path);
    json_array_foreach(primitives, i, primitive)
    {
        if (!read_primitive(glb, primitive, shares(primitives, i), s, error)) return false;
    }
    if (s->index_count == 0)
        return fail(error, ERROR_INPUT, "%s: expected triangles of three different vertices, got others alone",
                    glb->path);
    if (!s->looks.uv) s->looks.uv_count = 0;
    looks_drop_unused(&s->looks, s->index_count / 3);
    return true;
}

/// Takes the file's normals if every primitive has them, else keeps the computed ones.
static bool read_normals(const struct glb *glb, const json_t *primitives, struct character *c, struct error *error)
{
    size_t i;
    const json_t *primitive;
    int base = 0;
    json_array_foreach(primitives, i, primitive)
    {
        if (shares(primitives, i)) continue;
        int count = (int)vertex_count_of(glb, primitive);
        int64_t accessor = attribute(primitive, "NORMAL");
        if (accessor >= 0 && !read_vectors(glb, accessor, count, c->normal + base, 1, error)) return false;
        base += count;
    }
    return true;
}

/// The target called `name` followed by `part`, or −1.
static int target_called(const json_t *names, const char *name, size_t length, const char *part)
{
    size_t i;
    const json_t *value;
    json_array_foreach(names, i, value)
    {
        const char *text = json_string_value(value);
        if (text && strlen(text) == length + strlen(part) && strncmp(text, name, length) == 0 &&
            strcmp(text + length, part) == 0)
            return (int)i;
    }
    return -1;
}

/// Whether target i is the real part of a coordinate, and which target is its imaginary part.
static bool is_coordinate(const json_t *names, size_t i, size_t *name_length, int *im)
{
    const char *name = json_string_value(json_array_get(names, i));
    size_t length = name ? strlen(name) : 0;
    if (length < 4 || strcmp(name + length - 3, ".re") != 0) return false;
    *name_length = length - 3;
    *im = target_called(names, name, length - 3, ".im");
    return *im >= 0;
}

static bool read_target(const struct glb *glb, const json_t *primitives, int target, float sign, float (*vectors)[3],
                        struct error *error)
{
    size_t i;
    const json_t *primitive;
    int base = 0;
    json_array_foreach(primitives, i, primitive)
    {
        if (shares(primitives, i)) continue;
        int count = (int)vertex_count_of(glb, primitive);
        const json_t *targets = json_object_get(primitive, "targets");
        int64_t accessor = glb_integer(json_array_get(targets, (size_t)target), "POSITION", -1);
        if (accessor >= 0 && !read_vectors(glb, accessor, count, vectors + base, sign, error)) return false;
        base += count;
    }
    return true;
}

static double real_of(const json_t *object, const char *key)
{
    return json_number_value(json_object_get(object, key));
}

/// An export scales the targets up so that weights stay within 0 … 1, and says by how much.
static void unscale(const json_t *known, int vertex_count, struct coordinate *c)
{
    const double scale = real_of(known, "scale");
    if (!(scale > 0)) return;
    for (int i = 0; i < vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            c->re[i][k] = (float)((double)c->re[i][k] / scale);
            c->im[i][k] = (float)((double)c->im[i][k] / scale);
        }
    }
}

/// What our extras say about a coordinate, else zeros.
static void read_extras(const json_t *extras, int vertex_count, struct coordinate *c)
{
    size_t i;
    const json_t *known;
    json_array_foreach(json_object_get(json_object_get(extras, "wiggly"), "coordinates"), i, known)
    {
        const char *name = json_string_value(json_object_get(known, "name"));
        if (!name || strcmp(name, c->name) != 0) continue;
        c->frequency = real_of(known, "frequency");
        c->damping = real_of(known, "damping");
        c->explained = real_of(known, "explained");
        c->pca1 = real_of(known, "pca1");
        c->pca2 = real_of(known, "pca2");
        unscale(known, vertex_count, c);
        return;
    }
}

static bool read_coordinates(const struct glb *glb, const json_t *mesh, struct character *c, struct error *error)
{
    const json_t *primitives = json_object_get(mesh, "primitives"), *extras = json_object_get(mesh, "extras");
    const json_t *names = json_object_get(extras, "targetNames");
    struct coordinate *coordinate = c->coordinates;
    for (size_t i = 0; i < json_array_size(names); i++) {
        size_t length;
        int im;
        if (!is_coordinate(names, i, &length, &im)) continue;
        coordinate->name = strndup(json_string_value(json_array_get(names, i)), length);
        if (!coordinate->name) return fail_no_memory(error, glb->path);
        if (!read_target(glb, primitives, (int)i, 1, coordinate->re, error)) return false;
        if (!read_target(glb, primitives, im, -1, coordinate->im, error)) return false;
        read_extras(extras, c->vertex_count, coordinate++);
    }
    return true;
}

/// The number of the first mesh with morph targets, else of the first with triangles, else −1.
static int64_t choose_mesh(const json_t *meshes)
{
    const json_t *mesh;
    int64_t first = -1;
    size_t i;
    json_array_foreach(meshes, i, mesh)
    {
        const json_t *primitives = json_object_get(mesh, "primitives");
        if (json_array_size(primitives) == 0) continue;
        if (json_array_size(json_object_get(json_array_get(primitives, 0), "targets")) > 0) return (int64_t)i;
        if (first < 0) first = (int64_t)i;
    }
    return first;
}

static void transform(const double m[16], double weight, float v[3])
{
    const double x = (double)v[0], y = (double)v[1], z = (double)v[2];
    for (int i = 0; i < 3; i++) v[i] = (float)(m[i] * x + m[4 + i] * y + m[8 + i] * z + m[12 + i] * weight);
}

/// The cofactors of the linear part, which turn normals whatever the scale; returns the determinant.
static double cofactors(const double m[16], double c[16])
{
    for (int n = 0; n < 16; n++) c[n] = 0;
    for (int n = 0; n < 9; n++) {
        int column = n / 3, row = n % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3, r1 = (row + 1) % 3;
        int r2 = (row + 2) % 3;
        c[4 * column + row] = m[4 * c1 + r1] * m[4 * c2 + r2] - m[4 * c2 + r1] * m[4 * c1 + r2];
    }
    return m[0] * c[0] + m[1] * c[1] + m[2] * c[2];
}

/// Puts a character where its node stands. A mirror turns the triangles round, and the normals with them.
static void place(struct character *c, const double matrix[16])
{
    double normal[16];
    bool mirrored = cofactors(matrix, normal) < 0;
    for (int i = 0; i < c->vertex_count; i++) {
        transform(matrix, 1, c->position[i]);
        transform(normal, 0, c->normal[i]);
        float *n = c->normal[i], length = glm_vec3_norm(n);
        if (length > 0) glm_vec3_divs(n, mirrored ? -length : length, n);
        for (int k = 0; k < c->coordinate_count; k++) {
            transform(matrix, 0, c->coordinates[k].re[i]);
            transform(matrix, 0, c->coordinates[k].im[i]);
        }
    }
    for (int i = 0; mirrored && i + 2 < c->index_count; i += 3) {
        if (c->looks.joined) c->looks.joined[i / 3] = 0; // a fan that is turned round begins elsewhere
        uint32_t corner = c->indices[i + 1];
        c->indices[i + 1] = c->indices[i + 2];
        c->indices[i + 2] = corner;
    }
}

static bool read_character(struct glb *glb, struct surface *surface, struct character *c, struct error *error)
{
    const json_t *meshes = json_object_get(glb->json, "meshes");
    int64_t number = choose_mesh(meshes);
    const json_t *mesh = number >= 0 ? json_array_get(meshes, (size_t)number) : NULL;
    double matrix[16];
    if (!mesh) return fail(error, ERROR_INPUT, "%s: expected a mesh, got none", glb->path);
    const json_t *primitives = json_object_get(mesh, "primitives");
    const json_t *names = json_object_get(json_object_get(mesh, "extras"), "targetNames");
    int coordinates = 0, im;
    size_t length;
    for (size_t i = 0; i < json_array_size(names); i++) coordinates += is_coordinate(names, i, &length, &im);
    if (!read_surface(glb, primitives, coordinates, surface, error)) return false;
    if (!character_create(c, surface, coordinates)) return fail_no_memory(error, glb->path);
    if (!read_normals(glb, primitives, c, error) || !read_coordinates(glb, mesh, c, error)) return false;
    if (!glb_mesh_matrix(glb, number, matrix, error)) return false;
    bool moved = false; // by no node: then it stays as it is, to the last bit
    for (int n = 0; n < 16; n++) moved = moved || matrix[n] != (n % 5 == 0);
    if (moved) place(c, matrix);
    return true;
}

bool character_read(const char *path, struct character *character, struct error *error)
{
    struct glb glb;
    struct surface surface = {0};
    *character = (struct character){0};
    if (!glb_open(&glb, path, error)) return false;
    bool done = read_character(&glb, &surface, character, error);
    surface_free(&surface);
    glb_close(&glb);
    if (!done) character_free(character);
    return done;
}
