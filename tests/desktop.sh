# What the scripts share that drive the app in a real window. Sourced after check.sh, not run. Nothing here bounds how fast the
# app has to be: a loaded machine only makes a script slower.
unset WAYLAND_DISPLAY
server=""
app=""
at_end() { kill $app $server 2>/dev/null; wait 2>/dev/null; }

# Tries a command until it succeeds.
eventually() { # <what> <command>...
    local what=$1 tries
    shift
    for tries in $(seq 600); do "$@" && break; sleep 0.1; done
    ok "$what" $((tries == 600))
}

stop_server() {
    [ -z "$server" ] || kill $server 2>/dev/null
    server=""
}

# -noreset: a server that loses its last client would otherwise start over, and refuse the next one meanwhile.
start_server() { # <Xvfb's options>...
    stop_server
    rm -f "$scratch/display"
    Xvfb -displayfd 3 -noreset -screen 0 1280x720x24 -nolisten tcp "$@" 3>"$scratch/display" 2>"$scratch/xvfb.log" &
    server=$!
    eventually "an X server starts" [ -s "$scratch/display" ]
    export DISPLAY=:$(cat "$scratch/display")
}

# Starts the app and waits for a window with that title, which it has once the scene is open; the pointer is over the curves.
start_app() { # <title> [argument]...
    local title=$1
    shift
    "$WIGGLY" live "$@" >"$scratch/app.out" 2>"$scratch/app.err" &
    app=$!
    timeout 60 xdotool search --sync --onlyvisible --name "$title" >/dev/null
    ok "a window opens: $title" $?
    xdotool mousemove 500 560
}

# Waits for the app's own end; its exit status is in $status.
await_end() {
    local tries
    for tries in $(seq 600); do kill -0 $app 2>/dev/null || break; sleep 0.1; done
    [ "$tries" -lt 600 ] || kill $app
    status=0
    wait $app || status=$?
    app=""
}

quit_app() {
    xdotool key --delay 30 "$@" ctrl+q
    await_end
    ok "Ctrl+Q quits with exit status 0" $status
}

gone() { [ ! -e "$1" ]; }
