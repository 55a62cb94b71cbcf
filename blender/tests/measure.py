"""Measures what the extension promises, and the same of a handler that makes the same bones jiggle; prints it as a line of JSON for table.py."""
import json
import random
import subprocess
import tempfile
import time
from common import *
from wiggly_blender import bake

folder = tempfile.mkdtemp()
KEYS = (25, 1.0), (49, -0.6), (73, 0.2)  # frames at 24 frames a second, and values
BONES = [f'tail_{n}' for n in range(1, 9)]
REPLAY = """
import bpy, json, os, sys
bpy.ops.wm.open_mainfile(filepath=sys.argv[1], use_scripts=False)
rig, found = bpy.data.objects['Rig'], {}
for frame in range(1, 1001):
    bpy.context.scene.frame_set(frame)
    seen = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    found[frame] = [x for bone in seen.pose.bones for row in bone.matrix for x in row]
json.dump(found, open(sys.argv[2], 'w'))
os._exit(0)
"""


class Handler:
    """What jiggle add-ons do: after each frame change, a spring moves the bones on towards their keys."""
    def __init__(self, rig, curve, gain, rows=(BONES,)):
        self.rig, self.curve, self.gain, self.rows, self.state = rig, curve, math.radians(gain), rows, {}

    def __call__(self, scene, _):
        h, key = scene.render.fps_base / scene.render.fps, self.gain * self.curve.evaluate(scene.frame_current)
        for goal, bone in ((key, self.rig.pose.bones[name]) for row in self.rows for name in row):
            angle, speed = self.state.get(bone.name, (goal, 0.0)) if scene.frame_current > scene.frame_start else (goal, 0.0)
            speed += h * ((2 * math.pi * 1.5) ** 2 * (goal - angle) - 2 * 0.12 * 2 * math.pi * 1.5 * speed)
            self.state[bone.name] = angle + h * speed, speed
            bone.rotation_euler.z = angle


