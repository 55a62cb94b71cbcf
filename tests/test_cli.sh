# The real binary from the outside: usage, exit statuses, broken scenes, a headless run of the live app.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY

one_sentence() { # <what> <text>
    [ -n "$2" ] && [ "$(printf '%s\n' "$2" | wc -l)" -eq 1 ]
    ok "$1" $?
}

# --- usage

expect 0 "--version" "$WIGGLY" --version
says "--version gives version and commit" "wiggly $(sed -n 's/.*define WIGGLY_VERSION "\(.*\)"/\1/p' include/wiggly/wiggly.h) (" "$out"
expect 0 "-V" "$WIGGLY" -V
says "is --version" "wiggly " "$out"
expect 0 "--help-all" "$WIGGLY" --help-all
for command in live solve rig export check simulate analyze log; do
    says "--help-all lists $command" "  $command " "$out"
done
expect 0 "--help" "$WIGGLY" --help
few=$out
says "--help lists export" "  export " "$few"
[[ $few != *"  solve "* ]]
ok "--help leaves out what few need" $?
expect 0 "help" "$WIGGLY" help
[ "$out" = "$few" ]
ok "help is --help" $?
expect 0 "help export" "$WIGGLY" help export
says "is the help of export" "Usage: wiggly export" "$out"
expect 2 "help of a command that there is none of" "$WIGGLY" help exprot
says "names the nearest" "did you mean export?" "$err"
expect 0 "live --help" "$WIGGLY" live --help
says "lists what users need" "--ui-scale" "$out"
[[ $out != *--replay* ]]
ok "and no more" $?
expect 0 "live --help-all" "$WIGGLY" live --help-all
says "lists all" "--replay" "$out"
for command in live solve export check simulate log; do
    expect 0 "$command --help" "$WIGGLY" $command --help
    says "$command --help says how it is called" "Usage: wiggly $command" "$out"
    expect 2 "$command refuses an unknown option" "$WIGGLY" $command --hlep
    says "$command names the option and the nearest right one" "unknown option --hlep (did you mean --help?)" "$err"
    one_sentence "$command says it in one line" "$err"
done

expect 2 "an unknown command" "$WIGGLY" slove
says "names the nearest right one" "unknown command slove (did you mean solve?)" "$err"
expect 2 "a command that is like none" "$WIGGLY" xyzzyxyzzy
says "is named without a guess" "unknown command xyzzyxyzzy; see" "$err"
expect 2 "solve without a scene" "$WIGGLY" solve
says "says what is missing" "scene.json" "$err"
expect 2 "an option without its value" "$WIGGLY" live --headless --frames
says "says which" "--frames needs a value" "$err"
expect 2 "a number that is none" "$WIGGLY" live --headless --frames ten
says "says what was expected and got" "expected a whole number" "$err"
says "and what it got" "'ten'" "$err"
expect 2 "a size that is none" "$WIGGLY" live --headless --size 1280
expect 2 "a theme that there is none of" "$WIGGLY" live --headless --theme pink
expect 2 "a picture of what is not drawn" "$WIGGLY" live --no-draw --screenshot "$scratch/none.png"
says "says what was expected" "--no-draw: expected no --screenshot" "$err"
expect 2 "one argument too many" "$WIGGLY" check a.json b.json
says "says which one" "'b.json'" "$err"

# --- solve and check

scene=tests/vectors/complex_default.json
expect 0 "check of a good scene" "$WIGGLY" check "$scene"
expect 0 "solve of a good scene" "$WIGGLY" solve "$scene"
says "writes the header" "frame,$(sed -n '1s/^frame,\([^,]*\),.*/\1/p' tests/vectors/complex_default.csv)" "$(head -n 1 <<<"$out")"
expect 0 "solve -o" "$WIGGLY" solve "$scene" -o "$scratch/out.csv"
[ "$out" = "" ] && [ "$(wc -l <"$scratch/out.csv")" -eq "$(wc -l <tests/vectors/complex_default.csv)" ]
ok "the file has a line a sample and stdout nothing" $?
expect 3 "solve to a folder that is not there" "$WIGGLY" solve "$scene" -o "$scratch/no/out.csv"
one_sentence "says so in one line" "$err"
expect 1 "a scene that is not there" "$WIGGLY" solve "$scratch/missing.json"
says "is named" "missing.json" "$err"
expect 1 "a folder in place of a scene" "$WIGGLY" check "$scratch"

# --- pins that are not met

cat >"$scratch/pinned.json" <<'EOF'
{ "frames": [0, 48],
  "splines": [ { "name": "sway", "frequency": 1, "limits": [-1, 1], "knots": [ { "frame": 0, "value": 0 } ] } ],
  "rigs": [ { "type": "tail", "name": "tail", "spline": "sway", "pins": [ { "frame": 20, "joint": 23, "to": [0, 9, 0] } ] } ] }
