"""What animators do to a rig that wiggles: a right result or one sentence, and nothing left behind."""
import json
import tempfile
from common import *
from wiggly_blender import prop


def fails(words, call, *arguments, **options):
    try:
        call(*arguments, **options)
    except (RuntimeError, ValueError) as problem:
        return ok(f'says: {words}', words in str(problem) and 'Traceback' not in str(problem), problem)
    ok(f'says: {words}', False)


def update():
    bpy.context.view_layer.update()


def edit(rig, change):
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='EDIT')
    change(rig.data.edit_bones)
    bpy.ops.object.mode_set(mode='POSE')
    update()


def wagging(**options):
    rig = fresh(**options)
    add(rig, follow=False)
    key(rig, 'tail side', (10, 1), (30, -0.5))
    return rig


def values(rig, name='tail side', frames=range(1, 61), part='re'):
    curve = curves.part(rig, rig.wiggly.splines[name], part)
    return [curve.evaluate(frame) for frame in frames]


def shared_action():
    rig = wagging()
    before = values(rig)
    bpy.ops.object.mode_set(mode='OBJECT')
    other = rig.copy()
    bpy.context.scene.collection.objects.link(other)
    update()
    ok('linked duplicates share an action', other.animation_data.action == rig.animation_data.action)
    other.wiggly.splines['tail side'].frequency *= 2
    update()
    said = [solve.problems.get(solve.key_of(each, each.wiggly.splines['tail side'])) for each in (rig, other)]
    ok('one of them rules, and the other says so', sum('shared' in (text or '') for text in said) == 1, said)
    rig = fresh()
    edit(rig, lambda bones: setattr(bones.new('ear'), 'tail', (0, 0, 1)))
    other = rig.copy()
    bpy.context.scene.collection.objects.link(other)
    rig.animation_data_create().action = bpy.data.actions.new('both')
    add(rig, follow=False)
    other.animation_data_create().action = rig.animation_data.action
    if curves.LAYERED:
        other.animation_data.action_slot = rig.animation_data.action_slot
    key(rig, 'tail side', (10, 1), (30, -0.5))
    before = poses(rig, [5, 20])
    bpy.ops.object.mode_set(mode='OBJECT')
    bpy.context.view_layer.objects.active = other
    bpy.ops.object.mode_set(mode='POSE')
    chain = add(other, 'ear', follow=False)
    key(other, chain.channels[0].spline, (10, 2))
    ok('another chain with the same action leaves the first alone', poses(rig, [5, 20]) == before)


def bones_deleted():
    rig = wagging(bones=5)
    edit(rig, lambda bones: bones.remove(bones['tail_3']))
    key(rig, 'tail side', (20, 1))
    bpy.context.scene.frame_set(20)
    ok('a chain goes on without a bone', abs(bend(rig, 'tail_4')[2]) > 1)
    bpy.ops.wiggly.bake()
    bpy.ops.wiggly.remove()
    ok('and goes', not [d.data_path for d in rig.animation_data.drivers], [d.data_path for d in rig.animation_data.drivers])
    rig = wagging()
    edit(rig, lambda bones: bones.remove(bones['root']))
    bpy.context.scene.frame_set(10)
    ok('or without what is above it', abs(bend(rig, 'tail_1')[2]) > 1, bend(rig, 'tail_1'))
    rig = wagging()
    fails('No such file', bpy.ops.wiggly.export_scene, filepath='/proc/a.json')
    edit(rig, lambda bones: [bones.remove(bones[f'tail_{n}']) for n in (1, 2, 3, 4)])
    for call in (bpy.ops.wiggly.bake, lambda: bpy.ops.wiggly.export_scene(filepath=os.path.join(tempfile.mkdtemp(), 'a.json'))):
        fails('has no bones', call)
    bpy.ops.wiggly.remove()
    ok('a chain whose bones are gone goes too', not rig.animation_data and not settings.of(rig),
       [d.data_path for d in rig.animation_data.drivers] if rig.animation_data else 0)


