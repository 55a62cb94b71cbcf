/// Writes an imported character's own file with the keys of its chains: parses its JSON, adds to it, and prints it.
#include "base/file.h"
#include "export/gltf.h"
#include "model/glb.h"
#include "rig/import.h"
#include <stdlib.h>
#include <string.h>

/// The file that the clip goes into.
struct original {
    struct glb source;
    struct gltf_file file; ///< its JSON, and the bytes of the buffer that new ones go into
    bool is_same;          ///< the container stays what it is
    int clips;             ///< that were put into it
};

// --- the other container: all bytes in one buffer without an address, pictures too

/// Lets a view, or an extension of one, find its bytes again. False if memory is short.
static bool move(json_t *view, const size_t *starts, size_t count)
{
    const int64_t buffer = glb_integer(view, "buffer", -1), offset = glb_integer(view, "byteOffset", 0);
    if (buffer < 0 || (size_t)buffer >= count || offset < 0) return true;
    return json_object_set_new(view, "buffer", json_integer(0)) == 0 &&
           (starts[buffer] == 0 ||
            json_object_set_new(view, "byteOffset", json_integer(offset + (json_int_t)starts[buffer])) == 0);
}

static bool gather_buffers(struct original *o)
{
    const size_t count = json_array_size(json_object_get(o->source.json, "buffers"));
    size_t *starts = calloc(count + 1, sizeof *starts), i;
    json_t *view, *extension;
    bool done = starts;
    for (size_t b = 0; done && b < count; b++) { // all there is: views may reach beyond the byteLength
        const struct glb_bytes bytes = o->source.buffers[b].bytes;
        starts[b] = gltf_file_append(&o->file, bytes.at, bytes.size);
    }
    json_array_foreach(o->file.views, i, view)
    {
        const char *name;
        done = done && move(view, starts, count);
        json_object_foreach(json_object_get(view, "extensions"), name, extension) done =
            done && move(extension, starts, count);
    }
    if (o->file.size > 0) json_object_del(o->source.json, "buffers");
    free(starts);
    return done;
}

/// The type of a picture; NULL: unknown.
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

/// A picture that cannot be read keeps its address. False if memory is short.
static bool gather_image(struct original *o, json_t *image)
{
    const char *uri = json_string_value(json_object_get(image, "uri"));
    struct glb_buffer picture;
    struct error why = {0};
    if (!uri) return true;
    if (!glb_read_uri(&o->source, uri, &picture, &why)) return why.kind != ERROR_ENVIRONMENT;
    const char *kind = kind_of(picture.bytes);
    if (kind) {
        const json_int_t view = gltf_file_add_bytes(&o->file, picture.bytes.at, picture.bytes.size);
        gltf_set(&o->file, image, "bufferView", json_integer(view));
        gltf_set(&o->file, image, "mimeType", json_string(kind));
        json_object_del(image, "uri");
    }
    free(picture.owned);
    return true;
}

static bool gather(struct original *o, struct error *error)
{
    size_t i;
    json_t *image;
    if (!glb_read_buffers(&o->source, error)) return false;
    bool done = gather_buffers(o);
    json_array_foreach(json_object_get(o->source.json, "images"), i, image) done = done && gather_image(o, image);
    return done || fail_no_memory(error, o->source.path);
}

// --- the same container

/// Whether buffers and images are in the file itself.
static bool is_alone(const struct glb *source)
{
    static const char *const arrays[] = {"buffers", "images"};
    for (int a = 0; a < 2; a++) {
        size_t i;
        const json_t *thing;
        json_array_foreach(json_object_get(source->json, arrays[a]), i, thing)
        {
            const char *uri = json_string_value(json_object_get(thing, "uri"));
            if (uri && strncmp(uri, "data:", 5) != 0) return false;
        }
    }
    return true;
}

/// A file that stays what it is must be beside the files that it names.
static bool check_place(const struct export_range *range, const struct glb *source, struct error *error)
{
    char from[PATH_LIMIT], to[PATH_LIMIT], folder[PATH_LIMIT];
    if (is_alone(source)) return true;
    const bool same = path_folder(source->path, folder) && path_resolve(folder, ".", from) &&
                      path_folder(range->path, folder) && path_resolve(folder, ".", to) && strcmp(from, to) == 0;
    if (same) return true;
    return fail(error, ERROR_INPUT, "%s: refers to files beside it: export it to the same folder, or as .glb",
                source->path);
}

/// Takes the bytes that new ones follow: those of a .glb's chunk, if that is its first buffer; none of a .gltf; else all there are.
static bool take_bytes(const struct export_range *range, struct original *o, struct error *error)
{
    const json_t *buffers = json_object_get(o->source.json, "buffers"), *first = json_array_get(buffers, 0);
    const bool has_chunk = o->source.chunk.at && first && !json_object_get(first, "uri");
    gltf_file_continue(&o->file, o->source.json);
    if (!o->is_same || (range->format->is_binary && !has_chunk)) return gather(o, error);
    if (has_chunk) gltf_file_append(&o->file, o->source.chunk.at, o->source.chunk.size);
    if (!has_chunk) o->file.buffer = (json_int_t)json_array_size(buffers);
    return check_place(range, &o->source, error);
}

