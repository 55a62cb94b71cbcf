#!/bin/sh
# Makes the source with what is known only while building: commit, compiler, flags. Left alone where nothing changed.
# Usage: tools/build-info.sh <output.c> <compiler> <flags>
set -eu
output=$1
commit=$(git describe --always --dirty --abbrev=12 --exclude '*' 2>/dev/null || echo unknown)
compiler=$("$2" --version | head -n 1 | tr -d '"\\')
mkdir -p "$(dirname "$output")"
{
    echo '#include "base/build.h"'
    echo
    echo "const char build_commit[] = \"$commit\";"
    echo "const char build_compiler[] = \"$compiler\";"
    echo "const char build_flags[] = \"$3\";"
} >"$output.new"
if cmp -s "$output.new" "$output"; then rm "$output.new"; else mv "$output.new" "$output"; fi
