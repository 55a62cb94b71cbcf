/// Decodes the pictures of glTF files: PNG and JPEG from buffer views, data URIs and files.
#include "model/gltf_read.h"
#include <limits.h>
#include <stdlib.h>
#include <string.h>

static _Thread_local bool starved; ///< the library, which says only what it was about

static void *noted(void *memory)
{
    starved |= !memory;
    return memory;
}

// The implementation lives here and nowhere else; the library is not written for our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#ifdef __clang__ // which fuzzes: of a broken JPEG the library's numbers wrap; what it does to memory is checked all the same
#pragma clang attribute push(__attribute__((no_sanitize("shift", "signed-integer-overflow"))), apply_to = function)
#endif
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_MAX_DIMENSIONS 16384
// A scan may name a table that the file does not have: it is then of zeros, not of what lay there before.
#define STBI_MALLOC(size) noted(calloc(1, size))
#define STBI_REALLOC(old, size) noted(realloc(old, size))
#define STBI_FREE free
#include <stb/stb_image.h>
#ifdef __clang__
#pragma clang attribute pop
#endif
#pragma GCC diagnostic pop

// --- what a picture must hold to before it is decoded: the chunks of a PNG (ISO 15948) and the segments of a JPEG (ITU T.81, annex B)

enum { MARKER = 0xFF, START = 0xD8, END = 0xD9, FIRST_RESTART = 0xD0, HUFFMAN_TABLES = 0xC4 };
enum { LENGTHS = 16, MOST_CODES = 256 };
enum { SIGNATURE = 8, CHUNK_HEAD = 8, CHUNK_TAIL = 4 };

/// A segment's tables: a byte that names it, how many codes there are of each length, the codes.
static bool tables_fit(const unsigned char *at, const unsigned char *end)
{
    while (at < end) {
        int codes = 0;
        if (end - at < 1 + LENGTHS) return false;
        for (int i = 1; i <= LENGTHS; i++) codes += at[i];
        if (codes > MOST_CODES || codes > end - at - 1 - LENGTHS) return false;
        at += 1 + LENGTHS + codes;
    }
    return true;
}

/// Behind the next marker, or NULL. What is no marker lies between, as coded samples do.
static const unsigned char *next_marker(const unsigned char *at, const unsigned char *end, int *marker)
{
    at = memchr(at, MARKER, (size_t)(end - at));
    while (at && at < end && *at == MARKER) at++;
    if (!at || at == end) return NULL;
    *marker = *at;
    return at + 1;
}

static bool jpeg_is_sound(const unsigned char *at, const unsigned char *end)
{
    int marker = 0;
    while ((at = next_marker(at, end, &marker)) && marker != END) {
        const bool alone = marker == 0 || (marker >= FIRST_RESTART && marker <= START);
        if (alone) continue;
        const long length = end - at < 2 ? 0 : at[0] << 8 | at[1];
        if (length < 2 || length > end - at) return marker != HUFFMAN_TABLES;
        if (marker == HUFFMAN_TABLES && !tables_fit(at + 2, at + length)) return false;
        at += length;
    }
    return true;
}

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

/// Whether a PNG's chunks end within the file and its data does not begin with an empty one, and a JPEG's Huffman tables within their
/// segments and have 256 codes at most: stb_image takes memory for what a chunk claims, copies an empty one to nowhere, and up to 2.28
/// writes past its tables. True of what is neither.
static bool is_sound(const unsigned char *bytes, size_t size)
{
    if (size >= SIGNATURE && memcmp(bytes, "\x89PNG", 4) == 0) return png_is_sound(bytes, bytes + size);
    if (size > 0 && bytes[0] == MARKER) return jpeg_is_sound(bytes, bytes + size); // its start may be filled up
    return true;
}

// --- pictures

enum { PIXELS_A_BYTE = 8256 }; // what deflate packs into a byte at most, at a bit a pixel

/// The encoded bytes. `why` says what is wrong with them.
static bool find_bytes(struct gltf_reader *r, const json_t *image, struct glb_buffer *bytes, struct error *why)
{
    const char *uri = json_string_value(json_object_get(image, "uri"));
    size_t before = r->file.room;
    *bytes = (struct glb_buffer){0};
    bool found = uri ? glb_read_uri(&r->file, uri, bytes, why)
                     : glb_view(&r->file, glb_integer(image, "bufferView", -1), &bytes->bytes);
    r->pixel_room += r->file.room - before;
    if (!found && !uri) return fail(why, ERROR_INPUT, "no bytes in the file");
    return found;
}

static bool fail_starved(struct error *error) { return fail(error, ERROR_ENVIRONMENT, "not enough memory"); }

bool gltf_decode_image(const unsigned char *bytes, size_t size, size_t most, struct gltf_image *image,
                       struct error *error)
{
    int channels, length = size <= INT_MAX ? (int)size : 0;
    if (!is_sound(bytes, size))
        return fail(error, ERROR_INPUT, "expected PNG or JPEG: a part of it is larger than it may be, or empty");
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

/// The name for people: the image's own, or its file's.
static const char *name_of(const json_t *image)
{
    const char *name = json_string_value(json_object_get(image, "name"));
    const char *uri = json_string_value(json_object_get(image, "uri"));
    if (name && name[0]) return name;
    return uri && strncmp(uri, "data:", 5) != 0 ? uri : "of no name";
}

/// Keeps the encoded bytes, and unless they are only stored, decodes them. `why` says why it cannot.
static bool read_picture(struct gltf_reader *r, const json_t *json, struct gltf_image *image, struct error *why)
{
    const char *name = json_string_value(json_object_get(json, "name"));
    struct glb_buffer bytes;
    if (!find_bytes(r, json, &bytes, why)) return false;
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
    image->name = name && name[0] ? strdup(name) : NULL;
    image->size = size;
    if (image->bytes && !bytes.owned) memcpy(image->bytes, bytes.bytes.at, size);
    if (image->bytes && (image->name || !name || !name[0])) return true;
    free(image->pixels);
    free(image->bytes);
    free(image->name);
    return fail_starved(why);
}

bool gltf_read_image(struct gltf_reader *r, int number, int *index)
{
    const json_t *json = json_array_get(gltf_array(r, "images"), (size_t)number);
    struct gltf_image *image = &r->gltf->images[r->gltf->image_count];
    struct error why = {0};
    if (r->image_of[number] == -2) {
        const bool read = read_picture(r, json, image, &why);
        if (!read) *image = (struct gltf_image){0};
        r->image_of[number] = read ? r->gltf->image_count++ : -1;
        if (why.kind == ERROR_ENVIRONMENT) return fail_no_memory(r->error, r->file.path);
        if (!read && !gltf_not_shown(r, "image %.40s (%.60s)", name_of(json), why.text)) return false;
    }
    *index = r->image_of[number];
    return true;
}
