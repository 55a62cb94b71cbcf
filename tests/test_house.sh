# What keeps the house in order: checks of includes and lengths fail where it is broken, for a check that cannot fail proves nothing; limits
# and promises name their tests; tools/install-missing.sh knows systems that this one is not; and the library from outside: its names, and
# how it is built by other compilers, for other machines and under the thread sanitizer.
. tests/check.sh
CC=${CC:-gcc}

# --- include arrows, circles and lengths: rows of files, each with its only line, in a tree of their own

tree=$scratch/tree
plant() { # <file of src> <its only line>... into an empty tree
    rm -rf "$tree"
    mkdir -p "$tree/include/wiggly"
    echo '#include <stddef.h>' >"$tree/include/wiggly/wiggly.h"
    while [ $# -gt 0 ]; do
        mkdir -p "$tree/src/$(dirname "$1")"
        echo "#include $2" >"$tree/src/$1"
        shift 2
    done
}
expect 0 "the tree itself follows the arrows" tools/check-arrows.sh
json="jansson.h belongs in src/scene, src/base/json.h, src/app/settings.c, src/commands/companion.c and the glTF files of src/model and src/export alone"
while IFS='|' read -r file line said; do
    plant "$file" "$line"
    tells 1 "$file must not have $line" "src/$file:1: $said" tools/check-arrows.sh "$tree"
done <<END_OF_ROWS
spline/a.c|"scene/document.h"|spline must not include scene/document.h
spline/a.c|<stdio.h>|the spline core does no I/O
editor/a.c|"draw/draw.h"|editor must not include draw/draw.h
draw/a.c|"editor/editor.h"|draw must not include editor/editor.h
draw/a.c|<epoxy/gl.h>|src/draw reaches GL through draw/gl.h alone
editor/a.c|<GLFW/glfw3.h>|GLFW/glfw3.h belongs in src/draw and src/platform alone
model/a.c|<jansson.h>|$json
base/a.c|"error.h"|"error.h" must be written with its folder
rig/a.c|<cglm/vec3.h>|cglm comes through model/vector.h
editor/curves/a.c|"editor/stage/stage.h"|editor/curves must not include editor/stage/stage.h
editor/core/a.c|"editor/curves/curves.h"|editor/core must not include editor/curves/curves.h
editor/stage/a.c|"editor/state.h"|editor/stage must not include editor/state.h
editor/a.c|"editor/curves/state.h"|editor/curves/state.h is private to editor/curves: the way in is editor/curves/curves.h
app/a.c|"editor/core/state.h"|app must not include editor/core/state.h
END_OF_ROWS
while IFS='|' read -r file header line said; do
    plant "$file" "\"$header\"" "$header" "$line"
    tells 1 "$file must not get $line through $header" "src/$file:1: $said (through $header)" tools/check-arrows.sh "$tree"
done <<END_OF_ROWS
draw/a.c|ui/stage.h|"rig/posing.h"|draw must not include rig/posing.h
commands/a.c|model/glb.h|<jansson.h>|$json
model/a.c|model/glb.h|<jansson.h>|$json
app/a.c|draw/gl.h|<epoxy/gl.h>|epoxy/gl.h belongs in src/draw and src/platform alone
model/a.c|base/status.h|<wiggly/wiggly.h>|model must not include wiggly/wiggly.h
END_OF_ROWS
plant draw/a.c '"ui/stage.h"' ui/stage.h '"model/fox.h"' model/fox.h '"base/error.h"' editor/a.c '"editor/curves/curves.h"' \
    editor/curves/b.c '"editor/core/state.h"' editor/stage/c.c '"editor/stage/state.h"'
expect 0 "what follows the arrows is fine, and so are doors, core and one's own room" tools/check-arrows.sh "$tree"
plant misc/a.c '"base/error.h"'
tells 1 "there is no other room" "src/misc is not a room of the house" tools/check-arrows.sh "$tree"

expect 0 "no circle of includes in the tree is larger than those that are known" tools/check-circles.sh
plant ui/a.c '"ui/b.h"' ui/b.c '"ui/c.h"' ui/c.c '"ui/a.h"'
tells 0 "three files may include each other in a circle" "3 files: ui/" tools/check-circles.sh "$tree"
plant ui/a.c '"ui/b.h"' ui/b.h '"ui/c.h"' ui/c.c '"ui/d.h"' ui/d.h '"ui/a.h"' draw/a.c '"ui/a.h"'
tells 1 "four are refused, without those that only look in" "src: 4 files include each other in a circle: " tools/check-circles.sh "$tree"

{ printf '%s\n' 'void long_one(void)' '{' && yes '    ;' | head -n 119 && echo '}'; } >"$scratch/long.c"
expect 1 "a function of 121 lines is refused" tools/check-lengths.sh "$scratch/long.c"
seq 1201 >"$scratch/long.h"
expect 1 "a file of 1,201 lines is refused" tools/check-lengths.sh "$scratch/long.h"

# --- limits and promises: each that a user can meet has its test

limits() {
    grep -rhoE '\b[A-Z0-9_]*_?(MAX|LIMIT|LARGEST|MOST)(_[A-Z0-9_]+)? = [0-9A-Z(]|#define [A-Z_]*(MAX|MOST|LIMIT)[A-Z_]* ' \
        src/{scene,base,model,export,app,commands} src/analysis/analysis.h src/simulation/{integrator,soft}.c include/wiggly |
        sed 's/#define //; s/ =.*//; s/ $//' | grep -vE '^(DRAG|HOVER|PARAMETER|WIGGLY_ERROR)_LIMIT$' | LC_ALL=C sort -u
}
none() { # <what> <lines that should not be>
    [ -z "$2" ] || printf '  %s\n' "$2"
    holds "$1" [ -z "$2" ]
}
none "tests/limits.txt has every limit in the source" "$(limits | grep -vxFf <(grep -oE '^[A-Z0-9_]+' tests/limits.txt))"
tests=$(find tests -maxdepth 2 -name 'test_*' -printf '%f\n')
none "and each names its test, or says why there is none" \
    "$(grep -v '^#' tests/limits.txt | cut -f 2 | sed -E 's/^(test_[^, ]*).*/\1/' | grep -v '^room:' | grep -vxF "$tests")"
promises=$(sed -n '/^## Promises/,/^## [^P]/p' tests/README.md | grep -E '^\| [^*-]')
holds "there are promises" [ "$(wc -l <<<"$promises")" -gt 20 ]
none "they name tests that are there" "$(grep -oE 'test_[a-z_0-9]+\.(c|sh)' <<<"$promises" | sort -u | grep -vxF "$tests")"
none "and one for each promise" "$(grep -vE '`test_|^\| Promise ' <<<"$promises")"

# --- packages: missing ones, root or not, no apt at all. Stand-ins on PATH note how they were called

stand_ins=$scratch/bin calls=$scratch/calls
mkdir "$stand_ins"
stand_in() { # <name> <body>
    printf '#!/bin/sh\n%s\n' "$2" >"$stand_ins/$1"
    chmod +x "$stand_ins/$1"
}
# dpkg-query: everything but these is there. The one real call asks for a list and prints a line each.
without() { stand_in dpkg-query "shift 3; for p in \"\$@\"; do case \$p in $1) ;; *) printf '%s installed ' \"\$p\" ;; esac; done"; }
script=$PWD/tools/install-missing.sh
installs() { # <status> <what> <what is called, or said> <set>...
    : >"$calls"
    expect "$1" "$2" env PATH="$stand_ins" /bin/sh "$script" "${@:4}"
    if [ -z "$3" ]; then none "$2: nothing is done and nothing said" "$(<"$calls")$out"; else says "$2: so it is" "$3" "$(tr '\n' ' ' <"$calls")$out$err"; fi
}
apt="-y -qq -o DPkg::Lock::Timeout=600 --no-install-recommends"
stand_in apt-get "echo \"\$*\" >>$calls"
stand_in apt-cache 'exit 0'
stand_in id 'echo 0'
stand_in env 'while [ "${1#*=}" != "$1" ]; do shift; done; exec "$@"'
without cppcheck
installs 0 "nothing is missing" "" build test
installs 0 "as root it installs just what is missing, once" "install $apt cppcheck Installing: cppcheck" check
# The package lists of a fresh system are empty: the first attempt fails, then they are fetched.
stand_in apt-get "echo \"\$1\" >>$calls; [ \$1 = update ] || [ \"\$(/usr/bin/wc -l <$calls)\" -gt 1 ]"
installs 0 "an empty package list is filled between two attempts" "install update install" check
# Ubuntu 22.04 has no JetBrains Mono.
stand_in apt-get "echo \"\$*\" >>$calls"
stand_in apt-cache '[ "$2" != fonts-jetbrains-mono ]'
without 'fonts-j* | fonts-d*'
installs 0 "a package that the system lacks is replaced by the next best" "install $apt fonts-dejavu-core" build
without 'fonts-j*'
installs 0 "which is left in peace once it is there" "" build
# Draco is good to have: it comes along with others where the system has it, and is no reason to install anything.
stand_in apt-cache '[ "$2" != libmeshoptimizer-dev ]'
without 'libdraco-dev | libmeshoptimizer-dev'
installs 0 "what is good to have may be missing" "" build
without 'libdraco-dev | libmeshoptimizer-dev | gcc'
installs 0 "on a bare system it is installed with the rest, where it exists" "install $apt gcc libdraco-dev" build
without cppcheck
stand_in apt-cache 'exit 0'
stand_in apt-get 'exit 100'
installs 3 "apt-get that fails is reported with the package" "could not install: cppcheck" check
stand_in id 'echo 1000'
installs 3 "not root and no sudo: the command to run is named" "apt-get install cppcheck" check
stand_in sudo "echo \"sudo \$*\" >>$calls"
installs 0 "not root goes through sudo" "sudo env DEBIAN_FRONTEND=noninteractive apt-get install" check
rm "$stand_ins/apt-get"
installs 3 "a system without apt is told what is missing" "wiggly needs: clang-format-14 cppcheck" check
stand_in clang-format-14 ''
stand_in cppcheck ''
installs 0 "and left in peace where all is there" "" check

# --- the library's names

version=$(sed -n 's/.*define WIGGLY_VERSION "\(.*\)"/\1/p' include/wiggly/wiggly.h)
shared=$B/libwiggly.so.$version
sed -nE 's/^[a-z].*[ *](wiggly_[a-z_]+)\(.*/\1/p' include/wiggly/*.h | sort >"$scratch/promised"
holds "the headers promise functions" [ -s "$scratch/promised" ]
names() { nm --defined-only "$@" | awk 'NF == 3 { print $3 }' | sort; } # what is defined there and seen from outside
names -g "$B/libwiggly.a" >"$scratch/static"
names -D "$shared" | grep -v '^__\|^_init$\|^_fini$' >"$scratch/shared" # a sanitizer's own
for kind in static shared; do
    holds "the names that leave the $kind library are those of the headers" diff "$scratch/promised" "$scratch/$kind"
done
says "the shared library's soname has the major version" "[libwiggly.so.${version%%.*}]" "$(readelf -d "$shared" | grep SONAME)"

# The same bits everywhere: of libm only what IEEE rounds exactly, sqrt or remainder.
libm='(a?(sin|cos|tan)h?|sincos|atan2|exp(2|10|m1)?|log(2|10|1p|b)?|pow|hypot|cbrt|erfc?|[lt]gamma|c(exp|log|pow|sqrt|abs|arg))[fl]?'
none "curves and documents need no function of libm that differs between machines" \
    "$(find "$B"/obj/src/{maths,spline,scene,rig,editor,model,export} -name '*.o' -exec nm -u {} + | grep -wE "U $libm")"
for flags in -ffast-math "-fassociative-math -fno-signed-zeros -fno-trapping-math"; do
    tells 1 "sums in another order ($flags) are refused" "compile its sources without it" $CC $flags -Iinclude -Isrc -c src/maths/maths.c -o "$scratch/fast.o"
done

# --- other compilers and machines. The library is built as SANITIZE=1 asks already: then this would be the same once more

if [ -n "${SANITIZE:-}" ] || ! thorough; then exit 0; fi
unset MAKEFLAGS
# Whether a compiler makes programs with these flags: runtimes and C libraries are packages of their own.
makes() { # <what for> <compiler> <flags>...
    command -v "$2" >/dev/null || { echo "skip - $1, because $2 is not installed"; return 1; }
    echo 'int main(void) { return 0; }' | "${@:2}" -x c - -o "$scratch/probe" 2>/dev/null ||
        { echo "skip - $1, because ${*:2} links no program"; return 1; }
}
build() { # <folder> <compiler> <flags>: builds its libwiggly.a, unoptimised, which takes half the time
    expect 0 "it is built by $2 $3" make SETS= WERROR=1 CC="$2" CFLAGS="$3" B="$scratch/$1" "$scratch/$1/libwiggly.a"
}
link() { # <folder> <compiler> <example> <flags>...: to the folder's file `program`
    expect 0 "$3 is linked by $2" "$2" -Wall -Wextra -Werror -Iinclude "$3" "$scratch/$1/libwiggly.a" "${@:4}" -o "$scratch/$1/program"
}
for compiler in gcc clang; do
    makes "the thread sanitizer under $compiler" $compiler -fsanitize=thread || continue
    build tsan-$compiler $compiler "-O0 -fsanitize=thread"
    link tsan-$compiler $compiler examples/threads.c -fsanitize=thread -lm -lpthread
    expect 0 "many threads run without a race" "$scratch/tsan-$compiler/program"
done
arm=aarch64-linux-gnu-gcc
if makes "aarch64" $arm -static; then
    emulated=yes
    qemu-aarch64 "$scratch/probe" 2>/dev/null || { echo "skip - running it, because qemu-aarch64 does not"; emulated=""; }
    build arm $arm -O0
    for example in examples/*.c; do
        link arm $arm "$example" -static -lm -lpthread
        [ -n "$emulated" ] || continue
        expect 0 "and runs" qemu-aarch64 "$scratch/arm/program"
        [ "$example" != examples/curve.c ] || says "through its knots" "1.500000,1.000000000," "$out"
    done
fi
windows=x86_64-w64-mingw32-gcc
if makes "Windows" $windows; then
    build windows $windows "-O0 -Wno-float-conversion" # its own isfinite() converts
    for example in examples/{curve,game_loop,tail_lag}.c; do link windows $windows "$example"; done
fi
