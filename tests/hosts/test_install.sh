# The Makefile in hands that its author does not know: flags of the user's, folders with spaces, root in somebody else's clone. And what
# `make install` puts in place can be used: the examples compile against the installed .pc file and run; C++ reads the header; CMake finds it.
. tests/check.sh
CC=${CC:-gcc}

# --- the Makefile; how this very suite is built says nothing here, so that once is enough

makefile() {
    local line clone before folder theirs="$scratch/their tree"
    # How src/spline/batch.c would be compiled, and wiggly linked.
    compile_line() { make --no-print-directory -n V=1 B="$scratch/none" "$@" 2>&1 | grep -- '-c src/spline/batch.c'; }
    after() { # <what> <earlier> <later> <line>
        case $4 in *"$2"*"$3"*) ok "$1" 0 ;; *) echo "  $4"; ok "$1" 1 ;; esac
    }
    line=$(compile_line CFLAGS="-O2 -march=native" CPPFLAGS=-DMINE)
    says "CFLAGS on the command line keep what the sources need" "-D_GNU_SOURCE" "$line"
    after "they come after our own" "-O3" "-O2 -march=native" "$line"
    after "but not after what the results depend on" "-march=native" "-ffp-contract=off" "$line"
    says "CPPFLAGS add" "-DMINE" "$line"
    after "the same from the environment" "-ffast-math" "-fno-fast-math" "$(CFLAGS=-ffast-math compile_line)"
    line=$(make --no-print-directory -n V=1 B="$scratch/none" LDFLAGS=-Wl,-z,now LDLIBS=-lm 2>&1 | grep -- '-o .*/wiggly$')
    says "LDFLAGS keep the project's" "--wrap=malloc" "$line"
    says "and add" "-Wl,-z,now" "$line"
    echo 'int main(void) { return missing(); }' >"$scratch/implicit.c"
    # shellcheck disable=SC2046
    expect 1 "an implicit declaration is an error" gcc $(compile_line | grep -o -- '-Werror=[a-z-]*') -c "$scratch/implicit.c" -o "$scratch/implicit.o"

    # Two clones build the same bytes, also where a name needs quotes.
    for clone in one "it's another"; do
        mkdir "$scratch/$clone" && cp -r Makefile include src tools "$scratch/$clone"
        expect 0 "an object is built in a folder called $clone" env CCACHE_DISABLE=1 make -C "$scratch/$clone" SETS= build/obj/src/spline/batch.o build/obj/build.o
    done
    holds "it has the same bytes in both" diff -r "$scratch/one/build" "$scratch/it's another/build"
    holds "and does not name its folder" not grep -aq "$scratch" "$scratch/one/build/obj/src/spline/batch.o"

    # A tree of somebody else's, built by them.
    mkdir -p "$theirs/build"
    cp -r Makefile LICENSE wiggly.pc.in include src shaders assets tools tests "$theirs"
    cp "$built/wiggly" "$built"/libwiggly.* "$theirs/build"
    expect 0 "B and DESTDIR with spaces" make -C "$theirs" B="$scratch/my build" -n install DESTDIR="$scratch/a stage"
    holds "the build folder is the one that was named" [ -d "$scratch/my build" ]
    rm -rf "$theirs/build/links"
    [ "$(id -u)" = 0 ] || return
    chown -R nobody "$theirs"
    chmod 755 "$scratch"
    before=$(find "$theirs" | wc -l)
    expect 0 "root installs from it" make -C "$theirs" install DESTDIR="$scratch/a stage" PREFIX=/opt/wiggly
    holds "and leaves nothing there" [ "$(find "$theirs" | wc -l) $(find "$theirs" -user root)" = "$before " ]
    holds "what is installed knows its version" [ "$("$scratch/a stage/opt/wiggly/bin/wiggly" --version)" = "$("$built/wiggly" --version)" ]
    touch "$theirs/src/main.c"
    folder=$(cd "$theirs" && TMPDIR=$scratch tools/install-from.sh build)
    holds "what is not built, or was changed since, is built elsewhere" [ "${folder#"$scratch"/wiggly-install.}" != "$folder" ]
}
built=$B
unset MAKEFLAGS
if [ -z "${SANITIZE:-}" ]; then # a local variable would not hide those of the environment
    unset B DEBUG
    makefile
    export B=$built
