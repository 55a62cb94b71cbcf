"""All kinds of rigs: rotation modes, constraints, IK, NLA, chains without a parent, scaled and turned objects."""
from common import *
from mathutils import Matrix

MODES = 'QUATERNION', 'AXIS_ANGLE', 'XYZ', 'XZY', 'YXZ', 'YZX', 'ZXY', 'ZYX'


def local(rig, name):
    seen = rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones[name]
    return rig.convert_space(pose_bone=seen, matrix=seen.matrix, from_space='POSE', to_space='LOCAL').to_3x3().normalized()


def turns_over(rig, what, name='tail_2'):
    """A bone's wiggle is the same turn, in its own space, whatever turned it before."""
    frames = (5, 17, 33)
    chain, off, most = rig.wiggly.chains[0], 0, 0
    for frame in frames:
        bpy.context.scene.frame_set(frame)
        chain.mute = False
        bpy.context.view_layer.update()
        with_it = local(rig, name)
        chain.mute = True
        bpy.context.view_layer.update()
        turn = local(rig, name).inverted() @ with_it
        values = [c.evaluate(frame) for c in (curves.part(rig, s, p) for s in rig.wiggly.splines for p in ('re', 'im'))]
        angles = []
        for channel, (re, im) in zip(chain.channels, (values[:2], values[2:])):
            n = int(name[-1]) - 1
            lag = math.radians(n * channel.lag)
            angles.append(math.radians(channel.gain) * (re * math.cos(lag) + im * math.sin(lag)))
        into = rig.data.bones[name].matrix_local.to_3x3().inverted() @ chains.axes_at_rest(rig, chain, chains.bones_of(rig, chain))
        want = into @ Matrix.Rotation(angles[0], 3, 'Z') @ Matrix.Rotation(angles[1], 3, 'X') @ into.inverted()
        off = max([off] + [abs(a - b) for x, y in zip(turn, want) for a, b in zip(x, y)])
        most = max(most, abs(angles[0]))
    chain.mute = False
    ok(what, off < 5e-6 and most > 0.1, off, most)


def wagging(bend=0.3, **options):
    rig = fresh(bend=bend, **options)
    add(rig, follow=False)
    key(rig, 'tail side', (10, 1), (30, -0.5))
    key(rig, 'tail up', (5, 0.3), (20, -0.5))
    return rig


def modes():
    for mode in MODES:
        rig = wagging()
        bone = rig.pose.bones['tail_2']
        bone.rotation_mode = mode
        bone.matrix_basis = Matrix.Rotation(0.5, 4, 'X') @ Matrix.Rotation(0.7, 4, 'Z')
        turns_over(rig, f'over {mode}')


def objects():
    rig = fresh(bend=0.3)
    rig.matrix_world = Matrix.Translation((1, 2, 3)) @ Matrix.Rotation(0.5, 4, 'X') @ Matrix.Rotation(0.7, 4, 'Z') @ Matrix.Scale(2, 4)
    bpy.context.view_layer.update()
    add(rig, follow=False)
    key(rig, 'tail side', (10, 1), (30, -0.5))
    turns_over(rig, 'over a turned and scaled object')


def constraints():
    rig = wagging()
    bone = rig.pose.bones['tail_2']
    con = bone.constraints.new('COPY_ROTATION')
    con.target, con.subtarget, con.influence = rig, 'root', 0.5
    con.owner_space = con.target_space = 'LOCAL'
    bone.constraints.move(len(bone.constraints) - 1, 0)
    rig.pose.bones['root'].matrix_basis = Matrix.Rotation(0.5, 4, 'X')
    turns_over(rig, 'over a constraint')


