# wiggly rig from the outside: deep, packed and nameless characters. The rest has test_commands.c.
. tests/check.sh
dog=assets/models/dog.glb

head -c 5000 $dog >"$scratch/cut.glb"
expect 1 "check of one that was cut off" "$WIGGLY" check "$scratch/cut.glb"
# However deep nodes lie, all are listed, and in a moment: neither time nor text grows as their square.
awk 'BEGIN { printf "{\"asset\":{\"version\":\"2.0\"},\"nodes\":["
    for (i = 0; i < 9999; i++) printf "{\"name\":\"b%d\",\"children\":[%d,%d]},{\"name\":\"s%d\"},", i, 2 * i + 2, 2 * i + 1, i
    print "{\"name\":\"end\"}]}" }' >"$scratch/deep.gltf"
expect 0 "check of 10,000 bones, each below the one before" "$WIGGLY" check "$scratch/deep.gltf"
holds "lists all" [ "$(grep -cE '^ +(\([0-9]+ deep\) )?([bs][0-9]+|end)$' <<<"$out")" = 19999 ]
says "those beyond a screen's width with their depth" "(9999 deep) end" "$out"
says "each under its parent" "        b3
          s3
          b4
            s4" "$out"
expect 0 "the driver has nothing to remark" "$WIGGLY" live --headless --frames 3 --gl-debug assets/scenes/dog.json
holds "about the character's buffers" not grep -q OpenGL <<<"$err"

"$WIGGLY" rig $dog --chain tail_1:tail_8 --chain ear_1_L -c ear_1_R --frequency 2 -o "$scratch/dog.json" >"$scratch/said"
expect 0 "its splines follow the clip" "$WIGGLY" solve "$scratch/dog.json" -o "$scratch/dog.csv"
holds "and swing" [ "$(awk -F, 'NR > 1 && $3 * $3 > 1e-4' "$scratch/dog.csv" | wc -l)" -gt 5 ]
"$WIGGLY" rig $dog --chain tail_1 -o "$scratch/named.gltf" >/dev/null
sed 's/"name": *"\(Walk\|Trot\|Idle\)"/"extras": {}/' "$scratch/named.gltf" >"$scratch/nameless.gltf"
expect 0 "one without a name" "$WIGGLY" rig "$scratch/nameless.gltf" --chain ear_1_L -o "$scratch/nameless.json"
says "is said once" "1 chain; clip 0 loops" "$out"

for packed in draco meshopt; do
    file=tests/fuzz/seeds/gltf/$packed.glb
    "$WIGGLY" check "$file" >"$scratch/said" 2>&1 || { echo "skip - $(tail -n 1 "$scratch/said")"; continue; }
    for chain in "--chain root:tip" ""; do # without a chain nothing else changes
        expect 0 "a character compressed by $packed" "$WIGGLY" rig $file $chain -o "$scratch/packed.json"
        expect 0 "is exported" "$WIGGLY" export "$scratch/packed.json" -o "$scratch/plain.gltf"
        says "and said to be plain" "meshes decompressed" "$out"
        holds "with nothing compressed" not grep -qiE "draco|EXT_meshopt" "$scratch/plain.gltf"
        expect 0 "as it was read" "$WIGGLY" check "$scratch/plain.gltf"
        says "with all its triangles" "32 triangles and 2 joints" "$out"
    done
done

# Two animals of the same bones, and one whose bones have one name: a chain is on the bones that it names, and no others.
twins='{"asset":{"version":"2.0"},"nodes":[{"name":"rat","children":[1]},{"name":"tail_1","children":[2],"translation":[1,0,0]},
    {"name":"tail_2","translation":[1,0,0]},{"name":"rat","children":[4]},{"name":"tail_1","children":[5],"translation":[0,1,0]},
    {"name":"tail_2","translation":[0,1,0]}]}'
printf '%s' "$twins" >"$scratch/twins.gltf"
sed 's/"name":"[a-z_12]*"/"name":"bone"/g' "$scratch/twins.gltf" >"$scratch/bones.gltf"
expect 0 "two animals of the same bones" "$WIGGLY" rig "$scratch/twins.gltf"
says "have names of their own" "  rat:tail_2 (3 bones)
  rat 2:tail_2 2 (3 bones)" "$out"
for file in "twins:tail_1 2" "bones:bone 5"; do
    animal=${file%%:*}
    expect 0 "a chain on the second, in $animal" "$WIGGLY" rig "$scratch/$animal.gltf" --chain "${file#*:}" --plain -o "$scratch/$animal.json"
    sed -i 's/"knots": \[\]/"knots": [{ "frame": 0, "value": 1 }]/' "$scratch/$animal.json"
    expect 0 "which goes into a file" "$WIGGLY" export "$scratch/$animal.json" -o "$scratch/$animal.out.gltf"
    says "with two bones" "2 bones bent by chains" "$out"
    holds "and bends the second animal's" [ "$(grep -o '"node": *[0-9]*' "$scratch/$animal.out.gltf" | tr -dc '0-9\n' | sort -u | tr '\n' ' ')" = "4 5 " ]
done

skeleton=/usr/share/assimp/models/FBX/animation_with_skeleton.fbx
if [ -e $skeleton ] && command -v blender >/dev/null; then
    expect 0 "Blender converts FBX" tools/from-fbx.sh $skeleton "$scratch/skeleton.glb"
    says "with its bones and its clip" "chains you can use with --chain:
  Bone:Bone.006 (7 bones)" "$("$WIGGLY" check "$scratch/skeleton.glb")"
else
    echo "skip - Blender or assimp-testmodels is not installed"
fi
