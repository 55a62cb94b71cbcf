"""Keys that hold more, loops, follow-through, and what each operator says."""
from common import *
from wiggly_blender import prop


def channel(rig, name, frame):
    name, part = name.rsplit(' ', 1)
    return curves.part(rig, rig.wiggly.splines[name], part).evaluate(frame)


def slopes():
    rig = fresh()
    add(rig, follow=False)
    curve = key(rig, 'tail side', (10, 1), (40, 0))
    before = channel(rig, 'tail side re', 11) - channel(rig, 'tail side re', 9)
    point = curve.keyframe_points[0]
    point.handle_left_type = point.handle_right_type = 'FREE'
    point.handle_right = point.co[0] + 3, point.co[1] + 0.6
    curve.update()
    bpy.context.view_layer.update()
    slope = (channel(rig, 'tail side re', 11) - channel(rig, 'tail side re', 9)) / 2
    ok('a free handle is a slope', abs(slope - 0.2) < 0.02 and abs(before / 2 - 0.2) > 0.02, slope, before / 2)
    ok('the key is still hit', abs(channel(rig, 'tail side re', 10) - 1) < 1e-6)


def poses_and_still_keys():
    rig = fresh()
    add(rig, follow=False)
    curve = key(rig, 'tail side', (10, 1), (24, -0.7), (40, 0))
    held = channel(rig, 'tail side im', 24)
    curve.keyframe_points[1].type = 'EXTREME'
    curve.update()
    bpy.context.view_layer.update()
    ok('an extreme holds the phase that is seen', abs(channel(rig, 'tail side im', 24) - held) < 1e-6)
    rig.wiggly.splines['tail side'].frequency *= 1.3
    key(rig, 'tail side', (50, 0.4))
    ok('whatever changes', abs(channel(rig, 'tail side im', 24) - held) < 1e-6 and abs(held) > 0.1, held)
    curve.keyframe_points[1].co[0] = 27
    curve.update()
    bpy.context.view_layer.update()
    ok('and takes it along', abs(channel(rig, 'tail side im', 27) - held) < 1e-6)
    curve.keyframe_points[1].type = 'KEYFRAME'
    curve.update()
    bpy.context.view_layer.update()
    ok('until it is none any more', abs(channel(rig, 'tail side im', 27) - held) > 1e-3)
    curve.keyframe_points[1].type = 'MOVING_HOLD'
    curve.update()
    bpy.context.view_layer.update()
    ok('a moving hold is still', all(abs(channel(rig, f'tail side {part}', 27)) < 1e-6 for part in ('re', 'im')))
    bpy.context.scene.frame_set(18)
    was = bend(rig, 'tail_3')
    bpy.ops.wiggly.key(kind='EXTREME')
    bpy.context.view_layer.update()
    ok('Insert Key keeps what is seen', max(abs(a - b) for a, b in zip(bend(rig, 'tail_3'), was)) < 1e-3, bend(rig, 'tail_3'), was)


