/// The fuzz targets (`make fuzz`): a row for each reader, which hands the fuzzer's bytes to it and says what must hold. FUZZ_READER in the
/// environment names the row; without it the program prints all names.
#include "fuzz.h"
#include "app/personal.h"
#include "app/replay.h"
#include "base/file.h"
#include "commands/companion.h"
#include "draw/posed.h"
#include "export/export.h"
#include "model/adjacency.h"
#include "model/figure.h"
#include "model/gltf.h"
#include "model/motion.h"
#include "model/surface.h"
#include "regress/log.h"
#include "rig/models.h"
#include "scene/load.h"
#include "simulation/integrator.h"
#include "simulation/soft.h"
#include <fcntl.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// What libFuzzer calls.
int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);

/// Loads and saves, in a format of ours; NULL where the data is refused.
typedef char *save(const char *data, size_t size, size_t *saved_size, struct error *error);

static struct {
    const uint8_t *data;
    size_t size;
} input;

static char folder[64];

/// Ends the run as a finding.
static void expect(bool good, const char *what)
{
    if (good) return;
    fprintf(stderr, "not true: %s\n", what);
    abort();
}

/// Whether a file was taken: what is refused is so with a sentence, and nothing else has one.
static bool taken(bool good, const struct error *error)
{
    expect(good == (error->kind == ERROR_NONE), "what is refused has a sentence");
    return good;
}

static void remove_folder(void)
{
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    if (system(command) != 0) perror(folder);
}

/// Writes a file, in memory where the system can, and returns its path; the same storage at each call.
static const char *file_of(const char *name, const void *data, size_t size)
{
    static char path[128];
    if (!folder[0]) {
        snprintf(folder, sizeof folder, "%s/wiggly-fuzz-XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
        if (!mkdtemp(folder)) abort();
        atexit(remove_folder);
    }
    snprintf(path, sizeof path, "%s/%s", folder, name);
    int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || write(file, data, size) != (ssize_t)size || close(file) != 0) abort();
    return path;
}

static char *bytes_of(const char *path, size_t *size)
{
    char *data;
    expect(file_read(path, (size_t)1 << 30, &data, size, NULL), "a file that was written can be read");
    return data;
}

/// What one load and save gives, the next one gives again.
static void save_twice(save *save)
{
    struct error error = {0};
    size_t sizes[2];
    char *first = save((const char *)input.data, input.size, &sizes[0], &error);
    if (!taken(first != NULL, &error)) return;
    char *second = save(first, sizes[0], &sizes[1], &error);
    expect(second != NULL, error.text);
    if (sizes[0] != sizes[1] || memcmp(first, second, sizes[0]) != 0) {
        fprintf(stderr, "first:\n%.*s\nsecond:\n%.*s\n", (int)sizes[0], first, (int)sizes[1], second);
        expect(false, "what is saved, loaded and saved is the same");
    }
    free(first);
    free(second);
}

static void ignore(void *user, bool is_error, const char *sentence) { (void)user, (void)is_error, (void)sentence; }

static char *save_scene(const char *data, size_t size, size_t *saved_size, struct error *error)
{
    struct problems problems = {.report = ignore};
    struct document *document = scene_parse("fuzz.json", data, size, &problems, error);
    char *text = document ? scene_print(document, document->folder, NULL, saved_size) : NULL;
    document_destroy(document);
    return text;
}

static char *save_knots(const char *data, size_t size, size_t *saved_size, struct error *error)
{
    struct knot_list list;
    char *text = strndup(data, size);
    bool good = knots_parse("clipboard", text, &list, error);
    free(text);
    if (!good) return NULL;
    text = knots_print(&list);
    *saved_size = strlen(text);
    knot_list_free(&list);
    return text;
}

static char *save_settings(const char *data, size_t size, size_t *saved_size, struct error *error)
{
    struct error broken; // settings that are start anew
    const char *path = file_of("settings", data, size);
    struct settings *settings = settings_load(path, &broken);
    expect(settings_save(settings, path, error), error->text);
    settings_free(settings);
    return bytes_of(path, saved_size);
}