def bone_inserted():
    rig = wagging()

    def split(bones):
        new = bones.new('between')
        new.head, new.tail, new.parent = bones['tail_2'].tail, bones['tail_3'].head + type(new.head)((0, 0, 0.1)), bones['tail_2']
        bones['tail_3'].parent = new
    edit(rig, split)
    rig.wiggly.chains[0].channels[0].gain *= 2
    update()
    bpy.context.scene.frame_set(10)
    ok('a bone put between stays', abs(bend(rig, 'between')[2]) < 1e-4 and abs(bend(rig, 'tail_3')[2]) > 1)
    bpy.ops.wiggly.remove()
    select(rig, 'tail_1')
    ok('until the chain is added anew', len(chains.bones_of(rig, add(rig, follow=False))) == 5)


def copied_constraints():
    rig = wagging(bend=0.2)
    edit(rig, lambda bones: setattr(bones.new('ear'), 'tail', (0, 0, 1)))
    before = poses(rig, [10, 20])
    for con in rig.pose.bones['tail_2'].constraints:
        rig.pose.bones['ear'].constraints.copy(con)
    rig.wiggly.chains[0].channels[0].gain += 1
    rig.wiggly.chains[0].channels[0].gain -= 1
    update()
    now = poses(rig, [10, 20])
    tails = [{f: p[16:80] for f, p in each.items()} for each in (before, now)]
    ok('constraints copied to another bone leave the chain alone', apart(*tails) < 1e-5, apart(*tails))
    ok('in which that bone is not', len(chains.bones_of(rig, rig.wiggly.chains[0])) == 4)
    chain = add(rig, 'ear', follow=False)
    ok('and can wiggle by itself', [b.name for b in chains.bones_of(rig, chain)] == ['ear'] and len(rig.pose.bones['ear'].constraints) in (1, 3),
       list(rig.pose.bones['ear'].constraints.keys()))


def renamed():
    rig = wagging()
    before = poses(rig, [5, 20])
    rig.name = 'Another "name"'
    key(rig, 'tail side', (10, 1))
    ok('a renamed object moves on', poses(rig, [5, 20]) == before)
    del rig['tail side']
    curves.find(rig, '["tail side"]').data_path = '["wag"]'
    rig['wag'] = 0.0
    rig.location.x = 1
    update()
    said = solve.problems.get(solve.key_of(rig, rig.wiggly.splines[0]))
    ok('a renamed property is missed', 'tail side' in (said or ''), said)
    bpy.context.scene.frame_set(12)
    bpy.ops.wiggly.key()
    ok('until there is a new one', not solve.problems[solve.key_of(rig, rig.wiggly.splines[0])])
    del rig[curves.SAMPLES]
    bpy.ops.wiggly.remove()
    ok('and all goes', not settings.of(rig))


def action_gone():
    rig = wagging()
    bpy.data.actions.remove(rig.animation_data.action)
    update()
    bpy.ops.wiggly.key()
    update()
    ok('a key after the action was deleted', len(curves.find(rig, '["tail side"]').keyframe_points) == 1)
    rig = wagging()
    if curves.LAYERED:
        rig.animation_data.action_slot = None
        rig.location.x = 1
        update()
        ok('a slot that is taken away stays away', not rig.animation_data.action_slot)
        slot = rig.animation_data.action.slots.new('OBJECT', 'second')
        rig.animation_data.action_slot = slot
        update()
        key(rig, 'tail side', (10, 2))
        ok('a second slot has keys of its own', abs(values(rig)[9] - 2) < 1e-6)
        rig.animation_data.action_slot = rig.animation_data.action.slots[0]
        update()
        ok('and the first keeps its own', abs(values(rig)[9] - 1) < 1e-6)


