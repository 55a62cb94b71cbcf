/// Rigs as glTF 2.0: meshes with skins or morph targets, and one clip that moves them all. Or a character's own file with the keys of
/// its chains: its JSON is parsed, added to, and printed.
///
/// The clip's other channels stay as they are in that file, bit for bit. If the scene shows another part of the clip, or several rounds of it,
/// their keys are copied to that, with the file's own values between the same keys.
#include "model/gltf.h"
#include "base/file.h"
#include "base/need.h"
#include "export/form.h"
#include "model/glb.h"
#include "model/gltf_write.h"
#include "rig/import.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- morph targets of a file: the form's, or each as a positive and a negative one with weights 0 … 1, because Blender clamps weights

/// Fills the list: first all of the form's in order, then the negative ones ("up.-re" of "up.re"), for these weights of the form's targets.
static void make_targets(struct form *form, const struct gltf_weights *weights, int weights_count,
                         struct gltf_retargeting *r)
{
    const size_t count = (size_t)form->shape.target_count;
    float *low = pool_take(&form->pool, count, sizeof *low), *high = pool_take(&form->pool, count, sizeof *high);
    for (const struct gltf_weights *of = weights; r->clamped && of < weights + weights_count; of++) {
        for (int row = of->is_cubic; row < of->rows; row += of->is_cubic ? 3 : 1) {
            for (size_t t = 0; t < count; t++) {
                const float weight = of->values[(size_t)row * (size_t)of->stride + t];
                low[t] = fminf(low[t], weight);
                high[t] = fmaxf(high[t], weight);
            }
        }
    }
    r->pool = &form->pool;
    r->before = r->count = form->shape.target_count;
    r->list = pool_take(&form->pool, 2 * count, sizeof *r->list);
    for (int t = 0; t < r->before; t++) {
        struct gltf_retarget *target = &r->list[t];
        *target = (struct gltf_retarget){.source = t, .scale = 1, .name = form->shape.targets[t].name};
        // The largest |weight| of a group's targets, at least 1: weights are divided by it.
        for (int other = 0; other < r->before; other++) {
            if (form->targets[other].group == form->targets[t].group)
                target->scale = fmaxf(target->scale, fmaxf(high[other], -low[other]));
        }
    }
    for (int t = 0; t < r->before; t++) {
        if (!(low[t] < 0)) continue;
        const struct gltf_retarget *own = &r->list[t]; // "up.re" → "up.-re", "smile" → "-smile"
        const char *dot = strrchr(own->name, '.'), *behind = dot ? dot + 1 : own->name;
        char *start = pool_text(&form->pool, own->name, "", "");
        start[behind - own->name] = '\0';
        r->list[r->count++] = (struct gltf_retarget){
            .source = t, .scale = -own->scale, .name = pool_text(&form->pool, start, "-", behind)};
    }
}

// --- one animation

/// An animation being written. `file` must outlive it.
struct gltf_motion {
    struct gltf_file *file;
    json_t *samplers, *channels;
    json_int_t times; ///< accessor of the keys' times
    int key_count;
};

static const struct {
    const char *name;
    enum gltf_elements elements;
} paths[] = {{"translation", ELEMENTS_KEY_VECTORS},
             {"rotation", ELEMENTS_TURNS},
             {"scale", ELEMENTS_KEY_VECTORS},
             {"weights", ELEMENTS_KEYS}};

/// Adds a sampler and returns its number: `width` numbers per key, `stride` between keys, linear between them.
static json_int_t add_sampler(struct gltf_motion *motion, enum gltf_path path, const float *values, int width,
                              int stride)
{
    const size_t size = (size_t)width * sizeof *values, count = (size_t)motion->key_count;
    float *const keys = need(count, size), *at = keys;
    for (size_t from = 0; at < keys + count * (size_t)width; from += (size_t)stride)
        at = mempcpy(at, values + from, size);
    const json_int_t output = gltf_file_add(motion->file, paths[path].elements, keys,
                                            count * (path == GLTF_WEIGHTS ? (size_t)width : 1), false);
    free(keys);
    return gltf_append(
        motion->file, motion->samplers,
        json_pack("{s:I, s:I, s:s}", "input", motion->times, "output", output, "interpolation", "LINEAR"));
}

/// Adds a channel that moves a node by a sampler.
static void add_channel(struct gltf_motion *motion, json_int_t node, enum gltf_path path, json_int_t sampler)
{
    gltf_append(
        motion->file, motion->channels,
        json_pack("{s:I, s:{s:I, s:s}}", "sampler", sampler, "target", "node", node, "path", paths[path].name));
}

// --- a scene

struct scene {
    struct export_range *range;
    struct gltf_file file;
    struct gltf_motion motion;
    int joints, targets;
};

