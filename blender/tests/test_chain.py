"""A chain: keys are hit, edits are followed, frames may come in any order."""
import random
from common import *


def keys_are_hit():
    rig = fresh()
    chain = add(rig, follow=False)
    ok('a chain of four bones', [bone.name for bone in chains.bones_of(rig, chain)] == [f'tail_{n}' for n in (1, 2, 3, 4)])
    curve = key(rig, 'tail side', (10, 1), (30, -0.5))
    bpy.context.scene.frame_set(10)
    gain = chain.channels[0].gain
    ok('the first bone is at its key', abs(bend(rig, 'tail_1')[2] / gain - 1) < 1e-5, bend(rig, 'tail_1'), gain)
    ok('the last one lags', abs(bend(rig, 'tail_4')[2] / gain - 1) > 0.1)
    curve.keyframe_points[1].co[1] = -2
    curve.update()
    bpy.context.view_layer.update()
    bpy.context.scene.frame_set(30)
    ok('an edited key is followed', abs(bend(rig, 'tail_1')[2] / gain + 2) < 2e-5, bend(rig, 'tail_1'))


def any_order():
    rig = fresh(bend=0.3)
    rig.pose.bones['tail_2'].rotation_mode = 'XYZ'
    add(rig, follow=False)
    key(rig, 'tail side', (10, 1), (30, -0.5))
    key(rig, 'tail up', (5, 0.3), (20, -0.5))
    frames = [f / 2 for f in range(2, 120)]
    forwards = poses(rig, frames)
    ok('it moves', apart({1: forwards[1.0]}, {1: forwards[15.0]}) > 0.1)
    ok('backwards is the same', poses(rig, frames[::-1]) == forwards)
    random.Random(1).shuffle(frames)
    ok('any order is the same', poses(rig, frames) == forwards)


main(keys_are_hit, any_order)
