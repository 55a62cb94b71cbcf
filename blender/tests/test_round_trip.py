"""A character goes from Blender to wiggly as a .glb and comes back: what no chain moves is where it was, the rest is where wiggly has it."""
import subprocess
import tempfile
from common import *

WIGGLY = os.path.abspath(os.environ.get('WIGGLY', 'build/wiggly'))
JUDGE = os.path.join(here, '..', '..', 'tests', 'others', 'blender.py')
FRAMES = range(0, 61, 3)
folder = tempfile.mkdtemp()


def animal():
    """A turned body with a tail, as one skin; the body walks and nods."""
    rig = fresh(bones=6, frames=(0, 60), bend=0.2)
    rig.location, rig.rotation_euler = (0.3, -0.2, 0.5), (0.1, 0.2, 0.7)
    bones = rig.data.bones
    rings = [(bone, bone.head_local) for bone in bones] + [(bones[-1], bones[-1].tail_local)]
    points = [place + type(place)((0.1 * math.cos(a), 0, 0.1 * math.sin(a))) for _, place in rings for a in (0, 2, 4)]
    mesh = bpy.data.meshes.new('skin')
    mesh.from_pydata(points, [], [(3 * n + k, 3 * n + (k + 1) % 3, 3 * n + 3 + (k + 1) % 3, 3 * n + 3 + k) for n in range(len(rings) - 1) for k in range(3)])
    mesh.polygons.foreach_set('use_smooth', [True] * len(mesh.polygons))
    skin = bpy.data.objects.new('skin', mesh)
    bpy.context.scene.collection.objects.link(skin)
    skin.parent = rig
    skin.modifiers.new('rig', 'ARMATURE').object = rig
    for n, (bone, _) in enumerate(rings):
        for each, weight in ((bone, 0.7), (bone.parent or bone, 0.3)):
            group = skin.vertex_groups.get(each.name) or skin.vertex_groups.new(name=each.name)
            group.add(range(3 * n, 3 * n + 3), 1 if not bone.parent else weight, 'REPLACE')
    root = rig.pose.bones['root']
    root.rotation_mode = 'XYZ'
    for frame, x, angle in ((0, 0, 0), (20, 0.4, 0.8), (35, 0.1, -0.3), (60, 0, 0)):
        root.location.x, root.rotation_euler.z = x, angle
        root.keyframe_insert('location', frame=frame)
        root.keyframe_insert('rotation_euler', frame=frame)
    bpy.ops.object.mode_set(mode='OBJECT')
    return rig


def seen():
    """Places of the skin's vertices and the bones' heads in the world, by frame."""
    skin = next(each for each in bpy.data.objects if each.type == 'MESH' and each.find_armature())
    rig, found = skin.find_armature(), []
    for frame in FRAMES:
        bpy.context.scene.frame_set(frame)
        graph = bpy.context.evaluated_depsgraph_get()
        shown, pose = skin.evaluated_get(graph), rig.evaluated_get(graph)
        found.append(([shown.matrix_world @ vertex.co for vertex in shown.data.vertices],
                      {bone.name: pose.matrix_world @ bone.head for bone in pose.pose.bones}))
    return found


def wiggly(*arguments):
    said = subprocess.run([WIGGLY, *arguments], capture_output=True, text=True)
    ok(f'wiggly {arguments[0]}', said.returncode == 0, said.stderr)


def there_and_back():
    if not os.path.exists(WIGGLY):
        return print(f'skip - there is no {WIGGLY}')
    animal()
    before = seen()
    path = os.path.join(folder, 'animal.glb')
    bpy.ops.export_scene.gltf(filepath=path, export_yup=True)
    for what, chain in (('without a chain', ()), ('with a chain', ('--chain', 'tail_2'))):
        scene, back = os.path.join(folder, 'animal.json'), os.path.join(folder, 'back.glb')
        wiggly('rig', path, *chain, '-o', scene)
        wiggly('export', scene, '-o', back, '--substeps', '1')
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.context.scene.render.fps = 24
        bpy.ops.import_scene.gltf(filepath=back)
        after = seen()
        heads = [name for name in before[0][1] if not chain or name in ('root', 'tail_1', 'tail_2')]
        off = max((then[1][name] - now[1][name]).length for then, now in zip(before, after) for name in heads)
        ok(f'{what}: bones come back', off < 1e-5, off)
        if not chain:
            ok('with all vertices', all(len(then[0]) == len(now[0]) for then, now in zip(before, after)), len(before[0][0]), len(after[0][0]))
            off = max((p - q).length for then, now in zip(before, after) for p, q in zip(then[0], now[0]))
            ok('where they were', off < 1e-5, off)
            continue
        moved = max((then[1]['tail_6'] - now[1]['tail_6']).length for then, now in zip(before, after))
        ok('the chain swings', moved > 0.01, moved)
        cache = os.path.join(folder, 'back.pc2')
        wiggly('export', scene, '-o', cache, '--substeps', '1')
        said = subprocess.run([sys.executable, JUDGE, back, cache], capture_output=True, text=True)
        ok('and its vertices are those of wiggly', said.returncode == 0, said.stdout[-300:], said.stderr[-300:])


main(there_and_back)
