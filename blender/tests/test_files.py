"""Nothing breaks: files without the add-on, undo, copies, other files, renamed bones; and nothing stays behind."""
import subprocess
import tempfile
from common import *

folder = tempfile.mkdtemp()
WITHOUT = """
import bpy, json, os, sys
bpy.ops.wm.open_mainfile(filepath=sys.argv[1], use_scripts=False)
rig, found = bpy.data.objects['Rig'], {}
for frame in json.loads(sys.argv[2]):
    bpy.context.scene.frame_set(int(frame), subframe=frame % 1)
    seen = rig.evaluated_get(bpy.context.evaluated_depsgraph_get())
    found[frame] = [x for bone in seen.pose.bones for row in bone.matrix for x in row]
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1] + '.blend')
print('poses ' + json.dumps(list(found.values())), flush=True)
os._exit(0)
"""


def wagging(**options):
    rig = fresh(**options)
    bpy.context.preferences.edit.use_global_undo = True
    add(rig, follow=False)
    key(rig, 'tail side', (10, 1), (30, -0.5))
    return rig


def without_add_on():
    rig = wagging(bend=0.2)
    path = os.path.join(folder, 'a.blend')
    frames = [17, 3, 8.5, 40, 3.25]
    found = poses(rig, frames)
    bpy.ops.wm.save_as_mainfile(filepath=path)
    import json
    said = subprocess.run([sys.executable, '-c', WITHOUT, path, json.dumps(frames)], capture_output=True, text=True).stdout
    line = next((line for line in said.splitlines() if line.startswith('poses ')), 'poses []')
    ok('a file moves without the add-on, untrusted', json.loads(line[6:]) == list(found.values()), said[-500:])
    bpy.ops.wm.open_mainfile(filepath=path + '.blend')
    rig = bpy.data.objects['Rig']
    ok('which keeps the settings when it saves it', len(rig.wiggly.chains) == 1 and rig.wiggly.splines[0].name == 'tail side')
    ok('and as it was once loaded again', poses(rig, frames) == found)
    key(rig, 'tail side', (20, 2))
    ok('and can be edited', apart(poses(rig, frames), found) > 0.01)


def undo():
    rig = wagging()
    bpy.ops.ed.undo_push(message='start')
    before = poses(rig, [5, 20])
    key(rig, 'tail side', (20, 2))
    bpy.ops.ed.undo_push(message='key')
    after = poses(rig, [5, 20])
    bpy.ops.ed.undo_push(message='more')
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    bpy.context.view_layer.update()
    ok('undo', poses(bpy.data.objects['Rig'], [5, 20]) == before)
    bpy.ops.ed.redo()
    bpy.context.view_layer.update()
    ok('redo', poses(bpy.data.objects['Rig'], [5, 20]) == after)
    bpy.data.objects['Rig'].wiggly.splines['tail side'].settle = True
    bpy.ops.ed.undo_push(message='settle')
    settled = poses(bpy.data.objects['Rig'], [5, 20])
    bpy.ops.ed.undo_push(message='more')
    for what, step, want in (('undo', bpy.ops.ed.undo, settled), ('undo', bpy.ops.ed.undo, after), ('redo', bpy.ops.ed.redo, settled)):
        step()
        bpy.context.view_layer.update()
        ok(f'{what} of keys that settle', poses(bpy.data.objects['Rig'], [5, 20]) == want and apart(settled, after) > 0.01)


def undo_of_an_edit_that_was_not_solved_yet():
    """Blender stores the step of an edit before it tells anybody of the edit."""
    rig = wagging()
    bpy.ops.ed.undo_push(message='start')
    curve = curves.find(rig, curves.path_of('tail side'))
    curve.keyframe_points[0].co[1] = 3
    curve.update()
    bpy.ops.ed.undo_push(message='edit')
    bpy.context.view_layer.update()
    after = poses(rig, [5, 20])
    rig.location.x = 1
    bpy.ops.ed.undo_push(message='more')
    bpy.context.view_layer.update()
    bpy.ops.ed.undo()
    bpy.context.view_layer.update()
    rig = bpy.data.objects['Rig']
    ok('the step of an edit shows the edit', rig.location.x == 0 and poses(rig, [5, 20]) == after, apart(poses(rig, [5, 20]), after))


def duplicate():
    rig = wagging()
    before = poses(rig, [5, 20])
    bpy.ops.object.mode_set(mode='OBJECT')
    for each in bpy.data.objects:
        each.select_set(each == rig)
    bpy.context.preferences.edit.use_duplicate_action = True
    bpy.ops.object.duplicate()
    copy = bpy.context.object
    ok('a copy moves alike', copy != rig and poses(copy, [5, 20]) == before)
    key(copy, 'tail side', (20, 2))
    ok('has keys of its own', apart(poses(copy, [5, 20]), before) > 0.1)
    ok('and leaves the first one alone', poses(rig, [5, 20]) == before)


