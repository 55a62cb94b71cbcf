/// Rigs as glTF 2.0: meshes with skins or morph targets, and one clip that moves them all.
#include "export/gltf.h"
#include "base/need.h"
#include "model/gltf_write.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- morph targets of a file: the form's, or each as a positive and a negative one with weights 0 … 1, because Blender clamps weights

/// `scale` times a target of the form.
struct file_target {
    int source;
    float scale;      ///< below 0 for the negative one
    const char *name; ///< "up.re"; "up.-re" for the negative one
};

struct file_targets {
    struct file_target *list; ///< first all of the form's in order, then the negative ones
    int count;
    bool clamped; ///< weights are 0 … 1
};

static void make_targets(struct form *form, const struct keys *keys, bool clamped, struct file_targets *targets)
{
    const int count = form->target_count;
    *targets = (struct file_targets){.clamped = clamped, .count = count};
    targets->list = need_zeroed(2 * (size_t)count, sizeof *targets->list);
    for (int t = 0; t < count; t++) {
        struct file_target *target = &targets->list[t];
        *target = (struct file_target){.source = t, .scale = 1.0f, .name = form->targets[t].figure.name};
        // The largest |weight| of a group's targets over all keys, at least 1: weights are divided by it.
        for (int other = 0; clamped && other < count; other++) {
            if (form->targets[other].group != form->targets[t].group) continue;
            for (int k = 0; k < keys->count; k++)
                target->scale = fmaxf(target->scale, fabsf(*keys_at(keys, k, keys_weight(keys, other))));
        }
    }
    for (int t = 0; clamped && t < count; t++) {
        int k = 0;
        while (k < keys->count && !(*keys_at(keys, k, keys_weight(keys, t)) < 0)) k++;
        if (k == keys->count) continue;                    // it is never negative
        const struct file_target *own = &targets->list[t]; // "up.re" → "up.-re", "smile" → "-smile"
        const char *dot = strrchr(own->name, '.'), *behind = dot ? dot + 1 : own->name;
        char *start = form_text(&form->pool, own->name, "", "");
        start[behind - own->name] = '\0';
        targets->list[targets->count++] = (struct file_target){
            .source = t, .scale = -own->scale, .name = form_text(&form->pool, start, "-", behind)};
    }
}

// --- one animation

static const struct {
    const char *name;
    enum gltf_elements elements;
} paths[] = {{"translation", ELEMENTS_KEY_VECTORS},
             {"rotation", ELEMENTS_TURNS},
             {"scale", ELEMENTS_KEY_VECTORS},
             {"weights", ELEMENTS_KEYS}};

/// Adds a sampler and returns its number: `width` numbers per key, `stride` between keys, and slopes per second (NULL: linear between keys).
static json_int_t add_sampler(struct gltf_motion *motion, enum gltf_path path, const float *values,
                              const float *slopes, int width, int stride)
{
    const size_t size = (size_t)width * sizeof *values, count = (size_t)motion->key_count * (slopes ? 3 : 1);
    float *const keys = need(count, size), *at = keys;
    for (size_t from = 0; at < keys + count * (size_t)width; from += (size_t)stride) {
        if (slopes) at = mempcpy(at, slopes + from, size); // in-tangent, value, out-tangent
        at = mempcpy(at, values + from, size);
        if (slopes) at = mempcpy(at, slopes + from, size);
    }
    const json_int_t output = gltf_file_add(motion->file, paths[path].elements, keys,
                                            count * (path == GLTF_WEIGHTS ? (size_t)width : 1), false);
    free(keys);
    return gltf_append(motion->file, motion->samplers,
                       json_pack("{s:I, s:I, s:s}", "input", motion->times, "output", output, "interpolation",
                                 slopes ? "CUBICSPLINE" : "LINEAR"));
}

json_int_t gltf_motion_add_sampler(struct gltf_motion *motion, enum gltf_path path, const struct keys *keys,
                                   int column, int width)
{
    return add_sampler(motion, path, keys_at(keys, 0, column), keys->slopes ? keys->slopes + column : NULL, width,
                       keys->width);
}

void gltf_motion_add_channel(struct gltf_motion *motion, json_int_t node, enum gltf_path path, json_int_t sampler)
{
    gltf_append(
        motion->file, motion->channels,
        json_pack("{s:I, s:{s:I, s:s}}", "sampler", sampler, "target", "node", node, "path", paths[path].name));
}

// --- a scene

struct scene {
    struct export_range *range;
    struct gltf_file file;
    struct gltf_looks looks;
    json_t *roots, *nodes, *meshes, *skins;
    struct gltf_motion motion;
    int joints, targets;
};

/// A rig being added to a scene.
struct part {
    const struct form *form;
    const struct keys *keys;
    const struct file_targets *targets;
    json_int_t mesh_node, first_joint;
};

static json_t *numbers(struct scene *scene, const float *values, int count)
{
    json_t *array = json_array();
    for (int i = 0; i < count; i++) gltf_append(&scene->file, array, json_real((double)values[i]));
    return array;
}

