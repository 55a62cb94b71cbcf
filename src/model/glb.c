/// Opens .glb and .gltf files.
#include "model/glb.h"
#include "base/file.h"
#include "base/json.h"
#include "base/progress.h"
#include <stdlib.h>
#include <string.h>

enum { HEADER = 12, CHUNK_HEADER = 8 };

static uint32_t word_at(const char *bytes)
{
    uint32_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

static bool expected(const struct glb *glb, const char *what, struct error *error)
{
    return fail(error, ERROR_INPUT, "%s: expected %s, got something else", glb->path, what);
}

static bool read_json(struct glb *glb, const char *text, size_t length, struct error *error)
{
    json_error_t wrong;
    while (length > 0 && text[length - 1] == '\0') length--; // how some writers fill a chunk up
    // The JSON library reads over a NUL, where all else sees the end of the text.
    if (memchr(text, '\0', length))
        return fail(error, ERROR_INPUT, "%s: JSON: expected text, got a NUL byte", glb->path);
    glb->json = json_read(text, length, 0, &wrong);
    if (!glb->json && json_error_code(&wrong) == json_error_out_of_memory) return fail_no_memory(error, glb->path);
    if (!glb->json) return fail(error, ERROR_INPUT, "%s: JSON, line %d: %s", glb->path, wrong.line, wrong.text);
    return true;
}

static bool read_chunks(struct glb *glb, size_t size, struct error *error)
{
    bool is_glb = size >= HEADER + CHUNK_HEADER && word_at(glb->data) == GLB_MAGIC && word_at(glb->data + 4) == 2;
    if (!is_glb) return expected(glb, "a binary glTF 2.0 file (.glb)", error);
    size_t length = word_at(glb->data + HEADER), end = HEADER + CHUNK_HEADER + length;
    if (word_at(glb->data + 8) > size || end > size)
        return fail(error, ERROR_INPUT, "%s: expected a file of %u bytes, got %zu: it is not whole", glb->path,
                    word_at(glb->data + 8), size);
    if (word_at(glb->data + HEADER + 4) != GLB_JSON) return expected(glb, "JSON in the first chunk", error);
    if (end + CHUNK_HEADER <= size && word_at(glb->data + end + 4) == GLB_BIN) {
        struct glb_bytes *chunk = &glb->chunk;
        *chunk = (struct glb_bytes){(const unsigned char *)glb->data + end + CHUNK_HEADER, word_at(glb->data + end)};
        if (chunk->size > size - end - CHUNK_HEADER) return expected(glb, "a binary chunk as long as it says", error);
    }
    return read_json(glb, glb->data + HEADER + CHUNK_HEADER, length, error);
}

bool glb_open_bytes(struct glb *glb, const char *path, char *data, size_t size, struct error *error)
{
    *glb = (struct glb){.path = path, .data = data, .room = GLB_ROOM + GLB_GROWTH * size};
    stage_tell("reading a glTF file", 0, (long)size);
    const bool binary = size >= 4 && word_at(data) == GLB_MAGIC;
    const bool parsed = binary ? read_chunks(glb, size, error) : read_json(glb, data, size, error);
    if (parsed && (json_is_object(glb->json) || expected(glb, "a JSON object", error))) return true;
    glb_close(glb);
    return false;
}

bool glb_open(struct glb *glb, const char *path, struct error *error)
{
    char *data;
    size_t size;
    return file_read(path, GLB_FILE_LIMIT, &data, &size, error) && glb_open_bytes(glb, path, data, size, error);
}

void glb_close(struct glb *glb)
{
    for (int i = 0; i < glb->buffer_count; i++) free(glb->buffers[i].owned);
    free(glb->buffers);
    json_decref(glb->json);
    free(glb->data);
    *glb = (struct glb){0};
}

int64_t glb_integer(const json_t *object, const char *key, int64_t otherwise)
{
    const json_t *member = json_object_get(object, key);
    if (!member) return otherwise;
    json_int_t value = json_is_integer(member) ? json_integer_value(member) : -1;
    return value >= 0 && value <= INT32_MAX ? (int64_t)value : -1;
}
