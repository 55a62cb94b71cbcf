#!/bin/bash
# Exports scenes and has programs of others evaluate every file: three.js under Node, Blender without a window (bpy) and usd-core, each
# against our own vertices (.pc2), to 1e-5 of the size. They are fetched into the build folder at pinned versions; a step whose program
# cannot be had is skipped with a word. Usage: tests/others/proof.sh, with B (build folder) and WIGGLY (the program).
. tests/check.sh
here=tests/others
place=$B/proof
mkdir -p "$place"

have_three() {
    [ -e "$place/node_modules/three/package.json" ] ||
        timeout 120 npm install --silent --no-audit --no-fund --no-save --prefix "$place" three@0.187.0
}
have_python() { # <module> <package>
    [ -x "$place/venv/bin/python" ] || python3 -m venv "$place/venv" || return 1
    "$place/venv/bin/python" -c "import importlib.util as u, sys; sys.exit(u.find_spec('$1') is None)" ||
        timeout 900 "$place/venv/bin/pip" install --quiet numpy "$2"
}
fetched() { # <what> <command>...
    local what=$1
    shift
    "$@" >"$scratch/fetch" 2>&1 && return 0
    echo "ok - skipped: $what could not be fetched: $(tail -n 1 "$scratch/fetch")"
    return 1
}
export_to() { # <scene> <file> <option>...
    local file=$2 scene=assets/scenes/$1.json
    [ -e "$scene" ] || scene=$scratch/$1.json
    shift 2
    "$WIGGLY" export "$scene" -o "$scratch/$file" --quiet "$@" || ok "export of $file" 1
}
compares() { # <what> <command>...
    expect 0 "$@"
    tail -n 1 <<<"$out" | sed 's/^/  /'
}

# scene, and the rigs that it has
scenes="tail:tail follow:tail character:character figure7:character compositing:nodder,swayer dog:dog"
others= # made of .gltf files of Debian's assimp-testmodels: morph targets; bones with a scale that no half has, without normals
models=/usr/share/assimp/models/glTF2
if [ -d $models ]; then
    sed 's/"rotation" : \[ 0.0, 0.0, 0.0, 1.0 \]/"scale" : [ 1.2, 0.7, 1.3 ], &/' $models/simple_skin/simple_skin.gltf >"$scratch/strip.gltf"
    "$WIGGLY" rig "$scratch/strip.gltf" --chain "node 1" -o "$scratch/strip.json" >"$scratch/rig" 2>&1 || ok "a chain of the strip" 1
    cat >"$scratch/cube.json" <<END
{ "wiggly": 1, "frames": [0, 96], "splines": [{ "name": "none", "knots": [] }], "rigs": [{ "type": "model", "name": "cube", "clip": "Square",
  "model": "$models/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", "position": [1, 2, 3], "scale": 0.5, "turn": 30 }] }
END
    others="cube:cube strip:strip"
else
    echo "ok - skipped: assimp-testmodels is not installed"
fi
caches() { # <scene> <rigs>: their files, in the order of the meshes
    for rig in ${2//,/ }; do echo "$scratch/$1-$rig.pc2"; done
}
for entry in $scenes $others; do
    scene=${entry%%:*} rigs=${entry#*:}
    export_to "$scene" "$scene.glb" --substeps 1
    export_to "$scene" "$scene.usda" --substeps 1
    for rig in ${rigs//,/ }; do export_to "$scene" "$scene-$rig.pc2" --rig "$rig" --substeps 1; done
done
export_to dog turned.gltf --substeps 1 --keys cubic
cp "$scratch/dog-dog.pc2" "$scratch/turned-dog.pc2"
for scene in tail follow dog; do export_to $scene $scene.bvh --substeps 1; done

# shellcheck disable=SC2046 # the caches are split on purpose
each_scene() { # <who> <ending> <scenes> <command>...
    local who=$1 ending=$2 scenes=$3 entry
    shift 3
    for entry in $scenes; do
        case $entry in *:dog) export CLIP=Walk ;; *) unset CLIP ;; esac
        compares "$who: ${entry%%:*}.$ending" "$@" "$scratch/${entry%%:*}.$ending" $(caches "${entry%%:*}" "${entry#*:}")
    done
}
if fetched three.js have_three; then each_scene three.js glb "$scenes" node $here/three.mjs "$place"; fi
if fetched usd-core have_python pxr usd-core==26.11; then each_scene usd-core usda "$scenes $others" "$place/venv/bin/python" $here/usd.py; fi
if fetched bpy have_python bpy bpy==4.5.15; then
    each_scene Blender glb "$scenes" "$place/venv/bin/python" $here/blender.py
    each_scene Blender gltf turned:dog "$place/venv/bin/python" $here/blender.py
    for scene in tail follow dog; do
        if [ $scene = dog ]; then export CLIP=Walk; else unset CLIP; fi
        compares "Blender: $scene.bvh" "$place/venv/bin/python" $here/blender.py "$scratch/$scene.bvh" "$scratch/$scene.glb"
    done
fi
