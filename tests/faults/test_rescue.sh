# What happens to unsaved work when the program cannot go on: the X server dies, or the session ends by a signal.
. tests/check.sh
. tests/desktop.sh

# Starts the app on a fresh scene and inserts a knot that is not saved.
start_edited() {
    cp assets/scenes/tail.json "$scratch/mine.json"
    start_app mine.json "$scratch/mine.json" --record "$scratch/mine.replay"
    xdotool key --delay 30 Home shift+Left Right Right Right i
    eventually "the title shows unsaved work" opened '^\*mine.json'
}

knots() { grep -o '"frame":' "$1" | wc -l; }

# Waits for the app's own end and looks at what it left.
check_rescue() { # <cause> <file with the work> <what the sentence says>
    await_end
    holds "$1: exit status 3" [ $status -eq 3 ]
    says "$1: one sentence says where the work is" "$3" "$(cat "$scratch/app.err")"
    [ "$(grep -c ^wiggly "$scratch/app.err")" -eq 1 ] && cmp "$scratch/mine.json" assets/scenes/tail.json
    ok "$1: the scene's own file is as it was" $?
    [ "$(knots "$2")" -eq $(($(knots "$scratch/mine.json") + 1)) ] && "$WIGGLY" check "$2" >/dev/null
    ok "$1: the work is whole" $?
}

recovery=$XDG_STATE_HOME/wiggly/recovery
start_server
slot=0
for signal in TERM HUP INT; do # the session's manager, a lost terminal, Ctrl+C
    slot=$((slot + 1))
    start_edited
    kill -$signal $app
    check_rescue "SIG$signal" "$recovery-$slot" "$recovery-$slot, and the next start offers to recover it"
done
start_edited
disown $server
kill -9 $server
check_rescue "a lost display" "$recovery-4" "$recovery-4, and the next start offers to recover it"
start_server
for slot in 5 6; do # destroyed while nothing moves, and while it draws
    start_edited
    [ $slot -eq 5 ] || xdotool key space
    sleep 0.3
    xdotool search --onlyvisible --name wiggly windowclose
    check_rescue "a destroyed window" "$recovery-$slot" "$recovery-$slot, and the next start offers to recover it"
done
holds "the recording has its length" grep -q '^frames [1-9]' "$scratch/mine.replay"

start_server
chmod -R a-w "$XDG_STATE_HOME"
if [ -w "$XDG_STATE_HOME/wiggly" ]; then # root may write everywhere
    rm -r "$XDG_STATE_HOME"
    touch "$XDG_STATE_HOME"
fi
start_edited
kill $app
check_rescue "no place for recovery files" "$scratch/mine.recovered.json" "$scratch/mine.recovered.json: open it to continue"
chmod -R u+w "$XDG_STATE_HOME"
