# wiggly export from the outside: what it makes, Ctrl+C; and the Khronos validator on every glTF file, where npm can fetch
# it (into the build folder).
. tests/check.sh
. tests/box.sh
folder=${B:-build}/gltf-validator
scenes=assets/scenes

"$WIGGLY" export $scenes/tail.json -o "$scratch/tail.glb" --quiet
"$WIGGLY" export $scenes/tail.json -o "$scratch/TAIL.GLB" --quiet
holds "the same scene gives the same bytes, by an ending in capitals" cmp -s "$scratch/tail.glb" <(sed 's/TAIL/tail/' "$scratch/TAIL.GLB")
"$WIGGLY" export $scenes/tail.json -o "$scratch/tail.usda" --quiet
"$WIGGLY" export $scenes/dog.json -o "$scratch/dog.usda" --substeps 1 --quiet
texture=$(ls "$scratch/dog_textures")
mkdir -p "$scratch/taken_textures/$texture"
expect 3 "a folder where the texture has to go" "$WIGGLY" export $scenes/dog.json -o "$scratch/taken.usda" --substeps 1
says "is named" "taken_textures/$texture" "$err"
holds "and there is no scene without its texture" [ ! -e "$scratch/taken.usda" ]
for file in tail dog; do
    tr -cd '{(' <"$scratch/$file.usda" | wc -c >"$scratch/opened"
    tr -cd '})' <"$scratch/$file.usda" | wc -c >"$scratch/closed"
    holds "$file.usda: what is opened is closed" cmp -s "$scratch/opened" "$scratch/closed"
done

# Names of any length and script: whole where others look a bone up, and UTF-8 everywhere.
skeleton() { # <name of a bone>: a file of three, numbered
    printf '{"asset":{"version":"2.0"},"nodes":[{"name":"%s0","children":[1]},{"name":"%s1","children":[2],"translation":[0,1,0]},' "$1" "$1"
    printf '{"name":"%s2","translation":[0,1,0]}],"skins":[{"joints":[0,1,2]}]}' "$1"
}
for name in hair-front-left-strand-a-bone-0 character_rig_export_tail_spring_chain_bone_with_a_long_name_ \
    "x$(printf '尻尾%.0s' {1..30})" "Кость хвоста лисы, номер " "$(printf 'ab%.0s' {1..300})"; do
    what=${name::20}…
    skeleton "$name" >"$scratch/named.gltf"
    expect 0 "bones called $what" "$WIGGLY" rig "$scratch/named.gltf" --chain "${name}0" --plain -o "$scratch/named.json"
    for ending in glb usda bvh csv; do
        expect 0 "as .$ending" timeout 20 "$WIGGLY" export "$scratch/named.json" -o "$scratch/named.$ending"
    done
    holds "have three names in the .usda" [ "$(grep -m1 'joints = ' "$scratch/named.usda" | grep -o '[^"/]*",' | sort -u | wc -l)" = 2 ]
    for text in "$scratch/named.usda" "$scratch/named.bvh" "$scratch/named.json"; do
        holds "${text##*.} is UTF-8" iconv -f UTF-8 -t UTF-8 -o /dev/null "$text"
    done
    holds "are whole in the .bvh" grep -qF "ROOT $(tr ' ' _ <<<"${name}0")" "$scratch/named.bvh"
done
holds "names that are too long for USD are there in full" grep -qF "jointNames = [\"${name}0\", " "$scratch/named.usda"
skeleton '左.' >"$scratch/named.gltf"
"$WIGGLY" rig "$scratch/named.gltf" --chain '左.0' --plain -o "$scratch/named.json" >"$scratch/said"
expect 0 "bones of another script as .usda" "$WIGGLY" export "$scratch/named.json" -o "$scratch/named.usda"
holds "have their letters" grep -qF 'joints = ["左_0", "左_0/左_1", "左_0/左_1/左_2"]' "$scratch/named.usda"
holds "and their names" grep -qF 'jointNames = ["左.0", "左.1", "左.2"]' "$scratch/named.usda"
for name in "$(printf 'Персонаж_%.0s' {1..8})" "x$(printf '尻%.0s' {1..40})"; do
    sed "s/\"name\": \"tail\"/\"name\": \"$name\"/" $scenes/tail.json >"$scratch/$name.json"
    for ending in glb usda bvh; do
        expect 0 "a scene and a rig called ${name::9}… as .$ending" "$WIGGLY" export "$scratch/$name.json" -o "$scratch/long.$ending" --frames 0:4
    done
    holds "the rig has its name in the .bvh" grep -q "^ROOT ${name}_" "$scratch/long.bvh"
    holds "and in the .usda" grep -qF "displayName = \"$name\"" "$scratch/long.usda"
