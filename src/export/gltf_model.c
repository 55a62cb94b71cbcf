/// Writes an imported character's own file with a clip more.
#include "export/gltf_model.h"
#include "base/file.h"
#include "base/json.h"
#include "base/path.h"
#include "export/gltf_body.h"
#include "export/gltf_gather.h"
#include "export/gltf_splice.h"
#include "export/keys.h"
#include "export/model.h"
#include "model/glb.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void add_bones(const struct form *form, const struct keys *keys, struct gltf_motion *motion)
{
    const struct model_bones *own = form->owned;
    for (int j = 0; j < form->joint_count; j++) {
        const size_t at = (size_t)j * (size_t)keys->count;
        gltf_motion_add(motion, own->node[j], GLTF_ROTATION, keys->at.rotation[at],
                        keys->slope.rotation ? keys->slope.rotation[at] : NULL, 4);
    }
}

/// What the clip is put into: the file as it is, or gathered for the other container.
struct original {
    struct glb source;       ///< its JSON
    char *text;              ///< of that
    struct glb_buffer first; ///< its first buffer where that has no address
    bool is_other;           ///< in another container than it came in
};

/// The JSON as a text of its own; NULL if memory is short.
static char *text_of(const struct glb *source, bool binary)
{
    uint32_t length;
    if (!binary) return strdup(source->data);
    memcpy(&length, source->data + 12, sizeof length);
    return strndup(source->data + 20, length);
}

static json_int_t count_of(const struct original *original, const char *array)
{
    return (json_int_t)json_array_size(json_object_get(original->source.json, array));
}

/// The .glb's chunk where the file's first buffer is that, all of it: views may reach beyond the buffer's byteLength.
static struct glb_bytes find_chunk(const struct glb *source)
{
    const json_t *buffer = json_array_get(json_object_get(source->json, "buffers"), 0);
    if (!source->chunk.at || !buffer || json_object_get(buffer, "uri")) return (struct glb_bytes){0};
    return source->chunk;
}

static void append_all(struct splice *splice, const char *array, const json_t *values)
{
    char *joined = json_print(values, JSON_COMPACT | JSON_REAL_PRECISION(9));
    if (joined) {
        joined[strlen(joined) - 1] = '\0'; // without the brackets
        splice_append(splice, array, joined + 1);
    }
    splice->failed = splice->failed || !joined;
    free(joined);
}

static void put_clip(struct splice *splice, const struct gltf *gltf, const struct gltf_motion *motion,
                     const char *name)
{
    json_t *json = gltf_motion_json(motion, name);
    char *text = json ? json_print(json, JSON_COMPACT) : NULL;
    const int known = gltf_find_clip(gltf, name);
    if (text && known >= 0) splice_replace(splice, "animations", (size_t)known, NULL, text);
    if (text && known < 0) splice_append(splice, "animations", text);
    splice->failed = splice->failed || !text;
    free(text);
    json_decref(json);
}

/// The new bytes follow those of the first buffer, or get a buffer of their own where that is NULL.
static void put_bytes(struct splice *splice, const struct gltf_file *file, const json_t *first, bool binary)
{
    const bool in_first = first != NULL, has_length = json_object_get(first, "byteLength") != NULL;
    char *value = NULL, *address = in_first && binary ? NULL : gltf_file_address(file);
    if (in_first && binary) {
        if (asprintf(&value, has_length ? "%zu" : "{\"byteLength\":%zu}", file->size) < 0) value = NULL;
        if (value) splice_replace(splice, "buffers", 0, has_length ? "byteLength" : NULL, value);
    } else if (address) {
        if (asprintf(&value, "{\"byteLength\":%zu,\"uri\":\"%s\"}", file->size, address) < 0) value = NULL;
        if (value && in_first) splice_replace(splice, "buffers", 0, NULL, value);
        if (value && !in_first) splice_append(splice, "buffers", value);
    }
    splice->failed = splice->failed || !value;
    free(value);
    free(address);
}

static bool add_motion(struct shot *shot, const struct form *form, const struct gltf_body *body,
                       struct gltf_motion *motion, struct error *error)
{
    struct keys keys;
    if (!keys_collect(shot, shot->rigs[0], form, &keys, error)) return false;
    const bool done = !body->clip || (shot->is_cubic ? gltf_body_keep(body, shot, motion, error)
                                                     : gltf_body_sample(body, shot, motion, error));
    if (done) add_bones(form, &keys, motion);
    keys_free(&keys);
    return done;
}

/// Puts the new clip into the text.
static bool put_motion(struct shot *shot, const struct form *form, const struct gltf_body *body,
                       struct gltf_file *file, struct splice *splice, struct error *error)
{
    struct gltf_motion motion;
    gltf_motion_begin(&motion, file, shot);
    const bool done = add_motion(shot, form, body, &motion, error);
    put_clip(splice, body->gltf, &motion, shot->clip);
    append_all(splice, "accessors", file->accessors);
    append_all(splice, "bufferViews", file->views);
    gltf_motion_free(&motion);
    return done;
}

