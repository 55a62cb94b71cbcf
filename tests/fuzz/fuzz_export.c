/// Exports of imported characters: whatever opens is exported, in a format that the input's size chooses, and what is glTF opens again.
#include "export/export.h"
#include "fuzz.h"
#include "model/gltf.h"
#include "rig/models.h"
#include "scene/load.h"
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const outputs[] = {"out.glb", "out.gltf", "out.usda", "out.bvh", "out.npy"};
enum { OUTPUTS = sizeof outputs / sizeof *outputs, GLTF_OUTPUTS = 2 };

/// The deepest node, and in `from` its parent's parent or what there is; −1 where there are no two.
static int deepest(const struct gltf *gltf, int *from)
{
    int found = -1, most = 0;
    for (int node = 0; node < gltf->node_count; node++) {
        int depth = 0;
        for (int at = node; gltf->nodes[at].parent >= 0; at = gltf->nodes[at].parent) depth++;
        if (depth > most) found = node, most = depth;
    }
    if (found >= 0) *from = gltf->nodes[found].parent;
    if (most > 1) *from = gltf->nodes[*from].parent;
    return found;
}

/// A scene that shows the model, with a chain that moves its deepest bones.
static json_t *scene_json(const char *model, const struct gltf *gltf)
{
    int from = 0, to = deepest(gltf, &from);
    json_t *scene =
        json_pack("{s:i, s:[i,i], s:[{s:s, s:f, s:[{s:i, s:f}, {s:i, s:f}]}], s:[{s:s, s:s, s:s}]}", "wiggly", 1,
                  "frames", 0, 2, "splines", "name", "wag", "frequency", 2.0, "knots", "frame", 0, "value", 1.0,
                  "frame", 2, "value", -1.0, "rigs", "type", "model", "name", "it", "model", model);
    if (to < 0) return scene;
    json_array_append_new(json_object_get(scene, "rigs"),
                          json_pack("{s:s, s:s, s:s, s:s, s:s, s:[{s:s, s:s, s:f}]}", "type", "chain", "name", "tail",
                                    "model", "it", "from", gltf->nodes[from].name, "to", gltf->nodes[to].name,
                                    "channels", "spline", "wag", "axis", "side", "gain", 9.0));
    return scene;
}

/// NULL where the model is refused, or its bones are no chain.
static struct document *scene_of(const char *model, struct error *error)
{
    struct gltf gltf;
    if (!gltf_read(model, &gltf, error)) return NULL;
    json_t *json = scene_json(model, &gltf);
    char *text = json_dumps(json, 0);
    fuzz_expect(text != NULL, "names are text");
    struct document *document = scene_parse("scene.json", text, strlen(text), NULL, error);
    free(text);
    json_decref(json);
    gltf_free(&gltf);
    return document;
}

static void export_to(const struct posing *posing, const char *path, bool is_gltf)
{
    const struct export_options options = {.clip = "moved"};
    struct export_report report;
    struct error error = {0};
    const bool good = export_write(posing, path, &options, &report, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "an export is refused with a sentence");
    if (!good || !is_gltf) return;
    struct gltf gltf;
    if (!gltf_read(path, &gltf, &error)) fuzz_expect(false, error.text);
    gltf_free(&gltf);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char model[128];
    struct error error = {0};
    struct evaluation evaluation = {0};
    const size_t output = size % OUTPUTS;
    snprintf(model, sizeof model, "%s", fuzz_file(fuzz_is_glb(data, size) ? "fuzz.glb" : "fuzz.gltf", data, size));
    struct document *document = scene_of(model, &error);
    if (!document) return 0;
    struct models *models = models_create();
    if (models_update(models, document, &error)) {
        evaluation_update(&evaluation, document, false);
        const struct posing posing = {.document = document, .evaluation = &evaluation, .models = models};
        export_to(&posing, fuzz_file(outputs[output], "", 0), output < GLTF_OUTPUTS);
    }
    evaluation_free(&evaluation);
    models_destroy(models);
    document_destroy(document);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_gltf(data, size, most, seed);
}