/// Whether any key differs from the rest.
static bool differs(const struct keys *keys, int column, int width, const float *rest)
{
    for (int k = 0; k < keys->count; k++) {
        for (int i = 0; i < width; i++) {
            if (keys_at(keys, k, column)[i] != rest[i]) return true;
        }
    }
    return false;
}

/// Adds a channel for a column of a rig's keys.
static void add_keys(struct gltf_motion *motion, json_int_t node, enum gltf_path path, const struct keys *keys,
                     int column, int width)
{
    add_channel(motion, node, path, add_sampler(motion, path, keys_at(keys, 0, column), width, keys->width));
}

static bool add_rig(struct scene *scene, int rig, struct error *error)
{
    struct form form;
    struct keys keys;
    struct gltf_retargeting targets = {.clamped = !scene->range->options->is_signed};
    if (!form_open(scene->range, rig, &form, error)) return false;
    if (!keys_collect(scene->range, rig, &form, &keys, error)) {
        form_close(&form);
        return false;
    }
    const struct gltf_weights weights = {
        .values = keys_at(&keys, 0, keys_weight(&keys, 0)), .rows = keys.count, .stride = keys.width};
    make_targets(&form, &weights, 1, &targets);

    struct gltf_file *file = &scene->file;
    json_t *nodes = json_object_get(file->root, "nodes");
    json_t *roots = json_object_get(json_array_get(json_object_get(file->root, "scenes"), 0), "nodes");
    struct gltf_shape shape = form.shape;
    shape.name = form.name;
    shape.target_count = targets.count;
    shape.targets = pool_take(&form.pool, (size_t)shape.target_count, sizeof *shape.targets);
    for (int t = 0; t < shape.target_count; t++) {
        const struct gltf_retarget *target = &targets.list[t];
        shape.targets[t] = form.shape.targets[target->source];
        shape.targets[t].name = target->name;
        shape.targets[t].scale *= target->scale;
        shape.targets[t].turn *= target->scale;
    }
    const json_int_t mesh = gltf_append_to(file, file->root, "meshes", gltf_shape_json(file, &shape));
    json_t *node = json_pack("{s:s, s:I}", "name", form.name, "mesh", mesh);
    const json_int_t mesh_node = gltf_append(file, nodes, node);
    gltf_append(file, roots, json_integer(mesh_node));

    // The joints as nodes, posed at the first key, and their skin.
    const json_int_t first_joint = (json_int_t)json_array_size(nodes);
    if (form.joint_count > 0) {
        json_t *joints = json_array();
        float(*inverse)[16] = pool_take(&form.pool, (size_t)form.joint_count, sizeof *inverse);
        for (int j = 0; j < form.joint_count; j++) {
            const struct form_joint *joint = &form.joints[j];
            const float *place = joint->parent < 0 ? keys.rows : joint->offset;
            json_t *own =
                json_pack("{s:s, s:o, s:o}", "name", joint->name, "translation", gltf_numbers(file, place, 3),
                          "rotation", gltf_numbers(file, keys.rows + keys_rotation(j), 4));
            gltf_append(file, joints, json_integer(gltf_append(file, nodes, own)));
            for (int k = 0; k < 4; k++) inverse[j][5 * k] = 1;
            for (int k = 0; k < 3; k++) inverse[j][12 + k] = -joint->bind[k];
            if (joint->parent < 0) continue;
            json_t *parent = json_array_get(nodes, (size_t)(first_joint + joint->parent));
            gltf_append_to(file, parent, "children", json_integer(first_joint + j));
        }
        gltf_append(file, roots, json_integer(first_joint));
        const json_int_t matrices = gltf_file_add(file, ELEMENTS_MATRICES, inverse, (size_t)form.joint_count, false);
        const json_int_t skin = gltf_append_to(
            file, file->root, "skins",
            json_pack("{s:o, s:I, s:I}", "joints", joints, "inverseBindMatrices", matrices, "skeleton", first_joint));
        gltf_set(file, node, "skin", json_integer(skin));
    } else {
        gltf_set(file, node, "translation", gltf_numbers(file, keys.rows, 3));
    }

    // The channels that move it.
    if (keys.travels)
        add_keys(&scene->motion, form.joint_count > 0 ? first_joint : mesh_node, GLTF_TRANSLATION, &keys, 0, 3);
    for (int j = 0; j < form.joint_count; j++) {
        if (j >= form.first_bone || differs(&keys, keys_rotation(j), 4, (const float[]){0, 0, 0, 1}))
            add_keys(&scene->motion, first_joint + j, GLTF_ROTATION, &keys, keys_rotation(j), 4);
        if (differs(&keys, keys_scale(&keys, j), 3, (const float[]){1, 1, 1}))
            add_keys(&scene->motion, first_joint + j, GLTF_SCALE, &keys, keys_scale(&keys, j), 3);
    }
    if (targets.count > 0)
        add_channel(&scene->motion, mesh_node, GLTF_WEIGHTS,
                    add_sampler(&scene->motion, GLTF_WEIGHTS, gltf_convert_weights(&targets, &weights), targets.count,
                                targets.count));
    scene->joints += form.joint_count - form.first_bone;
    scene->targets += targets.count;
    form_close(&form);
    return true;
}