def frames():
    rig = wagging()
    curve = curves.find(rig, '["tail side"]')
    curve.keyframe_points[1].co[0] = 10
    curve.update()
    update()
    ok('keys moved onto one frame', all(abs(v) < 100 for v in values(rig)))
    for name, start, end, keys, fps, base in (
            ('one frame', 5, 5, ((5, 1),), 24, 1), ('29.97', 1, 60, ((10, 1), (33, -0.5)), 30, 1.001), ('negative', 1, 60, ((-20, 1), (-3, -1)), 24, 1),
            ('subframes', 1, 60, ((10.3, 1), (10.4, -1), (30.7, 2)), 24, 1), ('ten thousand', 1, 10000, ((10, 1), (9000, -1)), 24, 1)):
        for follow, loop in ((False, False), (True, False), (False, True)):
            if loop and name == 'negative':
                continue
            rig = fresh(frames=(start, end))
            if follow and end > 5000:
                continue
            bpy.context.scene.render.fps, bpy.context.scene.render.fps_base = fps, base
            add(rig, follow=follow, loop=loop)
            key(rig, 'tail side', *keys)
            found = values(rig, frames=[k for k, _ in keys])
            off = max(abs(a - b) for a, (k, b) in zip(found, keys) if k == int(k)) if keys[0][0] == int(keys[0][0]) else 0
            said = solve.problems.get(solve.key_of(rig, rig.wiggly.splines[0]))
            ok(f'{name} {follow} {loop}', off < 2e-6 and all(abs(v) < 100 for v in values(rig)), off, found, said)
            for kind in ('KEYFRAME', 'EXTREME', 'MOVING_HOLD'):
                for frame in (start, end):
                    bpy.context.scene.frame_set(frame)
                    bpy.ops.wiggly.key(kind=kind)
                    update()
            ok(f'{name} {follow} {loop}: keys at the ends', all(abs(v) < 100 for v in values(rig)))


def problem_of(rig, name='tail side'):
    return solve.problems.get(solve.key_of(rig, rig.wiggly.splines[name])) or ''


def far_frames():
    """Whatever a number is, each later edit goes on: what is wrong is said, and the rest is solved."""
    rig = wagging()
    before = values(rig)
    curve = curves.find(rig, '["tail side"]')
    for what, frame, value in (('far', 1e9, 1), ('farther', -1e30, 1), ('at no frame', math.inf, 0), ('without a value', 20, math.nan)):
        point = curve.keyframe_points.insert(25, 0)
        point.co = frame, value
        curve.update()
        update()
        said = problem_of(rig)
        ok(f'a key that is {what} is said to be wrong', said and 'Traceback' not in said, said)
        key(rig, 'tail up', (10, 1))
        ok('and other keys are followed', abs(values(rig, 'tail up')[9] - 1) < 1e-6 and not problem_of(rig, 'tail up'), problem_of(rig, 'tail up'))
        curve.keyframe_points.remove(next(each for each in curve.keyframe_points if each.co[0] not in (10, 30)))
        curve.update()
        update()
        ok('without it all is as before', values(rig) == before and not problem_of(rig), problem_of(rig))
    spline = rig.wiggly.splines['tail side']
    spline.last = 2000000000
    update()
    ok('a last frame ends where frames of Blender do', 'expected 1000000 at most' in problem_of(rig) and spline.last == settings.FARTHEST, problem_of(rig))
    spline.last = 60
    for more in ('{', '[]', '{"limits": [1]}', '{"limits": ["a", 1]}', '{"variation": 5}', '{"passive": "no"}'):
        spline.more = more
        rig.location.x += 1
        update()
        ok(f'{more}: is said to be wrong', problem_of(rig), problem_of(rig))
    spline.more = '{"limits": [-9, 9]}'
    bpy.context.scene.frame_end = 30000
    update()
    ok('a curve between limits is shorter', 'expected 20000 at most' in problem_of(rig), problem_of(rig))


def two_keys_on_one_frame():
    rig = wagging()
    curve = key(rig, 'tail side', (10.3, 0.2))
    ok('keys that share a frame are named', 'Keys at 10 and 10.3 are at one frame' in problem_of(rig) and abs(values(rig)[9] - 0.2) < 1e-6, problem_of(rig))
    curve.keyframe_points[1].co[1] = 1
    curve.update()
    update()
    ok('but not if they are alike', not problem_of(rig), problem_of(rig))
    rig = fresh(frames=(1, 49))
    add(rig, follow=False, loop=True)
    key(rig, 'tail side', (1, 1), (49, -1))
    ok('the last frame of a loop is its first', 'Keys at 1 and 49 are at one frame' in problem_of(rig), problem_of(rig))


