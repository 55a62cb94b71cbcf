# Unsaved work outlives kill -9: the next start offers it, and neither the scene's own file nor another running app is touched.
. tests/check.sh
. tests/desktop.sh
window=1280x720 # room for larger text
state=$XDG_STATE_HOME/wiggly

expect 0 "a headless run" "$WIGGLY" live --no-draw --frames 2
[ ! -e "$XDG_STATE_HOME" ] && [ ! -e "$XDG_CONFIG_HOME" ]
ok "a headless run makes no files of the user's" $?

other=""
at_end() { kill $app $other $server 2>/dev/null; wait 2>/dev/null; }
start_server

# Inserts a knot, waits for the recovery file, and kills the app.
edit_and_kill() { # <keys that go to a frame without one>...
    xdotool key --delay 30 Home "$@" i
    eventually "unsaved work is kept soon after the edit" [ -s "$state/recovery-1" ]
    kill -9 $app
    wait $app 2>/dev/null
    app=""
}

cp assets/scenes/tail.json "$scratch/mine.json"
before=$(grep -o '"frame":' "$scratch/mine.json" | wc -l)
start_app mine.json "$scratch/mine.json"
xdotool key F1 Escape
said() { grep -q '"welcomed": true' "$XDG_CONFIG_HOME/wiggly/settings"; }
eventually "what to try first is said once" said
xdotool key F10
light() { grep -q '"theme": "light"' "$XDG_CONFIG_HOME/wiggly/settings"; }
eventually "the theme is remembered" light
xdotool key ctrl+shift+equal
larger() { grep -qE '"ui_scale": 1\.[0-9]+' "$XDG_CONFIG_HOME/wiggly/settings"; }
eventually "how large everything is, is remembered" larger
xdotool key ctrl+shift+0
edit_and_kill shift+Left Right Right Right
holds "the scene's own file is as it was" cmp "$scratch/mine.json" assets/scenes/tail.json
says "it says whose work it is" "\"file\": \"$scratch/mine.json\"" "$(grep recovers "$state/recovery-1")"

start_app wiggly
xdotool key l # later
quit_app
holds "later: it stays" [ -s "$state/recovery-1" ]

start_app wiggly
xdotool key r
eventually "recover: the title shows the scene with unsaved work" opened '^\*mine.json'
holds "it is still kept while it is not saved" [ -s "$state/recovery-1" ]
other=$app
start_app '^tail.json|^untitled'
xdotool key r # would recover what is offered, and insert nothing
quit_app
holds "what a running app works on is not offered to another" [ -s "$state/recovery-1" ]
app=$other
other=""
xdotool key ctrl+s
eventually "saved: nothing is left to recover" gone "$state/recovery-1"
quit_app
[ "$(grep -o '"frame":' "$scratch/mine.json" | wc -l)" -eq $((before + 1)) ]
ok "the work is in the scene's own file" $?
says "and that is a recent file" "\"$scratch/mine.json\"" "$(grep -A1 recent "$XDG_CONFIG_HOME/wiggly/settings")"

start_app mine.json "$scratch/mine.json"
edit_and_kill shift+Left Right Right Right Right Right
start_app wiggly
xdotool key d
eventually "discard: it is deleted" gone "$state/recovery-1"
quit_app

start_app mine.json "$scratch/mine.json"
xdotool key --delay 30 Home shift+Left Right Right Right Right i
eventually "kept again" [ -s "$state/recovery-1" ]
xdotool key --delay 30 ctrl+q d
await_end
holds "quitting without saving deletes it" gone "$state/recovery-1"

# Nor is work lost where names are not UTF-8, of a folder, a file and its character.
bytes=$scratch/caf$'\xe9'
mkdir "$bytes"
cp assets/models/dog.glb "$bytes/d"$'\xf6'g.glb
expect 0 "a character in a folder that is not UTF-8" "$WIGGLY" rig "$bytes/d"$'\xf6'g.glb --chain tail_1 -o "$bytes/mine.json"
start_app mine.json "$bytes/mine.json"
edit_and_kill shift+Left Right Right Right
expect 0 "the recovery file can be read" "$WIGGLY" check "$state/recovery-1"
start_app wiggly
xdotool key r
eventually "recover: it is the same scene" opened '^\*mine.json'
xdotool key ctrl+s
eventually "saved: nothing is left to recover" gone "$state/recovery-1"
quit_app
holds "the work is in that file" [ "$(grep -c '"frame":' "$bytes/mine.json")" -eq 1 ]
expect 0 "which finds its character" "$WIGGLY" export "$bytes/mine.json" -o "$bytes/mine.pc2" --frames 0:1
expect 0 "and can be read" "$WIGGLY" check "$bytes/mine.json"
holds "without a warning" [ -z "$err" ]

echo '{"theme" "dark"}' >"$XDG_CONFIG_HOME/wiggly/settings"
start_app wiggly
quit_app
holds "broken settings keep nobody from working" silent "$(cat "$scratch/app.err")"
