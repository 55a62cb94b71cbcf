#!/bin/sh
# Makes assets/models/creature.glb, as anyone can from a mesh of their own: the mesh, two shakes of it as a soft body, and what
# the analysis finds in them. Takes about 35 s of one core. Usage: tools/make-creature.sh [build folder] [output.glb]
set -eu
export LC_ALL=C
build=${1:-build}
out=${2:-assets/models/creature.glb}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$build/creature_obj" "$work/creature.obj"
for shake in up side; do
    "$build/wiggly" simulate "$work/creature.obj" --shake $shake --damping 0.05 --seconds 4 --fps 48 -o "$work/$shake.npy"
done
mkdir -p "$(dirname "$out")"
"$build/wiggly" analyze "$work/up.npy" "$work/side.npy" --rest "$work/creature.obj" --fps 48 -o "$out"
