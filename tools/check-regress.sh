#!/bin/sh
# Does make regress find what it should, on this machine, now? Plays the committed session with the same build three times in a
# row, which has to say nothing, then with builds that have a delay compiled in, which has to be found. Takes as long as seven
# times `make regress`. Usage: tools/check-regress.sh <build folder>   (PAIRS from the environment)
set -eu
build=$1
out=$build/check-regress
rm -rf "$out"
mkdir -p "$out"

# A copy of the tree in which every drawn frame waits busily for `$2` microseconds (C, of frame and draw_us) that count as draw.
plant() { # <name> <microseconds>
    mkdir "$out/$1"
    cp -a Makefile wiggly.pc.in src include shaders assets tools "$out/$1/"
    mkdir "$out/$1/build"
    cp -a "$build/obj" "$build/generated" "$build/flags" "$out/$1/build/" 2>/dev/null || true
    sed -i "s|^    draw_frame(app->draw, &input, &cost);|&\n    double planted = ($2), until = clock_now() + 1e-6 * planted;\n    while (clock_now() < until) continue;\n    cost.draw_us += planted;|" \
        "$out/$1/src/app/frame.c"
    grep -q planted "$out/$1/src/app/frame.c" || { echo "check-regress: draw_frame() is not where it was" >&2; exit 2; }
    make -s -C "$out/$1" B=build build/wiggly >"$out/$1.txt" 2>&1 || { cat "$out/$1.txt" >&2; exit 3; }
}

failed=0
compare() { # <name> <what it is> <new build> <exit status and line (a pattern) that are expected>
    status=0
    tools/regress.sh "$build/wiggly" "$3" "$build/timing_diff" "$out/$1-logs" >"$out/$1-seen.txt" 2>&1 || status=$?
    slower=$(sed -n 's/^\(.*[^ ]\)  *\(p[59][059]*\|share\|longest\) .*SLOWER$/\1 \2/p' "$out/$1-seen.txt" | tr -s ' ' | paste -sd, -)
    verdict=good
    [ "$status" -eq "$4" ] || verdict=BAD
    [ -z "$5" ] || grep -q "^$5 .*SLOWER" "$out/$1-seen.txt" || verdict=BAD
    [ "$verdict" = good ] || failed=1
    echo "$verdict: $2: exit status $status, slower: ${slower:-nothing}"
}

for i in 1 2 3; do compare "same-$i" "the same build, time $i" "$build/wiggly" 0 ""; done
plant draw "0.03 * cost.draw_us"
compare draw "3 % more in draw" "$out/draw/build/wiggly" 1 "draw_us  *p50"
plant hitch "app->frame % 30 == 0 ? 25000 : 0"
compare hitch "25 ms in every 30th frame" "$out/hitch/build/wiggly" 1 "over 33.3 ms  *share"
plant each "1000"
compare each "1 ms in every frame" "$out/each/build/wiggly" 1 "frame_ms  *p50"
exit $failed
