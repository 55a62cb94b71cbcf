/// Reads a glTF character: materials with their pictures, meshes with their vertices and morph targets, nodes, skins and animations.
#include "base/names.h"
#include "base/need.h"
#include "maths/maths.h"
#include "model/glb.h"
#include "model/surface.h"
#include "model/vector.h"
#include <math.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PIXEL_ROOM = 256 << 20, VERTEX_LIMIT = 1 << 24, NAME_ROOM = 512 };

/// Where the base colour of a material lies on its texture.
struct gltf_uv {
    int set; ///< TEXCOORD_n
    float offset[2], rotation, scale[2];
};

/// The state of reading a file. Functions set `error` when they fail; what was read so far is freed with `gltf`.
struct gltf_reader {
    struct glb file;
    struct gltf *gltf;
    struct error *error;
    struct pool work;     ///< numbers of the thing that is being read
    bool stored;          ///< gltf_read_stored()
    char place[96];       ///< in the JSON, for messages
    struct gltf_uv *uvs;  ///< of each material
    int *joints_of;       ///< of each mesh: its joints' numbers are below
    int *image_of;        ///< gltf.images of each image of the file: −1 cannot be shown, −2 not tried yet
    size_t pixel_room;    ///< bytes of pixels that may still be decoded
    size_t not_shown_end; ///< length of gltf.not_shown
};

/// The part of the JSON that is being read.
#define gltf_at(r, ...) snprintf((r)->place, sizeof(r)->place, __VA_ARGS__)

