# No command writes over what it reads: its operands, the models that a scene names, what these name, and other input. Paths are compared as files.
. tests/check.sh
quick=(--tets 60 --seconds 0.5 --substeps 1)
small=(--frames 0:1 --size 64x36)

# A folder of inputs.
mkdir "$scratch/all" "$scratch/all/sub"
cp assets/scenes/tail.json "$scratch/all/s.json"
sed 's|"\.\./models/dog.glb"|"dog.glb"|' assets/scenes/dog.json >"$scratch/all/dog.json"
cp assets/models/dog.glb "$scratch/all/dog.glb"
cat >"$scratch/all/cube.rest.obj" <<'END'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
END
cp "$scratch/all/cube.rest.obj" "$scratch/all/rest.obj"
head -c 36 /dev/zero >"$scratch/all/three.bin"
cat >"$scratch/all/three.gltf" <<'END'
{"asset": {"version": "2.0"}, "buffers": [{"uri": "three.bin", "byteLength": 36}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"name": "n", "mesh": 0}], "scenes": [{"nodes": [0]}]}
END
expect 0 "a model with a file of its own" "$WIGGLY" check "$scratch/all/three.gltf"
printf '{"wiggly": 1, "frames": [0, 9], "splines": [{"name": "s", "knots": []}], "rigs": [{"type": "model", "model": "three.gltf"}]}' \
    >"$scratch/all/three.json"
expect 0 "and a scene with it" "$WIGGLY" check "$scratch/all/three.json"
expect 0 "a motion" "$WIGGLY" simulate "$scratch/all/rest.obj" "${quick[@]}" -o "$scratch/all/up.npy"
cp "$scratch/all/rest.obj" "$scratch/all/up.rest.obj"
{
    printf '\x93NUMPY\x01\x00\x76\x00%-117s\n' "{'descr': '<f8', 'fortran_order': False, 'shape': (8,), }"
    head -c 64 /dev/zero
} >"$scratch/all/map.npy"
expect 0 "a replay" "$WIGGLY" live --no-draw --frames 2 --record "$scratch/all/r.replay" "$scratch/all/s.json"
ln "$scratch/all/s.json" "$scratch/all/hard.csv"
ln -s s.json "$scratch/all/soft.csv"
ln -s . "$scratch/all/here"
ln -s dog.glb "$scratch/all/walk.glb"
cp "$scratch/all/three.bin" "$scratch/all/w-0002.png"
sed 's/three.bin/w-0002.png/' "$scratch/all/three.gltf" >"$scratch/all/odd.gltf"
sed 's/three.gltf/odd.gltf/' "$scratch/all/three.json" >"$scratch/all/odd.json"
cp "$scratch/all/three.bin" "$scratch/all/sub/frame_00000.png"
sed 's|three.bin|sub/frame_00000.png|' "$scratch/all/three.gltf" >"$scratch/all/shots.gltf"
sed 's/three.gltf/shots.gltf/' "$scratch/all/three.json" >"$scratch/all/shots.json"

# A command is refused in a copy of the folder, with a sentence of both roles, and the copy stays as it is.
refuses() { # <what> <what the sentence says> <argument>...
    local what=$1 sentence=$2
    shift 2
    rm -rf "$scratch/copy"
    cp -a "$scratch/all" "$scratch/copy"
    expect 2 "$what" in_copy "$@"
    says "says so" "$sentence" "$err"
    holds "and changes nothing" diff -r --no-dereference "$scratch/all" "$scratch/copy"
}
program=$(realpath "$WIGGLY")
in_copy() { (cd "$scratch/copy" && "$program" "$@"); }

refuses "solve over its scene" "--output: s.json: cannot be written, because it is read as scene.json" solve s.json -o s.json
refuses "by another path" "read as scene.json" solve s.json -o sub/..//./s.json
refuses "through a folder that is a link" "read as scene.json" solve s.json -o here/s.json
refuses "through a link" "read as scene.json" solve s.json -o soft.csv
refuses "by a second name of the file" "read as scene.json" solve s.json -o hard.csv
refuses "solve over a model that it need not read" "dog.glb: cannot be written, because it is read as a model of the scene" solve dog.json -o dog.glb
for option in --log --screenshot --record --result; do
    refuses "live $option over its scene" "$option: s.json: cannot be written, because it is read as scene.json" \
        live --no-draw --frames 2 $option s.json s.json
    refuses "live $option over a model" "read as a model of the scene" live --headless --frames 2 $option dog.glb dog.json
    refuses "live $option over a model's file" "three.bin: cannot be written, because it is read as" live --headless --frames 2 $option three.bin three.json
done
refuses "live over its replay" "read as --replay" live --no-draw --replay r.replay --record r.replay s.json
refuses "live's pictures over a model's file" "frame_00000.png: cannot be written, because it is read as" live --headless --frames 2 --frames-dir sub shots.json
refuses "export over its model" "dog.glb: cannot be written, because it is read as a model of the scene" export dog.json -o dog.glb
refuses "through a link" "walk.glb: cannot be written" export dog.json -o walk.glb
refuses "export over its character" "read as scene.json" export dog.glb -o dog.glb
refuses "a film over a model's file" "w-0002.png: cannot be written" export odd.json "${small[@]}" -o w.png
refuses "rig over its character" "read as character.glb" rig dog.glb --chain tail_1:tail_8 -o dog.glb
refuses "simulate's rest mesh over its mesh" "cube.rest.obj: cannot be written, because it is read as MESH" simulate cube.rest.obj "${quick[@]}" -o cube.npy
refuses "simulate over its map" "map.npy: cannot be written, because it is read as map.npy" simulate rest.obj "${quick[@]}" --soft map.npy -o map.npy
refuses "analyze over its rest mesh" "read as --rest" analyze up.npy --rest rest.obj -o rest.obj
refuses "a scene over a rest mesh that analyze finds" "up.rest.obj: cannot be written" analyze up.npy -o x.glb --scene up.rest.obj
refuses "analyze over a motion" "read as up.npy" analyze up.npy --rest rest.obj -o up.npy

cd "$scratch/all" || exit
expect 0 "other files are written" "$program" export dog.json -o other.glb
expect 0 "and again" "$program" export dog.json -o other.glb
expect 0 "a recording under a new name" "$program" live --no-draw --replay r.replay --record new.replay s.json
