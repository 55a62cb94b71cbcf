/// Reads nodes, their order and visibility, skins, and animations.
#include "model/gltf_read.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float SHEARED = 1e-4f; ///< cosine between columns of a matrix that is no move, turn and scale

/// Splits a matrix into a move, a turn and a scale, as other programs do, so that clips and chains can move the node. A sheared or flat matrix
/// stays one.
static void decompose(struct gltf_node *node)
{
    mat3s turn = glms_mat4_pick3(mat4_from(node->matrix));
    struct gltf_place place;
    for (int k = 0; k < 3; k++) {
        place.translation[k] = node->matrix[12 + k];
        place.scale[k] = glms_vec3_norm(turn.col[k]);
        if (node->matrix[4 * k + 3] != 0 || !(place.scale[k] > 0) || !isfinite(place.scale[k])) return;
    }
    if (node->matrix[15] != 1) return;
    if (glms_mat3_det(turn) < 0) place.scale[0] = -place.scale[0];
    for (int k = 0; k < 3; k++) turn.col[k] = glms_vec3_divs(turn.col[k], place.scale[k]);
    for (int k = 0; k < 3; k++) {
        if (!(fabsf(glms_vec3_dot(turn.col[k], turn.col[(k + 1) % 3])) < SHEARED)) return;
    }
    const versors q = glms_quat_normalize(glms_mat3_quat(turn));
    memcpy(place.rotation, q.raw, sizeof place.rotation);
    node->place = place;
    node->has_matrix = false;
}

static bool read_place(struct gltf_reader *r, const json_t *json, struct gltf_node *node)
{
    node->place = (struct gltf_place){.rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
    node->has_matrix = json_object_get(json, "matrix");
    if (!gltf_reals(r, json, "matrix", node->matrix, 16) ||
        !gltf_reals(r, json, "translation", node->place.translation, 3) ||
        !gltf_reals(r, json, "rotation", node->place.rotation, 4) ||
        !gltf_reals(r, json, "scale", node->place.scale, 3))
        return false;
    float *q = node->place.rotation, length = sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0) || !isfinite(length)) return gltf_bad(r, ".rotation: expected a unit quaternion, got another");
    for (int k = 0; k < 4; k++) q[k] /= length;
    if (node->has_matrix) decompose(node);
    return true;
}

static bool read_node(struct gltf_reader *r, const json_t *json, size_t number)
{
    struct gltf_node *node = &r->gltf->nodes[number];
    int skins = (int)json_array_size(gltf_array(r, "skins"));
    gltf_at(r, "nodes[%zu]", number);
    return read_place(r, json, node) && gltf_index(r, json, "mesh", r->gltf->mesh_count, &node->mesh) &&
           gltf_index(r, json, "skin", skins, &node->skin);
}

/// An element of an array of node indices.
static bool read_member(struct gltf_reader *r, const json_t *element, const char *key, size_t i, int *node)
{
    json_int_t value = json_is_integer(element) ? json_integer_value(element) : -1;
    if (value < 0 || value >= r->gltf->node_count)
        return gltf_bad(r, ".%s[%zu]: expected a node from 0 to %d, got %s", key, i, r->gltf->node_count - 1,
                        json_is_integer(element) ? "another number" : "something else");
    *node = (int)value;
    return true;
}

static bool read_parents(struct gltf_reader *r, const json_t *nodes)
{
    const json_t *json, *element;
    size_t i, k;
    for (int n = 0; n < r->gltf->node_count; n++) r->gltf->nodes[n].parent = -1;
    json_array_foreach(nodes, i, json)
    {
        gltf_at(r, "nodes[%zu]", i);
        json_array_foreach(json_object_get(json, "children"), k, element)
        {
            int child;
            if (!read_member(r, element, "children", k, &child)) return false;
            if (r->gltf->nodes[child].parent >= 0)
                return gltf_bad(r,
                                ".children[%zu]: expected a node of one parent, got node %d, which nodes[%d] has too",
                                k, child, r->gltf->nodes[child].parent);
            r->gltf->nodes[child].parent = (int)i;
        }
    }
    return true;
}