done

# A character of several files stays beside them.
size=$(od -An -tu4 -j12 -N4 assets/models/dog.glb | tr -d ' ')
mkdir "$scratch/beside" "$scratch/away"
tail -c +21 assets/models/dog.glb | head -c "$size" | sed 's/"buffers": *\[{/&"uri":"dog.bin",/' >"$scratch/beside/dog.gltf"
tail -c +$((size + 29)) assets/models/dog.glb >"$scratch/beside/dog.bin"
expect 0 "a character in two files" "$WIGGLY" rig "$scratch/beside/dog.gltf" --chain tail_1 -o "$scratch/beside/walk.json"
expect 0 "is exported beside them" "$WIGGLY" export "$scratch/beside/walk.json" -o "$scratch/beside/out.gltf"
expect 1 "but to no other folder" "$WIGGLY" export "$scratch/beside/walk.json" -o "$scratch/away/out.gltf"
says "which is explained" "refers to files beside it: export it to the same folder, or as .glb" "$err"

mkdir "$scratch/stop"
"$WIGGLY" export $scenes/tail.json --substeps 1024 -o "$scratch/stop/long.pc2" 2>"$scratch/stderr" &
for _ in $(seq 100); do
    ls -A "$scratch/stop" | grep -q . && break
    sleep 0.05
done
kill -INT $!
wait $!
[ $? -eq 3 ] && [ -z "$(ls -A "$scratch/stop")" ]
ok "Ctrl+C ends it and leaves nothing" $?
says "and says so" "interrupted; nothing was written" "$(<"$scratch/stderr")"

# --- the validator

command -v node >/dev/null && command -v npm >/dev/null || { echo "skip - there is no npm, so no glTF validator"; exit $cases_failed; }
npm_has "$folder" validator || exit $cases_failed
mkdir "$scratch/own"
own=$(thorough && echo tail follow character figure7 compositing || echo tail character)
for scene in $own; do
    "$WIGGLY" export $scenes/$scene.json -o "$scratch/own/$scene.glb" --quiet
    "$WIGGLY" export $scenes/$scene.json -o "$scratch/own/$scene-cubic.gltf" --keys cubic --signed --quiet
done
expect 0 "the validator reads what wiggly makes" node tests/others/validate.js "$folder" "$scratch"/own/*.gl*
holds "without a complaint" [ "$(grep -c "0 errors, 0 warnings, 0 infos, 0 hints" <<<"$out")" -eq $((2 * $(wc -w <<<"$own"))) ]
"$WIGGLY" export $scenes/dog.json -o "$scratch/dog-cubic.glb" --keys cubic --quiet
read=("$scratch/dog-cubic.glb" "$scratch/box.glb")
if thorough; then
    "$WIGGLY" export $scenes/dog.json -o "$scratch/dog.glb" --quiet
    "$WIGGLY" export $scenes/dog.json -o "$scratch/dog.gltf" --quiet
    read+=("$scratch/dog.glb" "$scratch/dog.gltf" assets/models/dog.glb)
fi
# A box with colours, shaken; and the dog of the tree.
write_box "$scratch/plain.obj"
sed -e 's/^v 0 0 0$/& 1 0.5 0/' -e 's/^v 0 2 0$/& 0.2 0.1 0/' "$scratch/plain.obj" >"$scratch/box.obj"
expect 0 "simulate" "$WIGGLY" simulate "$scratch/box.obj" --tets 60 --seconds 1 --substeps 2 -o "$scratch/up.npy"
expect 0 "analyze" "$WIGGLY" analyze "$scratch/up.npy" --rest "$scratch/box.obj" --fps 24 --modes 2 -o "$scratch/box.glb"
expect 0 "the validator reads an imported character with a new clip, and what wiggly analyze writes" node tests/others/validate.js \
    "$folder" "${read[@]}"
holds "without an error or a warning" [ "$(grep -c "0 errors, 0 warnings" <<<"$out")" -eq ${#read[@]} ]
