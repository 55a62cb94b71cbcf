#!/bin/bash
# Exports scenes and has programs of others evaluate every file: three.js under Node, Blender without a window (bpy) and usd-core, each
# against our own vertices (.pc2), to 1e-5 of the size. They are fetched into the build folder at pinned versions; a step whose program
# cannot be had is skipped with a word. Prints the table of tests/README.md as it is measured; an error on the page that is smaller fails.
# Usage: tests/others/proof.sh, with B (build folder) and WIGGLY (the program).
. tests/check.sh
here=tests/others
place=$B/proof
mkdir -p "$place"

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
compares() { # <who: file> <command>...
    expect 0 "$@"
    tail -n 1 <<<"$out" | sed 's/^/  /'
    local ending=.${1##*.}
    case $out in *"scaled bones"*) ending+=", scaled bones" ;; esac
    sed -n "\$s/.* \([^ ]*\) of the size/$ending|${1%%:*}|\1/p" <<<"$out" >>"$scratch/measured"
}

# in the units of its file, not as large as on the stage
sed "s|\.\./models|$PWD/assets/models|; s/\"scale\": 1,/\"scale\": 0.3,/; s/\"position\": \[0, 0, 0\]/\"position\": [1, 2, 3]/; s/\"turn\": 0/\"turn\": 40/" \
    assets/scenes/dog.json >"$scratch/small.json"
# flesh that swings in the walk, before the skin
"$WIGGLY" flesh assets/models/dog.glb --tets 300 --substeps 2 -o "$scratch/flesh.glb" --scene "$scratch/soft.json" >"$scratch/rig" || ok "flesh on the dog" 1
# scene, and the rigs that it has
scenes="tail:tail follow:tail character:model figure7:model compositing:nodder,swayer dog:dog small:dog soft:flesh"
others= # made of .gltf files of Debian's assimp-testmodels: morph targets; bones with a scale that no half has, without normals
models=/usr/share/assimp/models/glTF2
if [ -d $models ]; then
    sed 's/"rotation" : \[ 0.0, 0.0, 0.0, 1.0 \]/"scale" : [ 1.2, 0.7, 1.3 ], &/' $models/simple_skin/simple_skin.gltf >"$scratch/strip.gltf"
    "$WIGGLY" rig "$scratch/strip.gltf" --chain "node 2" -o "$scratch/strip.json" >"$scratch/rig" 2>&1 || ok "a chain of the strip" 1
    cat >"$scratch/cube.json" <<END
{ "wiggly": 1, "frames": [0, 96], "splines": [{ "name": "none", "knots": [] }], "rigs": [{ "type": "model", "name": "cube", "clip": "Square",
  "model": "$models/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", "position": [1, 2, 3], "scale": 0.5, "turn": 30 }] }
END
    others="cube:cube strip:strip"
else
    echo "ok - skipped: assimp-testmodels is not installed"
