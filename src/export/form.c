/// Rigs as other programs know them: a form for each kind of rig; collects the keys of one rig.
#include "export/form.h"
#include "base/need.h"
#include "model/fox.h"
#include "model/vector.h"
#include "rig/models.h"
#include "rig/strand.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- what moves a model: the places of nodes, and the weights of its soft mesh

static void pose_key(const struct form *form, const struct rig_pose *pose, struct form_key *key)
{
    const struct gltf_pose *now = pose->model.pose;
    if (form->kind->holds & FORM_MESH) memcpy(key->translation, pose->model.root + 12, sizeof key->translation);
    for (int j = 0; j < form->joint_count; j++) {
        const struct gltf_place *place = &now->place[form->joints[j].node];
        memcpy(key->rotation[j], place->rotation, sizeof place->rotation);
        memcpy(key->scale[j], place->scale, sizeof place->scale);
    }
    for (int t = 0; t < form->shape.target_count; t++) {
        const struct form_target *target = &form->targets[t];
        key->weight[t] = target->scale * now->weights[form->gltf->nodes[form->soft].first_weight + target->source];
    }
}

// --- a tail: the fox, skinned to the tail's joints; and a chain, which moves its model

/// Angles in degrees by which channels bend the joints of a tail or chain.
static void tail_columns(const struct export_range *range, int rig, const struct rig_pose *pose, int key,
                         form_column *column, void *user)
{
    const struct document *document = range->posing->document;
    const char *name = form_name(document->rigs[rig]);
    struct strand strand;
    (void)pose;
    if (!strand_find(range->posing, rig_body(document, rig), rig, &strand)) return;
    wiggly_value values[RIG_MAX_INPUTS];
    posing_values(range->posing, rig, range_position(range, key), values);
    for (int c = 0; c < strand.channel_count; c++) {
        const struct channel *channel = &strand.channels[c];
        const wiggly_value value = values[c];
        if (!axis_bends(channel->axis))
            column(user, channel_moves(channel, value, 1, range->posing->look), "%s.%s.%s", name,
                   axis_word(channel->axis), document->splines[channel->spline]->name);
        for (int n = 0; n < strand.joints && axis_bends(channel->axis); n++) {
            const double angle = channel_bend(channel, value, n, strand.joints, range->posing->look);
            column(user, 180 / 3.14159265358979323846 * angle, "%s.%s.%s.%d", name, axis_word(channel->axis),
                   document->splines[channel->spline]->name, n);
        }
    }
}

static bool tail_open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                      struct error *error)
{
    const struct gltf *gltf = form->gltf;
    struct gltf_shape *shape = &form->shape;
    (void)posing, (void)rig, (void)error;
    const struct gltf_mesh *mesh = gltf->meshes;
    const float *root = pose->model.root, scale = root[0];
    size_t vertices = 1, indices = 1;
    for (int p = 0; p < mesh->part_count; p++) {
        vertices += (size_t)mesh->parts[p].vertex_count;
        indices += (size_t)mesh->parts[p].index_count;
    }
    float(*position)[3] = pool_take(&form->pool, vertices, sizeof *position);
    float(*normal)[3] = pool_take(&form->pool, vertices, sizeof *normal);
    float(*color)[3] = pool_take(&form->pool, vertices, sizeof *color);
    uint32_t *to = pool_take(&form->pool, indices, sizeof *to);
    uint16_t(*joints)[FORM_INFLUENCES] = pool_take(&form->pool, vertices, sizeof *joints);
    float(*weights)[FORM_INFLUENCES] = pool_take(&form->pool, vertices, sizeof *weights);
    *shape = (struct gltf_shape){.position = (const float(*)[3])position,
                                 .normal = (const float(*)[3])normal,
                                 .color = (const float(*)[3])color,
                                 .joints = (const uint16_t(*)[4])joints,
                                 .weights = (const float(*)[4])weights,
                                 .indices = to};
    for (int p = 0; p < mesh->part_count; p++) {
        const struct gltf_part *part = &mesh->parts[p];
        for (int i = 0; i < part->index_count; i++)
            to[shape->index_count++] = (uint32_t)shape->vertex_count + part->indices[i];
        for (int v = 0; v < part->vertex_count; v++) {
            const int at = shape->vertex_count++;
            for (int k = 0; k < 3; k++) position[at][k] = scale * part->position[v][k];
            memcpy(normal[at], part->normal[v], sizeof normal[at]);
            memcpy(color[at], part->color[v], sizeof color[at]);
            for (int n = 0; n < FORM_INFLUENCES; n++) { // a vertex has at most four joints
                weights[at][n] = part->weights[v][n];
                joints[at][n] = part->weights[v][n] > 0.0f ? (uint16_t)(FOX_FIRST_LIMB + part->joints[v][n]) : 0;
            }
        }
    }

    // The animal's root node, the nodes of its body, and those of the tail.
    form->joint_count = gltf->node_count - 1; // the last node shows the mesh
    form->first_bone = FOX_FIRST_JOINT;
    form->joints = pool_take(&form->pool, (size_t)form->joint_count, sizeof *form->joints);
    for (int j = 0; j < form->joint_count; j++) {
        const struct gltf_node *node = &gltf->nodes[j];
        struct form_joint *joint = &form->joints[j];
        const char *name = j == 0 ? "base" : node->name + (j < FOX_FIRST_JOINT ? 0 : strlen("tail_"));
        joint->name = pool_text(&form->pool, form->name, "_", name);
        joint->node = j;
        joint->parent = node->parent;
        for (int k = 0; k < 3; k++) {
            joint->offset[k] = j == 0 ? root[12 + k] : scale * node->place.translation[k];
            if (j > 0) joint->bind[k] = -scale * gltf->skins->inverse_bind[j - FOX_FIRST_LIMB][12 + k];
        }
    }
    form->joints[form->joint_count - 1].tip[2] =
        scale * FOX_TAIL_LENGTH / (float)(form->joint_count - form->first_bone);
    return true;
}