/// Writes the file with a clip more, if a chain moves it.
static bool write_patched(struct shot *shot, const struct form *form, const struct gltf_body *body,
                          const struct original *original, bool binary, FILE *out, struct error *error)
{
    const struct glb_bytes first = original->first.bytes, chunk = original->source.chunk;
    struct gltf_file file = {.first_view = count_of(original, "bufferViews"),
                             .first_accessor = count_of(original, "accessors"),
                             .buffer = first.size > 0 ? 0 : count_of(original, "buffers")};
    struct gltf_file as_it_was = {0}; // a chunk that is not the first buffer
    struct splice splice = {.text = original->text};
    const json_t *buffers = json_object_get(original->source.json, "buffers");
    char *text = NULL;
    bool whole = gltf_file_begin(&file, first.at, first.size);
    if (whole && binary && first.size == 0) whole = gltf_file_begin(&as_it_was, chunk.at, chunk.size);
    bool done = !whole || form->joint_count == 0 || put_motion(shot, form, body, &file, &splice, error);
    if (done) {
        if (file.size > 0) put_bytes(&splice, &file, first.size > 0 ? json_array_get(buffers, 0) : NULL, binary);
        if (whole && !file.without_memory) text = splice_apply(&splice);
        done = text || fail_no_memory(error, body->gltf->path);
    }
    if (done && binary) gltf_file_write_binary(first.size > 0 ? &file : &as_it_was, text, out);
    if (done && !binary) fputs(text, out);
    free(text);
    splice_free(&splice);
    gltf_file_free(&file);
    gltf_file_free(&as_it_was);
    return done;
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
static bool check_place(const struct shot *shot, const struct glb *source, struct error *error)
{
    char from[PATH_LIMIT], to[PATH_LIMIT], folder[PATH_LIMIT];
    if (is_alone(source)) return true;
    const bool same = path_folder(source->path, folder) && path_resolve(folder, ".", from) &&
                      path_folder(shot->path, folder) && path_resolve(folder, ".", to) && strcmp(from, to) == 0;
    if (same) return true;
    return fail(error, ERROR_INPUT, "%s: names files beside it: export it to the same folder, or as .glb",
                source->path);
}

static void close_original(struct original *original)
{
    free(original->text);
    free(original->first.owned);
    glb_close(&original->source);
}

/// False leaves nothing to close.
static bool open_original(const struct shot *shot, const char *path, bool binary, struct original *original,
                          struct error *error)
{
    *original = (struct original){0};
    struct glb *source = &original->source;
    if (!glb_open(source, path, error)) return false;
    original->is_other = (memcmp(source->data, "glTF", 4) == 0) != binary;
    bool done;
    if (original->is_other) {
        done = gltf_gather(source, &original->first, error);
        if (done) original->text = json_print(source->json, binary ? JSON_COMPACT : JSON_INDENT(1));
    } else {
        done = check_place(shot, source, error);
        if (done) original->text = text_of(source, binary);
        original->first.bytes = binary ? find_chunk(source) : (struct glb_bytes){0};
    }
    if (done && original->text) return true;
    if (done) fail_no_memory(error, path);
    close_original(original);
    return false;
}

static bool write_model(struct shot *shot, const struct form *form, bool binary, FILE *out, struct error *error)
{
    const struct model_bones *own = form->owned;
    const struct model_rig *model = &shot->posing->document->rigs[shot->rigs[0]].model;
    const int clip = model->clip ? gltf_find_clip(own->gltf, model->clip) : -1;
    const struct gltf_body body = {
        .gltf = own->gltf, .clip = clip >= 0 ? &own->gltf->clips[clip] : NULL, .is_bone = own->is_bone};
    struct original original;
    if (body.clip && !shot->is_cubic) shot->total += shot->key_count;
    if (!shot->clip) shot->clip = model->clip ? model->clip : shot->title;
    if (!open_original(shot, own->gltf->path, binary, &original, error)) return false;
    const bool is_same = form->joint_count == 0 && !original.is_other;
    const bool done = is_same ? write_same(own->gltf->path, out, error)
                              : write_patched(shot, form, &body, &original, binary, out, error);
    close_original(&original);
    return done;
}

bool gltf_model_write(struct shot *shot, bool binary, FILE *out, char summary[FORMAT_SUMMARY], struct error *error)
{
    struct form form;
    shot->total = shot->key_count;
    if (!form_open(shot, shot->rigs[0], &form, error)) return false;
    const bool done = write_model(shot, &form, binary, out, error);
    if (form.joint_count > 0) {
        snprintf(summary, FORMAT_SUMMARY, "%d bones bent by chains, %d keys", form.joint_count, shot->key_count);
    } else {
        snprintf(summary, FORMAT_SUMMARY, "what is in the file as it was, because no chain moves it");
    }
    form_close(&form);
    return done;
}
