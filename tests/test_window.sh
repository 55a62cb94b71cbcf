# The live app in a real window, driven by keys and mouse as a person would, under keyboards of other countries; displays that refuse; and a
# Wayland compositor without a seat, which dies.
. tests/check.sh
. tests/desktop.sh
go_to_scratch

keys() { xdotool key --delay 10 "$@"; } # by name, or by the number that X gives to their place
# Saves until it is so: the app gets to keys and files when it gets to them.
until_saved() { # <what> <command>...
    local tries bad=1
    for tries in $(seq 0 1199); do
        [ $((tries % 20)) -ne 0 ] || keys "${save:-ctrl+s}"
        "${@:2}" && bad=0 && break
        sleep 0.03
    done
    ok "$1" $bad
}
has() { [ "$(grep -c "$1" mine.json)" "${@:2}" ]; } # <pattern> <test's arguments>...: lines of the file
start_server

# --- see it run, edit, undo, save, quit, open again

expect 0 "frames in a window" wiggly live --frames 9 --size 640x400 --screenshot window.png
holds "the picture has the window's size" [ "$(identify -format '%wx%h' window.png 2>&1)" = 640x400 ]

cp "$root/assets/scenes/tail.json" mine.json
before=$(grep -c '"frame":' mine.json)
start_app mine.json mine.json
xdotool search --class '^wiggly$' >/dev/null
ok "the window's class is the one in wiggly.desktop" $?
keys Home shift+Left Right Right Right i
until_saved "I inserts a knot at the playhead and Ctrl+S saves it" has '"frame":' -eq $((before + 1))
quit_app
cp mine.json saved.json
expect 0 "what was saved is a good scene" wiggly check mine.json

start_app mine.json mine.json
keys ctrl+a Delete
until_saved "it opens again; Ctrl+A and Del delete the active spline's knots" has '"frame":' -lt "$before"
keys ctrl+z
until_saved "Ctrl+Z brings them back" cmp -s mine.json saved.json
xdotool keydown f
keys Up Up
xdotool keyup f
raised() { [ "$(diff saved.json mine.json | grep -c '^> *"frequency": 1.1,')" = 1 ]; }
until_saved "F held and Up twice raise the frequency by 0.1 Hz" raised
keys ctrl+z
until_saved "one Ctrl+Z takes both back" cmp -s mine.json saved.json
xdotool mousemove 295 248 click --repeat 2 --delay 5 1
until_saved "a double click on the curves inserts a knot" has '"frame":' -eq $((before + 2))
keys ctrl+z
until_saved "one Ctrl+Z takes it back, byte for byte" cmp -s mine.json saved.json
touch wiggly-0001.png
keys F12
eventually "F12 leaves a picture beside the scene's file" [ -s wiggly-0002.png ]
holds "and not over one that is there" [ ! -s wiggly-0001.png ]
quit_app

# --- the same board with other letters and signs on its keys; each is struck where that layout has it

cat >mine.json <<'END_OF_SCENE'
{"wiggly": 1, "frames": [0, 48], "splines": [{"name": "sway", "frequency": 1, "knots": [
{"frame": 6, "value": 0}, {"frame": 24, "value": 1}, {"frame": 48, "value": 0}]}]}
END_OF_SCENE
start_app mine.json mine.json
# `make test` takes the last three. Where the layout has: A, S, Y, Z, "-", "1", "." and "5".
while read -r layout A S Y Z minus one point five; do
    save=ctrl+$S
    setxkbmap -layout "$layout" -model pc105
    keys "ctrl+$A" "$S" "$Y" "$minus" "$one" "$point" "$five" Return
    until_saved "$layout: S, Y and -1.5 scale the values by that" has '"value": \(1.25\|-0.25\)' -eq 3
    keys "ctrl+$Z"
    until_saved "$layout: Ctrl+Z takes it back" has '"value": [01]' -eq 3
    keys Escape shift+Left "$point" shift+Next Delete
    until_saved "$layout: a knot, then one more, and both are deleted" has '"frame":' -eq 1
    keys "ctrl+$Z"
    until_saved "$layout: and brought back" has '"frame":' -eq 3