/// Fails with "file: place" and then the text, which begins with ".member: " or ": ".
#define gltf_bad(r, format, ...)                                                                                     \
    fail((r)->error, ERROR_INPUT, "%s: %s" format, (r)->file.path, (r)->place, ##__VA_ARGS__)

/// Zeroed memory that is freed with the character, if the file is large enough to justify so much; else NULL and an error.
static void *gltf_make(struct gltf_reader *r, size_t count, size_t size)
{
    if (count > r->file.room / size) {
        gltf_bad(r, ": expected no more data than fits a file of this size, got %zu times %zu bytes", count, size);
        return NULL;
    }
    r->file.room -= count * size;
    void *memory = pool_try(&r->gltf->pool, count, size);
    if (!memory) fail_no_memory(r->error, r->file.path);
    return memory;
}

/// A member that is an index into an array of `limit` things; −1 if it is missing.
static bool gltf_index(struct gltf_reader *r, const json_t *object, const char *key, int limit, int *index)
{
    const json_t *member = json_object_get(object, key);
    json_int_t value = json_is_integer(member) ? json_integer_value(member) : -1;
    *index = -1;
    if (!member) return true;
    if (value < 0 || value >= limit)
        return limit == 0 ? gltf_bad(r, ".%s: expected none, because the file has none", key)
               : !json_is_number(member)
                   ? gltf_bad(r, ".%s: expected a number from 0 to %d, got something else", key, limit - 1)
                   : gltf_bad(r, ".%s: expected a number from 0 to %d, got %.10g", key, limit - 1,
                              json_number_value(member));
    *index = (int)value;
    return true;
}

/// A member that is an array of `count` numbers; unchanged if it is missing.
static bool gltf_reals(struct gltf_reader *r, const json_t *object, const char *key, float *numbers, size_t count)
{
    const json_t *array = json_object_get(object, key);
    if (!array) return true;
    if (json_array_size(array) != count)
        return gltf_bad(r, ".%s: expected %zu numbers, got %zu", key, count, json_array_size(array));
    for (size_t i = 0; i < count; i++) {
        const json_t *number = json_array_get(array, i);
        float value = (float)json_number_value(number);
        if (!json_is_number(number) || !isfinite(value))
            return gltf_bad(r, ".%s[%zu]: expected a finite number, got something else", key, i);
        numbers[i] = value;
    }
    return true;
}

/// A copy that stays with the character.
static char *gltf_text(struct gltf_reader *r, const char *text)
{
    char *copy = pool_try(&r->gltf->pool, strlen(text) + 1, 1);
    if (!copy) fail_no_memory(r->error, r->file.path);
    return copy ? strcpy(copy, text) : NULL;
}

/// The file's own name; NULL: none, or one that nobody could see.
static const char *own_name(const json_t *object)
{
    const char *name = json_string_value(json_object_get(object, "name"));
    return name && !name_is_blank(name) ? name : NULL;
}

/// The name of a thing, or "kind n".
static char *gltf_name(struct gltf_reader *r, const json_t *object, const char *kind, size_t n)
{
    char made[64];
    const char *name = own_name(object);
    snprintf(made, sizeof made, "%s %zu", kind, n);
    return gltf_text(r, name ? name : made);
}

/// Names all things of an array, each of which begins with its `char *name`. Scenes find them by name, so a name that repeats gets a number:
/// "bone", "bone 2"; with `by_place` its place in the file, counted from 1. A thing that is called "bone 2" in the file keeps that name.
static bool name_all(struct gltf_reader *r, const json_t *array, const char *kind, bool by_place, void *things,
                     size_t size)
{
    struct names names = {0};
    const json_t *object;
    size_t i, room = 0;
    json_array_foreach(array, i, object) room += NAME_ROOM + 4 * json_string_length(json_object_get(object, "name"));
    bool done = need_has_room(room) || fail_no_memory(r->error, r->file.path);
    for (int pass = 0; pass < 2; pass++) {
        json_array_foreach(array, i, object)
        {
            char **name = (char **)((char *)things + i * size);
            const bool is_first = pass == 0 && own_name(object) && !names_has(&names, own_name(object));
            if (!done || (pass == 0 ? !is_first : *name != NULL)) continue;
            if (by_place) names.number = (int)i + 1;
            char *wanted = gltf_name(r, object, kind, i);
            *name = wanted ? gltf_text(r, names_add(&names, wanted)) : NULL;
            done = *name;
        }
    }
    names_free(&names);
    return done;
}

/// An array of the file's root; NULL if there is none.
static const json_t *gltf_array(const struct gltf_reader *r, const char *key)
{
    return json_object_get(r->file.json, key);
}

/// Adds a name to those not shown, once.
static bool __attribute__((format(printf, 2, 3))) gltf_not_shown(struct gltf_reader *r, const char *format, ...)
{
    char name[128];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(name, sizeof name, format, arguments);
    va_end(arguments);
    const size_t end = r->not_shown_end, length = strlen(name);
    for (const char *at = r->gltf->not_shown; at && (at = strstr(at, name)); at++) {
        const bool begins = at == r->gltf->not_shown || at[-1] == ' ', ends = at[length] == ',' || at[length] == '\0';
        if (begins && ends) return true;
    }
    char *longer = realloc(r->gltf->not_shown, end + length + 3);
    if (!longer) return fail_no_memory(r->error, r->file.path);
    r->gltf->not_shown = longer;
    r->not_shown_end = end + (size_t)sprintf(longer + end, "%s%s", end ? ", " : "", name);
    return true;
}

// --- pictures

/// Keeps the encoded bytes and, unless they are only stored, decodes them. `why` receives the error.
static bool read_picture(struct gltf_reader *r, const json_t *json, struct gltf_image *image, struct error *why)
{
    const char *name = json_string_value(json_object_get(json, "name"));
    const char *uri = json_string_value(json_object_get(json, "uri"));
    const size_t before = r->file.room;
    struct glb_buffer bytes = {0};
    const bool found = uri ? glb_read_uri(&r->file, uri, &bytes, why)
                           : glb_view(&r->file, glb_integer(json, "bufferView", -1), &bytes.bytes);
    r->pixel_room += r->file.room - before;
    if (!found) return uri ? false : fail(why, ERROR_INPUT, "no bytes in the file");
    const size_t size = bytes.bytes.size;
    if (!r->stored && !gltf_decode_image(bytes.bytes.at, size, r->pixel_room, image, why)) {
        free(bytes.owned);
        return false;
    }
    r->pixel_room -= r->stored ? 0 : 4 * (size_t)image->width * (size_t)image->height;
    if (!bytes.owned && size > r->file.room) {
        free(image->pixels);
        return fail(why, ERROR_INPUT, "too large with %zu bytes", size);
    }
    if (!bytes.owned) r->file.room -= size;
    image->bytes = bytes.owned ? bytes.owned : malloc(size + 1);
    image->name = name && name[0] ? gltf_text(r, name) : NULL;
    image->size = size;
    if (image->bytes && !bytes.owned) memcpy(image->bytes, bytes.bytes.at, size);
    if (image->bytes && (image->name || !name || !name[0])) return true;
    free(image->pixels);
    free(image->bytes);
    return fail(why, ERROR_ENVIRONMENT, "not enough memory");
}

// --- materials

/// Sets a sampler's number that glTF knows. Unknown numbers by other programs are ignored.
static void take(const json_t *json, const char *key, const int *known, int *number)
{
    const int64_t value = glb_integer(json, key, *number);
    for (; *known; known++) {
        if (value == *known) *number = *known;
    }
}

static bool read_texture(struct gltf_reader *r, const json_t *info, struct gltf_uv *uv,
                         struct gltf_material *material)
{
    static const int wraps[] = {GLTF_REPEATED, GLTF_MIRRORED, GLTF_CLAMPED, 0};
    static const int filters[] = {GLTF_READ_NEAREST,
                                  GLTF_READ_LINEAR,
                                  GLTF_READ_SMALLER,
                                  GLTF_READ_SMALLER + 1,
                                  GLTF_READ_SMALLER + 2,
                                  GLTF_READ_BETWEEN,
                                  0};
    static const int near[] = {GLTF_READ_NEAREST, GLTF_READ_LINEAR, 0};
    const json_t *textures = gltf_array(r, "textures"), *images = gltf_array(r, "images");
    const json_t *transform = json_object_get(json_object_get(info, "extensions"), "KHR_texture_transform");
    const json_t *samplers = gltf_array(r, "samplers");
    int texture, source, sampler;
    if (!gltf_index(r, info, "index", (int)json_array_size(textures), &texture)) return false;
    if (texture < 0) return true;
    int64_t set = glb_integer(transform, "texCoord", glb_integer(info, "texCoord", 0));
    if (set < 0) return gltf_bad(r, ".texCoord: expected the number of a set of coordinates, got something else");
    uv->set = (int)set;
    uv->rotation = (float)json_number_value(json_object_get(transform, "rotation"));
    if (!gltf_reals(r, transform, "offset", uv->offset, 2) || !gltf_reals(r, transform, "scale", uv->scale, 2))
        return false;
    gltf_at(r, "textures[%d]", texture);
    const json_t *described = json_array_get(textures, (size_t)texture);
    if (!gltf_index(r, described, "source", (int)json_array_size(images), &source) ||
        !gltf_index(r, described, "sampler", (int)json_array_size(samplers), &sampler))
        return false;
    if (sampler >= 0) {
        const json_t *of = json_array_get(samplers, (size_t)sampler);
        take(of, "wrapS", wraps, &material->sampler.wrap[0]);
        take(of, "wrapT", wraps, &material->sampler.wrap[1]);
        take(of, "minFilter", filters, &material->sampler.far);
        take(of, "magFilter", near, &material->sampler.near);
    }
    if (source < 0) return true;

    // Each image of the file is added to gltf.images once; −1, and it is listed as not shown, if that fails.
    if (r->image_of[source] == -2) {
        const json_t *json = json_array_get(images, (size_t)source);
        struct gltf_image *image = &r->gltf->images[r->gltf->image_count];
        struct error why = {0};
        const bool read = read_picture(r, json, image, &why);
        if (!read) *image = (struct gltf_image){0};
        r->image_of[source] = read ? r->gltf->image_count++ : -1;
        if (why.kind == ERROR_ENVIRONMENT) return fail_no_memory(r->error, r->file.path);
        if (!read) { // called by its own name, or its file's
            const char *name = json_string_value(json_object_get(json, "name"));
            const char *uri = json_string_value(json_object_get(json, "uri"));
            if (!name || !name[0]) name = uri && strncmp(uri, "data:", 5) != 0 ? uri : "of no name";
            if (!gltf_not_shown(r, "image %.40s (%.60s)", name, why.text)) return false;
        }
    }
    material->image = r->image_of[source];
    return true;
}

/// A factor, 1 if it is missing.
static double number_of(const json_t *object, const char *key)
{
    const json_t *number = json_object_get(object, key);
    return number ? json_number_value(number) : 1;
}

static bool gltf_read_materials(struct gltf_reader *r)
{
    /// Properties of a material that are not shown: their place and name.
    static const struct {
        const char *key, *name;
    } ignored[] = {
        {"normalTexture", "normal maps"}, {"occlusionTexture", "occlusion maps"}, {"emissiveTexture", "emission"}};
    static const struct gltf_sampler usual = {
        .wrap = {GLTF_REPEATED, GLTF_REPEATED}, .far = GLTF_READ_BETWEEN, .near = GLTF_READ_LINEAR};
    const json_t *materials = gltf_array(r, "materials"), *json;
    size_t i, count = json_array_size(materials), images = json_array_size(gltf_array(r, "images"));
    gltf_at(r, "materials");
    r->gltf->materials = gltf_make(r, count, sizeof *r->gltf->materials);
    r->uvs = r->gltf->materials ? gltf_make(r, count, sizeof *r->uvs) : NULL;
    r->gltf->images = r->uvs ? gltf_make(r, images, sizeof *r->gltf->images) : NULL;
    r->image_of = r->gltf->images ? gltf_make(r, images, sizeof *r->image_of) : NULL;
    if (!r->image_of) return false;
    for (i = 0; i < images; i++) r->image_of[i] = -2;
    json_array_foreach(materials, i, json)
    {
        gltf_at(r, "materials[%zu]", i);
        struct gltf_material *material = &r->gltf->materials[r->gltf->material_count++];
        const char *mode = json_string_value(json_object_get(json, "alphaMode"));
        const json_t *cutoff = json_object_get(json, "alphaCutoff");
        *material = (struct gltf_material){.color = {1, 1, 1, 1}, .image = -1, .sampler = usual};
        r->uvs[i] = (struct gltf_uv){.scale = {1, 1}};
        const json_t *metal = json_object_get(json, "pbrMetallicRoughness");
        const json_t *maps = json_object_get(metal, "metallicRoughnessTexture");
        material->shines = metal && !maps;
        material->metallic = number_of(metal, "metallicFactor");
        material->roughness = number_of(metal, "roughnessFactor");
        material->double_sided = json_is_true(json_object_get(json, "doubleSided"));
        material->blended = mode && strcmp(mode, "BLEND") == 0;
        if (mode && strcmp(mode, "MASK") == 0) material->cutoff = cutoff ? (float)json_number_value(cutoff) : 0.5f;
        for (size_t k = 0; k < sizeof ignored / sizeof *ignored; k++) {
            if (json_object_get(json, ignored[k].key) && !gltf_not_shown(r, "%s", ignored[k].name)) return false;
        }
        if (maps && !gltf_not_shown(r, "metal and roughness maps")) return false;

        // The base colour; the older of two material descriptions calls it diffuse.
        const json_t *gloss =
            json_object_get(json_object_get(json, "extensions"), "KHR_materials_pbrSpecularGlossiness");
        const bool older = gloss && !metal;
        const json_t *from = older ? gloss : metal;
        if (!gltf_reals(r, from, older ? "diffuseFactor" : "baseColorFactor", material->color, 4) ||
            !read_texture(r, json_object_get(from, older ? "diffuseTexture" : "baseColorTexture"), &r->uvs[i],
                          material))
            return false;
    }
    return true;
}

// --- meshes

enum { LINES = 1, TRIANGLES = 4, STRIP = 5, FAN = 6 };
/// The numbers of an attribute, one element per vertex of the part in the file.
static bool read_numbers(struct gltf_reader *r, const json_t *attributes, const char *name, int least, int most,
                         int count, struct glb_numbers *numbers)
{
    if (!glb_numbers(&r->file, glb_integer(attributes, name, -1), &r->work, numbers, r->error)) return false;
    if (numbers->components >= least && numbers->components <= most && numbers->count == count) return true;
    return gltf_bad(r, ".attributes.%s: expected %d elements of %d numbers, got %d of %d", name, count, most,
                    numbers->count, numbers->components);
}

/// An attribute as rows of `width` floats; NULL if it is missing. A missing fourth component is 1.
static bool read_rows(struct gltf_reader *r, const json_t *attributes, const char *name, int width, int count,
                      void *array)
{
    struct glb_numbers numbers;
    if (!json_object_get(attributes, name)) return true;
    if (!read_numbers(r, attributes, name, width == 4 ? 3 : width, width, count, &numbers)) return false;
    float *const rows = gltf_make(r, (size_t)count, (size_t)width * sizeof *rows), *row = rows;
    memcpy(array, &rows, sizeof rows);
    const float *from = numbers.values;
    for (int i = 0; row && i < count; i++, row += width, from += numbers.components) {
        for (int k = 0; k < width; k++) row[k] = k < numbers.components ? from[k] : 1;
    }
    return rows;
}

/// Adds four influences, from `first`, to each vertex.
static bool read_four(struct gltf_reader *r, const json_t *attributes, int set, struct gltf_part *part)
{
    struct glb_numbers joints, weights;
    char name[2][16] = {"JOINTS_0", "WEIGHTS_0"};
    bool whole = true;
    name[0][7] = name[1][8] = (char)('0' + set);
    if (!read_numbers(r, attributes, name[0], 4, 4, part->vertex_count, &joints) ||
        !read_numbers(r, attributes, name[1], 4, 4, part->vertex_count, &weights))
        return false;
    for (int n = 0; whole && n < 4 * part->vertex_count; n++) {
        int vertex = n / 4, k = n % 4;
        float joint = joints.values[n], weight = weights.values[n];
        whole = joint >= 0 && joint <= UINT16_MAX && joint == floorf(joint) && weight < 1e6f;
        part->joints[vertex][4 * set + k] = whole ? (uint16_t)joint : 0;
        part->weights[vertex][4 * set + k] = weight > 0 ? weight : 0;
    }
    return whole ||
           gltf_bad(r, ".attributes.%s: expected numbers of joints, and weights from 0 to 1, got others", name[0]);
}

/// Reads the attributes and targets of a part's vertices, except texture coordinates; missing ones are NULL.
static bool read_vertices(struct gltf_reader *r, const json_t *primitive, int targets, struct gltf_part *part)
{
    const json_t *attributes = json_object_get(primitive, "attributes");
    const int count = part->vertex_count;
    if (!read_rows(r, attributes, "POSITION", 3, count, &part->position) ||
        !read_rows(r, attributes, "NORMAL", 3, count, &part->normal) ||
        !read_rows(r, attributes, "COLOR_0", 4, count, &part->color))
        return false;
    for (int i = 0; part->normal && i < count; i++) {
        float *normal = part->normal[i], length = glm_vec3_norm(normal);
        if (fabsf(length - 1) < 1e-6f) continue; // already exact: keep the bits
        if (length > 0 && isfinite(length)) {
            glm_vec3_divs(normal, length, normal);
        } else {
            glm_vec3_copy((vec3){0, 1, 0}, normal);
        }
    }

    // The fox's own attributes, which glTF does not define. In other files these names may mean anything, so unsuitable ones are ignored.
    struct glb_numbers mark, fur;
    struct error why = {0};
    if (glb_numbers(&r->file, glb_integer(attributes, "_MARK", -1), &r->gltf->pool, &mark, &why) &&
        glb_numbers(&r->file, glb_integer(attributes, "_FUR", -1), &r->gltf->pool, &fur, &why) &&
        mark.count == count && mark.components == 3 && fur.count == count && fur.components == 2) {
        part->mark = (float(*)[3])mark.values;
        part->fur = (float(*)[2])fur.values;
    }
    if (why.kind == ERROR_ENVIRONMENT) return fail_no_memory(r->error, r->file.path);

    if (json_object_get(attributes, "JOINTS_0")) { // up to eight joints and weights a vertex
        for (int set = 0; set < 2; set++) {
            const char *const joints = set ? "JOINTS_1" : "JOINTS_0";
            const char *const weights = set ? "WEIGHTS_1" : "WEIGHTS_0";
            if (json_object_get(attributes, joints) && !json_object_get(attributes, weights))
                return gltf_bad(r, ".attributes: expected %s beside %s, got %s alone", weights, joints, joints);
        }
        part->joints = gltf_make(r, (size_t)count, sizeof *part->joints);
        part->weights = part->joints ? gltf_make(r, (size_t)count, sizeof *part->weights) : NULL;
        if (!part->weights || !read_four(r, attributes, 0, part)) return false;
        if (json_object_get(attributes, "JOINTS_1") && !read_four(r, attributes, 1, part)) return false;
        for (int i = 0; i < count; i++) {
            float *weight = part->weights[i];
            double sum = 0;
            for (int k = 0; k < GLTF_INFLUENCES; k++) sum += (double)weight[k];
            if (!(sum > 0)) weight[0] = 1, sum = 1; // it follows its first joint
            for (int k = 0; k < GLTF_INFLUENCES; k++) {
                weight[k] = (float)((double)weight[k] / sum);
                if (weight[k] <= 0) part->joints[i][k] = 0;
            }
        }
        if (json_object_get(attributes, "JOINTS_2") && !gltf_not_shown(r, "more than 8 joints a vertex"))
            return false;
    }

    part->targets = gltf_make(r, (size_t)targets, sizeof *part->targets);
    for (int i = 0; part->targets && i < targets; i++) { // a target that the part lacks leaves it alone
        const json_t *target = json_array_get(json_object_get(primitive, "targets"), (size_t)i);
        struct gltf_target *to = &part->targets[i];
        if (!read_rows(r, target, "POSITION", 3, count, &to->position)) return false;
        if (part->normal && !r->stored && !read_rows(r, target, "NORMAL", 3, count, &to->normal)) return false;
    }
    return part->targets;
}

/// Reads a primitive; `like` is the mesh's first part or NULL, whose vertices it may share. A part without triangles is listed as not shown.
static bool read_part(struct gltf_reader *r, const json_t *primitive, const json_t *like, struct gltf_mesh *mesh,
                      struct gltf_part *part)
{
    const int64_t mode = glb_integer(primitive, "mode", TRIANGLES);
    const json_t *attributes = json_object_get(primitive, "attributes"),
                 *extensions = json_object_get(primitive, "extensions");
    if (mode < 0 || mode > FAN) return gltf_bad(r, ".mode: expected a number from 0 to 6, got something else");
    if (mode < TRIANGLES) return gltf_not_shown(r, mode < LINES ? "points" : "lines");
    if (!json_object_get(attributes, "POSITION")) return gltf_not_shown(r, "meshes without positions");

    const int64_t accessor = glb_integer(attributes, "POSITION", -1);
    const json_t *position = json_array_get(gltf_array(r, "accessors"), (size_t)accessor);
    const int64_t count = glb_integer(position, "count", -1);
    const size_t most = r->file.room / sizeof(float[3]);
    if (json_object_get(extensions, "KHR_draco_mesh_compression") && !json_object_get(position, "bufferView"))
        return gltf_bad(r, ": expected a mesh that is not compressed, got Draco; export without compression");
    if (count < 1) return gltf_bad(r, ".attributes.POSITION: expected an accessor, got none");
    if (!glb_is_stored(&r->file, accessor))
        return gltf_bad(r, ".attributes.POSITION: expected positions that are in the file, got none");
    if ((size_t)count > most)
        return gltf_bad(r, ".attributes.POSITION: expected at most %zu vertices in a file of this size, got %lld",
                        most, (long long)count);
    part->vertex_count = (int)count;

    if (!gltf_index(r, primitive, "material", r->gltf->material_count, &part->material)) return false;

    // Triangles in the file's order; without indices, in order of vertices.
    struct glb_numbers numbers = {.count = part->vertex_count, .components = 1};
    const bool indexed = json_object_get(primitive, "indices");
    if (indexed && !glb_numbers(&r->file, glb_integer(primitive, "indices", -1), &r->work, &numbers, r->error))
        return false;
    bool good =
        numbers.components == 1 || gltf_bad(r, ".indices: expected one number each, got %d", numbers.components);
    uint32_t *corners = good ? gltf_make(r, (size_t)numbers.count, sizeof *corners) : NULL;
    good = corners;
    for (int i = 0; good && i < numbers.count; i++) {
        const double index = indexed ? (double)numbers.values[i] : i;
        good = (index >= 0 && index < (double)count && index == floor(index)) ||
               gltf_bad(r, ".indices: expected numbers from 0 to %d, got %g at place %d", part->vertex_count - 1,
                        index, i);
        if (good) corners[i] = (uint32_t)index;
    }
    if (!good) return false;
    part->indices = corners;
    part->index_count = numbers.count - numbers.count % 3;
    if (mode != TRIANGLES) { // strips and fans, oriented as glTF requires
        const int triangles = numbers.count > 2 ? numbers.count - 2 : 0;
        part->indices = gltf_make(r, (size_t)triangles, 3 * sizeof *part->indices);
        part->index_count = 3 * triangles;
        if (!part->indices) return false;
        for (int i = 0; i < triangles; i++) {
            const int second = mode == FAN ? i + 2 : i + 1 + i % 2, third = mode == FAN ? 0 : i + 2 - i % 2;
            part->indices[3 * i] = corners[mode == FAN ? i + 1 : i];
            part->indices[3 * i + 1] = corners[second];
            part->indices[3 * i + 2] = corners[third];
        }
    }
    int kept = 0; // those that name a vertex twice, with which strips jump, are left out
    for (int i = 0; i + 2 < part->index_count; i += 3) {
        if (triangle_repeats(part->indices + i)) continue;
        memmove(part->indices + kept, part->indices + i, 3 * sizeof *part->indices);
        kept += 3;
    }
    part->index_count = kept;
    if (part->index_count == 0) return gltf_not_shown(r, "triangles without area");
    part->has_polygons = json_object_get(extensions, GLTF_POLYGONS);
    const json_t *targets = json_object_get(primitive, "targets"), *others = json_object_get(like, "targets");
    if (like && json_equal(attributes, json_object_get(like, "attributes")) &&
        (targets == others || json_equal(targets, others))) { // both may be missing
        // Vertices that several primitives share, as ours with several materials do, are read once; texture coordinates too, if both materials
        // place them equally.
        const struct gltf_part *other = mesh->parts, own = *part;
        const struct gltf_uv *uvs = r->uvs;
        *part = *other;
        if (own.material != other->material && (own.material < 0 || other->material < 0 ||
                                                memcmp(&uvs[own.material], &uvs[other->material], sizeof *uvs) != 0))
            part->uv = NULL;
        part->indices = own.indices;
        part->index_count = own.index_count;
        part->material = own.material;
        part->has_polygons = own.has_polygons;
        part->shared = true;
    } else {
        int *joints = &r->joints_of[mesh - r->gltf->meshes];
        if (!read_vertices(r, primitive, mesh->target_count, part)) return false;
        for (int n = 0; part->joints && n < part->vertex_count * GLTF_INFLUENCES; n++) {
            const int joint = part->joints[n / GLTF_INFLUENCES][n % GLTF_INFLUENCES];
            if (joint >= *joints) *joints = joint + 1;
        }
    }
    if (part->uv) return true;

    // Texture coordinates are moved to where the material has them on its texture (KHR_texture_transform).
    static const struct gltf_uv plain = {.scale = {1, 1}};
    const struct gltf_uv *uv = part->material >= 0 ? &r->uvs[part->material] : &plain;
    const float c = maths_cosf(uv->rotation), s = maths_sinf(uv->rotation);
    char name[32];
    snprintf(name, sizeof name, "TEXCOORD_%d", uv->set);
    if (!read_rows(r, attributes, name, 2, part->vertex_count, &part->uv)) return false;
    for (int i = 0; part->uv && i < part->vertex_count; i++) {
        float *at = part->uv[i], u = at[0] * uv->scale[0], v = at[1] * uv->scale[1];
        at[0] = c * u + s * v + uv->offset[0];
        at[1] = -s * u + c * v + uv->offset[1];
    }
    return true;
}

static bool read_meshes(struct gltf_reader *r)
{
    const json_t *meshes = gltf_array(r, "meshes"), *json, *primitive;
    size_t m, i, count = json_array_size(meshes);
    gltf_at(r, "meshes");
    r->gltf->meshes = gltf_make(r, count, sizeof *r->gltf->meshes);
    r->joints_of = r->gltf->meshes ? gltf_make(r, count, sizeof *r->joints_of) : NULL;
    if (!r->joints_of) return false;
    r->gltf->mesh_count = (int)count;
    json_array_foreach(meshes, m, json)
    {
        struct gltf_mesh *mesh = &r->gltf->meshes[m];
        const json_t *primitives = json_object_get(json, "primitives"), *first = NULL;
        gltf_at(r, "meshes[%zu]", m);
        if (!json_is_array(primitives)) return gltf_bad(r, ".primitives: expected an array, got something else");
        mesh->name = gltf_name(r, json, "mesh", m);
        mesh->parts = mesh->name ? gltf_make(r, json_array_size(primitives), sizeof *mesh->parts) : NULL;
        if (!mesh->parts) return false;
        json_array_foreach(primitives, i, primitive)
        {
            const int targets = (int)json_array_size(json_object_get(primitive, "targets"));
            if (targets > mesh->target_count) mesh->target_count = targets;
        }
        json_array_foreach(primitives, i, primitive)
        {
            struct gltf_part *part = &mesh->parts[mesh->part_count];
            gltf_at(r, "meshes[%zu].primitives[%zu]", m, i);
            if (!read_part(r, primitive, first, mesh, part)) return false;
            pool_free(&r->work);
            part->primitive = (int)i;
            if (part->index_count > 0 && mesh->part_count++ == 0) first = primitive;
        }

        gltf_at(r, "meshes[%zu]", m);
        mesh->extras = json_incref(json_object_get(json, "extras"));
        mesh->weights = gltf_make(r, (size_t)mesh->target_count, sizeof *mesh->weights);
        mesh->target_names =
            mesh->weights ? gltf_make(r, (size_t)mesh->target_count, sizeof *mesh->target_names) : NULL;
        if (!mesh->target_names) return false;
        for (int t = 0; t < mesh->target_count; t++) {
            // glTF has no place for the names of targets: most programs write them beside the mesh's targets, VRM 0.x beside each primitive's, and
            // its first writers inside each target.
            const json_t *of = json;
            const char *name = NULL;
            for (i = 0; of && !name; of = json_array_get(primitives, i++)) {
                const json_t *own = json_array_get(json_object_get(of, "targets"), (size_t)t);
                const json_t *more =
                    json_object_get(own, "extras") ? json_object_get(own, "extras") : json_object_get(own, "extra");
                const json_t *names = json_object_get(json_object_get(of, "extras"), "targetNames");
                name = json_string_value(names ? json_array_get(names, (size_t)t) : json_object_get(more, "name"));
                if (name && name_is_blank(name)) name = NULL;
            }
            if (name && !(mesh->target_names[t] = gltf_text(r, name))) return false;
        }
        if (!gltf_reals(r, json, "weights", mesh->weights, (size_t)mesh->target_count)) return false;
    }
    return true;
}

/// Names targets without a name by the shapes of VRM 0.x that move them, by those of one target first.
static bool name_by_shapes(struct gltf_reader *r)
{
    const json_t *vrm = json_object_get(json_object_get(r->file.json, "extensions"), "VRM"), *shape, *bind;
    const json_t *shapes = json_object_get(json_object_get(vrm, "blendShapeMaster"), "blendShapeGroups");
    size_t s, b;
    for (int pass = 0; pass < 2; pass++) {
        json_array_foreach(shapes, s, shape)
        {
            const json_t *binds = json_object_get(shape, "binds");
            const char *name = own_name(shape);
            char *own = NULL; // one for all targets, because a name may be long
            if (!name) name = json_string_value(json_object_get(shape, "presetName"));
            const bool is_named = name && !name_is_blank(name);
            json_array_foreach(is_named && (pass || json_array_size(binds) == 1) ? binds : NULL, b, bind)
            {
                const int64_t m = glb_integer(bind, "mesh", -1), t = glb_integer(bind, "index", -1);
                if (m < 0 || m >= r->gltf->mesh_count || t < 0 || t >= r->gltf->meshes[m].target_count) continue;
                char **target = &r->gltf->meshes[m].target_names[t];
                if (!*target && !own && !(own = gltf_text(r, name))) return false;
                if (!*target) *target = own;
            }
        }
    }
    return true;
}

// --- nodes and skins

static const float SHEARED = 1e-4f; ///< cosine between columns of a matrix that is no move, turn and scale

/// An element of an array of node indices.
static bool read_member(struct gltf_reader *r, const json_t *element, const char *key, size_t i, int *node)
{
    json_int_t value = json_is_integer(element) ? json_integer_value(element) : -1;
    if (value < 0 || value >= r->gltf->node_count)
        return gltf_bad(r, ".%s[%zu]: expected a node from 0 to %d, got %s", key, i, r->gltf->node_count - 1,
                        json_is_integer(element) ? "another number" : "something else");
    *node = (int)value;
    return true;
}

/// Removes the meshes of nodes that the scene does not show. Without scenes all are shown.
static bool choose_scene(struct gltf_reader *r)
{
    struct gltf *gltf = r->gltf;
    const json_t *scenes = gltf_array(r, "scenes"), *element;
    size_t i;
    int scene;
    gltf_at(r, "scene");
    if (json_array_size(scenes) == 0) return true;
    if (!gltf_index(r, r->file.json, "scene", (int)json_array_size(scenes), &scene)) return false;
    if (scene < 0) scene = 0;
    bool *shown = gltf_make(r, (size_t)gltf->node_count, sizeof *shown), done = shown;
    gltf_at(r, "scenes[%d]", scene);
    json_array_foreach(json_object_get(json_array_get(scenes, (size_t)scene), "nodes"), i, element)
    {
        int root;
        done = done && read_member(r, element, "nodes", i, &root);
        if (done) shown[root] = true;
    }
    for (int n = 0; done && n < gltf->node_count; n++) {
        struct gltf_node *node = &gltf->nodes[gltf->order[n]];
        bool *is_shown = &shown[gltf->order[n]];
        *is_shown = *is_shown || (node->parent >= 0 && shown[node->parent]);
        if (*is_shown || node->mesh < 0) continue;
        node->mesh = -1;
        done = gltf_not_shown(r, "other scenes");
    }
    return done;
}

static bool read_nodes(struct gltf_reader *r)
{
    struct gltf *gltf = r->gltf;
    const json_t *nodes = gltf_array(r, "nodes"), *json, *element;
    size_t i, k, count = json_array_size(nodes);
    gltf_at(r, "nodes");
    if (count == 0) return gltf_bad(r, ": expected something to show, got no nodes");
    gltf->nodes = gltf_make(r, count, sizeof *gltf->nodes);
    gltf->order = gltf->nodes ? gltf_make(r, count, sizeof *gltf->order) : NULL;
    if (!gltf->order) return false;
    gltf->node_count = (int)count;
    if (!name_all(r, nodes, "node", false, gltf->nodes, sizeof *gltf->nodes)) return false;
    json_array_foreach(nodes, i, json)
    {
        struct gltf_node *node = &gltf->nodes[i];
        gltf_at(r, "nodes[%zu]", i);
        node->parent = -1;
        node->place = (struct gltf_place){.rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
        node->has_matrix = json_object_get(json, "matrix");
        if (!gltf_reals(r, json, "matrix", node->matrix, 16) ||
            !gltf_reals(r, json, "translation", node->place.translation, 3) ||
            !gltf_reals(r, json, "rotation", node->place.rotation, 4) ||
            !gltf_reals(r, json, "scale", node->place.scale, 3))
            return false;
        float *q = node->place.rotation, length = sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        if (!(length > 0) || !isfinite(length))
            return gltf_bad(r, ".rotation: expected a unit quaternion, got another");
        for (k = 0; k < 4; k++) q[k] /= length;

        // Other programs split a matrix into a move, a turn and a scale, so that clips and chains can move the node. A sheared or flat one
        // stays a matrix.
        mat3s turn = glms_mat4_pick3(mat4_from(node->matrix));
        struct gltf_place place;
        bool splits = node->has_matrix && node->matrix[15] == 1;
        for (k = 0; splits && k < 3; k++) {
            place.translation[k] = node->matrix[12 + k];
            place.scale[k] = glms_vec3_norm(turn.col[k]);
            splits = node->matrix[4 * k + 3] == 0 && place.scale[k] > 0 && isfinite(place.scale[k]);
        }
        if (splits && glms_mat3_det(turn) < 0) place.scale[0] = -place.scale[0];
        for (k = 0; splits && k < 3; k++) turn.col[k] = glms_vec3_divs(turn.col[k], place.scale[k]);
        for (k = 0; splits && k < 3; k++) splits = fabsf(glms_vec3_dot(turn.col[k], turn.col[(k + 1) % 3])) < SHEARED;
        if (splits) {
            const versors own = glms_quat_normalize(glms_mat3_quat(turn));
            memcpy(place.rotation, own.raw, sizeof place.rotation);
            node->place = place;
            node->has_matrix = false;
        }
        if (!gltf_index(r, json, "mesh", gltf->mesh_count, &node->mesh) ||
            !gltf_index(r, json, "skin", (int)json_array_size(gltf_array(r, "skins")), &node->skin))
            return false;
    }

    json_array_foreach(nodes, i, json)
    {
        gltf_at(r, "nodes[%zu]", i);
        json_array_foreach(json_object_get(json, "children"), k, element)
        {
            int child;
            if (!read_member(r, element, "children", k, &child)) return false;
            if (gltf->nodes[child].parent >= 0)
                return gltf_bad(r,
                                ".children[%zu]: expected a node of one parent, got node %d, which nodes[%d] has too",
                                k, child, gltf->nodes[child].parent);
            gltf->nodes[child].parent = (int)i;
        }
    }
    gltf_link_nodes(gltf);

    // Roots first, then the children of nodes already listed. Nodes never reached form a cycle.
    int listed = 0;
    for (int n = 0; n < gltf->node_count; n++) {
        if (gltf->nodes[n].parent < 0) gltf->order[listed++] = n;
    }
    for (int at = 0; at < listed; at++) {
        const json_t *children = json_object_get(json_array_get(nodes, (size_t)gltf->order[at]), "children");
        json_array_foreach(children, k, element) { gltf->order[listed++] = (int)json_integer_value(element); }
    }
    gltf_at(r, "nodes");
    if (listed < gltf->node_count) return gltf_bad(r, ": expected a tree, got a node that is below itself");
    if (!choose_scene(r)) return false;

    // Morph weights at rest: the node's own, else its mesh's.
    size_t total = 0;
    for (int n = 0; n < gltf->node_count; n++) {
        struct gltf_node *node = &gltf->nodes[n];
        node->first_weight = (int)total;
        if (node->mesh >= 0) total += (size_t)gltf->meshes[node->mesh].target_count;
        if (total > r->file.room / sizeof *gltf->weights) break; // gltf_make() reports it
    }
    gltf_at(r, "nodes");
    gltf->weights = gltf_make(r, total, sizeof *gltf->weights);
    if (!gltf->weights) return false;
    gltf->weight_count = (int)total;
    for (int n = 0; n < gltf->node_count; n++) {
        const struct gltf_node *node = &gltf->nodes[n];
        if (node->mesh < 0) continue;
        const struct gltf_mesh *mesh = &gltf->meshes[node->mesh];
        float *weights = gltf->weights + node->first_weight;
        for (int t = 0; t < mesh->target_count; t++) weights[t] = mesh->weights[t];
        gltf_at(r, "nodes[%d]", n);
        if (!gltf_reals(r, json_array_get(nodes, (size_t)n), "weights", weights, (size_t)mesh->target_count))
            return false;
    }
    return true;
}

static bool read_skins(struct gltf_reader *r)
{
    const json_t *skins = gltf_array(r, "skins"), *json, *element;
    size_t s, i;
    gltf_at(r, "skins");
    r->gltf->skins = gltf_make(r, json_array_size(skins), sizeof *r->gltf->skins);
    if (!r->gltf->skins) return false;
    json_array_foreach(skins, s, json)
    {
        struct gltf_skin *skin = &r->gltf->skins[r->gltf->skin_count++];
        const json_t *joints = json_object_get(json, "joints");
        const size_t count = json_array_size(joints);
        gltf_at(r, "skins[%zu]", s);
        if (count == 0) return gltf_bad(r, ".joints: expected a joint or more, got none");
        skin->joints = gltf_make(r, count, sizeof *skin->joints);
        skin->inverse_bind = skin->joints ? gltf_make(r, count, sizeof *skin->inverse_bind) : NULL;
        if (!skin->inverse_bind) return false;
        skin->joint_count = (int)count;
        skin->first_joint = r->gltf->joint_count;
        r->gltf->joint_count += skin->joint_count;
        json_array_foreach(joints, i, element)
        {
            if (!read_member(r, element, "joints", i, &skin->joints[i])) return false;
        }
        if (!json_object_get(json, "inverseBindMatrices")) {
            for (int n = 0; n < skin->joint_count; n++)
                for (int k = 0; k < 4; k++) skin->inverse_bind[n][5 * k] = 1;
            continue;
        }

        struct glb_numbers numbers;
        if (!glb_numbers(&r->file, glb_integer(json, "inverseBindMatrices", -1), &r->work, &numbers, r->error))
            return false;
        bool fits = numbers.components == 16 && numbers.count >= skin->joint_count;
        for (int n = 0; fits && n < 16 * skin->joint_count; n++)
            skin->inverse_bind[n / 16][n % 16] = numbers.values[n];
        if (!fits)
            return gltf_bad(r, ".inverseBindMatrices: expected %d matrices of 16 numbers, got %d of %d",
                            skin->joint_count, numbers.count, numbers.components);
    }
    for (int n = 0; n < r->gltf->node_count; n++) {
        const struct gltf_node *node = &r->gltf->nodes[n];
        if (node->mesh < 0 || node->skin < 0) continue;
        int joints = r->gltf->skins[node->skin].joint_count;
        gltf_at(r, "nodes[%d]", n);
        if (r->joints_of[node->mesh] > joints)
            return gltf_bad(r, ".skin: expected a skin of %d joints, which its mesh uses, got %d",
                            r->joints_of[node->mesh], joints);
    }
    return true;
}

// --- animations

/// The numbers of a sampler's accessor. NULL with an error.
static float *read_floats(struct gltf_reader *r, const json_t *sampler, const char *key, int *count, int *components)
{
    struct glb_numbers numbers;
    int accessor;
    if (!gltf_index(r, sampler, key, (int)json_array_size(gltf_array(r, "accessors")), &accessor)) return NULL;
    if (accessor < 0) {
        gltf_bad(r, ".%s: expected an accessor, got none", key);
        return NULL;
    }
    if (!glb_numbers(&r->file, accessor, &r->gltf->pool, &numbers, r->error)) return NULL;
    r->file.room -= (size_t)numbers.count * (size_t)numbers.components * sizeof *numbers.values;
    *count = numbers.count;
    *components = numbers.components;
    return numbers.values;
}

static bool read_clips(struct gltf_reader *r)
{
    static const char *const names[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    static const char *const paths[] = {"translation", "rotation", "scale", "weights"}; // as in enum gltf_path
    const json_t *clips = gltf_array(r, "animations"), *json, *channel;
    size_t i, k;
    gltf_at(r, "animations");
    r->gltf->clips = gltf_make(r, json_array_size(clips), sizeof *r->gltf->clips);
    if (!r->gltf->clips || !name_all(r, clips, "clip", true, r->gltf->clips, sizeof *r->gltf->clips)) return false;
    json_array_foreach(clips, i, json)
    {
        struct gltf_clip *clip = &r->gltf->clips[r->gltf->clip_count++];
        const json_t *channels = json_object_get(json, "channels"), *samplers = json_object_get(json, "samplers");
        gltf_at(r, "animations[%zu]", i);
        clip->channels = gltf_make(r, json_array_size(channels), sizeof *clip->channels);
        if (!clip->channels) return false;
        clip->first = INFINITY;
        json_array_foreach(channels, k, channel)
        {
            gltf_at(r, "animations[%zu].channels[%zu]", i, k);
            const json_t *target = json_object_get(channel, "target");
            struct gltf_channel *to = &clip->channels[clip->channel_count];
            int sampler;
            *to = (struct gltf_channel){0};
            if (!gltf_index(r, target, "node", r->gltf->node_count, &to->node)) return false;
            if (to->node < 0) continue;
            const struct gltf_node *node = &r->gltf->nodes[to->node];
            const char *path = json_string_value(json_object_get(target, "path"));
            int p = path ? 0 : 4;
            while (p < 4 && strcmp(path, paths[p]) != 0) p++;
            if (p == 4) continue;
            to->path = (enum gltf_path)p;
            to->components = p == GLTF_ROTATION ? 4 : 3;
            if (p == GLTF_WEIGHTS) to->components = node->mesh >= 0 ? r->gltf->meshes[node->mesh].target_count : 0;
            if (node->has_matrix && p != GLTF_WEIGHTS) {
                if (!gltf_not_shown(r, "clips of nodes with sheared matrices")) return false;
                continue;
            }
            if (to->components == 0) continue;
            if (!gltf_index(r, channel, "sampler", (int)json_array_size(samplers), &sampler)) return false;
            if (sampler < 0) return gltf_bad(r, ".sampler: expected a sampler, got none");
            gltf_at(r, "animations[%zu].samplers[%d]", i, sampler);
            clip->channel_count++;
            const json_t *of = json_array_get(samplers, (size_t)sampler);
            const char *name = json_string_value(json_object_get(of, "interpolation"));
            int count, of_time, components, kind = name ? 0 : GLTF_LINEAR;
            to->times = read_floats(r, of, "input", &to->key_count, &of_time);
            to->values = to->times ? read_floats(r, of, "output", &count, &components) : NULL;
            if (!to->values) return false;
            while (name && kind < 3 && strcmp(name, names[kind]) != 0) kind++;
            if (kind == 3)
                return gltf_bad(r, ".interpolation: expected STEP, LINEAR or CUBICSPLINE, got %.40s", name);
            to->interpolation = (enum gltf_interpolation)kind;
            if (of_time != 1) return gltf_bad(r, ".input: expected times, got %d numbers a key", of_time);
            for (int n = 1; n < to->key_count; n++) {
                if (to->times[n] < to->times[n - 1])
                    return gltf_bad(r, ".input: expected ascending times, got %g after %g", (double)to->times[n],
                                    (double)to->times[n - 1]);
            }
            const int width = to->path == GLTF_WEIGHTS ? 1 : to->components;
            const int64_t expected =
                (int64_t)to->key_count * (to->interpolation == GLTF_CUBIC ? 3 : 1) * to->components / width;
            if (components != width || count != expected)
                return gltf_bad(r, ".output: expected %lld elements of %d numbers, got %d of %d", (long long)expected,
                                width, count, components);
            clip->first = fmin(clip->first, (double)to->times[0]);
            clip->last = fmax(clip->last, (double)to->times[to->key_count - 1]);
        }
        clip->first = fmin(clip->first, clip->last); // without a key
        if (!gltf_judge_loop(r->gltf, clip)) return fail_no_memory(r->error, r->file.path);
    }
    return true;
}

// --- the file

uint64_t gltf_new_id(void)
{
    static atomic_uint_fast64_t last;
    return atomic_fetch_add(&last, 1) + 1;
}

static bool read_all(struct gltf_reader *r)
{
    static const char *const keys[] = {"accessors", "animations", "buffers",  "bufferViews", "extensionsRequired",
                                       "images",    "materials",  "meshes",   "nodes",       "extensionsUsed",
                                       "scenes",    "skins",      "textures", "cameras",     "samplers"};
    const json_t *asset = json_object_get(r->file.json, "asset"), *least = json_object_get(asset, "minVersion");
    const json_t *extension;
    const char *version = json_string_value(least);
    size_t i, total = 0;
    gltf_at(r, "asset");
    if (!version) version = json_string_value(json_object_get(asset, "version"));
    if (!version || strncmp(version, "2.", 2) != 0 || (least && strcmp(version, "2.0") != 0))
        return gltf_bad(r, ".version: expected glTF 2.0, got %.20s", version ? version : "none");
    for (i = 0; i < sizeof keys / sizeof *keys; i++) {
        const json_t *member = json_object_get(r->file.json, keys[i]);
        gltf_at(r, "%s", keys[i]);
        if (member && !json_is_array(member)) return gltf_bad(r, ": expected an array, got something else");
        if (json_array_size(member) > INT32_MAX / 2) return gltf_bad(r, ": expected fewer");
    }
    json_array_foreach(gltf_array(r, "extensionsRequired"), i, extension)
    {
        const char *name = json_string_value(extension), *package = name ? glb_missing_codec(name) : NULL;
        gltf_at(r, "extensionsRequired[%zu]", i);
        if (package)
            return gltf_bad(
                r, ": expected meshes that are not compressed, got %.60s; export without compression%s%s%s", name,
                *package ? ", or install " : "", package, *package ? " and build wiggly again" : "");
    }
    if (!glb_read_buffers(&r->file, r->error)) return false;
    json_array_foreach(gltf_array(r, "extensionsUsed"), i, extension)
    {
        const char *name = json_string_value(extension);
        const bool shown = !name || !strcmp(name, "KHR_mesh_quantization") ||
                           !strcmp(name, "KHR_texture_transform") || !strcmp(name, GLTF_POLYGONS);
        if (!shown && !gltf_not_shown(r, "%.100s", name)) return false;
    }
    if (json_array_size(gltf_array(r, "cameras")) > 0 && !gltf_not_shown(r, "cameras")) return false;

    r->pixel_room = PIXEL_ROOM + r->file.room;
    r->gltf->path = gltf_text(r, r->file.path);
    r->gltf->id = gltf_new_id();
    if (!r->gltf->path || !gltf_read_materials(r) ||
        !name_all(r, gltf_array(r, "materials"), "material", false, r->gltf->materials, sizeof *r->gltf->materials) ||
        !read_meshes(r) || !name_by_shapes(r) || !read_nodes(r))
        return false;
    const size_t limit = r->file.room < VERTEX_LIMIT ? r->file.room : VERTEX_LIMIT;
    for (int n = 0; n < r->gltf->node_count; n++) total += (size_t)gltf_vertex_count(r->gltf, n);
    if (total > limit) // nodes may show a mesh several times
        return fail(r->error, ERROR_INPUT, "%s: nodes: expected at most %zu vertices together%s, got %zu",
                    r->file.path, limit, limit < VERTEX_LIMIT ? " in a file of this size" : "", total);
    if (!read_skins(r) || !read_clips(r)) return false;

    // The box of all vertices at rest or, without vertices, of the nodes.
    struct gltf *gltf = r->gltf;
    struct gltf_pose pose;
    int most = 0;
    for (int n = 0; n < gltf->node_count; n++) {
        int count = gltf_vertex_count(gltf, n);
        if (count > most) most = count;
    }
    float(*positions)[3] = pool_try(&r->work, (size_t)most, sizeof *positions);
    if (!positions || !gltf_pose_create(gltf, &pose)) return fail_no_memory(r->error, r->file.path);
    glm_vec3_fill(gltf->lo, INFINITY);
    glm_vec3_fill(gltf->hi, -INFINITY);
    for (int n = 0; n < gltf->node_count; n++) {
        int count = gltf_vertex_count(gltf, n);
        gltf_pose_vertices(gltf, &pose, n, positions, NULL);
        for (int v = 0; v < count; v++) {
            glm_vec3_minv(positions[v], gltf->lo, gltf->lo);
            glm_vec3_maxv(positions[v], gltf->hi, gltf->hi);
        }
    }
    for (int n = 0; most == 0 && n < gltf->node_count; n++) {
        glm_vec3_minv(pose.world[n] + 12, gltf->lo, gltf->lo);
        glm_vec3_maxv(pose.world[n] + 12, gltf->hi, gltf->hi);
    }
    gltf_pose_free(&pose);
    for (int k = 0; k < 3; k++) {
        if (!isfinite(gltf->lo[k]) || !isfinite(gltf->hi[k]))
            return fail(r->error, ERROR_INPUT, "%s: expected a size that can be shown, got an infinite one",
                        gltf->path);
    }
    return true;
}

/// Reads the opened file, if it is open, and closes it.
static bool read_open(struct gltf_reader *r, bool is_open)
{
    *r->gltf = (struct gltf){0};
    const bool done = is_open && read_all(r);
    r->gltf->room = r->file.room;
    pool_free(&r->work);
    glb_close(&r->file);
    if (!done) gltf_free(r->gltf);
    return done;
}

bool gltf_read(const char *path, struct gltf *gltf, struct error *error)
{
    struct gltf_reader r = {.gltf = gltf, .error = error};
    return read_open(&r, glb_open(&r.file, path, error));
}

bool gltf_read_stored(const char *path, struct gltf *gltf, struct error *error)
{
    struct gltf_reader r = {.gltf = gltf, .error = error, .stored = true};
    return read_open(&r, glb_open(&r.file, path, error));
}

bool gltf_read_bytes(const char *path, char *data, size_t size, struct gltf *gltf, struct error *error)
{
    struct gltf_reader r = {.gltf = gltf, .error = error};
    return read_open(&r, glb_open_bytes(&r.file, path, data, size, error));
}

// --- what was read

void gltf_link_nodes(struct gltf *gltf)
{
    for (int n = 0; n < gltf->node_count; n++) gltf->nodes[n].child = gltf->nodes[n].next = -1;
    for (int n = gltf->node_count - 1; n >= 0; n--) {
        struct gltf_node *node = &gltf->nodes[n];
        if (node->parent < 0) continue;
        node->next = gltf->nodes[node->parent].child;
        gltf->nodes[node->parent].child = n;
    }
}

int gltf_find_node(const struct gltf *gltf, const char *name)
{
    for (int n = 0; n < gltf->node_count; n++) {
        if (strcmp(gltf->nodes[n].name, name) == 0) return n;
    }
    return -1;
}

int gltf_find_clip(const struct gltf *gltf, const char *name)
{
    for (int i = 0; name && i < gltf->clip_count; i++) {
        if (strcmp(gltf->clips[i].name, name) == 0) return i;
    }
    return -1;
}

const char *gltf_target_name(const struct gltf_mesh *mesh, int target)
{
    return mesh->target_names ? mesh->target_names[target] : NULL;
}

char *gltf_target_label(const struct gltf_mesh *mesh, int target, struct pool *pool)
{
    char number[32];
    const char *name = gltf_target_name(mesh, target);
    snprintf(number, sizeof number, "target_%d", target);
    return pool_text(pool, name ? name : number, "", "");
}

int gltf_vertex_count(const struct gltf *gltf, int node)
{
    const struct gltf_mesh *mesh = gltf->nodes[node].mesh >= 0 ? &gltf->meshes[gltf->nodes[node].mesh] : NULL;
    int count = 0;
    for (int i = 0; mesh && i < mesh->part_count; i++) count += mesh->parts[i].vertex_count;
    return count;
}

void gltf_free(struct gltf *gltf)
{
    for (int i = 0; i < gltf->mesh_count; i++) json_decref(gltf->meshes[i].extras);
    for (int i = 0; i < gltf->image_count; i++) {
        free(gltf->images[i].bytes);
        free(gltf->images[i].pixels);
    }
    free(gltf->not_shown);
    pool_free(&gltf->pool);
    *gltf = (struct gltf){0};
}
