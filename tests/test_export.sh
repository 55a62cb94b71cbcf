# Characters from the outside: wiggly rig and wiggly export, scenes whose models are elsewhere or broken; and the Khronos validator on every
# glTF file, where npm can fetch it (into the build folder). The rest has test_commands.c.
. tests/check.sh
go_to_scratch
scenes=$root/assets/scenes
dog=$root/assets/models/dog.glb

# --- files of a scene

wiggly export "$scenes/tail.json" -o tail.glb --quiet
wiggly export "$scenes/tail.json" -o TAIL.GLB --quiet
holds "the same scene gives the same bytes, by an ending in capitals" cmp -s tail.glb <(sed 's/TAIL/tail/' TAIL.GLB)
wiggly export "$scenes/tail.json" -o tail.usda --quiet
wiggly export "$scenes/dog.json" -o dog.usda --substeps 1 --quiet
texture=taken_textures/$(ls dog_textures)
mkdir -p "$texture"
tells 3 "a folder where the texture has to go" "$texture" wiggly export "$scenes/dog.json" -o taken.usda --substeps 1
holds "and there is no scene without its texture" [ ! -e taken.usda ]
for file in tail dog; do
    holds "$file.usda: what is opened is closed" [ "$(tr -cd '{(' <$file.usda | wc -c)" = "$(tr -cd '})' <$file.usda | wc -c)" ]
done

# Names of any length and script: whole where others look a bone up, and UTF-8 everywhere.
named() { # <name of a bone> <option>...: a file of three, numbered, with a chain
    printf '{"asset":{"version":"2.0"},"nodes":[{"name":"%s0","children":[1]},{"name":"%s1","children":[2],"translation":[0,1,0]},
        {"name":"%s2","translation":[0,1,0]}],"skins":[{"joints":[0,1,2]}]}' "$1" "$1" "$1" >named.gltf
    wiggly rig named.gltf --chain "${1}0" --plain -o named.json
}
exports() { # <scene> <ending>...
    local scene=$1 ending
    shift
    for ending in "$@"; do timeout 20 "$WIGGLY" export "$scene" -o "named.$ending" --frames 0:4 || return; done
}
for name in hair-front-left-strand-a-bone-0 character_rig_export_tail_spring_chain_bone_with_a_long_name_ \
    "x$(printf '尻尾%.0s' {1..30})" "Кость хвоста лисы, номер " "$(printf 'ab%.0s' {1..300})"; do
    expect 0 "bones called ${name::20}…" named "$name"
    expect 0 "are exported" exports named.json glb usda bvh csv
    holds "have three names in the .usda" [ "$(grep -m1 'joints = ' named.usda | grep -o '[^"/]*",' | sort -u | wc -l)" = 2 ]
    holds "all text is UTF-8" iconv -f UTF-8 -t UTF-8 -o /dev/null named.usda named.bvh named.json
    holds "are whole in the .bvh" grep -qF "ROOT $(tr ' ' _ <<<"${name}0")" named.bvh
done
holds "names that are too long for USD are there in full" grep -qF "jointNames = [\"${name}0\", " named.usda
named '左.' >said
expect 0 "bones of another script" exports named.json usda
holds "have their letters" grep -qF 'joints = ["左_0", "左_0/左_1", "左_0/左_1/左_2"]' named.usda
holds "and their names" grep -qF 'jointNames = ["左.0", "左.1", "左.2"]' named.usda
for name in "$(printf 'Персонаж_%.0s' {1..8})" "x$(printf '尻%.0s' {1..40})"; do
    sed "s/\"name\": \"tail\"/\"name\": \"$name\"/" "$scenes/tail.json" >"$name.json"
    expect 0 "a scene and a rig called ${name::9}…" exports "$name.json" glb usda bvh
    holds "the rig has its name in the .bvh" grep -q "^ROOT ${name}_" named.bvh
    holds "and in the .usda" grep -qF "displayName = \"$name\"" named.usda
done

# A character of several files stays beside them.
size=$(od -An -tu4 -j12 -N4 "$dog" | tr -d ' ')
mkdir beside away stop
tail -c +21 "$dog" | head -c "$size" | sed 's/"buffers": *\[{/&"uri":"dog.bin",/' >beside/dog.gltf
tail -c +$((size + 29)) "$dog" >beside/dog.bin
expect 0 "a character in two files" wiggly rig beside/dog.gltf --chain tail_1 -o beside/walk.json
expect 0 "is exported beside them" wiggly export beside/walk.json -o beside/out.gltf
tells 1 "but to no other folder" "refers to files beside it: export it to the same folder, or as .glb" wiggly export beside/walk.json -o away/out.gltf

