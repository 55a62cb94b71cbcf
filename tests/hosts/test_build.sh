# The Makefile in hands that its author does not know: flags of the user's, folders with spaces, root in somebody else's clone.
. tests/check.sh
built=${B:-build}
unset MAKEFLAGS B DEBUG SANITIZE # how this very suite is built says nothing here

compile_line() { # <make's arguments>...: how src/spline/batch.c would be compiled
    make --no-print-directory -n V=1 B="$scratch/none" "$@" 2>&1 | grep -- '-c src/spline/batch.c'
}

after() { # <what> <earlier> <later> <line>
    case $4 in *"$2"*"$3"*) ok "$1" 0 ;; *) echo "  $4"; ok "$1" 1 ;; esac
}

line=$(compile_line CFLAGS="-O2 -march=native" CPPFLAGS=-DMINE)
says "CFLAGS on the command line keep what the sources need" "-D_GNU_SOURCE" "$line"
after "they come after our own" "-O3" "-O2 -march=native" "$line"
after "but not after what the results depend on" "-march=native" "-ffp-contract=off" "$line"
says "CPPFLAGS add" "-DMINE" "$line"
line=$(CFLAGS=-ffast-math compile_line)
after "the same from the environment" "-ffast-math" "-fno-fast-math" "$line"
line=$(make --no-print-directory -n V=1 B="$scratch/none" LDFLAGS=-Wl,-z,now LDLIBS=-lm 2>&1 | grep -- '-o .*/wiggly$')
says "LDFLAGS keep the project's" "--wrap=malloc" "$line"
says "and add" "-Wl,-z,now" "$line"

printf 'int main(void) { return missing(); }\n' >"$scratch/implicit.c"
flags=$(compile_line | grep -o -- '-Werror=[a-z-]*' | tr '\n' ' ')
# shellcheck disable=SC2086
expect 1 "an implicit declaration is an error" gcc $flags -c "$scratch/implicit.c" -o "$scratch/implicit.o"

# Two clones build the same bytes, also where a name needs quotes.
for clone in one "it's another"; do
    mkdir "$scratch/$clone" && cp -r Makefile include src tools "$scratch/$clone"
    expect 0 "an object is built in a folder called $clone" env CCACHE_DISABLE=1 make -C "$scratch/$clone" SETS= build/obj/src/spline/batch.o build/obj/build.o
done
holds "it has the same bytes in both" diff -r "$scratch/one/build" "$scratch/it's another/build"
grep -aq "$scratch" "$scratch/one/build/obj/src/spline/batch.o"
ok "and does not name its folder" $((! $?))

# A tree of somebody else's, built by them.
mkdir "$scratch/their tree"
cp -r Makefile LICENSE wiggly.pc.in include src shaders assets tools tests "$scratch/their tree"
mkdir "$scratch/their tree/build"
cp "$built/wiggly" "$built"/libwiggly.* "$scratch/their tree/build"
expect 0 "B and DESTDIR with spaces" make -C "$scratch/their tree" B="$scratch/my build" -n install DESTDIR="$scratch/a stage"
holds "the build folder is the one that was named" [ -d "$scratch/my build" ]
rm -rf "$scratch/their tree/build/links"

if [ "$(id -u)" = 0 ]; then
    chown -R nobody "$scratch/their tree"
    chmod 755 "$scratch"
    before=$(find "$scratch/their tree" | wc -l)
    expect 0 "root installs from it" make -C "$scratch/their tree" install DESTDIR="$scratch/a stage" PREFIX=/opt/wiggly
    [ "$(find "$scratch/their tree" | wc -l)" = "$before" ] && [ -z "$(find "$scratch/their tree" -user root)" ]
    ok "and leaves nothing there" $?
    [ "$("$scratch/a stage/opt/wiggly/bin/wiggly" --version)" = "$("$built/wiggly" --version)" ]
    ok "what is installed knows its version" $?
    touch "$scratch/their tree/src/main.c"
    folder=$(cd "$scratch/their tree" && TMPDIR=$scratch tools/install-from.sh build)
    case $folder in "$scratch"/wiggly-install.*) ok "what is not built, or was changed since, is built elsewhere" 0 ;;
    *) ok "what is not built, or was changed since, is built elsewhere" 1 ;; esac
fi
says "licences of what is built in are printed" "part of this program" "$("$built/wiggly" --licenses)"
