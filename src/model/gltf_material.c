/// Reads materials: base colour, texture and transparency; and decodes PNG and JPEG pictures from buffer views, data URIs and files.
#include "model/glb.h"
#include <limits.h>
#include <stdlib.h>
#include <string.h>

static _Thread_local bool starved; ///< the picture library ran out of memory; it does not say so

static void *noted(void *memory)
{
    starved |= !memory;
    return memory;
}

// The implementation is included here only; it does not compile under our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#ifdef __clang__ // for fuzzing: in a broken JPEG the library's numbers wrap; memory errors are still found
#pragma clang attribute push(__attribute__((no_sanitize("shift", "signed-integer-overflow"))), apply_to = function)
#endif
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_MAX_DIMENSIONS 16384
// A scan may name a table that the file lacks. Then it is zeros, and not old memory.
#define STBI_MALLOC(size) noted(calloc(1, size))
#define STBI_REALLOC(old, size) noted(realloc(old, size))
#define STBI_FREE free
#include <stb/stb_image.h>
#ifdef __clang__
#pragma clang attribute pop
#endif
#pragma GCC diagnostic pop

// --- checks before decoding: the chunks of a PNG (ISO 15948) and the segments of a JPEG (ITU T.81, annex B)

enum { MARKER = 0xFF, START = 0xD8, END = 0xD9, FIRST_RESTART = 0xD0, HUFFMAN_TABLES = 0xC4 };
enum { LENGTHS = 16, MOST_CODES = 256 };
enum { SIGNATURE = 8, CHUNK_HEAD = 8, CHUNK_TAIL = 4 };

/// Whether a JPEG's Huffman tables lie within their segments and have at most 256 codes: otherwise stb_image up to 2.28 writes past its tables.
static bool jpeg_is_sound(const unsigned char *at, const unsigned char *end)
{
    while ((at = memchr(at, MARKER, (size_t)(end - at)))) { // coded samples may lie between
        while (at < end && *at == MARKER) at++;
        if (at == end || *at == END) return true;
        const int marker = *at++;
        const bool alone = marker == 0 || (marker >= FIRST_RESTART && marker <= START);
        if (alone) continue;
        const long length = end - at < 2 ? 0 : at[0] << 8 | at[1];
        if (length < 2 || length > end - at) return marker != HUFFMAN_TABLES;
        const unsigned char *table = at + 2;
        at += length;
        while (marker == HUFFMAN_TABLES &&
               table < at) { // an identifying byte, the number of codes of each length, the codes
            int codes = 0;
            if (at - table < 1 + LENGTHS) return false;
            for (int i = 1; i <= LENGTHS; i++) codes += table[i];
            if (codes > MOST_CODES || codes > at - table - 1 - LENGTHS) return false;
            table += 1 + LENGTHS + codes;
        }
    }
    return true;
}

/// Whether a PNG's chunks end within the file and its data does not begin with an empty one: otherwise stb_image allocates what a chunk claims,
/// and copies an empty one to nowhere.
static bool png_is_sound(const unsigned char *at, const unsigned char *end)
{
    bool has_data = false;
    for (at += SIGNATURE; end - at >= CHUNK_HEAD;) {
        const long length = (long)at[0] << 24 | at[1] << 16 | at[2] << 8 | at[3];
        if (memcmp(at + 4, "IEND", 4) == 0) return true;
        const bool is_data = memcmp(at + 4, "IDAT", 4) == 0;
        if (is_data && length == 0 && !has_data) return false;
        has_data |= is_data;
        if (length > end - at - CHUNK_HEAD - CHUNK_TAIL) return false;
        at += CHUNK_HEAD + length + CHUNK_TAIL;
    }
    return true;
}

// --- pictures

enum { PIXELS_A_BYTE = 8256 }; // the most that deflate packs into a byte, at one bit per pixel

static bool fail_starved(struct error *error) { return fail(error, ERROR_ENVIRONMENT, "not enough memory"); }

bool gltf_decode_image(const unsigned char *bytes, size_t size, size_t most, struct gltf_image *image,
                       struct error *error)
{
    const unsigned char *end = bytes + size;
    const bool is_png = size >= SIGNATURE && memcmp(bytes, "\x89PNG", 4) == 0;
    const bool is_jpeg = !is_png && size > 0 && bytes[0] == MARKER; // may begin with padding
    int channels, length = size <= INT_MAX ? (int)size : 0;
    if ((is_png && !png_is_sound(bytes, end)) || (is_jpeg && !jpeg_is_sound(bytes, end)))
        return fail(error, ERROR_INPUT, "expected PNG or JPEG: a part of it is too large, or empty");
    starved = false;
    if (!stbi_info_from_memory(bytes, length, &image->width, &image->height, &channels))
        return starved ? fail_starved(error)
                       : fail(error, ERROR_INPUT, "expected PNG or JPEG of at most %d pixels a side: %s",
                              STBI_MAX_DIMENSIONS, stbi_failure_reason());
    size_t pixels = (size_t)image->width * (size_t)image->height;
    if (pixels / PIXELS_A_BYTE > size || 4 * pixels > most)
        return fail(error, ERROR_INPUT, "too large with %d by %d", image->width, image->height);
    image->pixels = stbi_load_from_memory(bytes, length, &image->width, &image->height, &channels, 4);
    if (image->pixels) return true;
    return starved ? fail_starved(error) : fail(error, ERROR_INPUT, "%s", stbi_failure_reason());
}

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
    return fail_starved(why);
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

bool gltf_read_materials(struct gltf_reader *r)
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