EOF
expect 0 "check of a scene with a pin out of reach" "$WIGGLY" check "$scratch/pinned.json"
says "says how far it stays away" "pinned.json: rigs[0].pins[0]: the point stays 9." "$out"
says "and that limits are ignored" "pinned.json: splines[0].limits: ignored, because pins or a floor move this spline" "$out"
expect 0 "solve of it" "$WIGGLY" solve "$scratch/pinned.json"
says "says so too" "warning: rigs[0].pins[0]: the point stays 9." "$err"

cat >"$scratch/sunk.json" <<EOF
{ "frames": [0, 48],
  "splines": [ { "name": "up", "frequency": 1, "knots": [ { "frame": 0, "value": 0 }, { "frame": 20, "value": -8 } ] } ],
  "rigs": [ { "type": "character", "name": "soft", "model": "$PWD/assets/models/creature.glb", "floor": 0,
              "coordinates": [ { "name": "up", "spline": "up", "amplitude": 4 } ] } ] }
EOF
expect 0 "check of a character that a knot holds below its floor" "$WIGGLY" check "$scratch/sunk.json"
says "says how deep, and when" "sunk.json: rigs[0].floor: knots and pins hold the character up to " "$out"

# --- some broken files, of which test_bad.c has all: exit status 1, one sentence that names the file and the fault

number=0
if [ -s tests/bad/expected.txt ]; then
    while IFS=$'\t' read -r file fragment; do
        case $file in *.json) ;; *) continue ;; esac
        number=$((number + 1))
        [ $((number % 2)) -eq 1 ] || continue
        expect 1 "solve refuses $file" "$WIGGLY" solve "tests/bad/$file"
        one_sentence "$file: one sentence" "$err"
        says "$file: names the file" "$file" "$err"
        says "$file: says what is wrong" "$fragment" "$err"
        expect 1 "check refuses $file" "$WIGGLY" check "tests/bad/$file"
    done <tests/bad/expected.txt
else
    ok "tests/bad/expected.txt lists the broken scenes" 1
fi

# --- the live app without a display

live() { "$WIGGLY" live --headless --size 640x360 "$@"; }
blind() { "$WIGGLY" live --no-draw --size 640x360 "$@"; }
expect 0 "live --headless" live --frames 90 --log "$scratch/live.csv" --screenshot "$scratch/live.png" --result "$scratch/end.json"
says "prints the summary" "fps on average" "$out"
[ "$(identify -format '%m %wx%h' "$scratch/live.png" 2>&1)" = "PNG 640x360" ]
ok "the picture is a PNG of the size asked for" $?
holds "the picture is not empty" [ "$(identify -format '%k' "$scratch/live.png" 2>/dev/null || echo 0)" -gt 100 ]
holds "the log has a row a frame" [ "$(grep -cvE '^(#|frame)' "$scratch/live.csv")" -eq 90 ]
allocations=$(awk -F, 'BEGIN { total = 0 }
    /^frame/ { for (c = 1; c <= NF; c++) if ($c == "allocations") column = c; next }
    !/^#/ && $1 >= 60 { if ($column == "NA") unknown = 1; total += $column }
    END { print unknown ? "NA" : total }' "$scratch/live.csv")
[ "$allocations" = 0 ] || echo "  allocations after frame 60: $allocations"
holds "playing allocates nothing" [ "$allocations" = 0 ]
expect 0 "the document at the end is a good scene" "$WIGGLY" check "$scratch/end.json"
expect 0 "it opens again" blind --frames 2 "$scratch/end.json"
expect 1 "live of a scene that is not there" blind --frames 2 "$scratch/none.json"
says "is named" "none.json: cannot be opened" "$err"
expect 0 "without a display and without --headless" "$WIGGLY" live --frames 2 --size 640x360
says "it says that it runs headless" "headless" "$out$err"
expect 0 "a display that does not open" env DISPLAY=:987 "$WIGGLY" live --frames 2 --size 640x360
says "is like none" "headless" "$out$err"

# `make run` finds nothing out by itself: whatever became of the display, there is something to show for it.
make_run() { DISPLAY=:987 make B="${B:-build}" SANITIZE="${SANITIZE:-}" LIVE_OUT="$shown" ARGS="--frames 2 --size 640x360 $*" run; }
shown=$scratch/shown # not where the user's own `make run` has left something
mkdir "$shown"
picture=$shown/live.png
log=$shown/live.csv
expect 0 "make run with a display that does not open" make_run
[ -s "$picture" ] && [ -s "$log" ]
ok "leaves a picture and a log" $?
says "and says where" "Picture: $picture, timing log: $log" "$out"
expect 0 "make run ARGS=--help" make_run --help
[[ ! -e $picture && $out != *Picture:* ]]
ok "promises no picture that it did not make" $?
elsewhere() { (cd "$scratch" && "$binary" live --no-draw --frames 2); }
binary=$(realpath "$WIGGLY")
expect 0 "the built-in tail is found from any folder" elsewhere

expect 1 "live with a broken scene" blind --frames 2 tests/vectors/complex_default.csv
expect 3 "a log that cannot be made" blind --frames 2 --log "$scratch/no/live.csv"
one_sentence "says so in one line" "$err"
says "with its path" "no/live.csv" "$err"
