/// Rigs as glTF 2.0: meshes with skins or morph targets, and one clip that moves them all.
#include "export/form.h"
#include "export/gltf_motion.h"
#include "export/keys.h"
#include "export/targets.h"
#include "model/gltf_shape.h"
#include <stdlib.h>
#include <string.h>

struct scene {
    struct export_range *range;
    struct gltf_file file;
    struct gltf_looks looks;
    json_t *roots, *nodes, *meshes, *skins;
    struct gltf_motion motion;
    int joints, targets;
};

/// One rig on its way into a scene.
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
    shape.targets = calloc((size_t)shape.target_count + 1, sizeof *shape.targets);
    if (!shape.targets) {
        scene->file.without_memory = true;
        return 0;
    }
    for (int t = 0; t < shape.target_count; t++) {
        const struct file_target *target = &part->targets->list[t];
        const struct form_target *of = &form->targets[target->source];
        shape.targets[t] = (struct gltf_shape_target){target->name, (const float(*)[3])of->position,
                                                      (const float(*)[3])of->normal, target->scale, target->scale};
    }
    const json_int_t mesh = gltf_append(&scene->file, scene->meshes, gltf_shape_json(&scene->looks, &shape));
    free(shape.targets);
    return mesh;
}

// --- nodes

/// The joints as nodes, posed as at the first key; returns the skin.
static json_int_t add_skin(struct scene *scene, struct part *part)
{
    const struct form *form = part->form;
    json_t *joints = json_array();
    part->first_joint = (json_int_t)json_array_size(scene->nodes);
    for (int j = 0; j < form->joint_count; j++) {
        const struct form_joint *joint = &form->joints[j];
        const float *place = joint->parent < 0 ? part->keys->at.translation[0] : joint->offset;
        json_t *node = json_pack("{s:s, s:o, s:o}", "name", joint->name, "translation", numbers(scene, place, 3),
                                 "rotation", numbers(scene, part->keys->at.rotation[j * part->keys->count], 4));
        gltf_append(&scene->file, joints, json_integer(gltf_append(&scene->file, scene->nodes, node)));
        if (joint->parent < 0) continue;
        json_t *parent = json_array_get(scene->nodes, (size_t)(part->first_joint + joint->parent));
        gltf_append_to(&scene->file, parent, "children", json_integer(part->first_joint + j));
    }
    gltf_append(&scene->file, scene->roots, json_integer(part->first_joint));
    float(*inverse)[16] = calloc((size_t)form->joint_count, sizeof *inverse);
    for (int j = 0; inverse && j < form->joint_count; j++) {
        for (int k = 0; k < 4; k++) inverse[j][5 * k] = 1;
        for (int k = 0; k < 3; k++) inverse[j][12 + k] = -form->joints[j].bind[k];
    }
    if (!inverse) scene->file.without_memory = true;
    const json_int_t matrices =
        inverse ? gltf_file_add(&scene->file, ELEMENTS_MATRICES, inverse, (size_t)form->joint_count, false) : 0;
    free(inverse);
    return gltf_append(&scene->file, scene->skins,
                       json_pack("{s:o, s:I, s:I}", "joints", joints, "inverseBindMatrices", matrices, "skeleton",
                                 part->first_joint));
}

static void add_nodes(struct scene *scene, struct part *part, json_int_t mesh)
{
    const struct form *form = part->form;
    json_t *node = json_pack("{s:s, s:I}", "name", form->name, "mesh", mesh);
    part->mesh_node = gltf_append(&scene->file, scene->nodes, node);
    gltf_append(&scene->file, scene->roots, json_integer(part->mesh_node));
    if (form->joint_count > 0) {
        gltf_set(&scene->file, node, "skin", json_integer(add_skin(scene, part)));
    } else {
        gltf_set(&scene->file, node, "translation", numbers(scene, part->keys->at.translation[0], 3));
    }
}

// --- the clip

static void add_weights(struct scene *scene, const struct part *part)
{
    const struct keys *keys = part->keys;
    const int width = part->targets->count, count = keys->count;
    if (width == 0) return;
    float *values = malloc((size_t)(width * count) * sizeof *values);
    float *slopes = keys->slope.translation ? malloc((size_t)(width * count) * sizeof *slopes) : NULL;
    if (!values || (keys->slope.translation && !slopes)) {
        scene->file.without_memory = true;
    } else {
        for (int i = 0; i < width * count; i++) {
            values[i] = targets_weight(part->targets, i % width, keys, i / width);
            if (slopes) slopes[i] = targets_slope(part->targets, i % width, keys, i / width);
        }
        gltf_motion_add(&scene->motion, part->mesh_node, GLTF_WEIGHTS, values, slopes, width);
    }
    free(values);
    free(slopes);
}

/// Whether any key is other than at rest.
static bool differs(const float *keys, int width, int count, const float *rest)
{
    for (int i = 0; i < width * count; i++) {
        if (keys[i] != rest[i % width]) return true;
    }
    return false;
}

