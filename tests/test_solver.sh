# --solver: solve and live take chain or band; the curves are the same, and the log says which one ran.
. tests/check.sh
WIGGLY=${WIGGLY:-build/wiggly}
unset DISPLAY WAYLAND_DISPLAY
scene=tests/replays/session.json
replay=tests/replays/session.replay

for command in "solve $scene" live; do
    # shellcheck disable=SC2086
    expect 2 "${command%% *} by a solver that there is none of" "$WIGGLY" $command --solver tree
    says "says which there are" "wiggly ${command%% *}: --solver: expected chain or band, got 'tree'" "$err"
done

# --- the same curves, not the same bits

for solver in chain band; do
    expect 0 "solve by the $solver" "$WIGGLY" solve --solver $solver -o "$scratch/$solver.csv" assets/scenes/tail.json
done
"$WIGGLY" solve assets/scenes/tail.json | cmp - "$scratch/chain.csv"
ok "the chain is the default" $?
! cmp -s "$scratch/chain.csv" "$scratch/band.csv"
ok "the band is another way" $?
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
expect 0 "and by the chain" play chain --frames 400
grep -qx "# solver: chain" "$scratch/chain.csv"
ok "its log says so" $?
counters() { grep -v '^#' "$1" | cut -d, -f1,14-17; } # <log>
cmp <(counters "$scratch/band.csv") <(counters "$scratch/chain.csv")
ok "in each frame the band solved what the chain did" $?
cmp "$scratch/band.json" "$scratch/chain.json"
ok "to the same document" $?

# --- the switch in the inspector

{
    sed '/^frames/d' $replay | sed '/^dt/q'
    printf 'frames 30\n'
    printf '%s\n' "2 wheel 0 -40 @widget(look.stiff)+0,-60" \
        "3 pointer @widget(section.scene)" "3 press left @widget(section.scene)" "3 release left @widget(section.scene)" \
        "5 wheel 0 -40 @widget(look.stiff)+0,-60" \
        "6 pointer @widget(scene.solver.band)" "6 press left @widget(scene.solver.band)" "6 release left @widget(scene.solver.band)"
} >"$scratch/switch.replay"
replay=$scratch/switch.replay
expect 0 "the switch is found" play switch
[ "$(grep -A1 '^# solver: band' "$scratch/switch.csv" | tail -n 1 | cut -d, -f1,14)" = 6,2 ]
ok "from its frame on all is solved anew, by the band" $?
expect 0 "a log with both" "$WIGGLY" log "$scratch/switch.csv"
says "names both" "solver: chain, band" "$out"
cmp <("$WIGGLY" live --no-draw --frames 1 --result /dev/stdout $scene | sed '/^}$/q') "$scratch/switch.json"
ok "the document knows nothing of it" $?
exit $((cases_failed > 0))