// --- mesh

static json_int_t add_mesh(struct scene *scene, const struct part *part)
{
    const struct form *form = part->form;
    struct gltf_shape shape = {.name = form->name,
                               .vertex_count = form->vertex_count,
                               .position = form->position,
                               .normal = form->normal,
                               .color = form->color,
                               .uv = form->looks ? (const float(*)[2])form->looks->uv : NULL,
                               .joints = (const uint16_t(*)[4])form->slots,
                               .weights = (const float(*)[4])form->weights,
                               .indices = form->indices,
                               .index_count = form->index_count,
                               .looks = form->looks,
                               .target_count = part->targets->count,
                               .character = form->character};
    shape.targets = need((size_t)shape.target_count, sizeof *shape.targets);
    for (int t = 0; t < shape.target_count; t++) {
        const struct file_target *target = &part->targets->list[t];
        const struct figure_target *of = &form->targets[target->source].figure;
        shape.targets[t] = (struct gltf_shape_target){target->name, of->position, (const float(*)[3])of->normal,
                                                      of->sign * target->scale, target->scale};
    }
    const json_int_t mesh = gltf_append(&scene->file, scene->meshes, gltf_shape_json(&scene->looks, &shape));
    free(shape.targets);
    return mesh;
}

// --- nodes

/// Adds the mesh's node and, posed at the first key, the joints as nodes and their skin.
static void add_nodes(struct scene *scene, struct part *part, json_int_t mesh)
{
    const struct form *form = part->form;
    struct gltf_file *file = &scene->file;
    json_t *node = json_pack("{s:s, s:I}", "name", form->name, "mesh", mesh);
    part->mesh_node = gltf_append(file, scene->nodes, node);
    gltf_append(file, scene->roots, json_integer(part->mesh_node));
    if (form->joint_count == 0) {
        gltf_set(file, node, "translation", numbers(scene, part->keys->rows, 3));
        return;
    }
    json_t *joints = json_array();
    part->first_joint = (json_int_t)json_array_size(scene->nodes);
    for (int j = 0; j < form->joint_count; j++) {
        const struct form_joint *joint = &form->joints[j];
        const float *place = joint->parent < 0 ? part->keys->rows : joint->offset;
        json_t *own = json_pack("{s:s, s:o, s:o}", "name", joint->name, "translation", numbers(scene, place, 3),
                                "rotation", numbers(scene, part->keys->rows + keys_rotation(j), 4));
        gltf_append(file, joints, json_integer(gltf_append(file, scene->nodes, own)));
        if (joint->parent < 0) continue;
        json_t *parent = json_array_get(scene->nodes, (size_t)(part->first_joint + joint->parent));
        gltf_append_to(file, parent, "children", json_integer(part->first_joint + j));
    }
    gltf_append(file, scene->roots, json_integer(part->first_joint));
    float(*inverse)[16] = need_zeroed((size_t)form->joint_count, sizeof *inverse);
    for (int j = 0; j < form->joint_count; j++) {
        for (int k = 0; k < 4; k++) inverse[j][5 * k] = 1;
        for (int k = 0; k < 3; k++) inverse[j][12 + k] = -form->joints[j].bind[k];
    }
    const json_int_t matrices = gltf_file_add(file, ELEMENTS_MATRICES, inverse, (size_t)form->joint_count, false);
    free(inverse);
    const json_int_t skin = gltf_append(file, scene->skins,
                                        json_pack("{s:o, s:I, s:I}", "joints", joints, "inverseBindMatrices",
                                                  matrices, "skeleton", part->first_joint));
    gltf_set(file, node, "skin", json_integer(skin));
}

// --- the clip

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

static void add_keys(struct gltf_motion *motion, json_int_t node, enum gltf_path path, const struct keys *keys,
                     int column, int width)
{
    gltf_motion_add_channel(motion, node, path, gltf_motion_add_sampler(motion, path, keys, column, width));
}

static void add_animation(struct scene *scene, const struct part *part)
{
    const struct form *form = part->form;
    const struct keys *keys = part->keys;
    if (keys->travels)
        add_keys(&scene->motion, form->joint_count > 0 ? part->first_joint : part->mesh_node, GLTF_TRANSLATION, keys,
                 0, 3);
    for (int j = 0; j < form->joint_count; j++) {
        if (j >= form->first_bone || differs(keys, keys_rotation(j), 4, (const float[]){0, 0, 0, 1}))
            add_keys(&scene->motion, part->first_joint + j, GLTF_ROTATION, keys, keys_rotation(j), 4);
        if (differs(keys, keys_scale(keys, j), 3, (const float[]){1, 1, 1}))
            add_keys(&scene->motion, part->first_joint + j, GLTF_SCALE, keys, keys_scale(keys, j), 3);
    }
    const int width = part->targets->count;
    if (width == 0) return;
    const size_t count = (size_t)width * (size_t)keys->count;
    float *values = need(count, sizeof *values);
    float *slopes = keys->slopes ? need_zeroed(count, sizeof *slopes) : NULL;
    for (int i = 0; i < width * keys->count; i++) {
        const struct file_target *target = &part->targets->list[i % width];
        const int column = keys_weight(keys, target->source);
        const float weight = *keys_at(keys, i / width, column) / target->scale;
        values[i] = part->targets->clamped ? fminf(fmaxf(weight, 0.0f), 1.0f) : weight;
        if (!slopes || (part->targets->clamped && weight <= 0)) continue;
        slopes[i] = keys->slopes[(size_t)(i / width) * (size_t)keys->width + (size_t)column] / target->scale;
    }
    gltf_motion_add_channel(&scene->motion, part->mesh_node, GLTF_WEIGHTS,
                            add_sampler(&scene->motion, GLTF_WEIGHTS, values, slopes, width, width));
    free(values);
    free(slopes);
}