def unlinked():
    rig = wagging(bend=0.2)
    bpy.context.scene.frame_set(14)
    rest = poses(rig, [14])
    action, slot = rig.animation_data.action, getattr(rig.animation_data, 'action_slot', None)
    rig.wiggly.chains[0].mute = True
    update()
    still = poses(rig, [14])
    rig.wiggly.chains[0].mute = False
    rig.animation_data.action = None
    update()
    update()
    ok('a bend goes with its action', apart(poses(rig, [14]), still) < 1e-6 and apart(rest, still) > 0.01, apart(poses(rig, [14]), still))
    rig.animation_data.action = action
    if slot:
        rig.animation_data.action_slot = slot
    update()
    ok('and comes back with it', poses(rig, [14]) == rest)
    strip = rig.animation_data.nla_tracks.new().strips.new('wag', 1, action)
    if slot:
        strip.action_slot = slot
    rig.animation_data.action = None
    update()
    ok('a strip keeps it', apart(poses(rig, [14]), rest) < 1e-6, apart(poses(rig, [14]), rest))
    rig.animation_data.nla_tracks[0].mute = True
    update()
    update()
    ok('until it is muted', apart(poses(rig, [14]), still) < 1e-6, apart(poses(rig, [14]), still))


def joined(name='tail', first=True):
    """A rig, with a chain or without, into which another one with a chain was joined."""
    rig = wagging() if first else fresh()
    bpy.ops.object.mode_set(mode='OBJECT')
    other = bpy.data.objects.new('Other', bpy.data.armatures.new('Other'))
    bpy.context.scene.collection.objects.link(other)

    def build(bones):
        above = bones.new('root')
        above.head, above.tail = (1, -1, 0), (1, 0, 0)
        for n in range(4):
            bone = bones.new(f'{name}_{n + 1}')
            bone.head, bone.parent = above.tail, above
            bone.tail = bone.head + type(bone.head)((0, 0.2, 0))
            above = bone
    edit(other, build)
    add(other, f'{name}_1', follow=False)
    key(other, f'{name} side', (20, 1))
    bpy.ops.object.mode_set(mode='OBJECT')
    for each in bpy.data.objects:
        each.select_set(True)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.join()
    update()
    bpy.ops.object.mode_set(mode='POSE')
    return rig


def joined_rigs():
    rig = joined()
    rig.wiggly.chains[0].channels[0].lag *= 1.5
    update()
    for frame in (10, 14, 22):
        bpy.context.scene.frame_set(frame)
        off = max(abs(a - b) for n in (1, 2, 3, 4) for a, b in zip(bend(rig, f'tail_{n}'), bend(rig, f'tail_{n}.001')))
        ok(f'both tails of joined rigs lag alike at frame {frame}', off < 1e-3 and abs(bend(rig, 'tail_4')[2]) > 0.5, off, bend(rig, 'tail_4'))
    path = os.path.join(tempfile.mkdtemp(), 'joined.json')
    bpy.ops.wiggly.export_scene(filepath=path)
    rows = [(each['name'], each['from'], each['to']) for each in json.load(open(path))['rigs'][1:]]
    ok('and are two chains of a scene', rows == [('tail', 'tail_1', 'tail_4'), ('tail 2', 'tail_1.001', 'tail_4.001')], rows)
    live = poses(rig, range(1, 61))
    bpy.ops.wiggly.bake()
    update()
    ok('both are baked', apart(live, poses(rig, range(1, 61))) < 2e-6, apart(live, poses(rig, range(1, 61))))
    for first in (True, False):
        rig = joined('ear', first)
        bpy.context.scene.frame_set(14)
        ok('a chain that a joined rig lost its settings of rests', max(map(abs, bend(rig, 'ear_1') + bend(rig, 'ear_4'))) < 1e-3, bend(rig, 'ear_4'))
        select(rig, 'ear_1')
        fails('already wiggles: remove that first', bpy.ops.wiggly.add)
        bpy.ops.wiggly.remove()
        ok('and can be removed', not rig.pose.bones['ear_1'].constraints and len(rig.wiggly.chains) == first)
        chain = add(rig, 'ear_1', follow=False)
        key(rig, chain.channels[0].spline, (14, 1))
        bpy.context.scene.frame_set(14)
        ok('and added anew', abs(bend(rig, 'ear_1')[2]) > 1, bend(rig, 'ear_1'))


