"""Makes .glb files of other people's skeletons in Blender (bpy): files that it imports and Rigify's metarigs. A skeleton without a mesh
gets a box for each bone, one without a clip steps aside and back.

Usage: python rigs.py <folder> <file or metarig>...
"""
import os
import sys
import bpy
import addon_utils  # which is there only after bpy
from mathutils import Vector

CORNERS = [(x, y, z) for x in (-1, 1) for y in (0, 1) for z in (-1, 1)]
FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def load(source):
    """An armature of a file, or of Rigify."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if source.endswith('.fbx'):
        bpy.ops.import_scene.fbx(filepath=source)
    elif source.endswith('.bvh'):
        bpy.ops.import_anim.bvh(filepath=source, global_scale=0.05, frame_start=1)
    else:
        addon_utils.enable('rigify')
        getattr(bpy.ops.object, f'armature_{source}_metarig_add')()
    return next(o for o in bpy.data.objects if o.type == 'ARMATURE')


def dress(armature):
    """A box along each bone that deforms, moved by it alone."""
    places, faces, groups = [], [], {}
    for bone in (b for b in armature.data.bones if b.use_deform):
        first, side = len(places), 0.1 * bone.length
        for x, y, z in CORNERS:
            places.append(bone.matrix_local @ Vector((x * side, y * bone.length, z * side)))
        faces += [tuple(first + corner for corner in face) for face in FACES]
        groups[bone.name] = list(range(first, first + len(CORNERS)))
    mesh = bpy.data.meshes.new('boxes')
    mesh.from_pydata(places, [], faces)
    boxes = bpy.data.objects.new('boxes', mesh)
    bpy.context.collection.objects.link(boxes)
    boxes.parent = armature
    boxes.modifiers.new('bones', 'ARMATURE').object = armature
    for name, vertices in groups.items():
        boxes.vertex_groups.new(name=name).add(vertices, 1, 'REPLACE')


def main():
    folder, *sources = sys.argv[1:]
    for source in sources:
        armature = load(source)
        if not any(o.find_armature() == armature for o in bpy.data.objects if o.type == 'MESH'):
            dress(armature)
        for frame, x in ((1, 0), (13, 0.3), (25, 0)) if not bpy.data.actions else ():
            armature.location.x = x
            armature.keyframe_insert('location', frame=frame)
        name = os.path.splitext(os.path.basename(source))[0]
        bpy.ops.export_scene.gltf(filepath=os.path.join(folder, name + '.glb'))


try:
    main()
    status = 0
except Exception as problem:  # what is wrong must be seen before the process ends
    print(f'Blender: {problem}')
    status = 1
sys.stdout.flush()
os._exit(status)  # bpy may hang at the end