def tail(jiggle, last=1000, fps=24, loop=False, follow=False):
    """A rig with keys at whole seconds: of a chain, or of a handler."""
    rig = fresh(bones=8, frames=(1, last))
    bpy.context.scene.render.fps = fps
    points = [(1 + (frame - 1) * fps // 24, value) for frame, value in KEYS]
    bpy.app.handlers.frame_change_post.clear()
    if jiggle:
        rig['goal'] = 0.0
        curve = key(rig, 'goal', *points)
        for name in BONES:
            rig.pose.bones[name].rotation_mode = 'XYZ'
        bpy.app.handlers.frame_change_post.append(Handler(rig, curve, 14))
    else:
        if follow:
            for second, x in ((0, 0), (1, 0), (2, 0.2)):
                rig.pose.bones['root'].location.x = x
                rig.pose.bones['root'].keyframe_insert('location', index=0, frame=1 + second * fps)
        add(rig, follow=follow, loop=loop)
        key(rig, 'tail side', *points)
    bpy.context.view_layer.update()
    return rig


def orders(jiggle):
    rig, frames = tail(jiggle), list(range(1, 1001))
    forwards = poses(rig, frames)
    shuffled = random.Random(1).sample(frames, len(frames))
    yield 'order', apart(forwards, poses(rig, shuffled))
    yield 'backwards', apart(forwards, poses(rig, frames[::-1]))
    path = os.path.join(folder, 'tail.blend')
    bpy.ops.wm.save_as_mainfile(filepath=path)
    subprocess.run([sys.executable, '-c', REPLAY, path, path + '.json'], check=True, capture_output=True)
    yield 'reload', apart(forwards, {int(frame): row for frame, row in json.load(open(path + '.json')).items()})


def keys_and_bake(jiggle):
    rig, frames = tail(jiggle, 120), range(1, 121)
    gain = 14 if jiggle else rig.wiggly.chains[0].channels[0].gain
    off = 0
    for frame in frames:
        bpy.context.scene.frame_set(frame)
        off = max([off] + [math.radians(abs(bend_at(rig, 'tail_1', jiggle) - gain * value)) for at, value in KEYS if at == frame])
    yield 'keys', off
    live = poses(rig, frames)
    if jiggle:
        rows = {name: [] for name in BONES}
        for frame in frames:
            bpy.context.scene.frame_set(frame)
            for name, row in rows.items():
                row.append(rig.pose.bones[name].rotation_euler.z)
        bpy.app.handlers.frame_change_post.clear()
        for name, row in rows.items():
            bake.write(rig, rig.pose.bones[name].path_from_id('rotation_euler'), 2, frames, row)
    else:
        bpy.ops.wiggly.bake()
    bpy.context.view_layer.update()
    yield 'bake', apart(live, poses(rig, frames))


def bend_at(rig, name, jiggle):
    return math.degrees(rig.pose.bones[name].rotation_euler.z) if jiggle else bend(rig, name)[2]


def seam(jiggle):
    found = poses(tail(jiggle, 97, loop=True), range(1, 98))
    yield 'seam', apart({1: found[1]}, {1: found[97]})


def rates(jiggle):
    off, peak = 0, 0
    for follow in (False, True)[:1 if jiggle else 2]:
        found = {}
        for fps in (24, 25, 30, 60):
            rig, found[fps] = tail(jiggle, 1 + 4 * fps, fps, follow=follow), []
            for frame in range(1, 2 + 4 * fps):
                bpy.context.scene.frame_set(frame)
                found[fps].append(bend_at(rig, 'tail_8', jiggle))
        peak = max(abs(angle) for angle in found[60])
        for a in found:
            for b in found:
                n = math.gcd(a, b)  # times that both have, a second
                off = max([off] + [abs(found[a][i * a // n] - found[b][i * b // n]) / peak for i in range(4 * n + 1)])
    yield 'rates', off


def pictures(jiggle):
    """Frames as a render farm has them, each by itself and in some order, and as one animation; with motion blur."""
    rig, scene = tail(jiggle, 120), bpy.context.scene
    mesh = bpy.data.meshes.new('skin')
    mesh.from_pydata([(x, 0.2 * n, 0) for n in range(9) for x in (-0.2, 0.2)], [], [(2 * n, 2 * n + 1, 2 * n + 3, 2 * n + 2) for n in range(8)])
    skin = bpy.data.objects.new('skin', mesh)
    skin.modifiers.new('rig', 'ARMATURE').object = rig
    for n, name in enumerate(BONES):
        skin.vertex_groups.new(name=name).add([2 * n, 2 * n + 1, 2 * n + 2, 2 * n + 3], 1, 'REPLACE')
    camera = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
    camera.location, camera.data.type, camera.data.ortho_scale = (0, 0.8, 5), 'ORTHO', 3
    sun = bpy.data.objects.new('sun', bpy.data.lights.new('sun', 'SUN'))
    for each in (skin, camera, sun):
        scene.collection.objects.link(each)
    scene.camera, scene.render.engine = camera, 'CYCLES'
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = 'CPU', 1, False
    scene.render.resolution_x = scene.render.resolution_y = 48
    scene.render.use_motion_blur = True
    scene.frame_step, frames = 40, (41, 1, 81)
    for frame in frames:
        scene.frame_set(frame)
        scene.render.filepath = os.path.join(folder, f'alone{frame}.png')
        bpy.ops.render.render(write_still=True)
    scene.render.filepath = os.path.join(folder, 'all####.png')
    bpy.ops.render.render(animation=True)
    off, seen = 0, 0
    for frame in frames:
        a, b = (list(bpy.data.images.load(os.path.join(folder, name)).pixels) for name in (f'alone{frame}.png', f'all{frame:04}.png'))
        off = max([off] + [abs(x - y) for x, y in zip(a, b)])
        seen = max([seen] + a[::4])
    yield 'renders', off if seen > 0 else math.inf


def least(times, call):
    best = math.inf
    for n in range(times):
        start = time.perf_counter()
        call(n)
        best = min(best, 1000 * (time.perf_counter() - start))
    return best


def many():
    """50 chains of 8 bones under one root."""
    rig = fresh(bones=0, frames=(1, 240))
    bpy.ops.object.mode_set(mode='EDIT')
    rows = [[f'tail{c}_{n}' for n in range(8)] for c in range(50)]
    for c, row in enumerate(rows):
        above = rig.data.edit_bones['root']
        for n, name in enumerate(row):
            bone = rig.data.edit_bones.new(name)
            bone.head, bone.tail, bone.parent = (0.3 * c, 0.2 * n, 0), (0.3 * c, 0.2 * n + 0.2, 0), above
            above = bone
    bpy.ops.object.mode_set(mode='POSE')
    return rig, rows


def costs(jiggle):
    rig, rows = many()
    path = os.path.join(folder, 'many.blend')

    def pose():
        return rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones[-1].matrix[0][0]

    def step(n):
        bpy.context.scene.frame_set(30 + n % 40)
        pose()

    def size(compress):
        bpy.ops.wm.save_as_mainfile(filepath=path, compress=compress)
        return os.path.getsize(path)

    if jiggle:
        rig['goal'] = 0.0
        bpy.app.handlers.frame_change_post[:] = [Handler(rig, key(rig, 'goal', *KEYS), 14, rows)]
        yield 'frame', least(200, step)
        return
    bpy.app.handlers.frame_change_post.clear()
    bare = size(False), size(True)
    select(rig, *(row[0] for row in rows))
    bpy.ops.wiggly.add(follow=False)
    edited = [key(rig, spline.name, *KEYS) for spline in rig.wiggly.splines if spline.name.endswith(' side')]

    def edit(some):
        def now(n):
            for curve in some:
                curve.keyframe_points[1].co[1] = -0.6 + 0.01 * n
                curve.update()
            bpy.context.view_layer.update()  # the chains are solved at its end
            pose()
        return now

    yield 'frame', least(200, step)
    yield 'edit', least(20, edit(edited)) / len(edited)
    yield 'edit one', least(40, edit(edited[:1]))
    full = size(False), size(True)
    bpy.context.scene.frame_end = 480
    bpy.context.view_layer.update()
    sample = (size(False) - full[0]) / (50 * 240)
    yield 'sample', sample
    yield 'chain', (full[1] - bare[1]) / 50000
    yield 'plain', (full[0] - bare[0]) / 50000


def measure():
    found = {'version': '.'.join(map(str, bpy.app.version[:2])), 'full': bpy.app.version_string}
    for jiggle in (False, True):
        for each in (orders, keys_and_bake, seam, rates, pictures, costs):
            found.update((('handler ' if jiggle else '') + name, value) for name, value in each(jiggle))
    print('measured ' + json.dumps(found), flush=True)


main(measure)
