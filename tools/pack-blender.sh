#!/bin/bash
# Writes the Blender extension: its modules, and the wheels of the Python package. Usage: tools/pack-blender.sh BUILD VERSION PLATFORM...
set -eu
build=$(realpath "$1") version=$2
folder=$build/blender zip=$build/wiggly-blender-$2.zip
shift 2
rm -rf "$folder" "$zip"
mkdir -p "$folder/wheels"
cp LICENSE blender/wiggly_blender/*.py "$folder"
{
    echo 'wheels = ['
    for platform; do
        wheel=wiggly-$version-py3-none-$platform.whl
        cp "$build/wheels/$wheel" "$folder/wheels"
        echo "    \"./wheels/$wheel\","
    done
    echo ']'
    sed "s/^version = .*/version = \"$version\"/" blender/wiggly_blender/blender_manifest.toml
} >"$folder/blender_manifest.toml"
(cd "$folder" && python3 -m zipfile -c "$zip" *)
echo "wrote $zip"
