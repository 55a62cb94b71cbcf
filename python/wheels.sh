#!/bin/bash
# Builds wheels of the Python package with PyPI's zig, which compiles for all platforms: wheels.sh BUILD [PLATFORM]...
# They come to BUILD/wheels, zig and its cache to BUILD/python. The first Windows wheel takes minutes.
set -eu
build=$(mkdir -p "$1" && realpath "$1")
folder=$build/python
shift
declare -A targets=(
    [manylinux_2_17_x86_64]=x86_64-linux-gnu.2.17
    [manylinux_2_17_aarch64]=aarch64-linux-gnu.2.17
    [musllinux_1_2_x86_64]=x86_64-linux-musl
    [musllinux_1_2_aarch64]=aarch64-linux-musl
    [win_amd64]=x86_64-windows-gnu
    [macosx_11_0_x86_64]=x86_64-macos.11.0
    [macosx_11_0_arm64]=aarch64-macos.11.0
)
python=$folder/bin/python
"$(dirname "$0")/fetch.sh" "$folder" wheel
export ZIG_GLOBAL_CACHE_DIR=$folder/zig ZIG_LOCAL_CACHE_DIR=$folder/zig
cd "$(dirname "$0")"
[ $# -gt 0 ] || set -- "${!targets[@]}"
for platform; do
    WIGGLY_PLATFORM=$platform CC="'$python' -m ziglang cc -target ${targets[$platform]}" \
        "$python" -m hatchling build -t wheel -d "$build/wheels"
done
