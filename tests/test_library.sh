# The library from outside: the names that leave it, what the shared one calls itself, and how it is built by other compilers, for
# other machines and under the thread sanitizer.
. tests/check.sh
B=${B:-build}
CC=${CC:-gcc}
version=$(sed -n 's/.*define WIGGLY_VERSION "\(.*\)"/\1/p' include/wiggly/wiggly.h)
shared=$B/libwiggly.so.$version

# --- names

sed -nE 's/^[a-z].*[ *](wiggly_[a-z_]+)\(.*/\1/p' include/wiggly/wiggly.h | sort >"$scratch/promised"
names() { # <nm's arguments>...: what is defined there and seen from outside
    nm --defined-only "$@" | awk 'NF == 3 { print $3 }' | sort
}
names -g "$B/libwiggly.a" >"$scratch/static"
names -D "$shared" | grep -v '^__\|^_init$\|^_fini$' >"$scratch/shared" # a sanitizer's own
[ -s "$scratch/promised" ]
ok "the header promises functions" $?
for kind in static shared; do
    diff "$scratch/promised" "$scratch/$kind"
    ok "the names that leave the $kind library are those of the header" $?
done
says "the shared library's soname has the major version" "[libwiggly.so.${version%%.*}]" "$(readelf -d "$shared" | grep SONAME)"
exit $((cases_failed > 0))
