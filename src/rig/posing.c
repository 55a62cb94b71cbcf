/// Poses any rig at any time, by its kind.
#include "rig/posing.h"
#include "rig/posing_kind.h"
#include <string.h>

#define POSING_ROW(constant, name) [constant] = &name##_posing,
const struct posing_functions *const posing_kinds[RIG_KINDS] = {RIG_KIND_LIST(POSING_ROW)};
#undef POSING_ROW

/// All that moves a rig by hand.
static void add_hands(const struct posing *posing, int rig, const struct by_hand *by_hand, struct by_hand *sum)
{
    *sum = by_hand ? *by_hand : (struct by_hand){0};
    if (posing->move) posing->move(posing->context, rig, sum);
}

void posing_base(const struct posing *posing, int rig, const struct by_hand *by_hand, double base[3])
{
    struct by_hand sum;
    add_hands(posing, rig, by_hand, &sum);
    memcpy(base, sum.base, sizeof sum.base);
}

void posing_values(const struct posing *posing, int index, double position, const struct by_hand *by_hand,
                   wiggly_value values[RIG_MAX_INPUTS])
{
    const struct rig *rig = posing->document->rigs[index];
    struct by_hand sum;
    add_hands(posing, index, by_hand, &sum);
    for (int i = 0; i < rig_input_count(rig); i++) {
        values[i] = evaluation_at(posing->evaluation, rig_input(rig, i), position);
        values[i].y += sum.input[i].y;
        values[i].re += sum.input[i].re;
        values[i].im += sum.input[i].im;
    }
}

bool rig_pose(const struct posing *posing, int index, double position, const struct by_hand *by_hand,
              struct rig_pose *pose)
{
    wiggly_value values[RIG_MAX_INPUTS];
    if (index < 0 || index >= posing->document->rig_count) return false;
    const struct rig *rig = posing->document->rigs[index];
    posing_values(posing, index, position, by_hand, values);
    pose->kind = rig->kind;
    return posing_kinds[rig->kind]->pose(posing, index, position, values, by_hand, pose);
}

void rig_bounds(const struct rig_pose *pose, float lo[3], float hi[3])
{
    posing_kinds[pose->kind]->bounds(pose, lo, hi);
}
