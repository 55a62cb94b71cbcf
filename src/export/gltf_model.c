/// Writes an imported character's own file with a clip more.
#include "export/gltf_model.h"
#include "base/file.h"
#include "base/path.h"
#include "export/gltf_gather.h"
#include "export/gltf_motion.h"
#include "export/gltf_splice.h"
#include "export/keys.h"
#include "export/model.h"
#include "model/glb.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The character's own clip at all keys: what moves a node, one track after the other in each row.
struct kept_motion {
    const struct gltf *gltf;
    const struct gltf_clip *clip; ///< NULL: it stands at rest
    const bool *is_bone;
    float *rows;
    int width;
};

/// Chains have the rotation of their bones.
static bool is_ours(const struct kept_motion *kept, const struct gltf_channel *channel)
{
    return channel->path == GLTF_ROTATION && kept->is_bone[channel->node];
}

static const float *values_of(const struct gltf *gltf, const struct gltf_pose *pose,
                              const struct gltf_channel *channel)
{
    const struct gltf_place *place = &pose->place[channel->node];
    switch (channel->path) {
    case GLTF_TRANSLATION:
        return place->translation;
    case GLTF_ROTATION:
        return place->rotation;
    case GLTF_SCALE:
        return place->scale;
    case GLTF_WEIGHTS:
        break;
    }
    return pose->weights + gltf->nodes[channel->node].first_weight;
}

static bool collect_kept(struct shot *shot, struct kept_motion *kept, struct error *error)
{
    for (int c = 0; c < kept->clip->channel_count; c++) kept->width += kept->clip->channels[c].components;
    kept->rows = malloc(((size_t)shot->key_count * (size_t)kept->width + 1) * sizeof *kept->rows);
    if (!kept->rows) return fail_no_memory(error, kept->gltf->path);
    for (int k = 0; k < shot->key_count; k++) {
        struct rig_pose pose;
        float *at = kept->rows + (size_t)k * (size_t)kept->width;
        if (!shot_pose(shot, shot->rigs[0], k, &pose, error) || !shot_proceed(shot, error)) return false;
        for (int c = 0; c < kept->clip->channel_count; c++) {
            const struct gltf_channel *channel = &kept->clip->channels[c];
            memcpy(at, values_of(kept->gltf, pose.model.pose, channel), (size_t)channel->components * sizeof *at);
            if (channel->path == GLTF_ROTATION && k > 0) keys_turn_short_way(at - kept->width, at);
            at += channel->components;
        }
    }
    keys_close_loop(kept->rows, kept->width, shot->key_count);
    return true;
}

/// The tracks that are kept, each in an array of its own.
static void add_kept(const struct kept_motion *kept, struct gltf_motion *motion)
{
    static const char *const paths[] = {"translation", "rotation", "scale", "weights"};
    static const enum gltf_elements elements[] = {ELEMENTS_KEY_VECTORS, ELEMENTS_TURNS, ELEMENTS_KEY_VECTORS,
                                                  ELEMENTS_KEYS};
    int first = 0;
    for (int c = 0; c < kept->clip->channel_count; c++) {
        const struct gltf_channel *channel = &kept->clip->channels[c];
        const size_t width = (size_t)channel->components, from = (size_t)first, row = (size_t)kept->width;
        first += channel->components;
        if (is_ours(kept, channel)) continue;
        float *track = malloc((size_t)motion->key_count * width * sizeof *track);
        if (!track) {
            motion->file->without_memory = true;
            return;
        }
        for (size_t k = 0; k < (size_t)motion->key_count; k++)
            memcpy(track + k * width, kept->rows + k * row + from, width * sizeof *track);
        gltf_motion_add(motion, channel->node, paths[channel->path], elements[channel->path], track, NULL,
                        channel->components);
        free(track);
    }
}

