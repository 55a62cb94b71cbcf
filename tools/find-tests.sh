#!/bin/sh
# Prints the tests that the words name: FILE or FILE:CASE. A word is a room (spline), a file (test_curves, curves.c, spline/test_spline,
# tests/test_cli.sh) or a case. Without a word it prints all tests; those of faults and hosts only with THOROUGH=1.
cd "$(dirname "$0")/.." || exit 1
if [ $# -eq 0 ]; then
    for test in tests/*/test_*.c; do [ "${test#tests/faults/}" != "$test" ] || set -- "$@" "$test"; done
    set -- "$@" tests/test_*.sh ${THOROUGH:+faults hosts}
fi
for word in "$@"; do
    path=tests/${word#tests/}
    name=${word##*/}
    name=${name#test_}
    name=${name%.*}
    if [ -f "$path" ]; then
        echo "$path"
    elif [ -f "$path.c" ]; then
        echo "$path.c"
    elif ! { ls "$path"/test_* || ls tests/*/"test_$name".* tests/"test_$name.sh" | grep . ||
        grep -HE "^[A-Z]*_?TEST[A-Z_]*\((.*, )?(test_)?$name[,)]" tests/*/test_*.c |
        sed -E "s/^([^:]*):.*\W((test_)?$name)[,)].*/\1:\2/" | grep .; } 2>/dev/null; then
        echo "make test: no room, file or case of tests is called $word" >&2
        exit 1
    fi
done
