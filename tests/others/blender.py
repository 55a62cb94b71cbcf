"""Evaluates a .glb in Blender (bpy) at ten of its keys against point caches of the same rigs. A .bvh has no vertices: the heads of its
bones must be where those of the .glb are.

Usage: python blender.py file.glb rig.pc2...    |    python blender.py file.bvh file.glb
"""
import os
import sys
import bpy
import numpy as np
from compare import judge, read_cache, ten_of


def load(path):
    """The objects of a file."""
    before = set(bpy.data.objects)
    if path.endswith(('.glb', '.gltf')):
        bpy.ops.import_scene.gltf(filepath=path)
    else:
        bpy.ops.import_anim.bvh(filepath=path)
    return [o for o in bpy.data.objects if o not in before]


def choose_clip(objects, name):
    """A file with several clips comes with an action for each, and one of them plays."""
    for data in (d for o in objects for d in (o, getattr(o.data, 'shape_keys', None)) if d and d.animation_data):
        data.animation_data.action = bpy.data.actions[name]
        data.animation_data.action_slot = data.animation_data.action_suitable_slots[0]


def vertices(mesh):
    """Of the mesh as it is deformed now, in glTF's axes (y up) and its node's frame, where its cache stands."""
    shown = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
    flat = np.empty(3 * len(shown.data.vertices), np.float32)
    shown.data.vertices.foreach_get('co', flat)
    return flat.reshape(-1, 3) @ np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])


def compare_meshes(path, cache_paths):
    caches = [read_cache(p)[0] for p in cache_paths]
    counts = [c.shape[1] for c in caches]
    objects = load(path)
    if 'CLIP' in os.environ:
        choose_clip(objects, os.environ['CLIP'])
    meshes = [o for o in objects if o.type == 'MESH' and len(o.data.vertices) in counts]  # not the importer's shapes for bones
    assert len(meshes) == len(caches), f'expected {len(caches)} meshes, got {len(meshes)}'
    off = 0.0
    for key in ten_of(len(caches[0])):
        bpy.context.scene.frame_set(key)
        for mesh, cache in zip(meshes, caches):
            off = max(off, float(np.linalg.norm(vertices(mesh) - cache[key], axis=1).max()))
    return judge(f'Blender {bpy.app.version_string}', off, caches[0])


def heads(armature, bones):
    return np.array([armature.matrix_world @ armature.pose.bones[name].head for name in bones])


def compare_bones(path, reference):
    read, known = (next(o for o in load(p) if o.type == 'ARMATURE') for p in (path, reference))
    if 'CLIP' in os.environ:
        choose_clip([known], os.environ['CLIP'])
    bones, off, all_heads = [b.name for b in read.pose.bones], 0.0, []
    first, last = (round(frame) for frame in read.animation_data.action.frame_range)
    for key in ten_of(last - first + 1):
        bpy.context.scene.frame_set(key)
        all_heads.append(heads(known, bones))
        bpy.context.scene.frame_set(first + key)
        off = max(off, float(np.linalg.norm(heads(read, bones) - all_heads[-1], axis=1).max()))
    return judge(f'Blender {bpy.app.version_string}, {len(bones)} bones', off, np.array(all_heads))


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = 24  # as the scenes that are compared
    compare = compare_bones if sys.argv[1].endswith('.bvh') else compare_meshes
    return compare(sys.argv[1], *([sys.argv[2]] if compare is compare_bones else [sys.argv[2:]]))


try:
    status = main()
except Exception as problem:  # what is wrong must be seen before the process ends
    print(f'Blender: {problem}')
    status = 1
sys.stdout.flush()
os._exit(status)  # bpy may hang at the end
