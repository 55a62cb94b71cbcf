# Figures of the paper by their keys, in the app as a whole.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY
scene=tests/replays/session.json
replay=tests/replays/session.replay
header=$(sed '/^frames/q' $replay)

# A figure of the paper opens as an untitled scene, without a question unless work would be lost.
cp $scene "$scratch/own.json"
figure() { # <frames> <line>...
    frames=$1
    shift
    printf '%s\n' "$header" "$@" >"$scratch/figure.replay"
    "$WIGGLY" live --no-draw --replay "$scratch/figure.replay" --frames "$frames" --result "$scratch/figure.json" "$scratch/own.json"
}
for n in 1 2 3 4 5 6; do
    expect 0 "figure $n opens by its key" figure 20 "5 key $n ctrl"
    cmp "$scratch/figure.json" <("$WIGGLY" live --no-draw --frames 1 --result /dev/stdout assets/scenes/figure$n.json | sed '/^}$/q')
    ok "it is the scene of assets" $?
done
expect 0 "a figure is no file's" figure 40 "2 key 4 ctrl" "4 key S ctrl"
holds "saving one leaves the file that was open before alone" cmp "$scratch/own.json" $scene