"$WIGGLY" export "$scenes/tail.json" --substeps 1024 -o stop/long.pc2 2>said &
begun() { ls -A stop | grep -q .; }
await begun
kill -INT $!
wait $!
holds "Ctrl+C ends it" [ $? -eq 3 ]
holds "and leaves nothing" [ -z "$(ls -A stop)" ]
says "and says so" "interrupted; nothing was written" "$(<said)"

# --- deep, nameless and packed characters

head -c 5000 "$dog" >cut.glb
tells 1 "check of one that was cut off" "cut.glb: " wiggly check cut.glb
# However deep nodes lie, all are listed, and in a moment: neither time nor text grows as their square.
awk 'BEGIN { printf "{\"asset\":{\"version\":\"2.0\"},\"nodes\":["
    for (i = 0; i < 9999; i++) printf "{\"name\":\"b%d\",\"children\":[%d,%d]},{\"name\":\"s%d\"},", i, 2 * i + 2, 2 * i + 1, i
    print "{\"name\":\"end\"}]}" }' >deep.gltf
tells 0 "10,000 bones, each below the one before; those beyond a screen's width with their depth" "(9999 deep) end" wiggly check deep.gltf
holds "all are listed" [ "$(grep -cE '^ +(\([0-9]+ deep\) )?([bs][0-9]+|end)$' <<<"$out")" = 19999 ]
says "each under its parent" "        b3
          s3
          b4
            s4" "$out"
if draws; then
    expect 0 "a character is drawn" wiggly live --headless --frames 3 --gl-debug "$scenes/dog.json"
    holds "the driver has nothing to remark about its buffers" not grep -q OpenGL <<<"$err"
fi

expect 0 "chains on the dog" wiggly rig "$dog" --chain tail_1:tail_8 --chain ear_1_L -c ear_1_R --frequency 2 -o dog.json
expect 0 "its splines follow the clip" wiggly solve dog.json -o dog.csv
holds "and swing" [ "$(awk -F, 'NR > 1 && $3 * $3 > 1e-4' dog.csv | wc -l)" -gt 5 ]
wiggly rig "$dog" --chain tail_1 -o clips.gltf >said
sed 's/"name": *"\(Walk\|Trot\|Idle\)"/"extras": {}/' clips.gltf >nameless.gltf
tells 0 "a clip without a name is said once" "1 chain; clip 0 loops" wiggly rig nameless.gltf --chain ear_1_L -o nameless.json

for packed in draco meshopt; do
    file=$root/tests/fuzz/seeds/gltf/$packed.glb
    wiggly check "$file" >said 2>&1 || { echo "skip - $(tail -n 1 said)"; continue; }
    for chain in "--chain root:tip" ""; do # without a chain nothing else changes
        expect 0 "a character compressed by $packed" wiggly rig "$file" $chain -o packed.json
        tells 0 "is exported, and said to be plain" "meshes decompressed" wiggly export packed.json -o plain.gltf
        holds "with nothing compressed" not grep -qiE "draco|EXT_meshopt" plain.gltf
        tells 0 "and all its triangles" "32 triangles and 2 joints" wiggly check plain.gltf
    done
done

# Two animals of the same bones, and one whose bones have one name: a chain is on the bones that it names, and no others.
printf '{"asset":{"version":"2.0"},"nodes":[{"name":"rat","children":[1]},{"name":"tail_1","children":[2],"translation":[1,0,0]},
    {"name":"tail_2","translation":[1,0,0]},{"name":"rat","children":[4]},{"name":"tail_1","children":[5],"translation":[0,1,0]},
    {"name":"tail_2","translation":[0,1,0]}]}' >twins.gltf
sed 's/"name":"[a-z_12]*"/"name":"bone"/g' twins.gltf >bones.gltf
tells 0 "two animals of the same bones have names of their own" "  rat:tail_2 (3 bones)
  rat 2:tail_2 2 (3 bones)" wiggly rig twins.gltf
for file in "twins:tail_1 2" "bones:bone 5"; do
    animal=${file%%:*}
    expect 0 "a chain on the second, in $animal" wiggly rig $animal.gltf --chain "${file#*:}" --plain -o $animal.json
    sed -i 's/"knots": \[\]/"knots": [{ "frame": 0, "value": 1 }]/' $animal.json
    tells 0 "goes into a file with two bones" "2 bones bent by chains" wiggly export $animal.json -o $animal.out.gltf
    holds "the second animal's" [ "$(grep -o '"node": *[0-9]*' $animal.out.gltf | tr -dc '0-9\n' | sort -u | xargs)" = "4 5" ]
done

