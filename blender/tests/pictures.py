"""The pictures of docs/blender.md: the dog's tail at three frames, and the curve that moves it. Usage: python pictures.py folder"""
from common import *
import bmesh
from mathutils import Vector

FRAMES = 30, 33, 37
COLORS = (0.02, 0.2, 0.6), (0.75, 0.25, 0.03), (0.1, 0.45, 0.1)
KEYS = (18, 0.0), (30, 1.0), (52, -0.9), (70, 0.0)


def material(name, color, strength=0.0):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes['Principled BSDF']
    shader.inputs['Base Color'].default_value = *((0, 0, 0) if strength else color), 1
    shader.inputs['Roughness'].default_value = 0.7
    shader.inputs['Emission Color'].default_value = *color, 1
    shader.inputs['Emission Strength'].default_value = strength
    return made


def put(data, name='thing'):
    made = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(made)
    return made


def render(path, place, target, width, size, background):
    scene = bpy.context.scene
    camera = put(bpy.data.cameras.new('camera'))
    camera.data.type, camera.data.ortho_scale, camera.location = 'ORTHO', width, place
    camera.rotation_euler = (Vector(target) - camera.location).to_track_quat('-Z', 'Y').to_euler()
    world = bpy.data.worlds.new('world')
    world.use_nodes = True
    world.node_tree.nodes['Background'].inputs[0].default_value = *background, 1
    scene.world, scene.camera, scene.render.engine = world, camera, 'CYCLES'
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = 'CPU', 24, True
    scene.view_settings.view_transform = 'Standard'
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.image_settings.color_mode, scene.render.image_settings.compression = 'RGB', 100
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def wag():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end, bpy.context.scene.render.fps = 1, 96, 24
    bpy.ops.import_scene.gltf(filepath=os.path.join(here, '..', '..', 'assets', 'models', 'dog.glb'))
    rig = next(each for each in bpy.data.objects if each.type == 'ARMATURE')
    rig.animation_data_clear()
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode='POSE')
    add(rig, follow=False)
    rig.wiggly.splines[0].frequency = 2
    key(rig, 'tail side', *KEYS)
    bpy.ops.object.mode_set(mode='OBJECT')
    return rig


def tail(folder):
    """The dog, and its tail three times."""
    rig, graph = wag(), bpy.context.evaluated_depsgraph_get()
    skin = next(each for each in bpy.data.objects if each.type == 'MESH' and each.find_armature() == rig)
    tails = {group.index for group in skin.vertex_groups if group.name.startswith('tail_')}
    is_tail = [sum(group.weight for group in vertex.groups if group.group in tails) > 0.5 for vertex in skin.data.vertices]
    body = material('body', (0.5, 0.42, 0.33))
    for frame, color in zip(FRAMES, COLORS):
        bpy.context.scene.frame_set(frame)
        shown = skin.evaluated_get(graph)
        data = bpy.data.meshes.new_from_object(shown)
        data.materials.clear()
        data.materials.append(body)
        data.materials.append(material(f'at {frame}', color))
        for face in data.polygons:
            face.material_index = all(is_tail[n] for n in face.vertices)
        if frame != FRAMES[0]:
            edited = bmesh.new()
            edited.from_mesh(data)
            bmesh.ops.delete(edited, geom=[face for face in edited.faces if not face.material_index], context='FACES')
            edited.to_mesh(data)
        put(data, f'at {frame}').matrix_world = shown.matrix_world
    skin.hide_render = True
    sun = put(bpy.data.lights.new('sun', 'SUN'))
    sun.data.energy, sun.data.angle, sun.rotation_euler = 2.5, 0.2, (-0.6, 0.5, 0)
    render(os.path.join(folder, 'blender-tail.png'), (1.2, 3.0, 2.6), (0.08, 0.12, 0.5), 1.6, (640, 320), (0.8, 0.8, 0.8))


def line(points, thick, color):
    data = bpy.data.curves.new('line', 'CURVE')
    data.dimensions, data.bevel_depth = '3D', thick
    data.materials.append(material('line', color, 1.0))
    part = data.splines.new('POLY')
    part.points.add(len(points) - 1)
    part.points.foreach_set('co', [x for point in points for x in (*point, 1)])
    return put(data)


def curve(folder):
    """What the Graph Editor shows of the side spline, and the samples of its swing."""
    rig = wag()
    keys, swing = curves.find(rig, curves.path_of('tail side')), curves.part(rig, rig.wiggly.splines['tail side'], 're')
    frames = [1 + n / 4 for n in range(4 * 95 + 1)]
    at = lambda frame, value, z: (frame / 20, value / 1.3, z)
    for value in (-1, 0, 1):
        line([at(1, value, 0), at(96, value, 0)], 0.006 if value else 0.01, (0.6, 0.6, 0.6))
    line([at(frame, keys.evaluate(frame), 0.1) for frame in frames], 0.012, (0.35, 0.35, 0.35))
    line([at(frame, swing.evaluate(frame), 0.2) for frame in frames], 0.022, COLORS[0])
    for frame, value in [*KEYS, *((frame, swing.evaluate(frame)) for frame in FRAMES)]:
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.06, location=at(frame, value, 0.5 + (frame in FRAMES)), segments=32, ring_count=16)
        bpy.context.object.data.materials.append(material('key', COLORS[FRAMES.index(frame)] if frame in FRAMES else (0.1, 0.1, 0.1), 1.0))
    skin = [each for each in bpy.data.objects if each.find_armature() == rig]
    for each in skin:
        each.hide_render = True
    render(os.path.join(folder, 'blender-curve.png'), (48.5 / 20, 0, 9), (48.5 / 20, 0, 0), 5.2, (640, 280), (1, 1, 1))


def draw():
    folder = os.path.abspath(sys.argv[1])
    for each in (curve, tail):
        each(folder)


main(draw)