def other_files():
    rig = wagging()
    before = poses(rig, [5, 20])
    bpy.ops.object.mode_set(mode='OBJECT')
    group = bpy.data.collections.new('Group')
    bpy.context.scene.collection.children.link(group)
    group.objects.link(rig)
    path = os.path.join(folder, 'library.blend')
    bpy.ops.wm.save_as_mainfile(filepath=path)

    fresh(object_name='Other')
    with bpy.data.libraries.load(path) as (_, to):
        to.objects = ['Rig']
    bpy.context.scene.collection.objects.link(to.objects[0])
    rig = to.objects[0]
    ok('appended, it moves alike', poses(rig, [5, 20]) == before)
    key(rig, 'tail side', (20, 2))
    ok('and can be edited', apart(poses(rig, [5, 20]), before) > 0.1)

    fresh(object_name='Other')
    bpy.ops.object.mode_set(mode='OBJECT')
    with bpy.data.libraries.load(path, link=True) as (_, to):
        to.collections = ['Group']
    scene = bpy.context.scene
    scene.collection.children.link(to.collections[0])
    linked = to.collections[0].objects[0]
    bpy.context.view_layer.update()
    ok('linked, it moves alike', poses(linked, [5, 20]) == before)
    override = to.collections[0].override_hierarchy_create(scene, bpy.context.view_layer)
    rig = override.objects[0]
    bpy.context.view_layer.update()
    ok('overridden, it moves alike', rig.override_library and poses(rig, [5, 20]) == before)
    rig.wiggly.splines[0].frequency = 2.5
    rig.animation_data.action = rig.animation_data.action.copy()
    key(rig, 'tail side', (20, 2))
    ok('and can have keys of its own', apart(poses(rig, [5, 20]), before) > 0.1)
    own = poses(rig, [5, 20])
    rig.wiggly.splines['tail side'].settle = True
    bpy.context.view_layer.update()
    said = solve.problems[solve.key_of(rig, rig.wiggly.splines['tail side'])]
    ok('which do not settle, and say so', poses(rig, [5, 20]) == own and 'library override' in said, said)
    here = os.path.join(folder, 'shot.blend')
    now = poses(rig, [5, 20])
    bpy.ops.wm.save_as_mainfile(filepath=here)
    bpy.ops.wm.open_mainfile(filepath=here)
    rig = next(each for each in bpy.data.objects if each.override_library)
    ok('which are kept', apart(poses(rig, [5, 20]), now) < 1e-6, apart(poses(rig, [5, 20]), now))


def renamed():
    rig = wagging()
    before = poses(rig, [5, 20])
    rig.data.bones['tail_2'].name = 'wag'
    key(rig, 'tail side', (10, 1))
    ok('a renamed bone moves on', poses(rig, [5, 20]) == before)
    rig.wiggly.chains[0].channels[0].gain *= 2
    bpy.context.view_layer.update()
    ok('and follows settings', apart(poses(rig, [5, 20]), before) > 0.1)


def everything(rig):
    """All of a rig that Remove must leave as it was."""
    drivers = [(d.data_path, d.array_index) for d in rig.animation_data.drivers] if rig.animation_data else []
    keys = {(c.data_path, c.array_index): curves.read(c) for c in curves.list_of(rig) or ()}
    return sorted(rig.keys()), drivers, keys, [[c.name for c in bone.constraints] for bone in rig.pose.bones]


def leaves_no_action():
    rig = fresh()
    add(rig)
    key(rig, 'tail side', (10, 1))
    bpy.ops.wiggly.remove()
    ok('Remove leaves no action where there was none', not rig.animation_data and not bpy.data.actions, list(bpy.data.actions))


def leaves_nothing():
    rig = fresh(bend=0.2)
    bone = rig.pose.bones['tail_2']
    bone.constraints.new('LIMIT_SCALE')
    rig['mine'] = 3.0
    for frame, angle in ((1, 0), (30, 1)):
        bone.rotation_mode = 'XYZ'
        bone.rotation_euler.x = angle
        bone.keyframe_insert('rotation_euler', frame=frame)
    before, shown = everything(rig), poses(rig, [5, 20])
    add(rig)
    key(rig, 'tail side', (10, 1))
    ok('it moves', apart(poses(rig, [5, 20]), shown) > 0.01)
    bpy.ops.wiggly.remove()
    now = everything(rig)
    ok('Remove leaves keys, properties, drivers and constraints as they were', now == before, now, before)
    ok('and the poses', poses(rig, [5, 20]) == shown)
    ok('and no splines', not settings.of(rig))


main(without_add_on, undo, undo_of_an_edit_that_was_not_solved_yet, duplicate, other_files, renamed, leaves_no_action, leaves_nothing)
