"""Bake makes what is seen; any property can swing."""
from common import *


def baked(what, prepare=lambda rig: None):
    rig = fresh(bend=0.2)
    rig.pose.bones['tail_1'].rotation_mode = 'QUATERNION'
    rig.pose.bones['tail_2'].rotation_mode = 'ZXY'
    rig.pose.bones['tail_3'].rotation_mode = 'AXIS_ANGLE'
    for frame, angle in ((1, 0), (30, 1), (60, -2)):
        rig.pose.bones['tail_2'].rotation_euler = angle, angle / 2, 0.1
        rig.pose.bones['tail_2'].keyframe_insert('rotation_euler', frame=frame)
    prepare(rig)
    mine = rig.animation_data.action
    chain = add(rig, follow=False)
    key(rig, 'tail side', (10, 1), (30, -0.5))
    key(rig, 'tail up', (20, 2))
    frames = range(1, 61)
    live = poses(rig, frames)
    bpy.ops.wiggly.bake()
    bpy.context.view_layer.update()
    after = poses(rig, frames)
    ok(f'{what}: baked is live', apart(live, after) < 2e-6, apart(live, after))
    ok(f'{what}: the action stays', rig.animation_data.action != mine and curves.LAYERED or len(mine.fcurves) > 3)
    ok(f'{what}: the chain is muted', chain.mute)
    bpy.ops.wiggly.remove()
    ok(f'{what}: Remove leaves the keys', apart(live, poses(rig, frames)) < 2e-6, apart(live, poses(rig, frames)))
    if not any(c.name.startswith('Baked') for bone in rig.pose.bones for c in bone.constraints):
        ok(f'{what}: and nothing else', not any('onstraint' in c.data_path or 'wiggle' in c.data_path for c in curves.list_of(rig)))


def bones():
    baked('bones')


def constrained():
    def prepare(rig):
        con = rig.pose.bones['tail_3'].constraints.new('COPY_ROTATION')
        con.target, con.subtarget = rig, 'root'
        con.influence = 0.5
    baked('a constraint', prepare)


def swings(what, owner, path, index, read, keys=((1, 0.0), (20, 1.0))):
    def value(frame):
        bpy.context.scene.frame_set(frame)
        return read(owner.evaluated_get(bpy.context.evaluated_depsgraph_get()))

    curve = curves.ensure(owner, path, index)
    for frame, number in keys:
        curve.keyframe_points.insert(frame, number)
    curve.update()
    before, still = curves.read(curve), [value(frame) for frame in range(1, 40)]
    from wiggly_blender import prop
    spline = prop.add(owner, path, index)
    bpy.context.view_layer.update()
    moved = [value(frame) for frame in range(1, 40)]
    ok(f'{what}: hits its keys', all(abs(moved[frame - 1] - number) < 1e-5 for frame, number in keys), moved)
    ok(f'{what}: swings', max(abs(a - b) for a, b in zip(moved, still)) > 0.05)
    prop.remove(owner, path, index)
    bpy.context.view_layer.update()
    ok(f'{what}: Remove gives the keys back', curves.read(curves.find(owner, path, index)) == before)
    ok(f'{what}: and the motion', [value(frame) for frame in range(1, 40)] == still)
    ok(f'{what}: and leaves nothing', not list(owner.keys()) and not owner.animation_data.drivers and len(curves.list_of(owner)) == 1)


def properties():
    fresh()
    bpy.ops.object.mode_set(mode='OBJECT')
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.object
    swings('location', cube, 'location', 1, lambda seen: seen.location[1])
    cube.shape_key_add(name='Basis')
    cube.shape_key_add(name='fat')
    keys = cube.data.shape_keys
    swings('a shape key', keys, 'key_blocks["fat"].value', 0, lambda seen: seen.key_blocks['fat'].value, ((1, 0.2), (20, 0.6)))
    cube['mine'] = 0.1
    from wiggly_blender import prop
    prop.add(cube, '["mine"]', 0)
    prop.remove(cube, '["mine"]', 0)
    ok('a custom property without keys is as it was', cube['mine'] == 0.1 and list(cube.keys()) == ['mine'], cube['mine'], list(cube.keys()))
    del cube['mine']
    light = bpy.data.lights.new('light', 'POINT')
    bpy.context.scene.collection.objects.link(bpy.data.objects.new('light', light))
    swings('a light', light, 'energy', 0, lambda seen: seen.energy, ((1, 40.0), (20, 60.0)))