static void add_bones(const struct form *form, const struct keys *keys, struct gltf_motion *motion)
{
    const struct model_bones *own = form->owned;
    for (int j = 0; j < form->joint_count; j++) {
        const size_t at = (size_t)j * (size_t)keys->count;
        gltf_motion_add(motion, own->node[j], "rotation", ELEMENTS_TURNS, keys->at.rotation[at],
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

/// Bytes of the .glb's chunk that the file's first buffer is.
static struct glb_bytes find_chunk(const struct glb *source)
{
    const json_t *buffer = json_array_get(json_object_get(source->json, "buffers"), 0);
    if (!source->chunk.at || !buffer || json_object_get(buffer, "uri")) return (struct glb_bytes){0};
    const int64_t length = glb_integer(buffer, "byteLength", 0), most = (int64_t)source->chunk.size;
    return (struct glb_bytes){source->chunk.at, (size_t)(length < 0 || length > most ? most : length)};
}

static void append_all(struct splice *splice, const char *array, const json_t *values)
{
    char *joined = json_dumps(values, JSON_COMPACT | JSON_REAL_PRECISION(9));
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
    char *text = json ? json_dumps(json, JSON_COMPACT) : NULL;
    const int known = gltf_find_clip(gltf, name);
    if (text && known >= 0) splice_replace(splice, "animations", (size_t)known, NULL, text);
    if (text && known < 0) splice_append(splice, "animations", text);
    splice->failed = splice->failed || !text;
    free(text);
    json_decref(json);
}

/// The new bytes follow those of the first buffer, or get a buffer of their own.
static void put_bytes(struct splice *splice, const struct gltf_file *file, bool in_first, bool binary)
{
    char *value = NULL, *address = in_first && binary ? NULL : gltf_file_address(file);
    if (in_first && binary) {
        if (asprintf(&value, "%zu", file->size) < 0) value = NULL;
        if (value) splice_replace(splice, "buffers", 0, "byteLength", value);
    } else if (address) {
        if (asprintf(&value, "{\"byteLength\":%zu,\"uri\":\"%s\"}", file->size, address) < 0) value = NULL;
        if (value && in_first) splice_replace(splice, "buffers", 0, NULL, value);
        if (value && !in_first) splice_append(splice, "buffers", value);
    }
    splice->failed = splice->failed || !value;
    free(value);
    free(address);
}

/// The text with what is new in it; NULL if memory is short. A file that no chain moves gets no clip.
static char *patch(struct shot *shot, const struct form *form, const struct keys *keys,
                   const struct kept_motion *kept, const struct original *original, struct gltf_file *file,
                   bool binary)
{
    struct gltf_motion motion;
    struct splice splice = {.text = original->text};
    if (form->joint_count > 0) {
        gltf_motion_begin(&motion, file, shot);
        if (kept->clip) add_kept(kept, &motion);
        add_bones(form, keys, &motion);
        put_clip(&splice, kept->gltf, &motion, shot->clip);
        append_all(&splice, "accessors", file->accessors);
        append_all(&splice, "bufferViews", file->views);
        gltf_motion_free(&motion);
    }
    if (file->size > 0) put_bytes(&splice, file, original->first.bytes.size > 0, binary);
    char *text = file->without_memory ? NULL : splice_apply(&splice);
    splice_free(&splice);
    return text;
}

static bool write_patched(struct shot *shot, const struct form *form, const struct keys *keys,
                          const struct kept_motion *kept, const struct original *original, bool binary, FILE *out,
                          struct error *error)
{
    const struct glb_bytes first = original->first.bytes, chunk = original->source.chunk;
    struct gltf_file file = {.first_view = count_of(original, "bufferViews"),
                             .first_accessor = count_of(original, "accessors"),
                             .buffer = first.size > 0 ? 0 : count_of(original, "buffers")};
    struct gltf_file as_it_was = {0}; // a chunk that is not the first buffer
    bool done = gltf_file_begin(&file, first.at, first.size);
    if (done && binary && first.size == 0) done = gltf_file_begin(&as_it_was, chunk.at, chunk.size);
    char *text = done ? patch(shot, form, keys, kept, original, &file, binary) : NULL;
    if (text && binary) gltf_file_write_binary(first.size > 0 ? &file : &as_it_was, text, out);
    if (text && !binary) fputs(text, out);
    done = text || fail_no_memory(error, kept->gltf->path);
    free(text);
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
    if (!glb_open_any(source, path, error)) return false;
    original->is_other = (memcmp(source->data, "glTF", 4) == 0) != binary;
    bool done;
    if (original->is_other) {
        done = gltf_gather(source, &original->first, error);
        if (done) original->text = json_dumps(source->json, binary ? JSON_COMPACT : JSON_INDENT(1));
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

static bool write_moved(struct shot *shot, const struct form *form, struct kept_motion *kept,
                        const struct original *original, bool binary, FILE *out, struct error *error)
{
    struct keys keys;
    if (!keys_collect(shot, shot->rigs[0], form, &keys, error)) return false;
    const bool done = (!kept->clip || collect_kept(shot, kept, error)) &&
                      write_patched(shot, form, &keys, kept, original, binary, out, error);
    keys_free(&keys);
    return done;
}

static bool write_model(struct shot *shot, const struct form *form, bool binary, FILE *out, struct error *error)
{
    const struct model_bones *own = form->owned;
    const struct model_rig *model = &shot->posing->document->rigs[shot->rigs[0]].model;
    const int clip = model->clip ? gltf_find_clip(own->gltf, model->clip) : -1;
    struct kept_motion kept = {
        .gltf = own->gltf, .clip = clip >= 0 ? &own->gltf->clips[clip] : NULL, .is_bone = own->is_bone};
    struct original original;
    bool done;
    if (kept.clip) shot->total += shot->key_count;
    if (!shot->clip) shot->clip = model->clip ? model->clip : shot->title;
    if (!open_original(shot, own->gltf->path, binary, &original, error)) return false;
    if (form->joint_count > 0) {
        done = write_moved(shot, form, &kept, &original, binary, out, error);
    } else if (original.is_other) {
        done = write_patched(shot, form, NULL, &kept, &original, binary, out, error);
    } else {
        done = write_same(own->gltf->path, out, error);
    }
    free(kept.rows);
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
