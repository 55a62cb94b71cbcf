# Replays of a few lines, and ones that do not fit: what is wrong is said in one sentence with its line.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY
scene=tests/replays/session.json
replay=tests/replays/session.replay

play() { # <replay> <scene> <name> [option]...
    local file=$1 start=$2 name=$3
    shift 3
    "$WIGGLY" live --no-draw --replay "$file" --log "$scratch/$name.csv" --result "$scratch/$name.json" "$@" "$start"
}

# Replays that do not fit.
expect 1 "a replay of another scene" play $replay tests/vectors/figure1.json other
says "says so" "recorded on another scene" "$err"
sed 's/^0* *\(40 pointer\).*/40 pointer @knot(nobody,2)/' $replay >"$scratch/nobody.replay"
expect 1 "a target that is not there" play "$scratch/nobody.replay" $scene nobody
says "is named with its line" "nobody.replay:9: @knot(nobody,2) is not on the screen: there is no spline \"nobody\"" "$err"
echo "hello" >"$scratch/hello.replay"
expect 1 "a file that is no replay" play "$scratch/hello.replay" $scene hello
says "says what was expected" "hello.replay:1: expected \"wiggly-replay 1\", got \"hello\"" "$err"
printf '\f\f\n' >"$scratch/blank.replay"
expect 1 "a replay of one blank line" play "$scratch/blank.replay" $scene blank
says "says what was expected" "expected \"wiggly-replay 1\"" "$err"
printf 'wiggly-replay 1\n\v\n' >"$scratch/blank.replay"
expect 1 "a header of blank lines" play "$scratch/blank.replay" $scene blank
says "says what was expected" "expected a header with size and frames" "$err"
expect 1 "a replay that is not there" play "$scratch/missing.replay" $scene missing
says "is named" "missing.replay" "$err"

# A replay of a few lines on the same scene.
header=$(sed '/^frames/q' $replay)
play_lines() { # <line>...
    printf '%s\n' "$header" "$@" >"$scratch/lines.replay"
    play "$scratch/lines.replay" $scene lines --frames 40
}
refused() { # <what> <message> <line>...
    local what=$1 message=$2
    shift 2
    expect 1 "$what" play_lines "$@"
    says "is refused with its line" "$message" "$err"
}
refused "a frame before the last one" 'lines.replay:9: expected an event in a frame from 5 to 1199, got "3"' "5 key A" "3 key B"
refused "a frame behind the end" 'lines.replay:8: expected an event in a frame from 0 to 1199, got "1200"' "1200 key A"
refused "a frame that no number holds" 'lines.replay:8: expected an event in a frame' "99999999999999999999 key A"
refused "an event without its key" "lines.replay:8: expected the name of a key, got the end of the line" "5 key"
refused "a number beyond a float" 'lines.replay:8: expected a number, got "1e39"' "5 wheel 0 1e39 100 100"
refused "an offset beyond a float" 'lines.replay:8: expected an offset such as +4,-3 behind the target, got "+1e39,0"' "5 pointer @knot(sway,2)+1e39,0"
refused "words behind the event" 'lines.replay:8: expected the end of the line, got "now"' "5 close now"
refused "a window of no size" 'lines.replay:8: expected a width and a height from 64' "5 size 0 0"
expect 0 "the smallest window, CRLF, blank lines, a wheel with all modifiers" play_lines \
    $'5 size 64 64\r' "  " $'\t' "9 wheel 0 1 400 500 shift ctrl alt super"
expect 0 "a paste" play_lines "5 key Escape" "6 paste 0,0.5%0a1,0.25%20"
holds "sets the knots of its text" grep -q '"value": 0.25 }' "$scratch/lines.json"
refused "a paste of nothing" 'lines.replay:8: expected a text, got the end of the line' "5 paste"
printf 'wiggly-replay 1\0\n' >"$scratch/nul.replay"
expect 1 "a NUL byte in a replay" play "$scratch/nul.replay" $scene nul
says "is named" "nul.replay: expected text, got a NUL byte" "$err"

# A recording whose program was killed has no length yet: it ends with its last event.
{ printf '%s\n' "$header" | sed 's/^frames .*/frames 0/' && printf '%s\n' "5 key A" "12 key Escape"; } >"$scratch/killed.replay"
expect 0 "a recording that was cut short" play "$scratch/killed.replay" $scene killed
holds "plays to its last event" [ "$(grep -vc '^[#f]' "$scratch/killed.csv")" -eq 13 ]
