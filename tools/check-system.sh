#!/bin/sh
# Reports missing build requirements before compiling.
# Usage: tools/check-system.sh <compiler> <pkg-config module>...
set -eu
compiler=${1%% *}
shift
command -v "$compiler" >/dev/null || { echo "wiggly: there is no compiler '$compiler'; install it or choose another with CC=" >&2; exit 3; }
pkg-config --print-errors --exists "$@" || exit 3
tools/find-parts.sh >/dev/null