def remapped():
    rig = fresh()
    for frame, x in ((1, 0), (20, 0), (26, 1), (60, 1)):
        rig.pose.bones['root'].location.x = x
        rig.pose.bones['root'].keyframe_insert('location', index=0, frame=frame)
    add(rig)
    before = values(rig, part='y')
    bpy.context.scene.render.frame_map_new = 200
    bpy.ops.wiggly.refresh()
    ok('stretched time is read as it is keyed', max(abs(a - b) for a, b in zip(values(rig, part='y'), before)) < 1e-4)


def moved_strip():
    rig = fresh()
    for frame, x in ((1, 0), (20, 0), (26, 1), (60, 1)):
        rig.pose.bones['root'].location.x = x
        rig.pose.bones['root'].keyframe_insert('location', index=0, frame=frame)
    strip = rig.animation_data.nla_tracks.new().strips.new('body', 1, rig.animation_data.action)
    rig.animation_data.action = None
    add(rig)
    update()
    from wiggly_blender import base
    ok('the motion of a strip is read', not base.stale(rig, bpy.context.scene) and max(values(rig, part='y')) > 0.5)
    strip.frame_start = 10
    rig.location.x = 1
    update()
    ok('and stale once the strip is moved', base.stale(rig, bpy.context.scene))


def stretch_baked():
    rig = wagging()
    bpy.context.scene.render.frame_map_new = 200
    frames = range(1, 61)
    live = poses(rig, frames)
    bpy.ops.wiggly.bake()
    ok('and baked so', apart(live, poses(rig, frames)) < 0.02, apart(live, poses(rig, frames)))


def bake_driven():
    rig = fresh()
    bone = rig.pose.bones['tail_2']
    bone.rotation_mode = 'XYZ'
    bone.driver_add('rotation_euler', 0).driver.expression = '0.3'
    add(rig, follow=False)
    key(rig, 'tail up', (10, 1), (30, -0.5))
    frames = range(1, 61)
    live = poses(rig, frames)
    bpy.ops.wiggly.bake()
    update()
    ok('a driven bone is baked over its driver', apart(live, poses(rig, frames)) < 2e-6, apart(live, poses(rig, frames)))
    fails('is muted', bpy.ops.wiggly.bake)
    ok('baked twice, it stays', apart(live, poses(rig, frames)) < 2e-6)


def bake_turns():
    rig = fresh()
    bone = rig.pose.bones['tail_2']
    add(rig, follow=False)
    key(rig, 'tail side', (10, 1), (30, -0.5))
    for frame, mode in ((1, 'QUATERNION'), (20, 'XYZ')):
        bone.rotation_mode = mode
        bone.keyframe_insert('rotation_mode', frame=frame)
    bone.rotation_euler.x = 0.5
    live = poses(rig, range(1, 61))
    bpy.ops.wiggly.bake()
    update()
    ok('a bone whose rotation mode has keys is baked', apart(live, poses(rig, range(1, 61))) < 2e-6)


def strips():
    rig = wagging()
    animation = rig.animation_data
    strip = animation.nla_tracks.new().strips.new('wag', 1, animation.action)
    if curves.LAYERED:
        strip.action_slot = animation.action_slot
    animation.action = None
    bpy.context.scene.frame_set(14)
    was = bend(rig, 'tail_1')[2]
    bpy.ops.wiggly.key()
    update()
    ok('a key over a strip keeps what is seen', abs(bend(rig, 'tail_1')[2] - was) < 1e-4 and abs(was) > 1, bend(rig, 'tail_1'), was)
    rig = wagging()
    bpy.context.scene.frame_set(12, subframe=0.6)
    bpy.ops.wiggly.key()
    ok('keys go to whole frames', [point.co[0] for point in curves.find(rig, '["tail side"]').keyframe_points] == [10, 13, 30])


