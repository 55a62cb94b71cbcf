#!/bin/sh
# Converts an FBX character with all its clips to glTF. Needs Blender.
# Usage: tools/from-fbx.sh <character.fbx> [<character.glb>]
set -eu
[ $# -ge 1 ] && [ $# -le 2 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
command -v blender >/dev/null || { echo "from-fbx: there is no blender; install it" >&2; exit 3; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# Blender exports an object's clip and those on its tracks. Its glTF add-on uses a name that NumPy has removed.
blender --background --factory-startup --python-exit-code 1 --python-expr '
import sys, bpy, numpy
if not hasattr(numpy, "bool"): numpy.bool = bool
source, target = sys.argv[-2:]
bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
bpy.ops.import_scene.fbx(filepath=source)
for thing in bpy.data.objects:
    clips = [action for action in bpy.data.actions if action.name.startswith(thing.name + "|")]
    for action in clips if thing.animation_data else []:
        thing.animation_data.action = None
        thing.animation_data.nla_tracks.new().strips.new(action.name, 1, action)
bpy.ops.export_scene.gltf(filepath=target, export_format="GLTF_SEPARATE" if target.endswith(".gltf") else "GLB")
' -- "$1" "${2:-${1%.*}.glb}" >"$log" 2>&1 || { grep -m 1 'Error:' "$log" >&2; exit 1; }
