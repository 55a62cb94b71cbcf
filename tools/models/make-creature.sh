#!/bin/sh
# Makes assets/models/creature.glb, as you can from any mesh: the mesh, a soft-body simulation with two bursts of its base and limbs eight
# times softer than feet, and the result's analysis. The bursts' frequencies lie between those of trunk and limbs, so that limbs lag behind.
# Takes about a minute of one core. Usage: tools/models/make-creature.sh [build folder] [output.glb]
set -eu
export LC_ALL=C
build=${1:-build}
out=${2:-assets/models/creature.glb}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$build/creature_obj" "$work/creature.obj"
shake() { # <direction> <amplitude>
    "$build/wiggly" simulate "$work/creature.obj" --shake "$1" --amplitude "$2" --drive burst --drive-frequency 2.75 --young 1e6 \
        --poisson 0.45 --damping 0.2 --soft distance --seconds 3 --fps 48 -o "$work/$1.npy"
}
shake up 0.05
shake side 0.09 # a larger swing would change the volume by more than 5 % at amplitude 1: a linear shape lengthens what turns
mkdir -p "$(dirname "$out")"
# As in the paper, by complex principal components; otherwise each coordinate would have one pole.
# The stage computes how normals turn, so the file omits that.
"$build/wiggly" analyze "$work/up.npy" "$work/side.npy" --method cpca --modes 3 --no-normals -o "$out"