static bool write_same(const char *path, FILE *out, struct error *error)
{
    char *data;
    size_t size;
    if (!file_read(path, GLB_FILE_LIMIT, &data, &size, error)) return false;
    fwrite(data, 1, size, out);
    free(data);
    return true;
}

// --- the clips

/// Adds what the chains make of another clip of the file.
static bool put_other(struct export_range *range, int clip, struct original *o, struct error *error)
{
    const struct posing *first = range->posing;
    const int rig = range->rigs[0];
    const struct gltf *gltf = &models_imported(first->models, first->document, rig)->gltf;
    struct document *document = import_with_clip(first->document, rig, gltf, clip, error);
    if (!document) return false;
    struct evaluation evaluation = {.solver = first->evaluation->solver, .models = first->evaluation->models};
    struct posing posing = *first;
    struct export_report report = {0};
    struct form form;
    evaluation_update(&evaluation, document, false);
    posing.document = document;
    posing.evaluation = &evaluation;
    range->posing = &posing;
    bool done = range_choose_keys(range, &report, error) && form_open(range, rig, &form, error);
    if (done) {
        done = gltf_clip_put(range, &form, &o->file, o->source.json, error);
        o->clips++;
        form_close(&form);
    }
    evaluation_free(&evaluation);
    document_destroy(document);
    range->posing = first;
    return done;
}

/// Adds the clip that plays, and all others if all are wanted. Chains do not move in clips of a single pose.
static bool put_clips(struct export_range *range, struct form *form, struct original *o, struct error *error)
{
    const struct model_body *body = form->owned;
    bool done = gltf_clip_put(range, form, &o->file, o->source.json, error);
    o->clips = 1;
    for (int c = 0; done && range->options->all_clips && c < body->gltf->clip_count; c++) {
        const struct gltf_clip *clip = &body->gltf->clips[c];
        if (clip != body->clip && clip->last > clip->first) done = put_other(range, c, o, error);
    }
    return done;
}

/// Places a scene's nodes under one with the character's matrix on the stage. Joints place a skinned mesh: it stays where it is, because
/// validators warn of one that has a parent.
static void place_nodes(struct original *o, json_t *scene, json_t *matrix)
{
    json_t *nodes = json_object_get(o->source.json, "nodes"), *number;
    json_t *placed = json_array(), *roots = json_array();
    size_t i;
    json_array_foreach(json_object_get(scene, "nodes"), i, number)
    {
        const json_t *node = json_array_get(nodes, (size_t)json_integer_value(number));
        const bool is_skinned = json_object_get(node, "skin") && !json_object_get(node, "children");
        gltf_append(&o->file, is_skinned ? roots : placed, json_incref(number));
    }
    if (json_array_size(placed) > 0) {
        json_t *shown = json_pack("{s:s, s:O, s:O}", "name", "as shown", "matrix", matrix, "children", placed);
        gltf_append(&o->file, roots, json_integer(gltf_append(&o->file, nodes, shown)));
        gltf_set(&o->file, scene, "nodes", json_incref(roots));
    }
    json_decref(placed);
    json_decref(roots);
}

static void put_place(struct original *o, const float root[16])
{
    json_t *matrix = json_array(), *scene;
    size_t s;
    for (int i = 0; i < 16; i++) gltf_append(&o->file, matrix, json_real((double)root[i]));
    json_array_foreach(json_object_get(o->source.json, "scenes"), s, scene) { place_nodes(o, scene, matrix); }
    json_decref(matrix);
}

static bool write_file(struct export_range *range, struct form *form, FILE *out, struct error *error)
{
    struct original o = {0};
    const struct model_body *body = form->owned;
    const bool has_clip = form->joint_count > 0, binary = range->format->is_binary;
    struct rig_pose pose;
    if (!range_pose(range, range->rigs[0], 0, &pose, error)) return false;
    const float *root = range_root(range, range->rigs[0], &pose);
    if (!glb_open(&o.source, body->gltf->path, error)) return false;
    const bool was_packed = glb_is_packed(&o.source);
    o.is_same = !was_packed && (memcmp(o.source.data, "glTF", 4) == 0) == binary;
    bool done;
    if (!has_clip && o.is_same && !root) {
        done = check_place(range, &o.source, error) && write_same(body->gltf->path, out, error);
    } else {
        done = take_bytes(range, &o, error) && (!has_clip || put_clips(range, form, &o, error));
        if (done && root) put_place(&o, root);
        done = done && gltf_file_write(&o.file, json_incref(o.source.json), binary, out, error);
    }
    gltf_file_free(&o.file);
    glb_close(&o.source);
    if (has_clip) {
        snprintf(range->summary, FORMAT_SUMMARY, "%d bones bent by chains in %d clip%s, %ld keys%s",
                 form->joint_count, o.clips, o.clips == 1 ? "" : "s", range->total,
                 was_packed ? ", meshes decompressed" : "");
    } else {
        snprintf(range->summary, FORMAT_SUMMARY, "the file as it was, %sbecause no chain moves it",
                 was_packed ? "meshes decompressed, " : "");
    }
    return done;
}

bool gltf_model_write(struct export_range *range, FILE *out, struct error *error)
{
    struct form form;
    if (!form_open(range, range->rigs[0], &form, error)) return false;
    const bool done = write_file(range, &form, out, error);
    form_close(&form);
    return done;
}
