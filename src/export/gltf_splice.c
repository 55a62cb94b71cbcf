/// Adds a clip to a glTF file, and leaves the rest of it alone.
#include "export/gltf_splice.h"
#include "base/path.h"
#include "export/gltf_file.h"
#include "export/json_splice.h"
#include "export/tracks.h"
#include "model/glb.h"
#include <stdlib.h>
#include <string.h>

enum { URI_LIMIT = 3 * PATH_LIMIT };

static const char *const path_words[] = {[GLTF_TRANSLATION] = "translation",
                                         [GLTF_ROTATION] = "rotation",
                                         [GLTF_SCALE] = "scale",
                                         [GLTF_WEIGHTS] = "weights"};

/// The file, and what changes in it.
struct work {
    struct take *take;
    const struct gltf *gltf;
    const struct tracks *tracks;
    struct glb file;
    char *text; ///< its JSON
    bool from_binary, to_binary;
    struct json_splices splices;
    char *bytes; ///< the new keys
    size_t size;
    size_t before; ///< bytes of the buffer that the keys are added to
    bool has_own_buffer;
};

static char *dump(json_t *json)
{
    char *text = json ? json_dumps(json, JSON_COMPACT | JSON_REAL_PRECISION(9)) : NULL;
    json_decref(json);
    return text;
}

// --- the JSON's arrays

static size_t count_of(const struct work *work, const char *key)
{
    return json_array_size(json_object_get(work->file.json, key));
}

/// Adds elements to an array of the root, which may be missing.
static void add_elements(struct work *work, const char *key, char *elements)
{
    const struct json_span root = json_span_of(work->text);
    struct json_span array;
    char *members = NULL;
    if (json_span_member(work->text, root, key, &array)) {
        json_append(&work->splices, work->text, array, elements);
        return;
    }
    if (elements && asprintf(&members, "\"%s\":[%s]", key, elements) < 0) members = NULL;
    free(elements);
    json_prepend(&work->splices, work->text, root, members);
}

static bool find_element(const struct work *work, const char *key, size_t index, struct json_span *element)
{
    struct json_span array;
    return json_span_member(work->text, json_span_of(work->text), key, &array) &&
           json_span_element(work->text, array, index, element);
}

// --- keys

static bool pack_keys(struct work *work)
{
    const struct tracks *tracks = work->tracks;
    const size_t keys = (size_t)work->take->key_count;
    work->size = keys * sizeof(float);
    for (int t = 0; t < tracks->count; t++) work->size += keys * (size_t)tracks->list[t].components * sizeof(float);
    float *at = malloc(work->size + 1);
    work->bytes = (char *)at;
    if (!at) return false;
    for (size_t k = 0; k < keys; k++) *at++ = (float)take_seconds(work->take, (double)k);
    for (int t = 0; t < tracks->count; t++) {
        const size_t numbers = keys * (size_t)tracks->list[t].components;
        memcpy(at, tracks->list[t].values, numbers * sizeof *at);
        at += numbers;
    }
    return true;
}

/// The accessors: of the times, and of each track.
static void add_accessors(struct work *work)
{
    const struct tracks *tracks = work->tracks;
    const json_int_t view = (json_int_t)count_of(work, "bufferViews"), keys = work->take->key_count;
    const double last = (double)(float)take_seconds(work->take, (double)(keys - 1));
    json_int_t offset = keys * (json_int_t)sizeof(float);
    json_t *list = json_array();
    json_array_append_new(list, json_pack("{s:I, s:i, s:I, s:s, s:[f], s:[f]}", "bufferView", view, "componentType",
                                          GLB_FLOAT, "count", keys, "type", "SCALAR", "min", 0.0, "max", last));
    for (int t = 0; t < tracks->count; t++) {
        const struct track *track = &tracks->list[t];
        const bool is_list = track->path == GLTF_WEIGHTS;
        const json_int_t numbers = keys * track->components;
        json_array_append_new(list, json_pack("{s:I, s:I, s:i, s:I, s:s}", "bufferView", view, "byteOffset", offset,
                                              "componentType", GLB_FLOAT, "count", is_list ? numbers : keys, "type",
                                              is_list                        ? "SCALAR"
                                              : track->path == GLTF_ROTATION ? "VEC4"
                                                                             : "VEC3"));
        offset += numbers * (json_int_t)sizeof(float);
    }
    char *text = dump(list);
    if (text) { // without the brackets
        text[strlen(text) - 1] = ' ';
        text[0] = ' ';
    }
    add_elements(work, "accessors", text);
}

// --- the clip

/// Whether one of the tracks takes a channel's place.
static bool is_replaced(const struct tracks *tracks, const json_t *channel)
{
    const json_t *target = json_object_get(channel, "target");
    const char *path = json_string_value(json_object_get(target, "path"));
    for (int t = 0; path && t < tracks->count; t++) {
        if (glb_integer(target, "node", -1) == tracks->list[t].node &&
            strcmp(path, path_words[tracks->list[t].path]) == 0)
            return true;
    }
    return false;
}