fi
tells 0 "licences of what is built in are printed" "part of this program" wiggly --licenses

# --- make install

sanitizers=""
[ -n "${SANITIZE:-}" ] && sanitizers="-fsanitize=address,undefined"

# What was built for the tests: another test may be at the same build folder. Root may keep its files to itself; not these.
umask 077
install() { make BORROWED=yes B="$B" SANITIZE="${SANITIZE:-}" "$@"; }
expect 0 "make install" install DESTDIR="$scratch/stage" PREFIX=/opt/wiggly install
umask 022
holds "everybody can read all of it" [ -z "$(find "$scratch/stage" \( -type d ! -perm -755 -o -type f ! -perm -644 \))" ]

root=$scratch/stage/opt/wiggly
for file in bin/wiggly lib/libwiggly.a lib/libwiggly.so lib/cmake/wiggly/wigglyConfig.cmake lib/pkgconfig/wiggly.pc include/wiggly/wiggly.h include/wiggly/more.h share/wiggly/scenes/tail.json \
    share/man/man1/wiggly.1 share/applications/wiggly.desktop share/icons/hicolor/scalable/apps/wiggly.svg; do
    holds "$file is installed" [ -s "$root/$file" ]
done

expect 0 "make install-library" install DESTDIR="$scratch/library" PREFIX= install-library
holds "is the library's part of it, and no more" diff <(cd "$root" && find ./include ./lib ! -type d | sort) <(cd "$scratch/library" && find . ! -type d | sort)

page=$root/share/man/man1/wiggly.1
if command -v man >/dev/null; then
    expect 0 "the page is one for man" man --warnings=all -l "$page"
    holds "without a warning: $err" [ -z "$err" ]
fi
for command in live solve check simulate analyze log; do
    missing=$("$root/bin/wiggly" $command --help-all | sed -nE 's/^  ((-., )?--[a-z-]+.*[^ ])  +.*/\1/p' | while IFS= read -r option; do
        sed 's/\\-/-/g' "$page" | grep -qxF ".B $option" || echo "$option"
    done)
    holds "the page has every option of $command: $missing" [ -z "$missing" ]
done
entry() { sed -n "s/^$1=//p" "$root/share/applications/wiggly.desktop"; }
holds "the desktop's entry starts the program" [ "$(entry Exec)" = "wiggly %f" ]
holds "and has its icon" [ -e "$root/share/icons/hicolor/scalable/apps/$(entry Icon).svg" ]
if command -v desktop-file-validate >/dev/null; then
    expect 0 "and is a good one" desktop-file-validate "$root/share/applications/wiggly.desktop"
fi

# An installation that was moved works as before.
root=$scratch/moved
mv "$scratch/stage/opt/wiggly" "$root"
holds "no file of it names its place" not grep -rlI "$scratch/stage\|/opt/wiggly" "$root"
from_elsewhere() { (cd "$scratch" && "$root/bin/wiggly" "$@"); }
expect 0 "the default scene opens" from_elsewhere live --no-draw --frames 2 --result "$scratch/opened.json"
expect 0 "and is the installed one" cmp "$scratch/opened.json" <(from_elsewhere live --no-draw --frames 2 \
    --result /dev/stdout "$root/share/wiggly/scenes/tail.json" | sed '/^}$/q')
expect 0 "a scene there finds its model" from_elsewhere live --no-draw --frames 2 "$root/share/wiggly/scenes/character.json"

export PKG_CONFIG_PATH=$root/lib/pkgconfig
version=$(sed -n 's/.*define WIGGLY_VERSION "\(.*\)"/\1/p' include/wiggly/wiggly.h)
holds "the .pc file carries the version" [ "$(pkg-config --modversion wiggly)" = "$version" ]
flags=$(pkg-config --cflags --libs wiggly)
export LD_LIBRARY_PATH=$root/lib # where no ldconfig has been

