# The live app in a real window, driven by keys and mouse as a person would: see it run, edit, undo, save, quit, open again.
. tests/check.sh
WIGGLY=${WIGGLY:-build/wiggly}
unset WAYLAND_DISPLAY

# -noreset: a server that loses its last client would otherwise start over, and refuse the next one meanwhile.
Xvfb -displayfd 3 -noreset -screen 0 1280x720x24 -nolisten tcp 3>"$scratch/display" 2>"$scratch/xvfb.log" &
xvfb=$!
app=""
trap 'kill $app $xvfb 2>/dev/null; wait 2>/dev/null; rm -rf "$scratch"' EXIT
for _ in $(seq 100); do [ -s "$scratch/display" ] && break; sleep 0.1; done
export DISPLAY=:$(cat "$scratch/display")

keys() { xdotool key --delay 30 "$@"; }

# Starts the app with a scene and waits for its window, with the pointer over the curves.
start_app() {
    "$WIGGLY" live "$1" >"$scratch/app.out" 2>"$scratch/app.err" &
    app=$!
    timeout 20 xdotool search --sync --onlyvisible --name wiggly >/dev/null
    ok "a window opens" $?
    xdotool mousemove 500 560
    sleep 0.7
}

# Quits by key and expects exit status 0.
quit_app() {
    keys ctrl+q
    for _ in $(seq 50); do kill -0 $app 2>/dev/null || break; sleep 0.1; done
    if kill -0 $app 2>/dev/null; then
        ok "Ctrl+Q quits" 1
        kill $app
    else
        wait $app
        ok "Ctrl+Q quits with exit status 0" $?
    fi
    app=""
}

# How many knots the saved file has; waits for it, because the app saves when it gets to it.
has_knots() { # <what> <comparison> <number>
    local tries
    for tries in $(seq 50); do
        [ "$(grep -o '"frame":' "$scratch/mine.json" | wc -l)" "$2" "$3" ] && break
        sleep 0.1
    done
    ok "$1" $((tries == 50))
}

expect 0 "frames in a window" "$WIGGLY" live --frames 60 --log "$scratch/window.csv" --screenshot "$scratch/window.png"
says "prints the summary" "fps on average" "$out"
[ "$(identify -format '%wx%h' "$scratch/window.png" 2>&1)" = 1280x720 ]
ok "the picture has the window's size" $?

cp assets/scenes/tail.json "$scratch/mine.json"
before=$(grep -o '"frame":' "$scratch/mine.json" | wc -l)

start_app "$scratch/mine.json"
keys space Home shift+Left Right Right Right i ctrl+s
has_knots "I inserts a knot at the playhead and Ctrl+S saves it" -eq $((before + 1))
quit_app
cp "$scratch/mine.json" "$scratch/saved.json"
expect 0 "what was saved is a good scene" "$WIGGLY" check "$scratch/mine.json"

start_app "$scratch/mine.json"
keys space ctrl+a Delete ctrl+s
has_knots "it opens again; Ctrl+A and Del delete the active spline's knots" -lt "$before"
keys ctrl+z ctrl+s
has_knots "Ctrl+Z brings them back" -eq $((before + 1))
cp "$scratch/mine.json" "$scratch/undone.json"
xdotool keydown f
keys Up Up
xdotool keyup f
keys ctrl+s
for _ in $(seq 50); do cmp -s "$scratch/mine.json" "$scratch/undone.json" || break; sleep 0.1; done
[ "$(diff "$scratch/undone.json" "$scratch/mine.json" | grep -c '^> *"frequency": 1.1,')" = 1 ]
ok "F held and Up twice raise the frequency by 0.1 Hz" $?
keys ctrl+z ctrl+s
for _ in $(seq 50); do cmp -s "$scratch/mine.json" "$scratch/undone.json" && break; sleep 0.1; done
cmp "$scratch/mine.json" "$scratch/undone.json"
ok "one Ctrl+Z takes both back" $?
quit_app
cmp "$scratch/mine.json" "$scratch/saved.json"
ok "byte for byte" $?
exit $((cases_failed > 0))
