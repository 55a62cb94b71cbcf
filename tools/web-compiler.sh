#!/bin/sh
# Prints Emscripten's clang with the flags that emcc calls it with; emcc itself where its clang is not found.
# Usage: tools/web-compiler.sh <emcc>
config=${1%emcc}em-config
version=$($config CLANG_ADD_VERSION 2>/dev/null) # Debian's has one in its name
clang=$($config LLVM_ROOT 2>/dev/null)/clang${version:+-$version}
[ -x "$clang" ] && flags=$($1 --cflags 2>/dev/null) && echo "$clang $flags" || echo "$1"