def ik():
    """IK on the legs above a tail, and IK on the chain itself: no cycle, the same in any order."""
    rig = wagging(bones=6)
    goal = bpy.data.objects.new('goal', None)
    bpy.context.scene.collection.objects.link(goal)
    for frame, place in ((1, (0.3, 0.8, 0.4)), (40, (-0.3, 0.6, 0.7))):
        goal.location = place
        goal.keyframe_insert('location', frame=frame)
    con = rig.pose.bones['tail_3'].constraints.new('IK')
    con.target, con.chain_count = goal, 3
    frames = [3, 9, 21, 40]
    forwards = poses(rig, frames)
    ok('IK on the chain: any order is the same', poses(rig, frames[::-1]) == forwards)
    rig.wiggly.chains[0].mute = True
    ok('and bones past it wiggle', apart(poses(rig, frames), forwards) > 0.05)
    rig.wiggly.chains[0].mute = False
    turns_over(rig, 'bones past IK turn over it', 'tail_5')


def without_parent():
    rig = fresh()
    bpy.ops.object.mode_set(mode='EDIT')
    rig.data.edit_bones.remove(rig.data.edit_bones['root'])
    bpy.ops.object.mode_set(mode='POSE')
    select(rig, 'tail_1')
    try:
        bpy.ops.wiggly.add(follow=False)
        ok('a chain alone in a scene is refused', False)
    except RuntimeError as problem:
        ok('a chain alone in a scene is refused', 'add any object to the scene' in str(problem), problem)
    ok('and nothing is left of it', not settings.of(rig) or not rig.wiggly.chains)
    skin = bpy.data.objects.new('skin', bpy.data.meshes.new('skin'))
    bpy.context.scene.collection.objects.link(skin)
    skin.parent = rig
    skin.modifiers.new('rig', 'ARMATURE').object = rig
    add(rig, follow=False)
    key(rig, 'tail side', (10, 1), (30, -0.5))
    turns_over(rig, 'a chain without a parent', 'tail_1')


def long_names():
    rig = fresh(bend=0.3)
    rig.data.bones['tail_1'].name = 'ä"' * 20
    add(rig, rig.pose.bones[1].name, follow=False)
    chain = rig.wiggly.chains[0]
    ok('names may be long and strange', len(chains.bones_of(rig, chain)) == 4)
    key(rig, chain.channels[0].spline, (10, 1))
    ok('and move', abs(local(rig, 'tail_2').to_euler().z) >= 0 and curves.part(rig, rig.wiggly.splines[0], 're').evaluate(10) == 1)
    bpy.ops.wiggly.remove()
    ok('and go', not rig.animation_data)


def nla():
    rig = wagging()
    frames = [3, 9, 21, 40]
    before = poses(rig, frames)
    animation = rig.animation_data
    action, slot = animation.action, getattr(animation, 'action_slot', None)
    strip = animation.nla_tracks.new().strips.new('wag', 1, action)
    strip.action_frame_start, strip.frame_start = 1, 1
    strip.action_frame_end = strip.frame_end = 60
    if slot:
        strip.action_slot = slot
    animation.action = None
    bpy.context.view_layer.update()
    ok('in a strip', apart(poses(rig, frames), before) < 1e-6, apart(poses(rig, frames), before))
    strip.frame_start, strip.frame_end = 11, 70
    bpy.context.view_layer.update()
    shifted = poses(rig, [frame + 10 for frame in frames])
    ok('in a strip that was moved', apart({f: shifted[f + 10] for f in frames}, before) < 1e-6)


def many_actions():
    rig = wagging()
    first, before = rig.animation_data.action, poses(rig, [3, 9])
    rig.animation_data.action = None
    key(rig, 'tail side', (9, 0.2))
    ok('another action has keys of its own', apart(poses(rig, [3, 9]), before) > 0.01)
    rig.animation_data.action = first
    if curves.LAYERED:
        rig.animation_data.action_slot = rig.animation_data.action_suitable_slots[0]
    bpy.context.view_layer.update()
    ok('and the first one keeps its own', poses(rig, [3, 9]) == before)


main(modes, objects, constraints, ik, without_parent, long_names, nla, many_actions)