def channels():
    rig = wagging()
    before = values(rig)
    curve = curves.find(rig, '["tail side"]')
    curve.mute = True
    update()
    ok('muted keys do nothing', max(map(abs, values(rig))) < 1e-6)
    curve.mute = False
    update()
    ok('until they are back', values(rig) == before)
    curve.lock = True
    fails('"tail side" is locked', bpy.ops.wiggly.key)
    curve.lock = False
    curve.modifiers.new('NOISE')
    curve.update()
    rig.location.x = 1
    update()
    said = solve.problems.get(solve.key_of(rig, rig.wiggly.splines[0]))
    ok('modifiers are said to do nothing', 'odifier' in (said or ''), said)


def pose_keys():
    rig = wagging()
    curve = curves.find(rig, '["tail side"]')
    curve.keyframe_points[1].type = 'EXTREME'
    curve.update()
    update()
    held = values(rig, part='im')[29]
    point = curve.keyframe_points[1]
    copy = curve.keyframe_points.insert(45, point.co[1])
    point = curve.keyframe_points[1]
    copy.type, copy.back, copy.period = point.type, point.back, point.period
    curve.update()
    update()
    ok('a pose copied to another frame', abs(values(rig, part='im')[44] - held) < 1e-6, values(rig, part='im')[44], held)


def undone():
    rig = wagging()
    bpy.context.preferences.edit.use_global_undo = True
    bpy.ops.ed.undo_push(message='start')
    before = poses(rig, [5, 20])
    rig.wiggly.splines['tail side'].frequency = 3
    update()
    changed = poses(rig, [5, 20])
    bpy.ops.ed.undo_push(message='frequency')
    bpy.ops.ed.undo()
    update()
    rig = bpy.data.objects['Rig']
    ok('undo of a setting', poses(rig, [5, 20]) == before and apart(before, changed) > 0.01, apart(poses(rig, [5, 20]), before))
    bpy.ops.wiggly.remove()
    bpy.ops.ed.undo_push(message='remove')
    bpy.ops.ed.undo()
    update()
    rig = bpy.data.objects['Rig']
    ok('undo of Remove', settings.of(rig) and poses(rig, [5, 20]) == before)
    key(rig, 'tail side', (20, 2))
    ok('which can be edited', apart(poses(rig, [5, 20]), before) > 0.1)


def properties():
    fresh()
    bpy.ops.object.mode_set(mode='OBJECT')
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.object
    cube.shape_key_add(name='Basis')
    fat = cube.shape_key_add(name='fat')
    keys = cube.data.shape_keys
    path = 'key_blocks["fat"].value'
    prop.add(keys, path, 0)
    fat.name = 'thin'
    prop.remove(keys, 'key_blocks["thin"].value', 0)
    ok('a renamed shape key gets its keys back', not settings.of(keys) and not keys.animation_data)
    prop.add(keys, 'key_blocks["thin"].value', 0)
    cube.shape_key_remove(fat)
    cube.shape_key_add(name='more')
    keys = cube.data.shape_keys
    keys.wiggly.splines[0].frequency = 2
    update()
    with bpy.context.temp_override(wiggly_owner=keys):
        bpy.ops.wiggly.property_remove(spline=keys.wiggly.splines[0].name)
    ok('what moved a deleted shape key can go', not settings.of(keys))
    modifier = cube.modifiers.new('wave', 'WAVE')
    prop.add(cube, 'modifiers["wave"].height', 0)
    cube.modifiers.remove(modifier)
    cube.location.x = 1
    update()
    with bpy.context.temp_override(wiggly_owner=cube):
        bpy.ops.wiggly.property_remove(spline=cube.wiggly.splines[0].name)
    ok('and what moved a deleted modifier', not settings.of(cube) and not cube.animation_data)
    names = 'Basis', 'up.re', 'up.im'
    for name in names[1:]:
        cube.shape_key_add(name=name)
    bpy.ops.wiggly.shapes()
    keys.key_blocks['up.re'].name = 'left.re'
    rig = cube
    rig.location.x = 2
    update()
    bpy.ops.wiggly.shapes(remove=True)
    ok('and renamed pairs', not settings.of(keys) and not keys.animation_data)
    keys.key_blocks['left.re'].name = 'up.re'
    keys.key_blocks['up.im'].driver_add('value').driver.expression = '0.5'
    fails('"up.im" has a driver', bpy.ops.wiggly.shapes)
    ok('which stays', not settings.of(keys) and [d.driver.expression for d in keys.animation_data.drivers] == ['0.5'])
    prop.add(cube, 'location', 1)
    cube.animation_data.action = None
    fails('has no keys', prop.make_keys, cube, 'location', 1)


