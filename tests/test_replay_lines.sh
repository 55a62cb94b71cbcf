# Replays of a few lines, and ones that do not fit their scene. Lines that are refused has test_boundaries_files.c.
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
# A replay of a few lines on the same scene.
header=$(sed '/^frames/q' $replay)
play_lines() { # <line>...
    printf '%s\n' "$header" "$@" >"$scratch/lines.replay"
    play "$scratch/lines.replay" $scene lines --frames 40
}
expect 0 "the smallest window, CRLF, blank lines, a wheel with all modifiers" play_lines \
    $'5 size 64 64\r' "  " $'\t' "9 wheel 0 1 400 500 shift ctrl alt super"
expect 0 "a paste" play_lines "5 key Escape" "6 paste 0,0.5%0a1,0.25%20"
holds "sets the knots of its text" grep -q '"value": 0.25 }' "$scratch/lines.json"

# A recording whose program was killed has no length yet: it ends with its last event.
{ printf '%s\n' "$header" | sed 's/^frames .*/frames 0/' && printf '%s\n' "5 key A" "12 key Escape"; } >"$scratch/killed.replay"
expect 0 "a recording that was cut short" play "$scratch/killed.replay" $scene killed
holds "plays to its last event" [ "$(grep -vc '^[#f]' "$scratch/killed.csv")" -eq 13 ]