// --- writing

static bool add_rig(struct scene *scene, int rig, struct error *error)
{
    struct form form;
    struct keys keys;
    struct file_targets targets = {0};
    if (!form_open(scene->range, rig, &form, error)) return false;
    bool done = keys_collect(scene->range, rig, &form, &keys, error);
    if (done) make_targets(&form, &keys, !scene->range->options->is_signed, &targets);
    if (done) {
        struct part part = {.form = &form, .keys = &keys, .targets = &targets};
        add_nodes(scene, &part, add_mesh(scene, &part));
        add_animation(scene, &part);
        scene->joints += form.joint_count - form.first_bone;
        scene->targets += targets.count;
    }
    free(targets.list);
    form_close(&form);
    return done;
}

static bool write_scene(struct export_range *range, const int *rigs, int count, bool binary, FILE *out,
                        struct error *error)
{
    struct scene scene = {.range = range, .motion = {.file = &scene.file, .key_count = range->key_count}};
    json_t **const arrays[] = {&scene.roots, &scene.nodes,           &scene.meshes,
                               &scene.skins, &scene.motion.samplers, &scene.motion.channels};
    enum { ARRAYS = sizeof arrays / sizeof *arrays };
    scene.looks.file = &scene.file;
    for (int i = 0; i < ARRAYS; i++) *arrays[i] = json_array();
    bool done = true;
    float *times = need((size_t)range->key_count, sizeof *times);
    for (int k = 0; k < range->key_count; k++) times[k] = (float)range_seconds(range, k);
    scene.motion.times = gltf_file_add(&scene.file, ELEMENTS_KEYS, times, (size_t)range->key_count, true);
    free(times);
    for (int r = 0; done && r < count; r++) done = add_rig(&scene, rigs[r], error);
    if (done) {
        json_t *root =
            json_pack("{s:{s:s, s:s}, s:i, s:[{s:O}], s:O, s:O}", "asset", "version", "2.0", "generator", "wiggly",
                      "scene", 0, "scenes", "nodes", scene.roots, "nodes", scene.nodes, "meshes", scene.meshes);
        gltf_looks_complete(&scene.looks, root);
        if (json_array_size(scene.skins) > 0) gltf_set(&scene.file, root, "skins", json_incref(scene.skins));
        if (json_array_size(scene.motion.channels) > 0) {
            const char *name = range->options->clip ? range->options->clip : range->title;
            char *valid = name_from(name, strlen(name)); // it may be an argument
            gltf_set(&scene.file, root, "animations",
                     json_pack("[{s:s, s:O, s:O}]", "name", valid, "samplers", scene.motion.samplers, "channels",
                               scene.motion.channels));
            free(valid);
        }
        done = gltf_file_write(&scene.file, root, binary, out, error);
    }
    char joints[32] = "", targets[32] = "";
    if (scene.joints > 0) snprintf(joints, sizeof joints, "%d joints, ", scene.joints);
    if (scene.targets > 0) snprintf(targets, sizeof targets, "%d morph targets, ", scene.targets);
    snprintf(range->summary, FORMAT_SUMMARY, "%s%s%d keys", joints, targets, range->key_count);
    for (int i = 0; i < ARRAYS; i++) json_decref(*arrays[i]);
    gltf_looks_free(&scene.looks);
    gltf_file_free(&scene.file);
    return done;
}

bool gltf_write_rig(struct export_range *range, int rig, FILE *out, struct error *error)
{
    return write_scene(range, &rig, 1, true, out, error);
}

/// An imported character is written to a file of its own, without other rigs.
bool gltf_write(struct export_range *range, FILE *out, struct error *error)
{
    const struct document *document = range->posing->document;
    for (int r = 0; r < range->rig_count; r++) {
        const struct rig *rig = document->rigs[range->rigs[r]];
        if (!(form_kind(rig->kind)->holds & FORM_FILE)) continue;
        if (range->rig_count == 1) return gltf_model_write(range, out, error);
        return fail(error, ERROR_INPUT, "\"%s\" is exported into a copy of its own file: choose one rig with %s",
                    form_name(rig), range->rig_choice);
    }
    return write_scene(range, range->rigs, range->rig_count, range->format->is_binary, out, error);
}
