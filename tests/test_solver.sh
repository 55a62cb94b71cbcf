# --solver: solve and live take chain or band; the curves are the same, and the log says which one ran.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY
scene=tests/replays/session.json
replay=tests/replays/session.replay

# --- the same curves, not the same bits

for solver in chain band; do
    expect 0 "solve by the $solver" "$WIGGLY" solve --solver $solver -o "$scratch/$solver.csv" assets/scenes/figure4.json
done
"$WIGGLY" solve assets/scenes/figure4.json | cmp - "$scratch/band.csv"
ok "the band is the default" $?
by_default() { # <way> <last frame>
    printf '{"frames": [0, %s], "splines": [{"name": "s", "frequency": 1, "knots": [{"frame": 9, "value": 1}, {"frame": 99, "value": 2}]}]}' "$2" >"$scratch/long.json"
    "$WIGGLY" solve "$scratch/long.json" | cmp - <("$WIGGLY" solve --solver "$1" "$scratch/long.json")
    ok "of $(($2 + 1)) samples it is the $1" $?
}
by_default band 4095
by_default chain 4096
holds "the band is another way" not cmp -s "$scratch/chain.csv" "$scratch/band.csv"
paste -d, "$scratch/chain.csv" "$scratch/band.csv" | awk -F, 'NR > 1 { n = NF / 2; for (i = 1; i <= n; i++) if (($i - $(n + i)) ^ 2 > 1e-18) exit 1 }'
ok "to the same curves" $?

# --- live

play() { # <name> [option]...
    local name=$1
    shift
    "$WIGGLY" live --no-draw --replay $replay --log "$scratch/$name.csv" --result "$scratch/$name.json" "$@" $scene
}
expect 0 "a session plays by the band" play band --solver band --frames 400
grep -qx "# solver: band" "$scratch/band.csv" && ! grep -q "# solver: chain" "$scratch/band.csv"
ok "its log says so" $?
expect 0 "the log is read" "$WIGGLY" log "$scratch/band.csv"
says "and what is printed says so" "solver: band" "$out"
expect 0 "and by the chain" play chain --solver chain --frames 400
holds "its log says so" grep -qx "# solver: chain" "$scratch/chain.csv"
counters() { grep -v '^#' "$1" | cut -d, -f1,14-17; } # <log>
cmp <(counters "$scratch/band.csv") <(counters "$scratch/chain.csv")
ok "in each frame the band solved what the chain did" $?
holds "to the same document" cmp "$scratch/band.json" "$scratch/chain.json"
