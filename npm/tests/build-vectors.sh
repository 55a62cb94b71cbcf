#!/bin/sh
# The whole solver as a wasm module that is not shipped, for vectors.test.js: build-vectors.sh OUT.wasm
set -eu
unset LDFLAGS CFLAGS
export NODE_PATH=/usr/share/nodejs
cd "$(dirname "$0")"
# shellcheck disable=SC2046 # a list of files
emcc -std=gnu11 -O2 -fno-math-errno -fno-trapping-math -ffp-contract=off -I../../src -I../../include vectors.c ../../src/maths/maths.c $(ls ../../src/spline/*.c | grep -v batch) \
    -sSTANDALONE_WASM --no-entry -sEXPORTED_FUNCTIONS=_vector_numbers,_vector_solve,_vector_spring -sINITIAL_MEMORY=128MB -o "$1"