static const struct form_kind tail_form = {FORM_MESH | FORM_JOINTS | FORM_POINTS, tail_open, pose_key, tail_columns};
static const struct form_kind chain_form = {.holds = FORM_IN_MODEL, .columns = tail_columns};

// --- a soft character without bones: its mesh, and the morph targets of each coordinate, as in its own file (model/character.h)

static bool character_open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                           struct error *error)
{
    const struct character *c = &pose->model.figure->character;
    const struct model_rig *model = &posing->document->rigs[rig]->model;
    const size_t most = (size_t)c->coordinate_count * COORDINATE_PARTS;
    (void)error;
    form->shape = (struct gltf_shape){.vertex_count = c->vertex_count,
                                      .position = (const float(*)[3])c->position,
                                      .normal = (const float(*)[3])c->normal,
                                      .color = (const float(*)[3])c->color,
                                      .uv = (const float(*)[2])c->looks.uv,
                                      .indices = c->indices,
                                      .index_count = c->index_count,
                                      .looks = &c->looks,
                                      .targets = pool_take(&form->pool, most, sizeof *form->shape.targets),
                                      .coordinates = pool_take(&form->pool, most, sizeof *form->shape.coordinates)};
    form->targets = pool_take(&form->pool, most, sizeof *form->targets);
    for (int k = 0; k < c->coordinate_count; k++) {
        const struct coordinate *coordinate = &c->coordinates[k];
        bool moves = false;
        for (int d = 0; d < model->drive_count; d++) moves |= figure_find(form->figure, model->drives[d].name) == k;
        if (!moves) continue;
        form->shape.coordinates[form->shape.coordinate_count++] = coordinate;
        for (int part = 0; part < coordinate_parts(coordinate); part++) {
            const int t = form->shape.target_count++;
            form->shape.targets[t] = figure_target_create(form->figure, k, part, &form->pool);
            form->targets[t] = (struct form_target){k, coordinate->target[part], (float)coordinate->scale};
        }
    }
    return true;
}

/// Each driven coordinate's weight, a complex number.
static void model_columns(const struct export_range *range, int rig, const struct rig_pose *pose, int key,
                          form_column *column, void *user)
{
    const struct rig *of = range->posing->document->rigs[rig];
    const struct figure *figure = pose->model.figure;
    const char *name = form_name(of);
    (void)key;
    for (int d = 0; figure && d < of->model.drive_count; d++) {
        const int coordinate = figure_find(figure, of->model.drives[d].name);
        const struct morph *morph = &pose->model.morph;
        int k = 0;
        if (coordinate < 0) continue;
        while (k < morph->count && morph->coordinate[k] != coordinate) k++;
        for (int part = 0; part < 2; part++)
            column(user, k < morph->count ? (double)morph->weight[k][part] : 0, "%s.%s.%s", name,
                   figure->character.coordinates[coordinate].name, part ? "im" : "re");
    }
}

