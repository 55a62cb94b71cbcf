#!/bin/bash
# Characters as a user meets them: Ctrl+7 from anywhere, scenes saved elsewhere, models that are missing or broken.
. tests/check.sh
WIGGLY=$(realpath "$WIGGLY")
root=$PWD

replay() { # <scene> <event>...: plays events on a scene, the document at the end is in $scratch/deep/result.json
    local scene=$1
    shift
    "$WIGGLY" live --no-draw --frames 1 --record "$scratch/header" "$scene" >/dev/null 2>&1
    { sed -n 1,6p "$scratch/header"; echo "frames 20"; printf '%s\n' "$@"; } >"$scratch/events"
    "$WIGGLY" live --no-draw --replay "$scratch/events" --result "$scratch/deep/result.json" "$scene"
}

mkdir -p "$scratch/deep"
cd "$scratch" || exit 1
expect 0 "Ctrl+7 opens Figure 7" replay "$root/assets/scenes/tail.json" "5 key 7 ctrl"
says "with the phases of its vertical movement" '"phases": "y"' "$(cat deep/result.json)"
expect 0 "saved in another folder it finds its model" "$WIGGLY" check deep/result.json
model=$(sed -n 's/.*"model": "\(.*\)",/\1/p' deep/result.json)
holds "by a path from there" [ -f "deep/$model" ]

cp "$root/assets/scenes/up-down.json" "$scratch/lost.json"
expect 1 "a missing model is a problem" "$WIGGLY" check lost.json
says "that names it" "creature.glb: " "$out"
expect 0 "the scene opens all the same" replay "$scratch/lost.json" "9 key Space"
says "and keeps its model's name" '"coordinates"' "$(cat deep/result.json)"
sed 's|"model": ".*"|"model": "cut.glb"|' lost.json >cut.json
head -c 5000 "$root/assets/models/creature.glb" >cut.glb
expect 1 "a model that was cut off is a problem" "$WIGGLY" check cut.json
says "that names it, in one sentence" "cut.glb: " "$out"
expect 0 "that scene opens too" "$WIGGLY" live --no-draw --frames 3 cut.json
sed 's|"name": "up"|"name": "sideways"|' "$root/assets/scenes/up-down.json" |
    sed "s|\"model\": \".*\"|\"model\": \"$root/assets/models/creature.glb\"|" >other.json
expect 1 "a coordinate that the model does not have is a problem" "$WIGGLY" check other.json
says "that says which it has" 'expected a coordinate called "sideways", got others, such as up' "$out"
