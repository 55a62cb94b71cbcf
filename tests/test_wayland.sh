# The live app under a Wayland compositor without a seat, and what happens when the compositor dies.
# Skipped where there is no weston, or where GLFW speaks X11 alone and Debian's build for Wayland cannot be had.
. tests/check.sh
. tests/desktop.sh
weston=""
at_end() { kill -9 $app $weston 2>/dev/null; wait 2>/dev/null; }

skip() { # <why>
    echo "skip - $1"
    exit 0
}
command -v weston >/dev/null || skip "there is no weston"
export XDG_RUNTIME_DIR=$scratch/run
mkdir -m 700 "$XDG_RUNTIME_DIR"

start_weston() { # <name of the display> <weston's options>...
    weston --socket="$1" --idle-time=0 "${@:2}" >"$scratch/weston.log" 2>&1 &
    weston=$!
    disown $weston
    for _ in $(seq 600); do [ -S "$XDG_RUNTIME_DIR/$1" ] && break; sleep 0.1; done
    [ -S "$XDG_RUNTIME_DIR/$1" ] || skip "weston does not start"
}

kill_weston() {
    kill -9 $weston
    weston=""
    await_end
    holds "a killed compositor: exit status 3" [ $status -eq 3 ]
}

wayland() { env -u DISPLAY WAYLAND_DISPLAY=$display "$WIGGLY" live "$@"; }

# Starts the app and waits until it draws.
start_wayland() { # [argument]...
    rm -f "$scratch/live.csv"
    env -u DISPLAY WAYLAND_DISPLAY=$display "$WIGGLY" live --log "$scratch/live.csv" "$@" >/dev/null 2>"$scratch/app.err" &
    app=$!
    eventually "it runs" [ -e "$scratch/live.csv" ]
    sleep 2
    holds "and goes on" kill -0 $app
}

# Debian has GLFW for Wayland in a package that takes the place of the other; here it is only unpacked.
unpack_glfw() {
    local folder=build/glfw-wayland
    if [ ! -e $folder/usr ]; then
        mkdir -p $folder
        (cd $folder && timeout 60 apt-get download libglfw3-wayland && dpkg -x libglfw3-wayland_*.deb .) >/dev/null 2>&1 || return 1
    fi
    export LD_LIBRARY_PATH=$(echo "$PWD"/$folder/usr/lib/*)
    export ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0 # which are the library's
}

display=seatless
start_weston $display --backend=headless-backend.so
speaks() { ! wayland --frames 1 2>&1 | grep -q "no window opens"; }
speaks || { unpack_glfw && speaks; } || skip "this GLFW has no Wayland"
expect 0 "frames in a window without a seat" wayland --frames 20
start_wayland
kill_weston
says "and one sentence" "wiggly live: the window or its display is gone" "$(cat "$scratch/app.err")"
