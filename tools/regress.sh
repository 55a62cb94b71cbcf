#!/bin/sh
# Frame times of two builds on the committed session: run in turn, so that the machine's drift hits both alike, then compared.
# Usage: tools/regress.sh <old wiggly> <new wiggly> <timing_diff> <output folder>   (PAIRS, at least 11, from the environment)
set -eu
old=$1 new=$2 timing_diff=$3 out=$4
session=tests/replays/session.replay
scene=tests/replays/session.json
pairs=${PAIRS:-11}
[ -x "$old" ] || { echo "regress: $old is not a program" >&2; exit 2; }
[ "$pairs" -ge 11 ] || { echo "regress: fewer than 11 pairs say too little; got PAIRS=$pairs" >&2; exit 2; }
mkdir -p "$out"
rm -f "$out"/*.csv

play() { # <program> <log>
    "$1" live --headless --replay "$session" --log "$2" "$scene" >"$out/last-run.txt" 2>&1 || {
        cat "$out/last-run.txt" >&2
        echo "regress: $1 could not play $session" >&2
        exit 3
    }
}

pair=1
while [ "$pair" -le "$pairs" ]; do
    play "$old" "$out/old-$pair.csv"
    play "$new" "$out/new-$pair.csv"
    cat "$out/old-$pair.csv" >>"$out/old.csv"
    cat "$out/new-$pair.csv" >>"$out/new.csv"
    echo "pair $pair of $pairs"
    pair=$((pair + 1))
done
"$timing_diff" "$out/old.csv" "$out/new.csv"