bool gltf_write_scene(struct export_range *range, const int *rigs, int count, bool binary, FILE *out,
                      struct error *error)
{
    const char *wanted = range->options->clip ? range->options->clip : range->title;
    char *name = name_from(wanted, strlen(wanted)); // it may be an argument
    struct scene scene = {.range = range};
    struct gltf_file *file = &scene.file;
    file->root = json_pack("{s:{s:s, s:s}, s:i, s:[{s:[]}], s:[], s:[{s:s, s:[], s:[]}]}", "asset", "version", "2.0",
                           "generator", "wiggly", "scene", 0, "scenes", "nodes", "nodes", "animations", "name", name,
                           "samplers", "channels");
    free(name);
    const json_t *clip = json_array_get(json_object_get(file->root, "animations"), 0);
    scene.motion = (struct gltf_motion){.file = file,
                                        .samplers = json_object_get(clip, "samplers"),
                                        .channels = json_object_get(clip, "channels"),
                                        .key_count = range->key_count};
    bool done = true;
    float *times = need((size_t)range->key_count, sizeof *times);
    for (int k = 0; k < range->key_count; k++) times[k] = (float)range_seconds(range, k);
    scene.motion.times = gltf_file_add(file, ELEMENTS_KEYS, times, (size_t)range->key_count, true);
    free(times);
    for (int r = 0; done && r < count; r++) done = add_rig(&scene, rigs[r], error);
    if (json_array_size(scene.motion.channels) == 0) json_object_del(file->root, "animations");
    done = done && gltf_file_write(file, binary, out, error);
    char joints[32] = "", targets[32] = "";
    if (scene.joints > 0) snprintf(joints, sizeof joints, "%d joints, ", scene.joints);
    if (scene.targets > 0) snprintf(targets, sizeof targets, "%d morph targets, ", scene.targets);
    snprintf(range->summary, FORMAT_SUMMARY, "%s%s%d keys", joints, targets, range->key_count);
    gltf_file_free(file);
    return done;
}

// --- a character's own file

static const double EARLIER = 4e-6; ///< of a time and its clip's length: before a step, more than posing rounds
static const double NEAR = 1e-3;    ///< frames of the grid between keys that count as one

/// What is exported, in seconds of the clip as the scene repeats it: round r begins at first + r · length.
struct part {
    struct clip_play play;
    double end;      ///< of the clip's last key
    double from, to; ///< of the first and last exported key
    double shift;    ///< from there to the exported file's times
    int rounds[2];   ///< the first and last round that it touches
    bool is_clip;    ///< the part is the clip in the file
};

// --- the times of the chains' keys

struct key_time {
    double at;   ///< seconds in the scene
    float time;  ///< in the file
    bool is_own; ///< the clip has a key of the bones there, or begins or ends there
};

struct key_times {
    struct key_time *list;
    size_t count;
};

static void add_time(struct key_times *times, const struct part *part, double at, bool is_own)
{
    if (at < part->from || at > part->to) return;
    times->list = need_more(times->list, times->count + 1, sizeof *times->list);
    times->list[times->count++] = (struct key_time){at, (float)(at + part->shift), is_own};
}

static int compare_times(const void *a, const void *b)
{
    const struct key_time *one = a, *other = b;
    return (one->at > other->at) - (one->at < other->at);
}

/// Whether splines move a node in this way: the bones of chains, and the morph weights of what is soft.
static bool is_moved(const struct form *form, json_int_t node, enum gltf_path path)
{
    bool moved = path == GLTF_WEIGHTS && node >= 0 && node == form->soft;
    for (int j = 0; j < form->joint_count && path == GLTF_ROTATION; j++) moved |= form->joints[j].node == node;
    return moved;
}

// --- other channels, where the part is not the clip

/// Appends a key, whose tangents are 0 where only a value is given. Where a round ends with another value than the next begins with, it ends just
/// before that.
static void push_key(struct gltf_channel *to, double time, const float *key, bool is_whole)
{
    const int n = to->components, stride = gltf_stride(to), middle = stride > n ? n : 0;
    const size_t size = (size_t)stride;
    const int last = to->key_count - 1;
    float *const end = to->values + (size_t)to->key_count * size;
    if (last >= 0 && (float)time <= to->times[last]) {
        float *const before = end - size;
        const float *value = is_whole ? key + middle : key;
        const bool same = memcmp(before + middle, value, (size_t)n * sizeof *value) == 0;
        if (same && is_whole && middle) memcpy(before + 2 * n, key + 2 * n, (size_t)n * sizeof *key);
        if (same) return;
        to->times[last] = nextafterf((float)time, -INFINITY);
        if (last > 0 && to->times[last] <= to->times[last - 1]) return;
    }
    to->times[to->key_count++] = (float)time;
    memset(end, 0, size * sizeof *end);
    if (is_whole) {
        memcpy(end, key, size * sizeof *key);
    } else {
        memcpy(end + middle, key, (size_t)n * sizeof *key);
    }
}

