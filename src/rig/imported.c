/// Reads imported characters, and finds their bones.
#include "rig/imported.h"
#include "base/need.h"
#include "maths/maths.h"
#include "model/vector.h"
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const float SHORT_TIP = 0.1f;     ///< share of the character's height: length of a lone joint's bone
static const float BESIDE = 0.1f;        ///< share of its length: a tail that ends nearer to the middle shows no back
static const float SHORT_SIBLING = 0.4f; ///< share of the way from its parent, for one of several bones, like an eye
static const float STRAIGHT = 0.8f;      ///< cosine within which one of several children goes on from the bone before

/// Joints; in a file without skins, nodes below others. A single mesh is no skeleton.
static void mark_joints(const struct imported *imported, bool *is_bone)
{
    const struct gltf *gltf = &imported->gltf;
    for (int s = 0; s < gltf->skin_count; s++) {
        for (int j = 0; j < gltf->skins[s].joint_count; j++) is_bone[gltf->skins[s].joints[j]] = true;
    }
    for (int n = 0; n < gltf->node_count && gltf->skin_count == 0; n++)
        is_bone[n] = gltf->nodes[n].parent >= 0 && imported->bounds.count != 1;
}

/// A mesh without a skin is carried by the bone above it.
static void mark_carrying(const struct imported *imported, const bool *is_bone, struct skeleton *skeleton)
{
    const struct gltf *gltf = &imported->gltf;
    const struct gltf_bounds *bounds = &imported->bounds;
    for (int f = 0; f < bounds->count; f++) {
        const struct gltf_box *box = &bounds->boxes[f];
        int n = box->joint < 0 ? box->node : gltf->skins[gltf->nodes[box->node].skin].joints[box->joint];
        while (n >= 0 && !is_bone[n]) n = gltf->nodes[n].parent;
        if (n >= 0) skeleton->carries[n] = true;
    }
    for (int n = 0; n < gltf->node_count; n++) skeleton->carries[n] |= bounds->count == 0 && is_bone[n];
    for (int i = gltf->node_count - 1; i >= 0; i--) {
        const int n = gltf->order[i], parent = gltf->nodes[n].parent;
        skeleton->leads[n] |= skeleton->carries[n];
        if (parent >= 0) skeleton->leads[parent] |= skeleton->leads[n];
    }
}

static vec3s place_of(const struct gltf_pose *pose, int node) { return vec3_from(pose->world[node] + 12); }

/// How a bone goes on if no child says so: as far as the bone before is long, if it has one.
static vec3s way_on(const struct imported *imported, const bool *is_bone, int node)
{
    const struct gltf *gltf = &imported->gltf;
    const int parent = gltf->nodes[node].parent;
    if (parent < 0 || !is_bone[parent]) return (vec3s){.raw = {0, SHORT_TIP * (gltf->hi[1] - gltf->lo[1]), 0}};
    int siblings = 0;
    for (int c = gltf->nodes[parent].child; c >= 0; c = gltf->nodes[c].next) siblings += is_bone[c];
    const vec3s on = glms_vec3_sub(place_of(&imported->rest, node), place_of(&imported->rest, parent));
    return siblings > 1 ? glms_vec3_scale(on, SHORT_SIBLING) : on;
}

/// The child that a bone leads to: the only one that leads to vertices, or the only one at all; of several, the one that goes straight on.
static int main_child(const struct imported *imported, const struct skeleton *skeleton, const bool *is_bone, int node)
{
    const struct gltf_node *nodes = imported->gltf.nodes;
    const vec3s at = place_of(&imported->rest, node), on = glms_vec3_normalize(way_on(imported, is_bone, node));
    for (int all = 0; all < 2; all++) {
        int count = 0, only = -1, best = -1;
        float most = STRAIGHT;
        for (int c = nodes[node].child; c >= 0; c = nodes[c].next) {
            if (!is_bone[c] || !(skeleton->leads[c] || all)) continue;
            const vec3s way = glms_vec3_normalize(glms_vec3_sub(place_of(&imported->rest, c), at));
            only = count++ == 0 ? c : -1;
            if (glms_vec3_dot(way, on) <= most) continue;
            most = glms_vec3_dot(way, on);
            best = c;
        }
        if (count > 0) return only >= 0 ? only : best;
    }
    return -1;
}

static bool is_hidden(const struct gltf *gltf, const struct skeleton *skeleton, int node)
{
    bool seen = skeleton->carries[node];
    for (int c = gltf->nodes[node].child; c >= 0 && !seen; c = gltf->nodes[c].next) seen = skeleton->carries[c];
    return !seen;
}

