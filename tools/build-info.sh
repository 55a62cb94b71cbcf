#!/bin/sh
# Makes a source file with the build's commit, compiler and flags. Leaves it alone if nothing changed.
# Usage: tools/build-info.sh <output.c> <compiler> <flags>
set -eu
output=$1
# Root may build in another user's clone, which git calls dubious and must not write to.
git() { GIT_OPTIONAL_LOCKS=0 command git -c safe.directory='*' "$@" 2>/dev/null; }
commit=$(git rev-parse --short=12 HEAD || echo unknown)
[ -z "$(git status --porcelain --untracked-files=no || true)" ] || commit=$commit-dirty
# shellcheck disable=SC2086 # the compiler may have a prefix (ccache gcc)
compiler=$($2 --version | sed -n '1{s/["\\]//g;p;}')
mkdir -p "$(dirname "$output")"
new=$output.$$ # several may be at it at once
{
    echo '#include "base/embedded.h"'
    echo
    echo "const char build_commit[] = \"$commit\";"
    echo "const char build_compiler[] = \"$compiler\";"
    echo "const char build_flags[] = \"$3\";"
} >"$new"
if cmp -s "$new" "$output"; then rm "$new"; else mv "$new" "$output"; fi