/// Colours are encoded anew, nearly the same.
static char *save_obj(const char *data, size_t size, size_t *saved_size, struct error *error)
{
    struct surface surface;
    const char *path = file_of("fuzz.obj", data, size);
    if (!surface_read(path, &surface, error)) return NULL;
    free(surface.color);
    surface.color = NULL;
    expect(obj_write(path, &surface, error), error->text);
    surface_free(&surface);
    return bytes_of(path, saved_size);
}

static bool somewhere(void *user, const char *target, float *x, float *y, struct error *error)
{
    (void)user, (void)error;
    *x = (float)target[0];
    *y = 1;
    return true;
}

/// A recording of what a replay plays. Frames without events are many; one that goes on much longer than it is large is played to here only.
static char *save_replay(const char *data, size_t size, size_t *saved_size, struct error *error)
{
    char out[160];
    struct event event;
    const char *path = file_of("replay", data, size);
    struct replay *replay = replay_load(path, error);
    if (!replay) return NULL;
    const struct replay_header *header = replay_get_header(replay);
    snprintf(out, sizeof out, "%s.out", path);
    struct recording *recording = recording_open(out, header, error);
    for (long frame = 0; frame < header->frames && frame < 4000 && error->kind == ERROR_NONE; frame++) {
        while (replay_next(replay, frame, somewhere, NULL, &event, error)) recording_event(recording, frame, &event);
    }
    bool played = error->kind == ERROR_NONE;
    expect(recording_close(recording, header->frames, error), "a recording is written");
    replay_destroy(replay);
    return played ? bytes_of(out, saved_size) : NULL;
}

/// Opens a motion and reads all columns, some at a time.
static void read_motion(const char *path)
{
    struct error error = {0};
    struct motion motion;
    bool good = motion_open(&motion, path, &error);
    if (!taken(good, &error)) return;
    const int columns = 3 * motion.vertices;
    for (int first = 0; good && first < columns; first += 8) {
        const int count = columns - first < 8 ? columns - first : 8;
        const size_t numbers = (size_t)count * (size_t)motion.frames;
        double *slab = malloc(numbers * sizeof *slab);
        good = motion_columns(&motion, first, count, slab, &error);
        for (size_t i = 0; good && i < numbers; i++) expect(isfinite(slab[i]), "what is read is finite");
        free(slab);
    }
    motion_close(&motion);
}

/// An array is a motion, or paint, which reads back as it is written.
static void read_array(const char *path)
{
    struct error error = {0};
    read_motion(path);
    struct paint *paint = paint_read(path, &error);
    if (!paint) return;
    expect(paint_write(paint, path, &error), error.text);
    struct paint *again = paint_read(path, &error);
    expect(again != NULL, error.text);
    expect(memcmp(paint->values, again->values, paint_bytes(paint) - sizeof *paint) == 0, "paint reads back");
    paint_drop(paint);
    paint_drop(again);
}

