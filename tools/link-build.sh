#!/bin/sh
# Prints a name without spaces, build/links/N, by which a build folder can be reached whose own name has some.
# Usage: tools/link-build.sh <folder>
set -eu
mkdir -p "$1" build/links
link=build/links/$(printf '%s' "$1" | cksum | cut -d ' ' -f 1)
ln -sfn "$(readlink -f "$1")" "$link"
echo "$link"
