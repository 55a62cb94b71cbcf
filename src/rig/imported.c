/// Reads imported characters, and finds their bones.
#include "rig/imported.h"
#include "base/need.h"
#include "model/vector.h"
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const float SHORT_TIP = 0.1f;     ///< share of the character's height: length of a lone joint's bone
static const float BESIDE = 0.1f;        ///< share of its length: a tail that ends nearer to the middle shows no back
static const float SHORT_SIBLING = 0.4f; ///< share of the way from its parent, for one of several bones, like an eye

static void mark_joints(const struct gltf *gltf, bool *is_bone)
{
    for (int s = 0; s < gltf->skin_count; s++) {
        for (int j = 0; j < gltf->skins[s].joint_count; j++) is_bone[gltf->skins[s].joints[j]] = true;
    }
    for (int n = 0; n < gltf->node_count && gltf->skin_count == 0; n++) is_bone[n] = gltf->nodes[n].parent >= 0;
}

static vec3s place_of(const struct gltf_pose *pose, int node) { return vec3_from(pose->world[node] + 12); }

/// The end of a bone without a child: as far on as the bone before is long, if it has one.
static struct bone tip_bone(const struct gltf *gltf, const struct gltf_pose *rest, int node, int parent_children)
{
    const vec3s at = place_of(rest, node);
    vec3s on = {.raw = {0, SHORT_TIP * (gltf->hi[1] - gltf->lo[1]), 0}};
    if (parent_children > 0) on = glms_vec3_sub(at, place_of(rest, gltf->nodes[node].parent));
    if (parent_children > 1) on = glms_vec3_scale(on, SHORT_SIBLING);
    const vec3s tip = glms_mat3_mulv(mat3_inverse(glms_mat4_pick3(mat4_from(rest->world[node]))), on);
    struct bone bone = {.node = node, .child = -1};
    memcpy(bone.tip, tip.raw, sizeof bone.tip);
    return bone;
}

/// In the file's order, so that a chain's bones follow each other.
static void list_bones(const struct gltf *gltf, const struct gltf_pose *rest, const bool *is_bone, int *children,
                       struct skeleton *skeleton)
{
    for (int n = 0; n < gltf->node_count; n++) {
        const int parent = gltf->nodes[n].parent;
        if (!is_bone[n] || parent < 0 || !is_bone[parent]) continue;
        children[parent]++;
        skeleton->bones[skeleton->count++] = (struct bone){.node = parent, .child = n};
    }
    for (int n = 0; n < gltf->node_count; n++) {
        const int parent = gltf->nodes[n].parent;
        if (!is_bone[n] || children[n] > 0) continue;
        skeleton->bones[skeleton->count++] = tip_bone(gltf, rest, n, parent >= 0 ? children[parent] : 0);
    }
}

static void skeleton_create(const struct gltf *gltf, const struct gltf_pose *rest, struct skeleton *skeleton)
{
    const size_t count = (size_t)gltf->node_count + 1;
    bool *is_bone = need_zeroed(count, sizeof *is_bone);
    int *children = need_zeroed(count, sizeof *children); // child bones
    *skeleton = (struct skeleton){.bones = need_zeroed(2 * count, sizeof *skeleton->bones)};
    mark_joints(gltf, is_bone);
    list_bones(gltf, rest, is_bone, children, skeleton);
    free(is_bone);
    free(children);
}

void skeleton_ends(const struct bone *bone, const struct gltf_pose *pose, float ends[2][3])
{
    vec3s end = bone->child >= 0 ? place_of(pose, bone->child)
                                 : glms_mat4_mulv3(mat4_from(pose->world[bone->node]), vec3_from(bone->tip), 1.0f);
    memcpy(ends[0], pose->world[bone->node] + 12, sizeof ends[0]);
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
        if (hypotf(x, z) <= farthest) continue;
        farthest = hypotf(x, z);
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
    skeleton_create(&imported->gltf, &imported->rest, &imported->skeleton);
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
    free(imported->skeleton.bones);
    gltf_bounds_free(&imported->bounds);
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
        return fail(error, ERROR_INPUT, "%s: expected a bone that can turn, got \"%s\", which has a matrix",
                    gltf->path, gltf->nodes[n].name);
    }
    return true;
}

int chain_end(const struct gltf *gltf, int from, struct error *error)
{
    int last = from;
    for (int count = 1; count <= ANGLES_MAX_JOINTS; count++) {
        const int child = gltf->nodes[last].child, other = child < 0 ? -1 : gltf->nodes[child].next;
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
            snprintf(other, BONE_NAME_SIZE, "%.*s%s%s", (int)(at - name), name, words[w][!side],
                     at + strlen(words[w][side]));
            return true;
        }
    }
    for (size_t i = 0; name[i]; i++) {
        for (int k = 0; k < 4; k++) {
            const char *letter = letters[k / 2][k % 2];
            if (name[i] != letter[0] || !stands_alone(name, i)) continue;
            snprintf(other, BONE_NAME_SIZE, "%.*s%s%s", (int)i, name, letters[k / 2][!(k % 2)], name + i + 1);
            return true;
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