static void list_bones(const struct imported *imported, const bool *is_bone, struct skeleton *skeleton)
{
    const struct gltf *gltf = &imported->gltf;
    for (int n = 0; n < gltf->node_count; n++) {
        if (!is_bone[n]) continue;
        const mat3s turn = mat3_inverse(glms_mat4_pick3(mat4_from(imported->rest.world[n])));
        const vec3s tip = glms_mat3_mulv(turn, way_on(imported, is_bone, n));
        struct bone *bone = &skeleton->bones[skeleton->own++];
        *bone = (struct bone){.node = n, .from = n, .hidden = is_hidden(gltf, skeleton, n)};
        bone->child = main_child(imported, skeleton, is_bone, n);
        memcpy(bone->tip, tip.raw, sizeof bone->tip);
    }
    skeleton->count = skeleton->own;
    for (int b = 0; b < skeleton->own; b++) {
        const int parent = skeleton->bones[b].from, main = skeleton->bones[b].child;
        for (int c = gltf->nodes[parent].child; c >= 0; c = gltf->nodes[c].next) {
            const bool hidden = skeleton->bones[b].hidden || is_hidden(gltf, skeleton, c);
            if (is_bone[c] && c != main)
                skeleton->bones[skeleton->count++] =
                    (struct bone){.node = c, .from = parent, .child = c, .hidden = hidden};
        }
    }
}

static void skeleton_create(struct imported *imported)
{
    const size_t count = (size_t)imported->gltf.node_count + 1;
    bool *is_bone = need_zeroed(count, sizeof *is_bone);
    struct pool *pool = &imported->gltf.pool;
    imported->skeleton = (struct skeleton){.bones = pool_take(pool, 2 * count, sizeof(struct bone)),
                                           .carries = pool_take(pool, count, sizeof(bool)),
                                           .leads = pool_take(pool, count, sizeof(bool))};
    mark_joints(imported, is_bone);
    mark_carrying(imported, is_bone, &imported->skeleton);
    list_bones(imported, is_bone, &imported->skeleton);
    free(is_bone);
}

void skeleton_ends(const struct bone *bone, const struct gltf_pose *pose, float ends[2][3])
{
    vec3s end = bone->child >= 0 ? place_of(pose, bone->child)
                                 : glms_mat4_mulv3(mat4_from(pose->world[bone->node]), vec3_from(bone->tip), 1.0f);
    memcpy(ends[0], pose->world[bone->from] + 12, sizeof ends[0]);
    memcpy(ends[1], end.raw, sizeof ends[1]);
}

bool imported_back(const struct imported *imported, float back[2])
{
    const struct gltf *gltf = &imported->gltf;
    const float *lo = gltf->lo, *hi = gltf->hi;
    float farthest = BESIDE * (hi[2] - lo[2]);
    bool found = false;
    for (int b = 0; b < imported->skeleton.count; b++) {
        const struct bone *bone = &imported->skeleton.bones[b];
        float ends[2][3];
        if (!strcasestr(gltf->nodes[bone->node].name, "tail")) continue;
        skeleton_ends(bone, &imported->rest, ends);
        const float x = ends[1][0] - 0.5f * (lo[0] + hi[0]), z = ends[1][2] - 0.5f * (lo[2] + hi[2]);
        if (maths_hypotf(x, z) <= farthest) continue;
        farthest = maths_hypotf(x, z);
        back[0] = x;
        back[1] = z;
        found = true;
    }
    if (found) return true;
    back[0] = 0;
    back[1] = -1;
    return gltf->skin_count > 0 && hi[2] - lo[2] > hi[0] - lo[0];
}

bool imported_complete(struct imported *imported)
{
    if (!gltf_pose_create(&imported->gltf, &imported->rest) ||
        !gltf_bounds_create(&imported->gltf, &imported->bounds))
        return false;
    skeleton_create(imported);
    return true;
}

bool imported_read(struct imported *imported, const char *path, struct error *error)
{
    *imported = (struct imported){0};
    if (!gltf_read(path, &imported->gltf, error)) return false;
    if (imported_complete(imported)) return true;
    imported_free(imported);
    return fail_no_memory(error, path);
}

void imported_free(struct imported *imported)
{
    gltf_pose_free(&imported->rest);
    gltf_free(&imported->gltf);
    *imported = (struct imported){0};
}

// --- bones of a chain

static bool fail_missing(const struct gltf *gltf, const char *name, struct error *error)
{
    return fail(error, ERROR_INPUT, "%s: expected a bone called \"%s\", got none", gltf->path, name);
}

