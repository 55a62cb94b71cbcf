/// Copies and compares motions of joints.
#include "scene/joint_motion.h"
#include "base/need.h"
#include <stdlib.h>
#include <string.h>

const char *const motion_words[] = {
    [MOTION_TURN] = "turn", [MOTION_ACROSS] = "across", [MOTION_UP] = "up", [MOTION_KINDS] = NULL};

static bool same_text(const char *a, const char *b) { return a == b || (a && b && strcmp(a, b) == 0); }

bool motion_equals(const struct joint_motion *a, const struct joint_motion *b)
{
    if (a == b || !a || !b) return a == b;
    return a->of == b->of && a->by_file == b->by_file && same_text(a->model, b->model) &&
           same_text(a->joint, b->joint) && same_text(a->chain, b->chain);
}

struct joint_motion *motion_create(const struct joint_motion *motion)
{
    struct joint_motion *copy = need(1, sizeof *copy);
    *copy = *motion;
    atomic_init(&copy->holders, 1);
    copy->model = need_text(motion->model);
    copy->joint = need_text(motion->joint);
    copy->chain = motion->chain ? need_text(motion->chain) : NULL;
    return copy;
}

void motion_hold(struct joint_motion *motion)
{
    if (motion) atomic_fetch_add(&motion->holders, 1);
}

void motion_drop(struct joint_motion *motion)
{
    if (!motion || atomic_fetch_sub(&motion->holders, 1) > 1) return;
    free(motion->model);
    free(motion->joint);
    free(motion->chain);
    free(motion);
}
