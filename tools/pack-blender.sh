#!/bin/bash
# Writes the Blender extension: its modules, and the wheels of the Python package in the build folder. Usage: tools/pack-blender.sh BUILD VERSION
set -eu
ls "$1"/wheels/*.whl >/dev/null 2>&1 || { echo "$1/wheels has no wheel of the Python package: run make wheel" >&2; exit 1; }
build=$1 folder=$1/blender zip=$PWD/$1/wiggly-blender-$2.zip
case $1 in /*) zip=$1/wiggly-blender-$2.zip ;; esac
rm -rf "$folder" "$zip"
mkdir -p "$folder/wheels"
cp blender/wiggly_blender/* "$folder" 2>/dev/null || true # not the folder of compiled modules
cp "$build"/wheels/*.whl "$folder/wheels"
{
    sed "s/^version = .*/version = \"$2\"/" blender/wiggly_blender/blender_manifest.toml
    echo 'wheels = ['
    for wheel in "$folder"/wheels/*.whl; do echo "    \"./wheels/${wheel##*/}\","; done
    echo ']'
} >"$folder/blender_manifest.toml"
(cd "$folder" && python3 -m zipfile -c "$zip" *)
echo "wrote ${zip#"$PWD/"}"