def settling_keys():
    def one(rig, curve):
        curve.keyframe_points[1].type = 'JITTER'

    def pose(rig, curve):
        curve.keyframe_points[1].type = 'EXTREME'
        curve.update()
        bpy.context.view_layer.update()
        curve.keyframe_points[1].type = 'JITTER'

    def all_of_them(rig, curve):
        rig.wiggly.splines['tail side'].settle = True

    for what, settle, follow in (('a Jitter key', one, False), ('a chain whose keys settle', all_of_them, False), ('a pose', pose, False),
                                 ('a chain that follows', one, True)):
        rig = fresh(frames=(1, 240))
        chain = add(rig, follow=follow)
        curve = key(rig, 'tail side', (10, 1), (30, -0.5))
        bones, held = chains.bones_of(rig, chain), channel(rig, 'tail side im', 30)

        def at(frame):
            bpy.context.scene.frame_set(frame)
            return [bend(rig, bone.name)[2] / chain.channels[0].gain for bone in bones]

        settle(rig, curve)
        curve.update()
        bpy.context.view_layer.update()
        ok(f'{what} stays where it settles', max(abs(each + 0.5) for each in at(240)) < 1e-3, at(240))
        ok('after it was hit and overshot', abs(at(30)[0] + 0.5) < 1e-5 and (settle == pose or min(at(36)) < -0.55), at(30), at(36))
        ok('and keeps the phase that it held', settle != pose or abs(channel(rig, 'tail side im', 30) - held) < 1e-6)
        bpy.context.scene.frame_set(200)
        bpy.ops.wiggly.key()
        ok('Insert Key has the value that is seen', abs(curve.keyframe_points[-1].co[1] + 0.5) < 2e-3, curve.keyframe_points[-1].co)
        curve.keyframe_points.remove(curve.keyframe_points[-1])
        curve.keyframe_points[1].type, rig.wiggly.splines['tail side'].settle = 'KEYFRAME', False
        curve.update()
        bpy.context.view_layer.update()
        ok('or comes home again', max(map(abs, at(240))) < 1e-3, at(240))
        bpy.ops.wiggly.remove()
        ok('and leaves nothing', not rig.keys() and not rig.animation_data, list(rig.keys()))
    rig = fresh(frames=(1, 240))
    prop.add(rig, 'location', 0)
    curve = key(rig, 'wiggle location X', (10, 0), (30, 2))
    curve.keyframe_points[-1].type = 'JITTER'
    curve.update()
    bpy.context.view_layer.update()
    bpy.context.scene.frame_set(240)
    ok('a property settles', abs(rig.location.x - 2) < 1e-3, rig.location.x)


def wind_up():
    rig = fresh()
    add(rig, follow=False)
    spline = rig.wiggly.splines['tail side']
    ok('new chains wind up for half a period', [each.wind_up for each in rig.wiggly.splines] == [0.5, 0.5])
    for what, periods, same in (('nothing before the key before it', 0.5, True), ('the whole curve without wind-up', 0, False)):
        spline.wind_up = periods
        curve = key(rig, 'tail side', (10, 1), (30, -0.5), (50, 0.4))
        before = poses(rig, range(1, 31))
        key(rig, 'tail side', (50, 2))
        ok(f'an edited key changes {what}', (apart(before, poses(rig, range(1, 31))) == 0) == same)
    before = poses(rig, range(1, 60))
    for each in rig.wiggly.splines:
        each.property_unset('wind_up')
    key(rig, 'tail side', (50, 2))
    ok('files of before have none', spline.wind_up == 0 and poses(rig, range(1, 60)) == before)


def has_no_effect():
    rig = fresh()
    add(rig, follow=False)
    key(rig, 'tail side', (10, 1))
    spline = rig.wiggly.splines['tail side']
    for words, change in (('', {}), ('limits need the whole curve', {'more': '{"limits": [-2, 2]}'}),
                          ("the paper's filter has none", {'more': '{"passive": "filter"}'}),
                          ('below two, it is a jerk', {'frequency': 9, 'bandwidth': 0}), ('a Cubic does not swing', {'mode': 'cubic', 'settle': True})):
        for each in ('more', 'frequency', 'bandwidth', 'mode', 'settle'):
            spline.property_unset(each)
        for name, value in change.items():
            setattr(spline, name, value)
        rig.location.x += 1
        bpy.context.view_layer.update()
        said = solve.problems[solve.key_of(rig, spline)]
        ok(f'says: {words or "nothing"}', words in said if words else not said, said)


