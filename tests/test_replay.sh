# The committed session, played by the real binary: it ends in the same document byte by byte and solves the same splines and
# samples each time; what is recorded plays back to the same document; a replay that does not fit is refused in one sentence.
. tests/check.sh
WIGGLY=${WIGGLY:-build/wiggly}
unset DISPLAY WAYLAND_DISPLAY
scene=tests/replays/session.json
replay=tests/replays/session.replay

# Rows without times: what was solved, keyed and edited in each frame.
counters() { grep -v '^#' "$1" | cut -d, -f1,13-16; }

play() { # <replay> <scene> <name> [option]...
    local file=$1 start=$2 name=$3
    shift 3
    "$WIGGLY" live --headless --replay "$file" --log "$scratch/$name.csv" --result "$scratch/$name.json" "$@" "$start"
}

expect 0 "the session plays" play $replay $scene first
cmp "$scratch/first.json" tests/replays/session.result.json
ok "it ends in the committed document" $?
counters "$scratch/first.csv" | cmp - tests/replays/session.counters.csv
ok "each frame solves what it solved when it was committed" $?
[ "$(grep -vc '^[#f]' "$scratch/first.csv")" -eq 1200 ]
ok "it has 1,200 frames" $?
structural=$(grep -v '^[#f]' "$scratch/first.csv" | awk -F, '$1 > 0 && $16 == 0 && $18 > 0' | wc -l)
[ "$structural" -eq 0 ]
ok "no frame without an edit allocates" $?

# Playing a replay while recording it gives plain positions, which play back to the same document.
expect 0 "the session is recorded anew" play $replay $scene again --record "$scratch/recorded.replay"
expect 0 "and the recording plays" play "$scratch/recorded.replay" $scene second
cmp "$scratch/second.json" tests/replays/session.result.json
ok "to the same document" $?

# The result opens and saves as it is.
expect 0 "the result is a scene" "$WIGGLY" check "$scratch/first.json"

# Replays that do not fit.
expect 1 "a replay of another scene" play $replay tests/vectors/figure1.json other
says "says so" "recorded on another scene" "$err"
sed 's/^0* *\(40 pointer\).*/40 pointer @knot(nobody,2)/' $replay >"$scratch/nobody.replay"
expect 1 "a target that is not there" play "$scratch/nobody.replay" $scene nobody
says "is named with its line" "nobody.replay:9: @knot(nobody,2) is not on the screen: there is no spline \"nobody\"" "$err"
echo "hello" >"$scratch/hello.replay"
expect 1 "a file that is no replay" play "$scratch/hello.replay" $scene hello
says "says what was expected" "hello.replay:1: expected \"wiggly-replay 1\", got \"hello\"" "$err"
expect 1 "a replay that is not there" play "$scratch/missing.replay" $scene missing
says "is named" "missing.replay" "$err"
[ $cases_failed -eq 0 ]