static const struct form_kind soft_form = {FORM_MESH | FORM_POINTS, character_open, pose_key, model_columns};

// --- any other character, in its file's space: its vertices, and the bones of its chains as joints

const struct gltf *form_gltf(const struct rig_pose *pose, struct pool *pool)
{
    const struct figure *figure = pose->model.figure;
    if (!figure || !figure_is_painted(figure)) return pose->model.gltf;
    struct gltf *painted = pool_take(pool, 1, sizeof *painted);
    *painted = *pose->model.gltf;
    const struct character *c = &figure->character;
    const struct gltf_mesh *plain = &painted->meshes[painted->nodes[c->node].mesh];
    struct gltf_mesh *meshes = pool_take(pool, (size_t)painted->mesh_count, sizeof *meshes);
    struct gltf_part *parts = pool_take(pool, (size_t)plain->part_count, sizeof *parts);
    memcpy(meshes, painted->meshes, (size_t)painted->mesh_count * sizeof *meshes);
    memcpy(parts, plain->parts, (size_t)plain->part_count * sizeof *parts);
    meshes[plain - painted->meshes].parts = parts;
    painted->meshes = meshes;
    const mat4s back = glms_mat4_inv(mat4_from(c->moved));
    for (int p = 0, first = 0; p < plain->part_count; p++) {
        const size_t vertices = (size_t)parts[p].vertex_count;
        struct gltf_target *targets = pool_take(pool, (size_t)plain->target_count, sizeof *targets);
        memcpy(targets, parts[p].targets, (size_t)plain->target_count * sizeof *targets);
        parts[p].targets = targets;
        for (int k = 0; k < c->coordinate_count; k++) {
            const struct coordinate *own = &c->coordinates[k];
            for (int n = 0; n < coordinate_parts(own); n++) {
                float(*offsets)[3] = pool_take(pool, vertices, sizeof *offsets);
                const float size = (float)own->scale * (n == 1 ? -1.0f : 1.0f);
                for (size_t v = 0; v < vertices; v++) {
                    const vec3s way = vec3_from(own->parts[n][(parts[p].shared ? 0 : first) + (int)v]);
                    const vec3s inside = glms_vec3_scale(glms_mat4_mulv3(back, way, 0.0f), size);
                    memcpy(offsets[v], inside.raw, sizeof *offsets);
                }
                targets[own->target[n]] = (struct gltf_target){.position = offsets};
            }
        }
        first += gltf_own_vertices(&parts[p]);
    }
    return painted;
}

static bool model_open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                       struct error *error)
{
    const struct model_rig *model = &posing->document->rigs[rig]->model;
    const struct gltf *gltf = form->gltf;
    (void)pose;
    const int clip = gltf_find_clip(gltf, model->clip);
    const size_t nodes = (size_t)gltf->node_count;
    form->clip = clip >= 0 ? &gltf->clips[clip] : NULL;
    form->joints = pool_take(&form->pool, nodes, sizeof *form->joints);
    for (int r = -1; (r = document_next_chain(posing->document, rig, r)) >= 0;) {
        const struct chain *chain = &posing->document->rigs[r]->chain;
        struct chain_bones bones;
        if (!chain_find(gltf, chain->from, chain->to, &bones, error)) return false;
        for (int n = 0; n < bones.count; n++) {
            bool is_new = true;
            for (int j = 0; j < form->joint_count; j++) is_new = is_new && form->joints[j].node != bones.node[n];
            if (is_new) form->joints[form->joint_count++].node = bones.node[n];
        }
    }
    if (model->drive_count == 0) form->soft = -1;
    if (form->soft >= 0) {
        const struct gltf_mesh *mesh = &gltf->meshes[gltf->nodes[form->soft].mesh];
        const struct character *c = &form->figure->character;
        const size_t targets = (size_t)mesh->target_count;
        form->shape.target_count = mesh->target_count;
        form->shape.targets = pool_take(&form->pool, targets, sizeof *form->shape.targets);
        form->targets = pool_take(&form->pool, targets, sizeof *form->targets);
        for (int t = 0; t < mesh->target_count; t++) {
            form->shape.targets[t].name = gltf_target_label(mesh, t, &form->pool);
            form->targets[t] = (struct form_target){-1 - t, t, 1};
        }
        for (int k = 0; k < c->coordinate_count; k++) {
            for (int part = 0; part < coordinate_parts(&c->coordinates[k]); part++)
                form->targets[c->coordinates[k].target[part]].group = k;
        }
    }
    return true;
}