fi
caches() { # <scene> <rigs> <ending>: their files, in the order of the meshes. A .pc2 stands in its node, these .npy on the stage, as the .usda do
    for rig in ${2//,/ }; do echo "$scratch/$1-$rig.$3"; done
}
for entry in $scenes $others; do
    scene=${entry%%:*} rigs=${entry#*:}
    export_to "$scene" "$scene.glb" --substeps 1
    export_to "$scene" "$scene.usda" --substeps 1 --as-shown
    for rig in ${rigs//,/ }; do
        export_to "$scene" "$scene-$rig.pc2" --rig "$rig" --substeps 1
        export_to "$scene" "$scene-$rig.npy" --rig "$rig" --substeps 1 --as-shown
    done
done
# a file with all of its clips
clips="Walk Trot Idle"
"$WIGGLY" rig assets/models/dog.glb --chain tail_1 --all-clips -o "$scratch/packed.glb" >"$scratch/rig" 2>&1 || ok "all clips of the dog" 1
for clip in $clips; do # with the strength that the chain has in the first of them
    "$WIGGLY" rig assets/models/dog.glb --chain tail_1 --clip "$clip" -o "$scratch/$clip.json" >"$scratch/rig"
    awk 'match($0, /"gain": [-0-9.e]+/) { here = substr($0, RSTART, RLENGTH); if (NR == FNR) gain[++n] = here; else sub(here, gain[++m]) }
        NR > FNR' "$scratch/Walk.json" "$scratch/$clip.json" >"$scratch/same.json"
    "$WIGGLY" export "$scratch/same.json" -o "$scratch/packed-$clip.pc2" --quiet --rig dog --substeps 1 || ok "the cache of $clip" 1
done
export_to dog turned.gltf --substeps 1
cp "$scratch/dog-dog.pc2" "$scratch/turned-dog.pc2"
for scene in tail follow dog small; do export_to $scene $scene.bvh --substeps 1; done

# shellcheck disable=SC2046 # the caches are split on purpose
each_scene() { # <who> <ending> <scenes> <command>...
    local who=$1 ending=$2 scenes=$3 entry
    shift 3
    for entry in $scenes; do
        case $entry in *:dog | *:flesh) export CLIP=Walk ;; *) unset CLIP ;; esac
        compares "$who: ${entry%%:*}.$ending" "$@" "$scratch/${entry%%:*}.$ending" \
            $(caches "${entry%%:*}" "${entry#*:}" "$([ "$ending" = usda ] && echo npy || echo pc2)")
    done
}
if npm_has "$place" three validator; then
    each_scene three.js glb "$scenes" node $here/three.mjs "$place"
    for clip in $clips; do
        export CLIP=$clip
        compares "three.js: $clip of packed.glb" node $here/three.mjs "$place" "$scratch/packed.glb" "$scratch/packed-$clip.pc2"
    done
    expect 0 "the validator reads all of them" node $here/validate.js "$place" "$scratch"/*.gl*
    holds "without an error" [ "$(grep -c ': 0 errors' <<<"$out")" -eq "$(ls "$scratch"/*.gl* | wc -l)" ]
fi
if fetched usd-core timeout 900 python/fetch.sh "$B/python" numpy usd; then each_scene usd-core usda "$scenes $others" "$B/python/bin/python" $here/usd.py; fi
if fetched bpy timeout 900 python/fetch.sh "$place/venv" bpy-4.5.15; then
    each_scene Blender glb "$scenes" "$place/venv/bin/python" $here/blender.py
    each_scene Blender gltf turned:dog "$place/venv/bin/python" $here/blender.py
    for scene in tail follow dog small; do
        if [ $scene = dog ] || [ $scene = small ]; then export CLIP=Walk; else unset CLIP; fi
        compares "Blender: $scene.bvh" "$place/venv/bin/python" $here/blender.py "$scratch/$scene.bvh" "$scratch/$scene.glb"
    done
fi

# --- the table of tests/README.md, as measured; no error on the page may be smaller

sed -n 's/^| `\(\.[^|]*\) | \([^|]*\) | \([0-9.e-]*\) |$/\1|\2|\3/p' tests/README.md | tr -d '`' >"$scratch/promised"
awk -F'|' 'NR == FNR { most[$1 "|" $2] = $3; next } { who = $1 "|" $2; files[who]++; if ($3 + 0 > largest[who] + 0) largest[who] = $3 }
    END { for (who in files) { split(who, part, "|"); kept = largest[who] + 0 <= most[who] + 0; bad += !kept
        printf "| `%s` | %s | %s of the size in %d files |%s\n", part[1], part[2], largest[who], files[who], kept ? "" : " tests/README.md says " most[who] }
        exit bad > 0 }' "$scratch/promised" "$scratch/measured" >"$scratch/table"
ok "tests/README.md has no smaller errors" $?
LC_ALL=C sort "$scratch/table"