bool chain_find(const struct gltf *gltf, const char *from, const char *to, struct chain_bones *bones,
                struct error *error)
{
    const int first = gltf_find_node(gltf, from), last = gltf_find_node(gltf, to);
    if (first < 0) return fail_missing(gltf, from, error);
    if (last < 0) return fail_missing(gltf, to, error);
    bones->count = 1;
    for (int n = last; n != first; n = gltf->nodes[n].parent, bones->count++) {
        if (n < 0)
            return fail(error, ERROR_INPUT, "%s: expected \"%s\" below \"%s\", got it elsewhere", gltf->path, to,
                        from);
        if (bones->count == ANGLES_MAX_JOINTS)
            return fail(error, ERROR_INPUT, "%s: expected at most %d bones from \"%s\" to \"%s\", got more",
                        gltf->path, ANGLES_MAX_JOINTS, from, to);
    }
    for (int i = bones->count - 1, n = last; i >= 0; i--, n = gltf->nodes[n].parent) {
        bones->node[i] = n;
        if (!gltf->nodes[n].has_matrix) continue;
        return fail(error, ERROR_INPUT,
                    "%s: expected a bone that can turn, got \"%s\", which a matrix shears or flattens", gltf->path,
                    gltf->nodes[n].name);
    }
    return true;
}

/// The first of `node` and those after it below the same parent that counts as a way down.
static int next_way(const struct imported *imported, int node, bool leads)
{
    while (node >= 0 && leads && !imported->skeleton.leads[node]) node = imported->gltf.nodes[node].next;
    return node;
}

int chain_end(const struct imported *imported, int from, struct error *error)
{
    const struct gltf *gltf = &imported->gltf;
    const bool leads = imported->skeleton.leads[from];
    int last = from;
    for (int count = 1; count <= ANGLES_MAX_JOINTS; count++) {
        const int child = next_way(imported, gltf->nodes[last].child, leads);
        const int other = child < 0 ? -1 : next_way(imported, gltf->nodes[child].next, leads);
        if (child < 0) return last;
        if (other >= 0) {
            fail(error, ERROR_INPUT,
                 "\"%s\" branches into \"%s\" and \"%s\": choose the bone where the chain begins or ends",
                 gltf->nodes[last].name, gltf->nodes[child].name, gltf->nodes[other].name);
            return -1;
        }
        last = child;
    }
    fail(error, ERROR_INPUT, "below \"%s\" there are more than %d bones: choose the one where the chain ends",
         gltf->nodes[from].name, ANGLES_MAX_JOINTS);
    return -1;
}

// --- pairs

/// Whether a letter is a separate word, as in ear.l, or earL.
static bool stands_alone(const char *name, size_t at)
{
    const unsigned char before = at > 0 ? (unsigned char)name[at - 1] : ' ', letter = (unsigned char)name[at];
    return (!isalpha(before) || (islower(before) && isupper(letter))) && !isalpha((unsigned char)name[at + 1]);
}

bool bone_other_side(const char *name, char other[BONE_NAME_SIZE])
{
    static const char *const words[][2] = {{"Left", "Right"}, {"left", "right"}, {"LEFT", "RIGHT"}};
    static const char *const letters[][2] = {{"L", "R"}, {"l", "r"}};
    for (size_t w = 0; w < 3; w++) {
        for (int side = 0; side < 2; side++) {
            const char *at = strstr(name, words[w][side]);
            if (!at) continue;
            return snprintf(other, BONE_NAME_SIZE, "%.*s%s%s", (int)(at - name), name, words[w][!side],
                            at + strlen(words[w][side])) < BONE_NAME_SIZE;
        }
    }
    for (size_t i = 0; name[i]; i++) {
        for (int k = 0; k < 4; k++) {
            const char *letter = letters[k / 2][k % 2];
            if (name[i] != letter[0] || !stands_alone(name, i)) continue;
            return snprintf(other, BONE_NAME_SIZE, "%.*s%s%s", (int)i, name, letters[k / 2][!(k % 2)], name + i + 1) <
                   BONE_NAME_SIZE;
        }
    }
    return false;
}

bool chain_find_twin(const struct gltf *gltf, const char *from, const char *to, struct chain_bones *bones)
{
    char ends[2][BONE_NAME_SIZE];
    return bone_other_side(from, ends[0]) && bone_other_side(to, ends[1]) &&
           chain_find(gltf, ends[0], ends[1], bones, NULL);
}
