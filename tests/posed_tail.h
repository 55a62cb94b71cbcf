/// A tail without a scene, posed by values of its channels.
#ifndef TESTS_POSED_TAIL_H
#define TESTS_POSED_TAIL_H

#include "near.h"

#include "rig/posing.h"
#include <string.h>

static inline void pose_tail(const struct tail *tail, const wiggly_value *values, enum look look, struct pose *pose)
{
    static struct rig rig;
    struct rig *rigs[] = {&rig};
    struct document document = {.rigs = rigs, .rig_count = 1};
    const struct posing posing = {.document = &document, .look = look};
    struct by_hand hand = {0};
    static struct rig_pose posed;
    rig.kind = RIG_TAIL;
    rig.tail = *tail;
    if (values) memcpy(hand.input, values, (size_t)tail->channel_count * sizeof *values);
    assert_true(rig_pose(&posing, 0, 0, &hand, &posed));
    *pose = posed.strand;
}

#endif