zeros=$(printf 'A%.0s' {1..48})
printf '{"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:;base64,%s"}],"bufferViews":[{"buffer":0,"byteLength":36}],
    "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],"nodes":[{"name":"face","mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":0},{"POSITION":0}]}]}],"extensions":{"VRM":
    {"blendShapeMaster":{"blendShapeGroups":[{"name":"Joy","binds":[{"mesh":0,"index":1,"weight":100}]}]}}}}' "$zeros" >joy.gltf
tells 0 "the shapes of VRM have names" "shapes:
  Joy" wiggly rig joy.gltf
expect 0 "and so they have in a .usda" wiggly rig joy.gltf -o joy.usda
says "beside one without" '"target_0", "Joy"' "$(<joy.usda)"

fbx=/usr/share/assimp/models/FBX/animation_with_skeleton.fbx
if [ -e $fbx ] && command -v blender >/dev/null; then
    expect 0 "Blender converts FBX" "$root/tools/from-fbx.sh" $fbx skeleton.glb
    tells 0 "with its bones and its clip" "chains you can use with --chain:
  Bone:Bone.006 (7 bones)" wiggly check skeleton.glb
else
    echo "skip - Blender or assimp-testmodels is not installed"
fi

# --- as a user meets them: an example from anywhere, scenes saved elsewhere, models that are missing or broken

session() { # <scene> <event>...: plays them; the document at the end is in deep/result.json
    wiggly live --no-draw --frames 1 --record header "$1" >said 2>&1
    { sed -n 1,6p header; echo "frames 20"; printf '%s\n' "${@:2}"; } >events
    wiggly live --no-draw --replay events --result deep/result.json "$1"
}
mkdir deep
expect 0 "Examples opens Figure 7" session "$scenes/tail.json" "$(example 5 "phases")"
says "with the phases of its vertical movement" '"phases": "y"' "$(<deep/result.json)"
expect 0 "saved in another folder it finds its model" wiggly check deep/result.json
holds "by a path from there" [ -f "deep/$(sed -n 's/.*"model": "\(.*\)",/\1/p' deep/result.json)" ]
cp "$scenes/up-down.json" lost.json
tells 1 "a missing model is a problem" "creature.glb: " wiggly check lost.json
echo '{"frames": [0, 1], "background": {"file": "gone.mp4"}}' >gone.json
tells 1 "and a missing background" "/gone.mp4: the background is missing" wiggly check gone.json
expect 0 "the scene opens all the same" session lost.json "9 key Space"
says "and keeps its model's name" '"coordinates"' "$(<deep/result.json)"
sed 's|"model": ".*"|"model": "cut.glb"|' lost.json >cut.json
tells 1 "a model that was cut off is a problem" "cut.glb: " wiggly check cut.json
expect 0 "that scene opens too" wiggly live --no-draw --frames 3 cut.json
sed "s|\"name\": \"up\"|\"name\": \"sideways\"|; s|\"model\": \".*\"|\"model\": \"$root/assets/models/creature.glb\"|" lost.json >other.json
tells 1 "a coordinate that the model does not have is a problem" 'expected a coordinate called "sideways", got others, such as up' wiggly check other.json

# --- the validator

command -v node >/dev/null && command -v npm >/dev/null || { echo "skip - there is no npm, so no glTF validator"; exit $cases_failed; }
cd "$root" && npm_has "$B/gltf-validator" validator || exit $cases_failed
cd "$scratch" || exit 1
validated() { # <what> <what it says of each file> <file>...
    expect 0 "the validator reads $1" node "$root/tests/others/validate.js" "$B/gltf-validator" "${@:3}"
    holds "without a complaint" [ "$(grep -c "0 errors, 0 warnings$2" <<<"$out")" -eq $(($# - 2)) ]
}
mkdir own
for scene in tail character $(thorough && echo follow figure7 compositing); do
    wiggly export "$scenes/$scene.json" -o own/$scene.glb --quiet
    wiggly export "$scenes/$scene.json" -o own/$scene-signed.gltf --signed --quiet
done
validated "what wiggly makes" ", 0 infos, 0 hints" own/*
wiggly export "$scenes/dog.json" -o dog.glb --quiet
read=(dog.glb box.glb)
if thorough; then
    for ending in glb gltf; do wiggly export "$scenes/dog.json" -o plain-dog.$ending --quiet; done
    read+=(plain-dog.glb plain-dog.gltf "$dog")
fi
# A box with colours, shaken; and the dog of the tree.
write_box box.obj
sed -i -e 's/^v 0 0 0$/& 1 0.5 0/' -e 's/^v 0 2 0$/& 0.2 0.1 0/' box.obj
expect 0 "simulate" wiggly simulate box.obj --tets 60 --seconds 1 --substeps 2 -o up.npy
expect 0 "analyze" wiggly analyze up.npy --rest box.obj --fps 24 --modes 2 -o box.glb
validated "a character with a new clip, and what wiggly analyze writes" "" "${read[@]}"
