# The same program in WebAssembly: recorded sessions end in the native documents byte for byte, and every scene solves to the same bits.
. tests/check.sh
. tests/web/page.sh node
mkdir -p "$scratch/native" "$scratch/wasm"

for replay in tests/replays/*.replay; do
    name=$(basename "$replay" .replay)
    scene=tests/replays/$name.json
    [ "$name" != pins ] || scene=assets/scenes/hands.json
    [ "$name" != walk ] || scene=assets/models/dog.glb
    echo "live --no-draw --replay $replay $scene --result OUT/$name.json"
done >"$scratch/commands"
for scene in assets/scenes/*.json tests/vectors/*.json; do
    grep -q '"wiggly"' "$scene" && echo "solve $scene -o OUT/$(basename "$scene" .json).csv"
done >>"$scratch/commands"

sed "s|OUT|$scratch/native|" "$scratch/commands" | while read -r line; do "$WIGGLY" $line >/dev/null 2>&1; done
sed "s|OUT|/here$scratch/wasm|" "$scratch/commands" | node --no-experimental-fetch tests/web/node.js "$(realpath "$page/wiggly.js")"
holds "there are sessions and scenes" [ "$(ls "$scratch/native" | wc -l)" -gt 100 ]
for file in "$scratch/native"/*; do
    holds "$(basename "$file") is the same" cmp "$file" "$scratch/wasm/$(basename "$file")"
done
[ $cases_failed -eq 0 ]