static void reserve_keys(struct gltf_channel *channel, struct pool *pool, size_t keys,
                         const struct gltf_channel *like)
{
    *channel = *like;
    channel->key_count = 0;
    channel->times = pool_take(pool, keys, sizeof *channel->times);
    channel->values = pool_take(pool, keys * (size_t)gltf_stride(like), sizeof *channel->values);
}

/// Adds the curve's value and slope at a time between its keys.
static void push_between(struct gltf_channel *to, const struct gltf_channel *from, double time)
{
    const int n = from->components, stride = gltf_stride(from);
    float *key = need_zeroed(3 * (size_t)n, sizeof *key);
    int k = 0;
    while (k + 1 < from->key_count && (double)from->times[k + 1] <= time) k++;
    gltf_channel_at(from, time, key + n);
    if (from->interpolation != GLTF_CUBIC) {
        push_key(to, time, key + n, true);
    } else {
        const double T = k + 1 < from->key_count ? (double)(from->times[k + 1] - from->times[k]) : 0;
        const double s = T > 0 ? (time - (double)from->times[k]) / T : 0;
        const float *at = from->values + (size_t)k * (size_t)stride;
        for (int i = 0; i < n && T > 0 && s >= 0; i++) {
            const double slope = (6 * s * s - 6 * s) / T * (double)(at[n + i] - at[4 * n + i]) +
                                 (3 * s * s - 4 * s + 1) * (double)at[2 * n + i] +
                                 (3 * s * s - 2 * s) * (double)at[3 * n + i];
            key[i] = key[2 * n + i] = (float)slope;
        }
        push_key(to, time, key, true);
    }
    free(key);
}

/// Lets a sampler have the part's keys. One whose numbers cannot be read stays as it is.
static void cut_sampler(struct gltf_file *file, json_t *sampler, bool is_rotation, const struct part *part)
{
    static const enum gltf_elements kinds[17] = {[1] = ELEMENTS_KEYS,
                                                 [2] = ELEMENTS_UVS,
                                                 [3] = ELEMENTS_KEY_VECTORS,
                                                 [4] = ELEMENTS_TURNS,
                                                 [16] = ELEMENTS_MATRICES};
    const char *interpolation = json_string_value(json_object_get(sampler, "interpolation"));
    struct pool pool = {0};
    struct glb_numbers times = {0}, values = {0};
    struct error error = {0};
    const bool is_read = gltf_file_numbers(file, glb_integer(sampler, "input", -1), &pool, &times, &error) &&
                         gltf_file_numbers(file, glb_integer(sampler, "output", -1), &pool, &values, &error);
    file->without_memory |= error.kind == ERROR_ENVIRONMENT;
    struct gltf_channel unrolled, result,
        own = {.path = is_rotation ? GLTF_ROTATION : GLTF_TRANSLATION,
               .interpolation = GLTF_LINEAR,
               .key_count = times.count,
               .times = times.values,
               .values = values.values};
    if (interpolation && strcmp(interpolation, "STEP") == 0) own.interpolation = GLTF_STEP;
    if (interpolation && strcmp(interpolation, "CUBICSPLINE") == 0) own.interpolation = GLTF_CUBIC;
    const size_t all_values = (size_t)values.count * (size_t)values.components,
                 all_keys = (size_t)times.count * (own.interpolation == GLTF_CUBIC ? 3 : 1);
    if (!is_read || times.components != 1 || all_values % all_keys != 0 ||
        (is_rotation && all_values != 4 * all_keys)) {
        pool_free(&pool);
        return;
    }
    own.components = (int)(all_values / all_keys);
    const int element = values.components;
    const int stride = gltf_stride(&own), middle = stride > own.components ? own.components : 0,
              count = own.key_count;

    // The keys of all rounds, in the exported file's times. A channel that begins after its clip, or ends before, stands still there.
    reserve_keys(&unrolled, &pool, (size_t)(count + 2) * (size_t)(part->rounds[1] - part->rounds[0] + 1), &own);
    for (int round = part->rounds[0]; round <= part->rounds[1]; round++) {
        const double later = part->shift + round * part->play.length;
        if ((double)own.times[0] > part->play.first)
            push_key(&unrolled, part->play.first + later, own.values + middle, false);
        for (int k = 0; k < count; k++)
            push_key(&unrolled, (double)own.times[k] + later, own.values + (size_t)k * (size_t)stride, true);
        if ((double)own.times[count - 1] < part->end && part->rounds[1] > part->rounds[0])
            push_key(&unrolled, part->end + later, own.values + (size_t)(count - 1) * (size_t)stride + middle, false);
    }

    // Of these the part that is exported.
    const double first = part->from + part->shift, last = part->to + part->shift;
    reserve_keys(&result, &pool, (size_t)unrolled.key_count + 2, &unrolled);
    push_between(&result, &unrolled, first);
    for (int k = 0; k < unrolled.key_count; k++) {
        const double time = (double)unrolled.times[k];
        if (time > (double)(float)first && time < (double)(float)last)
            push_key(&result, time, unrolled.values + (size_t)k * (size_t)stride, true);
    }
    if (last > first) push_between(&result, &unrolled, last);

    const size_t keys = (size_t)result.key_count, total = keys * (size_t)stride;
    if (element < 17 && (kinds[element] || element == 0)) {
        gltf_set(file, sampler, "input", json_integer(gltf_file_add(file, ELEMENTS_KEYS, result.times, keys, true)));
        gltf_set(file, sampler, "output",
                 json_integer(gltf_file_add(file, kinds[element], result.values, total / (size_t)element, false)));
    }
    pool_free(&pool);
}