/// Its chains have columns of their own; its clip has none.
const struct form_kind model_form = {FORM_FILE | FORM_POINTS | FORM_JOINTS, model_open, pose_key, model_columns};

// --- the skeleton of a character: every bone with its clip and its chains
//
// Bones are relative to their rest in the character's space, so that bones at rest are not turned. The first joint is the character's origin, and
// holds the bones that have none above them.

enum { ORIGIN = 0, NO_JOINT = -1, TO_ADD = -2 };

static const float STILL = 1e-6f; ///< rounding, as a share of the character's size

struct source {
    const struct imported *imported;
    int *joint_of; ///< of each node, or NO_JOINT
    versors *turn; ///< of each joint, at the key being made
    float still;   ///< bones that move less do not move
};

static vec3s place_of(const struct form *form, const struct gltf_pose *pose, int joint)
{
    return joint == ORIGIN ? glms_vec3_zero() : vec3_from(pose->world[form->joints[joint].node] + 12);
}

/// Adds the bones among a node, those beside it, and all below.
static void add_joints(struct form *form, int node, int above)
{
    const struct source *source = form->owned;
    for (; node >= 0; node = source->imported->gltf.nodes[node].next) {
        int j = above;
        if (source->joint_of[node] == TO_ADD) {
            struct form_joint *joint = &form->joints[j = form->joint_count++];
            joint->name = names_add(&form->names, form_word(&form->pool, source->imported->gltf.nodes[node].name));
            joint->parent = above;
            joint->node = node;
            source->joint_of[node] = j;
            const struct gltf_pose *rest = &source->imported->rest;
            const vec3s offset = glms_vec3_sub(place_of(form, rest, j), place_of(form, rest, above));
            memcpy(joint->offset, offset.raw, sizeof joint->offset);
        }
        add_joints(form, source->imported->gltf.nodes[node].child, j);
    }
}

static bool skeleton_open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                          struct error *error)
{
    const struct gltf *gltf = pose->model.gltf;
    const struct skeleton *skeleton = &pose->imported->skeleton;
    const size_t most = (size_t)gltf->node_count + 1;
    float ends[2][3];
    int tops = 0;
    struct source *source = form->owned = pool_take(&form->pool, 1, sizeof *source);
    *source = (struct source){.imported = pose->imported,
                              .joint_of = pool_take(&form->pool, most, sizeof *source->joint_of),
                              .turn = pool_take(&form->pool, most, sizeof *source->turn)};
    for (int k = 0; k < 3; k++) source->still = fmaxf(source->still, STILL * (gltf->hi[k] - gltf->lo[k]));
    form->joints = pool_take(&form->pool, most, sizeof *form->joints);
    form->names.between = "_";
    for (int n = 0; n < gltf->node_count; n++) source->joint_of[n] = NO_JOINT;
    for (int b = 0; b < skeleton->count; b++) {
        source->joint_of[skeleton->bones[b].node] = TO_ADD;
        if (skeleton->bones[b].child >= 0) source->joint_of[skeleton->bones[b].child] = TO_ADD;
    }
    form->joints[ORIGIN].parent = -1;
    form->joint_count = 1;
    for (int n = 0; n < gltf->node_count; n++)
        if (gltf->nodes[n].parent < 0) add_joints(form, n, ORIGIN);
    form->joints[ORIGIN].name = names_add(&form->names, form_word(&form->pool, form->name));
    for (int j = 1; j < form->joint_count; j++) tops += form->joints[j].parent == ORIGIN;
    form->first_bone = tops == 1 ? 1 : ORIGIN; // a single one needs none to hold it
    for (int b = 0; b < skeleton->count; b++) {
        if (skeleton->bones[b].child >= 0) continue;
        skeleton_ends(&skeleton->bones[b], &source->imported->rest, ends);
        glm_vec3_sub(ends[1], ends[0], form->joints[source->joint_of[skeleton->bones[b].node]].tip);
    }
    return form->joint_count > 1 ||
           fail(error, ERROR_INPUT, "\"%s\" has no bones", rig_title(posing->document->rigs[rig]));
}

