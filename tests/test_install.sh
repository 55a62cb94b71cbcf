# What `make install` puts in place can be used: the examples compile against the installed .pc file and run; C++ reads the header.
. tests/check.sh
CC=${CC:-gcc}
sanitizers=""
[ -n "${SANITIZE:-}" ] && sanitizers="-fsanitize=address,undefined"

make B="${B:-build}" SANITIZE="${SANITIZE:-}" DESTDIR="$scratch/stage" PREFIX=/opt/wiggly install >"$scratch/log" 2>&1
status=$?
[ $status -eq 0 ] || cat "$scratch/log"
ok "make install" $status

root=$scratch/stage/opt/wiggly
for file in bin/wiggly lib/libwiggly.a lib/pkgconfig/wiggly.pc include/wiggly/wiggly.h share/wiggly/scenes/tail.json; do
    [ -s "$root/$file" ]
    ok "$file is installed" $?
done

export PKG_CONFIG_PATH=$root/lib/pkgconfig PKG_CONFIG_SYSROOT_DIR=$scratch/stage
version=$(sed -n 's/.*define WIGGLY_VERSION "\(.*\)"/\1/p' include/wiggly/wiggly.h)
[ "$(pkg-config --modversion wiggly)" = "$version" ]
ok "the .pc file carries the version" $?
flags=$(pkg-config --cflags --libs wiggly)

for example in curve game_loop tail_lag; do
    # shellcheck disable=SC2086
    expect 0 "example $example compiles" $CC -std=c11 -Wall -Wextra -Werror $sanitizers examples/$example.c $flags \
        -o "$scratch/$example"
    expect 0 "example $example runs" "$scratch/$example"
done
[ "$("$scratch/curve" | wc -l)" -eq 122 ]
ok "the curve has a header and 121 samples" $?
# The knots are hit exactly: sample 36 is 1, sample 90 is -0.5.
says "the curve hits its second knot" "1.500000,1.000000000," "$("$scratch/curve")"
says "the curve hits its third knot" "3.750000,-0.500000000," "$("$scratch/curve")"

cat >"$scratch/use.cpp" <<'CPP'
#include <wiggly/wiggly.h>
int main()
{
    wiggly_desc desc = wiggly_default_desc();
    return desc.calm == 1 ? 0 : 1;
}
CPP
# shellcheck disable=SC2086
expect 0 "C++ compiles and links the header" g++ -Wall -Wextra -Wpedantic -Werror $sanitizers "$scratch/use.cpp" $flags -o "$scratch/use"
expect 0 "the C++ program runs" "$scratch/use"
exit $((cases_failed > 0))
