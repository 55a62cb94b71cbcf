/// Builds .gltf files in tests: add accessors one by one; the test supplies the rest of the JSON, with ' for ".
#ifndef TESTS_GLTF_BUILDER_H
#define TESTS_GLTF_BUILDER_H

#include "model/gltf.h"
#include "near.h"
#include "temporary.h"

enum { BYTE = 5120, UBYTE = 5121, SHORT = 5122, USHORT = 5123, UINT = 5125, FLOAT = 5126 };

struct builder {
    unsigned char bytes[1 << 15];
    size_t size;
    char views[1 << 13], accessors[1 << 13], json[1 << 16];
    int view_count, accessor_count;
    const char *buffers; ///< more of them, each after a comma; NULL: none
    struct gltf gltf;    ///< the result of read_built()
};

/// A test that reads what it builds: GLTF_TEST(name) { add_data(b, …); read_built(b, members); … b->gltf … }.
#define GLTF_TEST(name) TEST_OF(struct builder, b, , gltf_free(&b->gltf), name)

static inline int add_view(struct builder *b, const void *data, size_t size, int stride)
{
    char *end = b->views + strlen(b->views);
    while (b->size % 4) b->size++;
    end += sprintf(end, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu", b->view_count ? "," : "", b->size,
                   size);
    sprintf(end, stride ? ",\"byteStride\":%d}" : "}", stride);
    if (b->size + size > sizeof b->bytes) abort();
    memcpy(b->bytes + b->size, data, size);
    b->size += size;
    return b->view_count++;
}

/// `more` contains further members, each after a comma.
static inline int add_accessor(struct builder *b, int component, const char *type, int count, const char *more)
{
    char *end = b->accessors + strlen(b->accessors);
    sprintf(end, "%s{\"componentType\":%d,\"type\":\"%s\",\"count\":%d%s}", b->accessor_count ? "," : "", component,
            type, count, more);
    return b->accessor_count++;
}

/// An accessor with its own view.
static inline int add_data(struct builder *b, int component, const char *type, int count, const void *data,
                           size_t size)
{
    char view[64];
    snprintf(view, sizeof view, ",\"bufferView\":%d", add_view(b, data, size, 0));
    return add_accessor(b, component, type, count, view);
}

/// An accessor of numbers, `each` an element: ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0).
#define ADD(b, component, numbers, each, ...)                                                                        \
    add_numbers(b, component, "", each, sizeof(numbers), (const numbers[]){__VA_ARGS__},                             \
                sizeof((const numbers[]){__VA_ARGS__}))
#define ADD_NORMALISED(b, component, numbers, each, ...)                                                             \
    add_numbers(b, component, ",'normalized':true", each, sizeof(numbers), (const numbers[]){__VA_ARGS__},           \
                sizeof((const numbers[]){__VA_ARGS__}))

static inline int add_numbers(struct builder *b, int component, const char *more, int each, size_t bytes,
                              const void *data, size_t size)
{
    static const char *const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4", [16] = "MAT4"};
    char view[64];
    snprintf(view, sizeof view, ",'bufferView':%d%s", add_view(b, data, size, 0), more);
    return add_accessor(b, component, types[each], (int)(size / bytes) / each, view);
}

/// Puts " for each '.
static inline char *quote(char *text)
{
    for (char *at = text; (at = strchr(at, '\'')); at++) *at = '"';
    return text;
}

static inline char *append_base64(char *out, const unsigned char *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        unsigned word =
            (unsigned)bytes[i] << 16 | (left > 1 ? bytes[i + 1] : 0u) << 8 | (left > 2 ? bytes[i + 2] : 0u);
        for (unsigned k = 0; k < 4; k++) *out++ = k > left ? '=' : digits[word >> (18 - 6 * k) & 63];
    }
    *out = '\0';
    return out;
}

/// The JSON of the file, with these members.
static inline const char *builder_json(struct builder *b, const char *members)
{
    char *end = b->json + sprintf(b->json,
                                  "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%zu,\"uri\":"
                                  "\"data:application/octet-stream;base64,",
                                  b->size);
    end = append_base64(end, b->bytes, b->size);
    sprintf(end, "\"}%s],\"bufferViews\":[%s],\"accessors\":[%s],%s}", b->buffers ? b->buffers : "", b->views,
            b->accessors, members);
    return quote(b->json);
}

/// Writes the file; returns its path.
static inline const char *write_built(struct builder *b, const char *name, const char *members)
{
    const char *text = builder_json(b, members);
    return temporary_file(name, text, strlen(text));
}

/// A .glb of a JSON text, with ' for ", and bytes; returns its size.
static inline size_t put_glb(char *out, const char *json, const void *bytes, size_t size)
{
    const uint32_t length = ((uint32_t)strlen(json) + 3) / 4 * 4, room = (uint32_t)size;
    const uint32_t header[5] = {0x46546C67, 2, 28 + length + room, length, 0x4E4F534A}, chunk[2] = {room, 0x004E4942};
    memcpy(out, header, sizeof header);
    sprintf(out + sizeof header, "%-*s", (int)length, json);
    quote(out + sizeof header);
    memcpy(out + 20 + length, chunk, sizeof chunk);
    memcpy(out + 28 + length, bytes, size);
    return header[2];
}

static inline void read_text(const char *text, struct gltf *gltf)
{
    assert_done(gltf_read(temporary_file("model.gltf", text, strlen(text)), gltf, &error));
}

static inline void read_built(struct builder *b, const char *members)
{
    read_text(builder_json(b, members), &b->gltf);
}

#endif
