# The live app under a Wayland compositor without a seat, and what happens when the compositor dies. Skipped where there is no
# weston, or where GLFW speaks X11 alone.
. tests/check.sh
WIGGLY=${WIGGLY:-build/wiggly}
weston=""
app=""
trap 'kill -9 $app $weston 2>/dev/null; wait 2>/dev/null; rm -rf "$scratch"' EXIT

skip() { # <why>
    echo "skip - $1"
    exit 0
}
command -v weston >/dev/null || skip "there is no weston"
export XDG_RUNTIME_DIR=$scratch/run WAYLAND_DISPLAY=wiggly-test
mkdir -m 700 "$XDG_RUNTIME_DIR"
unset DISPLAY

weston --backend=headless-backend.so --socket=$WAYLAND_DISPLAY --idle-time=0 >"$scratch/weston.log" 2>&1 &
weston=$!
disown $weston
for _ in $(seq 600); do [ -S "$XDG_RUNTIME_DIR/$WAYLAND_DISPLAY" ] && break; sleep 0.1; done
[ -S "$XDG_RUNTIME_DIR/$WAYLAND_DISPLAY" ] || skip "weston does not start"

expect 0 "frames in a window without a seat" "$WIGGLY" live --frames 20
case $err in *"no display"*) skip "this GLFW has no Wayland" ;; esac

"$WIGGLY" live --log "$scratch/live.csv" >/dev/null 2>"$scratch/app.err" &
app=$!
for _ in $(seq 600); do [ -e "$scratch/live.csv" ] && break; sleep 0.1; done
sleep 2
kill -0 $app
ok "it runs" $?
kill -9 $weston
for _ in $(seq 600); do kill -0 $app 2>/dev/null || break; sleep 0.1; done
kill -0 $app 2>/dev/null && kill -9 $app
status=0
wait $app || status=$?
[ $status -eq 3 ]
ok "a killed compositor: exit status 3" $?
says "and one sentence" "wiggly live: the window or its display is gone" "$(cat "$scratch/app.err")"
exit $((cases_failed > 0))
