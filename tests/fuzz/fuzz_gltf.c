/// Characters in .glb and .gltf, by every reader of them: imported, as a surface, and as a character of ours.
#include "model/character.h"
#include "rig/imported.h"
#include "surface.h"
#include <stdlib.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

enum { HEADER = 12, CHUNK = 8 };

static uint32_t word_at(const uint8_t *data)
{
    uint32_t word;
    memcpy(&word, data, sizeof word);
    return word;
}

static void put_word(uint8_t *data, size_t word)
{
    const uint32_t bits = (uint32_t)word;
    memcpy(data, &bits, sizeof bits);
}

/// All that a pose of a model says.
static void pose_at(const struct imported *imported, int clip, double time, struct gltf_pose *pose)
{
    const struct gltf *gltf = &imported->gltf;
    float lo[3], hi[3];
    gltf_pose_clip(gltf, clip, time, pose);
    gltf_pose_world(gltf, pose);
    gltf_bounds_at(&imported->bounds, gltf, pose, lo, hi);
    for (int node = 0; node < gltf->node_count; node++) {
        const size_t count = (size_t)gltf_vertex_count(gltf, node) + 1;
        float(*vectors)[3] = malloc(2 * count * sizeof *vectors);
        gltf_pose_vertices(gltf, pose, node, vectors, vectors + count);
        free(vectors);
    }
}

static void import(const char *path)
{
    struct error error = {0};
    struct imported imported;
    const bool good = imported_read(&imported, path, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a model is refused with a sentence");
    if (!good) return;
    for (int clip = -1; clip < imported.gltf.clip_count && clip < 3; clip++)
        pose_at(&imported, clip, clip < 0 ? 0 : 0.6 * imported.gltf.clips[clip].duration, &imported.rest);
    imported_free(&imported);
}

static void open_character(const char *path)
{
    struct error error = {0};
    struct character character;
    const bool good = character_read(path, &character, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a character is refused with a sentence");
    if (good) character_free(&character);
}

static bool is_glb(const uint8_t *data, size_t size)
{
    return size >= HEADER + CHUNK && memcmp(data, "glTF", 4) == 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const bool glb = is_glb(data, size);
    const char *path = fuzz_file(glb ? "fuzz.glb" : "fuzz.gltf", data, size);
    import(path);
    fuzz_surface(path);
    if (glb) open_character(path);
    return 0;
}

/// Keeps the frame of a .glb whole: its chunk of JSON is changed as JSON, padded, and the lengths say so.
static size_t mutate_glb(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    const size_t start = HEADER + CHUNK, length = word_at(data + HEADER), end = start + length;
    if (length > size - start || most < size + 4) return LLVMFuzzerMutate(data, size, most);
    if (seed % 8 == 0 && size > end + CHUNK) // the numbers in the other chunk
        return end + CHUNK + LLVMFuzzerMutate(data + end + CHUNK, size - end - CHUNK, size - end - CHUNK);
    const size_t behind = size - end;
    size_t now = fuzz_mutate_json(data, size, most - 4, start, end, seed);
    if (now < start + behind || !is_glb(data, now) || word_at(data + HEADER) != length)
        return now; // changed as bytes
    size_t json = now - start - behind, padding = (4 - json % 4) % 4;
    memmove(data + start + json + padding, data + start + json, behind);
    memset(data + start + json, ' ', padding);
    put_word(data + HEADER, json + padding);
    put_word(data + 8, now + padding);
    return now + padding;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return is_glb(data, size) ? mutate_glb(data, size, most, seed)
                              : fuzz_mutate_json(data, size, most, 0, size, seed);
}