/// What a channel moves; false: nothing that is known.
static bool find_target(const json_t *channel, json_int_t *node, enum gltf_path *path)
{
    const json_t *target = json_object_get(channel, "target");
    const char *name = json_string_value(json_object_get(target, "path"));
    *node = glb_integer(target, "node", -1);
    for (int p = GLTF_TRANSLATION; name && p <= GLTF_WEIGHTS; p++) {
        *path = (enum gltf_path)p;
        if (strcmp(paths[p].name, name) == 0) return *node >= 0;
    }
    return false;
}

/// Lets a sampler move a node, in the channel that the clip has for that, or a new one.
static void put_sampler(struct gltf_motion *motion, json_int_t node, enum gltf_path path, json_int_t sampler)
{
    json_t *channel;
    size_t i;
    bool found = false;
    json_array_foreach(motion->channels, i, channel)
    {
        json_int_t own;
        enum gltf_path by;
        if (!find_target(channel, &own, &by) || own != node || by != path) continue;
        gltf_set(motion->file, channel, "sampler", json_integer(sampler));
        found = true;
    }
    if (!found) add_channel(motion, node, path, sampler);
}

// --- the clip

/// Makes the clip's accessor of times, and poses the rig at them: the keys of the range and of the bones in the clip, in ascending order; those of
/// the range go where two are almost at one time.
static bool collect_clip_keys(struct export_range *range, struct form *form, const struct part *part,
                              struct gltf_motion *motion, struct keys *keys, struct error *error)
{
    const double fps = range->posing->document->fps;
    struct key_times times = {0};
    add_time(&times, part, part->from, true);
    if (part->to > part->from) add_time(&times, part, part->to, true);
    for (int k = 0; k < range->key_count; k++) add_time(&times, part, range_frame(range, k) / fps, false);
    for (int c = 0; form->clip && c < form->clip->channel_count; c++) {
        const struct gltf_channel *channel = &form->clip->channels[c];
        if (!is_moved(form, channel->node, channel->path)) continue;
        // Its own keys, so that none between two frames is lost. A step has a key just before it.
        for (int round = part->rounds[0]; round <= part->rounds[1]; round++) {
            for (int k = 0; k < channel->key_count; k++) {
                const double at = (double)channel->times[k] + round * part->play.length;
                const size_t before = times.count;
                if (channel->interpolation == GLTF_STEP && k > 0)
                    add_time(&times, part, at - EARLIER * (fabs(at) + part->play.length), true);
                if (times.count > before) times.list[before].time = nextafterf((float)(at + part->shift), -INFINITY);
                add_time(&times, part, at, true);
            }
        }
    }
    qsort(times.list, times.count, sizeof *times.list, compare_times);
    int count = 0;
    for (size_t i = 0; i < times.count; i++) {
        const struct key_time *next = &times.list[i], *last = count > 0 ? &times.list[count - 1] : NULL;
        if (last && next->at - last->at < NEAR * range->spacing / fps && !(next->is_own && last->is_own)) {
            if (next->is_own) times.list[count - 1] = *next;
        } else if (!last || next->time > last->time) {
            times.list[count++] = *next;
        }
    }