/// A map of softness over the corners of an octahedron: no element gets stiffer than the material, none limp.
static void read_softness(const char *path)
{
    static float corners[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    static uint32_t sides[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    static const struct surface octahedron = {
        .position = corners, .vertex_count = 6, .indices = sides, .index_count = 24};
    static struct lattice lattice;
    static struct body body;
    struct error error = {0};
    if (!body.elements) {
        const struct lattice_options options = {60, NAN, -1};
        expect(lattice_create(&lattice, &octahedron, &options, "octahedron", &error), error.text);
        body.element_count = lattice.tet_count;
        body.elements = calloc((size_t)lattice.tet_count, sizeof *body.elements);
    }
    const struct softness softness = {.from = path, .times = 8};
    if (!taken(softness_apply(&softness, &lattice, &octahedron, "octahedron", &body, &error), &error)) return;
    for (int e = 0; e < body.element_count; e++) {
        const double stiffness = body.elements[e].stiffness;
        expect(stiffness > 0.124 && stiffness < 1.001, "stiffness is from an eighth to the material's");
    }
}

/// A track that drives a simulated body's base is smooth and finite.
static void read_track(const char *path)
{
    struct error error = {0};
    struct base_drive drive = {.size = 1};
    const bool good = taken(drive_read_track(&drive, path, &error), &error);
    for (int i = 0; good && i < drive.count; i++) {
        expect(isfinite(drive_place(&drive, drive.time[i])), "a track's places are finite");
        expect(isfinite(drive_acceleration(&drive, drive.time[i])), "a track's accelerations are finite");
    }
    pool_free(&drive.pool);
}

static void read_log(const char *path)
{
    struct error error = {0};
    struct timing_log log;
    if (!taken(timing_log_read(path, &log, &error), &error)) return;
    for (int i = 0; i < log.rows; i++) expect(log.run[i] >= 0 && log.run[i] < log.runs, "a row is of a run");
    timing_log_free(&log);
}

/// What lies beside a simulated motion can be used.
static void read_companion(const char *path)
{
    struct error error = {0};
    struct companion made;
    char motion[COMPANION_PATH];
    expect(companion_path(path, "", motion), "a path fits");
    *strrchr(motion, '.') = '\0';
    const bool good = taken(companion_read(motion, 96, 8, &made, &error), &error);
    expect(!good || made.frames == 0 || (made.fps > 0 && made.from >= 0), "its times are some");
}

/// Every pixel of a picture that is taken is there, and no more than is allowed.
static void read_image(const char *path)
{
    enum { MOST = 1 << 24 };
    struct error error = {0};
    struct gltf_image image = {0};
    (void)path;
    if (!taken(gltf_decode_image(input.data, input.size, MOST, &image, &error), &error)) return;
    const size_t bytes = 4 * (size_t)image.width * (size_t)image.height;
    expect(bytes > 0 && bytes <= MOST, "a picture has its size");
    unsigned sum = 0;
    for (size_t i = 0; i < bytes; i++) sum += image.pixels[i];
    expect(sum <= 255 * bytes, "pixels are bytes");
    free(image.pixels);
}

// --- surfaces, and what analyses and drawn frames make of them

/// The outlines of a mesh as it stands, from an eye.
static void outline(const struct posed *mesh, const float eye[3])
{
    for (int p = 0; p < mesh->part_count; p++) {
        const struct posed_part *part = &mesh->parts[p];
        float place[SKIRT_CORNERS][3], normal[SKIRT_CORNERS][3];
        struct posed_look look[SKIRT_CORNERS];
        for (int i = part->first - 1; (i = skirt_next(mesh, part, i + 1)) < part->end;)
            skirt_hang(mesh, part, i, eye, 1e-3f, place, normal, look);
    }
}

/// What `analyze` writes of a character, and what a frame that shows it hands to the GPU. Takes the character.
static void use_character(struct character *character)
{
    struct figure figure;
    figure_create(&figure, character);
    const struct character *c = &figure.character;
    for (int e = 0; e < figure.edges.first[c->vertex_count]; e++)
        expect(figure.edges.other[e] < (uint32_t)c->vertex_count, "an edge ends at a vertex of the surface");
    for (int k = 0; k < 2 * c->coordinate_count; k++) figure_target_create(&figure, k / 2, k % 2, &figure.pool);
    figure_free(&figure);
}

/// Every index of what a surface gives is within it.
static void read_surface(const char *path)
{
    struct error error = {0};
    struct surface surface;
    if (!taken(surface_read(path, &surface, &error), &error)) return;
    const struct looks *looks = &surface.looks;
    for (int i = 0; i < surface.index_count; i++) {
        expect(surface.indices[i] < (uint32_t)surface.vertex_count, "a triangle has vertices of the surface");
        expect(!looks->corner || looks->corner[i] == LOOKS_NONE || looks->corner[i] < (uint32_t)looks->uv_count,
               "a corner has texture coordinates of the surface");
    }
    for (int i = 0; i < surface.index_count / 3; i++) {
        const uint32_t material = looks->material ? looks->material[i] : LOOKS_NONE;
        expect(material == LOOKS_NONE || material < (uint32_t)looks->material_count,
               "a triangle has a material of the surface");
        expect(!triangle_repeats(surface.indices + 3 * i), "a triangle has three different vertices");
    }
    struct character character;
    if (character_create(&character, &surface, 1)) {
        character.coordinates[0].name = strdup("up");
        use_character(&character);
    }
    surface_free(&surface);
}

/// Materials of an OBJ file.
static void read_materials(const char *path)
{
    static const char obj[] = "mtllib fuzz.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl red\nf 1/1 2/1 3/1\n";
    (void)path;
    read_surface(file_of("fuzz.obj", obj, strlen(obj)));
}

// --- glTF

/// All that a pose of a model says, of a clip or at rest.
static void pose_at(const struct imported *imported, int clip, double time, struct gltf_pose *pose)
{
    const struct gltf *gltf = &imported->gltf;
    float lo[3], hi[3];
    gltf_pose_clip(gltf, clip, time, pose);
    gltf_pose_world(gltf, pose);
    gltf_bounds_at(&imported->bounds, gltf, pose, -1, lo, hi);
    for (int node = 0; node < gltf->node_count; node++) {
        const size_t count = (size_t)gltf_vertex_count(gltf, node) + 1;
        float(*vectors)[3] = malloc(2 * count * sizeof *vectors);
        gltf_pose_vertices(gltf, pose, node, vectors, vectors + count);
        free(vectors);
    }
}

static void import(const char *path)
{
    static const float eye[3] = {0, 0, 1};
    struct error error = {0};
    struct imported imported;
    struct posed mesh;
    if (!taken(imported_read(&imported, path, &error), &error)) return;
    for (int clip = -1; clip < imported.gltf.clip_count && clip < 3; clip++)
        pose_at(&imported, clip, clip < 0 ? 0 : 0.6 * imported.gltf.clips[clip].last, &imported.rest);
    const bool is_soft = imported.figure.character.vertex_count > 0;
    const struct stage_model shown = {.posed = {.gltf = &imported.gltf,
                                                .pose = &imported.rest,
                                                .root = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                                .figure = is_soft ? &imported.figure : NULL}};
    posed_from_gltf(&mesh, &imported.gltf);
    posed_map(&mesh, &shown);
    posed_pose(&mesh, &shown, eye);
    outline(&mesh, eye);
    posed_free(&mesh);
    imported_free(&imported);
}

/// By every reader of glTF: imported, as a surface, and as a character of ours.
static void read_gltf(const char *path)
{
    struct error error = {0};
    struct character character;
    import(path);
    read_surface(path);
    if (taken(character_read(path, &character, &error), &error)) use_character(&character);
}

/// A .gltf and a file beside it, which it may name as a buffer and as a picture: the text, a NUL, and that file.
static void read_beside(const char *path)
{
    const size_t text = strnlen((const char *)input.data, input.size), behind = text + (text < input.size);
    file_of("fuzz.bin", input.data + behind, input.size - behind);
    path = file_of("fuzz.gltf", input.data, text);
    import(path);
    read_surface(path);
}

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

/// A scene that shows the model, with a chain that moves its deepest bones. NULL where the model is refused, or its bones are no chain.
static struct document *scene_of(const char *model, struct error *error)
{
    struct gltf gltf;
    if (!gltf_read(model, &gltf, error)) return NULL;
    int from = 0, to = deepest(&gltf, &from);
    json_t *chain = to < 0 ? NULL
                           : json_pack("{s:s, s:s, s:s, s:s, s:s, s:[{s:s, s:s, s:f}]}", "type", "chain", "name",
                                       "tail", "model", "it", "from", gltf.nodes[from].name, "to",
                                       gltf.nodes[to].name, "channels", "spline", "wag", "axis", "side", "gain", 9.0);
    json_t *scene =
        json_pack("{s:i, s:[i,i], s:[{s:s, s:f, s:[{s:i, s:f}, {s:i, s:f}]}], s:[{s:s, s:s, s:s}, o*]}", "wiggly", 1,
                  "frames", 0, 2, "splines", "name", "wag", "frequency", 2.0, "knots", "frame", 0, "value", 1.0,
                  "frame", 2, "value", -1.0, "rigs", "type", "model", "name", "it", "model", model, chain);
    char *text = json_dumps(scene, 0);
    expect(text != NULL, "names are text");
    struct document *document = scene_parse("scene.json", text, strlen(text), NULL, error);
    free(text);
    json_decref(scene);
    gltf_free(&gltf);
    return document;
}

/// Whatever opens is exported, in a format that the input's size chooses, and what is glTF opens again.
static void export_model(const char *path)
{
    static const char *const outputs[] = {"out.glb", "out.gltf", "out.usda", "out.bvh", "out.npy"};
    const size_t output = input.size % (sizeof outputs / sizeof *outputs);
    char model[128];
    struct error error = {0};
    struct evaluation evaluation = {0};
    snprintf(model, sizeof model, "%s", path);
    struct document *document = scene_of(model, &error);
    if (!document) return;
    struct models *models = models_create();
    if (models_update(models, document, &error)) {
        evaluation_update(&evaluation, document, false);
        const struct posing posing = {.document = document, .evaluation = &evaluation, .models = models};
        const struct export_options options = {.clip = "moved"};
        struct export_report report;
        struct gltf gltf;
        path = file_of(outputs[output], "", 0);
        if (taken(export_write(&posing, path, &options, &report, &error), &error) && output < 2) {
            expect(gltf_read(path, &gltf, &error), error.text);
            gltf_free(&gltf);
        }
    }
    evaluation_free(&evaluation);
    models_destroy(models);
    document_destroy(document);
}

// --- the table

static const struct target {
    const char *name;
    fuzz_mutate *mutate;
    save *save;
    void (*run)(const char *path);
    const char *file; ///< where the input lies for it
} targets[] = {
    {"beside", mutate_before_nul, NULL, read_beside, NULL},
    {"clipboard", mutate_json, save_knots, NULL, NULL},
    {"companion", mutate_json, NULL, read_companion, "fuzz.simulation.json"},
    {"export", mutate_gltf, NULL, export_model, "fuzz.gltf"},
    {"gltf", mutate_gltf, NULL, read_gltf, "fuzz.gltf"},
    {"image", mutate_bytes, NULL, read_image, NULL},
    {"log", mutate_bytes, NULL, read_log, "log.csv"},
    {"mdd", mutate_bytes, NULL, read_motion, "fuzz.mdd"},
    {"mtl", mutate_bytes, NULL, read_materials, "fuzz.mtl"},
    {"npy", mutate_bytes, NULL, read_array, "fuzz.npy"},
    {"obj", mutate_bytes, save_obj, read_surface, "fuzz.obj"},
    {"off", mutate_bytes, NULL, read_surface, "fuzz.off"},
    {"pc2", mutate_bytes, NULL, read_motion, "fuzz.pc2"},
    {"ply", mutate_bytes, NULL, read_surface, "fuzz.ply"},
    {"replay", mutate_bytes, save_replay, NULL, NULL},
    {"scene", mutate_json, save_scene, NULL, NULL},
    {"settings", mutate_bytes, save_settings, NULL, NULL},
    {"softness", mutate_bytes, NULL, read_softness, "fuzz.npy"},
    {"stl", mutate_bytes, NULL, read_surface, "fuzz.stl"},
    {"track", mutate_bytes, NULL, read_track, "track.csv"},
};
enum { TARGETS = sizeof targets / sizeof *targets };

static const struct target *target;

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    const char *wanted = getenv("FUZZ_READER");
    (void)argc, (void)argv;
    for (int i = 0; i < TARGETS; i++) {
        if (!wanted) puts(targets[i].name);
        if (wanted && strcmp(wanted, targets[i].name) == 0) target = &targets[i];
    }
    if (!wanted) exit(0);
    expect(target != NULL, "FUZZ_READER names a reader");
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *file = target->mutate == mutate_gltf && fuzz_is_glb(data, size) ? "fuzz.glb" : target->file;
    input.data = data;
    input.size = size;
    if (target->run) target->run(file ? file_of(file, data, size) : NULL);
    if (target->save) save_twice(target->save);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return target->mutate(data, size, most, seed);
}