def overrides():
    rig = wagging()
    bpy.ops.object.mode_set(mode='OBJECT')
    group = bpy.data.collections.new('Group')
    bpy.context.scene.collection.children.link(group)
    group.objects.link(rig)
    path = os.path.join(tempfile.mkdtemp(), 'library.blend')
    bpy.ops.wm.save_as_mainfile(filepath=path)
    fresh(object_name='Other')
    bpy.ops.object.mode_set(mode='OBJECT')
    with bpy.data.libraries.load(path, link=True) as (_, to):
        to.collections = ['Group']
    scene = bpy.context.scene
    empty = bpy.data.objects.new('instance', None)
    empty.instance_type, empty.instance_collection = 'COLLECTION', to.collections[0]
    scene.collection.objects.link(empty)
    update()
    bpy.context.view_layer.objects.active = empty
    ok('an instance has no operators', not bpy.ops.wiggly.key.poll())
    override = to.collections[0].override_hierarchy_create(scene, bpy.context.view_layer)
    rig = override.objects[0]
    bpy.context.view_layer.objects.active = rig
    update()
    fails('is linked', bpy.ops.wiggly.key)
    fails('library override', bpy.ops.wiggly.remove)
    ok('nothing went', len(rig.wiggly.chains) == 1 and len(chains.bones_of(rig, rig.wiggly.chains[0])) == 4)
    frames = range(1, 40)
    live = poses(rig, frames)
    bpy.ops.wiggly.bake()
    update()
    ok('an override is baked', apart(live, poses(rig, frames)) < 2e-6, apart(live, poses(rig, frames)))


def two_scenes():
    """One object in two scenes of other frame rates: the first rules, whichever is edited."""
    rig = wagging()
    before = values(rig)
    second = bpy.data.scenes.new('Second')
    second.render.fps, second.frame_start, second.frame_end = 60, 1, 60
    second.collection.objects.link(rig)
    for scene in (second, bpy.data.scenes['Scene'], second):
        rig.location.x += 1
        solve.solve_all(scene)
        ok(f'edited in {scene.name}: the same swing', values(rig) == before)
    ok('which is said', 'scene "Scene"' in solve.problems[solve.key_of(rig, rig.wiggly.splines[0])])


def settings_ends():
    rig = wagging()
    spline = rig.wiggly.splines['tail side']
    for name, some in (('frequency', (0, 1e-3, 100)), ('damping', (0, 1)), ('bandwidth', (0, 1)), ('calm', (0, 1)), ('start', ('free', 'rest', 'loop')),
                       ('mode', ('real', 'cubic', 'complex'))):
        old = getattr(spline, name)
        for value in some:
            setattr(spline, name, value)
            update()
            ok(f'{name} {value}', all(abs(v) < 1e6 for v in values(rig)), solve.problems)
        setattr(spline, name, old)
    rig.scale = 1, 3, 0.2
    update()
    select(rig, 'tail_1')
    bpy.ops.wiggly.remove()
    add(rig, follow=True)
    rig.scale = 0, 0, 0
    update()
    bpy.ops.wiggly.remove()
    add(rig, follow=True)
    ok('no size', True)


main(shared_action, bones_deleted, bone_inserted, copied_constraints, renamed, action_gone, frames, far_frames, two_keys_on_one_frame, unlinked, joined_rigs, remapped, moved_strip, stretch_baked, bake_driven,
     bake_turns, strips, channels, pose_keys, undone, properties, overrides, two_scenes, settings_ends)