    double *frames = pool_take(&form->pool, (size_t)count, sizeof *frames);
    float *seconds = pool_take(&form->pool, (size_t)count, sizeof *seconds);
    for (int k = 0; k < count; k++) {
        frames[k] = times.list[k].at * fps;
        seconds[k] = times.list[k].time;
    }
    free(times.list);
    const int on_grid = range->key_count;
    range->frames = frames;
    range->key_count = motion->key_count = count;
    range->total += count - on_grid;
    const bool done = keys_collect(range, range->rigs[0], form, keys, error);
    range->frames = NULL;
    range->key_count = on_grid;
    motion->times = gltf_file_add(motion->file, ELEMENTS_KEYS, seconds, (size_t)count, true);
    return done;
}

/// Puts the keys of the chains into the clip that the rig plays, or into a copy of it.
static bool put_clip(struct export_range *range, struct form *form, struct gltf_file *file, struct error *error)
{
    json_t *root = file->root;
    const struct model_rig *model = &range->posing->document->rigs[range->rigs[0]]->model;
    const char *wanted = range->options->clip ? range->options->clip : model->clip ? model->clip : range->title;
    const struct gltf_clip *playing = form->clip;
    const double fps = range->posing->document->fps;
    struct part part = {.from = range_frame(range, 0) / fps, .to = range_frame(range, range->key_count - 1) / fps};
    part.shift = -part.from;
    if (playing) {
        // The part that the keys cover. It is the clip itself where they begin and end within a frame of it; one that plays once, or is a
        // single pose, may end before.
        part.play = clip_play(model, playing);
        part.end = playing->last;
        const double length = part.play.length, frame = fmax(1, range->spacing) / fps;
        const bool ends =
            part.to > part.end - frame && (!part.play.loops || part.to < playing->first + length + frame);
        part.is_clip = !(length > 0) || (fabs(part.from - playing->first) < frame && ends);
        if (part.is_clip && length > 0) {
            part.from = playing->first;
            if (part.play.loops || part.to < part.end + frame) part.to = part.end;
        }
        part.shift = playing->first - part.from;
        if (part.play.loops && length > 0) {
            const double begin = floor((part.from - playing->first) / length + 1e-6),
                         end = ceil((part.to - playing->first) / length - 1e-6) - 1;
            part.rounds[0] = (int)fmin(fmax(begin, -1e9), 1e9); // a round is no shorter than a key
            part.rounds[1] = part.rounds[0] + (int)fmin(fmax(end - begin, 0), range->key_count);
        }
    }
    struct gltf_motion motion = {.file = file};
    struct keys keys;
    size_t i;
    if (!collect_clip_keys(range, form, &part, &motion, &keys, error)) return false;
    char *name = name_from(wanted, strlen(wanted)); // it may be an argument
    const int known = gltf_find_clip(form->gltf, name);

    // A copy of the clip that plays, by the name that it is to have; the clip itself if it has that name.
    static const char *const arrays[] = {"samplers", "channels"};
    json_t *clips = json_object_get(root, "animations"), *nodes = json_object_get(root, "nodes"), *channel;
    json_t *clip =
        form->clip ? json_deep_copy(json_array_get(clips, (size_t)(form->clip - form->gltf->clips))) : json_object();
    if (!form->clip || strcmp(form->clip->name, name) != 0) gltf_set(file, clip, "name", json_string(name));
    for (i = 0; i < 2; i++)
        if (!json_object_get(clip, arrays[i])) gltf_set(file, clip, arrays[i], json_array());
    free(name);
    motion.samplers = json_object_get(clip, "samplers");
    motion.channels = json_object_get(clip, "channels");
    if (playing && !part.is_clip) { // all samplers but those of chains get the part's keys
        const size_t samplers = json_array_size(motion.samplers);
        bool *done = need_zeroed(samplers + 1, sizeof *done);
        json_array_foreach(motion.channels, i, channel)
        {
            const size_t s = (size_t)glb_integer(channel, "sampler", -1);
            json_int_t node;
            enum gltf_path path;
            const bool is_known = find_target(channel, &node, &path);
            if (s >= samplers || done[s] || (is_known && is_moved(form, node, path))) continue;
            done[s] = true;
            cut_sampler(file, json_array_get(motion.samplers, s), is_known && path == GLTF_ROTATION, &part);
        }
        free(done);
    }

    for (int j = 0; j < form->joint_count; j++)
        put_sampler(&motion, form->joints[j].node, GLTF_ROTATION,
                    add_sampler(&motion, GLTF_ROTATION, keys_at(&keys, 0, keys_rotation(j)), 4, keys.width));
    if (form->soft >= 0)
        put_sampler(&motion, form->soft, GLTF_WEIGHTS,
                    add_sampler(&motion, GLTF_WEIGHTS, keys_at(&keys, 0, keys_weight(&keys, 0)),
                                form->shape.target_count, keys.width));

    // The matrices of nodes that the clip moves are split, because glTF does not allow it to move a matrix.
    json_array_foreach(motion.channels, i, channel)
    {
        json_int_t n;
        enum gltf_path path;
        if (!find_target(channel, &n, &path) || path == GLTF_WEIGHTS) continue;
        json_t *node = json_array_get(nodes, (size_t)n);
        if (!json_object_get(node, "matrix") || form->gltf->nodes[n].has_matrix) continue;
        const struct gltf_place *place = &form->gltf->nodes[n].place;
        json_object_del(node, "matrix");
        gltf_set(file, node, "translation", gltf_numbers(file, place->translation, 3));
        gltf_set(file, node, "rotation", gltf_numbers(file, place->rotation, 4));
        gltf_set(file, node, "scale", gltf_numbers(file, place->scale, 3));
    }
    if (known < 0) {
        gltf_append_to(file, root, "animations", clip);
    } else if (json_array_set_new(clips, (size_t)known, clip) != 0) {
        file->without_memory = true;
    }
    return true;
}