/// Roots first, then the children of nodes already listed. Nodes never reached form a cycle.
static bool put_in_order(struct gltf_reader *r, const json_t *nodes)
{
    struct gltf *gltf = r->gltf;
    int count = 0;
    for (int n = 0; n < gltf->node_count; n++) {
        if (gltf->nodes[n].parent < 0) gltf->order[count++] = n;
    }
    for (int at = 0; at < count; at++) {
        const json_t *children = json_object_get(json_array_get(nodes, (size_t)gltf->order[at]), "children");
        for (size_t k = 0; k < json_array_size(children); k++)
            gltf->order[count++] = (int)json_integer_value(json_array_get(children, k));
    }
    gltf_at(r, "nodes");
    return count == gltf->node_count || gltf_bad(r, ": expected a tree, got a node that is below itself");
}

/// Removes the meshes of nodes that the scene does not show. Without scenes all are shown.
static bool choose_scene(struct gltf_reader *r)
{
    struct gltf *gltf = r->gltf;
    const json_t *scenes = gltf_array(r, "scenes"), *element;
    size_t i;
    int scene;
    gltf_at(r, "scene");
    if (json_array_size(scenes) == 0) return true;
    if (!gltf_index(r, r->file.json, "scene", (int)json_array_size(scenes), &scene)) return false;
    if (scene < 0) scene = 0;
    bool *shown = gltf_make(r, (size_t)gltf->node_count, sizeof *shown), done = shown;
    gltf_at(r, "scenes[%d]", scene);
    json_array_foreach(json_object_get(json_array_get(scenes, (size_t)scene), "nodes"), i, element)
    {
        int root;
        done = done && read_member(r, element, "nodes", i, &root);
        if (done) shown[root] = true;
    }
    for (int n = 0; done && n < gltf->node_count; n++) {
        struct gltf_node *node = &gltf->nodes[gltf->order[n]];
        bool *is_shown = &shown[gltf->order[n]];
        *is_shown = *is_shown || (node->parent >= 0 && shown[node->parent]);
        if (*is_shown || node->mesh < 0) continue;
        node->mesh = -1;
        done = gltf_not_shown(r, "other scenes");
    }
    return done;
}

/// Morph weights at rest: the node's own, else its mesh's.
static bool read_weights(struct gltf_reader *r, const json_t *nodes)
{
    struct gltf *gltf = r->gltf;
    size_t total = 0;
    for (int n = 0; n < gltf->node_count; n++) {
        struct gltf_node *node = &gltf->nodes[n];
        node->first_weight = (int)total;
        if (node->mesh >= 0) total += (size_t)gltf->meshes[node->mesh].target_count;
        if (total > r->file.room / sizeof *gltf->weights) break; // gltf_make() reports it
    }
    gltf_at(r, "nodes");
    gltf->weights = gltf_make(r, total, sizeof *gltf->weights);
    if (!gltf->weights) return false;
    gltf->weight_count = (int)total;
    for (int n = 0; n < gltf->node_count; n++) {
        const struct gltf_node *node = &gltf->nodes[n];
        if (node->mesh < 0) continue;
        const struct gltf_mesh *mesh = &gltf->meshes[node->mesh];
        float *weights = gltf->weights + node->first_weight;
        for (int k = 0; k < mesh->target_count; k++) weights[k] = mesh->weights[k];
        gltf_at(r, "nodes[%d]", n);
        if (!gltf_reals(r, json_array_get(nodes, (size_t)n), "weights", weights, (size_t)mesh->target_count))
            return false;
    }
    return true;
}

bool gltf_read_nodes(struct gltf_reader *r)
{
    const json_t *nodes = gltf_array(r, "nodes"), *json;
    size_t i, count = json_array_size(nodes);
    gltf_at(r, "nodes");
    if (count == 0) return gltf_bad(r, ": expected something to show, got no nodes");
    r->gltf->nodes = gltf_make(r, count, sizeof *r->gltf->nodes);
    r->gltf->order = r->gltf->nodes ? gltf_make(r, count, sizeof *r->gltf->order) : NULL;
    if (!r->gltf->order) return false;
    r->gltf->node_count = (int)count;
    if (!gltf_name_all(r, nodes, "node", false, r->gltf->nodes, sizeof *r->gltf->nodes)) return false;
    json_array_foreach(nodes, i, json)
    {
        if (!read_node(r, json, i)) return false;
    }
    if (!read_parents(r, nodes)) return false;
    gltf_link_nodes(r->gltf);
    return put_in_order(r, nodes) && choose_scene(r) && read_weights(r, nodes);
}