/// Adds the channels that stay, each with its sampler.
static void keep_channels(const struct work *work, const json_t *clip, json_t *samplers, json_t *channels)
{
    const json_t *old = json_object_get(clip, "samplers");
    size_t i;
    json_t *channel;
    json_array_foreach(json_object_get(clip, "channels"), i, channel)
    {
        if (is_replaced(work->tracks, channel)) continue;
        const json_int_t sampler = glb_integer(channel, "sampler", 0);
        json_t *copy = json_copy(channel);
        json_object_set_new(copy, "sampler", json_integer((json_int_t)json_array_size(samplers)));
        json_array_append(samplers, json_array_get(old, (size_t)sampler));
        json_array_append_new(channels, copy);
    }
}

static void add_channels(const struct work *work, json_t *samplers, json_t *channels)
{
    const json_int_t times = (json_int_t)count_of(work, "accessors");
    for (int t = 0; t < work->tracks->count; t++) {
        const struct track *track = &work->tracks->list[t];
        const json_int_t sampler = (json_int_t)json_array_size(samplers);
        json_array_append_new(samplers, json_pack("{s:I, s:I, s:s}", "input", times, "output", times + 1 + t,
                                                  "interpolation", "LINEAR"));
        json_array_append_new(channels, json_pack("{s:I, s:{s:i, s:s}}", "sampler", sampler, "target", "node",
                                                  track->node, "path", path_words[track->path]));
    }
}

/// The clip that plays with the tracks in it, under its new name, in place of the one of that name or behind all others.
static void add_clip(struct work *work, const char *playing)
{
    const json_t *clips = json_object_get(work->file.json, "animations");
    const int from = playing ? gltf_find_clip(work->gltf, playing) : -1;
    const int to = gltf_find_clip(work->gltf, work->take->clip);
    const json_t *old = from >= 0 ? json_array_get(clips, (size_t)from) : NULL;
    json_t *clip = old ? json_copy((json_t *)old) : json_object();
    json_t *samplers = json_array(), *channels = json_array();
    struct json_span span;
    if (work->tracks->keeps_clip) keep_channels(work, old, samplers, channels);
    add_channels(work, samplers, channels);
    json_object_set_new(clip, "name", json_string(work->take->clip));
    json_object_set_new(clip, "samplers", samplers);
    json_object_set_new(clip, "channels", channels);
    char *text = dump(clip);
    if (to >= 0 && find_element(work, "animations", (size_t)to, &span)) {
        json_replace(&work->splices, span, text);
    } else {
        add_elements(work, "animations", text);
    }
}

// --- buffers

/// Another folder needs other names for the files beside.
static void rebase_uris(struct work *work, const char *key)
{
    char from[PATH_LIMIT], to[PATH_LIMIT], moved[PATH_LIMIT];
    if (!path_folder(work->gltf->path, from) || !path_folder(work->take->path, to)) return;
    for (size_t i = 0; i < count_of(work, key); i++) {
        const json_t *element = json_array_get(json_object_get(work->file.json, key), i);
        const char *uri = json_string_value(json_object_get(element, "uri"));
        struct json_span span, value;
        if (!uri || strncmp(uri, "data:", 5) == 0 || !path_rebase(uri, from, to, moved)) continue;
        if (find_element(work, key, i, &span) && json_span_member(work->text, span, "uri", &value))
            json_replace(&work->splices, value, dump(json_string(moved)));
    }
}

/// The number of a buffer's bytes, and in text, the bytes themselves.
static void grow_chunk(struct work *work)
{
    struct json_span buffer, length;
    char *text = NULL;
    if (!find_element(work, "buffers", 0, &buffer) || !json_span_member(work->text, buffer, "byteLength", &length))
        return;
    if (asprintf(&text, "%zu", work->before + work->size) < 0) text = NULL;
    json_replace(&work->splices, length, text);
}

/// Where the bytes of a .glb go into text, the chunk with the keys becomes a data URI.
static void unpack_chunk(struct work *work)
{
    struct json_span buffer;
    char *all = calloc(1, work->before + work->size + 1), *uri = NULL, *member = NULL;
    if (all) {
        memcpy(all, work->file.chunk.at, work->file.chunk.size < work->before ? work->file.chunk.size : work->before);
        memcpy(all + work->before, work->bytes, work->size);
        uri = gltf_file_address(all, work->before + work->size);
    }
    if (uri && asprintf(&member, "\"uri\":\"%s\"", uri) < 0) member = NULL;
    if (find_element(work, "buffers", 0, &buffer)) {
        json_prepend(&work->splices, work->text, buffer, member);
    } else {
        free(member);
    }
    free(all);
    free(uri);
}

/// A buffer of the keys' own, where there is no chunk to add them to.
static void add_buffer(struct work *work)
{
    char *uri = gltf_file_address(work->bytes, work->size), *text = NULL;
    if (uri && asprintf(&text, "{\"byteLength\":%zu,\"uri\":\"%s\"}", work->size, uri) < 0) text = NULL;
    free(uri);
    add_elements(work, "buffers", text);
}

