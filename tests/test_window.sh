# The live app in a real window, driven by keys and mouse as a person would: see it run, edit, undo, save, quit, open again.
. tests/check.sh
. tests/desktop.sh
window=1280x720
start_server

keys() { xdotool key --delay 30 "$@"; }

# How many knots the saved file has.
knots() { [ "$(grep -o '"frame":' "$scratch/mine.json" | wc -l)" "$@" ]; }

expect 0 "frames in a window" "$WIGGLY" live --frames 9 --screenshot "$scratch/window.png"
holds "the picture has the window's size" [ "$(identify -format '%wx%h' "$scratch/window.png" 2>&1)" = 1280x720 ]

cp assets/scenes/tail.json "$scratch/mine.json"
before=$(grep -o '"frame":' "$scratch/mine.json" | wc -l)

start_app mine.json "$scratch/mine.json"
xdotool mousemove 500 560
xdotool search --class '^wiggly$' >/dev/null
ok "the window's class is the one in wiggly.desktop" $?
keys Home shift+Left Right Right Right i ctrl+s
eventually "I inserts a knot at the playhead and Ctrl+S saves it" knots -eq $((before + 1))
quit_app
cp "$scratch/mine.json" "$scratch/saved.json"
expect 0 "what was saved is a good scene" "$WIGGLY" check "$scratch/mine.json"

start_app mine.json "$scratch/mine.json"
xdotool mousemove 500 560
keys ctrl+a Delete ctrl+s
eventually "it opens again; Ctrl+A and Del delete the active spline's knots" knots -lt "$before"
keys ctrl+z ctrl+s
eventually "Ctrl+Z brings them back" knots -eq $((before + 1))
cp "$scratch/mine.json" "$scratch/undone.json"
xdotool keydown f
keys Up Up
xdotool keyup f
keys ctrl+s
raised() { [ "$(diff "$scratch/undone.json" "$scratch/mine.json" | grep -c '^> *"frequency": 1.1,')" = 1 ]; }
eventually "F held and Up twice raise the frequency by 0.1 Hz" raised
keys ctrl+z ctrl+s
eventually "one Ctrl+Z takes both back" cmp -s "$scratch/mine.json" "$scratch/undone.json"
xdotool mousemove 700 540 click --repeat 2 --delay 5 1
keys ctrl+s
eventually "a double click on the curves inserts a knot" knots -eq $((before + 2))
keys ctrl+z ctrl+s
eventually "one Ctrl+Z takes it back" cmp -s "$scratch/mine.json" "$scratch/undone.json"
touch "$scratch/wiggly-0001.png"
keys F12
eventually "F12 leaves a picture beside the scene's file" [ -s "$scratch/wiggly-0002.png" ]
holds "and not over one that is there" [ ! -s "$scratch/wiggly-0001.png" ]
quit_app
holds "byte for byte" cmp "$scratch/mine.json" "$scratch/saved.json"
