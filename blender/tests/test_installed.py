"""The zip that `make blender` writes, named in ZIP, installs as an extension and moves a bone."""
import os
import sys
import tempfile

os.environ['BLENDER_USER_RESOURCES'] = tempfile.mkdtemp()
sys.path = [each for each in sys.path if not each.endswith('python/src')]  # its own wheel
import bpy

good = 'ZIP' not in os.environ
if good:
    print('ok - skipped: there is no wheel, so nothing to install')
else:
    bpy.ops.wm.read_factory_settings()
    bpy.ops.extensions.package_install_files(filepath=os.path.abspath(os.environ['ZIP']), repo='user_default', enable_on_install=True)
    bpy.ops.object.armature_add()
    rig = bpy.context.object
    bpy.ops.object.mode_set(mode='POSE')
    bpy.ops.pose.select_all(action='SELECT')
    bpy.ops.wiggly.add(follow=False)
    bpy.context.scene.frame_set(5)
    rig['Bone side'] = 1.0
    rig.keyframe_insert('["Bone side"]')
    bpy.context.view_layer.update()
    bpy.context.scene.frame_set(5)
    seen = rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones[0]
    import wiggly
    angle = (rig.data.bones[0].matrix_local.inverted() @ seen.matrix).to_quaternion().angle
    good = abs(angle - 1.91986) < 1e-4 and os.environ['BLENDER_USER_RESOURCES'] in wiggly.__file__
    print(('ok' if good else 'not ok') + ' - the packed extension installs and moves a bone', angle, wiggly.__file__)
sys.stdout.flush()
os._exit(not good)
