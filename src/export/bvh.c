/// Joints as .bvh. Metres, y up; a joint turns by R_y · R_x · R_z, so that a tail's side and up are the first two of its channels. A joint
/// whose place in its parent changes has channels for that, too.
#include "base/need.h"
#include "export/form.h"
#include "model/vector.h"
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// A name without spaces, at which readers end one.
static void write_name(FILE *out, const char *name)
{
    for (const char *c = name; *c; c++) fputc(isspace((unsigned char)*c) ? '_' : *c, out);
}

static void write_offset(FILE *out, const float offset[3], float scale, int depth)
{
    fprintf(out, "%*sOFFSET %.9g %.9g %.9g\n", 2 * depth, "", (double)(scale * offset[0]),
            (double)(scale * offset[1]), (double)(scale * offset[2]));
}

static void write_end(FILE *out, const float tip[3], float scale, int depth)
{
    fprintf(out, "%*sEnd Site\n%*s{\n", 2 * depth, "", 2 * depth, "");
    write_offset(out, tip, scale, depth + 1);
    fprintf(out, "%*s}\n", 2 * depth, "");
}

/// What is written, and where it stands: its first joint is turned and moved by `root`, and all are scaled.
struct bvh {
    FILE *out;
    const struct form *form;
    const struct keys *keys;
    mat4s root;
    versors turn;
    float scale;
    bool *has_place;   ///< of each joint: it has channels for that
    double (*seen)[3]; ///< its angles at the key before, which go on past half a turn
};

static bool is_moved(const struct bvh *bvh, int j)
{
    for (int k = 0; k < bvh->keys->count; k++) {
        const float *offset = keys_at(bvh->keys, k, keys_offset(bvh->keys, j));
        if (memcmp(offset, bvh->form->joints[j].offset, 3 * sizeof *offset) != 0) return true;
    }
    return j == bvh->form->first_bone;
}

/// Returns the joint after it and all that hang on it.
static int write_joint(const struct bvh *bvh, int j, int depth)
{
    static const float none[3];
    FILE *out = bvh->out;
    const struct form_joint *joint = &bvh->form->joints[j];
    const bool is_root = j == bvh->form->first_bone;
    int next = j + 1;
    fprintf(out, "%*s%s ", 2 * depth, "", is_root ? "ROOT" : "JOINT");
    write_name(out, joint->name);
    fprintf(out, "\n%*s{\n", 2 * depth, "");
    write_offset(out, is_root ? none : joint->offset, bvh->scale, depth + 1);
    fprintf(out, "%*sCHANNELS %s\n", 2 * depth + 2, "",
            bvh->has_place[j] ? "6 Xposition Yposition Zposition Yrotation Xrotation Zrotation"
                              : "3 Yrotation Xrotation Zrotation");
    while (next < bvh->form->joint_count && bvh->form->joints[next].parent == j)
        next = write_joint(bvh, next, depth + 1);
    if (next == j + 1) write_end(out, joint->tip, bvh->scale, depth + 1);
    fprintf(out, "%*s}\n", 2 * depth, "");
    return next;
}

/// Angles with q = R_y(angle[0]) · R_x(angle[1]) · R_z(angle[2]), degrees. The last is what the first two leave of q, so that near
/// an upright axis, where the first is arbitrary, the three still agree.
static void to_angles(const float q[4], double angle[3])
{
    const double x = (double)q[0], y = (double)q[1], z = (double)q[2], w = (double)q[3];
    const double degrees = 180 / 3.14159265358979323846;
    const double across = 2 * (x * z + w * y), along = 1 - 2 * (x * x + y * y);
    const double a = atan2(across, along) / 2, b = atan2(2 * (w * x - y * z), hypot(across, along)) / 2;
    const double ca = cos(a), sa = sin(a), cb = cos(b), sb = sin(b);
    // the inverse of R_y · R_x = (ca·sb, sa·cb, −sa·sb, ca·cb), times q
    const double rest_z = ca * cb * z - ca * sb * y + sa * cb * x + sa * sb * w;
    const double rest_w = ca * cb * w + ca * sb * x + sa * cb * y - sa * sb * z;
    angle[0] = 2 * degrees * a;
    angle[1] = 2 * degrees * b;
    angle[2] = 2 * degrees * atan2(rest_z, rest_w);
}

/// The joints in the order in which write_joint() names them.
static void write_key(const struct bvh *bvh, int key)
{
    for (int j = bvh->form->first_bone; j < bvh->form->joint_count; j++) {
        const bool is_root = j == bvh->form->first_bone;
        versors q;
        double angle[3];
        memcpy(&q, keys_at(bvh->keys, key, keys_rotation(j)), sizeof q);
        if (is_root) q = glms_quat_mul(bvh->turn, q);
        to_angles(q.raw, angle);
        vec3s place = vec3_from(keys_at(bvh->keys, key, is_root ? 0 : keys_offset(bvh->keys, j)));
        place = is_root ? glms_mat4_mulv3(bvh->root, place, 1) : glms_vec3_scale(place, bvh->scale);
        for (int k = 0; k < 3 && bvh->has_place[j]; k++) fprintf(bvh->out, " %.9g", (double)place.raw[k]);
        for (int k = 0; k < 3; k++) {
            bvh->seen[j][k] = angle[k] + 360 * round((bvh->seen[j][k] - angle[k]) / 360);
            fprintf(bvh->out, " %.9g", bvh->seen[j][k]);
        }
    }
    fputc('\n', bvh->out);
}

static void write_all(struct export_range *range, struct bvh *bvh)
{
    const int count = bvh->keys->count, joints = bvh->form->joint_count;
    bvh->has_place = need((size_t)joints, sizeof *bvh->has_place);
    bvh->seen = need_zeroed((size_t)joints, sizeof *bvh->seen);
    for (int j = 0; j < joints; j++) bvh->has_place[j] = is_moved(bvh, j);
    fputs("HIERARCHY\n", bvh->out);
    write_joint(bvh, bvh->form->first_bone, 0);
    fprintf(bvh->out, "MOTION\nFrames: %d\nFrame Time: %.12g\n", count, range_seconds(range, 1));
    for (int k = 0; k < count; k++) write_key(bvh, k);
    free(bvh->has_place);
    free(bvh->seen);
    snprintf(range->summary, FORMAT_SUMMARY, "%d joints, %d frames", joints - bvh->form->first_bone, count);
}

/// Where it stands on the stage, if it is written so.
static bool find_root(const struct export_range *range, struct bvh *bvh, struct error *error)
{
    struct rig_pose pose;
    if (!range_pose(range, range->rigs[0], 0, &pose, error)) return false;
    const float *root = range_root(range, range->rigs[0], &pose);
    bvh->root = root ? mat4_from(root) : glms_mat4_identity();
    bvh->scale = glms_vec3_norm(vec3_from(bvh->root.raw[0]));
    mat3s turned = glms_mat4_pick3(bvh->root);
    for (int k = 0; k < 3; k++) glm_vec3_normalize(turned.raw[k]);
    bvh->turn = glms_mat3_quat(turned);
    return true;
}

bool bvh_write(struct export_range *range, FILE *out, struct error *error)
{
    struct form form;
    struct keys keys;
    struct bvh bvh = {.out = out, .form = &form, .keys = &keys};
    if (!find_root(range, &bvh, error) || !form_open(range, range->rigs[0], &form, error)) return false;
    const bool done = keys_collect(range, range->rigs[0], &form, &keys, error);
    if (done) write_all(range, &bvh);
    keys_free(&keys);
    form_close(&form);
    return done;
}