def scene_changes():
    rig = fresh()
    add(rig, follow=False)
    rig.wiggly.splines['tail side'].wind_up = 0  # so that the start reaches beyond the first key
    key(rig, 'tail side', (10, 1), (30, -0.5))
    scene, before = bpy.context.scene, channel(rig, 'tail side re', 20)
    scene.render.fps = 48
    bpy.context.view_layer.update()
    ok('another frame rate is another swing', abs(channel(rig, 'tail side re', 20) - before) > 0.01)
    scene.frame_end = 90
    bpy.context.view_layer.update()
    ok('more frames are solved', channel(rig, 'tail side re', 80) != channel(rig, 'tail side re', 85))
    key(rig, 'tail side', (120, 2))
    ok('to the last key', abs(channel(rig, 'tail side re', 120) - 2) < 1e-6)
    from wiggly_blender import base
    ok('the frames are those of the scene', not base.stale(rig, scene))
    before = poses(rig, range(20, 40))
    scene.frame_start, scene.frame_end = 20, 40
    bpy.context.view_layer.update()
    ok('a part of them moves as in the whole', apart(before, poses(rig, range(20, 40))) == 0)
    ok('the panel offers to start there', base.stale(rig, scene))
    bpy.ops.wiggly.refresh()
    bpy.context.view_layer.update()
    ok('and then it does', not base.stale(rig, scene) and apart(before, poses(rig, range(20, 40))) > 1e-3)


def loops():
    rig = fresh(frames=(1, 49))
    add(rig, follow=False, loop=True)
    key(rig, 'tail side', (10, 1), (30, -1))
    found = poses(rig, [1, 49, 0, 48, 1.5, 49.5])
    ok('the last frame is the first one', apart({1: found[1]}, {1: found[49]}) < 1e-6)
    ok('and goes on', apart({1: found[0]}, {1: found[48]}) < 1e-6 and apart({1: found[1.5]}, {1: found[49.5]}) < 1e-6)
    ok('it moves', apart({1: found[1]}, {1: found[48]}) > 1e-3)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 20, 30
    bpy.context.view_layer.update()
    ok('a part of it, too', apart(found, poses(rig, list(found))) < 1e-6)


def follow_through():
    rig = fresh()
    for frame, x in ((1, 0), (20, 0), (26, 1), (60, 1)):
        rig.pose.bones['root'].location.x = x
        rig.pose.bones['root'].keyframe_insert('location', index=0, frame=frame)
    chain = add(rig)
    ok('the motion of the body is read', abs(channel(rig, 'tail side y', 26) - channel(rig, 'tail side y', 20)) > 0.9)
    bpy.context.scene.frame_set(10)
    ok('it rests before', abs(bend(rig, 'tail_1')[2]) < 0.1, bend(rig, 'tail_1'))
    bpy.context.scene.frame_set(25)
    turned = bend(rig, 'tail_1')[2]
    ok('it stays behind', turned > 5, turned)
    from wiggly_blender import base
    ok('what is read is fresh', not base.stale(rig, bpy.context.scene))
    rig.pose.bones['root'].location.x = 2
    rig.pose.bones['root'].keyframe_insert('location', index=0, frame=26)
    bpy.context.view_layer.update()
    ok('and stale once the action is edited', base.stale(rig, bpy.context.scene))
    bpy.ops.wiggly.refresh()
    bpy.context.scene.frame_set(25)
    ok('until it is refreshed', not base.stale(rig, bpy.context.scene) and bend(rig, 'tail_1')[2] > 1.5 * turned)
    key(rig, 'tail side', (40, 0.8))
    bpy.context.scene.frame_set(40)
    want = chain.channels[0].gain * (0.8 - channel(rig, 'tail side y', 40))
    ok('keys say where the chain is over the motion', abs(bend(rig, 'tail_1')[2] - want) < 1e-4, bend(rig, 'tail_1'), want)


def says():
    def fails(words, call, *arguments, **options):
        try:
            call(*arguments, **options)
        except RuntimeError as problem:
            return ok(f'says: {words}', words in str(problem), problem)
        ok(f'says: {words}', False)

    rig = fresh()
    select(rig)
    fails('Select the first bone', bpy.ops.wiggly.add)
    fails('has no chain', bpy.ops.wiggly.remove)
    add(rig, follow=False)
    select(rig, 'tail_2')
    fails('already wiggles', bpy.ops.wiggly.add)
    ok('nothing was added', len(rig.wiggly.chains) == 1 and len(rig.wiggly.splines) == 2)


main(slopes, poses_and_still_keys, settling_keys, wind_up, has_no_effect, scene_changes, loops, follow_through, says)
