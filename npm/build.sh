#!/bin/sh
# Builds the npm package: npm/build.sh BUILD. It comes to BUILD/npm/wiggly, and as a .tgz beside it.
# The solver without what springs never reach (bands, loops, limits, variations, moving equilibria): those functions become imports.
set -eu
build=$(mkdir -p "$1/npm" && realpath "$1/npm")
cd "$(dirname "$0")"
package=$build/wiggly
sources="src/spring.c ../src/maths/maths.c"
for name in spline solver problem complete poles chain chain_nodes chain_tables chain_gradient tail desc pose scale; do
    sources="$sources ../src/spline/$name.c"
done
unset LDFLAGS CFLAGS
export NODE_PATH=/usr/share/nodejs # where Debian keeps what emcc needs
mkdir -p "$package"
# shellcheck disable=SC2086 # the list is split on purpose
emcc -std=gnu11 -O2 -flto -mbulk-memory -fno-math-errno -fno-trapping-math -ffp-contract=off -Wall -Wextra -Werror \
    -I../src -I../include $sources \
    -sSTANDALONE_WASM --no-entry -sEXPORTED_FUNCTIONS=_spring_room,_spring_solve,_spring_swing -sERROR_ON_UNDEFINED_SYMBOLS=0 \
    -sWARN_ON_UNDEFINED_SYMBOLS=0 -sMALLOC=none -sFILESYSTEM=0 -sTOTAL_STACK=65536 -sINITIAL_MEMORY=1MB -sALLOW_MEMORY_GROWTH \
    -o "$build/solver.wasm"
# As text, so that nothing has to be fetched; hexadecimal, because that compresses best.
printf "export const wasm = '%s'\n" "$(od -An -v -tx1 "$build/solver.wasm" | tr -d ' \n')" >"$package/wasm.js"
cp src/index.js src/solver.js src/index.d.ts package.json README.md ../LICENSE "$package"
command -v npm >/dev/null || { echo "Package: $package (npm, which makes a .tgz of it, is not installed)"; exit 0; }
cd "$package"
npm pack --silent --pack-destination "$build" >/dev/null
ls "$build"/wiggly-*.tgz
