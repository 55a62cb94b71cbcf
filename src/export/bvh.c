/// Joints as .bvh, y up. A joint turns by R_y · R_x · R_z, so a tail's side and up are the first two of its channels. A joint that moves in its
/// parent has channels for its place, too.
#include "base/need.h"
#include "export/form.h"
#include "maths/maths.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void write_offset(FILE *out, const float offset[3], int depth)
{
    fprintf(out, "%*sOFFSET %.9g %.9g %.9g\n", 2 * depth, "", (double)offset[0], (double)offset[1],
            (double)offset[2]);
}

struct bvh {
    FILE *out;
    struct form *form;
    bool *has_place; ///< of each joint: whether it moves in its parent
};

/// Returns the joint after it and all that hang on it.
static int write_joint(const struct bvh *bvh, int j, int depth)
{
    static const float none[3];
    FILE *out = bvh->out;
    const struct form_joint *joint = &bvh->form->joints[j];
    const bool is_root = j == bvh->form->first_bone;
    int next = j + 1;
    fprintf(out, "%*s%s %s\n%*s{\n", 2 * depth, "", is_root ? "ROOT" : "JOINT",
            form_word(&bvh->form->pool, joint->name), 2 * depth, "");
    write_offset(out, is_root ? none : joint->offset, depth + 1);
    fprintf(out, "%*sCHANNELS %s\n", 2 * depth + 2, "",
            bvh->has_place[j] ? "6 Xposition Yposition Zposition Yrotation Xrotation Zrotation"
                              : "3 Yrotation Xrotation Zrotation");
    while (next < bvh->form->joint_count && bvh->form->joints[next].parent == j)
        next = write_joint(bvh, next, depth + 1);
    if (next == j + 1) {
        fprintf(out, "%*sEnd Site\n%*s{\n", 2 * depth + 2, "", 2 * depth + 2, "");
        write_offset(out, joint->tip, depth + 2);
        fprintf(out, "%*s}\n", 2 * depth + 2, "");
    }
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
    const double a = maths_atan2(across, along) / 2,
                 b = maths_atan2(2 * (w * x - y * z), maths_hypot(across, along)) / 2;
    const double ca = maths_cos(a), sa = maths_sin(a), cb = maths_cos(b), sb = maths_sin(b);
    // the inverse of R_y · R_x = (ca·sb, sa·cb, −sa·sb, ca·cb), times q
    const double rest_z = ca * cb * z - ca * sb * y + sa * cb * x + sa * sb * w;
    const double rest_w = ca * cb * w + ca * sb * x + sa * cb * y - sa * sb * z;
    angle[0] = 2 * degrees * a;
    angle[1] = 2 * degrees * b;
    angle[2] = 2 * degrees * maths_atan2(rest_z, rest_w);
}

bool bvh_write(struct export_range *range, FILE *out, struct error *error)
{
    struct rig_pose pose;
    struct form form;
    struct keys keys;
    if (!range_pose(range, range->rigs[0], 0, &pose, error)) return false;
    const float *root = range_root(range, range->rigs[0], &pose);
    if (!form_open(range, range->rigs[0], &form, error)) return false;
    const bool done = keys_collect(range, range->rigs[0], &form, &keys, error);
    if (done && root) { // everything moves to where the stage has it
        mat4s matrix = mat4_from(root);
        const float scale = glms_vec3_norm(vec3_from(root));
        mat3s turned = glms_mat4_pick3(matrix);
        for (int k = 0; k < 3; k++) glm_vec3_normalize(turned.raw[k]);
        const versors turn = glms_mat3_quat(turned);
        for (int j = 0; j < form.joint_count; j++) {
            glm_vec3_scale(form.joints[j].offset, scale, form.joints[j].offset);
            glm_vec3_scale(form.joints[j].tip, scale, form.joints[j].tip);
        }
        for (float *row = keys.rows; row < keys_at(&keys, keys.count, 0); row += keys.width) {
            versors q;
            glm_mat4_mulv3(matrix.raw, row, 1, row);
            memcpy(&q, row + keys_rotation(form.first_bone), sizeof q);
            q = glms_quat_mul(turn, q);
            memcpy(row + keys_rotation(form.first_bone), &q, sizeof q);
            for (int j = 0; j < form.joint_count; j++)
                glm_vec3_scale(row + keys_offset(&keys, j), scale, row + keys_offset(&keys, j));
        }
    }
    if (done) {
        struct bvh bvh = {.out = out, .form = &form};
        const int count = keys.count, joints = form.joint_count;
        bvh.has_place = need((size_t)joints, sizeof *bvh.has_place);
        double(*seen)[3] = need_zeroed(
            (size_t)joints, sizeof *seen); // angles at the key before, so that turns continue past half a turn
        for (int j = 0; j < joints; j++) {
            bvh.has_place[j] = j == form.first_bone;
            for (int k = 0; k < count && !bvh.has_place[j]; k++) {
                const float *offset = keys_at(&keys, k, keys_offset(&keys, j));
                bvh.has_place[j] = memcmp(offset, form.joints[j].offset, 3 * sizeof *offset) != 0;
            }
        }
        fputs("HIERARCHY\n", out);
        write_joint(&bvh, form.first_bone, 0);
        fprintf(out, "MOTION\nFrames: %d\nFrame Time: %.12g\n", count, range_seconds(range, 1));
        for (int k = 0; k < count; k++) {
            for (int j = form.first_bone; j < joints; j++) { // in the order in which write_joint() names them
                const float *place = keys_at(&keys, k, j == form.first_bone ? 0 : keys_offset(&keys, j));
                double angle[3];
                to_angles(keys_at(&keys, k, keys_rotation(j)), angle);
                for (int i = 0; i < 3 && bvh.has_place[j]; i++) fprintf(out, " %.9g", (double)place[i]);
                for (int i = 0; i < 3; i++) {
                    seen[j][i] = angle[i] + 360 * round((seen[j][i] - angle[i]) / 360);
                    fprintf(out, " %.9g", seen[j][i]);
                }
            }
            fputc('\n', out);
        }
        free(bvh.has_place);
        free(seen);
        snprintf(range->summary, FORMAT_SUMMARY, "%d joints, %d frames", joints - form.first_bone, count);
    }
    form_close(&form);
    return done;
}