static void add_bytes(struct work *work)
{
    const json_int_t buffer = work->has_own_buffer ? (json_int_t)count_of(work, "buffers") : 0;
    char *view =
        dump(json_pack("{s:I, s:I, s:I}", "buffer", buffer, "byteOffset",
                       (json_int_t)(work->has_own_buffer ? 0 : work->before), "byteLength", (json_int_t)work->size));
    add_elements(work, "bufferViews", view);
    if (work->has_own_buffer) {
        add_buffer(work);
    } else {
        grow_chunk(work);
    }
}

// --- the file

/// Whether the first buffer is the chunk of a .glb.
static bool has_chunk(const struct work *work)
{
    const json_t *buffer = json_array_get(json_object_get(work->file.json, "buffers"), 0);
    return work->from_binary && work->file.chunk.at && buffer && !json_object_get(buffer, "uri");
}

static bool read_text(struct work *work)
{
    uint32_t magic, length;
    memcpy(&magic, work->file.data, sizeof magic); // of any file that could be read, as of its "{}"
    work->from_binary = magic == GLB_MAGIC;
    if (!work->from_binary) return (work->text = strdup(work->file.data)) != NULL;
    memcpy(&length, work->file.data + 12, sizeof length);
    return (work->text = strndup(work->file.data + 20, length)) != NULL;
}

static void write_word(FILE *out, size_t word)
{
    const uint32_t bits = (uint32_t)word;
    fwrite(&bits, sizeof bits, 1, out);
}

static void write_padded(FILE *out, const void *data, size_t size, size_t room, char fill)
{
    fwrite(data, 1, size < room ? size : room, out);
    for (size_t i = size; i < room; i++) fputc(fill, out);
}

static void write_binary(const struct work *work, const char *text, size_t size, FILE *out)
{
    const bool chunk = has_chunk(work);
    const size_t json = (size + 3) / 4 * 4, before = chunk ? work->before : 0;
    const size_t bytes = chunk ? before + (work->has_own_buffer ? 0 : work->size) : 0;
    write_word(out, GLB_MAGIC);
    write_word(out, 2);
    write_word(out, 12 + 8 + json + (chunk ? 8 + bytes : 0));
    write_word(out, json);
    write_word(out, GLB_JSON);
    write_padded(out, text, size, json, ' ');
    if (!chunk) return;
    write_word(out, bytes);
    write_word(out, GLB_BIN);
    write_padded(out, work->file.chunk.at, work->file.chunk.size, before, '\0');
    fwrite(work->bytes, 1, bytes - before, out);
}

static bool splice(struct work *work, const char *playing, FILE *out, struct error *error)
{
    size_t size;
    work->has_own_buffer = !has_chunk(work);
    work->before = has_chunk(work) ? (work->file.chunk.size + 3) / 4 * 4 : 0;
    if (work->tracks->has_chains) {
        if (!pack_keys(work)) return fail_no_memory(error, work->gltf->path);
        add_bytes(work);
        add_accessors(work);
        add_clip(work, playing);
    }
    if (work->from_binary && !work->to_binary && has_chunk(work)) unpack_chunk(work);
    rebase_uris(work, "buffers");
    rebase_uris(work, "images");
    char *text = json_spliced(work->text, &work->splices, &size);
    if (!text) return fail_no_memory(error, work->gltf->path);
    if (work->to_binary) {
        write_binary(work, text, size, out);
    } else {
        fwrite(text, 1, size, out);
    }
    free(text);
    return true;
}

static bool check(const struct take *take, const struct gltf *gltf, struct error *error)
{
    if (!take->is_cubic) return true;
    return fail(error, ERROR_USAGE, "--keys: expected linear for an imported character, got cubic: %s", gltf->path);
}

bool gltf_splice_write(struct take *take, int rig, bool binary, FILE *out, char summary[FORMAT_SUMMARY],
                       struct error *error)
{
    struct rig_pose pose;
    struct tracks tracks;
    if (!take_pose(take, rig, 0, &pose, error)) return false;
    const struct gltf *gltf = &pose.model.imported->gltf;
    if (!check(take, gltf, error) || !tracks_collect(take, rig, &tracks, error)) return false;
    struct work *work = calloc(1, sizeof *work);
    bool done = work ? glb_open_any(&work->file, gltf->path, error) : fail_no_memory(error, gltf->path);
    if (done) {
        work->take = take;
        work->gltf = gltf;
        work->tracks = &tracks;
        work->to_binary = binary;
        done = read_text(work) ? splice(work, take->posing->document->rigs[rig].model.clip, out, error)
                               : fail_no_memory(error, gltf->path);
        json_splices_free(&work->splices);
        glb_close(&work->file);
        free(work->text);
        free(work->bytes);
    }
    if (tracks.has_chains)
        snprintf(summary, FORMAT_SUMMARY, "clip \"%.40s\", %d tracks, %d keys", take->clip, tracks.count,
                 take->key_count);
    else
        snprintf(summary, FORMAT_SUMMARY, "no chains, so the file as it was");
    free(work);
    tracks_free(&tracks);
    return done;
}
