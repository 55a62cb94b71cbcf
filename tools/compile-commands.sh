#!/bin/sh
# Makes a compilation database (compile_commands.json) from the compiler calls that `make -n` prints.
# Usage: make -n V=1 ... | tools/compile-commands.sh > compile_commands.json   from the root of the tree
set -eu
sed -nE '/ -c [^ ]+\.c -o /{ s/[\\"]/\\&/g; s/^.* -c ([^ ]+\.c) -o .*$/\1\n&/p; }' |
    awk -v folder="$PWD" '
    BEGIN { print "[" }
    NR % 2 { file = $0; next }
    { printf "%s{\"directory\": \"%s\", \"file\": \"%s\", \"command\": \"%s\"}", (NR > 2 ? ",\n" : ""), folder, file, $0 }
    END { print "\n]" }'
