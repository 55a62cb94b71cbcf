"""Plain keyframes in place of a chain's bends."""
import math
from mathutils import Euler, Quaternion
from . import base, chain as chains, curves

LINEAR = 1  # of a keyframe's interpolation


def bake(context, owner, chain):
    """A copy of the action with a key of each bone at every frame of the scene; the chain is muted. The action itself stays."""
    scene = context.scene
    if not curves.list_of(owner):
        raise ValueError(f'"{owner.name}" has no action to bake into: set a key first')
    if chain.mute:
        raise ValueError(f'"{chain.name}" is muted: unmute it to bake it')
    bones = [bone for row in chains.all_rows_of(owner, chain) for bone in row]
    modes = [curve for curve in curves.list_of(owner) if curve.data_path.endswith('.rotation_mode')]
    driven = [each.data_path.rpartition('.rotation_')[0] for each in [*owner.animation_data.drivers, *modes]]
    frames = range(scene.frame_start, scene.frame_end + 1)
    held = [bone.path_from_id() in driven or any(not con.mute and con not in chains.constraints_of(bone, chain) for con in bone.constraints)
            for bone in bones]
    rows = [[] for _ in bones]
    for seen in base.played(context, owner):
        for bone, row, by_constraint in zip(bones, rows, held):
            row.append(angles(seen.pose.bones[bone.name], chain) if by_constraint else
                       turned(seen.pose.bones[bone.name], chain, row))
    copy_action(owner)
    for bone, row, by_constraint in zip(bones, rows, held):
        if by_constraint:
            con = keep(bone, chain)
            for axis, letter in enumerate('xyz'):
                write(owner, con.path_from_id(f'to_min_{letter}_rot'), 0, frames, [angle[axis] for angle in row])
        else:
            path = bone.path_from_id(channel_of(bone.rotation_mode))
            for index in range(len(row[0])):
                write(owner, path, index, frames, [value[index] for value in row])
    for channel in chain.channels:
        spline = owner.wiggly.splines[channel.spline]
        curves.drop(owner, curves.path_of(spline.name))
        curves.drop_samples(owner, spline)
    chain.mute = True


def copy_action(owner):
    old = owner.animation_data.action
    old.use_fake_user = True
    owner.animation_data.action = old.copy()
    owner.animation_data.action.name = f'{old.name} baked'


def angles(seen, chain):
    con = seen.constraints[chains.constraint_name(chain)]
    return con.to_min_x_rot, con.to_min_y_rot, con.to_min_z_rot


def channel_of(mode):
    return {'QUATERNION': 'rotation_quaternion', 'AXIS_ANGLE': 'rotation_axis_angle'}.get(mode, 'rotation_euler')


def turned(seen, chain, before):
    """The bone's own rotation with its bend, in its own mode, near the one before."""
    mode = seen.rotation_mode
    if mode == 'QUATERNION':
        turn = seen.rotation_quaternion.normalized()
    elif mode == 'AXIS_ANGLE':
        turn = Quaternion(seen.rotation_axis_angle[1:], seen.rotation_axis_angle[0])
    else:
        turn = seen.rotation_euler.to_quaternion()
    for con in chains.constraints_of(seen, chain):
        turn = turn @ Euler((con.to_min_x_rot, con.to_min_y_rot, con.to_min_z_rot), 'YXZ').to_quaternion()
    if mode == 'QUATERNION':
        if before:
            turn.make_compatible(Quaternion(before[-1]))
        return tuple(turn)
    if mode == 'AXIS_ANGLE':
        length = math.hypot(*turn[1:])
        return 2 * math.atan2(length, turn.w), *(x / (length or 1) for x in turn[1:])  # to_axis_angle() is coarse where little is turned
    return tuple(turn.to_euler(mode, Euler(before[-1], mode)) if before else turn.to_euler(mode))


def keep(bone, chain):
    """Copies of the chain's constraints beside them, without drivers: where constraints or drivers act, keys of the bone would not be the same."""
    main = None
    for con in chains.constraints_of(bone, chain):
        copy = bone.constraints.copy(con)
        copy.name = con.name.replace('Wiggle ', 'Baked ', 1)
        bone.constraints.move(len(bone.constraints) - 1, bone.constraints.find(con.name))
        copy = bone.constraints[con.name.replace('Wiggle ', 'Baked ', 1)]
        main = copy if con.name == chains.constraint_name(chain) else main
    return main


def write(owner, path, index, frames, values):
    curves.drop(owner, path, index)
    curve = curves.ensure(owner, path, index)
    curve.keyframe_points.add(len(values))
    curve.keyframe_points.foreach_set('co', [x for pair in zip(frames, values) for x in pair])
    curve.keyframe_points.foreach_set('interpolation', [LINEAR] * len(values))
    curve.update()
