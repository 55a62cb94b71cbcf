"""Scenes of wiggly come in and go out with their knots."""
import json
import subprocess
import tempfile
from common import *

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
    curve = key(rig, 'tail side', (10, 0.1), (24, -0.7), (31.5, 0.3), (50, 0))
    curve.keyframe_points[0].handle_right_type = curve.keyframe_points[0].handle_left_type = 'FREE'
    curve.keyframe_points[0].handle_right = 12, 0.3
    curve.keyframe_points[1].type = 'EXTREME'
    curve.keyframe_points[3].type = 'MOVING_HOLD'
    curve.update()
    bpy.context.view_layer.update()
    frames = range(0, 61, 3)
    moved = poses(rig, frames)
    bpy.ops.object.mode_set(mode='OBJECT')
    path = os.path.join(folder, 'out.json')
    bpy.ops.wiggly.export_scene(filepath=path)
    out = json.load(open(path))
    knots = out['splines'][0]['knots']
    ok('knots go out', [knot['frame'] for knot in knots] == [10, 24, 31.5, 50] and knots[0] == {'frame': 10, 'value': 0.1, 'slope': 2.4} and
       'im' in knots[1] and knots[3] == {'frame': 50, 'still': True}, knots)
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
    bpy.ops.wiggly.import_scene(filepath=scene)
    rig, found = heads(frames)
    ok('the dog has its chains', len(rig.wiggly.chains) == 3, list(rig.wiggly.chains.keys()))
    if known:
        off = {name: max((now[name] - then[name]).length for now, then in zip(found, known)) for name in found[0]}
        worst = max(off, key=off.get)
        print(f'  bones of the dog are off by {off[worst]:.1e} m at most ({worst})')
        ok('and moves as in wiggly', off[worst] < 1e-5, worst, off[worst], {k: round(v, 4) for k, v in off.items()})


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


main(round_trip, dog, strange_files)
