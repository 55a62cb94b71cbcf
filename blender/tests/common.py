"""What the tests share: the add-on from the source tree, a rig, and cases."""
import math
import os
import sys
import traceback
import bpy

here = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(here))
import wiggly_blender
from wiggly_blender import chain as chains, curves, settings, solve

failed = 0


def ok(what, good, *more):
    global failed
    print(('ok - ' if good else 'not ok - ') + what, *(() if good else more), flush=True)
    failed += not good


def fresh(bones=4, frames=(1, 60), bend=0.0, object_name='Rig'):
    """An empty file with a row of bones along +y, over a mesh."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.render.fps = *frames, 24
    data = bpy.data.armatures.new(object_name)
    rig = bpy.data.objects.new(object_name, data)
    scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    above = data.edit_bones.new('root')
    above.head, above.tail = (0, -1, 0), (0, 0, 0)
    for n in range(bones):
        bone = data.edit_bones.new(f'tail_{n + 1}')
        bone.head, bone.parent = above.tail, above
        bone.tail = bone.head + type(bone.head)((0, 0.2, 0.2 * bend * n))
        bone.roll = bend
        above = bone
    bpy.ops.object.mode_set(mode='POSE')
    return rig


def select(rig, *names):
    for bone in rig.pose.bones:
        chosen = bone if hasattr(bone, 'select') else bone.bone
        chosen.select = bone.name in names


def add(rig, first='tail_1', **options):
    select(rig, first)
    bpy.ops.wiggly.add(**options)
    return rig.wiggly.chains[-1]


def key(rig, name, *points):
    """Sets keys (frame, value) of a spline, as the Graph Editor would."""
    curve = curves.ensure(rig, curves.path_of(name))
    for frame, value in points:
        curve.keyframe_points.insert(frame, value)
    curve.update()
    bpy.context.view_layer.update()
    return curve


def bend(rig, bone):
    """By how much a bone is turned over its own rotation, as a rotation vector in degrees."""
    seen = rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones[bone]
    local = rig.convert_space(pose_bone=seen, matrix=seen.matrix, from_space='POSE', to_space='LOCAL')
    turn = (seen.matrix_basis.inverted() @ local).to_quaternion()
    length = math.hypot(*turn[1:])
    return [math.degrees(2 * math.atan2(length, turn.w)) * x / (length or 1) for x in turn[1:]]  # to_axis_angle() is coarse where little is turned


def poses(rig, frames):
    """All pose matrices at frames, as numbers."""
    found = {}
    for frame in frames:
        bpy.context.scene.frame_set(math.floor(frame), subframe=frame % 1)
        seen = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
        found[frame] = [x for bone in seen.pose.bones for row in bone.matrix for x in row]
    return found


def apart(a, b):
    return max(abs(x - y) for frame in a for x, y in zip(a[frame], b[frame]))


def main(*tests):
    global failed
    wiggly_blender.register()
    for test in tests:
        try:
            test()
        except Exception:
            traceback.print_exc()
            ok(test.__name__, False)
    print(f'Blender {bpy.app.version_string}: {failed} failed', flush=True)
    os._exit(failed > 0)