// --- the same container

/// A file that stays what it is must be beside the files that it names.
static bool check_place(const struct export_range *range, const struct glb *source, struct error *error)
{
    char from[PATH_LIMIT], to[PATH_LIMIT], folder[PATH_LIMIT];
    static const char *const arrays[] = {"buffers", "images"};
    bool names_files = false;
    for (int a = 0; a < 2; a++) {
        size_t i;
        const json_t *thing;
        json_array_foreach(json_object_get(source->json, arrays[a]), i, thing)
        {
            const char *uri = json_string_value(json_object_get(thing, "uri"));
            names_files = names_files || (uri && strncmp(uri, "data:", 5) != 0);
        }
    }
    const bool same =
        !names_files || (path_folder(source->path, folder) && path_resolve(folder, ".", from) &&
                         path_folder(range->path, folder) && path_resolve(folder, ".", to) && strcmp(from, to) == 0);
    if (same) return true;
    return fail(error, ERROR_INPUT, "%s: refers to files beside it: export it to the same folder, or as .glb",
                source->path);
}

// --- the clips

/// Adds what the chains make of another clip of the file.
static bool put_other(struct export_range *range, int clip, struct gltf_file *file, struct error *error)
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
        done = put_clip(range, &form, file, error);
        form_close(&form);
    }
    evaluation_free(&evaluation);
    document_destroy(document);
    range->posing = first;
    return done;
}

// --- the morph targets of a soft mesh, for the weights that its clips have

/// Gives the soft mesh targets by which weights stay within 0 … 1, and those of paint, and all clips their weights.
static bool put_targets(const struct export_range *range, struct form *form, struct gltf_file *file,
                        struct error *error)
{
    const bool is_painted = figure_is_painted(form->figure);
    struct gltf_retargeting r = {.file = file,
                                 .pool = &form->pool,
                                 .mesh = form->gltf->nodes[form->soft].mesh,
                                 .before = form->shape.target_count,
                                 .clamped = !range->options->is_signed};
    bool done = gltf_find_weights(&r, error), changes = is_painted;
    if (done) make_targets(form, r.clips, r.clip_count, &r); // for the weights of all clips together
    for (int t = 0; done && t < r.count; t++) {
        changes |= r.list[t].scale != 1;
        r.list[t].is_new = is_painted && form->targets[r.list[t].source].group >= 0;
    }
    if (done && changes) {
        json_t *json = json_array_get(json_object_get(file->root, "meshes"), (size_t)r.mesh), *entry;
        json_t *known = json_object_get(json_object_get(json, "extras"), "wiggly");
        size_t i;
        json_array_foreach(json_object_get(known, "coordinates"), i, entry)
        {
            const int coordinate = figure_find(form->figure, json_string_value(json_object_get(entry, "name")));
            if (coordinate < 0) continue;
            const struct coordinate *c = &form->figure->character.coordinates[coordinate];
            gltf_set(file, entry, "scale", json_real(c->scale * (double)r.list[c->target[0]].scale));
        }
        gltf_retarget(&r, &form->gltf->meshes[r.mesh]);
    }
    free(r.clips);
    return done;
}