static void skeleton_key(const struct form *form, const struct rig_pose *pose, struct form_key *key)
{
    const struct source *source = form->owned;
    const struct gltf_pose *now = pose->model.pose;
    source->turn[ORIGIN] = glms_quat_identity();
    for (int j = ORIGIN; j < form->joint_count; j++) {
        const int parent = j == ORIGIN ? ORIGIN : form->joints[j].parent;
        const versors back = glms_quat_inv(source->turn[parent]);
        if (j != ORIGIN) { // how it is turned from its rest, in the character's space
            const int node = form->joints[j].node;
            const mat3s rest = glms_mat4_pick3(mat4_from(source->imported->rest.world[node]));
            mat3s turned = glms_mat3_mul(glms_mat4_pick3(mat4_from(now->world[node])), mat3_inverse(rest));
            for (int k = 0; k < 3; k++) glm_vec3_normalize(turned.raw[k]);
            source->turn[j] = glms_quat_normalize(glms_mat3_quat(turned)); // uneven scales shear it
        }
        const versors own = glms_quat_mul(back, source->turn[j]);
        const vec3s place = place_of(form, now, j);
        const vec3s offset = glms_quat_rotatev(back, glms_vec3_sub(place, place_of(form, now, parent)));
        memcpy(key->rotation[j], own.raw, sizeof key->rotation[j]);
        if (j == form->first_bone) memcpy(key->translation, place.raw, sizeof key->translation);
        if (glms_vec3_distance(offset, vec3_from(form->joints[j].offset)) > source->still)
            memcpy(key->offset[j], offset.raw, sizeof key->offset[j]);
    }
}

const struct form_kind skeleton_form = {.holds = FORM_JOINTS, .open = skeleton_open, .key = skeleton_key};

// --- vertices as points, in the order of the file: a cache has a row for each that parts do not share

/// Whether a node's mesh is a part of the form.
static bool shows(const struct form *form, int node)
{
    const bool is_alone = form->kind == &soft_form && node != form->soft;
    return !is_alone && gltf_vertex_count(form->gltf, node) > 0;
}

void form_vertices(const struct form *form, const struct rig_pose *pose, bool as_shown, float (*positions)[3])
{
    const struct gltf *gltf = form->gltf;
    float(*to)[3] = positions;
    int holders = 0, holder = -1; // nodes that have vertices, and the last of them
    int most = 0;
    for (int n = 0; n < gltf->node_count; n++) {
        if (!shows(form, n)) continue;
        holders++;
        holder = n;
        most = gltf_vertex_count(gltf, n) > most ? gltf_vertex_count(gltf, n) : most;
    }
    float(*posed)[3] = need((size_t)most, sizeof *posed);
    for (int n = 0; n < gltf->node_count; n++) {
        if (!shows(form, n)) continue;
        const struct gltf_mesh *mesh = &gltf->meshes[gltf->nodes[n].mesh];
        float(*from)[3] = posed;
        gltf_pose_vertices(gltf, pose->model.pose, n, from, NULL);
        for (const struct gltf_part *part = mesh->parts; part < mesh->parts + mesh->part_count; part++) {
            memcpy(to, from, (size_t)gltf_own_vertices(part) * sizeof *to);
            to += gltf_own_vertices(part);
            from += part->vertex_count;
        }
    }
    free(posed);
    const bool is_placed = as_shown || form->kind == &tail_form;
    const bool is_inside = !is_placed && holders == 1 && form->kind == &model_form;
    mat4s place = is_placed   ? mat4_from(pose->model.root)
                  : is_inside ? mat4_from(pose->model.pose->world[holder])
                              : glms_mat4_identity();
    const bool has_size = is_inside && glms_mat4_det(place) != 0.0f; // else it stays in the file's space
    if (has_size) place = glms_mat4_inv(place);
    for (int v = 0; (is_placed || has_size) && v < form->vertex_count; v++)
        glm_mat4_mulv3(place.raw, positions[v], 1, positions[v]);
}

// --- all kinds

static const struct form_kind *const kinds[RIG_KINDS] = {
    [RIG_TAIL] = &tail_form, [RIG_MODEL] = &model_form, [RIG_CHAIN] = &chain_form};

const struct form_kind *form_kind(const struct posing *posing, int rig)
{
    const struct document *document = posing->document;
    const struct rig *of = document->rigs[rig];
    const bool stands = of->kind == RIG_MODEL && models_figure(posing->models, document, rig) && !of->model.clip &&
                        of->model.scale == 1 && of->model.turn == 0 &&
                        models_imported(posing->models, document, rig)->gltf.skin_count == 0 &&
                        document_next_chain(document, rig, -1) < 0;
    return stands ? &soft_form : kinds[of->kind];
}