static bool read_inverse_bind(struct gltf_reader *r, const json_t *json, struct gltf_skin *skin)
{
    struct glb_numbers numbers;
    if (!json_object_get(json, "inverseBindMatrices")) {
        for (int i = 0; i < skin->joint_count; i++)
            for (int k = 0; k < 4; k++) skin->inverse_bind[i][5 * k] = 1;
        return true;
    }
    if (!glb_numbers(&r->file, glb_integer(json, "inverseBindMatrices", -1), &numbers, r->error)) return false;
    bool fits = numbers.components == 16 && numbers.count >= skin->joint_count;
    for (int n = 0; fits && n < 16 * skin->joint_count; n++)
        skin->inverse_bind[n / 16][n % 16] = (float)numbers.values[n];
    free(numbers.values);
    return fits || gltf_bad(r, ".inverseBindMatrices: expected %d matrices of 16 numbers, got %d of %d",
                            skin->joint_count, numbers.count, numbers.components);
}

static bool read_skin(struct gltf_reader *r, const json_t *json, struct gltf_skin *skin)
{
    const json_t *joints = json_object_get(json, "joints"), *element;
    size_t i, count = json_array_size(joints);
    if (count == 0) return gltf_bad(r, ".joints: expected a joint or more, got none");
    skin->joints = gltf_make(r, count, sizeof *skin->joints);
    skin->inverse_bind = skin->joints ? gltf_make(r, count, sizeof *skin->inverse_bind) : NULL;
    if (!skin->inverse_bind) return false;
    skin->joint_count = (int)count;
    skin->first_joint = r->gltf->joint_count;
    r->gltf->joint_count += skin->joint_count;
    json_array_foreach(joints, i, element)
    {
        if (!read_member(r, element, "joints", i, &skin->joints[i])) return false;
    }
    return read_inverse_bind(r, json, skin);
}

bool gltf_read_skins(struct gltf_reader *r)
{
    const json_t *skins = gltf_array(r, "skins"), *json;
    size_t i;
    gltf_at(r, "skins");
    r->gltf->skins = gltf_make(r, json_array_size(skins), sizeof *r->gltf->skins);
    if (!r->gltf->skins) return false;
    json_array_foreach(skins, i, json)
    {
        gltf_at(r, "skins[%zu]", i);
        r->gltf->skin_count++;
        if (!read_skin(r, json, &r->gltf->skins[i])) return false;
    }
    for (int n = 0; n < r->gltf->node_count; n++) {
        const struct gltf_node *node = &r->gltf->nodes[n];
        if (node->mesh < 0 || node->skin < 0) continue;
        int joints = r->gltf->skins[node->skin].joint_count;
        gltf_at(r, "nodes[%d]", n);
        if (r->joints_of[node->mesh] > joints)
            return gltf_bad(r, ".skin: expected a skin of %d joints, which its mesh uses, got %d",
                            r->joints_of[node->mesh], joints);
    }
    return true;
}

// --- animations

/// The numbers of a sampler's accessor; the caller frees them. NULL with an error.
static float *read_floats(struct gltf_reader *r, const json_t *sampler, const char *key, int *count, int *components)
{
    struct glb_numbers numbers;
    int accessor;
    if (!gltf_index(r, sampler, key, (int)json_array_size(gltf_array(r, "accessors")), &accessor)) return NULL;
    if (accessor < 0) {
        gltf_bad(r, ".%s: expected an accessor, got none", key);
        return NULL;
    }
    if (!glb_numbers(&r->file, accessor, &numbers, r->error)) return NULL;
    const size_t total = (size_t)numbers.count * (size_t)numbers.components;
    float *values = gltf_make(r, total, sizeof *values);
    for (size_t i = 0; values && i < total; i++) values[i] = (float)numbers.values[i];
    free(numbers.values);
    *count = numbers.count;
    *components = numbers.components;
    return values;
}