done < <(tail -n "$(thorough && echo 7 || echo 3)" <<'END_OF_ROWS'
us 38 39 29 52 20 10       60       14
de 38 39 52 29 61 10       60       14
no 38 39 29 52 61 10       60       14
se 38 39 29 52 61 10       60       14
fr 24 39 29 25 15 shift+10 shift+59 shift+14
ru 38 39 29 52 20 10       61       14
gr 38 39 29 52 20 10       60       14
END_OF_ROWS
)
keys ctrl+24 # in Greek the key of Q has a semicolon on it
await_end
ok "gr: Ctrl+Q quits" $status

# --- displays that refuse: the app says so in one line and runs headless, as it does where there is none

opens() { timeout 60 "$WIGGLY" live --frames 2 --size 320x320 "$@"; }
falls_back() { # <what>
    rm -f picture.png
    tells 0 "$1: the app runs all the same" "running headless" opens --screenshot picture.png
    holds "$1: and draws" [ -s picture.png ]
    holds "$1: it says so in one line" [ "$(printf '%s\n' "$err" | grep -c '^wiggly')" = 1 ]
}
DISPLAY=:6173 falls_back "a DISPLAY that nobody serves"
DISPLAY="" falls_back "an empty DISPLAY"

start_server -auth "$scratch/cookies"
cookie=$(od -An -N16 -tx1 /dev/urandom | tr -d ' \n')
# One entry for the server: family 0x0100 (local), this host's name, the display's number, the cookie.
field() { printf "\\$(printf %03o $((${#1} / 256)))\\$(printf %03o $((${#1} % 256)))%s" "$1"; }
{ printf '\001\000'; field "$(uname -n)"; field "${DISPLAY#:}"; field MIT-MAGIC-COOKIE-1; printf '\000\020'; sed 's/../\\x&/g' <<<"$cookie" | xargs -0 printf; } |
    head -c -1 >cookies
kill -HUP $server
XAUTHORITY=$scratch/none falls_back "a display that wants a cookie"
XAUTHORITY=$scratch/cookies expect 0 "with the cookie it opens" opens
holds "in a window" silent "$err"
# As through ssh -X, where no socket of this machine answers.
start_server -listen tcp -nolisten unix -nolisten local -ac
DISPLAY=127.0.0.1$DISPLAY expect 0 "a display of another host opens" opens
holds "in a window, too" silent "$err"
start_server -extension GLX
falls_back "a display without GLX"
stop_server

# --- Wayland: skipped where there is no weston, or where GLFW speaks X11 alone and Debian's build for Wayland cannot be had

skip() { # <why>
    echo "skip - $1"
    exit $cases_failed
}
command -v weston >/dev/null || skip "there is no weston"
weston=""
at_end() { kill -9 $app $weston 2>/dev/null; wait 2>/dev/null; }
export XDG_RUNTIME_DIR=$scratch/run
mkdir -m 700 "$XDG_RUNTIME_DIR"
weston --socket=seatless --idle-time=0 --backend=headless-backend.so >weston.log 2>&1 &
weston=$!
disown $weston
await [ -S "$XDG_RUNTIME_DIR/seatless" ] || skip "weston does not start"

# Debian has GLFW for Wayland in a package that takes the place of the other; here it is only unpacked.
unpack_glfw() {
    local folder=$root/build/glfw-wayland
    if [ ! -e "$folder/usr" ]; then
        mkdir -p "$folder"
        (cd "$folder" && timeout 60 apt-get download libglfw3-wayland && dpkg -x libglfw3-wayland_*.deb .) >/dev/null 2>&1 || return 1
    fi
    export LD_LIBRARY_PATH=$(echo "$folder"/usr/lib/*)
    export ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0 # which are the library's
}
wayland() { env -u DISPLAY WAYLAND_DISPLAY=seatless "$WIGGLY" live --size 320x320 "$@"; }
speaks() { ! wayland --frames 1 2>&1 | grep -q "no window opens"; }
speaks || { unpack_glfw && speaks; } || skip "this GLFW has no Wayland"
expect 0 "frames in a window without a seat" wayland --frames 20
env -u DISPLAY WAYLAND_DISPLAY=seatless "$WIGGLY" live --size 320x320 --still --log live.csv >/dev/null 2>app.err &
app=$!
eventually "it runs" [ -e live.csv ]
sleep 2
holds "and goes on" kill -0 $app
kill -9 $weston
weston=""
await_end
holds "a killed compositor: exit status 3" [ $status -eq 3 ]
says "and one sentence" "wiggly live: the window or its display is gone" "$(<app.err)"