static void add_animation(struct scene *scene, const struct part *part)
{
    const struct form *form = part->form;
    const struct keys *keys = part->keys;
    if (keys->travels) {
        const float *slopes = keys->slope.translation ? keys->slope.translation[0] : NULL;
        gltf_motion_add(&scene->motion, form->joint_count > 0 ? part->first_joint : part->mesh_node, GLTF_TRANSLATION,
                        keys->at.translation[0], slopes, 3);
    }
    for (int j = 0; j < form->joint_count; j++) {
        const int at = j * keys->count;
        const float *turns = keys->at.rotation[at], *sizes = keys->at.scale[at];
        if (j >= form->first_bone || differs(turns, 4, keys->count, (const float[]){0, 0, 0, 1}))
            gltf_motion_add(&scene->motion, part->first_joint + j, GLTF_ROTATION, turns,
                            keys->slope.translation ? keys->slope.rotation[at] : NULL, 4);
        if (differs(sizes, 3, keys->count, (const float[]){1, 1, 1}))
            gltf_motion_add(&scene->motion, part->first_joint + j, GLTF_SCALE, sizes,
                            keys->slope.translation ? keys->slope.scale[at] : NULL, 3);
    }
    add_weights(scene, part);
}

// --- all of it

static bool add_rig(struct scene *scene, int rig, struct error *error)
{
    struct form form;
    struct keys keys;
    struct file_targets targets = {0};
    if (!form_open(scene->range, rig, &form, error)) return false;
    bool done = keys_collect(scene->range, rig, &form, &keys, error);
    if (done) targets_create(scene->range, &form, &keys, &targets);
    if (done) {
        struct part part = {.form = &form, .keys = &keys, .targets = &targets};
        add_nodes(scene, &part, add_mesh(scene, &part));
        add_animation(scene, &part);
        scene->joints += form.joint_count - form.first_bone;
        scene->targets += targets.count;
    }
    targets_free(&targets);
    keys_free(&keys);
    form_close(&form);
    return done;
}

static json_t *make_root(struct scene *scene)
{
    json_t *root =
        json_pack("{s:{s:s, s:s}, s:i, s:[{s:O}], s:O, s:O}", "asset", "version", "2.0", "generator", "wiggly",
                  "scene", 0, "scenes", "nodes", scene->roots, "nodes", scene->nodes, "meshes", scene->meshes);
    gltf_looks_complete(&scene->looks, root);
    if (json_array_size(scene->skins) > 0) gltf_set(&scene->file, root, "skins", json_incref(scene->skins));
    if (json_array_size(scene->motion.channels) > 0) {
        const char *name = scene->range->clip ? scene->range->clip : scene->range->title;
        gltf_set(&scene->file, root, "animations", json_pack("[o]", gltf_motion_json(&scene->motion, name)));
    }
    return root;
}

static void summarise(const struct scene *scene, char summary[FORMAT_SUMMARY])
{
    char joints[32] = "", targets[32] = "";
    if (scene->joints > 0) snprintf(joints, sizeof joints, "%d joints, ", scene->joints);
    if (scene->targets > 0) snprintf(targets, sizeof targets, "%d morph targets, ", scene->targets);
    snprintf(summary, FORMAT_SUMMARY, "%s%s%d keys", joints, targets, scene->range->key_count);
}

static bool write_scene(struct export_range *range, const int *rigs, int count, bool binary, FILE *out,
                        char summary[FORMAT_SUMMARY], struct error *error)
{
    struct scene scene = {.range = range};
    json_t **const arrays[] = {&scene.roots, &scene.nodes, &scene.meshes, &scene.skins};
    enum { ARRAYS = sizeof arrays / sizeof *arrays };
    scene.looks.file = &scene.file;
    for (int i = 0; i < ARRAYS; i++) *arrays[i] = json_array();
    bool done = true;
    gltf_motion_begin(&scene.motion, &scene.file, range);
    for (int r = 0; done && r < count; r++) done = add_rig(&scene, rigs[r], error);
    done = done && gltf_file_write(&scene.file, make_root(&scene), binary, out, error);
    summarise(&scene, summary);
    for (int i = 0; i < ARRAYS; i++) json_decref(*arrays[i]);
    gltf_motion_free(&scene.motion);
    gltf_looks_free(&scene.looks);
    gltf_file_free(&scene.file);
    return done;
}

/// An imported character has a file of its own, in which nothing else has a place.
static bool write_either(struct export_range *range, bool binary, FILE *out, char summary[FORMAT_SUMMARY],
                         struct error *error)
{
    const struct document *document = range->posing->document;
    for (int r = 0; r < range->rig_count; r++) {
        const struct rig *rig = document->rigs[range->rigs[r]];
        if (!(form_kind(rig->kind)->holds & FORM_FILE)) continue;
        if (range->rig_count == 1) return gltf_model_write(range, binary, out, summary, error);
        return fail(error, ERROR_INPUT, "\"%s\" is exported into a copy of its own file: choose one rig with %s",
                    form_name(rig), range->rig_choice);
    }
    range->total = (long)range->key_count * range->rig_count;
    return write_scene(range, range->rigs, range->rig_count, binary, out, summary, error);
}

bool gltf_write_rig(struct export_range *range, int rig, FILE *out, struct error *error)
{
    char summary[FORMAT_SUMMARY];
    return write_scene(range, &rig, 1, true, out, summary, error);
}

bool glb_write(struct export_range *range, FILE *out, char summary[FORMAT_SUMMARY], struct error *error)
{
    return write_either(range, true, out, summary, error);
}

bool gltf_write(struct export_range *range, FILE *out, char summary[FORMAT_SUMMARY], struct error *error)
{
    return write_either(range, false, out, summary, error);
}
