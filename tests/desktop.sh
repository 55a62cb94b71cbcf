# What the scripts share that drive the app in a real window. Sourced after check.sh, not run. Nothing here bounds how fast the
# app has to be: a loaded machine only makes a script slower.
unset WAYLAND_DISPLAY
server=""
app=""
at_end() { kill $app $server 2>/dev/null; wait 2>/dev/null; }

# Tries a command until it succeeds.
eventually() { # <what> <command>...
    await "${@:2}"
    ok "$1" $?
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

opened() { xdotool search --onlyvisible --name "$1" >/dev/null 2>&1; } # <title>; its own --sync looks every half a second

# Starts the app and waits for a window with that title, which it has once the scene is open; the pointer is over the curves. The window
# is small and still, because the processor draws it, unless $window says how large.
start_app() { # <title> [argument]...
    local title=$1
    shift
    "$WIGGLY" live --size ${window:-640x400} --stage-scale 0.25 --still "$@" >"$scratch/app.out" 2>"$scratch/app.err" &
    app=$!
    eventually "a window opens: $title" opened "$title"
    xdotool mousemove 250 330
}

# Waits for the app's own end; its exit status is in $status.
ended() { ! kill -0 $app 2>/dev/null; }
await_end() {
    await ended || kill $app
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