for example in examples/*.c*; do
    name=$(basename "${example%.*}")
    case $example in *.cpp) compiler="g++ -std=c++17 -Wpedantic" ;; *) compiler="$CC -std=c11" ;; esac
    # shellcheck disable=SC2086
    expect 0 "example $name compiles" $compiler -Wall -Wextra -Wshadow -Wconversion -Werror $sanitizers "$example" $flags -o "$scratch/$name"
    expect 0 "example $name runs" "$scratch/$name"
done
holds "the curve has a header and 121 samples" [ "$("$scratch/curve" | wc -l)" -eq 122 ]
# The knots are hit exactly: sample 36 is 1, sample 90 is -0.5.
says "the curve hits its second knot" "1.500000,1.000000000," "$("$scratch/curve")"
says "the curve hits its third knot" "3.750000,-0.500000000," "$("$scratch/curve")"

cat >"$scratch/use.cpp" <<'CPP'
#include <wiggly/more.h>
wiggly_desc desc = wiggly_default_desc();
wiggly_explanation best[2];
int main() { return desc.calm == 1 && wiggly_explain(&desc, best) == 0 ? 0 : 1; }
CPP
# shellcheck disable=SC2086
expect 0 "C++ compiles and links the headers" g++ -Wall -Wextra -Wpedantic -Werror $sanitizers "$scratch/use.cpp" $flags -o "$scratch/use"
expect 0 "the C++ program runs" "$scratch/use"

cat >"$scratch/version.c" <<'C'
#include <stdio.h>
#include <wiggly/wiggly.h>
int main(void) { puts(wiggly_version()); }
C
needs() { # <program>: the libraries of ours that it loads
    readelf -d "$1" | sed -nE 's/.*NEEDED.*\[(libwiggly[^]]*)\]/\1/p'
}
# shellcheck disable=SC2086
expect 0 "a program is linked with the shared library" $CC $sanitizers "$scratch/version.c" $flags -o "$scratch/version"
says "by its soname" "libwiggly.so.${version%%.*}" "$(needs "$scratch/version")"
holds "which knows its version" [ "$("$scratch/version")" = "$version" ]
# shellcheck disable=SC2086
expect 0 "or with the static one" $CC $sanitizers "$scratch/version.c" ${flags/-lwiggly/-l:libwiggly.a} -o "$scratch/version"
holds "and then needs none" [ -z "$(needs "$scratch/version")" ]

if command -v cmake >/dev/null; then
    mkdir "$scratch/project"
    cat >"$scratch/project/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.10)
project(mine C)
find_package(wiggly ${WANTED} REQUIRED CONFIG)
add_executable(shared ../version.c)
target_link_libraries(shared wiggly::wiggly)
add_executable(static ../version.c)
target_link_libraries(static wiggly::static)
CMAKE
    configure() { # <version> <cmake's arguments>...
        rm -rf "$scratch/made"
        cmake -S "$scratch/project" -B "$scratch/made" -DCMAKE_PREFIX_PATH="$root" -DWANTED="$1" -DCMAKE_C_COMPILER="${CC%% *}" \
            -DCMAKE_C_FLAGS="$sanitizers" "${@:2}"
    }
    next=$((${version%%.*} + 1))
    tells 1 "CMake is refused another major version, and told what there is" "version: $version" configure "$next.0"
    expect 0 "and finds its own" configure "${version%.*}"
    expect 0 "a CMake project builds" env -u MAKEFLAGS cmake --build "$scratch/made"
    unset LD_LIBRARY_PATH
    for kind in shared static; do
        holds "and runs with the $kind library" [ "$("$scratch/made/$kind")" = "$version" ]
    done
    sed -i "s|^find_package.*|add_subdirectory($PWD wiggly)|; s/wiggly::static/wiggly::wiggly/; s|../version.c|$PWD/examples/curve.c|" "$scratch/project/CMakeLists.txt"
    expect 0 "a project takes the sources as its subdirectory" configure 0 -DBUILD_SHARED_LIBS=ON -DCMAKE_BUILD_TYPE=Debug
    thorough || exit $cases_failed
    expect 0 "and builds" env -u MAKEFLAGS cmake --build "$scratch/made"
    holds "the same bits" [ "$("$scratch/made/shared")" = "$(LD_LIBRARY_PATH=$root/lib "$scratch/curve")" ]
    if command -v x86_64-w64-mingw32-gcc >/dev/null; then
        sanitizers="" CC=x86_64-w64-mingw32-gcc
        expect 0 "for Windows, too" configure 0 -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_BUILD_TYPE=Debug
        expect 0 "which builds" env -u MAKEFLAGS cmake --build "$scratch/made"
    fi
else
    echo "skip - CMake projects, because cmake is not installed"
fi
