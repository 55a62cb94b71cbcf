"""The motion that a chain follows: that of a bone as the action alone moves it."""
import hashlib
import math
from . import chain as chains, curves, solve


known = {}  # armature, scene → (edits so far, stamp)


def stamp(owner, scene):
    """Differs once an action that moves the body does, or the frames."""
    key = owner.name_full, scene.name_full
    if known.get(key, (None,))[0] != solve.edits[0]:
        text = hashlib.sha1(f'{scene.frame_start} {scene.frame_end}'.encode())
        for mover in movers(owner):
            for track in mover.animation_data.nla_tracks if mover.animation_data else ():
                for strip in track.strips:
                    text.update(f'{strip.name} {strip.frame_start} {strip.frame_end} {strip.influence} {track.mute or strip.mute}'.encode())
            for curve in curves.list_of(mover) or ():
                if not curve.data_path.startswith('["') and '"].constraints["Wiggle ' not in curve.data_path:
                    text.update(f'{curve.data_path} {curve.array_index}'.encode() + curves.read(curve, curves.SHAPE))
        known[key] = solve.edits[0], text.hexdigest()
    return known[key][1]


def movers(owner):
    """The armature, what it is parented to, and the targets of its constraints."""
    cons = list(owner.constraints) + [con for bone in owner.pose.bones for con in bone.constraints]
    found, more = [], [owner] + [con.target for con in cons if getattr(con, 'target', None)]
    while more:
        each = more.pop()
        if each and each not in found:
            found.append(each)
            more.append(each.parent)
    return found


def stale(owner, scene):
    """Whether a followed motion is not the one of now, or a spline has other frames than the scene."""
    action = curves.action_of(owner)
    for spline in owner.wiggly.splines:
        first, last = frames_of(owner, spline, scene)
        if spline.first != first or spline.start == 'loop' and spline.last != last:
            return True
    return bool(action) and any(spline.follow != 'none' for spline in owner.wiggly.splines) and action.get(curves.STAMP) != stamp(owner, scene)


def frames_of(owner, spline, scene):
    """First and last frame: the scene's, or those of an action that loops."""
    action = curves.action_of(owner)
    if spline.start == 'loop' and action and action.use_frame_range:
        return tuple(map(round, action.frame_range))
    return scene.frame_start, scene.frame_end


def played(context, owner):
    """An armature at each frame of the scene. Time may be stretched, and actions have frames of their own."""
    scene, now = context.scene, (context.scene.frame_current, context.scene.frame_subframe)
    stretch = scene.render.frame_map_new / scene.render.frame_map_old
    try:
        for frame in range(scene.frame_start, scene.frame_end + 1):
            scene.frame_set(math.floor(frame * stretch), subframe=frame * stretch % 1)
            yield owner.evaluated_get(context.evaluated_depsgraph_get())
    finally:
        scene.frame_set(now[0], subframe=now[1])


def refresh(context, owner):
    """Reads what the owner's splines follow, by playing the scene once with the wiggle muted, and takes the scene's frames."""
    scene = context.scene
    wanted = []
    for spline in owner.wiggly.splines:
        spline.first, spline.last = frames_of(owner, spline, scene)
        if spline.follow == 'none':
            continue
        chain = chains.chain_of(owner, spline)
        bones = chain and chains.bones_of(owner, chain)
        bone = owner.pose.bones.get(spline.joint) if spline.joint else bones and bones[-1]
        if not bones or not bone:
            raise ValueError(f'"{spline.name}" follows the bone "{spline.joint}", which is not there')
        wanted.append((spline, bone.name, chains.axes_to_follow(owner, spline), []))
    if not wanted:
        return
    with chains.muted(owner):
        for seen in played(context, owner):
            for spline, name, axes, motion in wanted:
                motion.append(sample(seen, name, spline.follow, axes, motion))
    for spline, _, _, motion in wanted:
        values = [value for value, _ in motion]
        mean = (sum(values) - (values[0] + values[-1]) / 2) / max(len(values) - 1, 1)  # of a loop, too, whose ends are one
        curves.write(owner, spline, 'y', scene.frame_start, [spline.follow_gain * (value - mean) for value in values])
    solve.edits[0] += 1
    curves.action_of(owner)[curves.STAMP] = stamp(owner, scene)
    for chain in owner.wiggly.chains:
        chains.drive(owner, chain)


def sample(seen, name, of, axes, motion):
    """Value and state at a frame. A place is summed up along the object's axes as they turn with it."""
    bone = seen.pose.bones[name]
    if of == 'turn':
        side, along = axes.col[2], axes.col[1]
        after = bone.matrix.to_3x3() @ bone.bone.matrix_local.to_3x3().inverted() @ along
        across = side.cross(along)
        turn = math.degrees(math.atan2(after.dot(across), after.dot(along)))
        last = motion[-1][0] if motion else 0.0
        return turn + 360 * round((last - turn) / 360), None
    way = axes.col[2] if of == 'up' else axes.col[2].cross(axes.col[1])
    way = seen.matrix_world.to_3x3().normalized() @ way
    place = seen.matrix_world @ bone.head
    value, before = motion[-1] if motion else (0.0, place)
    return value + way.dot(place - before), place