def bone_properties():
    rig = fresh()
    bone = rig.pose.bones['tail_1']
    bone['a.b'] = 0.5
    swings('a property of a bone', rig, 'pose.bones["tail_1"]["a.b"]', 0, lambda seen: seen.pose.bones['tail_1']['a.b'])
    rig = fresh()
    swings('a rotation', rig, 'pose.bones["tail_1"].rotation_quaternion', 2, lambda seen: seen.pose.bones['tail_1'].rotation_quaternion[2])


def baked_property():
    fresh()
    light = bpy.data.lights.new('light', 'POINT')
    bpy.context.scene.collection.objects.link(bpy.data.objects.new('light', light))
    curve = curves.ensure(light, 'energy')
    for frame, number in ((1, 40), (20, 60), (30, 10)):
        curve.keyframe_points.insert(frame, number)
    from wiggly_blender import prop
    prop.add(light, 'energy', 0)
    bpy.context.view_layer.update()
    mine = light.animation_data.action

    def energies():
        found = []
        for frame in range(1, 61):
            bpy.context.scene.frame_set(frame)
            found.append(light.evaluated_get(bpy.context.evaluated_depsgraph_get()).energy)
        return found

    live = energies()
    prop.make_keys(light, 'energy', 0)
    bpy.context.view_layer.update()
    off = max(abs(a - b) for a, b in zip(live, energies()))
    ok('a baked property is as it was', off < 1e-5 and max(live) - min(live) > 40, off)
    ok('in an action of its own', light.animation_data.action != mine and len(curves.list_of(light)) == 1 and not light.animation_data.drivers)


def nodes():
    fresh()
    material = bpy.data.materials.new('skin')
    material.use_nodes = True
    tree = material.node_tree
    path = 'nodes["Principled BSDF"].inputs[2].default_value'
    bpy.ops.object.mode_set(mode='OBJECT')
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.data.materials.append(material)
    swings('an input of a material', tree, path, 0, lambda seen: seen.nodes['Principled BSDF'].inputs[2].default_value, ((1, 0.2), (20, 0.6)))


def soft_characters():
    """A character that wiggly exported: its shapes go as the spline says."""
    fresh()
    bpy.ops.object.mode_set(mode='OBJECT')
    for halved in (False, True):
        bpy.ops.mesh.primitive_cube_add()
        cube = bpy.context.object
        cube.shape_key_add(name='Basis')
        names = ['up.re', 'up.im', 'up.sq', 'up.re2', 'up.im2', 'side.re', 'side.im']
        names += ['up.-re', 'up.-im', 'up.-re2', 'up.-im2', 'side.-re', 'side.-im'] * halved
        for name in names:
            cube.shape_key_add(name=name).value = 0
        cube.data['wiggly'] = {'coordinates': [{'name': 'up', 'frequency': 3.25, 'damping': 0.0625, 'scale': 2.0, 'most': 1.5}]}
        bpy.ops.wiggly.shapes()
        keys = cube.data.shape_keys
        spline = keys.wiggly.splines['wiggle up']
        ok('a spline for each pair', len(keys.wiggly.splines) == 2)
        ok('the frequency that wiggly found', (spline.frequency, spline.damping) == (3.25, 0.0625))
        key(keys, spline.name, (10, 1), (22, -0.6))
        off, most, far = 0, 0, 0
        for frame in range(1, 40):
            bpy.context.scene.frame_set(frame)
            seen = keys.evaluated_get(bpy.context.evaluated_depsgraph_get())
            re, im = (curves.part(keys, spline, part).evaluate(frame) for part in ('re', 'im'))
            z = 2 * complex(re, im)
            square = z * z / abs(z) ** 2 * 1.5 * (2 * abs(z) - 1.5) if abs(z) > 1.5 else z * z
            for part, want in (('re', re), ('im', im), ('sq', abs(square) / 2), ('re2', square.real / 2), ('im2', -square.imag / 2)):
                value = seen.key_blocks[f'up.{part}'].value - (seen.key_blocks[f'up.-{part}'].value if halved and part != 'sq' else 0)
                off, most = max(off, abs(value - want)), max(most, -want)
            far = max(far, abs(z))
        ok('pairs of shape keys swing' + ', in halves' * halved, off < 1e-5 and most > 0.3 and far > 1.5, off, most, far)
        bpy.ops.wiggly.shapes(remove=True)
        ok('Remove leaves nothing', not keys.animation_data and not list(keys.keys()))


main(soft_characters, bones, constrained, properties, bone_properties, baked_property, nodes)
