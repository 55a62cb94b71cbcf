# The real binary from the outside: usage, a table, a headless run of the live app. What its commands say and refuse has test_commands.c.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY

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
holds "--help leaves out what few need" not grep -q "  solve " <<<"$few"
expect 0 "help" "$WIGGLY" help
holds "help is --help" [ "$out" = "$few" ]
expect 0 "help export" "$WIGGLY" help export
says "is the help of export" "Usage: wiggly export" "$out"
while IFS='|' read -r words sentence; do
    # shellcheck disable=SC2086
    expect 2 "wiggly $words" "$WIGGLY" $words
    says "says why" "$sentence" "$err"
    holds "in one line" [ "$(wc -l <<<"$err")" -eq 1 ]
done <<END
help exprot|did you mean export?
slove|unknown command slove (did you mean solve?)
xyzzyxyzzy|unknown command xyzzyxyzzy; see
$(printf '\033')check|unknown command \x1bcheck
--hlep|unknown option --hlep (did you mean --help?)
END

# --- a table

scene=tests/vectors/complex_default.json
expect 0 "solve of a good scene" "$WIGGLY" solve "$scene"
says "writes the header" "frame,$(sed -n '1s/^frame,\([^,]*\),.*/\1/p' tests/vectors/complex_default.csv)" "$(head -n 1 <<<"$out")"
expect 0 "solve -o" "$WIGGLY" solve "$scene" -o "$scratch/out.csv"
[ "$out" = "" ] && [ "$(wc -l <"$scratch/out.csv")" -eq "$(wc -l <tests/vectors/complex_default.csv)" ]
ok "the file has a line a sample and stdout nothing" $?
expect 1 "a broken scene" "$WIGGLY" solve tests/vectors/complex_default.csv
expect 3 "standard output that is full" sh -c '"$0" solve "$1" >/dev/full' "$WIGGLY" "$scene"

# --- the live app without a display

expect 0 "live --headless" "$WIGGLY" live --headless --size 640x360 --frames 70 --log "$scratch/live.csv" \
    --screenshot "$scratch/live.png" --result "$scratch/end.json"
says "prints the summary" "fps on average" "$out"
[ "$(identify -format '%m %wx%h' "$scratch/live.png" 2>&1)" = "PNG 640x360" ]
ok "the picture is a PNG of the size asked for" $?
holds "the picture is not empty" [ "$(identify -format '%k' "$scratch/live.png" 2>/dev/null || echo 0)" -gt 100 ]
holds "the log has a row a frame" [ "$(grep -cvE '^(#|frame)' "$scratch/live.csv")" -eq 70 ]
allocations=$(awk -F, 'BEGIN { total = 0 }
    /^frame/ { for (c = 1; c <= NF; c++) if ($c == "allocations") column = c; next }
    !/^#/ && $1 >= 60 { if ($column == "NA") unknown = 1; total += $column }
    END { print unknown ? "NA" : total }' "$scratch/live.csv")
[ "$allocations" = 0 ] || echo "  allocations after frame 60: $allocations"
holds "playing allocates nothing" [ "$allocations" = 0 ]
expect 0 "the document at the end is a good scene" "$WIGGLY" check "$scratch/end.json"
expect 0 "it opens again" "$WIGGLY" live --no-draw --frames 2 "$scratch/end.json"

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
if thorough; then
    expect 0 "make run ARGS=--help" make_run --help
    [[ ! -e $picture && $out != *Picture:* ]]
    ok "promises no picture that it did not make" $?
fi
elsewhere() { (cd "$scratch" && "$binary" live --no-draw --frames 2); }
binary=$(realpath "$WIGGLY")
expect 0 "the built-in tail is found from any folder" elsewhere
