"""Scenes of wiggly come in and go out with their knots."""
import json
import subprocess
import tempfile
from common import *
from wiggly_blender import exchange

folder = tempfile.mkdtemp()
WIGGLY = os.path.abspath(os.environ.get('WIGGLY', 'build/wiggly'))


def round_trip():
    rig = fresh(frames=(0, 60))
    for frame, x in ((0, 0), (20, 0.1), (60, 0)):
        rig.pose.bones['root'].location.x = x
        rig.pose.bones['root'].keyframe_insert('location', index=0, frame=frame)
    mesh = bpy.data.meshes.new('mesh')
    mesh.from_pydata([(0, 0, 0), (0.1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
    body = bpy.data.objects.new('body', mesh)
    bpy.context.scene.collection.objects.link(body)
    body.parent = rig
    body.modifiers.new('rig', 'ARMATURE').object = rig
    body.vertex_groups.new(name='tail_1').add([0, 1, 2], 1, 'ADD')
    add(rig)
    curve = key(rig, 'tail side', (10, 0.1), (24, -0.7), (31.5, 0.3), (40, 0.4), (50, 0))
    curve.keyframe_points[0].handle_right_type = curve.keyframe_points[0].handle_left_type = 'FREE'
    curve.keyframe_points[0].handle_right = 12, 0.3
    curve.keyframe_points[1].type = 'EXTREME'
    curve.keyframe_points[3].type = 'JITTER'
    curve.keyframe_points[4].type = 'MOVING_HOLD'
    curve.update()
    bpy.context.view_layer.update()
    curve.keyframe_points[1].type = 'JITTER'
    rig.wiggly.chains[0].alike = False
    rig.wiggly.splines['tail up'].wind_up, rig.wiggly.splines['tail up'].settle = 0, True
    key(rig, 'tail up', (30, 0.3))
    frames = range(0, 61, 3)
    moved = poses(rig, frames)
    bpy.ops.object.mode_set(mode='OBJECT')
    path = os.path.join(folder, 'out.json')
    bpy.ops.wiggly.export_scene(filepath=path)
    out = json.load(open(path))
    knots = out['splines'][0]['knots']
    ok('knots go out', [knot['frame'] for knot in knots] == [10, 24, 31.5, 40, 50] and knots[0] == {'frame': 10, 'value': 0.1, 'slope': 2.4} and
       'im' in knots[1] and 'settles' in knots[1] and knots[3] == {'frame': 40, 'value': 0.4, 'settles': True} and
       knots[4] == {'frame': 50, 'still': True}, knots)
    ok('with the wind-up', [(each['wind_up'], each['knots'][-1].get('settles')) for each in out['splines']] == [(0.5, None), (0, True)], out['splines'])
    if os.path.exists(WIGGLY):
        said = subprocess.run([WIGGLY, 'solve', path, '-o', path + '.csv'], capture_output=True, text=True)
        ok('wiggly solves them', said.returncode == 0, said.stderr)
        rows = [line.split(',') for line in open(path + '.csv')][1:]
        column = curves.part(rig, rig.wiggly.splines['tail side'], 're')
        off = max(abs(float(row[2]) - column.evaluate(float(row[0]))) for row in rows)
        print(f'  the exported spline is off by {off:.1e}')
        ok('as Blender does', off < 2e-3, off)
        scene, path = path, os.path.join(folder, 'saved.json')
        said = subprocess.run([WIGGLY, 'live', scene, '--headless', '--frames', '2', '--no-draw', '--result', path], capture_output=True, text=True)
        ok('the app saves them', said.returncode == 0, said.stderr)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wiggly.import_scene(filepath=path)
    rig = next(each for each in bpy.data.objects if each.type == 'ARMATURE')
    bpy.context.view_layer.objects.active = rig
    again = os.path.join(folder, 'again.json')
    bpy.context.view_layer.update()
    back = poses(rig, frames)
    bpy.ops.wiggly.export_scene(filepath=again)
    more = json.load(open(again))
    ok('and are the same after a round trip', [s['knots'] for s in more['splines']] == [s['knots'] for s in out['splines']], more['splines'], out['splines'])
    ok('with all settings', more['splines'] == out['splines'] and more['rigs'][1:] == out['rigs'][1:], more['rigs'], out['rigs'])


def dog():
    """Bones of the imported dog are where wiggly puts them."""
    assets = os.path.abspath(os.path.join(here, '..', '..', 'assets'))
    scene = os.path.join(folder, 'dog.json')
    with open(os.path.join(assets, 'scenes', 'dog.json')) as file, open(scene, 'w') as copy:
        copy.write(file.read().replace('../models', f'{assets}/models').replace('"substeps": 4', '"substeps": 1'))

    def heads(frames):
        found, rig = [], next(each for each in bpy.data.objects if each.type == 'ARMATURE')
        for frame in frames:
            bpy.context.scene.frame_set(frame)
            seen = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
            found.append({bone.name: seen.matrix_world @ bone.head for bone in seen.pose.bones})
        return rig, found

    frames = range(0, 96, 7)
    known = None
    if os.path.exists(WIGGLY):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.context.scene.render.fps = 24
        path = os.path.join(folder, 'dog.glb')
        subprocess.run([WIGGLY, 'export', scene, '-o', path, '--substeps', '1'], check=True, capture_output=True)
        bpy.ops.import_scene.gltf(filepath=path)
        animation = next(each for each in bpy.data.objects if each.type == 'ARMATURE').animation_data
        for track in animation.nla_tracks:
            track.mute = True
        animation.action = next(action for action in bpy.data.actions if action.name.startswith('Walk'))
        if curves.LAYERED:
            animation.action_slot = animation.action_suitable_slots[0]
        known = heads(frames)[1]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    mine = bpy.data.actions.new('Walk')
    mine.use_fake_user = True
    bpy.ops.wiggly.import_scene(filepath=scene)
    rig, found = heads(frames)
    ok('it has its own action, whatever others are called', rig.animation_data.action != mine and mine.users == 1)
    ok('the dog has its chains', len(rig.wiggly.chains) == 3, list(rig.wiggly.chains.keys()))
    if known:
        off = {name: max((now[name] - then[name]).length for now, then in zip(found, known)) for name in found[0]}
        worst = max(off, key=off.get)
        print(f'  bones of the dog are off by {off[worst]:.1e} m at most ({worst})')
        ok('and moves as in wiggly', off[worst] < 1e-5, worst, off[worst], {k: round(v, 4) for k, v in off.items()})


def bytes_of(*paths):
    found = []
    for path in paths:
        with open(path, 'rb') as file:
            found.append(file.read())
    return found


def nothing_is_overwritten():
    rig = fresh()
    add(rig, follow=False)
    key(rig, 'tail side', (10, 1))
    bpy.ops.object.mode_set(mode='OBJECT')
    place = tempfile.mkdtemp()
    scene, model, mine = (os.path.join(place, name) for name in ('a.json', 'a.glb', 'mine'))
    for path in (model, mine):
        with open(path, 'w') as file:
            file.write('mine')
    os.symlink(mine, scene + '.new')

    def fails(words, **options):
        listed, before = sorted(os.listdir(place)), bytes_of(model, mine)
        try:
            bpy.ops.wiggly.export_scene(**{'filepath': scene, **options})
            ok(f'is refused: {words}', False)
        except RuntimeError as problem:
            ok(f'is refused: {words}', words in str(problem), problem)
        ok('and leaves all files alone', sorted(os.listdir(place)) == listed and bytes_of(model, mine) == before, os.listdir(place))

    fails('is there already')
    fails('expected a name that ends in .json', filepath=model)
    os.mkdir(scene)
    fails('is a folder', overwrite=True)
    os.rmdir(scene)
    name = rig.wiggly.chains[0].channels[0].spline
    rig.wiggly.chains[0].channels[0].ramps = '{'
    fails('Expecting', overwrite=True)
    rig.wiggly.chains[0].channels[0].ramps = ''
    bpy.ops.wiggly.export_scene(filepath=scene, overwrite=True)
    with open(scene) as file:
        ok('if you say so, a model is overwritten', json.load(file)['splines'][0]['name'] == name and bytes_of(model)[0][:4] == b'glTF')
    ok('nothing is written through a link', bytes_of(mine) == [b'mine'] and sorted(os.listdir(place)) == ['a.glb', 'a.json', 'a.json.new', 'mine'])


def everything():
    scene = bpy.context.scene
    kinds = [getattr(bpy.data, each.identifier) for each in bpy.data.bl_rna.properties if each.type == 'COLLECTION']
    return (sorted(each.name_full for kind in kinds for each in kind), scene.render.fps, scene.render.fps_base, scene.frame_start, scene.frame_end,
            scene.frame_current, [each.name for each in bpy.context.selected_objects], bpy.context.view_layer.objects.active)


def failed_imports_change_nothing():
    assets = os.path.abspath(os.path.join(here, '..', '..', 'assets'))
    with open(os.path.join(assets, 'scenes', 'dog.json')) as file:
        good = file.read().replace('../models', f'{assets}/models').replace('"fps": 24', '"fps": 30')
    rig = fresh(frames=(3, 77))
    add(rig)
    key(rig, 'tail side', (10, 1))
    bpy.ops.object.mode_set(mode='OBJECT')
    bpy.context.preferences.edit.use_global_undo = True
    bpy.context.scene.frame_set(12)
    broken = os.path.join(folder, 'broken.glb')
    with open(os.path.join(assets, 'models', 'dog.glb'), 'rb') as file, open(broken, 'wb') as copy:
        copy.write(file.read()[:20000])
    before, moved = everything(), poses(rig, [5, 20])
    bpy.context.scene.frame_set(12)
    path = os.path.join(folder, 'wrong.json')

    def changed(change):
        data = json.loads(good)
        chain, model = (next(each for each in data['rigs'] if each['type'] == kind) for kind in ('chain', 'model'))
        change(data, next(each for each in data['splines'] if each['name'] == chain['channels'][0]['spline']), chain, model)
        return data

    def knot(**more):
        return lambda data, spline, chain, model: spline.update(knots=[{'frame': 1, 'value': 0}, {'frame': 5, 'value': 1, **more}])

    for words, change in (
            ('a row of bones', lambda data, spline, chain, model: data['rigs'][-1].update(to='nowhere')),
            ('wrong.json', lambda data, spline, chain, model: model.update(model=broken)),
            ('frames from', lambda data, spline, chain, model: data.update(frames=[0, 1000000000])),
            ('frames from', lambda data, spline, chain, model: data.update(frames=[0, 9.5])),
            ('frames a second', lambda data, spline, chain, model: data.update(fps=1e9)),
            ('as its frame, got 1000000000', knot(frame=1000000000)), ('as its value, got "a"', knot(value='a')),
            ('as its slope, got NaN', knot(slope=math.nan)), ('as its frame, got null', knot(frame=None)),
            ('a track', lambda data, spline, chain, model: spline.update(frequency={'spline': 'x'})),
            ('mode, got "cubical"', lambda data, spline, chain, model: spline.update(mode='cubical')),
            ('two numbers as its limits, got "none"', lambda data, spline, chain, model: spline.update(limits='none')),
            ('"tail": ', lambda data, spline, chain, model: spline.update(limits=['a', 1])),
            ('as its variation, got 5', lambda data, spline, chain, model: spline.update(variation=5)),
            ('passive', lambda data, spline, chain, model: spline.update(passive='no')),
            ('there is no spline', lambda data, spline, chain, model: chain.update(channels=[{'spline': 'no'}])),
            ('axis, got "along"', lambda data, spline, chain, model: chain.update(channels=[{'spline': spline['name'], 'axis': 'along'}])),
            ('as its lag', lambda data, spline, chain, model: chain.update(channels=[{'spline': spline['name'], 'lag': [1, 'x']}]))):
        with open(path, 'w') as file:
            json.dump(changed(change), file)
        try:
            bpy.ops.wiggly.import_scene(filepath=path)
            ok(f'is refused: {words}', False)
        except RuntimeError as problem:
            ok(f'is refused: {words}', words in str(problem) and 'Traceback' not in str(problem) and 'wrong.json' in str(problem), problem)
        bpy.context.view_layer.update()
        ok('and changes nothing', everything() == before, [(a, b) for a, b in zip(everything(), before) if a != b])
    ok('the rig that was there moves as before', poses(rig, [5, 20]) == moved)
    bpy.context.scene.frame_set(12)
    bpy.ops.ed.undo_push(message='start')
    with open(path, 'w') as file:
        file.write('\ufeff' + good)
    bpy.ops.wiggly.import_scene('EXEC_DEFAULT', True, filepath=path)
    ok('after a byte order mark a scene is read', bpy.context.scene.render.fps == 30 and len(bpy.data.objects) > 1, everything())
    bpy.ops.ed.undo()
    ok('an import is one undo step', everything()[:7] == before[:7], everything(), before)


def offsets_are_left_out():
    assets = os.path.abspath(os.path.join(here, '..', '..', 'assets'))
    with open(os.path.join(assets, 'scenes', 'dog.json')) as file:
        data = json.loads(file.read().replace('../models', f'{assets}/models'))
    chain = next(each for each in data['rigs'] if each['type'] == 'chain')
    path = os.path.join(folder, 'later.json')
    for offset, left in ((0, []), (2.5, [f'the offset of {chain["name"]}'])):
        chain['offset'] = offset
        with open(path, 'w') as file:
            json.dump(data, file)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        found = exchange.read(bpy.context, path)
        ok(f'of an offset of {offset} an import says what it left out', found == left, found)


def strange_files():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    start = {'wiggly': 1, 'frames': [0, 9], 'splines': [], 'rigs': []}
    for what, words, text in (('no file', 'FileNotFoundError', None), ('no JSON', 'expected a scene', '{'), ('no scene', "expected a scene", '[]'),
                              ('no rate', 'expected a scene', json.dumps({**start, 'fps': 0})),
                              ('a model that is missing', '"no.glb" is not there',
                               json.dumps({**start, 'rigs': [{'type': 'model', 'model': 'no.glb'}]}))):
        path = os.path.join(folder, f'{what}.json')
        if text:
            with open(path, 'w') as file:
                file.write(text)
        try:
            bpy.ops.wiggly.import_scene(filepath=path)
            ok(f'{what} is refused', False)
        except RuntimeError as problem:
            ok(f'{what} is refused', words in str(problem), problem)


main(round_trip, dog, nothing_is_overwritten, failed_imports_change_nothing, offsets_are_left_out, strange_files)