const char *form_name(const struct rig *rig) { return rig->name ? rig->name : rig_word(rig->kind); }

char *form_word(struct pool *pool, const char *name)
{
    char *word = pool_text(pool, name, "", ""), *to = word;
    for (const char *from = name; *from;) {
        const char *letter = from;
        if (letter_is_blank(utf8_next(&from))) {
            *to++ = '_';
        } else {
            to = mempcpy(to, letter, (size_t)(from - letter));
        }
    }
    *to = '\0';
    return word;
}

bool form_open(const struct export_range *range, int rig, struct form *form, struct error *error)
{
    struct rig_pose pose;
    const struct document *document = range->posing->document;
    const struct rig *source = document->rigs[rig];
    *form = (struct form){.kind = form_kind(range->posing, rig)};
    if (range->format->holds == FORM_JOINTS && source->kind == RIG_MODEL) form->kind = &skeleton_form;
    if (!range_pose(range, rig, 0, &pose, error)) return false;
    struct names names = {.between = "_"}; // rigs of the same name get a number, because other programs go by names
    for (int i = 0; i < rig; i++) names_add(&names, form_name(document->rigs[i]));
    form->name = pool_text(&form->pool, names_add(&names, form_name(source)), "", "");
    names_free(&names);
    form->gltf = form_gltf(&pose, &form->pool);
    form->figure = pose.model.figure;
    form->soft = form->figure ? form->figure->character.node : -1;
    if (!form->kind->open(range->posing, rig, &pose, form, error)) {
        form_close(form);
        return false;
    }
    for (int n = 0; n < form->gltf->node_count; n++) {
        if (!shows(form, n)) continue;
        const struct gltf_mesh *mesh = &form->gltf->meshes[form->gltf->nodes[n].mesh];
        for (int p = 0; p < mesh->part_count; p++) form->vertex_count += gltf_own_vertices(&mesh->parts[p]);
    }
    return true;
}

void form_close(struct form *form)
{
    names_free(&form->names);
    pool_free(&form->pool);
    *form = (struct form){0};
}

// --- keys

void keys_turn_short_way(const float before[4], float q[4])
{
    if (before[0] * q[0] + before[1] * q[1] + before[2] * q[2] + before[3] * q[3] >= 0) return;
    for (int k = 0; k < 4; k++) q[k] = -q[k];
}

void keys_close_loop(float *rows, int width, int count)
{
    float *last = rows + (size_t)(count - 1) * (size_t)width;
    for (int i = 0; i < width && last > rows; i++) {
        if (!(fabsf(last[i] - rows[i]) <= 1e-5f)) return;
    }
    memmove(last, rows, (size_t)width * sizeof *rows);
}

bool keys_collect(struct export_range *range, int rig, struct form *form, struct keys *keys, struct error *error)
{
    const size_t count = (size_t)range->key_count,
                 width = 3 + 10 * (size_t)form->joint_count + (size_t)form->shape.target_count;
    *keys = (struct keys){.count = range->key_count, .width = (int)width, .joints = form->joint_count};
    if (!need_has_room(count * width * sizeof *keys->rows)) return fail_no_memory(error, form->name);
    keys->rows = pool_take(&form->pool, count * width, sizeof *keys->rows);
    for (int k = 0; k < keys->count; k++) {
        float *row = keys->rows + (size_t)k * width;
        struct rig_pose pose;
        struct form_key values = {.rotation = (float(*)[4])(row + keys_rotation(0)),
                                  .scale = (float(*)[3])(row + keys_scale(keys, 0)),
                                  .offset = (float(*)[3])(row + keys_offset(keys, 0)),
                                  .weight = row + keys_weight(keys, 0)};
        for (int j = 0; j < keys->joints; j++) {
            for (int i = 0; i < 3; i++) values.scale[j][i] = 1;
            memcpy(values.offset[j], form->joints[j].offset, sizeof values.offset[j]);
        }
        if (!range_pose(range, rig, k, &pose, error)) return false;
        form->kind->key(form, &pose, &values);
        memcpy(row, values.translation, sizeof values.translation);
        if (!range_proceed(range, error)) return false;
        for (int j = 0; k > 0 && j < keys->joints; j++)
            keys_turn_short_way(row - width + keys_rotation(j), row + keys_rotation(j));
        keys->travels = keys->travels || memcmp(row, keys->rows, 3 * sizeof *row) != 0;
    }
    keys_close_loop(keys->rows, keys->width, keys->count);
    return true;
}
