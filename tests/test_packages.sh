# tools/install-missing.sh on systems that this one is not: packages missing, root or not, no apt at all. The system's own
# commands are replaced by stand-ins on PATH that note how they were called.
. tests/check.sh
script=$PWD/tools/install-missing.sh
stand_ins=$scratch/bin
mkdir "$stand_ins"
calls=$scratch/calls

stand_in() { # <name> <body>
    printf '#!/bin/sh\n%s\n' "$2" >"$stand_ins/$1"
    chmod +x "$stand_ins/$1"
}

on_that_system() { PATH=$stand_ins /bin/sh "$script" "$@"; }

# dpkg-query: everything but cppcheck is there. The one real call asks for a list and prints a line each.
stand_in dpkg-query 'shift 3; for p in "$@"; do [ $p = cppcheck ] || printf "%s installed " "$p"; done'
stand_in apt-get "echo \"\$*\" >>$calls"
stand_in apt-cache 'exit 0'
stand_in id 'echo 0'
stand_in env 'while [ "${1#*=}" != "$1" ]; do shift; done; exec "$@"'

: >"$calls"
expect 0 "nothing missing: nothing done" on_that_system build test
[ ! -s "$calls" ] && [ -z "$out" ]
ok "and nothing said" $?

expect 0 "as root it installs" on_that_system check
says "just what is missing" "install -y -qq --no-install-recommends cppcheck" "$(cat "$calls")"
says "and says so" "Installing: cppcheck" "$out"
says "once" "1" "$(wc -l <"$calls")"

# The package lists of a fresh system are empty: the first attempt fails, then they are fetched.
stand_in apt-get "echo \"\$1\" >>$calls; [ \$1 = update ] || [ \"\$(/usr/bin/wc -l <$calls)\" -gt 1 ]"
: >"$calls"
expect 0 "an empty package list is filled" on_that_system check
says "between two attempts" "install update install" "$(tr '\n' ' ' <"$calls")"

# Ubuntu 22.04 has no JetBrains Mono.
stand_in dpkg-query 'shift 3; for p in "$@"; do case $p in fonts-j* | fonts-d*) ;; *) printf "%s installed " "$p" ;; esac; done'
stand_in apt-cache '[ "$2" != fonts-jetbrains-mono ]'
stand_in apt-get "echo \"\$*\" >>$calls"
: >"$calls"
expect 0 "a package that the system lacks is replaced" on_that_system build
says "by the next best" "install -y -qq --no-install-recommends fonts-dejavu-core" "$(cat "$calls")"
stand_in dpkg-query 'shift 3; for p in "$@"; do case $p in fonts-j*) ;; *) printf "%s installed " "$p" ;; esac; done'
: >"$calls"
expect 0 "which is left in peace once it is there" on_that_system build
holds "and nothing installed" [ ! -s "$calls" ]
stand_in dpkg-query 'shift 3; for p in "$@"; do [ $p = cppcheck ] || printf "%s installed " "$p"; done'
stand_in apt-cache 'exit 0'

# Draco is good to have: it comes along with others where the system has it, and is no reason to install anything.
without() { stand_in dpkg-query "shift 3; for p in \"\$@\"; do case \$p in $1) ;; *) printf '%s installed ' \"\$p\" ;; esac; done"; }
stand_in apt-cache '[ "$2" != libmeshoptimizer-dev ]'
without 'libdraco-dev | libmeshoptimizer-dev'
: >"$calls"
expect 0 "what is good to have may be missing" on_that_system build
holds "and nothing is installed" [ ! -s "$calls" ]
without 'libdraco-dev | libmeshoptimizer-dev | gcc'
expect 0 "on a bare system" on_that_system build
says "it is installed with the rest, where it exists" "--no-install-recommends gcc libdraco-dev" "$(cat "$calls")"
without cppcheck
stand_in apt-cache 'exit 0'

stand_in apt-get 'exit 100'
expect 3 "apt-get that fails is reported" on_that_system check
says "with the package" "could not install: cppcheck" "$err"

stand_in id 'echo 1000'
expect 3 "not root and no sudo" on_that_system check
says "names the command to run" "apt-get install cppcheck" "$err"

stand_in sudo "echo \"sudo \$*\" >>$calls"
: >"$calls"
expect 0 "not root but sudo" on_that_system check
says "goes through sudo" "sudo env DEBIAN_FRONTEND=noninteractive apt-get install" "$(cat "$calls")"

rm "$stand_ins/apt-get"
expect 3 "a system without apt" on_that_system check
says "is told what is missing" "wiggly needs: clang-format-14 cppcheck" "$err"
stand_in clang-format-14 ''
stand_in cppcheck ''
expect 0 "and left in peace where all is there" on_that_system check
