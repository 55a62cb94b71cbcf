#!/bin/sh
# Puts the npm package together: npm/build.sh BUILD. It comes to BUILD/npm/wiggly, and as a .tgz beside it.
set -eu
build=$(mkdir -p "$1/npm" && realpath "$1/npm")
cd "$(dirname "$0")"
package=$build/wiggly
rm -rf "$package" && mkdir "$package"
cp src/* package.json README.md ../LICENSE "$package"
cp src/index.d.ts "$package/index.d.cts"
# For require(): the modules one after the other, as one.
{
    echo "'use strict'"
    for name in solver options linear index; do sed '/^import /d; s/^export //' "src/$name.js"; done
    echo 'exports.spring = spring'
} >"$package/index.cjs"
command -v npm >/dev/null || { echo "Package: $package (npm, which makes a .tgz of it, is not installed)"; exit 0; }
cd "$package"
npm pack --silent --pack-destination "$build" >/dev/null
ls "$build"/wiggly-*.tgz
