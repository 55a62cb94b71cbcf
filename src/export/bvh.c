/// Joints as .bvh. Metres, y up; a joint turns by R_y · R_x · R_z, so that a tail's side and up are the first two of its channels.
#include "export/form.h"
#include <ctype.h>
#include <math.h>
#include <string.h>

/// A name without spaces, at which readers end one.
static void write_name(FILE *out, const char *name)
{
    for (const char *c = name; *c; c++) fputc(isspace((unsigned char)*c) ? '_' : *c, out);
}

static void write_offset(FILE *out, const float offset[3], int depth)
{
    fprintf(out, "%*sOFFSET %.9g %.9g %.9g\n", 2 * depth, "", (double)offset[0], (double)offset[1],
            (double)offset[2]);
}

static void write_end(FILE *out, const float tip[3], int depth)
{
    fprintf(out, "%*sEnd Site\n%*s{\n", 2 * depth, "", 2 * depth, "");
    write_offset(out, tip, depth + 1);
    fprintf(out, "%*s}\n", 2 * depth, "");
}

static void write_joint(FILE *out, const struct form *form, int j, int depth)
{
    static const float none[3];
    const struct form_joint *joint = &form->joints[j];
    const bool root = j == form->first_bone;
    bool is_last = true;
    fprintf(out, "%*s%s ", 2 * depth, "", root ? "ROOT" : "JOINT");
    write_name(out, joint->name);
    fprintf(out, "\n%*s{\n", 2 * depth, "");
    write_offset(out, root ? none : joint->offset, depth + 1);
    fprintf(out, "%*sCHANNELS %s\n", 2 * depth + 2, "",
            root ? "6 Xposition Yposition Zposition Yrotation Xrotation Zrotation"
                 : "3 Yrotation Xrotation Zrotation");
    for (int child = j + 1; child < form->joint_count; child++) {
        if (form->joints[child].parent != j) continue;
        is_last = false;
        write_joint(out, form, child, depth + 1);
    }
    if (is_last) write_end(out, form->tip, depth + 1);
    fprintf(out, "%*s}\n", 2 * depth, "");
}

/// Angles with q = R_y(angle[0]) · R_x(angle[1]) · R_z(angle[2]), degrees.
static void to_angles(const float q[4], double angle[3])
{
    const double x = (double)q[0], y = (double)q[1], z = (double)q[2], w = (double)q[3];
    const double degrees = 180 / 3.14159265358979323846;
    angle[0] = degrees * atan2(2 * (x * z + w * y), 1 - 2 * (x * x + y * y));
    angle[1] = degrees * asin(fmin(fmax(2 * (w * x - y * z), -1), 1));
    angle[2] = degrees * atan2(2 * (x * y + w * z), 1 - 2 * (x * x + z * z));
}

/// The joints in the order in which write_joint() names them, parents before children.
static void write_key(FILE *out, const struct form *form, const struct keys *keys, int j, int key)
{
    double angle[3];
    to_angles(keys_at(keys, key, keys_rotation(j)), angle);
    fprintf(out, " %.9g %.9g %.9g", angle[0], angle[1], angle[2]);
    for (int child = j + 1; child < form->joint_count; child++) {
        if (form->joints[child].parent == j) write_key(out, form, keys, child, key);
    }
}

bool bvh_write(struct export_range *range, FILE *out, struct error *error)
{
    struct form form;
    struct keys keys;
    if (!form_open(range, range->rigs[0], &form, error)) return false;
    const bool done = keys_collect(range, range->rigs[0], &form, &keys, error);
    if (done) {
        fputs("HIERARCHY\n", out);
        write_joint(out, &form, form.first_bone, 0);
        fprintf(out, "MOTION\nFrames: %d\nFrame Time: %.12g\n", keys.count, range_seconds(range, 1));
        for (int k = 0; k < keys.count; k++) {
            const float *place = keys_at(&keys, k, 0);
            fprintf(out, "%.9g %.9g %.9g", (double)place[0], (double)place[1], (double)place[2]);
            write_key(out, &form, &keys, form.first_bone, k);
            fputc('\n', out);
        }
        snprintf(range->summary, FORMAT_SUMMARY, "%d joints, %d frames", form.joint_count - form.first_bone,
                 keys.count);
    }
    keys_free(&keys);
    form_close(&form);
    return done;
}