static bool read_interpolation(struct gltf_reader *r, const json_t *sampler, struct gltf_channel *channel)
{
    static const char *const names[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    const char *name = json_string_value(json_object_get(sampler, "interpolation"));
    channel->interpolation = GLTF_LINEAR;
    for (int i = 0; name && i < 3; i++) {
        if (strcmp(name, names[i]) != 0) continue;
        channel->interpolation = (enum gltf_interpolation)i;
        return true;
    }
    return !name || gltf_bad(r, ".interpolation: expected STEP, LINEAR or CUBICSPLINE, got %.40s", name);
}

static bool read_sampler(struct gltf_reader *r, const json_t *sampler, struct gltf_channel *channel)
{
    int count, of_time, components;
    channel->times = read_floats(r, sampler, "input", &channel->key_count, &of_time);
    channel->values = channel->times ? read_floats(r, sampler, "output", &count, &components) : NULL;
    if (!channel->values || !read_interpolation(r, sampler, channel)) return false;
    if (of_time != 1) return gltf_bad(r, ".input: expected times, got %d numbers a key", of_time);
    for (int i = 1; i < channel->key_count; i++) {
        if (channel->times[i] < channel->times[i - 1])
            return gltf_bad(r, ".input: expected ascending times, got %g after %g", (double)channel->times[i],
                            (double)channel->times[i - 1]);
    }
    int width = channel->path == GLTF_WEIGHTS ? 1 : channel->components;
    int64_t expected =
        (int64_t)channel->key_count * (channel->interpolation == GLTF_CUBIC ? 3 : 1) * channel->components / width;
    return (components == width && count == expected) ||
           gltf_bad(r, ".output: expected %lld elements of %d numbers, got %d of %d", (long long)expected, width,
                    count, components);
}

/// The channel's target; false if it does not exist or is not animated here.
static bool find_target(const struct gltf *gltf, const char *path, struct gltf_channel *channel)
{
    static const char *const names[] = {"translation", "rotation", "scale", "weights"};
    static const int components[] = {3, 4, 3, 0};
    const struct gltf_node *node = &gltf->nodes[channel->node];
    for (int i = 0; path && i < 4; i++) {
        if (strcmp(path, names[i]) != 0) continue;
        channel->path = (enum gltf_path)i;
        channel->components = components[i];
        if (i != GLTF_WEIGHTS) return !node->has_matrix;
        channel->components = node->mesh >= 0 ? gltf->meshes[node->mesh].target_count : 0;
        return channel->components > 0;
    }
    return false;
}

static bool read_channel(struct gltf_reader *r, const json_t *json, const json_t *samplers, size_t clip,
                         struct gltf_clip *out)
{
    struct gltf_channel channel = {0};
    const json_t *target = json_object_get(json, "target");
    int sampler;
    if (!gltf_index(r, target, "node", r->gltf->node_count, &channel.node)) return false;
    if (channel.node < 0) return true;
    if (!find_target(r->gltf, json_string_value(json_object_get(target, "path")), &channel)) {
        const bool stays = r->gltf->nodes[channel.node].has_matrix && channel.components > 0;
        return !stays || gltf_not_shown(r, "clips of nodes with sheared matrices");
    }
    if (!gltf_index(r, json, "sampler", (int)json_array_size(samplers), &sampler)) return false;
    if (sampler < 0) return gltf_bad(r, ".sampler: expected a sampler, got none");
    gltf_at(r, "animations[%zu].samplers[%d]", clip, sampler);
    struct gltf_channel *to = &out->channels[out->channel_count++];
    *to = channel;
    if (!read_sampler(r, json_array_get(samplers, (size_t)sampler), to)) return false;
    out->first = fmin(out->first, (double)to->times[0]);
    out->last = fmax(out->last, (double)to->times[to->key_count - 1]);
    return true;
}

static bool read_clip(struct gltf_reader *r, const json_t *json, size_t number, struct gltf_clip *clip)
{
    const json_t *channels = json_object_get(json, "channels"), *samplers = json_object_get(json, "samplers"),
                 *channel;
    size_t i;
    gltf_at(r, "animations[%zu]", number);
    clip->channels = gltf_make(r, json_array_size(channels), sizeof *clip->channels);
    if (!clip->channels) return false;
    clip->first = INFINITY;
    json_array_foreach(channels, i, channel)
    {
        gltf_at(r, "animations[%zu].channels[%zu]", number, i);
        if (!read_channel(r, channel, samplers, number, clip)) return false;
    }
    clip->first = fmin(clip->first, clip->last); // without a key
    return gltf_judge_loop(r->gltf, clip) || fail_no_memory(r->error, r->file.path);
}

bool gltf_read_clips(struct gltf_reader *r)
{
    const json_t *clips = gltf_array(r, "animations"), *clip;
    size_t i;
    gltf_at(r, "animations");
    r->gltf->clips = gltf_make(r, json_array_size(clips), sizeof *r->gltf->clips);
    if (!r->gltf->clips || !gltf_name_all(r, clips, "clip", true, r->gltf->clips, sizeof *r->gltf->clips))
        return false;
    json_array_foreach(clips, i, clip)
    {
        r->gltf->clip_count++;
        if (!read_clip(r, clip, i, &r->gltf->clips[i])) return false;
    }
    return true;
}
