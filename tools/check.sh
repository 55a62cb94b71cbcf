#!/bin/sh
# Checks formatting, static analysis, include directions and circles, lengths and file heads of all C files. Prints problems; exit status 1
# if there are any.
set -u
files=$(find src include tests tools examples -name '*.[ch]' | sort)
failed=""

step() { # <name> <command>...
    name=$1
    shift
    if "$@"; then echo "check: $name is fine"; else failed="$failed $name"; fi
}

formatted() { # <file>...
    wrong=$(clang-format-14 --dry-run "$@" 2>&1 | sed -n 's/^\([^:]*\):[0-9]*:[0-9]*: \(warning\|error\): .*/\1/p' | sort -u)
    [ -z "$wrong" ] && return 0
    echo "Not formatted (clang-format-14 -i FILE does it):" $wrong
    return 1
}

analyse() {
    cppcheck --quiet --error-exitcode=1 --enable=warning,performance,portability --inline-suppr --std=c11 \
        --suppress=missingIncludeSystem -j "$(nproc)" \
        -D_GNU_SOURCE -Isrc -Iinclude -Itools src tools 2>&1
}

# shellcheck disable=SC2086 # the list is split on purpose
step format formatted $files
step arrows tools/check-arrows.sh
step circles tools/check-circles.sh
# shellcheck disable=SC2086
step lengths tools/check-lengths.sh $files
# shellcheck disable=SC2086
step heads tools/check-heads.sh $files
step analysis analyse
[ -z "$failed" ] || { echo "check failed:$failed" >&2; exit 1; }