/// Copies the file of the range's only rig and gives its clip, or a copy of that by another name, the keys of chains. Everything else stays the
/// same, also in the other container (.glb or .gltf). Without a chain the clip stays, too.
static bool write_model(struct export_range *range, FILE *out, struct error *error)
{
    struct glb source;
    struct gltf_file to = {.source = &source}; // the file's JSON, and the bytes of the buffer that new ones go into
    int clips = 0;                             // that were put into it
    struct form form;
    struct rig_pose pose;
    if (!form_open(range, range->rigs[0], &form, error)) return false;
    const bool has_clip = form.joint_count > 0 || form.soft >= 0, binary = range->format->is_binary;
    bool done = range_pose(range, range->rigs[0], 0, &pose, error);
    const float *root = done ? range_root(range, range->rigs[0], &pose) : NULL;
    if (!done || !glb_open(&source, form.gltf->path, error)) {
        form_close(&form);
        return false;
    }
    const bool was_packed = glb_is_packed(&source);
    const bool is_same = !was_packed && (memcmp(source.data, "glTF", 4) == 0) == binary; // the container
    if (!has_clip && is_same && !root) {
        char *data = NULL;
        size_t size;
        done = check_place(range, &source, error) && file_read(form.gltf->path, GLB_FILE_LIMIT, &data, &size, error);
        if (done) fwrite(data, 1, size, out);
        free(data);
    } else {
        // The bytes that new ones follow: those of a .glb's chunk, if that is its first buffer; none of a .gltf; else all there are.
        const json_t *buffers = json_object_get(source.json, "buffers"), *first = json_array_get(buffers, 0);
        const bool has_chunk = source.chunk.at && first && !json_object_get(first, "uri");
        done = glb_read_buffers(&source, error);
        if (done && (!is_same || (binary && !has_chunk))) {
            done = gltf_file_gather(&to, error);
        } else if (done) {
            to.root = json_incref(source.json);
            if (has_chunk) gltf_file_append(&to, source.chunk.at, source.chunk.size);
            if (!has_chunk) to.buffer = (json_int_t)json_array_size(buffers);
            done = check_place(range, &source, error);
        }
        if (done && has_clip) {
            done = put_clip(range, &form, &to, error);
            clips = 1;
        }
        for (int c = 0; done && has_clip && range->options->all_clips && c < form.gltf->clip_count; c++) {
            const struct gltf_clip *clip = &form.gltf->clips[c]; // chains do not move in clips of a single pose
            if (clip == form.clip || !(clip->last > clip->first)) continue;
            done = put_other(range, c, &to, error);
            clips++;
        }

        if (done && form.soft >= 0) done = put_targets(range, &form, &to, error);

        // All scenes' nodes go under one with the character's matrix on the stage. Joints place a skinned mesh: it stays where it is, because
        // validators warn of one that has a parent.
        json_t *nodes = json_object_get(source.json, "nodes"), *scene, *number;
        size_t s, i;
        json_array_foreach(done && root ? json_object_get(source.json, "scenes") : NULL, s, scene)
        {
            json_t *placed = json_array(), *roots = json_array();
            json_array_foreach(json_object_get(scene, "nodes"), i, number)
            {
                const json_t *node = json_array_get(nodes, (size_t)json_integer_value(number));
                const bool is_skinned = json_object_get(node, "skin") && !json_object_get(node, "children");
                gltf_append(&to, is_skinned ? roots : placed, json_incref(number));
            }
            if (json_array_size(placed) > 0) {
                json_t *shown = json_pack("{s:s, s:o, s:O}", "name", "as shown", "matrix",
                                          gltf_numbers(&to, root, 16), "children", placed);
                gltf_append(&to, roots, json_integer(gltf_append(&to, nodes, shown)));
                gltf_set(&to, scene, "nodes", json_incref(roots));
            }
            json_decref(placed);
            json_decref(roots);
        }
        done = done && gltf_file_write(&to, binary, out, error);
    }
    gltf_file_free(&to);
    glb_close(&source);
    if (has_clip) {
        const bool both = form.joint_count > 0 && form.soft >= 0;
        range->summary[0] = '\0';
        if (form.joint_count > 0)
            print_more(range->summary, FORMAT_SUMMARY, "%d bones bent by chains%s", form.joint_count,
                       both ? ", " : "");
        if (form.soft >= 0) print_more(range->summary, FORMAT_SUMMARY, "%d morph targets", form.shape.target_count);
        print_more(range->summary, FORMAT_SUMMARY, " in %d clip%s, %ld keys%s", clips, clips == 1 ? "" : "s",
                   range->total, was_packed ? ", meshes decompressed" : "");
    } else {
        snprintf(range->summary, FORMAT_SUMMARY, "the file as it was, %sbecause no spline moves it",
                 was_packed ? "meshes decompressed, " : "");
    }
    form_close(&form);
    return done;
}

/// A character is written to a file of its own, without other rigs.
bool gltf_write(struct export_range *range, FILE *out, struct error *error)
{
    const struct document *document = range->posing->document;
    for (int r = 0; r < range->rig_count; r++) {
        const struct rig *rig = document->rigs[range->rigs[r]];
        if (!(form_kind(range->posing, range->rigs[r])->holds & FORM_FILE)) continue;
        if (range->rig_count == 1) return write_model(range, out, error);
        return fail(error, ERROR_INPUT, "\"%s\" is exported into a copy of its own file: choose one rig with %s",
                    form_name(rig), range->rig_choice);
    }
    return gltf_write_scene(range, range->rigs, range->rig_count, range->format->is_binary, out, error);
}
