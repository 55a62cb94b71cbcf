/// Characters in .glb and .gltf, by every reader of them: imported, as a surface, and as a character of ours; and what is drawn of them.
#include "draw/posed.h"
#include "rig/models.h"
#include "surface.h"
#include <stdlib.h>

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

static void draw(const struct imported *imported)
{
    static const float eye[3] = {0, 0, 1};
    const struct stage_model shown = {
        .gltf = &imported->gltf, .pose = &imported->rest, .root = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    struct posed mesh;
    posed_from_gltf(&mesh, shown.gltf);
    posed_pose_gltf(&mesh, &shown, eye);
    fuzz_outlines(&mesh, eye);
    posed_free(&mesh);
}

static void import(const char *path)
{
    struct error error = {0};
    struct imported imported;
    const bool good = imported_read(&imported, path, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a model is refused with a sentence");
    if (!good) return;
    for (int clip = -1; clip < imported.gltf.clip_count && clip < 3; clip++)
        pose_at(&imported, clip, clip < 0 ? 0 : 0.6 * imported.gltf.clips[clip].last, &imported.rest);
    draw(&imported);
    imported_free(&imported);
}

static void open_character(const char *path)
{
    struct error error = {0};
    struct character character;
    const bool good = character_read(path, &character, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a character is refused with a sentence");
    if (good) fuzz_figure(&character);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const bool glb = fuzz_is_glb(data, size);
    const char *path = fuzz_file(glb ? "fuzz.glb" : "fuzz.gltf", data, size);
    import(path);
    fuzz_surface(path);
    open_character(path);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_gltf(data, size, most, seed);
}
