# The committed session, played by the real binary: it ends in the same document byte by byte and solves the same splines and
# samples each time; what is recorded plays back to the same document.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY
scene=tests/replays/session.json
replay=tests/replays/session.replay

# Rows without times: what was solved, keyed and edited in each frame that did any of it.
counters() { grep -v '^#' "$1" | cut -d, -f1,14-17 | grep -v ',0,0,0,0$'; }

play() { # <replay> <scene> <name> [option]...
    local file=$1 start=$2 name=$3
    shift 3
    "$WIGGLY" live --no-draw --replay "$file" --log "$scratch/$name.csv" --result "$scratch/$name.json" "$@" "$start"
}

# Recording while it plays gives plain positions.
expect 0 "the session plays" play $replay $scene first --record "$scratch/recorded.replay"
holds "it ends in the committed document" cmp "$scratch/first.json" tests/replays/session.result.json
counters "$scratch/first.csv" | cmp - tests/replays/session.counters.csv
ok "each frame solves what it solved when it was committed" $?
holds "it has 1,200 frames" [ "$(grep -vc '^[#f]' "$scratch/first.csv")" -eq 1200 ]
# Frames that allocate though nothing is edited in them. Where a drag ends, the history keeps the document as it is: a handful.
wasteful() { grep -v '^[#f]' "$1" | awk -F, '$1 > 0 && $17 == 0 && $19 > 8' | wc -l; } # <log>
holds "no frame without an edit allocates" [ "$(wasteful "$scratch/first.csv")" -eq 0 ]

# The one for the frame budget: eight splines, 200 knots, every panel, overlay and kind of drag. Drawn, too, with small pictures.
expect 0 "the full session plays" play tests/replays/full.replay tests/replays/full.json full $(quickly --frames 420)
holds "nor does one with everything shown" [ "$(wasteful "$scratch/full.csv")" -eq 0 ]
drawn() { "$WIGGLY" live --headless --scale 0.5 --replay tests/replays/full.replay --log "$scratch/drawn.csv" "$@" tests/replays/full.json; }
if "$WIGGLY" live --headless --frames 1 >/dev/null 2>&1; then
    expect 0 "the full session is drawn" drawn $(quickly --frames 70)
    holds "nor does drawing it" [ "$(wasteful "$scratch/drawn.csv")" -eq 0 ]
else
    echo "skip - nothing is drawn here"
fi

# A hand of the creature goes round at its frame, the other one's pin goes to another frame.
expect 0 "pins are dragged" play tests/replays/pins.replay assets/scenes/hands.json pins
holds "which allocates only where it edits" [ "$(wasteful "$scratch/pins.csv")" -eq 0 ]
holds "and moves a pin in time" grep -q '"frame": 84, "vertex": 2711' "$scratch/pins.json"

expect 0 "what was recorded plays" play "$scratch/recorded.replay" $scene second
holds "to the same document" cmp "$scratch/second.json" tests/replays/session.result.json

# The result opens and saves as it is.
expect 0 "the result is a scene" "$WIGGLY" check "$scratch/first.json"
