#!/bin/sh
# Finds the optional libraries that decompress meshes, and prints their compiler and linker flags on a line. Draco is linked as an archive,
# so that src/model/draco.cpp can limit its allocations. Usage: tools/find-codecs.sh <compiler>
compiler=$1

there() { # <language> <header> <library>: prints where the library is
    # shellcheck disable=SC2086 # the compiler may have arguments
    echo "#include <$2>" | $compiler -x "$1" -E - >/dev/null 2>&1 || return 1
    # shellcheck disable=SC2086
    file=$($compiler -print-file-name="$3")
    [ "$file" != "$3" ] && echo "$file"
}

draco=$(there c++ draco/core/status.h libdraco.a) && draco="-DWITH_DRACO $draco -lstdc++"
meshopt=$(there c meshoptimizer.h libmeshoptimizer.so) && meshopt="-DWITH_MESHOPT -lmeshoptimizer"
echo $draco $meshopt
