#!/bin/sh
# Prints a path without spaces, build/links/N, for a build folder whose own path has some.
# Usage: tools/link-build.sh <folder>
set -eu
mkdir -p "$1" build/links
link=build/links/$(printf '%s' "$1" | cksum | cut -d ' ' -f 1)
ln -sfn "$(readlink -f "$1")" "$link"
echo "$link"
