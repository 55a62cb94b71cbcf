/// Gathers the bytes of a glTF file.
#include "export/gltf_gather.h"
#include <stdlib.h>
#include <string.h>

struct gathered {
    struct glb *file;
    unsigned char *bytes;
    size_t size;
};

/// Adds bytes where a multiple of 4 begins; `start` is there. False if memory is short.
static bool add(struct gathered *gathered, struct glb_bytes bytes, size_t *start)
{
    *start = (gathered->size + 3) / 4 * 4;
    unsigned char *larger = realloc(gathered->bytes, *start + bytes.size + 1);
    if (!larger) return false;
    memset(larger + gathered->size, 0, *start - gathered->size);
    if (bytes.size > 0) memcpy(larger + *start, bytes.at, bytes.size);
    gathered->bytes = larger;
    gathered->size = *start + bytes.size;
    return true;
}

/// Lets a view, or an extension of one, find its bytes again. False if memory is short.
static bool move(json_t *view, const size_t *starts, size_t count)
{
    const int64_t buffer = glb_integer(view, "buffer", -1), offset = glb_integer(view, "byteOffset", 0);
    if (buffer < 0 || (size_t)buffer >= count || offset < 0) return true;
    return json_object_set_new(view, "buffer", json_integer(0)) == 0 &&
           (starts[buffer] == 0 ||
            json_object_set_new(view, "byteOffset", json_integer(offset + (json_int_t)starts[buffer])) == 0);
}

static bool gather_buffers(struct gathered *gathered)
{
    json_t *buffers = json_object_get(gathered->file->json, "buffers"), *view, *extension;
    const size_t count = json_array_size(buffers);
    size_t *starts = calloc(count + 1, sizeof *starts), i;
    bool done = starts;
    for (size_t b = 0; done && b < count; b++) {
        done = add(gathered, gathered->file->buffers[b].bytes, &starts[b]); // views may reach beyond the byteLength
    }
    json_array_foreach(json_object_get(gathered->file->json, "bufferViews"), i, view)
    {
        const char *name;
        done = done && move(view, starts, count);
        json_object_foreach(json_object_get(view, "extensions"), name, extension) done =
            done && move(extension, starts, count);
    }
    free(starts);
    return done;
}

/// What kind of picture the bytes are; NULL: of none that is known.
static const char *kind_of(struct glb_bytes bytes)
{
    static const struct {
        const char *start, *kind;
        size_t length;
    } kinds[] = {{"\x89PNG", "image/png", 4}, {"\xFF\xD8", "image/jpeg", 2}, {"\xABKTX 20", "image/ktx2", 7}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (bytes.size >= kinds[i].length && memcmp(bytes.at, kinds[i].start, kinds[i].length) == 0)
            return kinds[i].kind;
    }
    const bool webp = bytes.size >= 12 && memcmp(bytes.at, "RIFF", 4) == 0 && memcmp(bytes.at + 8, "WEBP", 4) == 0;
    return webp ? "image/webp" : NULL;
}

/// A picture that cannot be read, which is not shown either, keeps its address.
static bool gather_image(struct gathered *gathered, json_t *views, json_t *image)
{
    const char *uri = json_string_value(json_object_get(image, "uri"));
    struct glb_buffer picture;
    struct error why = {0};
    size_t start;
    if (!uri) return true;
    if (!glb_read_uri(gathered->file, uri, &picture, &why)) return why.kind != ERROR_ENVIRONMENT; // memory is short
    const char *kind = kind_of(picture.bytes);
    bool done = true;
    if (kind) {
        const json_int_t view = (json_int_t)json_array_size(views);
        done = add(gathered, picture.bytes, &start) &&
               json_array_append_new(views, json_pack("{s:i, s:I, s:I}", "buffer", 0, "byteOffset", (json_int_t)start,
                                                      "byteLength", (json_int_t)picture.bytes.size)) == 0 &&
               json_object_set_new(image, "bufferView", json_integer(view)) == 0 &&
               json_object_set_new(image, "mimeType", json_string(kind)) == 0;
        json_object_del(image, "uri");
    }
    free(picture.owned);
    return done;
}

static bool gather_images(struct gathered *gathered)
{
    json_t *root = gathered->file->json, *image;
    json_t *views = json_incref(json_object_get(root, "bufferViews"));
    size_t i;
    bool done = true;
    if (!views) views = json_array();
    json_array_foreach(json_object_get(root, "images"), i, image) done = done && gather_image(gathered, views, image);
    if (json_array_size(views) > 0) done = done && json_object_set(root, "bufferViews", views) == 0;
    done = done && views;
    json_decref(views);
    return done;
}

bool gltf_gather(struct glb *file, struct glb_buffer *bytes, struct error *error)
{
    struct gathered gathered = {.file = file};
    if (!glb_read_buffers(file, error)) return false;
    bool done = gather_buffers(&gathered) && gather_images(&gathered);
    if (gathered.size > 0)
        done = done && json_object_set_new(file->json, "buffers",
                                           json_pack("[{s:I}]", "byteLength", (json_int_t)gathered.size)) == 0;
    if (!done) {
        free(gathered.bytes);
        return fail_no_memory(error, file->path);
    }
    *bytes = (struct glb_buffer){{gathered.bytes, gathered.size}, gathered.bytes};
    return true;
}
