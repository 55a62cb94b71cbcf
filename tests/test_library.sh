# The library from outside: the names that leave it, what the shared one calls itself, and how it is built by other compilers, for
# other machines and under the thread sanitizer.
. tests/check.sh
CC=${CC:-gcc}
version=$(sed -n 's/.*define WIGGLY_VERSION "\(.*\)"/\1/p' include/wiggly/wiggly.h)
shared=$B/libwiggly.so.$version

# --- names

sed -nE 's/^[a-z].*[ *](wiggly_[a-z_]+)\(.*/\1/p' include/wiggly/*.h | sort >"$scratch/promised"
names() { # <nm's arguments>...: what is defined there and seen from outside
    nm --defined-only "$@" | awk 'NF == 3 { print $3 }' | sort
}
names -g "$B/libwiggly.a" >"$scratch/static"
names -D "$shared" | grep -v '^__\|^_init$\|^_fini$' >"$scratch/shared" # a sanitizer's own
holds "the headers promise functions" [ -s "$scratch/promised" ]
for kind in static shared; do
    holds "the names that leave the $kind library are those of the headers" diff "$scratch/promised" "$scratch/$kind"
done
says "the shared library's soname has the major version" "[libwiggly.so.${version%%.*}]" "$(readelf -d "$shared" | grep SONAME)"

# --- the same bits everywhere: of libm only what IEEE rounds exactly, sqrt or remainder

libm='(a?(sin|cos|tan)h?|sincos|atan2|exp(2|10|m1)?|log(2|10|1p|b)?|pow|hypot|cbrt|erfc?|[lt]gamma|c(exp|log|pow|sqrt|abs|arg))[fl]?'
find "$B"/obj/src/{maths,spline,scene,rig,editor,model,export} -name '*.o' -exec nm -u {} + | grep -wE "U $libm" >"$scratch/inexact"
holds "curves and documents need no function of libm that differs between machines" [ ! -s "$scratch/inexact" ]

for flags in -ffast-math "-fassociative-math -fno-signed-zeros -fno-trapping-math"; do
    expect 1 "sums in another order ($flags) are refused" $CC $flags -Iinclude -Isrc -c src/maths/maths.c -o "$scratch/fast.o"
    says "with the reason" "compile its sources without it" "$err"
done

# --- other compilers and machines. The library is built as SANITIZE=1 asks already: then this would be the same once more.

if [ -n "${SANITIZE:-}" ] || ! thorough; then exit 0; fi
unset MAKEFLAGS
# Whether a compiler makes programs with these flags: runtimes and C libraries are packages of their own.
makes() { # <what for> <compiler> <flags>...
    command -v "$2" >/dev/null || { echo "skip - $1, because $2 is not installed"; return 1; }
    echo 'int main(void) { return 0; }' | "${@:2}" -x c - -o "$scratch/probe" 2>/dev/null ||
        { echo "skip - $1, because ${*:2} links no program"; return 1; }
}
build() { # <folder> <compiler> <flags>: builds its libwiggly.a, unoptimised, which takes half the time
    make SETS= WERROR=1 CC="$2" CFLAGS="$3" B="$scratch/$1" "$scratch/$1/libwiggly.a"
}
link() { # <folder> <compiler> <example> <flags>...: to the folder's file `program`
    local folder=$1 compiler=$2 example=$3
    shift 3
    "$compiler" -Wall -Wextra -Werror -Iinclude "$example" "$scratch/$folder/libwiggly.a" "$@" -o "$scratch/$folder/program"
}

for compiler in gcc clang; do
    makes "the thread sanitizer under $compiler" $compiler -fsanitize=thread || continue
    expect 0 "$compiler builds it for the thread sanitizer" build tsan-$compiler $compiler "-O0 -fsanitize=thread"
    expect 0 "and the many threads" link tsan-$compiler $compiler examples/threads.c -fsanitize=thread -lm -lpthread
    expect 0 "which run without a race" "$scratch/tsan-$compiler/program"
done

arm=aarch64-linux-gnu-gcc
if makes "aarch64" $arm -static; then
    emulated=yes
    qemu-aarch64 "$scratch/probe" 2>/dev/null || { echo "skip - running it, because qemu-aarch64 does not"; emulated=""; }
    expect 0 "it is built for aarch64" build arm $arm -O0
    for example in examples/*.c; do
        expect 0 "$example is, too" link arm $arm "$example" -static -lm -lpthread
        [ -n "$emulated" ] || continue
        expect 0 "and runs" qemu-aarch64 "$scratch/arm/program"
        [ "$example" != examples/curve.c ] || says "through its knots" "1.500000,1.000000000," "$out"
    done
fi

windows=x86_64-w64-mingw32-gcc
if makes "Windows" $windows; then
    # Its own isfinite() converts.
    expect 0 "it is built for Windows" build windows $windows "-O0 -Wno-float-conversion"
    for example in examples/curve.c examples/game_loop.c examples/tail_lag.c; do
        expect 0 "$example is, too" link windows $windows "$example"
    done
fi
