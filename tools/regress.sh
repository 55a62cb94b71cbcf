#!/bin/sh
# Compares frame times of two builds on the committed session. Both play it at once and draw their frames alternately, so that the machine's
# other work affects both equally.
# Usage: tools/regress.sh <old wiggly> <new wiggly> <timing_diff> <output folder>   (PAIRS, at least 11, from the environment)
set -eu
old=$1 new=$2 timing_diff=$3 out=$4
session=tests/replays/session.replay
scene=tests/replays/session.json
pairs=${PAIRS:-11}
[ -x "$old" ] || { echo "regress: $old is not a program" >&2; exit 2; }
[ "$pairs" -ge 11 ] || { echo "regress: fewer than 11 pairs say too little; got PAIRS=$pairs" >&2; exit 2; }
mkdir -p "$out"
rm -f "$out"/*.csv "$out"/to-old "$out"/to-new
mkfifo "$out/to-old" "$out/to-new"
trap 'rm -f "$out/to-old" "$out/to-new"' EXIT

play() { # <program> <log> <what it says> [--turns WHICH]
    program=$1 log=$2 said=$3
    shift 3
    "$program" live --headless --replay "$session" --log "$log" "$@" "$scene" >"$said" 2>&1
}

stop() { # <program> <what it said>
    cat "$2" >&2
    echo "regress: $1 could not play $session" >&2
    exit 3
}

in_turn() { # <pair> <old's turn> <new's turn>; the pipes open in this order or not at all
    play "$old" "$out/old-$1.csv" "$out/old.txt" --turns "$2" 3<"$out/to-old" 4>"$out/to-new" &
    other=$!
    new_failed=0
    play "$new" "$out/new-$1.csv" "$out/new.txt" --turns "$3" 4>"$out/to-old" 3<"$out/to-new" || new_failed=1
    wait "$other" || stop "$old" "$out/old.txt"
    [ "$new_failed" -eq 0 ] || stop "$new" "$out/new.txt"
}

pair=1
while [ "$pair" -le "$pairs" ]; do
    if [ $((pair % 2)) -eq 1 ]; then
        in_turn "$pair" first second
    else
        in_turn "$pair" second first
    fi
    cat "$out/old-$pair.csv" >>"$out/old.csv"
    cat "$out/new-$pair.csv" >>"$out/new.csv"
    echo "pair $pair of $pairs"
    pair=$((pair + 1))
done
"$timing_diff" "$out/old.csv" "$out/new.csv"
